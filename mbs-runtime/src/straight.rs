//! The scalar of a loop over lanes.
//!
//! # How a loop over lanes becomes vectors
//!
//! A pack computes the scalar's fused step in a loop over lanes. The compiler makes vectors of that loop.
//! `mbs-ensemble` has it compiled for AVX2 and AVX-512 and chooses at run time. No function may be called in
//! the loop, or there are no vectors. Closures and iterators are functions where the compiler finds them
//! long.
//!
//! A method without a fused step has a loop over its stages. There every operation is one of all lanes
//! (`step_together` in `pack`). Long chains, whose programs are loops, take their steps lane after lane
//! (`pack/long.rs`).

use core::fmt;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::lanes::Lane;
use crate::spline::Spline;
use crate::{Real, Two};

/// A scalar whose sine and cosine have no branch: a loop over instances that
/// computes with it can become vector instructions.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
#[doc(hidden)]
pub struct Straight<T>(pub T);

impl<T: fmt::Display> fmt::Display for Straight<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident)*) => {$(
        impl<T: Lane> $operator for Straight<T> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0))
            }
        }
    )*};
}

operators!(Add add  Sub sub  Mul mul  Div div);

impl<T: Lane> Neg for Straight<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

macro_rules! of_the_scalar {
    ($($name:ident)*; $($name2:ident)*) => {
        $(
            #[inline(always)]
            fn $name(self) -> Self {
                Self(self.0.$name())
            }
        )*
        $(
            #[inline(always)]
            fn $name2(self, other: Self) -> Self {
                Self(self.0.$name2(other.0))
            }
        )*
    };
}

impl<T: Lane> Real for Straight<T> {
    type Pair = Two<Self>;
    const ZERO: Self = Self(T::ZERO);
    const EPSILON: Self = Self(T::EPSILON);

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Self(T::from_f64(x))
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        self.0.to_f64()
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        self.0.is_finite()
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = self.0.straight_sin_cos();
        (Self(sine), Self(cosine))
    }
    #[inline(always)]
    fn sin_cos_of_two(angles: [Self; 2]) -> ([Self; 2], [Self; 2]) {
        let (sines, cosines) = T::straight_sin_cos_of_two(angles.map(|angle| angle.0));
        (sines.map(Self), cosines.map(Self))
    }
    of_the_scalar!(
        tan asin acos atan sqrt exp ln tanh abs sign;
        atan2 pow min max greater gate
    );
    #[inline(always)]
    fn interpolate(self, spline: &Spline, order: u8) -> Self {
        Self(self.0.interpolate(spline, order))
    }
}
