//! A robot as readers give it: bodies with what joins and drives them.

use super::space::{Matrix, Pose, Vector};
use crate::Refusal;

/// The body that does not move, among those of a [`Robot`].
pub(super) const GROUND: usize = 0;

/// A mechanism is at most this large: compiling takes seconds then.
pub(super) const MOST_BODIES: usize = 200;

/// Joints that close loops, couplings and actuators together are at most so many.
const MOST_TIES: usize = 1000;

/// A tree of bodies with what moves, closes and drives it, in SI units.
#[derive(Debug)]
pub(super) struct Robot {
    /// Its name in the file.
    pub name: String,
    /// The program whose file it is.
    pub program: &'static str,
    pub gravity: Vector,
    /// The first one is the ground; each of the others comes after its parent.
    pub bodies: Vec<Body>,
    pub loops: Vec<LoopJoint>,
    pub closings: Vec<Closing>,
    pub couplings: Vec<Coupling>,
    pub actuators: Vec<Actuator>,
    /// Notes on what was assumed, and on what was not carried over.
    pub notes: Vec<String>,
}

/// A body, where it is while all of its joints are at their reference.
#[derive(Debug)]
pub(super) struct Body {
    pub name: String,
    /// Its name in messages, in the words of the file.
    pub of: String,
    pub parent: usize,
    /// Its frame in that of the parent.
    pub pose: Pose,
    /// The joints between the body and its parent, the first one at the parent; without any it is fixed to
    /// it.
    pub joints: Vec<Joint>,
    pub lumps: Vec<Lump>,
    pub marks: Vec<Mark>,
}

/// A mass with its inertia about its own centre, along the axes of the body.
#[derive(Debug)]
pub(super) struct Lump {
    pub mass: f64,
    pub at: Vector,
    pub inertia: Matrix,
}

impl Lump {
    /// Of a part of a file: its centre and the axes of its inertia as a frame of the body.
    ///
    /// # Errors
    /// A negative mass.
    pub fn new(of: &str, mass: f64, pose: &Pose, inertia: Matrix) -> Result<Self, Refusal> {
        if mass < 0.0 {
            return Err(Refusal(format!("{of} has a negative mass")));
        }
        Ok(Self { mass, at: pose.at, inertia: pose.turn.tensor(inertia) })
    }
}

/// A place of a body that has a name.
#[derive(Debug)]
pub(super) struct Mark {
    pub name: String,
    pub of: String,
    pub at: Vector,
    /// True if it only gives the body a shape, and may be left out of a body that has one.
    pub is_shape: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Hinge,
    Slide,
}

/// One degree of freedom between a body and its parent, in the frame of the body.
#[derive(Debug)]
pub(super) struct Joint {
    pub name: String,
    pub of: String,
    pub kind: Kind,
    pub at: Vector,
    pub axis: Vector,
    /// The joint's coordinate where the file draws the body.
    pub reference: f64,
    pub stiffness: f64,
    /// The coordinate at which the spring is at rest.
    pub rest: f64,
    pub damping: f64,
    /// Inertia that turns with the coordinate, as of a rotor behind a gear.
    pub armature: f64,
}

impl Joint {
    pub fn new(name: String, of: String, kind: Kind, at: Vector, axis: Vector) -> Self {
        let [reference, stiffness, rest, damping, armature] = [0.0; 5];
        Self { name, of, kind, at, axis, reference, stiffness, rest, damping, armature }
    }
}

/// A joint between two bodies that the tree joins already, with a coordinate as those of the tree.
#[derive(Debug)]
pub(super) struct LoopJoint {
    /// The one that moves along the coordinate, and the one that counts as its parent.
    pub bodies: [usize; 2],
    /// In the frame of the first one.
    pub joint: Joint,
}

/// A tie that closes a loop and has no coordinate: a place of each of two bodies.
#[derive(Debug)]
pub(super) struct Closing {
    pub name: String,
    pub of: String,
    pub bodies: [usize; 2],
    pub at: [Vector; 2],
    /// The frame of the second body in that of the first one, where they keep their angle.
    pub fixed: Option<Pose>,
}

/// A joint's coordinate as a polynomial of another one's: y - y0 = Σ cᵢ (x - x0)ⁱ.
#[derive(Debug)]
pub(super) struct Coupling {
    pub name: String,
    pub of: String,
    /// The name of the joint that follows.
    pub follower: String,
    pub leader: Option<String>,
    pub coefficients: Vec<f64>,
}

impl Coupling {
    /// Of a joint that says itself which one it follows.
    pub fn mimic(of: &str, follower: String, leader: String, coefficients: Vec<f64>) -> Self {
        let name = format!("{follower}_mimic");
        Self { name, of: of.to_owned(), follower, leader: Some(leader), coefficients }
    }
}

/// An actuator of a joint: its effort is gear (gain u + b0 + b1 gear q + b2 gear q̇).
#[derive(Debug)]
pub(super) struct Actuator {
    pub name: String,
    pub of: String,
    pub joint: String,
    pub gear: f64,
    pub gain: f64,
    pub bias: [f64; 3],
    /// The kind of its input u.
    pub input: Input,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Input {
    Effort,
    Position,
    Velocity,
    Number,
}

impl Robot {
    pub fn new(program: &'static str, name: &str, gravity: Vector) -> Self {
        let ground = Body {
            name: "ground".into(),
            of: "the ground".into(),
            parent: GROUND,
            pose: Pose::NONE,
            joints: Vec::new(),
            lumps: Vec::new(),
            marks: Vec::new(),
        };
        Self {
            name: name.into(),
            program,
            gravity,
            bodies: vec![ground],
            loops: Vec::new(),
            closings: Vec::new(),
            couplings: Vec::new(),
            actuators: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// One more body.
    ///
    /// # Errors
    /// One too many.
    pub fn body(&mut self, body: Body) -> Result<usize, Refusal> {
        if self.bodies.len() > MOST_BODIES {
            return Err(too_many_bodies());
        }
        self.bodies.push(body);
        Ok(self.bodies.len() - 1)
    }

    /// Refuses a robot that has too many ties, so that readers look through few of them.
    ///
    /// # Errors
    /// One too many.
    pub fn is_limited(&self) -> Result<(), Refusal> {
        let ties = [self.loops.len(), self.closings.len(), self.couplings.len(), self.actuators.len()];
        match ties.iter().sum::<usize>() > MOST_TIES {
            true => Err(Refusal(format!(
                "it has more than {MOST_TIES} closed loops, couplings and actuators, which is the most that is imported"
            ))),
            false => Ok(()),
        }
    }

    pub fn lost(&mut self, what: impl AsRef<str>) {
        self.notes.push(format!("not carried over: {}", what.as_ref()));
    }
}

pub(super) fn too_many_bodies() -> Refusal {
    Refusal(format!("it has more than {MOST_BODIES} bodies, which is the most that is imported"))
}
