//! A run that can be gone back through, whatever its mechanism was made from.

use super::{Adjoints, Function, Given};
use crate::equations::At;
use crate::{Error, Explicit, Gains, Info};

/// A run with a constant step, and the functions of its mechanism forward and backward, on slices.
pub trait Reversible {
    /// Names and dimensions.
    fn info(&self) -> &'static Info;

    /// The method of the run.
    fn method(&self) -> Explicit;

    /// The gains of its feedback.
    fn gains(&self) -> Gains<f64>;

    /// h in s
    fn step_size(&self) -> f64;

    /// The function that is a whole step, if there is one.
    fn whole_step(&self) -> Option<Function>;

    /// How many values depend on parameters alone.
    fn hoisted(&self) -> usize;

    /// The present time in s.
    fn time(&self) -> f64;

    /// Writes the present positions and velocities of what is integrated.
    fn states(&self, q: &mut [f64], v: &mut [f64]);

    /// Writes the inputs.
    fn inputs(&self, inputs: &mut [f64]);

    /// Sets the inputs.
    fn set_inputs(&mut self, inputs: &[f64]);

    /// A step.
    ///
    /// # Errors
    /// Those of a run.
    fn step(&mut self) -> Result<(), Error>;

    /// Goes to the start of the step with this number, the first one being 0, from which the run has been
    /// before: `at` has the time and what is integrated.
    fn go_to(&mut self, step: u64, at: At<'_, f64>);

    /// Writes the results of a function, one vector after the other. A whole step is not asked for.
    fn forward(&mut self, function: Function, given: &Given<'_, f64>, results: &mut [&mut [f64]]);

    /// Adds to the adjoints of what a function reads, from the weights of its results; see
    /// [`Transposed::transposed`](super::Transposed::transposed).
    fn backward(
        &mut self,
        function: Function,
        given: &Given<'_, f64>,
        weights: &[f64],
        adjoints: &mut Adjoints<'_, f64>,
    );
}
