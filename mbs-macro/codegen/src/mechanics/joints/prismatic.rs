//! The first body slides along a line of the second one without turning
//! relative to it: the row of a point on a line, and φ₁ − φ₂ − angle
//! (Nikravesh 1988, §4.2.1).
//!
//! λ: normal force as for a point on a line; torque on the second body, the
//! first feels −λ.

use super::fixed::ANGLE;
use super::point_on_line::NORMAL;
use super::{ClauseKind, JointKind};

pub const PRISMATIC: JointKind = JointKind {
    word: "prismatic",
    meaning: "a body slides along another without turning against it",
    example: "(slider, ground.rail) along (1, 0)",
    needs: &[&[ClauseKind::Along]],
    takes: &[ClauseKind::Angle],
    rows: &[NORMAL, ANGLE],
    ..JointKind::PLAIN
};
