//! Equilibria, linear systems and modes with states of a mechanism's own.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_analysis::{Equilibrium, Error, OperatingPoint, Ports, Search, Stability, equilibrium, linearize};
use mbs_live::{Live, Text};

fn live(text: &str) -> Live {
    Text::declaration("states.mbs", text).compile().expect("a mechanism")
}

fn rest(text: &str, inputs: &[f64]) -> Result<Equilibrium, Error> {
    equilibrium(&live(text), &Search { inputs: Some(inputs.to_vec()), ..Search::default() })
}

const LORENZ: &str = "Lorenz { dof = 0; const s = 1 [1/s];
    state x [1] = 7; state y [1] = 7; state z [1] = 30;
    der(x) = 10*s*(y - x); der(y) = s*(x*(28 - z) - y); der(z) = s*(x*y - 8/3*z); }";

/// E. N. Lorenz's convection rests at x = y = ±√(β(ρ − 1)), z = ρ − 1, on both sides unstable for ρ = 28, and at 0.
#[test]
fn a_search_begins_at_the_declared_start() {
    let found = rest(LORENZ, &[]).expect("a rest");
    let size = 72_f64.sqrt();
    for (found, expected) in found.q.iter().zip([size, size, 27.0]) {
        assert!((found - expected).abs() < 1e-12 * expected, "{found} {expected}");
    }
    assert_eq!(found.stability(), Stability::Unstable { directions: 2 });
    let (lorenz, info) = (live(LORENZ), live(LORENZ).declared_info());
    let point = OperatingPoint::resting(info, 0.0, &[1.0, 1.0, 1.0], &[]);
    let linear = linearize(&lorenz, &point, &Ports::default()).expect("a linear system");
    let second: Vec<f64> = linear.a.row(1).iter().copied().collect();
    assert_eq!(second, [27.0, -1.0, -1.0]);
    // without declared outputs they are the states
    assert_eq!(linear.outputs.iter().map(|y| y.name.as_str()).collect::<Vec<_>>(), ["x", "y", "z"]);
}

/// Regression: a temperature whose rate is 0 came out as 0 K, or off by what made the correction shortest.
#[test]
fn what_no_motion_changes_stays() {
    let found = rest(
        "Hot { dof = 1; body b (x) { mass = 1 [kg]; } state heat [K] = 300 [K]; der(heat) = 0;
            force f on x = -100 [N/m]*(x - 1e-3 [m/K]*heat) - 1 [N*s/m]*der(x); }",
        &[],
    )
    .expect("a rest");
    assert!((found.q[0] - 0.3).abs() < 1e-13 && (found.q[1] - 300.0).abs() < 1e-10, "{:?}", found.q);
    assert_eq!(found.stability(), Stability::Indifferent);
    // two tanks that exchange what they hold, of which nothing is lost
    let found = rest(
        "Tanks { dof = 0; state a [L] = 5 [L]; state b [L] = 1 [L]; const k = 2 [1/s];
            der(a) = k*(b - 2*a); der(b) = k*(2*a - b); }",
        &[],
    )
    .expect("a rest");
    assert!((found.q[0] - 2e-3).abs() < 1e-15 && (found.q[1] - 4e-3).abs() < 1e-15, "{:?}", found.q);
}

/// Regression: where nothing brings a state to rest, it grew until its rate was small beside it, and rested there.
#[test]
fn a_rate_that_nothing_changes_has_no_rest() {
    let cases: [(&str, &[f64], &str); 2] = [
        ("Coil { dof = 0; input u [V]; state z [Wb] = 2 [Wb]; der(z) = u; }", &[1.0], "z"),
        (
            "Clock { dof = 1; body b (x) { mass = 1 [kg]; } state z [1]; der(z) = 1e-3 [1/s];
                force f on x = -100 [N/m]*(x - 1 [m]) - 1 [N*s/m]*der(x); }",
            &[],
            "z",
        ),
    ];
    for (text, inputs, name) in cases {
        let error = rest(text, inputs).expect_err("no rest");
        assert!(matches!(error, Error::NoRest { state, .. } if state == name), "{error}");
    }
    // what it wears is not 0 where the spring is at rest, and elsewhere the body moves
    let wear = "Wear { dof = 1; body b (x) { mass = 1 [kg]; } state worn [N*s]; der(worn) = 3 [N/m]*x;
        force f on x = -100 [N/m]*(x - 1 [m]) - 1 [N*s/m]*der(x); }";
    let error = rest(wear, &[]).expect_err("no rest");
    assert!(matches!(error, Error::NoRest { .. } | Error::NoEquilibrium { .. }), "{error}");
    // at rest it is where it starts, and a large value is found from a small one
    assert_eq!(rest(cases[0].0, &[0.0]).expect("a rest").q, [2.0]);
    let oil = "Oil { dof = 0; state p [Pa]; der(p) = 1e7 [Pa/s] - 0.5 [1/s]*p; }";
    assert!((rest(oil, &[]).expect("a rest").q[0] - 2e7).abs() < 1e-5);
}

/// A controller holds what falls without it, and a state makes unstable what a spring holds.
#[test]
fn stability_is_that_with_states() {
    let held = "Held { dof = 1; body b (x) { mass = 1 [kg]; } state z [m]; der(z) = -20 [1/s]*(z - x);
        force f on x = 50 [N/m]*x - 400 [N/m]*(2*x - z) - 40 [N*s/m]*der(x); }";
    let found = rest(held, &[]).expect("a rest");
    assert!(found.is_stable(), "{:?}", found.rates);
    let lost = "Lost { dof = 1; body b (x) { mass = 1 [kg]; } state z [1] = 0; der(z) = 2 [1/s]*z;
        force f on x = -100 [N/m]*x - 1 [N*s/m]*der(x); }";
    let found = rest(lost, &[]).expect("a rest");
    assert_eq!(found.stability(), Stability::Unstable { directions: 1 });
    assert!(found.stiffness[0] > 0.0);
}

/// Regression: several states that nothing moves had one shape, twice.
#[test]
fn equal_modes_have_shapes_of_their_own() {
    let text = "Neutral { dof = 0; state a [1]; state b [1]; state c [1] = 1;
        der(a) = 0; der(b) = 0; der(c) = -1 [1/s]*c; }";
    let point = OperatingPoint::resting(live(text).declared_info(), 0.0, &[0.0; 3], &[]);
    let linear = linearize(&live(text), &point, &Ports::default()).expect("a linear system");
    let modes = linear.modes().expect("modes");
    let shape = |at: usize| modes[at].shape.iter().map(|x| x.re).collect::<Vec<f64>>();
    let (first, second) = (shape(0), shape(1));
    let across = first[0] * second[1] - first[1] * second[0];
    assert!(across.abs() > 0.5, "{first:?} {second:?}");
    assert!((modes[2].eigenvalue.re + 1.0).abs() < 1e-12);
    // integrals are no outputs of a linear system
    let asked = Ports { outputs: Some(vec!["integral(a)".to_owned()]), ..Ports::default() };
    assert!(matches!(linearize(&live(text), &point, &asked), Err(Error::Unknown { .. })));
}

/// Regression: of three eigenvalues 0, with a position and two states that nothing brings back, two had the same shape.
#[test]
fn equal_eigenvalues_have_shapes_of_their_own() {
    let live = live(
        "Free { dof = 1; body b (x) { mass = 1 [kg]; } force d on x = -3 [N*s/m]*der(x);
            state w [J]; der(w) = 1 [W]*der(x)/(1 [m/s]); state z [1]; der(z) = 0; }",
    );
    let point = OperatingPoint::resting(live.declared_info(), 0.0, &[0.0; 3], &[]);
    let linear = linearize(&live, &point, &Ports::default()).expect("a linear system");
    let modes = linear.modes().expect("modes");
    let free: Vec<_> = modes.iter().filter(|mode| mode.eigenvalue.norm() == 0.0).collect();
    assert_eq!(free.len(), 3);
    for at in 0..3 {
        let moves = |mode: &&&mbs_analysis::Mode| mode.shape[at].norm() > 0.0;
        assert_eq!(free.iter().filter(moves).count(), 1, "{at}");
    }
}
