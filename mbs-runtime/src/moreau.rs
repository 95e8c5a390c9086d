//! Stops in runs with constant steps: time stepping by Moreau and Jean.
//!
//! A step is made as if there were no stops. Where a gap g is closed at its end, impulses Λ ≥ 0 act along ∂g/∂q. With the
//! responses Y to unit impulses and W = ∂g/∂q Y,
//!
//! ```text
//! v⁺ = v + Y Λ,   q⁺ = q + (1 − s) h Y Λ,   W Λ + ġ ≥ e |ġ_s| + (1 − s)(ġ − ġ₀),   one or the other is equal to 0
//! ```
//!
//! where ġ₀ and ġ are the rates of the gap with the velocities at the start and at the end of the step, both at the positions
//! of the end. The gap closes after the part s of the step, as its values at both ends tell, with the rate ġ_s. Impulses act
//! at gaps that close; where they make others close, the next impacts follow, each by Newton's law, so that no impulse gives
//! energy. A rebound that the force at the stop takes back within one step, as h g̈ tells, is not flown: the stop is rested on, and
//! its gap is made 0 by the shortest way by masses.
//!
//! Where a stop is rested on at the start of a step, half of the impulse of its force acts before the step and half of it
//! behind (a symmetric splitting): between, velocities are those of the rest on average, and nothing moves. The
//! rate that the second half leaves at such a stop is an impact: a floor that speeds up gives none, one that begins to move at
//! once does.
//!
//! # Source
//! J. J. Moreau (1988), Unilateral contact and dry friction in finite freedom dynamics; M. Jean, Comput. Methods Appl. Mech.
//! Eng. 177 (1999) 235; V. Acary, ibid. 256 (2013) 224, for the correction of positions.

pub use crate::changes::{Changes, Vectors};
use crate::contact::{Contacts, Each, Gaps, MOST_CONTACTS, has, number, those};
use crate::equations::{At, Equations};
use crate::halting::halt;
use crate::locks::{all_stops, locked, placed};
use crate::modes::{self, Judging, close, due, engage, pass};
use crate::pressing::held;
use crate::rubbing::{self, Bounds, Struck};
use crate::sticking::{Held, Undecided, all_frictions, decide, direction};
use crate::striking::{Answer, Ends, Sizes, Striking, of, zip};
pub use crate::touching::begin;
use crate::{Error, Real, touching, vectors};

/// The stops that push before a step and the frictions that stick, with half of the impulses of rest.
#[derive(Clone, Copy, Debug)]
pub struct Pushed<T> {
    pub(crate) set: u32,
    pub(crate) halves: Each<T>,
}

impl<T: Real> Pushed<T> {
    /// Nothing pushes.
    pub(crate) const NONE: Self = Self { set: 0, halves: [T::ZERO; MOST_CONTACTS] };

    /// True if velocities have changed.
    pub fn is_any(&self) -> bool {
        self.set != 0
    }
}

/// Adds half of the impulses of rest over a step of `h` seconds to the velocities at its start, and sets the memories of
/// frictions that break loose.
///
/// # Errors
/// [`Error::Impact`], [`Error::Jammed`].
pub fn push<T: Real>(
    equations: &dyn Equations<T>,
    (h, changes): (T, Changes<'_, T>),
    (t, q, v): (T, &[T], &mut [T]),
    inputs: &mut [T],
) -> Result<Pushed<T>, Error> {
    let (info, held) = (equations.info(), held(equations, inputs));
    if held == 0 {
        return Ok(Pushed::NONE);
    }
    let Changes { still, rows, q: of_q, v: of_v } = changes;
    let own = Changes { still, rows: &mut *rows, q: &mut *of_q, v: of_v };
    engage(equations, (h, own), (t, q, &mut *v), inputs)?;
    let still = held & all_frictions(info);
    let (at, undecided) = (At { t, q, v }, Undecided { resting: held & all_stops(info), still, breaking: 0 });
    let Held { held, forces } = decide(equations, at, inputs, undecided, [of_q, rows])?;
    // what rubs on stops that are left does not stick in the step
    let still = held & still;
    let half = T::from_f64(0.5) * h;
    let halves = forces.map(|force| half * force);
    Contacts::at(equations, (t, q), |contacts| contacts.add(&halves, v));
    let holds = held & (still | locked(info, inputs));
    let set = those(MOST_CONTACTS, |row| has(holds, row) || number(&forces, row) > 0.0);
    Ok(Pushed { set, halves })
}

/// Answers the stops and the frictions that stick at the end of a step of `h` seconds: changes all coordinates and velocities
/// there, and sets their memories. Stops that have [pushed](push) before the step count as closed. Gives true if anything has
/// changed.
///
/// # Errors
/// [`Error::Impact`], [`Error::Jammed`].
pub fn strike<T: Real>(
    equations: &dyn Equations<T>,
    (h, changes): (T, Changes<'_, T>),
    (pushed, before): (&Pushed<T>, At<'_, T>),
    (t, [q, v]): (T, [&mut [T]; 2]),
    inputs: &mut [T],
) -> Result<bool, Error> {
    let Changes { still, rows, q: of_q, v: of_v } = changes;
    let judging = Judging { off: modes::OFF, room: [&mut *of_q, &mut *rows] };
    let (found, _) = due(equations, At { t, q, v }, inputs, judging, false);
    let own = Changes { still, rows: &mut *rows, q: &mut *of_q, v: &mut *of_v };
    let (is_struck, is_impact) =
        strike_stops(equations, (h, own), (pushed, before), (t, [&mut *q, &mut *v]), inputs)?;
    let own = Changes { still, rows: &mut *rows, q: &mut *of_q, v: &mut *of_v };
    let has_halted = halt(equations, (h, own), (pushed.set, before), (t, [&mut *q, &mut *v]), inputs)?;
    if is_impact {
        keep_pushing(equations, At { t, q, v }, inputs, [&mut *of_q, &mut *rows])?;
    }
    let own = Changes { still, rows, q: of_q, v: of_v };
    // an impact throws back what a condition has let pass; what modes, rests and frictions lead back has not passed it
    let found = if is_impact { found } else { 0 };
    let passes = pass_and_engage(equations, (h, own), found, (t, [q, v]), inputs)?;
    Ok(has_halted || is_struck || passes)
}

/// Leaves the stops that would have to pull at what rests on them with the velocities behind an impact.
///
/// # Errors
/// [`Error::Impact`], [`Error::Jammed`].
fn keep_pushing<T: Real>(
    equations: &dyn Equations<T>,
    at: At<'_, T>,
    inputs: &mut [T],
    room: [&mut [T]; 2],
) -> Result<(), Error> {
    let (info, all) = (equations.info(), held(equations, inputs));
    let resting = all & all_stops(info);
    if resting == 0 {
        return Ok(());
    }
    let undecided = Undecided { resting, still: all & all_frictions(info), breaking: 0 };
    let Held { forces, .. } = decide(equations, at, inputs, undecided, room)?;
    let pushing = those(info.stops.len(), |stop| has(resting, stop) && number(&forces, stop) > 0.0);
    note(equations, pushing, &[T::ZERO; MOST_CONTACTS], inputs);
    Ok(())
}

/// Takes the samples of conditions that have begun to hold, and leads the end of a step to the constraints of the modes that
/// hold then. True if there were any.
///
/// # Errors
/// [`Error::Apart`], [`Error::Contradiction`], [`Error::Endless`].
fn pass_and_engage<T: Real>(
    equations: &dyn Equations<T>,
    (h, Changes { still, rows, q: of_q, v: of_v }): (T, Changes<'_, T>),
    mut found: u32,
    (t, [q, v]): (T, [&mut [T]; 2]),
    inputs: &mut [T],
) -> Result<bool, Error> {
    let mut all = 0;
    for _ in 0..=modes::IN_SEQUENCE {
        let judging = Judging { off: modes::OFF, room: [&mut *of_q, &mut *rows] };
        let passes = pass(equations, At { t, q, v }, inputs, (core::mem::take(&mut found), true), judging)?;
        all |= passes;
        if passes == 0 {
            return Ok(all != 0);
        }
        // with the velocities of before the way of a step is known, and with those behind where they lead
        for is_first in [true, false] {
            let own = Changes { still, rows: &mut *rows, q: &mut *of_q, v: &mut *of_v };
            engage(equations, (h, own), (t, q, &mut *v), inputs)?;
            if is_first {
                let own = Changes { still, rows: &mut *rows, q: &mut *of_q, v: &mut *of_v };
                close(equations, own, (t, &mut *q, v), inputs);
            }
        }
        // what modes have let go may slide, and what they hold does not
        let resting = held(equations, inputs) & all_stops(equations.info());
        let still = touching::slide(equations, At { t, q, v }, still, inputs);
        let undecided = Undecided { resting, still, breaking: 0 };
        // velocities and forces change, and other conditions may begin
        decide(equations, At { t, q, v }, inputs, undecided, [&mut *of_q, &mut *rows])?;
    }
    Err(modes::endless(equations.info(), t.to_f64(), all))
}

/// Answers the stops alone; frictions that stick and modes follow. True if anything has changed, and if that was an impact.
fn strike_stops<T: Real>(
    equations: &dyn Equations<T>,
    (h, changes): (T, Changes<'_, T>),
    (pushed, before): (&Pushed<T>, At<'_, T>),
    (t, [q, v]): (T, [&mut [T]; 2]),
    inputs: &mut [T],
) -> Result<(bool, bool), Error> {
    let count = equations.info().stops.len();
    let (halves, locked) = (&pushed.halves, locked(equations.info(), inputs));
    let pushed = pushed.set & all_stops(equations.info());
    let now = Gaps::of(equations, At { t, q, v }, changes.still);
    has_gaps(equations, t, &now.gap)?;
    let closed = pushed | those(count, |stop| number(&now.gap, stop) <= 0.0);
    if closed == 0 {
        note(equations, 0, &[T::ZERO; MOST_CONTACTS], inputs);
        return Ok((false, false));
    }
    let gap_before = Gaps::of(equations, before, changes.still).gap;
    equations.free_reactions(At { t, q, v }, inputs, changes.q, changes.rows);
    let pressing = Gaps::of(equations, At { t, q, v }, changes.q).acceleration.map(|a| h * a);
    let largest = |of: &[T]| vectors::largest(equations.info().of_bodies(of)).1.to_f64();
    let (size, speed) = (largest(q), largest(before.v).max(largest(v)));
    // velocities as joints at the end have them: those of the start change by forces alone, and stops that depend on each
    // other do not contradict each other by what joints are off
    let mut rate = |velocities: &[T]| {
        equations.phi_dot(At { t, q, v: velocities }, changes.rows);
        equations.projection(t, q, changes.rows, changes.q);
        vectors::copy(changes.v, velocities);
        vectors::zip_map(changes.v, changes.q, |v, change| v - change);
        Gaps::of(equations, At { t, q, v: changes.v }, changes.still).rate
    };
    let ends = Ends { gap: [gap_before, now.gap], rate: [rate(before.v), rate(v)] };
    let restitutions = restitutions(equations);
    let (info, bounds) = (equations.info(), Bounds::of(equations));
    let slid = core::array::from_fn(|row| direction(info, inputs, row));
    let held = held(equations, inputs);
    let (rested, stuck) = (held & all_stops(info), held & rubbing::all_rubbing(info));
    let answered = Contacts::at(equations, (t, q), |contacts| {
        let sizes = Sizes::of(&contacts, size, speed);
        let (from, laws) = ((&contacts, info, locked), (&restitutions, &bounds, &slid));
        let rests = (rested | pushed, pushed, halves);
        let striking = Striking::new(from, h, (&ends, &pressing, &sizes), laws, rests);
        let answer = striking.answer(closed)?;
        // what has stuck in the whole step is where it was
        let back = those(MOST_CONTACTS, |row| has(stuck, row) && number(&answer.directions, row) == 0.0);
        let off = core::array::from_fn(|row| {
            let was = if has(back, row) { of(&gap_before, row) } else { T::ZERO };
            of(&answer.gap, row) - was
        });
        let shifts = contacts.solve(answer.held | back | placed(info, locked), &off);
        vectors::fill(changes.q, T::ZERO);
        vectors::fill(changes.v, T::ZERO);
        contacts.add(&zip(&answer.moved, &shifts, |moved, shift| moved + shift), changes.q);
        contacts.add(&answer.impulses, changes.v);
        Some(answer)
    });
    let answer = answered.flatten().ok_or_else(|| impact(equations, t, closed))?;
    vectors::zip_map(q, changes.q, |q, change| q + change);
    vectors::zip_map(v, changes.v, |v, change| v + change);
    // a force that presses for a step is no impact, nor has the second half of a rest a part in one
    let noted = core::array::from_fn(|stop| {
        let second = if has(pushed, stop) { of(halves, stop) } else { T::ZERO };
        let more = of(&answer.impulses, stop) - second;
        if answer.is_impact && more > T::ZERO { more } else { T::ZERO }
    });
    note(equations, answer.held, &noted, inputs);
    let Answer { impulses, directions, is_impact, .. } = answer;
    let struck = Struck {
        impulses,
        held: answer.held,
        directions,
        rubbed: rubbing::borne(info, closed | answer.held),
    };
    rubbing::note(info, inputs, &struck);
    Ok((true, is_impact))
}

/// Refuses a gap that has no value, which nobody would see close.
///
/// # Errors
/// [`Error::Undefined`].
pub(crate) fn has_gaps<T: Real>(equations: &dyn Equations<T>, t: T, gaps: &Each<T>) -> Result<(), Error> {
    let mut stops = equations.info().stops.iter().zip(gaps);
    match stops.find(|(_, gap)| gap.to_f64().is_nan()) {
        Some((stop, gap)) => {
            let (t, value) = (t.to_f64(), gap.to_f64());
            Err(Error::Undefined { t, what: "the gap of stop", name: stop.name, value })
        }
        None => Ok(()),
    }
}

/// The change of the rate of each gap in a step by the force at its own stop; `change` is that of all rates without stops.
pub(crate) fn taken<T: Real>(
    contacts: &Contacts<'_, T>,
    (closed, locked): (u32, u32),
    change: &Each<T>,
) -> Option<Each<T>> {
    let (_, impulses) = contacts.complementary(closed | locked, locked, change)?;
    Some(core::array::from_fn(|stop| contacts.mobility(stop, stop) * of(&impulses, stop)))
}

/// e of every stop.
pub(crate) fn restitutions<T: Real>(equations: &dyn Equations<T>) -> Each<T> {
    let mut laws = [T::ZERO; 2 * MOST_CONTACTS];
    if let Some(laws) = laws.get_mut(..2 * equations.info().stops.len()) {
        equations.stop_laws(laws);
    }
    core::array::from_fn(|stop| laws.get(2 * stop).copied().unwrap_or_default())
}

/// The rates −e ġ with which gaps open again that close with the rates ġ.
pub(crate) fn rebounds<T: Real>(restitutions: &Each<T>, rates: &Each<T>) -> Each<T> {
    zip(
        restitutions,
        rates,
        |restitution, rate| if rate.to_f64() < 0.0 { -(restitution * rate) } else { T::ZERO },
    )
}

/// Sets the memories of all stops: those that are rested on, and what impulses add up to.
pub(crate) fn note<T: Real>(equations: &dyn Equations<T>, held: u32, impulses: &Each<T>, inputs: &mut [T]) {
    for (at, stop) in equations.info().stops.iter().enumerate() {
        if let Some(memory) = inputs.get_mut(stop.memory) {
            *memory = T::from_f64(if has(held, at) { 1.0 } else { 0.0 });
        }
        if let Some(memory) = inputs.get_mut(stop.memory + 1) {
            *memory = *memory + of(impulses, at);
        }
    }
}

pub(crate) fn impact<T: Real>(equations: &dyn Equations<T>, t: T, closed: u32) -> Error {
    let stop = equations.info().stops.get(closed.trailing_zeros() as usize);
    Error::Impact { t: t.to_f64(), stop: stop.map_or("", |stop| stop.name) }
}
