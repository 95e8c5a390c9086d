//! The constraints of modes among the contacts: which of them hold, and the memories of their multipliers.

use crate::contact::{Each, bit, has, those};
use crate::declared::DeclaredLock;
use crate::{Info, Real};

impl Info {
    /// The constraints of modes, with their places among the [contacts](Self::contacts).
    pub fn locks(&self) -> impl Iterator<Item = (usize, &'static DeclaredLock)> + use<> {
        (self.watched_contacts()..).zip(self.modes.locks)
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

/// Sets the memories of the multipliers of the constraints that hold: a force x along ∂g/∂q is −λ.
pub(crate) fn note_multipliers<T: Real>(info: &Info, inputs: &mut [T], held: u32, forces: &Each<T>) {
    for (row, lock) in info.locks() {
        let force = forces.get(row).copied().filter(|_| has(held, row));
        if let Some(to) = inputs.get_mut(lock.held) {
            *to = force.map_or(T::ZERO, |force| -force);
        }
    }
}
