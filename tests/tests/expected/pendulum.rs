/**A point mass on a massless rod.

# Equations

2 coordinates, 1 constraint, 1 degree of freedom. Φ(q, t) = 0 is
```text
rod: 1/2*(x^2 + y^2)/length - 1/2*length = 0
```

# Elimination

Order: constraints first, then what motion they leave free (null space).

```text
x: divided by mass
y: divided by mass
lambda(rod): divided by -((x/length)^2 + (y/length)^2)/mass
```

# Cost

Operations per call:

| function | mul | add | div | sincos | other | pivot watch |
|---|---|---|---|---|---|---|
| `new` | 4 | 0 | 1 | 0 | 0 | 0 |
| `phi` | 3 | 2 | 0 | 0 | 0 | 0 |
| `phi_dot` | 5 | 1 | 0 | 0 | 0 | 0 |
| `phi_q` | 2 | 0 | 0 | 0 | 0 | 0 |
| `phi_t` | 0 | 0 | 0 | 0 | 0 | 0 |
| `gamma` | 5 | 2 | 0 | 0 | 0 | 0 |
| `baumgarte_rhs` | 13 | 6 | 0 | 0 | 0 | 0 |
| `mass` | 0 | 0 | 0 | 0 | 0 | 0 |
| `forces` | 0 | 1 | 0 | 0 | 0 | 0 |
| `kinetic_energy` | 4 | 1 | 0 | 0 | 0 | 0 |
| `potential_energy` | 1 | 0 | 0 | 0 | 0 | 0 |
| `stabilized` | 20 | 9 | 1 | 0 | 0 | 0 |
| `constrained` | 12 | 5 | 1 | 0 | 0 | 0 |
| `reactions` | 13 | 6 | 1 | 0 | 0 | 0 |
| `position_correction` | 1 | 0 | 1 | 0 | 0 | 0 |
| `velocity_correction` | 6 | 1 | 1 | 0 | 0 | 0 |
| `projection` | 6 | 1 | 1 | 0 | 0 | 0 |
| `outputs` | 4 | 2 | 0 | 0 | 2 | 0 |
*/
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq
)]
pub struct Pendulum<T = ::core::primitive::f64> {
    parameters: PendulumParameters<T>,
    /**What depends on parameters alone, computed once:

```text
0: 1/2*length
1: 1/2*1/length
2: 1/length
3: 9.81*mass
4: 1/2*mass
```
*/
    hoisted: [T; 5usize],
}
impl<T: ::mbs_runtime::Real> ::core::default::Default for Pendulum<T> {
    /// The mechanism with its declared parameters.
    fn default() -> Self {
        Self::prepare(<PendulumParameters<T> as ::core::default::Default>::default())
    }
}
///Parameters of [`Pendulum`], in SI units; the default is the declaration.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq
)]
pub struct PendulumParameters<T = ::core::primitive::f64> {
    /**Length of the rod.

`length`: a length [m], declared as 1 m = 1 in SI units.*/
    pub length: T,
    /**Mass of the bob.

`mass`: a mass [kg], declared as 1 kg = 1 in SI units.*/
    pub mass: T,
}
impl<T: ::mbs_runtime::Real> ::core::default::Default for PendulumParameters<T> {
    #[allow(clippy::approx_constant)]
    fn default() -> Self {
        Self {
            length: T::from_f64(1.0),
            mass: T::from_f64(1.0),
        }
    }
}
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Components for PendulumParameters<T> {
    type Real = T;
    type Array = [T; 2];
    const NAMES: &'static [&'static ::core::primitive::str] = &["length", "mass"];
    #[inline(always)]
    fn into_array(self) -> [T; 2] {
        [self.length, self.mass]
    }
    #[inline(always)]
    fn from_array(array: [T; 2]) -> Self {
        Self {
            length: array[0],
            mass: array[1],
        }
    }
    #[inline(always)]
    fn splat(value: T) -> Self {
        Self { length: value, mass: value }
    }
}
impl<T: ::mbs_runtime::Real> ::core::convert::From<PendulumParameters<T>>
for ::mbs_runtime::__private::nalgebra::SVector<T, 2> {
    fn from(components: PendulumParameters<T>) -> Self {
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
///Coordinates of [`Pendulum`], or their rates, in SI units.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq
)]
pub struct PendulumCoordinates<T = ::core::primitive::f64> {
    ///`x`: a length [m].
    pub x: T,
    ///`y`: a length [m].
    pub y: T,
}
impl<T: ::mbs_runtime::Real> ::core::default::Default for PendulumCoordinates<T> {
    #[allow(clippy::approx_constant)]
    fn default() -> Self {
        Self {
            x: T::from_f64(0.0),
            y: T::from_f64(0.0),
        }
    }
}
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Components for PendulumCoordinates<T> {
    type Real = T;
    type Array = [T; 2];
    const NAMES: &'static [&'static ::core::primitive::str] = &["x", "y"];
    #[inline(always)]
    fn into_array(self) -> [T; 2] {
        [self.x, self.y]
    }
    #[inline(always)]
    fn from_array(array: [T; 2]) -> Self {
        Self { x: array[0], y: array[1] }
    }
    #[inline(always)]
    fn splat(value: T) -> Self {
        Self { x: value, y: value }
    }
}
impl<T: ::mbs_runtime::Real> ::core::convert::From<PendulumCoordinates<T>>
for ::mbs_runtime::__private::nalgebra::SVector<T, 2> {
    fn from(components: PendulumCoordinates<T>) -> Self {
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
///One component per constraint of [`Pendulum`]: Φ, its derivatives, or the multipliers λ.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq
)]
pub struct PendulumConstraints<T = ::core::primitive::f64> {
    /**The rod keeps its length.

`1/2*(x^2 + y^2)/length - 1/2*length = 0`*/
    pub rod: T,
}
impl<T: ::mbs_runtime::Real> ::core::default::Default for PendulumConstraints<T> {
    #[allow(clippy::approx_constant)]
    fn default() -> Self {
        Self { rod: T::from_f64(0.0) }
    }
}
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Components for PendulumConstraints<T> {
    type Real = T;
    type Array = [T; 1];
    const NAMES: &'static [&'static ::core::primitive::str] = &["rod"];
    #[inline(always)]
    fn into_array(self) -> [T; 1] {
        [self.rod]
    }
    #[inline(always)]
    fn from_array(array: [T; 1]) -> Self {
        Self { rod: array[0] }
    }
    #[inline(always)]
    fn splat(value: T) -> Self {
        Self { rod: value }
    }
}
impl<T: ::mbs_runtime::Real> ::core::convert::From<PendulumConstraints<T>>
for ::mbs_runtime::__private::nalgebra::SVector<T, 1> {
    fn from(components: PendulumConstraints<T>) -> Self {
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
///Outputs of [`Pendulum`], in SI units.
#[derive(
    ::core::clone::Clone,
    ::core::marker::Copy,
    ::core::fmt::Debug,
    ::core::cmp::PartialEq
)]
pub struct PendulumOutputs<T = ::core::primitive::f64> {
    /**Force in the rod, positive when it pulls.

`tension`: a force [N].*/
    pub tension: T,
    /**Angle from the lowest position.

`angle`: an angle [rad].*/
    pub angle: T,
}
impl<T: ::mbs_runtime::Real> ::core::default::Default for PendulumOutputs<T> {
    #[allow(clippy::approx_constant)]
    fn default() -> Self {
        Self {
            tension: T::from_f64(0.0),
            angle: T::from_f64(0.0),
        }
    }
}
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Components for PendulumOutputs<T> {
    type Real = T;
    type Array = [T; 2];
    const NAMES: &'static [&'static ::core::primitive::str] = &["tension", "angle"];
    #[inline(always)]
    fn into_array(self) -> [T; 2] {
        [self.tension, self.angle]
    }
    #[inline(always)]
    fn from_array(array: [T; 2]) -> Self {
        Self {
            tension: array[0],
            angle: array[1],
        }
    }
    #[inline(always)]
    fn splat(value: T) -> Self {
        Self {
            tension: value,
            angle: value,
        }
    }
}
impl<T: ::mbs_runtime::Real> ::core::convert::From<PendulumOutputs<T>>
for ::mbs_runtime::__private::nalgebra::SVector<T, 2> {
    fn from(components: PendulumOutputs<T>) -> Self {
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
impl Pendulum<::core::primitive::f64> {
    /// The mechanism with its declared parameters, in `f64`.
    ///
    /// For another scalar type, use `default`.
    pub fn declared() -> Self {
        ::core::default::Default::default()
    }
}
impl<T: ::mbs_runtime::Real> Pendulum<T> {
    /// The mechanism with these parameters.
    ///
    /// # Errors
    /// If a parameter is not finite, a mass or an inertia comes out
    /// negative, or a declared condition does not hold.
    pub fn new(
        parameters: PendulumParameters<T>,
    ) -> ::core::result::Result<Self, ::mbs_runtime::Error> {
        ::mbs_runtime::__private::check_finite(&parameters)?;
        #[allow(unused_variables)] #[allow(clippy::all)]
        {
            if !(parameters.length > T::from_f64(0.0)) {
                return ::core::result::Result::Err(::mbs_runtime::Error::Parameter {
                    name: "length",
                    value: (parameters.length).to_f64(),
                    requirement: "`length > 0` has to hold",
                });
            }
            if !(parameters.mass > T::from_f64(0.0)) {
                return ::core::result::Result::Err(::mbs_runtime::Error::Parameter {
                    name: "mass",
                    value: (parameters.mass).to_f64(),
                    requirement: "`mass > 0` has to hold",
                });
            }
            if !(parameters.mass >= T::from_f64(0.0)) {
                return ::core::result::Result::Err(::mbs_runtime::Error::Parameter {
                    name: "mass of bob",
                    value: (parameters.mass).to_f64(),
                    requirement: "it must not be negative",
                });
            }
        }
        ::core::result::Result::Ok(Self::prepare(parameters))
    }
    /// Computes what depends on parameters alone.
    #[allow(unused_variables, clippy::all)]
    fn prepare(parameters: PendulumParameters<T>) -> Self {
        let v0 = T::from_f64(0.5) * parameters.length;
        let v1 = T::from_f64(1.0) / parameters.length;
        let v2 = T::from_f64(0.5) * v1;
        let v3 = T::from_f64(9.81) * parameters.mass;
        let v4 = T::from_f64(0.5) * parameters.mass;
        Self {
            parameters,
            hoisted: [v0, v2, v1, v3, v4],
        }
    }
    /// The parameters.
    pub fn parameters(&self) -> &PendulumParameters<T> {
        &self.parameters
    }
}
impl<T: ::mbs_runtime::Real> Pendulum<T> {
    /// Operations of one evaluation of the right-hand side, the watch over
    /// the pivots included; a step takes one per stage, or less.
    pub const OPERATIONS: ::core::primitive::u32 = 30u32;
    /// The size of the state of a step (time, positions, velocities) in bytes.
    pub const STATE_BYTES: ::core::primitive::usize = ::core::mem::size_of::<
        ::mbs_runtime::State<PendulumCoordinates<T>>,
    >();
    /// A bound of the stack that a step takes, in bytes, in optimized code:
    /// every value of all evaluations of the right-hand side once, four
    /// copies of the state, the inputs and the rows per stage, and 1 KiB for calls.
    pub const STACK_BYTES: ::core::primitive::usize = 60usize
        * ::core::mem::size_of::<T>()
        + 8usize
            * (Self::STATE_BYTES + ::core::mem::size_of::<PendulumConstraints<T>>()
                + ::core::mem::size_of::<::mbs_runtime::NoComponents<T>>()) + 1024;
}
#[allow(unused_variables, clippy::all)]
impl<T: ::mbs_runtime::Real> Pendulum<T> {
    /**Constraints Φ(q, t): 0 where the mechanism is assembled.

```text
rod: 1/2*(x^2 + y^2)/length - 1/2*length
```


Cost: 3 mul + 2 add + 0 div + 0 sincos.*/
    #[inline(always)]
    pub fn phi(&self, t: T, q: &PendulumCoordinates<T>) -> PendulumConstraints<T> {
        let v0 = q.x * q.x;
        let v1 = q.y * q.y;
        let v2 = v1 + v0;
        let v3 = self.hoisted[1] * v2;
        let phi_rod = v3 - self.hoisted[0];
        PendulumConstraints {
            rod: phi_rod,
        }
    }
    /**Partial time derivative Φ_t; velocities satisfy Φ_q v = −Φ_t.

```text
rod: 0
```


Cost: 0 mul + 0 add + 0 div + 0 sincos.*/
    #[inline]
    pub fn phi_t(&self, t: T, q: &PendulumCoordinates<T>) -> PendulumConstraints<T> {
        PendulumConstraints {
            rod: T::from_f64(0.0),
        }
    }
    /// Φ̇ = Φ_q v + Φ_t, the constraint violation in velocities.
    #[inline(always)]
    pub fn phi_dot(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
    ) -> PendulumConstraints<T> {
        let v0 = T::from_f64(2.0) * at.v.x;
        let v1 = at.q.x * v0;
        let v2 = T::from_f64(2.0) * at.v.y;
        let v3 = at.q.y * v2;
        let v4 = v3 + v1;
        let phi_dot_rod = self.hoisted[1] * v4;
        PendulumConstraints {
            rod: phi_dot_rod,
        }
    }
    /**γ = −(Φ_q v)_q v − 2Φ_qt v − Φ_tt, so that Φ_q q̈ = γ (Jiang 2025, Eq. 5).

```text
rod: -1/2*(2*der(x)^2 + 2*der(y)^2)/length
```


Cost: 5 mul + 2 add + 0 div + 0 sincos.*/
    #[inline]
    pub fn gamma(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
    ) -> PendulumConstraints<T> {
        let v0 = T::from_f64(2.0) * at.v.x;
        let v1 = at.v.x * v0;
        let v2 = T::from_f64(2.0) * at.v.y;
        let v3 = at.v.y * v2;
        let v4 = v3 + v1;
        let v5 = self.hoisted[1] * v4;
        let gamma_rod = -v5;
        PendulumConstraints {
            rod: gamma_rod,
        }
    }
    /**γ − 2αΦ̇ − β²Φ, the right-hand side with feedback of the violation (Jiang 2025, Eq. 8); gains in 1/s.

Cost: 13 mul + 6 add + 0 div + 0 sincos.*/
    #[inline]
    pub fn baumgarte_rhs(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        alpha: T,
        beta: T,
    ) -> PendulumConstraints<T> {
        let gains = &::mbs_runtime::Gains {
            minus_two_alpha: -(alpha + alpha),
            minus_beta_squared: -(beta * beta),
        };
        let v0 = T::from_f64(2.0) * at.v.x;
        let v1 = at.v.x * v0;
        let v2 = T::from_f64(2.0) * at.v.y;
        let v3 = at.v.y * v2;
        let v4 = v3 + v1;
        let v5 = self.hoisted[1] * v4;
        let v6 = at.q.x * at.q.x;
        let v7 = at.q.y * at.q.y;
        let v8 = v7 + v6;
        let v9 = self.hoisted[1] * v8;
        let phi_rod = v9 - self.hoisted[0];
        let v11 = gains.minus_beta_squared * phi_rod;
        let v12 = at.q.x * v0;
        let v13 = at.q.y * v2;
        let v14 = v13 + v12;
        let phi_dot_rod = self.hoisted[1] * v14;
        let v16 = gains.minus_two_alpha * phi_dot_rod;
        let v17 = v16 - v5;
        let v18 = v11 + v17;
        PendulumConstraints { rod: v18 }
    }
    /**Jacobian Φ_q, one row per constraint, one column per coordinate. Entries that are not 0:

```text
∂rod/∂x = x/length
∂rod/∂y = y/length
```


Cost: 2 mul + 0 add + 0 div + 0 sincos.*/
    #[inline]
    pub fn phi_q(
        &self,
        t: T,
        q: &PendulumCoordinates<T>,
    ) -> ::mbs_runtime::__private::nalgebra::SMatrix<T, 1usize, 2usize> {
        let phi_q_rod_x = self.hoisted[2] * q.x;
        let phi_q_rod_y = self.hoisted[2] * q.y;
        ::mbs_runtime::__private::nalgebra::SMatrix::from_data(
            ::mbs_runtime::__private::nalgebra::ArrayStorage([
                [phi_q_rod_x],
                [phi_q_rod_y],
            ]),
        )
    }
    /**Mass matrix M. Its diagonal, all that is not 0:

```text
x: mass
y: mass
```


Cost: 0 mul + 0 add + 0 div + 0 sincos.*/
    #[inline]
    pub fn mass(
        &self,
        q: &PendulumCoordinates<T>,
    ) -> ::mbs_runtime::__private::nalgebra::SMatrix<T, 2usize, 2usize> {
        ::mbs_runtime::__private::nalgebra::SMatrix::from_data(
            ::mbs_runtime::__private::nalgebra::ArrayStorage([
                [self.parameters.mass, T::from_f64(0.0)],
                [T::from_f64(0.0), self.parameters.mass],
            ]),
        )
    }
    /**Generalized forces Q: gravity and applied loads.

```text
x: 0
y: -9.81*mass
```


Cost: 0 mul + 1 add + 0 div + 0 sincos.*/
    #[inline]
    pub fn forces(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
    ) -> PendulumCoordinates<T> {
        let v0 = -self.hoisted[3];
        PendulumCoordinates {
            x: T::from_f64(0.0),
            y: v0,
        }
    }
    /**Accelerations q̈ and multipliers λ from M q̈ + Φ_qᵀ λ = Q, Φ_q q̈ = γ, without feedback terms.

In a singular position the result is not finite or its `growth` exceeds the runtime's `growth_limit`.

Cost: 13 mul + 6 add + 1 div + 0 sincos.*/
    #[inline]
    pub fn accelerations(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
    ) -> ::mbs_runtime::Reactions<PendulumCoordinates<T>, PendulumConstraints<T>> {
        let none = <PendulumConstraints<
            T,
        > as ::mbs_runtime::Components>::splat(T::from_f64(0.0));
        ::mbs_runtime::Mechanism::reactions(self, at, inputs, &none)
    }
    /// Kinetic energy ½ vᵀMv in J.
    #[inline(always)]
    pub fn kinetic_energy(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
    ) -> T {
        let v0 = self.hoisted[4] * at.v.x;
        let v1 = at.v.x * v0;
        let v2 = self.hoisted[4] * at.v.y;
        let v3 = at.v.y * v2;
        let v4 = v3 + v1;
        v4
    }
    /// Potential energy of gravity (0 at the origin) and springs in J.
    #[inline(always)]
    pub fn potential_energy(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
    ) -> T {
        let v0 = self.hoisted[3] * at.q.y;
        v0
    }
}
#[allow(unused_variables, clippy::all)]
impl<T: ::mbs_runtime::Real> Pendulum<T> {
    ///A step with feedback held over it.
    #[inline(always)]
    fn step_held(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        gains: &::mbs_runtime::Gains<T>,
        h: T,
        t_next: T,
    ) -> ::mbs_runtime::Stepped<PendulumCoordinates<T>> {
        use ::mbs_runtime::{Octant, Pair as _, Single as _, Term as _};
        type Single<T> = <<T as ::mbs_runtime::Real>::Pair as ::mbs_runtime::Pair<
            T,
        >>::Single;
        type SineTerm<T> = <<T as ::mbs_runtime::Real>::Pair as ::mbs_runtime::Pair<
            T,
        >>::Term;
        let half_h = T::from_f64(0.5) * h;
        let p0 = T::Pair::join(Single::<T>::new(at.v.x), Single::<T>::new(at.v.y));
        let p1 = T::Pair::splat(Single::<T>::new(T::from_f64(2.0)));
        let p2 = T::Pair::join(Single::<T>::new(at.q.x), Single::<T>::new(at.q.y));
        let p3 = p1 * p0;
        let p4 = p2 * p2;
        let p5 = T::Pair::join(Single::<T>::new(at.q.x), Single::<T>::new(at.v.y));
        let p6 = T::Pair::join(Single::<T>::new(at.q.y), Single::<T>::new(at.v.x));
        let p7 = p3.swap();
        let p8 = p5 * p3;
        let p9 = p6 * p7;
        let v10 = p4.second() + p4.first();
        let p11 = p8 + p9;
        let v12 = Single::<T>::new(self.hoisted[1]) * v10;
        let p13 = T::Pair::splat(Single::<T>::new(self.hoisted[2]));
        let p14 = T::Pair::splat(Single::<T>::new(self.hoisted[1]));
        let p15 = p2 * p13;
        let p16 = p14 * p11;
        let phi_rod = v12 - Single::<T>::new(self.hoisted[0]);
        let v18 = Single::<T>::new(T::from_f64(9.81)) * p15.second();
        let v19 = Single::<T>::new(gains.minus_two_alpha) * p16.first();
        let v20 = Single::<T>::new(gains.minus_beta_squared) * phi_rod;
        let v21 = v18 - p16.second();
        let feedback_rod = v19 + v20;
        let p23 = p15 * p15;
        let v24 = v21 + feedback_rod;
        let v25 = p23.second() + p23.first();
        let v26 = v24 / v25;
        let p27 = T::Pair::splat(v26);
        let p28 = p15 * p27;
        let acc_y = p28.second() - Single::<T>::new(T::from_f64(9.81));
        let p30 = T::Pair::splat(Single::<T>::new(h));
        let p31 = T::Pair::join(p28.first(), acc_y);
        let p32 = p30 * p31;
        let p33 = p0 + p32;
        let p34 = p30 * p0;
        let p35 = p2 + p34;
        let p36 = p1 * p33;
        let p37 = p35 * p13;
        let p38 = p33 * p36;
        let v39 = Single::<T>::new(T::from_f64(9.81)) * p37.second();
        let v40 = p38.second() + p38.first();
        let v41 = feedback_rod + v39;
        let v42 = Single::<T>::new(self.hoisted[1]) * v40;
        let p43 = p37 * p37;
        let v44 = v41 - v42;
        let v45 = p43.second() + p43.first();
        let v46 = v44 / v45;
        let p47 = T::Pair::splat(v46);
        let p48 = p37 * p47;
        let v49 = p48.second() - Single::<T>::new(T::from_f64(9.81));
        let v50 = p28.first() + p48.first();
        let v51 = acc_y + v49;
        let p52 = p0 + p33;
        let p53 = T::Pair::splat(Single::<T>::new(half_h));
        let p54 = T::Pair::join(v50, v51);
        let p55 = p53 * p54;
        let p56 = p53 * p52;
        let p57 = p0 + p55;
        let p58 = p2 + p56;
        let p59 = p57 + p58;
        let v60 = p59.first() + p59.second();
        ::mbs_runtime::Stepped {
            next: ::mbs_runtime::State {
                t: t_next,
                q: PendulumCoordinates {
                    x: p58.first().get(),
                    y: p58.second().get(),
                },
                v: PendulumCoordinates {
                    x: p57.first().get(),
                    y: p57.second().get(),
                },
            },
            growth: Single::<T>::new(T::from_f64(0.0)).get(),
            sum: v60.get(),
        }
    }
    ///A step with feedback in every stage.
    #[inline(always)]
    fn step_per_stage(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        gains: &::mbs_runtime::Gains<T>,
        h: T,
        t_next: T,
    ) -> ::mbs_runtime::Stepped<PendulumCoordinates<T>> {
        use ::mbs_runtime::{Octant, Pair as _, Single as _, Term as _};
        type Single<T> = <<T as ::mbs_runtime::Real>::Pair as ::mbs_runtime::Pair<
            T,
        >>::Single;
        type SineTerm<T> = <<T as ::mbs_runtime::Real>::Pair as ::mbs_runtime::Pair<
            T,
        >>::Term;
        let half_h = T::from_f64(0.5) * h;
        let p0 = T::Pair::join(Single::<T>::new(at.v.x), Single::<T>::new(at.v.y));
        let p1 = T::Pair::splat(Single::<T>::new(T::from_f64(2.0)));
        let p2 = T::Pair::join(Single::<T>::new(at.q.x), Single::<T>::new(at.q.y));
        let p3 = p1 * p0;
        let p4 = p2 * p2;
        let p5 = T::Pair::join(Single::<T>::new(at.q.x), Single::<T>::new(at.v.y));
        let p6 = T::Pair::join(Single::<T>::new(at.q.y), Single::<T>::new(at.v.x));
        let p7 = p3.swap();
        let p8 = p5 * p3;
        let p9 = p6 * p7;
        let v10 = p4.second() + p4.first();
        let p11 = p8 + p9;
        let v12 = Single::<T>::new(self.hoisted[1]) * v10;
        let p13 = T::Pair::splat(Single::<T>::new(self.hoisted[2]));
        let p14 = T::Pair::splat(Single::<T>::new(self.hoisted[1]));
        let p15 = p2 * p13;
        let p16 = p14 * p11;
        let phi_rod = v12 - Single::<T>::new(self.hoisted[0]);
        let v18 = Single::<T>::new(T::from_f64(9.81)) * p15.second();
        let v19 = Single::<T>::new(gains.minus_two_alpha) * p16.first();
        let v20 = Single::<T>::new(gains.minus_beta_squared) * phi_rod;
        let v21 = v18 - p16.second();
        let feedback_rod = v19 + v20;
        let p23 = p15 * p15;
        let v24 = v21 + feedback_rod;
        let v25 = p23.second() + p23.first();
        let v26 = v24 / v25;
        let p27 = T::Pair::splat(v26);
        let p28 = p15 * p27;
        let acc_y = p28.second() - Single::<T>::new(T::from_f64(9.81));
        let p30 = T::Pair::splat(Single::<T>::new(h));
        let p31 = T::Pair::join(p28.first(), acc_y);
        let p32 = p30 * p31;
        let p33 = p30 * p0;
        let p34 = p0 + p32;
        let p35 = p2 + p33;
        let p36 = p1 * p34;
        let p37 = p35 * p35;
        let p38 = T::Pair::join(p35.first(), p34.second());
        let p39 = T::Pair::join(p35.second(), p34.first());
        let p40 = p36.swap();
        let p41 = p38 * p36;
        let p42 = p39 * p40;
        let v43 = p37.second() + p37.first();
        let p44 = p41 + p42;
        let v45 = Single::<T>::new(self.hoisted[1]) * v43;
        let p46 = p35 * p13;
        let p47 = p14 * p44;
        let v48 = v45 - Single::<T>::new(self.hoisted[0]);
        let v49 = Single::<T>::new(T::from_f64(9.81)) * p46.second();
        let v50 = Single::<T>::new(gains.minus_two_alpha) * p47.first();
        let v51 = Single::<T>::new(gains.minus_beta_squared) * v48;
        let v52 = v49 - p47.second();
        let v53 = v50 + v51;
        let p54 = p46 * p46;
        let v55 = v52 + v53;
        let v56 = p54.second() + p54.first();
        let v57 = v55 / v56;
        let p58 = T::Pair::splat(v57);
        let p59 = p46 * p58;
        let v60 = p59.second() - Single::<T>::new(T::from_f64(9.81));
        let v61 = p28.first() + p59.first();
        let v62 = acc_y + v60;
        let p63 = p0 + p34;
        let p64 = T::Pair::splat(Single::<T>::new(half_h));
        let p65 = T::Pair::join(v61, v62);
        let p66 = p64 * p65;
        let p67 = p64 * p63;
        let p68 = p0 + p66;
        let p69 = p2 + p67;
        let p70 = p68 + p69;
        let v71 = p70.first() + p70.second();
        ::mbs_runtime::Stepped {
            next: ::mbs_runtime::State {
                t: t_next,
                q: PendulumCoordinates {
                    x: p69.first().get(),
                    y: p69.second().get(),
                },
                v: PendulumCoordinates {
                    x: p68.first().get(),
                    y: p68.second().get(),
                },
            },
            growth: Single::<T>::new(T::from_f64(0.0)).get(),
            sum: v71.get(),
        }
    }
    ///A step with feedback held over it, and the reactions at its start.
    #[inline(always)]
    fn step_held_with_reactions(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        gains: &::mbs_runtime::Gains<T>,
        h: T,
        t_next: T,
    ) -> (
        ::mbs_runtime::Stepped<PendulumCoordinates<T>>,
        ::mbs_runtime::Reactions<PendulumCoordinates<T>, PendulumConstraints<T>>,
    ) {
        use ::mbs_runtime::{Octant, Pair as _, Single as _, Term as _};
        type Single<T> = <<T as ::mbs_runtime::Real>::Pair as ::mbs_runtime::Pair<
            T,
        >>::Single;
        type SineTerm<T> = <<T as ::mbs_runtime::Real>::Pair as ::mbs_runtime::Pair<
            T,
        >>::Term;
        let half_h = T::from_f64(0.5) * h;
        let p0 = T::Pair::join(Single::<T>::new(at.v.x), Single::<T>::new(at.v.y));
        let p1 = T::Pair::splat(Single::<T>::new(T::from_f64(2.0)));
        let p2 = T::Pair::join(Single::<T>::new(at.q.x), Single::<T>::new(at.q.y));
        let p3 = p1 * p0;
        let p4 = p2 * p2;
        let p5 = T::Pair::join(Single::<T>::new(at.q.x), Single::<T>::new(at.v.y));
        let p6 = T::Pair::join(Single::<T>::new(at.q.y), Single::<T>::new(at.v.x));
        let p7 = p3.swap();
        let p8 = p5 * p3;
        let p9 = p6 * p7;
        let v10 = p4.second() + p4.first();
        let p11 = p8 + p9;
        let v12 = Single::<T>::new(self.hoisted[1]) * v10;
        let p13 = T::Pair::splat(Single::<T>::new(self.hoisted[2]));
        let p14 = T::Pair::splat(Single::<T>::new(self.hoisted[1]));
        let p15 = p2 * p13;
        let p16 = p14 * p11;
        let phi_rod = v12 - Single::<T>::new(self.hoisted[0]);
        let v18 = Single::<T>::new(T::from_f64(9.81)) * p15.second();
        let v19 = Single::<T>::new(gains.minus_two_alpha) * p16.first();
        let v20 = Single::<T>::new(gains.minus_beta_squared) * phi_rod;
        let v21 = v18 - p16.second();
        let feedback_rod = v19 + v20;
        let p23 = p15 * p15;
        let v24 = v21 + feedback_rod;
        let v25 = p23.second() + p23.first();
        let p26 = T::Pair::join(v24, v21);
        let p27 = T::Pair::splat(v25);
        let p28 = p26 / p27;
        let p29 = T::Pair::splat(p15.second());
        let p30 = p29 * p28;
        let p31 = T::Pair::splat(p15.first());
        let p32 = T::Pair::splat(Single::<T>::new(T::from_f64(9.81)));
        let p33 = p31 * p28;
        let p34 = p30 - p32;
        let p35 = T::Pair::splat(Single::<T>::new(h));
        let p36 = T::Pair::join(p33.first(), p34.first());
        let p37 = p35 * p36;
        let p38 = p0 + p37;
        let p39 = p35 * p0;
        let p40 = p2 + p39;
        let p41 = p1 * p38;
        let p42 = p40 * p13;
        let p43 = p38 * p41;
        let v44 = Single::<T>::new(T::from_f64(9.81)) * p42.second();
        let v45 = p43.second() + p43.first();
        let v46 = feedback_rod + v44;
        let v47 = Single::<T>::new(self.hoisted[1]) * v45;
        let p48 = p42 * p42;
        let v49 = v46 - v47;
        let v50 = p48.second() + p48.first();
        let v51 = v49 / v50;
        let p52 = T::Pair::splat(v51);
        let p53 = p42 * p52;
        let acc_y = p53.second() - Single::<T>::new(T::from_f64(9.81));
        let v55 = p33.first() + p53.first();
        let v56 = p34.first() + acc_y;
        let p57 = p0 + p38;
        let p58 = T::Pair::splat(Single::<T>::new(half_h));
        let p59 = T::Pair::join(v55, v56);
        let p60 = p58 * p59;
        let p61 = p58 * p57;
        let p62 = p0 + p60;
        let p63 = p2 + p61;
        let v64 = Single::<T>::new(self.parameters.mass) * p28.second();
        let lambda_rod = -v64;
        let p66 = p33 + p34;
        let p67 = p62 + p63;
        let p68 = p66 + p67;
        let v69 = lambda_rod + p68.first();
        let v70 = v69 + p68.second();
        (
            ::mbs_runtime::Stepped {
                next: ::mbs_runtime::State {
                    t: t_next,
                    q: PendulumCoordinates {
                        x: p63.first().get(),
                        y: p63.second().get(),
                    },
                    v: PendulumCoordinates {
                        x: p62.first().get(),
                        y: p62.second().get(),
                    },
                },
                growth: Single::<T>::new(T::from_f64(0.0)).get(),
                sum: v70.get(),
            },
            ::mbs_runtime::Reactions {
                acceleration: PendulumCoordinates {
                    x: p33.second().get(),
                    y: p34.second().get(),
                },
                multipliers: PendulumConstraints {
                    rod: lambda_rod.get(),
                },
                growth: Single::<T>::new(T::from_f64(0.0)).get(),
            },
        )
    }
    ///A step with feedback in every stage, and the reactions at its start.
    #[inline(always)]
    fn step_per_stage_with_reactions(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        gains: &::mbs_runtime::Gains<T>,
        h: T,
        t_next: T,
    ) -> (
        ::mbs_runtime::Stepped<PendulumCoordinates<T>>,
        ::mbs_runtime::Reactions<PendulumCoordinates<T>, PendulumConstraints<T>>,
    ) {
        use ::mbs_runtime::{Octant, Pair as _, Single as _, Term as _};
        type Single<T> = <<T as ::mbs_runtime::Real>::Pair as ::mbs_runtime::Pair<
            T,
        >>::Single;
        type SineTerm<T> = <<T as ::mbs_runtime::Real>::Pair as ::mbs_runtime::Pair<
            T,
        >>::Term;
        let half_h = T::from_f64(0.5) * h;
        let p0 = T::Pair::join(Single::<T>::new(at.v.x), Single::<T>::new(at.v.y));
        let p1 = T::Pair::splat(Single::<T>::new(T::from_f64(2.0)));
        let p2 = T::Pair::join(Single::<T>::new(at.q.x), Single::<T>::new(at.q.y));
        let p3 = p1 * p0;
        let p4 = p2 * p2;
        let p5 = T::Pair::join(Single::<T>::new(at.q.x), Single::<T>::new(at.v.y));
        let p6 = T::Pair::join(Single::<T>::new(at.q.y), Single::<T>::new(at.v.x));
        let p7 = p3.swap();
        let p8 = p5 * p3;
        let p9 = p6 * p7;
        let v10 = p4.second() + p4.first();
        let p11 = p8 + p9;
        let v12 = Single::<T>::new(self.hoisted[1]) * v10;
        let p13 = T::Pair::splat(Single::<T>::new(self.hoisted[2]));
        let p14 = T::Pair::splat(Single::<T>::new(self.hoisted[1]));
        let p15 = p2 * p13;
        let p16 = p14 * p11;
        let phi_rod = v12 - Single::<T>::new(self.hoisted[0]);
        let v18 = Single::<T>::new(T::from_f64(9.81)) * p15.second();
        let v19 = Single::<T>::new(gains.minus_two_alpha) * p16.first();
        let v20 = Single::<T>::new(gains.minus_beta_squared) * phi_rod;
        let v21 = v18 - p16.second();
        let feedback_rod = v19 + v20;
        let p23 = p15 * p15;
        let v24 = v21 + feedback_rod;
        let v25 = p23.second() + p23.first();
        let p26 = T::Pair::join(v24, v21);
        let p27 = T::Pair::splat(v25);
        let p28 = p26 / p27;
        let p29 = T::Pair::splat(p15.second());
        let p30 = p29 * p28;
        let p31 = T::Pair::splat(p15.first());
        let p32 = T::Pair::splat(Single::<T>::new(T::from_f64(9.81)));
        let p33 = p31 * p28;
        let p34 = p30 - p32;
        let p35 = T::Pair::splat(Single::<T>::new(h));
        let p36 = T::Pair::join(p33.first(), p34.first());
        let p37 = p35 * p36;
        let p38 = p35 * p0;
        let p39 = p0 + p37;
        let p40 = p2 + p38;
        let p41 = p1 * p39;
        let p42 = p40 * p40;
        let p43 = T::Pair::join(p40.first(), p39.second());
        let p44 = T::Pair::join(p40.second(), p39.first());
        let p45 = p41.swap();
        let p46 = p43 * p41;
        let p47 = p44 * p45;
        let v48 = p42.second() + p42.first();
        let p49 = p46 + p47;
        let v50 = Single::<T>::new(self.hoisted[1]) * v48;
        let p51 = p40 * p13;
        let p52 = p14 * p49;
        let v53 = v50 - Single::<T>::new(self.hoisted[0]);
        let v54 = Single::<T>::new(T::from_f64(9.81)) * p51.second();
        let v55 = Single::<T>::new(gains.minus_two_alpha) * p52.first();
        let v56 = Single::<T>::new(gains.minus_beta_squared) * v53;
        let v57 = v54 - p52.second();
        let v58 = v55 + v56;
        let p59 = p51 * p51;
        let v60 = v57 + v58;
        let v61 = p59.second() + p59.first();
        let v62 = v60 / v61;
        let p63 = T::Pair::splat(v62);
        let p64 = p51 * p63;
        let acc_y = p64.second() - Single::<T>::new(T::from_f64(9.81));
        let v66 = p33.first() + p64.first();
        let v67 = p34.first() + acc_y;
        let p68 = p0 + p39;
        let p69 = T::Pair::splat(Single::<T>::new(half_h));
        let p70 = T::Pair::join(v66, v67);
        let p71 = p69 * p70;
        let p72 = p69 * p68;
        let p73 = p0 + p71;
        let p74 = p2 + p72;
        let v75 = Single::<T>::new(self.parameters.mass) * p28.second();
        let lambda_rod = -v75;
        let p77 = p33 + p34;
        let p78 = p73 + p74;
        let p79 = p77 + p78;
        let v80 = lambda_rod + p79.first();
        let v81 = v80 + p79.second();
        (
            ::mbs_runtime::Stepped {
                next: ::mbs_runtime::State {
                    t: t_next,
                    q: PendulumCoordinates {
                        x: p74.first().get(),
                        y: p74.second().get(),
                    },
                    v: PendulumCoordinates {
                        x: p73.first().get(),
                        y: p73.second().get(),
                    },
                },
                growth: Single::<T>::new(T::from_f64(0.0)).get(),
                sum: v81.get(),
            },
            ::mbs_runtime::Reactions {
                acceleration: PendulumCoordinates {
                    x: p33.second().get(),
                    y: p34.second().get(),
                },
                multipliers: PendulumConstraints {
                    rod: lambda_rod.get(),
                },
                growth: Single::<T>::new(T::from_f64(0.0)).get(),
            },
        )
    }
}
#[allow(unused_variables, clippy::all)]
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Mechanism for Pendulum<T> {
    type Real = T;
    type Over<Scalar: ::mbs_runtime::Real> = Pendulum<Scalar>;
    type Scheme = ::mbs_runtime::Heun;
    type Parameters = PendulumParameters<T>;
    type Inputs = ::mbs_runtime::NoComponents<T>;
    type Coordinates = PendulumCoordinates<T>;
    type States = PendulumCoordinates<T>;
    type Constraints = PendulumConstraints<T>;
    type Outputs = PendulumOutputs<T>;
    type Points = [[T; 2]; 2];
    type Events = [T; 0];
    const INFO: &'static ::mbs_runtime::Info = &::mbs_runtime::Info::from_parts(
        "Pendulum",
        "A point mass on a massless rod.",
        1,
        &[
            ::mbs_runtime::Quantity {
                name: "length",
                doc: "Length of the rod.",
                unit: "m",
                scale: 1f64,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 1i8,
                    time: 0i8,
                },
                default: 1f64,
            },
            ::mbs_runtime::Quantity {
                name: "mass",
                doc: "Mass of the bob.",
                unit: "kg",
                scale: 1f64,
                dimension: ::mbs_runtime::Dimension {
                    mass: 1i8,
                    length: 0i8,
                    time: 0i8,
                },
                default: 1f64,
            },
        ],
        &[],
        &[
            ::mbs_runtime::Quantity {
                name: "x",
                doc: "",
                unit: "m",
                scale: 1f64,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 1i8,
                    time: 0i8,
                },
                default: 1f64,
            },
            ::mbs_runtime::Quantity {
                name: "y",
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
        ],
        &[
            ::mbs_runtime::Quantity {
                name: "tension",
                doc: "Force in the rod, positive when it pulls.",
                unit: "N",
                scale: 1f64,
                dimension: ::mbs_runtime::Dimension {
                    mass: 1i8,
                    length: 1i8,
                    time: -2i8,
                },
                default: 0f64,
            },
            ::mbs_runtime::Quantity {
                name: "angle",
                doc: "Angle from the lowest position.",
                unit: "deg",
                scale: 0.017453292519943295f64,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 0i8,
                    time: 0i8,
                },
                default: 0f64,
            },
        ],
        &[],
        &[
            ::mbs_runtime::Constraint {
                name: "rod",
                doc: "The rod keeps its length.",
                formula: "1/2*(x^2 + y^2)/length - 1/2*length",
                is_drive: false,
                dimension: ::mbs_runtime::Dimension {
                    mass: 0i8,
                    length: 1i8,
                    time: 0i8,
                },
            },
        ],
        &[0, 1],
        &[],
        &[],
        &[
            ::mbs_runtime::Pivot {
                constraint: "rod",
                coordinate: "",
            },
        ],
        &[
            ::mbs_runtime::Pivot {
                constraint: "rod",
                coordinate: "x",
            },
            ::mbs_runtime::Pivot {
                constraint: "rod",
                coordinate: "",
            },
        ],
        &[
            ::mbs_runtime::Function {
                name: "new",
                operations: ::mbs_runtime::Operations {
                    mul: 4u32,
                    add: 0u32,
                    div: 1u32,
                    sin_cos: 0u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 5u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "phi",
                operations: ::mbs_runtime::Operations {
                    mul: 3u32,
                    add: 2u32,
                    div: 0u32,
                    sin_cos: 0u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 5u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "phi_dot",
                operations: ::mbs_runtime::Operations {
                    mul: 5u32,
                    add: 1u32,
                    div: 0u32,
                    sin_cos: 0u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 6u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "phi_q",
                operations: ::mbs_runtime::Operations {
                    mul: 2u32,
                    add: 0u32,
                    div: 0u32,
                    sin_cos: 0u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 2u32,
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
                    mul: 5u32,
                    add: 2u32,
                    div: 0u32,
                    sin_cos: 0u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 7u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "baumgarte_rhs",
                operations: ::mbs_runtime::Operations {
                    mul: 13u32,
                    add: 6u32,
                    div: 0u32,
                    sin_cos: 0u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 19u32,
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
                name: "kinetic_energy",
                operations: ::mbs_runtime::Operations {
                    mul: 4u32,
                    add: 1u32,
                    div: 0u32,
                    sin_cos: 0u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 5u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "potential_energy",
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
            ::mbs_runtime::Function {
                name: "stabilized",
                operations: ::mbs_runtime::Operations {
                    mul: 20u32,
                    add: 9u32,
                    div: 1u32,
                    sin_cos: 0u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 30u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "constrained",
                operations: ::mbs_runtime::Operations {
                    mul: 12u32,
                    add: 5u32,
                    div: 1u32,
                    sin_cos: 0u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 18u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "reactions",
                operations: ::mbs_runtime::Operations {
                    mul: 13u32,
                    add: 6u32,
                    div: 1u32,
                    sin_cos: 0u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 20u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "position_correction",
                operations: ::mbs_runtime::Operations {
                    mul: 1u32,
                    add: 0u32,
                    div: 1u32,
                    sin_cos: 0u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 2u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "velocity_correction",
                operations: ::mbs_runtime::Operations {
                    mul: 6u32,
                    add: 1u32,
                    div: 1u32,
                    sin_cos: 0u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 8u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "projection",
                operations: ::mbs_runtime::Operations {
                    mul: 6u32,
                    add: 1u32,
                    div: 1u32,
                    sin_cos: 0u32,
                    other: 0u32,
                    watch: 0u32,
                },
                written: 8u32,
                loops: 0u32,
            },
            ::mbs_runtime::Function {
                name: "outputs",
                operations: ::mbs_runtime::Operations {
                    mul: 4u32,
                    add: 2u32,
                    div: 0u32,
                    sin_cos: 0u32,
                    other: 2u32,
                    watch: 0u32,
                },
                written: 8u32,
                loops: 0u32,
            },
        ],
    );
    const DERIVATION: &'static ::mbs_runtime::Derivation = &::mbs_runtime::Derivation {
        given: &[],
        phi: &[
            ::mbs_runtime::Formula {
                of: "rod",
                of_latex: "\\mathrm{rod}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "1/2*(x^2 + y^2)/length - 1/2*length",
                latex: "\\frac{1}{2} \\frac{x^{2} + y^{2}}{\\mathrm{length}} - \\frac{1}{2} \\mathrm{length}",
            },
        ],
        phi_q: &[
            ::mbs_runtime::Formula {
                of: "rod",
                of_latex: "\\mathrm{rod}",
                by: "x",
                by_latex: "x",
                text: "x/length",
                latex: "\\frac{x}{\\mathrm{length}}",
            },
            ::mbs_runtime::Formula {
                of: "rod",
                of_latex: "\\mathrm{rod}",
                by: "y",
                by_latex: "y",
                text: "y/length",
                latex: "\\frac{y}{\\mathrm{length}}",
            },
        ],
        phi_t: &[],
        phi_dot: &[
            ::mbs_runtime::Formula {
                of: "rod",
                of_latex: "\\mathrm{rod}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "1/2*(2*x*der(x) + 2*y*der(y))/length",
                latex: "\\frac{1}{2} \\frac{2 x \\, \\dot{x} + 2 y \\, \\dot{y}}{\\mathrm{length}}",
            },
        ],
        gamma: &[
            ::mbs_runtime::Formula {
                of: "rod",
                of_latex: "\\mathrm{rod}",
                by: "",
                by_latex: "\\mathrm{}",
                text: "-1/2*(2*der(x)^2 + 2*der(y)^2)/length",
                latex: "-\\frac{1}{2} \\frac{2 \\dot{x}^{2} + 2 \\dot{y}^{2}}{\\mathrm{length}}",
            },
        ],
        mass: &[
            ::mbs_runtime::Formula {
                of: "x",
                of_latex: "x",
                by: "",
                by_latex: "\\mathrm{}",
                text: "mass",
                latex: "\\mathrm{mass}",
            },
            ::mbs_runtime::Formula {
                of: "y",
                of_latex: "y",
                by: "",
                by_latex: "\\mathrm{}",
                text: "mass",
                latex: "\\mathrm{mass}",
            },
        ],
        forces: &[
            ::mbs_runtime::Formula {
                of: "y",
                of_latex: "y",
                by: "",
                by_latex: "\\mathrm{}",
                text: "-9.81*mass",
                latex: "-9.81 \\mathrm{mass}",
            },
        ],
        kinetic_energy: ::mbs_runtime::Formula {
            of: "T",
            of_latex: "T",
            by: "",
            by_latex: "\\mathrm{}",
            text: "1/2*mass*der(x)^2 + 1/2*mass*der(y)^2",
            latex: "\\frac{1}{2} \\mathrm{mass} \\, \\dot{x}^{2} + \\frac{1}{2} \\mathrm{mass} \\, \\dot{y}^{2}",
        },
        potential_energy: ::mbs_runtime::Formula {
            of: "V",
            of_latex: "V",
            by: "",
            by_latex: "\\mathrm{}",
            text: "9.81*y*mass",
            latex: "9.81 y \\, \\mathrm{mass}",
        },
        strategy: "constraints first, then what motion they leave free (null space)",
        order: &[
            ::mbs_runtime::Elimination {
                unknowns: &["x"],
                pivot: "mass",
                latex: "\\mathrm{mass}",
                is_watched: false,
            },
            ::mbs_runtime::Elimination {
                unknowns: &["y"],
                pivot: "mass",
                latex: "\\mathrm{mass}",
                is_watched: false,
            },
            ::mbs_runtime::Elimination {
                unknowns: &["lambda(rod)"],
                pivot: "-((x/length)^2 + (y/length)^2)/mass",
                latex: "-\\frac{\\frac{x}{\\mathrm{length}}^{2} + \\frac{y}{\\mathrm{length}}^{2}}{\\mathrm{mass}}",
                is_watched: true,
            },
        ],
    };
    const SKETCH: &'static ::mbs_runtime::Sketch = &::mbs_runtime::Sketch {
        points: &["bob", "ground"],
        bodies: &[
            ::mbs_runtime::sketch::Body {
                name: "bob",
                points: &[0],
            },
        ],
        ground: &[1],
        joints: &[],
        springs: &[],
    };
    fn new(
        parameters: PendulumParameters<T>,
    ) -> ::core::result::Result<Self, ::mbs_runtime::Error> {
        Self::new(parameters)
    }
    fn parameters(&self) -> &PendulumParameters<T> {
        &self.parameters
    }
    #[inline(always)]
    fn hoisted(&self) -> &[T] {
        &self.hoisted
    }
    #[inline(always)]
    fn from_hoisted(
        parameters: PendulumParameters<T>,
        hoisted: impl ::core::ops::FnMut(::core::primitive::usize) -> T,
    ) -> Self {
        Self {
            parameters,
            hoisted: ::mbs_runtime::__private::each(hoisted),
        }
    }
    fn declared_start(&self) -> ::mbs_runtime::State<PendulumCoordinates<T>> {
        ::mbs_runtime::State {
            t: T::from_f64(0.0),
            q: PendulumCoordinates {
                x: self.parameters.length,
                y: T::from_f64(0.0),
            },
            v: PendulumCoordinates {
                x: T::from_f64(0.0),
                y: T::from_f64(0.0),
            },
        }
    }
    #[inline(always)]
    fn phi(&self, t: T, q: &PendulumCoordinates<T>) -> PendulumConstraints<T> {
        Self::phi(self, t, q)
    }
    #[inline(always)]
    fn phi_dot(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
    ) -> PendulumConstraints<T> {
        Self::phi_dot(self, at)
    }
    #[inline(always)]
    fn states(all: PendulumCoordinates<T>) -> PendulumCoordinates<T> {
        all
    }
    #[inline(always)]
    fn complete(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
    ) -> ::mbs_runtime::State<PendulumCoordinates<T>> {
        *at
    }
    #[inline(always)]
    fn stabilized(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        gains: &::mbs_runtime::Gains<T>,
    ) -> ::mbs_runtime::Stabilized<PendulumCoordinates<T>, PendulumConstraints<T>> {
        let phi_q_rod_x = self.hoisted[2] * at.q.x;
        let v1 = phi_q_rod_x * phi_q_rod_x;
        let phi_q_rod_y = at.q.y * self.hoisted[2];
        let v3 = phi_q_rod_y * phi_q_rod_y;
        let v4 = v3 + v1;
        let v5 = at.q.x * at.q.x;
        let v6 = at.q.y * at.q.y;
        let v7 = v6 + v5;
        let v8 = self.hoisted[1] * v7;
        let phi_rod = v8 - self.hoisted[0];
        let v10 = gains.minus_beta_squared * phi_rod;
        let v11 = T::from_f64(2.0) * at.v.x;
        let v12 = at.q.x * v11;
        let v13 = T::from_f64(2.0) * at.v.y;
        let v14 = at.q.y * v13;
        let v15 = v14 + v12;
        let phi_dot_rod = self.hoisted[1] * v15;
        let v17 = gains.minus_two_alpha * phi_dot_rod;
        let feedback_rod = v17 + v10;
        let v19 = at.v.x * v11;
        let v20 = at.v.y * v13;
        let v21 = v20 + v19;
        let v22 = self.hoisted[1] * v21;
        let v23 = T::from_f64(9.81) * phi_q_rod_y;
        let v24 = v23 - v22;
        let v25 = v24 + feedback_rod;
        let v26 = v25 / v4;
        let acc_x = phi_q_rod_x * v26;
        let v28 = phi_q_rod_y * v26;
        let acc_y = v28 - T::from_f64(9.81);
        ::mbs_runtime::Stabilized {
            acceleration: PendulumCoordinates {
                x: acc_x,
                y: acc_y,
            },
            feedback: PendulumConstraints {
                rod: feedback_rod,
            },
            growth: T::from_f64(0.0),
        }
    }
    #[inline(always)]
    fn constrained(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        feedback: &PendulumConstraints<T>,
    ) -> ::mbs_runtime::Accelerations<PendulumCoordinates<T>> {
        let phi_q_rod_x = self.hoisted[2] * at.q.x;
        let v1 = phi_q_rod_x * phi_q_rod_x;
        let phi_q_rod_y = at.q.y * self.hoisted[2];
        let v3 = phi_q_rod_y * phi_q_rod_y;
        let v4 = v3 + v1;
        let v5 = T::from_f64(2.0) * at.v.x;
        let v6 = at.v.x * v5;
        let v7 = T::from_f64(2.0) * at.v.y;
        let v8 = at.v.y * v7;
        let v9 = v8 + v6;
        let v10 = self.hoisted[1] * v9;
        let v11 = T::from_f64(9.81) * phi_q_rod_y;
        let v12 = feedback.rod + v11;
        let v13 = v12 - v10;
        let v14 = v13 / v4;
        let acc_x = phi_q_rod_x * v14;
        let v16 = phi_q_rod_y * v14;
        let acc_y = v16 - T::from_f64(9.81);
        ::mbs_runtime::Accelerations {
            acceleration: PendulumCoordinates {
                x: acc_x,
                y: acc_y,
            },
            growth: T::from_f64(0.0),
        }
    }
    #[inline(always)]
    fn reactions(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        feedback: &PendulumConstraints<T>,
    ) -> ::mbs_runtime::Reactions<PendulumCoordinates<T>, PendulumConstraints<T>> {
        let phi_q_rod_x = self.hoisted[2] * at.q.x;
        let v1 = phi_q_rod_x * phi_q_rod_x;
        let phi_q_rod_y = at.q.y * self.hoisted[2];
        let v3 = phi_q_rod_y * phi_q_rod_y;
        let v4 = v3 + v1;
        let v5 = T::from_f64(2.0) * at.v.x;
        let v6 = at.v.x * v5;
        let v7 = T::from_f64(2.0) * at.v.y;
        let v8 = at.v.y * v7;
        let v9 = v8 + v6;
        let v10 = self.hoisted[1] * v9;
        let v11 = T::from_f64(9.81) * phi_q_rod_y;
        let v12 = feedback.rod + v11;
        let v13 = v12 - v10;
        let v14 = v13 / v4;
        let acc_x = phi_q_rod_x * v14;
        let v16 = phi_q_rod_y * v14;
        let acc_y = v16 - T::from_f64(9.81);
        let v18 = self.parameters.mass * v14;
        let lambda_rod = -v18;
        ::mbs_runtime::Reactions {
            acceleration: PendulumCoordinates {
                x: acc_x,
                y: acc_y,
            },
            multipliers: PendulumConstraints {
                rod: lambda_rod,
            },
            growth: T::from_f64(0.0),
        }
    }
    fn position_correction(
        &self,
        t: T,
        q: &PendulumCoordinates<T>,
        feedback: &PendulumConstraints<T>,
    ) -> ::mbs_runtime::Accelerations<PendulumCoordinates<T>> {
        let v0 = self.parameters.length / q.x;
        let v1 = feedback.rod * v0;
        ::mbs_runtime::Accelerations {
            acceleration: PendulumCoordinates {
                x: v1,
                y: T::from_f64(0.0),
            },
            growth: T::from_f64(0.0),
        }
    }
    fn velocity_correction(
        &self,
        t: T,
        q: &PendulumCoordinates<T>,
        feedback: &PendulumConstraints<T>,
    ) -> ::mbs_runtime::Accelerations<PendulumCoordinates<T>> {
        let phi_q_rod_x = self.hoisted[2] * q.x;
        let v1 = phi_q_rod_x * phi_q_rod_x;
        let phi_q_rod_y = q.y * self.hoisted[2];
        let v3 = phi_q_rod_y * phi_q_rod_y;
        let v4 = v3 + v1;
        let v5 = feedback.rod / v4;
        let v6 = phi_q_rod_x * v5;
        let v7 = phi_q_rod_y * v5;
        ::mbs_runtime::Accelerations {
            acceleration: PendulumCoordinates {
                x: v6,
                y: v7,
            },
            growth: T::from_f64(0.0),
        }
    }
    #[inline(always)]
    fn projection(
        &self,
        t: T,
        q: &PendulumCoordinates<T>,
        feedback: &PendulumConstraints<T>,
    ) -> ::mbs_runtime::Accelerations<PendulumCoordinates<T>> {
        let phi_q_rod_x = self.hoisted[2] * q.x;
        let v1 = phi_q_rod_x * phi_q_rod_x;
        let phi_q_rod_y = q.y * self.hoisted[2];
        let v3 = phi_q_rod_y * phi_q_rod_y;
        let v4 = v3 + v1;
        let v5 = feedback.rod / v4;
        let v6 = phi_q_rod_x * v5;
        let v7 = phi_q_rod_y * v5;
        ::mbs_runtime::Accelerations {
            acceleration: PendulumCoordinates {
                x: v6,
                y: v7,
            },
            growth: T::from_f64(0.0),
        }
    }
    type Clock = [T; 0];
    #[inline(always)]
    fn clock(&self, t: T) -> [T; 0] {
        []
    }
    #[inline(always)]
    fn fused_step<X: ::mbs_runtime::Method>(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        gains: &::mbs_runtime::Gains<T>,
        h: T,
        t_next: T,
    ) -> ::core::option::Option<::mbs_runtime::Stepped<PendulumCoordinates<T>>> {
        ::core::option::Option::Some(
            if X::EXPLICIT.is_held() {
                self.step_held(at, inputs, gains, h, t_next)
            } else {
                self.step_per_stage(at, inputs, gains, h, t_next)
            },
        )
    }
    #[inline(always)]
    fn fused_step_with_reactions<X: ::mbs_runtime::Method>(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        gains: &::mbs_runtime::Gains<T>,
        h: T,
        t_next: T,
    ) -> ::core::option::Option<
        (
            ::mbs_runtime::Stepped<PendulumCoordinates<T>>,
            ::mbs_runtime::Reactions<PendulumCoordinates<T>, PendulumConstraints<T>>,
        ),
    > {
        ::core::option::Option::Some(
            if X::EXPLICIT.is_held() {
                self.step_held_with_reactions(at, inputs, gains, h, t_next)
            } else {
                self.step_per_stage_with_reactions(at, inputs, gains, h, t_next)
            },
        )
    }
    fn worst_pivot(
        &self,
        t: T,
        q: &PendulumCoordinates<T>,
    ) -> ::core::option::Option<(::core::primitive::usize, T)> {
        let phi_q_rod_x = self.hoisted[2] * q.x;
        let v1 = phi_q_rod_x * phi_q_rod_x;
        let phi_q_rod_y = q.y * self.hoisted[2];
        let v3 = phi_q_rod_y * phi_q_rod_y;
        let v4 = v3 + v1;
        let v5 = v4 / v4;
        let abs_v5 = v5.abs();
        ::mbs_runtime::__private::worst(&[abs_v5])
    }
    fn worst_start_pivot(
        &self,
        t: T,
        q: &PendulumCoordinates<T>,
    ) -> ::core::option::Option<(::core::primitive::usize, T)> {
        let phi_q_rod_x = self.hoisted[2] * q.x;
        let v1 = self.parameters.length / q.x;
        let v2 = phi_q_rod_x * v1;
        let abs_v2 = v2.abs();
        let v4 = phi_q_rod_x * phi_q_rod_x;
        let phi_q_rod_y = q.y * self.hoisted[2];
        let v6 = phi_q_rod_y * phi_q_rod_y;
        let v7 = v6 + v4;
        let v8 = v7 / v7;
        let abs_v8 = v8.abs();
        ::mbs_runtime::__private::worst(&[abs_v2, abs_v8])
    }
    #[inline(always)]
    fn kinetic_energy(&self, at: &::mbs_runtime::State<PendulumCoordinates<T>>) -> T {
        Self::kinetic_energy(self, at)
    }
    #[inline(always)]
    fn potential_energy(&self, at: &::mbs_runtime::State<PendulumCoordinates<T>>) -> T {
        Self::potential_energy(self, at)
    }
    #[inline(always)]
    fn outputs(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        reactions: &::mbs_runtime::Reactions<
            PendulumCoordinates<T>,
            PendulumConstraints<T>,
        >,
    ) -> PendulumOutputs<T> {
        let v0 = at.q.x * at.q.x;
        let v1 = at.q.y * at.q.y;
        let v2 = v1 + v0;
        let sqrt_v2 = v2.sqrt();
        let v4 = self.hoisted[2] * reactions.multipliers.rod;
        let v5 = v4 * sqrt_v2;
        let v6 = -at.q.y;
        let v7 = at.q.x.atan2(v6);
        PendulumOutputs {
            tension: v5,
            angle: v7,
        }
    }
    #[inline(always)]
    fn events(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
    ) -> [T; 0] {
        []
    }
    fn points(&self, t: T, q: &PendulumCoordinates<T>) -> [[T; 2]; 2] {
        [[q.x, q.y], [T::from_f64(0.0), T::from_f64(0.0)]]
    }
}
