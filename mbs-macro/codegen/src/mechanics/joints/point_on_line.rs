//! A point of the first body stays on a line of the second one, through p₂
//! along u: Φ = n·(p₁ − p₂), n = u turned by 90° and made a unit vector
//! (Nikravesh 1988, §4.2.2). A pin in a slot is the same.
//!
//! λ: the first body feels the force −λ n at p₁, the second one λ n there.

use mbs_symbolic::Arena;
use mbs_symbolic::units::Dimension;

use super::{Connection, JointRow, component};

pub fn rows(arena: &mut Arena, connection: &Connection) -> Vec<JointRow> {
    let [ux, uy] = connection.along;
    let normal = [arena.neg(uy), ux];
    vec![JointRow { phi: component(arena, connection, normal), dimension: Dimension::LENGTH }]
}
