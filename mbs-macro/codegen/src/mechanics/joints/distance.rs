//! Two points keep their distance, as if a massless rod joined them:
//! Φ = (|p₁ − p₂|² − L²)/(2L), a length to first order.
//!
//! λ: the tension of the rod, positive when it pulls the points together.

use mbs_symbolic::Scalar;

use super::{ClauseKind, Holds, Joint, JointKind, Row, Wrench};

pub const DISTANCE: JointKind = JointKind {
    word: "distance",
    meaning: "two points keep their distance",
    example: "(bob, ground.hook) = 0.5 [m]",
    needs: &[&[ClauseKind::Distance]],
    rows: &[Row { suffix: "", restricts: "", holds: Holds::Length, phi, wrench: Some(pull) }],
    ..JointKind::PLAIN
};

fn phi<'a>(joint: &Joint<'a>) -> Scalar<'a> {
    let (r, length) = (joint.separation(), joint.value);
    (r.dot(r) / length - length) / 2
}

/// (p₁ − p₂)/L: the tension pulls the second body to the first.
fn pull<'a>(joint: &Joint<'a>) -> Wrench<'a> {
    Wrench::Force(joint.separation() / joint.value)
}
