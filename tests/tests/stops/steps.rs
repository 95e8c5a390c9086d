//! Runs with constant steps: time stepping by Moreau and Jean around every method.

use mbs_live::{Pack, Run, Text};
use mbs_runtime::equations::{At, Equations};
use mbs_runtime::lanes::Pack as Lanes;
use mbs_runtime::{Baumgarte, Dual, Error, Held, Rattle, Rk4, Simulation, System, TrBdf2, mechanism};

use super::{Ball, BallParameters, declared};

/// The height of the ball of the closed form at 1.5 s, after two impacts, and the sum of its impulses until it rests.
fn closed_form(e: f64) -> [f64; 2] {
    let (g, fall) = (9.81, (2.0_f64 / 9.81).sqrt());
    let (speed, time) = (e * e * g * fall, 1.5 - fall * (1.0 + 2.0 * e));
    [speed * time - 0.5 * g * time * time, 2.0 * g * fall * (1.0 + e) / (1.0 - e)]
}

/// At 1.5 s and at 4 s.
fn bounced(run: &mut dyn System) -> Result<[f64; 5], Error> {
    let (mut y, mut v, mut inputs) = ([0.0], [0.0], [0.0; 2]);
    run.advance(run.steps_to(1.5)?)?;
    run.state(&mut y, &mut v);
    let height = y[0];
    run.advance(run.steps_to(4.0)?)?;
    run.state(&mut y, &mut v);
    run.inputs(&mut inputs);
    Ok([height, inputs[1], y[0], v[0], inputs[0]])
}

/// An impact is placed in its step by the gaps at both ends, with an error of g h² in its time over the speed. The ball
/// rests exactly, whatever the step.
#[test]
fn impacts_are_of_second_order_and_rests_exact() -> Result<(), Error> {
    let ball = Ball::declared;
    let [height, impulses] = closed_form(0.7);
    for h in [4e-3, 1e-3, 2.5e-4] {
        let mut runs: [Box<dyn System>; 4] = [
            Box::new(Simulation::new(ball(), h)?),
            Box::new(Simulation::builder(ball(), h).baumgarte(Baumgarte::<Held<Rk4>>::deadbeat(h)).build()?),
            Box::new(Rattle::builder(ball(), h).build()?),
            Box::new(TrBdf2::builder(ball(), h).build()?),
        ];
        for run in &mut runs {
            let [found, sum, y, v, held] = bounced(run.as_mut())?;
            assert!((found - height).abs() < 2.0 * h * h, "{h}: {found} {height}");
            // the flights are missing that are shorter than two steps, from v = g h on: m v (1 + e)/(1 − e), which the
            // errors of those that are flown may double
            let missing = 2.0 * 9.81 * h * 1.7 / 0.3;
            assert!((sum - impulses).abs() < 2.0 * missing, "{h}: {sum} {impulses}");
            assert_eq!([y, v, held], [0.0, 0.0, 1.0], "{h}");
            // what rests has no acceleration
            let mut a = [f64::NAN];
            run.reactions(&mut a, &mut [])?;
            assert_eq!(a, [0.0]);
        }
    }
    Ok(())
}

// three blocks, each above the next one, the lowest in a guide
declared! { STACK;
    Stack {
        dof = 3;
        gravity = (0, -9.81) [m/s^2];
        body low (x, y) { mass = 1 [kg]; }
        body middle (y = u) { mass = 3 [kg]; }
        body high (y = w) { mass = 2 [kg]; }
        constraint guide: x = 0.2 [1/m]*y^2;
        stop floor: y >= 0.1 [m] { restitution = 0.5; }
        stop first: u - y >= 0.2 [m] { restitution = 0.3; }
        stop second: w - u >= 0.2 [m] { restitution = 0; }
        start { y = 0.3 [m]; guess x = 0; u = 0.7 [m]; w = 1 [m]; }
        output weight [N] = floor_impulse/(1 [s]);
    }
}

/// They come to rest on each other, and stay: the blocks above press those below.
#[test]
fn what_is_stacked_rests() -> Result<(), Error> {
    let mut run = Simulation::new(Stack::declared(), 1e-3)?;
    run.advance_to(3.0)?;
    let inputs = *run.inputs();
    assert_eq!([inputs.floor, inputs.first, inputs.second], [1.0; 3]);
    let (state, reactions) = (run.state(), run.reactions()?);
    let gaps = [state.q.y - 0.1, state.q.u - state.q.y - 0.2, state.q.w - state.q.u - 0.2];
    assert!(gaps.iter().all(|gap| gap.abs() < 1e-15), "{gaps:?}");
    let accelerations = [reactions.acceleration.y, reactions.acceleration.u, reactions.acceleration.w];
    assert!(accelerations.iter().all(|a| a.abs() < 1e-13), "{accelerations:?}");
    Ok(())
}

/// The stack as a text takes the steps of the type, to the bit, and so do both from their start on.
#[test]
fn texts_and_types_take_the_same_steps() -> Result<(), Error> {
    let live = Text::declaration("stack.mbs", STACK).compile().expect("a stack");
    let (mut typed, mut read) =
        (Simulation::new(Stack::declared(), 1e-3)?, Run::builder(&live, 1e-3).build()?);
    for _ in 0..3000 {
        System::step(&mut typed)?;
        read.step()?;
        let rows = [&typed as &dyn System, &read].map(|run| {
            let mut row = [0.0; 20];
            let (q, rest) = row.split_at_mut(4);
            let (v, rest) = rest.split_at_mut(4);
            let (a, rest) = rest.split_at_mut(4);
            let (multipliers, inputs) = rest.split_at_mut(1);
            run.state(q, v);
            run.inputs(&mut inputs[..6]);
            run.reactions(a, multipliers).map(|()| row)
        });
        let [typed, read] = rows;
        assert_eq!(typed?, read?);
    }
    // runs of texts with stops go one by one
    let runs = vec![read.clone(), read];
    assert!(Pack::new(runs).is_err());
    Ok(())
}

/// In lanes each ball has its own impacts, at its own steps.
#[test]
fn an_impact_does_not_disturb_the_neighbours() -> Result<(), Error> {
    let all = [0.0, 0.2, 0.5, 0.9]
        .map(|e| Ball::new(BallParameters { e }).and_then(|ball| Simulation::new(ball, 1e-3)));
    let mut alone = Vec::new();
    for run in all {
        alone.push(run?);
    }
    let members: [&Simulation<Ball<f64>>; 4] = std::array::from_fn(|lane| &alone[lane]);
    let mut pack = Lanes::new(members);
    let mut steps = 0;
    while steps < 4000 {
        let taken = pack.advance(4000 - steps);
        steps += taken;
        if taken == 0 {
            assert_eq!(pack.step(), [true; 4]);
            steps += 1;
        }
    }
    let led: Vec<_> = (0..4).map(|lane| pack.simulation(lane)).collect();
    for (mut alone, led) in alone.into_iter().zip(led) {
        alone.advance_to(4.0)?;
        assert_eq!((alone.steps(), led.steps()), (4000, 4000));
        let numbers = |run: &Simulation<Ball<f64>>| {
            [run.state().q.y, run.state().v.y, run.inputs().floor, run.inputs().floor_impulse]
        };
        assert_eq!(numbers(&alone), numbers(&led));
    }
    Ok(())
}

/// A step that no impulses can end keeps the state before it, and says where.
#[test]
fn stops_that_close_on_each_other_end_the_run() -> Result<(), Error> {
    let text = "Vise {
        dof = 1;
        body jaw (x) { mass = 1 [kg]; }
        stop fixed: x >= 0 { restitution = 0; }
        stop moving: x <= 0.1 [m] - 0.1 [m/s]*t { restitution = 0; }
        start { x = 0.05 [m]; }
    }";
    let live = Text::declaration("vise.mbs", text).compile().expect("a vise");
    let mut run = Run::builder(&live, 1e-2).build()?;
    let error = run.advance(200).expect_err("an end");
    assert!(error.to_string().contains("`fixed`"), "{error}");
    assert!((run.time() - 1.0).abs() < 0.02, "{}", run.time());
    let (q, v) = (run.q().to_vec(), run.v().to_vec());
    let at = At { t: run.time(), q: &q, v: &v };
    assert!(Equations::potential_energy(run.equations(), at) == 0.0 && (0.0..0.1).contains(&q[0]));
    Ok(())
}

/// A gap that is closed at the end of a step does not tell how the time of its closing depends on parameters.
#[test]
fn derivatives_of_constant_steps_are_refused() -> Result<(), Error> {
    let ball = Ball::new(BallParameters { e: Dual::<f64, 1>::variable(0.7, 0) })?;
    let refused = Simulation::new(ball, 1e-3).map(|_| ()).expect_err("an error");
    let expected = "a derivative of a run with constant steps does not see the impacts of the stop `floor`";
    assert!(refused.to_string().starts_with(expected), "{refused}");
    Ok(())
}

mechanism! {
    /// A block on a ramp, held by a spring along it with a damper.
    Ramp {
        dof = 2;
        gravity = (0, -9.81) [m/s^2];
        body block (x, y) { mass = 2 [kg]; }
        force spring on x = -50 [N/m]*x - 12 [N*s/m]*der(x);
        stop ramp: y + x >= 0 [m] { restitution = 0.4; }
        start { x = -0.2 [m]; y = 0.5 [m]; }
    }
}

/// At rest the ramp pushes with m g along y, and as much along x, against the spring: x = m g/k. With steps of h the block rests there to second order, since
/// dampers see the velocities of the rest on average.
#[test]
fn a_rest_is_of_second_order() -> Result<(), Error> {
    let errors = [2e-3, 1e-3].map(|h| {
        let mut run = Simulation::new(Ramp::declared(), h)?;
        run.advance_to(20.0)?;
        assert_eq!(run.inputs().ramp, 1.0);
        Ok::<f64, Error>(run.state().q.x - 2.0 * 9.81 / 50.0)
    });
    let [coarse, fine] = errors;
    let (coarse, fine) = (coarse?, fine?);
    assert!(coarse.abs() < 1e-4 && (coarse / fine - 4.0).abs() < 0.2, "{coarse:e} {fine:e}");
    Ok(())
}

/// The end of a run of a text with steps of 1 ms: q and v, and the impulses of its stops.
fn at_end(text: &str, end: f64) -> Result<[Vec<f64>; 3], Error> {
    let live = Text::declaration("steps.mbs", text).compile().expect("a mechanism");
    let mut run = Run::builder(&live, 1e-3).build()?;
    run.advance(run.steps_to(end)?)?;
    let info = live.declared_info();
    let [mut q, mut v] = [(); 2].map(|()| vec![0.0; info.coordinates.len()]);
    let mut inputs = vec![0.0; info.inputs.len()];
    run.state(&mut q, &mut v);
    run.inputs(&mut inputs);
    let impulses = info.stops.iter().map(|stop| inputs[stop.memory + 1]).collect();
    Ok([q, v, impulses])
}

/// Regression: a rest that curvature alone presses, or a platform that speeds up by more than g, dissolved into impacts of
/// the size of a step. The force of a rest knows both.
#[test]
fn a_rest_on_what_bends_or_speeds_up_stays_one() -> Result<(), Error> {
    for e in [0.5, 1.0] {
        let rim = format!(
            "Rim {{ dof = 2; body puck (x, y) {{ mass = 2 [kg]; }} stop rim: x^2 + y^2 <= 1 [m^2] {{ restitution = {e}; }}
                start {{ x = 0; y = -1 [m]; der(x) = 3 [m/s]; der(y) = 0; }} }}"
        );
        let [q, v, impulses] = at_end(&rim, 0.5)?;
        // the gap is closed to second order of what is left of it, and the velocity is turned with an error of third order
        let (radius, speed) = (q[0].hypot(q[1]), v[0].hypot(v[1]));
        assert!((radius - 1.0).abs() < 1e-9 && (speed - 3.0).abs() < 1e-7, "{radius} {speed}");
        assert_eq!(impulses, [0.0], "{e}");
        let lift = format!(
            "Lift {{ dof = 1; gravity = (0, -10) [m/s^2]; body case (y) {{ mass = 5 [kg]; }}
                body table (y = u) {{ mass = 1 [kg]; }} drive up: u = 15 [m/s^2]*t^2/2;
                stop floor: y >= u {{ restitution = {e}; }} start {{ guess u = 0; y = 0; }} }}"
        );
        let [q, v, impulses] = at_end(&lift, 0.3)?;
        assert!((q[0] - 0.675).abs() < 1e-12 && (v[0] - 4.5).abs() < 1e-12, "{q:?} {v:?}");
        assert_eq!(impulses, [0.0], "{e}");
    }
    Ok(())
}

/// Regression: a block on three rough feet or four walked, and a block on another one crept below the largest force of its
/// friction. A foot had no part in the answer whose rate was rounding, or opened without the second half of the rest.
#[test]
fn feet_in_line_do_not_walk() -> Result<(), Error> {
    let foot = |name: &str, x: f64| {
        format!(
            "point {name} on b = ({x} [m], -0.05 [m]);
            stop of_{name}: b.{name}.y >= 0 [m] {{ restitution = 0.3; friction = 0.5; along = b.{name}.x; }}"
        )
    };
    let feet = [("l", -0.1), ("k", -0.02), ("m", 0.03), ("r", 0.1)].map(|(name, x)| foot(name, x)).concat();
    for push in [0.0, 7.0, 8.0, 9.0, 9.9] {
        let text = format!(
            "Feet {{ dof = 3; gravity = (0, -10) [m/s^2]; body b (x, y, phi) {{ mass = 2 [kg]; inertia = 0.01 [kg*m^2]; }}
                {feet} force push on b = ({push} [N], 0); start {{ y = 0.05 [m]; }} }}"
        );
        let [q, v, impulses] = at_end(&text, 1.0)?;
        assert!(q[0].abs() < 1e-14 && v[0].abs() < 1e-14, "{push}: {q:?}");
        assert_eq!(impulses, [0.0; 4], "{push}");
    }
    // pushed with 2.9 N of 3 N
    let upper = |name: &str, x: f64| {
        format!(
            "point {name} on a = ({x} [m], -0.05 [m]);
            let up_{name} = (a.{name}.y - y)*cos(phi) - (a.{name}.x - x)*sin(phi);
            let way_{name} = (a.{name}.x - x)*cos(phi) + (a.{name}.y - y)*sin(phi);
            stop of_{name}: up_{name} >= 0.05 [m] {{ restitution = 0.3; friction = 0.3; along = way_{name}; }}"
        )
    };
    let feet = [foot("l", -0.1), foot("r", 0.1), upper("i", -0.08), upper("j", 0.08)].concat();
    let text = format!(
        "Stack {{ dof = 6; gravity = (0, -10) [m/s^2]; body b (x, y, phi) {{ mass = 2 [kg]; inertia = 0.01 [kg*m^2]; }}
            body a (u, w, psi) {{ mass = 1 [kg]; inertia = 0.005 [kg*m^2]; }} {feet}
            force push on a = (2.9 [N], 0); start {{ y = 0.05 [m]; w = 0.15 [m]; u = 0; }} }}"
    );
    let [q, _, impulses] = at_end(&text, 1.0)?;
    assert!(q[0].abs() < 1e-14 && q[3].abs() < 1e-14, "{q:?}");
    assert_eq!(impulses, [0.0; 4]);
    Ok(())
}

/// Regression: three balls in a row that touch answer an impact at once wherever the row lies: a gap of 3e-17 m is closed.
#[test]
fn touching_is_no_matter_of_the_last_bit() -> Result<(), Error> {
    for at in 0..10 {
        let from = 0.1 * f64::from(at);
        let ball = |name: &str, place: f64, speed: f64| {
            let place = from + place;
            format!(
                "body {name} (x = {name}) {{ mass = 1 [kg]; }} start {{ {name} = {place:?} [m]; der({name}) = {speed} [m/s]; }} "
            )
        };
        let balls = [ball("a", 0.0, 1.0), ball("b", 0.2, 0.0), ball("c", 0.3, 0.0)].concat();
        let text = format!(
            "Row {{ dof = 3; {balls} stop ab: b - a >= 0.1 [m] {{ restitution = 1; }} stop bc: c - b >= 0.1 [m] {{ restitution = 1; }} }}"
        );
        let [_, v, _] = at_end(&text, 1.0)?;
        for (found, expected) in v.iter().zip([-1.0, 2.0, 2.0]) {
            assert!((found - expected / 3.0).abs() < 1e-12, "{from}: {v:?}");
        }
    }
    Ok(())
}
