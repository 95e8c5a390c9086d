//! The functions of a compiled mechanism: a row per function.

use mbs_symbolic::Operations;

use super::Compiled;

/// A function of a compiled mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FunctionId {
    /// The values that depend on parameters alone.
    Hoisted,
    /// Φ
    Phi,
    /// Φ̇ = Φ_q v + Φ_t
    PhiDot,
    /// The entries of Φ_q that are not 0; see [`Compiled::jacobian`].
    PhiQ,
    /// Φ_t
    PhiT,
    /// γ, so that Φ_q q̈ = γ
    Gamma,
    /// γ − 2αΦ̇ − β²Φ
    BaumgarteRhs,
    /// The diagonal of M; the other entries are 0.
    Mass,
    /// Q
    Forces,
    /// ½ vᵀMv
    KineticEnergy,
    /// That of gravity and springs.
    PotentialEnergy,
    /// q̈ of the states with feedback of their own violation, and this feedback.
    Stabilized,
    /// q̈ of the states with given feedback.
    Constrained,
    /// q̈ and λ with given feedback.
    Reactions,
    /// The shortest Δq, measured by masses, with Φ_q Δq = the given residual.
    PositionCorrection,
    /// The shortest Δv with Φ_q Δv = the given residual.
    VelocityCorrection,
    /// The same Δ with no coordinate held: what leads back to the constraints within a run.
    Projection,
    /// The declared outputs.
    Outputs,
    /// The values whose changes of sign are events.
    Events,
    /// The values that [`Compiled::conditions`] judge.
    Conditions,
    /// Declared q, v and t of the start.
    Start,
    /// The growth of every watched pivot.
    Pivots,
    /// The growth of every watched pivot of the corrections.
    StartPivots,
    /// x and y of every point of the sketch.
    Points,
    /// q and v of all coordinates, from those that are integrated.
    Complete,
    /// q̈ of the states in an implicit stage, one step of Newton's method from a predicted one.
    Implicit,
}

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

/// The kind of some of the outputs of a function.
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
    /// One number per watched pivot.
    Pivots,
    /// One number per watched pivot of the corrections.
    StartPivots,
    /// One number per output.
    Outputs,
    /// One number per event.
    Events,
    /// Two numbers per point.
    Points,
    /// One number.
    Scalar,
    /// The pivot growth of what was solved.
    Growth,
}

/// Name, arguments and results of a function.
struct Row(FunctionId, &'static str, &'static [Argument], &'static [Results]);

use Argument::{
    Feedback, Gains, Inputs, Positions, Predicted, Reactions, Shift, StatePositions, StateVelocities, Time,
    Velocities,
};
use Results::{Constraints, Coordinates, Growth, Scalar, States};

const TABLE: [Row; 26] = [
    Row(FunctionId::Hoisted, "new", &[], &[Results::Hoisted]),
    Row(FunctionId::Phi, "phi", &[Time, Positions], &[Constraints]),
    Row(FunctionId::PhiDot, "phi_dot", &[Time, Positions, Velocities], &[Constraints]),
    Row(FunctionId::PhiQ, "phi_q", &[Time, Positions], &[Results::Jacobian]),
    Row(FunctionId::PhiT, "phi_t", &[Time, Positions], &[Constraints]),
    Row(FunctionId::Gamma, "gamma", &[Time, Positions, Velocities], &[Constraints]),
    Row(FunctionId::BaumgarteRhs, "baumgarte_rhs", &[Time, Positions, Velocities, Gains], &[Constraints]),
    Row(FunctionId::Mass, "mass", &[Time, Positions], &[Coordinates]),
    Row(FunctionId::Forces, "forces", &[Time, Positions, Velocities, Inputs], &[Coordinates]),
    Row(FunctionId::KineticEnergy, "kinetic_energy", &[Time, Positions, Velocities], &[Scalar]),
    Row(FunctionId::PotentialEnergy, "potential_energy", &[Time, Positions, Velocities], &[Scalar]),
    Row(
        FunctionId::Stabilized,
        "stabilized",
        &[Time, StatePositions, StateVelocities, Inputs, Gains],
        &[States, Constraints, Growth],
    ),
    Row(
        FunctionId::Constrained,
        "constrained",
        &[Time, StatePositions, StateVelocities, Inputs, Feedback],
        &[States, Growth],
    ),
    Row(
        FunctionId::Reactions,
        "reactions",
        &[Time, Positions, Velocities, Inputs, Feedback],
        &[Coordinates, Constraints, Growth],
    ),
    Row(
        FunctionId::PositionCorrection,
        "position_correction",
        &[Time, Positions, Feedback],
        &[Coordinates, Growth],
    ),
    Row(
        FunctionId::VelocityCorrection,
        "velocity_correction",
        &[Time, Positions, Feedback],
        &[Coordinates, Growth],
    ),
    Row(FunctionId::Projection, "projection", &[Time, Positions, Feedback], &[Coordinates, Growth]),
    Row(
        FunctionId::Outputs,
        "outputs",
        &[Time, Positions, Velocities, Inputs, Reactions],
        &[Results::Outputs],
    ),
    Row(FunctionId::Events, "events", &[Time, Positions, Velocities, Inputs], &[Results::Events]),
    Row(FunctionId::Conditions, "conditions", &[], &[Results::Conditions]),
    Row(FunctionId::Start, "declared_start", &[], &[Coordinates, Coordinates, Scalar]),
    Row(FunctionId::Pivots, "pivots", &[Time, Positions], &[Results::Pivots]),
    Row(FunctionId::StartPivots, "start_pivots", &[Time, Positions], &[Results::StartPivots]),
    Row(FunctionId::Points, "points", &[Time, Positions], &[Results::Points]),
    Row(
        FunctionId::Complete,
        "complete",
        &[Time, StatePositions, StateVelocities],
        &[Coordinates, Coordinates],
    ),
    Row(
        FunctionId::Implicit,
        "implicit",
        &[Time, StatePositions, StateVelocities, Inputs, Shift, Predicted],
        &[States, Growth],
    ),
];

/// The functions that people are told the cost of.
const COUNTED: usize = 18;

impl FunctionId {
    /// All functions.
    pub fn all() -> impl Iterator<Item = Self> {
        TABLE.iter().map(|Row(id, ..)| *id)
    }

    /// Its name in generated code.
    pub fn name(self) -> &'static str {
        TABLE[self as usize].1
    }

    /// Its arguments.
    pub fn arguments(self) -> &'static [Argument] {
        TABLE[self as usize].2
    }

    /// Its results, one kind after the other.
    pub fn results(self) -> &'static [Results] {
        TABLE[self as usize].3
    }

    /// Whether it solves a system: then its last output is the pivot growth.
    pub fn solves(self) -> bool {
        self.results().last() == Some(&Growth)
    }
}

/// The cost of a call of a function.
pub struct Count {
    /// The function.
    pub function: FunctionId,
    /// Its operations, without those that watch pivots.
    pub operations: Operations,
    /// The operations that watch pivots.
    pub watch: u32,
}

impl Compiled {
    /// The costs of the functions that people ask for.
    pub fn counts(&self) -> Vec<Count> {
        let implicit = self.has_stiffness.then_some(FunctionId::Implicit);
        FunctionId::all().take(COUNTED).chain(implicit).map(|function| self.count(function)).collect()
    }

    /// The cost of a function.
    pub fn count(&self, function: FunctionId) -> Count {
        let program = self.program(function);
        let outputs = program.outputs.len();
        let operations = program.operations_for(outputs - usize::from(function.solves()));
        let watch = program.operations_for(outputs).total() - operations.total();
        Count { function, operations, watch }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_stand_in_the_order_of_their_functions() {
        assert!(FunctionId::all().enumerate().all(|(at, function)| function as usize == at));
    }
}
