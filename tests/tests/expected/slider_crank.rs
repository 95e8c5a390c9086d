/**Slider-crank driven at constant speed.

# Equations

7 coordinates, 7 constraints, 0 degrees of freedom. Φ(q, t) = 0 is
```text
crank_x: x1 - 1/2*l1*cos(theta1) = 0
crank_y: y1 - 1/2*l1*sin(theta1) = 0
crank_speed: theta1 - omega*t = 0
rod_x: x2 - l1*cos(theta1) - 1/2*l2*cos(theta2) = 0
rod_y: y2 - l1*sin(theta1) - 1/2*l2*sin(theta2) = 0
guide: l1*sin(theta1) + l2*sin(theta2) = 0
slider: x3 - l1*cos(theta1) - l2*cos(theta2) = 0
```

# Elimination

Order: constraints first, then what motion they leave free (null space).

```text
lambda(crank_speed), theta1: divided by 1
lambda(crank_x), x1: divided by 1
lambda(crank_y), y1: divided by 1
lambda(rod_x), x2: divided by 1
lambda(rod_y), y2: divided by 1
lambda(slider), x3: divided by 1
lambda(guide), theta2: divided by l2*cos(theta2)
```

# Cost

Operations per call:

| function | mul | add | div | sincos | other | pivot watch |
|---|---|---|---|---|---|---|
| `new` | 17 | 1 | 1 | 0 | 1 | 0 |
| `phi` | 9 | 10 | 0 | 2 | 0 | 0 |
| `phi_dot` | 12 | 10 | 0 | 2 | 0 | 0 |
| `phi_q` | 8 | 3 | 0 | 2 | 0 | 0 |
| `phi_t` | 0 | 1 | 0 | 0 | 0 | 0 |
| `gamma` | 14 | 9 | 0 | 2 | 0 | 0 |
| `baumgarte_rhs` | 43 | 37 | 0 | 2 | 0 | 0 |
| `mass` | 0 | 0 | 0 | 0 | 0 | 0 |
| `forces` | 0 | 2 | 0 | 0 | 0 | 0 |
| `kinetic_energy` | 14 | 6 | 0 | 0 | 0 | 0 |
| `potential_energy` | 2 | 1 | 0 | 0 | 0 | 0 |
| `stabilized` | 49 | 44 | 1 | 2 | 0 | 2 |
| `constrained` | 26 | 17 | 1 | 2 | 0 | 2 |
| `reactions` | 48 | 34 | 1 | 2 | 0 | 2 |
| `position_correction` | 12 | 9 | 1 | 2 | 0 | 2 |
| `velocity_correction` | 12 | 9 | 1 | 2 | 0 | 2 |
| `outputs` | 0 | 1 | 0 | 0 | 0 | 0 |
*/
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq
)]
pub struct SliderCrank<T = ::core::primitive::f64> {
    parameters: SliderCrankParameters<T>,
    /**What depends on parameters alone, computed once:

```text
0: 1/2*l1
1: 1/2*l2
2: l1^2*m1*inertia_factor
3: l2^2*inertia_factor*m2
4: 9.81*m1
5: 9.81*m2
6: 1/2*m1
7: 1/2*l1^2*m1*inertia_factor
8: 1/2*m2
9: 1/2*l2^2*inertia_factor*m2
10: 1/2*m3
11: 1/l2
12: abs(l2)
13: l2^2*inertia_factor*m2 + 1/4*l2^2*m2
14: l2^2*m3
```
*/
    hoisted: [T; 15usize],
}
impl<T: ::mbs_runtime::Real> ::core::default::Default for SliderCrank<T> {
    /// The mechanism with its declared parameters.
    fn default() -> Self {
        Self::prepare(<SliderCrankParameters<T> as ::core::default::Default>::default())
    }
}
///Parameters of [`SliderCrank`], in SI units; the default is the declaration.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq
)]
pub struct SliderCrankParameters<T = ::core::primitive::f64> {
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
    /**Moment of inertia of crank and rod about their middles over m l²:
1/12 for slender rods, 0 for point masses. The paper's torques come
out with 1/3.

`inertia_factor`: a bare number, declared as 0.08333333333333333.*/
    pub inertia_factor: T,
    /**Speed of the crank.

`omega`: a rate [1/s], declared as 200 rpm = 20.94395102393195 in SI units.*/
    pub omega: T,
}
impl<T: ::mbs_runtime::Real> ::core::default::Default for SliderCrankParameters<T> {
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
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Components for SliderCrankParameters<T> {
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
impl<T: ::mbs_runtime::Real> ::core::convert::From<SliderCrankParameters<T>>
for ::mbs_runtime::__private::nalgebra::SVector<T, 7> {
    fn from(components: SliderCrankParameters<T>) -> Self {
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
///Coordinates of [`SliderCrank`], or their rates, in SI units.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq
)]
pub struct SliderCrankCoordinates<T = ::core::primitive::f64> {
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
impl<T: ::mbs_runtime::Real> ::core::default::Default for SliderCrankCoordinates<T> {
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
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Components for SliderCrankCoordinates<T> {
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
impl<T: ::mbs_runtime::Real> ::core::convert::From<SliderCrankCoordinates<T>>
for ::mbs_runtime::__private::nalgebra::SVector<T, 7> {
    fn from(components: SliderCrankCoordinates<T>) -> Self {
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
///One component per constraint of [`SliderCrank`]: Φ, its derivatives, or the multipliers λ.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq
)]
pub struct SliderCrankConstraints<T = ::core::primitive::f64> {
    /**The crank turns about the origin.

`x1 - 1/2*l1*cos(theta1) = 0`*/
    pub crank_x: T,
    /**The crank turns about the origin.

`y1 - 1/2*l1*sin(theta1) = 0`*/
    pub crank_y: T,
    /**The crank turns at constant speed.

`theta1 - omega*t = 0`*/
    pub crank_speed: T,
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
impl<T: ::mbs_runtime::Real> ::core::default::Default for SliderCrankConstraints<T> {
    #[allow(clippy::approx_constant)]
    fn default() -> Self {
        Self {
            crank_x: T::from_f64(0.0),
            crank_y: T::from_f64(0.0),
            crank_speed: T::from_f64(0.0),
            rod_x: T::from_f64(0.0),
            rod_y: T::from_f64(0.0),
            guide: T::from_f64(0.0),
            slider: T::from_f64(0.0),
        }
    }
}
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Components for SliderCrankConstraints<T> {
    type Real = T;
    type Array = [T; 7];
    const NAMES: &'static [&'static ::core::primitive::str] = &[
        "crank_x",
        "crank_y",
        "crank_speed",
        "rod_x",
        "rod_y",
        "guide",
        "slider",
    ];
    #[inline(always)]
    fn into_array(self) -> [T; 7] {
        [
            self.crank_x,
            self.crank_y,
            self.crank_speed,
            self.rod_x,
            self.rod_y,
            self.guide,
            self.slider,
        ]
    }
    #[inline(always)]
    fn from_array(array: [T; 7]) -> Self {
        Self {
            crank_x: array[0],
            crank_y: array[1],
            crank_speed: array[2],
            rod_x: array[3],
            rod_y: array[4],
            guide: array[5],
            slider: array[6],
        }
    }
    #[inline(always)]
    fn splat(value: T) -> Self {
        Self {
            crank_x: value,
            crank_y: value,
            crank_speed: value,
            rod_x: value,
            rod_y: value,
            guide: value,
            slider: value,
        }
    }
}
impl<T: ::mbs_runtime::Real> ::core::convert::From<SliderCrankConstraints<T>>
for ::mbs_runtime::__private::nalgebra::SVector<T, 7> {
    fn from(components: SliderCrankConstraints<T>) -> Self {
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
///Outputs of [`SliderCrank`], in SI units.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq
)]
pub struct SliderCrankOutputs<T = ::core::primitive::f64> {
    /**Torque that keeps the crank at its speed.

`drive_torque`: a torque or energy [N*m].*/
    pub drive_torque: T,
}
impl<T: ::mbs_runtime::Real> ::core::default::Default for SliderCrankOutputs<T> {
    #[allow(clippy::approx_constant)]
    fn default() -> Self {
        Self {
            drive_torque: T::from_f64(0.0),
        }
    }
}
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Components for SliderCrankOutputs<T> {
    type Real = T;
    type Array = [T; 1];
    const NAMES: &'static [&'static ::core::primitive::str] = &["drive_torque"];
    #[inline(always)]
    fn into_array(self) -> [T; 1] {
        [self.drive_torque]
    }
    #[inline(always)]
    fn from_array(array: [T; 1]) -> Self {
        Self { drive_torque: array[0] }
    }
    #[inline(always)]
    fn splat(value: T) -> Self {
        Self { drive_torque: value }
    }
}
impl<T: ::mbs_runtime::Real> ::core::convert::From<SliderCrankOutputs<T>>
for ::mbs_runtime::__private::nalgebra::SVector<T, 1> {
    fn from(components: SliderCrankOutputs<T>) -> Self {
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
impl SliderCrank<::core::primitive::f64> {
    /// The mechanism with its declared parameters, in `f64`.
    ///
    /// For another scalar type, use `default`.
    pub fn declared() -> Self {
        ::core::default::Default::default()
    }
}
impl<T: ::mbs_runtime::Real> SliderCrank<T> {
    /// The mechanism with these parameters.
    ///
    /// # Errors
    /// If a parameter is not finite, a mass or an inertia comes out
    /// negative, or a declared condition does not hold.
    pub fn new(
        parameters: SliderCrankParameters<T>,
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
    fn prepare(parameters: SliderCrankParameters<T>) -> Self {
        let abs_l2 = parameters.l2.abs();
        let v1 = T::from_f64(0.5) * parameters.l1;
        let v2 = T::from_f64(0.5) * parameters.l2;
        let v3 = parameters.m1 * parameters.l1;
        let v4 = parameters.inertia_factor * v3;
        let v5 = parameters.l1 * v4;
        let v6 = parameters.l2 * parameters.l2;
        let v7 = parameters.m2 * v6;
        let v8 = parameters.inertia_factor * v7;
        let v9 = T::from_f64(9.81) * parameters.m1;
        let v10 = T::from_f64(9.81) * parameters.m2;
        let v11 = T::from_f64(0.5) * parameters.m1;
        let v12 = v1 * v4;
        let v13 = T::from_f64(0.5) * parameters.m2;
        let v14 = T::from_f64(0.5) * v8;
        let v15 = T::from_f64(0.5) * parameters.m3;
        let v16 = T::from_f64(1.0) / parameters.l2;
        let v17 = T::from_f64(0.25) * v7;
        let v18 = v17 + v8;
        let v19 = parameters.m3 * v6;
        Self {
            parameters,
            hoisted: [
                v1,
                v2,
                v5,
                v8,
                v9,
                v10,
                v11,
                v12,
                v13,
                v14,
                v15,
                v16,
                abs_l2,
                v18,
                v19,
            ],
        }
    }
    /// The parameters.
    pub fn parameters(&self) -> &SliderCrankParameters<T> {
        &self.parameters
    }
}
impl<T: ::mbs_runtime::Real> SliderCrank<T> {
    /// Operations of one evaluation of the right-hand side, the watch over
    /// the pivots included; a step takes two, or less.
    pub const OPERATIONS: ::core::primitive::u32 = 98u32;
    /// The size of a state (time, positions, velocities) in bytes.
    pub const STATE_BYTES: ::core::primitive::usize = ::core::mem::size_of::<
        ::mbs_runtime::State<SliderCrankCoordinates<T>>,
    >();
    /// A bound of the stack that a step takes, in bytes, in optimized code:
    /// every value of both evaluations of the right-hand side once, eight
    /// copies of the state, the inputs and the rows, and 1 KiB for calls.
    pub const STACK_BYTES: ::core::primitive::usize = 200usize
        * ::core::mem::size_of::<T>()
        + 8
            * (Self::STATE_BYTES + ::core::mem::size_of::<SliderCrankConstraints<T>>()
                + ::core::mem::size_of::<::mbs_runtime::NoComponents<T>>()) + 1024;
}
#[allow(unused_variables, clippy::all)]
impl<T: ::mbs_runtime::Real> SliderCrank<T> {
    /**Constraints Φ(q, t): 0 where the mechanism is assembled.

```text
crank_x: x1 - 1/2*l1*cos(theta1)
crank_y: y1 - 1/2*l1*sin(theta1)
crank_speed: theta1 - omega*t
rod_x: x2 - l1*cos(theta1) - 1/2*l2*cos(theta2)
rod_y: y2 - l1*sin(theta1) - 1/2*l2*sin(theta2)
guide: l1*sin(theta1) + l2*sin(theta2)
slider: x3 - l1*cos(theta1) - l2*cos(theta2)
```


Cost: 9 mul + 10 add + 0 div + 2 sincos.*/
    #[inline(always)]
    pub fn phi(&self, t: T, q: &SliderCrankCoordinates<T>) -> SliderCrankConstraints<T> {
        let (sin_theta1, cos_theta1) = q.theta1.sin_cos();
        let (sin_theta2, cos_theta2) = q.theta2.sin_cos();
        let v4 = self.hoisted[0] * cos_theta1;
        let phi_crank_x = q.x1 - v4;
        let v6 = self.hoisted[0] * sin_theta1;
        let phi_crank_y = q.y1 - v6;
        let v8 = self.parameters.omega * t;
        let phi_crank_speed = q.theta1 - v8;
        let v10 = self.parameters.l1 * cos_theta1;
        let v11 = self.hoisted[1] * cos_theta2;
        let v12 = q.x2 - v11;
        let phi_rod_x = v12 - v10;
        let v14 = self.parameters.l1 * sin_theta1;
        let v15 = self.hoisted[1] * sin_theta2;
        let v16 = q.y2 - v15;
        let phi_rod_y = v16 - v14;
        let v18 = self.parameters.l2 * sin_theta2;
        let phi_guide = v18 + v14;
        let v20 = self.parameters.l2 * cos_theta2;
        let v21 = q.x3 - v20;
        let phi_slider = v21 - v10;
        SliderCrankConstraints {
            crank_x: phi_crank_x,
            crank_y: phi_crank_y,
            crank_speed: phi_crank_speed,
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
crank_speed: -omega
rod_x: 0
rod_y: 0
guide: 0
slider: 0
```


Cost: 0 mul + 1 add + 0 div + 0 sincos.*/
    #[inline]
    pub fn phi_t(
        &self,
        t: T,
        q: &SliderCrankCoordinates<T>,
    ) -> SliderCrankConstraints<T> {
        let v0 = -self.parameters.omega;
        SliderCrankConstraints {
            crank_x: T::from_f64(0.0),
            crank_y: T::from_f64(0.0),
            crank_speed: v0,
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
        at: &::mbs_runtime::State<SliderCrankCoordinates<T>>,
    ) -> SliderCrankConstraints<T> {
        let (sin_theta1, cos_theta1) = at.q.theta1.sin_cos();
        let (sin_theta2, cos_theta2) = at.q.theta2.sin_cos();
        let v4 = at.v.theta1 * sin_theta1;
        let v5 = self.hoisted[0] * v4;
        let phi_dot_crank_x = at.v.x1 + v5;
        let v7 = at.v.theta1 * cos_theta1;
        let v8 = self.hoisted[0] * v7;
        let phi_dot_crank_y = at.v.y1 - v8;
        let phi_dot_crank_speed = at.v.theta1 - self.parameters.omega;
        let v11 = self.parameters.l1 * v4;
        let v12 = at.v.theta2 * sin_theta2;
        let v13 = self.hoisted[1] * v12;
        let v14 = at.v.x2 + v13;
        let phi_dot_rod_x = v11 + v14;
        let v16 = self.parameters.l1 * v7;
        let v17 = at.v.theta2 * cos_theta2;
        let v18 = self.hoisted[1] * v17;
        let v19 = at.v.y2 - v18;
        let phi_dot_rod_y = v19 - v16;
        let v21 = self.parameters.l2 * v17;
        let phi_dot_guide = v21 + v16;
        let v23 = self.parameters.l2 * v12;
        let v24 = at.v.x3 + v23;
        let phi_dot_slider = v11 + v24;
        SliderCrankConstraints {
            crank_x: phi_dot_crank_x,
            crank_y: phi_dot_crank_y,
            crank_speed: phi_dot_crank_speed,
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
crank_speed: 0
rod_x: -l1*cos(theta1)*der(theta1)^2 - 1/2*l2*cos(theta2)*der(theta2)^2
rod_y: -l1*sin(theta1)*der(theta1)^2 - 1/2*l2*sin(theta2)*der(theta2)^2
guide: l1*sin(theta1)*der(theta1)^2 + l2*sin(theta2)*der(theta2)^2
slider: -l1*cos(theta1)*der(theta1)^2 - l2*cos(theta2)*der(theta2)^2
```


Cost: 14 mul + 9 add + 0 div + 2 sincos.*/
    #[inline]
    pub fn gamma(
        &self,
        at: &::mbs_runtime::State<SliderCrankCoordinates<T>>,
    ) -> SliderCrankConstraints<T> {
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
        SliderCrankConstraints {
            crank_x: gamma_crank_x,
            crank_y: gamma_crank_y,
            crank_speed: T::from_f64(0.0),
            rod_x: gamma_rod_x,
            rod_y: gamma_rod_y,
            guide: gamma_guide,
            slider: gamma_slider,
        }
    }
    /**γ − 2αΦ̇ − β²Φ, the right-hand side with feedback of the violation (Jiang 2025, Eq. 8); gains in 1/s.

Cost: 43 mul + 37 add + 0 div + 2 sincos.*/
    #[inline]
    pub fn baumgarte_rhs(
        &self,
        at: &::mbs_runtime::State<SliderCrankCoordinates<T>>,
        alpha: T,
        beta: T,
    ) -> SliderCrankConstraints<T> {
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
        let phi_dot_crank_speed = at.v.theta1 - self.parameters.omega;
        let v25 = gains.minus_two_alpha * phi_dot_crank_speed;
        let v26 = at.t * self.parameters.omega;
        let phi_crank_speed = at.q.theta1 - v26;
        let v28 = gains.minus_beta_squared * phi_crank_speed;
        let feedback_crank_speed = v25 + v28;
        let v30 = self.parameters.l1 * v4;
        let v31 = at.v.theta1 * v30;
        let v32 = at.v.theta2 * cos_theta2;
        let v33 = self.hoisted[1] * v32;
        let v34 = at.v.theta2 * v33;
        let v35 = self.parameters.l1 * v10;
        let v36 = at.v.theta2 * sin_theta2;
        let v37 = self.hoisted[1] * v36;
        let v38 = at.v.x2 + v37;
        let phi_dot_rod_x = v35 + v38;
        let v40 = gains.minus_two_alpha * phi_dot_rod_x;
        let v41 = self.parameters.l1 * cos_theta1;
        let v42 = self.hoisted[1] * cos_theta2;
        let v43 = at.q.x2 - v42;
        let phi_rod_x = v43 - v41;
        let v45 = gains.minus_beta_squared * phi_rod_x;
        let v46 = v34 + v31;
        let v47 = v45 - v46;
        let v48 = v47 + v40;
        let v49 = at.v.theta1 * v35;
        let v50 = at.v.theta2 * v37;
        let v51 = at.v.y2 - v33;
        let phi_dot_rod_y = v51 - v30;
        let v53 = gains.minus_two_alpha * phi_dot_rod_y;
        let v54 = self.parameters.l1 * sin_theta1;
        let v55 = self.hoisted[1] * sin_theta2;
        let v56 = at.q.y2 - v55;
        let phi_rod_y = v56 - v54;
        let v58 = gains.minus_beta_squared * phi_rod_y;
        let v59 = v50 + v49;
        let v60 = v58 - v59;
        let v61 = v60 + v53;
        let v62 = self.parameters.l2 * v36;
        let v63 = at.v.theta2 * v62;
        let v64 = self.parameters.l2 * v32;
        let phi_dot_guide = v64 + v30;
        let v66 = gains.minus_two_alpha * phi_dot_guide;
        let v67 = self.parameters.l2 * sin_theta2;
        let phi_guide = v67 + v54;
        let v69 = gains.minus_beta_squared * phi_guide;
        let v70 = v69 + v63;
        let v71 = v49 + v70;
        let v72 = v66 + v71;
        let v73 = at.v.theta2 * v64;
        let v74 = at.v.x3 + v62;
        let phi_dot_slider = v35 + v74;
        let v76 = gains.minus_two_alpha * phi_dot_slider;
        let v77 = self.parameters.l2 * cos_theta2;
        let v78 = at.q.x3 - v77;
        let phi_slider = v78 - v41;
        let v80 = gains.minus_beta_squared * phi_slider;
        let v81 = v73 + v31;
        let v82 = v80 - v81;
        let v83 = v82 + v76;
        SliderCrankConstraints {
            crank_x: v15,
            crank_y: v23,
            crank_speed: feedback_crank_speed,
            rod_x: v48,
            rod_y: v61,
            guide: v72,
            slider: v83,
        }
    }
    /**Jacobian Φ_q, one row per constraint, one column per coordinate. Entries that are not 0:

```text
∂crank_x/∂x1 = 1
∂crank_x/∂theta1 = 1/2*l1*sin(theta1)
∂crank_y/∂y1 = 1
∂crank_y/∂theta1 = -1/2*l1*cos(theta1)
∂crank_speed/∂theta1 = 1
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
        q: &SliderCrankCoordinates<T>,
    ) -> ::mbs_runtime::__private::nalgebra::SMatrix<T, 7usize, 7usize> {
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
                    T::from_f64(0.0),
                ],
                [
                    T::from_f64(0.0),
                    T::from_f64(1.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                ],
                [
                    phi_q_crank_x_theta1,
                    phi_q_crank_y_theta1,
                    T::from_f64(1.0),
                    phi_q_rod_x_theta1,
                    phi_q_rod_y_theta1,
                    phi_q_guide_theta1,
                    phi_q_rod_x_theta1,
                ],
                [
                    T::from_f64(0.0),
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
                    T::from_f64(0.0),
                    T::from_f64(1.0),
                    T::from_f64(0.0),
                    T::from_f64(0.0),
                ],
                [
                    T::from_f64(0.0),
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
        q: &SliderCrankCoordinates<T>,
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
theta1: 0
x2: 0
y2: -9.81*m2
theta2: 0
x3: 0
```


Cost: 0 mul + 2 add + 0 div + 0 sincos.*/
    #[inline]
    pub fn forces(
        &self,
        at: &::mbs_runtime::State<SliderCrankCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
    ) -> SliderCrankCoordinates<T> {
        let v0 = -self.hoisted[4];
        let v1 = -self.hoisted[5];
        SliderCrankCoordinates {
            x1: T::from_f64(0.0),
            y1: v0,
            theta1: T::from_f64(0.0),
            x2: T::from_f64(0.0),
            y2: v1,
            theta2: T::from_f64(0.0),
            x3: T::from_f64(0.0),
        }
    }
    /**Accelerations q̈ and multipliers λ from M q̈ + Φ_qᵀ λ = Q, Φ_q q̈ = γ, without feedback terms.

In a singular position the result is not finite or its `growth` exceeds the runtime's `growth_limit`.

Cost: 48 mul + 34 add + 1 div + 2 sincos.*/
    #[inline]
    pub fn accelerations(
        &self,
        at: &::mbs_runtime::State<SliderCrankCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
    ) -> ::mbs_runtime::Reactions<SliderCrankCoordinates<T>, SliderCrankConstraints<T>> {
        let none = <SliderCrankConstraints<
            T,
        > as ::mbs_runtime::Components>::splat(T::from_f64(0.0));
        ::mbs_runtime::Mechanism::reactions(self, at, inputs, &none)
    }
    /// Kinetic energy ½ vᵀMv in J.
    #[inline(always)]
    pub fn kinetic_energy(
        &self,
        at: &::mbs_runtime::State<SliderCrankCoordinates<T>>,
    ) -> T {
        let v0 = self.hoisted[6] * at.v.x1;
        let v1 = at.v.x1 * v0;
        let v2 = self.hoisted[6] * at.v.y1;
        let v3 = at.v.y1 * v2;
        let v4 = self.hoisted[7] * at.v.theta1;
        let v5 = at.v.theta1 * v4;
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
        at: &::mbs_runtime::State<SliderCrankCoordinates<T>>,
    ) -> T {
        let v0 = self.hoisted[4] * at.q.y1;
        let v1 = self.hoisted[5] * at.q.y2;
        let v2 = v1 + v0;
        v2
    }
}
#[allow(unused_variables, clippy::all)]
impl<T: ::mbs_runtime::Real> SliderCrank<T> {
    ///A step with feedback held over it.
    #[inline(always)]
    fn step_held(
        &self,
        at: &::mbs_runtime::State<SliderCrankCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        gains: &::mbs_runtime::Gains<T>,
        h: T,
        t_next: T,
    ) -> ::mbs_runtime::Stepped<SliderCrankCoordinates<T>> {
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
        let phi_dot_crank_speed = Single::<T>::new(at.v.theta1)
            - Single::<T>::new(self.parameters.omega);
        let v22 = Single::<T>::new(gains.minus_two_alpha) * phi_dot_crank_speed;
        let v23 = Single::<T>::new(at.t) * Single::<T>::new(self.parameters.omega);
        let phi_crank_speed = Single::<T>::new(at.q.theta1) - v23;
        let v25 = Single::<T>::new(gains.minus_beta_squared) * phi_crank_speed;
        let feedback_crank_speed = v22 + v25;
        let p27 = T::Pair::splat(feedback_crank_speed);
        let p28 = p27.flip();
        let p29 = p28 * p16;
        let v30 = Single::<T>::new(at.v.theta1) * Single::<T>::new(at.v.theta1);
        let p31 = T::Pair::splat(v30);
        let p32 = p31 * p10;
        let p33 = p29 + p32;
        let p34 = p20 - p33;
        let p35 = p3 * p34;
        let p36 = p2 + p35;
        let p37 = p2 + p36;
        let p38 = p1 * p37;
        let p39 = p0 + p38;
        let v40 = Single::<T>::new(h) * feedback_crank_speed;
        let v41 = Single::<T>::new(at.v.theta1) + v40;
        let v42 = Single::<T>::new(at.v.theta1) + v41;
        let v43 = Single::<T>::new(half_h) * v42;
        let v44 = Single::<T>::new(at.q.theta1) + v43;
        let p45 = T::Pair::join(Single::<T>::new(at.q.x2), Single::<T>::new(at.q.y2));
        let p46 = T::Pair::join(Single::<T>::new(at.v.x2), Single::<T>::new(at.v.y2));
        let p47 = T::Pair::splat(Single::<T>::new(self.hoisted[1]));
        let p48 = T::Pair::join(cosines7.second(), sines7.second());
        let p49 = p47 * p48;
        let p50 = p45 - p49;
        let p51 = T::Pair::splat(Single::<T>::new(self.parameters.l1));
        let p52 = p51 * p9;
        let p53 = p50 - p52;
        let p54 = p4 * p53;
        let p55 = T::Pair::splat(Single::<T>::new(at.v.theta2));
        let p56 = p55.flip();
        let p57 = p49.swap();
        let p58 = p56 * p57;
        let p59 = p46 + p58;
        let p60 = p52.swap();
        let p61 = p15 * p60;
        let p62 = p59 + p61;
        let p63 = p13 * p62;
        let p64 = p54 + p63;
        let p65 = p28 * p60;
        let p66 = p31 * p52;
        let p67 = p65 + p66;
        let v68 = Single::<T>::new(at.v.theta2) * Single::<T>::new(at.v.theta2);
        let p69 = T::Pair::splat(v68);
        let p70 = p69 * p49;
        let p71 = p67 + p70;
        let p72 = p64 - p71;
        let p73 = p57.flip();
        let p74 = T::Pair::splat(Single::<T>::new(self.hoisted[11]));
        let v75 = Single::<T>::new(h) * Single::<T>::new(at.v.theta1);
        let v76 = Single::<T>::new(at.q.theta1) + v75;
        let v77 = Single::<T>::new(h) * Single::<T>::new(at.v.theta2);
        let v78 = Single::<T>::new(at.q.theta2) + v77;
        let p79 = T::Pair::join(v76, v78);
        let (sines80, cosines80) = p79.sin_cos();
        let p82 = T::Pair::join(cosines7.second(), cosines80.second());
        let p83 = p74 / p82;
        let p84 = T::Pair::splat(Single::<T>::new(self.parameters.l2));
        let p85 = T::Pair::join(sines7.second(), cosines7.second());
        let p86 = p84 * p85;
        let phi_guide = p86.first() + p52.second();
        let v88 = Single::<T>::new(at.q.x3) - p86.second();
        let phi_slider = v88 - p52.first();
        let p90 = T::Pair::join(phi_guide, phi_slider);
        let p91 = p4 * p90;
        let v92 = Single::<T>::new(at.v.theta2) * p86.second();
        let p93 = T::Pair::join(v92, p61.first());
        let p94 = p61.flip();
        let v95 = Single::<T>::new(at.v.theta2) * p86.first();
        let v96 = Single::<T>::new(at.v.x3) + v95;
        let p97 = T::Pair::join(p94.second(), v96);
        let p98 = p93 + p97;
        let p99 = p13 * p98;
        let p100 = p91 + p99;
        let p101 = p69.flip();
        let p102 = p101 * p86;
        let p103 = p67.flip();
        let p104 = p103.swap();
        let p105 = p102 - p104;
        let p106 = p100 + p105;
        let acc_theta2 = p83.first() * p106.first();
        let p108 = T::Pair::splat(acc_theta2);
        let p109 = p73 * p108;
        let p110 = p72 - p109;
        let p111 = p3 * p110;
        let p112 = p46 + p111;
        let p113 = p46 + p112;
        let p114 = p1 * p113;
        let p115 = p45 + p114;
        let p116 = T::Pair::join(
            Single::<T>::new(at.q.theta2),
            Single::<T>::new(at.q.x3),
        );
        let p117 = T::Pair::join(
            Single::<T>::new(at.v.theta2),
            Single::<T>::new(at.v.x3),
        );
        let v118 = p86.first() * acc_theta2;
        let acc_x3 = p106.second() - v118;
        let p120 = T::Pair::join(acc_theta2, acc_x3);
        let p121 = p3 * p120;
        let p122 = p117 + p121;
        let p123 = p117 + p122;
        let p124 = p1 * p123;
        let p125 = p116 + p124;
        let p126 = T::Pair::join(sines80.first(), cosines80.first());
        let p127 = p27 * p126;
        let v128 = v41 * v41;
        let p129 = T::Pair::splat(v128);
        let p130 = T::Pair::join(cosines80.first(), sines80.first());
        let p131 = p129 * p130;
        let p132 = T::Pair::join(p127.first(), p131.second());
        let p133 = p5 * p132;
        let p134 = p20 - p133;
        let p135 = p5.flip();
        let p136 = T::Pair::join(p131.first(), p127.second());
        let p137 = p135 * p136;
        let p138 = p134 - p137;
        let p139 = p34 + p138;
        let p140 = p1 * p139;
        let p141 = p2 + p140;
        let v142 = feedback_crank_speed + feedback_crank_speed;
        let v143 = Single::<T>::new(half_h) * v142;
        let v144 = Single::<T>::new(at.v.theta1) + v143;
        let v145 = p122.first() * p122.first();
        let p146 = T::Pair::splat(v145);
        let p147 = T::Pair::join(cosines80.second(), sines80.second());
        let p148 = p47 * p147;
        let p149 = p146 * p148;
        let p150 = p64 - p149;
        let p151 = p51.flip();
        let p152 = p151 * p127;
        let p153 = p51 * p131;
        let p154 = p152 + p153;
        let p155 = p150 - p154;
        let p156 = p148.swap();
        let p157 = p156.flip();
        let v158 = Single::<T>::new(self.parameters.l2) * sines80.second();
        let v159 = v145 * v158;
        let v160 = p100.first() + v159;
        let p161 = p154.flip();
        let v162 = v160 - p161.second();
        let v163 = p83.second() * v162;
        let p164 = T::Pair::splat(v163);
        let p165 = p157 * p164;
        let p166 = p155 - p165;
        let p167 = p110 + p166;
        let p168 = p1 * p167;
        let p169 = p46 + p168;
        let v170 = acc_theta2 + v163;
        let v171 = Single::<T>::new(half_h) * v170;
        let v172 = Single::<T>::new(at.v.theta2) + v171;
        let v173 = Single::<T>::new(self.parameters.l2) * v145;
        let v174 = v173 * cosines80.second();
        let v175 = p100.second() - v174;
        let v176 = v175 - p161.first();
        let v177 = v158 * v163;
        let v178 = v176 - v177;
        let v179 = acc_x3 + v178;
        let v180 = Single::<T>::new(half_h) * v179;
        let v181 = Single::<T>::new(at.v.x3) + v180;
        let p182 = T::Pair::splat(Single::<T>::new(self.hoisted[12]));
        let p183 = p182 * p83;
        let v184 = Single::<T>::new(p183.first().get().abs());
        let v185 = Single::<T>::new(p183.second().get().abs());
        let v186 = v184 + v185;
        let p187 = p39 + p115;
        let p188 = p187 + p125;
        let p189 = p188 + p141;
        let p190 = p189 + p169;
        let v191 = v44 + v144;
        let v192 = v191 + v172;
        let v193 = v192 + v181;
        let v194 = v193 + p190.first();
        let v195 = v194 + p190.second();
        ::mbs_runtime::Stepped {
            next: ::mbs_runtime::State {
                t: t_next,
                q: SliderCrankCoordinates {
                    x1: p39.first().get(),
                    y1: p39.second().get(),
                    theta1: v44.get(),
                    x2: p115.first().get(),
                    y2: p115.second().get(),
                    theta2: p125.first().get(),
                    x3: p125.second().get(),
                },
                v: SliderCrankCoordinates {
                    x1: p141.first().get(),
                    y1: p141.second().get(),
                    theta1: v144.get(),
                    x2: p169.first().get(),
                    y2: p169.second().get(),
                    theta2: v172.get(),
                    x3: v181.get(),
                },
            },
            growth: v186.get(),
            sum: v195.get(),
        }
    }
    ///A step with feedback in both stages.
    #[inline(always)]
    fn step_per_stage(
        &self,
        at: &::mbs_runtime::State<SliderCrankCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        gains: &::mbs_runtime::Gains<T>,
        h: T,
        t_next: T,
    ) -> ::mbs_runtime::Stepped<SliderCrankCoordinates<T>> {
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
        let phi_dot_crank_speed = Single::<T>::new(at.v.theta1)
            - Single::<T>::new(self.parameters.omega);
        let v22 = Single::<T>::new(gains.minus_two_alpha) * phi_dot_crank_speed;
        let v23 = Single::<T>::new(at.t) * Single::<T>::new(self.parameters.omega);
        let phi_crank_speed = Single::<T>::new(at.q.theta1) - v23;
        let v25 = Single::<T>::new(gains.minus_beta_squared) * phi_crank_speed;
        let feedback_crank_speed = v22 + v25;
        let p27 = T::Pair::splat(feedback_crank_speed);
        let p28 = p27.flip();
        let p29 = p28 * p16;
        let v30 = Single::<T>::new(at.v.theta1) * Single::<T>::new(at.v.theta1);
        let p31 = T::Pair::splat(v30);
        let p32 = p31 * p10;
        let p33 = p29 + p32;
        let p34 = p20 - p33;
        let p35 = p3 * p34;
        let p36 = p2 + p35;
        let p37 = p2 + p36;
        let p38 = p1 * p37;
        let p39 = p0 + p38;
        let v40 = Single::<T>::new(h) * feedback_crank_speed;
        let v41 = Single::<T>::new(at.v.theta1) + v40;
        let v42 = Single::<T>::new(at.v.theta1) + v41;
        let v43 = Single::<T>::new(half_h) * v42;
        let v44 = Single::<T>::new(at.q.theta1) + v43;
        let p45 = T::Pair::join(Single::<T>::new(at.q.x2), Single::<T>::new(at.q.y2));
        let p46 = T::Pair::join(Single::<T>::new(at.v.x2), Single::<T>::new(at.v.y2));
        let p47 = T::Pair::splat(Single::<T>::new(self.hoisted[1]));
        let p48 = T::Pair::join(cosines7.second(), sines7.second());
        let p49 = p47 * p48;
        let p50 = p45 - p49;
        let p51 = T::Pair::splat(Single::<T>::new(self.parameters.l1));
        let p52 = p51 * p9;
        let p53 = p50 - p52;
        let p54 = p4 * p53;
        let p55 = T::Pair::splat(Single::<T>::new(at.v.theta2));
        let p56 = p55.flip();
        let p57 = p49.swap();
        let p58 = p56 * p57;
        let p59 = p46 + p58;
        let p60 = p52.swap();
        let p61 = p15 * p60;
        let p62 = p59 + p61;
        let p63 = p13 * p62;
        let p64 = p54 + p63;
        let p65 = p28 * p60;
        let p66 = p31 * p52;
        let p67 = p65 + p66;
        let v68 = Single::<T>::new(at.v.theta2) * Single::<T>::new(at.v.theta2);
        let p69 = T::Pair::splat(v68);
        let p70 = p69 * p49;
        let p71 = p67 + p70;
        let p72 = p64 - p71;
        let p73 = p57.flip();
        let p74 = T::Pair::splat(Single::<T>::new(self.hoisted[11]));
        let v75 = Single::<T>::new(h) * Single::<T>::new(at.v.theta1);
        let v76 = Single::<T>::new(at.q.theta1) + v75;
        let v77 = Single::<T>::new(h) * Single::<T>::new(at.v.theta2);
        let v78 = Single::<T>::new(at.q.theta2) + v77;
        let p79 = T::Pair::join(v76, v78);
        let (sines80, cosines80) = p79.sin_cos();
        let p82 = T::Pair::join(cosines7.second(), cosines80.second());
        let p83 = p74 / p82;
        let p84 = T::Pair::splat(Single::<T>::new(self.parameters.l2));
        let p85 = T::Pair::join(sines7.second(), cosines7.second());
        let p86 = p84 * p85;
        let phi_guide = p86.first() + p52.second();
        let v88 = Single::<T>::new(at.q.x3) - p86.second();
        let phi_slider = v88 - p52.first();
        let p90 = T::Pair::join(phi_guide, phi_slider);
        let p91 = p4 * p90;
        let v92 = Single::<T>::new(at.v.theta2) * p86.second();
        let p93 = T::Pair::join(v92, p61.first());
        let p94 = p61.flip();
        let v95 = Single::<T>::new(at.v.theta2) * p86.first();
        let v96 = Single::<T>::new(at.v.x3) + v95;
        let p97 = T::Pair::join(p94.second(), v96);
        let p98 = p93 + p97;
        let p99 = p13 * p98;
        let p100 = p91 + p99;
        let p101 = p69.flip();
        let p102 = p101 * p86;
        let p103 = p67.flip();
        let p104 = p103.swap();
        let p105 = p102 - p104;
        let p106 = p100 + p105;
        let acc_theta2 = p83.first() * p106.first();
        let p108 = T::Pair::splat(acc_theta2);
        let p109 = p73 * p108;
        let p110 = p72 - p109;
        let p111 = p3 * p110;
        let p112 = p46 + p111;
        let p113 = p46 + p112;
        let p114 = p1 * p113;
        let p115 = p45 + p114;
        let v116 = Single::<T>::new(h) * acc_theta2;
        let v117 = Single::<T>::new(at.v.theta2) + v116;
        let v118 = Single::<T>::new(at.v.theta2) + v117;
        let v119 = Single::<T>::new(half_h) * v118;
        let v120 = Single::<T>::new(at.q.theta2) + v119;
        let v121 = p86.first() * acc_theta2;
        let acc_x3 = p106.second() - v121;
        let v123 = Single::<T>::new(h) * acc_x3;
        let v124 = Single::<T>::new(at.v.x3) + v123;
        let v125 = Single::<T>::new(at.v.x3) + v124;
        let v126 = Single::<T>::new(half_h) * v125;
        let v127 = Single::<T>::new(at.q.x3) + v126;
        let p128 = p3 * p2;
        let p129 = p0 + p128;
        let p130 = T::Pair::join(cosines80.first(), sines80.first());
        let p131 = p5 * p130;
        let p132 = p129 - p131;
        let p133 = p4 * p132;
        let p134 = T::Pair::splat(v41);
        let p135 = p134.flip();
        let p136 = p131.swap();
        let p137 = p135 * p136;
        let p138 = p36 + p137;
        let p139 = p13 * p138;
        let p140 = p133 + p139;
        let v141 = v41 - Single::<T>::new(self.parameters.omega);
        let v142 = Single::<T>::new(gains.minus_two_alpha) * v141;
        let v143 = Single::<T>::new(t_next) * Single::<T>::new(self.parameters.omega);
        let v144 = v76 - v143;
        let v145 = Single::<T>::new(gains.minus_beta_squared) * v144;
        let v146 = v142 + v145;
        let p147 = T::Pair::splat(v146);
        let p148 = p147.flip();
        let p149 = p148 * p136;
        let v150 = v41 * v41;
        let p151 = T::Pair::splat(v150);
        let p152 = p151 * p131;
        let p153 = p149 + p152;
        let p154 = p140 - p153;
        let p155 = p34 + p154;
        let p156 = p1 * p155;
        let p157 = p2 + p156;
        let v158 = feedback_crank_speed + v146;
        let v159 = Single::<T>::new(half_h) * v158;
        let v160 = Single::<T>::new(at.v.theta1) + v159;
        let p161 = p3 * p46;
        let p162 = p45 + p161;
        let p163 = T::Pair::join(cosines80.second(), sines80.second());
        let p164 = p47 * p163;
        let p165 = p162 - p164;
        let p166 = p51 * p130;
        let p167 = p165 - p166;
        let p168 = p4 * p167;
        let p169 = T::Pair::splat(v117);
        let p170 = p169.flip();
        let p171 = p164.swap();
        let p172 = p170 * p171;
        let p173 = p112 + p172;
        let p174 = p166.swap();
        let p175 = p135 * p174;
        let p176 = p173 + p175;
        let p177 = p13 * p176;
        let p178 = p168 + p177;
        let p179 = p148 * p174;
        let p180 = p151 * p166;
        let p181 = p179 + p180;
        let v182 = v117 * v117;
        let p183 = T::Pair::splat(v182);
        let p184 = p183 * p164;
        let p185 = p181 + p184;
        let p186 = p178 - p185;
        let p187 = p171.flip();
        let p188 = T::Pair::join(sines80.second(), cosines80.second());
        let p189 = p84 * p188;
        let v190 = p189.first() + p166.second();
        let v191 = Single::<T>::new(h) * Single::<T>::new(at.v.x3);
        let v192 = Single::<T>::new(at.q.x3) + v191;
        let v193 = v192 - p189.second();
        let v194 = v193 - p166.first();
        let p195 = T::Pair::join(v190, v194);
        let p196 = p4 * p195;
        let v197 = v117 * p189.second();
        let p198 = T::Pair::join(v197, p175.first());
        let p199 = p175.flip();
        let v200 = v117 * p189.first();
        let v201 = v124 + v200;
        let p202 = T::Pair::join(p199.second(), v201);
        let p203 = p198 + p202;
        let p204 = p13 * p203;
        let p205 = p196 + p204;
        let p206 = p183.flip();
        let p207 = p206 * p189;
        let p208 = p181.flip();
        let p209 = p208.swap();
        let p210 = p207 - p209;
        let p211 = p205 + p210;
        let v212 = p83.second() * p211.first();
        let p213 = T::Pair::splat(v212);
        let p214 = p187 * p213;
        let p215 = p186 - p214;
        let p216 = p110 + p215;
        let p217 = p1 * p216;
        let p218 = p46 + p217;
        let v219 = acc_theta2 + v212;
        let v220 = Single::<T>::new(half_h) * v219;
        let v221 = Single::<T>::new(at.v.theta2) + v220;
        let v222 = p189.first() * v212;
        let v223 = p211.second() - v222;
        let v224 = acc_x3 + v223;
        let v225 = Single::<T>::new(half_h) * v224;
        let v226 = Single::<T>::new(at.v.x3) + v225;
        let p227 = T::Pair::splat(Single::<T>::new(self.hoisted[12]));
        let p228 = p227 * p83;
        let v229 = Single::<T>::new(p228.first().get().abs());
        let v230 = Single::<T>::new(p228.second().get().abs());
        let v231 = v229 + v230;
        let p232 = p39 + p115;
        let p233 = p232 + p157;
        let p234 = p233 + p218;
        let v235 = v44 + v120;
        let v236 = v235 + v127;
        let v237 = v236 + v160;
        let v238 = v237 + v221;
        let v239 = v238 + v226;
        let v240 = v239 + p234.first();
        let v241 = v240 + p234.second();
        ::mbs_runtime::Stepped {
            next: ::mbs_runtime::State {
                t: t_next,
                q: SliderCrankCoordinates {
                    x1: p39.first().get(),
                    y1: p39.second().get(),
                    theta1: v44.get(),
                    x2: p115.first().get(),
                    y2: p115.second().get(),
                    theta2: v120.get(),
                    x3: v127.get(),
                },
                v: SliderCrankCoordinates {
                    x1: p157.first().get(),
                    y1: p157.second().get(),
                    theta1: v160.get(),
                    x2: p218.first().get(),
                    y2: p218.second().get(),
                    theta2: v221.get(),
                    x3: v226.get(),
                },
            },
            growth: v231.get(),
            sum: v241.get(),
        }
    }
    ///A step with feedback held over it, and the reactions at its start.
    #[inline(always)]
    fn step_held_with_reactions(
        &self,
        at: &::mbs_runtime::State<SliderCrankCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        gains: &::mbs_runtime::Gains<T>,
        h: T,
        t_next: T,
    ) -> (
        ::mbs_runtime::Stepped<SliderCrankCoordinates<T>>,
        ::mbs_runtime::Reactions<SliderCrankCoordinates<T>, SliderCrankConstraints<T>>,
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
        let phi_dot_crank_speed = Single::<T>::new(at.v.theta1)
            - Single::<T>::new(self.parameters.omega);
        let v22 = Single::<T>::new(gains.minus_two_alpha) * phi_dot_crank_speed;
        let v23 = Single::<T>::new(at.t) * Single::<T>::new(self.parameters.omega);
        let phi_crank_speed = Single::<T>::new(at.q.theta1) - v23;
        let v25 = Single::<T>::new(gains.minus_beta_squared) * phi_crank_speed;
        let feedback_crank_speed = v22 + v25;
        let p27 = T::Pair::splat(feedback_crank_speed);
        let p28 = p27.flip();
        let p29 = p28 * p16;
        let v30 = Single::<T>::new(at.v.theta1) * Single::<T>::new(at.v.theta1);
        let p31 = T::Pair::splat(v30);
        let p32 = p31 * p10;
        let p33 = p29 + p32;
        let p34 = p20 - p33;
        let p35 = p3 * p34;
        let p36 = p2 + p35;
        let p37 = p2 + p36;
        let p38 = p1 * p37;
        let p39 = p0 + p38;
        let v40 = Single::<T>::new(h) * feedback_crank_speed;
        let v41 = Single::<T>::new(at.v.theta1) + v40;
        let v42 = Single::<T>::new(at.v.theta1) + v41;
        let v43 = Single::<T>::new(half_h) * v42;
        let v44 = Single::<T>::new(at.q.theta1) + v43;
        let p45 = T::Pair::join(Single::<T>::new(at.q.x2), Single::<T>::new(at.q.y2));
        let p46 = T::Pair::join(Single::<T>::new(at.v.x2), Single::<T>::new(at.v.y2));
        let p47 = T::Pair::splat(Single::<T>::new(self.hoisted[1]));
        let p48 = T::Pair::join(cosines7.second(), sines7.second());
        let p49 = p47 * p48;
        let p50 = p45 - p49;
        let p51 = T::Pair::splat(Single::<T>::new(self.parameters.l1));
        let p52 = p51 * p9;
        let p53 = p50 - p52;
        let p54 = p4 * p53;
        let p55 = T::Pair::splat(Single::<T>::new(at.v.theta2));
        let p56 = p55.flip();
        let p57 = p49.swap();
        let p58 = p56 * p57;
        let p59 = p46 + p58;
        let p60 = p52.swap();
        let p61 = p15 * p60;
        let p62 = p59 + p61;
        let p63 = p13 * p62;
        let p64 = p54 + p63;
        let p65 = p28 * p60;
        let p66 = p31 * p52;
        let p67 = p65 + p66;
        let v68 = Single::<T>::new(at.v.theta2) * Single::<T>::new(at.v.theta2);
        let p69 = T::Pair::splat(v68);
        let p70 = p69 * p49;
        let p71 = p67 + p70;
        let p72 = p64 - p71;
        let p73 = p57.flip();
        let p74 = T::Pair::splat(Single::<T>::new(self.hoisted[11]));
        let v75 = Single::<T>::new(h) * Single::<T>::new(at.v.theta1);
        let v76 = Single::<T>::new(at.q.theta1) + v75;
        let v77 = Single::<T>::new(h) * Single::<T>::new(at.v.theta2);
        let v78 = Single::<T>::new(at.q.theta2) + v77;
        let p79 = T::Pair::join(v76, v78);
        let (sines80, cosines80) = p79.sin_cos();
        let p82 = T::Pair::join(cosines7.second(), cosines80.second());
        let p83 = p74 / p82;
        let p84 = T::Pair::splat(Single::<T>::new(self.parameters.l2));
        let p85 = T::Pair::join(sines7.second(), cosines7.second());
        let p86 = p84 * p85;
        let phi_guide = p86.first() + p52.second();
        let v88 = Single::<T>::new(at.q.x3) - p86.second();
        let phi_slider = v88 - p52.first();
        let p90 = T::Pair::join(phi_guide, phi_slider);
        let p91 = p4 * p90;
        let v92 = Single::<T>::new(at.v.theta2) * p86.second();
        let p93 = T::Pair::join(v92, p61.first());
        let p94 = p61.flip();
        let v95 = Single::<T>::new(at.v.theta2) * p86.first();
        let v96 = Single::<T>::new(at.v.x3) + v95;
        let p97 = T::Pair::join(p94.second(), v96);
        let p98 = p93 + p97;
        let p99 = p13 * p98;
        let p100 = p91 + p99;
        let p101 = p69.flip();
        let p102 = p101 * p86;
        let p103 = p67.flip();
        let p104 = p103.swap();
        let p105 = p102 - p104;
        let p106 = p100 + p105;
        let acc_theta2 = p83.first() * p106.first();
        let p108 = T::Pair::splat(acc_theta2);
        let p109 = p73 * p108;
        let p110 = p72 - p109;
        let p111 = p3 * p110;
        let p112 = p46 + p111;
        let p113 = p46 + p112;
        let p114 = p1 * p113;
        let p115 = p45 + p114;
        let p116 = T::Pair::join(
            Single::<T>::new(at.q.theta2),
            Single::<T>::new(at.q.x3),
        );
        let p117 = T::Pair::join(
            Single::<T>::new(at.v.theta2),
            Single::<T>::new(at.v.x3),
        );
        let v118 = p86.first() * acc_theta2;
        let acc_x3 = p106.second() - v118;
        let p120 = T::Pair::join(acc_theta2, acc_x3);
        let p121 = p3 * p120;
        let p122 = p117 + p121;
        let p123 = p117 + p122;
        let p124 = p1 * p123;
        let p125 = p116 + p124;
        let p126 = T::Pair::join(sines80.first(), cosines80.first());
        let p127 = p27 * p126;
        let v128 = v41 * v41;
        let p129 = T::Pair::splat(v128);
        let p130 = T::Pair::join(cosines80.first(), sines80.first());
        let p131 = p129 * p130;
        let p132 = T::Pair::join(p127.first(), p131.second());
        let p133 = p5 * p132;
        let p134 = p20 - p133;
        let p135 = p5.flip();
        let p136 = T::Pair::join(p131.first(), p127.second());
        let p137 = p135 * p136;
        let p138 = p134 - p137;
        let p139 = p34 + p138;
        let p140 = p1 * p139;
        let p141 = p2 + p140;
        let v142 = feedback_crank_speed + feedback_crank_speed;
        let v143 = Single::<T>::new(half_h) * v142;
        let v144 = Single::<T>::new(at.v.theta1) + v143;
        let v145 = p122.first() * p122.first();
        let p146 = T::Pair::splat(v145);
        let p147 = T::Pair::join(cosines80.second(), sines80.second());
        let p148 = p47 * p147;
        let p149 = p146 * p148;
        let p150 = p64 - p149;
        let p151 = p51.flip();
        let p152 = p151 * p127;
        let p153 = p51 * p131;
        let p154 = p152 + p153;
        let p155 = p150 - p154;
        let p156 = p148.swap();
        let p157 = p156.flip();
        let v158 = Single::<T>::new(self.parameters.l2) * sines80.second();
        let v159 = v145 * v158;
        let v160 = p100.first() + v159;
        let p161 = p154.flip();
        let v162 = v160 - p161.second();
        let v163 = p83.second() * v162;
        let p164 = T::Pair::splat(v163);
        let p165 = p157 * p164;
        let p166 = p155 - p165;
        let p167 = p110 + p166;
        let p168 = p1 * p167;
        let p169 = p46 + p168;
        let v170 = acc_theta2 + v163;
        let v171 = Single::<T>::new(half_h) * v170;
        let v172 = Single::<T>::new(at.v.theta2) + v171;
        let v173 = Single::<T>::new(self.parameters.l2) * v145;
        let v174 = v173 * cosines80.second();
        let v175 = p100.second() - v174;
        let v176 = v175 - p161.first();
        let v177 = v158 * v163;
        let v178 = v176 - v177;
        let v179 = acc_x3 + v178;
        let v180 = Single::<T>::new(half_h) * v179;
        let v181 = Single::<T>::new(at.v.x3) + v180;
        let v182 = -p32.first();
        let v183 = -p32.second();
        let v184 = -p70.first();
        let v185 = v184 - p66.first();
        let v186 = -p66.second();
        let v187 = p102.first() - v186;
        let v188 = p83.first() * v187;
        let p189 = T::Pair::splat(v188);
        let p190 = p49 * p189;
        let acc_x2 = v185 - p190.second();
        let v192 = p70.second() - v186;
        let acc_y2 = p190.first() - v192;
        let v194 = Single::<T>::new(self.parameters.l2) * v68;
        let v195 = v194 * cosines7.second();
        let v196 = -v195;
        let v197 = v196 - p66.first();
        let v198 = p86.first() * v188;
        let v199 = v197 - v198;
        let p200 = T::Pair::splat(Single::<T>::new(self.hoisted[12]));
        let p201 = p200 * p83;
        let v202 = Single::<T>::new(p201.first().get().abs());
        let v203 = Single::<T>::new(p201.second().get().abs());
        let v204 = v202 + v203;
        let v205 = Single::<T>::new(self.parameters.m1) * v182;
        let lambda_crank_x = -v205;
        let v207 = Single::<T>::new(self.parameters.m1) * v183;
        let v208 = Single::<T>::new(self.hoisted[4]) + v207;
        let lambda_crank_y = -v208;
        let v210 = Single::<T>::new(self.parameters.m2) * v192;
        let v211 = v210 - Single::<T>::new(self.hoisted[5]);
        let p212 = T::Pair::splat(Single::<T>::new(self.parameters.m2));
        let p213 = p212 * p190;
        let lambda_rod_y = v211 - p213.first();
        let v215 = p52.first() * lambda_rod_y;
        let v216 = Single::<T>::new(self.parameters.m3) * v198;
        let v217 = Single::<T>::new(self.parameters.m3) * v197;
        let lambda_slider = v216 - v217;
        let v219 = p52.second() * lambda_slider;
        let v220 = v215 - v219;
        let v221 = p10.second() * v205;
        let v222 = p10.first() * lambda_crank_y;
        let v223 = v221 + v222;
        let v224 = Single::<T>::new(self.parameters.m2) * v185;
        let lambda_rod_x = p213.second() - v224;
        let v226 = p52.second() * lambda_rod_x;
        let v227 = v223 - v226;
        let v228 = v220 + v227;
        let v229 = p49.first() * v211;
        let v230 = p49.second() * v224;
        let v231 = p86.first() * v217;
        let v232 = Single::<T>::new(self.hoisted[14]) * sines7.second();
        let v233 = sines7.second() * v232;
        let v234 = Single::<T>::new(self.hoisted[13]) + v233;
        let v235 = v234 * v188;
        let v236 = v231 - v235;
        let v237 = v230 + v236;
        let v238 = v229 + v237;
        let lambda_guide = p83.first() * v238;
        let v240 = p52.first() * lambda_guide;
        let v241 = v228 - v240;
        let p242 = p39 + p115;
        let p243 = p242 + p125;
        let p244 = p243 + p141;
        let p245 = p244 + p169;
        let v246 = v44 + v144;
        let v247 = v246 + v172;
        let v248 = v247 + v181;
        let v249 = v248 + v182;
        let v250 = v249 + v183;
        let v251 = v250 + Single::<T>::new(T::from_f64(0.0));
        let v252 = v251 + acc_x2;
        let v253 = v252 + acc_y2;
        let v254 = v253 + v188;
        let v255 = v254 + v199;
        let v256 = v255 + p245.first();
        let v257 = v256 + p245.second();
        (
            ::mbs_runtime::Stepped {
                next: ::mbs_runtime::State {
                    t: t_next,
                    q: SliderCrankCoordinates {
                        x1: p39.first().get(),
                        y1: p39.second().get(),
                        theta1: v44.get(),
                        x2: p115.first().get(),
                        y2: p115.second().get(),
                        theta2: p125.first().get(),
                        x3: p125.second().get(),
                    },
                    v: SliderCrankCoordinates {
                        x1: p141.first().get(),
                        y1: p141.second().get(),
                        theta1: v144.get(),
                        x2: p169.first().get(),
                        y2: p169.second().get(),
                        theta2: v172.get(),
                        x3: v181.get(),
                    },
                },
                growth: v204.get(),
                sum: v257.get(),
            },
            ::mbs_runtime::Reactions {
                acceleration: SliderCrankCoordinates {
                    x1: v182.get(),
                    y1: v183.get(),
                    theta1: Single::<T>::new(T::from_f64(0.0)).get(),
                    x2: acc_x2.get(),
                    y2: acc_y2.get(),
                    theta2: v188.get(),
                    x3: v199.get(),
                },
                multipliers: SliderCrankConstraints {
                    crank_x: lambda_crank_x.get(),
                    crank_y: lambda_crank_y.get(),
                    crank_speed: v241.get(),
                    rod_x: lambda_rod_x.get(),
                    rod_y: lambda_rod_y.get(),
                    guide: lambda_guide.get(),
                    slider: lambda_slider.get(),
                },
                growth: v202.get(),
            },
        )
    }
    ///A step with feedback in both stages, and the reactions at its start.
    #[inline(always)]
    fn step_per_stage_with_reactions(
        &self,
        at: &::mbs_runtime::State<SliderCrankCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        gains: &::mbs_runtime::Gains<T>,
        h: T,
        t_next: T,
    ) -> (
        ::mbs_runtime::Stepped<SliderCrankCoordinates<T>>,
        ::mbs_runtime::Reactions<SliderCrankCoordinates<T>, SliderCrankConstraints<T>>,
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
        let phi_dot_crank_speed = Single::<T>::new(at.v.theta1)
            - Single::<T>::new(self.parameters.omega);
        let v22 = Single::<T>::new(gains.minus_two_alpha) * phi_dot_crank_speed;
        let v23 = Single::<T>::new(at.t) * Single::<T>::new(self.parameters.omega);
        let phi_crank_speed = Single::<T>::new(at.q.theta1) - v23;
        let v25 = Single::<T>::new(gains.minus_beta_squared) * phi_crank_speed;
        let feedback_crank_speed = v22 + v25;
        let p27 = T::Pair::splat(feedback_crank_speed);
        let p28 = p27.flip();
        let p29 = p28 * p16;
        let v30 = Single::<T>::new(at.v.theta1) * Single::<T>::new(at.v.theta1);
        let p31 = T::Pair::splat(v30);
        let p32 = p31 * p10;
        let p33 = p29 + p32;
        let p34 = p20 - p33;
        let p35 = p3 * p34;
        let p36 = p2 + p35;
        let p37 = p2 + p36;
        let p38 = p1 * p37;
        let p39 = p0 + p38;
        let v40 = Single::<T>::new(h) * feedback_crank_speed;
        let v41 = Single::<T>::new(at.v.theta1) + v40;
        let v42 = Single::<T>::new(at.v.theta1) + v41;
        let v43 = Single::<T>::new(half_h) * v42;
        let v44 = Single::<T>::new(at.q.theta1) + v43;
        let p45 = T::Pair::join(Single::<T>::new(at.q.x2), Single::<T>::new(at.q.y2));
        let p46 = T::Pair::join(Single::<T>::new(at.v.x2), Single::<T>::new(at.v.y2));
        let p47 = T::Pair::join(Single::<T>::new(at.v.x2), Single::<T>::new(at.v.x3));
        let p48 = T::Pair::join(Single::<T>::new(at.q.x2), Single::<T>::new(at.q.x3));
        let p49 = T::Pair::join(
            Single::<T>::new(self.hoisted[1]),
            Single::<T>::new(self.parameters.l2),
        );
        let p50 = T::Pair::splat(cosines7.second());
        let p51 = p49 * p50;
        let p52 = p48 - p51;
        let p53 = T::Pair::splat(Single::<T>::new(self.parameters.l1));
        let p54 = T::Pair::join(sines7.first(), cosines7.first());
        let p55 = p53 * p54;
        let p56 = T::Pair::splat(p55.second());
        let p57 = p52 - p56;
        let p58 = p4 * p57;
        let p59 = p14 * p55;
        let p60 = T::Pair::splat(p59.first());
        let p61 = T::Pair::splat(Single::<T>::new(at.v.theta2));
        let p62 = T::Pair::splat(sines7.second());
        let p63 = p49 * p62;
        let p64 = p61 * p63;
        let p65 = p47 + p64;
        let p66 = p60 + p65;
        let p67 = p13 * p66;
        let p68 = p58 + p67;
        let v69 = Single::<T>::new(at.v.theta2) * Single::<T>::new(at.v.theta2);
        let p70 = T::Pair::splat(v69);
        let p71 = p70 * p51;
        let p72 = p27 * p55;
        let p73 = p31.flip();
        let p74 = p55.swap();
        let p75 = p73 * p74;
        let p76 = p72 + p75;
        let p77 = T::Pair::splat(p76.first());
        let p78 = p71 + p77;
        let p79 = p68 - p78;
        let p80 = T::Pair::splat(Single::<T>::new(self.hoisted[11]));
        let v81 = Single::<T>::new(h) * Single::<T>::new(at.v.theta1);
        let v82 = Single::<T>::new(at.q.theta1) + v81;
        let v83 = Single::<T>::new(h) * Single::<T>::new(at.v.theta2);
        let v84 = Single::<T>::new(at.q.theta2) + v83;
        let p85 = T::Pair::join(v82, v84);
        let (sines86, cosines86) = p85.sin_cos();
        let p88 = T::Pair::join(cosines7.second(), cosines86.second());
        let p89 = p80 / p88;
        let v90 = v69 * p63.second();
        let v91 = v90 - p76.second();
        let v92 = Single::<T>::new(at.q.y2) - p63.first();
        let p93 = T::Pair::join(p63.second(), v92);
        let p94 = T::Pair::splat(p55.first());
        let p95 = p94.flip();
        let p96 = p93 + p95;
        let p97 = p4 * p96;
        let v98 = Single::<T>::new(at.v.theta2) * p51.second();
        let phi_dot_guide = v98 + p59.second();
        let v100 = Single::<T>::new(at.v.theta2) * p51.first();
        let v101 = Single::<T>::new(at.v.y2) - v100;
        let phi_dot_rod_y = v101 - p59.second();
        let p103 = T::Pair::join(phi_dot_guide, phi_dot_rod_y);
        let p104 = p13 * p103;
        let p105 = p97 + p104;
        let v106 = v91 + p105.first();
        let acc_theta2 = p89.first() * v106;
        let p108 = T::Pair::splat(acc_theta2);
        let p109 = p63 * p108;
        let p110 = p79 - p109;
        let p111 = p3 * p110;
        let p112 = p47 + p111;
        let v113 = v69 * p63.first();
        let v114 = p76.second() - v113;
        let v115 = v114 + p105.second();
        let v116 = p51.first() * acc_theta2;
        let acc_y2 = v115 + v116;
        let v118 = Single::<T>::new(h) * acc_y2;
        let v119 = Single::<T>::new(at.v.y2) + v118;
        let p120 = T::Pair::join(p112.first(), v119);
        let p121 = p46 + p120;
        let p122 = p1 * p121;
        let p123 = p45 + p122;
        let v124 = Single::<T>::new(h) * acc_theta2;
        let v125 = Single::<T>::new(at.v.theta2) + v124;
        let v126 = Single::<T>::new(at.v.theta2) + v125;
        let v127 = Single::<T>::new(half_h) * v126;
        let v128 = Single::<T>::new(at.q.theta2) + v127;
        let v129 = Single::<T>::new(at.v.x3) + p112.second();
        let v130 = Single::<T>::new(half_h) * v129;
        let v131 = Single::<T>::new(at.q.x3) + v130;
        let p132 = p3 * p2;
        let p133 = p0 + p132;
        let p134 = T::Pair::join(cosines86.first(), sines86.first());
        let p135 = p5 * p134;
        let p136 = p133 - p135;
        let p137 = p4 * p136;
        let p138 = T::Pair::splat(v41);
        let p139 = p138.flip();
        let p140 = p135.swap();
        let p141 = p139 * p140;
        let p142 = p36 + p141;
        let p143 = p13 * p142;
        let p144 = p137 + p143;
        let v145 = v41 - Single::<T>::new(self.parameters.omega);
        let v146 = Single::<T>::new(gains.minus_two_alpha) * v145;
        let v147 = Single::<T>::new(t_next) * Single::<T>::new(self.parameters.omega);
        let v148 = v82 - v147;
        let v149 = Single::<T>::new(gains.minus_beta_squared) * v148;
        let v150 = v146 + v149;
        let p151 = T::Pair::splat(v150);
        let p152 = p151.flip();
        let p153 = p152 * p140;
        let v154 = v41 * v41;
        let p155 = T::Pair::splat(v154);
        let p156 = p155 * p135;
        let p157 = p153 + p156;
        let p158 = p144 - p157;
        let p159 = p34 + p158;
        let p160 = p1 * p159;
        let p161 = p2 + p160;
        let v162 = feedback_crank_speed + v150;
        let v163 = Single::<T>::new(half_h) * v162;
        let v164 = Single::<T>::new(at.v.theta1) + v163;
        let p165 = p3 * p47;
        let p166 = p48 + p165;
        let p167 = T::Pair::splat(cosines86.second());
        let p168 = p49 * p167;
        let p169 = p166 - p168;
        let p170 = T::Pair::join(sines86.first(), cosines86.first());
        let p171 = p53 * p170;
        let p172 = T::Pair::splat(p171.second());
        let p173 = p169 - p172;
        let p174 = p4 * p173;
        let p175 = p138 * p171;
        let p176 = T::Pair::splat(p175.first());
        let p177 = T::Pair::splat(v125);
        let p178 = T::Pair::splat(sines86.second());
        let p179 = p49 * p178;
        let p180 = p177 * p179;
        let p181 = p112 + p180;
        let p182 = p176 + p181;
        let p183 = p13 * p182;
        let p184 = p174 + p183;
        let v185 = v125 * v125;
        let p186 = T::Pair::splat(v185);
        let p187 = p186 * p168;
        let p188 = p151 * p171;
        let p189 = p155.flip();
        let p190 = p171.swap();
        let p191 = p189 * p190;
        let p192 = p188 + p191;
        let p193 = T::Pair::splat(p192.first());
        let p194 = p187 + p193;
        let p195 = p184 - p194;
        let v196 = v185 * p179.second();
        let v197 = v196 - p192.second();
        let v198 = Single::<T>::new(h) * Single::<T>::new(at.v.y2);
        let v199 = Single::<T>::new(at.q.y2) + v198;
        let v200 = v199 - p179.first();
        let p201 = T::Pair::join(p179.second(), v200);
        let p202 = T::Pair::splat(p171.first());
        let p203 = p202.flip();
        let p204 = p201 + p203;
        let p205 = p4 * p204;
        let v206 = v125 * p168.second();
        let v207 = v206 + p175.second();
        let v208 = v125 * p168.first();
        let v209 = v119 - v208;
        let v210 = v209 - p175.second();
        let p211 = T::Pair::join(v207, v210);
        let p212 = p13 * p211;
        let p213 = p205 + p212;
        let v214 = v197 + p213.first();
        let v215 = p89.second() * v214;
        let p216 = T::Pair::splat(v215);
        let p217 = p179 * p216;
        let p218 = p195 - p217;
        let p219 = p110 + p218;
        let v220 = v185 * p179.first();
        let v221 = p192.second() - v220;
        let v222 = v221 + p213.second();
        let v223 = p168.first() * v215;
        let v224 = v222 + v223;
        let v225 = acc_y2 + v224;
        let p226 = T::Pair::join(p219.first(), v225);
        let p227 = p1 * p226;
        let p228 = p46 + p227;
        let v229 = acc_theta2 + v215;
        let v230 = Single::<T>::new(half_h) * v229;
        let v231 = Single::<T>::new(at.v.theta2) + v230;
        let v232 = Single::<T>::new(half_h) * p219.second();
        let v233 = Single::<T>::new(at.v.x3) + v232;
        let v234 = -p32.first();
        let v235 = -p32.second();
        let v236 = Single::<T>::new(self.parameters.l2) * v69;
        let v237 = v236 * cosines7.second();
        let v238 = -v237;
        let v239 = -p71.first();
        let p240 = T::Pair::join(v238, v239);
        let p241 = T::Pair::splat(p75.first());
        let p242 = p240 - p241;
        let p243 = p63.swap();
        let p244 = p75.flip();
        let v245 = -p244.second();
        let v246 = v90 - v245;
        let v247 = p89.first() * v246;
        let p248 = T::Pair::splat(v247);
        let p249 = p243 * p248;
        let acc_x2 = p242.second() - p249.second();
        let v251 = p51.first() * v247;
        let v252 = v113 - v245;
        let v253 = v251 - v252;
        let acc_x3 = p242.first() - p249.first();
        let p255 = T::Pair::splat(Single::<T>::new(self.hoisted[12]));
        let p256 = p255 * p89;
        let v257 = Single::<T>::new(p256.first().get().abs());
        let v258 = Single::<T>::new(p256.second().get().abs());
        let v259 = v257 + v258;
        let v260 = Single::<T>::new(self.parameters.m1) * v234;
        let lambda_crank_x = -v260;
        let v262 = Single::<T>::new(self.parameters.m1) * v235;
        let v263 = Single::<T>::new(self.hoisted[4]) + v262;
        let lambda_crank_y = -v263;
        let v265 = Single::<T>::new(self.parameters.m2) * v252;
        let v266 = v265 - Single::<T>::new(self.hoisted[5]);
        let v267 = Single::<T>::new(self.parameters.m2) * v251;
        let lambda_rod_y = v266 - v267;
        let v269 = p55.second() * lambda_rod_y;
        let p270 = T::Pair::join(
            Single::<T>::new(self.parameters.m3),
            Single::<T>::new(self.parameters.m2),
        );
        let p271 = p270 * p249;
        let p272 = p270 * p242;
        let p273 = p271 - p272;
        let p274 = p94 * p273;
        let v275 = v269 - p274.first();
        let v276 = p10.second() * v260;
        let v277 = p10.first() * lambda_crank_y;
        let v278 = v276 + v277;
        let v279 = v278 - p274.second();
        let v280 = v275 + v279;
        let v281 = p51.first() * v266;
        let v282 = p63.first() * p272.second();
        let v283 = p63.second() * p272.first();
        let v284 = Single::<T>::new(self.hoisted[14]) * sines7.second();
        let v285 = sines7.second() * v284;
        let v286 = Single::<T>::new(self.hoisted[13]) + v285;
        let v287 = v286 * v247;
        let v288 = v283 - v287;
        let v289 = v282 + v288;
        let v290 = v281 + v289;
        let lambda_guide = p89.first() * v290;
        let v292 = p55.second() * lambda_guide;
        let v293 = v280 - v292;
        let p294 = p39 + p123;
        let p295 = p294 + p161;
        let p296 = p295 + p228;
        let v297 = v44 + v128;
        let v298 = v297 + v131;
        let v299 = v298 + v164;
        let v300 = v299 + v231;
        let v301 = v300 + v233;
        let v302 = v301 + v234;
        let v303 = v302 + v235;
        let v304 = v303 + Single::<T>::new(T::from_f64(0.0));
        let v305 = v304 + acc_x2;
        let v306 = v305 + v253;
        let v307 = v306 + v247;
        let v308 = v307 + acc_x3;
        let v309 = v308 + p296.first();
        let v310 = v309 + p296.second();
        (
            ::mbs_runtime::Stepped {
                next: ::mbs_runtime::State {
                    t: t_next,
                    q: SliderCrankCoordinates {
                        x1: p39.first().get(),
                        y1: p39.second().get(),
                        theta1: v44.get(),
                        x2: p123.first().get(),
                        y2: p123.second().get(),
                        theta2: v128.get(),
                        x3: v131.get(),
                    },
                    v: SliderCrankCoordinates {
                        x1: p161.first().get(),
                        y1: p161.second().get(),
                        theta1: v164.get(),
                        x2: p228.first().get(),
                        y2: p228.second().get(),
                        theta2: v231.get(),
                        x3: v233.get(),
                    },
                },
                growth: v259.get(),
                sum: v310.get(),
            },
            ::mbs_runtime::Reactions {
                acceleration: SliderCrankCoordinates {
                    x1: v234.get(),
                    y1: v235.get(),
                    theta1: Single::<T>::new(T::from_f64(0.0)).get(),
                    x2: acc_x2.get(),
                    y2: v253.get(),
                    theta2: v247.get(),
                    x3: acc_x3.get(),
                },
                multipliers: SliderCrankConstraints {
                    crank_x: lambda_crank_x.get(),
                    crank_y: lambda_crank_y.get(),
                    crank_speed: v293.get(),
                    rod_x: p273.second().get(),
                    rod_y: lambda_rod_y.get(),
                    guide: lambda_guide.get(),
                    slider: p273.first().get(),
                },
                growth: v257.get(),
            },
        )
    }
}
#[allow(unused_variables, clippy::all)]
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Mechanism for SliderCrank<T> {
    type Real = T;
    type Over<Scalar: ::mbs_runtime::Real> = SliderCrank<Scalar>;
    type Parameters = SliderCrankParameters<T>;
    type Inputs = ::mbs_runtime::NoComponents<T>;
    type Coordinates = SliderCrankCoordinates<T>;
    type Constraints = SliderCrankConstraints<T>;
    type Outputs = SliderCrankOutputs<T>;
    type Points = [[T; 2]; 9];
    const INFO: &'static ::mbs_runtime::Info = &::mbs_runtime::Info::from_parts(
        "SliderCrank",
        "Slider-crank driven at constant speed.",
        0,
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
                doc: "Moment of inertia of crank and rod about their middles over m l²:\n1/12 for slender rods, 0 for point masses. The paper's torques come\nout with 1/3.",
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
                doc: "Speed of the crank.",
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
        &[],
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
                name: "drive_torque",
                doc: "Torque that keeps the crank at its speed.",
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
                name: "crank_speed",
                doc: "The crank turns at constant speed.",
                formula: "theta1 - omega*t",
                is_drive: true,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 0i8,
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
                    mul: 17u32,
                    add: 1u32,
                    div: 1u32,
                    sin_cos: 0u32,
                    other: 1u32,
                    watch: 0u32,
                },
                written: 20u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "phi",
                operations: ::mbs_runtime::Operations {
                    mul: 9u32,
                    add: 10u32,
                    div: 0u32,
                    sin_cos: 2u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 23u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "phi_dot",
                operations: ::mbs_runtime::Operations {
                    mul: 12u32,
                    add: 10u32,
                    div: 0u32,
                    sin_cos: 2u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 26u32,
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
                    add: 1u32,
                    div: 0u32,
                    sin_cos: 0u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 1u32,
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
                    mul: 43u32,
                    add: 37u32,
                    div: 0u32,
                    sin_cos: 2u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 84u32,
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
                    mul: 49u32,
                    add: 44u32,
                    div: 1u32,
                    sin_cos: 2u32,
                    other: 0u32,
                    watch: 2u32,
                },
                written: 100u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "constrained",
                operations: ::mbs_runtime::Operations {
                    mul: 26u32,
                    add: 17u32,
                    div: 1u32,
                    sin_cos: 2u32,
                    other: 0u32,
                    watch: 2u32,
                },
                written: 50u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "reactions",
                operations: ::mbs_runtime::Operations {
                    mul: 48u32,
                    add: 34u32,
                    div: 1u32,
                    sin_cos: 2u32,
                    other: 0u32,
                    watch: 2u32,
                },
                written: 89u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "position_correction",
                operations: ::mbs_runtime::Operations {
                    mul: 12u32,
                    add: 9u32,
                    div: 1u32,
                    sin_cos: 2u32,
                    other: 0u32,
                    watch: 2u32,
                },
                written: 28u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "velocity_correction",
                operations: ::mbs_runtime::Operations {
                    mul: 12u32,
                    add: 9u32,
                    div: 1u32,
                    sin_cos: 2u32,
                    other: 0u32,
                    watch: 2u32,
                },
                written: 28u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "outputs",
                operations: ::mbs_runtime::Operations {
                    mul: 0u32,
                    add: 1u32,
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
                of: "crank_speed",
                of_latex: "\\mathrm{crank\\_speed}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "theta1 - omega*t",
                latex: "\\theta_{1} - \\omega \\, t",
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
                of: "crank_speed",
                of_latex: "\\mathrm{crank\\_speed}",
                by: "theta1",
                by_latex: "\\theta_{1}",
                text: "1",
                latex: "1",
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
        phi_t: &[
            ::mbs_runtime::Formula {
                of: "crank_speed",
                of_latex: "\\mathrm{crank\\_speed}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "-omega",
                latex: "-\\omega",
            },
        ],
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
                of: "crank_speed",
                of_latex: "\\mathrm{crank\\_speed}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "der(theta1) - omega",
                latex: "\\dot{\\theta_{1}} - \\omega",
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
                unknowns: &["lambda(crank_speed)", "theta1"],
                pivot: "1",
                latex: "1",
                is_watched: false,
            },
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
                unknowns: &["lambda(guide)", "theta2"],
                pivot: "l2*cos(theta2)",
                latex: "l_{2} \\, \\cos \\theta_{2}",
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
        parameters: SliderCrankParameters<T>,
    ) -> ::core::result::Result<Self, ::mbs_runtime::Error> {
        Self::new(parameters)
    }
    fn parameters(&self) -> &SliderCrankParameters<T> {
        &self.parameters
    }
    #[inline(always)]
    fn hoisted(&self) -> &[T] {
        &self.hoisted
    }
    #[inline(always)]
    fn from_hoisted(
        parameters: SliderCrankParameters<T>,
        hoisted: impl ::core::ops::FnMut(::core::primitive::usize) -> T,
    ) -> Self {
        Self {
            parameters,
            hoisted: ::core::array::from_fn(hoisted),
        }
    }
    fn declared_start(&self) -> ::mbs_runtime::State<SliderCrankCoordinates<T>> {
        let v0 = T::from_f64(0.5) * self.parameters.l1;
        let v1 = T::from_f64(0.5) * self.parameters.l2;
        let v2 = self.parameters.l1 + v1;
        let v3 = self.parameters.l2 + self.parameters.l1;
        ::mbs_runtime::State {
            t: T::from_f64(0.0),
            q: SliderCrankCoordinates {
                x1: v0,
                y1: T::from_f64(0.0),
                theta1: T::from_f64(0.0),
                x2: v2,
                y2: T::from_f64(0.0),
                theta2: T::from_f64(0.0),
                x3: v3,
            },
            v: SliderCrankCoordinates {
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
    fn phi(&self, t: T, q: &SliderCrankCoordinates<T>) -> SliderCrankConstraints<T> {
        Self::phi(self, t, q)
    }
    #[inline(always)]
    fn phi_dot(
        &self,
        at: &::mbs_runtime::State<SliderCrankCoordinates<T>>,
    ) -> SliderCrankConstraints<T> {
        Self::phi_dot(self, at)
    }
    #[inline(always)]
    fn stabilized(
        &self,
        at: &::mbs_runtime::State<SliderCrankCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        gains: &::mbs_runtime::Gains<T>,
    ) -> ::mbs_runtime::Stabilized<
        SliderCrankCoordinates<T>,
        SliderCrankConstraints<T>,
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
        let phi_dot_crank_speed = at.v.theta1 - self.parameters.omega;
        let v15 = gains.minus_two_alpha * phi_dot_crank_speed;
        let v16 = at.t * self.parameters.omega;
        let phi_crank_speed = at.q.theta1 - v16;
        let v18 = gains.minus_beta_squared * phi_crank_speed;
        let feedback_crank_speed = v15 + v18;
        let v20 = feedback_crank_speed * v7;
        let v21 = v20 + v13;
        let acc_x1 = feedback_crank_x - v21;
        let v23 = at.v.theta1 * v4;
        let phi_dot_crank_y = at.v.y1 - v23;
        let v25 = gains.minus_two_alpha * phi_dot_crank_y;
        let phi_crank_y = at.q.y1 - v7;
        let v27 = gains.minus_beta_squared * phi_crank_y;
        let feedback_crank_y = v27 + v25;
        let v29 = feedback_crank_speed * v4;
        let v30 = v12 * v7;
        let v31 = v29 - v30;
        let acc_y1 = v31 + feedback_crank_y;
        let v33 = self.parameters.l1 * sin_theta1;
        let v34 = at.v.theta1 * v33;
        let v35 = self.hoisted[1] * sin_theta2;
        let v36 = at.v.theta2 * v35;
        let v37 = at.v.x2 + v36;
        let phi_dot_rod_x = v34 + v37;
        let v39 = gains.minus_two_alpha * phi_dot_rod_x;
        let v40 = self.parameters.l1 * cos_theta1;
        let v41 = self.hoisted[1] * cos_theta2;
        let v42 = at.q.x2 - v41;
        let phi_rod_x = v42 - v40;
        let v44 = gains.minus_beta_squared * phi_rod_x;
        let feedback_rod_x = v44 + v39;
        let v46 = at.v.theta2 * at.v.theta2;
        let v47 = v46 * v41;
        let v48 = v12 * v40;
        let v49 = feedback_crank_speed * v33;
        let v50 = v49 + v48;
        let v51 = v47 + v50;
        let v52 = feedback_rod_x - v51;
        let v53 = self.hoisted[11] / cos_theta2;
        let v54 = at.v.theta1 * v40;
        let v55 = self.parameters.l2 * cos_theta2;
        let v56 = at.v.theta2 * v55;
        let phi_dot_guide = v56 + v54;
        let v58 = gains.minus_two_alpha * phi_dot_guide;
        let v59 = self.parameters.l2 * sin_theta2;
        let phi_guide = v59 + v33;
        let v61 = gains.minus_beta_squared * phi_guide;
        let feedback_guide = v61 + v58;
        let v63 = v46 * v59;
        let v64 = feedback_crank_speed * v40;
        let v65 = v12 * v33;
        let v66 = v64 - v65;
        let v67 = v63 - v66;
        let v68 = v67 + feedback_guide;
        let acc_theta2 = v53 * v68;
        let v70 = v35 * acc_theta2;
        let acc_x2 = v52 - v70;
        let v72 = at.v.theta2 * v41;
        let v73 = at.v.y2 - v72;
        let phi_dot_rod_y = v73 - v54;
        let v75 = gains.minus_two_alpha * phi_dot_rod_y;
        let v76 = at.q.y2 - v35;
        let phi_rod_y = v76 - v33;
        let v78 = gains.minus_beta_squared * phi_rod_y;
        let feedback_rod_y = v78 + v75;
        let v80 = v46 * v35;
        let v81 = v66 - v80;
        let v82 = v81 + feedback_rod_y;
        let v83 = v41 * acc_theta2;
        let acc_y2 = v82 + v83;
        let v85 = at.v.theta2 * v59;
        let v86 = at.v.x3 + v85;
        let phi_dot_slider = v34 + v86;
        let v88 = gains.minus_two_alpha * phi_dot_slider;
        let v89 = at.q.x3 - v55;
        let phi_slider = v89 - v40;
        let v91 = gains.minus_beta_squared * phi_slider;
        let feedback_slider = v91 + v88;
        let v93 = v46 * v55;
        let v94 = v93 + v50;
        let v95 = feedback_slider - v94;
        let v96 = v59 * acc_theta2;
        let acc_x3 = v95 - v96;
        let v98 = self.hoisted[12] * v53;
        let abs_v98 = v98.abs();
        ::mbs_runtime::Stabilized {
            acceleration: SliderCrankCoordinates {
                x1: acc_x1,
                y1: acc_y1,
                theta1: feedback_crank_speed,
                x2: acc_x2,
                y2: acc_y2,
                theta2: acc_theta2,
                x3: acc_x3,
            },
            feedback: SliderCrankConstraints {
                crank_x: feedback_crank_x,
                crank_y: feedback_crank_y,
                crank_speed: feedback_crank_speed,
                rod_x: feedback_rod_x,
                rod_y: feedback_rod_y,
                guide: feedback_guide,
                slider: feedback_slider,
            },
            growth: abs_v98,
        }
    }
    #[inline(always)]
    fn constrained(
        &self,
        at: &::mbs_runtime::State<SliderCrankCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        feedback: &SliderCrankConstraints<T>,
    ) -> ::mbs_runtime::Accelerations<SliderCrankCoordinates<T>> {
        let (sin_theta1, cos_theta1) = at.q.theta1.sin_cos();
        let (sin_theta2, cos_theta2) = at.q.theta2.sin_cos();
        let v4 = at.v.theta1 * at.v.theta1;
        let v5 = v4 * cos_theta1;
        let v6 = self.hoisted[0] * v5;
        let v7 = feedback.crank_speed * sin_theta1;
        let v8 = self.hoisted[0] * v7;
        let v9 = feedback.crank_x - v8;
        let acc_x1 = v9 - v6;
        let v11 = feedback.crank_speed * cos_theta1;
        let v12 = self.hoisted[0] * v11;
        let v13 = v4 * sin_theta1;
        let v14 = self.hoisted[0] * v13;
        let v15 = feedback.crank_y - v14;
        let acc_y1 = v12 + v15;
        let v17 = at.v.theta2 * at.v.theta2;
        let v18 = self.hoisted[1] * cos_theta2;
        let v19 = v17 * v18;
        let v20 = self.parameters.l1 * v5;
        let v21 = self.parameters.l1 * v7;
        let v22 = v21 + v20;
        let v23 = feedback.rod_x - v19;
        let v24 = v23 - v22;
        let v25 = self.hoisted[11] / cos_theta2;
        let v26 = self.parameters.l2 * sin_theta2;
        let v27 = v17 * v26;
        let v28 = self.parameters.l1 * v11;
        let v29 = self.parameters.l1 * v13;
        let v30 = v28 - v29;
        let v31 = feedback.guide + v27;
        let v32 = v31 - v30;
        let acc_theta2 = v25 * v32;
        let v34 = self.hoisted[1] * sin_theta2;
        let v35 = v34 * acc_theta2;
        let acc_x2 = v24 - v35;
        let v37 = v17 * v34;
        let v38 = feedback.rod_y - v37;
        let v39 = v38 + v30;
        let v40 = v18 * acc_theta2;
        let acc_y2 = v39 + v40;
        let v42 = self.parameters.l2 * v17;
        let v43 = v42 * cos_theta2;
        let v44 = feedback.slider - v43;
        let v45 = v44 - v22;
        let v46 = v26 * acc_theta2;
        let acc_x3 = v45 - v46;
        let v48 = self.hoisted[12] * v25;
        let abs_v48 = v48.abs();
        ::mbs_runtime::Accelerations {
            acceleration: SliderCrankCoordinates {
                x1: acc_x1,
                y1: acc_y1,
                theta1: feedback.crank_speed,
                x2: acc_x2,
                y2: acc_y2,
                theta2: acc_theta2,
                x3: acc_x3,
            },
            growth: abs_v48,
        }
    }
    #[inline(always)]
    fn reactions(
        &self,
        at: &::mbs_runtime::State<SliderCrankCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        feedback: &SliderCrankConstraints<T>,
    ) -> ::mbs_runtime::Reactions<SliderCrankCoordinates<T>, SliderCrankConstraints<T>> {
        let (sin_theta1, cos_theta1) = at.q.theta1.sin_cos();
        let (sin_theta2, cos_theta2) = at.q.theta2.sin_cos();
        let v4 = at.v.theta1 * at.v.theta1;
        let v5 = self.hoisted[0] * cos_theta1;
        let v6 = v4 * v5;
        let v7 = self.hoisted[0] * sin_theta1;
        let v8 = feedback.crank_speed * v7;
        let v9 = feedback.crank_x - v8;
        let acc_x1 = v9 - v6;
        let v11 = feedback.crank_speed * v5;
        let v12 = v4 * v7;
        let v13 = feedback.crank_y - v12;
        let acc_y1 = v11 + v13;
        let v15 = at.v.theta2 * at.v.theta2;
        let v16 = self.hoisted[1] * cos_theta2;
        let v17 = v15 * v16;
        let v18 = self.parameters.l1 * cos_theta1;
        let v19 = v4 * v18;
        let v20 = self.parameters.l1 * sin_theta1;
        let v21 = feedback.crank_speed * v20;
        let v22 = v21 + v19;
        let v23 = feedback.rod_x - v17;
        let v24 = v23 - v22;
        let v25 = self.hoisted[11] / cos_theta2;
        let v26 = self.parameters.l2 * sin_theta2;
        let v27 = v15 * v26;
        let v28 = feedback.crank_speed * v18;
        let v29 = v4 * v20;
        let v30 = v28 - v29;
        let v31 = feedback.guide + v27;
        let v32 = v31 - v30;
        let acc_theta2 = v25 * v32;
        let v34 = self.hoisted[1] * sin_theta2;
        let v35 = v34 * acc_theta2;
        let acc_x2 = v24 - v35;
        let v37 = v15 * v34;
        let v38 = v37 - feedback.rod_y;
        let v39 = v38 - v30;
        let v40 = v16 * acc_theta2;
        let acc_y2 = v40 - v39;
        let v42 = self.parameters.l2 * v15;
        let v43 = v42 * cos_theta2;
        let v44 = feedback.slider - v43;
        let v45 = v44 - v22;
        let v46 = v26 * acc_theta2;
        let acc_x3 = v45 - v46;
        let v48 = self.parameters.m1 * acc_x1;
        let lambda_crank_x = -v48;
        let v50 = self.parameters.m1 * acc_y1;
        let v51 = self.hoisted[4] + v50;
        let lambda_crank_y = -v51;
        let v53 = self.hoisted[2] * feedback.crank_speed;
        let v54 = v5 * lambda_crank_y;
        let v55 = self.parameters.m2 * v39;
        let v56 = v55 - self.hoisted[5];
        let v57 = v16 * v56;
        let v58 = self.parameters.m2 * v24;
        let v59 = v34 * v58;
        let v60 = self.parameters.m3 * v45;
        let v61 = v26 * v60;
        let v62 = self.hoisted[14] * sin_theta2;
        let v63 = sin_theta2 * v62;
        let v64 = self.hoisted[13] + v63;
        let v65 = v64 * acc_theta2;
        let v66 = v61 - v65;
        let v67 = v59 + v66;
        let v68 = v57 + v67;
        let lambda_guide = v25 * v68;
        let v70 = v18 * lambda_guide;
        let v71 = self.parameters.m2 * v40;
        let lambda_rod_y = v56 - v71;
        let v73 = v18 * lambda_rod_y;
        let v74 = v7 * v48;
        let v75 = self.parameters.m3 * v46;
        let lambda_slider = v75 - v60;
        let v77 = v20 * lambda_slider;
        let v78 = self.parameters.m2 * v35;
        let lambda_rod_x = v78 - v58;
        let v80 = v20 * lambda_rod_x;
        let v81 = v74 + v54;
        let v82 = v81 - v80;
        let v83 = v73 - v77;
        let v84 = v83 + v82;
        let v85 = v84 - v70;
        let lambda_crank_speed = v85 - v53;
        let v87 = self.hoisted[12] * v25;
        let abs_v87 = v87.abs();
        ::mbs_runtime::Reactions {
            acceleration: SliderCrankCoordinates {
                x1: acc_x1,
                y1: acc_y1,
                theta1: feedback.crank_speed,
                x2: acc_x2,
                y2: acc_y2,
                theta2: acc_theta2,
                x3: acc_x3,
            },
            multipliers: SliderCrankConstraints {
                crank_x: lambda_crank_x,
                crank_y: lambda_crank_y,
                crank_speed: lambda_crank_speed,
                rod_x: lambda_rod_x,
                rod_y: lambda_rod_y,
                guide: lambda_guide,
                slider: lambda_slider,
            },
            growth: abs_v87,
        }
    }
    fn position_correction(
        &self,
        t: T,
        q: &SliderCrankCoordinates<T>,
        feedback: &SliderCrankConstraints<T>,
    ) -> ::mbs_runtime::Accelerations<SliderCrankCoordinates<T>> {
        let (sin_theta1, cos_theta1) = q.theta1.sin_cos();
        let (sin_theta2, cos_theta2) = q.theta2.sin_cos();
        let v4 = feedback.crank_speed * sin_theta1;
        let v5 = self.hoisted[0] * v4;
        let v6 = feedback.crank_x - v5;
        let v7 = feedback.crank_speed * cos_theta1;
        let v8 = self.hoisted[0] * v7;
        let v9 = feedback.crank_y + v8;
        let v10 = self.parameters.l1 * v4;
        let v11 = feedback.rod_x - v10;
        let v12 = self.hoisted[11] / cos_theta2;
        let v13 = self.parameters.l1 * v7;
        let v14 = feedback.guide - v13;
        let v15 = v14 * v12;
        let v16 = sin_theta2 * v15;
        let v17 = self.hoisted[1] * v16;
        let v18 = v11 - v17;
        let v19 = feedback.rod_y + v13;
        let v20 = self.hoisted[1] * cos_theta2;
        let v21 = v20 * v15;
        let v22 = v19 + v21;
        let v23 = feedback.slider - v10;
        let v24 = self.parameters.l2 * v16;
        let v25 = v23 - v24;
        let v26 = self.hoisted[12] * v12;
        let abs_v26 = v26.abs();
        ::mbs_runtime::Accelerations {
            acceleration: SliderCrankCoordinates {
                x1: v6,
                y1: v9,
                theta1: feedback.crank_speed,
                x2: v18,
                y2: v22,
                theta2: v15,
                x3: v25,
            },
            growth: abs_v26,
        }
    }
    fn velocity_correction(
        &self,
        t: T,
        q: &SliderCrankCoordinates<T>,
        feedback: &SliderCrankConstraints<T>,
    ) -> ::mbs_runtime::Accelerations<SliderCrankCoordinates<T>> {
        let (sin_theta1, cos_theta1) = q.theta1.sin_cos();
        let (sin_theta2, cos_theta2) = q.theta2.sin_cos();
        let v4 = feedback.crank_speed * sin_theta1;
        let v5 = self.hoisted[0] * v4;
        let v6 = feedback.crank_x - v5;
        let v7 = feedback.crank_speed * cos_theta1;
        let v8 = self.hoisted[0] * v7;
        let v9 = feedback.crank_y + v8;
        let v10 = self.parameters.l1 * v4;
        let v11 = feedback.rod_x - v10;
        let v12 = self.hoisted[11] / cos_theta2;
        let v13 = self.parameters.l1 * v7;
        let v14 = feedback.guide - v13;
        let v15 = v14 * v12;
        let v16 = sin_theta2 * v15;
        let v17 = self.hoisted[1] * v16;
        let v18 = v11 - v17;
        let v19 = feedback.rod_y + v13;
        let v20 = self.hoisted[1] * cos_theta2;
        let v21 = v20 * v15;
        let v22 = v19 + v21;
        let v23 = feedback.slider - v10;
        let v24 = self.parameters.l2 * v16;
        let v25 = v23 - v24;
        let v26 = self.hoisted[12] * v12;
        let abs_v26 = v26.abs();
        ::mbs_runtime::Accelerations {
            acceleration: SliderCrankCoordinates {
                x1: v6,
                y1: v9,
                theta1: feedback.crank_speed,
                x2: v18,
                y2: v22,
                theta2: v15,
                x3: v25,
            },
            growth: abs_v26,
        }
    }
    #[inline(always)]
    fn fused_step<F: ::mbs_runtime::Feedback>(
        &self,
        at: &::mbs_runtime::State<SliderCrankCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        gains: &::mbs_runtime::Gains<T>,
        h: T,
        t_next: T,
    ) -> ::core::option::Option<::mbs_runtime::Stepped<SliderCrankCoordinates<T>>> {
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
        at: &::mbs_runtime::State<SliderCrankCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        gains: &::mbs_runtime::Gains<T>,
        h: T,
        t_next: T,
    ) -> ::core::option::Option<
        (
            ::mbs_runtime::Stepped<SliderCrankCoordinates<T>>,
            ::mbs_runtime::Reactions<
                SliderCrankCoordinates<T>,
                SliderCrankConstraints<T>,
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
        q: &SliderCrankCoordinates<T>,
    ) -> ::core::option::Option<(::core::primitive::usize, T)> {
        let cos_theta2 = q.theta2.cos();
        let v1 = self.hoisted[11] / cos_theta2;
        let v2 = self.hoisted[12] * v1;
        let abs_v2 = v2.abs();
        ::mbs_runtime::__private::worst(&[abs_v2])
    }
    fn worst_start_pivot(
        &self,
        t: T,
        q: &SliderCrankCoordinates<T>,
    ) -> ::core::option::Option<(::core::primitive::usize, T)> {
        let cos_theta2 = q.theta2.cos();
        let v1 = self.hoisted[11] / cos_theta2;
        let v2 = self.hoisted[12] * v1;
        let abs_v2 = v2.abs();
        ::mbs_runtime::__private::worst(&[abs_v2])
    }
    #[inline(always)]
    fn kinetic_energy(&self, at: &::mbs_runtime::State<SliderCrankCoordinates<T>>) -> T {
        Self::kinetic_energy(self, at)
    }
    #[inline(always)]
    fn potential_energy(
        &self,
        at: &::mbs_runtime::State<SliderCrankCoordinates<T>>,
    ) -> T {
        Self::potential_energy(self, at)
    }
    #[inline(always)]
    fn outputs(
        &self,
        at: &::mbs_runtime::State<SliderCrankCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        reactions: &::mbs_runtime::Reactions<
            SliderCrankCoordinates<T>,
            SliderCrankConstraints<T>,
        >,
    ) -> SliderCrankOutputs<T> {
        let v0 = -reactions.multipliers.crank_speed;
        SliderCrankOutputs {
            drive_torque: v0,
        }
    }
    fn points(&self, t: T, q: &SliderCrankCoordinates<T>) -> [[T; 2]; 9] {
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
