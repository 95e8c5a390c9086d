//! Two points coincide: Φ = p₁ − p₂ (Nikravesh 1988, §4.2.1).
//!
//! λ: the force on the second body at the point, in the ground frame; the first
//! feels −λ.

use super::{Holds, Joint, JointKind, Mend, Row, Wrench};

pub const REVOLUTE: JointKind = JointKind {
    word: "revolute",
    meaning: "two points coincide",
    example: "(crank.tip, rod.base)",
    rows: &[X, Y],
    mend: Mend::RemoveOrMove,
    ..JointKind::PLAIN
};

pub const X: Row = Row {
    suffix: "_x",
    restricts: " along x",
    holds: Holds::Place,
    phi: |joint| joint.separation().x,
    wrench: Some(|joint| force(joint, [1, 0])),
};

pub const Y: Row = Row {
    suffix: "_y",
    restricts: " along y",
    phi: |joint| joint.separation().y,
    wrench: Some(|joint| force(joint, [0, 1])),
    ..X
};

fn force<'a>(joint: &Joint<'a>, along: [i64; 2]) -> Wrench<'a> {
    Wrench::Force(along.map(|component| joint.algebra().number(component)).into())
}
