//! Mechanisms that move freely.

use mbs_runtime::{Error, Mechanism, Simulation, start};
use models::{
    CartPendulum, CartPendulumInputs, CartPendulumParameters, DoublePendulum, DoublePendulumParameters,
    Metronome, MetronomeParameters, Pendulum, SpringMassDamper, SpringMassDamperInputs,
    SpringMassDamperParameters, Suspension, SuspensionParameters,
};
use paths::through_fused_path;

use super::{EXACT, near};

const G: f64 = 9.81;

/// Heun's phase error in a turn is (ωh)² π/3, 2e-7 here at small angles and a
/// few times that at large ones.
#[test]
fn pendulum_has_its_period_and_tension() -> Result<(), Error> {
    let period = 4.0 * (1.0 / G).sqrt() * 1.854074677301372;
    let start = |step| Simulation::new(Pendulum::declared(), step);
    through_fused_path("pendulum", period / 8192.0, start, |case, run| {
        run.advance_to(period / 4.0)?;
        let lowest = run.now()?;
        case.near("tension in the lowest position", lowest.outputs.tension, 3.0 * G, 1e-5);
        case.near("lowest position", lowest.q.x, 0.0, 2e-6);
        run.advance_to(period)?;
        case.near("after a period", run.now()?.q.y, 0.0, 2e-6);
        Ok(())
    })
}

/// Modes at 1e-5 rad: what is not linear is smaller by some tens of the
/// amplitude's square, 1e-10. Heun's phase error as above.
#[test]
fn double_pendulum_has_its_modes() -> Result<(), Error> {
    const AMPLITUDE: f64 = 1e-5;
    for sign in [-1.0, 1.0] {
        let factor = 3.0 + sign * 6.0 / 7_f64.sqrt();
        let ratio = 3.0 / factor - 8.0 / 3.0;
        let parameters =
            DoublePendulumParameters { phi1: AMPLITUDE, phi2: ratio * AMPLITUDE, ..Default::default() };
        let omega_squared = factor * G / parameters.length1;
        let period = std::f64::consts::TAU / omega_squared.sqrt();
        let start = |step| Simulation::new(DoublePendulum::new(parameters)?, step);
        through_fused_path("double pendulum", period / 8192.0, start, |case, run| {
            let a = run.now()?.acceleration;
            let reference = -omega_squared * AMPLITUDE;
            case.near("upper", a.angle1 / reference, 1.0, 1e-8);
            case.near("lower", a.angle2 / reference, ratio, 1e-8);

            run.advance_to(period / 4.0)?;
            let q = run.now()?.q;
            case.near("upper after a quarter", q.angle1 / AMPLITUDE, 0.0, 1e-6);
            case.near("lower after a quarter", q.angle2 / AMPLITUDE, 0.0, 1e-6);
            run.advance_to(period)?;
            let q = run.now()?.q;
            case.near("upper after a period", q.angle1 / AMPLITUDE, 1.0, 1e-6);
            case.near("lower after a period", q.angle2 / AMPLITUDE, ratio, 1e-6);
            Ok(())
        })?;
    }
    Ok(())
}

/// At single states, so to rounding.
#[test]
fn cart_pendulum_accelerates_as_lagrange_says() {
    let p: CartPendulumParameters<f64> = CartPendulumParameters::default();
    let mechanism = CartPendulum::declared();
    for (theta, rate, push) in [(0.1, 0.0, 0.0), (0.7, -2.0, 3.0), (2.5, 4.0, -6.0), (-1.6, 1.0, 2.0)] {
        let mut state = mechanism.declared_start();
        (state.q.theta, state.v.theta, state.v.x) = (theta, rate, 0.3);
        let pushed = Simulation::builder(mechanism, 1e-3)
            .from_state(start::consistent(&mechanism, &state).unwrap())
            .inputs(CartPendulumInputs { push })
            .build()
            .unwrap();
        let a = pushed.reactions().unwrap().acceleration;

        let s = p.length / 2.0;
        let (sin, cos) = theta.sin_cos();
        let (m11, m12) = (p.cart_mass + p.rod_mass, -p.rod_mass * s * cos);
        let m22 = p.rod_mass * s * s * (1.0 + 1.0 / 3.0);
        let (f1, f2) = (push - p.rod_mass * s * sin * rate * rate, p.rod_mass * G * s * sin);
        let determinant = m11 * m22 - m12 * m12;
        near("cart", a.x, (m22 * f1 - m12 * f2) / determinant, 1e-12);
        near("rod", a.theta, (m11 * f2 - m12 * f1) / determinant, 1e-12);
    }
}

/// Heun's error after the time t is x₀ (ωh)² ωt/6 without damping, and damping
/// takes from it; a quarter more for the next order.
#[test]
fn damped_oscillation_is_the_closed_form() -> Result<(), Error> {
    const STEP: f64 = 1e-4;
    let p: SpringMassDamperParameters<f64> = SpringMassDamperParameters::default();
    let omega = (p.stiffness / p.mass).sqrt();
    let delta = p.damping / (2.0 * p.mass);
    let nu = (omega * omega - delta * delta).sqrt();
    let start = |step| Simulation::new(SpringMassDamper::declared(), step);
    through_fused_path("damped oscillation", STEP, start, |case, run| {
        for k in 1..=20 {
            let t = 0.1 * f64::from(k);
            run.advance_to(t)?;
            let (sin, cos) = (nu * t).sin_cos();
            let reference = p.release * (-delta * t).exp() * (cos + delta / nu * sin);
            let tolerance = 1.25 * p.release * (omega * STEP).powi(2) * omega * t / 6.0;
            case.near("displacement", run.now()?.q.x, reference, tolerance);
        }
        Ok(())
    })
}

/// After 40 s the oscillation is down to exp(−40) = 4e-18; what is left is rounding.
#[test]
fn a_constant_push_is_held_by_the_spring() -> Result<(), Error> {
    let p: SpringMassDamperParameters<f64> = SpringMassDamperParameters::default();
    let push = SpringMassDamperInputs { push: 8.0 };
    let start = |step| Simulation::builder(SpringMassDamper::declared(), step).inputs(push).build();
    through_fused_path("constant push", 1e-3, start, |case, run| {
        run.advance_to(40.0)?;
        let displacement = push.push / p.stiffness;
        case.near("displacement", run.now()?.q.x, displacement, displacement * EXACT);
        Ok(())
    })
}

/// Instants to rounding; Heun's phase error in a period as above, and at 1e-4 rad
/// what is not linear is smaller by 1e-8.
#[test]
fn metronome_beats_as_its_spring_and_weight_say() -> Result<(), Error> {
    for release in [1e-4, 0.3, -0.5] {
        let p = MetronomeParameters::<f64> { release, ..Default::default() };
        let simulation = Simulation::new(Metronome::new(p)?, 1e-3)?;
        let inertia =
            p.rod_mass * p.length.powi(2) / 3.0 + p.weight_inertia + p.weight_mass * p.height.powi(2);
        let moment = p.rod_mass * p.length / 2.0 + p.weight_mass * p.height;
        let acceleration = (G * moment * release.sin() - p.stiffness * release) / inertia;
        near("φ̈", simulation.reactions()?.acceleration.phi, acceleration, 1e-12);
        let outputs = simulation.outputs()?;
        near("weld", outputs.weld_torque, p.weight_inertia * acceleration, 1e-14);
        near("beat", outputs.beat, ((p.stiffness - G * moment) / inertia).sqrt(), 1e-12);
    }

    let p = MetronomeParameters { release: 1e-4, ..Default::default() };
    let start = |step| Simulation::new(Metronome::new(p)?, step);
    let period = std::f64::consts::TAU / start(1e-3)?.outputs()?.beat;
    through_fused_path("metronome", period / 8192.0, start, |case, run| {
        run.advance_to(period / 4.0)?;
        case.near("after a quarter", run.now()?.q.phi / p.release, 0.0, 1e-6);
        run.advance_to(period)?;
        case.near("after a period", run.now()?.q.phi / p.release, 1.0, 1e-6);
        Ok(())
    })
}

/// Between two points of a table, as they stand in the file.
fn interpolated(points: &[(f64, f64)], x: f64) -> f64 {
    let piece = points.windows(2).rfind(|pair| pair[0].0 <= x).unwrap_or(&points[..2]);
    let [(x0, y0), (x1, y1)] = [piece[0], piece[1]];
    y0 + (y1 - y0) / (x1 - x0) * (x - x0)
}

/// It rests until the bump, which is a parabola: 4u(1 − u) behind the first metre. On it and behind it the accelerations
/// are those of the equations by hand, with forces of 20 kN and their roundings.
#[test]
fn suspension_rests_and_meets_a_bump() -> Result<(), Error> {
    let p: SuspensionParameters<f64> = SuspensionParameters::default();
    let mut run = Simulation::new(Suspension::declared(), 0.5e-3)?;
    let length = 0.25 + (5200.0 - p.chassis_mass * G) / 20e3;
    near("strut at rest", run.outputs()?.strut_length, length, EXACT);
    near("load at rest", run.outputs()?.wheel_load, (p.chassis_mass + p.wheel_mass) * G, 1e-11);
    let start = run.state();
    run.advance_to(0.0995)?;
    near("chassis before the bump", run.state().q.y_c, start.q.y_c, 1e-12);
    let spring = [(0.2, 12e3), (0.25, 5.2e3), (0.5, 0.2e3), (0.52, -2e3)];
    let damper = [(-2.0, -0.9e3), (-0.1, -0.12e3), (0.1, 0.12e3), (2.0, 2.7e3)];
    let mut shortest = length;
    for t in [0.11, 0.13, 0.15, 0.17, 0.19, 0.21, 0.3, 0.5, 1.0] {
        run.advance_to(t)?;
        let (at, u) = (run.state(), p.speed * run.time() - 1.0);
        let (q, v) = (at.q, at.v);
        let road = if u < 1.0 { p.bump * 4.0 * u * (1.0 - u) } else { 0.0 };
        let tension = interpolated(&damper, v.y_c - v.y_w) - interpolated(&spring, q.y_c - q.y_w);
        let tyre = p.tyre_stiffness * (road - q.y_w).max(0.0);
        let found = run.reactions()?.acceleration;
        near("chassis", found.y_c, -tension / p.chassis_mass - G, 1e-10);
        near("wheel", found.y_w, (tension + tyre) / p.wheel_mass - G, 1e-9);
        near("force", run.outputs()?.strut_force, tension, 1e-8);
        shortest = shortest.min(q.y_c - q.y_w);
    }
    // it comes to the soft part of the table and swings out
    near("chassis behind the bump", run.state().q.y_c, start.q.y_c, 0.01);
    assert!((0.2..length - 0.02).contains(&shortest), "{shortest}");
    Ok(())
}
