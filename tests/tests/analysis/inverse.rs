//! Forces of prescribed motions: closed forms of pendulums, drives that are declared against drives that
//! are not, more inputs and fewer than degrees of freedom, forces that are not linear in an input, runs
//! that get the motion back from the inputs that were found, texts; and motions that cannot be made.

#![allow(clippy::expect_used, reason = "a test says by panicking what is wrong")]

use mbs_analysis::{By, Curve, Error, Instant, Prescription, Time, inverse};
use mbs_runtime::equations::Equations;
use mbs_runtime::{Components, Dual, Real, Simulation, mechanism};

mechanism! {
    /// A mass on a rod without mass, its angle counted from below.
    pub Pendulum {
        dof = 1;
        param m = 2 [kg];
        param l = 0.7 [m];
        input torque [N*m];
        gravity = (0, -9.81) [m/s^2];
        body bob (x, y, theta) { mass = m; inertia = 0; }
        point pivot on bob = (0, l);
        revolute hinge (bob.pivot, ground);
        torque motor on bob = torque;
        start { theta = 0; guess y = -l; }
        output motor_power [W] = torque*der(theta);
    }
}

mechanism! {
    /// Two points on rods, each driven against the link before it.
    pub DoublePendulum {
        dof = 2;
        input shoulder [N*m];
        input elbow [N*m];
        gravity = (0, -9.81) [m/s^2];
        body upper (x1, y1, a) { mass = 1.5 [kg]; inertia = 0.02 [kg*m^2]; }
        body lower (x2, y2, b) { mass = 0.8 [kg]; inertia = 0.01 [kg*m^2]; }
        point top on upper = (0, 0.25) [m];
        point end on upper = (0, -0.25) [m];
        point top on lower = (0, 0.2) [m];
        revolute pivot (upper.top, ground);
        revolute joint (upper.end, lower.top);
        torque of_shoulder on upper = shoulder - elbow;
        torque of_elbow on lower = elbow;
        start { a = 0; b = 0; guess y1 = -0.25 [m]; guess y2 = -0.7 [m]; }
    }
}

four_bar! { FourBar;
    dof = 1;
    method = rk4;
    input torque [N*m];
    input force [N];
    point bearing on ground = (0.5, 0) [m];
    torque hand on crank = torque;
    force push on coupler = (force, 0);
    torque damper on rocker = -0.3 [N*m*s]*der(t3);
    output load [N] = lambda(r_x);
}

four_bar! { DrivenFourBar;
    dof = 0;
    point bearing on ground = (0.5, 0) [m];
    torque damper on rocker = -0.3 [N*m*s]*der(t3);
    drive motor: t1 = 1 + 0.4*sin(5 [rad/s]*t);
    output torque [N*m] = effort(motor);
    output load [N] = lambda(r_x);
}

mechanism! {
    /// A block on a rail with friction, pushed by a force that is no line of its input and lifts as well.
    pub Shuttle {
        dof = 1;
        input level [1];
        gravity = (0, -9.81) [m/s^2];
        body block (x, y, phi) { mass = 3 [kg]; inertia = 0.1 [kg*m^2]; }
        prismatic rail (block, ground) along (1, 0);
        force motor on block = (4 [N]*(level + level^3), 6 [N]*level);
        friction pads (block, ground) along (1, 0) {
            coefficient = 0.2; normal = reaction(rail); transition = 1e-2 [m/s];
        }
        start { x = 0; }
    }
}

mechanism! {
    /// A block that two rails keep from turning.
    pub Rails {
        dof = 1;
        redundant = minimum_norm;
        param slope = 3 [N/m];
        gravity = (0, -9.81) [m/s^2];
        body block (x, y, phi) { mass = 3 [kg]; inertia = 0.1 [kg*m^2]; }
        point right on block = (0.3, 0) [m];
        prismatic rail (block, ground) along (1, 0);
        point_on_line second (block.right, ground) along (1, 0);
        force spring on block.right = (-slope*x, 1 [N]);
        start { x = 0; }
    }
}

mechanism! {
    /// Two cranks of one length, their pins at the distance of their bearings.
    pub Parallelogram {
        dof = 1;
        body first (angle = a) { inertia = 1 [kg*m^2]; }
        body second (angle = b) { inertia = 1 [kg*m^2]; }
        constraint rod: (0.5 [m] + 0.2 [m]*(cos(b) - cos(a)))^2 + (0.2 [m]*(sin(b) - sin(a)))^2 = 0.25 [m^2];
        start { a = 1; guess b = 1; }
    }
}

fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} and not {expected}");
}

fn constant(x: f64) -> Time {
    Dual::constant(Dual::constant(x))
}

/// c + a sin ωt
fn swing(c: f64, a: f64, omega: f64) -> Curve {
    Curve::function(move |t| constant(c) + constant(a) * (constant(omega) * t).sin())
}

fn asked(name: &str, curve: Curve, by: By) -> Prescription {
    Prescription { curves: vec![(name.into(), curve)], by, ..Prescription::default() }
}

fn named(inputs: &[&str]) -> By {
    By::Inputs(inputs.iter().map(|name| (*name).to_owned()).collect())
}

fn times(end: f64, count: u32) -> Vec<f64> {
    (0..=count).map(|at| end * f64::from(at) / f64::from(count)).collect()
}

#[test]
fn the_torque_of_a_pendulum() {
    let pendulum = Pendulum::declared();
    let found = inverse(&pendulum, &asked("theta", swing(0.3, 2.5, 4.0), By::AllInputs), &times(2.0, 100))
        .expect("it turns");
    let (m, l) = (2.0, 0.7);
    for Instant { t, q, v, acceleration, inputs, multipliers, outputs, .. } in found {
        let (theta, rate, second) =
            (0.3 + 2.5 * (4.0 * t).sin(), 10.0 * (4.0 * t).cos(), -40.0 * (4.0 * t).sin());
        near(q[2], theta, 1e-12);
        near(acceleration[2], second, 1e-10);
        // m l² θ̈ + m g l sin θ
        let torque = m * l * l * second + m * 9.81 * l * theta.sin();
        near(inputs[0], torque, 1e-10);
        near(outputs[0], torque * v[2], 1e-8);
        // the hinge pulls towards itself by m(g cos θ + l θ̇²), and pushes across by m(l θ̈ + g sin θ)
        let size = (9.81 * theta.cos() + l * rate * rate).hypot(l * second + 9.81 * theta.sin()) * m;
        near(multipliers[0].hypot(multipliers[1]), size, 1e-9);
    }
}

#[test]
fn two_torques_of_a_double_pendulum() {
    let request = Prescription {
        curves: vec![("b".into(), swing(0.5, 0.7, 3.0)), ("a".into(), swing(-0.2, 1.1, 2.0))],
        by: By::AllInputs,
        ..Prescription::default()
    };
    for instant in inverse(&DoublePendulum::declared(), &request, &times(3.0, 60)).expect("it moves") {
        let t = instant.t;
        let (a, b) = (-0.2 + 1.1 * (2.0 * t).sin(), 0.5 + 0.7 * (3.0 * t).sin());
        let (va, vb) = (2.2 * (2.0 * t).cos(), 2.1 * (3.0 * t).cos());
        let (aa, ab) = (-4.4 * (2.0 * t).sin(), -6.3 * (3.0 * t).sin());
        // Lagrange, with angles from below: link 1 of length 0.5 m, centres at 0.25 m and 0.2 m
        let (coupling, cos, sin) = (0.8 * 0.5 * 0.2, (a - b).cos(), (a - b).sin());
        let elbow =
            (0.01 + 0.8 * 0.04) * ab + coupling * (cos * aa - sin * va * va) + 0.8 * 9.81 * 0.2 * b.sin();
        let upper = (0.02 + 1.5 * 0.0625 + 0.8 * 0.25) * aa
            + coupling * (cos * ab + sin * vb * vb)
            + (1.5 * 0.25 + 0.8 * 0.5) * 9.81 * a.sin();
        near(instant.inputs[1], elbow, 1e-11);
        near(instant.inputs[0], upper + elbow, 1e-11);
    }
}

/// A drive that is declared exerts what an input does in its place, and what the force along the coordinate
/// is; and everything else is the same.
#[test]
fn a_drive_an_input_and_an_effort() {
    let times = times(1.2, 40);
    let free = FourBar::declared();
    let curve = || swing(1.0, 0.4, 5.0);
    let driven = inverse(&DrivenFourBar::declared(), &Prescription::default(), &times).expect("it is driven");
    let by_input =
        inverse(&free, &asked("t1", curve(), named(&["torque"])), &times).expect("it has an input");
    let by_effort = inverse(&free, &asked("t1", curve(), By::Efforts), &times).expect("it can be led");
    for ((driven, by_input), by_effort) in driven.iter().zip(&by_input).zip(&by_effort) {
        let torque = driven.outputs[0];
        near(by_input.inputs[0], torque, 1e-9);
        near(by_effort.efforts[0], torque, 1e-9);
        near(by_input.outputs[0], driven.outputs[1], 1e-9);
        near(by_effort.outputs[0], driven.outputs[1], 1e-9);
        for (x, y) in by_effort.acceleration.iter().zip(&driven.acceleration) {
            near(*x, *y, 1e-9);
        }
    }
    // and what the runtime's own kinematics says
    let mut kinematics = mbs_runtime::Kinematics::new(DrivenFourBar::declared()).expect("it is driven");
    let motion = kinematics.at(times[17]).expect("it is assembled");
    for (x, y) in motion.acceleration.into_array().iter().zip(&driven[17].acceleration) {
        near(*x, *y, 1e-9);
    }
}

/// The inputs at the middle of each step, held over it, lead a run along the motion that they were found
/// for, to the error of holding them: a quarter at half of the step.
#[test]
fn a_run_gets_the_motion_back() {
    let error = |steps: u32| {
        let h = 1.0 / f64::from(steps);
        let middles: Vec<f64> = (0..steps).map(|at| (f64::from(at) + 0.5) * h).collect();
        let curve = Curve::rest_to_rest(1.0, 2.2, 0.0, 1.0).expect("it lasts");
        let request = asked("t1", curve, named(&["torque"]));
        let found = inverse(&FourBar::declared(), &request, &middles).expect("it moves");
        let mut run = Simulation::new(FourBar::declared(), h).expect("it starts");
        let curve = Curve::rest_to_rest(1.0, 2.2, 0.0, 1.0).expect("it lasts");
        let mut worst = 0.0_f64;
        for instant in &found {
            run.inputs_mut().torque = instant.inputs[0];
            run.step().expect("it goes on");
            worst = worst.max((run.state().q.t1 - curve.at(run.time()).position).abs());
        }
        worst
    };
    let (coarse, fine) = (error(200), error(400));
    near((coarse / fine).log2(), 2.0, 0.02);
    // what is left where the step vanishes
    assert!(((4.0 * fine - coarse) / 3.0).abs() < 1e-3 * fine);
}

/// Of two inputs the least ones are taken: u = Gᵀ(G Gᵀ)⁻¹τ.
#[test]
fn more_inputs_than_degrees_of_freedom() {
    let four_bar = FourBar::declared();
    let times = times(1.0, 10);
    let with = |by: By| inverse(&four_bar, &asked("t1", swing(1.0, 0.3, 4.0), by), &times).expect("it moves");
    let (torque, force, both) = (with(named(&["torque"])), with(named(&["force"])), with(By::AllInputs));
    for ((torque, force), both) in torque.iter().zip(&force).zip(&both) {
        let (t, f) = (torque.inputs[0], force.inputs[1]);
        // either alone is τ/G
        let expected = [1.0 / t, 1.0 / f].map(|gain| gain / (1.0 / (t * t) + 1.0 / (f * f)));
        near(both.inputs[0], expected[0], 1e-8 * t.abs());
        near(both.inputs[1], expected[1], 1e-8 * f.abs());
    }
}

/// 3 ẍ = 4 (u + u³) − 0.2 |N| tanh(v/v₀) with N = m g − 6 u, which the rail carries.
#[test]
fn a_force_that_is_no_line_of_its_input() {
    let request = asked("x", swing(0.0, 0.1, 6.0), By::AllInputs);
    for instant in inverse(&Shuttle::declared(), &request, &times(1.0, 50)).expect("it moves") {
        let u = instant.inputs[0];
        near(instant.multipliers[0].abs(), (3.0 * 9.81 - 6.0 * u).abs(), 1e-9);
        let brake = 0.2 * (3.0 * 9.81 - 6.0 * u).abs() * (instant.v[0] / 1e-2).tanh();
        near(3.0 * instant.acceleration[0], 4.0 * (u + u * u * u) - brake, 1e-8);
    }
}

/// Redundant constraints share a reaction as in a run: by least norm.
#[test]
fn redundant_rails() {
    let rails = Rails::declared();
    let found = inverse(&rails, &asked("x", swing(0.2, 0.1, 6.0), By::Efforts), &[0.3]).expect("it moves");
    let x = 0.2 + 0.1 * 1.8_f64.sin();
    near(found[0].efforts[0], 3.0 * found[0].acceleration[0] + 3.0 * x, 1e-10);
    let mut run = Simulation::new(rails, 1e-3).expect("it starts");
    run.step().expect("it slides");
    let reactions = run.reactions().expect("they exist").multipliers.into_array();
    for (led, free) in found[0].multipliers.iter().zip(reactions.as_ref()) {
        near(*led, *free, 1e-9);
    }
}

#[test]
fn a_text_as_the_type() {
    let text = mbs_live::Text::rust(file!(), include_str!("inverse.rs")).named("Pendulum");
    let live = text.compile().expect("it is a declaration");
    let request = || asked("theta", swing(0.3, 2.5, 4.0), By::AllInputs);
    let of_text = inverse(&live, &request(), &times(1.0, 10)).expect("it turns");
    let of_type = inverse(&Pendulum::declared(), &request(), &times(1.0, 10)).expect("it turns");
    for (text, typed) in of_text.iter().zip(&of_type) {
        near(text.q[0], typed.q[0], 1e-13);
        near(text.inputs[0], typed.inputs[0], 1e-12);
    }
}

#[test]
fn motions_that_cannot_be_made() {
    let failed = |mechanism: &dyn Equations<f64>, request: Prescription| {
        inverse(mechanism, &request, &times(1.0, 20)).expect_err("it cannot be made")
    };
    let pendulum = Pendulum::declared();
    let double = DoublePendulum::declared();
    let still = || swing(0.0, 0.0, 1.0);
    assert!(matches!(failed(&pendulum, Prescription::default()), Error::Prescribed { dof: 1, .. }));
    let twice = Prescription {
        curves: vec![("a".into(), still()), ("a".into(), still())],
        ..Prescription::default()
    };
    assert!(matches!(failed(&double, twice), Error::Prescribed { dof: 2, .. }));
    assert!(matches!(
        failed(&pendulum, asked("phi", still(), By::Efforts)),
        Error::Unknown { kind: "coordinate", .. }
    ));
    assert!(matches!(
        failed(&pendulum, asked("theta", still(), named(&["push"]))),
        Error::Unknown { kind: "input", .. }
    ));
    let nothing = asked("theta", still(), named(&[]));
    assert!(matches!(failed(&pendulum, nothing), Error::NoInputs { mechanism: "Pendulum" }));
    let driven = Prescription { by: By::AllInputs, ..Prescription::default() };
    assert!(matches!(
        failed(&DrivenFourBar::declared(), driven),
        Error::NoInputs { .. } | Error::NoFreedom { .. }
    ));

    // the shoulder alone cannot lead both links
    let request = Prescription {
        curves: vec![("a".into(), swing(0.0, 0.5, 2.0)), ("b".into(), still())],
        by: named(&["shoulder"]),
        ..Prescription::default()
    };
    let message = failed(&double, request).to_string();
    assert!(message.contains("along `b` more than `shoulder` can produce"), "{message}");
}

/// The rocker turns where crank and coupler are in one line: 0.7² = 0.5² + 0.3² + 2·0.5·0.3 cos t3. What
/// is led beyond is told where that is.
#[test]
fn a_rocker_is_led_to_its_dead_centre() {
    let led = Curve::rest_to_rest(1.5, 0.5, 0.0, 1.0).expect("it lasts");
    let request = asked("t3", led, By::Efforts);
    let error = inverse(&FourBar::declared(), &request, &times(1.0, 50)).expect_err("it is out of reach");
    let limit = ((0.49_f64 - 0.25 - 0.09) / 0.3).acos();
    let Error::Unreachable { place, coordinate, .. } = &error else { panic!("{error}") };
    assert_eq!(*coordinate, "t1");
    let reached = place.rsplit("= ").next().and_then(|text| text.strip_suffix(" rad"));
    let reached: f64 = reached.expect("a place").parse().expect("a number");
    near(reached, limit, 1e-5);
}

/// A parallelogram passes its change point, where it may become a crossed one, and is not led through it.
#[test]
fn a_change_point_is_not_passed() {
    let led = swing(1.0, 3.0, 1.0);
    let request = asked("a", led, By::Efforts);
    let error = inverse(&Parallelogram::declared(), &request, &times(1.5, 7)).expect_err("it has a branch");
    let Error::Unreachable { place, constraint: "rod", .. } = &error else { panic!("{error}") };
    assert!(place.contains("`a` = 3.1415"), "{place}");
}
