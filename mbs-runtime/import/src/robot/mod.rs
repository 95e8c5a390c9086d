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
mod parts;
mod plane;
mod sdf;
mod space;
mod table;
mod urdf;

use parts::{
    Actuator, Body, Closing, Coupling, GROUND, Input, Joint, Kind, LoopJoint, Lump, MOST_BODIES, Mark, Robot,
    too_many_bodies,
};

use super::Refusal;
use super::declaration::Written;

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
