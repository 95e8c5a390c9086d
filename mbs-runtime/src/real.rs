//! The scalar that generated code computes with.

use core::fmt::{Debug, Display};
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::pair::Pair;
use crate::spline::Spline;

/// A real scalar: what a generated solver needs to know of its number type.
///
/// Implemented for `f32`, `f64`, vectors of either ([`Lanes`](crate::Lanes)) and numbers with
/// their partial derivatives ([`Dual`](crate::Dual)). With the feature `std` the elementary
/// functions are the standard library's, without it those of `libm`; the two
/// may differ in the last place. The sine and cosine of an `f64` angle up to
/// 10⁹ rad are this crate's own, inlined: within 2 units in the last place up to
/// 10³ rad. Up to 10⁵ rad, 3·10⁻⁴ of a unit in the last place of the angle are added.
/// Beyond, they are those of an angle that differs from the given one by no more than half
/// a unit in its last place.
pub trait Real:
    Copy
    + Debug
    + Display
    + Default
    + PartialEq
    + PartialOrd
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// 0
    const ZERO: Self;
    /// The distance from 1 to the next larger number.
    const EPSILON: Self;
    /// How many orders of derivatives it carries beside its value: an iteration that has ended
    /// by value is continued by as many corrections.
    #[doc(hidden)]
    const ORDER: usize = 0;
    /// How many first derivatives it carries.
    #[doc(hidden)]
    const PARTIALS: usize = 0;
    /// Two of them at once; [`Two<Self>`](crate::Two) will do.
    type Pair: Pair<Self>;

    /// The nearest scalar to `x`.
    fn from_f64(x: f64) -> Self;
    /// The value as `f64`, exact for `f32` and `f64`.
    fn to_f64(self) -> f64;
    /// Neither infinite nor NaN.
    fn is_finite(self) -> bool;

    /// Sine and cosine of an angle in rad.
    fn sin_cos(self) -> (Self, Self);
    /// Sines and cosines of two angles.
    #[doc(hidden)]
    #[inline(always)]
    fn sin_cos_of_two([first, second]: [Self; 2]) -> ([Self; 2], [Self; 2]) {
        let ((s, c), (sine, cosine)) = (first.sin_cos(), second.sin_cos());
        ([s, sine], [c, cosine])
    }
    /// Sine of an angle in rad.
    #[inline(always)]
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    /// Cosine of an angle in rad.
    #[inline(always)]
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    /// Tangent of an angle in rad.
    fn tan(self) -> Self;
    /// Inverse sine in rad, NaN outside −1 … 1.
    fn asin(self) -> Self;
    /// Inverse cosine in rad, NaN outside −1 … 1.
    fn acos(self) -> Self;
    /// Inverse tangent in rad.
    fn atan(self) -> Self;
    /// Angle in rad of the vector (`x`, `self`).
    fn atan2(self, x: Self) -> Self;
    /// Square root, NaN below 0.
    fn sqrt(self) -> Self;
    /// Exponential.
    fn exp(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// Hyperbolic tangent.
    fn tanh(self) -> Self;
    /// `self` to the power `exponent`.
    fn pow(self, exponent: Self) -> Self;
    /// Magnitude.
    fn abs(self) -> Self;
    /// −1, 0 or 1; NaN of NaN.
    fn sign(self) -> Self;
    /// The smaller of two; NaN if either is NaN.
    fn min(self, other: Self) -> Self;
    /// The larger of two; NaN if either is NaN.
    fn max(self, other: Self) -> Self;
    /// 1 if `self > other`, else 0: the slope of `max`.
    fn greater(self, other: Self) -> Self;
    /// `other` where `self`, which is 0 or 1, is 1; 0 elsewhere, even if `other` is NaN.
    fn gate(self, other: Self) -> Self;

    /// A spline's derivative of this order at `self`.
    #[doc(hidden)]
    #[inline(always)]
    fn interpolate(self, spline: &Spline, order: u8) -> Self {
        spline.derivative_at(order, self)
    }

    /// True if it is the other number with all of its derivatives.
    #[doc(hidden)]
    #[inline(always)]
    fn is_same(self, other: Self) -> bool {
        self == other
    }
    /// The number as a constant.
    #[doc(hidden)]
    #[inline(always)]
    #[must_use]
    fn without_partials(self) -> Self {
        self
    }
    /// Its value with the derivatives of another number.
    #[doc(hidden)]
    #[inline(always)]
    #[must_use]
    fn with_partials_of(self, _other: Self) -> Self {
        self
    }
    /// a x + b y of partial derivatives in this scalar.
    #[doc(hidden)]
    #[inline(always)]
    fn combined<const N: usize>(a: Self, x: &[Self; N], b: Self, y: &[Self; N]) -> [Self; N] {
        core::array::from_fn(|at| a * x[at] + b * y[at])
    }
    /// x + y of partial derivatives.
    #[doc(hidden)]
    #[inline(always)]
    fn sum<const N: usize>(x: &[Self; N], y: &[Self; N]) -> [Self; N] {
        core::array::from_fn(|at| x[at] + y[at])
    }
    /// x − y of partial derivatives.
    #[doc(hidden)]
    #[inline(always)]
    fn difference<const N: usize>(x: &[Self; N], y: &[Self; N]) -> [Self; N] {
        core::array::from_fn(|at| x[at] - y[at])
    }
    /// a x of partial derivatives.
    #[doc(hidden)]
    #[inline(always)]
    fn scaled<const N: usize>(a: Self, x: &[Self; N]) -> [Self; N] {
        core::array::from_fn(|at| a * x[at])
    }
    /// A first derivative; 0 where there is none.
    #[doc(hidden)]
    #[inline(always)]
    fn partial(self, _index: usize) -> f64 {
        0.0
    }
    /// The number with an amount added to a first derivative.
    #[doc(hidden)]
    #[inline(always)]
    #[must_use]
    fn plus_partial(self, _index: usize, _change: f64) -> Self {
        self
    }
}
