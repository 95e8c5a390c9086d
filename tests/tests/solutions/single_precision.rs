//! The same declaration in `f32` follows the one in `f64` to single precision.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::{Components, Simulation};
use models::slider_crank::SliderCrank;
use models::slider_crank_free::SliderCrankFree;

const H: f64 = 0.5e-3;
const EPSILON: f64 = f32::EPSILON as f64;

/// Largest difference of two vectors of the same mechanism.
fn difference<A: Components<Real = f32>, B: Components<Real = f64>>(single: A, double: B) -> f64 {
    let (a, b) = (single.into_array(), double.into_array());
    a.as_ref().iter().zip(b.as_ref()).map(|(a, b)| (f64::from(*a) - b).abs()).fold(0.0, f64::max)
}

/// One turn. The feedback is deadbeat, so rounding of a step stays within two
/// steps instead of adding up: positions below 2π keep an error of a few ε·2π.
/// Velocities see the rounding of positions divided by h.
#[test]
fn driven_slider_crank_in_single_precision() {
    let mut single = Simulation::new(SliderCrank::<f32>::default(), H).expect("a start");
    let mut double = Simulation::new(SliderCrank::<f64>::default(), H).expect("a start");
    let (mut of_q, mut of_v) = (0.0_f64, 0.0_f64);
    for _ in 0..600 {
        single.step().expect("a step");
        double.step().expect("a step");
        of_q = of_q.max(difference(single.state().q, double.state().q));
        of_v = of_v.max(difference(single.state().v, double.state().v));
    }
    println!("q {:.1} ε, v {:.1} ε/h", of_q / EPSILON, of_v / EPSILON * H);
    assert!(of_q > 0.0 && of_q < 4.0 * 6.3 * EPSILON, "{of_q:e}");
    assert!(of_v < 4.0 * 6.3 * EPSILON / H, "{of_v:e}");
}

/// Without a drive errors of the angle add up: at most 600 roundings of θ1
/// and of h θ̇1, each within ε·2π.
#[test]
fn free_slider_crank_in_single_precision() {
    let mut single = Simulation::new(SliderCrankFree::<f32>::default(), H).expect("a start");
    let mut double = Simulation::new(SliderCrankFree::<f64>::default(), H).expect("a start");
    single.inputs_mut().crank_torque = 0.5;
    double.inputs_mut().crank_torque = 0.5;
    single.advance_to(0.3).expect("a motion");
    double.advance_to(0.3).expect("a motion");
    let of_q = difference(single.state().q, double.state().q);
    println!("q {:.1} ε", of_q / EPSILON);
    assert!(of_q > 0.0 && of_q < 600.0 * 6.3 * EPSILON, "{of_q:e}");
}

/// Starts are consistent to the rounding of `f32`.
#[test]
fn starts_in_single_precision() {
    let start = Simulation::new(SliderCrank::<f32>::default(), H).expect("a start");
    assert!(start.violation() <= 4.0 * f32::EPSILON, "{:e}", start.violation());
    assert!(start.velocity_violation() <= 21.0 * 4.0 * f32::EPSILON, "{:e}", start.velocity_violation());
}
