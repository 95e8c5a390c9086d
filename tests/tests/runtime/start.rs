//! Starts that are given: kept to the bit, refused, or made consistent with what has to
//! be kept.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::{Components, Error, Mechanism, Real, Simulation, State, mechanism, start};

mechanism! {
    /// A four-bar, free to move.
    FourBar {
        dof = 1;
        param base = 1 [m];
        param crank_length = 0.3 [m];
        param coupler_length = 0.8 [m];
        param rocker_length = 0.7 [m];
        gravity = (0, -9.81) [m/s^2];
        body crank (x1, y1, a1) { mass = 1 [kg]; inertia = 0.05 [kg*m^2]; }
        body coupler (x2, y2, a2) { mass = 2 [kg]; inertia = 0.1 [kg*m^2]; }
        body rocker (angle = a3) { inertia = 0.2 [kg*m^2]; }
        point base on crank = (-crank_length/2, 0);
        point tip on crank = (crank_length/2, 0);
        point base on coupler = (-coupler_length/2, 0);
        point tip on coupler = (coupler_length/2, 0);
        revolute left (crank.base, ground);
        revolute elbow (crank.tip, coupler.base);
        constraint knee_x: x2 + coupler_length/2*cos(a2) = base + rocker_length*cos(a3);
        constraint knee_y: y2 + coupler_length/2*sin(a2) = rocker_length*sin(a3);
        start {
            a1 = 60 [deg]; der(a1) = 1 [rad/s];
            guess x1 = 0.1 [m]; guess y1 = 0.1 [m];
            guess x2 = 0.5 [m]; guess y2 = 0.5 [m]; guess a2 = 20 [deg]; guess a3 = 100 [deg];
        }
    }
}

const H: f64 = 1e-3;

fn moving() -> Simulation<FourBar> {
    let mut run = Simulation::new(FourBar::declared(), H).expect("a start");
    run.advance_to(0.4).expect("a motion");
    run
}

/// Regression: the state was projected onto what the declaration prescribes, so that a
/// run did not go on as it would have.
#[test]
fn run_goes_on_from_the_state_of_another_to_the_bit() {
    let mut run = moving();
    let mut other =
        Simulation::builder(FourBar::declared(), H).from_state(run.state()).build().expect("its own state");
    assert_eq!(other.state(), run.state());
    for _ in 0..500 {
        run.step().expect("a step");
        other.step().expect("a step");
        // times are multiples of the step here, and sums there
        assert_eq!((run.state().q, run.state().v), (other.state().q, other.state().v));
    }
}

/// With coarse steps violations are large, but it is a run all the same; so it is at rest.
#[test]
fn states_of_coarse_and_resting_runs_are_accepted() {
    for h in [1e-2, 3e-3, 1e-5] {
        let mut run = Simulation::new(FourBar::declared(), h).expect("a start");
        for _ in 0..300 {
            run.step().expect("a step");
            let again = Simulation::builder(FourBar::declared(), h).from_state(run.state()).build();
            assert_eq!(again.expect("a state of a run").state(), run.state(), "h = {h}");
        }
    }
    let single = Simulation::new(FourBar::<f32>::default(), H);
    let mut single = single.expect("a start");
    for _ in 0..300 {
        single.step().expect("a step");
        Simulation::builder(FourBar::<f32>::default(), H)
            .from_state(single.state())
            .build()
            .expect("a state");
    }
    let mut rest = moving().state();
    rest.v = Components::splat(0.0);
    let run = Simulation::builder(FourBar::declared(), H).from_state(rest).build().expect("at rest");
    assert_eq!(run.state(), rest);
}

#[test]
fn start_that_violates_a_constraint_is_refused_with_the_violation() {
    let build = |state| Simulation::builder(FourBar::declared(), H).from_state(state).build();
    let mut state = moving().state();
    state.q.a3 += 0.01;
    match build(state).expect_err("not consistent") {
        Error::Inconsistent { constraint, is_rate: false, violation, allowed, .. } => {
            assert!(constraint.starts_with("knee") && violation > 5e-3 && violation < 8e-3, "{violation}");
            assert!(allowed > 1e-4 && violation > allowed, "{allowed}");
        }
        error => panic!("{error:?}"),
    }
    let mut state = moving().state();
    state.v.a3 *= 0.5;
    let error = build(state).expect_err("not consistent");
    assert!(matches!(error, Error::Inconsistent { is_rate: true, .. }), "{error:?}");
    assert!(error.to_string().contains("the rate of constraint `knee"), "{error}");
    // as it is, if that is what one wants
    let run = Simulation::builder(FourBar::declared(), H).from_state(state).as_declared().build();
    assert_eq!(run.expect("unchecked").state(), state);
}

/// Any coordinate of the one degree of freedom can be kept, and any velocity with it.
#[test]
fn projection_keeps_what_it_is_told_to_the_bit() {
    let mechanism = FourBar::declared();
    let names: &[&'static str] = <FourBar as Mechanism>::Coordinates::NAMES;
    let near = moving().state();
    for &position in names {
        for &velocity in names {
            let mut guess = near;
            let q = near.q.get(position).expect("a coordinate");
            guess.q = guess.q.with(position, q + 2e-3).expect("a coordinate");
            guess.v = guess.v.with(velocity, 0.25).expect("a coordinate");
            let state = start::project(&mechanism, &guess, &[position], &[velocity]).expect("a start");
            assert_eq!(state.q.get(position), guess.q.get(position));
            assert_eq!(state.v.get(velocity), Some(0.25));
            let run = Simulation::builder(mechanism, H).from_state(state).build().expect("consistent");
            assert_eq!(run.state(), state);
            // coordinates of 1 m; rates of up to 0.25 times a transmission ratio
            let ratio = state.v.largest().1.max(1.0);
            assert!(run.violation() < 1e-14, "{position}: {:e}", run.violation());
            assert!(run.velocity_violation() < 1e-13 * ratio, "{velocity}: {:e}", run.velocity_violation());
        }
    }
}

/// A projection that keeps at run time what the declaration prescribes gives the declared start.
#[test]
fn projection_and_the_declared_start_agree() {
    let mechanism = FourBar::declared();
    let guess = mechanism.declared_start();
    let declared = start::consistent(&mechanism, &guess).expect("a start");
    let projected = start::project(&mechanism, &guess, &["a1"], &["a1"]).expect("a start");
    for (a, b) in declared.q.into_array().into_iter().zip(projected.q.into_array()) {
        assert!((a - b).abs() < 1e-12, "{a} {b}");
    }
    for (a, b) in declared.v.into_array().into_iter().zip(projected.v.into_array()) {
        assert!((a - b).abs() < 1e-12, "{a} {b}");
    }
    // nothing kept: nearer than with something kept
    let nearest = start::project(&mechanism, &guess, &[], &[]).expect("a start");
    assert!(distance(&mechanism, guess.q, nearest.q) <= distance(&mechanism, guess.q, declared.q));
}

/// Half its square, in the norm of the mass matrix.
fn distance(mechanism: &FourBar, a: FourBarCoordinates, b: FourBarCoordinates) -> f64 {
    mechanism.kinetic_energy(&State { t: 0.0, q: a, v: a.zip_map(b, |a, b| a - b) })
}

#[test]
fn projection_says_what_cannot_be_kept() {
    let mechanism = FourBar::declared();
    let mut guess = moving().state();
    guess.q.a3 += 0.05;
    let error = start::project(&mechanism, &guess, &["a1", "a2", "a3"], &[]).expect_err("two too many");
    let is_named = matches!(error, Error::NotAssembled { .. } | Error::Inconsistent { is_rate: false, .. });
    assert!(is_named, "{error:?}");
    guess = moving().state();
    guess.v.a3 += 0.5;
    let error = start::project(&mechanism, &guess, &[], &["a1", "a3"]).expect_err("one too many");
    assert!(matches!(error, Error::Inconsistent { is_rate: true, .. }), "{error:?}");
    let error = start::project(&mechanism, &guess, &["a4"], &[]).expect_err("unknown");
    assert_eq!(error, Error::NoCoordinate { name: "a4" });
}

/// Regression: t = NaN and ±∞ were taken, and at 1e18 s time stood still.
#[test]
fn time_that_cannot_be_counted_is_refused() {
    let state = moving().state();
    for t in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e18, -1e18, 1.2e12] {
        for kept in [false, true] {
            let builder = Simulation::builder(FourBar::declared(), H).from_state(State { t, ..state });
            let builder = if kept { builder.as_declared() } else { builder };
            let error = builder.build().expect_err("no time to start at");
            assert!(matches!(error, Error::Time { step: H, .. }), "{error:?}");
        }
    }
    let late = Simulation::builder(FourBar::declared(), H).from_state(State { t: 1e9, ..state }).build();
    let mut late = late.expect("far, but countable");
    late.step().expect("a step");
    assert!(late.time() > 1e9);
    let single = Simulation::new(FourBar::<f32>::default(), 1e-3).expect("a start");
    let state = State { t: 1e5, ..single.state() };
    let error = Simulation::builder(FourBar::<f32>::default(), 1e-3).from_state(state).build();
    assert!(matches!(error, Err(Error::Time { .. })), "{error:?}");
}

/// Regression: the number of steps saturated, so that `advance_to` would not come back.
#[test]
fn end_that_cannot_be_counted_to_is_refused() {
    let mut run = moving();
    let before = run.state();
    for end in [1e300, 1e18, 1e13] {
        assert_eq!(run.steps_to(end), Err(Error::Time { t: end, step: H }));
        assert_eq!(run.advance_to(end), Err(Error::Time { t: end, step: H }));
    }
    assert_eq!(run.state(), before);
    assert_eq!(run.steps_to(1e9), Ok(1_000_000_000_000 - 400));
    assert_eq!(Real::to_f64(run.time()), 0.4);
}
