//! Friction that sticks: Coulomb's law against closed forms, to a tolerance and with constant steps, and its refusals.

use mbs_live::{Prepared, Run, Text};
use mbs_runtime::equations::{At, Equations};
use mbs_runtime::lanes::Pack as Lanes;
use mbs_runtime::{
    Adaptive, Baumgarte, Dop853, Error, Held, Rk4, Sampled, Simulation, System, TrBdf2, mechanism,
};

use super::{TIGHT, declared};

// a block on a spring, braked by 1 N
mechanism! {
    Oscillator {
        dof = 1;
        body block (x) { mass = 1 [kg]; }
        force spring on x = -1 [N/m]*x;
        friction rub (block, ground) along (1, 0) { coefficient = 0.5; normal = 2 [N]; law = coulomb; }
        start { x = 12 [m]; der(x) = 6 [m/s]; }
        output force [N] = force(rub);
        event turn: der(x) = 0;
    }
}

/// Half a turn about ±1 m at a time: the first turning point is at √(13² + 6²) − 1, each further one 2 m nearer on the other
/// side, until the spring pulls with less than 1 N.
#[test]
fn an_oscillator_comes_to_rest_behind_eight_turning_points() -> Result<(), Error> {
    let first = 13.0_f64.hypot(6.0) - 1.0;
    let mut run = Adaptive::builder(Oscillator::declared()).scheme::<Dop853>().tolerances(TIGHT).build()?;
    let mut turns = Vec::new();
    while let Some(event) = run.advance_to_event(100.0)? {
        turns.push([event.t, run.state().q.x]);
    }
    assert_eq!(turns.len(), 8);
    for (at, &[t, x]) in turns.iter().enumerate() {
        let sign = if at % 2 == 0 { 1.0 } else { -1.0 };
        let turned = sign * (first - 2.0 * at as f64);
        let time = (6.0_f64 / 13.0).atan() + at as f64 * std::f64::consts::PI;
        // the tolerance of 1e-10, over 200 steps of coordinates of 12 m
        assert!((t - time).abs() < 1e-8 && (x - turned).abs() < 1e-8, "{at}: {t} {time}, {x} {turned}");
    }
    let rest = 14.0 - first;
    assert!((run.state().q.x - rest).abs() < 1e-8 && run.state().v.x == 0.0);
    assert_eq!(run.inputs().rub_direction, 0.0);
    // it holds against the spring
    let (at, mut outputs) = (At { t: 0.0, q: &[run.state().q.x], v: &[0.0] }, [f64::NAN]);
    Equations::outputs(run.mechanism(), at, &[0.0; 2], [&[0.0], &[]], &mut outputs);
    assert!((outputs[0] - rest).abs() < 1e-8, "{outputs:?}");
    Ok(())
}

/// A reversal is placed in its step by the speeds at both ends: positions are of second order.
#[test]
fn constant_steps_are_of_second_order() -> Result<(), Error> {
    let rest = 15.0 - 13.0_f64.hypot(6.0);
    for h in [0.04, 0.01] {
        let block = Oscillator::declared;
        let mut runs: [Box<dyn System>; 3] = [
            Box::new(Simulation::new(block(), h)?),
            Box::new(Simulation::builder(block(), h).baumgarte(Baumgarte::<Held<Rk4>>::deadbeat(h)).build()?),
            Box::new(TrBdf2::builder(block(), h).build()?),
        ];
        for run in &mut runs {
            run.advance(run.steps_to(30.0)?)?;
            let (mut x, mut v, mut outputs) = ([0.0], [0.0], [0.0]);
            run.state(&mut x, &mut v);
            // Heun's error of phase, h²/6 in each unit of time, over 22 s of an amplitude of 13 m
            assert!((x[0] - rest).abs() < 50.0 * h * h, "{h}: {} {rest}", x[0]);
            assert_eq!(v, [0.0]);
            run.outputs(&[0.0], &[], &mut outputs)?;
            assert!((outputs[0] - x[0]).abs() < 1e-12, "{outputs:?} {x:?}");
        }
    }
    Ok(())
}

// a block on an incline of 20 degrees, whose guide presses
mechanism! {
    Incline {
        dof = 1;
        param mu = 0.37;
        param angle = 20 [deg];
        gravity = (0, -9.81) [m/s^2];
        body block (x, y) { mass = 1 [kg]; }
        point_on_line slope (block, ground) along (cos(angle), sin(angle));
        friction rub (block, ground) along (cos(angle), sin(angle)) {
            coefficient = mu; normal = reaction(slope); law = coulomb;
        }
    }
}

/// It sticks for 10⁴ s where the coefficient is above tan 20° = 0.364, and slides with g (sin − μ cos) below it.
#[test]
fn a_block_sticks_below_the_angle_of_friction() -> Result<(), Error> {
    let block = |mu: f64| Incline::new(InclineParameters { mu, angle: 20.0_f64.to_radians() });
    let mut run = Adaptive::builder(block(0.37)?).tolerances(TIGHT).build()?;
    run.advance_to(1e4)?;
    // steps of some 100 s round velocities to ε g h = 2e-13 m/s, over 10⁴ s
    assert!(run.state().q.x.abs() < 2e-9, "{}", run.state().q.x);
    let mut steps = Simulation::new(block(0.37)?, 1e-2)?;
    steps.advance_to(1e3)?;
    assert!(steps.state().q.x.abs() < 1e-12, "{}", steps.state().q.x);
    let angle = 20.0_f64.to_radians();
    let down = 9.81 * (angle.sin() - 0.3 * angle.cos());
    let mut run = Adaptive::builder(block(0.3)?).tolerances(TIGHT).build()?;
    run.advance_to(2.0)?;
    let mut steps = Simulation::new(block(0.3)?, 1e-2)?;
    steps.advance_to(2.0)?;
    for x in [run.state().q.x, steps.state().q.x] {
        assert!((x + 2.0 * down * angle.cos()).abs() < 1e-10, "{x}");
    }
    Ok(())
}

// a cart that sticks to its rail, a block that sticks to the cart and falls on it, a wheel with a brake
declared! { PADS;
    Pads {
        dof = 4;
        gravity = (0, -9.81) [m/s^2];
        body cart (x) { mass = 2 [kg]; }
        body block (x = u, y = w) { mass = 1 [kg]; }
        body wheel (angle = phi) { mass = 0; inertia = 0.02 [kg*m^2]; }
        force pull on x = 12 [N]*sin(3 [1/s]*t) - 20 [N/m]*x;
        torque drive on wheel = 0.3 [N*m]*sin(2.3 [1/s]*t);
        stop floor: w >= 0.1 [m] { restitution = 0.2; }
        stop wall: u <= 0.6 [m] { restitution = 0.5; }
        friction rail (cart, ground) along (1, 0) {
            coefficient = 0.2; static = 0.3; normal = 20 [N]; law = coulomb; viscous = 0.1 [N*s/m];
        }
        friction pad (block, cart) along (1, 0) { coefficient = 0.3; normal = 9.81 [N]; law = coulomb; }
        torsion_friction brake (wheel, ground) { torque = 0.1 [N*m]; breakaway = 0.2 [N*m]; law = coulomb; }
        start { x = 0.2 [m]; w = 0.12 [m]; }
        output rail_force [N] = force(rail);
        output pad_force [N] = force(pad);
        output brake_torque [N*m] = torque(brake);
    }
}

/// One friction halts where another one has just broken loose. Breaking loose is seen at the next step, so that constant
/// steps are of first order where static friction is larger.
#[test]
fn steps_come_to_the_run_to_a_tolerance() -> Result<(), Error> {
    let mut exact = Adaptive::builder(Pads::declared()).scheme::<Dop853>().tolerances(TIGHT).build()?;
    exact.advance_to(1.5)?;
    let exact = exact.state().q;
    for h in [1e-3, 1e-4] {
        let mut run = Simulation::new(Pads::declared(), h)?;
        run.advance_to(1.5)?;
        let q = run.state().q;
        for (found, exact) in [(q.x, exact.x), (q.u, exact.u), (q.w, exact.w), (q.phi, exact.phi)] {
            assert!((found - exact).abs() < 2.0 * h, "{h}: {found} {exact}");
        }
    }
    Ok(())
}

/// A type, a lane of it, and a text.
#[test]
fn every_path_has_the_same_bits() -> Result<(), Error> {
    let mut alone = Simulation::new(Pads::declared(), 1e-3)?;
    let (first, second) = (alone, alone);
    let mut pack = Lanes::new([&first, &second]);
    let text = Text::declaration("pads.mbs", PADS).compile().expect("pads");
    let mut read = Run::builder(&text, 1e-3).build()?;
    for _ in 0..2000 {
        alone.step()?;
        read.step()?;
        if pack.advance(1) == 0 {
            assert_eq!(pack.step(), [true; 2]);
        }
        let rows = [&alone as &dyn System, &read, &pack.simulation(1)].map(|run| {
            let (mut q, mut v, mut inputs) = ([0.0; 4], [0.0; 4], [0.0; 10]);
            run.state(&mut q, &mut v);
            run.inputs(&mut inputs);
            (q, v, inputs)
        });
        assert!(rows[0] == rows[1] && rows[0] == rows[2], "{rows:?}");
    }
    Ok(())
}

/// The position and the speed of the first coordinate of a text at a time, to a tolerance.
fn at(text: &str, t: f64) -> Result<[f64; 2], Error> {
    let live = Text::declaration("sticking.mbs", text).compile().expect("a mechanism");
    let mut run = Sampled::new(Adaptive::builder(Prepared::new(&live)).tolerances(TIGHT).build()?, t)?;
    run.advance(1)?;
    let (mut q, mut v) = ([0.0; 2], [0.0; 2]);
    run.state(&mut q, &mut v);
    Ok([q[0], v[0]])
}

/// A block slides forth in the first half of a period and back in the second one. Another block on it, with a coefficient of 0,
/// stays where it is.
#[test]
fn friction_without_a_largest_force_holds_nothing() -> Result<(), Error> {
    let text = |first: &str, second: &str| {
        format!(
            "Forth {{
                dof = 2;
                body {first} (x = a) {{ mass = 1 [kg]; }}
                body {second} (x = b) {{ mass = 1 [kg]; }}
                force pull on block = (10 [N]*sin(pi/2*t/(1 [s])), 0 [N]);
                friction rub (block, ground) along (-1, 0) {{ coefficient = 0.3; normal = 20 [N]; law = coulomb; }}
                friction pad (top, block) along (1, 0) {{ coefficient = 0; normal = 20 [N]; law = coulomb; }}
            }}"
        )
    };
    assert_eq!(at(&text("top", "block"), 4.3)?, [0.0, 0.0]);
    let block = at(&text("block", "top"), 4.3)?;
    assert!(block[0].abs() < 1e-8 && block[1] == 0.0, "{block:?}");
    Ok(())
}

/// A block is pressed against a stop and then pulled away: friction holds it until its largest force is reached, where
/// sin 2t = −5/19.
#[test]
fn friction_holds_what_leaves_a_stop() -> Result<(), Error> {
    let text = "Held {
        dof = 1;
        body block (x) { mass = 1 [kg]; }
        force pull on x = 19 [N]*sin(2*t/(1 [s]));
        friction rub (block, ground) along (1, 0) { coefficient = 0; static = 0.25; normal = 20 [N]; law = coulomb; }
        stop end: x <= 0 [m] { restitution = 0.25; }
        start { x = -0.01 [m]; der(x) = 0.1 [m/s]; }
    }";
    let leaves = f64::midpoint(std::f64::consts::PI, (5.0_f64 / 19.0).asin());
    assert!(at(text, leaves - 1e-4)?[0].abs() < 1e-12);
    // with 5 N and more, over 10 ms
    let (h, [x, v]) = (1e-2, at(text, leaves + 1e-2)?);
    assert!((x + 2.5 * h * h).abs() < 0.2 * h * h && (v + 5.0 * h).abs() < 0.4 * h, "{x} {v}");
    Ok(())
}

/// An impact that takes all of the speed turns friction around: towards the stop the block is slowed down by 25 N, from
/// it driven by 15 N.
#[test]
fn an_impact_that_halts_turns_friction_around() -> Result<(), Error> {
    let text = "Thrown {
        dof = 1;
        body block (x) { mass = 2 [kg]; }
        force push on x = -20 [N];
        friction rub (block, ground) along (1, 0) { coefficient = 0.25; normal = 20 [N]; law = coulomb; }
        stop end: x <= 0.5 [m] { restitution = 0; }
        start { x = 0.4 [m]; der(x) = 2 [m/s]; }
    }";
    let hits = (2.0 - 1.5_f64.sqrt()) / 12.5;
    let [x, v] = at(text, hits + 0.1)?;
    assert!((x - (0.5 - 3.75 * 0.01)).abs() < 1e-9 && (v + 0.75).abs() < 1e-8, "{x} {v}");
    Ok(())
}

mechanism! {
    /// A block that a force pushes against a stop, and holds there.
    Pressed {
        dof = 1;
        param e = 0;
        body block (x) { mass = 2 [kg]; }
        force push on x = 30 [N];
        friction rub (block, ground) along (1, 0) { coefficient = 0.5; normal = 20 [N]; law = coulomb; }
        stop end: x <= 0.5 [m] { restitution = e; }
        output rub [N] = force(rub);
    }
}

/// Regression: what a stop halts has no direction any more. With constant steps a speed of exactly 0 was none that had changed
/// its sign, and friction went on with its force.
#[test]
fn what_a_stop_halts_sticks() -> Result<(), Error> {
    for e in [0.0, 0.5] {
        let pressed = Pressed::new(PressedParameters { e })?;
        let mut in_steps = Simulation::new(pressed, 1e-3)?;
        let mut to_tolerance = Adaptive::builder(pressed).tolerances(TIGHT).build()?;
        in_steps.advance_to(1.5)?;
        to_tolerance.advance_to(1.5)?;
        let directions = [in_steps.inputs().rub_direction, to_tolerance.inputs().rub_direction];
        assert_eq!((in_steps.outputs()?.rub, directions), (0.0, [0.0; 2]), "{e}");
        assert_eq!([in_steps.inputs().end, to_tolerance.inputs().end], [1.0; 2], "{e}");
    }
    Ok(())
}

mechanism! {
    /// A flywheel with a Scotch yoke that rubs.
    Yoke {
        dof = 1;
        body wheel (phi) { inertia = 1 [kg*m^2]; }
        body yoke (x) { mass = 1 [kg]; }
        constraint pin: x = 0.1 [m]*cos(phi);
        friction rub (yoke, ground) along (1, 0) { coefficient = 0.3; normal = 100 [N]; law = coulomb; }
        start { phi = 90 [deg]; der(phi) = 10 [rad/s]; }
    }
}

/// Regression: at a dead centre the yoke stands still for an instant, and no force at it holds the wheel. A run to a tolerance
/// took it for sticking, and all of the wheel's energy. Friction takes 30 N times the way of the yoke.
#[test]
fn a_dead_centre_is_passed() -> Result<(), Error> {
    let mut to_tolerance = Adaptive::builder(Yoke::declared()).tolerances(TIGHT).build()?;
    let mut in_steps = Simulation::new(Yoke::declared(), 1e-4)?;
    to_tolerance.advance_to(2.0)?;
    in_steps.advance_to(2.0)?;
    // Heun's error and that of a reversal, which is placed in its step, are of second order
    for (state, allowed) in [(to_tolerance.state(), 1e-8), (in_steps.state(), 1e-4)] {
        let (phi, v) = (state.q.phi, state.v);
        let energy = 0.5 * (v.phi * v.phi + v.x * v.x);
        // ∫|sin φ| from the start, a quarter of a turn, where it is 1
        let halves = (phi / std::f64::consts::PI).floor();
        let way = 0.1 * (2.0 * halves - (phi - halves * std::f64::consts::PI).cos());
        assert!(phi > 17.0 && (energy - (50.5 - 30.0 * way)).abs() < allowed, "{phi} {energy} {way}");
    }
    Ok(())
}

mechanism! {
    /// A block that a drive moves, which rubs.
    Driven {
        dof = 0;
        body block (x) { mass = 1 [kg]; }
        drive way: x = 0.1 [m]*(1 - cos(5 [rad/s]*t));
        friction rub (block, ground) along (1, 0) { coefficient = 0.3; normal = 10 [N]; law = coulomb; }
        output rub [N] = force(rub);
        output effort [N] = effort(way);
    }
}

/// Regression: what a drive moves is held by nothing, and slides on behind each reversal. With constant steps it had no
/// friction from the first one on, to a tolerance none until the end of a step.
#[test]
fn a_driven_block_rubs_behind_every_reversal() -> Result<(), Error> {
    let mut to_tolerance = Adaptive::builder(Driven::declared()).build()?;
    let mut in_steps = Simulation::new(Driven::declared(), 1e-3)?;
    for at in 1..40 {
        // not at reversals, which are at multiples of π/5 s
        let t = 0.1 * f64::from(at);
        to_tolerance.advance_to(t)?;
        in_steps.advance_to(t)?;
        let expected = -3.0 * (5.0 * t).sin().signum();
        let effort = 2.5 * (5.0 * t).cos() - expected;
        let directions = [to_tolerance.inputs().rub_direction, in_steps.inputs().rub_direction];
        assert_eq!(directions, [-expected / 3.0; 2], "{t}");
        let outputs = in_steps.outputs()?;
        assert!((outputs.rub - expected).abs() < 1e-9, "{t}: {}", outputs.rub);
        assert!((outputs.effort - effort).abs() < 1e-9, "{t}: {} {effort}", outputs.effort);
    }
    Ok(())
}
