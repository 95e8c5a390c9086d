//! Mechanisms with cams.
//!
//! The law is the cycloid f = u − sin(2πu)/(2π) along rise and return; f⁗ is at
//! most (2π)³ and 0 at the ends. There f‴ jumps, by (2π)². That costs nothing,
//! since the ends are points of the spline: less a cubic spline with the same
//! jumps, which interpolation reproduces, f has four continuous derivatives. So
//! the bounds of Hall and Meyer (1976) hold everywhere: with points H apart the
//! spline is within 5/384 H⁴, its slope within 1/24 H³ and its second derivative
//! within 3/8 H² of f, times max |f⁗|.

use std::f64::consts::{PI, TAU};

use mbs_runtime::NoComponents;
use models::{CamFollower, CamFollowerParameters};

use super::{EXACT, along, near};

/// Angle of the rise, and of the return.
const RISE: f64 = TAU / 3.0;
/// Points of the profile along a rise.
const POINTS: f64 = 16.0;

/// f and its derivatives by θ/[`RISE`]: rise, dwell, return and dwell.
fn law(theta: f64) -> [f64; 3] {
    let cycloid = |u: f64| [u - (TAU * u).sin() / TAU, 1.0 - (TAU * u).cos(), TAU * (TAU * u).sin()];
    match theta.rem_euclid(TAU) {
        rise if rise < RISE => cycloid(rise / RISE),
        dwell if dwell < PI => [1.0, 0.0, 0.0],
        back if back < PI + RISE => {
            let [f, slope, curvature] = cycloid((back - PI) / RISE);
            [1.0 - f, -slope, -curvature]
        }
        _ => [0.0; 3],
    }
}

/// How far the spline and its derivatives may be from [`law`].
fn bounds() -> [f64; 3] {
    let (fourth, h) = (TAU.powi(3), 1.0 / POINTS);
    [5.0 / 384.0 * h.powi(4) * fourth, h.powi(3) / 24.0 * fourth, 3.0 / 8.0 * h * h * fourth]
}

/// m(a + g) + F₀ + k s
fn force(p: &CamFollowerParameters, lift: f64, acceleration: f64) -> f64 {
    p.follower_mass * (acceleration + 9.81) + p.preload + p.stiffness * lift
}

#[test]
fn cam_follower_follows_the_law() {
    let mechanism = CamFollower::declared();
    let p = *mechanism.parameters();
    let scales = [p.stroke, p.stroke * p.omega / RISE, p.stroke * (p.omega / RISE).powi(2)];
    let [s_off, v_off, a_off] = std::array::from_fn(|i| scales[i] * bounds()[i]);
    // rounding, of lengths of 0.1 m and accelerations of 10 m/s²
    let rounding = 1e2 * EXACT;
    let per_turn = 480;
    let mut k = 0;
    along(mechanism, NoComponents::default(), TAU / p.omega, per_turn, |at| {
        let f = law(p.omega * at.t);
        let [s, v, a] = std::array::from_fn(|i| scales[i] * f[i]);
        let is_point = k % 10 == 0;
        near("lift", at.outputs.lift, s, if is_point { EXACT } else { s_off });
        near("speed", at.motion.state.v.y, v, v_off + rounding);
        near("acceleration", at.motion.acceleration.y, a, a_off + rounding);
        let contact = force(&p, s, a);
        let contact_off = p.follower_mass * a_off + p.stiffness * s_off + rounding;
        near("contact force", at.outputs.contact_force, contact, contact_off);
        // what the drive puts in goes into the follower
        let torque_off = (contact + contact_off) * v_off + contact_off * v.abs();
        near("torque", at.outputs.drive_torque, contact * v / p.omega, torque_off / p.omega + rounding);
        k += 1;
    });
    assert_eq!(k, per_turn + 1);
}

/// The force reaches 0 where ω² S|f″| m/β² is the weight and the spring's force.
/// The spline's own force is off by `off`, which shifts the speed by a share of
/// off/(2 P), P being the least that weight and spring have to give.
#[test]
fn cam_follower_lifts_off() {
    let declared = CamFollowerParameters::default();
    let inertia = declared.follower_mass * declared.stroke / RISE.powi(2);
    let squared = (0..20_000).map(|k| law(TAU * f64::from(k) / 20_000.0)).filter(|f| f[2] < 0.0);
    let squared = squared.map(|[f, _, f2]| force(&declared, declared.stroke * f, 0.0) / (-f2 * inertia));
    let omega = squared.fold(f64::INFINITY, f64::min).sqrt();
    let [lift_off, _, curvature_off] = bounds();
    let off = inertia * omega.powi(2) * curvature_off + declared.stiffness * declared.stroke * lift_off;
    let share = off / (1.9 * force(&declared, 0.0, 0.0));
    println!("lifts off at {:.1} rpm, within {:.1} %", omega * 60.0 / TAU, 100.0 * share);
    assert!(share < 0.06, "{share}");
    let least = |omega: f64| {
        let p = CamFollowerParameters { omega, ..declared };
        let mut least = f64::INFINITY;
        along(CamFollower::new(p).unwrap(), NoComponents::default(), TAU / omega, 2000, |at| {
            least = least.min(at.outputs.contact_force);
        });
        least
    };
    let (slower, faster) = (least(omega * (1.0 - share)), least(omega * (1.0 + share)));
    assert!(slower > 0.0 && faster < 0.0, "{slower} N, {faster} N");
}
