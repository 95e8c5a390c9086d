//! The constraints of modes among the contacts: which of them hold; the memories of their multipliers, and of the forces of
//! stops.

use crate::contact::{Each, bit, has, those};
use crate::declared::DeclaredLock;
use crate::{Info, Real};

impl Info {
    /// The constraints of modes, with their places among the [contacts](Self::contacts).
    pub fn locks(&self) -> impl Iterator<Item = (usize, &'static DeclaredLock)> + use<> {
        (self.watched_contacts()..).zip(self.modes.locks)
    }

    /// The contacts whose forces have a memory of their own, with its place: stops that are asked for theirs, and the
    /// constraints of modes.
    pub(crate) fn noted(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let stops = self.stops.iter().enumerate().filter_map(|(row, stop)| Some((row, stop.force?)));
        stops.chain(self.locks().map(|(row, lock)| (row, lock.held)))
    }

    /// True if memories have forces with which frictions stick, stops bear, or constraints of modes hold.
    pub const fn holds(&self) -> bool {
        self.frictions.len() + self.modes.locks.len() > 0 || self.asks_stops()
    }

    /// True if a memory has the force of a stop.
    const fn asks_stops(&self) -> bool {
        let mut stops = self.stops;
        while let [stop, others @ ..] = stops {
            if stop.force.is_some() {
                return true;
            }
            stops = others;
        }
        false
    }

    /// The memories of forces, each with its row among the contacts: of frictions that stick, stops and modes.
    pub(crate) fn force_memories(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let frictions = (self.stops.len()..).zip(self.frictions);
        frictions.map(|(row, friction)| (row, friction.memory + 1)).chain(self.noted())
    }
}

/// Those of the modes that hold.
pub(crate) fn locked<T: Real>(info: &Info, inputs: &[T]) -> u32 {
    let holds = |lock: &DeclaredLock| inputs.get(lock.mode).is_some_and(|mode| mode.to_f64() > 0.5);
    info.locks().filter(|(_, lock)| holds(lock)).fold(0, |set, (row, _)| set | bit(row))
}

/// Those of a set that restrict positions.
pub(crate) fn placed(info: &Info, set: u32) -> u32 {
    info.locks().filter(|(_, lock)| lock.is_rate).fold(set, |set, (row, _)| set & !bit(row))
}

/// The set of all stops.
pub(crate) fn all_stops(info: &Info) -> u32 {
    those(info.stops.len(), |_| true)
}

/// Sets the memories of the forces of stops and of the multipliers of modes, those of what holds to theirs and the others
/// to 0. A force x along ∂g/∂q is −λ.
pub(crate) fn note_forces<T: Real>(info: &Info, inputs: &mut [T], held: u32, forces: &Each<T>) {
    for (row, memory) in info.noted() {
        let force = forces.get(row).copied().filter(|_| has(held, row));
        let force = force.map(|force| if row < info.stops.len() { force } else { -force });
        if let Some(to) = inputs.get_mut(memory) {
            *to = force.unwrap_or(T::ZERO);
        }
    }
}
