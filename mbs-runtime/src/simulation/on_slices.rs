//! A simulation as a run on slices: what is rarely done, and therefore compiled once for
//! all mechanisms.

use super::Simulation;
use crate::equations::Arrays;
use crate::room::{OnStack, Room};
use crate::run::Run;
use crate::samples::Grid;
use crate::{Components, Error, Mechanism, Method, Real, Scheme, State, spare};

/// A function of a run and of vectors to compute with.
type Do<'a, T> = dyn FnMut(&Run<'_, T>, &mut Room<'_, T>) -> Result<(), Error> + 'a;

impl<M: Mechanism, X: Method> Simulation<M, X> {
    /// By reference, so that this is compiled once for all that is to be done.
    #[inline(never)]
    fn on_slices(&self, what: &mut Do<'_, M::Real>) -> Result<(), Error> {
        let (state, inputs) = (Arrays::of(&self.state), self.inputs.into_array());
        let run = Run {
            equations: &self.mechanism,
            at: state.at(),
            inputs: inputs.as_ref(),
            gains: self.gains,
            step: self.step,
            method: X::EXPLICIT,
            keeps_constraints: self.baumgarte.is_stable(self.step.to_f64()),
        };
        let mut stages = X::Scheme::stages([state.q; 2]);
        what(&run, &mut OnStack::<M>::new().room_for_steps::<X::Scheme>(&mut stages))
    }

    /// A step in stages, and the samples that are due at its end.
    #[doc(hidden)]
    pub fn step_in_stages(&mut self) -> Result<(), Error> {
        self.step_by_stages()?;
        self.sample();
        Ok(())
    }

    /// The step of mechanisms that have no other, and of those whose step was not calm:
    /// it finds out what went wrong, if anything did. See [`Run::step`].
    pub(super) fn step_by_stages(&mut self) -> Result<(), Error> {
        // the run borrows what both belong to
        let (mut next, mut watch) = (Arrays::of(&self.state), self.watch);
        next.t = self.next_time();
        let Arrays { t, q, v } = &mut next;
        self.on_slices(&mut |run, room| run.step(*t, [q.as_mut(), v.as_mut()], &mut watch, room).map(drop))?;
        (self.state, self.watch) = (next.state(), watch);
        self.steps += 1.0;
        Ok(())
    }

    /// The steps, by which clocks are told.
    pub(crate) fn grid(&self) -> Grid {
        Grid { start: self.start_time.to_f64(), step: self.step.to_f64() }
    }

    /// Takes the samples that are due.
    #[inline(never)]
    pub(super) fn sample_clocks(&mut self) {
        let mut inputs = self.inputs.into_array();
        let state = Arrays::of(&self.state());
        self.grid().sample(self.steps(), &self.mechanism, state.at(), inputs.as_mut());
        self.inputs = Components::from_array(inputs);
    }

    /// Takes values and not references, so that what is healthy need not be in memory.
    #[cold]
    pub(super) fn examine(
        &self,
        acceleration: M::Coordinates,
        multipliers: M::Constraints,
        growth: M::Real,
    ) -> Result<(), Error> {
        let (acceleration, multipliers) = (acceleration.into_array(), multipliers.into_array());
        let q = self.state().q.into_array();
        self.on_slices(&mut |run, _| {
            run.examine(q.as_ref(), acceleration.as_ref(), multipliers.as_ref(), growth)
        })
    }

    /// True if redundant constraints, which steps do not look at, are met all the same.
    #[inline(always)]
    pub(super) fn keeps_redundant(&self, at: &State<M::States>) -> bool {
        spare::margin(&self.mechanism, at, self.watch.length) >= M::Real::default()
    }
}
