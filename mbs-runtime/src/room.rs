//! Room for vectors, so that what needs many of them needs no heap.
//!
//! Functions with named components copy to arrays and back, and have room on the stack. A mechanism whose
//! number of coordinates is known at run time only has its room within any slice.

use mbs_interface::MOST_STAGES;

use crate::arrays::{Constraints, Coordinates, States};
use crate::{Components, Info, Mechanism, Scheme};

/// How many vectors of coordinates the most demanding calculation works with, and how many
/// of constraints: [`project`](crate::equations::project).
const COORDINATES: usize = 8;
const CONSTRAINTS: usize = 6;
/// Vectors for all coordinates and velocities of two states.
const COMPLETED: usize = 4;

/// Vectors to compute with. Their contents before and after a calculation mean nothing:
/// each takes the first ones that it needs.
#[derive(Debug)]
pub struct Room<'a, T> {
    /// Vectors with a component per coordinate.
    pub(crate) coordinates: [&'a mut [T]; COORDINATES],
    /// Vectors with a component per constraint.
    pub(crate) constraints: [&'a mut [T]; CONSTRAINTS],
    /// All coordinates and velocities of two states of a step.
    pub(crate) completed: [&'a mut [T]; COMPLETED],
    /// The positions that are integrated, of a stage of a step.
    pub(crate) there: &'a mut [T],
    /// v and q̈ of the stages of a step, as many as there are.
    pub(crate) slopes: [[&'a mut [T]; MOST_STAGES]; 2],
}

impl<'a, T> Room<'a, T> {
    /// The numbers that a mechanism needs, for steps of so many stages; without steps, 0.
    pub const fn len(info: &Info, stages: usize) -> usize {
        (COORDINATES + COMPLETED) * info.coordinates.len()
            + CONSTRAINTS * info.constraints.len()
            + (1 + 2 * stages) * info.states.len()
    }

    /// Room for a mechanism in a slice of [`len`](Self::len) numbers. In a shorter one, what is
    /// computed means nothing.
    pub fn within(mut numbers: &'a mut [T], info: &Info) -> Self {
        let (coordinates, states) = (info.coordinates.len(), info.states.len());
        let mut cut = |length: usize| {
            let whole = core::mem::take(&mut numbers);
            let (vector, rest) = whole.split_at_mut(length.min(whole.len()));
            numbers = rest;
            vector
        };
        Self {
            coordinates: [(); COORDINATES].map(|()| cut(coordinates)),
            constraints: [(); CONSTRAINTS].map(|()| cut(info.constraints.len())),
            completed: [(); COMPLETED].map(|()| cut(coordinates)),
            there: cut(states),
            slopes: slopes(numbers.chunks_exact_mut(states.max(1))),
        }
    }
}

/// Vectors of stages from as many as there are: v and q̈ of the first stage, then those of the
/// next.
fn slopes<'a, T>(mut vectors: impl Iterator<Item = &'a mut [T]>) -> [[&'a mut [T]; MOST_STAGES]; 2] {
    let [mut velocities, mut accelerations] =
        [(); 2].map(|()| [(); MOST_STAGES].map(|()| Default::default()));
    for (v, a) in velocities.iter_mut().zip(&mut accelerations) {
        (*v, *a) = (vectors.next().unwrap_or_default(), vectors.next().unwrap_or_default());
    }
    [velocities, accelerations]
}

/// The arrays of a mechanism that [`Room`] is made of.
pub(crate) struct OnStack<M: Mechanism> {
    coordinates: [Coordinates<M>; COORDINATES],
    constraints: [Constraints<M>; CONSTRAINTS],
    completed: [Coordinates<M>; COMPLETED],
    there: States<M>,
}

/// v and q̈ of every stage of a scheme.
pub(crate) type Stages<M, S> = <S as Scheme>::Stages<[States<M>; 2]>;

impl<M: Mechanism> OnStack<M> {
    /// Zeros.
    #[inline(never)]
    pub fn new() -> Self {
        let zero = Default::default();
        Self {
            coordinates: [M::Coordinates::splat(zero).into_array(); COORDINATES],
            constraints: [M::Constraints::splat(zero).into_array(); CONSTRAINTS],
            completed: [M::Coordinates::splat(zero).into_array(); COMPLETED],
            there: M::States::splat(zero).into_array(),
        }
    }

    /// Room in these arrays.
    pub fn room(&mut self) -> Room<'_, M::Real> {
        Room {
            coordinates: self.coordinates.each_mut().map(AsMut::as_mut),
            constraints: self.constraints.each_mut().map(AsMut::as_mut),
            completed: self.completed.each_mut().map(AsMut::as_mut),
            there: self.there.as_mut(),
            slopes: slopes(core::iter::empty()),
        }
    }

    /// Room in these arrays and in those of the stages of a scheme.
    pub fn room_for_steps<'a, S: Scheme>(&'a mut self, stages: &'a mut Stages<M, S>) -> Room<'a, M::Real> {
        let vectors = stages.as_mut().iter_mut().flatten().map(AsMut::as_mut);
        Room { slopes: slopes(vectors), ..self.room() }
    }
}
