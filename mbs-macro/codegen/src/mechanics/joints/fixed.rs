//! Two bodies move as one: Φ = (p₁ − p₂, φ₁ − φ₂ − angle).
//!
//! λ: force (ground frame) and torque on the second body; the first feels −λ.

use mbs_symbolic::Arena;

use super::{Connection, JointRow, relative_angle, revolute};

pub fn rows(arena: &mut Arena, connection: &Connection) -> Vec<JointRow> {
    let mut rows = revolute::rows(arena, connection);
    rows.push(relative_angle(arena, connection));
    rows
}
