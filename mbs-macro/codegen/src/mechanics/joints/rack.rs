//! A pinion, the first body, meshes with a rack on the second one, along the
//! direction u of the second: Φ = u·(p₁ − p₂) + r(φ₁ − φ₂) − at (Nikravesh 1988,
//! ch. 4). The rack is on the right of u: its pitch line touches the pinion in
//! p₁ − r n, n = u turned by 90°.
//!
//! λ: the tooth force on the rack is λ u at that point; the pinion feels −λ u
//! there, and so a torque of −rλ about its centre.

use mbs_symbolic::Arena;
use mbs_symbolic::units::Dimension;

use super::{Connection, JointRow, component};

pub fn rows(arena: &mut Arena, connection: &Connection) -> Vec<JointRow> {
    let travel = component(arena, connection, connection.along);
    let turned = arena.sub(connection.first.angle, connection.second.angle);
    let rolled = arena.mul(connection.sizes[0], turned);
    let sum = arena.add(travel, rolled);
    vec![JointRow { phi: arena.sub(sum, connection.at), dimension: Dimension::LENGTH }]
}
