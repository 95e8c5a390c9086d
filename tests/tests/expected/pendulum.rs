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
    fn default() -> Self {}
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
    fn default() -> Self {}
}
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Components for PendulumParameters<T> {
    type Real = T;
    type Array = [T; 2];
    const NAMES: &'static [&'static ::core::primitive::str] = ..;
    #[inline(always)]
    fn into_array(self) -> [T; 2] {}
    #[inline(always)]
    fn from_array(array: [T; 2]) -> Self {}
    #[inline(always)]
    fn splat(value: T) -> Self {}
}
impl<T: ::mbs_runtime::Real> ::core::convert::From<PendulumParameters<T>>
for ::mbs_runtime::__private::nalgebra::SVector<T, 2> {
    fn from(components: PendulumParameters<T>) -> Self {}
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
    fn default() -> Self {}
}
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Components for PendulumCoordinates<T> {
    type Real = T;
    type Array = [T; 2];
    const NAMES: &'static [&'static ::core::primitive::str] = ..;
    #[inline(always)]
    fn into_array(self) -> [T; 2] {}
    #[inline(always)]
    fn from_array(array: [T; 2]) -> Self {}
    #[inline(always)]
    fn splat(value: T) -> Self {}
}
impl<T: ::mbs_runtime::Real> ::core::convert::From<PendulumCoordinates<T>>
for ::mbs_runtime::__private::nalgebra::SVector<T, 2> {
    fn from(components: PendulumCoordinates<T>) -> Self {}
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
    fn default() -> Self {}
}
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Components for PendulumConstraints<T> {
    type Real = T;
    type Array = [T; 1];
    const NAMES: &'static [&'static ::core::primitive::str] = ..;
    #[inline(always)]
    fn into_array(self) -> [T; 1] {}
    #[inline(always)]
    fn from_array(array: [T; 1]) -> Self {}
    #[inline(always)]
    fn splat(value: T) -> Self {}
}
impl<T: ::mbs_runtime::Real> ::core::convert::From<PendulumConstraints<T>>
for ::mbs_runtime::__private::nalgebra::SVector<T, 1> {
    fn from(components: PendulumConstraints<T>) -> Self {}
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
    fn default() -> Self {}
}
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Components for PendulumOutputs<T> {
    type Real = T;
    type Array = [T; 2];
    const NAMES: &'static [&'static ::core::primitive::str] = ..;
    #[inline(always)]
    fn into_array(self) -> [T; 2] {}
    #[inline(always)]
    fn from_array(array: [T; 2]) -> Self {}
    #[inline(always)]
    fn splat(value: T) -> Self {}
}
impl<T: ::mbs_runtime::Real> ::core::convert::From<PendulumOutputs<T>>
for ::mbs_runtime::__private::nalgebra::SVector<T, 2> {
    fn from(components: PendulumOutputs<T>) -> Self {}
}
impl Pendulum<::core::primitive::f64> {
    /// The mechanism with its declared parameters, in `f64`.
    ///
    /// For another scalar type, use `default`.
    pub fn declared() -> Self {}
}
impl<T: ::mbs_runtime::Real> Pendulum<T> {
    /// The mechanism with these parameters.
    ///
    /// # Errors
    /// If a parameter is not finite, a mass or an inertia comes out
    /// negative, or a declared condition does not hold.
    pub fn new(
        parameters: PendulumParameters<T>,
    ) -> ::core::result::Result<Self, ::mbs_runtime::Error> {}
    /// Computes what depends on parameters alone.
    #[allow(unused_variables, clippy::all)]
    fn prepare(parameters: PendulumParameters<T>) -> Self {}
    /// The parameters.
    pub fn parameters(&self) -> &PendulumParameters<T> {}
}
impl<T: ::mbs_runtime::Real> Pendulum<T> {
    /// Operations of one evaluation of the right-hand side, the watch over
    /// the pivots included; a step takes one per stage, or less.
    pub const OPERATIONS: ::core::primitive::u32 = ..;
    /// The size of the state of a step (time, positions, velocities) in bytes.
    pub const STATE_BYTES: ::core::primitive::usize = ..;
    /// A bound of the stack that a step takes, in bytes, in optimized code:
    /// every value of all evaluations of the right-hand side once, four
    /// copies of the state, the inputs and the rows per stage, and 1 KiB for calls.
    pub const STACK_BYTES: ::core::primitive::usize = ..;
}
#[allow(unused_variables, clippy::all)]
impl<T: ::mbs_runtime::Real> Pendulum<T> {
    /**The constraints Φ(q, t): 0 where the mechanism is assembled.

```text
rod: 1/2*(x^2 + y^2)/length - 1/2*length
```


Cost: 3 mul + 2 add + 0 div + 0 sincos.*/
    #[inline(always)]
    pub fn phi(&self, t: T, q: &PendulumCoordinates<T>) -> PendulumConstraints<T> {}
    /**The constraint violation in velocities, Φ̇ = Φ_q v + Φ_t.

Cost: 5 mul + 1 add + 0 div + 0 sincos.*/
    #[inline(always)]
    pub fn phi_dot(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
    ) -> PendulumConstraints<T> {}
    /**The partial time derivative Φ_t; velocities satisfy Φ_q v = −Φ_t.

```text
rod: 0
```


Cost: 0 mul + 0 add + 0 div + 0 sincos.*/
    #[inline(always)]
    pub fn phi_t(&self, t: T, q: &PendulumCoordinates<T>) -> PendulumConstraints<T> {}
    /**γ = −(Φ_q v)_q v − 2Φ_qt v − Φ_tt, so that Φ_q q̈ = γ (Jiang 2025, Eq. 5).

```text
rod: -1/2*(2*der(x)^2 + 2*der(y)^2)/length
```


Cost: 5 mul + 2 add + 0 div + 0 sincos.*/
    #[inline(always)]
    pub fn gamma(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
    ) -> PendulumConstraints<T> {}
    /**The generalized forces Q: gravity and applied loads, and centrifugal and Coriolis forces of particles.

```text
x: 0
y: -9.81*mass
```


Cost: 0 mul + 1 add + 0 div + 0 sincos.*/
    #[inline(always)]
    pub fn forces(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
    ) -> PendulumCoordinates<T> {}
    /**The kinetic energy ½ vᵀMv in J.

Cost: 4 mul + 1 add + 0 div + 0 sincos.*/
    #[inline(always)]
    pub fn kinetic_energy(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
    ) -> T {}
    /**The potential energy of gravity and springs in J.

Cost: 1 mul + 0 add + 0 div + 0 sincos.*/
    #[inline(always)]
    pub fn potential_energy(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
    ) -> T {}
    ///The kinetic momentum p = Mv; ½ pᵀv is the kinetic energy.
    #[inline(always)]
    pub fn kinetic_momentum(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
    ) -> PendulumCoordinates<T> {}
    /**γ − 2αΦ̇ − β²Φ, the right-hand side with feedback of the violation (Jiang 2025, Eq. 8).

Cost: 13 mul + 6 add + 0 div + 0 sincos.*/
    ///
    /// The gains α and β are in 1/s.
    #[inline]
    pub fn baumgarte_rhs(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        alpha: T,
        beta: T,
    ) -> PendulumConstraints<T> {}
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
    ) -> ::mbs_runtime::__private::nalgebra::SMatrix<T, 1usize, 2usize> {}
    /**Mass matrix M. Entries that are not 0:

```text
x: mass
y: mass
```


Cost: 0 mul + 0 add + 0 div + 0 sincos.*/
    #[inline]
    pub fn mass(
        &self,
        q: &PendulumCoordinates<T>,
    ) -> ::mbs_runtime::__private::nalgebra::SMatrix<T, 2usize, 2usize> {}
    /**Accelerations q̈ and multipliers λ from M q̈ + Φ_qᵀ λ = Q, Φ_q q̈ = γ, without feedback terms.

In a singular position the result is not finite or its `growth` exceeds the runtime's `growth_limit`.

Cost: 13 mul + 6 add + 1 div + 0 sincos.*/
    #[inline]
    pub fn accelerations(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
    ) -> ::mbs_runtime::Reactions<PendulumCoordinates<T>, PendulumConstraints<T>> {}
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
    ) -> ::mbs_runtime::Stepped<PendulumCoordinates<T>> {}
    ///A step with feedback in every stage.
    #[inline(always)]
    fn step_per_stage(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        gains: &::mbs_runtime::Gains<T>,
        h: T,
        t_next: T,
    ) -> ::mbs_runtime::Stepped<PendulumCoordinates<T>> {}
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
    ) {}
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
    ) {}
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
    const INFO: &'static ::mbs_runtime::Info = ..;
    const DERIVATION: &'static ::mbs_runtime::Derivation = ..;
    const SKETCH: &'static ::mbs_runtime::Sketch = ..;
    fn new(
        parameters: PendulumParameters<T>,
    ) -> ::core::result::Result<Self, ::mbs_runtime::Error> {}
    fn parameters(&self) -> &PendulumParameters<T> {}
    #[inline(always)]
    fn hoisted(&self) -> &[T] {}
    #[inline(always)]
    fn from_hoisted(
        parameters: PendulumParameters<T>,
        hoisted: impl ::core::ops::FnMut(::core::primitive::usize) -> T,
    ) -> Self {}
    fn declared_start(&self) -> ::mbs_runtime::State<PendulumCoordinates<T>> {}
    #[inline(always)]
    fn phi(&self, t: T, q: &PendulumCoordinates<T>) -> PendulumConstraints<T> {}
    #[inline(always)]
    fn phi_dot(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
    ) -> PendulumConstraints<T> {}
    #[inline(always)]
    fn states(all: PendulumCoordinates<T>) -> PendulumCoordinates<T> {}
    #[inline(always)]
    fn complete(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
    ) -> ::mbs_runtime::State<PendulumCoordinates<T>> {}
    #[inline(always)]
    fn stabilized(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        gains: &::mbs_runtime::Gains<T>,
    ) -> ::mbs_runtime::Stabilized<PendulumCoordinates<T>, PendulumConstraints<T>> {}
    #[inline(always)]
    fn constrained(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        feedback: &PendulumConstraints<T>,
    ) -> ::mbs_runtime::Accelerations<PendulumCoordinates<T>> {}
    #[inline(always)]
    fn reactions(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        feedback: &PendulumConstraints<T>,
    ) -> ::mbs_runtime::Reactions<PendulumCoordinates<T>, PendulumConstraints<T>> {}
    fn position_correction(
        &self,
        t: T,
        q: &PendulumCoordinates<T>,
        feedback: &PendulumConstraints<T>,
    ) -> ::mbs_runtime::Accelerations<PendulumCoordinates<T>> {}
    fn velocity_correction(
        &self,
        t: T,
        q: &PendulumCoordinates<T>,
        feedback: &PendulumConstraints<T>,
    ) -> ::mbs_runtime::Accelerations<PendulumCoordinates<T>> {}
    #[inline(always)]
    fn projection(
        &self,
        t: T,
        q: &PendulumCoordinates<T>,
        feedback: &PendulumConstraints<T>,
    ) -> ::mbs_runtime::Accelerations<PendulumCoordinates<T>> {}
    #[inline(always)]
    fn fused_step<X: ::mbs_runtime::Method>(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        gains: &::mbs_runtime::Gains<T>,
        h: T,
        t_next: T,
    ) -> ::core::option::Option<::mbs_runtime::Stepped<PendulumCoordinates<T>>> {}
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
    > {}
    fn worst_pivot(
        &self,
        t: T,
        q: &PendulumCoordinates<T>,
    ) -> ::core::option::Option<(::core::primitive::usize, T)> {}
    fn worst_start_pivot(
        &self,
        t: T,
        q: &PendulumCoordinates<T>,
    ) -> ::core::option::Option<(::core::primitive::usize, T)> {}
    #[inline(always)]
    fn kinetic_energy(&self, at: &::mbs_runtime::State<PendulumCoordinates<T>>) -> T {}
    #[inline(always)]
    fn potential_energy(&self, at: &::mbs_runtime::State<PendulumCoordinates<T>>) -> T {}
    #[inline(always)]
    fn outputs(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
        reactions: &::mbs_runtime::Reactions<
            PendulumCoordinates<T>,
            PendulumConstraints<T>,
        >,
    ) -> PendulumOutputs<T> {}
    #[inline(always)]
    fn events(
        &self,
        at: &::mbs_runtime::State<PendulumCoordinates<T>>,
        inputs: &::mbs_runtime::NoComponents<T>,
    ) -> [T; 0] {}
    fn points(&self, t: T, q: &PendulumCoordinates<T>) -> [[T; 2]; 2] {}
}
