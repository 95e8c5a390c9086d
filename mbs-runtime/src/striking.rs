//! The impulses that answer stops at the end of a constant step, one impact after the other.

use crate::contact::{Contacts, Each, MOST_CONTACTS, has, number, share, those};
use crate::mechanism::growth_limit;
use crate::moreau::{rebounds, taken};
use crate::rubbing::{self, Bounds, Hit, Struck};
use crate::{Info, Real, modes};

/// At most so many impacts follow each other within a step. The last one takes all closed stops, without restitution. Stops
/// contradict each other where it has no answer.
const IN_SEQUENCE: usize = 16;
/// A rate is 0 below this share of the terms of which it is made.
const ROUNDING: f64 = 1e-12;
/// Gaps, and their rates, are 0 below this share of the size of the coordinates, and of the largest velocity.
const NOTHING: f64 = 1e-14;

/// Gaps and their rates at the start and at the end of a step.
pub(crate) struct Ends<T> {
    pub gap: [Each<T>; 2],
    pub rate: [Each<T>; 2],
}

/// Limits of gaps and of their rates, by their rows.
pub(crate) struct Sizes {
    /// The depths by which gaps may be behind their stops where modes lead them.
    pub allowed: Each<f64>,
    /// The gaps up to which stops are closed, and the rates that are rounding of the velocities.
    pub nearest: Each<f64>,
    pub slowest: Each<f64>,
}

impl Sizes {
    /// Those of a mechanism of a size, with its largest velocity.
    pub fn of<T: Real>(contacts: &Contacts<'_, T>, size: f64, speed: f64) -> Self {
        let slopes: Each<f64> = core::array::from_fn(|row| contacts.slope(row));
        let share = share::<T>(NOTHING);
        Self {
            allowed: slopes.map(|slope| modes::allowed::<T>(size, slope)),
            nearest: slopes.map(|slope| share * size * slope),
            slowest: slopes.map(|slope| share * speed * slope),
        }
    }
}

/// Stops at the end of a step.
pub(crate) struct Striking<'a, T> {
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
    /// The stops that were rested on there, those of them that pushed, and half of the impulses of all rests.
    rested: u32,
    pushed: u32,
    halves: &'a Each<T>,
    ends: &'a Ends<T>,
    sizes: &'a Sizes,
    /// ġ − ġ₀
    change: Each<T>,
    /// h g̈ without the forces of stops. The motion of the stops and the curvature of their gaps are in it.
    pressing: &'a Each<T>,
    /// The rest of the step behind the closing of a gap: 1 − s.
    rest: Each<T>,
    /// The displacement by a unit impulse: (1 − s) h, and 0 where it is the second half of a push.
    shift: Each<T>,
}

/// The answer of stops to a step.
pub(crate) struct Answer<T> {
    /// The stops that are rested on.
    pub held: u32,
    /// Λ
    pub impulses: Each<T>,
    /// (1 − s) h Λ
    pub moved: Each<T>,
    /// The gaps with it.
    pub gap: Each<T>,
    /// The directions in which what touches stops slides.
    pub directions: Each<f64>,
    /// True if one has closed faster than forces press.
    pub is_impact: bool,
}

impl<'a, T: Real> Striking<'a, T> {
    pub fn new(
        (contacts, info, locked): (&'a Contacts<'a, T>, &'a Info, u32),
        h: T,
        (ends, pressing, sizes): (&'a Ends<T>, &'a Each<T>, &'a Sizes),
        (restitutions, bounds, slid): (&'a Each<T>, &'a Bounds<T>, &'a Each<f64>),
        (rested, pushed, halves): (u32, u32, &'a Each<T>),
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
            rested,
            pushed,
            halves,
            ends,
            sizes,
            change,
            pressing,
            rest,
            shift,
        }
    }

    /// The impulses at the stops that are closed, or that impulses close, one impact after the other; nothing where there
    /// are none. Those that were rested on at the start of the step have a part in the first one, whatever their rates are
    /// without the second half of the rest.
    pub fn answer(&self, mut closed: u32) -> Option<Answer<T>> {
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
            closed |= those(self.count, |stop| number(&gap, stop) <= number(&self.sizes.nearest, stop));
            let still = self.still(&impulses);
            let is_last = turn + 1 == IN_SEQUENCE;
            let closing = those(MOST_CONTACTS, |stop| {
                let takes_part = is_last || turn == 0 && has(self.rested, stop);
                has(closed, stop) && (takes_part || number(&rate, stop) <= number(&still, stop))
            });
            let is_hit = |stop: usize| has(closing, stop) && number(&rate, stop) < -number(&still, stop);
            if turn == IN_SEQUENCE || !(0..MOST_CONTACTS).any(is_hit) {
                let held =
                    those(MOST_CONTACTS, |stop| has(closing & held, stop) && number(&impulses, stop) > 0.0);
                let directions = self.moving(&directions, &rate, &impulses);
                return Some(Answer { held, impulses, moved, gap, directions, is_impact });
            }
            let taken = self.taken_back(closed)?;
            let approach = if turn == 0 { self.approach() } else { rate };
            let thrown = self.rebounds(&approach);
            let least = |stop: usize| number(&taken, stop) + number(&still, stop);
            let rests = |stop: usize| is_last || number(&thrown, stop) <= least(stop);
            held = those(MOST_CONTACTS, |stop| has(closed, stop) && rests(stop));
            let is_fast = |stop: usize| is_hit(stop) && -number(&approach, stop) > least(stop);
            is_impact = is_impact || (0..MOST_CONTACTS).any(is_fast);
            let short: Each<T> = core::array::from_fn(|stop| {
                let later = if turn == 0 { of(&self.rest, stop) * of(&self.change, stop) } else { T::ZERO };
                let is_still = has(held | self.locked | rubbing, stop);
                let target = if is_still { T::ZERO } else { of(&thrown, stop) + later };
                of(&rate, stop) - if target.to_f64() > 0.0 { target } else { T::ZERO }
            });
            // an impact takes no time: friction that it turns around has no part of the step
            let turns = turn == 0 && !is_impact;
            let bounds = if turns { self.turned(closing, &rate, &short) } else { *self.bounds };
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

    /// The directions of what moves by more than the rounding of impulses, √W Σ √W Λ: what does not is open to stick.
    fn moving(&self, directions: &Each<f64>, rate: &Each<T>, impulses: &Each<T>) -> Each<f64> {
        let of_row = |row: usize| Real::sqrt(self.contacts.mobility(row, row).to_f64().max(0.0));
        let sizes = (0..self.contacts.stops()).map(|row| of_row(row) * number(impulses, row).abs());
        let size = sizes.sum::<f64>();
        let moves = |row: usize| number(rate, row).abs() > share::<T>(ROUNDING) * of_row(row) * size;
        core::array::from_fn(|row| if moves(row) { number(directions, row) } else { 0.0 })
    }

    /// The bounds of frictions. Those that turn around within the step have bounds by the part of the step before the turn.
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
        let is_deep = |stop: usize| number(&self.ends.gap[1], stop) < -number(&self.sizes.allowed, stop);
        let is_led = self.locked != 0 && !(0..self.count).any(|stop| has(closing, stop) && is_deep(stop));
        let impulses = is_led.then(|| self.contacts.solve(self.locked, rate))?;
        Some(Struck { impulses, held: self.locked, rubbed: 0, directions: [0.0; MOST_CONTACTS] })
    }

    /// The rates with which gaps close: ġ_s, and at a stop that was rested on the rate that the second half of the rest leaves.
    fn approach(&self) -> Each<T> {
        let second = self.contacts.rates(self.halves);
        core::array::from_fn(|row| match has(self.pushed, row) {
            true => of(&self.ends.rate[1], row) + of(&second, row),
            false => of(&self.ends.rate[1], row) - of(&self.rest, row) * of(&self.change, row),
        })
    }

    /// The changes of rates that forces at the stops make in a step. Since one stop may bear the load of several, they are as
    /// large as the change without any such force at least.
    fn taken_back(&self, closed: u32) -> Option<Each<T>> {
        let set = (closed, self.locked);
        let by_forces = taken(self.contacts, set, self.pressing)
            .or_else(|| taken(self.contacts, set, &self.change))
            .or_else(|| (self.locked != 0).then_some([T::ZERO; MOST_CONTACTS]))?;
        Some(core::array::from_fn(|stop| {
            let (by_forces, alone) = (of(&by_forces, stop), -of(self.pressing, stop));
            if alone > by_forces { alone } else { by_forces }
        }))
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
            number(&self.sizes.slowest, of) + share::<T>(ROUNDING) * size
        })
    }
}

pub(crate) fn of<T: Real>(each: &Each<T>, stop: usize) -> T {
    each.get(stop).copied().unwrap_or_default()
}

pub(crate) fn zip<T: Real>(x: &Each<T>, y: &Each<T>, what: impl Fn(T, T) -> T) -> Each<T> {
    core::array::from_fn(|stop| what(of(x, stop), of(y, stop)))
}
