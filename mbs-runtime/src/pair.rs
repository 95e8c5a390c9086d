//! Two scalars that are computed with at once.

use core::ops::{Add, Div, Mul, Sub};

use wide::f64x2;

use crate::Real;
use crate::sincos;

/// Two scalars side by side: what a fused step computes with. Every operation is
/// done lane by lane and gives in each lane what the scalar gives, bit for bit.
pub trait Pair<T>:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// The pair of `first` and `second`.
    fn join(first: T, second: T) -> Self;
    /// The pair of `both` and `both`.
    fn splat(both: T) -> Self;
    /// The first lane.
    fn first(self) -> T;
    /// The second lane.
    fn second(self) -> T;
    /// The pair with its lanes exchanged.
    #[must_use]
    fn swap(self) -> Self;
    /// The pair with its second lane negated.
    #[must_use]
    fn flip(self) -> Self;
    /// Sines and cosines.
    fn sin_cos(self) -> (Self, Self);
}

/// A pair of any scalars, computed one after the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Two<T>(T, T);

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
    )*};
}

lane_by_lane!(Add add, Sub sub, Mul mul, Div div);

impl<T: Real> Pair<T> for Two<T> {
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
        let ((s, c), (sine, cosine)) = (self.0.sin_cos(), self.1.sin_cos());
        (Self(s, sine), Self(c, cosine))
    }
}

/// Two doubles in a vector register, where the processor has them: SSE2 on every
/// x86-64, Neon on every AArch64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector(f64x2);

impl Pair<f64> for Vector {
    #[inline(always)]
    fn join(first: f64, second: f64) -> Self {
        // From registers: an array of the two would go through memory.
        let [joined, _] = f64x2::transpose([f64x2::splat(first), f64x2::splat(second)]);
        Self(joined)
    }
    #[inline(always)]
    fn splat(both: f64) -> Self {
        Self(f64x2::splat(both))
    }
    #[inline(always)]
    fn first(self) -> f64 {
        let [first, _] = self.0.to_array();
        first
    }
    #[inline(always)]
    fn second(self) -> f64 {
        let [_, second] = self.0.to_array();
        second
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
        if self.0.abs().simd_le(f64x2::splat(sincos::RANGE)).all() {
            let (sine, cosine) = sincos::sin_cos_of_two(self.0);
            (Self(sine), Self(cosine))
        } else {
            far_sin_cos(self)
        }
    }
}

/// One after the other, each as the scalar does it.
#[cold]
fn far_sin_cos(angles: Vector) -> (Vector, Vector) {
    let ((s, c), (sine, cosine)) = (Real::sin_cos(angles.first()), Real::sin_cos(angles.second()));
    (Pair::join(s, sine), Pair::join(c, cosine))
}
