//! Several instances at once, one per lane: [`Lanes`] of scalars, and a [`Pack`]
//! of simulations.
#![allow(
    clippy::needless_range_loop,
    reason = "the compiler makes vectors of loops over indices, not of iterators over arrays"
)]

use core::cmp::Ordering;
use core::fmt;
use core::ops::{Add, Div, Mul, Neg, Sub};

pub use crate::pack::{Many, ManyCoordinates, ManyOutputs, Pack, Snapshot, and, unpack};

use crate::spline::Spline;
use crate::{Real, Two};

/// `N` scalars side by side, one per instance of a mechanism: generated code that
/// computes with `Lanes<f64, 8>` runs eight instances at once.
///
/// Every operation is done lane by lane and gives in each lane what the scalar
/// gives, bit for bit, with two exceptions for `N` > 1, which keep sines and
/// cosines free of branches:
///
/// * [`sin_cos`](Real::sin_cos) of an `f64` lane beyond 10⁹ rad is NaN;
/// * that of an `f32` lane is that of the `f64` angle, rounded: it may differ from
///   the scalar's in the last place up to 10⁵ rad, and is NaN beyond 10⁹ rad too.
///
/// Lanes do not branch apart, so what is a decision for a scalar is one for all
/// lanes together: a comparison holds if it holds in every lane, a value
/// [`is_finite`](Real::is_finite) if it is in every lane. [`to_f64`](Real::to_f64)
/// gives the first lane.
///
/// The operations are plain loops, all of them inlined: which vector instructions
/// they become is up to the target features of the function around them.
///
/// Aligned to 64 bytes, so that no vector lies across two lines of a cache.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Lanes<T, const N: usize>(pub [T; N]);

/// A scalar that can stand in a lane: `f32` or `f64`.
pub trait Lane: Real + sealed::Sealed {
    /// Sine and cosine without a branch; NaN beyond 10⁹ rad.
    #[doc(hidden)]
    fn straight_sin_cos(self) -> (Self, Self);
    /// The larger of two magnitudes; NaN if one is. A number with a minus sign is larger than
    /// one without, even a zero.
    #[doc(hidden)]
    #[must_use]
    fn worse(self, other: Self) -> Self;
    /// True if `other` is [`worse`](Self::worse), and not the same.
    #[doc(hidden)]
    fn is_below(self, other: Self) -> bool;
    /// Sines and cosines of two angles, in turns.
    #[doc(hidden)]
    fn straight_sin_cos_of_two(angles: [Self; 2]) -> ([Self; 2], [Self; 2]);
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

impl Lane for f64 {
    // Bits are in the order of magnitudes, and those of NaN beyond. That is an instruction
    // of a vector; a `max` that keeps NaN is two.
    #[inline(always)]
    fn worse(self, other: Self) -> Self {
        Self::from_bits(self.to_bits().max(other.to_bits()))
    }
    #[inline(always)]
    fn is_below(self, other: Self) -> bool {
        self.to_bits() < other.to_bits()
    }
    #[inline(always)]
    fn straight_sin_cos(self) -> (Self, Self) {
        crate::sincos::straight_sin_cos(self)
    }
    #[inline(always)]
    fn straight_sin_cos_of_two(angles: [Self; 2]) -> ([Self; 2], [Self; 2]) {
        crate::sincos::straight_sin_cos_of_two(angles)
    }
}

impl Lane for f32 {
    // Bits are in the order of magnitudes, and those of NaN beyond. That is an instruction
    // of a vector; a `max` that keeps NaN is two.
    #[inline(always)]
    fn worse(self, other: Self) -> Self {
        Self::from_bits(self.to_bits().max(other.to_bits()))
    }
    #[inline(always)]
    fn is_below(self, other: Self) -> bool {
        self.to_bits() < other.to_bits()
    }
    #[inline(always)]
    fn straight_sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = f64::from(self).straight_sin_cos();
        (sine as Self, cosine as Self)
    }
    #[inline(always)]
    fn straight_sin_cos_of_two(angles: [Self; 2]) -> ([Self; 2], [Self; 2]) {
        let (sines, cosines) = f64::straight_sin_cos_of_two(angles.map(f64::from));
        (sines.map(|sine| sine as Self), cosines.map(|cosine| cosine as Self))
    }
}

impl<T: Lane, const N: usize> Lanes<T, N> {
    /// f of every lane.
    #[inline(always)]
    #[must_use]
    pub fn map(self, f: impl Fn(T) -> T) -> Self {
        let mut lanes = self.0;
        for lane in 0..N {
            lanes[lane] = f(self.0[lane]);
        }
        Self(lanes)
    }

    /// f of every pair of lanes.
    #[inline(always)]
    #[must_use]
    pub fn zip_map(self, other: Self, f: impl Fn(T, T) -> T) -> Self {
        let mut lanes = self.0;
        for lane in 0..N {
            lanes[lane] = f(self.0[lane], other.0[lane]);
        }
        Self(lanes)
    }

    /// True if f holds for a pair of lanes, for every pair.
    #[inline(always)]
    pub fn test(self, other: Self, f: impl Fn(T, T) -> bool) -> [bool; N] {
        let mut holds = [false; N];
        for lane in 0..N {
            holds[lane] = f(self.0[lane], other.0[lane]);
        }
        holds
    }

    /// The lanes of `self` where `mask` is set, those of `other` elsewhere.
    ///
    /// # Example
    /// ```
    /// # use mbs_runtime::Lanes;
    /// let (x, y) = (Lanes([1.0, 4.0]), Lanes([3.0, 2.0]));
    /// let smaller = x.select(x.test(y, |x, y| x < y), y);
    /// assert_eq!(smaller, Lanes([1.0, 2.0]));
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn select(self, mask: [bool; N], other: Self) -> Self {
        let mut lanes = other.0;
        for lane in 0..N {
            lanes[lane] = if mask[lane] { self.0[lane] } else { other.0[lane] };
        }
        Self(lanes)
    }

    #[inline(always)]
    fn holds(self, other: Self, f: impl Fn(T, T) -> bool) -> bool {
        let mut holds = true;
        for lane in 0..N {
            holds &= f(self.0[lane], other.0[lane]);
        }
        holds
    }
}

impl<T: Lane, const N: usize> Default for Lanes<T, N> {
    #[inline(always)]
    fn default() -> Self {
        Self([T::default(); N])
    }
}

impl<T: fmt::Display, const N: usize> fmt::Display for Lanes<T, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("[")?;
        for (at, lane) in self.0.iter().enumerate() {
            f.write_str(if at == 0 { "" } else { ", " })?;
            lane.fmt(f)?;
        }
        f.write_str("]")
    }
}

impl<T: Lane, const N: usize> PartialOrd for Lanes<T, N> {
    /// The order that all lanes have.
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        let mut orders = self.0.iter().zip(&other.0).map(|(x, y)| x.partial_cmp(y));
        let first = orders.next()??;
        orders.all(|order| order == Some(first)).then_some(first)
    }
    #[inline(always)]
    fn lt(&self, other: &Self) -> bool {
        self.holds(*other, |x, y| x < y)
    }
    #[inline(always)]
    fn le(&self, other: &Self) -> bool {
        self.holds(*other, |x, y| x <= y)
    }
    #[inline(always)]
    fn gt(&self, other: &Self) -> bool {
        self.holds(*other, |x, y| x > y)
    }
    #[inline(always)]
    fn ge(&self, other: &Self) -> bool {
        self.holds(*other, |x, y| x >= y)
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident)*) => {$(
        impl<T: Lane, const N: usize> $operator for Lanes<T, N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.zip_map(other, T::$method)
            }
        }
    )*};
}

operators!(Add add  Sub sub  Mul mul  Div div);

impl<T: Lane, const N: usize> Neg for Lanes<T, N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(T::neg)
    }
}

macro_rules! lane_by_lane {
    ($($name:ident)*; $($name2:ident)*) => {
        $(
            #[inline(always)]
            fn $name(self) -> Self {
                self.map(T::$name)
            }
        )*
        $(
            #[inline(always)]
            fn $name2(self, other: Self) -> Self {
                self.zip_map(other, T::$name2)
            }
        )*
    };
}

impl<T: Lane, const N: usize> Real for Lanes<T, N> {
    type Pair = Two<Self>;
    const ZERO: Self = Self([T::ZERO; N]);
    const EPSILON: Self = Self([T::EPSILON; N]);

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Self([T::from_f64(x); N])
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        self.0.first().map_or(f64::NAN, |lane| lane.to_f64())
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        self.holds(self, |x, _| x.is_finite())
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (mut sines, mut cosines) = (self.0, self.0);
        for lane in 0..N {
            let x = self.0[lane];
            (sines[lane], cosines[lane]) = if N == 1 { x.sin_cos() } else { x.straight_sin_cos() };
        }
        (Self(sines), Self(cosines))
    }
    lane_by_lane!(
        tan asin acos atan sqrt exp ln tanh abs sign;
        atan2 pow min max greater gate
    );
    #[inline(always)]
    fn interpolate(self, spline: &Spline, order: u8) -> Self {
        self.map(|x| x.interpolate(spline, order))
    }
}

#[cfg(test)]
#[allow(
    clippy::nonminimal_bool,
    clippy::neg_cmp_op_on_partial_ord,
    reason = "comparisons of lanes are tested"
)]
mod tests {
    use super::{Lane, Lanes};
    use crate::Real;

    #[test]
    fn decisions_are_for_all_lanes() {
        let (low, high) = (Lanes([1.0, 2.0]), Lanes([2.0, 3.0]));
        assert!(low < high && high > low && low <= low && !(Lanes([1.0, 4.0]) < high));
        assert!(!(Lanes([1.0, f64::NAN]) <= Lanes([1.0, 1.0])));
        assert_eq!(low.partial_cmp(&Lanes([0.0, 3.0])), None);
        assert!(!Lanes([0.0, f64::INFINITY]).is_finite() && low.is_finite());
        assert_eq!(low.select([true, false], high), Lanes([1.0, 3.0]));
    }

    #[test]
    fn a_nan_is_worst() {
        let numbers = [0.0, 1.0, 0.5, f64::INFINITY, f64::NAN, 2.0];
        let worst = |upto: usize| numbers[..=upto].iter().fold(0.0, |worst: f64, &x| worst.worse(x));
        assert_eq!([worst(0), worst(1), worst(2), worst(3)], [0.0, 1.0, 1.0, f64::INFINITY]);
        assert!(worst(4).is_nan() && worst(5).is_nan());
        assert!(0.0.is_below(1.0) && 1.0_f32.is_below(1.5) && !1.5.is_below(1.5));
        for no_magnitude in [f64::INFINITY, f64::NAN, -f64::NAN, -0.0, -1.0] {
            assert!(!1.0.worse(no_magnitude).worse(1.0).is_below(2.0), "{no_magnitude}");
        }
    }

    #[test]
    fn far_angles_are_refused_where_branches_are() {
        let (sine, cosine) = Lanes([1.0, 1.1e9]).sin_cos();
        assert_eq!((sine.0[0], cosine.0[0]), 1.0_f64.sin_cos());
        assert!(sine.0[1].is_nan() && cosine.0[1].is_nan());
        assert_eq!(Lanes([1.1e9]).sin_cos().0.0, [Real::sin_cos(1.1e9).0]);
    }
}
