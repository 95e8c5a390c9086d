//! A point of the first body stays on a line of the second one, through p₂
//! along u: Φ = n·(p₁ − p₂), n = u turned by 90° and made a unit vector
//! (Nikravesh 1988, §4.2.2). A pin in a slot is the same.
//!
//! λ: the first body feels the force −λ n at p₁, the second one λ n there.

use super::{ClauseKind, Holds, JointKind, Row};

pub const POINT_ON_LINE: JointKind = JointKind {
    word: "point_on_line",
    meaning: "a point stays on a line of another body",
    also: Some(("pin_slot", "a pin stays in a slot, the same as `point_on_line`")),
    example: "(rod.end, ground.rail) along (1, 0)",
    needs: &[&[ClauseKind::Along]],
    rows: &[Row { suffix: "", restricts: "", ..NORMAL }],
    ..JointKind::PLAIN
};

pub const NORMAL: Row = Row {
    suffix: "_normal",
    restricts: " across its line",
    holds: Holds::Length,
    phi: |joint| joint.across_line(),
    wrench: Some(|joint| joint.force_across_line()),
};
