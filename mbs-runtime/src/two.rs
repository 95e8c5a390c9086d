//! Pairs of any scalars, and of doubles in a vector register.

use core::ops::{Add, Div, Mul, Neg, Sub};

use mbs_interface::sine::{Octant, RANGE};
use wide::f64x2;

use crate::pair::{Pair, Single, Term};
use crate::real::Real;
use crate::sincos::{self, far_sin_cos_of_two};

/// The terms of scalars that compute a sine as a whole: there is nothing to do before
/// [`turned`](Pair::turned).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoTerm;

impl Term for NoTerm {
    #[inline(always)]
    fn constant(_: f64) -> Self {
        Self
    }
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
        impl $Operator for NoTerm {
            type Output = Self;

            #[inline(always)]
            fn $operator(self, _: Self) -> Self {
                self
            }
        }

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
    type Term = NoTerm;

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
    fn abs(self) -> Self {
        Self(self.0.abs(), self.1.abs())
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let ([s, sine], [c, cosine]) = T::sin_cos_of_two([self.0, self.1]);
        (Self(s, sine), Self(c, cosine))
    }
    #[inline(always)]
    fn angles(self) -> NoTerm {
        NoTerm
    }
    #[inline(always)]
    fn shift_back(self) -> NoTerm {
        NoTerm
    }
    #[inline(always)]
    fn turned(self, _: Octant<NoTerm>) -> (Self, Self) {
        self.sin_cos()
    }
}

/// Two doubles in a vector register, where the processor has them: SSE2 on every
/// x86-64, Neon on every AArch64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector(f64x2);

impl Pair<f64> for Vector {
    type Single = Low;
    type Term = Self;

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
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        if self.0.abs().simd_le(f64x2::splat(RANGE)).all() {
            let (sine, cosine) = sincos::sin_cos_of_two(self.0);
            (Self(sine), Self(cosine))
        } else {
            let (sines, cosines) = far_sin_cos_of_two(self.0.to_array());
            (Self(sines.into()), Self(cosines.into()))
        }
    }
    #[inline(always)]
    fn angles(self) -> Self {
        self
    }
    #[inline(always)]
    fn shift_back(self) -> Self {
        Self(sincos::straight_shift_of_vector(self.0))
    }
    #[inline(always)]
    fn turned(self, Octant { shifted, sine, cosine }: Octant<Self>) -> (Self, Self) {
        let octant = Octant { shifted: shifted.0, sine: sine.0, cosine: cosine.0 };
        let (sine, cosine) = sincos::turned_vector(octant);
        (Self(sine), Self(cosine))
    }
}

impl Term for Vector {
    #[inline(always)]
    fn constant(x: f64) -> Self {
        Self(f64x2::splat(x))
    }
}
