//! Stops: impacts against closed forms, rests that hold and end, several at once. Many impacts and random ones are in
//! `tests/long`.
#![allow(clippy::expect_used, reason = "helpers of tests")]

mod bearing;
mod bristles;
mod by_forces;
mod contact;
mod energy;
mod held;
mod modes;
mod play;
mod rests;
mod rubbing;
mod several;
mod steps;
mod sticking;

use mbs_live::{Prepared, Run, Text};
use mbs_runtime::{
    Adaptive, Dop853, Dual, Error, Mechanism, Real, Sampled, Simulation, System, Tolerances, mechanism,
};

const TIGHT: Tolerances = Tolerances { rtol: 1e-10, atol: 1e-12, max_step: f64::INFINITY, first_step: None };

/// A declaration as a type, and as a text.
macro_rules! declared {
    ($text:ident; $($tokens:tt)*) => {
        mechanism! { $($tokens)* }
        const $text: &str = stringify!($($tokens)*);
    };
}
use declared;

// a ball that falls from a height of 1 m
declared! { BALL;
    Ball {
        dof = 1;
        param e = 0.7;
        gravity = (0, -9.81) [m/s^2];
        body ball (y) { mass = 2 [kg]; }
        stop floor: y >= 0 [m] { restitution = e; }
        start { y = 1 [m]; }
    }
}

/// It falls for t₀ = √(2h/g), and flies 2 eⁿ t₀ after its n-th impact. The flights that are shorter than 10⁻⁶ of the
/// first one are not flown: from the accumulation of impacts on, at t₀ (1 + e)/(1 − e), the ball rests.
#[test]
fn impacts_of_a_ball_are_those_of_the_closed_form() -> Result<(), Error> {
    let fall = (2.0_f64 / 9.81).sqrt();
    for e in [0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99] {
        let ball = Ball::new(BallParameters { e })?;
        // the last flight rises by 1e-12 m, and none that rises by less than the absolute tolerance is flown
        let tolerances = Tolerances { atol: 1e-13, ..TIGHT };
        let mut run = Adaptive::builder(ball).tolerances(tolerances).build()?;
        let (mut expected, mut count, mut sum) = (fall, 0_i32, 0.0);
        while run.inputs().floor == 0.0 {
            run.step()?;
            let impulse = run.inputs().floor_impulse;
            if impulse > sum {
                // and what roundings of times add up to
                let allowed = 1e-12 + f64::from(count) * f64::EPSILON * expected;
                assert!((run.time() - expected).abs() < allowed, "{e}: {} {expected}", run.time());
                // the momentum of before and behind
                let before = 2.0 * 9.81 * fall * e.powi(count);
                let is_last = run.inputs().floor == 1.0;
                let changed = if is_last { before } else { before * (1.0 + e) };
                assert!((impulse - sum - changed).abs() < 1e-11, "{e}: {} {changed}", impulse - sum);
                sum = impulse;
                count += 1;
                expected += 2.0 * fall * e.powi(count);
            }
        }
        let flights = (1e-6_f64.ln() / e.ln()).ceil() as i32;
        assert!((count - 1 - flights).abs() <= 1, "{e}: {count} impacts, {flights} flights");
        let end = fall * (1.0 + e) / (1.0 - e);
        let left = 2e-6 * fall * e / (1.0 - e);
        assert!(run.time() <= end && end - run.time() < 1.01 * left, "{e}: {} {end}", run.time());
        run.advance_to(1000.0)?;
        let state = run.state();
        assert!(state.q.y == 0.0 && state.v.y == 0.0 && run.inputs().floor == 1.0, "{e}: {state:?}");
    }
    // the number that others give for e = 0.7
    assert!((fall * 1.7 / 0.3 - 2.558_633_966).abs() < 1e-9);
    Ok(())
}

/// y at the end is v τ − g τ²/2, with v and τ of the second flight: the derivative by e goes through two impacts, whose
/// times it changes.
#[test]
fn derivatives_go_through_impacts() -> Result<(), Error> {
    let end = 1.5;
    let height = |e: Dual<f64, 1>| {
        let (g, fall) = (9.81, (2.0_f64 / 9.81).sqrt());
        let after = |flight: Dual<f64, 1>| flight * Dual::constant(2.0 * fall);
        let begin = Dual::constant(fall) + after(e);
        let (speed, time) = (e * e * Dual::constant(g * fall), Dual::constant(end) - begin);
        speed * time - Dual::constant(0.5 * g) * time * time
    };
    let e = Dual::variable(0.7, 0);
    let run = Adaptive::builder(Ball::new(BallParameters { e })?);
    let mut run = run.scheme::<Dop853>().tolerances(TIGHT).build()?;
    run.advance_to(end)?;
    let (found, expected) = (run.state().q.y, height(e));
    assert!((found.to_f64() - expected.to_f64()).abs() < 1e-10, "{found:?} {expected:?}");
    assert!((found.partial(0) - expected.partial(0)).abs() < 1e-8, "{found:?} {expected:?}");
    Ok(())
}

/// The ball as a text takes the steps of the type, to the bit.
#[test]
fn a_text_bounces_as_a_type() -> Result<(), Error> {
    let live = Text::declaration("ball.mbs", BALL).compile().expect("a ball");
    let mut typed = Sampled::new(Adaptive::builder(Ball::declared()).tolerances(TIGHT).build()?, 0.1)?;
    let mut read = Sampled::new(Adaptive::builder(Prepared::new(&live)).tolerances(TIGHT).build()?, 0.1)?;
    for _ in 0..30 {
        typed.step()?;
        read.step()?;
        let mut found = [[0.0; 4]; 2];
        for (found, run) in found.iter_mut().zip([&typed as &dyn System, &read]) {
            let [y, v, inputs @ ..] = found;
            let (mut q, mut rates) = ([0.0], [0.0]);
            run.state(&mut q, &mut rates);
            run.inputs(inputs);
            (*y, *v) = (q[0], rates[0]);
        }
        assert_eq!(found[0].map(f64::to_bits), found[1].map(f64::to_bits), "{found:?}");
    }
    Ok(())
}

/// Regression: a gap that has no value behind the stop was never seen to close, and the body fell on.
#[test]
fn a_gap_without_a_value_ends_the_run() {
    let text = "Fall {
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        body ball (y) { mass = 1 [kg]; }
        stop floor: sqrt(y) >= 0 { restitution = 0.5; }
        start { y = 1 [m]; }
    }";
    let live = Text::declaration("fall.mbs", text).compile().expect("a mechanism");
    let run = Adaptive::builder(Prepared::new(&live)).build().and_then(|mut run| run.advance_to(1.0));
    let steps = Run::builder(&live, 1e-3).build().and_then(|mut run| run.advance(1000));
    for error in [run, steps].map(|run| run.expect_err("an error")) {
        assert!(matches!(error, Error::Undefined { what: "the gap of stop", name: "floor", .. }), "{error}");
    }
}

/// A start behind a stop is none.
#[test]
fn a_start_behind_a_stop_is_refused() {
    let mut behind = Ball::<f64>::declared().declared_start();
    behind.q.y = -0.1;
    let run = Adaptive::builder(Ball::declared()).from_state(behind).build().map(|_| ());
    let steps = Simulation::builder(Ball::declared(), 1e-3).from_state(behind).build().map(|_| ());
    for refused in [run, steps].map(|run| run.expect_err("an error").to_string()) {
        assert!(refused.contains("is behind the stop `floor`: its gap is -0.1 m;"), "{refused}");
    }
}
