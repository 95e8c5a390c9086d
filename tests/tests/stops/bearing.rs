//! `force(stop)`, `torque(stop)` and `impulse(stop)`.

use mbs_runtime::equations::{At, Equations};
use mbs_runtime::{
    Adaptive, Baumgarte, Components, Error, Held, Mechanism, Rk4, Simulation, System, mechanism,
};

use super::TIGHT;

/// The outputs of a run to a tolerance that has no constraints and at most three coordinates.
fn outputs<M: Mechanism<Real = f64>>(run: &Adaptive<M>) -> [f64; 2] {
    let (state, mut outputs) = (run.state(), [0.0; 2]);
    let [q, v] = [state.q, state.v].map(Components::into_array);
    let at = At { t: state.t, q: q.as_ref(), v: v.as_ref() };
    let a = &[0.0; 3][..q.as_ref().len()];
    Equations::outputs(run.mechanism(), at, run.inputs().into_array().as_ref(), [a, &[]], &mut outputs);
    outputs
}

mechanism! {
    /// A chest on two feet, on a table that goes up and down.
    Carried {
        dof = 3;
        const bob = 0.02 [m];
        const omega = 9 [rad/s];
        gravity = (0, -9.81) [m/s^2];
        body chest (x, y, phi) { mass = 2 [kg]; inertia = 0.1 [kg*m^2]; }
        point a on chest = (-0.2, -0.1) [m];
        point b on chest = (0.3, -0.1) [m];
        stop left: chest.a.y >= bob*(1 - cos(omega*t)) { restitution = 0; }
        stop right: chest.b.y >= bob*(1 - cos(omega*t)) { restitution = 0; }
        memory heavy [1] = 0;
        when force(left) > 13 [N] { set heavy = heavy + 1; }
        output on_left [N] = force(left);
        output on_right [N] = force(right);
        start { x = 0; y = 0.1 [m]; phi = 0; }
    }
}

/// The feet carry m (g + a) in the inverse ratio of their distances, at every instant, in runs of both kinds.
#[test]
fn feet_carry_the_weight_on_a_table_that_moves() -> Result<(), Error> {
    let expected = |t: f64| {
        let sum = 2.0 * (9.81 + 0.02 * 81.0 * (9.0 * t).cos());
        [0.6 * sum, 0.4 * sum]
    };
    // some roundings of forces of 14 N, and the rounding of the angle under which they act
    let near =
        |found: [f64; 2], t: f64| found.iter().zip(expected(t)).all(|(a, b)| (a - b).abs() < 1e-12 * 14.0);
    let mut run = Adaptive::builder(Carried::declared()).tolerances(TIGHT).build()?;
    let mut steps = Simulation::builder(Carried::declared(), 1e-3)
        .baumgarte(Baumgarte::<Held<Rk4>>::deadbeat(1e-3))
        .build()?;
    for at in 1..=200 {
        let t = 0.01 * f64::from(at);
        run.advance_to(t)?;
        assert!(near(outputs(&run), run.time()), "{t}: {:?}", outputs(&run));
        steps.advance(10)?;
        let found = steps.outputs()?;
        assert!(near([found.on_left, found.on_right], steps.time()), "{t}: {found:?}");
    }
    Ok(())
}

/// A condition on the force of a stop begins to hold where the force passes its value.
#[test]
fn a_condition_on_the_force_of_a_stop() -> Result<(), Error> {
    let mut run = Adaptive::builder(Carried::declared()).tolerances(TIGHT).build()?;
    // it holds at the start, and begins anew where 1.2 (g + A ω² cos ω t) = 13 on the way up, in the second half of the first turn
    let cosine: f64 = (13.0 / 1.2 - 9.81) / (0.02 * 81.0);
    let expected = (2.0 * std::f64::consts::PI - cosine.acos()) / 9.0;
    while run.inputs().heavy < 2.0 {
        run.step()?;
    }
    assert!((run.time() - expected).abs() < 1e-9, "{} {expected}", run.time());
    let mut steps = Simulation::builder(Carried::declared(), 1e-3).build()?;
    while steps.inputs().heavy < 2.0 {
        steps.step()?;
    }
    assert!((0.0..=1e-3).contains(&(steps.time() - expected)), "{} {expected}", steps.time());
    Ok(())
}

mechanism! {
    /// A hatch that falls on its end.
    Hatch {
        dof = 1;
        body hatch (angle = phi) { inertia = 0.5 [kg*m^2]; }
        torque weight on hatch = -4 [N*m]*cos(phi);
        torque pull on hatch = 2 [N*m/s]*t;
        stop end: phi >= 30 [deg] { restitution = 0; }
        output bears [N*m] = torque(end);
        output hit [N*m*s] = impulse(end);
        start { phi = 60 [deg]; }
    }
}

/// A stop of an angle bears a torque: none in flight, the rest of the weight while it is rested on, and none behind.
#[test]
fn a_stop_of_an_angle_bears_a_torque() -> Result<(), Error> {
    let weight = 4.0 * 30.0_f64.to_radians().cos();
    let mut run = Adaptive::builder(Hatch::declared()).tolerances(TIGHT).build()?;
    assert_eq!(outputs(&run), [0.0; 2]);
    let mut speed = 0.0;
    while run.inputs().end == 0.0 {
        speed = run.state().v.phi;
        run.step()?;
        assert!(run.inputs().end == 1.0 || outputs(&run)[1] == 0.0);
    }
    assert!(run.state().v.phi == 0.0 && speed < 0.0 && outputs(&run)[1] > 0.0);
    while run.time() < 1.7 {
        let [bears, _] = outputs(&run);
        assert!((bears - (weight - 2.0 * run.time())).abs() < 1e-14, "{}: {bears}", run.time());
        run.advance_to(run.time() + 0.05)?;
    }
    // the pull takes it off where it bears nothing any more
    run.advance_to(1.8)?;
    assert!(run.inputs().end == 0.0 && outputs(&run)[0] == 0.0 && run.state().v.phi > 0.0);
    Ok(())
}

mechanism! {
    /// Two equal carts that hit a buffer: one is a stop that gives way, the other is written out.
    Buffers {
        dof = 4;
        const k = 2e4 [N/m];
        const c = 30 [N*s/m];
        body one (x1, y1) { mass = 2 [kg]; }
        body other (x2, y2) { mass = 2 [kg]; }
        stop buffer: x1 <= 0.1 [m] { stiffness = k; damping = c; friction = 0.3; along = y1; transition = 1 [cm/s]; }
        let push = if x2 > 0.1 [m] { max(k*(x2 - 0.1 [m]) + c*der(x2), 0 [N]) } else { 0 [N] };
        force back on x2 = -push;
        force rub on y2 = -0.3*push*tanh(der(y2)/(1 [cm/s]));
        output pushes [N] = force(buffer);
        output written [N] = push;
        start { x1 = 0; x2 = 0; y1 = 0; y2 = 0; der(x1) = 1 [m/s]; der(x2) = 1 [m/s]; der(y1) = 2 [m/s]; der(y2) = 2 [m/s]; }
    }
}

/// A stop with a stiffness is the force max(0, k δ + c δ̇) with its friction, and nothing else.
#[test]
fn a_stop_that_gives_way_is_a_force() -> Result<(), Error> {
    let mut run = Simulation::builder(Buffers::declared(), 1e-5).build()?;
    let mut largest = 0.0_f64;
    for _ in 0..200 {
        run.advance(100)?;
        let (q, found) = (run.state().q, run.outputs()?);
        // the same formulas, in another order
        let is_same = |a: f64, b: f64, size: f64| (a - b).abs() < 1e-11 * size;
        assert!(is_same(found.pushes, found.written, 200.0), "{}: {found:?}", run.time());
        assert!(is_same(q.x1, q.x2, 1.0) && is_same(q.y1, q.y2, 1.0), "{}: {q:?}", run.time());
        largest = largest.max(found.pushes);
    }
    // v √(k m) without damping, and it is thrown back
    assert!((100.0..200.0).contains(&largest) && run.state().v.x1 < -0.7, "{largest} {:?}", run.state());
    Ok(())
}
