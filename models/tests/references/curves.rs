//! Linkages that draw: lines, nearly lines, an ellipse, an enlarged figure.

use std::f64::consts::{PI, TAU};

use mbs_runtime::NoComponents;
use models::{
    Chebyshev, HartInversor, HartInversorParameters, Pantograph, PantographParameters, Peaucellier,
    TrammelOfArchimedes, WattLinkage,
};

use super::{EXACT, along, near};

#[test]
fn peaucellier_goes_straight() {
    let mechanism = Peaucellier::declared();
    let p = *mechanism.parameters();
    let line = (p.long * p.long - p.side * p.side) / (2.0 * p.radius);
    along(mechanism, NoComponents::default(), TAU / p.omega, 200, |at| {
        let q = at.motion.state.q;
        near("x", q.xp, line, EXACT);
        near("y", q.yp, line * (q.alpha / 2.0).tan(), EXACT);
        near("deviation", at.outputs.deviation, 0.0, EXACT);
    });
}

/// At other shares of the bars too.
#[test]
fn hart_goes_straight() {
    for share in [0.5, 0.45] {
        let mechanism = HartInversor::new(HartInversorParameters { share, ..Default::default() }).unwrap();
        let p = *mechanism.parameters();
        let line = -share * (1.0 - share) * (p.long * p.long - p.short * p.short) / (2.0 * p.radius);
        let mut highest = 0.0_f64;
        along(mechanism, NoComponents::default(), TAU / p.omega, 200, |at| {
            near("x", at.outputs.q_x, line, EXACT);
            near("y", at.outputs.q_y, line * (at.motion.state.q.alpha / 2.0).tan(), EXACT);
            highest = highest.max(at.outputs.q_y);
        });
        near("half the stroke", highest, -line * (p.amplitude / 2.0).tan(), EXACT);
    }
}

#[test]
fn chebyshev_follows_its_closed_form() {
    let mechanism = Chebyshev::declared();
    let p = *mechanism.parameters();
    let a = p.crank_length;
    along(mechanism, NoComponents::default(), TAU / p.omega, 360, |at| {
        let (sin, cos) = (p.omega * at.t).sin_cos();
        let w = ((20.0 + 4.0 * cos) / (5.0 - 4.0 * cos)).sqrt();
        near("x", at.outputs.p_x, a * (2.0 + w * sin), EXACT);
        near("y", at.outputs.p_y, a * w * (2.0 - cos), EXACT);
    });
}

/// Exact at the quarter turns about 180°, worst at cos θ = −5/8 in between.
#[test]
fn chebyshev_deviation_is_the_known_one() {
    let mechanism = Chebyshev::declared();
    let p = *mechanism.parameters();
    let a = p.crank_length;
    let worst = (21.0 / 8.0 * (7.0_f64 / 3.0).sqrt() - 4.0) * a;
    let mut seen = Vec::new();
    along(mechanism, NoComponents::default(), 1.5 * PI / p.omega, 3000, |at| {
        if p.omega * at.t > 0.5 * PI - 1e-9 {
            seen.push((at.outputs.p_x, at.outputs.deviation));
        }
    });
    let last = seen.len() - 1;
    near("one end", seen[0].1, 0.0, EXACT);
    near("middle", seen[last / 2].1, 0.0, EXACT);
    near("other end", seen[last].1, 0.0, EXACT);
    near("stroke", seen[0].0 - seen[last].0, 4.0 * a, EXACT);
    let largest = seen.iter().fold(0.0, |largest, (_, d)| f64::max(largest, *d));
    // the maximum lies within half a step of a sample, 8e-4 rad, and is flat
    near("largest deviation", largest, worst, 1e-6 * a);
    assert!(seen.iter().all(|(_, d)| *d > -EXACT && *d < worst + EXACT));
}

/// Watt's curve without its root:
/// (arm² − r² − half² + c² (cos² θ − sin² θ))² = 4 c² sin² θ (half² − c² cos² θ).
#[test]
fn watt_follows_his_curve() {
    let mechanism = WattLinkage::declared();
    let p = *mechanism.parameters();
    let c = p.arm.hypot(p.half);
    let mut largest = [0.0_f64; 2];
    along(mechanism, NoComponents::default(), TAU / p.omega, 400, |at| {
        let (x, y) = (at.motion.state.q.x2, at.motion.state.q.y2);
        if at.t == 0.0 {
            near("x at rest", x, 0.0, EXACT);
            near("y at rest", y, 0.0, EXACT);
        }
        let r = x.hypot(y);
        if r > 1e-3 {
            // the angle from C1–C2, which falls by `half` on `arm`
            let (cos, sin) = ((x * p.arm - y * p.half) / (c * r), (x * p.half + y * p.arm) / (c * r));
            let left = p.arm.powi(2) - r * r - p.half.powi(2) + c * c * (cos * cos - sin * sin);
            let right = 4.0 * (c * sin).powi(2) * (p.half.powi(2) - (c * cos).powi(2));
            near("curve", left * left, right, EXACT);
        }
        largest = [largest[0].max(x.abs()), largest[1].max(y.abs())];
    });
    // nearly straight, over more than the coupler's length
    assert!(largest[1] > 1.5 * p.half && largest[0] < 0.03 * largest[1], "{largest:?}");
}

#[test]
fn trammel_draws_an_ellipse() {
    let mechanism = TrammelOfArchimedes::declared();
    let p = *mechanism.parameters();
    along(mechanism, NoComponents::default(), TAU / p.omega, 100, |at| {
        let (sin, cos) = (p.omega * at.t).sin_cos();
        near("x", at.outputs.p_x, p.a * cos, EXACT);
        near("y", at.outputs.p_y, p.b * sin, EXACT);
    });
}

#[test]
fn pantograph_enlarges() {
    for ratio in [2.5, 2.2] {
        let mechanism = Pantograph::new(PantographParameters { ratio, ..Default::default() }).unwrap();
        let p = *mechanism.parameters();
        along(mechanism, NoComponents::default(), TAU / p.omega, 100, |at| {
            let (sin, cos) = (p.omega * at.t).sin_cos();
            near("x", at.outputs.pen_x, ratio * (p.centre_x + p.radius * cos), EXACT);
            near("y", at.outputs.pen_y, ratio * (p.centre_y + p.radius * sin), EXACT);
        });
    }
}
