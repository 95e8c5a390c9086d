//! Sine and cosine of an angle in additions and multiplications, as a formula for anything that
//! has both.
//!
//! The runtime evaluates the formula for numbers and for vectors of numbers. The compiler records
//! its operations, to order them among those of a step. So all of them have the same digits.

use core::ops::{Add, Mul, Sub};

/// In rad: about 10⁸ turns. An angle of this size has 7 digits behind the point.
pub const RANGE: f64 = 1.0e9;

/// Adding 3·2⁵¹ leaves the nearest integer in the low bits of the mantissa.
pub const SHIFT: f64 = 6_755_399_441_055_744.0;

/// π/2 in three parts of 33 bits and less: products with |n| < 2²⁰ are exact.
pub const HALF_PI: [f64; 3] =
    [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];

/// sin r = r + r³ (S₀ + S₁ r² + …) for |r| ≤ π/4; minimax coefficients of
/// Sun's fdlibm, error below 2⁻⁵⁸.
pub const SINE: [f64; 6] = [
    -1.666_666_666_666_663_2e-1,
    8.333_333_333_322_49e-3,
    -1.984_126_982_985_795e-4,
    2.755_731_370_707_007e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];

/// cos r = 1 − r²/2 + r⁴ (C₀ + C₁ r² + …); likewise.
pub const COSINE: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// What is left of an angle without its quarter turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Octant<T> {
    /// The number n of quarter turns, in the low bits of the mantissa.
    pub shifted: T,
    /// sin r, where r is the angle − n π/2.
    pub sine: T,
    /// cos r
    pub cosine: T,
}

impl<T> Octant<T> {
    /// With n the integer nearest to 2x/π, r = x − n π/2 by Cody and Waite's reduction, and
    /// polynomials in r. `shift_back` is [`SHIFT`], or NaN to have NaN.
    ///
    /// A step waits for its sines from angle to angle, so the chain of dependent operations is as
    /// short as the digits allow.
    ///
    /// # Example
    /// ```
    /// use mbs_schemes::sine::{Octant, SHIFT};
    ///
    /// let Octant { sine, cosine, .. } = Octant::new(0.5, SHIFT, |constant| constant);
    /// assert!((sine - 0.5_f64.sin()).abs() < 1e-15 && (cosine - 0.5_f64.cos()).abs() < 1e-15);
    /// ```
    #[inline(always)]
    pub fn new(x: T, shift_back: T, constant: impl Fn(f64) -> T) -> Self
    where
        T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T>,
    {
        let shifted = x * constant(core::f64::consts::FRAC_2_PI) + constant(SHIFT);
        let n = shifted - shift_back;
        let [high, middle, low] = HALF_PI;
        let near = (x - n * constant(high)) - n * constant(middle);
        let r = near - n * constant(low);

        // The last part of r, at most 10⁻¹⁶ up to 10⁵ rad, matters where r itself is that small,
        // and there r² does not.
        let z = near * near;
        let w = z * z;
        let ww = w * w;
        let [first, second, third] = pairs_of_terms(z, SINE, &constant);
        let sine = r + (r * z) * ((first + w * second) + ww * third);
        let half = constant(0.5) * z;
        let whole = constant(1.0) - half;
        let [first, second, third] = pairs_of_terms(z, COSINE, &constant);
        let rounding = (constant(1.0) - whole) - half;
        let cosine = whole + ((rounding + w * first) + ww * (second + w * third));
        Self { shifted, sine, cosine }
    }
}

/// (c₀ + c₁z), (c₂ + c₃z) and (c₄ + c₅z): with z² and z⁴ they make a polynomial by Estrin's
/// scheme, half as long a chain of operations as Horner's.
#[inline(always)]
fn pairs_of_terms<T>(z: T, coefficients: [f64; 6], constant: &impl Fn(f64) -> T) -> [T; 3]
where
    T: Copy + Add<Output = T> + Mul<Output = T>,
{
    // Not `map`: it is a call of its own where there is a lot of code already.
    let [c0, c1, c2, c3, c4, c5] = coefficients;
    [constant(c0) + z * constant(c1), constant(c2) + z * constant(c3), constant(c4) + z * constant(c5)]
}
