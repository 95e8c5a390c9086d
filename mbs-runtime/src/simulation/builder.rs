//! The choices before a simulation starts.

use super::Simulation;
use crate::equations::Arrays;
use crate::gradients::{Seeds, Sum};
use crate::room::OnStack;
use crate::start::{self, preparation::Start};
use crate::watch::Watch;
use crate::{Baumgarte, Components, Dual, Error, Held, Mechanism, Method, Real, State};

/// The choices before a simulation starts; see [`Simulation::builder`].
#[derive(Clone, Copy, Debug)]
pub struct Builder<M: Mechanism, X: Method = Held<<M as Mechanism>::Scheme>> {
    mechanism: M,
    step: f64,
    baumgarte: Baumgarte<X>,
    inputs: M::Inputs,
    /// In place of the declared start.
    state: Option<State<M::Coordinates>>,
    start: Start,
    allow_unstable: bool,
}

impl<M: Mechanism> Builder<M> {
    pub(super) fn new(mechanism: M, step: f64) -> Self {
        Self {
            mechanism,
            step,
            baumgarte: Baumgarte::deadbeat(step),
            inputs: M::Inputs::default(),
            state: None,
            start: Start::Declared,
            allow_unstable: false,
        }
    }
}

impl<M: Mechanism, X: Method> Builder<M, X> {
    /// The method of integration, with the gains that are [`deadbeat`](Baumgarte::deadbeat)
    /// for it. Default: the scheme that the mechanism declares, with feedback held over each
    /// step.
    ///
    /// # Example
    /// ```
    /// # use mbs_runtime::{Held, Rk4, Simulation, mechanism};
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
    /// let mut swing = Simulation::builder(Pendulum::declared(), 1e-3).method::<Held<Rk4>>().build()?;
    /// swing.advance_to(1.0)?;
    /// // it falls from the side without friction: the energy stays 0
    /// assert!(swing.energy().abs() < 1e-9);
    /// # Ok::<(), mbs_runtime::Error>(())
    /// ```
    #[must_use]
    pub fn method<Y: Method>(self) -> Builder<M, Y> {
        let step = self.step;
        self.baumgarte(Baumgarte::deadbeat(step))
    }

    /// Feedback of the constraint violation with these gains, and the method that they belong
    /// to. Default: [`Baumgarte::deadbeat`] of the step, held.
    #[must_use]
    pub fn baumgarte<Y: Method>(self, baumgarte: Baumgarte<Y>) -> Builder<M, Y> {
        Builder {
            mechanism: self.mechanism,
            step: self.step,
            baumgarte,
            inputs: self.inputs,
            state: self.state,
            start: self.start,
            allow_unstable: self.allow_unstable,
        }
    }

    /// Starts from `state` instead of the declared start, and keeps it bit for bit: it has
    /// to be [`check`](start::check)ed for consistency, as the states of other runs are. With
    /// reduced states, coordinates that constraints give are computed from those that are kept.
    ///
    /// A state of which some coordinates are guesses is made consistent by
    /// [`start::project`], which is told what to keep, or by [`start::consistent`], which
    /// keeps what the declaration prescribes.
    ///
    /// # Example
    /// ```
    /// # use mbs_runtime::{Error, Simulation, mechanism, start};
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
    /// let pendulum = Pendulum::declared();
    /// let mut run = Simulation::new(pendulum, 1e-3)?;
    /// run.advance_to(0.3)?;
    /// // a run goes on from where another one is
    /// let mut other = Simulation::builder(pendulum, 1e-3).from_state(run.state()).build()?;
    /// run.step()?;
    /// other.step()?;
    /// assert_eq!(run.state().q, other.state().q);
    ///
    /// let mut guess = run.state();
    /// guess.q.y = -0.8;
    /// guess.v.x = 0.5;
    /// let refused = Simulation::builder(pendulum, 1e-3).from_state(guess).build();
    /// assert!(matches!(refused, Err(Error::Inconsistent { constraint: "rod", .. })));
    /// let start = start::project(&pendulum, &guess, &["y"], &["x"])?;
    /// assert_eq!((start.q.y, start.v.x), (-0.8, 0.5));
    /// let run = Simulation::builder(pendulum, 1e-3).from_state(start).build()?;
    /// assert_eq!(run.state(), start);
    /// # Ok::<(), Error>(())
    /// ```
    #[must_use]
    pub fn from_state(mut self, state: State<M::Coordinates>) -> Self {
        self.state = Some(state);
        if matches!(self.start, Start::Declared) {
            self.start = Start::Given;
        }
        self
    }

    /// Keeps the start as it is, even if it violates Φ = 0 or Φ̇ = 0: the declared one,
    /// which is made [`consistent`](start::consistent) else, or that of
    /// [`from_state`](Self::from_state), which is refused else.
    ///
    /// # Example
    /// A start beside the rod, which the feedback leads back to it:
    /// ```
    /// # use mbs_runtime::{Simulation, mechanism};
    /// # mechanism! {
    /// #     pub Pendulum {
    /// #         dof = 1;
    /// #         gravity = (0, -9.81) [m/s^2];
    /// #         body bob (x, y) { mass = 2 [kg]; }
    /// #         constraint rod: x^2 + y^2 = 1 [m^2];
    /// #         start { y = 0; guess x = 1.001 [m]; }
    /// #     }
    /// # }
    /// let mut swing = Simulation::builder(Pendulum::declared(), 1e-3).as_declared().build()?;
    /// assert_eq!(swing.state().q.x, 1.001);
    /// swing.advance_to(0.1)?;
    /// assert!(swing.violation() < 1e-6 && swing.velocity_violation() < 1e-3);
    /// # Ok::<(), mbs_runtime::Error>(())
    /// ```
    #[must_use]
    pub fn as_declared(mut self) -> Self {
        self.start = Start::Unchecked;
        self
    }

    /// The inputs of the first step.
    #[must_use]
    pub fn inputs(mut self, inputs: M::Inputs) -> Self {
        self.inputs = inputs;
        self
    }

    /// Accepts gains under which violations grow, for the study of them.
    ///
    /// # Example
    /// ```
    /// # use mbs_runtime::{Baumgarte, Error, PerStage, Simulation, mechanism};
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
    /// let gains = Baumgarte::<PerStage>::new(2600.0, 2000.0)?;
    /// let builder = Simulation::builder(Pendulum::declared(), 0.5e-3).baumgarte(gains);
    /// assert!(matches!(builder.build(), Err(Error::UnstableGains { .. })));
    /// let swing = builder.allow_unstable().build()?;
    /// assert_eq!(swing.baumgarte().alpha(), 2600.0);
    /// # Ok::<(), Error>(())
    /// ```
    #[must_use]
    pub fn allow_unstable(mut self) -> Self {
        self.allow_unstable = true;
        self
    }

    /// The same run over another scalar, with these parameters: over [`Dual`](crate::Dual), a run
    /// with its derivatives. The state that was given and the inputs become constants.
    ///
    /// # Example
    /// ```
    /// use mbs_runtime::{Components, Dual, Mechanism, Simulation, mechanism};
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
    /// let pendulum = Pendulum::declared();
    /// let mut parameters: PendulumParameters<Dual<f64, 1>> = pendulum.parameters().over();
    /// parameters.length = Dual::variable(1.0, 0);
    /// let mut run = Simulation::builder(pendulum, 1e-3).over(parameters)?.build()?;
    /// run.advance_to(0.4)?;
    /// let shorter = PendulumParameters { length: 1.0 - 1e-6 };
    /// let mut other = Simulation::new(Pendulum::new(shorter)?, 1e-3)?;
    /// other.advance_to(0.4)?;
    /// let difference = (run.state().q.x.value - other.state().q.x) / 1e-6;
    /// assert!((run.state().q.x.partials[0] - difference).abs() < 1e-5);
    /// # Ok::<(), mbs_runtime::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Mechanism::new`].
    pub fn over<T: Real>(
        self,
        parameters: <M::Over<T> as Mechanism>::Parameters,
    ) -> Result<Builder<M::Over<T>, X>, Error> {
        let Self { step, baumgarte, inputs, state, start, allow_unstable, .. } = self;
        Ok(Builder {
            mechanism: M::Over::<T>::new(parameters)?,
            step,
            baumgarte,
            inputs: inputs.over(),
            state: state.map(|State { t, q, v }| State {
                t: T::from_f64(t.to_f64()),
                q: q.over(),
                v: v.over(),
            }),
            start,
            allow_unstable,
        })
    }

    /// Starts.
    ///
    /// # Errors
    /// [`Error::Step`], [`Error::UnstableGains`], [`Error::Input`], [`Error::Time`],
    /// [`Error::NonFinite`], and those of [`start::consistent`], or of [`start::check`]
    /// for a given state.
    pub fn build(self) -> Result<Simulation<M, X>, Error> {
        let step = self.step;
        // as the scalar holds it: 1e-60 s is 0 in `f32`
        let h = M::Real::from_f64(step);
        if !(h > M::Real::default() && h.is_finite()) {
            return Err(Error::Step { step });
        }
        if !self.allow_unstable && !self.baumgarte.is_stable(step) {
            let (alpha, beta) = (self.baumgarte.alpha(), self.baumgarte.beta());
            return Err(Error::UnstableGains {
                alpha,
                beta,
                step,
                feedback: X::EXPLICIT.stabilization.word(),
            });
        }
        let inputs = self.inputs.into_array();
        let Arrays { t, mut q, mut v } =
            Arrays::of(&self.state.unwrap_or_else(|| self.mechanism.declared_start()));
        let preparation = start::preparation::Preparation {
            start: self.start,
            inputs: inputs.as_ref(),
            step: h,
            keeps_constraints: self.baumgarte.is_stable(step),
        };
        let equations = &self.mechanism;
        let mut room = OnStack::<M>::new();
        let length = preparation.prepare(equations, t, q.as_mut(), v.as_mut(), &mut room.room())?;
        let State { t, q, v } = Arrays { t, q, v }.state();
        let state = State { t, q: M::states(q), v: M::states(v) };
        let mut simulation = Simulation {
            mechanism: self.mechanism,
            inputs: self.inputs,
            state,
            baumgarte: self.baumgarte,
            gains: self.baumgarte.gains(),
            step: h,
            start_time: state.t,
            steps: 0.0,
            watch: Watch::new(length),
        };
        simulation.grid().check(&simulation.mechanism)?;
        simulation.touch()?;
        simulation.sample();
        Ok(simulation)
    }
}

impl<M: Mechanism<Real = f64>, X: Method> Builder<M, X> {
    /// A sum over the run that starts here, with its derivatives by variables in `gradient`.
    ///
    /// `term` is what the start and the end of every step add to the sum; it is given the run over
    /// duals of `N` partial derivatives, and makes a dual of what it finds there. The run is made
    /// once for every `N` variables. See [`gradients`](crate::gradients).
    ///
    /// # Example
    /// The work of a damper, and what a stiffer spring, a stronger damper and a longer pull would
    /// change:
    /// ```
    /// use mbs_runtime::gradients::{Sum, Variable};
    /// use mbs_runtime::{Dual, Mechanism, Simulation, mechanism};
    ///
    /// mechanism! {
    ///     pub Oscillator {
    ///         dof = 1;
    ///         param stiffness = 100 [N/m];
    ///         param damping = 2 [N*s/m];
    ///         body block (x) { mass = 1 [kg]; }
    ///         force spring on x = -stiffness*x;
    ///         force damper on x = -damping*der(x);
    ///         start { x = 0.1 [m]; }
    ///     }
    /// }
    ///
    /// let variables =
    ///     [Variable::Parameter("stiffness"), Variable::Parameter("damping"), Variable::Position("x")];
    /// let mut gradient = [0.0; 3];
    /// let step = 1e-3;
    /// let work = Simulation::builder(Oscillator::declared(), step).gradient(
    ///     &Sum::new(1000, &variables),
    ///     |run: &Simulation<Oscillator<Dual<f64, 3>>>| {
    ///         let (v, damping) = (run.state().v.x, run.mechanism().parameters().damping);
    ///         Ok(Dual::constant(step) * damping * v * v)
    ///     },
    ///     &mut gradient,
    /// )?;
    /// assert!((work - 0.43).abs() < 0.01); // of 0.5 J in the spring
    /// assert!((gradient[2] - 2.0 * work / 0.1).abs() < 1e-9);
    /// # Ok::<(), mbs_runtime::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NoVariable`], [`Error::Length`] for a `gradient` that has not a number for each
    /// variable, [`Error::Undefined`] for a derivative that is not finite; those of
    /// [`build`](Self::build), of [`Simulation::step`], and of `term`.
    pub fn gradient<const N: usize>(
        self,
        sum: &Sum<'_>,
        term: impl FnMut(&Simulation<M::Over<Dual<f64, N>>, X>) -> Result<Dual<f64, N>, Error>,
        gradient: &mut [f64],
    ) -> Result<f64, Error> {
        let start = |seeds: Seeds<'_, N>| self.seeded(seeds)?.build();
        let mut inputs = self.inputs.over::<Inputs<M::Over<Dual<f64, N>>>>().into_array();
        sum.differentiate(M::INFO, start, term, inputs.as_mut(), gradient)
    }

    /// The same over duals, whose parameters, positions and velocities are variables.
    pub(crate) fn seeded<const N: usize>(
        self,
        seeds: Seeds<'_, N>,
    ) -> Result<Builder<M::Over<Dual<f64, N>>, X>, Error> {
        let mut parameters =
            self.mechanism.parameters().over::<Parameters<M::Over<Dual<f64, N>>>>().into_array();
        seeds.parameters(parameters.as_mut());
        let mut builder = self.over(Components::from_array(parameters))?;
        let state = builder.state.unwrap_or_else(|| builder.mechanism.declared_start());
        let Arrays { t, mut q, mut v } = Arrays::of(&state);
        seeds.start(q.as_mut(), v.as_mut());
        builder.state = Some(Arrays { t, q, v }.state());
        Ok(builder)
    }
}

type Parameters<M> = <M as Mechanism>::Parameters;
type Inputs<M> = <M as Mechanism>::Inputs;
