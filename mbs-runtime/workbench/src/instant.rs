//! A run at an instant.

use mbs_runtime::{Info, System};

/// The state and the results of a run at an instant, in room that is made once.
pub(crate) struct Instant {
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub acceleration: Vec<f64>,
    pub multipliers: Vec<f64>,
    pub outputs: Vec<f64>,
    pub inputs: Vec<f64>,
}

impl Instant {
    pub fn new(info: &Info) -> Self {
        let coordinates = || vec![0.0; info.coordinates.len()];
        Self {
            q: coordinates(),
            v: coordinates(),
            acceleration: coordinates(),
            multipliers: vec![0.0; info.constraints.len()],
            outputs: vec![0.0; info.outputs.len()],
            inputs: vec![0.0; info.inputs.len()],
        }
    }

    /// Takes the state, with memories.
    pub fn see(&mut self, run: &dyn System) {
        run.state(&mut self.q, &mut self.v);
        run.inputs(&mut self.inputs);
    }

    /// Takes accelerations and multipliers.
    pub fn solve(&mut self, run: &dyn System) -> Result<(), mbs_runtime::Error> {
        run.reactions(&mut self.acceleration, &mut self.multipliers)
    }

    /// Takes what is measured, which may be an error and is written all the same.
    pub fn measure(&mut self, run: &dyn System) -> Result<(), mbs_runtime::Error> {
        run.outputs(&self.acceleration, &self.multipliers, &mut self.outputs)
    }
}
