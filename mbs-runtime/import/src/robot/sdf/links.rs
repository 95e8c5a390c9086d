//! Masses of links, and whether gravity acts on them.

use crate::xml::Node;

use super::values::{is_set, number, pose, text};
use crate::Refusal;
use crate::robot::space::{Pose, symmetric};

use crate::robot::{Body, Lump, Robot};

/// The entries of an inertia, with what they are in a file that does not say them.
const ENTRIES: [(&str, f64); 6] =
    [("ixx", 1.0), ("iyy", 1.0), ("izz", 1.0), ("ixy", 0.0), ("ixz", 0.0), ("iyz", 0.0)];

/// Takes the gravity away from all links that are without it, or from none.
pub(super) fn gravity(model: Node<'_>, robot: &mut Robot) -> Result<(), Refusal> {
    let floats = |link: &Node<'_>| text(*link, "gravity").is_some() && !is_set(*link, "gravity");
    let links: Vec<_> = model.elements_named("link").collect();
    let Some(floating) = links.iter().find(|link| floats(link)) else { return Ok(()) };
    let held = links.iter().find(|link| !floats(link));
    match held.filter(|_| robot.gravity != [0.0; 3]) {
        Some(held) => Err(Refusal(format!(
            "{} is without gravity and {} is not, which is not imported; all links or none are",
            floating.described("link"),
            held.described("link")
        ))),
        None => {
            robot.gravity = [0.0; 3];
            Ok(())
        }
    }
}

/// A link as a body that has no joints yet. One that does not move needs no mass.
pub(super) fn body(
    node: Node<'_>,
    parent: usize,
    pose: Pose,
    moves: bool,
    robot: &mut Robot,
) -> Result<Body, Refusal> {
    let of = node.described("link");
    if is_set(node, "kinematic") {
        return Err(Refusal(format!("{of} is moved from outside (`kinematic`), which is not imported")));
    }
    if node.elements_named("velocity_decay").next().is_some() {
        robot.lost(format!("the `velocity_decay` of {of}"));
    }
    let lumps = if moves { vec![lump(node, &of, robot)?] } else { Vec::new() };
    let name = node.attribute("name").unwrap_or("link").to_owned();
    Ok(Body { name, of, parent, pose, joints: Vec::new(), lumps, marks: Vec::new() })
}

/// The mass of a link. As SDF has it, a mass and moments of inertia that the file does not say are 1, and
/// products of inertia 0.
fn lump(link: Node<'_>, of: &str, robot: &mut Robot) -> Result<Lump, Refusal> {
    let inertial = link.elements_named("inertial").next();
    if inertial.and_then(|inertial| inertial.attribute("auto")).is_some_and(super::values::is_true) {
        return Err(Refusal(format!(
            "{of} has the inertia of its shapes (`auto`), which is not imported; numbers may stand there"
        )));
    }
    if let Some(fluid) = inertial.and_then(|node| node.elements_named("fluid_added_mass").next()) {
        return Err(Refusal(format!("{of}: {} is not imported", fluid.described("fluid_added_mass"))));
    }
    let mass = inertial.map_or(Ok(None), |node| number(node, "mass", of))?;
    let inertia = inertial.and_then(|node| node.elements_named("inertia").next());
    let said = match (mass, inertia) {
        (None, None) => "a mass of 1 kg and inertias of 1 kg*m^2",
        (None, Some(_)) => "a mass of 1 kg",
        (Some(_), None) => "inertias of 1 kg*m^2",
        (Some(_), Some(_)) => "",
    };
    if !said.is_empty() {
        robot.notes.push(format!("{of} has {said}, which SDF gives to a link that says nothing else"));
    }
    let mut entries = [0.0; 6];
    for (entry, (name, usual)) in entries.iter_mut().zip(ENTRIES) {
        *entry = inertia.map_or(Ok(None), |inertia| number(inertia, name, of))?.unwrap_or(usual);
    }
    let frame = inertial.map_or(Ok(Pose::NONE), |inertial| pose(inertial, of).map(|(pose, _)| pose))?;
    Lump::new(of, mass.unwrap_or(1.0), &frame, symmetric(entries))
}
