//! A result that is not finite is an error with its name.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::{Error, Simulation, mechanism, start};

mechanism! {
    /// A driven slider with a force that ends in no number: q̈ does not feel it.
    Driven {
        dof = 0;
        param te = 0.5 [s];
        body slider (x) { mass = 1 [kg]; }
        drive motor: x = 1 [m/s]*t;
        force push on x = 1 [N]*sqrt((te - t)/(1 [s]));
        output pull [N] = effort(motor);
        output place [m] = x;
        output root = sqrt((te - t)/(1 [s]));
    }
}

mechanism! {
    /// The same without outputs that feel it.
    Quiet {
        dof = 0;
        param te = 0.5 [s];
        body slider (x) { mass = 1 [kg]; }
        drive motor: x = 1 [m/s]*t;
        force push on x = 1 [N]*sqrt((te - t)/(1 [s]));
    }
}

/// Regression: they were `Ok` with NaN.
#[test]
fn output_that_is_no_number_is_an_error_with_its_name() {
    let mut run = Simulation::new(Driven::declared(), 1e-2).expect("a start");
    run.advance_to(0.4).expect("a motion");
    assert!(run.outputs().expect("outputs").pull.is_finite());
    // the state does not feel the force
    run.advance_to(0.6).expect("a motion");
    let undefined = |error: Error, what: &str, name: &str| match error {
        Error::Undefined { t, what: found, name: of, value } => {
            assert_eq!((found, of, value.is_nan()), (what, name, true));
            assert!((t - 0.6).abs() < 1e-12);
        }
        _ => panic!("{error:?}"),
    };
    undefined(run.reactions().expect_err("NaN"), "the multiplier of constraint", "motor");
    undefined(run.raw_reactions().expect_err("NaN"), "the multiplier of constraint", "motor");
    undefined(run.outputs().expect_err("NaN"), "the multiplier of constraint", "motor");
    let before = run.state();
    undefined(run.step_with_reactions().expect_err("NaN"), "the multiplier of constraint", "motor");
    assert_eq!(run.state(), before);

    let mut quiet = Simulation::new(Quiet::declared(), 1e-2).expect("a start");
    quiet.advance_to(0.6).expect("a motion");
    undefined(quiet.reactions().expect_err("NaN"), "the multiplier of constraint", "motor");
}

mechanism! {
    /// An output of the state alone.
    Falling {
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        body stone (y) { mass = 1 [kg]; }
        start { y = 1 [m]; }
        output height [m] = y;
        output root = sqrt(y/(1 [m]));
    }
}

#[test]
fn output_that_is_no_number_is_named() {
    let mut run = Simulation::new(Falling::declared(), 1e-3).expect("a start");
    run.advance_to(0.4).expect("a motion");
    run.outputs().expect("above the ground");
    run.advance_to(0.5).expect("a motion");
    let error = run.outputs().expect_err("below");
    assert!(matches!(error, Error::Undefined { what: "the output", name: "root", .. }), "{error:?}");
    assert!(error.to_string().contains("the output `root` is NaN at t = 0.5 s"), "{error}");
}

mechanism! {
    /// A drive that ends in no number.
    Ending {
        dof = 0;
        body slider (x) { mass = 1 [kg]; }
        drive motor: x = 1 [m]*sqrt((0.5 [s] - t)/(1 [s]));
        start { guess x = 0.7 [m]; }
    }
}

#[test]
fn drive_that_is_no_number_is_an_error() {
    let mut run = Simulation::new(Ending::declared(), 1e-2).expect("a start");
    let error = run.advance_to(0.6).expect_err("NaN");
    assert!(matches!(error, Error::Undefined { name: "x", .. }), "{error:?}");
    assert!(start::consistent(&Ending::declared(), &mbs_runtime::State { t: 0.6, ..run.state() }).is_err());
}
