//! A robot laid into its plane: parts of bodies that are fixed to each other, and what joins them.

mod joints;

use super::plane::{PARALLEL, Plane};
use super::space::{Pose, Rotation, Vector, dot};
use super::{Actuator, Body, Closing, Coupling, GROUND, Joint, Robot};
use crate::Refusal;
use crate::geometry::{Point, distance, turned};

/// The planar mechanism. Points of a part are in its frame, whose origin is that of its first body.
#[derive(Debug)]
pub(super) struct Flat<'a> {
    pub plane: &'a Plane,
    /// In the plane.
    pub gravity: Point,
    /// The first one is the ground.
    pub parts: Vec<Part<'a>>,
    pub joints: Vec<Held<'a>>,
    pub coordinates: Vec<Coordinate<'a>>,
    pub closings: Vec<Closed<'a>>,
    pub couplings: Vec<Coupled<'a>>,
    /// The actuators, each with the index of its coordinate.
    pub actuators: Vec<(&'a Actuator, usize)>,
    /// The size of the mechanism in m.
    pub size: f64,
    pub notes: Vec<String>,
}

/// Bodies that are fixed to each other.
#[derive(Debug)]
pub(super) struct Part<'a> {
    pub body: &'a Body,
    /// The frame at the start, in the plane.
    pub at: Point,
    pub angle: f64,
    pub centre: Point,
    pub mass: f64,
    pub inertia: f64,
    /// The places that have names, in the frame of the part.
    pub marks: Vec<(&'a super::Mark, Point)>,
}

impl Part<'_> {
    /// Where a point of the frame is at the start.
    pub fn start(&self, point: Point) -> Point {
        let [x, y] = turned(point, self.angle);
        [self.at[0] + x, self.at[1] + y]
    }
}

/// The motion that a body's joints leave it against its parent.
#[derive(Clone, Copy, Debug)]
pub(super) enum Freedom {
    /// A turn about a point of both.
    Turn,
    /// A slide along a line of the parent, without turning.
    Slide { along: Point },
    /// A point of the body moves along a line of the parent, and the body turns.
    SlideAndTurn { along: Point },
    /// A point of the parent moves along a line of the body, and the body turns.
    TurnAndSlide { along: Point },
    /// Any displacement, without turning.
    Shift,
    /// Any motion.
    All,
}

/// A body and its parent, or the two bodies of a joint that closes a loop, with a point in the
/// frame of each.
#[derive(Debug)]
pub(super) struct Held<'a> {
    /// The first joint of the body.
    pub joint: &'a Joint,
    pub parts: [usize; 2],
    pub at: [Point; 2],
    pub freedom: Freedom,
}

/// A joint's coordinate.
#[derive(Debug)]
pub(super) struct Coordinate<'a> {
    pub joint: &'a Joint,
    /// Among the joints of the mechanism.
    pub held: usize,
    pub measure: Measure,
}

#[derive(Clone, Copy, Debug)]
pub(super) enum Measure {
    /// How far the body is turned against its parent; -1 where the axis goes against the normal.
    Angle { sign: f64 },
    /// How far the body's point is along a direction of the parent, or of the body itself.
    Along { along: Point, is_of_body: bool },
}

/// A joint that closes a loop.
#[derive(Debug)]
pub(super) struct Closed<'a> {
    pub closing: &'a Closing,
    pub parts: [usize; 2],
    pub at: [Point; 2],
    /// The angle of the first against the second, if they keep it.
    pub angle: Option<f64>,
}

/// A coordinate that follows another one.
#[derive(Debug)]
pub(super) struct Coupled<'a> {
    pub coupling: &'a Coupling,
    pub follower: usize,
    pub leader: Option<usize>,
}

/// Lays a robot into its plane.
///
/// # Errors
/// Bodies without mass, joints that follow each other in a way that the language lacks, and
/// parts that the file does not have.
pub(super) fn laid<'a>(robot: &'a Robot, plane: &'a Plane) -> Result<Flat<'a>, Refusal> {
    let gravity = plane.point(robot.gravity);
    let flat = Flat {
        plane,
        gravity,
        parts: Vec::new(),
        joints: Vec::new(),
        coordinates: Vec::new(),
        closings: Vec::new(),
        couplings: Vec::new(),
        actuators: Vec::new(),
        size: 0.0,
        notes: Vec::new(),
    };
    let mut layer = Layer { robot, flat, places: Vec::new() };
    layer.notes();
    layer.parts()?;
    layer.joints()?;
    layer.closings()?;
    layer.couplings()?;
    layer.actuators()?;
    layer.size();
    Ok(layer.flat)
}

/// The note on a joint between bodies that are fixed to each other.
fn idle(of: &str) -> String {
    format!("{of} joins what is one part already: it was left out")
}

struct Layer<'a> {
    robot: &'a Robot,
    flat: Flat<'a>,
    /// The part of each body, and the body's frame in that of the part in space.
    places: Vec<(usize, Pose)>,
}

impl<'a> Layer<'a> {
    fn notes(&mut self) {
        let across = dot(self.flat.plane.normal, self.robot.gravity);
        if across.abs() > 1e-3 {
            let name = &self.flat.plane.name;
            self.flat.notes.push(format!(
                "not carried over: the part of gravity across the plane {name}, which moves nothing in it"
            ));
        }
    }

    /// A frame as it turns in the plane: its angle, or nothing if it is turned out of the plane.
    fn angle(&self, turn: &Rotation) -> Option<f64> {
        let plane = self.flat.plane;
        let is_in_plane = dot(turn.apply(plane.normal), plane.normal) > 1.0 - 1e-12;
        let [x, y] = plane.point(turn.apply(plane.right));
        is_in_plane.then(|| y.atan2(x))
    }

    /// A vector of a body in the frame of its part, in the plane.
    fn vector(&self, body: usize, vector: Vector) -> Point {
        let (part, pose) = self.places.get(body).copied().unwrap_or((GROUND, Pose::NONE));
        let turned = pose.turn.apply(vector);
        let turn = self.frame(part);
        self.flat.plane.point(turn.map_or(turned, |turn| turn.apply(turned)))
    }

    /// A place of a body in the frame of its part.
    fn place(&self, body: usize, place: Vector) -> Point {
        let (part, pose) = self.places.get(body).copied().unwrap_or((GROUND, Pose::NONE));
        let turn = self.frame(part);
        let place = pose.place(place);
        self.flat.plane.point(turn.map_or(place, |turn| turn.apply(place)))
    }

    /// The rotation that brings the frame of a part into the plane, if the part is turned out of it.
    fn frame(&self, part: usize) -> Option<Rotation> {
        let first = self.places.iter().position(|(of, _)| *of == part)?;
        let turn = self.flat.plane.poses.get(first)?.turn;
        self.angle(&turn).is_none().then_some(turn)
    }

    fn parts(&mut self) -> Result<(), Refusal> {
        for (at, body) in self.robot.bodies.iter().enumerate() {
            let parent = self.places.get(body.parent).copied();
            let place = match parent {
                Some((part, pose)) if at != GROUND && body.joints.is_empty() => (part, pose.of(&body.pose)),
                _ => {
                    let pose = self.flat.plane.poses.get(at).copied().unwrap_or(Pose::NONE);
                    let angle = self.angle(&pose.turn).unwrap_or(0.0);
                    self.flat.parts.push(Part {
                        body,
                        at: self.flat.plane.point(pose.at),
                        angle,
                        centre: [0.0; 2],
                        mass: 0.0,
                        inertia: 0.0,
                        marks: Vec::new(),
                    });
                    (self.flat.parts.len() - 1, Pose::NONE)
                }
            };
            self.places.push(place);
        }
        for part in 0..self.flat.parts.len() {
            self.part(part)?;
        }
        Ok(())
    }

    /// Mass, centre and marks of a part.
    fn part(&mut self, part: usize) -> Result<(), Refusal> {
        let members: Vec<usize> =
            (0..self.places.len()).filter(|body| self.places[*body].0 == part).collect();
        let mut lumps: Vec<(f64, Point, f64)> = Vec::new();
        let mut marks = Vec::new();
        for body in members {
            let of = &self.robot.bodies[body];
            // the normal in the body's own frame
            let normal = self.flat.plane.poses[body].turn.back().apply(self.flat.plane.normal);
            for lump in of.lumps.iter().filter(|lump| lump.mass > 0.0) {
                let about = dot(normal, lump.inertia.map(|row| dot(row, normal)));
                lumps.push((lump.mass, self.place(body, lump.at), about));
            }
            marks.extend(of.marks.iter().map(|mark| (mark, self.place(body, mark.at))));
        }
        let mass: f64 = lumps.iter().map(|(mass, ..)| mass).sum();
        let centre = match lumps[..] {
            [] => [0.0; 2],
            // as it is written
            [(_, at, _)] => at,
            _ => [0, 1].map(|axis| lumps.iter().map(|(mass, at, _)| mass * at[axis]).sum::<f64>() / mass),
        };
        let Some(found) = self.flat.parts.get_mut(part) else { return Ok(()) };
        found.marks = marks;
        // The ground keeps its origin.
        if part == GROUND {
            return Ok(());
        }
        if mass <= 0.0 {
            return Err(Refusal(format!("{} moves and has no mass", found.body.of)));
        }
        let arm = |at: Point| distance(at, centre).powi(2);
        found.inertia = lumps.iter().map(|(mass, at, inertia)| inertia + mass * arm(*at)).sum();
        if found.inertia < 0.0 {
            return Err(Refusal(format!(
                "{} has a negative inertia about the plane's normal",
                found.body.of
            )));
        }
        (found.mass, found.centre) = (mass, centre);
        Ok(())
    }

    fn closings(&mut self) -> Result<(), Refusal> {
        for closing in &self.robot.closings {
            let parts = closing.bodies.map(|body| self.places[body].0);
            let at = [0, 1].map(|end: usize| self.place(closing.bodies[end], closing.at[end]));
            if parts[0] == parts[1] {
                self.flat.notes.push(idle(&closing.of));
                continue;
            }
            let angle = closing.fixed.map(|fixed| self.kept(closing, &fixed, parts)).transpose()?;
            self.flat.closings.push(Closed { closing, parts, at, angle });
        }
        Ok(())
    }

    /// The angle of the first part against the second that a closing keeps.
    fn kept(&self, closing: &Closing, fixed: &Pose, parts: [usize; 2]) -> Result<f64, Refusal> {
        let plane = self.flat.plane;
        let [first, second] = closing.bodies.map(|body| plane.poses[body].turn);
        // How far the second is turned from where it is drawn to where it is fixed.
        let turn = first.after(&fixed.turn).after(&second.back());
        if dot(turn.apply(plane.normal), plane.normal) < 1.0 - PARALLEL * PARALLEL {
            return Err(Refusal(format!("{} turns its bodies out of the plane {}", closing.of, plane.name)));
        }
        let [x, y] = plane.point(turn.apply(plane.right));
        let [a, b] = parts.map(|part| self.flat.parts[part].angle);
        Ok(a - b - y.atan2(x))
    }

    fn coordinate(&self, name: &str, of: &str) -> Result<usize, Refusal> {
        let found = self.flat.coordinates.iter().position(|coordinate| coordinate.joint.name == name);
        found.ok_or_else(|| {
            Refusal(format!(
                "{of} refers to the joint {}, which does not move or is not there",
                crate::shown(name)
            ))
        })
    }

    fn couplings(&mut self) -> Result<(), Refusal> {
        for coupling in &self.robot.couplings {
            let follower = self.coordinate(&coupling.follower, &coupling.of)?;
            let leader =
                coupling.leader.as_deref().map(|leader| self.coordinate(leader, &coupling.of)).transpose()?;
            self.flat.couplings.push(Coupled { coupling, follower, leader });
        }
        Ok(())
    }

    fn actuators(&mut self) -> Result<(), Refusal> {
        for actuator in &self.robot.actuators {
            let at = self.coordinate(&actuator.joint, &actuator.of)?;
            self.flat.actuators.push((actuator, at));
        }
        Ok(())
    }

    /// The largest distance of a place from the origin of its part, and of a part from that of the plane.
    fn size(&mut self) {
        let held = self.flat.joints.iter().flat_map(|held| held.at);
        let closed = self.flat.closings.iter().flat_map(|closed| closed.at);
        let own = self.flat.parts.iter().flat_map(|part| [part.at, part.centre]);
        let size = held.chain(closed).chain(own).map(|point| distance(point, [0.0; 2])).fold(0.0, f64::max);
        self.flat.size = if size > 0.0 { size } else { 1.0 };
    }
}
