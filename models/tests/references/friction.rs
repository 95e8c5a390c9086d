//! Mechanisms with dry friction.
//!
//! With s = sin α, c = μ cos α and w the transition speed, a block on an incline
//! has v̇ = −g(s + c tanh(v/w)). Coulomb's friction is that with w = 0.

use std::f64::consts::PI;

use mbs_runtime::Simulation;
use models::{BlockOnIncline, BlockOnInclineParameters};

use crate::{EXACT, near};

const G: f64 = 9.81;
const STEP: f64 = 1e-5;

fn block(speed: f64, coefficient: f64) -> (Simulation<BlockOnIncline>, [f64; 3]) {
    let p = BlockOnInclineParameters { speed, coefficient, ..Default::default() };
    let simulation = Simulation::new(BlockOnIncline::new(p).unwrap(), STEP).unwrap();
    (simulation, [p.slope.sin(), coefficient * p.slope.cos(), p.transition])
}

/// What Heun's method errs by in the speed, once through the transition.
///
/// Its error per step is h³(F′²F/6 − F″F²/12) for v̇ = F; with z = g c h/w that is
/// below 0.6 w z³ for s < 2c, and the transition takes some 2/z steps.
fn heun([_, c, w]: [f64; 3]) -> f64 {
    2.0 * w * (G * c * STEP / w).powi(2)
}

/// From rest: g t = ∫ dv/(s − c tanh(v/w)) = (s v + c w ln(cosh(v/w) − c/s sinh(v/w)))/(s² − c²),
/// and so v = (s − c) g t + c w ln(2s/(s − c))/(s + c) beyond the transition.
#[test]
fn block_slides_down() {
    let (mut simulation, law) = block(0.0, 0.3);
    let [s, c, w] = law;
    simulation.advance_to(1.0).unwrap();
    let reactions = simulation.reactions().unwrap();
    let outputs = simulation.outputs().unwrap();
    let p = *simulation.mechanism().parameters();
    near("acceleration", reactions.acceleration.x, -G * (s - c) * p.slope.cos(), 10.0 * EXACT);
    near("normal", outputs.normal, p.mass * G * p.slope.cos(), 1e2 * EXACT);
    near("friction", outputs.friction, p.mass * G * c, 1e2 * EXACT);
    let late = c * w * (2.0 * s / (s - c)).ln() / (s + c);
    assert!(late > 100.0 * heun(law), "the smooth law shows");
    near("speed", -outputs.rate, (s - c) * G + late, heun(law));
}

/// Smooth friction brakes less at the end: Coulomb's distance v₀²/(2g(s + c)) is
/// passed by ∫ v c (1 − tanh(v/w))/((s + c tanh(v/w))(s + c)g) dv, at most
/// c w² π²/(24 s (s + c) g).
#[test]
fn block_climbs_as_far_as_it_can() {
    let speed = 2.0;
    let (mut simulation, law) = block(speed, 0.3);
    let [s, c, w] = law;
    let mut highest = 0.0_f64;
    while simulation.state().v.x > 0.0 {
        simulation.step().unwrap();
        highest = highest.max(simulation.outputs().unwrap().distance);
    }
    let coulomb = speed * speed / (2.0 * G * (s + c));
    let further = c * w * w * PI * PI / (24.0 * s * (s + c) * G);
    // the error in speed while it is below 3 w, and half a step to the highest point
    let tolerance = heun(law) * 3.0 * w / (G * s) + G * (s + c) * STEP * STEP / 8.0;
    let passed = highest - coulomb;
    println!("passes Coulomb's distance by {passed:e} m of {further:e} m at most");
    assert!(-tolerance <= passed && passed <= further + tolerance, "{passed:e}, {further:e} ± {tolerance:e}");
}

/// Stuck, it creeps with tanh(v/w) = tan α/μ. The speed settles with the time
/// constant w/(g c (1 − tan²α/μ²)), 0.3 ms; what is left is what the feedback
/// takes out in a step of the rounding of the position.
#[test]
fn block_stays_but_for_its_creep() {
    let (mut simulation, [s, c, w]) = block(0.5, 0.8);
    simulation.advance_to(0.2).unwrap();
    let outputs = simulation.outputs().unwrap();
    let rounding = 10.0 * f64::EPSILON * outputs.distance / STEP;
    near("creep", -outputs.rate, w * (s / c).atanh(), rounding);
    let stopped = 0.5 * 0.5 / (2.0 * G * (s + c));
    assert!((outputs.distance - stopped).abs() < 0.2 * w, "within the creep of 0.2 s");
}
