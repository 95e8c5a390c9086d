//! A wheel, the first body, rolls without slip on a straight track of the second
//! one, through p₂ along u, with the wheel on the left of u: the row of a pinion
//! and a rack, Φ_slip = u·(p₁ − p₂) + r(φ₁ − φ₂) − at, and the distance of its
//! centre, Φ_normal = n·(p₁ − p₂) − r, n = u turned by 90°.
//!
//! λ: on the track act the friction force λ_slip u and the normal force
//! λ_normal n at the point of contact p₁ − r n; the wheel feels the opposite. A
//! track carries a wheel with a negative λ_normal: the constraint would also
//! hold the wheel down.

use mbs_symbolic::Arena;
use mbs_symbolic::units::Dimension;

use super::{Connection, JointRow, point_on_line, rack};

pub fn rows(arena: &mut Arena, connection: &Connection) -> Vec<JointRow> {
    let mut rows = rack::rows(arena, connection);
    let radius = connection.sizes[0];
    rows.extend(
        point_on_line::rows(arena, connection)
            .into_iter()
            .map(|height| JointRow { phi: arena.sub(height.phi, radius), dimension: Dimension::LENGTH }),
    );
    rows
}
