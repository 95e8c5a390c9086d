//! Room for vectors, so that what needs many of them needs no heap.

use crate::arrays::{Constraints, Coordinates};
use crate::{Components, Mechanism};

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
}

impl<'a, T> Room<'a, T> {
    /// The numbers that a mechanism with so many coordinates and constraints needs.
    pub const fn len(coordinates: usize, constraints: usize) -> usize {
        COORDINATES * coordinates + CONSTRAINTS * constraints
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
        }
    }
}

/// The arrays of a mechanism that [`Room`] is made of.
pub(crate) struct OnStack<M: Mechanism> {
    coordinates: [Coordinates<M>; COORDINATES],
    constraints: [Constraints<M>; CONSTRAINTS],
}

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
        }
    }
}
