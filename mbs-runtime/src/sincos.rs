//! Sine and cosine together, of one angle or of two at once, short enough to be
//! inlined.
//!
//! Library calls for sines and cosines cost more than all the rest of a small
//! mechanism, and everything that is alive has to be saved across them. This one
//! has no branch within its range. A step waits for it from angle to angle, so its
//! chain of dependent operations is as short as its digits allow.

use core::ops::{Add, Mul, Sub};

use wide::bytemuck::cast;
use wide::{f64x2, u64x2};

use crate::Two;

/// In rad: about 10⁸ turns. An angle of this size has 7 digits behind the point. What turns
/// further is left to the library.
pub(crate) const RANGE: f64 = 1.0e9;

/// π/2 in three parts of 33 bits and less: products with |n| < 2²⁰ are exact.
const HALF_PI: [f64; 3] = [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];

/// sin r = r + r³ (S₀ + S₁ r² + …) for |r| ≤ π/4; minimax coefficients of
/// Sun's fdlibm, error below 2⁻⁵⁸.
const SINE: [f64; 6] = [
    -1.666_666_666_666_663_2e-1,
    8.333_333_333_322_49e-3,
    -1.984_126_982_985_795e-4,
    2.755_731_370_707_007e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];

/// cos r = 1 − r²/2 + r⁴ (C₀ + C₁ r² + …); likewise.
const COSINE: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// (sin x, cos x) for |x| ≤ [`RANGE`], within 2 units in the last place up to 10³
/// rad, and within 2.5 up to 10⁵ rad. Beyond, they are those of an angle within half a unit
/// in the last place of x, as near to x as any computed angle is to its true value.
#[inline(always)]
pub(crate) fn sin_cos(x: f64) -> (f64, f64) {
    reduced(x, SHIFT)
}

/// The same without a branch for all x, NaN beyond [`RANGE`]: the sum below then has
/// NaN subtracted from it, which is decided while the sum is computed.
#[inline(always)]
pub(crate) fn straight_sin_cos(x: f64) -> (f64, f64) {
    reduced(x, straight_shift(x))
}

/// The same of two angles in turns, so that a processor, which looks only some
/// operations ahead, finds two that do not wait for each other.
#[inline(always)]
pub(crate) fn straight_sin_cos_of_two(x: Two<f64>) -> (Two<f64>, Two<f64>) {
    let Two(first, second) = x;
    let shift_back = Two(straight_shift(first), straight_shift(second));
    let Octant { shifted, sine, cosine } = octant(x, shift_back, |constant| Two(constant, constant));
    let (s, c) = turned(Octant { shifted: shifted.0, sine: sine.0, cosine: cosine.0 });
    let (s_second, c_second) = turned(Octant { shifted: shifted.1, sine: sine.1, cosine: cosine.1 });
    (Two(s, s_second), Two(c, c_second))
}

#[inline(always)]
fn straight_shift(x: f64) -> f64 {
    if x.abs() <= RANGE { SHIFT } else { f64::NAN }
}

/// Adding 3·2⁵¹ leaves the nearest integer in the low bits of the mantissa.
const SHIFT: f64 = 6_755_399_441_055_744.0;

/// With n the integer nearest to 2x/π, r = x − n π/2 by Cody and Waite's
/// reduction, polynomials in r, and a quarter turn per unit of n.
#[inline(always)]
fn reduced(x: f64, shift_back: f64) -> (f64, f64) {
    turned(octant(x, shift_back, |constant| constant))
}

/// Sine and cosine of the whole angle.
#[inline(always)]
fn turned(octant: Octant<f64>) -> (f64, f64) {
    let Octant { shifted, sine, cosine } = octant;
    let quadrant = shifted.to_bits();
    let swap = quadrant & 1 == 1;
    let (s, c) = if swap { (cosine, sine) } else { (sine, cosine) };
    // The sine is negative in quadrants 2 and 3, the cosine in 1 and 2.
    let sign = |bits: u64| (bits & 2) << 62;
    let s = f64::from_bits(s.to_bits() ^ sign(quadrant));
    let c = f64::from_bits(c.to_bits() ^ sign(quadrant.wrapping_add(1)));
    (s, c)
}

/// The same of two angles at once, bit for bit.
#[inline(always)]
pub(crate) fn sin_cos_of_two(x: f64x2) -> (f64x2, f64x2) {
    both_reduced(x, f64x2::splat(SHIFT))
}

/// The same without a branch, NaN beyond [`RANGE`].
#[inline(always)]
pub(crate) fn straight_sin_cos_of_vector(x: f64x2) -> (f64x2, f64x2) {
    // All bits of a lane that is beyond are set, which is a NaN.
    let beyond = x.abs().simd_gt(f64x2::splat(RANGE));
    both_reduced(x, f64x2::splat(SHIFT) | beyond)
}

#[inline(always)]
fn both_reduced(x: f64x2, shift_back: f64x2) -> (f64x2, f64x2) {
    let Octant { shifted, sine, cosine } = octant(x, shift_back, f64x2::splat);
    let quadrant: u64x2 = cast(shifted);
    // All bits of a lane are set where its quadrant is odd.
    let swap: f64x2 = cast(u64x2::ZERO - (quadrant & u64x2::ONE));
    let sign = f64x2::splat(-0.0);
    let second_half = cast::<_, f64x2>(quadrant << 62_u32) & sign;
    let exchange = (sine ^ cosine) & swap;
    let s = (sine ^ second_half) ^ exchange;
    let c = (cosine ^ (second_half ^ (swap & sign))) ^ exchange;
    (s, c)
}

/// n in the low bits of the mantissa, and the sine and cosine of r.
struct Octant<T> {
    shifted: T,
    sine: T,
    cosine: T,
}

#[inline(always)]
fn octant<T>(x: T, shift_back: T, constant: impl Fn(f64) -> T) -> Octant<T>
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
    Octant { shifted, sine, cosine }
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

#[cfg(all(test, feature = "std"))]
mod tests {
    use wide::f64x2;

    use super::{RANGE, sin_cos, sin_cos_of_two, straight_sin_cos_of_two, straight_sin_cos_of_vector};
    use crate::Two;

    /// A unit in the last place.
    fn unit(x: f64) -> f64 {
        f64::from_bits(x.abs().to_bits() + 1) - x.abs()
    }

    /// A number in (−1, 1).
    fn random(state: &mut u64) -> f64 {
        *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// The library is within 0.6 units of the true value, so 2.6 between both
    /// holds this function to its 2.
    #[test]
    fn within_two_units_of_the_library() {
        let mut worst: f64 = 0.0;
        let mut check = |x: f64| {
            let (s, c) = sin_cos(x);
            let (sine, cosine) = x.sin_cos();
            worst = worst.max((s - sine).abs() / unit(sine)).max((c - cosine).abs() / unit(cosine));
        };
        let mut state = 1_u64;
        for at in 0..400_000 {
            let x = random(&mut state) * [1.0, 10.0, 1e3, 1e5][at % 4];
            check(x);
            // Next to multiples of π/2, where all digits but the last cancel.
            check((x * core::f64::consts::FRAC_2_PI).round() * core::f64::consts::FRAC_PI_2);
        }
        for x in [0.0, -0.0, 1e-300, f64::MIN_POSITIVE, 1e5, -1e5] {
            check(x);
        }
        assert!(worst < 2.6, "{worst}");
        assert!(sin_cos(f64::NAN).0.is_nan());
    }

    #[test]
    fn two_at_once_are_the_same_bit_for_bit() {
        let mut state = 1_u64;
        let mut angle = || {
            let unit = random(&mut state);
            // all sizes up to the range, and beside multiples of π/2
            let x = unit * RANGE * 2_f64.powi(-((state & 31) as i32));
            if state & 32 == 0 {
                x
            } else {
                (x * core::f64::consts::FRAC_2_PI).round() * core::f64::consts::FRAC_PI_2
            }
        };
        for _ in 0..100_000 {
            let x = [angle(), angle()];
            let (s, c) = sin_cos_of_two(f64x2::new(x));
            assert_eq!(straight_sin_cos_of_vector(f64x2::new(x)), (s, c), "{x:?} without a branch");
            let (Two(s_first, s_second), Two(c_first, c_second)) = straight_sin_cos_of_two(Two(x[0], x[1]));
            let in_turns = [(s_first, c_first), (s_second, c_second)];
            for (lane, x) in x.into_iter().enumerate() {
                let (sine, cosine) = sin_cos(x);
                assert_eq!(in_turns[lane], (sine, cosine), "{x} in turns");
                assert_eq!(s.to_array()[lane].to_bits(), sine.to_bits(), "sine of {x}");
                assert_eq!(c.to_array()[lane].to_bits(), cosine.to_bits(), "cosine of {x}");
            }
        }
        assert!(sin_cos_of_two(f64x2::splat(f64::NAN)).0.to_array()[1].is_nan());
        let (Two(near, far), Two(_, c_far)) = straight_sin_cos_of_two(Two(1.0, 1.1 * RANGE));
        assert!(near == sin_cos(1.0).0 && far.is_nan() && c_far.is_nan());
        let (sines, cosines) = straight_sin_cos_of_vector(f64x2::new([1.1 * RANGE, 1.0]));
        let ([far, near], [c_far, _]) = (sines.to_array(), cosines.to_array());
        assert!(near == sin_cos(1.0).0 && far.is_nan() && c_far.is_nan());
    }
}
