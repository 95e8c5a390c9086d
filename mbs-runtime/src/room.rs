//! Room for vectors, so that what needs many of them needs no heap.

use mbs_schemes::MOST_STAGES;

use crate::arrays::{Constraints, Coordinates};
use crate::{Components, Mechanism, Scheme};

/// How many vectors of coordinates the most demanding calculation works with, and how many
/// of constraints: [`project`](crate::equations::project).
const COORDINATES: usize = 8;
const CONSTRAINTS: usize = 6;

/// Vectors to compute with. What they hold before and after a calculation means nothing:
/// each takes the first ones that it needs.
#[derive(Debug)]
pub struct Room<'a, T> {
    /// Vectors with a component per coordinate.
    pub(crate) coordinates: [&'a mut [T]; COORDINATES],
    /// Vectors with a component per constraint.
    pub(crate) constraints: [&'a mut [T]; CONSTRAINTS],
    /// v and q̈ of the stages of a step, as many as there are.
    pub(crate) slopes: [[&'a mut [T]; MOST_STAGES]; 2],
}

impl<'a, T> Room<'a, T> {
    /// The numbers that a mechanism with so many coordinates and constraints needs, for steps
    /// of so many stages; without steps, 0.
    pub const fn len(coordinates: usize, constraints: usize, stages: usize) -> usize {
        (COORDINATES + 2 * stages) * coordinates + CONSTRAINTS * constraints
    }

    /// Room in a slice of [`len`](Self::len) numbers. In a shorter one, what is computed
    /// means nothing.
    pub fn within(mut numbers: &'a mut [T], coordinates: usize, constraints: usize) -> Self {
        let mut cut = |length: usize| {
            let whole = core::mem::take(&mut numbers);
            let (vector, rest) = whole.split_at_mut(length.min(whole.len()));
            numbers = rest;
            vector
        };
        Self {
            coordinates: [(); COORDINATES].map(|()| cut(coordinates)),
            constraints: [(); CONSTRAINTS].map(|()| cut(constraints)),
            slopes: slopes(numbers.chunks_exact_mut(coordinates.max(1))),
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
}

/// v and q̈ of every stage of a scheme.
pub(crate) type Stages<M, S> = <S as Scheme>::Stages<[Coordinates<M>; 2]>;

impl<M: Mechanism> OnStack<M> {
    /// Zeros.
    #[inline(never)]
    pub fn new() -> Self {
        let zero = Default::default();
        Self {
            coordinates: [M::Coordinates::splat(zero).into_array(); COORDINATES],
            constraints: [M::Constraints::splat(zero).into_array(); CONSTRAINTS],
        }
    }

    /// Room in these arrays.
    pub fn room(&mut self) -> Room<'_, M::Real> {
        Room {
            coordinates: self.coordinates.each_mut().map(AsMut::as_mut),
            constraints: self.constraints.each_mut().map(AsMut::as_mut),
            slopes: slopes(core::iter::empty()),
        }
    }

    /// Room in these arrays and in those of the stages of a scheme.
    pub fn room_for_steps<'a, S: Scheme>(&'a mut self, stages: &'a mut Stages<M, S>) -> Room<'a, M::Real> {
        let vectors = stages.as_mut().iter_mut().flatten().map(AsMut::as_mut);
        Room { slopes: slopes(vectors), ..self.room() }
    }
}
