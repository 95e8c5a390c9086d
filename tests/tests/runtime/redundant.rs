//! Redundant constraints that fit at one instant only.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::{Error, Mechanism, Pack, Real, Simulation, mechanism, start};

mechanism! {
    /// A parallelogram with a spare link, whose ground pivot may lie anywhere.
    Spare {
        dof = 1;
        redundant = minimum_norm;
        param l = 1 [m];
        param w = 2 [m];
        param a = 0.3 [m];
        param third = 1 [m];
        param pivot_x = 0.3 [m];
        param pivot_y = 0 [m];
        param turning = 0.5 [rad/s];
        gravity = (0, -9.81) [m/s^2];
        body left  (angle = theta1) { inertia = 1 [kg*m^2]; }
        body right (angle = theta2) { inertia = 1 [kg*m^2]; }
        body spare (angle = theta3) { inertia = 1e-3 [kg*m^2]; }
        body top   (x, y, theta) { mass = 2 [kg]; inertia = 3 [kg*m^2]; }
        constraint left_x:  l*cos(theta1) = x;
        constraint left_y:  l*sin(theta1) = y;
        constraint right_x: w + l*cos(theta2) = x + w*cos(theta);
        constraint right_y: l*sin(theta2) = y + w*sin(theta);
        constraint spare_x: pivot_x + third*cos(theta3) = x + a*cos(theta);
        constraint spare_y: pivot_y + third*sin(theta3) = y + a*sin(theta);
        start {
            theta1 = -1; der(theta1) = turning;
            guess theta2 = -1; guess theta3 = -1; guess x = 0.5 [m]; guess y = -0.8 [m];
        }
    }
}

/// A third link of another length that is parallel to the others at the start: Φ = Φ̇ = 0.
fn fitting_at_the_start(third: f64, turning: f64) -> Spare {
    let (sine, cosine) = Real::sin_cos(-1.0);
    let other = 1.0 - third;
    let (pivot_x, pivot_y) = (0.3 + other * cosine, other * sine);
    Spare::new(SpareParameters { third, pivot_x, pivot_y, turning, ..Default::default() })
        .expect("parameters")
}

/// Regression: every step was `Ok`, with ‖Φ‖ up to 9e-2 m.
#[test]
fn spare_link_that_fits_at_the_first_instant_only_is_refused() {
    for third in [0.75, 0.9, 1.3] {
        let mechanism = fitting_at_the_start(third, 0.5);
        // nothing is wrong with the start itself
        let state = start::consistent(&mechanism, &mechanism.declared_start()).expect("it fits");
        assert!(mechanism.phi(0.0, &state.q).spare_y.abs() + mechanism.phi_dot(&state).spare_y.abs() < 1e-14);
        let error = Simulation::new(mechanism, 1e-3).expect_err("locked");
        assert!(
            matches!(error, Error::OutOfReach { t: 1e-3, constraint: "spare_x" | "spare_y", .. }),
            "{error:?}"
        );
    }
}

/// 1e-3 of the 2 m of the mechanism, in each of four rows that share what does not fit, and what a step adds.
const MOST: f64 = 4.2e-3;

/// At rest its accelerations fit too: gravity has to move it first.
#[test]
fn spare_link_that_locks_the_motion_ends_it() {
    for third in [0.75, 0.9, 1.3] {
        let mut run = Simulation::new(fitting_at_the_start(third, 0.0), 1e-3).expect("a start at rest");
        let mut lanes = Pack::new([run; 4]);
        let error = run.advance_to(2.0).expect_err("locked");
        assert!(matches!(error, Error::OutOfReach { .. }), "{error:?}");
        assert!(run.violation() < MOST && run.violation() > 1e-3, "{error}: {:e}", run.violation());
        while lanes.advance(100) > 0 || lanes.step() == [true; 4] {}
        assert_eq!((lanes.steps(1), lanes.simulation(1).state()), (run.steps(), run.state()));
        let mut stages = Simulation::new(fitting_at_the_start(third, 0.0), 1e-3).expect("a start at rest");
        while stages.step_in_stages().is_ok() {}
        assert_eq!(stages.state(), run.state());
        assert_eq!(run.step_with_reactions().err(), Some(error));
    }
}

/// Regression: a link that is 1e-7 m too long was carried over the flat position and
/// flipped.
#[test]
fn spare_link_that_nearly_fits_never_flips_in_silence() {
    for (third, turning) in [(1.0, 8.0), (1.0 + 1e-7, 8.0), (1.0 - 1e-7, 9.0), (1.0 + 1e-6, 10.0)] {
        let mut run = Simulation::new(fitting_at_the_start(third, turning), 1e-3).expect("a start");
        for _ in 0..5000 {
            let result = run.step();
            assert!(run.violation() < MOST, "{third}: {:e}", run.violation());
            if let Err(error) = result {
                println!("{third}: {error}");
                break;
            }
        }
    }
}

/// One that fits always is no trouble, in either precision.
#[test]
fn spare_link_that_fits_runs() {
    for turning in [0.0, 0.5, 3.0] {
        let parameters = SpareParameters { turning, ..Default::default() };
        for h in [1e-2, 1e-3, 1e-4] {
            let mut run = Simulation::new(Spare::new(parameters).expect("parameters"), h).expect("a start");
            run.advance_to(1.0).expect("a motion");
        }
        let parameters = SpareParameters::<f32> { turning: turning as f32, ..Default::default() };
        let mut run = Simulation::new(Spare::new(parameters).expect("parameters"), 1e-3).expect("a start");
        run.advance_to(1.0).expect("a motion");
    }
}
