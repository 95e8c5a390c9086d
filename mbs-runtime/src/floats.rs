//! The scalars of the language: `f64` and `f32`.

use crate::partials;
use crate::real::Real;
use crate::sincos::{self, far_sin_cos_of_two, sin_cos_f64};
use crate::two::{Two, Vector};

#[inline(always)]
fn sin_cos_f32(x: f32) -> (f32, f32) {
    #[cfg(feature = "std")]
    return x.sin_cos();
    #[cfg(not(feature = "std"))]
    return libm::sincosf(x);
}

macro_rules! elementary {
    ($float:ident: $($name:ident = $portable:ident),* $(,)?) => {$(
        #[cfg(feature = "std")]
        #[inline(always)]
        fn $name(self) -> Self {
            <$float>::$name(self)
        }
        #[cfg(not(feature = "std"))]
        #[inline(always)]
        fn $name(self) -> Self {
            libm::$portable(self)
        }
    )*};
}

/// The functions that compute two scalars in a vector register: sines, partial derivatives.
macro_rules! in_pairs {
    () => {
        #[inline(always)]
        fn sin_cos_of_two(angles: [Self; 2]) -> ([Self; 2], [Self; 2]) {
            // Magnitudes are compared as integers, whose order is the same, with NaN above all. If
            // vectors were compared, LLVM would load an angle together with the number beside it in
            // memory, and a load across two stores waits for both.
            let [first, second] = angles.map(|angle| angle.abs().to_bits());
            if first.max(second) <= mbs_interface::sine::RANGE.to_bits() {
                let (sines, cosines) = sincos::sin_cos_of_two(angles.into());
                (sines.to_array(), cosines.to_array())
            } else {
                far_sin_cos_of_two(angles)
            }
        }
        #[inline(always)]
        fn combined<const N: usize>(a: Self, x: &[Self; N], b: Self, y: &[Self; N]) -> [Self; N] {
            partials::combined(a, x, b, y)
        }
        #[inline(always)]
        fn sum<const N: usize>(x: &[Self; N], y: &[Self; N]) -> [Self; N] {
            partials::sum(x, y)
        }
        #[inline(always)]
        fn difference<const N: usize>(x: &[Self; N], y: &[Self; N]) -> [Self; N] {
            partials::difference(x, y)
        }
        #[inline(always)]
        fn scaled<const N: usize>(a: Self, x: &[Self; N]) -> [Self; N] {
            partials::scaled(a, x)
        }
    };
}

macro_rules! real {
    ($float:ident, $Pair:ty, $sincos:ident, $atan2:ident, $pow:ident; $($own:ident!())?; $($elementary:tt)*) => {
        impl Real for $float {
            const ZERO: Self = 0.0;
            const EPSILON: Self = $float::EPSILON;
            type Pair = $Pair;

            #[inline(always)]
            fn from_f64(x: f64) -> Self {
                x as $float
            }
            #[inline(always)]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
            #[inline(always)]
            fn is_finite(self) -> bool {
                $float::is_finite(self)
            }
            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                $sincos(self)
            }
            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                #[cfg(feature = "std")]
                return <$float>::atan2(self, x);
                #[cfg(not(feature = "std"))]
                return libm::$atan2(self, x);
            }
            #[inline(always)]
            fn pow(self, exponent: Self) -> Self {
                #[cfg(feature = "std")]
                return <$float>::powf(self, exponent);
                #[cfg(not(feature = "std"))]
                return libm::$pow(self, exponent);
            }
            #[inline(always)]
            fn abs(self) -> Self {
                $float::abs(self)
            }
            #[inline(always)]
            fn sign(self) -> Self {
                if self > 0.0 {
                    1.0
                } else if self < 0.0 {
                    -1.0
                } else {
                    // 0 or NaN: a NaN must not disappear.
                    self
                }
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                if self < other || self.is_nan() { self } else { other }
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                if self > other || self.is_nan() { self } else { other }
            }
            #[inline(always)]
            fn greater(self, other: Self) -> Self {
                if self > other { 1.0 } else { 0.0 }
            }
            #[inline(always)]
            fn gate(self, other: Self) -> Self {
                if self == 0.0 { 0.0 } else { other }
            }
            elementary!($float: $($elementary)*);
            $($own!();)?
        }
    };
}

real!(f64, Vector, sin_cos_f64, atan2, pow; in_pairs!();
    tan = tan, asin = asin, acos = acos, atan = atan,
    sqrt = sqrt, exp = exp, ln = log, tanh = tanh);
real!(f32, Two<f32>, sin_cos_f32, atan2f, powf; ;
    tan = tanf, asin = asinf, acos = acosf, atan = atanf,
    sqrt = sqrtf, exp = expf, ln = logf, tanh = tanhf);
