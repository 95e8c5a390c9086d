//! The generated Φ, Φ_q, Φ_t, Φ̇, γ and Eq. (8)'s right-hand side are those
//! derived by hand for the slider-crank (with the paper's slips put right), and
//! for mechanisms of every operator they are the derivatives that a scalar
//! which carries its own derivatives finds in Φ.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::{Components, State};
use models::slider_crank::{SliderCrank, SliderCrankCoordinates};
use models::slider_crank_free::{SliderCrankFree, SliderCrankFreeCoordinates};
use nalgebra::SVector;
use tests::by_hand::{self, Coordinates, DRIVER};
use tests::check_against_jets;
use tests::jet::{Jet, first, line};
use tests::operators::{Operators, OperatorsCoordinates};
use tests::random::Random;

const POINTS: usize = 1000;

/// Σ of a few terms of size 1 (or `scale`), each a product of up to five
/// rounded factors one of which is a sine good to an ulp: no more than 8
/// roundings a term and 3 terms.
const ROUNDING: f64 = 24.0 * f64::EPSILON;

fn assert_rows<const N: usize>(what: &str, ours: [f64; N], by_hand: &SVector<f64, N>, scale: f64) {
    let deviation = (SVector::from(ours) - by_hand).amax();
    assert!(deviation <= ROUNDING * scale, "{what}: {deviation:e} at scale {scale:e}\n{ours:?}\n{by_hand}");
}

#[test]
fn slider_crank_has_the_derivatives_of_a_person() {
    let hand = by_hand::SliderCrank::paper(1.0 / 12.0);
    let driven = SliderCrank::declared();
    let free = SliderCrankFree::declared();
    let none = mbs_runtime::NoComponents::default();
    let mut random = Random::new(5);
    for _ in 0..POINTS {
        let q = Coordinates::from(random.around_zero(3.0));
        let v = Coordinates::from(random.around_zero(30.0));
        let t = random.between(-1.0, 1.0);
        let of_driven = State {
            t,
            q: SliderCrankCoordinates::from_array(q.data.0[0]),
            v: SliderCrankCoordinates::from_array(v.data.0[0]),
        };
        let of_free = State {
            t,
            q: SliderCrankFreeCoordinates::from_array(q.data.0[0]),
            v: SliderCrankFreeCoordinates::from_array(v.data.0[0]),
        };
        // the largest term in each kind of row, ω t and l v² among them
        let positions = 3.0 + hand.omega * t.abs();
        let rates = 30.0 + hand.omega;
        let squares = 30.0 * 30.0 * (hand.l1 + hand.l2);
        let (alpha, beta) = (1500.0, 2000.0);
        let gains = by_hand::Gains { two_alpha: 2.0 * alpha, beta_squared: beta * beta };
        let rhs = hand.gamma(&q, &v) + hand.feedback(t, &q, &v, &gains);
        let of_rhs = squares + gains.two_alpha * rates + gains.beta_squared * positions;

        assert_rows("Φ", driven.phi(t, &of_driven.q).into_array(), &hand.phi(t, &q), positions);
        assert_rows("Φ_t", driven.phi_t(t, &of_driven.q).into_array(), &hand.phi_t(), hand.omega);
        assert_rows("Φ̇", driven.phi_dot(&of_driven).into_array(), &hand.phi_dot(&q, &v), rates);
        assert_rows("γ", driven.gamma(&of_driven).into_array(), &hand.gamma(&q, &v), squares);
        let ours = driven.baumgarte_rhs(&of_driven, alpha, beta).into_array();
        assert_rows("γ − 2αΦ̇ − β²Φ", ours, &rhs, of_rhs);
        let deviation = (driven.phi_q(t, &of_driven.q) - hand.phi_q(&q)).amax();
        assert!(deviation <= ROUNDING * hand.l2, "Φ_q: {deviation:e}");
        assert_rows("M", driven.mass(&of_driven.q).diagonal().data.0[0], &hand.mass(), 2.0);
        assert_rows("Q", driven.forces(&of_driven, &none).into_array(), &hand.forces(), 20.0);

        let without = |rows: &by_hand::Rows| rows.remove_row(DRIVER);
        assert_rows("Φ", free.phi(t, &of_free.q).into_array(), &without(&hand.phi(t, &q)), positions);
        assert_rows("γ", free.gamma(&of_free).into_array(), &without(&hand.gamma(&q, &v)), squares);
        let ours = free.baumgarte_rhs(&of_free, alpha, beta).into_array();
        assert_rows("γ − 2αΦ̇ − β²Φ", ours, &without(&rhs), of_rhs);
        let deviation = (free.phi_q(t, &of_free.q) - hand.phi_q(&q).remove_row(DRIVER)).amax();
        assert!(deviation <= ROUNDING * hand.l2, "Φ_q: {deviation:e}");
    }
}

/// Generated code, run with jets.
macro_rules! differentiate_itself {
    ($mechanism:ident, $coordinates:ident, $position:expr, $rate:expr, $tolerance:expr) => {{
        let carrying = $mechanism::<Jet>::default();
        let phi = |t, q| carrying.phi(t, &$coordinates::from_array(q)).into_array();
        check_against_jets!($mechanism, $coordinates, phi, $position, $rate, $tolerance);
    }};
}

/// Rows of three terms of up to five factors, each below the scale, evaluated
/// in two different ways: no more than 16 ε apart.
#[test]
fn slider_crank_agrees_with_jets() {
    differentiate_itself!(SliderCrank, SliderCrankCoordinates, 3.0, 30.0, 16.0 * f64::EPSILON);
    differentiate_itself!(SliderCrankFree, SliderCrankFreeCoordinates, 3.0, 30.0, 16.0 * f64::EPSILON);
}

/// Nine functions in a row with derivatives of order 1, some ten operations
/// each, evaluated in two different ways: 100 ε.
#[test]
fn every_operator_agrees_with_jets() {
    differentiate_itself!(Operators, OperatorsCoordinates, 1.5, 3.0, 100.0 * f64::EPSILON);
}

/// Complex numbers are not needed: central differences, good to ε^(2/3), bind
/// the jets themselves to plain evaluations of Φ.
#[test]
fn jets_agree_with_differences() {
    let plain = Operators::<f64>::default();
    let carrying = Operators::<Jet>::default();
    // truncation h²/6·Φ‴ and rounding ε/h balance at h = ε^(1/3); third
    // derivatives stay below 1000 here
    let h = f64::EPSILON.cbrt();
    let mut random = Random::new(7);
    for _ in 0..POINTS {
        let (q, v): ([f64; 3], [f64; 3]) = (random.around_zero(1.5), random.around_zero(1.0));
        let t = random.between(0.0, 1.0);
        let phi = |s: f64| {
            let q = OperatorsCoordinates::from_array(std::array::from_fn(|i| q[i] + s * v[i]));
            plain.phi(t + s, &q).into_array()
        };
        let q = OperatorsCoordinates::from_array(std::array::from_fn(|i| line(q[i], v[i])));
        let jets = carrying.phi(line(t, 1.0), &q).into_array();
        let (before, after) = (phi(-h), phi(h));
        for row in 0..jets.len() {
            let slope = (after[row] - before[row]) / (2.0 * h);
            assert!((slope - first(jets[row])).abs() < 1000.0 * h * h, "{slope} {:?}", jets[row]);
        }
    }
}
