//! The frictions of stops: which there are, and the bounds of their forces.

use crate::contact::{Each, MOST_CONTACTS, bit, has, number};
use crate::equations::Equations;
use crate::{Info, Real};

/// The frictions of stops, by their rows, with the stops.
pub(crate) fn rubbing(info: &Info) -> impl Iterator<Item = (usize, usize)> + use<> {
    let rows = (info.stops.len()..).zip(info.frictions);
    rows.filter_map(|(row, friction)| Some((row, friction.stop?)))
}

/// The set of the frictions of stops.
pub(crate) fn all_rubbing(info: &Info) -> u32 {
    rubbing(info).fold(0, |set, (row, _)| set | bit(row))
}

/// Those of them whose stops are in a set.
pub(crate) fn borne(info: &Info, stops: u32) -> u32 {
    rubbing(info).filter(|(_, stop)| has(stops, *stop)).fold(0, |set, (row, _)| set | bit(row))
}

/// μ of every friction of a stop, by its row.
pub(crate) fn sizes<T: Real>(equations: &dyn Equations<T>) -> Each<T> {
    let (info, mut sizes) = (equations.info(), [T::ZERO; MOST_CONTACTS]);
    let count = rubbing(info).count();
    if count == 0 {
        return sizes;
    }
    let mut laws = [T::ZERO; 3 * MOST_CONTACTS];
    let first = 2 * info.stops.len();
    if let Some(laws) = laws.get_mut(..first + count) {
        equations.stop_laws(laws);
    }
    for ((row, _), size) in rubbing(info).zip(laws.into_iter().skip(first)) {
        if let Some(to) = sizes.get_mut(row) {
            *to = size;
        }
    }
    sizes
}

/// The most that friction has beside x of its stop, by its row: x_s is from −`forwards` x, with which it slides forwards, to
/// `backwards` x. Both are μ but where it has turned around within a step.
#[derive(Clone, Copy)]
pub(crate) struct Bounds<T> {
    forwards: Each<T>,
    backwards: Each<T>,
}

impl<T: Real> Bounds<T> {
    pub fn of(equations: &dyn Equations<T>) -> Self {
        let sizes = sizes(equations);
        Self { forwards: sizes, backwards: sizes }
    }

    /// Sets the bounds of a friction that slid in a direction for a part of the step and turned around then. Half of the impulse of
    /// that direction acted before the step.
    pub fn turned(&mut self, row: usize, (direction, part): (f64, T)) {
        let other = if direction > 0.0 { &mut self.backwards } else { &mut self.forwards };
        if let Some(size) = other.get_mut(row) {
            *size = *size * (T::from_f64(3.0) - T::from_f64(4.0) * part);
        }
    }

    /// The middle of the bounds and half of what is between them: x_s is from −(k + m) x to (m − k) x.
    pub fn middle(&self, row: usize) -> [f64; 2] {
        let [forwards, backwards] = [number(&self.forwards, row), number(&self.backwards, row)];
        [0.5 * (forwards - backwards), 0.5 * (forwards + backwards)]
    }

    /// Narrows the bounds of a set of frictions by a factor: a run has found that they break loose.
    pub fn loosened(mut self, info: &Info, set: u32, part: f64) -> Self {
        for (row, _) in rubbing(info).filter(|(row, _)| has(set, *row)) {
            for size in [&mut self.forwards, &mut self.backwards].into_iter().filter_map(|it| it.get_mut(row))
            {
                *size = *size * T::from_f64(part);
            }
        }
        self
    }

    /// The x of frictions that slide in given directions, by their stops.
    pub fn slides(&self, info: &Info, direction: impl Fn(usize) -> f64) -> Each<T> {
        let mut slides = [T::ZERO; MOST_CONTACTS];
        for (row, stop) in rubbing(info) {
            if let Some(to) = slides.get_mut(stop) {
                *to = match direction(row) {
                    forwards if forwards > 0.0 => -of(&self.forwards, row),
                    backwards if backwards < 0.0 => of(&self.backwards, row),
                    _ => T::ZERO,
                };
            }
        }
        slides
    }
}

fn of<T: Real>(each: &Each<T>, row: usize) -> T {
    each.get(row).copied().unwrap_or_default()
}
