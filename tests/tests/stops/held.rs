//! Friction that holds: by forces that change what they follow, behind others that let go, and in steps of every method.

use mbs_runtime::{
    Adaptive, Baumgarte, Error, Held, RATTLE4, Rattle, Rk4, Simulation, System, TrBdf2, mechanism,
};

use super::TIGHT;

mechanism! {
    /// A block on a rail, pulled along it. Its brake pulls in a slant: what holds it presses it on the rail.
    Slanted {
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        body block (x, y) { mass = 2 [kg]; }
        point_on_line rail (block, ground) along (1, 0);
        friction brake (block, ground) along (4, 3) { law = coulomb; coefficient = 0.75; normal = lambda(rail); }
        force pull on block = (10 [N/s]*t, 0);
        state work [J];
        der(work) = power(brake);
        output brake [N] = force(brake);
        output rail [N] = reaction(rail);
    }
}

/// Regression: the responses to a unit impulse asked for the direction of friction, which they do not know, where the force
/// of friction changes the reaction that it follows. Nothing stuck there.
#[test]
fn friction_sticks_that_changes_its_own_reaction() -> Result<(), Error> {
    let mut to_tolerance = Adaptive::builder(Slanted::declared()).tolerances(TIGHT).build()?;
    let mut in_steps = Simulation::new(Slanted::declared(), 1e-3)?;
    in_steps.advance_to(2.0)?;
    // 0.8 F + 10 t = 0, and the rail carries the weight and 0.6 F
    let outputs = in_steps.outputs()?;
    assert!((outputs.brake + 25.0).abs() < 1e-9 && (outputs.rail - 34.62).abs() < 1e-9);
    // |F| = 0.75 (19.62 N + 0.6 |F|)
    let release = 0.8 * 0.75 * 19.62 / (1.0 - 0.75 * 0.6) / 10.0;
    to_tolerance.advance_to(release - 1e-6)?;
    assert_eq!((to_tolerance.inputs().brake_direction, to_tolerance.state().v.x), (0.0, 0.0));
    // from there on it slides with a force that stays, and 10 N/s of pull behind it
    let expected = 10.0 / (2.0 * 2.0) * (3.0 - release).powi(2);
    to_tolerance.advance_to(3.0)?;
    in_steps.advance_to(3.0)?;
    for (v, allowed) in [(to_tolerance.state().v.x, 1e-8), (in_steps.state().v.x, 1e-2)] {
        // steps see that it breaks loose at the end of one: by 5 N/s of a step
        assert!((v - expected).abs() < allowed, "{v} {expected}");
    }
    Ok(())
}

mechanism! {
    /// A rod that leans on a wall without friction.
    Leaning {
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        param angle = 60 [deg];
        body rod (x, y, phi) { mass = 3 [kg]; inertia = 1 [kg*m^2]; }
        point low on rod = (-1 [m], 0);
        point high on rod = (1 [m], 0);
        point_on_line floor (rod.low, ground) along (1, 0);
        point_on_line wall (rod.high, ground) along (0, 1);
        friction grip (rod.low, ground) along (1, 0) { law = coulomb; coefficient = 0.3; normal = reaction(floor); }
        start { phi = 180 [deg] - angle; guess x = 0.1 [m]; guess y = 1 [m]; }
    }
}

/// On its floor it stands if μ ≥ 1/(2 tan α).
#[test]
fn a_leaning_rod_stands_above_its_angle() -> Result<(), Error> {
    let limit = (1.0_f64 / 0.6).atan();
    for (angle, stands) in [(limit - 1e-3, false), (limit + 1e-3, true), (1.2, true), (1.5, true)] {
        let rod = || Leaning::new(LeaningParameters { angle });
        let mut to_tolerance = Adaptive::builder(rod()?).tolerances(TIGHT).build()?;
        let mut in_steps = Simulation::new(rod()?, 1e-3)?;
        to_tolerance.advance_to(0.5)?;
        in_steps.advance_to(0.5)?;
        for phi in [to_tolerance.state().q.phi, in_steps.state().q.phi] {
            let turned = (phi - (std::f64::consts::PI - angle)).abs();
            // feedback leaves steps some 1e-9 rad/s
            assert_eq!(turned < 1e-8, stands, "{angle}: {turned}");
        }
    }
    Ok(())
}

mechanism! {
    /// Two blocks, one on the other, that let go by turns.
    Stack {
        dof = 2;
        body lower (x = a) { mass = 1 [kg]; }
        body upper (x = b) { mass = 1 [kg]; }
        friction ground_grip (lower, ground) along (1, 0) { law = coulomb; coefficient = 0.3; static = 0.6; normal = 10 [N]; }
        friction top_grip (upper, lower) along (1, 0) { law = coulomb; coefficient = 0.1; static = 0.15; normal = 10 [N]; }
        force pull on lower = (10 [N/s]*t, 0);
    }
}

/// Regression: the lower block lets go at 6 N and is braked by 3 N. So both accelerate with 1.5 m/s², for which the upper one
/// needs all that its friction can have, and then more. A run to a tolerance let it hold without a limit.
#[test]
fn friction_that_holds_with_all_it_can_lets_go() -> Result<(), Error> {
    let mut run = Adaptive::builder(Stack::declared()).tolerances(TIGHT).build()?;
    run.advance_to(1.0)?;
    let q = run.state().q;
    // 10 t − 4 N on the lower one, 1 N on the upper one, over 0.4 s
    let lower = 0.5 * 2.0 * 0.4_f64.powi(2) + 10.0 / 6.0 * 0.4_f64.powi(3);
    assert!((q.a - lower).abs() < 1e-9 && (q.b - 0.08).abs() < 1e-9, "{q:?}");
    Ok(())
}

mechanism! {
    /// A rod on a pin, held aslant by its friction.
    Tilted {
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        body rod (x, y, phi) { mass = 1 [kg]; inertia = 0.083 [kg*m^2]; }
        point top on rod = (-0.5 [m], 0);
        revolute pin (rod.top, ground);
        torsion_friction grip (rod, ground) { law = coulomb; torque = 5 [N*m]; }
        start { phi = 20 [deg]; }
    }
}

/// Regression: half of what holds acts before a step and half of it behind, between which methods with inner stages let
/// positions go by h² and more. The rod climbed by 6e-6 rad a second in steps of 10 ms.
#[test]
fn nothing_creeps_in_steps() -> Result<(), Error> {
    let (rod, h) = (Tilted::declared, 0.01);
    let mut runs: [Box<dyn System>; 4] = [
        Box::new(Simulation::new(rod(), h)?),
        Box::new(Simulation::builder(rod(), h).baumgarte(Baumgarte::<Held<Rk4>>::deadbeat(h)).build()?),
        Box::new(TrBdf2::builder(rod(), h).build()?),
        Box::new(Rattle::builder(rod(), h).composition(&RATTLE4).build()?),
    ];
    let start = 20.0_f64.to_radians();
    for run in &mut runs {
        run.advance(10_000)?;
        let (mut q, mut v) = ([0.0_f64; 3], [0.0_f64; 3]);
        run.state(&mut q, &mut v);
        // roundings of 10⁴ steps
        assert!((q[2] - start).abs() < 1e-12 && v[2].abs() < 1e-12, "{q:?} {v:?}");
    }
    Ok(())
}

mechanism! {
    /// A mass that a light brake pad on a stiff spring halts.
    Padded {
        dof = 2;
        body mass (x = a) { mass = 100 [kg]; }
        body pad (x = b) { mass = 0.01 [kg]; }
        potential spring = 1e5 [N/m]*(a - b)^2/2;
        friction grip (pad, ground) along (1, 0) { law = coulomb; coefficient = 0.3; normal = 1000 [N]; }
        start { der(a) = 1 [m/s]; der(b) = 0; }
    }
}

/// Regression: where the period of the pad is a step or two, its speed was 0 at the ends of steps, and it moved by 1 mm in each
/// of them. Nothing braked.
#[test]
fn a_stiff_pad_brakes_in_long_steps() -> Result<(), Error> {
    let mut exact = Adaptive::builder(Padded::declared()).tolerances(TIGHT).build()?;
    exact.advance_to(0.3)?;
    let exact = exact.state();
    for h in [1e-3, 1e-4] {
        let mut run = TrBdf2::builder(Padded::declared(), h).build()?;
        run.advance_to(0.3)?;
        let (q, v) = (run.state().q.a, run.state().v.a);
        // 300 N brake 100 kg, of which a step or two go amiss at every halt of the pad
        assert!(
            (q - exact.q.a).abs() < 4.0 * h && (v - exact.v.a).abs() < 30.0 * h,
            "{h}: {q} {v} {exact:?}"
        );
    }
    Ok(())
}
