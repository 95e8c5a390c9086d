//! The plane in which a robot moves.

use super::space::{Pose, Vector, cross, dot, minus, scaled, unit};
use super::{GROUND, Kind, Robot};
use crate::import::Refusal;
use crate::import::geometry::Point;

/// Axes that are off by less than this, in rad, count as parallel: angles of files are
/// written with few digits, such as 1.57 for a right angle.
const PARALLEL: f64 = 2e-3;

/// Two directions of space in which everything moves; about the third one, `normal`, it turns.
#[derive(Debug)]
pub(super) struct Plane {
    pub right: Vector,
    pub up: Vector,
    pub normal: Vector,
    /// The axes of the file by name.
    pub name: String,
    /// Where the bodies are in space.
    pub poses: Vec<Pose>,
}

impl Plane {
    pub fn point(&self, vector: Vector) -> Point {
        [dot(self.right, vector), dot(self.up, vector)]
    }
}

const X: Vector = [1.0, 0.0, 0.0];
const Y: Vector = [0.0, 1.0, 0.0];
const Z: Vector = [0.0, 0.0, 1.0];

/// The plane across the axes of the hinges; without one, that of the slides and of gravity.
///
/// # Errors
/// Axes that leave no plane, with the joints by name.
pub(super) fn of(robot: &Robot) -> Result<Plane, Refusal> {
    let poses = poses(robot);
    let of_tree = robot.bodies.iter().zip(&poses).skip(GROUND + 1);
    let of_tree = of_tree.flat_map(|(body, pose)| body.joints.iter().map(move |joint| (joint, pose)));
    let of_loops = robot.loops.iter().map(|closing| (&closing.joint, &poses[closing.bodies[0]]));
    let axes = of_tree.chain(of_loops).map(|(joint, pose)| (joint, pose.turn.apply(joint.axis)));
    let (hinges, slides): (Vec<_>, Vec<_>) = axes.partition(|(joint, _)| joint.kind == Kind::Hinge);
    let first = hinges
        .first()
        .or(slides.first())
        .ok_or_else(|| Refusal("nothing in it moves: it has no joint".into()))?;
    let normal = match hinges.first() {
        Some((_, axis)) => *axis,
        None => across(first.1, slides.iter().map(|(_, axis)| *axis), robot.gravity),
    };
    let (right, up, normal, name) = directions(normal);
    for (joint, axis) in &hinges {
        if dot(cross(*axis, normal), cross(*axis, normal)).sqrt() > PARALLEL {
            let (of, first) = (&joint.of, &first.0.of);
            return Err(Refusal(format!(
                "{of} turns about {}, and {first} about {}: axes that are not parallel make no planar mechanism",
                written(*axis),
                written(hinges.first().map_or(normal, |(_, axis)| *axis))
            )));
        }
    }
    for (joint, axis) in &slides {
        if dot(*axis, normal).abs() > PARALLEL {
            return Err(Refusal(format!(
                "{} slides along {}, which leaves the plane {name} of the other joints",
                joint.of,
                written(*axis)
            )));
        }
    }
    Ok(Plane { right, up, normal, name, poses })
}

/// Where the bodies are in space.
pub(super) fn poses(robot: &Robot) -> Vec<Pose> {
    let mut poses = vec![Pose::NONE];
    for body in robot.bodies.iter().skip(1) {
        poses.push(poses.get(body.parent).copied().unwrap_or(Pose::NONE).of(&body.pose));
    }
    poses
}

/// A direction across the slides, and across gravity if they leave a choice.
fn across(first: Vector, slides: impl Iterator<Item = Vector>, gravity: Vector) -> Vector {
    let others = slides.chain([gravity, Z, X]);
    others.filter_map(|other| unit(cross(first, other))).next().unwrap_or(Y)
}

/// Right and up in the plane across a normal, the direction in which they turn, and their names.
fn directions(normal: Vector) -> (Vector, Vector, Vector, String) {
    let along = |axis: Vector| dot(normal, axis).abs() > 1.0 - 0.5 * PARALLEL * PARALLEL;
    if along(Y) {
        return (X, Z, scaled(Y, -1.0), "x-z".into());
    }
    if along(Z) {
        return (X, Y, Z, "x-y".into());
    }
    if along(X) {
        return (Y, Z, X, "y-z".into());
    }
    let up = unit(minus(Z, scaled(normal, dot(Z, normal)))).unwrap_or(Z);
    // It is seen from the side on which x goes to the right, as in the plane x-z.
    let normal = if cross(up, normal)[0] < 0.0 { scaled(normal, -1.0) } else { normal };
    (cross(up, normal), up, normal, format!("across {}", written(normal)))
}

/// A direction in messages.
fn written(direction: Vector) -> String {
    // no minus before a zero
    let [x, y, z] = direction.map(|entry| (1e4 * entry).round() / 1e4 + 0.0);
    format!("({x}, {y}, {z})")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The two directions of an axis are one plane; it was seen from behind for one of them.
    #[test]
    fn x_goes_to_the_right_in_every_plane_that_has_it() {
        for y in [[0.6, 0.8, 0.0], [-0.6, -0.8, 0.0], [0.48, -0.64, 0.6], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0]] {
            let (right, up, normal, name) = directions(y);
            assert!(right[0] > 0.0 && up[2] > 0.0, "{name}: {right:?}, {up:?}");
            let turned = minus(cross(right, up), normal);
            assert!(dot(turned, turned) < 1e-30, "{name}: {turned:?}");
        }
    }
}
