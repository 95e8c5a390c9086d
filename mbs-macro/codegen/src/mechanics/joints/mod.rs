//! Joints as constraint rows, a file each.
//!
//! A row is Φ with its multiplier's meaning: the generalized constraint forces
//! are −Φ_qᵀ λ, so a row Φ = p₁ − p₂ has in λ the force that acts on the second
//! body at p₂, while the first feels −λ.

mod belt;
mod cam;
mod distance;
mod fixed;
mod gear;
mod point_on_line;
mod prismatic;
mod rack;
mod revolute;
mod rolling;

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Arena, Expr, Function, Number};

use crate::syntax::JointKind;

/// A place on a body, in the ground frame.
#[derive(Clone, Copy)]
pub struct Placed {
    pub position: [Expr; 2],
    /// Angle of the body.
    pub angle: Expr,
}

/// A joint with its places and clauses resolved; what plays no part in it has
/// the value that changes nothing.
#[derive(Clone, Copy)]
pub struct Connection {
    pub first: Placed,
    pub second: Placed,
    /// A direction in the frame of the second body; (1, 0) without one.
    pub along: [Expr; 2],
    /// Constant relative angle or displacement; 0 without one.
    pub at: Expr,
    /// Constant distance, or the polar radius of a cam; 0 without one.
    pub value: Expr,
    /// Radii, or 1 and the ratio of the second to the first.
    pub sizes: [Expr; 2],
    /// A length, or of no dimension where the sizes are a ratio.
    pub unit: Dimension,
    /// Angle of the body relative to which the others turn; 0 for the ground.
    pub carrier: Expr,
}

/// One constraint row of a joint.
pub struct JointRow {
    pub phi: Expr,
    pub dimension: Dimension,
}

/// What a row exerts on the second body for λ = 1; the first feels the opposite.
pub struct Wrench {
    /// A force in the ground frame, where the row holds a place.
    pub force: Option<[Expr; 2]>,
    /// A torque, where it holds an angle.
    pub torque: Option<Expr>,
}

/// The names of a joint's rows behind its own: `pin_x`, `pin_y`; a joint with
/// one row gives it its own name.
pub fn row_suffixes(kind: JointKind) -> &'static [&'static str] {
    match kind {
        JointKind::Revolute => &["_x", "_y"],
        JointKind::Fixed => &["_x", "_y", "_angle"],
        JointKind::Prismatic => &["_normal", "_angle"],
        JointKind::Rolling => &["_slip", "_normal"],
        _ => &[""],
    }
}

/// The rows of a joint, in the order of their names.
pub fn rows(arena: &mut Arena, kind: JointKind, connection: &Connection) -> Vec<JointRow> {
    match kind {
        JointKind::Revolute => revolute::rows(arena, connection),
        JointKind::Fixed => fixed::rows(arena, connection),
        JointKind::Prismatic => prismatic::rows(arena, connection),
        JointKind::PointOnLine => point_on_line::rows(arena, connection),
        JointKind::Distance => distance::rows(arena, connection),
        JointKind::Gear => gear::external(arena, connection),
        JointKind::InternalGear => gear::internal(arena, connection),
        JointKind::Belt => belt::open(arena, connection),
        JointKind::CrossedBelt => belt::crossed(arena, connection),
        JointKind::Rack => rack::rows(arena, connection),
        JointKind::Rolling => rolling::rows(arena, connection),
        JointKind::Cam => cam::rows(arena, connection),
    }
}

/// What the rows of a joint exert, in their order.
pub fn wrenches(arena: &mut Arena, kind: JointKind, connection: &Connection) -> Vec<Wrench> {
    let force = |force| Wrench { force: Some(force), torque: None };
    let (zero, one) = (arena.zero(), arena.one());
    let mut wrenches = match kind {
        JointKind::Revolute | JointKind::Fixed => vec![force([one, zero]), force([zero, one])],
        JointKind::Prismatic | JointKind::PointOnLine => vec![force(unit_normal(arena, connection))],
        JointKind::Distance => vec![force(distance::pull(arena, connection))],
        JointKind::Rack => vec![force(unit_direction(arena, connection))],
        JointKind::Rolling => {
            vec![force(unit_direction(arena, connection)), force(unit_normal(arena, connection))]
        }
        // torques that differ on both bodies, or a force along a curve's normal
        JointKind::Gear
        | JointKind::InternalGear
        | JointKind::Belt
        | JointKind::CrossedBelt
        | JointKind::Cam => Vec::new(),
    };
    if matches!(kind, JointKind::Fixed | JointKind::Prismatic) {
        wrenches.push(Wrench { force: None, torque: Some(one) });
    }
    wrenches
}

/// The direction on the second body, of length 1.
fn unit_direction(arena: &mut Arena, connection: &Connection) -> [Expr; 2] {
    let [nx, ny] = unit_normal(arena, connection);
    [ny, arena.neg(nx)]
}

/// n, the direction on the second body turned by 90°, of length 1.
fn unit_normal(arena: &mut Arena, connection: &Connection) -> [Expr; 2] {
    let [ux, uy] = connection.along;
    let length = square(arena, connection.along);
    let length = arena.call(Function::Sqrt, length);
    let normal = [arena.neg(uy), ux];
    rotate(arena, connection.second.angle, normal).map(|n| arena.product(&[(n, 1), (length, -1)]))
}

/// How far the first place is from the second along a direction of the second
/// body.
pub fn offset_along(arena: &mut Arena, first: &Placed, second: &Placed, along: [Expr; 2]) -> Expr {
    let length = square(arena, along);
    let length = arena.call(Function::Sqrt, length);
    let along = rotate(arena, second.angle, along);
    let ([x1, y1], [x2, y2]) = (first.position, second.position);
    let (dx, dy) = (arena.sub(x1, x2), arena.sub(y1, y2));
    let (along_x, along_y) = (arena.mul(along[0], dx), arena.mul(along[1], dy));
    let offset = arena.add(along_x, along_y);
    arena.product(&[(offset, 1), (length, -1)])
}

/// Where a point of a body is: origin + R(angle)·local.
pub fn place(arena: &mut Arena, origin: [Expr; 2], angle: Expr, local: [Expr; 2]) -> Placed {
    let [x, y] = rotate(arena, angle, local);
    Placed { position: [arena.add(origin[0], x), arena.add(origin[1], y)], angle }
}

/// The distance between two places.
pub fn distance_between(arena: &mut Arena, first: &Placed, second: &Placed) -> Expr {
    let between = difference(arena, first, second);
    let squared = square(arena, between);
    arena.call(Function::Sqrt, squared)
}

/// The direction from the first place to the second, as an angle in the frame
/// of the first.
pub fn polar_angle(arena: &mut Arena, first: &Placed, second: &Placed) -> Expr {
    let [dx, dy] = difference(arena, second, first);
    let direction = arena.call2(Function::Atan2, dy, dx);
    arena.sub(direction, first.angle)
}

/// R(angle)·v
pub fn rotate(arena: &mut Arena, angle: Expr, [x, y]: [Expr; 2]) -> [Expr; 2] {
    let (sine, cosine) = (arena.call(Function::Sin, angle), arena.call(Function::Cos, angle));
    let (xc, ys) = (arena.mul(x, cosine), arena.mul(y, sine));
    let (xs, yc) = (arena.mul(x, sine), arena.mul(y, cosine));
    [arena.sub(xc, ys), arena.add(xs, yc)]
}

fn separation(arena: &mut Arena, connection: &Connection) -> [Expr; 2] {
    difference(arena, &connection.first, &connection.second)
}

/// p₁ − p₂
pub fn difference(arena: &mut Arena, first: &Placed, second: &Placed) -> [Expr; 2] {
    let ([x1, y1], [x2, y2]) = (first.position, second.position);
    [arena.sub(x1, x2), arena.sub(y1, y2)]
}

/// x² + y²
fn square(arena: &mut Arena, [x, y]: [Expr; 2]) -> Expr {
    let (xx, yy) = (arena.powi(x, 2), arena.powi(y, 2));
    arena.add(xx, yy)
}

/// φ₁ − φ₂ − angle
fn relative_angle(arena: &mut Arena, connection: &Connection) -> JointRow {
    let relative = arena.sub(connection.first.angle, connection.second.angle);
    JointRow { phi: arena.sub(relative, connection.at), dimension: Dimension::NONE }
}

/// The component of p₁ − p₂ along a direction of the second body, which is made
/// a unit vector.
fn component(arena: &mut Arena, connection: &Connection, direction: [Expr; 2]) -> Expr {
    let turned = rotate(arena, connection.second.angle, direction);
    let [dx, dy] = separation(arena, connection);
    let (along_x, along_y) = (arena.mul(turned[0], dx), arena.mul(turned[1], dy));
    let projection = arena.add(along_x, along_y);
    let squared = square(arena, direction);
    let length = arena.call(Function::Sqrt, squared);
    arena.product(&[(projection, 1), (length, -1)])
}

/// s₁ (φ₁ − φ_c − at) + sign s₂ (φ₂ − φ_c): two bodies turn relative to a third.
fn transmission(arena: &mut Arena, connection: &Connection, sign: Number) -> JointRow {
    let Connection { first, second, carrier, at, sizes, unit, .. } = connection;
    let driving =
        arena.sum(&[(first.angle, Number::ONE), (*carrier, Number::MINUS_ONE), (*at, Number::MINUS_ONE)]);
    let driven = arena.sub(second.angle, *carrier);
    let (driving, driven) = (arena.mul(sizes[0], driving), arena.mul(sizes[1], driven));
    JointRow { phi: arena.sum(&[(driving, Number::ONE), (driven, sign)]), dimension: *unit }
}
