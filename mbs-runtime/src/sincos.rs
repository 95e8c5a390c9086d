//! Sine and cosine together, of one angle or of two at once, short enough to be
//! inlined.
//!
//! Library calls for sines and cosines cost more than all the rest of a small
//! mechanism, and everything that is alive has to be saved across them. This one
//! has no branch within its range.
//!
//! It serves `f64` up to 10⁹ rad. Its chain of dependent operations is short, since steps wait for it.

use mbs_interface::sine::{Octant, RANGE, SHIFT};
use wide::bytemuck::cast;
use wide::{f64x2, u64x2};

use crate::two::Two;

/// (sin x, cos x) for |x| ≤ [`RANGE`], within 2 units in the last place up to 10³
/// rad. Up to 10⁵ rad, 3·10⁻⁴ of a unit in the last place of x are added. Beyond, they are those
/// of an angle within half a unit in the last place of x, as near to x as any computed angle is to
/// its true value.
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
pub(crate) fn straight_sin_cos_of_two([first, second]: [f64; 2]) -> ([f64; 2], [f64; 2]) {
    let shift_back = Two(straight_shift(first), straight_shift(second));
    let Octant { shifted, sine, cosine } =
        Octant::new(Two(first, second), shift_back, |constant| Two(constant, constant));
    let (s, c) = turned(Octant { shifted: shifted.0, sine: sine.0, cosine: cosine.0 });
    let (s_second, c_second) = turned(Octant { shifted: shifted.1, sine: sine.1, cosine: cosine.1 });
    ([s, s_second], [c, c_second])
}

#[inline(always)]
fn straight_shift(x: f64) -> f64 {
    if x.abs() <= RANGE { SHIFT } else { f64::NAN }
}

#[inline(always)]
fn reduced(x: f64, shift_back: f64) -> (f64, f64) {
    turned(Octant::new(x, shift_back, |constant| constant))
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
    turned_vector(Octant::new(x, f64x2::splat(SHIFT), f64x2::splat))
}

/// [`SHIFT`], and NaN where an angle is beyond [`RANGE`].
#[inline(always)]
pub(crate) fn straight_shift_of_vector(x: f64x2) -> f64x2 {
    // All bits of a lane that is beyond are set, which is a NaN.
    f64x2::splat(SHIFT) | x.abs().simd_gt(f64x2::splat(RANGE))
}

/// Sines and cosines of two whole angles.
#[inline(always)]
pub(crate) fn turned_vector(octant: Octant<f64x2>) -> (f64x2, f64x2) {
    let Octant { shifted, sine, cosine } = octant;
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

/// Sine and cosine of any angle, inlined within the range, which few mechanisms leave.
#[inline(always)]
pub(crate) fn sin_cos_f64(x: f64) -> (f64, f64) {
    if x.abs() <= RANGE { sin_cos(x) } else { far_sin_cos(x) }
}

/// The library's, for angles of more than 10⁸ turns, infinities and NaN. A
/// compiler that sees through it calls it for every angle in a loop, to choose
/// afterwards.
#[cold]
#[inline(never)]
fn far_sin_cos(x: f64) -> (f64, f64) {
    #[cfg(feature = "std")]
    return x.sin_cos();
    #[cfg(not(feature = "std"))]
    return libm::sincos(x);
}

/// Sines and cosines of two angles of which at least one is beyond the range, each as the scalar
/// does it.
#[cold]
#[inline(never)]
pub(crate) fn far_sin_cos_of_two(angles: [f64; 2]) -> ([f64; 2], [f64; 2]) {
    let [(s, c), (sine, cosine)] = angles.map(sin_cos_f64);
    ([s, sine], [c, cosine])
}

#[cfg(all(test, feature = "std"))]
mod tests {
    use mbs_interface::sine::{Octant, RANGE};
    use wide::f64x2;

    use super::{sin_cos, sin_cos_of_two, straight_shift_of_vector, straight_sin_cos_of_two, turned_vector};

    /// As fused steps compute them.
    fn straight_sin_cos_of_vector(x: f64x2) -> (f64x2, f64x2) {
        turned_vector(Octant::new(x, straight_shift_of_vector(x), f64x2::splat))
    }

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
            let of_angle = if x.abs() <= 1e3 { 0.0 } else { 3e-4 * unit(x) };
            for (found, expected) in [(s, sine), (c, cosine)] {
                worst = worst.max(((found - expected).abs() - of_angle) / unit(expected));
            }
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
            let ([s_first, s_second], [c_first, c_second]) = straight_sin_cos_of_two(x);
            let in_turns = [(s_first, c_first), (s_second, c_second)];
            for (lane, x) in x.into_iter().enumerate() {
                let (sine, cosine) = sin_cos(x);
                assert_eq!(in_turns[lane], (sine, cosine), "{x} in turns");
                assert_eq!(s.to_array()[lane].to_bits(), sine.to_bits(), "sine of {x}");
                assert_eq!(c.to_array()[lane].to_bits(), cosine.to_bits(), "cosine of {x}");
            }
        }
        assert!(sin_cos_of_two(f64x2::splat(f64::NAN)).0.to_array()[1].is_nan());
        let ([near, far], [_, c_far]) = straight_sin_cos_of_two([1.0, 1.1 * RANGE]);
        assert!(near == sin_cos(1.0).0 && far.is_nan() && c_far.is_nan());
        let (sines, cosines) = straight_sin_cos_of_vector(f64x2::new([1.1 * RANGE, 1.0]));
        let ([far, near], [c_far, _]) = (sines.to_array(), cosines.to_array());
        assert!(near == sin_cos(1.0).0 && far.is_nan() && c_far.is_nan());
    }

    #[test]
    fn two_at_once_may_be_beyond_the_range() {
        use crate::Real;

        let (far, none) = (2.0 * RANGE, f64::NAN);
        for x in [[1.0, far], [-far, 1.0], [far, 3.0 * far], [f64::INFINITY, 1.0], [none, 1.0]] {
            let (sines, cosines) = Real::sin_cos_of_two(x);
            for (lane, x) in x.into_iter().enumerate() {
                let (sine, cosine) = Real::sin_cos(x);
                let is_same = [sines[lane], cosines[lane]] == [sine, cosine];
                assert!(is_same || (sine.is_nan() && sines[lane].is_nan()), "{x}");
            }
        }
    }
}
