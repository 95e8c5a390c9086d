//! The forces at stops that are rested on, and of frictions that stick.

use crate::contact::{Contacts, DEPENDENT, Each, Gaps, MOST_CONTACTS, bit, share, those};
use crate::equations::{At, Equations};
use crate::locks::locked;
use crate::sticking::frictions;
use crate::{Real, rubbing};

/// The stops that are rested on, the frictions that stick, and the constraints of the modes that hold.
pub(crate) fn held<T: Real>(equations: &dyn Equations<T>, inputs: &[T]) -> u32 {
    let info = equations.info();
    let memory = |stop: usize| inputs.get(info.stops.get(stop)?.memory).map(|held| held.to_f64());
    let resting = those(info.stops.len(), |stop| memory(stop).is_some_and(|held| held > 0.5));
    let is_sticking = |memory: usize| inputs.get(memory).is_some_and(|it| it.to_f64().abs() < 0.5);
    let sticking = frictions(info).filter(|(_, memory)| is_sticking(*memory));
    let off = rubbing::all_rubbing(info) & !rubbing::borne(info, resting);
    sticking.fold(resting | locked(info, inputs), |held, (row, _)| held | bit(row) & !off)
}

/// Adds to accelerations what the stops do that are rested on, and to multipliers, if they are given; the pivot growth
/// of the responses.
pub fn press<T: Real>(
    equations: &dyn Equations<T>,
    at: At<'_, T>,
    inputs: &[T],
    acceleration: &mut [T],
    multipliers: Option<&mut [T]>,
) -> T {
    pressed(equations, at, inputs, acceleration, multipliers).0
}

/// The same with the forces λ at the stops.
pub(crate) fn pressed<T: Real>(
    equations: &dyn Equations<T>,
    at: At<'_, T>,
    inputs: &[T],
    acceleration: &mut [T],
    multipliers: Option<&mut [T]>,
) -> (T, Each<T>) {
    let none = (T::default(), [T::default(); MOST_CONTACTS]);
    let held = held(equations, inputs);
    if held == 0 {
        return none;
    }
    let gaps = Gaps::of(equations, at, acceleration);
    let found = Contacts::at(equations, (at.t, at.q), |contacts| {
        let contacts = contacts.sliding(rubbing::sliding(equations, inputs));
        let forces = contacts.solve(held, &gaps.acceleration);
        contacts.add(&forces, acceleration);
        if let Some(multipliers) = multipliers {
            contacts.react(&forces, multipliers);
        }
        (contacts.growth(), forces)
    });
    found.unwrap_or(none)
}

/// Adds to velocities, accelerations or positions the responses to x with W x + b = 0 at some stops, and writes x. Gives the
/// pivot growth of the responses.
pub fn lean<T: Real>(
    equations: &dyn Equations<T>,
    at: (T, &[T]),
    stops: &[usize],
    b: &[T],
    (to, x): (&mut [T], &mut [T]),
) -> T {
    let (mut set, mut all) = (0, [T::default(); MOST_CONTACTS]);
    for (stop, b) in stops.iter().zip(b) {
        set |= bit(*stop);
        if let Some(to) = all.get_mut(*stop) {
            *to = *b;
        }
    }
    let growth = Contacts::at(equations, at, |contacts| {
        let solution = contacts.solve(set, &all);
        contacts.add(&solution, to);
        for (x, stop) in x.iter_mut().zip(stops) {
            *x = solution.get(*stop).copied().unwrap_or_default();
        }
        contacts.growth()
    });
    growth.unwrap_or_default()
}

/// True if no stop of some depends on the others and on the constraints at a position.
pub fn are_independent<T: Real>(equations: &dyn Equations<T>, at: (T, &[T]), stops: &[usize]) -> bool {
    let is_independent = |count: usize| {
        let (set, last) = (stops.get(..count)?, *stops.get(count)?);
        Contacts::at(equations, at, |contacts| {
            let column = core::array::from_fn(|of| {
                if of < contacts.stops() { -contacts.mobility(of, last) } else { T::default() }
            });
            let set = set.iter().fold(0, |set, stop| set | bit(*stop));
            let shares = contacts.solve(set, &column);
            // what is left of W without the others
            let own = contacts.mobility(last, last).to_f64();
            let left = own - contacts.rates(&shares).get(last).map_or(0.0, |rate| rate.to_f64());
            left > share::<T>(DEPENDENT) * own
        })
    };
    (0..stops.len()).all(|count| is_independent(count).unwrap_or(false))
}
