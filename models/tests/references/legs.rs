//! Walking legs, joint after joint by intersecting circles.

use std::f64::consts::{PI, TAU};

use mbs_runtime::Kinematics;
use models::{Jansen, JansenWalker, Klann};

use super::{EXACT, along, intersection, near};

#[test]
fn jansen_is_a_chain_of_circles() {
    let mechanism = Jansen::declared();
    let omega = mechanism.parameters().omega;
    // the holy numbers, in m
    let [a, b, c, d, e, f, g, h, i, j, k, l, m] =
        [38.0, 41.5, 39.3, 40.1, 55.8, 39.4, 36.7, 65.7, 49.0, 50.0, 61.9, 7.8, 15.0].map(|x| x / 100.0);
    let pivot = [-a, -l];
    let mut low = Vec::new();
    along(mechanism, Default::default(), TAU / omega, 360, |at| {
        let (sin, cos) = (omega * at.t).sin_cos();
        let pin = [m * cos, m * sin];
        let upper = intersection(pivot, b, pin, j, 1.0);
        let lower = intersection(pivot, c, pin, k, -1.0);
        let outer = intersection(pivot, d, upper, e, 1.0);
        let ankle = intersection(lower, g, outer, f, 1.0);
        let foot = intersection(lower, i, ankle, h, 1.0);
        let q = at.motion.state.q;
        for (what, ours, reference) in [
            ("B", [q.xb, q.yb], upper),
            ("C", [q.xc, q.yc], lower),
            ("D", [q.xd, q.yd], outer),
            ("E", [q.xe, q.ye], ankle),
            ("F", [q.xf, q.yf], foot),
        ] {
            near(what, ours[0], reference[0], EXACT);
            near(what, ours[1], reference[1], EXACT);
        }
        low.push(q.yf);
    });
    // it walks: the foot is on a level to 1 cm for more than a third of the turn
    let lowest = low.iter().copied().fold(f64::INFINITY, f64::min);
    let on_the_ground = low.iter().filter(|y| **y < lowest + 0.01).count();
    assert!(on_the_ground > low.len() / 3, "{on_the_ground} of {}", low.len());
}

/// The patent's coordinates in its position, then circles with the distances
/// between them.
#[test]
fn klann_is_a_chain_of_circles() {
    let mechanism = Klann::declared();
    let p = *mechanism.parameters();
    let at_origin = |x: f64, y: f64| [p.size * (x - 1.599), p.size * (y - 0.750)];
    let [m, c, b, e, k, a, foot] = [
        at_origin(1.331, 0.750),
        at_origin(0.741, 0.750),
        at_origin(1.009, 0.574),
        at_origin(0.232, 0.866),
        at_origin(0.866, 1.500),
        at_origin(1.366, 1.366),
        at_origin(0.0, 0.0),
    ];
    let length = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
    along(mechanism, Default::default(), TAU / p.omega, 360, |at| {
        let (sin, cos) = (PI + p.omega * at.t).sin_cos();
        let crank = length(m, [0.0, 0.0]);
        let pin = [crank * cos, crank * sin];
        let c_now = intersection(b, length(b, c), pin, length(m, c), 1.0);
        let e_now = intersection(c_now, length(c, e), pin, length(m, e), 1.0);
        let k_now = intersection(a, length(a, k), e_now, length(k, e), -1.0);
        let foot_now = intersection(k_now, length(k, foot), e_now, length(e, foot), 1.0);
        let q = at.motion.state.q;
        for (what, ours, reference, patent) in [
            ("C", [q.xc, q.yc], c_now, c),
            ("E", [q.xe, q.ye], e_now, e),
            ("K", [q.xk, q.yk], k_now, k),
            ("foot", [q.xf, q.yf], foot_now, foot),
        ] {
            for axis in [0, 1] {
                near(what, ours[axis], reference[axis], EXACT);
                if at.t == 0.0 {
                    near(what, ours[axis], patent[axis], EXACT);
                }
            }
        }
    });
}

#[test]
fn walker_has_three_legs_out_of_phase() {
    let walker = JansenWalker::declared();
    let omega = walker.parameters().omega;
    let mut legs = [0.0, 1.0, 2.0].map(|third| {
        let mut leg = Kinematics::new(Jansen::declared()).unwrap();
        let lead = third / 3.0 * TAU / omega;
        // in steps, to stay on the branch
        for k in 0..=100 {
            leg.at(lead * f64::from(k) / 100.0).unwrap();
        }
        (lead, leg)
    });
    along(walker, Default::default(), TAU / omega, 360, |at| {
        let q = at.motion.state.q;
        let feet = [
            (q.first_xf, q.first_yf, at.outputs.foot1),
            (q.second_xf, q.second_yf, at.outputs.foot2),
            (q.third_xf, q.third_yf, at.outputs.foot3),
        ];
        for ((lead, leg), (x, y, height)) in legs.iter_mut().zip(feet) {
            let single = leg.at(at.t + *lead).unwrap().state.q;
            near("x", x, single.xf, EXACT);
            near("y", y, single.yf, EXACT);
            near("output", height, single.yf, EXACT);
        }
    });
}
