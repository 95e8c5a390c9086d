//! The plane in which a robot moves.

use super::space::{Pose, Rotation, Vector, cross, dot, minus, scaled, unit};
use super::{GROUND, Joint, Kind, Robot};
use crate::Refusal;
use crate::geometry::Point;

/// Axes that are off by less than this, in rad, count as parallel: angles of files are
/// written with few digits, such as 1.57 for a right angle.
pub(super) const PARALLEL: f64 = 2e-3;

/// Axes that are off by less than this are off by rounding alone.
const ROUNDING: f64 = 1e-9;

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
/// Bodies whose axes are nearly across it are turned about their joints until they are, so that
/// everything is projected along its own axis.
///
/// # Errors
/// Axes that leave no plane, with the joints by name.
pub(super) fn of(robot: &mut Robot) -> Result<Plane, Refusal> {
    let (right, up, normal, name) = found(robot)?;
    let mut plane = Plane { right, up, normal, name, poses: vec![Pose::NONE] };
    let mut turned: Vec<String> = Vec::new();
    let mut first: Option<(String, Vector)> = None;
    for body in robot.bodies.iter_mut().skip(1) {
        let parent = plane.poses.get(body.parent).copied().unwrap_or(Pose::NONE);
        let pose = parent.of(&body.pose);
        for joint in &body.joints {
            plane.fits(joint, pose.turn.apply(joint.axis), &mut first)?;
        }
        let leads = body.joints.iter().find(|joint| joint.kind == Kind::Hinge).or(body.joints.first());
        if let Some((joint, turn)) = leads.and_then(|joint| Some((joint, plane.turn(joint, &pose)?))) {
            let turn = parent.turn.back().after(&turn).after(&pose.turn);
            let at = minus(body.pose.place(joint.at), turn.apply(joint.at));
            body.pose = Pose { at, turn };
            turned.push(joint.of.clone());
        }
        plane.poses.push(parent.of(&body.pose));
    }
    for closing in &robot.loops {
        let pose = plane.poses.get(closing.bodies[0]).copied().unwrap_or(Pose::NONE);
        plane.fits(&closing.joint, pose.turn.apply(closing.joint.axis), &mut first)?;
    }
    if let Some(joint) = turned.first() {
        let others =
            if turned.len() > 1 { format!(" (and {} more)", turned.len() - 1) } else { String::new() };
        robot.notes.push(format!(
            "the axis of {joint}{others} is off by less than {PARALLEL} rad: it counts as parallel to the others and \
             to the axes of the file"
        ));
    }
    Ok(plane)
}

impl Plane {
    /// Refuses an axis that leaves the plane; `first` is the hinge that it is compared with.
    fn fits(&self, joint: &Joint, axis: Vector, first: &mut Option<(String, Vector)>) -> Result<(), Refusal> {
        let across = cross(axis, self.normal);
        match joint.kind {
            Kind::Hinge if dot(across, across).sqrt() > PARALLEL => Err(Refusal(format!(
                "{} turns about {}, and {} about {}: axes that are not parallel make no planar mechanism",
                joint.of,
                written(axis),
                first.as_ref().map_or("the others", |(first, _)| first),
                written(first.as_ref().map_or(self.normal, |(_, axis)| *axis))
            ))),
            Kind::Slide if dot(axis, self.normal).abs() > PARALLEL => Err(Refusal(format!(
                "{} slides along {}, which leaves the plane {} of the other joints",
                joint.of,
                written(axis),
                self.name
            ))),
            Kind::Hinge => {
                first.get_or_insert_with(|| (joint.of.clone(), axis));
                Ok(())
            }
            Kind::Slide => Ok(()),
        }
    }

    /// The rotation that brings the axis of a hinge onto the normal, or that of a slide into the plane. `None` if the
    /// axis is there but for rounding.
    fn turn(&self, joint: &Joint, pose: &Pose) -> Option<Rotation> {
        let axis = pose.turn.apply(joint.axis);
        let part = dot(axis, self.normal);
        let wanted = match joint.kind {
            Kind::Hinge => scaled(self.normal, part.signum()),
            Kind::Slide => unit(minus(axis, scaled(self.normal, part)))?,
        };
        let across = cross(axis, wanted);
        let sine = dot(across, across).sqrt();
        (sine > ROUNDING).then_some(())?;
        Some(Rotation::about(scaled(across, 1.0 / sine), sine.atan2(dot(axis, wanted))))
    }
}

/// Right and up in the plane of a robot, its normal and its name.
fn found(robot: &Robot) -> Result<(Vector, Vector, Vector, String), Refusal> {
    let poses = poses(robot);
    let of_tree = robot.bodies.iter().zip(&poses).skip(GROUND + 1);
    let of_tree = of_tree.flat_map(|(body, pose)| body.joints.iter().map(move |joint| (joint, pose)));
    let of_loops = robot.loops.iter().map(|closing| (&closing.joint, &poses[closing.bodies[0]]));
    let axes = of_tree.chain(of_loops).map(|(joint, pose)| (joint, pose.turn.apply(joint.axis)));
    let (hinges, slides): (Vec<_>, Vec<_>) = axes.partition(|(joint, _)| joint.kind == Kind::Hinge);
    let first = hinges.first().or(slides.first());
    let (_, first) = first.ok_or_else(|| Refusal("nothing in it moves: it has no joint".into()))?;
    Ok(directions(match hinges.is_empty() {
        false => *first,
        true => across(*first, slides.iter().map(|(_, axis)| *axis), robot.gravity),
    }))
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
