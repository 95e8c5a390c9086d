//! A mechanism in motion.

mod builder;
pub(crate) mod clock;
mod on_slices;
#[cfg(feature = "std")]
mod reverse;

pub use self::builder::Builder;

use core::hint::black_box;

use crate::components::sum_of;
use crate::explicit::{Span, Trial, trial};
use crate::mechanism::{growth_limit, is_fused_for};
use crate::run::check_outputs;
use crate::watch::{Watch, WorstPlace};
use crate::{Baumgarte, Components, Error, Gains, Held, Mechanism, Method, Reactions, Real, State};

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
pub struct Simulation<M: Mechanism, X: Method = Held<<M as Mechanism>::Scheme>> {
    mechanism: M,
    inputs: M::Inputs,
    state: State<M::States>,
    baumgarte: Baumgarte<X>,
    gains: Gains<M::Real>,
    step: M::Real,
    start_time: M::Real,
    /// How many steps were taken. Every step multiplies this number with its length, so it is a
    /// float; an integer would have to be converted.
    steps: f64,
    watch: Watch<M::Real>,
}

impl<M: Mechanism> Simulation<M> {
    /// Starts at the declared start, made consistent, with steps of `step` seconds of the
    /// declared scheme and deadbeat feedback held over each step.
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

impl<M: Mechanism, X: Method> Simulation<M, X> {
    /// Advances by one step of the method.
    ///
    /// # Errors
    /// [`Error::OutOfReach`] if the constraints cannot be met any more at its end,
    /// [`Error::Singular`], [`Error::NonFinite`], or [`Error::Input`] if that
    /// is where they come from; the state stays that of the last good step.
    #[inline]
    pub fn step(&mut self) -> Result<(), Error> {
        let t_next = self.next_time();
        let Self { mechanism, inputs, gains, step, watch, .. } = &*self;
        // Written so that a NaN fails the test. The state is stored from registers,
        // pair by pair; through a `Result` it would be copied in other pieces than
        // those in which it was written, for which processors wait.
        if is_fused_for::<M, X>()
            && let Some(fused) = mechanism.fused_step::<X>(&self.present(), inputs, gains, *step, t_next)
            && fused.growth <= watch.alarm
            && fused.sum.is_finite()
            && self.keeps_redundant(&fused.next)
        {
            self.state = fused.next;
            self.steps += 1.0;
            self.watch.note(fused.growth);
            return Ok(());
        }
        let Self { mechanism, state, inputs, gains, step, watch, .. } = self;
        // in place, so that nothing could be looked at before it is taken
        if M::INFO.redundant.is_empty()
            && let Some(growth) = mechanism.long_step::<X>(state, inputs, gains, *step, t_next, watch.alarm)
        {
            self.steps += 1.0;
            self.watch.note(growth);
            return Ok(());
        }
        if !is_fused_for::<M, X>() && self.step_unfused(t_next) {
            return Ok(());
        }
        self.step_in_stages()
    }

    /// The step of a method that has no program of its own, if it is calm.
    #[inline]
    fn step_unfused(&mut self, t_next: M::Real) -> bool {
        let Self { mechanism, state, inputs, gains, step, watch, .. } = &*self;
        let span = Span { t: state.t, h: *step, t_next };
        let Trial { next, growth } = trial::<M, X>(mechanism, state, inputs, gains, &span);
        let is_calm = growth <= watch.alarm
            && (sum_of(next.q) + sum_of(next.v)).is_finite()
            && self.keeps_redundant(&next);
        if is_calm {
            self.state = next;
            self.steps += 1.0;
            self.watch.note(growth);
        }
        is_calm
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
        let Self { mechanism, inputs, gains, step, watch, .. } = &*self;
        if is_fused_for::<M, X>()
            && let Some((fused, reactions)) =
                mechanism.fused_step_with_reactions::<X>(&self.present(), inputs, gains, *step, t_next)
            && fused.growth <= watch.alarm
            && fused.sum.is_finite()
            && self.keeps_redundant(&fused.next)
        {
            self.state = fused.next;
            self.steps += 1.0;
            self.watch.note(fused.growth);
            return Ok(reactions);
        }
        let reactions = self.reactions()?;
        self.step()?;
        Ok(reactions)
    }

    /// The present state, read in the pieces in which it was written: a processor waits where a
    /// load takes parts of two stores that have just been made.
    ///
    /// Compilers load a number together with the one behind it where they know that there is
    /// one, so several coordinates are read from a place of which they do not know. One or two
    /// stay in registers from step to step, which is faster still. Time is counted anew, which
    /// gives the same number.
    #[inline(always)]
    fn present(&self) -> State<M::States> {
        let t = self.start_time + M::Real::from_f64(self.steps) * self.step;
        let stays_in_registers = M::INFO.states.len() <= 2;
        let state = if stays_in_registers { &self.state } else { black_box(&self.state) };
        State { t, ..*state }
    }

    /// The time after the next step.
    #[inline(always)]
    fn next_time(&self) -> M::Real {
        self.start_time + M::Real::from_f64(self.steps + 1.0) * self.step
    }

    /// Advances by whole steps until less than half a step is left to `end` seconds.
    ///
    /// # Errors
    /// As [`steps_to`](Self::steps_to) and [`step`](Self::step).
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
    /// [`Error::EndTime`], or [`Error::Time`] if it is so far away that time would stand
    /// still before.
    pub fn steps_to(&self, end: f64) -> Result<u64, Error> {
        clock::steps_to::<M::Real>(self.start_time.to_f64(), self.step.to_f64(), self.steps(), end)
    }

    /// Time, positions and velocities of all coordinates.
    #[inline]
    pub fn state(&self) -> State<M::Coordinates> {
        self.mechanism.complete(&self.state)
    }

    /// Time, positions and velocities of the coordinates that are integrated.
    #[inline]
    pub fn integrated(&self) -> &State<M::States> {
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
    pub(crate) fn moved_to(&self, state: State<M::States>, steps: u64, watch: Watch<M::Real>) -> Self {
        Self { state, steps: steps as f64, watch, ..*self }
    }

    pub(crate) fn watch(&self) -> &Watch<M::Real> {
        &self.watch
    }

    /// Steps taken since the start.
    pub fn steps(&self) -> u64 {
        self.steps as u64
    }

    /// The mechanism.
    pub fn mechanism(&self) -> &M {
        &self.mechanism
    }

    /// The feedback.
    pub fn baumgarte(&self) -> &Baumgarte<X> {
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
        self.mechanism.phi(self.state.t, &self.state().q).norm()
    }

    /// Constraint violation in velocities ‖Φ̇‖.
    pub fn velocity_violation(&self) -> M::Real {
        self.mechanism.phi_dot(&self.state()).norm()
    }

    /// The largest pivot growth of a step so far, all stages added; 0 before the first.
    ///
    /// In a healthy position every pivot adds about 2. Where a mechanism comes close to a
    /// singular position it is the factor by which rounding errors are magnified; see
    /// [`digits_left`](Self::digits_left) and [`worst_place`](Self::worst_place).
    pub fn worst_growth(&self) -> M::Real {
        self.watch.worst
    }

    /// The decimal digits that the worst step so far had in its accelerations,
    /// −log₁₀(ε · [`worst_growth`](Self::worst_growth)): 15 in `f64` and 6 in `f32` while
    /// positions are healthy. An error comes below 3.
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
    /// swing.advance_to(0.5)?;
    /// assert!(swing.digits_left() > 14.0 && swing.worst_place().is_none());
    /// # Ok::<(), mbs_runtime::Error>(())
    /// ```
    pub fn digits_left(&self) -> f64 {
        self.watch.digits_left()
    }

    /// When and where the run came closest to a singular position; nothing as long as
    /// every growth was below 64, which costs less than two digits.
    ///
    /// The place is remembered when the growth has doubled since the last one, so that
    /// it is that of a step with at least half of [`worst_growth`](Self::worst_growth).
    pub fn worst_place(&self) -> Option<WorstPlace> {
        self.watch.worst_place(M::INFO)
    }

    /// Kinetic plus potential energy in J.
    pub fn energy(&self) -> M::Real {
        let state = self.state();
        self.mechanism.kinetic_energy(&state) + self.mechanism.potential_energy(&state)
    }

    /// q̈ and λ of the present state, from the right-hand side *without*
    /// feedback terms: the forces that the mechanism feels.
    ///
    /// # Errors
    /// [`Error::Singular`], [`Error::Input`], [`Error::NonFinite`] of an acceleration,
    /// [`Error::Undefined`] of a multiplier.
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
        let solved = self.mechanism.reactions(&self.state(), &self.inputs, feedback);
        let sum = sum_of(solved.acceleration) + sum_of(solved.multipliers);
        if sum.is_finite() && solved.growth < growth_limit() {
            return Ok(solved);
        }
        self.examine(solved.acceleration, solved.multipliers, solved.growth).map(|()| solved)
    }

    /// The declared outputs in the present state.
    ///
    /// # Errors
    /// [`Error::Undefined`] if one of them is not finite, else as
    /// [`reactions`](Self::reactions).
    #[inline]
    pub fn outputs(&self) -> Result<M::Outputs, Error> {
        let reactions = self.reactions()?;
        let outputs = self.mechanism.outputs(&self.state(), &self.inputs, &reactions);
        self.check_outputs(outputs).map(|()| outputs)
    }

    /// Refuses outputs that are not finite.
    #[inline]
    pub(crate) fn check_outputs(&self, outputs: M::Outputs) -> Result<(), Error> {
        if sum_of(outputs).is_finite() {
            return Ok(());
        }
        check_outputs(M::INFO, self.state.t, outputs.into_array().as_ref())
    }
}
