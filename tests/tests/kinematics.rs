//! Kinematic analysis of the driven slider-crank is the closed form over two
//! turns: θ2 = −asin(l1/l2 sin θ1) and its time derivatives.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::{Components, Error, Kinematics};
use models::slider_crank::SliderCrank;
use models::slider_crank_free::SliderCrankFree;
use tests::by_hand;

#[test]
fn kinematics_is_the_closed_form() {
    let hand = by_hand::SliderCrank::paper(1.0 / 12.0);
    let (l1, l2, w) = (hand.l1, hand.l2, hand.omega);
    let mut kinematics = Kinematics::new(SliderCrank::declared()).expect("fully driven");
    for k in 0..=1200 {
        let t = f64::from(k) * 0.5e-3;
        let motion = kinematics.at(t).expect("a regular position");
        let theta1 = w * t;
        let (s1, c1) = theta1.sin_cos();
        let theta2 = (-l1 / l2 * s1).asin();
        let (s2, c2) = theta2.sin_cos();
        // l2 sin θ2 = −l1 sin θ1 differentiated twice
        let w2 = -l1 * c1 * w / (l2 * c2);
        let a2 = (l1 * s1 * w * w + l2 * s2 * w2 * w2) / (l2 * c2);
        let q = [
            l1 / 2.0 * c1,
            l1 / 2.0 * s1,
            theta1,
            l1 * c1 + l2 / 2.0 * c2,
            l1 * s1 + l2 / 2.0 * s2,
            theta2,
            l1 * c1 + l2 * c2,
        ];
        let v = [
            -l1 / 2.0 * s1 * w,
            l1 / 2.0 * c1 * w,
            w,
            -l1 * s1 * w - l2 / 2.0 * s2 * w2,
            l1 * c1 * w + l2 / 2.0 * c2 * w2,
            w2,
            -l1 * s1 * w - l2 * s2 * w2,
        ];
        let a = [
            -l1 / 2.0 * c1 * w * w,
            -l1 / 2.0 * s1 * w * w,
            0.0,
            -l1 * c1 * w * w - l2 / 2.0 * (c2 * w2 * w2 + s2 * a2),
            -l1 * s1 * w * w + l2 / 2.0 * (-s2 * w2 * w2 + c2 * a2),
            a2,
            -l1 * c1 * w * w - l2 * (c2 * w2 * w2 + s2 * a2),
        ];
        // θ1 up to 4π has an ulp of 8 ε, which everything else inherits; rates
        // scale with ω and its square, and γ doubles an error of θ̇
        let ulp = 8.0 * f64::EPSILON;
        for (what, ours, closed, tolerance) in [
            ("q", motion.state.q.into_array(), q, 4.0 * ulp),
            ("v", motion.state.v.into_array(), v, 4.0 * ulp * w),
            ("a", motion.acceleration.into_array(), a, 8.0 * ulp * w * w),
        ] {
            for (at, (ours, closed)) in ours.into_iter().zip(closed).enumerate() {
                let deviation = (ours - closed).abs();
                assert!(deviation <= tolerance, "{what}[{at}] at {t}: {deviation:e} > {tolerance:e}");
            }
        }
    }
}

#[test]
fn kinematics_wants_drives() {
    assert_eq!(Kinematics::new(SliderCrankFree::declared()).expect_err("free"), Error::NotDriven { dof: 1 });
}
