//! Dry friction that sticks: which of it does, and with which forces.
//!
//! Friction of size L that has slid by s, with a force along ∂s/∂q, is in one of three modes: it slides forwards with the
//! force −L, backwards with L, or it sticks, ṡ = 0, with a force of at most L₀ ≥ L (Coulomb's law). A memory of the run has
//! the direction. Where ṡ is 0, forces decide:
//!
//! ```text
//! s̈ = 0 and |λ| ≤ L₀,   or   λ = −L sign(s̈)
//! ```
//!
//! All that do not move stick at first. The one that is farthest beyond its L₀ slides, until the others hold. One that would
//! then move against its direction sticks after all. One that has no hold, as on a slider at its dead centre, goes on in the
//! direction of s̈. With the forces at stops that are rested on this is one problem of few rows.

use crate::contact::{Contacts, Each, Gaps, MOST_CONTACTS, bit, has, number, share, those};
use crate::equations::{At, Equations};
use crate::locks::{locked, note_forces};
use crate::pressing::{held, pressed};
use crate::rubbing::{Bounds, Hit, Struck};
use crate::{Error, Info, Real, rubbing, vectors};

/// Friction breaks loose within this share of its largest force, where a run has found that it does.
const BREAKS: f64 = 1e-6;
/// A force is within its limit up to rounding by this share.
const ROUNDING: f64 = 1e-12;
/// Friction that leaves more than this share of the acceleration of its slip has no hold.
const LEFT: f64 = 1e-6;
/// Accelerations below this share of the largest one are none.
const NONE: f64 = 1e-9;
/// So many changes of modes are tried per friction.
const TRIES: usize = 8;

/// Stops and frictions before a decision.
#[derive(Clone, Copy)]
pub(crate) struct Undecided {
    /// The stops that are rested on if they push.
    pub resting: u32,
    /// The frictions that do not move.
    pub still: u32,
    /// Those of them that were found to break loose.
    pub breaking: u32,
}

/// The stops and frictions that hold, and their forces.
pub(crate) struct Held<T> {
    pub held: u32,
    pub forces: Each<T>,
}

/// The frictions of a mechanism by their rows among its contacts, with the places of their memories.
pub(crate) fn frictions(info: &Info) -> impl Iterator<Item = (usize, usize)> {
    let stops = info.stops.len();
    info.frictions.iter().enumerate().map(move |(at, friction)| (stops + at, friction.memory))
}

/// The set of all frictions but those of stops.
pub(crate) fn free_frictions(info: &Info) -> u32 {
    all_frictions(info) & !rubbing::all_rubbing(info)
}

/// The set of all frictions.
pub(crate) fn all_frictions(info: &Info) -> u32 {
    frictions(info).fold(0, |set, (row, _)| set | bit(row))
}

/// The direction in which friction slides, 0 while it sticks.
pub(crate) fn direction<T: Real>(info: &Info, inputs: &[T], row: usize) -> f64 {
    let found = frictions(info).find(|(of, _)| *of == row);
    found.and_then(|(_, memory)| inputs.get(memory)).map_or(0.0, |direction| direction.to_f64())
}

/// The force with which friction sticks, by its memory.
pub(crate) fn holding<T: Real>(info: &Info, inputs: &[T], row: usize) -> T {
    let found = frictions(info).find(|(of, _)| *of == row);
    found.and_then(|(_, memory)| inputs.get(memory + 1)).copied().unwrap_or_default()
}

/// Sets the memories of friction: its direction and the force with which it sticks.
pub(crate) fn set<T: Real>(info: &Info, inputs: &mut [T], row: usize, (direction, held): (f64, T)) {
    let Some((_, memory)) = frictions(info).find(|(of, _)| *of == row) else { return };
    if let Some(to) = inputs.get_mut(memory) {
        *to = T::from_f64(direction);
    }
    if let Some(to) = inputs.get_mut(memory + 1) {
        *to = held;
    }
}

/// The sizes of a friction by its row: while it slides, and at most while it sticks.
pub(crate) struct Limits<T> {
    stops: usize,
    values: [T; 2 * MOST_CONTACTS],
}

impl<T: Real> Limits<T> {
    /// In a state with given accelerations and multipliers, and forces at stops.
    pub fn of(
        equations: &dyn Equations<T>,
        at: At<'_, T>,
        inputs: &[T],
        (reactions, forces): ([&[T]; 2], &Each<T>),
    ) -> Self {
        let (stops, count) = (equations.info().stops.len(), equations.info().frictions.len());
        let mut values = [T::default(); 2 * MOST_CONTACTS];
        if let Some(values) = values.get_mut(..2 * count) {
            equations.limits(at, inputs, reactions, values);
        }
        Self { stops, values }.at_stops(equations.info(), forces)
    }

    fn of_row(&self, row: usize, which: usize) -> T {
        let place = row.checked_sub(self.stops).map(|at| 2 * at + which);
        place.and_then(|place| self.values.get(place)).copied().unwrap_or_default()
    }

    /// Frictions at stops, with the forces of these.
    fn at_stops(mut self, info: &Info, forces: &Each<T>) -> Self {
        for (row, stop) in rubbing::rubbing(info) {
            let force = forces.get(stop).copied().unwrap_or_default();
            let first = 2 * row.saturating_sub(self.stops);
            for size in self.values.iter_mut().skip(first).take(2) {
                *size = *size * force;
            }
        }
        self
    }

    /// While it slides.
    pub fn sliding(&self, row: usize) -> T {
        self.of_row(row, 0)
    }

    /// At most, while it sticks.
    pub fn sticking(&self, row: usize) -> T {
        self.of_row(row, 1)
    }
}

/// The friction of a set whose force, or impulse, is farthest beyond the largest one that it may have, by its row.
pub(crate) fn loose<T: Real>(set: u32, forces: &Each<T>, most: impl Fn(usize) -> f64) -> Option<usize> {
    let beyond = |row: usize| {
        let (force, most) = (number(forces, row).abs(), most(row));
        // what has no largest force does not stick
        match most > 0.0 {
            true if force > (1.0 + share::<T>(ROUNDING)) * most => force / most,
            true => 0.0,
            false => f64::INFINITY,
        }
    };
    let found = (0..MOST_CONTACTS).filter(|row| has(set, *row) && beyond(*row) > 0.0);
    found.reduce(|worst, row| if beyond(row) > beyond(worst) { row } else { worst })
}

/// Forces that hold in a state, and the accelerations with them.
struct Holding<T> {
    held: u32,
    forces: Each<T>,
    /// s̈, and g̈
    accelerations: Each<T>,
    /// The same without the forces.
    free: Each<T>,
    /// Accelerations up to this size are none.
    none: f64,
    /// W of each row with itself.
    own: Each<T>,
    limits: Limits<T>,
    /// The directions of frictions, with those in which what does not move at stops begins to slide.
    directions: Each<f64>,
}

impl<T: Real> Holding<T> {
    /// With the memories as they are, of stops that may be rested on and frictions that stick. Nothing where no forces answer.
    fn of(
        equations: &dyn Equations<T>,
        at: At<'_, T>,
        inputs: &[T],
        [resting, sticking, still, breaking]: [u32; 4],
        [a, lambda]: [&mut [T]; 2],
    ) -> Option<Self> {
        let info = equations.info();
        let bound = sticking | locked(info, inputs);
        let bounds = Bounds::of(equations).loosened(info, breaking, 1.0 - BREAKS);
        let directions =
            core::array::from_fn(|row| if has(still, row) { 0.0 } else { direction(info, inputs, row) });
        equations.free_reactions(at, inputs, a, lambda);
        let free = Gaps::of(equations, at, a).acceleration;
        let solved = Contacts::at(equations, (at.t, at.q), |contacts| {
            let rest = Hit { info, closed: resting, bound, directions, bounds: &bounds, rates: &free };
            let Struck { held, impulses: forces, directions, .. } = rest.with(&contacts, &free)?;
            contacts.add(&forces, a);
            contacts.react(&forces, lambda);
            let changes = contacts.rates(&forces);
            let own = core::array::from_fn(|row| contacts.mobility(row, row));
            Some((held, forces, changes, own, directions))
        });
        let none = [T::ZERO; MOST_CONTACTS];
        let (held, forces, changes, own, directions) =
            solved.unwrap_or(Some((0, none, none, none, directions)))?;
        let sum = |row: usize| Some(*free.get(row)? + *changes.get(row)?);
        let accelerations = core::array::from_fn(|row| sum(row).unwrap_or_default());
        let limits = Limits::of(equations, at, inputs, ([a, lambda], &forces));
        let none = NONE * vectors::largest(a).1.to_f64();
        Some(Self { held, forces, accelerations, free, none, own, limits, directions })
    }

    /// True if no force of this friction stops its slip. So it is where a drive moves the body, and at dead centres.
    fn has_no_hold(&self, row: usize) -> bool {
        let left = number(&self.accelerations, row).abs();
        left > LEFT * number(&self.free, row).abs() && left > self.none
    }

    /// True if friction that slides from rest would move against its direction.
    fn turns(&self, row: usize, direction: f64) -> bool {
        let most = self.limits.sticking(row).to_f64();
        let least = 2.0 * BREAKS * number(&self.own, row) * most;
        least > 0.0 && direction * number(&self.accelerations, row) < -least
    }
}

/// Decides which frictions stick and which stops are rested on, and sets the memories of the frictions that are still.
///
/// # Errors
/// [`Error::Jammed`], [`Error::Impact`].
pub(crate) fn decide<T: Real>(
    equations: &dyn Equations<T>,
    at: At<'_, T>,
    inputs: &mut [T],
    Undecided { resting, still, breaking }: Undecided,
    [a, lambda]: [&mut [T]; 2],
) -> Result<Held<T>, Error> {
    let info = equations.info();
    // what is off its stop does not rub; what is on it is decided with the stop
    let rubbing = still & rubbing::borne(info, resting);
    let still = still & free_frictions(info);
    let mut sticking = still;
    for _ in 0..=TRIES * info.frictions.len() {
        for (row, _) in frictions(info).filter(|(row, _)| has(sticking, *row)) {
            set(info, inputs, row, (0.0, T::ZERO));
        }
        let sets = [resting, sticking, rubbing, breaking];
        let found = Holding::of(equations, at, inputs, sets, [&mut *a, &mut *lambda]);
        let found = found.ok_or_else(|| unanswered(info, at.t.to_f64(), resting | sticking))?;
        let share = |row: usize| if has(breaking, row) { 1.0 - BREAKS } else { 1.0 };
        let most = |row: usize| share(row) * found.limits.sticking(row).to_f64();
        if let Some(row) = loose(sticking, &found.forces, most) {
            let direction = if number(&found.forces, row) > 0.0 { -1.0 } else { 1.0 };
            set(info, inputs, row, (direction, T::ZERO));
            sticking &= !bit(row);
            continue;
        }
        if let Some((row, _)) =
            frictions(info).find(|(row, _)| has(sticking, *row) && found.has_no_hold(*row))
        {
            let direction = if number(&found.accelerations, row) > 0.0 { 1.0 } else { -1.0 };
            set(info, inputs, row, (direction, T::ZERO));
            sticking &= !bit(row);
            continue;
        }
        let mut sliding = frictions(info).filter(|(row, _)| has(still & !sticking, *row));
        if let Some((row, _)) = sliding.find(|(row, _)| found.turns(*row, direction(info, inputs, *row))) {
            sticking |= bit(row);
            continue;
        }
        for (row, _) in frictions(info).filter(|(row, _)| has(sticking, *row)) {
            let force = found.forces.get(row).copied().unwrap_or_default();
            set(info, inputs, row, (0.0, force));
        }
        for (row, _) in frictions(info).filter(|(row, _)| has(rubbing, *row)) {
            let force = found.forces.get(row).copied().filter(|_| has(found.held, row));
            let direction = number(&found.directions, row);
            set(info, inputs, row, (direction, force.unwrap_or_default()));
        }
        note_forces(info, inputs, found.held, &found.forces);
        // what a mode pulls away leaves its stop
        let leaves = |stop: usize| {
            number(&found.forces, stop) <= 0.0 && number(&found.accelerations, stop) > found.none
        };
        let left = those(info.stops.len(), leaves);
        return Ok(Held { held: found.held & !left, forces: found.forces });
    }
    Err(unanswered(info, at.t.to_f64(), still))
}

/// Nothing answers the first of a set of stops and frictions.
pub(crate) fn unanswered(info: &Info, t: f64, set: u32) -> Error {
    let row = set.trailing_zeros() as usize;
    if let Some((_, lock)) = info.locks().find(|(of, _)| *of == row) {
        return Error::Contradiction { t, constraint: lock.name, rate: f64::NAN };
    }
    match row.checked_sub(info.stops.len()).and_then(|at| info.frictions.get(at)) {
        Some(friction) => Error::Jammed { t, friction: friction.name },
        None => Error::Impact { t, stop: info.stops.get(row).map_or("", |stop| stop.name) },
    }
}

/// Sets the memories of the forces with which frictions stick, and modes hold, to those in a state; `a` and `lambda` are to compute with.
pub fn hold<T: Real>(
    equations: &dyn Equations<T>,
    at: At<'_, T>,
    inputs: &mut [T],
    [a, lambda]: [&mut [T]; 2],
) {
    let info = equations.info();
    if held(equations, inputs) & remembered(info) == 0 {
        let_go(info, inputs);
    } else {
        measure(equations, at, inputs, [a, lambda]);
    }
}

/// The same with the accelerations and multipliers there.
pub(crate) fn measure<T: Real>(
    equations: &dyn Equations<T>,
    at: At<'_, T>,
    inputs: &mut [T],
    [a, lambda]: [&mut [T]; 2],
) {
    let info = equations.info();
    let holding = held(equations, inputs);
    let_go(info, inputs);
    equations.free_reactions(at, inputs, a, lambda);
    let (_, forces) = pressed(equations, at, inputs, a, Some(lambda));
    for (row, _) in frictions(info).filter(|(row, _)| has(holding, *row)) {
        set(info, inputs, row, (0.0, forces.get(row).copied().unwrap_or_default()));
    }
    note_forces(info, inputs, holding, &forces);
}

/// The contacts whose forces have a memory.
fn remembered(info: &Info) -> u32 {
    info.force_memories().fold(0, |set, (row, _)| set | bit(row))
}

/// The values of the memories of forces.
pub(crate) fn remembered_forces<T: Real>(info: &Info, inputs: &[T]) -> Each<T> {
    let mut forces = [T::ZERO; MOST_CONTACTS];
    for (row, memory) in info.force_memories() {
        if let (Some(to), Some(force)) = (forces.get_mut(row), inputs.get(memory)) {
            *to = *force;
        }
    }
    forces
}

/// Sets these memories.
pub(crate) fn remember_forces<T: Real>(info: &Info, inputs: &mut [T], forces: &Each<T>) {
    for (row, memory) in info.force_memories() {
        if let (Some(to), Some(force)) = (inputs.get_mut(memory), forces.get(row)) {
            *to = *force;
        }
    }
}

/// Sets the memories of all forces that hold to 0.
fn let_go<T: Real>(info: &Info, inputs: &mut [T]) {
    for (row, _) in frictions(info) {
        set(info, inputs, row, (direction(info, inputs, row), T::ZERO));
    }
    note_forces(info, inputs, 0, &[T::ZERO; MOST_CONTACTS]);
}
