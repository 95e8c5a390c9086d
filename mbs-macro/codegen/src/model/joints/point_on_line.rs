//! A point of the first body stays on a line of the second one, through p₂
//! along u: Φ = n·(p₁ − p₂), n = u turned by 90° and made a unit vector
//! (Nikravesh 1988, §4.2.2). A pin in a slot is the same.
//!
//! λ: the first body feels the force −λ n at p₁, the second one λ n there.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Arena, Function};

use super::{Connection, JointRow, rotate, separation, square};

pub fn rows(arena: &mut Arena, connection: &Connection) -> Vec<JointRow> {
    let [ux, uy] = connection.along;
    let normal = [arena.neg(uy), ux];
    let normal = rotate(arena, connection.second.angle, normal);
    let [dx, dy] = separation(arena, connection);
    let (along_x, along_y) = (arena.mul(normal[0], dx), arena.mul(normal[1], dy));
    let offset = arena.add(along_x, along_y);
    let length = square(arena, connection.along);
    let length = arena.call(Function::Sqrt, length);
    let phi = arena.product(&[(offset, 1), (length, -1)]);
    vec![JointRow { phi, dimension: Dimension::LENGTH }]
}
