//! Kinematic analysis of the driven slider-crank is the closed form over two
//! turns: θ2 = −asin(l1/l2 sin θ1) and its time derivatives. It stays on its branch over any
//! distance, ends where a mechanism cannot be closed, and gives reactions and outputs.
#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

use mbs_runtime::{Components, Error, Kinematics, Simulation};
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

/// A hundred turns away at once, and back: the rod stays on its side.
#[test]
fn far_instants_are_on_the_same_branch() {
    let mut kinematics = Kinematics::new(SliderCrank::declared()).expect("fully driven");
    let turn = core::f64::consts::TAU / SliderCrank::<f64>::declared().parameters().omega;
    for t in [0.1 * turn, 100.1 * turn, 0.1 * turn] {
        let motion = kinematics.at(t).expect("a regular position");
        let (sin, cos) = (0.2 * core::f64::consts::PI).sin_cos();
        let x3 = 0.06 * cos + (0.18 * 0.18 - 0.06 * sin * 0.06 * sin).sqrt();
        // 630 rad have an ulp of 1e-13
        assert!((motion.state.q.x3 - x3).abs() < 1e-13);
    }
}

/// Outputs and reactions of a position are those of a run.
#[test]
fn reactions_and_outputs() {
    let mut kinematics = Kinematics::new(SliderCrank::declared()).expect("fully driven");
    let run = Simulation::new(SliderCrank::declared(), 1e-4).expect("it starts");
    let motion = kinematics.at(0.0).expect("a regular position");
    let none = Default::default();
    let outputs = kinematics.outputs(&motion, &none).expect("defined");
    let expected = run.outputs().expect("defined");
    assert!((outputs.drive_torque - expected.drive_torque).abs() < 1e-12);
    let reactions = kinematics.reactions(&motion, &none).expect("regular");
    let of_run = run.reactions().expect("regular").multipliers.into_array();
    for (x, y) in reactions.multipliers.into_array().iter().zip(of_run.iter()) {
        assert!((x - y).abs() < 1e-10);
    }
}

mbs_runtime::mechanism! {
    /// A rod that is pulled out of a bearing that is too near.
    pub Pulled {
        dof = 0;
        body end (x, y) { mass = 1 [kg]; }
        distance rod (end, ground) = 0.5 [m];
        drive pull: x = 0.3 [m] + 0.1 [m/s]*t;
        start { guess x = 0.3 [m]; guess y = 0.4 [m]; }
    }
}

/// x = l after 2 s, where y is 0: nothing is beyond, and the error says when that is.
#[test]
fn a_motion_ends_where_it_cannot_be_followed() {
    let mut kinematics = Kinematics::new(Pulled::declared()).expect("fully driven");
    assert!((kinematics.at(1.0).expect("within reach").state.q.y - 0.3).abs() < 1e-14);
    let error = kinematics.at(5.0).expect_err("out of reach");
    let t = match error {
        Error::NotAssembled { t, .. } | Error::Singular { t, .. } => t,
        other => panic!("{other}"),
    };
    assert!((t - 2.0).abs() < 1e-5, "{error}");
    // and from the last good instant it can go elsewhere
    assert!((kinematics.at(0.0).expect("within reach").state.q.y - 0.4).abs() < 1e-13);
    assert!(matches!(kinematics.at(f64::NAN), Err(Error::Time { .. })));
}
