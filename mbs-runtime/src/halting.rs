//! Friction that sticks, at the ends of constant steps.
//!
//! In a step friction that slides acts with the force −L d in its direction d. Where its speed has changed its sign at the
//! end of a step, after the part s, the rest of the step is made good by an impulse Λ: the one that halts it, if with it the
//! force in the rest is at most L₀; else the one of a force L that brakes the way back. Where the speed is 0 at the
//! end, a stop or another friction has halted it, and s is 0.
//!
//! ```text
//! W Λ + ṡ = 0,  |Λ| ≤ (1 − s) h (L + L₀),   or   |Λ| = 2 (1 − s) h L
//! ```
//!
//! Impulses that halt act over the rest of the step, so that they move positions by ½ (1 − s) h Y Λ. Friction that sticks
//! acts by halves of its impulse before and behind a step, as stops do that are rested on; both are at most h L₀. What has
//! stuck in a whole step is where it was before: positions are led back to it the shortest way by masses. See
//! [`moreau`](crate::moreau).

use crate::changes::Changes;
use crate::contact::{Contacts, Each, Gaps, MOST_CONTACTS, bit, has, number, share};
use crate::equations::{At, Equations};
use crate::locks::{locked, placed};
use crate::mechanism::growth_limit;
use crate::pressing::{held, pressed};
use crate::sticking::{Limits, direction, free_frictions, frictions, hold, holding, loose, set, unanswered};
use crate::{Error, Info, Real, rubbing, vectors};

/// A speed is 0 below this share of that at the start of a step.
const ROUNDING: f64 = 1e-12;

/// Frictions at the end of a step.
struct Halting<T> {
    /// Those that stuck in the step or have crossed in it.
    all: u32,
    /// Those of them whose speeds are led to 0.
    halted: u32,
    /// The directions in which they slide from then on.
    directions: Each<f64>,
    /// The impulses before the step, of those that stuck in it.
    given: Each<T>,
    /// The largest impulses that halt, and those of what is not halted by them, both with what was given.
    most: Each<T>,
    loose: Each<T>,
    /// By how much an impulse moves positions: half of the rest of the step.
    shift: Each<T>,
}

/// Answers friction at the end of a step of `h` seconds, behind what stops did. `pushed` are those that stuck in it. True if
/// anything has changed.
///
/// # Errors
/// [`Error::Jammed`].
pub(crate) fn halt<T: Real>(
    equations: &dyn Equations<T>,
    (h, changes): (T, Changes<'_, T>),
    (pushed, before): (u32, At<'_, T>),
    (t, [q, v]): (T, [&mut [T]; 2]),
    inputs: &mut [T],
) -> Result<bool, Error> {
    let info = equations.info();
    let (friction, locked) = (free_frictions(info), locked(info, inputs));
    if friction | locked == 0 {
        if info.holds() {
            hold(equations, At { t, q, v }, inputs, [changes.q, changes.rows]);
        }
        return Ok(false);
    }
    let now = Gaps::of(equations, At { t, q, v }, changes.still);
    let was = Gaps::of(equations, before, changes.still);
    let rates = now.rate;
    let memory = |row: usize| (direction(info, inputs, row), holding(info, inputs, row));
    let crossed = crossing(info, [&was.rate, &rates], memory);
    let has_acted = (pushed & friction) | crossed | locked != 0;
    if has_acted {
        let placed = placed(info, locked);
        // stops that are rested on, and constraints of modes, hold meanwhile
        let resting = held(equations, inputs) & !friction;
        let at = At { t, q, v };
        equations.free_reactions(at, inputs, changes.q, changes.rows);
        let (_, forces) = pressed(equations, at, inputs, changes.q, Some(&mut *changes.rows));
        let limits = Limits::of(equations, at, inputs, ([changes.q, changes.rows], &forces));
        let slides = rubbing::sliding(equations, inputs);
        vectors::fill(changes.q, T::ZERO);
        vectors::fill(changes.v, T::ZERO);
        let answered = Contacts::at(equations, (t, q), |contacts| {
            let contacts = contacts.sliding(slides);
            let sets = [pushed & friction, resting];
            let (halting, impulses) =
                Halting::answered(info, &contacts, (h, sets), [&was.rate, &rates], (&limits, memory))?;
            let moved = core::array::from_fn(|row| of(&impulses, row) * of(&halting.shift, row));
            let back =
                halting.back(&contacts, (sets, [placed, locked & !placed]), [&was.gap, &now.gap], &moved);
            contacts.add(&impulses, changes.v);
            contacts.add(&moved, changes.q);
            contacts.add(&back, changes.q);
            Some(halting)
        });
        let halting = answered
            .flatten()
            .ok_or_else(|| unanswered(info, t.to_f64(), pushed & friction | crossed | locked))?;
        vectors::zip_map(q, changes.q, |q, change| q + change);
        vectors::zip_map(v, changes.v, |v, change| v + change);
        for (row, _) in frictions(info).filter(|(row, _)| has(halting.all, *row)) {
            let turned = halting.directions.get(row).copied().unwrap_or(0.0);
            set(info, inputs, row, (turned, T::ZERO));
        }
    }
    hold(equations, At { t, q, v }, inputs, [changes.q, changes.rows]);
    Ok(has_acted)
}

/// The frictions that slid and have come to a halt, or go against the directions in which they slid.
fn crossing<T: Real>(info: &Info, [was, rates]: [&Each<T>; 2], memory: impl Fn(usize) -> (f64, T)) -> u32 {
    let free = frictions(info).filter(|(row, _)| has(free_frictions(info), *row));
    let crossed = free.filter(|(row, _)| {
        let (direction, _) = memory(*row);
        let [from, to] = [was, rates].map(|rates| direction * number(rates, *row));
        to < 0.0 || from > 0.0 && to <= share::<T>(ROUNDING) * from
    });
    crossed.fold(0, |set, (row, _)| set | bit(row))
}

impl<T: Real> Halting<T> {
    /// With the impulses: those that stuck and stops that are rested on, and what they lead to a halt beside what halts by
    /// itself. Nothing in a singular position.
    fn answered(
        info: &Info,
        contacts: &Contacts<'_, T>,
        (h, [stuck, resting]): (T, [u32; 2]),
        [was, rates]: [&Each<T>; 2],
        (limits, memory): (&Limits<T>, impl Fn(usize) -> (f64, T) + Copy),
    ) -> Option<(Self, Each<T>)> {
        let (mut crossed, mut ends) = (0, *rates);
        loop {
            let mut halting = Self::new((h, stuck, crossed), [was, &ends], limits, memory);
            let impulses = halting.impulses(contacts, resting, rates)?;
            let changes = contacts.rates(&impulses);
            let after = core::array::from_fn(|row| of(rates, row) + of(&changes, row));
            let late = crossing(info, [was, &after], memory) & !halting.all;
            if late == 0 {
                return Some((halting, impulses));
            }
            for (row, end) in ends.iter_mut().enumerate().filter(|(row, _)| has(late, *row)) {
                *end = of(&after, row);
            }
            crossed |= late;
        }
    }

    fn new(
        (h, stuck, crossed): (T, u32, u32),
        [was, rates]: [&Each<T>; 2],
        limits: &Limits<T>,
        memory: impl Fn(usize) -> (f64, T),
    ) -> Self {
        let (one, half) = (T::from_f64(1.0), T::from_f64(0.5));
        let none = [T::ZERO; MOST_CONTACTS];
        let directions = [0.0; MOST_CONTACTS];
        let halted = stuck | crossed;
        let mut it =
            Self { all: halted, halted, directions, given: none, most: none, loose: none, shift: none };
        for row in (0..MOST_CONTACTS).filter(|row| has(stuck | crossed, *row)) {
            let (sliding, sticking) = (limits.sliding(row), limits.sticking(row));
            let (direction, held) = memory(row);
            let [given, most, loose, shift] = if has(crossed, row) {
                let (from, to) = (of(was, row), of(rates, row));
                let has_turned = direction * from.to_f64() > 0.0 && direction * to.to_f64() < 0.0;
                let rest = if has_turned { one - from / (from - to) } else { one };
                let rest = rest * h;
                [T::ZERO, rest * (sliding + sticking), rest * (sliding + sliding), half * rest]
            } else {
                [half * h * held, h * sticking, h * sliding, T::ZERO]
            };
            let values = [
                (&mut it.given, given),
                (&mut it.most, most),
                (&mut it.loose, loose),
                (&mut it.shift, shift),
            ];
            for (to, value) in values {
                if let Some(to) = to.get_mut(row) {
                    *to = value;
                }
            }
        }
        it
    }

    /// The impulses of positions that lead back what stuck in the whole step, and lead to the constraints of modes. Stops that
    /// are rested on stay closed.
    fn back(
        &self,
        contacts: &Contacts<'_, T>,
        ([stuck, resting], [locked, rates]): ([u32; 2], [u32; 2]),
        [was, now]: [&Each<T>; 2],
        moved: &Each<T>,
    ) -> Each<T> {
        let held = self.halted & stuck;
        if held | locked | rates == 0 {
            return [T::ZERO; MOST_CONTACTS];
        }
        let changes = contacts.rates(moved);
        let slipped = core::array::from_fn(|row| {
            let slipped = match has(locked, row) {
                true => of(now, row),
                false if has(held, row) => of(now, row) - of(was, row),
                false => T::ZERO,
            };
            slipped + of(&changes, row)
        });
        contacts.solve(held | resting & !rates, &slipped)
    }

    /// The impulses of frictions and at stops that are rested on; the worst one that needs more than it can have slides on.
    /// Nothing in a singular position.
    fn impulses(&mut self, contacts: &Contacts<'_, T>, resting: u32, rates: &Each<T>) -> Option<Each<T>> {
        // written so that a NaN is no growth
        let has_growth = contacts.growth() < growth_limit();
        if !has_growth {
            return None;
        }
        let mut fixed = [T::ZERO; MOST_CONTACTS];
        loop {
            let changes = contacts.rates(&fixed);
            let b = core::array::from_fn(|row| of(rates, row) + of(&changes, row));
            let x = contacts.solve(self.halted | resting, &b);
            let total: Each<T> = core::array::from_fn(|row| of(&x, row) + of(&self.given, row));
            let worst = loose(self.halted, &total, |row| number(&self.most, row));
            let Some(row) = worst else {
                return Some(core::array::from_fn(|row| of(&x, row) + of(&fixed, row)));
            };
            let is_forwards = number(&total, row) > 0.0;
            let (most, given) = (of(&self.loose, row), of(&self.given, row));
            if let (Some(fixed), Some(direction)) = (fixed.get_mut(row), self.directions.get_mut(row)) {
                *fixed = if is_forwards { most } else { -most } - given;
                *direction = if is_forwards { -1.0 } else { 1.0 };
            }
            self.halted &= !bit(row);
        }
    }
}

fn of<T: Real>(each: &Each<T>, row: usize) -> T {
    each.get(row).copied().unwrap_or_default()
}
