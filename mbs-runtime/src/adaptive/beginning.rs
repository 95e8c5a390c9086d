//! Where a run begins.

use crate::equations::{Preparation, Start};
use crate::{Dynamics, Error, Real, Scheme};

/// A mechanism with the inputs and the state from which a run of it begins.
#[derive(Clone)]
pub struct Beginning<D: Dynamics> {
    pub dynamics: D,
    pub inputs: D::Inputs,
    /// t, q and v.
    pub state: (D::Real, D::Coordinates, D::Coordinates),
    /// How the state becomes the start of the run.
    pub start: Start,
}

impl<D: Dynamics> Beginning<D> {
    /// The declared start, made consistent, with the default inputs.
    pub fn new(dynamics: D) -> Self {
        let (inputs, state) = (dynamics.default_inputs(), dynamics.declared_start());
        Self { dynamics, inputs, state, start: Start::Declared }
    }

    /// Prepares the state for a run with steps of `step` seconds; the value is the size of the
    /// mechanism, by which its redundant constraints are watched.
    ///
    /// # Errors
    /// Those of [`Preparation::prepare`].
    pub fn prepare<S: Scheme>(&mut self, step: f64) -> Result<D::Real, Error> {
        let Self { dynamics, inputs, state: (t, q, v), start } = self;
        let mut length = D::Real::default();
        dynamics.with_inputs(inputs, |inputs| {
            let step = D::Real::from_f64(step);
            let preparation = Preparation { start: *start, inputs, step, keeps_constraints: true };
            dynamics.with_room::<S>(|room| {
                length = preparation.prepare(dynamics.equations(), *t, q.as_mut(), v.as_mut(), room)?;
                Ok(())
            })
        })?;
        Ok(length)
    }
}
