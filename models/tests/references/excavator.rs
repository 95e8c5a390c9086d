//! Excavator arm: cylinders to angles to teeth.

use std::f64::consts::{FRAC_PI_4, TAU};

use models::Excavator;

use super::{EXACT, along, near};

/// The angle between sides a and b of a triangle with the third side s.
fn angle(a: f64, b: f64, s: f64) -> f64 {
    ((a * a + b * b - s * s) / (2.0 * a * b)).acos()
}

#[test]
fn cylinders_place_the_teeth() {
    let mechanism = Excavator::declared();
    let p = *mechanism.parameters();
    along(mechanism, Default::default(), TAU / p.omega, 200, |at| {
        let (sin, cos) = (p.omega * at.t).sin_cos();
        let boom = angle(0.5_f64.sqrt(), p.boom_length / 2.0, 2.1 + 0.2 * sin) - FRAC_PI_4;
        let stick = boom - angle(p.boom_length / 4.0, p.stick_length / 4.0, 1.2 + 0.15 * cos);
        let bucket = stick - angle(0.75 * p.stick_length, p.bucket_length / 4.0, 1.55 - 0.2 * sin * cos);
        let q = at.motion.state.q;
        near("boom", q.phi1, boom, EXACT);
        near("stick", q.phi2, stick, EXACT);
        near("bucket", q.phi3, bucket, EXACT);
        let links = [(p.boom_length, boom), (p.stick_length, stick), (p.bucket_length, bucket)];
        let x: f64 = links.iter().map(|(l, a)| l * a.cos()).sum();
        let y: f64 = links.iter().map(|(l, a)| l * a.sin()).sum();
        // 7 m of arm
        near("teeth x", at.outputs.teeth_x, x, 7.0 * EXACT);
        near("teeth y", at.outputs.teeth_y, y, 7.0 * EXACT);
    });
}
