//! A simulation as a run on slices: what is rarely done, and therefore compiled once for
//! all mechanisms.

use super::Simulation;
use crate::arrays::{Constraints, Coordinates};
use crate::equations::Arrays;
use crate::moreau::Pushed;
use crate::room::{OnStack, Room};
use crate::run::Run;
use crate::samples::Grid;
use crate::{Components, Error, Mechanism, Method, Reactions, Real, Scheme, State, moreau, pressing, spare};

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
        if const { !M::INFO.jumps() } {
            self.step_by_stages()?;
        } else {
            self.step_to_stops(Self::step_by_stages)?;
        }
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

    /// A step, and what stops make of its end.
    #[inline(never)]
    pub(super) fn step_to_stops(
        &mut self,
        step: impl FnOnce(&mut Self) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let before = *self;
        let led = pushed(&self.mechanism, self.step, &mut self.state, &mut self.inputs).and_then(|pushed| {
            step(self)?;
            let ends = [&before.state, &self.state];
            struck(&self.mechanism, self.step, (&pushed, ends), &mut self.inputs)
        });
        match led {
            Ok(state) => self.state = state,
            Err(error) => {
                *self = before;
                return Err(error);
            }
        }
        Ok(())
    }

    /// Rests on the stops that the start touches.
    ///
    /// # Errors
    /// Those of [`begin`](moreau::begin).
    pub(super) fn touch(&mut self) -> Result<(), Error> {
        if const { !M::INFO.jumps() } {
            return Ok(());
        }
        let (state, mut inputs) = (Arrays::of(&self.state()), self.inputs.into_array());
        let mut vectors = vectors::<M>();
        moreau::begin(&self.mechanism, (self.step, vectors.changes()), state.at(), inputs.as_mut())?;
        self.inputs = Components::from_array(inputs);
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

/// Vectors that stops compute with.
fn vectors<M: Mechanism>() -> moreau::Vectors<Coordinates<M>, Constraints<M>> {
    let zero = M::Coordinates::splat(M::Real::default()).into_array();
    moreau::Vectors::new(zero, M::Constraints::splat(M::Real::default()).into_array())
}

/// The stops that push before a step, which changes velocities.
///
/// # Errors
/// [`Error::Impact`].
pub(crate) fn pushed<M: Mechanism>(
    mechanism: &M,
    h: M::Real,
    state: &mut State<M::States>,
    inputs: &mut M::Inputs,
) -> Result<Pushed<M::Real>, Error> {
    let Arrays { t, q, mut v } = Arrays::of(&mechanism.complete(state));
    let (mut own, mut vectors) = (inputs.into_array(), vectors::<M>());
    let pushed = moreau::push(mechanism, (h, vectors.changes()), (t, q.as_ref(), v.as_mut()), own.as_mut())?;
    *inputs = Components::from_array(own);
    if pushed.is_any() {
        state.v = M::states(Components::from_array(v));
    }
    Ok(pushed)
}

/// The end of a step behind the answer of stops, which sets their memories. `pushed` are those that pushed before the step.
///
/// # Errors
/// [`Error::Impact`].
pub(crate) fn struck<M: Mechanism>(
    mechanism: &M,
    h: M::Real,
    (pushed, ends): (&Pushed<M::Real>, [&State<M::States>; 2]),
    inputs: &mut M::Inputs,
) -> Result<State<M::States>, Error> {
    let [before, after] = ends.map(|end| Arrays::of(&mechanism.complete(end)));
    let (Arrays { t, mut q, mut v }, mut own) = (after, inputs.into_array());
    let (end, mut vectors) = ((t, [q.as_mut(), v.as_mut()]), vectors::<M>());
    moreau::strike(mechanism, (h, vectors.changes()), (pushed, before.at()), end, own.as_mut())?;
    *inputs = Components::from_array(own);
    let State { t, q, v } = Arrays { t, q, v }.state();
    Ok(State { t, q: M::states(q), v: M::states(v) })
}

/// Adds what the stops do that are rested on.
#[inline(always)]
pub(crate) fn press<M: Mechanism>(
    mechanism: &M,
    at: &State<M::Coordinates>,
    inputs: &M::Inputs,
    to: &mut Reactions<M::Coordinates, M::Constraints>,
) {
    if const { M::INFO.jumps() } {
        *to = pressed(mechanism, at, inputs, to);
    }
}

#[inline(never)]
fn pressed<M: Mechanism>(
    mechanism: &M,
    at: &State<M::Coordinates>,
    inputs: &M::Inputs,
    free: &Reactions<M::Coordinates, M::Constraints>,
) -> Reactions<M::Coordinates, M::Constraints> {
    let (state, inputs) = (Arrays::of(at), inputs.into_array());
    let (mut a, mut multipliers) = (free.acceleration.into_array(), free.multipliers.into_array());
    let growth =
        pressing::press(mechanism, state.at(), inputs.as_ref(), a.as_mut(), Some(multipliers.as_mut()));
    Reactions {
        acceleration: Components::from_array(a),
        multipliers: Components::from_array(multipliers),
        growth: free.growth + growth,
    }
}
