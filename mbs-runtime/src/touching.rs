//! The start of a run with constant steps: what it rests on, what sticks, and what holds.

use crate::changes::Changes;
use crate::contact::{Contacts, Each, Gaps, MOST_CONTACTS, has, number, those};
use crate::equations::{At, Equations};
use crate::locks::locked;
use crate::modes::{self, are_met, look};
use crate::moreau::{impact, note, rebounds, restitutions, taken};
use crate::sticking::{Held, Undecided, all_frictions, decide, frictions, set};
use crate::{Error, Real, vectors};

/// A start is behind a stop by more than this share of the size of the coordinates.
const BEHIND: f64 = 1e-9;
/// The least size in m or rad: at the origin nothing else tells what is rounding.
pub(crate) const LEAST_SIZE: f64 = 1e-3;
/// Friction does not slide at a start below this share of the largest speed that the kinetic energy lets it have.
const STILL: f64 = 1e-9;

/// Sets the memories of the stops that a start rests on, and of the frictions that stick there.
///
/// # Errors
/// [`Error::Behind`], [`Error::Impact`], [`Error::Jammed`].
pub fn begin<T: Real>(
    equations: &dyn Equations<T>,
    (h, changes): (T, Changes<'_, T>),
    at: At<'_, T>,
    inputs: &mut [T],
) -> Result<(), Error> {
    let info = equations.info();
    let count = info.stops.len();
    look(equations, at, inputs, [&mut *changes.q, &mut *changes.rows]);
    let locked = locked(info, inputs);
    let still = slide(equations, at, changes.still, inputs);
    equations.free_reactions(at, inputs, &mut *changes.q, &mut *changes.rows);
    let gaps = Gaps::of(equations, at, changes.q);
    let size = BEHIND * (LEAST_SIZE + vectors::largest(info.of_bodies(at.q)).1.to_f64());
    let thrown = rebounds(&restitutions(equations), &gaps.rate);
    let settled = Contacts::at(equations, (at.t, at.q), |contacts| {
        let allowed = |stop: usize| size * contacts.slope(stop);
        if let Some(stop) = (0..count).find(|&stop| number(&gaps.gap, stop) < -allowed(stop)) {
            return Err(info.behind(at.t.to_f64(), stop, number(&gaps.gap, stop)));
        }
        let closed = those(count, |stop| number(&gaps.gap, stop) <= allowed(stop));
        let met = |row: usize| modes::allowed::<T>(size / BEHIND, contacts.slope(row));
        are_met(info, at.t.to_f64(), locked, |row| number(&gaps.gap, row), met)?;
        let taken =
            taken(&contacts, (closed, locked), &gaps.acceleration.map(|acceleration| h * acceleration));
        let taken = taken.ok_or_else(|| impact(equations, at.t, closed))?;
        Ok(those(count, |stop| {
            let taken = number(&taken, stop);
            has(closed, stop) && number(&gaps.rate, stop) <= taken && number(&thrown, stop) <= taken
        }))
    });
    let undecided = Undecided { resting: settled.transpose()?.unwrap_or(0), still, breaking: 0 };
    let Held { forces, .. } =
        decide(equations, at, inputs, undecided, [&mut *changes.q, &mut *changes.rows])?;
    let held = those(count, |stop| number(&forces, stop) > 0.0);
    note(equations, held, &[T::ZERO; MOST_CONTACTS], inputs);
    Ok(())
}

/// Sets the directions of the frictions that move; those that do not.
pub(crate) fn slide<T: Real>(
    equations: &dyn Equations<T>,
    at: At<'_, T>,
    still: &[T],
    inputs: &mut [T],
) -> u32 {
    let info = equations.info();
    let rates = Gaps::of(equations, at, still).rate;
    let energy = equations.kinetic_energy(at).to_f64().max(0.0);
    let own = Contacts::at(equations, (at.t, at.q), |contacts| {
        core::array::from_fn(|row| contacts.mobility(row, row).to_f64().max(0.0))
    });
    let own: Each<f64> = own.unwrap_or([0.0; MOST_CONTACTS]);
    let is_still = |row: usize| {
        let fastest = Real::sqrt(2.0 * energy * own.get(row).copied().unwrap_or(0.0));
        number(&rates, row).abs() <= STILL * fastest
    };
    for (row, _) in frictions(info).filter(|(row, _)| !is_still(*row)) {
        let direction = if number(&rates, row) > 0.0 { 1.0 } else { -1.0 };
        set(info, inputs, row, (direction, T::ZERO));
    }
    those(MOST_CONTACTS, |row| has(all_frictions(info), row) && is_still(row))
}
