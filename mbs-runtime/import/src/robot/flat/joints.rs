//! The motions that joints leave to bodies, and the measures of their coordinates.

use super::{Coordinate, Freedom, Held, Layer, Measure, idle};
use crate::Refusal;
use crate::geometry::Point;
use crate::robot::space::{Pose, dot};
use crate::robot::{Joint, Kind};

/// Directions whose product is below this one are at right angles.
const ACROSS: f64 = 1e-9;

/// Two bodies with the joints between them, the first one at the second body.
struct Between<'a> {
    bodies: [usize; 2],
    /// The frame of the first body in that of the second one.
    pose: Pose,
    joints: &'a [Joint],
}

impl<'a> Layer<'a> {
    /// The joints of the tree, and those that close its loops.
    pub(super) fn joints(&mut self) -> Result<(), Refusal> {
        let robot = self.robot;
        for (at, body) in robot.bodies.iter().enumerate().skip(1) {
            self.hold(&Between { bodies: [at, body.parent], pose: body.pose, joints: &body.joints })?;
        }
        for closing in &robot.loops {
            let [first, second] = closing.bodies.map(|body| self.flat.plane.poses[body]);
            let [part, other] = closing.bodies.map(|body| self.places[body].0);
            if part == other {
                self.flat.notes.push(idle(&closing.joint.of));
                continue;
            }
            let joints = std::slice::from_ref(&closing.joint);
            self.hold(&Between { bodies: closing.bodies, pose: first.seen_from(&second), joints })?;
        }
        Ok(())
    }

    fn hold(&mut self, between: &Between<'a>) -> Result<(), Refusal> {
        let Between { bodies: [at, parent], pose, joints } = *between;
        let Some(first) = joints.first() else { return Ok(()) };
        let freedom = self.freedom(between)?;
        // A hinge has a place; a slide may be drawn at any parallel line.
        let pivot = joints.iter().find(|joint| joint.kind == Kind::Hinge).unwrap_or(first);
        let ends = [self.place(at, pivot.at), self.place(parent, pose.place(pivot.at))];
        let parts = [self.places[at].0, self.places[parent].0];
        let held = self.flat.joints.len();
        self.flat.joints.push(Held { joint: first, parts, at: ends, freedom });
        for joint in joints {
            let measure = self.measure(between, joint, freedom);
            self.flat.coordinates.push(Coordinate { joint, held, measure });
        }
        Ok(())
    }

    /// The direction of a slide in the frame of the parent's part, and in that of the body's.
    fn along(&self, between: &Between<'_>, joint: &Joint) -> [Point; 2] {
        let [at, parent] = between.bodies;
        let unit = |[x, y]: Point| match x.hypot(y) {
            length if length > 0.0 && length != 1.0 => [x / length, y / length],
            _ => [x, y],
        };
        let of_parent = self.vector(parent, between.pose.turn.apply(joint.axis));
        [of_parent, self.vector(at, joint.axis)].map(unit)
    }

    fn freedom(&self, between: &Between<'_>) -> Result<Freedom, Refusal> {
        let along = |joint: &Joint| self.along(between, joint);
        let [first, rest @ ..] = between.joints else { return Ok(Freedom::All) };
        let is_across = |other: &Joint| {
            let ([a, _], [b, _]) = (along(first), along(other));
            (a[0] * b[0] + a[1] * b[1]).abs() < ACROSS
        };
        use Kind::{Hinge, Slide};
        match (first.kind, rest.iter().map(|joint| joint.kind).collect::<Vec<_>>().as_slice()) {
            (Hinge, []) => Ok(Freedom::Turn),
            (Slide, []) => Ok(Freedom::Slide { along: along(first)[0] }),
            (Slide, [Hinge]) => Ok(Freedom::SlideAndTurn { along: along(first)[0] }),
            (Hinge, [Slide]) => Ok(Freedom::TurnAndSlide { along: along(&rest[0])[1] }),
            (Slide, [Slide]) if is_across(&rest[0]) => Ok(Freedom::Shift),
            (Slide, [Slide, Hinge]) if is_across(&rest[0]) => Ok(Freedom::All),
            _ => {
                let (last, body) =
                    (&rest.last().unwrap_or(first).of, &self.robot.bodies[between.bodies[0]].of);
                Err(Refusal(format!(
                    "{last} follows others on {body} in a way that is not imported; a body has a hinge, slides at \
                     right angles, and a hinge after them or before one"
                )))
            }
        }
    }

    fn measure(&self, between: &Between<'_>, joint: &Joint, freedom: Freedom) -> Measure {
        let [of_parent, of_body] = self.along(between, joint);
        match (joint.kind, freedom) {
            (Kind::Hinge, _) => {
                let plane = self.flat.plane;
                let axis = plane.poses[between.bodies[0]].turn.apply(joint.axis);
                Measure::Angle { sign: dot(axis, plane.normal).signum() }
            }
            (Kind::Slide, Freedom::TurnAndSlide { .. }) => {
                Measure::Along { along: of_body, is_of_body: true }
            }
            (Kind::Slide, _) => Measure::Along { along: of_parent, is_of_body: false },
        }
    }
}
