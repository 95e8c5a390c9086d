//! Two scalars that are computed with at once.

use core::ops::{Add, Div, Mul, Neg, Sub};

use mbs_schemes::sine::RANGE;
use wide::f64x2;

use crate::Real;
use crate::sincos;

/// Two scalars side by side: what a fused step computes with. Every operation is
/// done lane by lane and gives in each lane what the scalar gives, bit for bit.
pub trait Pair<T>:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// A scalar between pairs.
    type Single: Single<T>;

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
    /// Sines and cosines.
    fn sin_cos(self) -> (Self, Self);
    /// Sines and cosines without a branch, which would cut a step in two. An angle beyond
    /// 10⁹ rad may give NaN.
    #[inline(always)]
    fn straight_sin_cos(self) -> (Self, Self) {
        self.sin_cos()
    }
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

impl<T: Real> Single<T> for T {
    #[inline(always)]
    fn new(scalar: T) -> Self {
        scalar
    }
    #[inline(always)]
    fn get(self) -> T {
        self
    }
}

/// A double in the first lane of a vector register, with anything in the second: it
/// costs nothing to take it from a pair, and compilers leave it where it is.
#[derive(Clone, Copy, Debug)]
pub struct Low(f64x2);

impl Single<f64> for Low {
    #[inline(always)]
    fn new(scalar: f64) -> Self {
        Self(f64x2::new([scalar, 0.0]))
    }
    #[inline(always)]
    fn get(self) -> f64 {
        let [scalar, _] = self.0.to_array();
        scalar
    }
}

impl Neg for Low {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

/// A pair of any scalars, computed one after the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Two<T>(pub(crate) T, pub(crate) T);

macro_rules! lane_by_lane {
    ($($Operator:ident $operator:ident),*) => {$(
        impl<T: Real> $Operator for Two<T> {
            type Output = Self;

            #[inline(always)]
            fn $operator(self, other: Self) -> Self {
                Self($Operator::$operator(self.0, other.0), $Operator::$operator(self.1, other.1))
            }
        }

        impl $Operator for Vector {
            type Output = Self;

            #[inline(always)]
            fn $operator(self, other: Self) -> Self {
                Self($Operator::$operator(self.0, other.0))
            }
        }

        impl $Operator for Low {
            type Output = Self;

            #[inline(always)]
            fn $operator(self, other: Self) -> Self {
                Self($Operator::$operator(self.0, other.0))
            }
        }
    )*};
}

lane_by_lane!(Add add, Sub sub, Mul mul, Div div);

impl<T: Real> Pair<T> for Two<T> {
    type Single = T;

    #[inline(always)]
    fn join(first: T, second: T) -> Self {
        Self(first, second)
    }
    #[inline(always)]
    fn splat(both: T) -> Self {
        Self(both, both)
    }
    #[inline(always)]
    fn first(self) -> T {
        self.0
    }
    #[inline(always)]
    fn second(self) -> T {
        self.1
    }
    #[inline(always)]
    fn swap(self) -> Self {
        Self(self.1, self.0)
    }
    #[inline(always)]
    fn flip(self) -> Self {
        Self(self.0, -self.1)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        T::sin_cos_of_two(self)
    }
}

/// Two doubles in a vector register, where the processor has them: SSE2 on every
/// x86-64, Neon on every AArch64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector(f64x2);

impl Pair<f64> for Vector {
    type Single = Low;

    #[inline(always)]
    fn join(first: Low, second: Low) -> Self {
        let [joined, _] = f64x2::transpose([first.0, second.0]);
        Self(joined)
    }
    #[inline(always)]
    fn splat(both: Low) -> Self {
        Self::join(both, both)
    }
    #[inline(always)]
    fn first(self) -> Low {
        Low(self.0)
    }
    #[inline(always)]
    fn second(self) -> Low {
        let [_, second] = f64x2::transpose([self.0, self.0]);
        Low(second)
    }
    #[inline(always)]
    fn swap(self) -> Self {
        Self::join(self.second(), self.first())
    }
    #[inline(always)]
    fn flip(self) -> Self {
        Self(self.0 ^ f64x2::new([0.0, -0.0]))
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        if self.0.abs().simd_le(f64x2::splat(RANGE)).all() {
            let (sine, cosine) = sincos::sin_cos_of_two(self.0);
            (Self(sine), Self(cosine))
        } else {
            far_sin_cos(self)
        }
    }
    #[inline(always)]
    fn straight_sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = sincos::straight_sin_cos_of_vector(self.0);
        (Self(sine), Self(cosine))
    }
}

/// One after the other, each as the scalar does it.
#[cold]
fn far_sin_cos(angles: Vector) -> (Vector, Vector) {
    let [first, second] = angles.0.to_array();
    let ((s, c), (sine, cosine)) = (Real::sin_cos(first), Real::sin_cos(second));
    (Vector(f64x2::new([s, sine])), Vector(f64x2::new([c, cosine])))
}
