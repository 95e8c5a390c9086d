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

/// sin r = r + r³ (S₀ + S₁ r² + S₂ q⁴ + S₃ q⁶ + …) for |r| ≤ π/4, where q = 2r/π: minimax
/// coefficients of Sun's fdlibm, error below 2⁻⁵⁸, of which those of qᵏ are times (π/2)ᵏ.
pub const SINE: [f64; 6] = [
    -1.666_666_666_666_663_2e-1,
    8.333_333_333_322_49e-3,
    -1.207_950_036_929_274_5e-3,
    4.139_578_687_803_403e-5,
    -9.284_957_642_210_898e-7,
    1.453_822_829_998_758_8e-8,
];

/// cos r = 1 − r²/2 + r⁴ (C₀ + C₁ r² + C₂ q⁴ + …); likewise.
pub const COSINE: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    1.509_937_546_292_747_7e-4,
    -4.139_578_784_591_348e-6,
    7.737_497_937_081_319e-8,
    -1.038_875_794_729_804_2e-9,
];

/// The quarter turns of an angle, with sine and cosine of the rest.
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
    /// short as the digits allow. Terms of the polynomials from r⁷ and r⁸ on are computed from
    /// q = 2x/π − n while r is still waited for. As 2/π and its product with x are rounded, π/2 q
    /// is off by no more than 1.6 units in the last place of x. The slope of these terms is
    /// 1.9·10⁻⁴ at most, so the sine is off by 3·10⁻⁴ of such a unit: a third of a unit in the last
    /// place of the sine at 10³ rad, 20 of them at 10⁵ rad.
    ///
    /// # Example
    /// ```
    /// use mbs_interface::sine::{Octant, SHIFT};
    ///
    /// let Octant { sine, cosine, .. } = Octant::new(0.5, SHIFT, |constant| constant);
    /// assert!((sine - 0.5_f64.sin()).abs() < 1e-15 && (cosine - 0.5_f64.cos()).abs() < 1e-15);
    /// ```
    #[inline(always)]
    pub fn new(x: T, shift_back: T, constant: impl Fn(f64) -> T) -> Self
    where
        T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T>,
    {
        let turns = x * constant(core::f64::consts::FRAC_2_PI);
        let shifted = turns + constant(SHIFT);
        let n = shifted - shift_back;
        let [high, middle, low] = HALF_PI;
        let near = (x - n * constant(high)) - n * constant(middle);
        let r = near - n * constant(low);
        let q = turns - n;

        // The last part of r, at most 10⁻¹⁶ up to 10⁵ rad, matters where r itself is that small,
        // and there r² does not.
        let z = near * near;
        let qq = q * q;
        let w = qq * qq;
        let ww = w * w;
        let [first, second, third] = pairs_of_terms(z, qq, SINE, &constant);
        let sine = r + (r * z) * (first + (w * second + ww * third));
        let [first, second, third] = pairs_of_terms(z, qq, COSINE, &constant);
        // The difference is below 1/3: its rounding is a quarter unit in the last place of the cosine.
        let less = constant(0.5) * z - (z * z) * (first + (w * second + ww * third));
        let cosine = constant(1.0) - less;
        Self { shifted, sine, cosine }
    }
}

/// (c₀ + c₁z), (c₂ + c₃y) and (c₄ + c₅y): with y² and y⁴ they make a polynomial by Estrin's
/// scheme, half as long a chain of operations as Horner's.
#[inline(always)]
fn pairs_of_terms<T>(z: T, y: T, coefficients: [f64; 6], constant: &impl Fn(f64) -> T) -> [T; 3]
where
    T: Copy + Add<Output = T> + Mul<Output = T>,
{
    // Not `map`: it is a call of its own where there is a lot of code already.
    let [c0, c1, c2, c3, c4, c5] = coefficients;
    [constant(c0) + z * constant(c1), constant(c2) + y * constant(c3), constant(c4) + y * constant(c5)]
}
