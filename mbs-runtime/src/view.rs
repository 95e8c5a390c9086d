//! A mechanism seen in one state.

use crate::diagnosis::{Solution, check_defined, check_inputs, check_solution};
use crate::equations::{At, check_outputs};
use crate::{Dynamics, Error, vectors};

/// A mechanism in a state of all its coordinates, with inputs: what a [`System`](crate::System)
/// tells of its present state.
pub(crate) struct View<'a, D: Dynamics> {
    pub dynamics: &'a D,
    pub inputs: &'a D::Inputs,
    pub at: At<'a, D::Real>,
}

impl<D: Dynamics> View<'_, D> {
    /// Does something with the present inputs as a slice.
    pub fn with_inputs<R>(&self, what: impl FnOnce(&[D::Real]) -> R) -> R {
        let mut inputs = self.dynamics.inputs_at(self.at.t, self.inputs);
        self.dynamics.with_inputs(&mut inputs, |inputs| what(inputs))
    }

    /// See [`System::reactions`](crate::System::reactions).
    pub fn reactions(&self, acceleration: &mut [D::Real], multipliers: &mut [D::Real]) -> Result<(), Error> {
        let At { t, q, .. } = self.at;
        let mechanism = self.dynamics.equations();
        let growth =
            self.with_inputs(|inputs| mechanism.reactions(self.at, inputs, acceleration, multipliers));
        let info = mechanism.info();
        let solution = Solution { t, q, value: acceleration, growth, info, pivots: info.pivots };
        let name = |row| info.constraint_name(row);
        check_solution(&solution, || mechanism.worst_pivot(t, q))
            .and_then(|()| check_defined(t, "the multiplier of constraint", multipliers, name))
            // an input that is not finite is the cause of whatever failed after it
            .map_err(|error| self.with_inputs(|inputs| check_inputs(info, inputs)).err().unwrap_or(error))
    }

    /// See [`System::outputs`](crate::System::outputs).
    pub fn outputs(
        &self,
        acceleration: &[D::Real],
        multipliers: &[D::Real],
        outputs: &mut [D::Real],
    ) -> Result<(), Error> {
        let mechanism = self.dynamics.equations();
        self.with_inputs(|inputs| mechanism.outputs(self.at, inputs, [acceleration, multipliers], outputs));
        check_outputs(mechanism.info(), self.at.t, outputs)
    }

    /// ‖Φ‖ and ‖Φ̇‖
    pub fn violations(&self) -> [D::Real; 2] {
        let mut rows = self.dynamics.no_feedback();
        let equations = self.dynamics.equations();
        equations.phi(self.at.t, self.at.q, rows.as_mut());
        let violation = vectors::norm(rows.as_ref());
        equations.phi_dot(self.at, rows.as_mut());
        [violation, vectors::norm(rows.as_ref())]
    }
}
