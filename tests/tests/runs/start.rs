//! A start is made consistent to rounding without touching what the
//! declaration prescribes, or kept as it was declared.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::{Components, Error, Mechanism, Simulation, State, mechanism, start};
use models::slider_crank::SliderCrank;
use models::slider_crank_free::SliderCrankFree;

const H: f64 = 0.5e-3;

/// Φ adds up to three lengths below 0.25 m: a few ε of that. Φ̇ has terms of
/// up to l1 ω ≈ 1.3 m/s, and ω = 21 in the driver's row.
const POSITION_ROUNDING: f64 = 4.0 * f64::EPSILON;
const VELOCITY_ROUNDING: f64 = 21.0 * 4.0 * f64::EPSILON;

#[test]
fn declared_start_is_made_consistent() {
    let driven = Simulation::new(SliderCrank::declared(), H).expect("a start");
    assert!(driven.violation() <= POSITION_ROUNDING, "{:e}", driven.violation());
    assert!(driven.velocity_violation() <= VELOCITY_ROUNDING, "{:e}", driven.velocity_violation());

    let free = Simulation::new(SliderCrankFree::declared(), H).expect("a start");
    let declared = SliderCrankFree::declared().declared_start();
    assert!(free.violation() <= POSITION_ROUNDING, "{:e}", free.violation());
    assert!(free.velocity_violation() <= VELOCITY_ROUNDING, "{:e}", free.velocity_violation());
    assert_eq!(free.state().q.theta1, declared.q.theta1);
    assert_eq!(free.state().v.theta1, declared.v.theta1);
    // the rod turns at −ω l1/l2 when the crank passes the dead centre
    let rod = free.state().v.theta2;
    assert!((rod + free.state().v.theta1 / 3.0).abs() <= VELOCITY_ROUNDING, "{rod}");
}

/// From every crank angle, with all other coordinates guessed from another
/// position of the same branch.
#[test]
fn prescribed_angle_is_kept_and_the_branch_too() {
    let mechanism = SliderCrankFree::declared();
    let mut guess = mechanism.declared_start();
    for k in 0..=72 {
        guess.q.theta1 = f64::from(k) * std::f64::consts::TAU / 72.0;
        guess.v.theta1 = -7.0;
        let consistent = start::consistent(&mechanism, &guess).expect("a start");
        let start = Simulation::builder(mechanism, H).from_state(consistent).build().expect("a start");
        assert_eq!(start.state(), consistent);
        let State { q, v, .. } = start.state();
        assert_eq!((q.theta1, v.theta1), (guess.q.theta1, -7.0));
        assert!(q.theta2.cos() > 0.9 && q.x3 > 0.1, "another branch: {q:?}");
        assert!(start.violation() <= POSITION_ROUNDING, "{:e} at {k}", start.violation());
        assert!(start.velocity_violation() <= VELOCITY_ROUNDING, "{:e} at {k}", start.velocity_violation());
        guess.q = q;
    }
}

#[test]
fn start_as_declared_is_kept_to_the_bit() {
    let mechanism = SliderCrank::declared();
    let declared = mechanism.declared_start();
    let start = Simulation::builder(mechanism, H).as_declared().build().expect("a start");
    assert_eq!(start.state(), declared);
    assert_eq!(declared.v.into_array().iter().filter(|v| **v != 0.0).count(), 1);
    // only the crank turns, so the crank's own middle already violates Φ̇ = 0
    let parameters = *mechanism.parameters();
    assert!(start.velocity_violation() >= parameters.l1 / 2.0 * parameters.omega);
    assert!(start.violation() <= POSITION_ROUNDING);
}

#[test]
fn start_that_is_not_finite_is_refused() {
    let mut state = SliderCrankFree::declared().declared_start();
    state.q.x3 = f64::NAN;
    for builder in [
        Simulation::builder(SliderCrankFree::declared(), H).from_state(state),
        Simulation::builder(SliderCrankFree::declared(), H).from_state(state).as_declared(),
    ] {
        let error = builder.build().expect_err("not finite");
        assert!(matches!(error, Error::NonFinite { coordinate: "x3", .. }), "{error:?}");
    }
}

mechanism! {
    /// A crank that a sine drives, which reaches the slot from t = 1 s on alone.
    pub LateStart {
        dof = 0;
        param reach = 1 [m];
        body slider (x) { mass = 1 [kg]; }
        body arm (theta) { inertia = 1 [kg*m^2]; }
        drive pull: x = 1.5 [m] - 1 [m/s]*t;
        constraint rod: x = reach*cos(theta);
        start { t = 1 [s]; guess theta = 60 [deg]; }
    }
}

/// At t = 0 the rod is too short; the declared start lies where it is not.
#[test]
fn starts_at_a_declared_time() {
    let mut run = Simulation::new(LateStart::declared(), 1e-3).expect("it is assembled at its start");
    assert_eq!(run.time(), 1.0);
    assert!((run.state().q.theta - 60_f64.to_radians()).abs() < 1e-12);
    run.advance_to(1.4).expect("it reaches");
    assert_eq!(run.steps(), 400);
    // x is known, and the feedback keeps Φ below h²
    assert!((run.state().q.theta.cos() - 0.1).abs() < 1e-6);
}
