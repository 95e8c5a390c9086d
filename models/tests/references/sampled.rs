//! Mechanisms with sampled controllers, against plants and controllers that are written out here.

use mbs_runtime::{Error, Simulation};
use models::{CartPole, CartPoleParameters, PathFollower, PathFollowerParameters};
use paths::through_fused_path;

use super::{near, to_tolerance};

/// The step of the references in s: their error, h⁴ times the fifth power of rates of 10/s, is below 1e-13.
const STEP: f64 = 5e-5;

/// One step of Runge and Kutta's method.
fn rk4<const N: usize>(y: &mut [f64; N], slope: impl Fn(&[f64; N]) -> [f64; N]) {
    let moved = |by: f64, k: &[f64; N]| std::array::from_fn(|at| y[at] + by * STEP * k[at]);
    let a = slope(y);
    let b = slope(&moved(0.5, &a));
    let c = slope(&moved(0.5, &b));
    let d = slope(&moved(1.0, &c));
    *y = std::array::from_fn(|at| y[at] + STEP / 6.0 * (a[at] + 2.0 * b[at] + 2.0 * c[at] + d[at]));
}

/// x, θ and their rates, and the force from then on, at every sample up to some seconds.
fn cart_pole(p: &CartPoleParameters<f64>, end: f64) -> Vec<[f64; 5]> {
    let (s, total, m) = (0.5 * p.length, p.cart_mass + p.rod_mass, p.rod_mass);
    let about_pivot = m * p.length * p.length / 3.0;
    let mut y = [0.0, p.tilt, 0.0, 0.0];
    let (mut place, mut angle, mut speed, mut turning) = (-0.5, 0.0, 0.0, 0.0);
    let mut samples = Vec::new();
    for _ in 0..=(end / 0.01).round() as u32 {
        let u = 12.960759 * place - 61.29563 * angle + 12.044296 * speed - 11.976865 * turning;
        samples.push([y[0], y[1], y[2], y[3], u]);
        let (ahead, beyond) = (y[0] - p.target - place, y[1] - angle);
        let [was_place, was_angle, was_speed, was_turning] = [place, angle, speed, turning];
        place = was_place
            + 0.000102688 * was_angle
            + 0.01 * was_speed
            + 0.000000342 * was_turning
            + 0.000046514 * u
            + 0.241178419 * ahead
            + 0.177532589 * beyond;
        speed = was_speed
            + 0.020542709 * was_angle
            + 0.000102688 * was_turning
            + 0.009303122 * u
            + 3.249728897 * ahead
            + 5.737302444 * beyond;
        angle = 1.001483274 * was_angle
            + 0.010004944 * was_turning
            + 0.000116308 * u
            + 0.178469459 * ahead
            + 0.618052494 * beyond;
        turning = 1.001483274 * was_turning
            + 0.296728018 * was_angle
            + 0.023267311 * u
            + 5.848756777 * ahead
            + 15.589419974 * beyond;
        for _ in 0..200 {
            rk4(&mut y, |[_, theta, v, omega]| {
                let (sin, cos) = theta.sin_cos();
                // (M + m) ẍ − m s cos θ θ̈ = f,  J θ̈ − m s cos θ ẍ = g
                let (f, g) = (u - m * s * sin * omega * omega, m * 9.81 * s * sin);
                let determinant = total * about_pivot - (m * s * cos).powi(2);
                let a = (about_pivot * f + m * s * cos * g) / determinant;
                let alpha = (m * s * cos * f + total * g) / determinant;
                [*v, *omega, a, alpha]
            });
        }
    }
    samples
}

/// At samples. Heun's error is 4.3e-7 rad at 1 s with steps of 0.5 ms; it falls by four with half the step.
#[test]
fn cart_pole_is_balanced() -> Result<(), Error> {
    let p = CartPoleParameters::default();
    let samples = cart_pole(&p, 2.0);
    let start = |step| Simulation::new(CartPole::declared(), step);
    through_fused_path("cart-pole", 5e-4, start, |case, run| {
        for at in [50, 100, 200] {
            run.advance_to(0.01 * f64::from(at))?;
            let (now, [x, theta, _, _, u]) = (run.now()?, samples[at as usize]);
            case.near("x", now.q.x, x, 1e-6);
            case.near("theta", now.q.theta, theta, 1e-6);
            case.near("force", now.outputs.force, u, 5e-5);
        }
        Ok(())
    })
}

/// Steps end at samples. Of 100 intervals, each is off by the tolerance of 1e-13 of some ten steps; the loop forgets in
/// half a second what came before.
#[test]
fn cart_pole_to_a_tolerance() -> Result<(), Error> {
    let p = CartPoleParameters::default();
    let mut run = to_tolerance(CartPole::declared(), 1e-13).build()?;
    for (at, [x, theta, v, omega, u]) in cart_pole(&p, 2.0).into_iter().enumerate() {
        run.advance_to(0.01 * at as f64)?;
        let now = run.state();
        near("x", now.q.x, x, 1e-11);
        near("theta", now.q.theta, theta, 1e-11);
        near("speed", now.v.x, v, 1e-11);
        near("turning", now.v.theta, omega, 1e-10);
        near("force", run.inputs().push, u, 1e-9);
    }
    Ok(())
}

/// x, y, φ, u, ω and both torques from then on, at every sample of the speeds.
fn path_follower(p: &PathFollowerParameters<f64>, end: f64) -> Vec<[f64; 7]> {
    let (r, b) = (p.radius, p.half_track);
    let along = p.mass + 2.0 * p.wheel_inertia / (r * r);
    let around = p.inertia + 2.0 * p.wheel_inertia * b * b / (r * r);
    let mut y = [0.0, p.beside, 0.0, p.rolling, 0.0];
    let (mut wanted, mut lag, mut torque) = ([0.0; 2], [0.0; 2], [0.0_f64; 2]);
    let mut samples = Vec::new();
    for sample in 0..=(end / p.fast).round() as u32 {
        let t = f64::from(sample) * p.fast;
        let [x, y_now, phi, u, omega] = y;
        let wheels = [(u - b * omega) / r, (u + b * omega) / r];
        if sample % 10 == 0 {
            let turned = p.speed / p.circle * t;
            let (dx, dy) = (p.circle * turned.sin() - x, p.circle * (1.0 - turned.cos()) - y_now);
            let (sin, cos) = phi.sin_cos();
            let (behind, right, off) = (dx * cos + dy * sin, dy * cos - dx * sin, turned - phi);
            let ahead = p.speed * off.cos() + 2.0 * behind;
            let turning = p.speed / p.circle + p.speed * (6.0 * right + 3.0 * off.sin());
            wanted = [(ahead - b * turning) / r, (ahead + b * turning) / r];
        }
        for side in 0..2 {
            let off = wanted[side] - wheels[side];
            if torque[side].abs() < 1.0 {
                lag[side] += p.fast * off;
            }
            torque[side] = (p.stiffness * off + p.integral * lag[side]).clamp(-1.0, 1.0);
        }
        samples.push([x, y_now, phi, u, omega, torque[0], torque[1]]);
        for _ in 0..40 {
            rk4(&mut y, |[_, _, phi, u, omega]| {
                let [left, right] = torque;
                let (a, alpha) = ((left + right) / r / along, (right - left) * b / r / around);
                [u * phi.cos(), u * phi.sin(), *omega, a, alpha]
            });
        }
    }
    samples
}

/// To 1e-11 m after 3 s, with both clocks: at the samples of the slow one the fast one acts behind it.
#[test]
fn path_follower_comes_to_its_circle() -> Result<(), Error> {
    let p = PathFollowerParameters::default();
    let mut run = to_tolerance(PathFollower::declared(), 1e-13).build()?;
    for (at, [x, y, phi, u, omega, left, right]) in path_follower(&p, 3.0).into_iter().enumerate() {
        run.advance_to(0.002 * at as f64)?;
        let now = run.state();
        near("x", now.q.x, x, 1e-11);
        near("y", now.q.y, y, 1e-11);
        near("phi", now.q.phi, phi, 1e-11);
        near("u", now.v.x * phi.cos() + now.v.y * phi.sin(), u, 1e-10);
        near("omega", now.v.phi, omega, 1e-10);
        near("left torque", run.inputs().left_torque, left, 1e-9);
        near("right torque", run.inputs().right_torque, right, 1e-9);
    }
    run.advance_to(12.0)?;
    let now = run.state().q;
    near("the circle", now.x.hypot(now.y - p.circle), p.circle, 1e-4);
    Ok(())
}

/// A clock that no number of steps meets.
#[test]
fn steps_have_to_meet_the_clocks() {
    let refused = Simulation::new(PathFollower::declared(), 3e-4).err().unwrap();
    assert_eq!(
        refused.to_string(),
        "the clock of `left_wanted` samples every 0.02 s, and no whole number of steps of 0.0003 s leads there; take steps \
         of 0.00028571428571428574 s, or a run to a tolerance, whose steps end at samples"
    );
    // the samples of two clocks, the times of which are multiples of nothing
    let apart = PathFollowerParameters { fast: 1e-3 * std::f64::consts::PI, ..Default::default() };
    let refused = Simulation::new(PathFollower::new(apart).unwrap(), 2.5e-4).err().unwrap();
    assert!(
        refused.to_string().ends_with("no constant step leads to the samples of all clocks: take a run to a tolerance, whose steps end at samples"),
        "{refused}"
    );
    let other = PathFollowerParameters { fast: 3e-3, slow: 15e-3, ..Default::default() };
    assert!(Simulation::new(PathFollower::new(other).unwrap(), 3e-4).is_ok());
}
