/**Slider-crank with a torque on the crank.

# Equations

7 coordinates, 6 constraints, 1 degrees of freedom. Φ(q, t) = 0 is
```text
crank_x: x1 - 1/2*l1*cos(theta1) = 0
crank_y: y1 - 1/2*l1*sin(theta1) = 0
rod_x: x2 - l1*cos(theta1) - 1/2*l2*cos(theta2) = 0
rod_y: y2 - l1*sin(theta1) - 1/2*l2*sin(theta2) = 0
guide: l1*sin(theta1) + l2*sin(theta2) = 0
slider: x3 - l1*cos(theta1) - l2*cos(theta2) = 0
```

# Elimination

Order: constraints first, then what motion they leave free (null space).

```text
lambda(crank_x), x1: divided by 1
lambda(crank_y), y1: divided by 1
lambda(rod_x), x2: divided by 1
lambda(rod_y), y2: divided by 1
lambda(slider), x3: divided by 1
lambda(guide), theta1, theta2: divided by l1*cos(theta1)
```

# Cost

Operations per call:

| function | mul | add | div | sincos | other | pivot watch |
|---|---|---|---|---|---|---|
| `new` | 26 | 5 | 1 | 0 | 2 | 0 |
| `phi` | 8 | 9 | 0 | 2 | 0 | 0 |
| `phi_dot` | 12 | 9 | 0 | 2 | 0 | 0 |
| `phi_q` | 8 | 3 | 0 | 2 | 0 | 0 |
| `phi_t` | 0 | 0 | 0 | 0 | 0 | 0 |
| `gamma` | 14 | 9 | 0 | 2 | 0 | 0 |
| `baumgarte_rhs` | 40 | 34 | 0 | 2 | 0 | 0 |
| `mass` | 0 | 0 | 0 | 0 | 0 | 0 |
| `forces` | 0 | 2 | 0 | 0 | 0 | 0 |
| `kinetic_energy` | 14 | 6 | 0 | 0 | 0 | 0 |
| `potential_energy` | 2 | 1 | 0 | 0 | 0 | 0 |
| `stabilized` | 84 | 63 | 2 | 2 | 0 | 3 |
| `constrained` | 64 | 39 | 2 | 2 | 0 | 3 |
| `reactions` | 76 | 49 | 2 | 2 | 0 | 3 |
| `position_correction` | 6 | 3 | 1 | 1 | 0 | 2 |
| `velocity_correction` | 6 | 3 | 1 | 1 | 0 | 2 |
| `outputs` | 1 | 0 | 0 | 0 | 0 | 0 |
*/
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq
)]
pub struct SliderCrankFree<T = ::core::primitive::f64> {
    parameters: SliderCrankFreeParameters<T>,
    /**What depends on parameters alone, computed once:

```text
0: 1/2*l1
1: 1/2*l2
2: l1^2*m1*inertia_factor
3: l2^2*inertia_factor*m2
4: 9.81*m1
5: 9.81*m2
6: 1/2*l1^2*m1*inertia_factor
7: 1/2*m1
8: 1/2*m2
9: 1/2*l2^2*inertia_factor*m2
10: 1/2*m3
11: l2^2*inertia_factor*m2 + 1/4*l2^2*m2
12: l2^2*m3
13: 1/2*l1*l2*m2
14: 1/2*l1*l2*m2 + l1*l2*m3
15: l1^2*m1*inertia_factor + 1/4*l1^2*m1 + l1^2*m2
16: l1^2*m3
17: abs(l1)^2 + abs(l2)^2
18: 1/l2
19: abs(l2)
```
*/
    hoisted: [T; 20usize],
}
impl<T: ::mbs_runtime::Real> ::core::default::Default for SliderCrankFree<T> {
    /// The mechanism with its declared parameters.
    fn default() -> Self {
        Self::prepare(
            <SliderCrankFreeParameters<T> as ::core::default::Default>::default(),
        )
    }
}
///Parameters of [`SliderCrankFree`], in SI units; the default is the declaration.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq
)]
pub struct SliderCrankFreeParameters<T = ::core::primitive::f64> {
    /**Length of the crank.

`l1`: a length [m], declared as 60 mm = 0.06 in SI units.*/
    pub l1: T,
    /**Length of the rod.

`l2`: a length [m], declared as 180 mm = 0.18 in SI units.*/
    pub l2: T,
    /**Mass of the crank, at its middle.

`m1`: a mass [kg], declared as 0.5 kg = 0.5 in SI units.*/
    pub m1: T,
    /**Mass of the rod, at its middle.

`m2`: a mass [kg], declared as 1.2 kg = 1.2 in SI units.*/
    pub m2: T,
    /**Mass of the slider.

`m3`: a mass [kg], declared as 2 kg = 2 in SI units.*/
    pub m3: T,
    /**Moment of inertia of crank and rod about their middles over m l².

`inertia_factor`: a bare number, declared as 0.08333333333333333.*/
    pub inertia_factor: T,
    /**Speed of the crank at the start.

`omega`: a rate [1/s], declared as 200 rpm = 20.94395102393195 in SI units.*/
    pub omega: T,
}
impl<T: ::mbs_runtime::Real> ::core::default::Default for SliderCrankFreeParameters<T> {
    #[allow(clippy::approx_constant)]
    fn default() -> Self {
        Self {
            l1: T::from_f64(0.06),
            l2: T::from_f64(0.18),
            m1: T::from_f64(0.5),
            m2: T::from_f64(1.2),
            m3: T::from_f64(2.0),
            inertia_factor: T::from_f64(0.08333333333333333),
            omega: T::from_f64(20.94395102393195),
        }
    }
}
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Components for SliderCrankFreeParameters<T> {
    type Real = T;
    type Array = [T; 7];
    const NAMES: &'static [&'static ::core::primitive::str] = &[
        "l1",
        "l2",
        "m1",
        "m2",
        "m3",
        "inertia_factor",
        "omega",
    ];
    #[inline(always)]
    fn into_array(self) -> [T; 7] {
        [self.l1, self.l2, self.m1, self.m2, self.m3, self.inertia_factor, self.omega]
    }
    #[inline(always)]
    fn from_array(array: [T; 7]) -> Self {
        Self {
            l1: array[0],
            l2: array[1],
            m1: array[2],
            m2: array[3],
            m3: array[4],
            inertia_factor: array[5],
            omega: array[6],
        }
    }
    #[inline(always)]
    fn splat(value: T) -> Self {
        Self {
            l1: value,
            l2: value,
            m1: value,
            m2: value,
            m3: value,
            inertia_factor: value,
            omega: value,
        }
    }
}
impl<T: ::mbs_runtime::Real> ::core::convert::From<SliderCrankFreeParameters<T>>
for ::mbs_runtime::__private::nalgebra::SVector<T, 7> {
    fn from(components: SliderCrankFreeParameters<T>) -> Self {
        ::mbs_runtime::__private::nalgebra::SVector::<
            T,
            7,
        >::from_data(
            ::mbs_runtime::__private::nalgebra::ArrayStorage([
                ::mbs_runtime::Components::into_array(components),
            ]),
        )
    }
}
///Inputs of [`SliderCrankFree`], set by the embedding program, in SI units.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq
)]
pub struct SliderCrankFreeInputs<T = ::core::primitive::f64> {
    /**Torque on the crank.

`crank_torque`: a torque or energy [N*m].*/
    pub crank_torque: T,
}
impl<T: ::mbs_runtime::Real> ::core::default::Default for SliderCrankFreeInputs<T> {
    #[allow(clippy::approx_constant)]
    fn default() -> Self {
        Self {
            crank_torque: T::from_f64(0.0),
        }
    }
}
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Components for SliderCrankFreeInputs<T> {
    type Real = T;
    type Array = [T; 1];
    const NAMES: &'static [&'static ::core::primitive::str] = &["crank_torque"];
    #[inline(always)]
    fn into_array(self) -> [T; 1] {
        [self.crank_torque]
    }
    #[inline(always)]
    fn from_array(array: [T; 1]) -> Self {
        Self { crank_torque: array[0] }
    }
    #[inline(always)]
    fn splat(value: T) -> Self {
        Self { crank_torque: value }
    }
}
impl<T: ::mbs_runtime::Real> ::core::convert::From<SliderCrankFreeInputs<T>>
for ::mbs_runtime::__private::nalgebra::SVector<T, 1> {
    fn from(components: SliderCrankFreeInputs<T>) -> Self {
        ::mbs_runtime::__private::nalgebra::SVector::<
            T,
            1,
        >::from_data(
            ::mbs_runtime::__private::nalgebra::ArrayStorage([
                ::mbs_runtime::Components::into_array(components),
            ]),
        )
    }
}
///Coordinates of [`SliderCrankFree`], or their rates, in SI units.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq
)]
pub struct SliderCrankFreeCoordinates<T = ::core::primitive::f64> {
    ///`x1`: a length [m].
    pub x1: T,
    ///`y1`: a length [m].
    pub y1: T,
    ///`theta1`: an angle [rad].
    pub theta1: T,
    ///`x2`: a length [m].
    pub x2: T,
    ///`y2`: a length [m].
    pub y2: T,
    ///`theta2`: an angle [rad].
    pub theta2: T,
    ///`x3`: a length [m].
    pub x3: T,
}
impl<T: ::mbs_runtime::Real> ::core::default::Default for SliderCrankFreeCoordinates<T> {
    #[allow(clippy::approx_constant)]
    fn default() -> Self {
        Self {
            x1: T::from_f64(0.0),
            y1: T::from_f64(0.0),
            theta1: T::from_f64(0.0),
            x2: T::from_f64(0.0),
            y2: T::from_f64(0.0),
            theta2: T::from_f64(0.0),
            x3: T::from_f64(0.0),
        }
    }
}
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Components
for SliderCrankFreeCoordinates<T> {
    type Real = T;
    type Array = [T; 7];
    const NAMES: &'static [&'static ::core::primitive::str] = &[
        "x1",
        "y1",
        "theta1",
        "x2",
        "y2",
        "theta2",
        "x3",
    ];
    #[inline(always)]
    fn into_array(self) -> [T; 7] {
        [self.x1, self.y1, self.theta1, self.x2, self.y2, self.theta2, self.x3]
    }
    #[inline(always)]
    fn from_array(array: [T; 7]) -> Self {
        Self {
            x1: array[0],
            y1: array[1],
            theta1: array[2],
            x2: array[3],
            y2: array[4],
            theta2: array[5],
            x3: array[6],
        }
    }
    #[inline(always)]
    fn splat(value: T) -> Self {
        Self {
            x1: value,
            y1: value,
            theta1: value,
            x2: value,
            y2: value,
            theta2: value,
            x3: value,
        }
    }
}
impl<T: ::mbs_runtime::Real> ::core::convert::From<SliderCrankFreeCoordinates<T>>
for ::mbs_runtime::__private::nalgebra::SVector<T, 7> {
    fn from(components: SliderCrankFreeCoordinates<T>) -> Self {
        ::mbs_runtime::__private::nalgebra::SVector::<
            T,
            7,
        >::from_data(
            ::mbs_runtime::__private::nalgebra::ArrayStorage([
                ::mbs_runtime::Components::into_array(components),
            ]),
        )
    }
}
///One component per constraint of [`SliderCrankFree`]: Φ, its derivatives, or the multipliers λ.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq
)]
pub struct SliderCrankFreeConstraints<T = ::core::primitive::f64> {
    /**The crank turns about the origin.

`x1 - 1/2*l1*cos(theta1) = 0`*/
    pub crank_x: T,
    /**The crank turns about the origin.

`y1 - 1/2*l1*sin(theta1) = 0`*/
    pub crank_y: T,
    /**The rod begins at the crank's tip.

`x2 - l1*cos(theta1) - 1/2*l2*cos(theta2) = 0`*/
    pub rod_x: T,
    /**The rod begins at the crank's tip.

`y2 - l1*sin(theta1) - 1/2*l2*sin(theta2) = 0`*/
    pub rod_y: T,
    /**The rod ends on the x axis.

`l1*sin(theta1) + l2*sin(theta2) = 0`*/
    pub guide: T,
    /**The slider sits at the rod's end.

`x3 - l1*cos(theta1) - l2*cos(theta2) = 0`*/
    pub slider: T,
}
impl<T: ::mbs_runtime::Real> ::core::default::Default for SliderCrankFreeConstraints<T> {
    #[allow(clippy::approx_constant)]
    fn default() -> Self {
        Self {
            crank_x: T::from_f64(0.0),
            crank_y: T::from_f64(0.0),
            rod_x: T::from_f64(0.0),
            rod_y: T::from_f64(0.0),
            guide: T::from_f64(0.0),
            slider: T::from_f64(0.0),
        }
    }
}
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Components
for SliderCrankFreeConstraints<T> {
    type Real = T;
    type Array = [T; 6];
    const NAMES: &'static [&'static ::core::primitive::str] = &[
        "crank_x",
        "crank_y",
        "rod_x",
        "rod_y",
        "guide",
        "slider",
    ];
    #[inline(always)]
    fn into_array(self) -> [T; 6] {
        [self.crank_x, self.crank_y, self.rod_x, self.rod_y, self.guide, self.slider]
    }
    #[inline(always)]
    fn from_array(array: [T; 6]) -> Self {
        Self {
            crank_x: array[0],
            crank_y: array[1],
            rod_x: array[2],
            rod_y: array[3],
            guide: array[4],
            slider: array[5],
        }
    }
    #[inline(always)]
    fn splat(value: T) -> Self {
        Self {
            crank_x: value,
            crank_y: value,
            rod_x: value,
            rod_y: value,
            guide: value,
            slider: value,
        }
    }
}
impl<T: ::mbs_runtime::Real> ::core::convert::From<SliderCrankFreeConstraints<T>>
for ::mbs_runtime::__private::nalgebra::SVector<T, 6> {
    fn from(components: SliderCrankFreeConstraints<T>) -> Self {
        ::mbs_runtime::__private::nalgebra::SVector::<
            T,
            6,
        >::from_data(
            ::mbs_runtime::__private::nalgebra::ArrayStorage([
                ::mbs_runtime::Components::into_array(components),
            ]),
        )
    }
}
///Outputs of [`SliderCrankFree`], in SI units.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq
)]
pub struct SliderCrankFreeOutputs<T = ::core::primitive::f64> {
    /**Speed of the crank.

`crank_speed`: a rate [1/s].*/
    pub crank_speed: T,
    /**Power of the motor.

`motor_power`: a power [W].*/
    pub motor_power: T,
}
impl<T: ::mbs_runtime::Real> ::core::default::Default for SliderCrankFreeOutputs<T> {
    #[allow(clippy::approx_constant)]
    fn default() -> Self {
        Self {
            crank_speed: T::from_f64(0.0),
            motor_power: T::from_f64(0.0),
        }
    }
}
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Components for SliderCrankFreeOutputs<T> {
    type Real = T;
    type Array = [T; 2];
    const NAMES: &'static [&'static ::core::primitive::str] = &[
        "crank_speed",
        "motor_power",
    ];
    #[inline(always)]
    fn into_array(self) -> [T; 2] {
        [self.crank_speed, self.motor_power]
    }
    #[inline(always)]
    fn from_array(array: [T; 2]) -> Self {
        Self {
            crank_speed: array[0],
            motor_power: array[1],
        }
    }
    #[inline(always)]
    fn splat(value: T) -> Self {
        Self {
            crank_speed: value,
            motor_power: value,
        }
    }
}
impl<T: ::mbs_runtime::Real> ::core::convert::From<SliderCrankFreeOutputs<T>>
for ::mbs_runtime::__private::nalgebra::SVector<T, 2> {
    fn from(components: SliderCrankFreeOutputs<T>) -> Self {
        ::mbs_runtime::__private::nalgebra::SVector::<
            T,
            2,
        >::from_data(
            ::mbs_runtime::__private::nalgebra::ArrayStorage([
                ::mbs_runtime::Components::into_array(components),
            ]),
        )
    }
}
impl SliderCrankFree<::core::primitive::f64> {
    /// The mechanism with its declared parameters, in `f64`.
    ///
    /// For another scalar type, use `default`.
    pub fn declared() -> Self {
        ::core::default::Default::default()
    }
}
impl<T: ::mbs_runtime::Real> SliderCrankFree<T> {
    /// The mechanism with these parameters.
    ///
    /// # Errors
    /// If a parameter is not finite, a mass or an inertia comes out
    /// negative, or a declared condition does not hold.
    pub fn new(
        parameters: SliderCrankFreeParameters<T>,
    ) -> ::core::result::Result<Self, ::mbs_runtime::Error> {
        ::mbs_runtime::__private::check_finite(&parameters)?;
        #[allow(unused_variables)] #[allow(clippy::all)]
        {
            let v0 = parameters.inertia_factor * parameters.m1;
            let v1 = parameters.l1 * parameters.l1;
            let v2 = v1 * v0;
            let v3 = parameters.m2 * parameters.inertia_factor;
            let v4 = parameters.l2 * parameters.l2;
            let v5 = v4 * v3;
            if !(parameters.l1 > T::from_f64(0.0)) {
                return ::core::result::Result::Err(::mbs_runtime::Error::Parameter {
                    name: "l1",
                    value: (parameters.l1).to_f64(),
                    requirement: "`l1 > 0` has to hold",
                });
            }
            if !(parameters.l2 > T::from_f64(0.0)) {
                return ::core::result::Result::Err(::mbs_runtime::Error::Parameter {
                    name: "l2",
                    value: (parameters.l2).to_f64(),
                    requirement: "`l2 > 0` has to hold",
                });
            }
            if !(parameters.m1 >= T::from_f64(0.0)) {
                return ::core::result::Result::Err(::mbs_runtime::Error::Parameter {
                    name: "mass of crank",
                    value: (parameters.m1).to_f64(),
                    requirement: "it must not be negative",
                });
            }
            if !(v2 >= T::from_f64(0.0)) {
                return ::core::result::Result::Err(::mbs_runtime::Error::Parameter {
                    name: "inertia of crank",
                    value: (v2).to_f64(),
                    requirement: "it must not be negative",
                });
            }
            if !(parameters.m2 >= T::from_f64(0.0)) {
                return ::core::result::Result::Err(::mbs_runtime::Error::Parameter {
                    name: "mass of rod",
                    value: (parameters.m2).to_f64(),
                    requirement: "it must not be negative",
                });
            }
            if !(v5 >= T::from_f64(0.0)) {
                return ::core::result::Result::Err(::mbs_runtime::Error::Parameter {
                    name: "inertia of rod",
                    value: (v5).to_f64(),
                    requirement: "it must not be negative",
                });
            }
            if !(parameters.m3 >= T::from_f64(0.0)) {
                return ::core::result::Result::Err(::mbs_runtime::Error::Parameter {
                    name: "mass of slider",
                    value: (parameters.m3).to_f64(),
                    requirement: "it must not be negative",
                });
            }
        }
        ::core::result::Result::Ok(Self::prepare(parameters))
    }
    /// Computes what depends on parameters alone.
    #[allow(unused_variables, clippy::all)]
    fn prepare(parameters: SliderCrankFreeParameters<T>) -> Self {
        let abs_l1 = parameters.l1.abs();
        let abs_l2 = parameters.l2.abs();
        let v2 = T::from_f64(0.5) * parameters.l1;
        let v3 = T::from_f64(0.5) * parameters.l2;
        let v4 = parameters.l1 * parameters.l1;
        let v5 = parameters.m1 * v4;
        let v6 = parameters.inertia_factor * v5;
        let v7 = parameters.l2 * parameters.l2;
        let v8 = parameters.inertia_factor * v7;
        let v9 = parameters.m2 * v8;
        let v10 = T::from_f64(9.81) * parameters.m1;
        let v11 = T::from_f64(9.81) * parameters.m2;
        let v12 = T::from_f64(0.5) * v6;
        let v13 = T::from_f64(0.5) * parameters.m1;
        let v14 = T::from_f64(0.5) * parameters.m2;
        let v15 = v14 * v8;
        let v16 = T::from_f64(0.5) * parameters.m3;
        let v17 = T::from_f64(0.25) * parameters.m2;
        let v18 = v17 * v7;
        let v19 = v18 + v9;
        let v20 = parameters.m3 * v7;
        let v21 = parameters.l2 * parameters.l1;
        let v22 = v21 * v14;
        let v23 = parameters.m3 * v21;
        let v24 = v23 + v22;
        let v25 = T::from_f64(0.25) * v5;
        let v26 = parameters.m2 * v4;
        let v27 = v26 + v6;
        let v28 = v25 + v27;
        let v29 = parameters.m3 * v4;
        let v30 = abs_l1 * abs_l1;
        let v31 = abs_l2 * abs_l2;
        let v32 = v31 + v30;
        let v33 = T::from_f64(1.0) / parameters.l2;
        Self {
            parameters,
            hoisted: [
                v2,
                v3,
                v6,
                v9,
                v10,
                v11,
                v12,
                v13,
                v14,
                v15,
                v16,
                v19,
                v20,
                v22,
                v24,
                v28,
                v29,
                v32,
                v33,
                abs_l2,
            ],
        }
    }
    /// The parameters.
    pub fn parameters(&self) -> &SliderCrankFreeParameters<T> {
        &self.parameters
    }
}
impl<T: ::mbs_runtime::Real> SliderCrankFree<T> {
    /// Operations of one evaluation of the right-hand side, the watch over
    /// the pivots included; a step takes two, or less.
    pub const OPERATIONS: ::core::primitive::u32 = 154u32;
    /// The size of a state (time, positions, velocities) in bytes.
    pub const STATE_BYTES: ::core::primitive::usize = ::core::mem::size_of::<
        ::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
    >();
    /// A bound of the stack that a step takes, in bytes, in optimized code:
    /// every value of both evaluations of the right-hand side once, eight
    /// copies of the state, the inputs and the rows, and 1 KiB for calls.
    pub const STACK_BYTES: ::core::primitive::usize = 312usize
        * ::core::mem::size_of::<T>()
        + 8
            * (Self::STATE_BYTES
                + ::core::mem::size_of::<SliderCrankFreeConstraints<T>>()
                + ::core::mem::size_of::<SliderCrankFreeInputs<T>>()) + 1024;
}
#[allow(unused_variables, clippy::all)]
impl<T: ::mbs_runtime::Real> SliderCrankFree<T> {
    /**Constraints Φ(q, t): 0 where the mechanism is assembled.

```text
crank_x: x1 - 1/2*l1*cos(theta1)
crank_y: y1 - 1/2*l1*sin(theta1)
rod_x: x2 - l1*cos(theta1) - 1/2*l2*cos(theta2)
rod_y: y2 - l1*sin(theta1) - 1/2*l2*sin(theta2)
guide: l1*sin(theta1) + l2*sin(theta2)
slider: x3 - l1*cos(theta1) - l2*cos(theta2)
```


Cost: 8 mul + 9 add + 0 div + 2 sincos.*/
    #[inline(always)]
    pub fn phi(
        &self,
        t: T,
        q: &SliderCrankFreeCoordinates<T>,
    ) -> SliderCrankFreeConstraints<T> {
        let (sin_theta1, cos_theta1) = q.theta1.sin_cos();
        let (sin_theta2, cos_theta2) = q.theta2.sin_cos();
        let v4 = self.hoisted[0] * cos_theta1;
        let phi_crank_x = q.x1 - v4;
        let v6 = self.hoisted[0] * sin_theta1;
        let phi_crank_y = q.y1 - v6;
        let v8 = self.parameters.l1 * cos_theta1;
        let v9 = self.hoisted[1] * cos_theta2;
        let v10 = q.x2 - v9;
        let phi_rod_x = v10 - v8;
        let v12 = self.parameters.l1 * sin_theta1;
        let v13 = self.hoisted[1] * sin_theta2;
        let v14 = q.y2 - v13;
        let phi_rod_y = v14 - v12;
        let v16 = self.parameters.l2 * sin_theta2;
        let phi_guide = v16 + v12;
        let v18 = self.parameters.l2 * cos_theta2;
        let v19 = q.x3 - v18;
        let phi_slider = v19 - v8;
        SliderCrankFreeConstraints {
            crank_x: phi_crank_x,
            crank_y: phi_crank_y,
            rod_x: phi_rod_x,
            rod_y: phi_rod_y,
            guide: phi_guide,
            slider: phi_slider,
        }
    }
    /**Partial time derivative Φ_t; velocities satisfy Φ_q v = −Φ_t.

```text
crank_x: 0
crank_y: 0
rod_x: 0
rod_y: 0
guide: 0
slider: 0
```


Cost: 0 mul + 0 add + 0 div + 0 sincos.*/
    #[inline]
    pub fn phi_t(
        &self,
        t: T,
        q: &SliderCrankFreeCoordinates<T>,
    ) -> SliderCrankFreeConstraints<T> {
        SliderCrankFreeConstraints {
            crank_x: T::from_f64(0.0),
            crank_y: T::from_f64(0.0),
            rod_x: T::from_f64(0.0),
            rod_y: T::from_f64(0.0),
            guide: T::from_f64(0.0),
            slider: T::from_f64(0.0),
        }
    }
    /// Φ̇ = Φ_q v + Φ_t, the constraint violation in velocities.
    #[inline(always)]
    pub fn phi_dot(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
    ) -> SliderCrankFreeConstraints<T> {
        let (sin_theta1, cos_theta1) = at.q.theta1.sin_cos();
        let (sin_theta2, cos_theta2) = at.q.theta2.sin_cos();
        let v4 = at.v.theta1 * sin_theta1;
        let v5 = self.hoisted[0] * v4;
        let phi_dot_crank_x = at.v.x1 + v5;
        let v7 = at.v.theta1 * cos_theta1;
        let v8 = self.hoisted[0] * v7;
        let phi_dot_crank_y = at.v.y1 - v8;
        let v10 = self.parameters.l1 * v4;
        let v11 = at.v.theta2 * sin_theta2;
        let v12 = self.hoisted[1] * v11;
        let v13 = at.v.x2 + v12;
        let phi_dot_rod_x = v10 + v13;
        let v15 = self.parameters.l1 * v7;
        let v16 = at.v.theta2 * cos_theta2;
        let v17 = self.hoisted[1] * v16;
        let v18 = at.v.y2 - v17;
        let phi_dot_rod_y = v18 - v15;
        let v20 = self.parameters.l2 * v16;
        let phi_dot_guide = v20 + v15;
        let v22 = self.parameters.l2 * v11;
        let v23 = at.v.x3 + v22;
        let phi_dot_slider = v10 + v23;
        SliderCrankFreeConstraints {
            crank_x: phi_dot_crank_x,
            crank_y: phi_dot_crank_y,
            rod_x: phi_dot_rod_x,
            rod_y: phi_dot_rod_y,
            guide: phi_dot_guide,
            slider: phi_dot_slider,
        }
    }
    /**γ = −(Φ_q v)_q v − 2Φ_qt v − Φ_tt, so that Φ_q q̈ = γ (Jiang 2025, Eq. 5).

```text
crank_x: -1/2*l1*cos(theta1)*der(theta1)^2
crank_y: -1/2*l1*sin(theta1)*der(theta1)^2
rod_x: -l1*cos(theta1)*der(theta1)^2 - 1/2*l2*cos(theta2)*der(theta2)^2
rod_y: -l1*sin(theta1)*der(theta1)^2 - 1/2*l2*sin(theta2)*der(theta2)^2
guide: l1*sin(theta1)*der(theta1)^2 + l2*sin(theta2)*der(theta2)^2
slider: -l1*cos(theta1)*der(theta1)^2 - l2*cos(theta2)*der(theta2)^2
```


Cost: 14 mul + 9 add + 0 div + 2 sincos.*/
    #[inline]
    pub fn gamma(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
    ) -> SliderCrankFreeConstraints<T> {
        let (sin_theta1, cos_theta1) = at.q.theta1.sin_cos();
        let (sin_theta2, cos_theta2) = at.q.theta2.sin_cos();
        let v4 = at.v.theta1 * at.v.theta1;
        let v5 = v4 * cos_theta1;
        let v6 = self.hoisted[0] * v5;
        let gamma_crank_x = -v6;
        let v8 = v4 * sin_theta1;
        let v9 = self.hoisted[0] * v8;
        let gamma_crank_y = -v9;
        let v11 = self.parameters.l1 * v5;
        let v12 = at.v.theta2 * at.v.theta2;
        let v13 = v12 * cos_theta2;
        let v14 = self.hoisted[1] * v13;
        let v15 = v14 + v11;
        let gamma_rod_x = -v15;
        let v17 = self.parameters.l1 * v8;
        let v18 = v12 * sin_theta2;
        let v19 = self.hoisted[1] * v18;
        let v20 = v19 + v17;
        let gamma_rod_y = -v20;
        let v22 = self.parameters.l2 * v18;
        let gamma_guide = v22 + v17;
        let v24 = self.parameters.l2 * v13;
        let v25 = v24 + v11;
        let gamma_slider = -v25;
        SliderCrankFreeConstraints {
            crank_x: gamma_crank_x,
            crank_y: gamma_crank_y,
            rod_x: gamma_rod_x,
            rod_y: gamma_rod_y,
            guide: gamma_guide,
            slider: gamma_slider,
        }
    }
    /**γ − 2αΦ̇ − β²Φ, the right-hand side with feedback of the violation (Jiang 2025, Eq. 8); gains in 1/s.

Cost: 40 mul + 34 add + 0 div + 2 sincos.*/
    #[inline]
    pub fn baumgarte_rhs(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
        alpha: T,
        beta: T,
    ) -> SliderCrankFreeConstraints<T> {
        let gains = &::mbs_runtime::Gains {
            minus_two_alpha: -(alpha + alpha),
            minus_beta_squared: -(beta * beta),
        };
        let (sin_theta1, cos_theta1) = at.q.theta1.sin_cos();
        let (sin_theta2, cos_theta2) = at.q.theta2.sin_cos();
        let v4 = at.v.theta1 * cos_theta1;
        let v5 = self.hoisted[0] * v4;
        let v6 = at.v.theta1 * v5;
        let v7 = self.hoisted[0] * cos_theta1;
        let phi_crank_x = at.q.x1 - v7;
        let v9 = gains.minus_beta_squared * phi_crank_x;
        let v10 = at.v.theta1 * sin_theta1;
        let v11 = self.hoisted[0] * v10;
        let phi_dot_crank_x = at.v.x1 + v11;
        let v13 = gains.minus_two_alpha * phi_dot_crank_x;
        let v14 = v9 - v6;
        let v15 = v14 + v13;
        let v16 = at.v.theta1 * v11;
        let phi_dot_crank_y = at.v.y1 - v5;
        let v18 = gains.minus_two_alpha * phi_dot_crank_y;
        let v19 = self.hoisted[0] * sin_theta1;
        let phi_crank_y = at.q.y1 - v19;
        let v21 = gains.minus_beta_squared * phi_crank_y;
        let v22 = v21 - v16;
        let v23 = v22 + v18;
        let v24 = self.parameters.l1 * v4;
        let v25 = at.v.theta1 * v24;
        let v26 = at.v.theta2 * cos_theta2;
        let v27 = self.hoisted[1] * v26;
        let v28 = at.v.theta2 * v27;
        let v29 = self.parameters.l1 * v10;
        let v30 = at.v.theta2 * sin_theta2;
        let v31 = self.hoisted[1] * v30;
        let v32 = at.v.x2 + v31;
        let phi_dot_rod_x = v29 + v32;
        let v34 = gains.minus_two_alpha * phi_dot_rod_x;
        let v35 = self.parameters.l1 * cos_theta1;
        let v36 = self.hoisted[1] * cos_theta2;
        let v37 = at.q.x2 - v36;
        let phi_rod_x = v37 - v35;
        let v39 = gains.minus_beta_squared * phi_rod_x;
        let v40 = v28 + v25;
        let v41 = v39 - v40;
        let v42 = v41 + v34;
        let v43 = at.v.theta1 * v29;
        let v44 = at.v.theta2 * v31;
        let v45 = at.v.y2 - v27;
        let phi_dot_rod_y = v45 - v24;
        let v47 = gains.minus_two_alpha * phi_dot_rod_y;
        let v48 = self.parameters.l1 * sin_theta1;
        let v49 = self.hoisted[1] * sin_theta2;
        let v50 = at.q.y2 - v49;
        let phi_rod_y = v50 - v48;
        let v52 = gains.minus_beta_squared * phi_rod_y;
        let v53 = v44 + v43;
        let v54 = v52 - v53;
        let v55 = v54 + v47;
        let v56 = self.parameters.l2 * v30;
        let v57 = at.v.theta2 * v56;
        let v58 = self.parameters.l2 * v26;
        let phi_dot_guide = v58 + v24;
        let v60 = gains.minus_two_alpha * phi_dot_guide;
        let v61 = self.parameters.l2 * sin_theta2;
        let phi_guide = v61 + v48;
        let v63 = gains.minus_beta_squared * phi_guide;
        let v64 = v63 + v57;
        let v65 = v43 + v64;
        let v66 = v60 + v65;
        let v67 = at.v.theta2 * v58;
        let v68 = at.v.x3 + v56;
        let phi_dot_slider = v29 + v68;
        let v70 = gains.minus_two_alpha * phi_dot_slider;
        let v71 = self.parameters.l2 * cos_theta2;
        let v72 = at.q.x3 - v71;
        let phi_slider = v72 - v35;
        let v74 = gains.minus_beta_squared * phi_slider;
        let v75 = v67 + v25;
        let v76 = v74 - v75;
        let v77 = v76 + v70;
        SliderCrankFreeConstraints {
            crank_x: v15,
            crank_y: v23,
            rod_x: v42,
            rod_y: v55,
            guide: v66,
            slider: v77,
        }
    }
    /**Jacobian Φ_q, one row per constraint, one column per coordinate. Entries that are not 0:

```text
∂crank_x/∂x1 = 1
∂crank_x/∂theta1 = 1/2*l1*sin(theta1)
∂crank_y/∂y1 = 1
∂crank_y/∂theta1 = -1/2*l1*cos(theta1)
∂rod_x/∂theta1 = l1*sin(theta1)
∂rod_x/∂x2 = 1
∂rod_x/∂theta2 = 1/2*l2*sin(theta2)
∂rod_y/∂theta1 = -l1*cos(theta1)
∂rod_y/∂y2 = 1
∂rod_y/∂theta2 = -1/2*l2*cos(theta2)
∂guide/∂theta1 = l1*cos(theta1)
∂guide/∂theta2 = l2*cos(theta2)
∂slider/∂theta1 = l1*sin(theta1)
∂slider/∂theta2 = l2*sin(theta2)
∂slider/∂x3 = 1
```


Cost: 8 mul + 3 add + 0 div + 2 sincos.*/
    #[inline]
    pub fn phi_q(
        &self,
        t: T,
        q: &SliderCrankFreeCoordinates<T>,
    ) -> ::mbs_runtime::__private::nalgebra::SMatrix<T, 6usize, 7usize> {
        let (sin_theta1, cos_theta1) = q.theta1.sin_cos();
        let (sin_theta2, cos_theta2) = q.theta2.sin_cos();
        let phi_q_crank_x_theta1 = self.hoisted[0] * sin_theta1;
        let v5 = self.hoisted[0] * cos_theta1;
        let phi_q_crank_y_theta1 = -v5;
        let phi_q_rod_x_theta1 = self.parameters.l1 * sin_theta1;
        let phi_q_rod_x_theta2 = self.hoisted[1] * sin_theta2;
        let phi_q_guide_theta1 = self.parameters.l1 * cos_theta1;
        let phi_q_rod_y_theta1 = -phi_q_guide_theta1;
        let v11 = self.hoisted[1] * cos_theta2;
        let phi_q_rod_y_theta2 = -v11;
        let phi_q_guide_theta2 = self.parameters.l2 * cos_theta2;
        let phi_q_slider_theta2 = self.parameters.l2 * sin_theta2;
        ::mbs_runtime::__private::nalgebra::SMatrix::from_data(
            ::mbs_runtime::__private::nalgebra::ArrayStorage([
                [
                    T::from_f64(1.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                ],
                [
                    T::from_f64(0.0),
                    T::from_f64(1.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                ],
                [
                    phi_q_crank_x_theta1,
                    phi_q_crank_y_theta1,
                    phi_q_rod_x_theta1,
                    phi_q_rod_y_theta1,
                    phi_q_guide_theta1,
                    phi_q_rod_x_theta1,
                ],
                [
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(1.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                ],
                [
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(1.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                ],
                [
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    phi_q_rod_x_theta2,
                    phi_q_rod_y_theta2,
                    phi_q_guide_theta2,
                    phi_q_slider_theta2,
                ],
                [
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(1.0),
                ],
            ]),
        )
    }
    /**Mass matrix M. Its diagonal, all that is not 0:

```text
x1: m1
y1: m1
theta1: l1^2*m1*inertia_factor
x2: m2
y2: m2
theta2: l2^2*inertia_factor*m2
x3: m3
```


Cost: 0 mul + 0 add + 0 div + 0 sincos.*/
    #[inline]
    pub fn mass(
        &self,
        q: &SliderCrankFreeCoordinates<T>,
    ) -> ::mbs_runtime::__private::nalgebra::SMatrix<T, 7usize, 7usize> {
        ::mbs_runtime::__private::nalgebra::SMatrix::from_data(
            ::mbs_runtime::__private::nalgebra::ArrayStorage([
                [
                    self.parameters.m1,
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                ],
                [
                    T::from_f64(0.0),
                    self.parameters.m1,
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                ],
                [
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    self.hoisted[2],
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                ],
                [
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    self.parameters.m2,
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                ],
                [
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    self.parameters.m2,
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                ],
                [
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    self.hoisted[3],
                    T::from_f64(0.0),
                ],
                [
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    self.parameters.m3,
                ],
            ]),
        )
    }
    /**Generalized forces Q: gravity and applied loads.

```text
x1: 0
y1: -9.81*m1
theta1: crank_torque
x2: 0
y2: -9.81*m2
theta2: 0
x3: 0
```


Cost: 0 mul + 2 add + 0 div + 0 sincos.*/
    #[inline]
    pub fn forces(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
        inputs: &SliderCrankFreeInputs<T>,
    ) -> SliderCrankFreeCoordinates<T> {
        let v0 = -self.hoisted[4];
        let v1 = -self.hoisted[5];
        SliderCrankFreeCoordinates {
            x1: T::from_f64(0.0),
            y1: v0,
            theta1: inputs.crank_torque,
            x2: T::from_f64(0.0),
            y2: v1,
            theta2: T::from_f64(0.0),
            x3: T::from_f64(0.0),
        }
    }
    /**Accelerations q̈ and multipliers λ from M q̈ + Φ_qᵀ λ = Q, Φ_q q̈ = γ, without feedback terms.

In a singular position the result is not finite or its `growth` exceeds the runtime's `growth_limit`.

Cost: 76 mul + 49 add + 2 div + 2 sincos.*/
    #[inline]
    pub fn accelerations(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
        inputs: &SliderCrankFreeInputs<T>,
    ) -> ::mbs_runtime::Reactions<
        SliderCrankFreeCoordinates<T>,
        SliderCrankFreeConstraints<T>,
    > {
        let none = <SliderCrankFreeConstraints<
            T,
        > as ::mbs_runtime::Components>::splat(T::from_f64(0.0));
        ::mbs_runtime::Mechanism::reactions(self, at, inputs, &none)
    }
    /// Kinetic energy ½ vᵀMv in J.
    #[inline(always)]
    pub fn kinetic_energy(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
    ) -> T {
        let v0 = self.hoisted[6] * at.v.theta1;
        let v1 = at.v.theta1 * v0;
        let v2 = self.hoisted[7] * at.v.x1;
        let v3 = at.v.x1 * v2;
        let v4 = self.hoisted[7] * at.v.y1;
        let v5 = at.v.y1 * v4;
        let v6 = self.hoisted[8] * at.v.x2;
        let v7 = at.v.x2 * v6;
        let v8 = self.hoisted[8] * at.v.y2;
        let v9 = at.v.y2 * v8;
        let v10 = self.hoisted[9] * at.v.theta2;
        let v11 = at.v.theta2 * v10;
        let v12 = self.hoisted[10] * at.v.x3;
        let v13 = at.v.x3 * v12;
        let v14 = v13 + v11;
        let v15 = v9 + v7;
        let v16 = v5 + v3;
        let v17 = v1 + v16;
        let v18 = v15 + v14;
        let v19 = v18 + v17;
        v19
    }
    /// Potential energy of gravity (0 at the origin) and springs in J.
    #[inline(always)]
    pub fn potential_energy(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
    ) -> T {
        let v0 = self.hoisted[4] * at.q.y1;
        let v1 = self.hoisted[5] * at.q.y2;
        let v2 = v1 + v0;
        v2
    }
}
#[allow(unused_variables, clippy::all)]
impl<T: ::mbs_runtime::Real> SliderCrankFree<T> {
    ///A step with feedback held over it.
    #[inline(always)]
    fn step_held(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
        inputs: &SliderCrankFreeInputs<T>,
        gains: &::mbs_runtime::Gains<T>,
        h: T,
        t_next: T,
    ) -> ::mbs_runtime::Stepped<SliderCrankFreeCoordinates<T>> {
        use ::mbs_runtime::{Pair as _, Single as _};
        type Single<T> = <<T as ::mbs_runtime::Real>::Pair as ::mbs_runtime::Pair<
            T,
        >>::Single;
        let half_h = T::from_f64(0.5) * h;
        let p0 = T::Pair::join(Single::<T>::new(at.q.x1), Single::<T>::new(at.q.y1));
        let p1 = T::Pair::splat(Single::<T>::new(half_h));
        let p2 = T::Pair::join(Single::<T>::new(at.v.x1), Single::<T>::new(at.v.y1));
        let p3 = T::Pair::splat(Single::<T>::new(h));
        let p4 = T::Pair::splat(Single::<T>::new(gains.minus_beta_squared));
        let p5 = T::Pair::splat(Single::<T>::new(self.hoisted[0]));
        let p6 = T::Pair::join(
            Single::<T>::new(at.q.theta1),
            Single::<T>::new(at.q.theta2),
        );
        let (sines7, cosines7) = p6.sin_cos();
        let p9 = T::Pair::join(cosines7.first(), sines7.first());
        let p10 = p5 * p9;
        let p11 = p0 - p10;
        let p12 = p4 * p11;
        let p13 = T::Pair::splat(Single::<T>::new(gains.minus_two_alpha));
        let p14 = T::Pair::splat(Single::<T>::new(at.v.theta1));
        let p15 = p14.flip();
        let p16 = p10.swap();
        let p17 = p15 * p16;
        let p18 = p2 + p17;
        let p19 = p13 * p18;
        let p20 = p12 + p19;
        let v21 = Single::<T>::new(at.v.theta1) * Single::<T>::new(at.v.theta1);
        let p22 = T::Pair::splat(v21);
        let p23 = p22 * p10;
        let p24 = p20 - p23;
        let p25 = p16.flip();
        let p26 = T::Pair::splat(Single::<T>::new(self.parameters.l1));
        let p27 = p26 * p9;
        let p28 = T::Pair::splat(Single::<T>::new(self.parameters.l2));
        let v29 = Single::<T>::new(h) * Single::<T>::new(at.v.theta1);
        let v30 = Single::<T>::new(at.q.theta1) + v29;
        let v31 = Single::<T>::new(h) * Single::<T>::new(at.v.theta2);
        let v32 = Single::<T>::new(at.q.theta2) + v31;
        let p33 = T::Pair::join(v30, v32);
        let (sines34, cosines34) = p33.sin_cos();
        let p36 = T::Pair::join(cosines7.second(), cosines34.second());
        let p37 = p28 * p36;
        let p38 = T::Pair::join(p27.first(), p37.first());
        let v39 = Single::<T>::new(self.parameters.l2) * sines7.second();
        let phi_guide = v39 + p27.second();
        let v41 = Single::<T>::new(at.q.x3) - p37.first();
        let phi_slider = v41 - p27.first();
        let p43 = T::Pair::join(phi_guide, phi_slider);
        let p44 = p4 * p43;
        let v45 = Single::<T>::new(at.v.theta2) * p37.first();
        let p46 = p27.swap();
        let p47 = p14 * p46;
        let p48 = T::Pair::join(v45, p47.first());
        let v49 = Single::<T>::new(at.v.theta2) * v39;
        let v50 = Single::<T>::new(at.v.x3) + v49;
        let p51 = T::Pair::join(p47.second(), v50);
        let p52 = p48 + p51;
        let p53 = p13 * p52;
        let p54 = p44 + p53;
        let v55 = Single::<T>::new(at.v.theta2) * Single::<T>::new(at.v.theta2);
        let p56 = T::Pair::splat(v55);
        let p57 = p56.flip();
        let p58 = T::Pair::join(v39, p37.first());
        let p59 = p57 * p58;
        let p60 = p22 * p27;
        let p61 = p60.swap();
        let p62 = p61.flip();
        let p63 = p59 + p62;
        let p64 = p54 + p63;
        let p65 = T::Pair::splat(Single::<T>::new(T::from_f64(1.0)));
        let p66 = p37 * p37;
        let v67 = p27.first() * p27.first();
        let p68 = T::Pair::join(cosines34.first(), sines34.first());
        let p69 = p26 * p68;
        let v70 = p69.first() * p69.first();
        let p71 = T::Pair::join(v67, v70);
        let p72 = p66 + p71;
        let p73 = p65 / p72;
        let v74 = p64.first() * p73.first();
        let p75 = T::Pair::splat(v74);
        let p76 = p38 * p75;
        let p77 = T::Pair::join(p37.first(), p27.first());
        let p78 = p77.flip();
        let v79 = Single::<T>::new(self.parameters.m3) * p64.second();
        let v80 = v39 * v79;
        let p81 = T::Pair::splat(Single::<T>::new(self.hoisted[1]));
        let p82 = T::Pair::join(cosines7.second(), sines7.second());
        let p83 = p81 * p82;
        let p84 = T::Pair::join(Single::<T>::new(at.q.x2), Single::<T>::new(at.q.y2));
        let p85 = p84 - p83;
        let p86 = p85 - p27;
        let p87 = p4 * p86;
        let p88 = T::Pair::join(Single::<T>::new(at.v.x2), Single::<T>::new(at.v.y2));
        let p89 = T::Pair::splat(Single::<T>::new(at.v.theta2));
        let p90 = p89 * p83;
        let p91 = p90.swap();
        let p92 = p91.flip();
        let p93 = p88 + p92;
        let p94 = p47.flip();
        let p95 = p93 + p94;
        let p96 = p13 * p95;
        let p97 = p87 + p96;
        let p98 = p56 * p83;
        let p99 = p98 + p60;
        let p100 = p97 - p99;
        let v101 = Single::<T>::new(self.parameters.m2) * p100.first();
        let v102 = p83.second() * v101;
        let v103 = v80 + v102;
        let v104 = Single::<T>::new(self.parameters.m2) * p100.second();
        let v105 = Single::<T>::new(self.hoisted[5]) + v104;
        let v106 = p83.first() * v105;
        let v107 = v103 - v106;
        let v108 = p27.first() * v107;
        let v109 = p27.second() * v101;
        let v110 = Single::<T>::new(self.parameters.m1) * p24.second();
        let v111 = Single::<T>::new(self.hoisted[4]) + v110;
        let v112 = p10.first() * v111;
        let v113 = v109 - v112;
        let v114 = Single::<T>::new(self.parameters.m1) * p24.first();
        let v115 = p10.second() * v114;
        let v116 = Single::<T>::new(inputs.crank_torque) + v115;
        let v117 = p27.second() * v79;
        let v118 = v116 + v117;
        let v119 = v113 + v118;
        let v120 = p27.first() * v105;
        let v121 = v119 - v120;
        let v122 = p37.first() * v121;
        let v123 = v108 - v122;
        let p124 = T::Pair::join(p27.first(), p69.first());
        let p125 = T::Pair::splat(Single::<T>::new(self.hoisted[11]));
        let p126 = T::Pair::join(sines7.second(), sines34.second());
        let p127 = T::Pair::splat(Single::<T>::new(self.hoisted[12]));
        let p128 = p127 * p126;
        let p129 = p126 * p128;
        let p130 = p125 + p129;
        let p131 = p124 * p130;
        let p132 = T::Pair::join(sines7.first(), sines34.first());
        let p133 = T::Pair::splat(Single::<T>::new(self.hoisted[14]));
        let p134 = p133 * p126;
        let p135 = p132 * p134;
        let p136 = T::Pair::join(cosines7.first(), cosines34.first());
        let p137 = T::Pair::splat(Single::<T>::new(self.hoisted[13]));
        let p138 = p137 * p36;
        let p139 = p136 * p138;
        let p140 = p135 + p139;
        let p141 = p37 * p140;
        let p142 = p131 - p141;
        let p143 = p37 * p142;
        let p144 = p124 * p140;
        let p145 = T::Pair::splat(Single::<T>::new(self.hoisted[15]));
        let p146 = T::Pair::splat(Single::<T>::new(self.hoisted[16]));
        let p147 = p146 * p132;
        let p148 = p132 * p147;
        let p149 = p145 + p148;
        let p150 = p37 * p149;
        let p151 = p144 - p150;
        let p152 = p124 * p151;
        let p153 = p143 + p152;
        let v154 = p153.first() * v74;
        let v155 = v123 - v154;
        let p156 = p124 * p142;
        let p157 = p37 * p151;
        let p158 = p156 - p157;
        let v159 = v155 / p158.first();
        let p160 = T::Pair::splat(v159);
        let p161 = p78 * p160;
        let p162 = p76 - p161;
        let p163 = T::Pair::splat(p162.first());
        let p164 = p25 * p163;
        let p165 = p24 - p164;
        let p166 = p3 * p165;
        let p167 = p2 + p166;
        let p168 = p2 + p167;
        let p169 = p1 * p168;
        let p170 = p0 + p169;
        let p171 = T::Pair::join(
            Single::<T>::new(at.v.theta1),
            Single::<T>::new(at.v.theta2),
        );
        let p172 = p3 * p162;
        let p173 = p171 + p172;
        let p174 = p171 + p173;
        let p175 = p1 * p174;
        let p176 = p6 + p175;
        let p177 = T::Pair::join(p27.second(), p83.first());
        let p178 = p177.flip();
        let p179 = p178 * p162;
        let p180 = T::Pair::join(p83.second(), p27.first());
        let p181 = p180.flip();
        let p182 = p162.swap();
        let p183 = p181 * p182;
        let p184 = p179 + p183;
        let p185 = p100 - p184;
        let p186 = p3 * p185;
        let p187 = p88 + p186;
        let p188 = p88 + p187;
        let p189 = p1 * p188;
        let p190 = p84 + p189;
        let v191 = v39 * p162.second();
        let v192 = v191 + p179.first();
        let acc_x3 = p64.second() - v192;
        let v194 = Single::<T>::new(h) * acc_x3;
        let v195 = Single::<T>::new(at.v.x3) + v194;
        let v196 = Single::<T>::new(at.v.x3) + v195;
        let v197 = Single::<T>::new(half_h) * v196;
        let v198 = Single::<T>::new(at.q.x3) + v197;
        let p199 = p173 * p173;
        let p200 = T::Pair::splat(p199.first());
        let p201 = p5 * p68;
        let p202 = p200 * p201;
        let p203 = p20 - p202;
        let p204 = p201.swap();
        let p205 = p204.flip();
        let p206 = T::Pair::join(p69.first(), p37.second());
        let p207 = p200 * p69;
        let v208 = Single::<T>::new(self.parameters.l2) * sines34.second();
        let v209 = p199.second() * v208;
        let v210 = p54.first() + v209;
        let v211 = p207.second() + v210;
        let v212 = v211 * p73.second();
        let p213 = T::Pair::splat(v212);
        let p214 = p206 * p213;
        let p215 = T::Pair::join(p37.second(), p69.first());
        let p216 = p215.flip();
        let v217 = p199.second() * p37.second();
        let v218 = p54.second() - v217;
        let v219 = v218 - p207.first();
        let v220 = Single::<T>::new(self.parameters.m3) * v219;
        let v221 = v208 * v220;
        let p222 = T::Pair::join(cosines34.second(), sines34.second());
        let p223 = p81 * p222;
        let p224 = T::Pair::splat(p199.second());
        let p225 = p224 * p223;
        let p226 = p97 - p225;
        let p227 = p226 - p207;
        let v228 = Single::<T>::new(self.parameters.m2) * p227.first();
        let v229 = p223.second() * v228;
        let v230 = v221 + v229;
        let v231 = Single::<T>::new(self.parameters.m2) * p227.second();
        let v232 = Single::<T>::new(self.hoisted[5]) + v231;
        let v233 = p223.first() * v232;
        let v234 = v230 - v233;
        let v235 = p69.first() * v234;
        let v236 = p69.second() * v228;
        let v237 = Single::<T>::new(self.parameters.m1) * p203.second();
        let v238 = Single::<T>::new(self.hoisted[4]) + v237;
        let v239 = p201.first() * v238;
        let v240 = v236 - v239;
        let v241 = Single::<T>::new(self.parameters.m1) * p203.first();
        let v242 = p201.second() * v241;
        let v243 = Single::<T>::new(inputs.crank_torque) + v242;
        let v244 = p69.second() * v220;
        let v245 = v243 + v244;
        let v246 = v240 + v245;
        let v247 = p69.first() * v232;
        let v248 = v246 - v247;
        let v249 = p37.second() * v248;
        let v250 = v235 - v249;
        let v251 = p153.second() * v212;
        let v252 = v250 - v251;
        let v253 = v252 / p158.second();
        let p254 = T::Pair::splat(v253);
        let p255 = p216 * p254;
        let p256 = p214 - p255;
        let p257 = T::Pair::splat(p256.first());
        let p258 = p205 * p257;
        let p259 = p203 - p258;
        let p260 = p165 + p259;
        let p261 = p1 * p260;
        let p262 = p2 + p261;
        let p263 = p162 + p256;
        let p264 = p1 * p263;
        let p265 = p171 + p264;
        let p266 = T::Pair::join(p69.second(), p223.first());
        let p267 = p266.flip();
        let p268 = p267 * p256;
        let p269 = T::Pair::join(p223.second(), p69.first());
        let p270 = p269.flip();
        let p271 = p256.swap();
        let p272 = p270 * p271;
        let p273 = p268 + p272;
        let p274 = p227 - p273;
        let p275 = p185 + p274;
        let p276 = p1 * p275;
        let p277 = p88 + p276;
        let v278 = v208 * p256.second();
        let v279 = v278 + p268.first();
        let v280 = v219 - v279;
        let v281 = acc_x3 + v280;
        let v282 = Single::<T>::new(half_h) * v281;
        let v283 = Single::<T>::new(at.v.x3) + v282;
        let p284 = T::Pair::splat(Single::<T>::new(self.hoisted[17]));
        let p285 = p284 * p73;
        let v286 = Single::<T>::new(p285.first().get().abs());
        let v287 = Single::<T>::new(v286.get().sqrt());
        let v288 = Single::<T>::new(p285.second().get().abs());
        let v289 = Single::<T>::new(v288.get().sqrt());
        let v290 = v287 + v289;
        let p291 = p170 + p176;
        let p292 = p291 + p190;
        let p293 = p292 + p262;
        let p294 = p293 + p265;
        let p295 = p294 + p277;
        let v296 = v198 + v283;
        let v297 = v296 + p295.first();
        let v298 = v297 + p295.second();
        ::mbs_runtime::Stepped {
            next: ::mbs_runtime::State {
                t: t_next,
                q: SliderCrankFreeCoordinates {
                    x1: p170.first().get(),
                    y1: p170.second().get(),
                    theta1: p176.first().get(),
                    x2: p190.first().get(),
                    y2: p190.second().get(),
                    theta2: p176.second().get(),
                    x3: v198.get(),
                },
                v: SliderCrankFreeCoordinates {
                    x1: p262.first().get(),
                    y1: p262.second().get(),
                    theta1: p265.first().get(),
                    x2: p277.first().get(),
                    y2: p277.second().get(),
                    theta2: p265.second().get(),
                    x3: v283.get(),
                },
            },
            growth: v290.get(),
            sum: v298.get(),
        }
    }
    ///A step with feedback in both stages.
    #[inline(always)]
    fn step_per_stage(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
        inputs: &SliderCrankFreeInputs<T>,
        gains: &::mbs_runtime::Gains<T>,
        h: T,
        t_next: T,
    ) -> ::mbs_runtime::Stepped<SliderCrankFreeCoordinates<T>> {
        use ::mbs_runtime::{Pair as _, Single as _};
        type Single<T> = <<T as ::mbs_runtime::Real>::Pair as ::mbs_runtime::Pair<
            T,
        >>::Single;
        let half_h = T::from_f64(0.5) * h;
        let p0 = T::Pair::join(Single::<T>::new(at.q.x1), Single::<T>::new(at.q.y1));
        let p1 = T::Pair::splat(Single::<T>::new(half_h));
        let p2 = T::Pair::join(Single::<T>::new(at.v.x1), Single::<T>::new(at.v.y1));
        let p3 = T::Pair::splat(Single::<T>::new(h));
        let p4 = T::Pair::splat(Single::<T>::new(gains.minus_beta_squared));
        let p5 = T::Pair::splat(Single::<T>::new(self.hoisted[0]));
        let p6 = T::Pair::join(
            Single::<T>::new(at.q.theta1),
            Single::<T>::new(at.q.theta2),
        );
        let (sines7, cosines7) = p6.sin_cos();
        let p9 = T::Pair::join(cosines7.first(), sines7.first());
        let p10 = p5 * p9;
        let p11 = p0 - p10;
        let p12 = p4 * p11;
        let p13 = T::Pair::splat(Single::<T>::new(gains.minus_two_alpha));
        let p14 = T::Pair::splat(Single::<T>::new(at.v.theta1));
        let p15 = p14.flip();
        let p16 = p10.swap();
        let p17 = p15 * p16;
        let p18 = p2 + p17;
        let p19 = p13 * p18;
        let p20 = p12 + p19;
        let v21 = Single::<T>::new(at.v.theta1) * Single::<T>::new(at.v.theta1);
        let p22 = T::Pair::splat(v21);
        let p23 = p22 * p10;
        let p24 = p20 - p23;
        let p25 = p16.flip();
        let p26 = T::Pair::splat(Single::<T>::new(self.parameters.l1));
        let p27 = p26 * p9;
        let p28 = T::Pair::splat(Single::<T>::new(self.parameters.l2));
        let v29 = Single::<T>::new(h) * Single::<T>::new(at.v.theta1);
        let v30 = Single::<T>::new(at.q.theta1) + v29;
        let v31 = Single::<T>::new(h) * Single::<T>::new(at.v.theta2);
        let v32 = Single::<T>::new(at.q.theta2) + v31;
        let p33 = T::Pair::join(v30, v32);
        let (sines34, cosines34) = p33.sin_cos();
        let p36 = T::Pair::join(cosines7.second(), cosines34.second());
        let p37 = p28 * p36;
        let p38 = T::Pair::join(p27.first(), p37.first());
        let v39 = Single::<T>::new(self.parameters.l2) * sines7.second();
        let phi_guide = v39 + p27.second();
        let v41 = Single::<T>::new(at.q.x3) - p37.first();
        let phi_slider = v41 - p27.first();
        let p43 = T::Pair::join(phi_guide, phi_slider);
        let p44 = p4 * p43;
        let v45 = Single::<T>::new(at.v.theta2) * p37.first();
        let p46 = p27.swap();
        let p47 = p14 * p46;
        let p48 = T::Pair::join(v45, p47.first());
        let v49 = Single::<T>::new(at.v.theta2) * v39;
        let v50 = Single::<T>::new(at.v.x3) + v49;
        let p51 = T::Pair::join(p47.second(), v50);
        let p52 = p48 + p51;
        let p53 = p13 * p52;
        let p54 = p44 + p53;
        let v55 = Single::<T>::new(at.v.theta2) * Single::<T>::new(at.v.theta2);
        let p56 = T::Pair::splat(v55);
        let p57 = p56.flip();
        let p58 = T::Pair::join(v39, p37.first());
        let p59 = p57 * p58;
        let p60 = p22 * p27;
        let p61 = p60.swap();
        let p62 = p61.flip();
        let p63 = p59 + p62;
        let p64 = p54 + p63;
        let p65 = T::Pair::splat(Single::<T>::new(T::from_f64(1.0)));
        let p66 = p37 * p37;
        let v67 = p27.first() * p27.first();
        let p68 = T::Pair::join(cosines34.first(), sines34.first());
        let p69 = p26 * p68;
        let v70 = p69.first() * p69.first();
        let p71 = T::Pair::join(v67, v70);
        let p72 = p66 + p71;
        let p73 = p65 / p72;
        let v74 = p64.first() * p73.first();
        let p75 = T::Pair::splat(v74);
        let p76 = p38 * p75;
        let p77 = T::Pair::join(p37.first(), p27.first());
        let p78 = p77.flip();
        let v79 = Single::<T>::new(self.parameters.m3) * p64.second();
        let v80 = v39 * v79;
        let p81 = T::Pair::splat(Single::<T>::new(self.hoisted[1]));
        let p82 = T::Pair::join(cosines7.second(), sines7.second());
        let p83 = p81 * p82;
        let p84 = T::Pair::join(Single::<T>::new(at.q.x2), Single::<T>::new(at.q.y2));
        let p85 = p84 - p83;
        let p86 = p85 - p27;
        let p87 = p4 * p86;
        let p88 = T::Pair::join(Single::<T>::new(at.v.x2), Single::<T>::new(at.v.y2));
        let p89 = T::Pair::splat(Single::<T>::new(at.v.theta2));
        let p90 = p89.flip();
        let p91 = p83.swap();
        let p92 = p90 * p91;
        let p93 = p88 + p92;
        let p94 = p47.flip();
        let p95 = p93 + p94;
        let p96 = p13 * p95;
        let p97 = p87 + p96;
        let p98 = p56 * p83;
        let p99 = p98 + p60;
        let p100 = p97 - p99;
        let v101 = Single::<T>::new(self.parameters.m2) * p100.first();
        let v102 = p83.second() * v101;
        let v103 = v80 + v102;
        let v104 = Single::<T>::new(self.parameters.m2) * p100.second();
        let v105 = Single::<T>::new(self.hoisted[5]) + v104;
        let v106 = p83.first() * v105;
        let v107 = v103 - v106;
        let v108 = p27.first() * v107;
        let v109 = p27.second() * v101;
        let v110 = Single::<T>::new(self.parameters.m1) * p24.second();
        let v111 = Single::<T>::new(self.hoisted[4]) + v110;
        let v112 = p10.first() * v111;
        let v113 = v109 - v112;
        let v114 = Single::<T>::new(self.parameters.m1) * p24.first();
        let v115 = p10.second() * v114;
        let v116 = Single::<T>::new(inputs.crank_torque) + v115;
        let v117 = p27.second() * v79;
        let v118 = v116 + v117;
        let v119 = v113 + v118;
        let v120 = p27.first() * v105;
        let v121 = v119 - v120;
        let v122 = p37.first() * v121;
        let v123 = v108 - v122;
        let p124 = T::Pair::join(p27.first(), p69.first());
        let p125 = T::Pair::splat(Single::<T>::new(self.hoisted[11]));
        let p126 = T::Pair::join(sines7.second(), sines34.second());
        let p127 = T::Pair::splat(Single::<T>::new(self.hoisted[12]));
        let p128 = p127 * p126;
        let p129 = p126 * p128;
        let p130 = p125 + p129;
        let p131 = p124 * p130;
        let p132 = T::Pair::join(sines7.first(), sines34.first());
        let p133 = T::Pair::splat(Single::<T>::new(self.hoisted[14]));
        let p134 = p133 * p126;
        let p135 = p132 * p134;
        let p136 = T::Pair::join(cosines7.first(), cosines34.first());
        let p137 = T::Pair::splat(Single::<T>::new(self.hoisted[13]));
        let p138 = p137 * p36;
        let p139 = p136 * p138;
        let p140 = p135 + p139;
        let p141 = p37 * p140;
        let p142 = p131 - p141;
        let p143 = p37 * p142;
        let p144 = p124 * p140;
        let p145 = T::Pair::splat(Single::<T>::new(self.hoisted[15]));
        let p146 = T::Pair::splat(Single::<T>::new(self.hoisted[16]));
        let p147 = p146 * p132;
        let p148 = p132 * p147;
        let p149 = p145 + p148;
        let p150 = p37 * p149;
        let p151 = p144 - p150;
        let p152 = p124 * p151;
        let p153 = p143 + p152;
        let v154 = p153.first() * v74;
        let v155 = v123 - v154;
        let p156 = p124 * p142;
        let p157 = p37 * p151;
        let p158 = p156 - p157;
        let v159 = v155 / p158.first();
        let p160 = T::Pair::splat(v159);
        let p161 = p78 * p160;
        let p162 = p76 - p161;
        let p163 = T::Pair::splat(p162.first());
        let p164 = p25 * p163;
        let p165 = p24 - p164;
        let p166 = p3 * p165;
        let p167 = p2 + p166;
        let p168 = p2 + p167;
        let p169 = p1 * p168;
        let p170 = p0 + p169;
        let p171 = T::Pair::join(
            Single::<T>::new(at.v.theta1),
            Single::<T>::new(at.v.theta2),
        );
        let p172 = p3 * p162;
        let p173 = p171 + p172;
        let p174 = p171 + p173;
        let p175 = p1 * p174;
        let p176 = p6 + p175;
        let p177 = T::Pair::join(p27.second(), p83.first());
        let p178 = p177.flip();
        let p179 = p178 * p162;
        let p180 = T::Pair::join(p83.second(), p27.first());
        let p181 = p180.flip();
        let p182 = p162.swap();
        let p183 = p181 * p182;
        let p184 = p179 + p183;
        let p185 = p100 - p184;
        let p186 = p3 * p185;
        let p187 = p88 + p186;
        let p188 = p88 + p187;
        let p189 = p1 * p188;
        let p190 = p84 + p189;
        let v191 = v39 * p162.second();
        let v192 = v191 + p179.first();
        let acc_x3 = p64.second() - v192;
        let v194 = Single::<T>::new(h) * acc_x3;
        let v195 = Single::<T>::new(at.v.x3) + v194;
        let v196 = Single::<T>::new(at.v.x3) + v195;
        let v197 = Single::<T>::new(half_h) * v196;
        let v198 = Single::<T>::new(at.q.x3) + v197;
        let p199 = p3 * p2;
        let p200 = p0 + p199;
        let p201 = p5 * p68;
        let p202 = p200 - p201;
        let p203 = p4 * p202;
        let p204 = T::Pair::splat(p173.first());
        let p205 = p204.flip();
        let p206 = p201.swap();
        let p207 = p205 * p206;
        let p208 = p167 + p207;
        let p209 = p13 * p208;
        let p210 = p203 + p209;
        let p211 = p173 * p173;
        let p212 = T::Pair::splat(p211.first());
        let p213 = p212 * p201;
        let p214 = p210 - p213;
        let p215 = p206.flip();
        let p216 = T::Pair::join(p69.first(), p37.second());
        let v217 = Single::<T>::new(self.parameters.l2) * sines34.second();
        let v218 = v217 + p69.second();
        let v219 = Single::<T>::new(h) * Single::<T>::new(at.v.x3);
        let v220 = Single::<T>::new(at.q.x3) + v219;
        let v221 = v220 - p37.second();
        let v222 = v221 - p69.first();
        let p223 = T::Pair::join(v218, v222);
        let p224 = p4 * p223;
        let v225 = p173.second() * p37.second();
        let p226 = p69.swap();
        let p227 = p204 * p226;
        let phi_dot_guide = v225 + p227.second();
        let v229 = p173.second() * v217;
        let v230 = v195 + v229;
        let phi_dot_slider = p227.first() + v230;
        let p232 = T::Pair::join(phi_dot_guide, phi_dot_slider);
        let p233 = p13 * p232;
        let p234 = p224 + p233;
        let p235 = T::Pair::splat(p211.second());
        let p236 = p235.flip();
        let p237 = T::Pair::join(v217, p37.second());
        let p238 = p236 * p237;
        let p239 = p212 * p69;
        let p240 = p239.swap();
        let p241 = p240.flip();
        let p242 = p238 + p241;
        let p243 = p234 + p242;
        let v244 = p243.first() * p73.second();
        let p245 = T::Pair::splat(v244);
        let p246 = p216 * p245;
        let p247 = T::Pair::join(p37.second(), p69.first());
        let p248 = p247.flip();
        let v249 = Single::<T>::new(self.parameters.m3) * p243.second();
        let v250 = v217 * v249;
        let p251 = T::Pair::join(cosines34.second(), sines34.second());
        let p252 = p81 * p251;
        let p253 = p3 * p88;
        let p254 = p84 + p253;
        let p255 = p254 - p252;
        let p256 = p255 - p69;
        let p257 = p4 * p256;
        let p258 = T::Pair::splat(p173.second());
        let p259 = p258.flip();
        let p260 = p252.swap();
        let p261 = p259 * p260;
        let p262 = p187 + p261;
        let p263 = p227.flip();
        let p264 = p262 + p263;
        let p265 = p13 * p264;
        let p266 = p257 + p265;
        let p267 = p235 * p252;
        let p268 = p267 + p239;
        let p269 = p266 - p268;
        let v270 = Single::<T>::new(self.parameters.m2) * p269.first();
        let v271 = p252.second() * v270;
        let v272 = v250 + v271;
        let v273 = Single::<T>::new(self.parameters.m2) * p269.second();
        let v274 = Single::<T>::new(self.hoisted[5]) + v273;
        let v275 = p252.first() * v274;
        let v276 = v272 - v275;
        let v277 = p69.first() * v276;
        let v278 = p69.second() * v270;
        let v279 = Single::<T>::new(self.parameters.m1) * p214.second();
        let v280 = Single::<T>::new(self.hoisted[4]) + v279;
        let v281 = p201.first() * v280;
        let v282 = v278 - v281;
        let v283 = Single::<T>::new(self.parameters.m1) * p214.first();
        let v284 = p201.second() * v283;
        let v285 = Single::<T>::new(inputs.crank_torque) + v284;
        let v286 = p69.second() * v249;
        let v287 = v285 + v286;
        let v288 = v282 + v287;
        let v289 = p69.first() * v274;
        let v290 = v288 - v289;
        let v291 = p37.second() * v290;
        let v292 = v277 - v291;
        let v293 = p153.second() * v244;
        let v294 = v292 - v293;
        let v295 = v294 / p158.second();
        let p296 = T::Pair::splat(v295);
        let p297 = p248 * p296;
        let p298 = p246 - p297;
        let p299 = T::Pair::splat(p298.first());
        let p300 = p215 * p299;
        let p301 = p214 - p300;
        let p302 = p165 + p301;
        let p303 = p1 * p302;
        let p304 = p2 + p303;
        let p305 = p162 + p298;
        let p306 = p1 * p305;
        let p307 = p171 + p306;
        let p308 = T::Pair::join(p69.second(), p252.first());
        let p309 = p308.flip();
        let p310 = p309 * p298;
        let p311 = T::Pair::join(p252.second(), p69.first());
        let p312 = p311.flip();
        let p313 = p298.swap();
        let p314 = p312 * p313;
        let p315 = p310 + p314;
        let p316 = p269 - p315;
        let p317 = p185 + p316;
        let p318 = p1 * p317;
        let p319 = p88 + p318;
        let v320 = v217 * p298.second();
        let v321 = v320 + p310.first();
        let v322 = p243.second() - v321;
        let v323 = acc_x3 + v322;
        let v324 = Single::<T>::new(half_h) * v323;
        let v325 = Single::<T>::new(at.v.x3) + v324;
        let p326 = T::Pair::splat(Single::<T>::new(self.hoisted[17]));
        let p327 = p326 * p73;
        let v328 = Single::<T>::new(p327.first().get().abs());
        let v329 = Single::<T>::new(v328.get().sqrt());
        let v330 = Single::<T>::new(p327.second().get().abs());
        let v331 = Single::<T>::new(v330.get().sqrt());
        let v332 = v329 + v331;
        let p333 = p170 + p176;
        let p334 = p333 + p190;
        let p335 = p334 + p304;
        let p336 = p335 + p307;
        let p337 = p336 + p319;
        let v338 = v198 + v325;
        let v339 = v338 + p337.first();
        let v340 = v339 + p337.second();
        ::mbs_runtime::Stepped {
            next: ::mbs_runtime::State {
                t: t_next,
                q: SliderCrankFreeCoordinates {
                    x1: p170.first().get(),
                    y1: p170.second().get(),
                    theta1: p176.first().get(),
                    x2: p190.first().get(),
                    y2: p190.second().get(),
                    theta2: p176.second().get(),
                    x3: v198.get(),
                },
                v: SliderCrankFreeCoordinates {
                    x1: p304.first().get(),
                    y1: p304.second().get(),
                    theta1: p307.first().get(),
                    x2: p319.first().get(),
                    y2: p319.second().get(),
                    theta2: p307.second().get(),
                    x3: v325.get(),
                },
            },
            growth: v332.get(),
            sum: v340.get(),
        }
    }
    ///A step with feedback held over it, and the reactions at its start.
    #[inline(always)]
    fn step_held_with_reactions(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
        inputs: &SliderCrankFreeInputs<T>,
        gains: &::mbs_runtime::Gains<T>,
        h: T,
        t_next: T,
    ) -> (
        ::mbs_runtime::Stepped<SliderCrankFreeCoordinates<T>>,
        ::mbs_runtime::Reactions<
            SliderCrankFreeCoordinates<T>,
            SliderCrankFreeConstraints<T>,
        >,
    ) {
        use ::mbs_runtime::{Pair as _, Single as _};
        type Single<T> = <<T as ::mbs_runtime::Real>::Pair as ::mbs_runtime::Pair<
            T,
        >>::Single;
        let half_h = T::from_f64(0.5) * h;
        let p0 = T::Pair::join(Single::<T>::new(at.q.x1), Single::<T>::new(at.q.y1));
        let p1 = T::Pair::splat(Single::<T>::new(half_h));
        let p2 = T::Pair::join(Single::<T>::new(at.v.x1), Single::<T>::new(at.v.y1));
        let p3 = T::Pair::splat(Single::<T>::new(h));
        let p4 = T::Pair::splat(Single::<T>::new(gains.minus_beta_squared));
        let p5 = T::Pair::splat(Single::<T>::new(self.hoisted[0]));
        let p6 = T::Pair::join(
            Single::<T>::new(at.q.theta1),
            Single::<T>::new(at.q.theta2),
        );
        let (sines7, cosines7) = p6.sin_cos();
        let p9 = T::Pair::join(cosines7.first(), sines7.first());
        let p10 = p5 * p9;
        let p11 = p0 - p10;
        let p12 = p4 * p11;
        let p13 = T::Pair::splat(Single::<T>::new(gains.minus_two_alpha));
        let p14 = T::Pair::splat(Single::<T>::new(at.v.theta1));
        let p15 = p14.flip();
        let p16 = p10.swap();
        let p17 = p15 * p16;
        let p18 = p2 + p17;
        let p19 = p13 * p18;
        let p20 = p12 + p19;
        let v21 = Single::<T>::new(at.v.theta1) * Single::<T>::new(at.v.theta1);
        let p22 = T::Pair::splat(v21);
        let p23 = p22 * p10;
        let p24 = p20 - p23;
        let p25 = p16.flip();
        let p26 = T::Pair::splat(Single::<T>::new(self.parameters.l1));
        let p27 = p26 * p9;
        let p28 = T::Pair::splat(Single::<T>::new(self.parameters.l2));
        let v29 = Single::<T>::new(h) * Single::<T>::new(at.v.theta1);
        let v30 = Single::<T>::new(at.q.theta1) + v29;
        let v31 = Single::<T>::new(h) * Single::<T>::new(at.v.theta2);
        let v32 = Single::<T>::new(at.q.theta2) + v31;
        let p33 = T::Pair::join(v30, v32);
        let (sines34, cosines34) = p33.sin_cos();
        let p36 = T::Pair::join(cosines7.second(), cosines34.second());
        let p37 = p28 * p36;
        let p38 = T::Pair::join(p27.first(), p37.first());
        let v39 = Single::<T>::new(at.v.theta2) * Single::<T>::new(at.v.theta2);
        let p40 = T::Pair::splat(v39);
        let v41 = Single::<T>::new(self.parameters.l2) * sines7.second();
        let p42 = T::Pair::join(p37.first(), v41);
        let p43 = p40 * p42;
        let p44 = p22 * p27;
        let v45 = p43.second() + p44.second();
        let phi_guide = v41 + p27.second();
        let v47 = Single::<T>::new(at.q.x3) - p37.first();
        let phi_slider = v47 - p27.first();
        let p49 = T::Pair::join(phi_guide, phi_slider);
        let p50 = p4 * p49;
        let v51 = Single::<T>::new(at.v.theta2) * p37.first();
        let p52 = p27.swap();
        let p53 = p14 * p52;
        let p54 = T::Pair::join(v51, p53.first());
        let v55 = Single::<T>::new(at.v.theta2) * v41;
        let v56 = Single::<T>::new(at.v.x3) + v55;
        let p57 = T::Pair::join(p53.second(), v56);
        let p58 = p54 + p57;
        let p59 = p13 * p58;
        let p60 = p50 + p59;
        let v61 = v45 + p60.first();
        let p62 = p44 + p43;
        let p63 = T::Pair::join(v61, p62.second());
        let p64 = T::Pair::splat(Single::<T>::new(T::from_f64(1.0)));
        let p65 = p37 * p37;
        let v66 = p27.first() * p27.first();
        let p67 = T::Pair::join(cosines34.first(), sines34.first());
        let p68 = p26 * p67;
        let v69 = p68.first() * p68.first();
        let p70 = T::Pair::join(v66, v69);
        let p71 = p65 + p70;
        let p72 = p64 / p71;
        let p73 = T::Pair::splat(p72.first());
        let p74 = p63 * p73;
        let p75 = T::Pair::splat(p74.first());
        let p76 = p38 * p75;
        let p77 = T::Pair::join(p37.first(), p27.first());
        let p78 = p77.flip();
        let p79 = T::Pair::splat(p27.first());
        let p80 = T::Pair::splat(v41);
        let p81 = T::Pair::splat(Single::<T>::new(self.parameters.m3));
        let v82 = p60.second() - p62.first();
        let v83 = -p43.first();
        let v84 = v83 - p44.first();
        let p85 = T::Pair::join(v82, v84);
        let p86 = p81 * p85;
        let p87 = p80 * p86;
        let p88 = T::Pair::splat(Single::<T>::new(self.hoisted[1]));
        let p89 = T::Pair::join(cosines7.second(), sines7.second());
        let p90 = p88 * p89;
        let p91 = T::Pair::splat(p90.second());
        let p92 = T::Pair::splat(Single::<T>::new(self.parameters.m2));
        let p93 = T::Pair::join(Single::<T>::new(at.q.x2), Single::<T>::new(at.q.y2));
        let p94 = p93 - p90;
        let p95 = p94 - p27;
        let p96 = p4 * p95;
        let p97 = T::Pair::join(Single::<T>::new(at.v.x2), Single::<T>::new(at.v.y2));
        let p98 = T::Pair::splat(Single::<T>::new(at.v.theta2));
        let p99 = p98 * p90;
        let p100 = p99.swap();
        let p101 = p100.flip();
        let p102 = p97 + p101;
        let p103 = p53.flip();
        let p104 = p102 + p103;
        let p105 = p13 * p104;
        let p106 = p96 + p105;
        let p107 = p40 * p90;
        let p108 = p107 + p44;
        let p109 = p106 - p108;
        let v110 = -p107.first();
        let v111 = v110 - p44.first();
        let p112 = T::Pair::join(p109.first(), v111);
        let p113 = p92 * p112;
        let p114 = p91 * p113;
        let p115 = p87 + p114;
        let p116 = T::Pair::splat(p90.first());
        let p117 = p92.flip();
        let v118 = p44.second() + p107.second();
        let p119 = T::Pair::join(p109.second(), v118);
        let p120 = p117 * p119;
        let p121 = T::Pair::splat(Single::<T>::new(self.hoisted[5]));
        let p122 = p120 + p121;
        let p123 = p116 * p122;
        let p124 = p115 - p123;
        let p125 = p79 * p124;
        let p126 = T::Pair::splat(p37.first());
        let p127 = T::Pair::splat(p27.second());
        let p128 = p127 * p113;
        let p129 = T::Pair::splat(p10.first());
        let p130 = T::Pair::splat(Single::<T>::new(self.parameters.m1));
        let p131 = p130.flip();
        let p132 = T::Pair::join(p24.second(), p23.second());
        let p133 = p131 * p132;
        let p134 = T::Pair::splat(Single::<T>::new(self.hoisted[4]));
        let p135 = p133 + p134;
        let p136 = p129 * p135;
        let p137 = p128 - p136;
        let p138 = T::Pair::splat(Single::<T>::new(inputs.crank_torque));
        let p139 = T::Pair::splat(p10.second());
        let v140 = -p23.first();
        let p141 = T::Pair::join(p24.first(), v140);
        let p142 = p130 * p141;
        let p143 = p139 * p142;
        let p144 = p138 + p143;
        let p145 = p127 * p86;
        let p146 = p144 + p145;
        let p147 = p137 + p146;
        let p148 = p79 * p122;
        let p149 = p147 - p148;
        let p150 = p126 * p149;
        let p151 = p125 - p150;
        let p152 = T::Pair::join(p27.first(), p68.first());
        let p153 = T::Pair::splat(Single::<T>::new(self.hoisted[11]));
        let p154 = T::Pair::join(sines7.second(), sines34.second());
        let p155 = T::Pair::splat(Single::<T>::new(self.hoisted[12]));
        let p156 = p155 * p154;
        let p157 = p154 * p156;
        let p158 = p153 + p157;
        let p159 = p152 * p158;
        let p160 = T::Pair::join(sines7.first(), sines34.first());
        let p161 = T::Pair::splat(Single::<T>::new(self.hoisted[14]));
        let p162 = p161 * p154;
        let p163 = p160 * p162;
        let p164 = T::Pair::join(cosines7.first(), cosines34.first());
        let p165 = T::Pair::splat(Single::<T>::new(self.hoisted[13]));
        let p166 = p165 * p36;
        let p167 = p164 * p166;
        let p168 = p163 + p167;
        let p169 = p37 * p168;
        let p170 = p159 - p169;
        let p171 = p37 * p170;
        let p172 = p152 * p168;
        let p173 = T::Pair::splat(Single::<T>::new(self.hoisted[15]));
        let p174 = T::Pair::splat(Single::<T>::new(self.hoisted[16]));
        let p175 = p174 * p160;
        let p176 = p160 * p175;
        let p177 = p173 + p176;
        let p178 = p37 * p177;
        let p179 = p172 - p178;
        let p180 = p152 * p179;
        let p181 = p171 + p180;
        let p182 = T::Pair::splat(p181.first());
        let p183 = p182 * p74;
        let p184 = p151 - p183;
        let p185 = p152 * p170;
        let p186 = p37 * p179;
        let p187 = p185 - p186;
        let p188 = T::Pair::splat(p187.first());
        let p189 = p184 / p188;
        let p190 = T::Pair::splat(p189.first());
        let p191 = p78 * p190;
        let p192 = p76 - p191;
        let p193 = T::Pair::splat(p192.first());
        let p194 = p25 * p193;
        let p195 = p24 - p194;
        let p196 = p3 * p195;
        let p197 = p2 + p196;
        let p198 = p2 + p197;
        let p199 = p1 * p198;
        let p200 = p0 + p199;
        let p201 = T::Pair::join(
            Single::<T>::new(at.v.theta1),
            Single::<T>::new(at.v.theta2),
        );
        let p202 = p3 * p192;
        let p203 = p201 + p202;
        let p204 = p201 + p203;
        let p205 = p1 * p204;
        let p206 = p6 + p205;
        let p207 = T::Pair::join(p27.second(), p90.first());
        let p208 = p207.flip();
        let p209 = p208 * p192;
        let p210 = T::Pair::join(p90.second(), p27.first());
        let p211 = p210.flip();
        let p212 = p192.swap();
        let p213 = p211 * p212;
        let p214 = p209 + p213;
        let p215 = p109 - p214;
        let p216 = p3 * p215;
        let p217 = p97 + p216;
        let p218 = p97 + p217;
        let p219 = p1 * p218;
        let p220 = p93 + p219;
        let v221 = v41 * p192.second();
        let v222 = v221 + p209.first();
        let acc_x3 = v82 - v222;
        let v224 = Single::<T>::new(h) * acc_x3;
        let v225 = Single::<T>::new(at.v.x3) + v224;
        let v226 = Single::<T>::new(at.v.x3) + v225;
        let v227 = Single::<T>::new(half_h) * v226;
        let v228 = Single::<T>::new(at.q.x3) + v227;
        let p229 = p203 * p203;
        let p230 = T::Pair::splat(p229.first());
        let p231 = p5 * p67;
        let p232 = p230 * p231;
        let p233 = p20 - p232;
        let p234 = p231.swap();
        let p235 = p234.flip();
        let p236 = T::Pair::join(p68.first(), p37.second());
        let p237 = p230 * p68;
        let v238 = Single::<T>::new(self.parameters.l2) * sines34.second();
        let v239 = p229.second() * v238;
        let v240 = p60.first() + v239;
        let v241 = p237.second() + v240;
        let v242 = v241 * p72.second();
        let p243 = T::Pair::splat(v242);
        let p244 = p236 * p243;
        let p245 = T::Pair::join(p37.second(), p68.first());
        let p246 = p245.flip();
        let v247 = p229.second() * p37.second();
        let v248 = p60.second() - v247;
        let v249 = v248 - p237.first();
        let v250 = Single::<T>::new(self.parameters.m3) * v249;
        let v251 = v238 * v250;
        let p252 = T::Pair::join(cosines34.second(), sines34.second());
        let p253 = p88 * p252;
        let p254 = T::Pair::splat(p229.second());
        let p255 = p254 * p253;
        let p256 = p106 - p255;
        let p257 = p256 - p237;
        let v258 = Single::<T>::new(self.parameters.m2) * p257.first();
        let v259 = p253.second() * v258;
        let v260 = v251 + v259;
        let v261 = Single::<T>::new(self.parameters.m2) * p257.second();
        let v262 = Single::<T>::new(self.hoisted[5]) + v261;
        let v263 = p253.first() * v262;
        let v264 = v260 - v263;
        let v265 = p68.first() * v264;
        let v266 = p68.second() * v258;
        let v267 = Single::<T>::new(self.parameters.m1) * p233.second();
        let v268 = Single::<T>::new(self.hoisted[4]) + v267;
        let v269 = p231.first() * v268;
        let v270 = v266 - v269;
        let v271 = Single::<T>::new(self.parameters.m1) * p233.first();
        let v272 = p231.second() * v271;
        let v273 = Single::<T>::new(inputs.crank_torque) + v272;
        let v274 = p68.second() * v250;
        let v275 = v273 + v274;
        let v276 = v270 + v275;
        let v277 = p68.first() * v262;
        let v278 = v276 - v277;
        let v279 = p37.second() * v278;
        let v280 = v265 - v279;
        let v281 = p181.second() * v242;
        let v282 = v280 - v281;
        let v283 = v282 / p187.second();
        let p284 = T::Pair::splat(v283);
        let p285 = p246 * p284;
        let p286 = p244 - p285;
        let p287 = T::Pair::splat(p286.first());
        let p288 = p235 * p287;
        let p289 = p233 - p288;
        let p290 = p195 + p289;
        let p291 = p1 * p290;
        let p292 = p2 + p291;
        let p293 = p192 + p286;
        let p294 = p1 * p293;
        let p295 = p201 + p294;
        let p296 = T::Pair::join(p68.second(), p253.first());
        let p297 = p296.flip();
        let p298 = p297 * p286;
        let p299 = T::Pair::join(p253.second(), p68.first());
        let p300 = p299.flip();
        let p301 = p286.swap();
        let p302 = p300 * p301;
        let p303 = p298 + p302;
        let p304 = p257 - p303;
        let p305 = p215 + p304;
        let p306 = p1 * p305;
        let p307 = p97 + p306;
        let v308 = v238 * p286.second();
        let v309 = v308 + p298.first();
        let v310 = v249 - v309;
        let v311 = acc_x3 + v310;
        let v312 = Single::<T>::new(half_h) * v311;
        let v313 = Single::<T>::new(at.v.x3) + v312;
        let p314 = T::Pair::splat(p74.second());
        let p315 = p38 * p314;
        let p316 = T::Pair::splat(p189.second());
        let p317 = p78 * p316;
        let p318 = p315 - p317;
        let p319 = T::Pair::splat(p318.first());
        let p320 = p16 * p319;
        let acc_x1 = v140 - p320.first();
        let acc_y1 = p320.second() - p23.second();
        let p323 = p207 * p318;
        let p324 = p318.swap();
        let p325 = p210 * p324;
        let p326 = p323 + p325;
        let acc_x2 = v111 - p326.first();
        let acc_y2 = p326.second() - v118;
        let v329 = v41 * p318.second();
        let v330 = v329 + p323.first();
        let v331 = v84 - v330;
        let p332 = T::Pair::splat(Single::<T>::new(self.hoisted[17]));
        let p333 = p332 * p72;
        let v334 = Single::<T>::new(p333.first().get().abs());
        let v335 = Single::<T>::new(v334.get().sqrt());
        let v336 = Single::<T>::new(p333.second().get().abs());
        let v337 = Single::<T>::new(v336.get().sqrt());
        let v338 = v335 + v337;
        let p339 = p130 * p320;
        let lambda_crank_x = p339.first() - p142.second();
        let p341 = p135.flip();
        let lambda_crank_y = p341.second() - p339.second();
        let p343 = p92 * p326;
        let lambda_rod_x = p343.first() - p113.second();
        let p345 = p122.flip();
        let lambda_rod_y = p345.second() - p343.second();
        let p347 = T::Pair::join(p177.first(), p158.first());
        let p348 = p347 * p318;
        let p349 = T::Pair::splat(p168.first());
        let p350 = p349 * p324;
        let p351 = p348 + p350;
        let v352 = p124.second() - p351.second();
        let v353 = p37.first() * v352;
        let v354 = p149.second() - p351.first();
        let v355 = p27.first() * v354;
        let v356 = v353 + v355;
        let lambda_guide = p72.first() * v356;
        let v358 = Single::<T>::new(self.parameters.m3) * v330;
        let lambda_slider = v358 - p86.second();
        let p360 = p200 + p206;
        let p361 = p360 + p220;
        let p362 = p361 + p292;
        let p363 = p362 + p295;
        let p364 = p363 + p307;
        let p365 = p364 + p318;
        let v366 = v228 + v313;
        let v367 = v366 + acc_x1;
        let v368 = v367 + acc_y1;
        let v369 = v368 + acc_x2;
        let v370 = v369 + acc_y2;
        let v371 = v370 + v331;
        let v372 = v371 + p365.first();
        let v373 = v372 + p365.second();
        (
            ::mbs_runtime::Stepped {
                next: ::mbs_runtime::State {
                    t: t_next,
                    q: SliderCrankFreeCoordinates {
                        x1: p200.first().get(),
                        y1: p200.second().get(),
                        theta1: p206.first().get(),
                        x2: p220.first().get(),
                        y2: p220.second().get(),
                        theta2: p206.second().get(),
                        x3: v228.get(),
                    },
                    v: SliderCrankFreeCoordinates {
                        x1: p292.first().get(),
                        y1: p292.second().get(),
                        theta1: p295.first().get(),
                        x2: p307.first().get(),
                        y2: p307.second().get(),
                        theta2: p295.second().get(),
                        x3: v313.get(),
                    },
                },
                growth: v338.get(),
                sum: v373.get(),
            },
            ::mbs_runtime::Reactions {
                acceleration: SliderCrankFreeCoordinates {
                    x1: acc_x1.get(),
                    y1: acc_y1.get(),
                    theta1: p318.first().get(),
                    x2: acc_x2.get(),
                    y2: acc_y2.get(),
                    theta2: p318.second().get(),
                    x3: v331.get(),
                },
                multipliers: SliderCrankFreeConstraints {
                    crank_x: lambda_crank_x.get(),
                    crank_y: lambda_crank_y.get(),
                    rod_x: lambda_rod_x.get(),
                    rod_y: lambda_rod_y.get(),
                    guide: lambda_guide.get(),
                    slider: lambda_slider.get(),
                },
                growth: v335.get(),
            },
        )
    }
    ///A step with feedback in both stages, and the reactions at its start.
    #[inline(always)]
    fn step_per_stage_with_reactions(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
        inputs: &SliderCrankFreeInputs<T>,
        gains: &::mbs_runtime::Gains<T>,
        h: T,
        t_next: T,
    ) -> (
        ::mbs_runtime::Stepped<SliderCrankFreeCoordinates<T>>,
        ::mbs_runtime::Reactions<
            SliderCrankFreeCoordinates<T>,
            SliderCrankFreeConstraints<T>,
        >,
    ) {
        use ::mbs_runtime::{Pair as _, Single as _};
        type Single<T> = <<T as ::mbs_runtime::Real>::Pair as ::mbs_runtime::Pair<
            T,
        >>::Single;
        let half_h = T::from_f64(0.5) * h;
        let p0 = T::Pair::join(Single::<T>::new(at.q.x1), Single::<T>::new(at.q.y1));
        let p1 = T::Pair::splat(Single::<T>::new(half_h));
        let p2 = T::Pair::join(Single::<T>::new(at.v.x1), Single::<T>::new(at.v.y1));
        let p3 = T::Pair::splat(Single::<T>::new(h));
        let p4 = T::Pair::splat(Single::<T>::new(gains.minus_beta_squared));
        let p5 = T::Pair::splat(Single::<T>::new(self.hoisted[0]));
        let p6 = T::Pair::join(
            Single::<T>::new(at.q.theta1),
            Single::<T>::new(at.q.theta2),
        );
        let (sines7, cosines7) = p6.sin_cos();
        let p9 = T::Pair::join(cosines7.first(), sines7.first());
        let p10 = p5 * p9;
        let p11 = p0 - p10;
        let p12 = p4 * p11;
        let p13 = T::Pair::splat(Single::<T>::new(gains.minus_two_alpha));
        let p14 = T::Pair::splat(Single::<T>::new(at.v.theta1));
        let p15 = p14.flip();
        let p16 = p10.swap();
        let p17 = p15 * p16;
        let p18 = p2 + p17;
        let p19 = p13 * p18;
        let p20 = p12 + p19;
        let v21 = Single::<T>::new(at.v.theta1) * Single::<T>::new(at.v.theta1);
        let p22 = T::Pair::splat(v21);
        let p23 = p22 * p10;
        let p24 = p20 - p23;
        let p25 = p16.flip();
        let p26 = T::Pair::splat(Single::<T>::new(self.parameters.l1));
        let p27 = p26 * p9;
        let p28 = T::Pair::splat(Single::<T>::new(self.parameters.l2));
        let v29 = Single::<T>::new(h) * Single::<T>::new(at.v.theta1);
        let v30 = Single::<T>::new(at.q.theta1) + v29;
        let v31 = Single::<T>::new(h) * Single::<T>::new(at.v.theta2);
        let v32 = Single::<T>::new(at.q.theta2) + v31;
        let p33 = T::Pair::join(v30, v32);
        let (sines34, cosines34) = p33.sin_cos();
        let p36 = T::Pair::join(cosines7.second(), cosines34.second());
        let p37 = p28 * p36;
        let p38 = T::Pair::join(p27.first(), p37.first());
        let v39 = Single::<T>::new(self.parameters.l2) * sines7.second();
        let phi_guide = v39 + p27.second();
        let v41 = Single::<T>::new(at.q.x3) - p37.first();
        let phi_slider = v41 - p27.first();
        let p43 = T::Pair::join(phi_guide, phi_slider);
        let p44 = p4 * p43;
        let v45 = Single::<T>::new(at.v.theta2) * p37.first();
        let p46 = p27.swap();
        let p47 = p14 * p46;
        let p48 = T::Pair::join(v45, p47.first());
        let v49 = Single::<T>::new(at.v.theta2) * v39;
        let v50 = Single::<T>::new(at.v.x3) + v49;
        let p51 = T::Pair::join(p47.second(), v50);
        let p52 = p48 + p51;
        let p53 = p13 * p52;
        let p54 = p44 + p53;
        let v55 = Single::<T>::new(at.v.theta2) * Single::<T>::new(at.v.theta2);
        let p56 = T::Pair::splat(v55);
        let p57 = p56.flip();
        let p58 = T::Pair::join(v39, p37.first());
        let p59 = p57 * p58;
        let p60 = p22 * p27;
        let p61 = p60.swap();
        let p62 = p61.flip();
        let p63 = p59 + p62;
        let p64 = p54 + p63;
        let v65 = p60.second() + p59.first();
        let p66 = T::Pair::join(p64.first(), v65);
        let p67 = T::Pair::splat(Single::<T>::new(T::from_f64(1.0)));
        let p68 = p37 * p37;
        let v69 = p27.first() * p27.first();
        let p70 = T::Pair::join(cosines34.first(), sines34.first());
        let p71 = p26 * p70;
        let v72 = p71.first() * p71.first();
        let p73 = T::Pair::join(v69, v72);
        let p74 = p68 + p73;
        let p75 = p67 / p74;
        let p76 = T::Pair::splat(p75.first());
        let p77 = p66 * p76;
        let p78 = T::Pair::splat(p77.first());
        let p79 = p38 * p78;
        let p80 = T::Pair::join(p37.first(), p27.first());
        let p81 = p80.flip();
        let p82 = T::Pair::splat(p27.first());
        let p83 = T::Pair::splat(v39);
        let p84 = T::Pair::splat(Single::<T>::new(self.parameters.m3));
        let p85 = p59.flip();
        let v86 = -p85.second();
        let v87 = v86 - p60.first();
        let p88 = T::Pair::join(p64.second(), v87);
        let p89 = p84 * p88;
        let p90 = p83 * p89;
        let p91 = T::Pair::splat(Single::<T>::new(self.hoisted[1]));
        let p92 = T::Pair::join(cosines7.second(), sines7.second());
        let p93 = p91 * p92;
        let p94 = T::Pair::splat(p93.second());
        let p95 = T::Pair::splat(Single::<T>::new(self.parameters.m2));
        let p96 = T::Pair::join(Single::<T>::new(at.q.x2), Single::<T>::new(at.q.y2));
        let p97 = p96 - p93;
        let p98 = p97 - p27;
        let p99 = p4 * p98;
        let p100 = T::Pair::join(Single::<T>::new(at.v.x2), Single::<T>::new(at.v.y2));
        let p101 = T::Pair::splat(Single::<T>::new(at.v.theta2));
        let p102 = p101.flip();
        let p103 = p93.swap();
        let p104 = p102 * p103;
        let p105 = p100 + p104;
        let p106 = p47.flip();
        let p107 = p105 + p106;
        let p108 = p13 * p107;
        let p109 = p99 + p108;
        let p110 = p56 * p93;
        let p111 = p110 + p60;
        let p112 = p109 - p111;
        let v113 = -p110.first();
        let v114 = v113 - p60.first();
        let p115 = T::Pair::join(p112.first(), v114);
        let p116 = p95 * p115;
        let p117 = p94 * p116;
        let p118 = p90 + p117;
        let p119 = T::Pair::splat(p93.first());
        let p120 = p95.flip();
        let v121 = p60.second() + p110.second();
        let p122 = T::Pair::join(p112.second(), v121);
        let p123 = p120 * p122;
        let p124 = T::Pair::splat(Single::<T>::new(self.hoisted[5]));
        let p125 = p123 + p124;
        let p126 = p119 * p125;
        let p127 = p118 - p126;
        let p128 = p82 * p127;
        let p129 = T::Pair::splat(p37.first());
        let p130 = T::Pair::splat(p27.second());
        let p131 = p130 * p116;
        let p132 = T::Pair::splat(p10.first());
        let p133 = T::Pair::splat(Single::<T>::new(self.parameters.m1));
        let p134 = p133.flip();
        let p135 = T::Pair::join(p24.second(), p23.second());
        let p136 = p134 * p135;
        let p137 = T::Pair::splat(Single::<T>::new(self.hoisted[4]));
        let p138 = p136 + p137;
        let p139 = p132 * p138;
        let p140 = p131 - p139;
        let p141 = T::Pair::splat(Single::<T>::new(inputs.crank_torque));
        let p142 = T::Pair::splat(p10.second());
        let v143 = -p23.first();
        let p144 = T::Pair::join(p24.first(), v143);
        let p145 = p133 * p144;
        let p146 = p142 * p145;
        let p147 = p141 + p146;
        let p148 = p130 * p89;
        let p149 = p147 + p148;
        let p150 = p140 + p149;
        let p151 = p82 * p125;
        let p152 = p150 - p151;
        let p153 = p129 * p152;
        let p154 = p128 - p153;
        let p155 = T::Pair::join(p27.first(), p71.first());
        let p156 = T::Pair::splat(Single::<T>::new(self.hoisted[11]));
        let p157 = T::Pair::join(sines7.second(), sines34.second());
        let p158 = T::Pair::splat(Single::<T>::new(self.hoisted[12]));
        let p159 = p158 * p157;
        let p160 = p157 * p159;
        let p161 = p156 + p160;
        let p162 = p155 * p161;
        let p163 = T::Pair::join(sines7.first(), sines34.first());
        let p164 = T::Pair::splat(Single::<T>::new(self.hoisted[14]));
        let p165 = p164 * p157;
        let p166 = p163 * p165;
        let p167 = T::Pair::join(cosines7.first(), cosines34.first());
        let p168 = T::Pair::splat(Single::<T>::new(self.hoisted[13]));
        let p169 = p168 * p36;
        let p170 = p167 * p169;
        let p171 = p166 + p170;
        let p172 = p37 * p171;
        let p173 = p162 - p172;
        let p174 = p37 * p173;
        let p175 = p155 * p171;
        let p176 = T::Pair::splat(Single::<T>::new(self.hoisted[15]));
        let p177 = T::Pair::splat(Single::<T>::new(self.hoisted[16]));
        let p178 = p177 * p163;
        let p179 = p163 * p178;
        let p180 = p176 + p179;
        let p181 = p37 * p180;
        let p182 = p175 - p181;
        let p183 = p155 * p182;
        let p184 = p174 + p183;
        let p185 = T::Pair::splat(p184.first());
        let p186 = p185 * p77;
        let p187 = p154 - p186;
        let p188 = p155 * p173;
        let p189 = p37 * p182;
        let p190 = p188 - p189;
        let p191 = T::Pair::splat(p190.first());
        let p192 = p187 / p191;
        let p193 = T::Pair::splat(p192.first());
        let p194 = p81 * p193;
        let p195 = p79 - p194;
        let p196 = T::Pair::splat(p195.first());
        let p197 = p25 * p196;
        let p198 = p24 - p197;
        let p199 = p3 * p198;
        let p200 = p2 + p199;
        let p201 = p2 + p200;
        let p202 = p1 * p201;
        let p203 = p0 + p202;
        let p204 = T::Pair::join(
            Single::<T>::new(at.v.theta1),
            Single::<T>::new(at.v.theta2),
        );
        let p205 = p3 * p195;
        let p206 = p204 + p205;
        let p207 = p204 + p206;
        let p208 = p1 * p207;
        let p209 = p6 + p208;
        let p210 = T::Pair::join(p27.second(), p93.first());
        let p211 = p210.flip();
        let p212 = p211 * p195;
        let p213 = T::Pair::join(p93.second(), p27.first());
        let p214 = p213.flip();
        let p215 = p195.swap();
        let p216 = p214 * p215;
        let p217 = p212 + p216;
        let p218 = p112 - p217;
        let p219 = p3 * p218;
        let p220 = p100 + p219;
        let p221 = p100 + p220;
        let p222 = p1 * p221;
        let p223 = p96 + p222;
        let v224 = v39 * p195.second();
        let v225 = v224 + p212.first();
        let acc_x3 = p64.second() - v225;
        let v227 = Single::<T>::new(h) * acc_x3;
        let v228 = Single::<T>::new(at.v.x3) + v227;
        let v229 = Single::<T>::new(at.v.x3) + v228;
        let v230 = Single::<T>::new(half_h) * v229;
        let v231 = Single::<T>::new(at.q.x3) + v230;
        let p232 = p3 * p2;
        let p233 = p0 + p232;
        let p234 = p5 * p70;
        let p235 = p233 - p234;
        let p236 = p4 * p235;
        let p237 = T::Pair::splat(p206.first());
        let p238 = p237.flip();
        let p239 = p234.swap();
        let p240 = p238 * p239;
        let p241 = p200 + p240;
        let p242 = p13 * p241;
        let p243 = p236 + p242;
        let p244 = p206 * p206;
        let p245 = T::Pair::splat(p244.first());
        let p246 = p245 * p234;
        let p247 = p243 - p246;
        let p248 = p239.flip();
        let p249 = T::Pair::join(p71.first(), p37.second());
        let v250 = Single::<T>::new(self.parameters.l2) * sines34.second();
        let v251 = v250 + p71.second();
        let v252 = Single::<T>::new(h) * Single::<T>::new(at.v.x3);
        let v253 = Single::<T>::new(at.q.x3) + v252;
        let v254 = v253 - p37.second();
        let v255 = v254 - p71.first();
        let p256 = T::Pair::join(v251, v255);
        let p257 = p4 * p256;
        let v258 = p206.second() * p37.second();
        let p259 = p71.swap();
        let p260 = p237 * p259;
        let phi_dot_guide = v258 + p260.second();
        let v262 = p206.second() * v250;
        let v263 = v228 + v262;
        let phi_dot_slider = p260.first() + v263;
        let p265 = T::Pair::join(phi_dot_guide, phi_dot_slider);
        let p266 = p13 * p265;
        let p267 = p257 + p266;
        let p268 = T::Pair::splat(p244.second());
        let p269 = p268.flip();
        let p270 = T::Pair::join(v250, p37.second());
        let p271 = p269 * p270;
        let p272 = p245 * p71;
        let p273 = p272.swap();
        let p274 = p273.flip();
        let p275 = p271 + p274;
        let p276 = p267 + p275;
        let v277 = p276.first() * p75.second();
        let p278 = T::Pair::splat(v277);
        let p279 = p249 * p278;
        let p280 = T::Pair::join(p37.second(), p71.first());
        let p281 = p280.flip();
        let v282 = Single::<T>::new(self.parameters.m3) * p276.second();
        let v283 = v250 * v282;
        let p284 = T::Pair::join(cosines34.second(), sines34.second());
        let p285 = p91 * p284;
        let p286 = p3 * p100;
        let p287 = p96 + p286;
        let p288 = p287 - p285;
        let p289 = p288 - p71;
        let p290 = p4 * p289;
        let p291 = T::Pair::splat(p206.second());
        let p292 = p291.flip();
        let p293 = p285.swap();
        let p294 = p292 * p293;
        let p295 = p220 + p294;
        let p296 = p260.flip();
        let p297 = p295 + p296;
        let p298 = p13 * p297;
        let p299 = p290 + p298;
        let p300 = p268 * p285;
        let p301 = p300 + p272;
        let p302 = p299 - p301;
        let v303 = Single::<T>::new(self.parameters.m2) * p302.first();
        let v304 = p285.second() * v303;
        let v305 = v283 + v304;
        let v306 = Single::<T>::new(self.parameters.m2) * p302.second();
        let v307 = Single::<T>::new(self.hoisted[5]) + v306;
        let v308 = p285.first() * v307;
        let v309 = v305 - v308;
        let v310 = p71.first() * v309;
        let v311 = p71.second() * v303;
        let v312 = Single::<T>::new(self.parameters.m1) * p247.second();
        let v313 = Single::<T>::new(self.hoisted[4]) + v312;
        let v314 = p234.first() * v313;
        let v315 = v311 - v314;
        let v316 = Single::<T>::new(self.parameters.m1) * p247.first();
        let v317 = p234.second() * v316;
        let v318 = Single::<T>::new(inputs.crank_torque) + v317;
        let v319 = p71.second() * v282;
        let v320 = v318 + v319;
        let v321 = v315 + v320;
        let v322 = p71.first() * v307;
        let v323 = v321 - v322;
        let v324 = p37.second() * v323;
        let v325 = v310 - v324;
        let v326 = p184.second() * v277;
        let v327 = v325 - v326;
        let v328 = v327 / p190.second();
        let p329 = T::Pair::splat(v328);
        let p330 = p281 * p329;
        let p331 = p279 - p330;
        let p332 = T::Pair::splat(p331.first());
        let p333 = p248 * p332;
        let p334 = p247 - p333;
        let p335 = p198 + p334;
        let p336 = p1 * p335;
        let p337 = p2 + p336;
        let p338 = p195 + p331;
        let p339 = p1 * p338;
        let p340 = p204 + p339;
        let p341 = T::Pair::join(p71.second(), p285.first());
        let p342 = p341.flip();
        let p343 = p342 * p331;
        let p344 = T::Pair::join(p285.second(), p71.first());
        let p345 = p344.flip();
        let p346 = p331.swap();
        let p347 = p345 * p346;
        let p348 = p343 + p347;
        let p349 = p302 - p348;
        let p350 = p218 + p349;
        let p351 = p1 * p350;
        let p352 = p100 + p351;
        let v353 = v250 * p331.second();
        let v354 = v353 + p343.first();
        let v355 = p276.second() - v354;
        let v356 = acc_x3 + v355;
        let v357 = Single::<T>::new(half_h) * v356;
        let v358 = Single::<T>::new(at.v.x3) + v357;
        let p359 = T::Pair::splat(p77.second());
        let p360 = p38 * p359;
        let p361 = T::Pair::splat(p192.second());
        let p362 = p81 * p361;
        let p363 = p360 - p362;
        let p364 = T::Pair::splat(p363.first());
        let p365 = p16 * p364;
        let acc_x1 = v143 - p365.first();
        let acc_y1 = p365.second() - p23.second();
        let p368 = p210 * p363;
        let p369 = p363.swap();
        let p370 = p213 * p369;
        let p371 = p368 + p370;
        let acc_x2 = v114 - p371.first();
        let acc_y2 = p371.second() - v121;
        let v374 = v39 * p363.second();
        let v375 = v374 + p368.first();
        let v376 = v87 - v375;
        let p377 = T::Pair::splat(Single::<T>::new(self.hoisted[17]));
        let p378 = p377 * p75;
        let v379 = Single::<T>::new(p378.first().get().abs());
        let v380 = Single::<T>::new(v379.get().sqrt());
        let v381 = Single::<T>::new(p378.second().get().abs());
        let v382 = Single::<T>::new(v381.get().sqrt());
        let v383 = v380 + v382;
        let p384 = p133 * p365;
        let lambda_crank_x = p384.first() - p145.second();
        let p386 = p138.flip();
        let lambda_crank_y = p386.second() - p384.second();
        let p388 = p95 * p371;
        let lambda_rod_x = p388.first() - p116.second();
        let p390 = p125.flip();
        let lambda_rod_y = p390.second() - p388.second();
        let p392 = T::Pair::join(p180.first(), p161.first());
        let p393 = p392 * p363;
        let p394 = T::Pair::splat(p171.first());
        let p395 = p394 * p369;
        let p396 = p393 + p395;
        let v397 = p127.second() - p396.second();
        let v398 = p37.first() * v397;
        let v399 = p152.second() - p396.first();
        let v400 = p27.first() * v399;
        let v401 = v398 + v400;
        let lambda_guide = p75.first() * v401;
        let v403 = Single::<T>::new(self.parameters.m3) * v375;
        let lambda_slider = v403 - p89.second();
        let p405 = p203 + p209;
        let p406 = p405 + p223;
        let p407 = p406 + p337;
        let p408 = p407 + p340;
        let p409 = p408 + p352;
        let p410 = p409 + p363;
        let v411 = v231 + v358;
        let v412 = v411 + acc_x1;
        let v413 = v412 + acc_y1;
        let v414 = v413 + acc_x2;
        let v415 = v414 + acc_y2;
        let v416 = v415 + v376;
        let v417 = v416 + p410.first();
        let v418 = v417 + p410.second();
        (
            ::mbs_runtime::Stepped {
                next: ::mbs_runtime::State {
                    t: t_next,
                    q: SliderCrankFreeCoordinates {
                        x1: p203.first().get(),
                        y1: p203.second().get(),
                        theta1: p209.first().get(),
                        x2: p223.first().get(),
                        y2: p223.second().get(),
                        theta2: p209.second().get(),
                        x3: v231.get(),
                    },
                    v: SliderCrankFreeCoordinates {
                        x1: p337.first().get(),
                        y1: p337.second().get(),
                        theta1: p340.first().get(),
                        x2: p352.first().get(),
                        y2: p352.second().get(),
                        theta2: p340.second().get(),
                        x3: v358.get(),
                    },
                },
                growth: v383.get(),
                sum: v418.get(),
            },
            ::mbs_runtime::Reactions {
                acceleration: SliderCrankFreeCoordinates {
                    x1: acc_x1.get(),
                    y1: acc_y1.get(),
                    theta1: p363.first().get(),
                    x2: acc_x2.get(),
                    y2: acc_y2.get(),
                    theta2: p363.second().get(),
                    x3: v376.get(),
                },
                multipliers: SliderCrankFreeConstraints {
                    crank_x: lambda_crank_x.get(),
                    crank_y: lambda_crank_y.get(),
                    rod_x: lambda_rod_x.get(),
                    rod_y: lambda_rod_y.get(),
                    guide: lambda_guide.get(),
                    slider: lambda_slider.get(),
                },
                growth: v380.get(),
            },
        )
    }
}
#[allow(unused_variables, clippy::all)]
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Mechanism for SliderCrankFree<T> {
    type Real = T;
    type Over<Scalar: ::mbs_runtime::Real> = SliderCrankFree<Scalar>;
    type Parameters = SliderCrankFreeParameters<T>;
    type Inputs = SliderCrankFreeInputs<T>;
    type Coordinates = SliderCrankFreeCoordinates<T>;
    type Constraints = SliderCrankFreeConstraints<T>;
    type Outputs = SliderCrankFreeOutputs<T>;
    type Points = [[T; 2]; 9];
    const INFO: &'static ::mbs_runtime::Info = &::mbs_runtime::Info::from_parts(
        "SliderCrankFree",
        "Slider-crank with a torque on the crank.",
        1,
        &[
            ::mbs_runtime::Quantity {
                name: "l1",
                doc: "Length of the crank.",
                unit: "mm",
                scale: 0.001f64,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 1i8,
                    time: 0i8,
                },
                default: 0.06f64,
            },
            ::mbs_runtime::Quantity {
                name: "l2",
                doc: "Length of the rod.",
                unit: "mm",
                scale: 0.001f64,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 1i8,
                    time: 0i8,
                },
                default: 0.18f64,
            },
            ::mbs_runtime::Quantity {
                name: "m1",
                doc: "Mass of the crank, at its middle.",
                unit: "kg",
                scale: 1f64,
                dimension: ::mbs_runtime::Dimension {
                    mass: 1i8,
                    length: 0i8,
                    time: 0i8,
                },
                default: 0.5f64,
            },
            ::mbs_runtime::Quantity {
                name: "m2",
                doc: "Mass of the rod, at its middle.",
                unit: "kg",
                scale: 1f64,
                dimension: ::mbs_runtime::Dimension {
                    mass: 1i8,
                    length: 0i8,
                    time: 0i8,
                },
                default: 1.2f64,
            },
            ::mbs_runtime::Quantity {
                name: "m3",
                doc: "Mass of the slider.",
                unit: "kg",
                scale: 1f64,
                dimension: ::mbs_runtime::Dimension {
                    mass: 1i8,
                    length: 0i8,
                    time: 0i8,
                },
                default: 2f64,
            },
            ::mbs_runtime::Quantity {
                name: "inertia_factor",
                doc: "Moment of inertia of crank and rod about their middles over m l².",
                unit: "",
                scale: 1f64,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 0i8,
                    time: 0i8,
                },
                default: 0.08333333333333333f64,
            },
            ::mbs_runtime::Quantity {
                name: "omega",
                doc: "Speed of the crank at the start.",
                unit: "rpm",
                scale: 0.10471975511965977f64,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 0i8,
                    time: -1i8,
                },
                default: 20.94395102393195f64,
            },
        ],
        &[
            ::mbs_runtime::Quantity {
                name: "crank_torque",
                doc: "Torque on the crank.",
                unit: "N*m",
                scale: 1f64,
                dimension: ::mbs_runtime::Dimension {
                    mass: 1i8,
                    length: 2i8,
                    time: -2i8,
                },
                default: 0f64,
            },
        ],
        &[
            ::mbs_runtime::Quantity {
                name: "x1",
                doc: "",
                unit: "m",
                scale: 1f64,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 1i8,
                    time: 0i8,
                },
                default: 0.03f64,
            },
            ::mbs_runtime::Quantity {
                name: "y1",
                doc: "",
                unit: "m",
                scale: 1f64,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 1i8,
                    time: 0i8,
                },
                default: 0f64,
            },
            ::mbs_runtime::Quantity {
                name: "theta1",
                doc: "",
                unit: "rad",
                scale: 1f64,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 0i8,
                    time: 0i8,
                },
                default: 0f64,
            },
            ::mbs_runtime::Quantity {
                name: "x2",
                doc: "",
                unit: "m",
                scale: 1f64,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 1i8,
                    time: 0i8,
                },
                default: 0.15f64,
            },
            ::mbs_runtime::Quantity {
                name: "y2",
                doc: "",
                unit: "m",
                scale: 1f64,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 1i8,
                    time: 0i8,
                },
                default: 0f64,
            },
            ::mbs_runtime::Quantity {
                name: "theta2",
                doc: "",
                unit: "rad",
                scale: 1f64,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 0i8,
                    time: 0i8,
                },
                default: 0f64,
            },
            ::mbs_runtime::Quantity {
                name: "x3",
                doc: "",
                unit: "m",
                scale: 1f64,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 1i8,
                    time: 0i8,
                },
                default: 0.24f64,
            },
        ],
        &[
            ::mbs_runtime::Quantity {
                name: "crank_speed",
                doc: "Speed of the crank.",
                unit: "rpm",
                scale: 0.10471975511965977f64,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 0i8,
                    time: -1i8,
                },
                default: 0f64,
            },
            ::mbs_runtime::Quantity {
                name: "motor_power",
                doc: "Power of the motor.",
                unit: "W",
                scale: 1f64,
                dimension: ::mbs_runtime::Dimension {
                    mass: 1i8,
                    length: 2i8,
                    time: -3i8,
                },
                default: 0f64,
            },
        ],
        &[
            ::mbs_runtime::Constraint {
                name: "crank_x",
                doc: "The crank turns about the origin.",
                formula: "x1 - 1/2*l1*cos(theta1)",
                is_drive: false,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 1i8,
                    time: 0i8,
                },
            },
            ::mbs_runtime::Constraint {
                name: "crank_y",
                doc: "The crank turns about the origin.",
                formula: "y1 - 1/2*l1*sin(theta1)",
                is_drive: false,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 1i8,
                    time: 0i8,
                },
            },
            ::mbs_runtime::Constraint {
                name: "rod_x",
                doc: "The rod begins at the crank's tip.",
                formula: "x2 - l1*cos(theta1) - 1/2*l2*cos(theta2)",
                is_drive: false,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 1i8,
                    time: 0i8,
                },
            },
            ::mbs_runtime::Constraint {
                name: "rod_y",
                doc: "The rod begins at the crank's tip.",
                formula: "y2 - l1*sin(theta1) - 1/2*l2*sin(theta2)",
                is_drive: false,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 1i8,
                    time: 0i8,
                },
            },
            ::mbs_runtime::Constraint {
                name: "guide",
                doc: "The rod ends on the x axis.",
                formula: "l1*sin(theta1) + l2*sin(theta2)",
                is_drive: false,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 1i8,
                    time: 0i8,
                },
            },
            ::mbs_runtime::Constraint {
                name: "slider",
                doc: "The slider sits at the rod's end.",
                formula: "x3 - l1*cos(theta1) - l2*cos(theta2)",
                is_drive: false,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 1i8,
                    time: 0i8,
                },
            },
        ],
        &[],
        &[
            ::mbs_runtime::Pivot {
                constraint: "guide",
                coordinate: "theta2",
            },
        ],
        &[
            ::mbs_runtime::Pivot {
                constraint: "guide",
                coordinate: "theta2",
            },
        ],
        &[
            ::mbs_runtime::Function {
                name: "new",
                operations: ::mbs_runtime::Operations {
                    mul: 26u32,
                    add: 5u32,
                    div: 1u32,
                    sin_cos: 0u32,
                    other: 2u32,
                    watch: 0u32,
                },
                written: 34u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "phi",
                operations: ::mbs_runtime::Operations {
                    mul: 8u32,
                    add: 9u32,
                    div: 0u32,
                    sin_cos: 2u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 21u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "phi_dot",
                operations: ::mbs_runtime::Operations {
                    mul: 12u32,
                    add: 9u32,
                    div: 0u32,
                    sin_cos: 2u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 25u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "phi_q",
                operations: ::mbs_runtime::Operations {
                    mul: 8u32,
                    add: 3u32,
                    div: 0u32,
                    sin_cos: 2u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 15u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "phi_t",
                operations: ::mbs_runtime::Operations {
                    mul: 0u32,
                    add: 0u32,
                    div: 0u32,
                    sin_cos: 0u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 0u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "gamma",
                operations: ::mbs_runtime::Operations {
                    mul: 14u32,
                    add: 9u32,
                    div: 0u32,
                    sin_cos: 2u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 27u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "baumgarte_rhs",
                operations: ::mbs_runtime::Operations {
                    mul: 40u32,
                    add: 34u32,
                    div: 0u32,
                    sin_cos: 2u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 78u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "mass",
                operations: ::mbs_runtime::Operations {
                    mul: 0u32,
                    add: 0u32,
                    div: 0u32,
                    sin_cos: 0u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 0u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "forces",
                operations: ::mbs_runtime::Operations {
                    mul: 0u32,
                    add: 2u32,
                    div: 0u32,
                    sin_cos: 0u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 2u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "kinetic_energy",
                operations: ::mbs_runtime::Operations {
                    mul: 14u32,
                    add: 6u32,
                    div: 0u32,
                    sin_cos: 0u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 20u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "potential_energy",
                operations: ::mbs_runtime::Operations {
                    mul: 2u32,
                    add: 1u32,
                    div: 0u32,
                    sin_cos: 0u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 3u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "stabilized",
                operations: ::mbs_runtime::Operations {
                    mul: 84u32,
                    add: 63u32,
                    div: 2u32,
                    sin_cos: 2u32,
                    other: 0u32,
                    watch: 3u32,
                },
                written: 156u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "constrained",
                operations: ::mbs_runtime::Operations {
                    mul: 64u32,
                    add: 39u32,
                    div: 2u32,
                    sin_cos: 2u32,
                    other: 0u32,
                    watch: 3u32,
                },
                written: 112u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "reactions",
                operations: ::mbs_runtime::Operations {
                    mul: 76u32,
                    add: 49u32,
                    div: 2u32,
                    sin_cos: 2u32,
                    other: 0u32,
                    watch: 3u32,
                },
                written: 134u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "position_correction",
                operations: ::mbs_runtime::Operations {
                    mul: 6u32,
                    add: 3u32,
                    div: 1u32,
                    sin_cos: 1u32,
                    other: 0u32,
                    watch: 2u32,
                },
                written: 14u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "velocity_correction",
                operations: ::mbs_runtime::Operations {
                    mul: 6u32,
                    add: 3u32,
                    div: 1u32,
                    sin_cos: 1u32,
                    other: 0u32,
                    watch: 2u32,
                },
                written: 14u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "outputs",
                operations: ::mbs_runtime::Operations {
                    mul: 1u32,
                    add: 0u32,
                    div: 0u32,
                    sin_cos: 0u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 1u32,
                loops: 0u32,
            },
        ],
    );
    const DERIVATION: &'static ::mbs_runtime::Derivation = &::mbs_runtime::Derivation {
        phi: &[
            ::mbs_runtime::Formula {
                of: "crank_x",
                of_latex: "\\mathrm{crank\\_x}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "x1 - 1/2*l1*cos(theta1)",
                latex: "x_{1} - \\frac{1}{2} l_{1} \\, \\cos \\theta_{1}",
            },
            ::mbs_runtime::Formula {
                of: "crank_y",
                of_latex: "\\mathrm{crank\\_y}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "y1 - 1/2*l1*sin(theta1)",
                latex: "y_{1} - \\frac{1}{2} l_{1} \\, \\sin \\theta_{1}",
            },
            ::mbs_runtime::Formula {
                of: "rod_x",
                of_latex: "\\mathrm{rod\\_x}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "x2 - l1*cos(theta1) - 1/2*l2*cos(theta2)",
                latex: "x_{2} - l_{1} \\, \\cos \\theta_{1} - \\frac{1}{2} l_{2} \\, \\cos \\theta_{2}",
            },
            ::mbs_runtime::Formula {
                of: "rod_y",
                of_latex: "\\mathrm{rod\\_y}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "y2 - l1*sin(theta1) - 1/2*l2*sin(theta2)",
                latex: "y_{2} - l_{1} \\, \\sin \\theta_{1} - \\frac{1}{2} l_{2} \\, \\sin \\theta_{2}",
            },
            ::mbs_runtime::Formula {
                of: "guide",
                of_latex: "\\mathrm{guide}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "l1*sin(theta1) + l2*sin(theta2)",
                latex: "l_{1} \\, \\sin \\theta_{1} + l_{2} \\, \\sin \\theta_{2}",
            },
            ::mbs_runtime::Formula {
                of: "slider",
                of_latex: "\\mathrm{slider}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "x3 - l1*cos(theta1) - l2*cos(theta2)",
                latex: "x_{3} - l_{1} \\, \\cos \\theta_{1} - l_{2} \\, \\cos \\theta_{2}",
            },
        ],
        phi_q: &[
            ::mbs_runtime::Formula {
                of: "crank_x",
                of_latex: "\\mathrm{crank\\_x}",
                by: "x1",
                by_latex: "x_{1}",
                text: "1",
                latex: "1",
            },
            ::mbs_runtime::Formula {
                of: "crank_x",
                of_latex: "\\mathrm{crank\\_x}",
                by: "theta1",
                by_latex: "\\theta_{1}",
                text: "1/2*l1*sin(theta1)",
                latex: "\\frac{1}{2} l_{1} \\, \\sin \\theta_{1}",
            },
            ::mbs_runtime::Formula {
                of: "crank_y",
                of_latex: "\\mathrm{crank\\_y}",
                by: "y1",
                by_latex: "y_{1}",
                text: "1",
                latex: "1",
            },
            ::mbs_runtime::Formula {
                of: "crank_y",
                of_latex: "\\mathrm{crank\\_y}",
                by: "theta1",
                by_latex: "\\theta_{1}",
                text: "-1/2*l1*cos(theta1)",
                latex: "-\\frac{1}{2} l_{1} \\, \\cos \\theta_{1}",
            },
            ::mbs_runtime::Formula {
                of: "rod_x",
                of_latex: "\\mathrm{rod\\_x}",
                by: "theta1",
                by_latex: "\\theta_{1}",
                text: "l1*sin(theta1)",
                latex: "l_{1} \\, \\sin \\theta_{1}",
            },
            ::mbs_runtime::Formula {
                of: "rod_x",
                of_latex: "\\mathrm{rod\\_x}",
                by: "x2",
                by_latex: "x_{2}",
                text: "1",
                latex: "1",
            },
            ::mbs_runtime::Formula {
                of: "rod_x",
                of_latex: "\\mathrm{rod\\_x}",
                by: "theta2",
                by_latex: "\\theta_{2}",
                text: "1/2*l2*sin(theta2)",
                latex: "\\frac{1}{2} l_{2} \\, \\sin \\theta_{2}",
            },
            ::mbs_runtime::Formula {
                of: "rod_y",
                of_latex: "\\mathrm{rod\\_y}",
                by: "theta1",
                by_latex: "\\theta_{1}",
                text: "-l1*cos(theta1)",
                latex: "-l_{1} \\, \\cos \\theta_{1}",
            },
            ::mbs_runtime::Formula {
                of: "rod_y",
                of_latex: "\\mathrm{rod\\_y}",
                by: "y2",
                by_latex: "y_{2}",
                text: "1",
                latex: "1",
            },
            ::mbs_runtime::Formula {
                of: "rod_y",
                of_latex: "\\mathrm{rod\\_y}",
                by: "theta2",
                by_latex: "\\theta_{2}",
                text: "-1/2*l2*cos(theta2)",
                latex: "-\\frac{1}{2} l_{2} \\, \\cos \\theta_{2}",
            },
            ::mbs_runtime::Formula {
                of: "guide",
                of_latex: "\\mathrm{guide}",
                by: "theta1",
                by_latex: "\\theta_{1}",
                text: "l1*cos(theta1)",
                latex: "l_{1} \\, \\cos \\theta_{1}",
            },
            ::mbs_runtime::Formula {
                of: "guide",
                of_latex: "\\mathrm{guide}",
                by: "theta2",
                by_latex: "\\theta_{2}",
                text: "l2*cos(theta2)",
                latex: "l_{2} \\, \\cos \\theta_{2}",
            },
            ::mbs_runtime::Formula {
                of: "slider",
                of_latex: "\\mathrm{slider}",
                by: "theta1",
                by_latex: "\\theta_{1}",
                text: "l1*sin(theta1)",
                latex: "l_{1} \\, \\sin \\theta_{1}",
            },
            ::mbs_runtime::Formula {
                of: "slider",
                of_latex: "\\mathrm{slider}",
                by: "theta2",
                by_latex: "\\theta_{2}",
                text: "l2*sin(theta2)",
                latex: "l_{2} \\, \\sin \\theta_{2}",
            },
            ::mbs_runtime::Formula {
                of: "slider",
                of_latex: "\\mathrm{slider}",
                by: "x3",
                by_latex: "x_{3}",
                text: "1",
                latex: "1",
            },
        ],
        phi_t: &[],
        phi_dot: &[
            ::mbs_runtime::Formula {
                of: "crank_x",
                of_latex: "\\mathrm{crank\\_x}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "der(x1) + 1/2*l1*sin(theta1)*der(theta1)",
                latex: "\\dot{x_{1}} + \\frac{1}{2} l_{1} \\, \\sin \\theta_{1} \\, \\dot{\\theta_{1}}",
            },
            ::mbs_runtime::Formula {
                of: "crank_y",
                of_latex: "\\mathrm{crank\\_y}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "der(y1) - 1/2*l1*cos(theta1)*der(theta1)",
                latex: "\\dot{y_{1}} - \\frac{1}{2} l_{1} \\, \\cos \\theta_{1} \\, \\dot{\\theta_{1}}",
            },
            ::mbs_runtime::Formula {
                of: "rod_x",
                of_latex: "\\mathrm{rod\\_x}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "der(x2) + l1*sin(theta1)*der(theta1) + 1/2*l2*sin(theta2)*der(theta2)",
                latex: "\\dot{x_{2}} + l_{1} \\, \\sin \\theta_{1} \\, \\dot{\\theta_{1}} + \\frac{1}{2} l_{2} \\, \\sin \\theta_{2} \\, \\dot{\\theta_{2}}",
            },
            ::mbs_runtime::Formula {
                of: "rod_y",
                of_latex: "\\mathrm{rod\\_y}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "der(y2) - l1*cos(theta1)*der(theta1) - 1/2*l2*cos(theta2)*der(theta2)",
                latex: "\\dot{y_{2}} - l_{1} \\, \\cos \\theta_{1} \\, \\dot{\\theta_{1}} - \\frac{1}{2} l_{2} \\, \\cos \\theta_{2} \\, \\dot{\\theta_{2}}",
            },
            ::mbs_runtime::Formula {
                of: "guide",
                of_latex: "\\mathrm{guide}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "l1*cos(theta1)*der(theta1) + l2*cos(theta2)*der(theta2)",
                latex: "l_{1} \\, \\cos \\theta_{1} \\, \\dot{\\theta_{1}} + l_{2} \\, \\cos \\theta_{2} \\, \\dot{\\theta_{2}}",
            },
            ::mbs_runtime::Formula {
                of: "slider",
                of_latex: "\\mathrm{slider}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "der(x3) + l1*sin(theta1)*der(theta1) + l2*sin(theta2)*der(theta2)",
                latex: "\\dot{x_{3}} + l_{1} \\, \\sin \\theta_{1} \\, \\dot{\\theta_{1}} + l_{2} \\, \\sin \\theta_{2} \\, \\dot{\\theta_{2}}",
            },
        ],
        gamma: &[
            ::mbs_runtime::Formula {
                of: "crank_x",
                of_latex: "\\mathrm{crank\\_x}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "-1/2*l1*cos(theta1)*der(theta1)^2",
                latex: "-\\frac{1}{2} l_{1} \\, \\cos \\theta_{1} \\, \\dot{\\theta_{1}}^{2}",
            },
            ::mbs_runtime::Formula {
                of: "crank_y",
                of_latex: "\\mathrm{crank\\_y}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "-1/2*l1*sin(theta1)*der(theta1)^2",
                latex: "-\\frac{1}{2} l_{1} \\, \\sin \\theta_{1} \\, \\dot{\\theta_{1}}^{2}",
            },
            ::mbs_runtime::Formula {
                of: "rod_x",
                of_latex: "\\mathrm{rod\\_x}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "-l1*cos(theta1)*der(theta1)^2 - 1/2*l2*cos(theta2)*der(theta2)^2",
                latex: "-l_{1} \\, \\cos \\theta_{1} \\, \\dot{\\theta_{1}}^{2} - \\frac{1}{2} l_{2} \\, \\cos \\theta_{2} \\, \\dot{\\theta_{2}}^{2}",
            },
            ::mbs_runtime::Formula {
                of: "rod_y",
                of_latex: "\\mathrm{rod\\_y}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "-l1*sin(theta1)*der(theta1)^2 - 1/2*l2*sin(theta2)*der(theta2)^2",
                latex: "-l_{1} \\, \\sin \\theta_{1} \\, \\dot{\\theta_{1}}^{2} - \\frac{1}{2} l_{2} \\, \\sin \\theta_{2} \\, \\dot{\\theta_{2}}^{2}",
            },
            ::mbs_runtime::Formula {
                of: "guide",
                of_latex: "\\mathrm{guide}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "l1*sin(theta1)*der(theta1)^2 + l2*sin(theta2)*der(theta2)^2",
                latex: "l_{1} \\, \\sin \\theta_{1} \\, \\dot{\\theta_{1}}^{2} + l_{2} \\, \\sin \\theta_{2} \\, \\dot{\\theta_{2}}^{2}",
            },
            ::mbs_runtime::Formula {
                of: "slider",
                of_latex: "\\mathrm{slider}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "-l1*cos(theta1)*der(theta1)^2 - l2*cos(theta2)*der(theta2)^2",
                latex: "-l_{1} \\, \\cos \\theta_{1} \\, \\dot{\\theta_{1}}^{2} - l_{2} \\, \\cos \\theta_{2} \\, \\dot{\\theta_{2}}^{2}",
            },
        ],
        mass: &[
            ::mbs_runtime::Formula {
                of: "x1",
                of_latex: "x_{1}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "m1",
                latex: "m_{1}",
            },
            ::mbs_runtime::Formula {
                of: "y1",
                of_latex: "y_{1}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "m1",
                latex: "m_{1}",
            },
            ::mbs_runtime::Formula {
                of: "theta1",
                of_latex: "\\theta_{1}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "l1^2*m1*inertia_factor",
                latex: "l_{1}^{2} \\, m_{1} \\, \\mathrm{inertia\\_factor}",
            },
            ::mbs_runtime::Formula {
                of: "x2",
                of_latex: "x_{2}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "m2",
                latex: "m_{2}",
            },
            ::mbs_runtime::Formula {
                of: "y2",
                of_latex: "y_{2}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "m2",
                latex: "m_{2}",
            },
            ::mbs_runtime::Formula {
                of: "theta2",
                of_latex: "\\theta_{2}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "l2^2*inertia_factor*m2",
                latex: "l_{2}^{2} \\, \\mathrm{inertia\\_factor} \\, m_{2}",
            },
            ::mbs_runtime::Formula {
                of: "x3",
                of_latex: "x_{3}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "m3",
                latex: "m_{3}",
            },
        ],
        forces: &[
            ::mbs_runtime::Formula {
                of: "y1",
                of_latex: "y_{1}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "-9.81*m1",
                latex: "-9.81 m_{1}",
            },
            ::mbs_runtime::Formula {
                of: "theta1",
                of_latex: "\\theta_{1}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "crank_torque",
                latex: "\\mathrm{crank\\_torque}",
            },
            ::mbs_runtime::Formula {
                of: "y2",
                of_latex: "y_{2}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "-9.81*m2",
                latex: "-9.81 m_{2}",
            },
        ],
        kinetic_energy: ::mbs_runtime::Formula {
            of: "T",
            of_latex: "T",
            by: "",
            by_latex: "\\mathrm{}",
            text: "1/2*m1*der(x1)^2 + 1/2*m1*der(y1)^2 + 1/2*l1^2*m1*inertia_factor*der(theta1)^2 + 1/2*m2*der(x2)^2 + 1/2*m2*der(y2)^2 + 1/2*l2^2*inertia_factor*m2*der(theta2)^2 + 1/2*m3*der(x3)^2",
            latex: "\\frac{1}{2} m_{1} \\, \\dot{x_{1}}^{2} + \\frac{1}{2} m_{1} \\, \\dot{y_{1}}^{2} + \\frac{1}{2} l_{1}^{2} \\, m_{1} \\, \\mathrm{inertia\\_factor} \\, \\dot{\\theta_{1}}^{2} + \\frac{1}{2} m_{2} \\, \\dot{x_{2}}^{2} + \\frac{1}{2} m_{2} \\, \\dot{y_{2}}^{2} + \\frac{1}{2} l_{2}^{2} \\, \\mathrm{inertia\\_factor} \\, m_{2} \\, \\dot{\\theta_{2}}^{2} + \\frac{1}{2} m_{3} \\, \\dot{x_{3}}^{2}",
        },
        potential_energy: ::mbs_runtime::Formula {
            of: "V",
            of_latex: "V",
            by: "",
            by_latex: "\\mathrm{}",
            text: "9.81*y1*m1 + 9.81*y2*m2",
            latex: "9.81 y_{1} \\, m_{1} + 9.81 y_{2} \\, m_{2}",
        },
        strategy: "constraints first, then what motion they leave free (null space)",
        order: &[
            ::mbs_runtime::Elimination {
                unknowns: &["lambda(crank_x)", "x1"],
                pivot: "1",
                latex: "1",
                is_watched: false,
            },
            ::mbs_runtime::Elimination {
                unknowns: &["lambda(crank_y)", "y1"],
                pivot: "1",
                latex: "1",
                is_watched: false,
            },
            ::mbs_runtime::Elimination {
                unknowns: &["lambda(rod_x)", "x2"],
                pivot: "1",
                latex: "1",
                is_watched: false,
            },
            ::mbs_runtime::Elimination {
                unknowns: &["lambda(rod_y)", "y2"],
                pivot: "1",
                latex: "1",
                is_watched: false,
            },
            ::mbs_runtime::Elimination {
                unknowns: &["lambda(slider)", "x3"],
                pivot: "1",
                latex: "1",
                is_watched: false,
            },
            ::mbs_runtime::Elimination {
                unknowns: &["lambda(guide)", "theta1", "theta2"],
                pivot: "l1*cos(theta1)",
                latex: "l_{1} \\, \\cos \\theta_{1}",
                is_watched: true,
            },
        ],
    };
    const SKETCH: &'static ::mbs_runtime::Sketch = &::mbs_runtime::Sketch {
        points: &[
            "crank",
            "crank.base",
            "crank.tip",
            "rod",
            "rod.base",
            "rod.tip",
            "slider",
            "ground",
            "slider.ahead",
        ],
        bodies: &[
            ::mbs_runtime::sketch::Body {
                name: "crank",
                points: &[0, 1, 2],
            },
            ::mbs_runtime::sketch::Body {
                name: "rod",
                points: &[3, 4, 5],
            },
            ::mbs_runtime::sketch::Body {
                name: "slider",
                points: &[6],
            },
        ],
        ground: &[7],
        joints: &[
            ::mbs_runtime::sketch::Joint {
                name: "slider",
                kind: "prismatic",
                first: 6,
                second: 7,
                ahead: ::core::option::Option::Some(8),
            },
        ],
        springs: &[],
    };
    fn new(
        parameters: SliderCrankFreeParameters<T>,
    ) -> ::core::result::Result<Self, ::mbs_runtime::Error> {
        Self::new(parameters)
    }
    fn parameters(&self) -> &SliderCrankFreeParameters<T> {
        &self.parameters
    }
    #[inline(always)]
    fn hoisted(&self) -> &[T] {
        &self.hoisted
    }
    #[inline(always)]
    fn from_hoisted(
        parameters: SliderCrankFreeParameters<T>,
        hoisted: impl ::core::ops::FnMut(::core::primitive::usize) -> T,
    ) -> Self {
        Self {
            parameters,
            hoisted: ::core::array::from_fn(hoisted),
        }
    }
    fn declared_start(&self) -> ::mbs_runtime::State<SliderCrankFreeCoordinates<T>> {
        let v0 = T::from_f64(0.5) * self.parameters.l1;
        let v1 = T::from_f64(0.5) * self.parameters.l2;
        let v2 = self.parameters.l1 + v1;
        let v3 = self.parameters.l2 + self.parameters.l1;
        ::mbs_runtime::State {
            t: T::from_f64(0.0),
            q: SliderCrankFreeCoordinates {
                x1: v0,
                y1: T::from_f64(0.0),
                theta1: T::from_f64(0.0),
                x2: v2,
                y2: T::from_f64(0.0),
                theta2: T::from_f64(0.0),
                x3: v3,
            },
            v: SliderCrankFreeCoordinates {
                x1: T::from_f64(0.0),
                y1: T::from_f64(0.0),
                theta1: self.parameters.omega,
                x2: T::from_f64(0.0),
                y2: T::from_f64(0.0),
                theta2: T::from_f64(0.0),
                x3: T::from_f64(0.0),
            },
        }
    }
    #[inline(always)]
    fn phi(
        &self,
        t: T,
        q: &SliderCrankFreeCoordinates<T>,
    ) -> SliderCrankFreeConstraints<T> {
        Self::phi(self, t, q)
    }
    #[inline(always)]
    fn phi_dot(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
    ) -> SliderCrankFreeConstraints<T> {
        Self::phi_dot(self, at)
    }
    #[inline(always)]
    fn stabilized(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
        inputs: &SliderCrankFreeInputs<T>,
        gains: &::mbs_runtime::Gains<T>,
    ) -> ::mbs_runtime::Stabilized<
        SliderCrankFreeCoordinates<T>,
        SliderCrankFreeConstraints<T>,
    > {
        let (sin_theta1, cos_theta1) = at.q.theta1.sin_cos();
        let (sin_theta2, cos_theta2) = at.q.theta2.sin_cos();
        let v4 = self.hoisted[0] * cos_theta1;
        let phi_crank_x = at.q.x1 - v4;
        let v6 = gains.minus_beta_squared * phi_crank_x;
        let v7 = self.hoisted[0] * sin_theta1;
        let v8 = at.v.theta1 * v7;
        let phi_dot_crank_x = at.v.x1 + v8;
        let v10 = gains.minus_two_alpha * phi_dot_crank_x;
        let feedback_crank_x = v6 + v10;
        let v12 = at.v.theta1 * at.v.theta1;
        let v13 = v12 * v4;
        let v14 = feedback_crank_x - v13;
        let phi_q_guide_theta1 = self.parameters.l1 * cos_theta1;
        let v16 = phi_q_guide_theta1 * phi_q_guide_theta1;
        let phi_q_guide_theta2 = self.parameters.l2 * cos_theta2;
        let v18 = phi_q_guide_theta2 * phi_q_guide_theta2;
        let v19 = v18 + v16;
        let v20 = T::from_f64(1.0) / v19;
        let v21 = at.v.theta1 * phi_q_guide_theta1;
        let v22 = at.v.theta2 * phi_q_guide_theta2;
        let phi_dot_guide = v22 + v21;
        let v24 = gains.minus_two_alpha * phi_dot_guide;
        let v25 = self.parameters.l1 * sin_theta1;
        let v26 = self.parameters.l2 * sin_theta2;
        let phi_guide = v26 + v25;
        let v28 = gains.minus_beta_squared * phi_guide;
        let feedback_guide = v28 + v24;
        let v30 = v12 * v25;
        let v31 = at.v.theta2 * at.v.theta2;
        let v32 = v31 * v26;
        let v33 = v32 + v30;
        let v34 = v33 + feedback_guide;
        let v35 = v34 * v20;
        let v36 = phi_q_guide_theta1 * v35;
        let v37 = self.hoisted[12] * sin_theta2;
        let v38 = sin_theta2 * v37;
        let v39 = self.hoisted[11] + v38;
        let v40 = phi_q_guide_theta1 * v39;
        let v41 = self.hoisted[13] * cos_theta2;
        let v42 = cos_theta1 * v41;
        let v43 = self.hoisted[14] * sin_theta2;
        let v44 = sin_theta1 * v43;
        let v45 = v44 + v42;
        let v46 = phi_q_guide_theta2 * v45;
        let v47 = v40 - v46;
        let v48 = phi_q_guide_theta1 * v47;
        let v49 = phi_q_guide_theta1 * v45;
        let v50 = self.hoisted[16] * sin_theta1;
        let v51 = sin_theta1 * v50;
        let v52 = self.hoisted[15] + v51;
        let v53 = phi_q_guide_theta2 * v52;
        let v54 = v49 - v53;
        let v55 = phi_q_guide_theta2 * v54;
        let v56 = v48 - v55;
        let v57 = self.hoisted[1] * cos_theta2;
        let v58 = at.v.theta2 * v57;
        let v59 = at.v.y2 - v58;
        let phi_dot_rod_y = v59 - v21;
        let v61 = gains.minus_two_alpha * phi_dot_rod_y;
        let v62 = self.hoisted[1] * sin_theta2;
        let v63 = at.q.y2 - v62;
        let phi_rod_y = v63 - v25;
        let v65 = gains.minus_beta_squared * phi_rod_y;
        let feedback_rod_y = v65 + v61;
        let v67 = v31 * v62;
        let v68 = v67 + v30;
        let v69 = feedback_rod_y - v68;
        let v70 = self.parameters.m2 * v69;
        let v71 = self.hoisted[5] + v70;
        let v72 = v57 * v71;
        let v73 = at.v.theta1 * v25;
        let v74 = at.v.theta2 * v62;
        let v75 = at.v.x2 + v74;
        let phi_dot_rod_x = v73 + v75;
        let v77 = gains.minus_two_alpha * phi_dot_rod_x;
        let v78 = at.q.x2 - v57;
        let phi_rod_x = v78 - phi_q_guide_theta1;
        let v80 = gains.minus_beta_squared * phi_rod_x;
        let feedback_rod_x = v80 + v77;
        let v82 = v12 * phi_q_guide_theta1;
        let v83 = v31 * v57;
        let v84 = v83 + v82;
        let v85 = feedback_rod_x - v84;
        let v86 = self.parameters.m2 * v85;
        let v87 = v62 * v86;
        let v88 = at.v.theta2 * v26;
        let v89 = at.v.x3 + v88;
        let phi_dot_slider = v73 + v89;
        let v91 = gains.minus_two_alpha * phi_dot_slider;
        let v92 = at.q.x3 - phi_q_guide_theta2;
        let phi_slider = v92 - phi_q_guide_theta1;
        let v94 = gains.minus_beta_squared * phi_slider;
        let feedback_slider = v94 + v91;
        let v96 = v31 * phi_q_guide_theta2;
        let v97 = v96 + v82;
        let v98 = feedback_slider - v97;
        let v99 = self.parameters.m3 * v98;
        let v100 = v26 * v99;
        let v101 = v100 + v87;
        let v102 = v101 - v72;
        let v103 = phi_q_guide_theta1 * v102;
        let v104 = at.v.theta1 * v4;
        let phi_dot_crank_y = at.v.y1 - v104;
        let v106 = gains.minus_two_alpha * phi_dot_crank_y;
        let phi_crank_y = at.q.y1 - v7;
        let v108 = gains.minus_beta_squared * phi_crank_y;
        let feedback_crank_y = v108 + v106;
        let v110 = v12 * v7;
        let v111 = feedback_crank_y - v110;
        let v112 = self.parameters.m1 * v111;
        let v113 = self.hoisted[4] + v112;
        let v114 = v4 * v113;
        let v115 = phi_q_guide_theta1 * v71;
        let v116 = self.parameters.m1 * v14;
        let v117 = v7 * v116;
        let v118 = v25 * v86;
        let v119 = v25 * v99;
        let v120 = inputs.crank_torque + v117;
        let v121 = v120 + v119;
        let v122 = v118 - v114;
        let v123 = v122 + v121;
        let v124 = v123 - v115;
        let v125 = phi_q_guide_theta2 * v124;
        let v126 = v103 - v125;
        let v127 = phi_q_guide_theta1 * v54;
        let v128 = phi_q_guide_theta2 * v47;
        let v129 = v128 + v127;
        let v130 = v129 * v35;
        let v131 = v126 - v130;
        let v132 = v131 / v56;
        let v133 = phi_q_guide_theta2 * v132;
        let acc_theta1 = v36 - v133;
        let v135 = v7 * acc_theta1;
        let acc_x1 = v14 - v135;
        let v137 = v4 * acc_theta1;
        let acc_y1 = v111 + v137;
        let v139 = v25 * acc_theta1;
        let v140 = phi_q_guide_theta1 * v132;
        let v141 = phi_q_guide_theta2 * v35;
        let acc_theta2 = v141 + v140;
        let v143 = v62 * acc_theta2;
        let v144 = v143 + v139;
        let acc_x2 = v85 - v144;
        let v146 = phi_q_guide_theta1 * acc_theta1;
        let v147 = v57 * acc_theta2;
        let v148 = v147 + v146;
        let acc_y2 = v69 + v148;
        let v150 = v26 * acc_theta2;
        let v151 = v150 + v139;
        let acc_x3 = v98 - v151;
        let v153 = self.hoisted[17] * v20;
        let abs_v153 = v153.abs();
        let sqrt_abs_v153 = abs_v153.sqrt();
        ::mbs_runtime::Stabilized {
            acceleration: SliderCrankFreeCoordinates {
                x1: acc_x1,
                y1: acc_y1,
                theta1: acc_theta1,
                x2: acc_x2,
                y2: acc_y2,
                theta2: acc_theta2,
                x3: acc_x3,
            },
            feedback: SliderCrankFreeConstraints {
                crank_x: feedback_crank_x,
                crank_y: feedback_crank_y,
                rod_x: feedback_rod_x,
                rod_y: feedback_rod_y,
                guide: feedback_guide,
                slider: feedback_slider,
            },
            growth: sqrt_abs_v153,
        }
    }
    #[inline(always)]
    fn constrained(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
        inputs: &SliderCrankFreeInputs<T>,
        feedback: &SliderCrankFreeConstraints<T>,
    ) -> ::mbs_runtime::Accelerations<SliderCrankFreeCoordinates<T>> {
        let (sin_theta1, cos_theta1) = at.q.theta1.sin_cos();
        let (sin_theta2, cos_theta2) = at.q.theta2.sin_cos();
        let v4 = at.v.theta1 * at.v.theta1;
        let v5 = self.hoisted[0] * cos_theta1;
        let v6 = v4 * v5;
        let v7 = feedback.crank_x - v6;
        let phi_q_guide_theta1 = self.parameters.l1 * cos_theta1;
        let v9 = phi_q_guide_theta1 * phi_q_guide_theta1;
        let phi_q_guide_theta2 = self.parameters.l2 * cos_theta2;
        let v11 = phi_q_guide_theta2 * phi_q_guide_theta2;
        let v12 = v11 + v9;
        let v13 = T::from_f64(1.0) / v12;
        let v14 = self.parameters.l1 * sin_theta1;
        let v15 = v4 * v14;
        let v16 = at.v.theta2 * at.v.theta2;
        let v17 = self.parameters.l2 * sin_theta2;
        let v18 = v16 * v17;
        let v19 = feedback.guide + v18;
        let v20 = v15 + v19;
        let v21 = v20 * v13;
        let v22 = phi_q_guide_theta1 * v21;
        let v23 = self.hoisted[12] * sin_theta2;
        let v24 = sin_theta2 * v23;
        let v25 = self.hoisted[11] + v24;
        let v26 = phi_q_guide_theta1 * v25;
        let v27 = self.hoisted[13] * cos_theta2;
        let v28 = cos_theta1 * v27;
        let v29 = self.hoisted[14] * sin_theta2;
        let v30 = sin_theta1 * v29;
        let v31 = v30 + v28;
        let v32 = phi_q_guide_theta2 * v31;
        let v33 = v26 - v32;
        let v34 = phi_q_guide_theta1 * v33;
        let v35 = phi_q_guide_theta1 * v31;
        let v36 = self.hoisted[16] * sin_theta1;
        let v37 = sin_theta1 * v36;
        let v38 = self.hoisted[15] + v37;
        let v39 = phi_q_guide_theta2 * v38;
        let v40 = v35 - v39;
        let v41 = phi_q_guide_theta2 * v40;
        let v42 = v34 - v41;
        let v43 = self.hoisted[1] * sin_theta2;
        let v44 = v16 * v43;
        let v45 = feedback.rod_y - v44;
        let v46 = v45 - v15;
        let v47 = self.parameters.m2 * v46;
        let v48 = self.hoisted[5] + v47;
        let v49 = self.hoisted[1] * cos_theta2;
        let v50 = v49 * v48;
        let v51 = v4 * phi_q_guide_theta1;
        let v52 = v16 * v49;
        let v53 = feedback.rod_x - v52;
        let v54 = v53 - v51;
        let v55 = self.parameters.m2 * v54;
        let v56 = v43 * v55;
        let v57 = v16 * phi_q_guide_theta2;
        let v58 = feedback.slider - v57;
        let v59 = v58 - v51;
        let v60 = self.parameters.m3 * v59;
        let v61 = v17 * v60;
        let v62 = v61 + v56;
        let v63 = v62 - v50;
        let v64 = phi_q_guide_theta1 * v63;
        let v65 = self.hoisted[0] * sin_theta1;
        let v66 = v4 * v65;
        let v67 = feedback.crank_y - v66;
        let v68 = self.parameters.m1 * v67;
        let v69 = self.hoisted[4] + v68;
        let v70 = v5 * v69;
        let v71 = phi_q_guide_theta1 * v48;
        let v72 = self.parameters.m1 * v7;
        let v73 = v65 * v72;
        let v74 = v14 * v55;
        let v75 = v14 * v60;
        let v76 = inputs.crank_torque + v73;
        let v77 = v76 + v75;
        let v78 = v74 - v70;
        let v79 = v78 + v77;
        let v80 = v79 - v71;
        let v81 = phi_q_guide_theta2 * v80;
        let v82 = v64 - v81;
        let v83 = phi_q_guide_theta1 * v40;
        let v84 = phi_q_guide_theta2 * v33;
        let v85 = v84 + v83;
        let v86 = v85 * v21;
        let v87 = v82 - v86;
        let v88 = v87 / v42;
        let v89 = phi_q_guide_theta2 * v88;
        let acc_theta1 = v22 - v89;
        let v91 = v65 * acc_theta1;
        let acc_x1 = v7 - v91;
        let v93 = v5 * acc_theta1;
        let acc_y1 = v67 + v93;
        let v95 = v14 * acc_theta1;
        let v96 = phi_q_guide_theta1 * v88;
        let v97 = phi_q_guide_theta2 * v21;
        let acc_theta2 = v97 + v96;
        let v99 = v43 * acc_theta2;
        let v100 = v99 + v95;
        let acc_x2 = v54 - v100;
        let v102 = phi_q_guide_theta1 * acc_theta1;
        let v103 = v49 * acc_theta2;
        let v104 = v103 + v102;
        let acc_y2 = v46 + v104;
        let v106 = v17 * acc_theta2;
        let v107 = v106 + v95;
        let acc_x3 = v59 - v107;
        let v109 = self.hoisted[17] * v13;
        let abs_v109 = v109.abs();
        let sqrt_abs_v109 = abs_v109.sqrt();
        ::mbs_runtime::Accelerations {
            acceleration: SliderCrankFreeCoordinates {
                x1: acc_x1,
                y1: acc_y1,
                theta1: acc_theta1,
                x2: acc_x2,
                y2: acc_y2,
                theta2: acc_theta2,
                x3: acc_x3,
            },
            growth: sqrt_abs_v109,
        }
    }
    #[inline(always)]
    fn reactions(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
        inputs: &SliderCrankFreeInputs<T>,
        feedback: &SliderCrankFreeConstraints<T>,
    ) -> ::mbs_runtime::Reactions<
        SliderCrankFreeCoordinates<T>,
        SliderCrankFreeConstraints<T>,
    > {
        let (sin_theta1, cos_theta1) = at.q.theta1.sin_cos();
        let (sin_theta2, cos_theta2) = at.q.theta2.sin_cos();
        let v4 = at.v.theta1 * at.v.theta1;
        let v5 = self.hoisted[0] * cos_theta1;
        let v6 = v4 * v5;
        let v7 = feedback.crank_x - v6;
        let phi_q_guide_theta1 = self.parameters.l1 * cos_theta1;
        let v9 = phi_q_guide_theta1 * phi_q_guide_theta1;
        let phi_q_guide_theta2 = self.parameters.l2 * cos_theta2;
        let v11 = phi_q_guide_theta2 * phi_q_guide_theta2;
        let v12 = v11 + v9;
        let v13 = T::from_f64(1.0) / v12;
        let v14 = self.parameters.l1 * sin_theta1;
        let v15 = v4 * v14;
        let v16 = at.v.theta2 * at.v.theta2;
        let v17 = self.parameters.l2 * sin_theta2;
        let v18 = v16 * v17;
        let v19 = feedback.guide + v18;
        let v20 = v15 + v19;
        let v21 = v20 * v13;
        let v22 = phi_q_guide_theta1 * v21;
        let v23 = self.hoisted[12] * sin_theta2;
        let v24 = sin_theta2 * v23;
        let v25 = self.hoisted[11] + v24;
        let v26 = phi_q_guide_theta1 * v25;
        let v27 = self.hoisted[13] * cos_theta2;
        let v28 = cos_theta1 * v27;
        let v29 = self.hoisted[14] * sin_theta2;
        let v30 = sin_theta1 * v29;
        let v31 = v30 + v28;
        let v32 = phi_q_guide_theta2 * v31;
        let v33 = v26 - v32;
        let v34 = phi_q_guide_theta1 * v33;
        let v35 = phi_q_guide_theta1 * v31;
        let v36 = self.hoisted[16] * sin_theta1;
        let v37 = sin_theta1 * v36;
        let v38 = self.hoisted[15] + v37;
        let v39 = phi_q_guide_theta2 * v38;
        let v40 = v35 - v39;
        let v41 = phi_q_guide_theta2 * v40;
        let v42 = v34 - v41;
        let v43 = self.hoisted[1] * sin_theta2;
        let v44 = v16 * v43;
        let v45 = v44 - feedback.rod_y;
        let v46 = v15 + v45;
        let v47 = self.parameters.m2 * v46;
        let v48 = v47 - self.hoisted[5];
        let v49 = self.hoisted[1] * cos_theta2;
        let v50 = v49 * v48;
        let v51 = v4 * phi_q_guide_theta1;
        let v52 = v16 * v49;
        let v53 = feedback.rod_x - v52;
        let v54 = v53 - v51;
        let v55 = self.parameters.m2 * v54;
        let v56 = v43 * v55;
        let v57 = v16 * phi_q_guide_theta2;
        let v58 = feedback.slider - v57;
        let v59 = v58 - v51;
        let v60 = self.parameters.m3 * v59;
        let v61 = v17 * v60;
        let v62 = v61 + v56;
        let v63 = v62 + v50;
        let v64 = phi_q_guide_theta1 * v63;
        let v65 = self.hoisted[0] * sin_theta1;
        let v66 = v4 * v65;
        let v67 = v66 - feedback.crank_y;
        let v68 = self.parameters.m1 * v67;
        let v69 = v68 - self.hoisted[4];
        let v70 = v5 * v69;
        let v71 = phi_q_guide_theta1 * v48;
        let v72 = self.parameters.m1 * v7;
        let v73 = v65 * v72;
        let v74 = v14 * v55;
        let v75 = v14 * v60;
        let v76 = inputs.crank_torque + v73;
        let v77 = v76 + v75;
        let v78 = v74 + v70;
        let v79 = v78 + v77;
        let v80 = v71 + v79;
        let v81 = phi_q_guide_theta2 * v80;
        let v82 = v64 - v81;
        let v83 = phi_q_guide_theta1 * v40;
        let v84 = phi_q_guide_theta2 * v33;
        let v85 = v84 + v83;
        let v86 = v85 * v21;
        let v87 = v82 - v86;
        let v88 = v87 / v42;
        let v89 = phi_q_guide_theta2 * v88;
        let acc_theta1 = v22 - v89;
        let v91 = v65 * acc_theta1;
        let acc_x1 = v7 - v91;
        let v93 = v5 * acc_theta1;
        let acc_y1 = v93 - v67;
        let v95 = v14 * acc_theta1;
        let v96 = phi_q_guide_theta1 * v88;
        let v97 = phi_q_guide_theta2 * v21;
        let acc_theta2 = v97 + v96;
        let v99 = v43 * acc_theta2;
        let v100 = v99 + v95;
        let acc_x2 = v54 - v100;
        let v102 = phi_q_guide_theta1 * acc_theta1;
        let v103 = v49 * acc_theta2;
        let v104 = v103 + v102;
        let acc_y2 = v104 - v46;
        let v106 = v17 * acc_theta2;
        let v107 = v106 + v95;
        let acc_x3 = v59 - v107;
        let v109 = self.parameters.m1 * v91;
        let lambda_crank_x = v109 - v72;
        let v111 = self.parameters.m1 * v93;
        let lambda_crank_y = v69 - v111;
        let v113 = self.parameters.m2 * v100;
        let lambda_rod_x = v113 - v55;
        let v115 = self.parameters.m2 * v104;
        let lambda_rod_y = v48 - v115;
        let v117 = v38 * acc_theta1;
        let v118 = v31 * acc_theta2;
        let v119 = v118 + v117;
        let v120 = v80 - v119;
        let v121 = phi_q_guide_theta1 * v120;
        let v122 = v31 * acc_theta1;
        let v123 = v25 * acc_theta2;
        let v124 = v123 + v122;
        let v125 = v63 - v124;
        let v126 = phi_q_guide_theta2 * v125;
        let v127 = v126 + v121;
        let lambda_guide = v13 * v127;
        let v129 = self.parameters.m3 * v107;
        let lambda_slider = v129 - v60;
        let v131 = self.hoisted[17] * v13;
        let abs_v131 = v131.abs();
        let sqrt_abs_v131 = abs_v131.sqrt();
        ::mbs_runtime::Reactions {
            acceleration: SliderCrankFreeCoordinates {
                x1: acc_x1,
                y1: acc_y1,
                theta1: acc_theta1,
                x2: acc_x2,
                y2: acc_y2,
                theta2: acc_theta2,
                x3: acc_x3,
            },
            multipliers: SliderCrankFreeConstraints {
                crank_x: lambda_crank_x,
                crank_y: lambda_crank_y,
                rod_x: lambda_rod_x,
                rod_y: lambda_rod_y,
                guide: lambda_guide,
                slider: lambda_slider,
            },
            growth: sqrt_abs_v131,
        }
    }
    fn position_correction(
        &self,
        t: T,
        q: &SliderCrankFreeCoordinates<T>,
        feedback: &SliderCrankFreeConstraints<T>,
    ) -> ::mbs_runtime::Accelerations<SliderCrankFreeCoordinates<T>> {
        let (sin_theta2, cos_theta2) = q.theta2.sin_cos();
        let v2 = self.hoisted[18] / cos_theta2;
        let v3 = feedback.guide * v2;
        let v4 = sin_theta2 * v3;
        let v5 = self.hoisted[1] * v4;
        let v6 = feedback.rod_x - v5;
        let v7 = self.hoisted[1] * cos_theta2;
        let v8 = v7 * v3;
        let v9 = feedback.rod_y + v8;
        let v10 = self.parameters.l2 * v4;
        let v11 = feedback.slider - v10;
        let v12 = self.hoisted[19] * v2;
        let abs_v12 = v12.abs();
        ::mbs_runtime::Accelerations {
            acceleration: SliderCrankFreeCoordinates {
                x1: feedback.crank_x,
                y1: feedback.crank_y,
                theta1: T::from_f64(0.0),
                x2: v6,
                y2: v9,
                theta2: v3,
                x3: v11,
            },
            growth: abs_v12,
        }
    }
    fn velocity_correction(
        &self,
        t: T,
        q: &SliderCrankFreeCoordinates<T>,
        feedback: &SliderCrankFreeConstraints<T>,
    ) -> ::mbs_runtime::Accelerations<SliderCrankFreeCoordinates<T>> {
        let (sin_theta2, cos_theta2) = q.theta2.sin_cos();
        let v2 = self.hoisted[18] / cos_theta2;
        let v3 = feedback.guide * v2;
        let v4 = sin_theta2 * v3;
        let v5 = self.hoisted[1] * v4;
        let v6 = feedback.rod_x - v5;
        let v7 = self.hoisted[1] * cos_theta2;
        let v8 = v7 * v3;
        let v9 = feedback.rod_y + v8;
        let v10 = self.parameters.l2 * v4;
        let v11 = feedback.slider - v10;
        let v12 = self.hoisted[19] * v2;
        let abs_v12 = v12.abs();
        ::mbs_runtime::Accelerations {
            acceleration: SliderCrankFreeCoordinates {
                x1: feedback.crank_x,
                y1: feedback.crank_y,
                theta1: T::from_f64(0.0),
                x2: v6,
                y2: v9,
                theta2: v3,
                x3: v11,
            },
            growth: abs_v12,
        }
    }
    #[inline(always)]
    fn fused_step<F: ::mbs_runtime::Feedback>(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
        inputs: &SliderCrankFreeInputs<T>,
        gains: &::mbs_runtime::Gains<T>,
        h: T,
        t_next: T,
    ) -> ::core::option::Option<::mbs_runtime::Stepped<SliderCrankFreeCoordinates<T>>> {
        ::core::option::Option::Some(
            if F::IS_HELD {
                self.step_held(at, inputs, gains, h, t_next)
            } else {
                self.step_per_stage(at, inputs, gains, h, t_next)
            },
        )
    }
    #[inline(always)]
    fn fused_step_with_reactions<F: ::mbs_runtime::Feedback>(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
        inputs: &SliderCrankFreeInputs<T>,
        gains: &::mbs_runtime::Gains<T>,
        h: T,
        t_next: T,
    ) -> ::core::option::Option<
        (
            ::mbs_runtime::Stepped<SliderCrankFreeCoordinates<T>>,
            ::mbs_runtime::Reactions<
                SliderCrankFreeCoordinates<T>,
                SliderCrankFreeConstraints<T>,
            >,
        ),
    > {
        ::core::option::Option::Some(
            if F::IS_HELD {
                self.step_held_with_reactions(at, inputs, gains, h, t_next)
            } else {
                self.step_per_stage_with_reactions(at, inputs, gains, h, t_next)
            },
        )
    }
    fn worst_pivot(
        &self,
        t: T,
        q: &SliderCrankFreeCoordinates<T>,
    ) -> ::core::option::Option<(::core::primitive::usize, T)> {
        let cos_theta1 = q.theta1.cos();
        let cos_theta2 = q.theta2.cos();
        let phi_q_guide_theta1 = self.parameters.l1 * cos_theta1;
        let v3 = phi_q_guide_theta1 * phi_q_guide_theta1;
        let phi_q_guide_theta2 = self.parameters.l2 * cos_theta2;
        let v5 = phi_q_guide_theta2 * phi_q_guide_theta2;
        let v6 = v5 + v3;
        let v7 = self.hoisted[17] / v6;
        let abs_v7 = v7.abs();
        let sqrt_abs_v7 = abs_v7.sqrt();
        ::mbs_runtime::__private::worst(&[sqrt_abs_v7])
    }
    fn worst_start_pivot(
        &self,
        t: T,
        q: &SliderCrankFreeCoordinates<T>,
    ) -> ::core::option::Option<(::core::primitive::usize, T)> {
        let cos_theta2 = q.theta2.cos();
        let v1 = self.hoisted[18] / cos_theta2;
        let v2 = self.hoisted[19] * v1;
        let abs_v2 = v2.abs();
        ::mbs_runtime::__private::worst(&[abs_v2])
    }
    #[inline(always)]
    fn kinetic_energy(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
    ) -> T {
        Self::kinetic_energy(self, at)
    }
    #[inline(always)]
    fn potential_energy(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
    ) -> T {
        Self::potential_energy(self, at)
    }
    #[inline(always)]
    fn outputs(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
        inputs: &SliderCrankFreeInputs<T>,
        reactions: &::mbs_runtime::Reactions<
            SliderCrankFreeCoordinates<T>,
            SliderCrankFreeConstraints<T>,
        >,
    ) -> SliderCrankFreeOutputs<T> {
        let v0 = inputs.crank_torque * at.v.theta1;
        SliderCrankFreeOutputs {
            crank_speed: at.v.theta1,
            motor_power: v0,
        }
    }
    fn points(&self, t: T, q: &SliderCrankFreeCoordinates<T>) -> [[T; 2]; 9] {
        let (sin_theta1, cos_theta1) = q.theta1.sin_cos();
        let (sin_theta2, cos_theta2) = q.theta2.sin_cos();
        let v4 = T::from_f64(0.5) * self.parameters.l1;
        let v5 = v4 * cos_theta1;
        let phi_crank_x = q.x1 - v5;
        let v7 = v4 * sin_theta1;
        let phi_crank_y = q.y1 - v7;
        let v9 = q.x1 + v5;
        let v10 = q.y1 + v7;
        let v11 = self.parameters.l2 * T::from_f64(0.5);
        let v12 = v11 * cos_theta2;
        let v13 = q.x2 - v12;
        let v14 = v11 * sin_theta2;
        let v15 = q.y2 - v14;
        let v16 = q.x2 + v12;
        let v17 = q.y2 + v14;
        [
            [q.x1, q.y1],
            [phi_crank_x, phi_crank_y],
            [v9, v10],
            [q.x2, q.y2],
            [v13, v15],
            [v16, v17],
            [q.x3, T::from_f64(0.0)],
            [T::from_f64(0.0), T::from_f64(0.0)],
            [T::from_f64(1.0), T::from_f64(0.0)],
        ]
    }
}
