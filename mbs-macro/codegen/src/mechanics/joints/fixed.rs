//! Two bodies move as one: Φ = (p₁ − p₂, φ₁ − φ₂ − angle).
//!
//! λ: force (ground frame) and torque on the second body; the first feels −λ.

use super::revolute::{X, Y};
use super::{ClauseKind, Holds, JointKind, Row, Wrench};

pub const FIXED: JointKind = JointKind {
    word: "fixed",
    meaning: "two bodies move as one",
    example: "(arm.end, hand.base) at 90 [deg]",
    takes: &[ClauseKind::Angle],
    rows: &[X, Y, ANGLE],
    ..JointKind::PLAIN
};

pub const ANGLE: Row = Row {
    suffix: "_angle",
    restricts: " in its angle",
    holds: Holds::Angle,
    phi: |joint| joint.relative_angle() - joint.at,
    wrench: Some(|joint| Wrench::Torque(joint.algebra().number(1))),
};
