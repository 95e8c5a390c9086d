/**Slider-crank with a torque on the crank.

# Equations

7 coordinates, 6 constraints, 1 degree of freedom. Φ(q, t) = 0 is
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
| `new` | 28 | 5 | 1 | 0 | 2 | 0 |
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
| `stabilized` | 80 | 60 | 1 | 2 | 0 | 3 |
| `constrained` | 60 | 36 | 1 | 2 | 0 | 3 |
| `reactions` | 71 | 44 | 1 | 2 | 0 | 3 |
| `position_correction` | 6 | 3 | 1 | 1 | 0 | 2 |
| `velocity_correction` | 6 | 3 | 1 | 1 | 0 | 2 |
| `projection` | 50 | 23 | 1 | 2 | 0 | 3 |
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
17: (l1^2*m1*inertia_factor + 1/4*l1^2*m1 + l1^2*m2)*abs(l2)^2 + (l2^2*inertia_factor*m2 + 1/4*l2^2*m2)*abs(l1)^2
18: 1/l2
19: abs(l2)
```
*/
    hoisted: [T; 20usize],
}
impl<T: ::mbs_runtime::Real> ::core::default::Default for SliderCrankFree<T> {
    /// The mechanism with its declared parameters.
    fn default() -> Self {}
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
    fn default() -> Self {}
}
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Components for SliderCrankFreeParameters<T> {
    type Real = T;
    type Array = [T; 7];
    const NAMES: &'static [&'static ::core::primitive::str] = ..;
    #[inline(always)]
    fn into_array(self) -> [T; 7] {}
    #[inline(always)]
    fn from_array(array: [T; 7]) -> Self {}
    #[inline(always)]
    fn splat(value: T) -> Self {}
}
impl<T: ::mbs_runtime::Real> ::core::convert::From<SliderCrankFreeParameters<T>>
for ::mbs_runtime::__private::nalgebra::SVector<T, 7> {
    fn from(components: SliderCrankFreeParameters<T>) -> Self {}
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
    fn default() -> Self {}
}
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Components for SliderCrankFreeInputs<T> {
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
impl<T: ::mbs_runtime::Real> ::core::convert::From<SliderCrankFreeInputs<T>>
for ::mbs_runtime::__private::nalgebra::SVector<T, 1> {
    fn from(components: SliderCrankFreeInputs<T>) -> Self {}
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
    fn default() -> Self {}
}
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Components
for SliderCrankFreeCoordinates<T> {
    type Real = T;
    type Array = [T; 7];
    const NAMES: &'static [&'static ::core::primitive::str] = ..;
    #[inline(always)]
    fn into_array(self) -> [T; 7] {}
    #[inline(always)]
    fn from_array(array: [T; 7]) -> Self {}
    #[inline(always)]
    fn splat(value: T) -> Self {}
}
impl<T: ::mbs_runtime::Real> ::core::convert::From<SliderCrankFreeCoordinates<T>>
for ::mbs_runtime::__private::nalgebra::SVector<T, 7> {
    fn from(components: SliderCrankFreeCoordinates<T>) -> Self {}
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
    fn default() -> Self {}
}
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Components
for SliderCrankFreeConstraints<T> {
    type Real = T;
    type Array = [T; 6];
    const NAMES: &'static [&'static ::core::primitive::str] = ..;
    #[inline(always)]
    fn into_array(self) -> [T; 6] {}
    #[inline(always)]
    fn from_array(array: [T; 6]) -> Self {}
    #[inline(always)]
    fn splat(value: T) -> Self {}
}
impl<T: ::mbs_runtime::Real> ::core::convert::From<SliderCrankFreeConstraints<T>>
for ::mbs_runtime::__private::nalgebra::SVector<T, 6> {
    fn from(components: SliderCrankFreeConstraints<T>) -> Self {}
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
    fn default() -> Self {}
}
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Components for SliderCrankFreeOutputs<T> {
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
impl<T: ::mbs_runtime::Real> ::core::convert::From<SliderCrankFreeOutputs<T>>
for ::mbs_runtime::__private::nalgebra::SVector<T, 2> {
    fn from(components: SliderCrankFreeOutputs<T>) -> Self {}
}
impl SliderCrankFree<::core::primitive::f64> {
    /// The mechanism with its declared parameters, in `f64`.
    ///
    /// For another scalar type, use `default`.
    pub fn declared() -> Self {}
}
impl<T: ::mbs_runtime::Real> SliderCrankFree<T> {
    /// The mechanism with these parameters.
    ///
    /// # Errors
    /// If a parameter is not finite, a mass or an inertia comes out
    /// negative, or a declared condition does not hold.
    pub fn new(
        parameters: SliderCrankFreeParameters<T>,
    ) -> ::core::result::Result<Self, ::mbs_runtime::Error> {}
    /// Computes what depends on parameters alone.
    #[allow(unused_variables, clippy::all)]
    fn prepare(parameters: SliderCrankFreeParameters<T>) -> Self {}
    /// The parameters.
    pub fn parameters(&self) -> &SliderCrankFreeParameters<T> {}
}
impl<T: ::mbs_runtime::Real> SliderCrankFree<T> {
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
    ) -> SliderCrankFreeConstraints<T> {}
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
    ) -> SliderCrankFreeConstraints<T> {}
    /// Φ̇ = Φ_q v + Φ_t, the constraint violation in velocities.
    #[inline(always)]
    pub fn phi_dot(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
    ) -> SliderCrankFreeConstraints<T> {}
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
    ) -> SliderCrankFreeConstraints<T> {}
    /**γ − 2αΦ̇ − β²Φ, the right-hand side with feedback of the violation (Jiang 2025, Eq. 8); gains in 1/s.

Cost: 40 mul + 34 add + 0 div + 2 sincos.*/
    #[inline]
    pub fn baumgarte_rhs(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
        alpha: T,
        beta: T,
    ) -> SliderCrankFreeConstraints<T> {}
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
    ) -> ::mbs_runtime::__private::nalgebra::SMatrix<T, 6usize, 7usize> {}
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
    ) -> ::mbs_runtime::__private::nalgebra::SMatrix<T, 7usize, 7usize> {}
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
    ) -> SliderCrankFreeCoordinates<T> {}
    /**Accelerations q̈ and multipliers λ from M q̈ + Φ_qᵀ λ = Q, Φ_q q̈ = γ, without feedback terms.

In a singular position the result is not finite or its `growth` exceeds the runtime's `growth_limit`.

Cost: 71 mul + 44 add + 1 div + 2 sincos.*/
    #[inline]
    pub fn accelerations(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
        inputs: &SliderCrankFreeInputs<T>,
    ) -> ::mbs_runtime::Reactions<
        SliderCrankFreeCoordinates<T>,
        SliderCrankFreeConstraints<T>,
    > {}
    /// Kinetic energy ½ vᵀMv in J.
    #[inline(always)]
    pub fn kinetic_energy(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
    ) -> T {}
    /// Potential energy of gravity (0 at the origin) and springs in J.
    #[inline(always)]
    pub fn potential_energy(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
    ) -> T {}
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
    ) -> ::mbs_runtime::Stepped<SliderCrankFreeCoordinates<T>> {}
    ///A step with feedback in every stage.
    #[inline(always)]
    fn step_per_stage(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
        inputs: &SliderCrankFreeInputs<T>,
        gains: &::mbs_runtime::Gains<T>,
        h: T,
        t_next: T,
    ) -> ::mbs_runtime::Stepped<SliderCrankFreeCoordinates<T>> {}
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
    ) {}
    ///A step with feedback in every stage, and the reactions at its start.
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
    ) {}
}
#[allow(unused_variables, clippy::all)]
impl<T: ::mbs_runtime::Real> ::mbs_runtime::Mechanism for SliderCrankFree<T> {
    type Real = T;
    type Over<Scalar: ::mbs_runtime::Real> = SliderCrankFree<Scalar>;
    type Scheme = ::mbs_runtime::Heun;
    type Parameters = SliderCrankFreeParameters<T>;
    type Inputs = SliderCrankFreeInputs<T>;
    type Coordinates = SliderCrankFreeCoordinates<T>;
    type States = SliderCrankFreeCoordinates<T>;
    type Constraints = SliderCrankFreeConstraints<T>;
    type Outputs = SliderCrankFreeOutputs<T>;
    type Points = [[T; 2]; 9];
    type Events = [T; 0];
    const INFO: &'static ::mbs_runtime::Info = ..;
    const DERIVATION: &'static ::mbs_runtime::Derivation = ..;
    const SKETCH: &'static ::mbs_runtime::Sketch = ..;
    fn new(
        parameters: SliderCrankFreeParameters<T>,
    ) -> ::core::result::Result<Self, ::mbs_runtime::Error> {}
    fn parameters(&self) -> &SliderCrankFreeParameters<T> {}
    #[inline(always)]
    fn hoisted(&self) -> &[T] {}
    #[inline(always)]
    fn from_hoisted(
        parameters: SliderCrankFreeParameters<T>,
        hoisted: impl ::core::ops::FnMut(::core::primitive::usize) -> T,
    ) -> Self {}
    fn declared_start(&self) -> ::mbs_runtime::State<SliderCrankFreeCoordinates<T>> {}
    #[inline(always)]
    fn phi(
        &self,
        t: T,
        q: &SliderCrankFreeCoordinates<T>,
    ) -> SliderCrankFreeConstraints<T> {}
    #[inline(always)]
    fn phi_dot(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
    ) -> SliderCrankFreeConstraints<T> {}
    #[inline(always)]
    fn states(all: SliderCrankFreeCoordinates<T>) -> SliderCrankFreeCoordinates<T> {}
    #[inline(always)]
    fn complete(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
    ) -> ::mbs_runtime::State<SliderCrankFreeCoordinates<T>> {}
    #[inline(always)]
    fn stabilized(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
        inputs: &SliderCrankFreeInputs<T>,
        gains: &::mbs_runtime::Gains<T>,
    ) -> ::mbs_runtime::Stabilized<
        SliderCrankFreeCoordinates<T>,
        SliderCrankFreeConstraints<T>,
    > {}
    #[inline(always)]
    fn constrained(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
        inputs: &SliderCrankFreeInputs<T>,
        feedback: &SliderCrankFreeConstraints<T>,
    ) -> ::mbs_runtime::Accelerations<SliderCrankFreeCoordinates<T>> {}
    #[inline(always)]
    fn reactions(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
        inputs: &SliderCrankFreeInputs<T>,
        feedback: &SliderCrankFreeConstraints<T>,
    ) -> ::mbs_runtime::Reactions<
        SliderCrankFreeCoordinates<T>,
        SliderCrankFreeConstraints<T>,
    > {}
    fn position_correction(
        &self,
        t: T,
        q: &SliderCrankFreeCoordinates<T>,
        feedback: &SliderCrankFreeConstraints<T>,
    ) -> ::mbs_runtime::Accelerations<SliderCrankFreeCoordinates<T>> {}
    fn velocity_correction(
        &self,
        t: T,
        q: &SliderCrankFreeCoordinates<T>,
        feedback: &SliderCrankFreeConstraints<T>,
    ) -> ::mbs_runtime::Accelerations<SliderCrankFreeCoordinates<T>> {}
    #[inline(always)]
    fn projection(
        &self,
        t: T,
        q: &SliderCrankFreeCoordinates<T>,
        feedback: &SliderCrankFreeConstraints<T>,
    ) -> ::mbs_runtime::Accelerations<SliderCrankFreeCoordinates<T>> {}
    type Clock = [T; 0];
    #[inline(always)]
    fn clock(&self, t: T) -> [T; 0] {}
    #[inline(always)]
    fn fused_step<X: ::mbs_runtime::Method>(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
        inputs: &SliderCrankFreeInputs<T>,
        gains: &::mbs_runtime::Gains<T>,
        h: T,
        t_next: T,
    ) -> ::core::option::Option<::mbs_runtime::Stepped<SliderCrankFreeCoordinates<T>>> {}
    #[inline(always)]
    fn fused_step_with_reactions<X: ::mbs_runtime::Method>(
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
    > {}
    fn worst_pivot(
        &self,
        t: T,
        q: &SliderCrankFreeCoordinates<T>,
    ) -> ::core::option::Option<(::core::primitive::usize, T)> {}
    fn worst_start_pivot(
        &self,
        t: T,
        q: &SliderCrankFreeCoordinates<T>,
    ) -> ::core::option::Option<(::core::primitive::usize, T)> {}
    #[inline(always)]
    fn kinetic_energy(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
    ) -> T {}
    #[inline(always)]
    fn potential_energy(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
    ) -> T {}
    #[inline(always)]
    fn outputs(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
        inputs: &SliderCrankFreeInputs<T>,
        reactions: &::mbs_runtime::Reactions<
            SliderCrankFreeCoordinates<T>,
            SliderCrankFreeConstraints<T>,
        >,
    ) -> SliderCrankFreeOutputs<T> {}
    #[inline(always)]
    fn events(
        &self,
        at: &::mbs_runtime::State<SliderCrankFreeCoordinates<T>>,
        inputs: &SliderCrankFreeInputs<T>,
    ) -> [T; 0] {}
    fn points(&self, t: T, q: &SliderCrankFreeCoordinates<T>) -> [[T; 2]; 9] {}
}
