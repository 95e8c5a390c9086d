//! Equilibria of mechanisms with springs that are many orders stiffer than what else holds them.

#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

use std::f64::consts::FRAC_PI_2;

use mbs_analysis::{Error, Search, Strategy, equilibrium};
use mbs_live::{Live, Text};
use mbs_runtime::equations::Differentiated;
use mbs_runtime::mechanism;

fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} and not {expected}");
}

fn from(q: &[f64]) -> Search {
    Search { from: Some(q.to_vec()), ..Search::default() }
}

mechanism! {
    /// A weight that a stiff bushing holds on the tip of a light flap, with a spring in its hinge.
    pub Bushing {
        dof = 3;
        param k = 10 [kN/m];
        param twist = 0 [N*m];
        gravity = (0, -9.81) [m/s^2];
        body flap (phi) { inertia = 0.05 [kg*m^2]; }
        body weight (x, y) { mass = 1.5 [kg]; }
        point tip on flap = (0.3 [m], 0);
        spring bushing (flap.tip, weight) { stiffness = k; damping = 10 [N*s/m]; length = 0; }
        torque hinge on flap = -twist*phi - 0.05 [N*m*s]*der(phi);
        start { phi = 0; x = 0.3 [m]; y = 0; }
    }
}

impl Bushing {
    fn with(k: f64, twist: f64) -> Differentiated<Self> {
        Differentiated(Self::new(BushingParameters { k, twist }).expect("valid parameters"))
    }
}

/// Where the bushing holds the weight, phi and y + 0.3 m sin phi: m g l cos φ = −c φ, and mg/k below the tip.
fn hung(k: f64, twist: f64) -> [f64; 2] {
    let (weight, l) = (1.5 * 9.81, 0.3);
    // from the start, the torque changes its sign once before the flap hangs
    let torque = |phi: f64| -weight * l * phi.cos() - twist * phi;
    let (mut low, mut high) = (-FRAC_PI_2, 0.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if torque(middle) < 0.0 { high = middle } else { low = middle }
    }
    [low, l * low.sin() - weight / k]
}

/// The way to rest leads along a circle, in a valley that is as steep as the bushing is stiff. Steps that are
/// only linear left it from 1e5 N/m on, and masses as unequal as these seemed to fall away. Accelerations are
/// rounded like k ε/m, and the angle, which gravity alone holds, like k l ε/(m g): the tolerance is 16 of that.
#[test]
fn a_stiff_bushing_is_followed_around_its_circle() {
    for (decade, twist) in (2..=12).flat_map(|decade| [(decade, 0.0), (decade, 2.0)]) {
        let k = f64::powi(10.0, decade);
        let [phi, y] = hung(k, twist);
        let tolerance = 1e-10 + 16.0 * k * 0.3 * f64::EPSILON / (1.5 * 9.81);
        for strategy in [Strategy::Relaxation, Strategy::Automatic] {
            let search = Search { strategy, ..Search::default() };
            let found = equilibrium(&Bushing::with(k, twist), &search).expect("it hangs");
            near(found.q[0], phi, tolerance);
            near(found.q[2], y, tolerance);
            assert!(found.is_stable(), "{k} {twist}: {:?}", found.stiffness);
            assert!(found.iterations < 25, "{k} {twist}: {} iterations", found.iterations);
        }
    }
}

/// A rest is not claimed where an acceleration is small beside what the stiffest spring gives: the flap stands
/// 0.1 rad from where it hangs, and accelerates.
#[test]
fn a_stiff_bushing_does_not_hide_that_its_flap_moves() {
    for k in [1e9, 1e11, 1e12] {
        let [phi, _] = hung(k, 2.0);
        let beside = phi + 0.1;
        let start = [beside, 0.3 * beside.cos(), 0.3 * beside.sin() - 1.5 * 9.81 / k];
        let tolerance = 1e-10 + 16.0 * k * 0.3 * f64::EPSILON / (1.5 * 9.81);
        for strategy in [Strategy::Newton, Strategy::Relaxation] {
            let search = Search { strategy, ..from(&start) };
            let found = equilibrium(&Bushing::with(k, 2.0), &search).expect("it hangs near by");
            near(found.q[0], phi, tolerance);
        }
        // differences know the soft direction while it is a billion times softer at most, and say so beyond
        match equilibrium(&Bushing::with(k, 2.0).0, &from(&start)) {
            Ok(found) if k < 1e10 => near(found.q[0], phi, tolerance),
            Err(Error::NoEquilibrium { coordinate: "phi", .. }) if k > 1e10 => {}
            other => panic!("{k}: {other:?}"),
        }
    }
}

/// A four-bar whose coupler and rocker are joined by a statement, 0.2 m apart before that is assembled.
fn four_bar(dof: usize, joint: &str, start: &str) -> Live {
    let declaration = format!(
        "Loop {{
            dof = {dof};
            gravity = (0, -9.81) [m/s^2];
            body crank (x1, y1, a1) {{ mass = 1 [kg]; inertia = 0.01 [kg*m^2]; }}
            body coupler (x2, y2, a2) {{ mass = 2 [kg]; inertia = 0.05 [kg*m^2]; }}
            body rocker (x3, y3, a3) {{ mass = 1.5 [kg]; inertia = 0.04 [kg*m^2]; }}
            point base on crank = (-0.1 [m], 0);
            point pin on crank = (0.1 [m], 0);
            point pin on coupler = (-0.25 [m], 0);
            point end on coupler = (0.25 [m], 0);
            point base on rocker = (-0.2 [m], 0);
            point end on rocker = (0.2 [m], 0);
            point post on ground = (0.5 [m], 0);
            revolute a (crank.base, ground);
            revolute b (crank.pin, coupler.pin);
            revolute c (rocker.base, ground.post);
            {joint}
            start {{
                a1 = 1; {start}
                guess x1 = 0.05 [m]; guess y1 = 0.08 [m]; guess x2 = 0.3 [m]; guess y2 = 0.2 [m];
                guess x3 = 0.55 [m]; guess y3 = 0.2 [m];
            }}
        }}"
    );
    Text::declaration("loop.mbs", declaration).compile().expect("it compiles")
}

/// A loop that is closed by a bushing hangs as one that is closed by a pin, but for what the bushing gives. The
/// bushing carries less than 30 N, and the shortest lever is 0.2 m: no angle differs by more than 30 N/(0.2 m k),
/// and by 1e-6 of rounding at 1e10 N/m.
#[test]
fn a_loop_with_a_stiff_bushing_hangs_as_one_with_a_pin() {
    let relaxed = Search { strategy: Strategy::Relaxation, ..Search::default() };
    let pin = "revolute d (coupler.end, rocker.end);";
    let pinned =
        equilibrium(&four_bar(1, pin, "guess a2 = 0.2; guess a3 = 1.2;"), &relaxed).expect("it hangs");
    assert!(pinned.is_stable());
    for k in [1e4, 1e6, 1e8, 1e10] {
        let bushing = format!(
            "spring d (coupler.end, rocker.end) {{ stiffness = {k} [N/m]; damping = 0; length = 0; }}"
        );
        let bushed = four_bar(3, &bushing, "a2 = 0.2; a3 = 1.2;");
        for strategy in [Strategy::Relaxation, Strategy::Automatic] {
            let search = Search { strategy, ..Search::default() };
            let found = equilibrium(&bushed, &search).expect("it hangs");
            assert!(found.is_stable(), "{k}: {:?}", found.stiffness);
            for angle in [2, 5, 8] {
                near(found.q[angle], pinned.q[angle], 150.0 / k + 1e-6);
            }
        }
    }
}

/// Level, nothing tells Newton's method which way it hangs, and it may stand; but there the flap does not fall
/// away, and so it is looked for where it hangs.
#[test]
fn a_flap_that_is_held_at_the_start_is_not_found_standing() {
    let flap = Bushing::with(100.0, 0.0);
    let standing = equilibrium(&flap, &Search { strategy: Strategy::Newton, ..Search::default() });
    assert!(standing.is_ok_and(|standing| !standing.is_stable()));
    assert!(equilibrium(&flap, &Search::default()).is_ok_and(|hanging| hanging.is_stable()));
}
