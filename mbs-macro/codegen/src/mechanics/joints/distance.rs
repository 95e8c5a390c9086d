//! Two points keep their distance, as if a massless rod joined them:
//! Φ = (|p₁ − p₂|² − L²)/(2L), a length to first order.
//!
//! λ: the tension of the rod, positive when it pulls the points together.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Arena, Expr, Number};

use super::{Connection, JointRow, separation, square};

pub fn rows(arena: &mut Arena, connection: &Connection) -> Vec<JointRow> {
    let separation = separation(arena, connection);
    let squared = square(arena, separation);
    let half = arena.number(Number::ratio(1, 2));
    let scaled = arena.product(&[(squared, 1), (half, 1), (connection.value, -1)]);
    let half_length = arena.mul(half, connection.value);
    vec![JointRow { phi: arena.sub(scaled, half_length), dimension: Dimension::LENGTH }]
}

/// (p₁ − p₂)/L: the tension pulls the second body to the first.
pub fn pull(arena: &mut Arena, connection: &Connection) -> [Expr; 2] {
    separation(arena, connection).map(|component| arena.product(&[(component, 1), (connection.value, -1)]))
}
