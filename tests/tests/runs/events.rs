//! Events: where values change their signs, against closed forms; in order; at the start; and
//! what becomes of a run behind them.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::{
    Adaptive, AdaptiveScheme, Direction, Dop853, Dopri5, Error, Event, Mechanism, Scheme, State, Tolerances,
    implicit::Esdirk4, mechanism,
};
use tests::swing::{Swing, quarter_period};

mechanism! {
    /// A ball above the ground.
    pub Ball {
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        body ball (y) { mass = 0.3 [kg]; }
        start { y = 1 [m]; }
    }
}

mechanism! {
    /// The ball with its events declared.
    pub Bouncer {
        dof = 1;
        param shelf = 0.5 [m];
        input wind [N];
        gravity = (0, -9.81) [m/s^2];
        body ball (y) { mass = 0.3 [kg]; }
        force push on y = wind;
        /// It stands still for a moment.
        event top: der(y) = 0 falling;
        event level: ball.y = shelf;
        event ground: y = 0 falling;
        event gust: wind = 1 [N] rising;
        event late: t = 0.65 [s];
        start { y = 1 [m]; der(y) = 2 [m/s]; }
    }
}

mechanism! {
    /// x = t m/s.
    pub Glider {
        dof = 1;
        body block (x) { mass = 1 [kg]; }
        start { der(x) = 1 [m/s]; }
    }
}

use Direction::{Either, Falling, Rising};

fn tolerances(rtol: f64) -> Tolerances {
    Tolerances { rtol, atol: 1e-2 * rtol, ..Tolerances::default() }
}

fn swing<S: Scheme>(rtol: f64) -> Adaptive<Swing, S> {
    let builder = Adaptive::builder(Swing::declared()).scheme::<S>();
    builder.tolerances(tolerances(rtol)).build().expect("a start")
}

fn glider() -> Adaptive<Glider> {
    Adaptive::builder(Glider::declared()).build().expect("a start")
}

/// Restitution is applied by the program. The fall takes √(2h/g), every bounce 2eᵏ√(2h/g).
#[test]
fn impacts_of_a_bouncing_ball_are_those_of_the_closed_form() {
    let mut run = Adaptive::builder(Ball::declared()).build().expect("a start");
    let mut expected = (2.0 / 9.81_f64).sqrt();
    let mut bounce = 2.0 * expected;
    for known in [0.451_523_641, 1.083_656_738, 1.526_149_907, 1.835_895_124] {
        let event = run.advance_until(10.0, [Falling], |at| [at.q.y]).expect("a motion").expect("an impact");
        assert!((event.t - expected).abs() < 1e-12, "{event:?} {expected}");
        assert!((event.t - known).abs() < 1e-9, "{event:?} {known}");
        // right behind: on the ground or an atom's width below it
        let mut state = run.state();
        assert!(state.q.y <= 0.0 && state.q.y > -1e-14, "{state:?}");
        state.v.y *= -0.7;
        run.set_state(state).expect("a free state");
        bounce *= 0.7;
        expected += bounce;
    }
}

/// Released from the side, a pendulum is at the bottom after odd multiples of K(1/√2) √(l/g).
#[test]
fn crossings_of_a_pendulum_are_those_of_the_elliptic_integral() {
    let quarter = quarter_period();
    let mut run = swing::<Dop853>(1e-13);
    for crossing in 0..20 {
        let event = run.advance_until(60.0, [Either], |at| [at.q.x]).expect("a motion").expect("a crossing");
        let expected = f64::from(2 * crossing + 1) * quarter;
        assert!((event.t - expected).abs() < 1e-10, "{crossing}: {event:?} {expected}");
        assert_eq!(event.is_rising, crossing % 2 == 1);
        // the state is on the constraint, and on the other side
        let state = run.state();
        assert!((state.q.x >= 0.0) == event.is_rising && (state.q.x.hypot(state.q.y) - 1.0).abs() < 1e-15);
    }
}

/// A coarse tolerance moves the motion, and not the place where its event is found.
#[test]
fn the_state_at_an_event_is_that_of_a_step_that_ends_there() {
    let mut run = swing::<Dopri5>(1e-5);
    let event = run.advance_until(2.0, [Falling], |at| [at.q.x - 0.3]).expect("a motion").expect("it falls");
    let (state, next) = (run.state(), run.at(event.t).expect("now"));
    assert_eq!((state, state.t), (next, event.t));
    assert!(state.q.x <= 0.3 && state.q.x > 0.3 - 1e-15, "{state:?}");
    // of the run that ends there without looking for anything
    let mut straight = swing::<Dopri5>(1e-5);
    straight.advance_to(event.t).expect("a motion");
    assert!((straight.state().q.x - 0.3).abs() < 1e-6);
}

/// y = 1 m + 2 m/s t − 4.905 m/s² t².
#[test]
fn declared_events_have_names_and_are_found() {
    let info = Bouncer::<f64>::INFO;
    let names: Vec<&str> = info.events.iter().map(|event| event.name).collect();
    assert_eq!(names, ["top", "level", "ground", "gust", "late"]);
    assert_eq!(info.events[0].doc, "It stands still for a moment.");
    let directions: Vec<Direction> = info.events.iter().map(|event| event.direction).collect();
    assert_eq!(directions, [Falling, Either, Falling, Rising, Either]);
    assert_eq!((info.events[1].dimension.length, info.events[0].dimension.time), (1, -1));

    let height = |y: f64| (2.0 + (4.0 + 4.0 * 4.905 * (1.0 - y)).sqrt()) / 9.81;
    let expected = [("top", 2.0 / 9.81), ("level", height(0.5)), ("late", 0.65), ("ground", height(0.0))];
    let mut run = Adaptive::builder(Bouncer::declared()).build().expect("a start");
    for (name, t) in expected {
        let event = run.advance_to_event(0.8).expect("a motion").expect("an event");
        assert_eq!(names[event.index], name);
        assert!((event.t - t).abs() < 1e-12, "{name}: {event:?} {t}");
    }
    assert_eq!(run.advance_to_event(0.8), Ok(None));
}

#[test]
fn events_of_one_step_come_in_their_order() {
    // x = t, whose first step is longer than all of this
    let at_times = |at: &State<GliderCoordinates>| [0.5 + 1e-9, 0.25, 0.5].map(|t| at.q.x - t);
    let mut run = glider();
    let mut found = Vec::new();
    while let Some(Event { index, t, .. }) = run.advance_until(1.0, [Rising; 3], at_times).expect("a motion")
    {
        found.push((index, t));
    }
    let expected = [(1, 0.25), (2, 0.5), (0, 0.5 + 1e-9)];
    assert_eq!(found.len(), 3, "{found:?}");
    for ((index, t), (known, at)) in found.into_iter().zip(expected) {
        assert!(index == known && (t - at).abs() < 1e-15, "{index} at {t}, and not {known} at {at}");
    }
    assert_eq!(run.time(), 1.0);
}

#[test]
fn simultaneous_events_are_told_one_after_the_other() {
    let values = |at: &State<GliderCoordinates>| [at.q.x - 0.5, 1.0 - 2.0 * at.q.x, at.q.x - 0.7];
    let mut run = glider();
    let mut next = || run.advance_until(1.0, [Rising, Falling, Rising], values).expect("a motion");
    let [first, second, third] = [next(), next(), next()].map(|event| event.expect("an event"));
    assert_eq!([first.index, second.index, third.index], [0, 1, 2]);
    assert_eq!(first.t, second.t);
    assert!(first.is_rising && !second.is_rising && next().is_none());
}

/// A value that is zero at the start has no sign there; it has one event where it comes back.
#[test]
fn an_event_at_the_start_is_masked() {
    let quarter = quarter_period();
    let mut run = swing::<Dop853>(1e-12);
    // y is 0 at the start, negative then, and 0 again after half a period, which it only touches;
    // the velocity is 0 at the start and changes its sign there
    let event =
        run.advance_until(10.0, [Either], |at| [at.v.x]).expect("a motion").expect("an end of the swing");
    assert!((event.t - 2.0 * quarter).abs() < 1e-8, "{event:?}");
    // what has just happened does not happen again
    let event = run.advance_until(10.0, [Either], |at| [at.v.x]).expect("a motion").expect("the other end");
    assert!((event.t - 4.0 * quarter).abs() < 1e-8, "{event:?}");
}

#[test]
fn only_the_directions_that_are_asked_for_are_events() {
    let quarter = quarter_period();
    for (direction, expected) in [(Rising, 3.0), (Falling, 1.0), (Either, 1.0)] {
        let mut run = swing::<Dop853>(1e-12);
        let event =
            run.advance_until(10.0, [direction], |at| [at.q.x]).expect("a motion").expect("a crossing");
        assert!((event.t - expected * quarter).abs() < 1e-9, "{direction:?}: {event:?}");
    }
}

/// A parabola that touches zero is no change of sign; one that goes through it within a quarter of
/// a step is found with shorter steps.
#[test]
fn what_touches_zero_is_no_event() {
    let touches = |at: &State<GliderCoordinates>| [(at.q.x - 0.3) * (at.q.x - 0.3)];
    assert_eq!(glider().advance_until(1.0, [Either], touches), Ok(None));

    let dips = |at: &State<GliderCoordinates>| [(at.q.x - 0.30) * (at.q.x - 0.31)];
    let short = Tolerances { max_step: 0.02, ..Tolerances::default() };
    let mut run = Adaptive::builder(Glider::declared()).tolerances(short).build().expect("a start");
    let event = run.advance_until(1.0, [Falling], dips).expect("a motion").expect("a dip");
    assert!((event.t - 0.3).abs() < 1e-12, "{event:?}");
}

#[test]
fn states_that_violate_a_constraint_are_refused() {
    let mut run = swing::<Dopri5>(1e-6);
    let mut state = run.state();
    state.q.y = -0.5;
    assert!(matches!(run.set_state(state), Err(Error::Inconsistent { constraint: "rod", .. })));
    assert!(matches!(run.advance_until(f64::NAN, [Either], |at| [at.q.x]), Err(Error::EndTime { .. })));
}

mechanism! {
    /// A ball over ground that is far from the origin, which a hand may hold.
    pub Dropped {
        dof = 1;
        param ground = 0 [m];
        input hold [N];
        gravity = (0, -9.81) [m/s^2];
        body ball (y) { mass = 1 [kg]; }
        force hand on y = hold;
        event hit: y = ground falling;
        start { y = ground + 1 [m]; }
    }
}

/// With restitution e all impacts are over after √(2h/g) (1 + e)/(1 − e), however high the ground: the run comes
/// near to that, ends with an error that says so, and the ball is never below the ground by more than rounding.
#[test]
fn a_ball_is_run_to_where_its_impacts_pile_up() {
    for ground in [0.0_f64, 0.3, -1000.0] {
        for restitution in [0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95] {
            let mechanism = Dropped::new(DroppedParameters { ground }).expect("a height");
            let mut run = Adaptive::builder(mechanism).build().expect("a start");
            let (mut impacts, mut speed) = (0, f64::INFINITY);
            let error = loop {
                match run.advance_to_event(60.0) {
                    Ok(Some(event)) => {
                        let mut state = run.state();
                        let depth = ground - state.q.y;
                        assert!((0.0..1e-14 + 1e-15 * ground.abs()).contains(&depth), "{event:?} {depth}");
                        // with what it came up, but for the rounding of heights
                        assert!(state.v.y < 0.0 && -state.v.y < 1.01 * speed, "{event:?} {state:?} {speed}");
                        state.v.y *= -restitution;
                        speed = state.v.y;
                        run.set_state(state).expect("a free state");
                        impacts += 1;
                    }
                    Ok(None) => panic!("e = {restitution}: it went through the ground"),
                    Err(error) => break error,
                }
            };
            let Error::EndlessEvents { t, name: "hit", index: 0 } = error else { panic!("{error:?}") };
            let over = (2.0 / 9.81_f64).sqrt() * (1.0 + restitution) / (1.0 - restitution);
            assert!((t - over).abs() < 1e-3 && impacts < 1000, "e = {restitution}: {t} {over} {impacts}");
            assert!(speed < 1e-4, "e = {restitution}: {speed}");
            // it says so again, and stays where it is
            let state = run.state();
            assert_eq!((run.advance_to_event(60.0), run.state()), (Err(error), state));
            assert_eq!(state.t, t);
        }
    }
}

/// A ball without a velocity on the ground falls through it, unless something holds it.
#[test]
fn a_ball_that_is_stopped_at_the_ground_has_to_be_held() {
    let mut run = Adaptive::builder(Dropped::declared()).build().expect("a start");
    run.advance_to_event(2.0).expect("a motion").expect("a hit");
    let mut state = run.state();
    state.v.y = 0.0;
    run.set_state(state).expect("a free state");
    let mut held = run.clone();
    let error = run.advance_to_event(2.0).expect_err("nothing holds it");
    assert!(matches!(error, Error::EndlessEvents { name: "hit", .. }), "{error}");

    held.inputs_mut().hold = 9.81;
    assert_eq!(held.advance_to_event(2.0), Ok(None));
    assert!(held.state().q.y.abs() < 1e-14, "{:?}", held.state());
    // and when the hand lets go
    held.inputs_mut().hold = 0.0;
    let error = held.advance_to_event(3.0).expect_err("nothing holds it any more");
    assert!(matches!(error, Error::EndlessEvents { name: "hit", .. }), "{error}");
    assert!(held.state().q.y.abs() < 1e-14, "{:?}", held.state());
}

/// A program may set a state at an event without turning its value around: it goes on behind the event.
#[test]
fn a_value_that_is_not_turned_goes_on_behind_its_event() {
    for share in [1.0, 0.3, 1e-3] {
        let mut run = Adaptive::builder(Dropped::declared()).build().expect("a start");
        run.advance_to_event(2.0).expect("a motion").expect("a hit");
        let mut state = run.state();
        state.v.y *= share;
        run.set_state(state).expect("a free state");
        assert_eq!(run.advance_to_event(0.6), Ok(None), "{share}");
        assert!(run.state().q.y < -0.01, "{share}: {:?}", run.state());
    }
}

/// A start on the ground, to rounding, with a bounce far shorter than a step: its end is an event.
#[test]
fn a_bounce_from_the_ground_is_seen_however_short_it_is() {
    for below in [0.0, -1e-17, 1e-17] {
        for speed in [1.0, 1e-3, 1e-6] {
            let mut run = Adaptive::builder(Dropped::declared()).build().expect("a start");
            let mut state = run.state();
            (state.q.y, state.v.y) = (below, speed);
            run.set_state(state).expect("a free state");
            let event = run.advance_to_event(2.0).expect("a motion").expect("a hit");
            let expected = 2.0 * speed / 9.81;
            assert!((event.t - expected).abs() < 1e-3 * expected, "{below} {speed}: {event:?} {expected}");
        }
    }
}

mechanism! {
    /// A body that is pushed for a moment, and an event in the middle of it.
    pub Pushed {
        dof = 1;
        param width = 20 [ms];
        body sled (x) { mass = 1 [kg]; }
        force push on x = 100 [N]*exp(-((t - 0.7 [s])/width)^2);
        event middle: t = 0.7 [s];
    }
}

/// No stage of a long step met the push, and the step was taken. It was made again with its end at the event, where one
/// stage met the push. The error of that step was not looked at, and the sled had 9.48 m/s.
#[test]
fn a_step_that_ends_at_an_event_meets_the_tolerance() -> Result<(), Error> {
    fn speed<S: AdaptiveScheme>(width: f64) -> Result<f64, Error> {
        let mechanism = Pushed::new(PushedParameters { width })?;
        let builder = Adaptive::builder(mechanism).scheme::<S>().tolerances(Tolerances::relative(1e-8));
        let mut run = builder.build()?;
        let mut events = 0;
        while run.advance_to_event(1.0)?.is_some() {
            events += 1;
        }
        assert_eq!(events, 1);
        Ok(run.state().v.x)
    }
    for width in [0.1e-3, 2e-3, 5e-3, 10e-3, 20e-3, 50e-3] {
        let expected = 100.0 * width * std::f64::consts::PI.sqrt();
        for found in [speed::<Dopri5>(width)?, speed::<Dop853>(width)?, speed::<Esdirk4>(width)?] {
            assert!((found / expected - 1.0).abs() < 1e-6, "{width}: {found} for {expected}");
        }
    }
    Ok(())
}
