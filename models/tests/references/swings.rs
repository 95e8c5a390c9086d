//! Mechanisms that move freely.

use mbs_runtime::{Mechanism, Simulation};
use models::{
    CartPendulum, CartPendulumInputs, CartPendulumParameters, DoublePendulum, DoublePendulumParameters,
    Metronome, MetronomeParameters, Pendulum, SpringMassDamper, SpringMassDamperInputs,
    SpringMassDamperParameters,
};

use crate::near;

const G: f64 = 9.81;

/// Heun's phase error in a turn is (ωh)² π/3, 2e-7 here at small angles and a
/// few times that at large ones.
#[test]
fn pendulum_has_its_period_and_tension() {
    let period = 4.0 * (1.0 / G).sqrt() * 1.854074677301372;
    let mut simulation = Simulation::new(Pendulum::declared(), period / 8192.0).unwrap();
    simulation.advance_to(period / 4.0).unwrap();
    near("tension in the lowest position", simulation.outputs().unwrap().tension, 3.0 * G, 1e-5);
    near("lowest position", simulation.state().q.x, 0.0, 2e-6);
    simulation.advance_to(period).unwrap();
    near("after a period", simulation.state().q.y, 0.0, 2e-6);
}

/// Modes at 1e-5 rad: what is not linear is smaller by some tens of the
/// amplitude's square, 1e-10. Heun's phase error as above.
#[test]
fn double_pendulum_has_its_modes() {
    const AMPLITUDE: f64 = 1e-5;
    for sign in [-1.0, 1.0] {
        let factor = 3.0 + sign * 6.0 / 7_f64.sqrt();
        let ratio = 3.0 / factor - 8.0 / 3.0;
        let parameters =
            DoublePendulumParameters { phi1: AMPLITUDE, phi2: ratio * AMPLITUDE, ..Default::default() };
        let omega_squared = factor * G / parameters.length1;
        let period = std::f64::consts::TAU / omega_squared.sqrt();
        let mechanism = DoublePendulum::new(parameters).unwrap();
        let mut simulation = Simulation::new(mechanism, period / 8192.0).unwrap();

        let a = simulation.reactions().unwrap().acceleration;
        let reference = -omega_squared * AMPLITUDE;
        near("upper", a.angle1 / reference, 1.0, 1e-8);
        near("lower", a.angle2 / reference, ratio, 1e-8);

        simulation.advance_to(period / 4.0).unwrap();
        near("upper after a quarter", simulation.state().q.angle1 / AMPLITUDE, 0.0, 1e-6);
        near("lower after a quarter", simulation.state().q.angle2 / AMPLITUDE, 0.0, 1e-6);
        simulation.advance_to(period).unwrap();
        near("upper after a period", simulation.state().q.angle1 / AMPLITUDE, 1.0, 1e-6);
        near("lower after a period", simulation.state().q.angle2 / AMPLITUDE, ratio, 1e-6);
    }
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
            .from_state(state)
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
fn damped_oscillation_is_the_closed_form() {
    const STEP: f64 = 1e-4;
    let p: SpringMassDamperParameters<f64> = SpringMassDamperParameters::default();
    let omega = (p.stiffness / p.mass).sqrt();
    let delta = p.damping / (2.0 * p.mass);
    let nu = (omega * omega - delta * delta).sqrt();
    let mut simulation = Simulation::new(SpringMassDamper::declared(), STEP).unwrap();
    for k in 1..=20 {
        let t = 0.1 * f64::from(k);
        simulation.advance_to(t).unwrap();
        let (sin, cos) = (nu * t).sin_cos();
        let reference = p.release * (-delta * t).exp() * (cos + delta / nu * sin);
        let tolerance = 1.25 * p.release * (omega * STEP).powi(2) * omega * t / 6.0;
        near("displacement", simulation.state().q.x, reference, tolerance);
    }
}

/// After 25 s the oscillation is down to exp(−25) = 1e-11.
#[test]
fn a_constant_push_is_held_by_the_spring() {
    let p: SpringMassDamperParameters<f64> = SpringMassDamperParameters::default();
    let mut simulation = Simulation::builder(SpringMassDamper::declared(), 1e-3)
        .inputs(SpringMassDamperInputs { push: 8.0 })
        .build()
        .unwrap();
    simulation.advance_to(25.0).unwrap();
    near("displacement", simulation.state().q.x, 8.0 / p.stiffness, 1e-11);
}

/// Instants to rounding; Heun's phase error in a period as above, and at 1e-4 rad
/// what is not linear is smaller by 1e-8.
#[test]
fn metronome_beats_as_its_spring_and_weight_say() {
    for release in [1e-4, 0.3, -0.5] {
        let p = MetronomeParameters::<f64> { release, ..Default::default() };
        let simulation = Simulation::new(Metronome::new(p).unwrap(), 1e-3).unwrap();
        let inertia =
            p.rod_mass * p.length.powi(2) / 3.0 + p.weight_inertia + p.weight_mass * p.height.powi(2);
        let moment = p.rod_mass * p.length / 2.0 + p.weight_mass * p.height;
        let acceleration = (G * moment * release.sin() - p.stiffness * release) / inertia;
        near("φ̈", simulation.reactions().unwrap().acceleration.phi, acceleration, 1e-12);
        let outputs = simulation.outputs().unwrap();
        near("weld", outputs.weld_torque, p.weight_inertia * acceleration, 1e-14);
        near("beat", outputs.beat, ((p.stiffness - G * moment) / inertia).sqrt(), 1e-12);
    }

    let p = MetronomeParameters { release: 1e-4, ..Default::default() };
    let mechanism = Metronome::new(p).unwrap();
    let beat = Simulation::new(mechanism, 1e-3).unwrap().outputs().unwrap().beat;
    let period = std::f64::consts::TAU / beat;
    let mut simulation = Simulation::new(mechanism, period / 8192.0).unwrap();
    simulation.advance_to(period / 4.0).unwrap();
    near("after a quarter", simulation.state().q.phi / p.release, 0.0, 1e-6);
    simulation.advance_to(period).unwrap();
    near("after a period", simulation.state().q.phi / p.release, 1.0, 1e-6);
}
