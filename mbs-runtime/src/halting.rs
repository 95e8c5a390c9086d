//! Friction that sticks, at the ends of constant steps.
//!
//! In a step friction that slides acts with the force −L d in its direction d. Where its speed has changed its sign at the
//! end of a step, after the part s, the rest of the step is made good by an impulse Λ: the one that halts it, if with it the
//! force in the rest is at most L₀; else the one of a force L that brakes the way back.
//!
//! ```text
//! W Λ + ṡ = 0,  |Λ| ≤ (1 − s) h (L + L₀),   or   |Λ| = 2 (1 − s) h L
//! ```
//!
//! Impulses that halt act over the rest of the step, so that they move positions by ½ (1 − s) h Y Λ. Friction that sticks
//! acts by halves of its impulse before and behind a step, as stops do that are rested on; both are at most h L₀. See
//! [`moreau`](crate::moreau).

use crate::contact::{Contacts, Each, Gaps, MOST_CONTACTS, bit, has, number};
use crate::equations::{At, Equations};
use crate::mechanism::growth_limit;
use crate::moreau::Changes;
use crate::pressing::{held, pressed};
use crate::sticking::{Limits, all_frictions, direction, frictions, hold, holding, set, unanswered};
use crate::{Error, Real, vectors};

/// A force is within its limit up to rounding by this share.
const ROUNDING: f64 = 1e-12;

/// Frictions at the end of a step.
struct Halting<T> {
    /// Those whose speeds are led to 0.
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
    let friction = all_frictions(info);
    if friction == 0 {
        return Ok(false);
    }
    let rates = Gaps::of(equations, At { t, q, v }, changes.still).rate;
    let is_crossed = |row: usize| direction(info, inputs, row) * number(&rates, row) < 0.0;
    let crossed = frictions(info).filter(|(row, _)| is_crossed(*row));
    let crossed = crossed.fold(0, |set, (row, _)| set | bit(row));
    let has_acted = (pushed & friction) | crossed != 0;
    if has_acted {
        let resting = held(equations, inputs) & !friction;
        let at = At { t, q, v };
        equations.free_reactions(at, inputs, changes.q, changes.rows);
        pressed(equations, at, inputs, changes.q, Some(&mut *changes.rows));
        let limits = Limits::of(equations, at, inputs, [changes.q, changes.rows]);
        let was = Gaps::of(equations, before, changes.still).rate;
        // sliding may come to a halt by the impulses of those that stick
        let (stuck, mut all, mut ends) = (pushed & friction, pushed & friction, rates);
        let memory = |row: usize| (direction(info, inputs, row), holding(info, inputs, row));
        vectors::fill(changes.q, T::ZERO);
        vectors::fill(changes.v, T::ZERO);
        let (changes_of_q, changes_of_v) = (&mut *changes.q, &mut *changes.v);
        let answered = Contacts::at(equations, (t, q), |contacts| {
            loop {
                let mut halting = Halting::new((h, stuck, all & !stuck), [&was, &ends], &limits, memory);
                let impulses = halting.answer(&contacts, resting, &rates)?;
                let changes = contacts.rates(&impulses);
                let rate = |row: usize| of(&rates, row) + of(&changes, row);
                let is_late = |row: usize| !has(all, row) && memory(row).0 * rate(row).to_f64() < 0.0;
                let late = frictions(info).filter(|(row, _)| is_late(*row));
                let late = late.fold(0, |set, (row, _)| set | bit(row));
                if late == 0 {
                    contacts.add(&impulses, changes_of_v);
                    let moved = core::array::from_fn(|row| of(&impulses, row) * of(&halting.shift, row));
                    contacts.add(&moved, changes_of_q);
                    return Some(halting.directions);
                }
                for (row, end) in ends.iter_mut().enumerate().filter(|(row, _)| has(late, *row)) {
                    *end = rate(row);
                }
                all |= late;
            }
        });
        let directions =
            answered.flatten().ok_or_else(|| unanswered(info, t.to_f64(), pushed & friction | crossed))?;
        vectors::zip_map(q, changes.q, |q, change| q + change);
        vectors::zip_map(v, changes.v, |v, change| v + change);
        for (row, _) in frictions(info).filter(|(row, _)| has(all, *row)) {
            let turned = directions.get(row).copied().unwrap_or(0.0);
            set(info, inputs, row, (turned, T::ZERO));
        }
    }
    hold(equations, At { t, q, v }, inputs, [changes.q, changes.rows]);
    Ok(has_acted)
}

impl<T: Real> Halting<T> {
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
        let mut it = Self { halted, directions, given: none, most: none, loose: none, shift: none };
        for row in (0..MOST_CONTACTS).filter(|row| has(stuck | crossed, *row)) {
            let (sliding, sticking) = (limits.sliding(row), limits.sticking(row));
            let (direction, held) = memory(row);
            let [given, most, loose, shift] = if has(crossed, row) {
                let (from, to) = (of(was, row), of(rates, row));
                let has_come = direction * from.to_f64() > 0.0;
                let rest = if has_come { one - from / (from - to) } else { one };
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

    /// The impulses of frictions and at stops that are rested on; the worst one that needs more than it can have slides on.
    /// Nothing in a singular position.
    fn answer(&mut self, contacts: &Contacts<'_, T>, resting: u32, rates: &Each<T>) -> Option<Each<T>> {
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
            let beyond = |row: usize| {
                let (impulse, most) = (number(&total, row).abs(), number(&self.most, row));
                match most > 0.0 {
                    true if impulse > (1.0 + ROUNDING) * most => impulse / most,
                    true => 0.0,
                    false => f64::INFINITY,
                }
            };
            let loose = (0..MOST_CONTACTS).filter(|row| has(self.halted, *row) && beyond(*row) > 0.0);
            let worst = loose.reduce(|worst, row| if beyond(row) > beyond(worst) { row } else { worst });
            let Some(row) = worst else {
                return Some(core::array::from_fn(|row| of(&x, row) + of(&fixed, row)));
            };
            let is_forwards = number(&total, row) > 0.0;
            let (loose, given) = (of(&self.loose, row), of(&self.given, row));
            if let (Some(fixed), Some(direction)) = (fixed.get_mut(row), self.directions.get_mut(row)) {
                *fixed = if is_forwards { loose } else { -loose } - given;
                *direction = if is_forwards { -1.0 } else { 1.0 };
            }
            self.halted &= !bit(row);
        }
    }
}

fn of<T: Real>(each: &Each<T>, row: usize) -> T {
    each.get(row).copied().unwrap_or_default()
}
