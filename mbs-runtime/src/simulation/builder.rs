//! What can be chosen before a simulation starts.

use super::{Simulation, check_inputs};
use crate::{Baumgarte, Error, Feedback, Held, Mechanism, Real, State, start};

/// The choices before a simulation starts; see [`Simulation::builder`].
#[derive(Clone, Copy, Debug)]
pub struct Builder<M: Mechanism, F: Feedback = Held> {
    mechanism: M,
    step: f64,
    baumgarte: Baumgarte<F>,
    inputs: M::Inputs,
    state: State<M::Coordinates>,
    make_consistent: bool,
    allow_unstable: bool,
}

impl<M: Mechanism> Builder<M> {
    pub(super) fn new(mechanism: M, step: f64) -> Self {
        Self {
            mechanism,
            step,
            baumgarte: Baumgarte::deadbeat(step),
            inputs: M::Inputs::default(),
            state: mechanism.declared_start(),
            make_consistent: true,
            allow_unstable: false,
        }
    }
}

impl<M: Mechanism, F: Feedback> Builder<M, F> {
    /// Feedback of the constraint violation. Default: [`Baumgarte::deadbeat`]
    /// of the step, held.
    #[must_use]
    pub fn baumgarte<G: Feedback>(self, baumgarte: Baumgarte<G>) -> Builder<M, G> {
        Builder {
            mechanism: self.mechanism,
            step: self.step,
            baumgarte,
            inputs: self.inputs,
            state: self.state,
            make_consistent: self.make_consistent,
            allow_unstable: self.allow_unstable,
        }
    }

    /// Starts from `state` instead of the declared start.
    #[must_use]
    pub fn from_state(mut self, state: State<M::Coordinates>) -> Self {
        self.state = state;
        self
    }

    /// Keeps the start as it is, even if it violates Φ = 0 or Φ̇ = 0. Default:
    /// it is made [`consistent`](start::consistent).
    #[must_use]
    pub fn as_declared(mut self) -> Self {
        self.make_consistent = false;
        self
    }

    /// The inputs of the first step.
    #[must_use]
    pub fn inputs(mut self, inputs: M::Inputs) -> Self {
        self.inputs = inputs;
        self
    }

    /// Accepts gains under which violations grow, for the study of them.
    #[must_use]
    pub fn allow_unstable(mut self) -> Self {
        self.allow_unstable = true;
        self
    }

    /// Starts.
    ///
    /// # Errors
    /// [`Error::Step`], [`Error::UnstableGains`], [`Error::Input`],
    /// [`Error::NonFinite`], and those of [`start::consistent`].
    pub fn build(self) -> Result<Simulation<M, F>, Error> {
        let step = self.step;
        // as the scalar holds it: 1e-60 s is 0 in `f32`
        let h = M::Real::from_f64(step);
        if !(h > M::Real::default() && h.is_finite()) {
            return Err(Error::Step { step });
        }
        if !self.allow_unstable && !self.baumgarte.is_stable(step) {
            let (alpha, beta) = (self.baumgarte.alpha(), self.baumgarte.beta());
            return Err(Error::UnstableGains { alpha, beta, step, feedback: F::NAME });
        }
        check_inputs::<M>(&self.inputs)?;
        let state =
            if self.make_consistent { start::consistent(&self.mechanism, &self.state)? } else { self.state };
        crate::heun::check_finite(&state)?;
        Ok(Simulation {
            mechanism: self.mechanism,
            inputs: self.inputs,
            state,
            baumgarte: self.baumgarte,
            gains: self.baumgarte.gains(),
            step: h,
            start_time: state.t,
            steps: 0,
        })
    }
}
