//! Two points coincide: Φ = p₁ − p₂ (Nikravesh 1988, §4.2.1).
//!
//! λ: the force on the second body at the point, in the ground frame; the first
//! feels −λ.

use mbs_symbolic::Arena;
use mbs_symbolic::units::Dimension;

use super::{Connection, JointRow, separation};

pub fn rows(arena: &mut Arena, connection: &Connection) -> Vec<JointRow> {
    let row = |phi| JointRow { phi, dimension: Dimension::LENGTH };
    separation(arena, connection).map(row).into()
}
