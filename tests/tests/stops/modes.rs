//! Modes: constraints that come and go, against closed forms, beside constraints that stay, and on every path.

use mbs_live::{Prepared, Run, Text};
use mbs_runtime::lanes::Pack as Lanes;
use mbs_runtime::{
    Adaptive, Dop853, Dual, Error, Rattle, Real, Sampled, Simulation, System, Tolerances, TrBdf2, mechanism,
};

use super::{TIGHT, declared};

// a plate that drives a wheel while a clutch holds
declared! { CLUTCH;
    Clutch {
        dof = 2;
        body plate (phi) { inertia = 1 [kg*m^2]; }
        body wheel (psi) { inertia = 2 [kg*m^2]; }
        memory times [1] = 0;
        mode engaged { rate lock: der(phi) = der(psi); }
        when t >= 1 [s] { enter engaged; set times = times + 1; }
        when times > 0 { set times = 10*times; }
        when t > 2 [s] { leave engaged; }
        torque drive on plate = 3 [N*m];
        start { der(phi) = 10 [rad/s]; }
        output torque [N*m] = lambda(lock);
    }
}

/// Momentum stays where the clutch engages: 13 rad/s of a third of the inertia become 13/3. Then 3 N·m accelerate all of it by
/// 1 rad/s², with 2 N·m through the clutch; and from 2 s on the plate alone.
#[test]
fn a_clutch_keeps_the_momentum() -> Result<(), Error> {
    let mut to_tolerance = Adaptive::builder(Clutch::declared()).tolerances(TIGHT).build()?;
    let mut in_steps = Simulation::new(Clutch::declared(), 1e-2)?;
    for (t, phi, psi, rates, torque) in [
        (1.5, 11.5 + 13.0 / 6.0 + 0.125, 13.0 / 6.0 + 0.125, [13.0 / 3.0 + 0.5; 2], 2.0),
        (
            3.0,
            11.5 + 16.0 / 3.0 + 5.0 + 11.0 / 6.0 - 0.5,
            13.0 / 3.0 + 0.5 + 16.0 / 3.0,
            [25.0 / 3.0, 16.0 / 3.0],
            0.0,
        ),
    ] {
        to_tolerance.advance_to(t)?;
        in_steps.advance_to(t)?;
        // Heun's rule is exact for constant torques, and both moments are ends of steps
        for state in [to_tolerance.state(), in_steps.state()] {
            let off = [state.q.phi - phi, state.q.psi - psi, state.v.phi - rates[0], state.v.psi - rates[1]];
            assert!(off.iter().all(|off: &f64| off.abs() < 1e-9), "{t}: {off:?}");
        }
        assert!((in_steps.outputs()?.torque - torque).abs() < 1e-9);
    }
    assert_eq!((to_tolerance.inputs().engaged, to_tolerance.inputs().times), (0.0, 10.0));
    Ok(())
}

/// Regression: a sample at the moment of entering had the mode and the velocities of before it.
#[test]
fn a_sample_at_a_jump_is_behind_it() -> Result<(), Error> {
    let run = Adaptive::builder(Clutch::declared()).tolerances(TIGHT).build()?;
    let mut run = Sampled::new(run, 0.5)?;
    run.advance(2)?;
    let (mut v, mut inputs) = ([0.0; 2], vec![0.0; run.equations().info().inputs.len()]);
    run.state(&mut [0.0; 2], &mut v);
    run.inputs(&mut inputs);
    let engaged = run.equations().info().modes.modes[0].memory;
    assert!(inputs[engaged] == 1.0 && v.iter().all(|rate: &f64| (rate - 13.0 / 3.0).abs() < 1e-9), "{v:?}");
    Ok(())
}

/// A type, a lane of it, and a text.
#[test]
fn every_path_has_the_same_bits() -> Result<(), Error> {
    let mut alone = Simulation::new(Clutch::declared(), 7e-3)?;
    let (first, second) = (alone, alone);
    let mut pack = Lanes::new([&first, &second]);
    let text = Text::declaration("clutch.mbs", CLUTCH).compile().expect("a clutch");
    let mut read = Run::builder(&text, 7e-3).build()?;
    for _ in 0..400 {
        alone.step()?;
        read.step()?;
        if pack.advance(1) == 0 {
            assert_eq!(pack.step(), [true; 2]);
        }
        let rows = [&alone as &dyn System, &read, &pack.simulation(1)].map(|run| {
            let (mut q, mut v, mut inputs) = ([0.0; 2], [0.0; 2], [0.0; 6]);
            run.state(&mut q, &mut v);
            run.inputs(&mut inputs);
            (q, v, inputs)
        });
        assert!(rows[0] == rows[1] && rows[0] == rows[2], "{rows:?}");
    }
    assert_eq!(alone.inputs().times, 10.0);
    Ok(())
}

mechanism! {
    /// A bar that falls past a pin, which catches its tip and lets it go at 2 s.
    Caught {
        dof = 3;
        gravity = (0, -9.81) [m/s^2];
        body bar (x, y, phi) { mass = 2 [kg]; inertia = 0.1 [kg*m^2]; }
        point tip on bar = (-0.5 [m], 0);
        mode hung { revolute pin (bar.tip, ground); }
        when bar.tip.y < 0 [m] { enter hung; }
        when t > 2 [s] { leave hung; }
        start { x = 0.5 [m]; y = 1 [m]; }
        output pin [N] = reaction(pin);
    }
}

mechanism! {
    /// The same bar on its pin.
    Hung {
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        body bar (x, y, phi) { mass = 2 [kg]; inertia = 0.1 [kg*m^2]; }
        point tip on bar = (-0.5 [m], 0);
        revolute pin (bar.tip, ground);
        param turning = 1 [rad/s];
        start { x = 0.5 [m]; der(phi) = turning; }
        output pin [N] = reaction(pin);
    }
}

/// The pin is hit at √(2/g). The angular momentum about it stays, m v l, of an inertia of J + m l². From then on the bar is
/// a pendulum.
#[test]
fn a_pin_catches_a_bar() -> Result<(), Error> {
    let fall = (2.0_f64 / 9.81).sqrt();
    let turning = -2.0 * 9.81 * fall * 0.5 / (0.1 + 2.0 * 0.25);
    let hung = Hung::new(HungParameters { turning })?;
    let mut exact = Adaptive::builder(hung).scheme::<Dop853>().tolerances(TIGHT).build()?;
    exact.advance_to(1.9 - fall)?;
    let exact = exact.state();
    let mut to_tolerance =
        Adaptive::builder(Caught::declared()).scheme::<Dop853>().tolerances(TIGHT).build()?;
    to_tolerance.advance_to(1.9)?;
    let state = to_tolerance.state();
    let off = [state.q.phi - exact.q.phi, state.q.x - exact.q.x, state.v.phi - exact.v.phi];
    assert!(off.iter().all(|off: &f64| off.abs() < 1e-8), "{off:?}");
    // a step that ends behind the pin is led back to it: of first order, and all that follows of second
    for h in [1e-3, 1e-4] {
        let bar = Caught::declared;
        let mut runs: [Box<dyn System>; 3] = [
            Box::new(Simulation::new(bar(), h)?),
            Box::new(TrBdf2::builder(bar(), h).build()?),
            Box::new(Rattle::builder(bar(), h).build()?),
        ];
        for run in &mut runs {
            run.advance(run.steps_to(1.9)?)?;
            let (mut q, mut v) = ([0.0_f64; 3], [0.0; 3]);
            run.state(&mut q, &mut v);
            assert!((q[2] - exact.q.phi).abs() < 5.0 * h, "{h}: {q:?} {exact:?}");
            // it hangs on the pin to rounding
            assert!((q[0] - 0.5 * q[2].cos()).hypot(q[1] - 0.5 * q[2].sin()) < 1e-12);
        }
    }
    // let go, it keeps its rate
    let rate = to_tolerance.advance_to(2.0).map(|()| to_tolerance.state().v.phi)?;
    to_tolerance.advance_to(2.2)?;
    assert!((to_tolerance.state().v.phi - rate).abs() < 1e-8);
    Ok(())
}

/// While a mode holds, steps are of second order beside the pendulum that has a constraint.
#[test]
fn constraints_of_modes_are_of_second_order() -> Result<(), Error> {
    mechanism! {
        Held {
            dof = 3;
            gravity = (0, -9.81) [m/s^2];
            body bar (x, y, phi) { mass = 2 [kg]; inertia = 0.1 [kg*m^2]; }
            point tip on bar = (-0.5 [m], 0);
            mode hung = 1 { revolute pin (bar.tip, ground); }
            when t > 100 [s] { leave hung; }
            start { x = 0.5 [m]; der(y) = 0.5 [m/s]; der(phi) = 1 [rad/s]; }
            output pin [N] = reaction(pin);
        }
    }
    let mut exact = Adaptive::builder(Hung::declared()).scheme::<Dop853>().tolerances(TIGHT).build()?;
    exact.advance_to(2.0)?;
    let mut to_tolerance =
        Adaptive::builder(Held::declared()).scheme::<Dop853>().tolerances(TIGHT).build()?;
    to_tolerance.advance_to(2.0)?;
    assert!((to_tolerance.state().q.phi - exact.state().q.phi).abs() < 1e-8);
    let mut errors = [0.0; 2];
    for (error, h) in errors.iter_mut().zip([4e-3, 2e-3]) {
        let mut run = Simulation::new(Held::declared(), h)?;
        run.advance_to(2.0)?;
        *error = (run.state().q.phi - exact.state().q.phi).abs();
        let mut beside = Simulation::new(Hung::declared(), h)?;
        beside.advance_to(2.0)?;
        assert!((run.outputs()?.pin - beside.outputs()?.pin).abs() < 1e3 * h * h);
    }
    let order = (errors[0] / errors[1]).log2();
    assert!((1.8..2.2).contains(&order), "{errors:?}");
    Ok(())
}

/// A program may set the memory of a mode; an impulse leads velocities to its constraints.
#[test]
fn a_program_enters_a_mode() -> Result<(), Error> {
    let mut run = Simulation::new(Clutch::declared(), 1e-3)?;
    run.inputs_mut().engaged = 1.0;
    run.step()?;
    let v = run.state().v;
    assert!((v.phi - (10.0 / 3.0 + 1e-3)).abs() < 1e-12 && (v.phi - v.psi).abs() < 1e-12, "{v:?}");
    let mut run = Adaptive::builder(Clutch::declared()).build()?;
    run.inputs_mut().engaged = 1.0;
    run.advance_to(0.5)?;
    let v = run.state().v;
    assert!((v.phi - (10.0 / 3.0 + 0.5)).abs() < 1e-6 && (v.phi - v.psi).abs() < 1e-12, "{v:?}");
    Ok(())
}

/// The error of a text in 1 s, to a tolerance and in steps of 10 ms.
fn errors(text: &str) -> [Option<Error>; 2] {
    let live = Text::declaration("modes.mbs", text).compile().expect("a mechanism");
    let to_tolerance = Adaptive::builder(Prepared::new(&live)).build();
    let to_tolerance = to_tolerance.and_then(|mut run| run.advance_to(1.0)).err();
    let in_steps = Run::builder(&live, 1e-2).build().and_then(|mut run| run.advance(100).map(drop)).err();
    [to_tolerance, in_steps]
}

/// Modes that cannot be entered, and conditions that follow each other without an end.
#[test]
fn errors_name_what_is_wrong() {
    let text = |rest: &str| {
        format!(
            "Wrong {{ dof = 1; body block (x) {{ mass = 1 [kg]; }} {rest} start {{ der(x) = 1 [m/s]; }} }}"
        )
    };
    let apart = text("mode held { constraint hook: x = 0.2 [m]; } when x > 0.5 [m] { enter held; }");
    for error in errors(&apart) {
        let Some(Error::Apart { constraint: "hook", by, .. }) = error else { panic!("{error:?}") };
        assert!((by - 0.3).abs() < 0.02, "{by}");
    }
    let at_start = text("mode held = 1 { constraint hook: x = 0.2 [m]; } when x > 0.5 [m] { leave held; }");
    for error in errors(&at_start) {
        assert!(matches!(error, Some(Error::Apart { constraint: "hook", t: 0.0, .. })), "{error:?}");
    }
    // two that contradict each other
    let against = text(
        "mode held { rate first: der(x) = 0 [m/s]; rate second: der(x) = 2 [m/s]; } when x > 0.5 [m] { enter held; }",
    );
    for error in errors(&against) {
        assert!(matches!(error, Some(Error::Contradiction { .. })), "{error:?}");
    }
    let endless =
        text("memory n [1] = 1; when x*n > 0.5 [m] { set n = -n; } when x*n < -0.4 [m] { set n = -n; }");
    for error in errors(&endless) {
        assert!(matches!(error, Some(Error::Endless { .. })), "{error:?}");
    }
}

mechanism! {
    /// A plate that turns with 10 rad/s, and takes a wheel along from an angle on.
    Meeting {
        dof = 2;
        param angle = 2;
        body plate (phi) { inertia = 1 [kg*m^2]; }
        body wheel (psi) { inertia = 2 [kg*m^2]; }
        mode engaged { rate lock: der(phi) = der(psi); }
        when phi > angle { enter engaged; }
        start { der(phi) = 10 [rad/s]; }
    }
}

/// φ = α + 10/3 (t − α/10) behind the angle α, so that its derivative by α is 2/3: the moment moves with it. Regression: where a
/// condition has the variable itself, its derivative by it was counted as one along the motion.
#[test]
fn derivatives_go_through_what_enters_a_mode() -> Result<(), Error> {
    let angle = Dual::<f64, 1>::variable(2.0, 0);
    let run = Adaptive::builder(Meeting::new(MeetingParameters { angle })?);
    let mut run = run.scheme::<Dop853>().tolerances(TIGHT).build()?;
    run.advance_to(1.0)?;
    let phi = run.state().q.phi;
    assert!((phi.to_f64() - (2.0 + 10.0 / 3.0 * 0.8)).abs() < 1e-9, "{phi:?}");
    assert!((phi.partial(0) - 2.0 / 3.0).abs() < 1e-8, "{phi:?}");
    Ok(())
}

mechanism! {
    /// A mass on a spring.
    Swing {
        dof = 1;
        body mass (x) { mass = 1 [kg]; }
        potential spring = 100 [N/m]*x^2/2;
        memory outside [1] = 0;
        memory turned [1] = 0;
        when x > 0.1 [m] { set outside = outside + 1; }
        when der(x) <= 0 [m/s] { set turned = turned + 1; }
        start { der(x) = 2 [m/s]; }
    }
}

/// Regression: a run to a tolerance saw each condition once, as it did not look whether it had stopped to hold. In 6.2 s there
/// are ten swings, many of them within a few steps.
#[test]
fn a_condition_begins_to_hold_again_and_again() -> Result<(), Error> {
    for rtol in [1e-3, 1e-6, 1e-10] {
        let tolerances = Tolerances { rtol, ..TIGHT };
        let mut run =
            Adaptive::builder(Swing::declared()).scheme::<Dop853>().tolerances(tolerances).build()?;
        run.advance_to(6.2)?;
        assert_eq!((run.inputs().outside, run.inputs().turned), (10.0, 10.0), "{rtol}");
    }
    let mut run = Simulation::new(Swing::declared(), 1e-3)?;
    run.advance_to(6.2)?;
    assert_eq!((run.inputs().outside, run.inputs().turned), (10.0, 10.0));
    Ok(())
}

/// Regression: within a step the polynomial between its ends, and a step that ends in it, leave what a mode keeps at its limit by
/// their error. A run to a tolerance found that the condition began to hold anew.
#[test]
fn what_holds_does_not_begin_anew() -> Result<(), Error> {
    for rtol in [1e-2, 1e-4, 1e-7, 1e-10] {
        let tolerances = Tolerances { rtol, ..TIGHT };
        let mut run = Adaptive::builder(Caught::declared()).tolerances(tolerances).build()?;
        let (mut entered, mut last) = (0, 0.0);
        while run.time() < 1.9 {
            run.step()?;
            entered += usize::from(run.inputs().hung > last);
            last = run.inputs().hung;
        }
        assert_eq!(entered, 1, "{rtol}");
    }
    Ok(())
}

mechanism! {
    /// A ball that falls from the limit of a condition, and a clock that counts.
    Limits {
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        body ball (y) { mass = 2 [kg]; }
        memory falls [1] = 0;
        memory count [1] = 0;
        memory third [s] = 0 [s];
        every 0.2 [s] offset 0.1 [s] { set count = count + 1; }
        when y < 0.5 [m] { set falls = falls + 1; }
        when count > 2 { set third = t; }
        start { y = 0.5 [m]; }
    }
}

/// Regressions: a run to a tolerance had no end where a value begins at its limit, by rounding of 0.5 m; and what jumps to
/// its limit was beyond it.
#[test]
fn conditions_begin_at_their_limits() -> Result<(), Error> {
    for rtol in [1e-3, 1e-6, 1e-10] {
        let tolerances = Tolerances { rtol, ..TIGHT };
        let mut run = Adaptive::builder(Limits::declared()).tolerances(tolerances).build()?;
        run.advance_to(1.0)?;
        assert_eq!((run.inputs().falls, run.inputs().count, run.inputs().third), (1.0, 5.0, 0.5), "{rtol}");
    }
    let mut run = Simulation::new(Limits::declared(), 1e-3)?;
    run.advance_to(1.0)?;
    assert_eq!((run.inputs().falls, run.inputs().count), (1.0, 5.0));
    // the sample of the clock is the end of a step
    assert!((run.inputs().third - 0.5).abs() < 1.5e-3, "{}", run.inputs().third);
    Ok(())
}

/// The inputs of a text after 1 s: to a tolerance, and in steps of 1 ms.
fn inputs_after_a_second(text: &str) -> Result<[Vec<f64>; 2], Error> {
    let live = Text::declaration("modes.mbs", text).compile().expect("a mechanism");
    let mut to_tolerance = Adaptive::builder(Prepared::new(&live)).tolerances(TIGHT).build()?;
    to_tolerance.advance_to(1.0)?;
    let mut in_steps = Run::builder(&live, 1e-3).build()?;
    in_steps.advance(1000)?;
    let mut inputs = vec![0.0; to_tolerance.inputs().len()];
    in_steps.inputs(&mut inputs);
    Ok([to_tolerance.inputs().clone(), inputs])
}

/// Regression: to a tolerance a condition on a velocity was not looked at behind the impulse of a mode that a clock enters, or a
/// condition of another value. The wheel throws the body back from 1 to −1 m/s at 0.5 s.
#[test]
fn conditions_see_the_velocities_behind_an_impulse() -> Result<(), Error> {
    for enters in ["every 10 [s] offset 0.5 [s] { enter g; }", "when t > 0.5 [s] { enter g; }"] {
        let text = format!(
            "Thrown {{
                dof = 2;
                body a (x) {{ mass = 1 [kg]; }}
                body w (phi) {{ mass = 0; inertia = 0.02 [kg*m^2]; }}
                mode g {{ rate r: der(x) = 0.1 [m]*der(phi); }}
                memory n [1] = 0;
                {enters}
                when der(x) < -0.5 [m/s] {{ set n = n + 1; leave g; }}
                start {{ der(x) = 1 [m/s]; der(phi) = -20 [rad/s]; }}
            }}"
        );
        for inputs in inputs_after_a_second(&text)? {
            // the mode, then the memory
            assert_eq!(inputs[..2], [0.0, 1.0], "{enters}");
        }
    }
    Ok(())
}

/// Regression: in constant steps a condition on a velocity that leaves its own mode began twice. The end of a step has half of
/// the impulse of a constraint before it is led back.
#[test]
fn a_mode_that_its_velocity_leaves_is_left_once() -> Result<(), Error> {
    let text = "Left {
        dof = 2;
        body a (x) { mass = 1 [kg]; }
        body w (phi) { mass = 0; inertia = 0.02 [kg*m^2]; }
        force s on x = -3 [N];
        mode g = 1 { rate r: der(x) = 0.1 [m]*der(phi); }
        memory n [1] = 0;
        when der(x) < -0.5 [m/s] { leave g; set n = n + 1; }
    }";
    for inputs in inputs_after_a_second(text)? {
        assert_eq!(inputs[..2], [0.0, 1.0]);
    }
    Ok(())
}

/// A mode that is entered presses what it leads against what that rests on: Λ = 1 kg · 1 m/s is an impulse of the stop in runs of
/// both kinds, and to a tolerance one of its events.
#[test]
fn a_mode_that_is_entered_hits_what_is_rested_on() -> Result<(), Error> {
    let text = "Pressed {
        dof = 2;
        body a (x) { mass = 1 [kg]; }
        body b (y) { mass = 1 [kg]; }
        force push on x = -1 [N];
        stop wall: x >= 0 [m] { restitution = 0.5; }
        mode link { rate r: der(x) = der(y); }
        when y < 0.5 [m] { enter link; }
        start { y = 1 [m]; der(y) = -1 [m/s]; }
    }";
    for inputs in inputs_after_a_second(text)? {
        assert!(inputs[0] == 1.0 && (inputs[1] - 1.0).abs() < 1e-9, "{inputs:?}");
    }
    let live = Text::declaration("pressed.mbs", text).compile().expect("a mechanism");
    let mut run = Sampled::new(Adaptive::builder(Prepared::new(&live)).build()?, 1.0)?;
    let mut names = Vec::new();
    while let Some(event) = run.step_to_event()? {
        assert!((event.t - 0.5).abs() < 1e-9, "{event:?}");
        names.push(live.declared_info().event_name(event.index));
    }
    names.sort_unstable();
    assert_eq!(names, [Some("wall"), Some("y < 0.5 [m]")]);
    Ok(())
}
