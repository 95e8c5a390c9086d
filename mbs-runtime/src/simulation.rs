//! A mechanism in motion.

mod builder;

pub use self::builder::Builder;

use crate::heun::{Solution, check_solution, heun_step};
use crate::mechanism::growth_limit;
use crate::{Baumgarte, Components, Error, Feedback, Gains, Held, Mechanism, Reactions, Real, State};

/// A mechanism being integrated in time.
///
/// # Example
/// ```
/// use mbs_runtime::{Simulation, mechanism};
///
/// mechanism! {
///     /// A weight on a massless rod.
///     pub Pendulum {
///         dof = 1;
///         param length = 1 [m];
///         gravity = (0, -9.81) [m/s^2];
///         body bob (x, y) { mass = 2 [kg]; }
///         constraint rod: x^2 + y^2 = length^2;
///         start { x = length; guess y = 0; }
///     }
/// }
///
/// let mut swing = Simulation::new(Pendulum::declared(), 1e-3)?;
/// swing.advance_to(0.5)?;
/// assert!(swing.state().q.y < 0.0);
/// # Ok::<(), mbs_runtime::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Simulation<M: Mechanism, F: Feedback = Held> {
    mechanism: M,
    inputs: M::Inputs,
    state: State<M::Coordinates>,
    baumgarte: Baumgarte<F>,
    gains: Gains<M::Real>,
    step: M::Real,
    start_time: M::Real,
    steps: u64,
}

impl<M: Mechanism> Simulation<M> {
    /// Starts at the declared start, made consistent, with steps of `step`
    /// seconds and deadbeat feedback held over each step.
    ///
    /// # Errors
    /// As [`Builder::build`].
    pub fn new(mechanism: M, step: f64) -> Result<Self, Error> {
        Self::builder(mechanism, step).build()
    }

    /// Choices to make before the start.
    pub fn builder(mechanism: M, step: f64) -> Builder<M> {
        Builder::new(mechanism, step)
    }
}

impl<M: Mechanism, F: Feedback> Simulation<M, F> {
    /// Advances by one step of Heun's method.
    ///
    /// # Errors
    /// [`Error::Singular`], [`Error::NonFinite`], or [`Error::Input`] if that
    /// is where they come from; the state stays that of the last good step.
    #[inline]
    pub fn step(&mut self) -> Result<(), Error> {
        let t_next = self.next_time();
        let Self { mechanism, state, inputs, gains, step, .. } = &*self;
        // Written so that a NaN fails the test. The state is stored from registers,
        // pair by pair; through a `Result` it would be copied in other pieces than
        // those in which it was written, for which processors wait.
        if let Some(fused) = mechanism.fused_step::<F>(state, inputs, gains, *step, t_next)
            && fused.growth < growth_limit()
            && fused.sum.is_finite()
        {
            self.state = fused.next;
            self.steps += 1;
            return Ok(());
        }
        let Self { mechanism, state, inputs, gains, step, .. } = self;
        if mechanism.long_step::<F>(state, inputs, gains, *step, t_next) {
            self.steps += 1;
            return Ok(());
        }
        self.step_in_stages()
    }

    /// Advances by one step, and gives the [`reactions`](Self::reactions) at its start:
    /// what they have in common is computed once.
    ///
    /// # Example
    /// ```
    /// # use mbs_runtime::{Simulation, mechanism};
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
    /// let mut swing = Simulation::new(Pendulum::declared(), 1e-3)?;
    /// for _ in 0..500 {
    ///     let expected = swing.reactions()?.multipliers.rod;
    ///     let at_start = swing.step_with_reactions()?;
    ///     assert_eq!(at_start.multipliers.rod, expected);
    /// }
    /// assert_eq!(swing.steps(), 500);
    /// # Ok::<(), mbs_runtime::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`reactions`](Self::reactions) and [`step`](Self::step); the state stays that
    /// of the last good step.
    #[inline]
    pub fn step_with_reactions(&mut self) -> Result<Reactions<M::Coordinates, M::Constraints>, Error> {
        let t_next = self.next_time();
        let Self { mechanism, state, inputs, gains, step, .. } = &*self;
        if let Some((fused, reactions)) =
            mechanism.fused_step_with_reactions::<F>(state, inputs, gains, *step, t_next)
            && fused.growth < growth_limit()
            && fused.sum.is_finite()
        {
            self.state = fused.next;
            self.steps += 1;
            return Ok(reactions);
        }
        let reactions = self.reactions()?;
        self.step()?;
        Ok(reactions)
    }

    /// The time after the next step.
    #[inline(always)]
    fn next_time(&self) -> M::Real {
        self.start_time + M::Real::from_f64((self.steps + 1) as f64) * self.step
    }

    /// The step of mechanisms that have no other, and of those whose step failed:
    /// it finds out what went wrong, if anything did.
    #[doc(hidden)]
    pub fn step_in_stages(&mut self) -> Result<(), Error> {
        let t_next = self.next_time();
        let Self { mechanism, state, inputs, gains, step, .. } = &*self;
        match heun_step::<M, F>(mechanism, state, inputs, gains, *step, t_next) {
            Ok(next) => {
                self.state = next;
                self.steps += 1;
                Ok(())
            }
            Err(error) => Err(self.blame_inputs(error)),
        }
    }

    /// Advances by whole steps until less than half a step is left to `end` seconds.
    ///
    /// # Errors
    /// [`Error::EndTime`], else as [`step`](Self::step).
    pub fn advance_to(&mut self, end: f64) -> Result<(), Error> {
        let steps = self.steps_to(end)?;
        for _ in 0..steps {
            self.step()?;
        }
        Ok(())
    }

    /// How many steps [`advance_to`](Self::advance_to) would take.
    ///
    /// # Errors
    /// [`Error::EndTime`].
    pub fn steps_to(&self, end: f64) -> Result<u64, Error> {
        let now = self.state.t.to_f64();
        let span = (end - self.start_time.to_f64()) / self.step.to_f64();
        // Half a step back is still "now".
        if !span.is_finite() || span + 0.5 < self.steps as f64 {
            return Err(Error::EndTime { end, now });
        }
        Ok(((span + 0.5) as u64).saturating_sub(self.steps))
    }

    /// Time, positions and velocities.
    #[inline]
    pub fn state(&self) -> &State<M::Coordinates> {
        &self.state
    }

    /// Time in s.
    #[inline]
    pub fn time(&self) -> M::Real {
        self.state.t
    }

    /// The step in s.
    pub fn step_size(&self) -> M::Real {
        self.step
    }

    /// The time of the start in s.
    pub(crate) fn start_time(&self) -> M::Real {
        self.start_time
    }

    /// The same run, that many steps after its start.
    pub(crate) fn moved_to(&self, state: State<M::Coordinates>, steps: u64) -> Self {
        Self { state, steps, ..*self }
    }

    /// Steps taken since the start.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// The mechanism.
    pub fn mechanism(&self) -> &M {
        &self.mechanism
    }

    /// The feedback.
    pub fn baumgarte(&self) -> &Baumgarte<F> {
        &self.baumgarte
    }

    /// The inputs as they are now.
    pub fn inputs(&self) -> &M::Inputs {
        &self.inputs
    }

    /// The inputs, to be set before a step; they are held over it.
    pub fn inputs_mut(&mut self) -> &mut M::Inputs {
        &mut self.inputs
    }

    /// Constraint violation ‖Φ‖, the Euclidean norm.
    pub fn violation(&self) -> M::Real {
        self.mechanism.phi(self.state.t, &self.state.q).norm()
    }

    /// Constraint violation in velocities ‖Φ̇‖.
    pub fn velocity_violation(&self) -> M::Real {
        self.mechanism.phi_dot(&self.state).norm()
    }

    /// Kinetic plus potential energy in J.
    pub fn energy(&self) -> M::Real {
        self.mechanism.kinetic_energy(&self.state) + self.mechanism.potential_energy(&self.state)
    }

    /// q̈ and λ of the present state, from the right-hand side *without*
    /// feedback terms: the forces that the mechanism feels.
    ///
    /// # Errors
    /// [`Error::Singular`], [`Error::Input`].
    #[inline]
    pub fn reactions(&self) -> Result<Reactions<M::Coordinates, M::Constraints>, Error> {
        self.reactions_with(&M::Constraints::splat(M::Real::default()))
    }

    /// q̈ and λ of the present state with the feedback terms left in, as the
    /// first stage of a step sees them.
    ///
    /// # Errors
    /// As [`reactions`](Self::reactions).
    pub fn raw_reactions(&self) -> Result<Reactions<M::Coordinates, M::Constraints>, Error> {
        let feedback = self.mechanism.stabilized(&self.state, &self.inputs, &self.gains).feedback;
        self.reactions_with(&feedback)
    }

    #[inline]
    fn reactions_with(
        &self,
        feedback: &M::Constraints,
    ) -> Result<Reactions<M::Coordinates, M::Constraints>, Error> {
        let solved = self.mechanism.reactions(&self.state, &self.inputs, feedback);
        // A sum is finite only if all of them are, and shorter than a test of each.
        let sum =
            solved.acceleration.into_array().as_ref().iter().fold(M::Real::default(), |sum, &a| sum + a);
        if sum.is_finite() && solved.growth < growth_limit() {
            return Ok(solved);
        }
        self.examine(solved.acceleration, solved.growth).map(|()| solved)
    }

    /// Takes values and not references, so that what is healthy need not be in memory.
    #[cold]
    fn examine(&self, acceleration: M::Coordinates, growth: M::Real) -> Result<(), Error> {
        let (t, q) = (self.state.t, &self.state.q);
        let solution = Solution { t, q, value: &acceleration, growth, pivots: M::INFO.pivots };
        check_solution(&solution, || self.mechanism.worst_pivot(t, q))
            .map_err(|error| self.blame_inputs(error))
    }

    /// The declared outputs in the present state.
    ///
    /// # Errors
    /// As [`reactions`](Self::reactions).
    pub fn outputs(&self) -> Result<M::Outputs, Error> {
        let reactions = self.reactions()?;
        Ok(self.mechanism.outputs(&self.state, &self.inputs, &reactions))
    }

    /// An input that is not finite is the cause of whatever failed after it.
    #[cold]
    fn blame_inputs(&self, error: Error) -> Error {
        match check_inputs::<M>(&self.inputs) {
            Ok(()) => error,
            Err(bad_input) => bad_input,
        }
    }
}

fn check_inputs<M: Mechanism>(inputs: &M::Inputs) -> Result<(), Error> {
    let array = inputs.into_array();
    for (&value, &name) in array.as_ref().iter().zip(M::Inputs::NAMES) {
        if !value.is_finite() {
            return Err(Error::Input { name, value: value.to_f64() });
        }
    }
    Ok(())
}
