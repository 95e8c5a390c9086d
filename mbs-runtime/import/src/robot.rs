//! Files of robots, trees of bodies in space, as planar mechanisms.
//!
//! A reader makes a [`Robot`] of a file. [`plane`] finds the plane in which it moves and
//! [`flat`] lays it into that plane; what moves across it is refused. [`declaration`] writes
//! the rest in the language.
//!
//! # How it works
//!
//! * `mjcf`, `urdf` and `sdf` are the readers. Each element and attribute of a format stands in a table:
//!   read, noted or refused (`table`).
//! * `plane` finds the plane across the axes of the hinges.
//! * `flat` joins bodies that are fixed to each other.
//! * `freedom` counts degrees of freedom as `mobility` does for linkages.
//!
//! A statement of a file that the language lacks is refused if the mechanism would be another one without
//! it. Else it becomes a comment. Tests compare accelerations and motions with numbers that MuJoCo and Drake
//! compute of the same files.

mod declaration;
mod digits;
mod efforts;
mod flat;
mod freedom;
mod mjcf;
mod numbers;
mod plane;
mod sdf;
mod space;
mod table;
mod urdf;

use space::{Matrix, Pose, Vector};

use super::Refusal;
use super::declaration::Written;

/// The body that does not move, among those of a [`Robot`].
const GROUND: usize = 0;

/// A mechanism is at most this large: compiling takes seconds then.
const MOST_BODIES: usize = 200;

/// Joints that close loops, couplings and actuators together are at most so many.
const MOST_TIES: usize = 1000;

/// A tree of bodies with what moves, closes and drives it, in SI units.
#[derive(Debug)]
struct Robot {
    /// Its name in the file.
    name: String,
    /// The program whose file it is.
    program: &'static str,
    gravity: Vector,
    /// The first one is the ground; each of the others comes after its parent.
    bodies: Vec<Body>,
    loops: Vec<LoopJoint>,
    closings: Vec<Closing>,
    couplings: Vec<Coupling>,
    actuators: Vec<Actuator>,
    /// Notes on what was assumed, and on what was not carried over.
    notes: Vec<String>,
}

/// A body, where it is while all of its joints are at their reference.
#[derive(Debug)]
struct Body {
    name: String,
    /// Its name in messages, in the words of the file.
    of: String,
    parent: usize,
    /// Its frame in that of the parent.
    pose: Pose,
    /// The joints between the body and its parent, the first one at the parent; without any it is fixed to
    /// it.
    joints: Vec<Joint>,
    lumps: Vec<Lump>,
    marks: Vec<Mark>,
}

/// A mass with its inertia about its own centre, along the axes of the body.
#[derive(Debug)]
struct Lump {
    mass: f64,
    at: Vector,
    inertia: Matrix,
}

impl Lump {
    /// Of a part of a file: its centre and the axes of its inertia as a frame of the body.
    ///
    /// # Errors
    /// A negative mass.
    fn new(of: &str, mass: f64, pose: &Pose, inertia: Matrix) -> Result<Self, Refusal> {
        if mass < 0.0 {
            return Err(Refusal(format!("{of} has a negative mass")));
        }
        Ok(Self { mass, at: pose.at, inertia: pose.turn.tensor(inertia) })
    }
}

/// A place of a body that has a name.
#[derive(Debug)]
struct Mark {
    name: String,
    of: String,
    at: Vector,
    /// Whether it only gives the body a shape, and may be left out of a body that has one.
    is_shape: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Hinge,
    Slide,
}

/// One degree of freedom between a body and its parent, in the frame of the body.
#[derive(Debug)]
struct Joint {
    name: String,
    of: String,
    kind: Kind,
    at: Vector,
    axis: Vector,
    /// The joint's coordinate where the file draws the body.
    reference: f64,
    stiffness: f64,
    /// The coordinate at which the spring is at rest.
    rest: f64,
    damping: f64,
    /// Inertia that turns with the coordinate, as of a rotor behind a gear.
    armature: f64,
}

impl Joint {
    fn new(name: String, of: String, kind: Kind, at: Vector, axis: Vector) -> Self {
        let [reference, stiffness, rest, damping, armature] = [0.0; 5];
        Self { name, of, kind, at, axis, reference, stiffness, rest, damping, armature }
    }
}

/// A joint between two bodies that the tree joins already, with a coordinate as those of the tree.
#[derive(Debug)]
struct LoopJoint {
    /// The one that moves along the coordinate, and the one that counts as its parent.
    bodies: [usize; 2],
    /// In the frame of the first one.
    joint: Joint,
}

/// A tie that closes a loop and has no coordinate: a place of each of two bodies.
#[derive(Debug)]
struct Closing {
    name: String,
    of: String,
    bodies: [usize; 2],
    at: [Vector; 2],
    /// The frame of the second body in that of the first one, where they keep their angle.
    fixed: Option<Pose>,
}

/// A joint's coordinate as a polynomial of another one's: y - y0 = Σ cᵢ (x - x0)ⁱ.
#[derive(Debug)]
struct Coupling {
    name: String,
    of: String,
    /// The name of the joint that follows.
    follower: String,
    leader: Option<String>,
    coefficients: Vec<f64>,
}

impl Coupling {
    /// Of a joint that says itself which one it follows.
    fn mimic(of: &str, follower: String, leader: String, coefficients: Vec<f64>) -> Self {
        let name = format!("{follower}_mimic");
        Self { name, of: of.to_owned(), follower, leader: Some(leader), coefficients }
    }
}

/// An actuator of a joint: its effort is gear (gain u + b0 + b1 gear q + b2 gear q̇).
#[derive(Debug)]
struct Actuator {
    name: String,
    of: String,
    joint: String,
    gear: f64,
    gain: f64,
    bias: [f64; 3],
    /// The kind of its input u.
    input: Input,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Input {
    Effort,
    Position,
    Velocity,
    Number,
}

impl Robot {
    fn new(program: &'static str, name: &str, gravity: Vector) -> Self {
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
    fn body(&mut self, body: Body) -> Result<usize, Refusal> {
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
    fn is_limited(&self) -> Result<(), Refusal> {
        let ties = [self.loops.len(), self.closings.len(), self.couplings.len(), self.actuators.len()];
        match ties.iter().sum::<usize>() > MOST_TIES {
            true => Err(Refusal(format!(
                "it has more than {MOST_TIES} closed loops, couplings and actuators, which is the most that is imported"
            ))),
            false => Ok(()),
        }
    }

    fn lost(&mut self, what: impl AsRef<str>) {
        self.notes.push(format!("not carried over: {}", what.as_ref()));
    }
}

fn too_many_bodies() -> Refusal {
    Refusal(format!("it has more than {MOST_BODIES} bodies, which is the most that is imported"))
}

/// The declaration of what a file of MuJoCo describes, and its notes.
pub(super) fn of_mjcf(text: &str, file: &str) -> Result<(Written, Vec<String>), Refusal> {
    written(mjcf::read(text)?, file)
}

/// The declaration of what a file of URDF describes, and its notes.
pub(super) fn of_urdf(text: &str, file: &str) -> Result<(Written, Vec<String>), Refusal> {
    written(urdf::read(text)?, file)
}

/// The declaration of what a file of SDF describes, or one of its models, and its notes.
pub(super) fn of_sdf(text: &str, file: &str, model: Option<&str>) -> Result<(Written, Vec<String>), Refusal> {
    written(sdf::read(text, model)?, file)
}

fn written(mut robot: Robot, file: &str) -> Result<(Written, Vec<String>), Refusal> {
    robot.is_limited()?;
    let plane = plane::of(&mut robot)?;
    let flat = flat::laid(&robot, &plane)?;
    let mut notes = robot.notes.clone();
    notes.extend(flat.notes.iter().cloned());
    Ok((declaration::written(&flat, &notes, robot.program, &robot.name, file)?, notes))
}
