//! The emitted accelerations and multipliers are those of a dense LU of
//! Eq. (8) built from the paper's formulas by hand, at random states on and
//! off the constraints, with slender rods, the paper's inertias and point
//! masses, driven and free; and so is the elimination by hand that the
//! benchmark compares with.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::{Components, Gains, Mechanism, NoComponents, State};
use models::slider_crank::{SliderCrank, SliderCrankCoordinates, SliderCrankParameters};
use models::slider_crank_free::{
    SliderCrankFree, SliderCrankFreeCoordinates, SliderCrankFreeInputs, SliderCrankFreeParameters,
};
use nalgebra::SVector;
use tests::by_hand::{self, Coordinates};
use tests::random::Random;

/// The acceptance limit. Both solutions come from backward-stable
/// eliminations; the condition of the system (rows scaled) is below 1e3 for
/// |θ2| ≤ 1.2, so each is good to about 14·1e3·ε = 2e-12 in the worst case and
/// a few hundred ε in all but rare ones.
const TOLERANCE: f64 = 1e-12;

const STATES: usize = 1000;

/// Largest deviation over the largest component.
fn deviation<const N: usize>(ours: [f64; N], dense: &SVector<f64, N>) -> f64 {
    (SVector::from(ours) - dense).amax() / dense.amax()
}

/// Time, positions and velocities of an arbitrary state; the rod within
/// ±1.2 rad of the axis, twice as far as it gets when assembled.
fn random_state(random: &mut Random) -> (f64, Coordinates, Coordinates) {
    let mut q = Coordinates::from(random.around_zero(0.3));
    q[2] = random.between(-3.2, 3.2);
    q[5] = random.between(-1.2, 1.2);
    let mut v = Coordinates::from(random.around_zero(2.0));
    v[2] = random.between(-30.0, 30.0);
    v[5] = random.between(-15.0, 15.0);
    (random.between(0.0, 0.3), q, v)
}

fn parameters(inertia_factor: f64) -> SliderCrankParameters {
    SliderCrankParameters { inertia_factor, ..Default::default() }
}

/// Deviations of (accelerations, multipliers, feedback) of the driven one.
fn compare_driven(inertia_factor: f64, t: f64, q: &Coordinates, v: &Coordinates) -> [f64; 3] {
    let hand = by_hand::SliderCrank::paper(inertia_factor);
    let gains = by_hand::Gains { two_alpha: 4000.0, beta_squared: 4e6 };
    let feedback = hand.feedback(t, q, v, &gains);
    let dense = hand.solve_driven(q, v, &feedback).expect("a regular position");

    let mechanism = SliderCrank::new(parameters(inertia_factor)).expect("valid parameters");
    let at = State {
        t,
        q: SliderCrankCoordinates::from_array(q.data.0[0]),
        v: SliderCrankCoordinates::from_array(v.data.0[0]),
    };
    let none = NoComponents::default();
    let both = Gains { minus_two_alpha: -gains.two_alpha, minus_beta_squared: -gains.beta_squared };
    let stabilized = mechanism.stabilized(&at, &none, &both);
    let reactions = mechanism.reactions(&at, &none, &stabilized.feedback);
    let constrained = mechanism.constrained(&at, &none, &stabilized.feedback);

    let of_stabilized = deviation(stabilized.acceleration.into_array(), &dense.acceleration);
    let of_reactions = deviation(reactions.acceleration.into_array(), &dense.acceleration);
    let of_constrained = deviation(constrained.acceleration.into_array(), &dense.acceleration);
    [
        of_stabilized.max(of_reactions).max(of_constrained),
        deviation(reactions.multipliers.into_array(), &dense.multipliers),
        deviation(stabilized.feedback.into_array(), &feedback),
    ]
}

fn compare_free(inertia_factor: f64, torque: f64, q: &Coordinates, v: &Coordinates) -> [f64; 3] {
    let hand = by_hand::SliderCrank { torque, ..by_hand::SliderCrank::paper(inertia_factor) };
    let gains = by_hand::Gains { two_alpha: 4000.0, beta_squared: 4e6 };
    let feedback = hand.feedback(0.0, q, v, &gains);
    let dense = hand.solve_free(q, v, &feedback).expect("a regular position");

    let parameters = SliderCrankFreeParameters { inertia_factor, ..Default::default() };
    let mechanism = SliderCrankFree::new(parameters).expect("valid parameters");
    let coordinates = |x: &Coordinates| SliderCrankFreeCoordinates::from_array(x.data.0[0]);
    let at = State { t: 0.0, q: coordinates(q), v: coordinates(v) };
    let inputs = SliderCrankFreeInputs { crank_torque: torque };
    let both = Gains { minus_two_alpha: -gains.two_alpha, minus_beta_squared: -gains.beta_squared };
    let stabilized = mechanism.stabilized(&at, &inputs, &both);
    let reactions = mechanism.reactions(&at, &inputs, &stabilized.feedback);
    let constrained = mechanism.constrained(&at, &inputs, &stabilized.feedback);

    let of_stabilized = deviation(stabilized.acceleration.into_array(), &dense.acceleration);
    let of_reactions = deviation(reactions.acceleration.into_array(), &dense.acceleration);
    let of_constrained = deviation(constrained.acceleration.into_array(), &dense.acceleration);
    [
        of_stabilized.max(of_reactions).max(of_constrained),
        deviation(reactions.multipliers.into_array(), &dense.multipliers.remove_row(by_hand::DRIVER)),
        deviation(stabilized.feedback.into_array(), &feedback.remove_row(by_hand::DRIVER)),
    ]
}

fn worst(deviations: impl Iterator<Item = [f64; 3]>) -> [f64; 3] {
    deviations.fold([0.0; 3], |worst, d| std::array::from_fn(|i| worst[i].max(d[i])))
}

fn assert_close(what: &str, worst: [f64; 3]) {
    println!(
        "{what}: accelerations {:.1e}, multipliers {:.1e}, feedback {:.1e}",
        worst[0], worst[1], worst[2]
    );
    assert!(worst.iter().all(|d| *d <= TOLERANCE), "{what}: {worst:?}");
}

#[test]
fn driven_slider_crank_agrees_with_a_dense_lu() {
    for inertia_factor in [1.0 / 12.0, 1.0 / 3.0, 0.0] {
        let mut random = Random::new(1);
        let deviations = (0..STATES).map(|_| {
            let (t, q, v) = random_state(&mut random);
            compare_driven(inertia_factor, t, &q, &v)
        });
        assert_close(&format!("driven, J = {inertia_factor:.3} m l²"), worst(deviations));
    }
}

#[test]
fn free_slider_crank_agrees_with_a_dense_lu() {
    for inertia_factor in [1.0 / 12.0, 1.0 / 3.0, 0.0] {
        let mut random = Random::new(2);
        let deviations = (0..STATES).map(|_| {
            let (_, q, v) = random_state(&mut random);
            compare_free(inertia_factor, random.between(-2.0, 2.0), &q, &v)
        });
        assert_close(&format!("free, J = {inertia_factor:.3} m l²"), worst(deviations));
    }
}

/// The positions where one of the crank's own sines or cosines vanishes, both
/// dead centres among them: an elimination that divides by one gives NaN here.
#[test]
fn special_crank_angles_are_regular() {
    use std::f64::consts::{FRAC_PI_2, PI};
    let mut random = Random::new(3);
    for inertia_factor in [1.0 / 12.0, 0.0] {
        for theta1 in [0.0, FRAC_PI_2, -FRAC_PI_2, PI, -PI] {
            let hand = by_hand::SliderCrank::paper(inertia_factor);
            let theta2 = (-hand.l1 / hand.l2 * theta1.sin()).asin();
            let (t, mut q, v) = random_state(&mut random);
            (q[2], q[5]) = (theta1, theta2);
            let what = format!("θ1 = {theta1:.2}, J = {inertia_factor:.3} m l²");
            assert_close(&what, compare_driven(inertia_factor, t, &q, &v));
            assert_close(&what, compare_free(inertia_factor, 0.5, &q, &v));
        }
    }
}

#[test]
fn elimination_by_hand_agrees_with_a_dense_lu() {
    let gains = by_hand::Gains { two_alpha: 4000.0, beta_squared: 4e6 };
    let hand = by_hand::SliderCrank { torque: 0.5, ..by_hand::SliderCrank::paper(1.0 / 12.0) };
    let mut random = Random::new(4);
    let deviations = (0..STATES).map(|_| {
        let (t, q, v) = random_state(&mut random);
        let (q0, v0) = (&q.data.0[0], &v.data.0[0]);
        let driven = hand.solve_driven(&q, &v, &hand.feedback(t, &q, &v, &gains)).expect("regular");
        let free = hand.solve_free(&q, &v, &hand.feedback(t, &q, &v, &gains)).expect("regular");
        let (a, _) = hand.accelerations_driven(q0, v0, t, &gains);
        let (b, _) = hand.accelerations_free(q0, v0, &gains);
        [
            deviation(a, &driven.acceleration),
            deviation(b, &free.acceleration),
            deviation(hand.multipliers_driven(q0, &a), &driven.multipliers),
        ]
    });
    assert_close("by hand (driven, free, multipliers of the driven)", worst(deviations));
}
