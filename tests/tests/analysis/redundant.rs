//! Constraints that repeat others: where those that a run solves for come to depend on each other, all
//! together still hold the mechanism, and statements about positions are made with all of them.
#![allow(clippy::expect_used, reason = "a test says by panicking what is wrong")]

use std::f64::consts::PI;

use mbs_analysis::{Curve, Prescription, inverse};
use mbs_runtime::mechanism;

mechanism! {
    /// A plate on three parallel cranks. The third pivot is not in line with the others, so no position is
    /// singular, but two of the cranks alone are in line twice in a turn.
    pub Plate {
        dof = 1;
        redundant = minimum_norm;
        body plate (x, y, theta) { mass = 2 [kg]; inertia = 0.1 [kg*m^2]; }
        body q1 (angle = f1) { inertia = 0.01 [kg*m^2]; }
        body q2 (x2, y2, f2) { mass = 0.2 [kg]; inertia = 0.01 [kg*m^2]; }
        body q3 (x3, y3, f3) { mass = 0.2 [kg]; inertia = 0.01 [kg*m^2]; }
        point tip on q1 = (0.3, 0) [m];
        point base on q2 = (-0.15, 0) [m];  point tip on q2 = (0.15, 0) [m];
        point base on q3 = (-0.15, 0) [m];  point tip on q3 = (0.15, 0) [m];
        point g2 on ground = (0.8, 0) [m];  point g3 on ground = (0.3, 0.5) [m];
        point h1 on plate = (0, 0);  point h2 on plate = (0.8, 0) [m];  point h3 on plate = (0.3, 0.5) [m];
        revolute a1 (q1.tip, plate.h1);
        revolute b2 (q2.base, ground.g2);
        revolute b3 (q3.base, ground.g3);
        revolute a3 (q3.tip, plate.h3);
        revolute a2 (q2.tip, plate.h2);
        start { f1 = 40 [deg]; guess theta = 0; guess f2 = 40 [deg]; guess f3 = 40 [deg]; }
    }
}

/// The motion of `three_cranks` ended at 59.04°, where the chosen rows depend on each other.
#[test]
fn a_whole_turn_of_three_cranks_takes_what_their_inertia_does() {
    let turn = Curve::rest_to_rest(40_f64.to_radians(), 400_f64.to_radians(), 0.0, 3.0).expect("a curve");
    let request = Prescription { curves: vec![("f1".into(), turn)], ..Prescription::default() };
    let times: Vec<f64> = (0..=300).map(|k| f64::from(k) * 0.01).collect();
    let found = inverse(&Plate::declared(), &request, &times).expect("the whole turn");
    // the plate goes along a circle without turning, the cranks turn about their pivots
    let inertia = 2.0 * 0.3_f64.powi(2) + 3.0 * 0.01 + 2.0 * 0.2 * 0.15_f64.powi(2);
    for (instant, t) in found.iter().zip(times) {
        let s = t / 3.0;
        let acceleration = 2.0 * PI / 9.0 * (60.0 * s - 180.0 * s.powi(2) + 120.0 * s.powi(3));
        // the chosen rows are nearly dependent at some samples, where seven digits of sixteen are lost
        let difference = instant.efforts[0] - inertia * acceleration;
        assert!(difference.abs() < 1e-9, "{t} s: {} N·m, {difference:e} off", instant.efforts[0]);
    }
}
