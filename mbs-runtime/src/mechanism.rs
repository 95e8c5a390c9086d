//! A generated mechanism as integrators and tools see it.
//!
//! `Mechanism` is the interface between generated code and integrators. Errors and tools need its constant
//! `INFO`. `DERIVATION` has the equations and their elimination as text and LaTeX. Pictures are made of
//! `SKETCH` and `points`. Both constants are apart from `INFO`, so that firmware does not carry them.

use crate::{Components, Derivation, Error, Info, Method, Real, Scheme, Sketch, Switch};

/// Position and velocity of a mechanism at an instant.
///
/// A [state of its own](crate::language#states-of-its-own) z is the velocity in a place behind those of the
/// coordinates, with ż as its acceleration. Its position is ∫ z dt, on which nothing depends. So whatever
/// integrates velocities integrates own states.
#[derive(Clone, Copy, Debug, PartialEq)]
// This keeps the time between coordinates and velocities. Where they are neighbours, compilers load
// both at once, and the load waits for two stores of the step before.
#[repr(C)]
pub struct State<C: Components> {
    /// Coordinates q: lengths in m, angles in rad. Of an own state ∫ z dt.
    pub q: C,
    /// Time in s.
    pub t: C::Real,
    /// Velocities v = q̇, per second. Of an own state its value z.
    pub v: C,
}

/// The gains of the feedback in the form in which Eq. (8) uses them, signs
/// included: that spares the generated code a negation per constraint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gains<T> {
    /// −2α in 1/s.
    pub minus_two_alpha: T,
    /// −β² in 1/s².
    pub minus_beta_squared: T,
}

/// The solution of the constrained system with feedback from the state itself; see
/// [`Mechanism::stabilized`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stabilized<C: Components, R> {
    /// q̈ of the coordinates that are integrated.
    pub acceleration: C,
    /// −2αΦ̇ − β²Φ, one per constraint; 0 of those that give a coordinate.
    pub feedback: R,
    /// Pivot growth; see [`Mechanism`].
    pub growth: C::Real,
}

/// The solution of the constrained system for the accelerations alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accelerations<C: Components> {
    /// q̈, or the correction of q or v that was asked for.
    pub acceleration: C,
    /// Pivot growth; see [`Mechanism`].
    pub growth: C::Real,
}

/// The solution of the constrained system with its Lagrange multipliers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reactions<C: Components, R> {
    /// q̈
    pub acceleration: C,
    /// λ, one per constraint: the generalized constraint forces are −Φ_qᵀ λ.
    pub multipliers: R,
    /// Pivot growth; see [`Mechanism`].
    pub growth: C::Real,
}

/// A step whose health has not been tested.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stepped<C: Components> {
    /// The state after the step.
    pub next: State<C>,
    /// The sum of the pivot growths of all stages; see [`Mechanism`].
    pub growth: C::Real,
    /// The sum of positions and velocities, up to their signs: finite only if all
    /// of them are. Of a step that gives reactions, accelerations and multipliers
    /// belong to the sum too.
    pub sum: C::Real,
}

/// A mechanism with constraints Φ(q, t) = 0 and the equations of motion
///
/// ```text
/// ⎡ M   Φ_qᵀ ⎤ ⎡ q̈ ⎤   ⎡ Q                 ⎤
/// ⎣ Φ_q  0   ⎦ ⎣ λ ⎦ = ⎣ γ − 2αΦ̇ − β²Φ    ⎦      (Jiang 2025, Eq. 8)
/// ```
///
/// `mechanism!` implements it by straight-line code: the system is eliminated
/// at compile time, and no matrix is formed when these methods run. None of
/// them allocates or panics.
///
/// **Pivot growth.** Every elimination divides by pivots that may vanish in
/// singular positions. The code sums, over the pivots, the size of the terms
/// that made the pivot divided by the pivot: about 1 per pivot in a healthy
/// position, 1/ε when all digits have cancelled, infinite or NaN at an exact
/// zero. Integrators compare it with [`growth_limit`] once a step.
///
/// **States.** A step integrates the [`States`](Self::States): all coordinates, or with
/// `states = reduced;` those that no constraint gives explicitly. The others and their
/// velocities are functions of the states, which [`complete`](Self::complete) evaluates; they
/// meet their constraints exactly. A function that is not part of a step is given all coordinates.
pub trait Mechanism: Copy + core::fmt::Debug + Send + Sync + 'static {
    /// The scalar of the computation.
    type Real: Real;
    /// The same mechanism over another scalar.
    type Over<Scalar: Real>: Mechanism<Real = Scalar>;
    /// The scheme that it declares, and that runs use unless they ask for another:
    /// [`Heun`](crate::Heun), or that of `method = …;`.
    type Scheme: Scheme;
    /// The parameters, named fields in SI units.
    type Parameters: Components<Real = Self::Real> + Default;
    /// The inputs that the embedding program sets, named fields in SI units; the default is the declaration.
    type Inputs: Components<Real = Self::Real> + Default;
    /// The coordinates q, and with the same names q̇ and q̈.
    type Coordinates: Components<Real = Self::Real>;
    /// The coordinates that are integrated, by the same names: the
    /// [`Coordinates`](Self::Coordinates), unless the declaration reduces them.
    type States: Components<Real = Self::Real>;
    /// One component per constraint: Φ, Φ̇, γ and λ.
    type Constraints: Components<Real = Self::Real>;
    /// The declared outputs.
    type Outputs: Components<Real = Self::Real>;
    /// An array of places (x, y), one per point of the sketch.
    type Points: Copy + AsRef<[[Self::Real; 2]]>;
    /// An array of numbers, one per declared event.
    type Events: Copy + AsRef<[Self::Real]>;
    /// Names, units, equations and operation counts.
    const INFO: &'static Info;

    /// The equations and their elimination, for people to read.
    const DERIVATION: &'static Derivation;

    /// The picture of the mechanism. It is apart from [`INFO`](Self::INFO), so that a
    /// program without pictures does not carry it.
    const SKETCH: &'static Sketch;

    /// The values of the motion at whose knots forces, constraints or events bend or jump; at most
    /// 64.
    const SWITCHES: &'static [Switch] = &[];

    /// The mechanism with these parameters.
    ///
    /// # Errors
    /// [`Error::Parameter`] if one is not finite, if a mass or an inertia comes
    /// out negative, or if a declared condition on a parameter does not hold.
    fn new(parameters: Self::Parameters) -> Result<Self, Error>;

    /// The parameters it was made with.
    fn parameters(&self) -> &Self::Parameters;

    /// The values that [`new`](Self::new) computed from the parameters.
    #[doc(hidden)]
    fn hoisted(&self) -> &[Self::Real];

    /// A mechanism that exists already, from its parameters and from what `new`
    /// computed from them, number by number.
    #[doc(hidden)]
    fn from_hoisted(parameters: Self::Parameters, hoisted: impl FnMut(usize) -> Self::Real) -> Self;

    /// The `start { … }` block as it was declared, at t = 0, nothing made consistent.
    fn declared_start(&self) -> State<Self::Coordinates>;

    /// Φ(q, t)
    fn phi(&self, t: Self::Real, q: &Self::Coordinates) -> Self::Constraints;

    /// Φ̇ = Φ_q v + Φ_t
    fn phi_dot(&self, at: &State<Self::Coordinates>) -> Self::Constraints;

    /// Those of all coordinates, of their velocities or accelerations, that are integrated.
    fn states(all: Self::Coordinates) -> Self::States;

    /// All coordinates and velocities, from those that are integrated.
    fn complete(&self, at: &State<Self::States>) -> State<Self::Coordinates>;

    /// Solves Eq. (8) for q̈ of the states, and gives the feedback that went into it.
    fn stabilized(
        &self,
        at: &State<Self::States>,
        inputs: &Self::Inputs,
        gains: &Gains<Self::Real>,
    ) -> Stabilized<Self::States, Self::Constraints>;

    /// Solves for q̈ of the states with γ + `feedback` below; constraints that give a
    /// coordinate have none.
    fn constrained(
        &self,
        at: &State<Self::States>,
        inputs: &Self::Inputs,
        feedback: &Self::Constraints,
    ) -> Accelerations<Self::States>;

    /// q̈ of the states in an implicit stage, by one step of Newton's method from the acceleration
    /// `predicted`, without feedback:
    ///
    /// ```text
    /// (M + D) q̈ + Φ_qᵀ λ = Q + D p,  Φ_q q̈ = γ,    D = −s ∂Q/∂v − s² ∂Q/∂q
    /// ```
    ///
    /// with p the prediction, s the `shift`, which is the share of the step that the stage has of
    /// its own slope, and everything taken `at` where p leads to. D is made symmetric. Where no
    /// force depends on positions or velocities it is 0.
    #[inline]
    fn implicit(
        &self,
        at: &State<Self::States>,
        inputs: &Self::Inputs,
        _shift: Self::Real,
        _predicted: &Self::States,
    ) -> Accelerations<Self::States> {
        self.constrained(at, inputs, &Self::Constraints::splat(Self::Real::default()))
    }

    /// A whole step of the declared [`Scheme`](Self::Scheme) of length `h`, from `at` to
    /// `t_next`, as one program: sines and cosines of all stages, the solutions and the
    /// update, in the operations of [`stabilized`](Self::stabilized) and
    /// [`constrained`](Self::constrained). `None` if the mechanism is too large for that to
    /// pay. Of the method `X` it uses the feedback alone.
    ///
    /// It has no branch, so it gives no number where an angle is beyond the reach of
    /// [sines without one](crate::Pair::shift_back): `sum` tells, and the step is made in
    /// stages.
    #[inline(always)]
    fn fused_step<X: Method>(
        &self,
        _at: &State<Self::States>,
        _inputs: &Self::Inputs,
        _gains: &Gains<Self::Real>,
        _h: Self::Real,
        _t_next: Self::Real,
    ) -> Option<Stepped<Self::States>> {
        None
    }

    /// The same with q̈ and λ at the start of the step, without feedback terms, in the
    /// operations of [`reactions`](Self::reactions); `sum` is finite only if these are
    /// too.
    #[inline(always)]
    #[allow(clippy::type_complexity, reason = "the parts have names")]
    fn fused_step_with_reactions<X: Method>(
        &self,
        _at: &State<Self::States>,
        _inputs: &Self::Inputs,
        _gains: &Gains<Self::Real>,
        _h: Self::Real,
        _t_next: Self::Real,
    ) -> Option<(Stepped<Self::States>, Reactions<Self::Coordinates, Self::Constraints>)> {
        None
    }

    /// The step of a mechanism with long vectors, in place, and its growth; nothing, and
    /// the state as it was, if there is none, or its growth is over `alarm`, or it is not
    /// finite.
    #[doc(hidden)]
    #[inline(always)]
    fn long_step<X: Method>(
        &self,
        _state: &mut State<Self::States>,
        _inputs: &Self::Inputs,
        _gains: &Gains<Self::Real>,
        _h: Self::Real,
        _t_next: Self::Real,
        _alarm: Self::Real,
    ) -> Option<Self::Real> {
        None
    }

    /// Solves for q̈ and λ of all coordinates and constraints with γ + `feedback` below.
    fn reactions(
        &self,
        at: &State<Self::Coordinates>,
        inputs: &Self::Inputs,
        feedback: &Self::Constraints,
    ) -> Reactions<Self::Coordinates, Self::Constraints>;

    /// The smallest Δq, in the norm of the mass matrix, with Φ_q Δq =
    /// `residual` and Δq = 0 for coordinates that `start` prescribes.
    fn position_correction(
        &self,
        t: Self::Real,
        q: &Self::Coordinates,
        residual: &Self::Constraints,
    ) -> Accelerations<Self::Coordinates>;

    /// The smallest Δv, in the norm of the mass matrix, with Φ_q Δv =
    /// `residual` and Δv = 0 for velocities that `start` prescribes.
    fn velocity_correction(
        &self,
        t: Self::Real,
        q: &Self::Coordinates,
        residual: &Self::Constraints,
    ) -> Accelerations<Self::Coordinates>;

    /// The smallest Δ, in the norm of the mass matrix, with Φ_q Δ = `violation`:
    ///
    /// ```text
    /// ⎡ M   Φ_qᵀ ⎤ ⎡ Δ ⎤   ⎡ 0         ⎤
    /// ⎣ Φ_q  0   ⎦ ⎣ μ ⎦ = ⎣ violation ⎦
    /// ```
    ///
    /// It is the elimination of [`reactions`](Self::reactions) with another right-hand
    /// side. q − Δ of Φ is a step of Newton's method to the constraints, v − Δ of Φ̇ is on
    /// their tangent.
    fn projection(
        &self,
        t: Self::Real,
        q: &Self::Coordinates,
        violation: &Self::Constraints,
    ) -> Accelerations<Self::Coordinates>;

    /// Index into [`Info::pivots`] of the pivot with the largest growth, and
    /// that growth, if the elimination has any pivot that can vanish. For
    /// diagnosis: slow.
    fn worst_pivot(&self, t: Self::Real, q: &Self::Coordinates) -> Option<(usize, Self::Real)>;

    /// The same for [`position_correction`](Self::position_correction) and
    /// [`velocity_correction`](Self::velocity_correction), as an index into
    /// [`Info::start_pivots`].
    fn worst_start_pivot(&self, t: Self::Real, q: &Self::Coordinates) -> Option<(usize, Self::Real)>;

    /// Kinetic energy ½ vᵀMv in J.
    fn kinetic_energy(&self, at: &State<Self::Coordinates>) -> Self::Real;

    /// Potential energy of gravity (0 at the origin) and springs in J.
    fn potential_energy(&self, at: &State<Self::Coordinates>) -> Self::Real;

    /// The first time behind `t` at which forces, constraints or events bend or jump because time passes a point of
    /// a table or the end of a piece, such as `if t < delay`, with the inputs as they are. Infinite where there is none.
    fn next_corner(&self, _t: Self::Real, _inputs: &Self::Inputs) -> Self::Real {
        Self::Real::from_f64(f64::INFINITY)
    }

    /// Writes the values of [`SWITCHES`](Self::SWITCHES).
    fn switches(&self, _at: &State<Self::Coordinates>, _inputs: &Self::Inputs, _values: &mut [Self::Real]) {}

    /// Writes the restitution of every [stop](Info::stops), and the share of its longest flight below which it is not left
    /// again; behind them the coefficients of friction of those that rub.
    fn stop_laws(&self, _laws: &mut [Self::Real]) {}

    /// Writes the gap of every stop, its rate and its second derivative with given accelerations; then the same of the way
    /// that every friction has slid.
    fn gaps(
        &self,
        _at: &State<Self::Coordinates>,
        _reactions: &Reactions<Self::Coordinates, Self::Constraints>,
        _gaps: &mut [Self::Real],
    ) {
    }

    /// Writes of every [friction](Info::frictions) that sticks its size while it slides, and the largest one with which it
    /// sticks.
    fn limits(
        &self,
        _at: &State<Self::Coordinates>,
        _inputs: &Self::Inputs,
        _reactions: &Reactions<Self::Coordinates, Self::Constraints>,
        _limits: &mut [Self::Real],
    ) {
    }

    /// Does something with the responses to unit impulses along the gaps of stops, the ways of frictions and constraints of modes: of each the changes Y of the
    /// velocities and those of the multipliers μ, and ∂g/∂q,
    ///
    /// ```text
    /// M Y + Φ_qᵀ μ = (∂g/∂q)ᵀ    Φ_q Y = 0
    /// ```
    ///
    /// then W = ∂g/∂q Y, one row per stop, and the pivot growth.
    fn contacts(&self, _t: Self::Real, _q: &Self::Coordinates, _what: &mut dyn FnMut(&[Self::Real])) {}

    /// The period and the offset of a clock in s: it samples at the times offset + k period, k whole.
    fn clock(&self, _clock: usize) -> [Self::Real; 2] {
        [Self::Real::from_f64(f64::NAN); 2]
    }

    /// Sets the memories of a clock as they are from a sample at this state on.
    fn sample(&self, _at: &State<Self::Coordinates>, _inputs: &mut Self::Inputs, _clock: usize) {}

    /// Writes the values of [transitions](crate::Modes::transitions), given q̈ and λ. Their sets are samples behind those of the
    /// clocks.
    fn transitions(
        &self,
        _at: &State<Self::Coordinates>,
        _inputs: &Self::Inputs,
        _reactions: &Reactions<Self::Coordinates, Self::Constraints>,
        _values: &mut [Self::Real],
    ) {
    }

    /// The declared outputs, given q̈ and λ.
    fn outputs(
        &self,
        at: &State<Self::Coordinates>,
        inputs: &Self::Inputs,
        reactions: &Reactions<Self::Coordinates, Self::Constraints>,
    ) -> Self::Outputs;

    /// The values whose changes of sign are the declared events, left − right of each.
    fn events(&self, at: &State<Self::Coordinates>, inputs: &Self::Inputs) -> Self::Events;

    /// Where every point of the [sketch](Self::SKETCH) is, in m in the ground
    /// frame. For pictures: nothing of it takes part in a step.
    fn points(&self, t: Self::Real, q: &Self::Coordinates) -> Self::Points;
}

/// True if the fused step of a mechanism is one of this method: that of its scheme, with
/// feedback.
pub(crate) const fn is_fused_for<M: Mechanism, X: Method>() -> bool {
    M::Scheme::TABLEAU.is(X::Scheme::TABLEAU) && !X::EXPLICIT.is_projected()
}

/// The pivot growth from which on a position counts as singular: 1/(1024 ε),
/// that is when fewer than ten bits of a pivot are left.
#[inline(always)]
pub fn growth_limit<T: Real>() -> T {
    T::from_f64(1.0 / 1024.0) / T::EPSILON
}
