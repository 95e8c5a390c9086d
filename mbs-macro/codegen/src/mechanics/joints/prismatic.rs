//! The first body slides along a line of the second one without turning
//! relative to it: the row of a point on a line, and φ₁ − φ₂ − angle
//! (Nikravesh 1988, §4.2.1).
//!
//! λ: normal force as for a point on a line; torque on the second body, the
//! first feels −λ.

use mbs_symbolic::Arena;

use super::{Connection, JointRow, point_on_line, relative_angle};

pub fn rows(arena: &mut Arena, connection: &Connection) -> Vec<JointRow> {
    let mut rows = point_on_line::rows(arena, connection);
    rows.push(relative_angle(arena, connection));
    rows
}
