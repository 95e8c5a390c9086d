//! The steps of a simulation.
//!
//! # How it works
//!
//! A mechanism names the scheme of its fused step (`Mechanism::Scheme`). The growth of that step and the sum
//! of its state are tested once. A step that fails the test is made again in stages, which name the error
//! (`diagnosis.rs`). So is a step on arrays. Another method is computed stage by stage.
//!
//! The state is read from a place that a compiler does not see through. It would otherwise load a number
//! together with the one behind it, which another store wrote. Steps are counted in a float, since the time
//! of every step is a multiple of the count.

use core::hint::black_box;

use super::{Simulation, clock};
use crate::components::sum_of;
use crate::explicit::{Span, Trial, trial};
use crate::mechanism::is_fused_for;
use crate::{Error, Mechanism, Method, Reactions, Real, State};

impl<M: Mechanism, X: Method> Simulation<M, X> {
    /// Advances by one step of the method.
    ///
    /// # Errors
    /// [`Error::OutOfReach`] if the constraints cannot be met any more at its end,
    /// [`Error::Singular`], [`Error::NonFinite`], or [`Error::Input`] if that
    /// is where they come from; the state stays that of the last good step.
    #[inline]
    pub fn step(&mut self) -> Result<(), Error> {
        self.inlined_step()
    }

    /// [`step`](Self::step), always inlined into its caller.
    #[inline(always)]
    fn inlined_step(&mut self) -> Result<(), Error> {
        if const { !M::INFO.jumps() } {
            self.step_between()?;
        } else {
            self.step_to_stops(Self::step_between)?;
        }
        self.sample();
        Ok(())
    }

    /// A step of which clocks and stops know nothing.
    #[inline(always)]
    fn step_between(&mut self) -> Result<(), Error> {
        let t_next = self.next_time();
        let Self { mechanism, inputs, gains, step, watch, .. } = &*self;
        // Written so that a NaN fails the test. The state is stored from registers,
        // pair by pair; through a `Result` it would be copied in other pieces than
        // those in which it was written, for which processors wait.
        if const { is_fused_for::<M, X>() }
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
        if const { M::INFO.redundant.is_empty() }
            && let Some(growth) = mechanism.long_step::<X>(state, inputs, gains, *step, t_next, watch.alarm)
        {
            self.steps += 1.0;
            self.watch.note(growth);
            return Ok(());
        }
        if const { !is_fused_for::<M, X>() } && self.step_unfused(t_next) {
            return Ok(());
        }
        self.step_by_stages()
    }

    /// Takes the samples that are due.
    #[inline(always)]
    pub(super) fn sample(&mut self) {
        if const { M::INFO.sampling.clocks > 0 } {
            self.sample_clocks();
        }
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
        if const { is_fused_for::<M, X>() && !M::INFO.jumps() }
            && let Some((fused, reactions)) =
                mechanism.fused_step_with_reactions::<X>(&self.present(), inputs, gains, *step, t_next)
            && fused.growth <= watch.alarm
            && fused.sum.is_finite()
            && self.keeps_redundant(&fused.next)
        {
            self.state = fused.next;
            self.steps += 1.0;
            self.watch.note(fused.growth);
            self.sample();
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
        let state = if stays_in_registers::<M>() { &self.state } else { black_box(&self.state) };
        State { t, ..*state }
    }

    /// The time after the next step.
    #[inline(always)]
    pub(super) fn next_time(&self) -> M::Real {
        self.start_time + M::Real::from_f64(self.steps + 1.0) * self.step
    }

    /// Advances by whole steps until less than half a step is left to `end` seconds.
    ///
    /// # Errors
    /// As [`steps_to`](Self::steps_to) and [`step`](Self::step).
    pub fn advance_to(&mut self, end: f64) -> Result<(), Error> {
        let steps = self.steps_to(end)?;
        for _ in 0..steps {
            if stays_in_registers::<M>() {
                self.inlined_step()?;
            } else {
                self.step()?;
            }
        }
        Ok(())
    }

    /// How many steps [`advance_to`](Self::advance_to) would take.
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
    /// assert_eq!(swing.steps_to(0.2504)?, 250);
    /// swing.advance_to(0.2504)?;
    /// assert_eq!((swing.steps(), swing.steps_to(0.2504)?), (250, 0));
    /// # Ok::<(), mbs_runtime::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::EndTime`], or [`Error::Time`] if it is so far away that time would stand
    /// still before.
    pub fn steps_to(&self, end: f64) -> Result<u64, Error> {
        clock::steps_to::<M::Real>(self.start_time.to_f64(), self.step.to_f64(), self.steps(), end)
    }
}

/// True if a loop over inlined steps keeps the state in registers: that of one or two coordinates.
#[inline(always)]
fn stays_in_registers<M: Mechanism>() -> bool {
    M::INFO.states.len() <= 2
}
