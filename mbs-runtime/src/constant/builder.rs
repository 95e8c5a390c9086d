//! The choices before a run with a constant step starts.

use super::{ConstantStep, Kernel};
use crate::adaptive::{Beginning, Moment};
use crate::equations::Start;
use crate::vectors::assign;
use crate::watch::Watch;
use crate::{Components, Dynamics, Error, Heun, Mechanism, Real, State};

/// The choices before a run with a constant step starts; see [`Rattle::builder`](crate::Rattle)
/// and [`TrBdf2::builder`](crate::TrBdf2), or [`new`](Self::new) for a [`Kernel`] of another crate.
#[derive(Clone)]
pub struct ConstantStepBuilder<D: Dynamics, K: Kernel<D>> {
    beginning: Beginning<D>,
    step: f64,
    steps_taken: u64,
    pub(super) kernel: K,
}

impl<D: Dynamics, K: Kernel<D>> ConstantStepBuilder<D, K> {
    /// Choices to make before a run of a method starts. Without any: the declared start, made
    /// consistent, steps of `step` seconds, inputs at their defaults.
    pub fn new(mechanism: D, step: f64, kernel: K) -> Self {
        Self { beginning: Beginning::new(mechanism), step, steps_taken: 0, kernel }
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

    /// Goes on with a run that has taken so many steps: the given state is that at t + n·h, where t is the time at
    /// which that run started.
    ///
    /// # Example
    /// ```
    /// # use mbs_runtime::{Components, Rattle, mechanism};
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
    /// let mut swing = Rattle::builder(Pendulum::declared(), 0.01).build()?;
    /// swing.advance_to(0.5)?;
    /// let (q, v) = (swing.state().q.into_array(), swing.state().v.into_array());
    /// let other = Rattle::builder(Pendulum::declared(), 0.01)
    ///     .from_vectors(0.0, q, v)
    ///     .steps_taken(swing.steps())
    ///     .build()?;
    /// assert_eq!((other.time(), other.state()), (swing.time(), swing.state()));
    /// # Ok::<(), mbs_runtime::Error>(())
    /// ```
    #[must_use]
    pub fn steps_taken(self, steps_taken: u64) -> Self {
        Self { steps_taken, ..self }
    }

    /// Keeps the start as it is, consistent or not; the first step leads to the constraints.
    ///
    /// # Example
    /// ```
    /// # use mbs_runtime::{Rattle, mechanism};
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
    /// let beside = Rattle::builder(Pendulum::declared(), 0.01).from_vectors(0.0, [0.6, 0.79], [0.0; 2]);
    /// let mut swing = beside.as_declared().build()?;
    /// assert_eq!(swing.state().q.y, 0.79);
    /// swing.step()?;
    /// assert!(swing.violation() < 1e-14);
    /// # Ok::<(), mbs_runtime::Error>(())
    /// ```
    #[must_use]
    pub fn as_declared(mut self) -> Self {
        self.beginning.start = Start::Unchecked;
        self
    }

    /// Starts.
    ///
    /// # Errors
    /// Of RATTLE [`Error::VelocityForce`] for forces that depend on velocities or reactions, and
    /// [`Error::ReducedStates`] for a mechanism that does not integrate all of its coordinates;
    /// [`Error::Step`], and those of the start of a [`Simulation`](crate::Simulation).
    pub fn build(self) -> Result<ConstantStep<D, K>, Error> {
        let Self { mut beginning, step, steps_taken, kernel } = self;
        kernel.check(beginning.dynamics.equations().info())?;
        let h = D::Real::from_f64(step);
        if !(h > D::Real::default() && h.is_finite()) {
            return Err(Error::Step { step });
        }
        let start_time = beginning.state.0;
        beginning.state.0 = start_time + D::Real::from_f64(steps_taken as f64) * h;
        let length = beginning.prepare::<Heun>(step)?;
        let Beginning { dynamics, inputs, state: (t, q, v), .. } = beginning;
        let (states, rates) = (dynamics.states(&q), dynamics.states(&v));
        let now = Moment { t, a: states.clone(), q: states, v: rates };
        let mut run = ConstantStep {
            next: now.clone(),
            now,
            all: [q, v],
            dynamics,
            inputs,
            kernel,
            step: h,
            start_time: start_time.to_f64(),
            steps: steps_taken,
            is_solved: false,
            watch: Watch::new(length),
        };
        run.grid().check(run.dynamics.equations())?;
        if steps_taken == 0 {
            run.touch()?;
            run.sample();
        }
        run.solve()?;
        assign(&mut run.now.a, &run.next.a);
        Ok(run)
    }
}

impl<M: Mechanism, K: Kernel<M>> ConstantStepBuilder<M, K> {
    /// Starts from a state that has to be [`check`](crate::start::check)ed for consistency.
    #[must_use]
    pub fn from_state(self, state: State<M::Coordinates>) -> Self {
        self.from_vectors(state.t, state.q.into_array(), state.v.into_array())
    }
}
