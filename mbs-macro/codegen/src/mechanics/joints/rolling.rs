//! A wheel, the first body, rolls without slip on a straight track of the second
//! one, through p₂ along u, with the wheel on the left of u: the row of a pinion
//! and a rack, Φ_slip = u·(p₁ − p₂) + r(φ₁ − φ₂) − at, and the distance of its
//! centre, Φ_normal = n·(p₁ − p₂) − r, n = u turned by 90°.
//!
//! λ: on the track act the friction force λ_slip u and the normal force
//! λ_normal n at the point of contact p₁ − r n; the wheel feels the opposite. A
//! track carries a wheel with a negative λ_normal: the constraint would also
//! hold the wheel down.

use mbs_symbolic::Scalar;

use super::point_on_line::NORMAL;
use super::rack::MESH;
use super::{ClauseKind, Joint, JointKind, Mend, Part, Row};

pub const ROLLING: JointKind = JointKind {
    word: "rolling",
    meaning: "a wheel rolls on a track without slip",
    example: "(wheel, ground.track) along (1, 0) radius 0.3 [m]",
    needs: &[&[ClauseKind::Along], &[ClauseKind::Radius]],
    takes: &[ClauseKind::Place],
    rows: &[Row { suffix: "_slip", ..MESH }, Row { phi: height, ..NORMAL }],
    turns: &[(Part::First, Part::Second)],
    mend: Mend::Move("the contact holds the wheel at its height, so that it needs both positions"),
    ..JointKind::PLAIN
};

fn height<'a>(joint: &Joint<'a>) -> Scalar<'a> {
    let [radius, _] = joint.sizes;
    joint.across_line() - radius
}
