//! Equilibria and their stability against closed forms, from different starts, and where there is
//! none.

use std::f64::consts::FRAC_PI_2;

use mbs_analysis::{Error, Search, Stability, Strategy, equilibrium};
use mbs_runtime::equations::{Differentiated, Equations};
use mbs_runtime::mechanism;

mechanism! {
    /// A rod on a hinge.
    pub Pendulum {
        dof = 1;
        param l = 0.8 [m];
        param m = 2 [kg];
        input push [N*m];
        gravity = (0, -9.81) [m/s^2];
        body rod (x, y, phi) { mass = m; inertia = m*l^2/12; }
        point hinge on rod = (-l/2, 0);
        revolute pivot (rod.hinge, ground);
        torque hand on rod = push;
        start { phi = -1; guess x = 0.2 [m]; guess y = -0.3 [m]; }
    }
}

mechanism! {
    /// Two rods.
    pub Double {
        dof = 2;
        param l = 0.5 [m];
        gravity = (0, -9.81) [m/s^2];
        body upper (x1, y1, a1) { mass = 1 [kg]; inertia = 1/12*1 [kg]*l^2; }
        body lower (x2, y2, a2) { mass = 1 [kg]; inertia = 1/12*1 [kg]*l^2; }
        point base on upper = (-l/2, 0);
        point end on upper = (l/2, 0);
        point base on lower = (-l/2, 0);
        revolute hinge (upper.base, ground);
        revolute knee (upper.end, lower.base);
        start { a1 = -1; a2 = -1.2; guess x1 = 0.1 [m]; guess y1 = -0.2 [m]; guess x2 = 0.3 [m]; guess y2 = -0.6 [m]; }
    }
}

mechanism! {
    /// A cart without a spring, and a pendulum on it.
    pub Cart {
        dof = 2;
        gravity = (0, -9.81) [m/s^2];
        body cart (x) { mass = 3 [kg]; }
        body bob (xb, yb) { mass = 1 [kg]; }
        constraint rod: (xb - x)^2 + yb^2 = 0.25 [m^2];
        start { x = 0; xb = 0.3 [m]; guess yb = -0.4 [m]; }
    }
}

mechanism! {
    /// x = m g/k.
    pub Spring {
        dof = 1;
        param k = 200 [N/m];
        gravity = (9.81, 0) [m/s^2];
        body block (x) { mass = 2 [kg]; }
        force spring on x = -k*x - 3 [N*s/m]*der(x);
        start { x = 1 [m]; }
    }
}

mechanism! {
    /// A link that snaps through: two springs on a slider, V = k (√(a² + x²) − l)².
    pub Toggle {
        dof = 1;
        body slider (x) { mass = 1 [kg]; }
        force springs on x = -1000 [N/m]*x*(1 - 0.5 [m]/sqrt(0.16 [m^2] + x^2));
        start { x = 1 [cm]; }
    }
}

mechanism! {
    /// Nothing holds it.
    pub Falling {
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        body ball (y) { mass = 1 [kg]; }
        start { y = 1 [m]; }
    }
}

mechanism! {
    /// Nothing acts on it.
    pub Drifting {
        dof = 1;
        body ball (x) { mass = 1 [kg]; }
        start { x = 1 [m]; }
    }
}

mechanism! {
    /// A drive holds one of two coordinates that a spring joins.
    pub Held {
        dof = 1;
        body hand (x) { mass = 1 [kg]; }
        body block (x = z) { mass = 2 [kg]; }
        drive pull: x = 0.1 [m] + 0.2 [m/s]*t + 1 [m/s^2]*t^2;
        force on_block on z = -50 [N/m]*(z - x);
        start { guess x = 0.1 [m]; }
    }
}

fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} and not {expected}");
}

fn from(q: &[f64]) -> Search {
    Search { from: Some(q.to_vec()), ..Search::default() }
}

#[test]
fn a_pendulum_hangs_and_stands() {
    let pendulum = Pendulum::declared();
    let hanging = equilibrium(&pendulum, &Search::default()).expect("it hangs");
    near(hanging.q[2], -FRAC_PI_2, 1e-10);
    near(hanging.q[1], -0.4, 1e-10);
    assert_eq!(hanging.stability(), Stability::Stable);
    // ω² = m g (l/2)/(m l²/3)
    near(hanging.stiffness[0], 1.5 * 9.81 / 0.8, 1e-7);
    // the hinge carries the weight
    near(hanging.multipliers.iter().map(|x| x * x).sum::<f64>().sqrt(), 2.0 * 9.81, 1e-8);

    let standing = equilibrium(&pendulum, &from(&[0.1, 0.38, 1.3])).expect("it stands");
    near(standing.q[2], FRAC_PI_2, 1e-10);
    assert_eq!(standing.stability(), Stability::Unstable { directions: 1 });
    near(standing.stiffness[0], -1.5 * 9.81 / 0.8, 1e-7);

    // relaxation falls from there
    let search = Search { strategy: Strategy::Relaxation, ..from(&[0.1, 0.38, 1.3]) };
    let fallen = equilibrium(&pendulum, &search).expect("it falls");
    near(fallen.q[2].sin(), -1.0, 1e-15);
    near(fallen.q[2].cos(), 0.0, 1e-9);
    assert!(fallen.is_stable());
}

/// Exactly on top nothing moves it: relaxation pushes it.
#[test]
fn relaxation_leaves_where_a_pendulum_balances() {
    let search = Search { strategy: Strategy::Relaxation, ..from(&[0.0, 0.4, FRAC_PI_2]) };
    let fallen = equilibrium(&Pendulum::declared(), &search).expect("it falls");
    assert!(fallen.is_stable() && (fallen.q[1] + 0.4).abs() < 1e-10);
}

/// Where it begins level, gravity acts fully and has no stiffness.
#[test]
fn a_pendulum_that_begins_level_comes_to_hang() {
    let hanging = equilibrium(&Pendulum::declared(), &from(&[0.4, 0.0, 0.0])).expect("it hangs");
    near(hanging.q[1], -0.4, 1e-10);
    assert!(hanging.is_stable());
}

/// M = m g (l/2) cos φ.
#[test]
fn inputs_hold_it_where_they_balance_gravity() {
    let search = Search { inputs: Some(vec![4.0]), ..Search::default() };
    let held = equilibrium(&Pendulum::declared(), &search).expect("it is held");
    near(held.q[2].cos(), 4.0 / (2.0 * 9.81 * 0.4), 1e-10);
    assert!(held.is_stable());
    // more than gravity can hold
    let search = Search { inputs: Some(vec![10.0]), ..Search::default() };
    let error = equilibrium(&Pendulum::declared(), &search).expect_err("it turns for ever");
    assert!(
        matches!(error, Error::NoEquilibrium { .. }) && error.to_string().contains("accelerates"),
        "{error}"
    );
}

/// For two equal rods the linear system has M = m l² [4/3 1/2; 1/2 1/3], K = m g l [3/2 0; 0 1/2].
#[test]
fn a_double_pendulum_has_two_stiffnesses() {
    let found = equilibrium(&Double::declared(), &Search::default()).expect("it hangs");
    near(found.q[2], -FRAC_PI_2, 1e-9);
    near(found.q[5], -FRAC_PI_2, 1e-9);
    let (g, l) = (9.81, 0.5);
    // 7/36 κ² − (g/l)(7/6) κ + 3/4 (g/l)² = 0
    let [a, b, c] = [7.0 / 36.0, 7.0 / 6.0 * g / l, 0.75 * (g / l) * (g / l)];
    let root = f64::sqrt(b * b - 4.0 * a * c);
    near(found.stiffness[0], (b - root) / (2.0 * a), 1e-6);
    near(found.stiffness[1], (b + root) / (2.0 * a), 1e-6);
}

/// ω² = (1 + m/M) g/l, and 0 for the cart.
#[test]
fn a_cart_without_a_spring_is_indifferent() {
    let found = equilibrium(&Cart::declared(), &Search::default()).expect("it hangs somewhere");
    near(found.q[1] - found.q[0], 0.0, 1e-9);
    assert_eq!(found.stability(), Stability::Indifferent);
    near(found.stiffness[1], 4.0 / 3.0 * 9.81 / 0.5, 1e-6);
    near(found.stiffness[0], 0.0, 1e-7);
}

#[test]
fn a_spring_carries_a_weight() {
    let found = equilibrium(&Spring::declared(), &Search::default()).expect("it rests");
    near(found.q[0], 2.0 * 9.81 / 200.0, 1e-13);
    near(found.stiffness[0], 100.0, 1e-8);
    assert!(found.iterations < 30);
}

/// x = ±√(l² − a²) = ±0.3 m, and 0 between them.
#[test]
fn the_start_decides_on_the_branch() {
    for (start, expected, is_stable) in [(0.01, 0.0, false), (0.2, 0.3, true), (-0.35, -0.3, true)] {
        let found = equilibrium(&Toggle::declared(), &from(&[start])).expect("it rests");
        near(found.q[0], expected, 1e-10);
        assert_eq!(found.is_stable(), is_stable, "{start}");
    }
    let search = Search { strategy: Strategy::Relaxation, ..from(&[-0.01]) };
    near(equilibrium(&Toggle::declared(), &search).expect("it snaps").q[0], -0.3, 1e-9);
}

/// Drives stand still where they are at the time that is asked for, even if they accelerate.
#[test]
fn drives_are_held() {
    for t in [0.0, 0.5] {
        let search = Search { t, ..Search::default() };
        let found = equilibrium(&Held::declared(), &search).expect("it rests");
        let x = 0.1 + 0.2 * t + t * t;
        near(found.q[0], x, 1e-13);
        near(found.q[1], x, 1e-10);
        near(found.stiffness[0], 25.0, 1e-7);
    }
}

/// Neither a stiffness nor anything that holds it: Newton's method has nothing to correct.
#[test]
fn a_falling_body_has_no_equilibrium() {
    for strategy in [Strategy::Newton, Strategy::Relaxation, Strategy::Automatic] {
        let error = equilibrium(&Falling::declared(), &Search { strategy, ..Search::default() });
        assert!(matches!(error, Err(Error::NoEquilibrium { coordinate: "y", .. })), "{error:?}");
    }
    let drifting = equilibrium(&Drifting::declared(), &Search::default()).expect("nothing acts on it");
    assert_eq!(drifting.stability(), Stability::Indifferent);
}

mechanism! {
    /// A beam of 60 N on a pin and a slide 2 m apart.
    pub Bridge {
        dof = 0;
        param l = 2 [m];
        gravity = (0, -10) [m/s^2];
        body beam (x, y, theta) { mass = 6 [kg]; inertia = 2 [kg*m^2]; }
        point left on beam = (-l/4, 0);
        point right on beam = (3*l/4, 0);
        revolute pin (beam.left, ground);
        point_on_line slide (beam.right, ground) along (1, 0);
        start { guess x = 0.5 [m]; }
    }
}

#[test]
fn what_has_no_freedom_has_reactions() {
    let found = equilibrium(&Bridge::declared(), &Search::default()).expect("it is held");
    assert!(found.is_stable() && found.stiffness.is_empty());
    // 3/4 of the weight near the centre, 1/4 far away, to some roundings of 60 N
    let sizes: Vec<f64> = found.multipliers.iter().map(|x| x.abs()).collect();
    for (size, expected) in sizes.iter().zip([0.0, 45.0, 15.0]) {
        assert!((size - expected).abs() < 1e-12, "{sizes:?}");
    }
}

#[test]
fn what_cannot_rest_is_refused() {
    let error = equilibrium(&Spring::declared(), &from(&[1.0, 2.0])).expect_err("too many");
    assert!(error.to_string().contains("2 numbers"), "{error}");
}

/// Where the equations can be had over duals, stiffnesses are exact: κ = 3g/2l of a rod, to a few
/// roundings of its terms. Without, they are differences, good to ten digits.
#[test]
fn a_differentiable_mechanism_has_exact_stiffnesses() {
    let expected = 1.5 * 9.81 / 0.8;
    let of = |mechanism: &dyn Equations<f64>| {
        let rest = equilibrium(mechanism, &Search::default()).unwrap();
        (rest.stiffness[0] - expected).abs() / expected
    };
    let pendulum = Pendulum::declared();
    assert!(of(&pendulum) < 1e-10 && of(&Differentiated(pendulum)) < 32.0 * f64::EPSILON);
}

mechanism! {
    /// A force with an infinite slope at x = 0, and without a value below.
    pub Root {
        dof = 2;
        body bead (x, y) { mass = 1 [kg]; }
        force drag on x = -3 [N]*sqrt(x/1 [m]);
        force spring on y = -30 [N/m]*(y - 1 [m]);
        start { x = 0; y = 0; }
    }
}

/// These were panics of a decomposition.
#[test]
fn forces_without_a_value_or_a_slope_are_named() {
    for strategy in [Strategy::Newton, Strategy::Relaxation, Strategy::Automatic] {
        let at = |x: f64| {
            let search = Search { strategy, ..from(&[x, 0.0]) };
            equilibrium(&Differentiated(Root::declared()), &search).expect_err("no numbers").to_string()
        };
        assert!(
            at(0.0).starts_with("the acceleration of `x` has no derivative at this position"),
            "{}",
            at(0.0)
        );
        assert!(
            at(-1.0).starts_with("the acceleration of `x` is no number at this position"),
            "{}",
            at(-1.0)
        );
    }
}
