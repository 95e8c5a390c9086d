//! The functions of a mechanism, one row of a table each.
//!
//! The compiler makes a program of each, every target prints them, and runs call them by this table. A new
//! function is a row here, its roots in the plan of the compiler, and its caller.

/// An argument of a function. All functions are given the parameters and what depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Argument {
    /// t
    Time,
    /// q
    Positions,
    /// v
    Velocities,
    /// The positions of the coordinates that are integrated.
    StatePositions,
    /// The velocities of the coordinates that are integrated.
    StateVelocities,
    /// The inputs.
    Inputs,
    /// −2α and −β²
    Gains,
    /// An amount added to γ per constraint; of corrections, the residual.
    Feedback,
    /// q̈ and λ
    Reactions,
    /// s of an implicit stage.
    Shift,
    /// The predicted q̈ of the states in an implicit stage.
    Predicted,
}

/// The kind of some of the results of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Results {
    /// Values that depend on parameters alone.
    Hoisted,
    /// Values that conditions judge.
    Conditions,
    /// One number per coordinate.
    Coordinates,
    /// One number per coordinate that is integrated.
    States,
    /// One number per constraint.
    Constraints,
    /// One number per entry of the Jacobian that is not 0.
    Jacobian,
    /// One number per coordinate, and one per pair of coordinates whose entry of M is not 0.
    Masses,
    /// One number per watched pivot.
    Pivots,
    /// One number per watched pivot of the corrections.
    StartPivots,
    /// One number per output.
    Outputs,
    /// One number per event.
    Events,
    /// Two numbers per corner over time.
    Corners,
    /// One number per switch.
    Switches,
    /// Period and offset of every clock.
    Clocks,
    /// Restitution and settling of every stop.
    Stops,
    /// The gap of every stop and the way that every friction has slid, its rate and its second derivative.
    Gaps,
    /// The size of every friction that sticks while it slides, and the largest one with which it sticks.
    Limits,
    /// Of each of these what a unit impulse along it does to velocities and multipliers, and its slopes; then how all
    /// impulses change their rates, and the pivot growth.
    Contacts,
    /// One number per memory that a clock or a transition sets.
    Samples,
    /// One number per transition.
    Transitions,
    /// Two numbers per point.
    Points,
    /// One number.
    Scalar,
    /// The pivot growth of the elimination.
    Growth,
}

/// A property of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Property {
    /// People are told its cost.
    Counted,
    /// It is a method of generated types: it gives one vector, or one number, of positions, velocities and inputs.
    Method,
    /// It is differentiated along a direction, for functional mock-up units.
    Tangent,
    /// It is transposed, for gradients in reverse.
    Transposed,
    /// It computes itself what depends on parameters alone, and shares nothing with functions of a run.
    Whole,
    /// It exists only where a force depends on positions or velocities.
    Stiff,
    /// It exists only where clocks sample or transitions happen.
    Sampled,
    /// It exists only where there are stops.
    Stopping,
    /// Runs to a tolerance call it, and nobody else: other languages do not have it.
    Adaptive,
}

/// The row of a function.
#[derive(Debug)]
pub struct FunctionRow {
    /// The function.
    pub function: FunctionId,
    /// Its results in a sentence.
    pub doc: &'static str,
    /// Its name in generated code.
    pub name: &'static str,
    /// Its arguments, in their order.
    pub arguments: &'static [Argument],
    /// The kinds of its results, one after the other.
    pub results: &'static [Results],
    /// The names of the results, in generated code that writes them.
    pub result_names: &'static [&'static str],
    properties: &'static [Property],
}

macro_rules! functions {
    ($(
        #[doc = $doc:literal]
        $function:ident = $name:literal($($argument:ident),*) -> [$($result:ident: $kind:ident),*], $properties:expr;
    )*) => {
        /// A function of a mechanism.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum FunctionId {
            $(#[doc = $doc] $function,)*
        }

        /// The table, in the order of [`FunctionId`].
        pub const FUNCTIONS: &[FunctionRow] = &[$(FunctionRow {
            function: FunctionId::$function,
            doc: $doc,
            name: $name,
            arguments: &[$(Argument::$argument),*],
            results: &[$(Results::$kind),*],
            result_names: &[$(stringify!($result)),*],
            properties: &$properties,
        },)*];
    };
}

use Property::{Adaptive, Counted, Method, Sampled, Stiff, Stopping, Tangent, Transposed, Whole};

functions! {
    /// The values that depend on parameters alone.
    Hoisted = "new"() -> [result: Hoisted], [Counted, Transposed, Whole];
    /// The constraints Φ(q, t): 0 where the mechanism is assembled.
    Phi = "phi"(Time, Positions) -> [result: Constraints], [Counted, Method, Transposed];
    /// The constraint violation in velocities, Φ̇ = Φ_q v + Φ_t.
    PhiDot = "phi_dot"(Time, Positions, Velocities) -> [result: Constraints], [Counted, Method, Transposed];
    /// The entries of the Jacobian Φ_q that are not 0, as the table of places has them.
    PhiQ = "phi_q"(Time, Positions) -> [result: Jacobian], [Counted];
    /// The partial time derivative Φ_t; velocities satisfy Φ_q v = −Φ_t.
    PhiT = "phi_t"(Time, Positions) -> [result: Constraints], [Counted, Method];
    /// γ = −(Φ_q v)_q v − 2Φ_qt v − Φ_tt, so that Φ_q q̈ = γ (Jiang 2025, Eq. 5).
    Gamma = "gamma"(Time, Positions, Velocities) -> [result: Constraints], [Counted, Method];
    /// γ − 2αΦ̇ − β²Φ, the right-hand side with feedback of the violation (Jiang 2025, Eq. 8).
    BaumgarteRhs = "baumgarte_rhs"(Time, Positions, Velocities, Gains) -> [result: Constraints], [Counted];
    /// The diagonal of the mass matrix M, and its other entries that are not 0, as the table of places has them.
    Mass = "mass"(Time, Positions) -> [result: Masses], [Counted];
    /// The generalized forces Q: gravity and applied loads, and centrifugal and Coriolis forces of particles.
    Forces = "forces"(Time, Positions, Velocities, Inputs) -> [result: Coordinates], [Counted, Method];
    /// The kinetic energy ½ vᵀMv in J.
    KineticEnergy = "kinetic_energy"(Time, Positions, Velocities) -> [energy: Scalar], [Counted, Method];
    /// The potential energy of gravity and springs in J.
    PotentialEnergy = "potential_energy"(Time, Positions, Velocities) -> [energy: Scalar], [Counted, Method];
    /// Accelerations of what is integrated, with feedback of its own violation, and this feedback.
    Stabilized = "stabilized"(Time, StatePositions, StateVelocities, Inputs, Gains)
        -> [acceleration: States, feedback: Constraints, growth: Growth], [Counted, Tangent, Transposed];
    /// Accelerations of what is integrated, with the given feedback.
    Constrained = "constrained"(Time, StatePositions, StateVelocities, Inputs, Feedback)
        -> [result: States, growth: Growth], [Counted, Transposed];
    /// q̈ and λ from M q̈ + Φ_qᵀ λ = Q and Φ_q q̈ = γ + feedback.
    Reactions = "reactions"(Time, Positions, Velocities, Inputs, Feedback)
        -> [acceleration: Coordinates, multipliers: Constraints, growth: Growth], [Counted, Tangent, Transposed];
    /// The shortest Δq by masses, with Φ_q Δq = feedback; prescribed coordinates do not move.
    PositionCorrection = "position_correction"(Time, Positions, Feedback)
        -> [result: Coordinates, growth: Growth], [Counted];
    /// The shortest Δv by masses, with Φ_q Δv = feedback; prescribed velocities do not change.
    VelocityCorrection = "velocity_correction"(Time, Positions, Feedback)
        -> [result: Coordinates, growth: Growth], [Counted];
    /// The same Δq or Δv with no coordinate prescribed: it leads back to the constraints within a run.
    Projection = "projection"(Time, Positions, Feedback)
        -> [result: Coordinates, growth: Growth], [Counted, Transposed];
    /// The declared outputs.
    Outputs = "outputs"(Time, Positions, Velocities, Inputs, Reactions)
        -> [result: Outputs], [Counted, Tangent, Transposed];
    /// The values whose changes of sign are declared as events.
    Events = "events"(Time, Positions, Velocities, Inputs) -> [result: Events], [Tangent];
    /// The rate a and the offset b of values a t + b at whose knots forces, constraints or events bend or jump.
    Corners = "corners"(Inputs) -> [result: Corners], [Adaptive, Whole];
    /// The values at whose knots forces, constraints or events bend or jump, beside those of time alone.
    Switches = "switches"(Time, Positions, Velocities, Inputs) -> [result: Switches], [Adaptive, Whole];
    /// Restitution and settling of every stop, behind them the coefficients of friction of those that rub.
    Stops = "stop_laws"() -> [result: Stops], [Stopping, Whole];
    /// The gap of every stop and the way that every friction has slid, its rate and its second derivative with given accelerations.
    Gaps = "gaps"(Time, Positions, Velocities, Reactions) -> [result: Gaps], [Counted, Stopping];
    /// The size of every friction that sticks while it slides, and the largest one with which it sticks.
    Limits = "limits"(Time, Positions, Velocities, Inputs, Reactions) -> [result: Limits], [Counted, Stopping];
    /// Y and μ of M Y + Φ_qᵀ μ = ∂g/∂q, Φ_q Y = 0 for each of these g, and W = ∂g/∂q Y.
    Contacts = "contacts"(Time, Positions) -> [result: Contacts], [Counted, Stopping];
    /// The period and the offset of every clock in s.
    Clocks = "clocks"() -> [result: Clocks], [Sampled, Whole];
    /// The values that every clock sets its memories to, one clock after the other.
    Samples = "samples"(Time, Positions, Velocities, Inputs) -> [result: Samples], [Counted, Sampled];
    /// The values whose change of sign is that of a transition.
    Transitions = "transitions"(Time, Positions, Velocities, Inputs, Reactions) -> [result: Transitions], [Sampled];
    /// The values that the conditions of the parameters judge.
    Conditions = "conditions"() -> [result: Conditions], [Whole];
    /// The declared start, before guesses are corrected. Returns its time.
    Start = "declared_start"() -> [q: Coordinates, v: Coordinates, t: Scalar], [Whole];
    /// The growth of every pivot that may vanish.
    Pivots = "pivots"(Time, Positions) -> [result: Pivots], [];
    /// The growth of every pivot of the corrections.
    StartPivots = "start_pivots"(Time, Positions) -> [result: StartPivots], [];
    /// The places of the points of the mechanism in m: x and y of each.
    Points = "points"(Time, Positions) -> [result: Points], [Whole];
    /// All coordinates and velocities, from those that are integrated.
    Complete = "complete"(Time, StatePositions, StateVelocities)
        -> [q_all: Coordinates, v_all: Coordinates], [Tangent, Transposed];
    /// Accelerations of what is integrated in an implicit stage, by one step of Newton's method from predicted ones.
    Implicit = "implicit"(Time, StatePositions, StateVelocities, Inputs, Shift, Predicted)
        -> [result: States, growth: Growth], [Counted, Stiff];
    /// The kinetic momentum p = Mv; ½ pᵀv is the kinetic energy.
    KineticMomentum = "kinetic_momentum"(Time, Positions, Velocities) -> [result: Coordinates], [Method];
}

impl FunctionId {
    /// All functions.
    pub fn all() -> impl Iterator<Item = Self> {
        FUNCTIONS.iter().map(|row| row.function)
    }

    /// Its row of the table.
    pub fn row(self) -> &'static FunctionRow {
        // in the order of the functions, by the macro that makes both
        &FUNCTIONS[self as usize]
    }

    /// Its name in generated code.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// Its arguments.
    pub fn arguments(self) -> &'static [Argument] {
        self.row().arguments
    }

    /// Its results, one kind after the other.
    pub fn results(self) -> &'static [Results] {
        self.row().results
    }

    /// True if it has a property.
    pub fn is(self, property: Property) -> bool {
        self.row().properties.contains(&property)
    }

    /// True if it solves a system: then its last result is the pivot growth.
    pub fn solves(self) -> bool {
        self.results().last() == Some(&Results::Growth)
    }

    /// The kinds of results that it writes, with their names: all but a last single number, which is returned.
    pub fn written(self) -> impl Iterator<Item = (&'static str, Results)> {
        let row = self.row();
        let written = row.results.len() - usize::from(self.returns());
        row.result_names.iter().copied().zip(row.results.iter().copied()).take(written)
    }

    /// True if its last result is a single number, which is returned.
    pub fn returns(self) -> bool {
        matches!(self.results().last(), Some(Results::Growth | Results::Scalar))
    }
}
