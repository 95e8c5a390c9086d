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
//! energy. A rebound that the force at the stop takes back within one step is not flown: the stop is rested on, and its gap is
//! made 0 by the shortest way by masses.
//!
//! Where a stop is rested on at the start of a step, half of the impulse of its force acts before the step and half of it
//! behind (a symmetric splitting): between, velocities are those of the rest on average, and nothing moves.
//!
//! # Source
//! J. J. Moreau (1988), Unilateral contact and dry friction in finite freedom dynamics; M. Jean, Comput. Methods Appl. Mech.
//! Eng. 177 (1999) 235; V. Acary, ibid. 256 (2013) 224, for the correction of positions.

pub use crate::changes::{Changes, Vectors};
use crate::contact::{Contacts, Each, Gaps, MOST_CONTACTS, has, number, share, those};
use crate::equations::{At, Equations};
use crate::halting::halt;
use crate::locks::{all_stops, locked, placed};
use crate::mechanism::growth_limit;
use crate::modes::{self, close, due, engage, pass};
use crate::pressing::held;
use crate::rubbing::{self, Bounds, Hit, Struck};
use crate::sticking::{Held, Undecided, all_frictions, decide, direction, hold};
pub use crate::touching::begin;
use crate::{Error, Info, Real, vectors};

/// So many impacts follow each other within a step. What closes then is rested on.
const IN_SEQUENCE: usize = 16;
/// A rate is 0 below this share of the terms of which it is made.
const ROUNDING: f64 = 1e-12;

/// Adds half of the impulses of rest over a step of `h` seconds to the velocities at its start, and sets the memories of
/// frictions that break loose. Gives the stops that push and the frictions that stick.
///
/// # Errors
/// [`Error::Impact`], [`Error::Jammed`].
pub fn push<T: Real>(
    equations: &dyn Equations<T>,
    (h, changes): (T, Changes<'_, T>),
    (t, q, v): (T, &[T], &mut [T]),
    inputs: &mut [T],
) -> Result<u32, Error> {
    let (info, held) = (equations.info(), held(equations, inputs));
    if held == 0 {
        return Ok(0);
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
    Contacts::at(equations, (t, q), |contacts| contacts.add(&forces.map(|force| half * force), v));
    let holds = held & (still | locked(info, inputs));
    Ok(those(MOST_CONTACTS, |row| has(holds, row) || number(&forces, row) > 0.0))
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
    (pushed, before): (u32, At<'_, T>),
    (t, [q, v]): (T, [&mut [T]; 2]),
    inputs: &mut [T],
) -> Result<bool, Error> {
    let Changes { still, rows, q: of_q, v: of_v } = changes;
    let own = Changes { still, rows: &mut *rows, q: &mut *of_q, v: &mut *of_v };
    // a stop may throw back what a condition has let pass
    let (found, _) = due(equations, At { t, q, v }, inputs, modes::OFF);
    let is_struck = strike_stops(equations, (h, own), (pushed, before), (t, [&mut *q, &mut *v]), inputs)?;
    let own = Changes { still, rows: &mut *rows, q: &mut *of_q, v: &mut *of_v };
    let has_halted = halt(equations, (h, own), (pushed, before), (t, [&mut *q, &mut *v]), inputs)?;
    let passes = pass(equations, At { t, q, v }, inputs, (found, modes::OFF))? != 0;
    if passes {
        // with the velocities of before the way of a step is known, and with those behind where they lead
        for is_first in [true, false] {
            let own = Changes { still, rows: &mut *rows, q: &mut *of_q, v: &mut *of_v };
            engage(equations, (h, own), (t, q, &mut *v), inputs)?;
            if is_first {
                let own = Changes { still, rows: &mut *rows, q: &mut *of_q, v: &mut *of_v };
                close(equations, own, (t, &mut *q, v), inputs);
            }
        }
        hold(equations, At { t, q, v }, inputs, [of_q, rows]);
    }
    Ok(has_halted || is_struck || passes)
}

/// The same without friction.
fn strike_stops<T: Real>(
    equations: &dyn Equations<T>,
    (h, changes): (T, Changes<'_, T>),
    (pushed, before): (u32, At<'_, T>),
    (t, [q, v]): (T, [&mut [T]; 2]),
    inputs: &mut [T],
) -> Result<bool, Error> {
    let count = equations.info().stops.len();
    let (pushed, locked) = (pushed & all_stops(equations.info()), locked(equations.info(), inputs));
    let now = Gaps::of(equations, At { t, q, v }, changes.still);
    let closed = pushed | those(count, |stop| number(&now.gap, stop) <= 0.0);
    if closed == 0 {
        note(equations, 0, &[T::ZERO; MOST_CONTACTS], inputs);
        return Ok(false);
    }
    let gap_before = Gaps::of(equations, before, changes.still).gap;
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
    let stuck = rubbing::all_rubbing(info) & held(equations, inputs);
    let size = vectors::largest(equations.info().of_bodies(q)).1.to_f64();
    let answered = Contacts::at(equations, (t, q), |contacts| {
        let allowed = core::array::from_fn(|row| modes::allowed::<T>(size, contacts.slope(row)));
        let from = (&contacts, info, locked);
        let striking = Striking::new(from, h, (&ends, &allowed), (&restitutions, &bounds, &slid), pushed);
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
    // a force that presses for a step is no impact
    let noted = if answer.is_impact { answer.impulses } else { [T::ZERO; MOST_CONTACTS] };
    note(equations, answer.held, &noted, inputs);
    let Answer { impulses, directions, .. } = answer;
    let struck = Struck {
        impulses,
        held: answer.held,
        directions,
        rubbed: rubbing::borne(info, closed | answer.held),
    };
    rubbing::note(info, inputs, &struck);
    Ok(true)
}

/// Gaps and their rates at the start and at the end of a step.
struct Ends<T> {
    gap: [Each<T>; 2],
    rate: [Each<T>; 2],
}

/// Stops at the end of a step.
struct Striking<'a, T> {
    contacts: &'a Contacts<'a, T>,
    info: &'a Info,
    /// The number of stops: behind them there may be frictions.
    count: usize,
    /// The constraints of modes, which hold with any impulse.
    locked: u32,
    restitutions: &'a Each<T>,
    /// The bounds of the frictions of stops.
    bounds: &'a Bounds<T>,
    /// The directions in which these slid at the start of the step.
    slid: &'a Each<f64>,
    /// The stops that were rested on there.
    pushed: u32,
    ends: &'a Ends<T>,
    /// The depths by which gaps may be behind their stops where modes lead them.
    allowed: &'a Each<f64>,
    /// ġ − ġ₀
    change: Each<T>,
    /// The rest of the step behind the closing of a gap: 1 − s.
    rest: Each<T>,
    /// The displacement by a unit impulse: (1 − s) h, and 0 where it is the second half of a push.
    shift: Each<T>,
}

/// The answer of stops to a step.
struct Answer<T> {
    /// The stops that are rested on.
    held: u32,
    /// Λ
    impulses: Each<T>,
    /// (1 − s) h Λ
    moved: Each<T>,
    /// The gaps with it.
    gap: Each<T>,
    /// The directions in which what touches stops slides.
    directions: Each<f64>,
    /// True if one has closed faster than forces press.
    is_impact: bool,
}

impl<'a, T: Real> Striking<'a, T> {
    fn new(
        (contacts, info, locked): (&'a Contacts<'a, T>, &'a Info, u32),
        h: T,
        (ends, allowed): (&'a Ends<T>, &'a Each<f64>),
        (restitutions, bounds, slid): (&'a Each<T>, &'a Bounds<T>, &'a Each<f64>),
        pushed: u32,
    ) -> Self {
        let one = T::from_f64(1.0);
        let [before, now] = &ends.gap;
        let rest = zip(before, now, |before, now| {
            let is_open = before.to_f64() > 0.0;
            let part = if is_open && now < before { before / (before - now) } else { T::ZERO };
            if part < one { one - part } else { T::ZERO }
        });
        let mut shift: Each<T> =
            core::array::from_fn(|row| if has(pushed | locked, row) { T::ZERO } else { of(&rest, row) * h });
        for (row, stop) in rubbing::rubbing(info) {
            let of_stop = of(&shift, stop);
            if let Some(to) = shift.get_mut(row) {
                *to = of_stop;
            }
        }
        let [before, now] = &ends.rate;
        let change = zip(now, before, |now, before| now - before);
        let count = info.stops.len();
        Self {
            contacts,
            info,
            count,
            locked,
            restitutions,
            bounds,
            slid,
            pushed,
            ends,
            allowed,
            change,
            rest,
            shift,
        }
    }

    /// The impulses at the stops that are closed, or that impulses close, one impact after the other; nothing where there
    /// are none.
    fn answer(&self, mut closed: u32) -> Option<Answer<T>> {
        let Self { contacts, ends, shift, .. } = self;
        // written so that a NaN is no growth
        let has_growth = contacts.growth() < growth_limit();
        if !has_growth {
            return None;
        }
        let (mut impulses, mut held, mut is_impact) = ([T::ZERO; MOST_CONTACTS], 0, false);
        let (mut directions, rubbing) = ([0.0; MOST_CONTACTS], rubbing::all_rubbing(self.info));
        for turn in 0..=IN_SEQUENCE {
            let moved = zip(&impulses, shift, |impulse, shift| impulse * shift);
            let gap = zip(&ends.gap[1], &contacts.rates(&moved), |gap, change| gap + change);
            let rate = zip(&ends.rate[1], &contacts.rates(&impulses), |rate, change| rate + change);
            closed |= those(self.count, |stop| number(&gap, stop) <= 0.0);
            let still = self.still(&impulses);
            let closing =
                those(MOST_CONTACTS, |stop| has(closed, stop) && number(&rate, stop) <= number(&still, stop));
            let is_hit = |stop: usize| has(closing, stop) && number(&rate, stop) < -number(&still, stop);
            if turn == IN_SEQUENCE || !(0..MOST_CONTACTS).any(is_hit) {
                let held =
                    those(MOST_CONTACTS, |stop| has(closing & held, stop) && number(&impulses, stop) > 0.0);
                return Some(Answer { held, impulses, moved, gap, directions, is_impact });
            }
            let taken = taken(contacts, (closed, self.locked), &self.change)
                .or_else(|| (self.locked != 0).then_some([T::ZERO; MOST_CONTACTS]))?;
            let approach = if turn == 0 { self.approach() } else { rate };
            let thrown = self.rebounds(&approach);
            let is_last = turn + 1 == IN_SEQUENCE;
            held = those(MOST_CONTACTS, |stop| {
                has(closed, stop) && (is_last || number(&thrown, stop) <= number(&taken, stop))
            });
            is_impact = is_impact
                || (0..MOST_CONTACTS)
                    .any(|stop| is_hit(stop) && -number(&approach, stop) > number(&taken, stop));
            let short: Each<T> = core::array::from_fn(|stop| {
                let later = if turn == 0 { of(&self.rest, stop) * of(&self.change, stop) } else { T::ZERO };
                let is_still = has(held | self.locked | rubbing, stop);
                let target = if is_still { T::ZERO } else { of(&thrown, stop) + later };
                of(&rate, stop) - if target.to_f64() > 0.0 { target } else { T::ZERO }
            });
            let bounds = if turn == 0 { self.turned(closing, &rate, &short) } else { *self.bounds };
            let hit = self.hit(closing, &bounds, &rate);
            // what others keep closed throws nothing back
            let unthrown = || {
                let kept = contacts.kept_closed(closing, self.locked);
                core::array::from_fn(|stop| of(if has(kept, stop) { &rate } else { &short }, stop))
            };
            let more = hit
                .answer(contacts, &short)
                .or_else(|| hit.answer(contacts, &unthrown()))
                .or_else(|| self.led_by_modes(closing, &rate))?;
            for (row, direction) in
                directions.iter_mut().enumerate().filter(|(row, _)| has(more.rubbed, *row))
            {
                *direction = number(&more.directions, row);
            }
            impulses = zip(&impulses, &more.impulses, |impulse, more| impulse + more);
        }
        None
    }

    /// The bounds of frictions, of those that turn around within the step, too: with the part of it before.
    fn turned(&self, closing: u32, rate: &Each<T>, short: &Each<T>) -> Bounds<T> {
        let mut bounds = *self.bounds;
        let slid = |row: usize| number(self.slid, row);
        let moves = |(row, stop): &(usize, usize)| has(self.pushed & closing, *stop) && slid(*row) != 0.0;
        if rubbing::rubbing(self.info).any(|it| moves(&it)) {
            let on = Hit { directions: *self.slid, ..self.hit(closing, &bounds, rate) };
            let Some(struck) = on.with(self.contacts, short) else { return bounds };
            let changes = self.contacts.rates(&struck.impulses);
            let after = zip(rate, &changes, |rate, change| rate + change);
            for (row, _) in rubbing::rubbing(self.info).filter(moves) {
                let (from, to) = (of(&self.ends.rate[0], row), of(&after, row));
                if slid(row) * from.to_f64() > 0.0 && slid(row) * to.to_f64() < 0.0 {
                    bounds.turned(row, (slid(row), from / (from - to)));
                }
            }
        }
        bounds
    }

    /// The stops that close, with what rubs on them.
    fn hit<'b>(&'b self, closed: u32, bounds: &'b Bounds<T>, rates: &'b Each<T>) -> Hit<'b, T> {
        let directions = [0.0; MOST_CONTACTS];
        Hit { info: self.info, closed, bound: self.locked, directions, bounds, rates }
    }

    /// The impulses of modes alone, where their constraints and drives lead to what is closed: a stop gives none while it is
    /// behind its gap by no more than a mode may be off.
    fn led_by_modes(&self, closing: u32, rate: &Each<T>) -> Option<Struck<T>> {
        let is_deep = |stop: usize| number(&self.ends.gap[1], stop) < -number(self.allowed, stop);
        let is_led = self.locked != 0 && !(0..self.count).any(|stop| has(closing, stop) && is_deep(stop));
        let impulses = is_led.then(|| self.contacts.solve(self.locked, rate))?;
        Some(Struck { impulses, held: self.locked, rubbed: 0, directions: [0.0; MOST_CONTACTS] })
    }

    /// The rates with which gaps close, ġ_s.
    fn approach(&self) -> Each<T> {
        let behind = zip(&self.rest, &self.change, |rest, change| rest * change);
        zip(&self.ends.rate[1], &behind, |rate, behind| rate - behind)
    }

    /// The rates −e ġ with which gaps open again.
    fn rebounds(&self, rates: &Each<T>) -> Each<T> {
        rebounds(self.restitutions, rates)
    }

    /// The rates below which gaps do not move.
    fn still(&self, impulses: &Each<T>) -> Each<f64> {
        let [before, now] = &self.ends.rate;
        core::array::from_fn(|of| {
            let mut size = number(before, of).abs() + number(now, of).abs();
            for by in 0..self.contacts.stops() {
                size += (self.contacts.mobility(of, by).to_f64() * number(impulses, by)).abs();
            }
            share::<T>(ROUNDING) * size
        })
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

fn of<T: Real>(each: &Each<T>, stop: usize) -> T {
    each.get(stop).copied().unwrap_or_default()
}

fn zip<T: Real>(x: &Each<T>, y: &Each<T>, what: impl Fn(T, T) -> T) -> Each<T> {
    core::array::from_fn(|stop| what(of(x, stop), of(y, stop)))
}
