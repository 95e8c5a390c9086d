//! Redundant constraints, allowed on purpose: the motion is that of the
//! mechanism without them, and the multipliers are those of least norm, as a
//! dense pseudo-inverse gives them.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::{Components, Error, Mechanism, Reactions, Simulation, State, mechanism};
use nalgebra::{DMatrix, DVector, SMatrix};

mechanism! {
    /// A parallelogram whose third link, of the same length, is spare.
    pub Spare {
        dof = 1;
        redundant = minimum_norm;
        param l = 1 [m];
        param w = 2 [m];
        param a = 0.3 [m];
        param third = 1 [m];
        gravity = (0, -9.81) [m/s^2];
        body left  (theta1) { inertia = 1 [kg*m^2]; }
        body right (theta2) { inertia = 1 [kg*m^2]; }
        body spare (theta3) { inertia = 1e-9 [kg*m^2]; }
        body top   (x, y, theta) { mass = 2 [kg]; inertia = 3 [kg*m^2]; }
        constraint left_x:  l*cos(theta1) = x;
        constraint left_y:  l*sin(theta1) = y;
        constraint right_x: w + l*cos(theta2) = x + w*cos(theta);
        constraint right_y: l*sin(theta2) = y + w*sin(theta);
        constraint spare_x: a + third*cos(theta3) = x + a*cos(theta);
        constraint spare_y: third*sin(theta3) = y + a*sin(theta);
        start {
            theta1 = -1; der(theta1) = 0.5 [rad/s];
            guess theta2 = -1; guess theta3 = -1; guess x = 0.5 [m]; guess y = -0.8 [m];
        }
    }
}

mechanism! {
    /// The same without the spare link.
    pub Plain {
        dof = 1;
        param l = 1 [m];
        param w = 2 [m];
        gravity = (0, -9.81) [m/s^2];
        body left  (theta1) { inertia = 1 [kg*m^2]; }
        body right (theta2) { inertia = 1 [kg*m^2]; }
        body top   (x, y, theta) { mass = 2 [kg]; inertia = 3 [kg*m^2]; }
        constraint left_x:  l*cos(theta1) = x;
        constraint left_y:  l*sin(theta1) = y;
        constraint right_x: w + l*cos(theta2) = x + w*cos(theta);
        constraint right_y: l*sin(theta2) = y + w*sin(theta);
        start {
            theta1 = -1; der(theta1) = 0.5 [rad/s];
            guess theta2 = -1; guess x = 0.5 [m]; guess y = -0.8 [m];
        }
    }
}

mechanism! {
    /// A parallelogram on a slope, of whole bodies and joints, with a spare rod.
    pub Jointed {
        dof = 1;
        redundant = minimum_norm;
        param l = 0.5 [m];
        param w = 0.8 [m];
        gravity = (3, -9) [m/s^2];
        body left  (x1, y1, p1) { mass = 1 [kg]; inertia = 0.02 [kg*m^2]; }
        body right (x2, y2, p2) { mass = 1 [kg]; inertia = 0.02 [kg*m^2]; }
        body top   (x3, y3, p3) { mass = 2 [kg]; inertia = 0.1 [kg*m^2]; }
        point a on ground = (0, 0);
        point b on ground = (0.8*w, 0.6*w);
        point hook on ground = (0.24*w, 0.18*w);
        point left_foot on left = (-l/2, 0);
        point left_tip on left = (l/2, 0);
        point right_foot on right = (-l/2, 0);
        point right_tip on right = (l/2, 0);
        point top_left on top = (-0.4*w, -0.3*w);
        point top_right on top = (0.4*w, 0.3*w);
        point top_hook on top = (-0.16*w, -0.12*w);
        distance spare (top.top_hook, ground.hook) = l;
        revolute foot_a (left.left_foot, ground.a);
        revolute foot_b (right.right_foot, ground.b);
        revolute tip_a (left.left_tip, top.top_left);
        revolute tip_b (right.right_tip, top.top_right);
        start {
            p1 = -1; guess p2 = -1.1; guess x1 = 0.15 [m]; guess y1 = -0.2 [m];
            guess x2 = 0.7 [m]; guess y2 = 0.3 [m]; guess x3 = 0.6 [m]; guess y3 = -0.15 [m];
        }
    }
}

mechanism! {
    /// A beam on three supports: one more than its three coordinates need.
    pub Beam {
        dof = 0;
        redundant = minimum_norm;
        param l = 2 [m];
        gravity = (0, -10) [m/s^2];
        body beam (x, y, theta) { mass = 6 [kg]; inertia = 2 [kg*m^2]; }
        point left on beam = (-l/2, 0);
        point right on beam = (l/2, 0);
        revolute pin (beam.left, ground);
        point_on_line middle (beam, ground) along (1, 0);
        point_on_line end (beam.right, ground) along (1, 0);
        start { guess x = 1 [m]; }
    }
}

mechanism! {
    /// A pendulum that is hinged twice at the same place.
    pub Twice {
        dof = 1;
        redundant = minimum_norm;
        param l = 1 [m];
        gravity = (0, -10) [m/s^2];
        body rod (x, y, theta) { mass = 3 [kg]; inertia = 1 [kg*m^2]; }
        point base on rod = (-l/2, 0);
        revolute pin (rod.base, ground);
        revolute hinge (rod.base, ground);
        start { theta = 0.3; guess x = 0.5 [m]; guess y = 0; }
    }
}

/// The multipliers of least norm with Φ_qᵀ λ = Q − M q̈: the pseudo-inverse by
/// the singular vectors of Φ_q, as eigenvectors of Φ_q Φ_qᵀ.
fn least_norm<const M: usize, const N: usize>(
    phi_q: &SMatrix<f64, M, N>,
    mass: &SMatrix<f64, N, N>,
    forces: [f64; N],
    acceleration: [f64; N],
) -> DVector<f64> {
    let load = DVector::from_row_slice(&forces)
        - DMatrix::from_column_slice(N, N, mass.as_slice()) * DVector::from_row_slice(&acceleration);
    let phi_q = DMatrix::from_column_slice(M, N, phi_q.as_slice());
    let squares = (&phi_q * phi_q.transpose()).symmetric_eigen();
    // The eigenvalue of a redundant row comes out at rounding, the others here
    // at 0.01 and more.
    let inverses = squares.eigenvalues.map(|value| if value > 1e-8 { 1.0 / value } else { 0.0 });
    let vectors = &squares.eigenvectors;
    vectors * (inverses.component_mul(&(vectors.transpose() * (phi_q * load))))
}

/// Largest difference over the largest multiplier.
fn deviation<C: Components<Real = f64>>(ours: C, reference: &DVector<f64>) -> f64 {
    let ours = ours.into_array();
    (DVector::from_row_slice(ours.as_ref()) - reference).amax() / reference.amax()
}

/// Both solutions come from backward-stable eliminations of matrices whose
/// condition at these positions is below 1e3: 1e3 times a few tens of ε.
const ROUNDING: f64 = 1e-11;

macro_rules! assert_least_norm {
    ($mechanism:expr, $state:expr) => {{
        let (mechanism, state) = ($mechanism, $state);
        let inputs = Default::default();
        let Reactions { acceleration, multipliers, .. } = mechanism.accelerations(&state, &inputs);
        let reference = least_norm(
            &mechanism.phi_q(state.t, &state.q),
            &mechanism.mass(&state.q),
            mechanism.forces(&state, &inputs).into_array(),
            acceleration.into_array(),
        );
        let deviation = deviation(multipliers, &reference);
        assert!(deviation < ROUNDING, "{deviation:e} at {state:?}");
    }};
}

#[test]
fn a_spare_link_does_not_change_the_motion() {
    let h = 1e-3;
    let mut spare = Simulation::new(Spare::declared(), h).expect("assembles");
    let mut plain = Simulation::new(Plain::declared(), h).expect("assembles");
    for _ in 0..2000 {
        spare.step().expect("regular");
        plain.step().expect("regular");
    }
    let (a, b) = (spare.state().q, plain.state().q);
    // The spare link's inertia of 1e-9 kg·m² beside 4: it moves the others by
    // that much; everything else is rounding, which a free swing of 2 s amplifies
    // by less than 1e3.
    for (name, x, y) in [("theta1", a.theta1, b.theta1), ("x", a.x, b.x), ("theta", a.theta, b.theta)] {
        assert!((x - y).abs() < 1e-8, "{name}: {x} and {y}");
    }
    assert!((a.theta1 + 1.0).abs() > 0.1, "it moves");
    // The violation of the spare rows is that of the others: second order.
    assert!(spare.violation() < 1e-6, "{}", spare.violation());
}

#[test]
fn multipliers_of_a_spare_link_are_those_of_least_norm() {
    let mut run = Simulation::new(Spare::declared(), 1e-3).expect("assembles");
    for _ in 0..10 {
        assert_least_norm!(run.mechanism(), assembled(run.mechanism(), &run.state()));
        run.advance_to(run.time() + 0.1).expect("regular");
    }
}

#[test]
fn a_spare_rod_shares_the_load() {
    let mut run = Simulation::new(Jointed::declared(), 1e-3).expect("assembles");
    // `spare` says what the joints say, the last of which is the one too many.
    assert_eq!(Jointed::<f64>::INFO.redundant[0], 8);
    let mut tensions = Vec::new();
    for _ in 0..8 {
        let state = mbs_runtime::start::consistent(run.mechanism(), &run.state()).expect("assembled");
        assert_least_norm!(run.mechanism(), state);
        let none = Default::default();
        tensions.push(run.mechanism().accelerations(&state, &none).multipliers.spare);
        run.advance_to(run.time() + 0.1).expect("regular");
    }
    assert!(run.violation() < 1e-5, "{}", run.violation());
    assert!(tensions.iter().all(|tension| tension.abs() > 0.1), "{tensions:?}");
}

/// The state on Φ = 0: least norm off the constraints depends on what the
/// redundant rows are there.
fn assembled(mechanism: &Spare, at: &State<SpareCoordinates>) -> State<SpareCoordinates> {
    mbs_runtime::start::consistent(mechanism, at).expect("close to being assembled")
}

#[test]
fn a_beam_on_three_supports() {
    let beam = Beam::declared();
    let state = State {
        t: 0.0,
        q: BeamCoordinates { x: 1.0, y: 0.0, theta: 0.0 },
        v: BeamCoordinates { x: 0.0, y: 0.0, theta: 0.0 },
    };
    let found = beam.accelerations(&state, &Default::default());
    // By hand: p + m + e = 60 N upwards and, about the middle, p = e; of these
    // the least p² + m² + e² has p = m = e = 20 N. `pin` is what the beam exerts
    // on the ground, the others act on the ground as well.
    let forces = [found.multipliers.pin_y, found.multipliers.middle, found.multipliers.end];
    for force in forces {
        assert!((force.abs() - 20.0).abs() < 60.0 * 16.0 * f64::EPSILON, "{forces:?}");
    }
    assert!(found.acceleration.into_array().iter().all(|a| a.abs() < 1e-14));
    assert_least_norm!(beam, state);
}

/// A bar far from the origin is short beside the coordinates that its equation squares: its length tells how far the mechanism
/// moves, not d²/2l, by which 25 mm looked like no motion at all.
#[test]
fn a_short_bar_moves_beside_a_spare_guide() {
    mechanism! {
        ShortBar {
            dof = 1;
            redundant = minimum_norm;
            body bob (x, y) { mass = 1 [kg]; }
            body slide (y_s, phi) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
            point hook on ground = (2.4 [m], -1.6 [m]);
            point guide on ground = (0.6 [m], 0.9 [m]);
            point eye on slide = (0.6 [m], 0.7 [m]);
            distance bar (bob, ground.hook) = 25 [mm];
            prismatic rail (slide.eye, ground.guide) along (1, 3);
            point_on_line spare (slide.eye, ground.guide) along (2, 1);
            start { guess x = 2.425 [m]; guess y = -1.6 [m]; guess y_s = 0.2 [m]; }
        }
    }
    let mut run = Simulation::new(ShortBar::declared(), 1e-3).expect("one row of three is spare");
    run.advance_to(0.1).expect("nothing acts on it");
    // the start is assembled to rounding
    assert!(run.state().v.x.abs() < 1e-12, "{}", run.state().v.x);
}

#[test]
fn two_joints_at_one_place_share_the_force() {
    let mut run = Simulation::new(Twice::declared(), 1e-3).expect("assembles");
    run.advance_to(0.7).expect("regular");
    let found = run.mechanism().accelerations(&run.state(), &Default::default()).multipliers;
    // Equal rows: the system does not tell them apart, not even in rounding.
    for (pin, hinge) in [(found.pin_x, found.hinge_x), (found.pin_y, found.hinge_y)] {
        assert!((pin - hinge).abs() <= 4.0 * f64::EPSILON * pin.abs(), "{pin} and {hinge}");
    }
    assert_least_norm!(run.mechanism(), run.state());
    assert_eq!(Twice::<f64>::INFO.redundant, [2, 3]);
    assert_eq!(Twice::<f64>::INFO.dof, 1);
}

#[test]
fn a_spare_link_that_does_not_fit_is_refused_at_run_time() {
    let wrong = Spare::new(SpareParameters { third: 0.999, ..Default::default() }).expect("valid");
    let error = Simulation::builder(wrong, 1e-3).build().expect_err("does not fit");
    match error {
        Error::NotAssembled { constraint: "spare_y", violation, .. } => {
            assert!((1e-4..1e-2).contains(&violation), "{violation}");
        }
        other => panic!("{other}"),
    }
}

mechanism! {
    /// A rod on three parallel cranks, whose pivots are not in line: it is held once too often, and no position is singular.
    /// Each pin says nothing of its own somewhere: a row where the crank lies along it, both where the other two cranks
    /// are in line with their pivots.
    pub Cranks {
        dof = 1;
        redundant = minimum_norm;
        param r = 0.2 [m];
        gravity = (0, -9.81) [m/s^2];
        body first (theta1) { inertia = 0.05 [kg*m^2]; }
        body second (theta2) { inertia = 0.05 [kg*m^2]; }
        body third (theta3) { inertia = 0.05 [kg*m^2]; }
        body rod (x, y, b) { mass = 2 [kg]; inertia = 0.1 [kg*m^2]; }
        point tip on first = (r, 0);
        revolute pin1 (first.tip, rod);
        constraint pin2_x: 1 [m] + r*cos(theta2) = x + 1 [m]*cos(b);
        constraint pin2_y: r*sin(theta2) = y + 1 [m]*sin(b);
        constraint pin3_x: 0.5 [m] + r*cos(theta3) = x + 0.5 [m]*cos(b) + 0.3 [m]*sin(b);
        constraint pin3_y: r*sin(theta3) - 0.3 [m] = y + 0.5 [m]*sin(b) - 0.3 [m]*cos(b);
        start {
            theta1 = 1; der(theta1) = 8 [rad/s];
            guess theta2 = 1; guess theta3 = 1; guess x = 0.11 [m]; guess y = 0.17 [m]; guess b = 0;
        }
    }
}

/// A run used to end where the third crank was level, after 0.26 s.
#[test]
fn a_rod_on_three_parallel_cranks_turns_on_and_on() {
    let h = 1e-4;
    let mut run = Simulation::new(Cranks::declared(), h).expect("assembles");
    for at in 1..=60 {
        run.advance_to(f64::from(at) * 0.05).expect("regular in every position");
        let state = mbs_runtime::start::consistent(run.mechanism(), &run.state()).expect("assembled");
        assert_least_norm!(run.mechanism(), state);
        // a pendulum of 3·0.05 + m r² with the rod's weight: ω² from the energy
        let (inertia, weight) = (0.15 + 2.0 * 0.04, 2.0 * 9.81 * 0.2);
        let squared = 64.0 - 2.0 * weight * (state.q.theta1.sin() - 1.0_f64.sin()) / inertia;
        // the method is of order 2: (8 h)² a radian, over 30 rad
        assert!((state.v.theta1.powi(2) - squared).abs() < 30.0 * (8.0 * h).powi(2) * 64.0, "{state:?}");
    }
    assert!(run.state().q.theta1 > 8.0 * std::f64::consts::PI, "four turns: {}", run.state().q.theta1);
}
