//! Mechanisms with equations between rates.

use mbs_runtime::{Error, Simulation};
use models::{
    ChaplyginSleigh, ChaplyginSleighParameters, DifferentialDrive, DifferentialDriveInputs,
    DifferentialDriveParameters,
};
use paths::through_fused_path;

use super::{found, near, to_tolerance};

/// u, ω and φ at a time, from u = 0.
fn sleigh(p: &ChaplyginSleighParameters<f64>, t: f64) -> [f64; 3] {
    let about_edge = p.inertia + p.mass * p.behind * p.behind;
    let fastest = p.turning * (about_edge / p.mass).sqrt();
    let lambda = p.behind * p.turning * p.turning / fastest;
    let angle = 2.0 * p.turning / lambda * (0.5 * lambda * t).tanh().atan();
    [fastest * (lambda * t).tanh(), p.turning / (lambda * t).cosh(), angle]
}

/// Heun's error over 3 s is some 3e-6 of the motion with steps of 1 ms. The edge is held by feedback of its rate: it
/// slips by no more than the error of a step.
#[test]
fn chaplygin_sleigh_ends_straight() -> Result<(), Error> {
    let p: ChaplyginSleighParameters<f64> = ChaplyginSleighParameters::default();
    let start = |step| Simulation::new(ChaplyginSleigh::declared(), step);
    through_fused_path("Chaplygin's sleigh", 1e-3, start, |case, run| {
        for t in [1.0, 2.0, 3.0] {
            run.advance_to(t)?;
            let (now, [u, omega, phi]) = (run.now()?, sleigh(&p, t));
            case.near("speed", now.outputs.speed, u, 1e-5);
            case.near("turning", now.v.phi, omega, 1e-5);
            case.near("angle", now.q.phi, phi, 1e-5);
        }
        Ok(())
    })
}

/// To 1e-12 of the motion. The place of the centre of mass is the integral of its velocity u (cos φ, sin φ) +
/// a ω (−sin φ, cos φ) by Simpson's rule on 20000 parts, whose error is below 1e-14.
#[test]
fn chaplygin_sleigh_comes_where_its_velocity_leads() -> Result<(), Error> {
    let p: ChaplyginSleighParameters<f64> = ChaplyginSleighParameters::default();
    let velocity = |t: f64| {
        let [u, omega, phi] = sleigh(&p, t);
        let (s, c) = phi.sin_cos();
        [u * c - p.behind * omega * s, u * s + p.behind * omega * c]
    };
    let mut run = to_tolerance(ChaplyginSleigh::declared(), 1e-13).build()?;
    run.advance_to(3.0)?;
    let [x, y] = integral(velocity, 3.0);
    let (now, [u, omega, phi]) = (run.state(), sleigh(&p, 3.0));
    near("x", now.q.x, p.behind + x, 1e-12);
    near("y", now.q.y, y, 1e-12);
    near("angle", now.q.phi, phi, 1e-12);
    near("turning", now.v.phi, omega, 1e-12);
    let (_, outputs) = found(run.mechanism(), &now, run.inputs());
    near("speed", outputs.speed, u, 1e-12);
    Ok(())
}

/// Constant torques turn the robot into a spiral: speeds to rounding, the place to 1e-12 of the way.
#[test]
fn differential_drive_follows_a_spiral() -> Result<(), Error> {
    let p: DifferentialDriveParameters<f64> = DifferentialDriveParameters::default();
    let inputs = DifferentialDriveInputs { left_torque: 0.05, right_torque: -0.02 };
    let (r, b) = (p.radius, p.half_track);
    let ahead = (inputs.left_torque + inputs.right_torque) / r / (p.mass + 2.0 * p.wheel_inertia / (r * r));
    let around = (inputs.right_torque - inputs.left_torque) * b
        / r
        / (p.inertia + 2.0 * p.wheel_inertia * b * b / (r * r));
    let speed = |t: f64| p.speed + ahead * t;
    let angle = |t: f64| (p.turning + 0.5 * around * t) * t;
    let mut run = to_tolerance(DifferentialDrive::declared(), 1e-13).inputs(inputs).build()?;
    run.advance_to(3.0)?;
    let [x, y] = integral(|t| [speed(t) * angle(t).cos(), speed(t) * angle(t).sin()], 3.0);
    let now = run.state();
    near("x", now.q.x, x, 1e-12);
    near("y", now.q.y, y, 1e-12);
    near("angle", now.q.phi, angle(3.0), 1e-12);
    let (way, turned) = ((p.speed + 0.5 * ahead * 3.0) * 3.0, b * angle(3.0));
    near("left wheel", now.q.alpha, (way - turned) / r, 1e-11);
    near("right wheel", now.q.beta, (way + turned) / r, 1e-11);
    // m (u̇ along itself, and u φ̇ across)
    let (_, outputs) = found(run.mechanism(), &now, run.inputs());
    near("side force", outputs.side, p.mass * speed(3.0) * (p.turning + around * 3.0), 1e-11);
    Ok(())
}

/// ∫₀ᵗ f by Simpson's rule.
fn integral(f: impl Fn(f64) -> [f64; 2], t: f64) -> [f64; 2] {
    const PARTS: usize = 20_000;
    let h = t / PARTS as f64;
    let mut sum = [0.0; 2];
    for at in 0..=PARTS {
        let weight = if at == 0 || at == PARTS { 1.0 } else { 2.0 + 2.0 * (at % 2) as f64 };
        let value = f(at as f64 * h);
        sum.iter_mut().zip(value).for_each(|(sum, value)| *sum += weight * h / 3.0 * value);
    }
    sum
}
