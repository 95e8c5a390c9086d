//! Pairs of scalars: what a fused step computes with.

use core::ops::{Add, Div, Mul, Neg, Sub};

use mbs_interface::sine::Octant;

/// Two scalars side by side: what a fused step computes with. Every operation is
/// done lane by lane and gives in each lane what the scalar gives, bit for bit.
pub trait Pair<T>:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// A scalar between pairs.
    type Single: Single<T>;
    /// The terms with which its sines and cosines are computed, operation by operation.
    type Term: Term;

    /// The pair of `first` and `second`.
    fn join(first: Self::Single, second: Self::Single) -> Self;
    /// The pair of `both` and `both`.
    fn splat(both: Self::Single) -> Self;
    /// The first lane.
    fn first(self) -> Self::Single;
    /// The second lane.
    fn second(self) -> Self::Single;
    /// The pair with its lanes exchanged.
    #[must_use]
    fn swap(self) -> Self;
    /// The pair with its second lane negated.
    #[must_use]
    fn flip(self) -> Self;
    /// The magnitudes of both lanes.
    #[must_use]
    fn abs(self) -> Self;
    /// Sines and cosines.
    fn sin_cos(self) -> (Self, Self);
    /// The angles as a term: x of [`Octant::new`].
    fn angles(self) -> Self::Term;
    /// The shift that is taken back: `shift_back` of [`Octant::new`]. It is NaN for an angle beyond
    /// 10⁹ rad, so that sines need no branch, which would cut a step in two.
    fn shift_back(self) -> Self::Term;
    /// Sines and cosines, from those without quarter turns. An angle beyond 10⁹ rad may give NaN.
    fn turned(self, octant: Octant<Self::Term>) -> (Self, Self);
}

/// A term of the sines and cosines of two angles. The operations of sines stand one by one in a
/// fused step, each where its time comes.
pub trait Term: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// The same number for both angles.
    fn constant(x: f64) -> Self;
}

/// A scalar that is computed with next to pairs, where that is another register
/// than that of a scalar.
pub trait Single<T>:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// From a scalar.
    fn new(scalar: T) -> Self;
    /// The scalar.
    fn get(self) -> T;
}
