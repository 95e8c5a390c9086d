//! The interface between a method and the run that takes its steps.

use crate::adaptive::Moment;
use crate::{Dynamics, Error, Info};

/// A method with room for its vectors: [`RattleStep`](crate::RattleStep),
/// [`TrBdf2Step`](crate::TrBdf2Step), or one of another crate, which
/// [`ConstantStepBuilder::new`](crate::ConstantStepBuilder::new) takes. A method may take steps of
/// its own within a step of the run.
pub trait Kernel<D: Dynamics>: Clone + Send {
    /// The word that asks for it.
    fn word(&self) -> &'static str;

    /// Checks that the method can integrate a mechanism.
    ///
    /// # Errors
    /// The mechanism has a property that the method does not support.
    fn check(&self, info: &Info) -> Result<(), Error>;

    /// Writes the acceleration of a moment at the start and where inputs have changed, when it holds
    /// that of the step before; its growth.
    fn accelerate(
        &mut self,
        dynamics: &D,
        inputs: &D::Inputs,
        _h: D::Real,
        moment: &mut Moment<D::Real, D::States>,
    ) -> D::Real {
        let Moment { t, q, v, a } = moment;
        dynamics.free_acceleration(*t, q, v, inputs, a)
    }

    /// A step of `h` seconds to `t_next`, on `moment`, whose acceleration is known and becomes that
    /// of the end. The growths of all that was solved, added; nothing if there is no such step.
    fn step(
        &mut self,
        dynamics: &D,
        inputs: &D::Inputs,
        h: D::Real,
        t_next: D::Real,
        moment: &mut Moment<D::Real, D::States>,
    ) -> Option<D::Real>;

    /// Why there was no step, where the method has found it out itself. Otherwise explicit steps look for it.
    fn failure(&self) -> Option<Error> {
        None
    }
}
