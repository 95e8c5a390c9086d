//! Samples of the clocks of a run.

use mbs_runtime::Real;
use mbs_runtime::equations::{At, Grid};

use super::Run;

impl<T: Real> Run<T> {
    /// The steps, by which clocks are told.
    pub(super) fn grid(&self) -> Grid {
        Grid { start: self.start_time.to_f64(), step: self.step.to_f64() }
    }

    /// Takes the samples that are due.
    pub(super) fn sample(&mut self) {
        if self.mechanism.declared_info().sampling.clocks > 0 {
            let [q, v] = self.completed();
            let at = At { t: self.t, q: &q, v: &v };
            self.grid().sample(self.steps, &self.mechanism, at, &mut self.inputs);
        }
    }
}
