//! Modes at the ends of steps: what enters and leaves them, and the impulses of entering.
//!
//! A mode is a memory of 1 while its constraints hold. Their rows stand behind those of stops and frictions, and hold with
//! any force: where W x + b is asked to be 0 they take part, whatever the sign of x. Where a mode is entered impulses Λ lead
//! the rates ġ of its constraints to 0,
//!
//! ```text
//! W Λ + ġ = 0    v⁺ = v + Y Λ
//! ```
//!
//! which is an impact without restitution: what joints leave free keeps its momentum. A mode is left without one.
//!
//! A transition is a sample where a condition begins to hold. A memory keeps on which side of its condition it was last, so
//! that also what jumps is seen; and the largest difference of the two sides of the condition so far, of which a small share
//! is rounding. What stays at its limit holds.
//!
//! Conditions may ask for forces and accelerations, which are those of a state: of the one before a jump, and behind it of the
//! one to which velocities have been led.

use crate::changes::Changes;
use crate::contact::{Contacts, Each, Gaps, MOST_CONTACTS, bit, has, number, share};
use crate::declared::DeclaredTransition;
use crate::equations::{At, Equations};
use crate::locks::{all_stops, locked, placed};
use crate::mechanism::growth_limit;
use crate::pressing::held;
use crate::rubbing::{Bounds, Hit};
use crate::sticking::{measure, unanswered};
use crate::{Error, Info, Real, rubbing, sticking, vectors};

/// So often transitions follow each other at one moment.
pub(crate) const IN_SEQUENCE: usize = 16;
/// A mode holds where its constraints are met within this share of the size of the coordinates,
pub(crate) const CLOSED: f64 = 1e-6;
/// or within so many steps at the rate with which they close.
const STEPS: f64 = 4.0;
/// So many of Newton's steps lead positions to them, each with a residual that is the square of that before.
const CLOSINGS: usize = 4;
/// The least size in m or rad.
const LEAST_SIZE: f64 = 1e-3;
/// A condition begins to hold at its limit, up to this share of the largest difference of its sides so far.
const ROUNDING: f64 = 1e-12;
/// One that holds stops to hold where it is off by this share: a mode keeps it at its limit with an error of a step.
pub(crate) const OFF: f64 = 1e-6;
/// A speed that moves coordinates by this share of their size in a step is none.
const STILL: f64 = 1e-9;
/// A value that was 0 from the start on has this size.
const NONE: f64 = 1e-30;
/// Impulses leave this share of a rate where its constraint depends on others.
const LEFT: f64 = 1e-6;

/// The first constraint of a set that is off by more than is allowed.
///
/// # Errors
/// [`Error::Apart`].
pub(crate) fn are_met(
    info: &Info,
    t: f64,
    set: u32,
    off: impl Fn(usize) -> f64,
    allowed: impl Fn(usize) -> f64,
) -> Result<(), Error> {
    // written so that a NaN is not met
    let is_met = |row: usize| off(row).abs() <= allowed(row);
    match info.locks().find(|(row, _)| has(set, *row) && !is_met(*row)) {
        Some((row, lock)) => Err(Error::Apart { t, constraint: lock.name, by: off(row) }),
        None => Ok(()),
    }
}

/// The first constraint of a set whose rate is more than what is left of it.
///
/// # Errors
/// [`Error::Contradiction`].
pub(crate) fn do_not_contradict(
    info: &Info,
    t: f64,
    set: u32,
    rate: impl Fn(usize) -> f64,
    left: impl Fn(usize) -> f64,
) -> Result<(), Error> {
    let met = are_met(info, t, set, rate, left);
    met.map_err(|error| match error {
        Error::Apart { t, constraint, by } => Error::Contradiction { t, constraint, rate: by },
        other => other,
    })
}

/// The most by which a constraint may be off where its mode is entered, given Σ |∂g/∂q|.
pub(crate) fn allowed<T: Real>(size: f64, slope: f64) -> f64 {
    share::<T>(CLOSED) * (LEAST_SIZE + size) * slope
}

/// The part of a constraint, or of its rate, by which joints are off: twice Σ |μ Φ|, μ the multipliers of a unit impulse along
/// it.
fn of_joints<T: Real>(contacts: &Contacts<'_, T>, row: usize, off: &[T]) -> f64 {
    let terms = contacts.reactions(row).iter().zip(off);
    2.0 * terms.map(|(reaction, off)| (*reaction * *off).to_f64().abs()).sum::<f64>()
}

/// The most that impulses may leave of rates up to one: they leave more where constraints depend on others.
pub(crate) fn left_of<T: Real>(fastest: f64) -> f64 {
    share::<T>(LEFT) * fastest
}

/// Leads velocities to the constraints of the modes that hold, at the start or the end of a step of `h` seconds.
///
/// # Errors
/// [`Error::Apart`], [`Error::Contradiction`].
pub(crate) fn engage<T: Real>(
    equations: &dyn Equations<T>,
    (h, changes): (T, Changes<'_, T>),
    (t, q, v): (T, &[T], &mut [T]),
    inputs: &mut [T],
) -> Result<(), Error> {
    let info = equations.info();
    let locked = locked(info, inputs);
    if locked == 0 {
        return Ok(());
    }
    let gaps = Gaps::of(equations, At { t, q, v }, changes.still);
    let size = vectors::largest(info.of_bodies(q)).1.to_f64();
    let fastest = vectors::largest(info.of_bodies(v)).1.to_f64();
    vectors::fill(changes.v, T::ZERO);
    let resting = held(equations, inputs) & all_stops(info);
    let bounds = Bounds::of(equations);
    let directions = [0.0; MOST_CONTACTS];
    let hit = Hit { info, closed: resting, bound: locked, directions, bounds: &bounds, rates: &gaps.rate };
    let Changes { rows, v: of_v, .. } = changes;
    let answered = Contacts::at(equations, (t, q), |contacts| {
        let way = |row: usize| STEPS * h.to_f64() * number(&gaps.rate, row).abs();
        equations.phi(t, q, rows);
        let allowed =
            |row: usize| allowed::<T>(size, contacts.slope(row)) + way(row) + of_joints(&contacts, row, rows);
        are_met(info, t.to_f64(), locked, |row| number(&gaps.gap, row), allowed)?;
        // written so that a NaN is no growth
        let has_growth = contacts.growth() < growth_limit();
        let solved = hit.answer(&contacts, &gaps.rate).filter(|_| has_growth);
        let struck = solved.ok_or_else(|| unanswered(info, t.to_f64(), locked))?;
        let impulses = struck.impulses;
        let left = contacts.rates(&impulses);
        let after = |row: usize| number(&gaps.rate, row) + number(&left, row);
        // and what moves no position by more than rounding
        let slowest = STILL * (LEAST_SIZE + size) / h.to_f64();
        equations.phi_dot(At { t, q, v }, rows);
        let left = |row: usize| {
            left_of::<T>(number(&gaps.rate, row).abs() + contacts.slope(row) * fastest)
                + contacts.slope(row) * slowest
                + of_joints(&contacts, row, rows)
        };
        do_not_contradict(info, t.to_f64(), locked, after, left)?;
        contacts.add(&impulses, of_v);
        rubbing::note(info, inputs, &struck);
        // the entry of a mode hits what is rested on; a smaller impulse is the rounding of a mode that holds
        for (stop, declared) in info.stops.iter().enumerate() {
            let impulse = impulses.get(stop).copied().unwrap_or_default();
            let rate = (contacts.mobility(stop, stop) * impulse).to_f64();
            let memory = inputs.get_mut(declared.memory + 1);
            if let Some(sum) = memory.filter(|_| rate > left_of::<T>(contacts.slope(stop) * fastest)) {
                *sum = *sum + impulse;
            }
        }
        Ok(())
    });
    answered.unwrap_or(Ok(()))?;
    vectors::zip_map(v, of_v, |v, change| v + change);
    Ok(())
}

/// Leads positions to the constraints of the modes that hold, where these were entered at the end of a step; stops that are
/// rested on stay closed.
pub(crate) fn close<T: Real>(
    equations: &dyn Equations<T>,
    changes: Changes<'_, T>,
    (t, q, v): (T, &mut [T], &[T]),
    inputs: &[T],
) {
    let info = equations.info();
    let locked = locked(info, inputs);
    if locked == 0 {
        return;
    }
    let set = placed(info, locked) | held(equations, inputs) & all_stops(info);
    for _ in 0..CLOSINGS {
        let gap = Gaps::of(equations, At { t, q, v }, changes.still).gap;
        vectors::fill(changes.q, T::ZERO);
        Contacts::at(equations, (t, q), |contacts| contacts.add(&contacts.solve(set, &gap), changes.q));
        vectors::zip_map(q, changes.q, |q, change| q + change);
    }
}

/// The share by which conditions that hold may be off, and vectors for the accelerations and multipliers that they see.
pub(crate) struct Judging<'a, T> {
    pub off: f64,
    pub room: [&'a mut [T]; 2],
}

/// Notes on which side of its condition every transition is at a start. Those that see forces do not hold yet: no start declares
/// these.
pub(crate) fn look<T: Real>(
    equations: &dyn Equations<T>,
    at: At<'_, T>,
    inputs: &mut [T],
    room: [&mut [T]; 2],
) {
    let values = values(equations, at, inputs, room, false);
    for (transition, value) in equations.info().modes.transitions.iter().zip(values) {
        let is_below = transition.is_rising == (transition.is_strict || transition.sees_forces);
        let side = if is_below { -NONE } else { NONE };
        if let Some(to) = inputs.get_mut(transition.memory) {
            *to = if transition.sees_forces || value.to_f64() == 0.0 { T::from_f64(side) } else { value };
        }
    }
}

/// The transitions whose conditions have begun to hold, and what their memories are from then on. Those that see forces are
/// judged in a state, and not within a jump, where velocities have not followed yet.
pub(crate) fn due<T: Real>(
    equations: &dyn Equations<T>,
    at: At<'_, T>,
    inputs: &mut [T],
    Judging { off, room }: Judging<'_, T>,
    are_forces_known: bool,
) -> (u32, Each<T>) {
    let mut due = 0;
    let mut seen = values(equations, at, inputs, room, are_forces_known);
    for ((of, transition), value) in equations.info().modes.transitions.iter().enumerate().zip(&mut seen) {
        let before = inputs.get(transition.memory).copied().unwrap_or_default();
        if transition.sees_forces && !are_forces_known {
            *value = before;
            continue;
        }
        let side = if transition.is_rising { 1.0 } else { -1.0 };
        let (before, now) = (before.to_f64(), value.to_f64());
        let holds = match side * before > 0.0 {
            true => stays::<T>(transition, before.abs(), side * now, off),
            false => begins::<T>(transition, before.abs(), side * now),
        };
        if side * before < 0.0 && holds {
            due |= bit(of);
        }
        let size = before.abs().max(now.abs());
        *value = T::from_f64(if holds { side * size } else { -side * size });
    }
    (due, seen)
}

/// True if a condition that holds goes on to: its value is that much beyond its limit, and was at most `largest`.
fn stays<T: Real>(transition: &DeclaredTransition, largest: f64, beyond: f64, off: f64) -> bool {
    // where no mode holds that it asks for, there is no force
    let is_none = transition.sees_forces && transition.is_strict && beyond == 0.0;
    beyond >= -(share::<T>(off) * largest) && !is_none
}

/// True if a condition that does not hold begins to. Forces are solved for, and are none within rounding.
fn begins<T: Real>(transition: &DeclaredTransition, largest: f64, beyond: f64) -> bool {
    let rounding = share::<T>(ROUNDING) * largest;
    let is_at_limit = transition.holds_near && beyond.abs() <= rounding && largest > 2.0 * NONE;
    if transition.sees_forces { beyond > rounding } else { beyond > 0.0 || is_at_limit }
}

/// Notes that the conditions hold that a run has found. One that begins at its limit stays there within rounding for a while: it
/// holds until it is off by more than rounding of the coordinates.
pub(crate) fn note_found<T: Real>(info: &Info, (found, size): (u32, f64), inputs: &mut [T]) {
    let all = info.modes.transitions.iter().enumerate();
    for (_, transition) in all.filter(|(of, _)| has(found, *of)) {
        let Some(memory) = inputs.get_mut(transition.memory) else { continue };
        let side = if transition.is_rising { 1.0 } else { -1.0 };
        if side * memory.to_f64() <= 0.0 {
            *memory = T::from_f64(side * memory.to_f64().abs().max(ROUNDING / OFF * size));
        }
    }
}

/// The value of a transition, which falls through 0 where its condition begins to hold.
pub(crate) fn margin<T: Real>(
    equations: &dyn Equations<T>,
    at: At<'_, T>,
    (inputs, room): (&mut [T], [&mut [T]; 2]),
    transition: usize,
) -> T {
    let value = values(equations, at, inputs, room, true).get(transition).copied().unwrap_or_default();
    let Some(declared) = equations.info().modes.transitions.get(transition) else { return value };
    let value = if declared.is_rising { -value } else { value };
    let seen = inputs.get(declared.memory).copied().unwrap_or_default();
    if declared.sees_forces { value + T::from_f64(share::<T>(ROUNDING)) * seen.abs() } else { value }
}

/// Notes on which side of its condition every transition is.
pub(crate) fn note<T: Real>(info: &Info, seen: &Each<T>, inputs: &mut [T]) {
    for (transition, seen) in info.modes.transitions.iter().zip(seen) {
        if let Some(to) = inputs.get_mut(transition.memory) {
            *to = *seen;
        }
    }
}

/// Takes the samples of the transitions whose conditions have begun to hold, those of some that a run has found among them, and
/// of those whose conditions do by that. Gives them.
///
/// # Errors
/// [`Error::Endless`] where they follow each other without an end.
pub(crate) fn pass<T: Real>(
    equations: &dyn Equations<T>,
    at: At<'_, T>,
    inputs: &mut [T],
    (mut found, are_forces_known): (u32, bool),
    Judging { off, room: [a, lambda] }: Judging<'_, T>,
) -> Result<u32, Error> {
    let info = equations.info();
    let mut all = 0;
    for turn in 0..=IN_SEQUENCE {
        let judging = Judging { off, room: [&mut *a, &mut *lambda] };
        // behind what the first ones set, forces are known where velocities have followed
        let (due, seen) = due(equations, at, inputs, judging, are_forces_known && turn == 0);
        let due = due | core::mem::take(&mut found);
        note(info, &seen, inputs);
        if due == 0 {
            return Ok(all);
        }
        all |= due;
        for of in (0..info.modes.transitions.len()).filter(|of| has(due, *of)) {
            equations.sample(at, inputs, info.sampling.clocks + of);
        }
    }
    Err(endless(info, at.t.to_f64(), all))
}

/// Conditions of a set follow each other without an end.
pub(crate) fn endless(info: &Info, t: f64, set: u32) -> Error {
    let first = info.modes.transitions.get(set.trailing_zeros() as usize);
    Error::Endless { t, condition: first.map_or("", |transition| transition.condition) }
}

/// The value of every transition. Where forces are known, those that see them see those of this state; memories stay as they are.
fn values<T: Real>(
    equations: &dyn Equations<T>,
    at: At<'_, T>,
    inputs: &mut [T],
    [a, lambda]: [&mut [T]; 2],
    are_forces_known: bool,
) -> Each<T> {
    let info = equations.info();
    let mut values = [T::ZERO; MOST_CONTACTS];
    let Some(all) = values.get_mut(..info.modes.transitions.len()) else { return values };
    if are_forces_known && info.sees_forces() {
        let kept = sticking::remembered_forces(info, inputs);
        measure(equations, at, inputs, [&mut *a, &mut *lambda]);
        equations.transitions(at, inputs, [a, lambda], all);
        sticking::remember_forces(info, inputs, &kept);
    } else {
        equations.transitions(at, inputs, [a, lambda], all);
    }
    values
}
