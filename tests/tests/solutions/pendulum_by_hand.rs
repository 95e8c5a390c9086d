//! The N-pendulum written by hand and the generated one do the same step.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::{Baumgarte, Components, Held, Mechanism, Simulation, mechanism};
use tests::pendulum::{Links, Pendulum};

const H: f64 = 1e-3;

tests::pendulum!(mechanism; One 1);
tests::pendulum!(mechanism; Twelve 12);

/// Both start every step from the generated one's state.
///
/// They round differently: positions of size N l to ε N l, which comes back as
/// β²Φ = Φ/h², and over a step as ε N l/h in velocities. The constraints hand it
/// on enlarged by at most the reciprocal of the smallest singular value of
/// Φ_q M^−½, which is that of N equal masses on a straight string, 2 sin(π/(4N + 2)).
/// With eight roundings in each row of Φ, and 2N rows, that is what is allowed.
fn steps_agree<M: Mechanism<Real = f64>, const N: usize>() {
    let best = Baumgarte::<Held>::deadbeat(H);
    let by_hand = Pendulum::new(1.0, 1.0, best.alpha(), best.beta());
    let n = N as f64;
    let enlarged = 0.5 / (std::f64::consts::PI / (4.0 * n + 2.0)).sin();
    let tolerance = 8.0 * (2.0 * n).sqrt() * enlarged * f64::EPSILON * n / H;

    let mechanism = M::new(M::Parameters::default()).expect("declared values are valid");
    let mut generated = Simulation::new(mechanism, H).expect("the start is consistent");
    let links = |vector: M::Coordinates| Links::<N>::from_coordinates(vector.into_array().as_ref());
    let mut worst: f64 = 0.0;
    for _ in 0..500 {
        let (mut q, mut v) = (links(generated.state().q), links(generated.state().v));
        by_hand.step(&mut q, &mut v, H);
        generated.step().expect("no step ends in a singular position");
        let (q_there, v_there) = (links(generated.state().q), links(generated.state().v));
        worst = worst.max(q.distance(&q_there) / H).max(v.distance(&v_there));
    }
    let turned = links(generated.state().q).theta[0] + 0.6;
    assert!(turned.abs() > 0.1, "it has moved");
    assert!(worst < tolerance, "{worst:.1e} is over {tolerance:.1e}");
}

#[test]
fn one_link() {
    steps_agree::<One, 1>();
}

#[test]
fn twelve_links() {
    steps_agree::<Twelve, 12>();
}
