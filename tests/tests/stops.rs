//! Stops: impacts against closed forms, rests that hold and end, several at once. Many impacts and random ones are in
//! `tests/long`.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_live::{Prepared, Text};
use mbs_runtime::{
    Adaptive, Components, Dop853, Dual, Error, Mechanism, Real, Sampled, Simulation, System, Tolerances,
    mechanism,
};

const TIGHT: Tolerances = Tolerances { rtol: 1e-10, atol: 1e-12, max_step: f64::INFINITY, first_step: None };

mechanism! {
    /// A ball that falls from a height of 1 m.
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
        let mut run = Adaptive::builder(ball).tolerances(TIGHT).build()?;
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

mechanism! {
    /// A ball on a table that shakes.
    Shaken {
        dof = 1;
        param e = 0.3;
        gravity = (0, -9.81) [m/s^2];
        body ball (y) { mass = 1 [kg]; }
        stop top: y >= 0.01 [m]*sin(20 [rad/s]*t) { restitution = e; }
        start { y = 0.1 [m]; }
    }
}

/// The table throws with its own velocity. Where the ball comes to rest on it, its acceleration, 4 m/s², never exceeds
/// gravity, so that it stays.
#[test]
fn a_table_that_moves_throws() -> Result<(), Error> {
    let (a, w, g, e) = (0.01, 20.0, 9.81, 0.3);
    let table = |t: f64| (a * (w * t).sin(), a * w * (w * t).cos());
    let mut run = Adaptive::builder(Shaken::declared()).tolerances(TIGHT).build()?;
    let (mut t, mut y, mut v, mut sum) = (0.0, 0.1, 0.0, 0.0);
    for impact in 0..6 {
        // the next impact, by bisection
        let gap = |s: f64| y + v * s - 0.5 * g * s * s - table(t + s).0;
        let mut to = 1e-5;
        while gap(to) > 0.0 {
            to += 1e-5;
        }
        let mut from = to - 1e-5;
        for _ in 0..60 {
            let middle = f64::midpoint(from, to);
            if gap(middle) > 0.0 { from = middle } else { to = middle }
        }
        let speed = v - g * to;
        t += to;
        let (height, rate) = table(t);
        (y, v) = (height, rate - e * (speed - rate));
        while run.inputs().top_impulse == sum {
            run.step()?;
        }
        sum = run.inputs().top_impulse;
        assert!((run.time() - t).abs() < 1e-10, "impact {impact}: {} {t}", run.time());
        assert!((run.state().v.y - v).abs() < 1e-9, "impact {impact}: {} {v}", run.state().v.y);
    }
    run.advance_to(20.0)?;
    let (now, (height, rate)) = (run.state(), table(20.0));
    assert!(run.inputs().top == 1.0 && (now.q.y - height).abs() < 1e-12 && (now.v.y - rate).abs() < 1e-11);
    Ok(())
}

mechanism! {
    /// A case that a rope lifts off the ground.
    Lifted {
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        body case (y) { mass = 3 [kg]; }
        force rope on y = 5 [N/s]*t;
        stop ground: y >= 0 [m] { restitution = 0.5; }
        output height [m] = y;
    }
}

/// It rests until the rope carries it, at m g/5 s, and then moves by 5 (t − t₁)³/(6 m).
#[test]
fn what_rests_is_lifted() -> Result<(), Error> {
    let mut run = Adaptive::builder(Lifted::declared()).tolerances(TIGHT).build()?;
    let lifted: f64 = 3.0 * 9.81 / 5.0;
    run.advance_to(lifted - 1e-6)?;
    assert!(run.inputs().ground == 1.0 && run.state().q.y == 0.0 && run.state().v.y == 0.0);
    run.advance_to(8.0)?;
    let expected = 5.0 * (8.0 - lifted).powi(3) / 18.0;
    let found = run.state().q.y;
    assert!(run.inputs().ground == 0.0 && (found - expected).abs() < 1e-9, "{found} {expected}");
    assert_eq!(run.inputs().ground_impulse, 0.0);
    Ok(())
}

mechanism! {
    /// A case on the ground that magnets pull up and push down from one moment to the next.
    Switched {
        dof = 2;
        gravity = (0, -9.81) [m/s^2];
        param begin = 0.5 [s];
        body case (y) { mass = 3 [kg]; }
        force magnet on y = if t > begin && t < begin + 0.1 [s] { 60 [N] } else { 0 };
        stop ground: y >= 0 [m] { restitution = 0; }
        // a slide without weight, which a clock pushes against its end
        memory push [N] = 0;
        every 0.25 [s] { set push = if t > 0.6 [s] { 2 [N] } else { 0 }; }
        body slide (x) { mass = 1 [kg]; }
        force pushed on x = push;
        stop end: x <= 0 [m] { restitution = 0; }
    }
}

/// A force that jumps lifts what rested from that moment on, and presses what lay loosely at its end.
#[test]
fn forces_that_jump_end_and_begin_rests() -> Result<(), Error> {
    let mut run = Adaptive::builder(Switched::declared()).tolerances(TIGHT).build()?;
    run.advance_to(0.6)?;
    let (a, state) = (60.0 / 3.0 - 9.81, run.state());
    assert!((state.q.y - 0.005 * a).abs() < 1e-10 && (state.v.y - 0.1 * a).abs() < 1e-10, "{state:?}");
    run.advance_to(10.0)?;
    let (state, inputs) = (run.state(), run.inputs());
    assert!(state.q.y.abs() < 1e-12 && inputs.ground == 1.0, "{state:?}");
    assert!(state.q.x.abs() < 1e-12 && inputs.end == 1.0, "{state:?}");
    Ok(())
}

mechanism! {
    /// Three balls in a row, of which the last two touch.
    Row {
        dof = 3;
        param e = 1;
        const r = 10 [mm];
        body one (x = x1) { mass = 1 [kg]; }
        body two (x = x2) { mass = 1 [kg]; }
        body three (x = x3) { mass = 1 [kg]; }
        stop first: x2 - x1 >= 2*r { restitution = e; }
        stop second: x3 - x2 >= 2*r { restitution = e; }
        start { x1 = -0.1 [m]; der(x1) = 1 [m/s]; x2 = 0; x3 = 20 [mm]; }
    }
}

/// Newton's law at all contacts at once, ġ⁺ ≥ −e ġ⁻ with an impulse only where it is equal: the contact of two and
/// three opens by nothing, as it did not close. With e = 1 the balls have −1/3, 2/3 and 2/3 of the velocity.
#[test]
fn simultaneous_impacts_follow_newtons_law() -> Result<(), Error> {
    let mut run = Adaptive::builder(Row::declared()).tolerances(TIGHT).build()?;
    run.advance_to(0.1)?;
    let v = run.state().v;
    let expected = [-1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0];
    for (found, expected) in [v.x1, v.x2, v.x3].into_iter().zip(expected) {
        assert!((found - expected).abs() < 1e-12, "{v:?}");
    }
    let inputs = run.inputs();
    assert!(
        (inputs.first_impulse - 4.0 / 3.0).abs() < 1e-12 && (inputs.second_impulse - 2.0 / 3.0).abs() < 1e-12
    );
    Ok(())
}

/// One that touches and opens is not pulled shut: the first two balls have their impact, and then the second one may
/// follow the third. No energy comes of it.
#[test]
fn contacts_that_open_have_no_part_in_an_impact() -> Result<(), Error> {
    let mut row = Row::<f64>::declared().declared_start();
    (row.q.x1, row.v.x1, row.v.x3) = (-0.02, 1.0, 0.5);
    let mut run = Adaptive::builder(Row::declared()).from_state(row).tolerances(TIGHT).build()?;
    run.advance_to(0.2)?;
    let v = run.state().v;
    // equal balls that lose nothing change velocities: 1 and 0, then 1 and 0.5
    for (found, expected) in [v.x1, v.x2, v.x3].into_iter().zip([0.0, 0.5, 1.0]) {
        assert!((found - expected).abs() < 1e-12, "{v:?}");
    }
    Ok(())
}

mechanism! {
    /// A ball on a floor that begins to rise at once.
    Raised {
        dof = 1;
        gravity = (0, -10) [m/s^2];
        body ball (y) { mass = 1 [kg]; }
        stop floor: y >= (if t < 1 [s] { 0 [m] } else { 2 [m/s]*(t - 1 [s]) }) { restitution = 0.5; }
    }
}

/// The floor hits the ball with 2 m/s, which throws it with half of that: flights of 0.2, 0.1, 0.05 s follow. A rest is left
/// behind them, and the ball goes on with the floor.
#[test]
fn a_floor_that_begins_to_move_throws() -> Result<(), Error> {
    let mut run = Adaptive::builder(Raised::declared()).tolerances(TIGHT).build()?;
    let (mut times, mut sum) = (Vec::new(), 0.0);
    while run.inputs().floor == 0.0 || times.is_empty() {
        run.step()?;
        if run.inputs().floor_impulse > sum {
            sum = run.inputs().floor_impulse;
            times.push(run.time());
        }
    }
    for (found, expected) in times.iter().zip([1.0, 1.2, 1.3, 1.35, 1.375]) {
        assert!((found - expected).abs() < 1e-11, "{times:?}");
    }
    run.advance_to(3.0)?;
    assert!((run.state().q.y - 4.0).abs() < 1e-9 && (run.state().v.y - 2.0).abs() < 1e-9);
    Ok(())
}

mechanism! {
    /// A block that spins in its fall: one step of its motion is many turns of its corners.
    Spinning {
        dof = 3;
        gravity = (0, -9.81) [m/s^2];
        body block (x, y, phi) { mass = 2 [kg]; inertia = 0.02 [kg*m^2]; }
        point a on block = (-0.15, -0.05) [m];
        point b on block = (0.15, -0.05) [m];
        point c on block = (0.15, 0.05) [m];
        point d on block = (-0.15, 0.05) [m];
        stop at_a: block.a.y >= 0 [m] { restitution = 0.5; }
        stop at_b: block.b.y >= 0 [m] { restitution = 0.5; }
        stop at_c: block.c.y >= 0 [m] { restitution = 0.5; }
        stop at_d: block.d.y >= 0 [m] { restitution = 0.5; }
        start { y = 3 [m]; der(phi) = 60 [rad/s]; }
    }
}

#[test]
fn corners_of_what_spins_are_seen() -> Result<(), Error> {
    let corners = [(-0.15, -0.05), (0.15, -0.05), (0.15, 0.05), (-0.15, 0.05)];
    for speed in [3.0, 17.0, 60.0, -75.0] {
        let gap = |t: f64| {
            let (sine, cosine) = (speed * t).sin_cos();
            let heights = corners.map(|(x, y)| 3.0 - 4.905 * t * t + sine * x + cosine * y);
            heights.into_iter().fold(f64::INFINITY, f64::min)
        };
        let mut t = 0.0;
        while gap(t) > 0.0 {
            t += 1e-6;
        }
        let mut state = Spinning::<f64>::declared().declared_start();
        state.v.phi = speed;
        let mut run = Adaptive::builder(Spinning::declared()).from_state(state).build()?;
        let hit = |run: &Adaptive<Spinning<f64>>| {
            let inputs = run.inputs();
            inputs.at_a_impulse + inputs.at_b_impulse + inputs.at_c_impulse + inputs.at_d_impulse > 0.0
        };
        while !hit(&run) {
            run.step()?;
        }
        assert!((run.time() - t).abs() < 2e-6, "{speed}: {} {t}", run.time());
    }
    Ok(())
}

mechanism! {
    /// A ram that a drive leads against its end.
    Driven {
        dof = 0;
        body ram (x) { mass = 1 [kg]; }
        drive push: x = 0.1 [m/s]*t;
        stop end: x <= 0.2 [m] { restitution = 0.5; }
    }
}

/// Nothing answers that, and nothing goes on through the stop.
#[test]
fn a_drive_against_a_stop_ends_the_run() -> Result<(), Error> {
    let mut run = Adaptive::builder(Driven::declared()).build()?;
    let error = run.advance_to(3.0);
    assert!(matches!(error, Err(Error::Impact { stop: "end", t }) if (t - 2.0).abs() < 1e-9), "{error:?}");
    Ok(())
}

mechanism! {
    /// A weight on the ground under a load that swings, and grows slowly.
    Loaded {
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        body weight (y) { mass = 1 [kg]; }
        force load on y = 9 [N]*sin(1 [rad/s]*t) + 1e-3 [N/s]*t;
        stop ground: y >= 0 [m] { restitution = 0; }
    }
}

/// Nothing moves for minutes, so that steps would grow over many swings of the load. The force at the ground is looked at
/// all the same: it ends where 9 sin t + 0.001 t = 9.81 for the first time.
#[test]
fn a_long_rest_ends_in_time() -> Result<(), Error> {
    let pulls = |t: f64| 9.0 * t.sin() + 1e-3 * t - 9.81;
    let mut t = 0.0;
    while pulls(t) < 0.0 {
        t += 1e-4;
    }
    let mut run = Adaptive::builder(Loaded::declared()).tolerances(TIGHT).build()?;
    while run.inputs().ground == 1.0 {
        run.step()?;
    }
    assert!((run.time() - t).abs() < 2e-4, "{} {t}", run.time());
    Ok(())
}

mechanism! {
    /// A slider-crank whose slider has 1 mm of play in its guide (Flores, Leine, Glocker 2010, without friction).
    Clearance {
        dof = 3;
        const l1 = 0.153 [m];
        const l2 = 0.306 [m];
        const a = 0.05 [m];
        const b = 0.025 [m];
        const d = 0.026 [m];
        gravity = (0, -9.81) [m/s^2];
        body crank (x1, y1, theta1) { mass = 0.038 [kg]; inertia = 7.4e-5 [kg*m^2]; }
        body rod (x2, y2, theta2) { mass = 0.038 [kg]; inertia = 5.9e-4 [kg*m^2]; }
        body slider (x3, y3, theta3) { mass = 0.076 [kg]; inertia = 2.7e-6 [kg*m^2]; }
        point base on crank = (-l1/2, 0);
        point pin on crank = (l1/2, 0);
        point base on rod = (-l2/2, 0);
        point pin on rod = (l2/2, 0);
        point p1 on slider = (-a, b);
        point p2 on slider = (a, b);
        point p3 on slider = (-a, -b);
        point p4 on slider = (a, -b);
        revolute main (crank.base, ground);
        revolute joint (crank.pin, rod.base);
        revolute wrist (rod.pin, slider);
        stop c1: slider.p1.y <= d { restitution = 0.4; }
        stop c2: slider.p2.y <= d { restitution = 0.4; }
        stop c3: slider.p3.y >= -d { restitution = 0.4; }
        stop c4: slider.p4.y >= -d { restitution = 0.4; }
        output up [m/s] = der(slider.p1.y);
        start {
            theta1 = 0;
            theta2 = 0;
            theta3 = 0;
            der(theta1) = 150 [rad/s];
            der(theta2) = -75 [rad/s];
            der(theta3) = 0;
            guess x1 = 0.07 [m];
            guess x2 = 0.3 [m];
            guess x3 = 0.459 [m];
        }
    }
}

/// The published first contact is at t = 2.692502752 ms with the angles 0.355304455 and −0.171509541, of two corners at
/// once. The work of the impulses, ½ Σ Λ (ġ⁺ + ġ⁻), is what the kinetic energy changes by; joints do none.
#[test]
fn a_slider_with_clearance_hits_where_it_was_published() -> Result<(), Error> {
    let tolerances = Tolerances { rtol: 1e-12, atol: 1e-13, ..TIGHT };
    let mut run =
        Adaptive::builder(Clearance::declared()).scheme::<Dop853>().tolerances(tolerances).build()?;
    let mut before = run.state();
    while run.inputs().c1_impulse == 0.0 {
        before = run.state();
        run.step()?;
    }
    let now = run.state();
    assert!((run.time() - 2.692_502_752e-3).abs() < 1e-12, "{}", run.time());
    assert!((now.q.theta1 - 0.355_304_455).abs() < 1e-9 && (now.q.theta2 + 0.171_509_541).abs() < 1e-9);
    let inputs = *run.inputs();
    assert!((inputs.c1_impulse - inputs.c2_impulse).abs() < 1e-12 * inputs.c1_impulse);
    assert_eq!([inputs.c3_impulse, inputs.c4_impulse], [0.0; 2]);
    // −e of the rate before; a run that stops short of the impact has that
    let mut short =
        Adaptive::builder(Clearance::declared()).scheme::<Dop853>().tolerances(tolerances).build()?;
    short.advance_to(run.time() - 1e-12)?;
    let rate = |state: &mbs_runtime::State<ClearanceCoordinates>| state.v.y3;
    let (came, goes) = (rate(&short.state()), rate(&now));
    assert!((goes + 0.4 * came).abs() < 1e-7 * came.abs(), "{came} {goes}");
    let [kinetic, after] = [&short.state(), &now].map(|state| run.mechanism().kinetic_energy(state));
    let work = -0.5 * (inputs.c1_impulse + inputs.c2_impulse) * (came + goes);
    assert!((after - kinetic - work).abs() < 1e-8 * kinetic, "{} {work}", after - kinetic);
    let violation = run.mechanism().phi_dot(&now);
    assert!(violation.into_array().iter().all(|rate| rate.abs() < 1e-11), "{violation:?}");
    assert!(before.t < now.t);
    // and on, over a turn of the crank
    run.advance_to(0.05)?;
    let slider = run.state().q;
    assert!(slider.y3.abs() < 1.01e-3 && slider.theta3.abs() < 0.03, "{slider:?}");
    Ok(())
}

/// The ball as a text takes the steps of the type, to the bit.
#[test]
fn a_text_bounces_as_a_type() -> Result<(), Error> {
    let text = "Ball {
        dof = 1;
        param e = 0.7;
        gravity = (0, -9.81) [m/s^2];
        body ball (y) { mass = 2 [kg]; }
        stop floor: y >= 0 [m] { restitution = e; }
        start { y = 1 [m]; }
    }";
    let live = Text::declaration("ball.mbs", text).compile().expect("a ball");
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

/// What sees no impact says so.
#[test]
fn constant_steps_refuse_stops() {
    let refused = Simulation::new(Ball::declared(), 1e-3).expect_err("an error");
    assert!(
        refused
            .to_string()
            .starts_with("a run with constant steps does not see the impacts of the stop `floor`")
    );
    let mut behind = Ball::<f64>::declared().declared_start();
    behind.q.y = -0.1;
    let refused = Adaptive::builder(Ball::declared()).from_state(behind).build().expect_err("an error");
    assert!(refused.to_string().contains("is behind the stop `floor`: its gap is -0.1"), "{refused}");
}
