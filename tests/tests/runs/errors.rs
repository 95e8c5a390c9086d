//! Every error of the runtime can be provoked, says which thing of the
//! declaration it is about, and leaves the last good state behind.
#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

use mbs_live::Text;
use mbs_runtime::{
    Baumgarte, Components, Error, Held, Kinematics, Mechanism, PerStage, Projected, Simulation, State,
    mechanism, start,
};
use models::slider_crank::{SliderCrank, SliderCrankParameters};
use models::slider_crank_free::{SliderCrankFree, SliderCrankFreeInputs};

const H: f64 = 0.5e-3;

mechanism! {
    /// A bead on a circle; the radius may be given as 0 or less.
    Bead {
        dof = 1;
        param square = 1 [m^2];
        param m = 1 [kg];
        gravity = (0, -9.81) [m/s^2];
        body bead (x, y) { mass = m; }
        constraint circle: x^2 + y^2 = square;
        start { guess x = 1 [m]; guess y = 0.1 [m]; }
    }
}

fn parameters(change: impl Fn(&mut SliderCrankParameters)) -> SliderCrankParameters {
    let mut parameters = SliderCrankParameters::default();
    change(&mut parameters);
    parameters
}

fn assert_parameter(change: impl Fn(&mut SliderCrankParameters), expected: &str) {
    let error = SliderCrank::new(parameters(change)).expect_err(expected);
    match error {
        Error::Parameter { name, .. } => assert_eq!(name, expected, "{error}"),
        _ => panic!("{error:?}"),
    }
    assert!(error.to_string().contains(expected), "{error}");
}

#[test]
fn bad_parameters_are_refused_by_name() {
    assert_parameter(|p| p.m1 = -0.5, "mass of crank");
    assert_parameter(|p| p.m3 = -1e-300, "mass of slider");
    assert_parameter(|p| p.inertia_factor = -1.0, "inertia of crank");
    assert_parameter(|p| p.l1 = 0.0, "l1");
    assert_parameter(|p| p.l2 = -0.18, "l2");
    assert_parameter(|p| p.omega = f64::NAN, "omega");
    assert_parameter(|p| p.m2 = f64::INFINITY, "m2");
    assert!(SliderCrank::new(parameters(|_| ())).is_ok());
}

#[test]
fn bad_steps_are_refused() {
    for step in [0.0, -0.0, -H, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let error = Simulation::new(SliderCrank::declared(), step).expect_err("a bad step");
        assert!(matches!(error, Error::Step { .. }), "{error:?}");
    }
}

/// A step that is fine in `f64` may be 0 or infinite in the scalar of the
/// simulation.
#[test]
fn steps_that_the_scalar_cannot_hold_are_refused() {
    for step in [1e-60, 1e60] {
        let simulation = Simulation::builder(SliderCrank::<f32>::default(), step)
            .baumgarte(Baumgarte::<Held>::NONE)
            .build();
        let error = simulation.expect_err("not a step in f32");
        assert!(matches!(error, Error::Step { .. }), "{error:?}");
    }
}

#[test]
fn bad_gains_are_refused_by_name() {
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        let of_alpha = Baumgarte::<Held>::new(bad, 1.0).expect_err("a bad gain");
        assert!(matches!(of_alpha, Error::Gain { name: "alpha", .. }), "{of_alpha:?}");
        let of_beta = Baumgarte::<PerStage>::new(1.0, bad).expect_err("a bad gain");
        assert!(matches!(of_beta, Error::Gain { name: "beta", .. }), "{of_beta:?}");
    }
}

#[test]
fn gains_of_projection_are_refused() {
    let error = Baumgarte::<Projected>::new(0.0, 2000.0).expect_err("no use");
    assert_eq!(error, Error::NoUseOfGain { name: "beta", value: 2000.0 });
    assert!(Baumgarte::<Projected>::new(0.0, 0.0).is_ok());
    assert_eq!(Baumgarte::<Projected>::deadbeat(H), Baumgarte::NONE);
}

#[test]
fn bad_inputs_are_refused_by_name() {
    let builder = Simulation::builder(SliderCrankFree::declared(), H);
    let error = builder.inputs(SliderCrankFreeInputs { crank_torque: f64::NAN }).build().expect_err("NaN");
    assert!(matches!(error, Error::Input { name: "crank_torque", .. }), "{error:?}");
}

#[test]
fn simulation_goes_on_after_a_bad_input_is_put_right() {
    for bad in [f64::NAN, f64::INFINITY] {
        let mut simulation = Simulation::new(SliderCrankFree::declared(), H).expect("a start");
        let mut other = simulation;
        simulation.step().expect("a step");
        other.step().expect("a step");
        let before = simulation.state();

        simulation.inputs_mut().crank_torque = bad;
        let error = simulation.step().expect_err("a bad input");
        assert!(matches!(error, Error::Input { name: "crank_torque", .. }), "{error:?}");
        assert!(simulation.outputs().is_err() || SliderCrankFree::<f64>::INFO.outputs.is_empty());
        assert_eq!((simulation.state(), simulation.steps()), (before, 1));

        simulation.inputs_mut().crank_torque = 0.5;
        other.inputs_mut().crank_torque = 0.5;
        simulation.step().expect("a step");
        other.step().expect("a step");
        assert_eq!(simulation.state(), other.state());
    }
}

#[test]
fn bad_end_times_are_refused() {
    let mut simulation = Simulation::new(SliderCrank::declared(), H).expect("a start");
    simulation.advance_to(0.1).expect("a motion");
    let before = simulation.state();
    for end in [0.09, -1.0, f64::NAN, f64::INFINITY] {
        let error = simulation.advance_to(end).expect_err("a bad end");
        assert!(matches!(error, Error::EndTime { .. }), "{error:?}");
    }
    assert_eq!(simulation.state(), before);
    simulation.advance_to(0.1).expect("already there");
    assert_eq!(simulation.state(), before);
}

#[test]
fn kinematics_of_a_free_mechanism_is_refused() {
    let error = Kinematics::new(SliderCrankFree::declared()).expect_err("free");
    assert_eq!(error, Error::NotDriven { dof: 1 });
}

/// A rod as long as the crank, upright: the guide no longer determines θ2.
fn upright() -> (SliderCrank, State<<SliderCrank as Mechanism>::Coordinates>) {
    let mechanism = SliderCrank::new(parameters(|p| p.l2 = p.l1)).expect("valid parameters");
    let quarter = std::f64::consts::FRAC_PI_2;
    let mut state = mechanism.declared_start();
    state.t = quarter / mechanism.parameters().omega;
    (state.q.theta1, state.q.theta2) = (quarter, -quarter);
    (state.q.x1, state.q.y1) = (0.0, mechanism.parameters().l1 / 2.0);
    (state.q.x2, state.q.y2, state.q.x3) = (0.0, mechanism.parameters().l1 / 2.0, 0.0);
    (mechanism, state)
}

fn assert_singular(error: Error, time: f64) {
    match error {
        Error::Singular { t, constraint: "guide", coordinate: "theta2", growth, .. } => {
            assert!((t - time).abs() < 1e-15 && growth > 1e12, "{error:?}");
        }
        _ => panic!("{error:?}"),
    }
    let text = error.to_string();
    assert!(text.contains("guide") && text.contains("theta2") && text.contains("t = 0.07"), "{text}");
}

#[test]
fn singular_positions_name_constraint_coordinate_and_time() {
    let (mechanism, state) = upright();
    assert_singular(start::consistent(&mechanism, &state).expect_err("singular"), state.t);

    let mut simulation =
        Simulation::builder(mechanism, H).from_state(state).as_declared().build().expect("kept as it is");
    assert_singular(simulation.step().expect_err("singular"), state.t);
    assert_singular(simulation.reactions().expect_err("singular"), state.t);
    assert_singular(simulation.outputs().expect_err("singular"), state.t);
    assert_eq!((simulation.state(), simulation.steps()), (state, 0));
}

/// Regression: a row of the Schur complement that vanished as a whole was
/// compared with itself and passed, with a multiplier of 6e16 N.
#[test]
fn row_that_vanishes_as_a_whole_is_singular() {
    use models::slider_crank_free::SliderCrankFreeParameters;
    let equal = SliderCrankFreeParameters { l2: 0.06, ..Default::default() };
    let folded = SliderCrankFree::new(equal).expect("equal lengths are allowed");
    let mut state = folded.declared_start();
    let quarter = core::f64::consts::FRAC_PI_2;
    // Crank up and rod down: the guide restricts neither, to first order.
    (state.q.theta1, state.q.theta2) = (quarter, -quarter);
    (state.q.x1, state.q.y1, state.q.x2, state.q.y2, state.q.x3) = (0.0, 0.03, 0.0, 0.03, 0.0);
    let run = Simulation::builder(folded, H).from_state(state).as_declared().build().expect("a finite state");
    match run.reactions().expect_err("the folded position is singular") {
        Error::Singular { constraint, t, .. } => assert_eq!((constraint, t), ("guide", 0.0)),
        other => panic!("{other:?}"),
    }
    match start::consistent(&folded, &state).expect_err("nor can it be assembled there") {
        Error::Singular { constraint, .. } => assert_eq!(constraint, "guide"),
        other => panic!("{other:?}"),
    }
}

/// A crank longer than the rod cannot turn past asin(l2/l1): the drive pulls
/// the mechanism into the singular position. However the steps fall, it ends
/// in a typed error within a step, with the state from before.
#[test]
fn motion_into_a_singular_position_ends_in_an_error() {
    for step in [1e-3, 0.5e-3, 0.2e-3, 1e-5] {
        let mechanism = SliderCrank::new(parameters(|p| p.l1 = 1.1 * p.l2)).expect("valid parameters");
        let mut simulation = Simulation::new(mechanism, step).expect("a start");
        let error = simulation.advance_to(0.3).expect_err("a singular position");
        assert!(matches!(error, Error::Singular { .. } | Error::OutOfReach { .. }), "{error:?}");
        let state = simulation.state();
        assert!(state.q.is_finite() && state.v.is_finite());
        // the position where sin θ1 = l2/l1
        let last = (1.0_f64 / 1.1).asin() / mechanism.parameters().omega;
        println!("h = {step}: {error}, {last:.4} s");
        assert!((state.t - last).abs() < 1.01 * step, "{state:?}");
    }
}

#[test]
fn assembly_that_does_not_exist_is_refused() {
    let impossible = BeadParameters { square: -1.0, ..Default::default() };
    let mechanism = Bead::new(impossible).expect("no condition on the parameter");
    let error = Simulation::new(mechanism, H).expect_err("no such circle");
    match error {
        Error::NotAssembled { t, constraint, violation } => {
            assert_eq!((t, constraint), (0.0, "circle"));
            // at best Φ = 1 m², at the origin
            assert!(violation >= 1.0, "{error:?}");
        }
        Error::Singular { constraint: "circle", .. } => {}
        _ => panic!("{error:?}"),
    }

    // the crank is longer than the rod and stands where the rod cannot reach
    let mechanism = SliderCrank::new(parameters(|p| p.l1 = 1.1 * p.l2)).expect("valid parameters");
    let mut state = mechanism.declared_start();
    state.t = 0.25 / (200.0 / 60.0);
    let error = start::consistent(&mechanism, &state).expect_err("out of reach");
    println!("{error}");
    assert!(
        matches!(
            error,
            Error::NotAssembled { constraint: "guide", .. } | Error::Singular { constraint: "guide", .. }
        ),
        "{error:?}"
    );
}

/// Twice the gains that are still stable: the violation doubles in every step
/// until numbers end.
#[test]
fn motion_that_explodes_ends_in_an_error() {
    let mut simulation = Simulation::builder(SliderCrank::declared(), H)
        .baumgarte(Baumgarte::<PerStage>::new(3000.0, 2000.0).expect("valid gains"))
        .as_declared()
        .allow_unstable()
        .build()
        .expect("a start");
    let error = simulation.advance_to(0.3).expect_err("an explosion");
    assert!(matches!(error, Error::NonFinite { .. } | Error::Singular { .. }), "{error:?}");
    let before = simulation.state();
    assert!(before.q.is_finite() && before.v.is_finite() && before.t < 0.3);
    assert_eq!(simulation.step().expect_err("still there"), error);
    assert_eq!(simulation.state(), before);
}

/// A velocity that doubles what `f64` can hold within a step.
#[test]
fn overflow_names_the_coordinate() {
    let mut state = SliderCrankFree::declared().declared_start();
    state.v.x3 = f64::MAX;
    let mut simulation = Simulation::builder(SliderCrankFree::declared(), 2.0)
        .baumgarte(Baumgarte::<Held>::NONE)
        .from_state(state)
        .as_declared()
        .build()
        .expect("finite");
    let error = simulation.step().expect_err("an overflow");
    assert!(matches!(error, Error::NonFinite { coordinate: "x3", .. }), "{error:?}");
    assert_eq!(simulation.state(), state);
}

#[test]
fn all_messages_are_sentences_with_the_numbers_in_them() {
    let errors = [
        (Error::Step { step: -1.0 }, "-1"),
        (Error::EndTime { end: 2.0, now: 3.0 }, "3"),
        (Error::Gain { name: "beta", value: -4.0 }, "-4"),
        (Error::UnstableGains { alpha: 5.0, beta: 6.0, step: 7.0, feedback: "held" }, "leave both out"),
        (Error::NonFinite { t: 8.0, coordinate: "x" }, "`x`"),
        (Error::NotDriven { dof: 9 }, "9"),
        (Error::OwnState { state: "current" }, "`current`"),
        (Error::NoUseOfGain { name: "alpha", value: 7.0 }, "7 1/s"),
        (Error::NoEstimate { scheme: "rk4" }, "dopri5"),
        (Error::Tolerance { name: "rtol", value: 0.0, least: 1e-14 }, "1.0e-14"),
        (Error::StepTooShort { t: 0.25, step: 1e-18 }, "0.25"),
        (Error::TooManySteps { t: 0.25, steps: 1000 }, "0.25"),
        (Error::Input { name: "torque", value: f64::NAN }, "NaN"),
        (Error::NotAssembled { t: 0.0, constraint: "pin", violation: 0.5 }, "`pin`"),
    ];
    for (error, part) in errors {
        let text = error.to_string();
        assert!(text.contains(part) && text.len() > 30, "{text}");
    }
}

/// Regression: a mass that was set to 0 gave an infinite acceleration at the start. On a bead in a circle the constraint
/// says where it goes as well.
#[test]
fn a_mass_that_alone_determines_an_acceleration_is_positive() {
    let ball = "Ball { dof = 3; param m = 1 [kg]; param inertia = 1 [kg*m^2]; gravity = (0, -9.81) [m/s^2];
        body ball (x, y, phi) { mass = m; inertia = inertia; } force spring on y = -10 [N/m]*y; }";
    let live = Text::declaration("ball.mbs", ball).compile().expect("a mechanism");
    for (at, expected) in [(0, "mass of ball"), (1, "inertia of ball")] {
        let refused = live.with_parameters(|parameters| parameters[at] = 0.0).err();
        let Some(Error::Parameter { name, value, .. }) = refused else { panic!("{refused:?}") };
        assert_eq!((name, value), (expected, 0.0));
    }
    assert!(Bead::new(BeadParameters { m: 0.0, ..BeadParameters::default() }).is_ok());
    // a particle on it has a mass too
    let loaded = ball.replace("force spring", "particle load at ball { mass = 1 [kg]; } force spring");
    let live = Text::declaration("loaded.mbs", loaded).compile().expect("a mechanism");
    assert!(live.with_parameters(|parameters| parameters[0] = 0.0).is_ok());
}

/// Times of steps are sums and products, whose rounding is nobody's concern.
#[test]
fn times_are_shown_without_their_rounding() {
    let message = |t: f64| Error::NonFinite { t, coordinate: "x" }.to_string();
    for (t, shown) in [
        (0.072_000_000_000_000_01, "t = 0.072 s"),
        (0.1 + 0.2, "t = 0.3 s"),
        (1.0 / 3.0, "t = 0.333333333333 s"),
        (-1.234_567_890_12e-300, "t = -1.23456789012e-300 s"),
        (1e15, "t = 1000000000000000 s"),
        (0.0, "t = 0 s"),
        (f64::NEG_INFINITY, "t = -inf s"),
        (f64::NAN, "t = NaN s"),
    ] {
        assert!(message(t).contains(shown), "{}", message(t));
    }
}
