//! A fused step is the step in two stages, bit for bit but for the sign of a zero:
//! at states on and off the constraints, in both precisions, with both kinds of
//! feedback, at and beside positions in which mechanisms are singular, and at angles
//! beyond the range of the inlined sine. So are the reactions that a step gives.
//!
//! Not within a tolerance: lanes do the operations of the scalars, so that a
//! difference is an error.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use std::thread;

use mbs_runtime::{Baumgarte, Components, Gains, Held, Mechanism, Method, PerStage, Real, Simulation, State};
use models::*;
use tests::random::Random;

const H: f64 = 0.5e-3;

/// The same number, not a number in both, or zeros of any sign.
fn are_same<T: Real>(a: T, b: T) -> bool {
    a == b || (a.to_f64().is_nan() && b.to_f64().is_nan())
}

fn assert_same<C: Components>(fused: C, staged: C, what: &str) {
    let (fused, staged) = (fused.into_array(), staged.into_array());
    for ((fused, staged), name) in fused.as_ref().iter().zip(staged.as_ref()).zip(C::NAMES) {
        assert!(are_same(*fused, *staged), "{what}: {name} is {fused}, in stages {staged}");
    }
}

/// Compares one step; its next state.
fn compare<M: Mechanism, X: Method>(
    mechanism: &M,
    at: &State<M::States>,
    inputs: &M::Inputs,
    what: &str,
) -> State<M::States> {
    let what = format!("{what} of {} with {} feedback", M::INFO.name, X::EXPLICIT.stabilization.word());
    let number = M::Real::from_f64;
    let (h, half_h) = (number(H), number(0.5) * number(H));
    let t_next = at.t + h;
    let gains = Gains { minus_two_alpha: number(-1.5 / H), minus_beta_squared: number(-1.0 / (H * H)) };
    let fused = mechanism.fused_step::<X>(at, inputs, &gains, h, t_next).expect("a small mechanism");

    let here = mechanism.stabilized(at, inputs, &gains);
    let predicted = State {
        t: t_next,
        q: at.q.zip_map(at.v, |q, v| q + h * v),
        v: at.v.zip_map(here.acceleration, |v, a| v + h * a),
    };
    let (there, growth) = if X::EXPLICIT.is_held() {
        let there = mechanism.constrained(&predicted, inputs, &here.feedback);
        (there.acceleration, there.growth)
    } else {
        let there = mechanism.stabilized(&predicted, inputs, &gains);
        (there.acceleration, there.growth)
    };
    let q = at.q.zip_map(at.v.zip_map(predicted.v, |v, w| v + w), |q, sum| q + half_h * sum);
    let v = at.v.zip_map(here.acceleration.zip_map(there, |a, b| a + b), |v, sum| v + half_h * sum);

    assert!(fused.next.t == t_next);
    assert_same(fused.next.q, q, &what);
    assert_same(fused.next.v, v, &what);
    let growth = here.growth + growth;
    assert!(are_same(fused.growth, growth), "{what}: growth {}, in stages {growth}", fused.growth);
    if fused.sum.is_finite() {
        assert!(q.is_finite() && v.is_finite(), "{what}: not finite, but the sum is");
    }
    compare_with_reactions::<M, X>(mechanism, &mechanism.complete(at), inputs, &what);
    fused.next
}

/// Compares a step that gives reactions with reactions and then a step: results,
/// failures, and the states after them.
fn compare_with_reactions<M: Mechanism, X: Method>(
    mechanism: &M,
    at: &State<M::Coordinates>,
    inputs: &M::Inputs,
    what: &str,
) {
    let simulation = Simulation::builder(*mechanism, H)
        .baumgarte(Baumgarte::<X>::deadbeat(H))
        .inputs(*inputs)
        .from_state(*at)
        .as_declared()
        .build();
    // off the constraints a state may not be finite any more
    let Ok(mut fused) = simulation else { return };
    let mut apart = fused;
    let expected = apart.reactions().and_then(|reactions| apart.step().map(|()| reactions));
    match (fused.step_with_reactions(), expected) {
        (Ok(found), Ok(expected)) => {
            assert_same(found.acceleration, expected.acceleration, &format!("q̈ of {what}"));
            assert_same(found.multipliers, expected.multipliers, &format!("λ of {what}"));
            assert!(are_same(found.growth, expected.growth), "{what}: growth at the start");
        }
        // as text: a growth that is not a number is not equal to itself
        (found, expected) => {
            assert_eq!(format!("{:?}", found.err()), format!("{:?}", expected.err()), "{what}");
        }
    }
    assert_eq!(fused.steps(), apart.steps(), "{what}");
    assert_same(fused.state().q, apart.state().q, what);
    assert_same(fused.state().v, apart.state().v, what);
}

/// Everything about one mechanism: its motion from the start, random states beside
/// it, and angles far away.
fn check<M: Mechanism>(mechanism: M, inputs: M::Inputs) {
    let mut random = Random::new(7);
    let start = mechanism.declared_start();
    let (h, none) = (M::Real::from_f64(H), M::Real::default());
    let gains = Gains { minus_two_alpha: none, minus_beta_squared: none };
    let start = mbs_runtime::start::consistent(&mechanism, &start).unwrap_or(start);
    let start = State { t: start.t, q: M::states(start.q), v: M::states(start.v) };
    let fused = mechanism.fused_step_with_reactions::<Held>(&start, &inputs, &gains, h, start.t + h);
    assert!(fused.is_some(), "{} gives no reactions with a step", M::INFO.name);
    let (mut held, mut per_stage) = (start, start);
    for _ in 0..200 {
        held = compare::<M, Held>(&mechanism, &held, &inputs, "motion");
        per_stage = compare::<M, PerStage>(&mechanism, &per_stage, &inputs, "motion");
        for scale in [1e-6, 1e-2, 1.0, 1e6] {
            let mut shifted = |components: M::States| {
                let mut array = components.into_array();
                for x in array.as_mut() {
                    *x = *x + M::Real::from_f64(random.between(-scale, scale));
                }
                M::States::from_array(array)
            };
            let beside = State { t: held.t, q: shifted(held.q), v: shifted(held.v) };
            compare::<M, Held>(&mechanism, &beside, &inputs, "a state");
            compare::<M, PerStage>(&mechanism, &beside, &inputs, "a state");
        }
    }
}

/// Runs a test on a stack for the results of all instructions. Code that is not optimised holds them at once.
fn with_a_large_stack(test: fn()) {
    let thread = thread::Builder::new().stack_size(64 << 20).spawn(test).expect("a thread");
    thread.join().expect("the test");
}

/// For every mechanism of the library its text says so (`models/tests/library`), from its start on.
#[test]
fn mechanisms_of_the_library_step_alike() {
    with_a_large_stack(|| {
        check(SliderCrank::declared(), Default::default());
        check(SliderCrankFree::declared(), SliderCrankFreeInputs { crank_torque: 0.5 });
        check(Pendulum::declared(), Default::default());
        check(DoublePendulum::declared(), Default::default());
        check(FourBarFree::declared(), Default::default());
        check(NFourBar1::declared(), Default::default());
        check(NPendulum2::declared(), Default::default());
        // friction, a spline
        check(BlockOnIncline::declared(), Default::default());
        check(CamFollower::declared(), Default::default());
    });
}

/// A mechanism whose step is too long for one program gives reactions all the same.
#[test]
fn long_steps_give_reactions_too() {
    let mechanism = NFourBar10::declared();
    let (at, inputs) = (mechanism.declared_start(), NoInputs::default());
    let gains = Gains { minus_two_alpha: 0.0, minus_beta_squared: 0.0 };
    assert!(mechanism.fused_step_with_reactions::<Held>(&at, &inputs, &gains, H, H).is_none());
    compare_with_reactions::<_, Held>(&mechanism, &at, &inputs, "a long step");
    compare_with_reactions::<_, PerStage>(&mechanism, &at, &inputs, "a long step");
}

#[test]
fn single_precision_steps_alike() {
    with_a_large_stack(|| {
        check(SliderCrank::<f32>::default(), Default::default());
        check(SliderCrankFree::<f32>::default(), SliderCrankFreeInputs { crank_torque: 0.5 });
        check(FourBarFree::<f32>::default(), Default::default());
    });
}

/// At ±90° the crank stands upright and the rod turns back; with the rod itself
/// upright the pivot vanishes.
#[test]
fn slider_cranks_step_alike_at_dead_centres() {
    fn at_angles<M: Mechanism<Real = f64>>(mechanism: M, inputs: M::Inputs, angles: [&str; 2]) {
        let right = std::f64::consts::FRAC_PI_2;
        for (theta1, theta2) in
            [(0.0, right), (right, -0.34), (-right, 0.34), (right, right), (0.0, -right), (0.0, 0.0)]
        {
            for off in [0.0, 1e-15, -1e-9, 1e-3] {
                let mut at = mechanism.declared_start();
                for (name, angle) in angles.into_iter().zip([theta1 + off, theta2 - off]) {
                    at.q = at.q.with(name, angle).expect("an angle of the slider-crank");
                    at.v = at.v.with(name, 3.0).expect("a rate of the slider-crank");
                }
                let at = State { t: at.t, q: M::states(at.q), v: M::states(at.v) };
                compare::<M, Held>(&mechanism, &at, &inputs, "a dead centre");
                compare::<M, PerStage>(&mechanism, &at, &inputs, "a dead centre");
            }
        }
    }
    at_angles(SliderCrank::declared(), Default::default(), ["theta1", "theta2"]);
    at_angles(SliderCrankFree::declared(), SliderCrankFreeInputs::default(), ["theta1", "theta2"]);
}

/// Where its bars lie on one line a parallelogram may fold two ways.
#[test]
fn parallelograms_step_alike_at_change_points() {
    let mechanism = NFourBar1::declared();
    for angle in [0.0, std::f64::consts::PI, -std::f64::consts::PI] {
        for off in [0.0, 1e-15, 1e-9, -1e-3] {
            let mut at = mechanism.declared_start();
            for name in ["phi_0", "phi_1"] {
                at.q = at.q.with(name, angle + off).expect("an upright");
                at.v = at.v.with(name, -2.0).expect("an upright");
            }
            at.q = at.q.with("psi_1", 0.0).expect("a bar");
            compare::<_, Held>(&mechanism, &at, &NoInputs::default(), "a change point");
            compare::<_, PerStage>(&mechanism, &at, &NoInputs::default(), "a change point");
        }
    }
}

type NoInputs = mbs_runtime::NoComponents<f64>;

/// A step that the fused form cannot make is examined in stages, and fails as it
/// does there.
#[test]
fn failures_are_named() {
    let mechanism = SliderCrank::declared();
    let mut at = mechanism.declared_start();
    at.q.theta2 = std::f64::consts::FRAC_PI_2;
    let baumgarte = Baumgarte::<Held>::deadbeat(H);
    let mut simulation = Simulation::builder(mechanism, H)
        .baumgarte(baumgarte)
        .from_state(at)
        .as_declared()
        .build()
        .expect("any finite state");
    let error = simulation.step().expect_err("the rod is upright");
    assert_eq!(simulation.step_with_reactions().err(), Some(error));
    assert!(
        matches!(error, mbs_runtime::Error::Singular { constraint: "guide", coordinate: "theta2", .. }),
        "{error}"
    );
}
