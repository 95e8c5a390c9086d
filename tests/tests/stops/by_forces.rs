//! Conditions on forces and accelerations: freewheels, magnets, pins that shear, belts that lock.

use mbs_live::{Prepared, Run, Text};
use mbs_runtime::lanes::Pack as Lanes;
use mbs_runtime::{Adaptive, Dop853, Dual, Error, Real, Sampled, Simulation, System, mechanism};

use super::{TIGHT, declared};

// a hub that drives a wheel, and that the wheel overruns
declared! { FREEWHEEL;
    Freewheel {
        dof = 2;
        body hub (theta) { inertia = 1 [kg*m^2]; }
        body wheel (phi) { inertia = 3 [kg*m^2]; }
        torque motor on theta = 2 [N*m]*cos(t/(1 [s])) + 0.3 [N*m];
        mode engaged = 1 { rate lock: der(theta) = der(phi); }
        when lambda(lock) < 0 { leave engaged; }
        when der(theta) > der(phi) { enter engaged; }
        start { der(theta) = 1 [rad/s]; der(phi) = 1 [rad/s]; }
        output drive [N*m] = lambda(lock);
    }
}

/// The rates of hub and wheel at a time. Together they are of 4 kg·m². The hub is let go where the torque 2 cos t + 0.3 turns
/// negative, and engages where its integral is again what it was there.
fn rates(end: f64) -> [f64; 2] {
    let integral = |t: f64| 2.0 * t.sin() + 0.3 * t;
    let zero = |value: &dyn Fn(f64) -> f64, mut from: f64, mut to: f64| {
        for _ in 0..100 {
            let middle = 0.5 * (from + to);
            *(if (value(middle) > 0.0) == (value(from) > 0.0) { &mut from } else { &mut to }) = middle;
        }
        from
    };
    let (mut t, mut rate) = (0.0, 1.0);
    for turn in 0.. {
        let turns = 2.0 * std::f64::consts::PI * f64::from(turn);
        let left = zero(&|t| 2.0 * t.cos() + 0.3, turns, turns + 3.0);
        if end < left {
            return [rate + (integral(end) - integral(t)) / 4.0; 2];
        }
        rate += (integral(left) - integral(t)) / 4.0;
        // behind its least value the integral rises
        let least = turns + 2.0 * std::f64::consts::PI - left + turns;
        t = zero(&|t| integral(t) - integral(left), least, least + 4.0);
        if end < t {
            return [rate + integral(end) - integral(left), rate];
        }
    }
    [f64::NAN; 2]
}

#[test]
fn a_freewheel_is_let_go_by_its_torque() -> Result<(), Error> {
    let mut run = Adaptive::builder(Freewheel::declared()).tolerances(TIGHT).build()?;
    let mut in_steps = Simulation::new(Freewheel::declared(), 1e-3)?;
    let (mut engaged, mut freed) = (0, 0);
    for moment in 1..80 {
        let end = 0.25 * f64::from(moment);
        run.advance_to(end)?;
        in_steps.advance_to(end)?;
        let [theta, phi] = rates(end);
        let (to_tolerance, stepped) = (run.state().v, in_steps.state().v);
        assert!((to_tolerance.theta - theta).abs() < 1e-8 && (to_tolerance.phi - phi).abs() < 1e-8, "{end}");
        // a moment is known to a step, in which the rates of both differ by some 2 rad/s² h
        assert!((stepped.theta - theta).abs() < 1e-2 && (stepped.phi - phi).abs() < 1e-2, "{end}");
        let drive = in_steps.outputs()?.drive;
        let expected = if theta == phi { 0.75 * (2.0 * end.cos() + 0.3) } else { 0.0 };
        assert!((drive - expected).abs() < 1e-9, "{end}: {drive} {expected}");
        *(if theta == phi { &mut engaged } else { &mut freed }) += 1;
    }
    assert!(engaged > 20 && freed > 20, "{engaged} {freed}");
    Ok(())
}

/// A type, a lane of it, and a text.
#[test]
fn every_path_has_the_same_bits() -> Result<(), Error> {
    let mut alone = Simulation::new(Freewheel::declared(), 7e-3)?;
    let (first, second) = (alone, alone);
    let mut pack = Lanes::new([&first, &second]);
    let text = Text::declaration("freewheel.mbs", FREEWHEEL).compile().expect("a freewheel");
    let mut read = Run::builder(&text, 7e-3).build()?;
    let mut changes = 0;
    for _ in 0..2000 {
        let before = alone.inputs().engaged;
        alone.step()?;
        changes += i32::from(alone.inputs().engaged != before);
        read.step()?;
        if pack.advance(1) == 0 {
            assert_eq!(pack.step(), [true; 2]);
        }
        let rows = [&alone as &dyn System, &read, &pack.simulation(1)].map(|run| {
            let (mut q, mut v, mut inputs) = ([0.0; 2], [0.0; 2], [0.0; 4]);
            run.state(&mut q, &mut v);
            run.inputs(&mut inputs);
            (q, v, inputs)
        });
        assert!(rows[0] == rows[1] && rows[0] == rows[2], "{rows:?}");
    }
    assert_eq!(changes, 4);
    Ok(())
}

mechanism! {
    /// A plate on a magnet, pulled by a force that grows.
    Magnet {
        dof = 1;
        param strength = 30 [N];
        body plate (y) { mass = 2 [kg]; }
        force pull on y = 10 [N/s]*t;
        mode held = 1 { constraint magnet: y = 0; }
        when lambda(magnet) > strength { leave held; }
    }
}

/// It leaves at τ = F/(10 N/s), and is at m y = 10/6 (t − τ)³ + F/2 (t − τ)² from then on, so that m dy/dF = −F (t − τ)/10.
#[test]
fn a_magnet_lets_go_and_derivatives_go_through_it() -> Result<(), Error> {
    let strength = Dual::<f64, 1>::variable(30.0, 0);
    let run = Adaptive::builder(Magnet::new(MagnetParameters { strength })?);
    let mut run = run.scheme::<Dop853>().tolerances(TIGHT).build()?;
    run.advance_to(5.0)?;
    let y = run.state().q.y;
    let rest = 2.0;
    let expected = (10.0 / 6.0 * rest * rest * rest + 0.5 * 30.0 * rest * rest) / 2.0;
    let derivative = -0.1 * 30.0 * rest / 2.0;
    assert!((y.to_f64() - expected).abs() < 1e-8, "{y:?} {expected}");
    assert!((y.partial(0) - derivative).abs() < 1e-7, "{y:?} {derivative}");
    Ok(())
}

/// Positions, velocities and memories.
type Seen = [Vec<f64>; 3];

/// Both kinds of run of a text up to a time.
fn runs(text: &str, end: f64) -> [Result<Seen, Error>; 2] {
    let live = Text::declaration("forces.mbs", text).compile().expect("a mechanism");
    let seen = |run: &dyn System| {
        let count = run.equations().info().coordinates.len();
        let (mut q, mut v) = (vec![0.0; count], vec![0.0; count]);
        let mut inputs = vec![0.0; run.equations().info().inputs.len()];
        run.state(&mut q, &mut v);
        run.inputs(&mut inputs);
        [q, v, inputs]
    };
    let to_tolerance = Adaptive::builder(Prepared::new(&live)).tolerances(TIGHT).build();
    let to_tolerance = to_tolerance.and_then(|run| {
        let mut run = Sampled::new(run, end)?;
        run.advance(1)?;
        Ok(seen(&run))
    });
    let in_steps = Run::builder(&live, 1e-3).build();
    let in_steps = in_steps.and_then(|mut run| {
        run.advance(run.steps_to(end)?)?;
        Ok(seen(&run))
    });
    [to_tolerance, in_steps]
}

/// A bar that a torque spins up on a pin, which shears. α = T/(J + m l²) = 5 rad/s². The pin carries m l √(α² + ω⁴), which is
/// 100 N at ω⁴ = 100² − α². From then on the centre goes straight, and the bar turns with T/J.
#[test]
fn a_pin_shears() {
    let text = "Spun { dof = 3; body bar (x, y, phi) { mass = 2 [kg]; inertia = 0.1 [kg*m^2]; }
        point tip on bar = (-0.5 [m], 0);
        torque drive on bar = 3 [N*m];
        mode whole = 1 { revolute pin (bar.tip, ground); }
        when reaction(pin) > 100 [N] { leave whole; }
        start { x = 0.5 [m]; } }";
    let (alpha, t) = (5.0_f64, (1e4_f64 - 25.0).powf(0.25) / 5.0);
    let (angle, speed) = (0.5 * alpha * t * t, 0.5 * alpha * t);
    // in steps the moment is known to one, in which the bar turns by 0.01 rad
    for (run, allowed) in runs(text, t + 0.5).into_iter().zip([1e-7, 0.02]) {
        let [q, v, inputs] = run.expect("a run");
        assert_eq!(inputs[0], 0.0);
        let expected = [
            (v[0], -speed * angle.sin()),
            (v[1], speed * angle.cos()),
            (v[2], alpha * t + 15.0),
            (q[0], 0.5 * angle.cos() - 0.5 * speed * angle.sin()),
            (q[2], angle + 0.5 * alpha * t + 30.0 * 0.125),
        ];
        assert!(
            expected.iter().all(|(found, right)| (found - right).abs() < allowed * speed),
            "{expected:?}"
        );
    }
    for run in runs(text, t - 2e-3) {
        assert_eq!(run.expect("a run")[2][0], 1.0);
    }
}

/// A belt that locks where it is pulled out by more than 4 m/s², at 4/3 s. Behind it there is no acceleration, so that the
/// condition ends.
#[test]
fn a_belt_locks_by_its_acceleration() {
    let text = "Belt { dof = 1; body end (x) { mass = 2 [kg]; } force pull on x = 6 [N/s]*t;
        mode locked { rate pawl: der(x) = 0; }
        when der(der(x)) > 4 [m/s^2] { enter locked; } }";
    let t = 4.0_f64 / 3.0;
    // with 3/2 t² = 2.7 m/s for one step at most
    for (run, allowed) in runs(text, 2.0).into_iter().zip([1e-9, 3e-3]) {
        let [q, v, inputs] = run.expect("a run");
        assert!((q[0] - 0.5 * t.powi(3)).abs() < allowed && v[0].abs() < 1e-12, "{q:?} {v:?}");
        assert_eq!(inputs[0], 1.0);
    }
}

/// A magnet that catches what it cannot hold takes its speed by an impulse, and lets go at the same moment: behind 0.5 s the
/// block starts from rest with 20 m/s². And it holds what is pulled by less.
#[test]
fn forces_behind_an_impulse_count() {
    let text = |pull: f64| {
        format!(
            "Caught {{ dof = 1; body block (x) {{ mass = 2 [kg]; }} force pull on x = {pull} [N];
               mode held {{ constraint magnet: x = {} [m]; }}
               when x >= {} [m] {{ enter held; }} when lambda(magnet) > 30 [N] {{ leave held; }} }}",
            pull / 16.0,
            pull / 16.0,
        )
    };
    // pull/m · t²/2 = pull/16 at t = 0.5 s
    for (pull, held) in [(40.0, 0.0), (20.0, 1.0)] {
        for (run, h) in runs(&text(pull), 1.0).into_iter().zip([1e-8, 1e-2]) {
            let [q, v, inputs] = run.expect("a run");
            let (x, v) = (q[0], v[0]);
            let (far, fast) = if held == 0.0 { (0.125 * pull / 2.0, 0.5 * pull / 2.0) } else { (0.0, 0.0) };
            assert!((x - pull / 16.0 - far).abs() < h * pull && (v - fast).abs() < h * pull, "{x} {v}");
            assert_eq!(inputs[0], held, "{inputs:?}");
        }
    }
}

/// Regression: what a clock enters takes its impulse before the force is judged that lets it go, also in the first moment.
#[test]
fn a_clock_enters_what_lets_go_at_once() {
    for (offset, [x, v]) in [("offset 0.5 [s]", [1.35, 1.5]), ("", [1.6, 4.0])] {
        let text = format!(
            "Brake {{ dof = 1; body a (x) {{ mass = 1 [kg]; }} force f on x = 5 [N]; mode lock {{ rate l: der(x) = 0 [m/s]; }}
                every 1 [s] {offset} {{ enter lock; }} when abs(lambda(l)) > 4 [N] {{ leave lock; }} start {{ der(x) = 1 [m/s]; }} }}"
        );
        for (run, allowed) in runs(&text, 0.8).into_iter().zip([1e-8, 1e-2]) {
            let [q, rates, inputs] = run.expect("a run");
            assert!((q[0] - x).abs() < allowed && (rates[0] - v).abs() < allowed, "{q:?} {rates:?}");
            assert_eq!(inputs[0], 0.0, "{inputs:?}");
        }
    }
}

/// Forces of joints, too, and energies. A condition on forces that holds at the start begins there; others have begun already.
#[test]
fn conditions_see_all_forces() {
    let text = "Hanging { dof = 1; gravity = (0, -10) [m/s^2];
        body bob (x, y, phi) { mass = 2 [kg]; inertia = 0.5 [kg*m^2]; } point top on bob = (0, 0.5 [m]);
        revolute pin (bob.top, ground);
        memory times [1] = 0; memory same [1] = 0;
        when reaction(pin) > 20 [N] { set times = times + 1; }
        when kinetic_energy() > 1 [J] { set same = same + 1; }
        start { guess x = 0; y = -0.5 [m]; phi = 0; der(phi) = 2 [rad/s]; } }";
    // hung from above with ω = 2 rad/s it carries m (g + l ω²) = 24 N, of an energy ½ (J + m l²) ω² = 2 J; it swings with 10 rad/s²
    // for sin φ, so that a half period takes some 1 s, and each has one rise above 20 N and one above 1 J
    for run in runs(text, 10.0) {
        let [_, _, inputs] = run.expect("a run");
        assert_eq!((inputs[0], inputs[1]), (11.0, 10.0), "{inputs:?}");
    }
}

/// A magnet that cannot hold from the start lets go there.
#[test]
fn forces_at_the_start_count() {
    let text = "Hung { dof = 1; gravity = (0, -10) [m/s^2]; body block (y) { mass = 2 [kg]; }
        mode held = 1 { constraint magnet: y = 0; }
        when abs(lambda(magnet)) > 15 [N] { leave held; } }";
    for (run, allowed) in runs(text, 1.0).into_iter().zip([1e-9, 0.02]) {
        let [q, _, inputs] = run.expect("a run");
        assert!((q[0] + 5.0).abs() < allowed && inputs[0] == 0.0, "{q:?} {inputs:?}");
    }
}

/// Regression: behind a mode that was left, friction held with more than it can until the next step, and conditions saw that.
/// The block breaks loose at 15 N and slides against 5.886 N, until it is fast enough to be caught at 0.5 m/s.
#[test]
fn friction_behind_a_mode_slides() {
    let text = "Freed { dof = 1; body b (x) { mass = 2 [kg]; } force pull on x = 10 [N/s]*t; memory n [1] = 0;
        friction f (b, ground) along (1, 0) { coefficient = 0.3; static = 0.5; normal = 19.62 [N]; law = coulomb; }
        mode held { rate hold: der(x) = 0 [m/s]; }
        when -force(f) > 8 [N] { enter held; set n = n + 1; }
        when lambda(hold) > 15 [N] { leave held; } }";
    for (run, allowed) in runs(text, 1.7).into_iter().zip([1e-7, 2e-2]) {
        let [_, v, inputs] = run.expect("a run");
        // entered once; it slides from 1.5 s on, or a bit later where friction carries a part beside the mode
        let slides = 0.2 * (15.0 - 5.886) / 2.0 + 0.2 * 0.2 * 5.0 / 2.0;
        assert!(inputs[2] == 0.0 && inputs[0] == 1.0, "{inputs:?}");
        assert!((v[0] - slides).abs() < allowed, "{v:?} {slides}");
    }
}

/// Conditions that enter and leave at one moment without an end are told.
#[test]
fn what_has_no_end_is_told() {
    let text = "Endless { dof = 1; body block (x) { mass = 2 [kg]; } force pull on x = 40 [N];
        memory n [1] = 0;
        mode held { rate magnet: der(x) = 0; }
        when x > 0.1 [m] { enter held; }
        when lambda(magnet) > 30 [N] { leave held; set n = n + 1; }
        when n*der(der(x)) > 10 [m/s^2] { enter held; set n = 0; } }";
    for run in runs(text, 1.0) {
        assert!(matches!(run, Err(Error::Endless { .. })), "{run:?}");
    }
}
