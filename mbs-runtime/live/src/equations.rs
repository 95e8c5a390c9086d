//! A live mechanism as [`Equations`]: a function of the compiled mechanism behind each method.

use mbs_codegen::FunctionId;
use mbs_runtime::__private::worst;
use mbs_runtime::equations::{At, Described, Equations};
use mbs_runtime::{Derivation, Gains, Info, Sketch};

use crate::Live;
use crate::arguments::Arguments;

impl Equations<f64> for Live {
    fn info(&self) -> &Info {
        self.declared_info()
    }

    fn phi(&self, t: f64, q: &[f64], phi: &mut [f64]) {
        self.call(FunctionId::Phi, &position(t, q), [phi]);
    }

    fn phi_dot(&self, at: At<'_, f64>, phi_dot: &mut [f64]) {
        self.call(FunctionId::PhiDot, &state(at), [phi_dot]);
    }

    fn complete(&self, states: At<'_, f64>, q: &mut [f64], v: &mut [f64]) {
        self.call(FunctionId::Complete, &state(states), [q, v]);
    }

    fn stabilized(
        &self,
        states: At<'_, f64>,
        inputs: &[f64],
        gains: &Gains<f64>,
        acceleration: &mut [f64],
        feedback: &mut [f64],
    ) -> f64 {
        let arguments = Arguments { inputs: single(inputs), gains: both(gains), ..state(states) };
        self.solve(|growth| {
            self.call(FunctionId::Stabilized, &arguments, [acceleration, feedback, growth]);
        })
    }

    fn constrained(
        &self,
        states: At<'_, f64>,
        inputs: &[f64],
        feedback: &[f64],
        acceleration: &mut [f64],
    ) -> f64 {
        let arguments = Arguments { inputs: single(inputs), feedback: single(feedback), ..state(states) };
        self.solve(|growth| self.call(FunctionId::Constrained, &arguments, [acceleration, growth]))
    }

    fn accelerations(
        &self,
        at: At<'_, f64>,
        inputs: &[f64],
        feedback: &[f64],
        acceleration: &mut [f64],
    ) -> f64 {
        let mut multipliers = vec![f64::NAN; feedback.len()];
        let given = Arguments { inputs: single(inputs), feedback: single(feedback), ..state(at) };
        self.solve(|growth| {
            self.call(FunctionId::Reactions, &given, [acceleration, &mut multipliers, growth]);
        })
    }

    fn position_correction(&self, t: f64, q: &[f64], residual: &[f64], correction: &mut [f64]) -> f64 {
        let arguments = Arguments { feedback: single(residual), ..position(t, q) };
        self.solve(|growth| self.call(FunctionId::PositionCorrection, &arguments, [correction, growth]))
    }

    fn velocity_correction(&self, t: f64, q: &[f64], residual: &[f64], correction: &mut [f64]) -> f64 {
        let arguments = Arguments { feedback: single(residual), ..position(t, q) };
        self.solve(|growth| self.call(FunctionId::VelocityCorrection, &arguments, [correction, growth]))
    }

    fn projection(&self, t: f64, q: &[f64], violation: &[f64], correction: &mut [f64]) -> f64 {
        let arguments = Arguments { feedback: single(violation), ..position(t, q) };
        self.solve(|growth| self.call(FunctionId::Projection, &arguments, [correction, growth]))
    }

    fn worst_pivot(&self, t: f64, q: &[f64]) -> Option<(usize, f64)> {
        self.worst_of(FunctionId::Pivots, t, q)
    }

    fn worst_start_pivot(&self, t: f64, q: &[f64]) -> Option<(usize, f64)> {
        self.worst_of(FunctionId::StartPivots, t, q)
    }

    fn kinetic_energy(&self, at: At<'_, f64>) -> f64 {
        let mut energy = [f64::NAN];
        self.call(FunctionId::KineticEnergy, &state(at), [&mut energy]);
        energy[0]
    }
}

impl Described<f64> for Live {
    fn reactions(
        &self,
        at: At<'_, f64>,
        inputs: &[f64],
        acceleration: &mut [f64],
        multipliers: &mut [f64],
    ) -> f64 {
        let no_feedback = vec![0.0; self.declared_info().constraints.len()];
        let given = Arguments { inputs: single(inputs), feedback: single(&no_feedback), ..state(at) };
        self.solve(|growth| self.call(FunctionId::Reactions, &given, [acceleration, multipliers, growth]))
    }

    fn outputs(
        &self,
        at: At<'_, f64>,
        inputs: &[f64],
        [acceleration, multipliers]: [&[f64]; 2],
        outputs: &mut [f64],
    ) {
        let [acceleration, multipliers] = [acceleration, multipliers].map(single);
        let given = Arguments { inputs: single(inputs), acceleration, multipliers, ..state(at) };
        self.call(FunctionId::Outputs, &given, [outputs]);
    }

    fn events(&self, at: At<'_, f64>, inputs: &[f64], values: &mut [f64]) {
        let given = Arguments { inputs: single(inputs), ..state(at) };
        self.call(FunctionId::Events, &given, [values]);
    }

    fn potential_energy(&self, at: At<'_, f64>) -> f64 {
        let mut energy = [f64::NAN];
        self.call(FunctionId::PotentialEnergy, &state(at), [&mut energy]);
        energy[0]
    }

    fn points(&self, t: f64, q: &[f64], points: &mut [f64]) {
        self.call(FunctionId::Points, &position(t, q), [points]);
    }

    fn parameters(&self, parameters: &mut [f64]) {
        parameters.iter_mut().zip(Self::parameters(self)).for_each(|(to, from)| *to = *from);
    }

    fn derivation(&self) -> &Derivation {
        Self::derivation(self)
    }

    fn sketch(&self) -> &Sketch {
        Self::sketch(self)
    }
}

impl Live {
    /// The growth that a function gives which solves.
    fn solve(&self, call: impl FnOnce(&mut [f64])) -> f64 {
        let mut growth = [f64::NAN];
        call(&mut growth);
        growth[0]
    }

    fn worst_of(&self, pivots: FunctionId, t: f64, q: &[f64]) -> Option<(usize, f64)> {
        let mut growths = vec![f64::NAN; self.programs().function(pivots).outputs.len()];
        self.call(pivots, &position(t, q), [&mut growths]);
        worst(&growths)
    }
}

/// A vector of single numbers, as functions are given it.
pub(crate) fn single(vector: &[f64]) -> &[[f64; 1]] {
    vector.as_chunks().0
}

/// The gains as functions are given them.
pub(crate) fn both(gains: &Gains<f64>) -> [[f64; 1]; 2] {
    [[gains.minus_two_alpha], [gains.minus_beta_squared]]
}

/// Time and positions as functions are given them.
pub(crate) fn position(t: f64, q: &[f64]) -> Arguments<'_> {
    Arguments { t: [t], q: single(q), ..Arguments::default() }
}

/// Time, positions and velocities as functions are given them.
pub(crate) fn state<'a>(at: At<'a, f64>) -> Arguments<'a> {
    Arguments { v: single(at.v), ..position(at.t, at.q) }
}
