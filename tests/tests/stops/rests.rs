//! Rests: where they begin, hold and end.

use mbs_runtime::{Adaptive, Error, Simulation, mechanism};

use paths::STRIDE;

use super::TIGHT;

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
    for (e, impacts) in [(0.5, 6), (0.1, 3), (0.3, 6), (0.7, 12), (0.9, 12)].into_iter().step_by(STRIDE) {
        table_throws(e, impacts)?;
    }
    Ok(())
}

fn table_throws(e: f64, impacts: u32) -> Result<(), Error> {
    let (a, w, g) = (0.01, 20.0, 9.81);
    let table = |t: f64| (a * (w * t).sin(), a * w * (w * t).cos());
    let shaken = Shaken::new(ShakenParameters { e })?;
    let mut run = Adaptive::builder(shaken).tolerances(TIGHT).build()?;
    let (mut t, mut y, mut v, mut sum) = (0.0, 0.1, 0.0, 0.0);
    for impact in 0..impacts {
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
        assert!((run.time() - t).abs() < 1e-12, "e = {e}, impact {impact}: {} {t}", run.time());
        // an impact that is off by δt is one of a speed that is off by g δt
        assert!((run.state().v.y - v).abs() < 1e-11, "e = {e}, impact {impact}: {} {v}", run.state().v.y);
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
    /// A ball on a floor that begins to rise at once.
    Raised {
        dof = 1;
        gravity = (0, -10) [m/s^2];
        body ball (y) { mass = 1 [kg]; }
        stop floor: y >= (if t < 1 [s] { 0 [m] } else { 2 [m/s]*(t - 1 [s]) }) { restitution = 0.5; }
    }
}

/// The floor hits the ball with 2 m/s, which throws it with half of that: flights of 0.2, 0.1, 0.05 s follow. A rest is left
/// behind them, and the ball goes on with the floor. Constant steps see the hit at the end of their step.
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
    let h = 1e-3;
    let mut run = Simulation::new(Raised::declared(), h)?;
    run.advance_to(1.1)?;
    // thrown with 2 (1 + e) m/s up to a step later, and by the force of a step less
    assert!((run.inputs().floor_impulse - 3.0).abs() < 10.0 * h, "{:?}", run.inputs());
    let (t, [y, v]) = (0.1, [run.state().q.y, run.state().v.y]);
    assert!(
        (y - (3.0 * t - 5.0 * t * t)).abs() < 3.0 * h && (v - (3.0 - 10.0 * t)).abs() < 10.0 * h,
        "{y} {v}"
    );
    Ok(())
}

mechanism! {
    /// A ball on a table that lies on a lever, which swings fast, but not so fast that it throws.
    Borne {
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        param e = 0;
        body lever (phi) { inertia = 0.1 [kg*m^2]; }
        drive swing: phi = 0.2 [rad]*sin(9 [rad/s]*t);
        body ball (y) { mass = 2 [kg]; }
        stop table: y >= 0.5 [m]*sin(phi) { restitution = e; }
        start { guess phi = 0; y = 0; der(y) = 0.9 [m/s]; }
    }
}

/// Regression: what rests on a table that speeds up by more than a third of g was hit by it in each constant step, and thrown
/// where that exceeded its share: the force of a rest is no impact, whatever moves.
#[test]
fn a_table_that_speeds_up_does_not_hit() -> Result<(), Error> {
    for e in [0.0, 0.5, 1.0] {
        let borne = Borne::<f64>::new(BorneParameters { e })?;
        let mut run = Simulation::new(borne, 1e-3)?;
        let mut to_tolerance = Adaptive::builder(borne).tolerances(TIGHT).build()?;
        for at in 1..=30 {
            let t = 0.1 * f64::from(at);
            run.advance_to(t)?;
            to_tolerance.advance_to(t)?;
            let found = [run.inputs(), to_tolerance.inputs()].map(|it| (it.table, it.table_impulse));
            assert_eq!(found, [(1.0, 0.0); 2], "e = {e}, t = {t}");
            let table = 0.5 * run.state().q.phi.sin();
            assert!((run.state().q.y - table).abs() < 1e-14, "{:?}", run.state());
        }
    }
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
