//! SDF, the models of Gazebo: links that have poses in a model, and joints between any two.
//!
//! All joints are at zero where the file draws them. Joints may close loops: a tree is made of
//! the first ones that reach each link, and the others join what it has already.

mod frames;
mod joints;
mod links;
mod scene;
mod table;
mod tree;
mod values;

use crate::xml::Node;

use super::numbers::parsed;
use super::table::Table;
use super::{Actuator, Input, Robot};
use crate::{Refusal, shown};
use frames::Frames;
use scene::Scene;
use values::{is_set, text};

/// The oldest version that is read: older ones have another root.
const OLDEST: u32 = 3;

/// Reads a file.
pub(super) fn read(text: &str, model: Option<&str>) -> Result<Robot, Refusal> {
    let document = parsed(text, "sdf")?;
    let root = document.root();
    let version = version(root)?;
    let Scene { model, gravity, notes } = scene::read(root, model)?;
    let is_other = |node: Node<'_>| node.name() == "model" && node.at != model.at;
    let left = Table::new(table::ROWS).check(root, is_other)?;
    let mut robot = Robot::new("Gazebo (SDF)", model.attribute("name").unwrap_or_default(), gravity);
    robot.notes = left;
    robot.notes.extend(notes);
    check(model, &mut robot)?;
    let frames = Frames::read(model)?;
    links::gravity(model, &mut robot)?;
    let edges = joints::read(model, &frames, version, &mut robot)?;
    tree::grow(model, &frames, edges, &mut robot)?;
    for node in model.elements() {
        extra(node, &mut robot)?;
    }
    Ok(robot)
}

/// The second number of `version`; the first one is 1.
fn version(root: Node<'_>) -> Result<u32, Refusal> {
    let version = root.attribute("version").ok_or_else(|| Refusal("the sdf has no `version`".into()))?;
    let minor = version.trim().strip_prefix("1.").and_then(|minor| minor.parse().ok());
    minor.filter(|minor| *minor >= OLDEST).ok_or_else(|| {
        Refusal(format!(
            "the sdf is of the version {}; those from 1.{OLDEST} on are imported",
            shown(version.trim())
        ))
    })
}

/// Refuses models that are more than links and joints.
fn check(model: Node<'_>, robot: &mut Robot) -> Result<(), Refusal> {
    if is_set(model, "static") {
        let of = model.described("model");
        return Err(Refusal(format!("{of} is static: nothing in it moves")));
    }
    for node in model.elements() {
        match node.name() {
            "include" => return Err(scene::include(node)),
            "model" => {
                let of = node.described("model");
                return Err(Refusal(format!(
                    "{of} is in another model, which is not imported; its links and joints may stand in that one"
                )));
            }
            _ => {}
        }
    }
    let is_solid = |link: Node<'_>| link.elements_named("collision").next().is_some();
    if model.elements_named("link").any(is_solid) {
        robot.lost("contacts: bodies pass through each other");
    }
    Ok(())
}

/// Reads the plugins, grippers and sensors of a model. A plugin for a joint's effort becomes an actuator; the
/// others are noted as not carried over.
fn extra(node: Node<'_>, robot: &mut Robot) -> Result<(), Refusal> {
    let name = node.name();
    let of = node.described(name);
    let is_effort = node.attribute("name").is_some_and(|name| name.ends_with("ApplyJointForce"));
    match (name, text(node, "joint_name")) {
        ("plugin", Some(joint)) if is_effort => {
            let (name, joint) = (format!("{joint}_effort"), joint.to_owned());
            let (gear, gain, bias) = (1.0, 1.0, [0.0; 3]);
            robot.actuators.push(Actuator { name, of, joint, gear, gain, bias, input: Input::Effort });
        }
        ("plugin" | "gripper", _) => robot.lost(of),
        ("link" | "joint", _) => {
            for sensor in node.elements_named("sensor") {
                robot.lost(sensor.described("sensor"));
            }
        }
        _ => {}
    }
    Ok(())
}
