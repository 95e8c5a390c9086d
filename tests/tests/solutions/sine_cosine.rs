//! The sine and cosine of a lane and of the scalar against 100 bits: within 2
//! units in the last place up to 10³ rad, and 3·10⁻⁴ of a unit in the last place of the angle more
//! up to 10⁵ rad; special arguments included. Beyond, as good as the last digit of the angle; from
//! 10⁹ rad on NaN for lanes, the library's for the scalar.

#![allow(clippy::needless_range_loop, reason = "lanes are counted through several arrays")]

use mbs_runtime::{Lanes, Real, Simulation, mechanism};

/// hi + lo, of about 106 bits.
#[derive(Clone, Copy)]
struct Double {
    hi: f64,
    lo: f64,
}

impl Double {
    fn of_sum(a: f64, b: f64) -> Self {
        let hi = a + b;
        let part = hi - a;
        Self { hi, lo: (a - (hi - part)) + (b - part) }
    }
    fn plus(self, y: Self) -> Self {
        let Self { hi, lo } = Self::of_sum(self.hi, y.hi);
        Self::of_sum(hi, lo + self.lo + y.lo)
    }
    fn times(self, y: Self) -> Self {
        let hi = self.hi * y.hi;
        let lo = self.hi.mul_add(y.hi, -hi) + (self.hi * y.lo + self.lo * y.hi);
        Self::of_sum(hi, lo)
    }
    fn over(self, divisor: f64) -> Self {
        let hi = self.hi / divisor;
        let rest = (-hi).mul_add(divisor, self.hi) + self.lo;
        Self::of_sum(hi, rest / divisor)
    }
    fn negated(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

/// π/2 in units of 2⁻¹⁰⁸, and the rest in units of 2⁻²¹⁶.
const HALF_PI: [i128; 2] = [0x1921_fb54_442d_1846_9898_cc51_701b, 0x839_a252_049c_1114_cf98_e804_177d];

/// x − n π/2 and n, for |x| ≤ 10⁵: exact to 2⁻¹⁹⁸.
fn reduced(x: f64) -> (Double, i128) {
    let n = (x / std::f64::consts::FRAC_PI_2).round() as i128;
    if n == 0 {
        return (Double { hi: x, lo: 0.0 }, 0);
    }
    // |x| ≥ π/4 has no bit below 2⁻⁵³, so this is exact
    let [coarse, fine] = HALF_PI;
    let difference = (x * 2.0_f64.powi(53)) as i128 * (1 << 55) - n * coarse;
    let hi = difference as f64;
    let scale = 2.0_f64.powi(-108);
    let rest = (difference - hi as i128) as f64 - (n * fine) as f64 * scale;
    (Double::of_sum(hi * scale, rest * scale), n)
}

/// sin x and cos x by Taylor's series of the reduced angle, ends below 2⁻¹¹⁰.
fn reference(x: f64) -> (Double, Double) {
    let (r, n) = reduced(x);
    let square = r.times(r).negated();
    let (mut sine, mut cosine) = (r, Double { hi: 1.0, lo: 0.0 });
    let (mut odd, mut even) = (sine, cosine);
    for k in 1..=14 {
        let k = 2.0 * f64::from(k);
        even = even.times(square).over(k * (k - 1.0));
        odd = odd.times(square).over(k * (k + 1.0));
        (sine, cosine) = (sine.plus(odd), cosine.plus(even));
    }
    match n.rem_euclid(4) {
        0 => (sine, cosine),
        1 => (cosine, sine.negated()),
        2 => (sine.negated(), cosine.negated()),
        _ => (cosine.negated(), sine),
    }
}

/// A unit in the last place.
fn unit(x: f64) -> f64 {
    f64::from_bits(x.abs().to_bits() + 1) - x.abs()
}

/// Units in the last place, but for what the rounding of the angle explains.
fn ulps(found: f64, exact: Double, of_angle: f64) -> f64 {
    (((found - exact.hi) - exact.lo).abs() - of_angle) / unit(exact.hi)
}

/// Up to here the rounding of the angle adds nothing.
const MECHANISMS: f64 = 1e3;
/// Up to here it adds 3·10⁻⁴ of a unit in its last place.
const NEAR: f64 = 1e5;
/// Up to here lanes have numbers.
const RANGE: f64 = 1e9;

#[test]
fn lanes_and_scalars_within_their_bound() {
    let mut random = tests::random::Random::new(11);
    let mut worst = [0.0_f64; 2];
    let mut check = |x: [f64; 8]| {
        let (sines, cosines) = Lanes(x).sin_cos();
        for lane in 0..8 {
            let found = (sines.0[lane], cosines.0[lane]);
            assert_eq!(found, Real::sin_cos(x[lane]), "{}", x[lane]);
            let (sine, cosine) = reference(x[lane]);
            let is_far = x[lane].abs() > MECHANISMS;
            let of_angle = if is_far { 3e-4 * unit(x[lane]) } else { 0.0 };
            let deviation = ulps(found.0, sine, of_angle).max(ulps(found.1, cosine, of_angle));
            assert!(deviation <= 2.0, "{deviation} units at {:e}", x[lane]);
            worst[usize::from(is_far)] = worst[usize::from(is_far)].max(deviation);
        }
    };
    for _ in 0..200_000 {
        check(std::array::from_fn(|lane| {
            let x = random.between(-1.0, 1.0) * [1.0, 100.0, MECHANISMS, NEAR][lane % 4];
            // every other one beside a multiple of π/2, where most digits cancel
            let n = (x / std::f64::consts::FRAC_PI_2).round();
            if lane < 4 { x } else { (n * std::f64::consts::FRAC_PI_2).clamp(-NEAR, NEAR) }
        }));
    }
    let tiny = f64::from_bits(1);
    check([tiny, -tiny, f64::MIN_POSITIVE, 1e-310, NEAR, -NEAR, 1e-300, std::f64::consts::FRAC_PI_4]);
    println!("at most {worst:.3?} units");
    // it is no copy of the reference
    assert!(worst[0] > 0.5);
}

/// The library is within 0.6 units, and half a unit in the last place of the angle moves the
/// sine by no more than that.
#[test]
fn far_angles_within_half_their_last_digit() {
    let mut random = tests::random::Random::new(13);
    for _ in 0..50_000 {
        let x: [f64; 8] =
            std::array::from_fn(|lane| random.between(-1.0, 1.0) * [1e6, 1e7, 1e8, RANGE][lane % 4]);
        let (sines, cosines) = Lanes(x).sin_cos();
        for lane in 0..8 {
            assert_eq!((sines.0[lane], cosines.0[lane]), Real::sin_cos(x[lane]), "{}", x[lane]);
            let (sine, cosine) = x[lane].sin_cos();
            for (found, expected) in [(sines.0[lane], sine), (cosines.0[lane], cosine)] {
                let allowed = 0.5 * unit(x[lane]) + 3.0 * unit(expected);
                assert!((found - expected).abs() <= allowed, "{found} and {expected} at {}", x[lane]);
            }
        }
    }
}

#[test]
fn zeros_are_exact() {
    let (sines, cosines) = Lanes([0.0, -0.0]).sin_cos();
    // the sine of −0 is +0, which is the same number
    assert_eq!((sines.0, cosines.0), ([0.0, 0.0], [1.0, 1.0]));
}

#[test]
fn what_is_out_of_range_is_not_a_number() {
    let beyond = f64::from_bits(RANGE.to_bits() + 1);
    let x = [beyond, -beyond, 1e300, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 1.0, RANGE];
    let (sines, cosines) = Lanes(x).sin_cos();
    for (lane, (sine, cosine)) in sines.0.into_iter().zip(cosines.0).enumerate() {
        assert_eq!((sine.is_nan(), cosine.is_nan()), (lane < 6, lane < 6), "{}", x[lane]);
    }
    assert_eq!(Real::sin_cos(1e300), 1e300_f64.sin_cos());
    // a lane by itself may branch
    assert_eq!(Lanes([1e300]).sin_cos().0.0, [1e300_f64.sin()]);
}

/// The scalar's library is within 0.6 units, a rounded `f64` within 0.5.
#[test]
fn single_precision_within_a_unit_of_the_scalar() {
    let mut random = tests::random::Random::new(12);
    for _ in 0..50_000 {
        let x: [f32; 16] = std::array::from_fn(|lane| {
            (random.between(-1.0, 1.0) * [1.0, 100.0, 1e4, NEAR][lane % 4]) as f32
        });
        let (sines, cosines) = Lanes(x).sin_cos();
        for lane in 0..16 {
            let (sine, cosine) = x[lane].sin_cos();
            for (found, expected) in [(sines.0[lane], sine), (cosines.0[lane], cosine)] {
                let distance = found.to_bits().abs_diff(expected.to_bits());
                assert!(distance <= 1, "{found} and {expected} at {}", x[lane]);
            }
        }
    }
}

mechanism! {
    /// A rod on a pin.
    Rod {
        dof = 1;
        param turned = 0 [rad];
        gravity = (0, -9.81) [m/s^2];
        body rod (x, y, theta) { mass = 1 [kg]; inertia = 0.1 [kg*m^2]; }
        point top on rod = (0, 0.5) [m];
        revolute pin (ground, rod.top);
        start { theta = turned; der(theta) = 3 [rad/s]; }
    }
}

/// A fused step gives no number there, and is made in stages with the sines of the library.
#[test]
fn mechanisms_turn_on_beyond_the_range() {
    let turned = 2.0 * RANGE;
    let rod = Rod::new(RodParameters { turned }).expect("parameters");
    let mut run = Simulation::new(rod, 1e-3).expect("a start");
    run.advance_to(0.1).expect("sines of the library");
    assert!(run.state().q.theta > turned + 0.1);
    // places are as exact as the last digit of the angle
    assert!(run.violation() < unit(turned), "{}", run.violation());
}
