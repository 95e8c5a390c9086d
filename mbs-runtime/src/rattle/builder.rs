//! The choices before a run of RATTLE starts.

use mbs_schemes::{Composition, RATTLE};

use super::{Rattle, Substep};
use crate::adaptive::{Beginning, Moment};
use crate::equations::Start;
use crate::watch::Watch;
use crate::{Components, Dynamics, Error, Heun, Mechanism, Real, State};

/// The choices before a run of RATTLE starts; see [`Rattle::builder`].
#[derive(Clone)]
pub struct RattleBuilder<D: Dynamics> {
    beginning: Beginning<D>,
    step: f64,
    composition: &'static Composition,
}

impl<D: Dynamics> Rattle<D> {
    /// Choices to make before the start. Without any: the declared start, made consistent, steps
    /// of `step` seconds of second order, inputs at their defaults.
    pub fn builder(mechanism: D, step: f64) -> RattleBuilder<D> {
        RattleBuilder { beginning: Beginning::new(mechanism), step, composition: &RATTLE }
    }
}

impl<D: Dynamics> RattleBuilder<D> {
    /// What a step is composed of: [`RATTLE`](crate::RATTLE) itself, of second order, or
    /// [`RATTLE4`](crate::RATTLE4), five steps that make one of fourth order.
    ///
    /// # Example
    /// ```
    /// use mbs_runtime::{RATTLE4, Rattle, mechanism};
    /// # mechanism! {
    /// #     pub Pendulum {
    /// #         dof = 1;
    /// #         param length = 1 [m];
    /// #         gravity = (0, -9.81) [m/s^2];
    /// #         body bob (x, y) { mass = 2 [kg]; }
    /// #         constraint rod: x^2 + y^2 = length^2;
    /// #         start { x = length; guess y = 0; }
    /// #     }
    /// # }
    /// let mut swing =
    ///     Rattle::builder(Pendulum::declared(), 1e-2).composition(&RATTLE4).build()?;
    /// swing.advance_to(10.0)?;
    /// assert!(swing.energy().abs() < 1e-6);
    /// # Ok::<(), mbs_runtime::Error>(())
    /// ```
    #[must_use]
    pub fn composition(self, composition: &'static Composition) -> Self {
        Self { composition, ..self }
    }

    /// The inputs of the first step.
    #[must_use]
    pub fn inputs(mut self, inputs: D::Inputs) -> Self {
        self.beginning.inputs = inputs;
        self
    }

    /// Starts at `t` from positions and velocities that have to be consistent.
    #[must_use]
    pub fn from_vectors(mut self, t: D::Real, q: D::Coordinates, v: D::Coordinates) -> Self {
        (self.beginning.state, self.beginning.start) = ((t, q, v), Start::Given);
        self
    }

    /// Keeps the start as it is, consistent or not; the first step leads to the constraints.
    #[must_use]
    pub fn as_declared(mut self) -> Self {
        self.beginning.start = Start::Unchecked;
        self
    }

    /// Starts.
    ///
    /// # Errors
    /// [`Error::VelocityForce`] for forces that depend on velocities or reactions,
    /// [`Error::ReducedStates`] for a mechanism that does not integrate all of its coordinates,
    /// [`Error::Step`], and those of the start of a [`Simulation`](crate::Simulation).
    pub fn build(self) -> Result<Rattle<D>, Error> {
        let Self { mut beginning, step, composition } = self;
        let info = *beginning.dynamics.equations().info();
        if let Some(&at) = info.velocity_forces.first() {
            return Err(Error::VelocityForce { coordinate: info.coordinate_name(at) });
        }
        if info.has_reduced_states() {
            return Err(Error::ReducedStates { method: composition.word });
        }
        let h = D::Real::from_f64(step);
        if !(h > D::Real::default() && h.is_finite()) {
            return Err(Error::Step { step });
        }
        let length = beginning.prepare::<Heun>(step)?;
        let Beginning { dynamics, inputs, state: (t, q, v), .. } = beginning;
        let (states, rates) = (dynamics.states(&q), dynamics.states(&v));
        let now = Moment { t, a: states.clone(), q: states, v: rates };
        let mut run = Rattle {
            next: now.clone(),
            substep: Substep { from: now.q.clone(), delta: now.q.clone() },
            now,
            all: [q, v],
            dynamics,
            inputs,
            composition,
            step: h,
            start_time: t.to_f64(),
            steps: 0,
            is_solved: false,
            watch: Watch::new(length),
        };
        run.solve()?;
        Ok(run)
    }
}

impl<M: Mechanism> RattleBuilder<M> {
    /// Starts from a state that has to be [`check`](crate::start::check)ed for consistency.
    #[must_use]
    pub fn from_state(self, state: State<M::Coordinates>) -> Self {
        self.from_vectors(state.t, state.q.into_array(), state.v.into_array())
    }
}
