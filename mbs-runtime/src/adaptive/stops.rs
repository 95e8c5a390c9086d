//! Stops in runs to a tolerance: where they are reached, and how the run goes on.
//!
//! A run watches the gaps of the stops that are open, and the forces at those that are rested on. Where one of them
//! would become negative the step ends. The [jump](super::jump) is made before the next step, or where the run is looked
//! at: until then the last step is known with the motion that it had.

use super::events::{Happened, Watched};
use super::gaps::{Stopping, among, of_run, stop_in, watched_of};
use super::jump::{CLOSED, Jump, Outcome};
use super::{Adaptive, AdaptiveScheme, Dynamics};
use crate::contact::{Each, Gaps, MOST_CONTACTS, bit, has, number, those};
use crate::equations::{At, Equations};
use crate::locks::placed;
use crate::modes::{self, Judging};
use crate::moreau::has_gaps;
use crate::pressing::held;
use crate::rubbing::all_rubbing;
use crate::sticking::{all_frictions, direction, frictions, set};
use crate::{Error, Real, vectors};

/// A start is behind a stop by more than this share of the size of the coordinates.
const BEHIND: f64 = 1e-9;
/// The step behind an impact is tried with so many times the flight that follows.
const FLIGHTS: f64 = 2.0;
/// A step that was too long to see what gaps do in it is tried again with this share of it,
const SHORTER: f64 = 0.1;
/// unless it is as short already beside the longest one.
const SHORT: f64 = 1e-4;
/// Conditions that begin to hold often in sequence are endless behind so many,
const MOST_OFTEN: u32 = 1000;
/// and impacts behind so many: those of a bounce with a restitution near 1 come to an end by `settle`.
const MOST_IMPACTS: u32 = 10_000;
/// A run ends where so many steps in sequence do not leave a stop.
const MOST_LOOKS: u8 = 8;

impl<D: Dynamics, S: AdaptiveScheme> Adaptive<D, S> {
    /// True if velocities or memories may jump.
    fn jumps(&self) -> bool {
        self.dynamics.info().jumps()
    }

    /// Looks for the first stop that was reached in the last step, where nothing else is watched.
    pub(super) fn look_for_stops(&mut self) -> Result<(), Error> {
        if !D::JUMPS || !self.jumps() {
            return Ok(());
        }
        let mut watched = Watched {
            count: 0,
            direction: &|_| None,
            values: &mut |_: &D, _: &D::Inputs, _, _| {},
            room: &mut [],
            is_declared: false,
        };
        self.look_back(&mut watched)
    }

    /// Notes the stops at which the last step ended.
    pub(super) fn reach_stops(&mut self) {
        self.stopping.reached |= among(self.happened.due, self.dynamics.info());
    }

    /// The events at stops are no news where a program asks for its own.
    pub(super) fn forget_stops(&mut self) {
        self.happened.due &= !watched_of(of_run(self.dynamics.info()));
    }

    /// Nor is it where a stop is left.
    pub(super) fn forget_releases(&mut self) {
        if D::JUMPS && self.jumps() {
            let held = self.with_jump(|jump| held(jump.dynamics.equations(), jump.inputs));
            self.happened.due &= !watched_of(held);
        }
    }

    /// Looks at the stops at the start of a step, where forces may have jumped: one that is rested on and pulls is left, and
    /// one that is closed and still is rested on if it pushes.
    ///
    /// # Errors
    /// [`Error::Impact`].
    pub(super) fn look_at_rests(&mut self) -> Result<(), Error> {
        if !D::JUMPS || !self.jumps() {
            return Ok(());
        }
        self.stopping.effort = self.effort;
        let Stopping { kept, size, off, .. } = self.stopping;
        let [pulled, pushing, closed, entered, begun] = self.with_jump(|jump| jump.look(size, off));
        self.stopping.kept = kept & !pushing;
        // what a jump has looked at already leaves its event
        let known = among(self.happened.all | self.happened.judged, self.dynamics.info());
        let reached = pulled & !kept | closed & !known | entered | begun << MOST_CONTACTS;
        if reached != 0 {
            return self.jump_at(reached, entered == 0);
        }
        if !self.dynamics.info().modes.transitions.is_empty() {
            self.with_memories(|equations, at, inputs, room| {
                let (_, seen) = modes::due(equations, at, inputs, Judging { off, room }, true);
                modes::note(equations.info(), &seen, inputs);
            });
        }
        Ok(())
    }

    /// Makes the jump that is due at the present time, if one is.
    ///
    /// # Errors
    /// [`Error::Impact`].
    pub(super) fn jump(&mut self) -> Result<(), Error> {
        if !D::JUMPS {
            return Ok(());
        }
        let reached = core::mem::take(&mut self.stopping.reached);
        if reached == 0 { Ok(()) } else { self.jump_at(reached, true) }
    }

    /// Rests on the stops that the start touches, and bounces off them.
    ///
    /// # Errors
    /// [`Error::Behind`], [`Error::Impact`].
    pub(super) fn touch(&mut self) -> Result<(), Error> {
        if !D::JUMPS || !self.jumps() {
            return Ok(());
        }
        let (t, stops) = (self.now.t.to_f64(), self.dynamics.info().stops);
        self.with_memories(|equations, at, inputs, room| modes::look(equations, at, inputs, room));
        let size = self.with_jump(|jump| jump.size());
        self.stopping.size = self.stopping.size.max(size);
        let size = BEHIND * self.stopping.size;
        let slopes = self.with_jump(|jump| jump.slopes());
        let allowed: Each<f64> = vectors::each(&mut |stop| size * number(&slopes, stop));
        let behind = self.with_jump(|jump| {
            let gaps = vectors::numbers(&jump.gaps().gap);
            gaps.into_iter()
                .zip(allowed)
                .enumerate()
                .take(stops.len())
                .find(|(_, (gap, allowed))| *gap < -*allowed)
        });
        if let Some((stop, (gap, _))) = behind {
            return Err(self.dynamics.info().behind(t, stop, gap));
        }
        let touched = self.with_jump(|jump| {
            let gaps = vectors::numbers(&jump.gaps().gap);
            those(stops.len(), |stop| gaps.get(stop) <= allowed.get(stop))
        });
        // frictions stick, and modes hold
        let may_hold = self.dynamics.info().contacts() > stops.len();
        if touched == 0 && !may_hold { Ok(()) } else { self.jump_once(touched, false) }
    }

    /// Refuses the end of a step where a gap has no value.
    ///
    /// # Errors
    /// [`Error::Undefined`].
    pub(super) fn check_gaps(&mut self) -> Result<(), Error> {
        if !D::JUMPS || self.dynamics.info().stops.is_empty() {
            return Ok(());
        }
        let Self { dynamics, now, all, .. } = self;
        dynamics.complete(now.t, &now.q, &now.v, all);
        let [q, v] = all;
        let mut still = dynamics.declared_start().1;
        vectors::fill(still.as_mut(), D::Real::default());
        let at = At { t: now.t, q: q.as_ref(), v: v.as_ref() };
        let gaps = Gaps::of(dynamics.equations(), at, still.as_ref());
        has_gaps(dynamics.equations(), now.t, &gaps.gap)
    }

    /// Goes back to where the last step began if that was too long to see what gaps do in it; true if it does.
    pub(super) fn is_shorter(&mut self) -> bool {
        if !D::JUMPS {
            return false;
        }
        let h = (self.now.t - self.before.t).to_f64();
        let is_long = core::mem::take(&mut self.stopping.is_too_long) && h > SHORT * self.effort.longest;
        if is_long {
            self.step_back();
            // it was no step of the run
            self.effort = self.stopping.effort;
            self.effort.rejected += 1;
            self.control.next = SHORTER * h;
        }
        is_long
    }

    /// True of what is watched of a friction that sticks.
    pub(super) fn is_sticking(&mut self, index: usize) -> bool {
        if !D::JUMPS {
            return false;
        }
        let Some(row) = stop_in(self.dynamics.equations(), index) else { return false };
        let sticking = self.with_jump(|jump| {
            let equations = jump.dynamics.equations();
            held(equations, jump.inputs) & all_frictions(equations.info())
        });
        has(sticking, row)
    }

    /// True of a stop or a friction that others hold: a stop that stays closed in the last step and is not rested on, a
    /// friction that slides and does not move in it.
    pub(super) fn is_held_by_others(&mut self, index: usize, watched: &mut Watched<'_, D>) -> bool {
        if !D::JUMPS {
            return false;
        }
        let Some(row) = stop_in(self.dynamics.equations(), index) else { return false };
        let (size, ends) = (CLOSED * self.stopping.size, [self.before.t, self.now.t]);
        let h = (ends[1] - ends[0]).to_f64();
        let allowed = self.with_jump(|jump| {
            let (equations, slopes) = (jump.dynamics.equations(), jump.slopes());
            let (held, friction) = (held(equations, jump.inputs), all_frictions(equations.info()));
            let is_friction = has(friction, row);
            let is_free = held != 0 && !has(held, row);
            // of the value of a friction, which is a rate
            let per = if is_friction { h } else { 1.0 };
            is_free.then(|| size * number(&slopes, row) / per)
        });
        let Some(allowed) = allowed else { return false };
        ends.into_iter().all(|t| self.value_between(t, index, watched).to_f64().abs() <= allowed)
    }

    /// True of the friction of a stop that has been looked at too often where the last step began: its slip is rounding. A slip
    /// against its direction that is more than rounding is found at the next step.
    pub(super) fn is_idle_at_stops(&self, index: usize) -> bool {
        if !D::JUMPS {
            return false;
        }
        let equations = self.dynamics.equations();
        let row = stop_in(equations, index);
        let is_rubbing = row.is_some_and(|row| has(all_rubbing(equations.info()), row));
        is_rubbing && self.stopping.looks == (self.before.t.to_f64(), MOST_LOOKS)
    }

    /// Lets the next jump rest on a stop; false if that has been tried too often at this time.
    pub(super) fn is_stuck(&mut self, stop: usize) -> bool {
        let (t, Stopping { stuck, reached, looks, .. }) = (self.now.t.to_f64(), &mut self.stopping);
        let count = if looks.0 == t { looks.1 + 1 } else { 1 };
        *looks = (t, count);
        *stuck |= bit(stop);
        *reached |= bit(stop);
        count <= MOST_LOOKS
    }

    /// Leads the end of a step back to the stops that are rested on, as joints are led back to their constraints. One whose
    /// velocity jumps, as a floor does that a table moves, hits what rests on it.
    pub(super) fn stay(&mut self) {
        if !D::JUMPS || !self.jumps() {
            return;
        }
        let size = self.stopping.size;
        let found = self.with_jump(|jump| {
            let held = held(jump.dynamics.equations(), jump.inputs);
            if held == 0 {
                return None;
            }
            let hit = jump.hit(held, size);
            if hit == 0 {
                let (gaps, info) = (jump.gaps().gap, jump.dynamics.info());
                jump.clear(placed(info, held) & !all_frictions(info), &gaps, true);
                let rates = jump.gaps().rate;
                jump.clear(held, &rates, false);
            }
            Some((jump.q.clone(), jump.v.clone(), hit))
        });
        if let Some((q, v, hit)) = found {
            (self.now.q, self.now.v) = (self.dynamics.states(&q), self.dynamics.states(&v));
            self.is_solved = false;
            self.stopping.reached |= hit;
        }
    }

    fn with_jump<R>(&mut self, what: impl FnOnce(&mut Jump<'_, D>) -> R) -> R {
        let Self { dynamics, inputs, now, all, effort, stopping, .. } = self;
        dynamics.complete(now.t, &now.q, &now.v, all);
        let [q, v] = all.clone();
        let slowest = if effort.longest > 0.0 { CLOSED * stopping.size / effort.longest } else { 0.0 };
        let mut present = dynamics.inputs_at(now.t, inputs);
        dynamics.with_inputs(&mut present, |inputs| {
            what(&mut Jump { dynamics: &*dynamics, inputs, t: now.t, a: q.clone(), q, v, slowest })
        })
    }

    /// Does something that sets memories in the present state.
    pub(super) fn with_memories<R>(
        &mut self,
        what: impl FnOnce(&dyn Equations<D::Real>, At<'_, D::Real>, &mut [D::Real], [&mut [D::Real]; 2]) -> R,
    ) -> R {
        let Self { dynamics, inputs, now, all, .. } = self;
        dynamics.complete(now.t, &now.q, &now.v, all);
        let [q, v] = all;
        let at = At { t: now.t, q: q.as_ref(), v: v.as_ref() };
        let sampling = dynamics.info().sampling;
        let (mut a, mut lambda) = (dynamics.declared_start().1, dynamics.no_feedback());
        let mut present = dynamics.inputs_at(now.t, inputs);
        dynamics.with_inputs(&mut present, |present| {
            let result = what(dynamics.equations(), at, present, [a.as_mut(), lambda.as_mut()]);
            dynamics.with_inputs(inputs, |own| sampling.set_memories(own, present));
            result
        })
    }

    /// The jump at stops that are reached: those whose gap has closed, and those that pull; and those that conditions ask for
    /// by the velocities and forces behind it.
    fn jump_at(&mut self, mut reached: u32, mut are_forces_known: bool) -> Result<(), Error> {
        let off = self.stopping.off;
        for _ in 0..=modes::IN_SEQUENCE {
            self.jump_once(reached, core::mem::replace(&mut are_forces_known, true))?;
            if self.dynamics.info().modes.transitions.is_empty() {
                return Ok(());
            }
            let (due, _) = self.with_memories(|equations, at, inputs, room| {
                modes::due(equations, at, inputs, Judging { off, room }, true)
            });
            if due == 0 {
                return Ok(());
            }
            reached = due << MOST_CONTACTS;
            self.happened.due |= watched_of(reached);
        }
        let (t, transitions) = (self.now.t.to_f64(), reached >> MOST_CONTACTS);
        Err(modes::endless(self.dynamics.info(), t, transitions))
    }

    /// Tells of the transitions that were passed without being found.
    ///
    /// # Errors
    /// [`Error::Endless`] where they follow each other too often.
    fn note_passed(&mut self, passed: u32, found: u32) -> Result<(), Error> {
        if passed == 0 {
            return Ok(());
        }
        self.happened.due |= watched_of((passed & !found) << MOST_CONTACTS);
        let (t, longest) = (self.now.t.to_f64(), self.effort.longest);
        if self.stopping.passed.at(t, longest) <= MOST_OFTEN {
            return Ok(());
        }
        Err(modes::endless(self.dynamics.info(), t, passed))
    }

    /// Counts impacts.
    ///
    /// # Errors
    /// [`Error::EndlessImpacts`] where they follow each other too often.
    fn note_struck(&mut self, impulses: &Each<D::Real>) -> Result<(), Error> {
        let stops = self.dynamics.info().stops.iter().zip(impulses);
        let mut struck = stops.filter(|(_, impulse)| **impulse > D::Real::default());
        let (t, longest) = (self.now.t.to_f64(), self.effort.longest);
        match struck.next() {
            Some((stop, _)) if self.stopping.struck.at(t, longest) > MOST_IMPACTS => {
                Err(Error::EndlessImpacts { t, stop: stop.name })
            }
            _ => Ok(()),
        }
    }

    /// One of them. At a start forces are not known before it.
    fn jump_once(&mut self, reached: u32, are_forces_known: bool) -> Result<(), Error> {
        // what lies behind was computed with the memories of before
        self.inputs_mut();
        let (found, Stopping { off, size, .. }) = (reached >> MOST_CONTACTS, self.stopping);
        let passed = self.with_memories(|equations, at, inputs, room| {
            let passed =
                modes::pass(equations, at, inputs, (found, are_forces_known), Judging { off, room })?;
            modes::note_found(equations.info(), (found, size), inputs);
            Ok(passed)
        })?;
        self.note_passed(passed, found)?;
        let (longest, mut stopping) = (self.effort.longest, self.stopping);
        let found = self.with_jump(|jump| {
            let held = held(jump.dynamics.equations(), jump.inputs);
            let outcome = jump.lead(reached, held, longest, &mut stopping)?;
            let info = jump.dynamics.info();
            let mut directions = [0.0; MOST_CONTACTS];
            for (of, (row, _)) in directions.iter_mut().zip(frictions(info)) {
                *of = direction(info, jump.inputs, row);
            }
            Ok((jump.q.clone(), jump.v.clone(), outcome, directions))
        });
        let (q, v, Outcome { held: now_held, closed, impulses, struck, flight }, directions) = found?;
        self.stopping = stopping;
        self.note_struck(&impulses)?;
        // stops that were hit without an event of their gap: at a start, at the entry of a mode, where a floor begins to move
        let known = among(self.happened.all, self.dynamics.info());
        self.happened.due |= watched_of(struck & !known);
        // a step over many flights would round the first one away
        self.control.next = self.control.next.min(FLIGHTS * flight);
        if !self.happened.is_set {
            self.arrival = self.now.clone();
        }
        let Self { dynamics, inputs, now, before, .. } = self;
        (now.q, now.v) = (dynamics.states(&q), dynamics.states(&v));
        let stops = dynamics.info().stops;
        dynamics.with_inputs(inputs, |inputs| {
            for (at, stop) in stops.iter().enumerate() {
                let impulse = impulses.get(at).copied().unwrap_or_default();
                if let Some(memory) = inputs.get_mut(stop.memory) {
                    *memory = D::Real::from_f64(if has(now_held, at) { 1.0 } else { 0.0 });
                }
                if let Some(memory) = inputs.get_mut(stop.memory + 1) {
                    *memory = *memory + impulse;
                }
            }
            let info = dynamics.info();
            for (direction, (row, _)) in directions.into_iter().zip(frictions(info)) {
                set(info, inputs, row, (direction, D::Real::default()));
            }
        });
        *before = now.clone();
        self.between.begin(false);
        let Happened { all, rising, due, judged, turned, .. } = self.happened;
        let ours = watched_of(of_run(dynamics.info()));
        // an open stop that is closed still is left from its event; the force at another one has not been looked at
        let left = watched_of(closed & !now_held);
        self.happened = Happened {
            all: all & !ours | left,
            rising: rising & !ours,
            due,
            judged: judged & !ours,
            turned: turned & !ours,
            is_set: true,
        };
        Ok(())
    }
}
