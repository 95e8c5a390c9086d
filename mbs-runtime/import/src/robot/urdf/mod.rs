//! URDF, the robots of ROS: links, and joints that make a tree of them.
//!
//! The frame of a link is that of the joint above it; all joints are at zero where the file
//! draws them. The link that no joint has as its child is the ground.

mod table;

use std::collections::BTreeMap;

use super::numbers::{exactly, not_negative, parsed};
use super::space::{Pose, Rotation, symmetric, unit};
use super::table::Table;
use super::{Actuator, Body, Coupling, GROUND, Input, Joint, Kind, Lump, MOST_BODIES, Robot};
use crate::xml::{Document, Node};
use crate::{Refusal, shown};

/// The name of what does not move, with an element of its own or without one.
const WORLD: &str = "world";

/// Reads a file.
pub(super) fn read(text: &str) -> Result<Robot, Refusal> {
    let document = parsed(text, "robot")?;
    let root = document.root();
    let gravity = [0.0, 0.0, -9.81];
    let mut reader =
        Reader { robot: Robot::new("ROS (URDF)", root.attribute("name").unwrap_or_default(), gravity) };
    is_expanded(&document)?;
    reader.robot.notes = Table::new(table::ROWS).check(root, |_| false)?;
    reader.robot.notes.push("the file has no gravity: 9.81 m/s^2 against z is assumed".into());
    let links = links(root)?;
    reader.tree(root, &links)?;
    for node in root.elements_named("transmission") {
        reader.transmission(node)?;
    }
    for node in root.elements() {
        if let name @ ("gazebo" | "sensor") = node.name() {
            reader.robot.lost(node.described(name));
        }
    }
    Ok(reader.robot)
}

/// Refuses formulas that xacro is still to compute.
fn is_expanded(document: &Document<'_>) -> Result<(), Refusal> {
    let is_raw = |text: &&str| text.contains("${") || text.contains("$(");
    for node in document.all() {
        let raw = node.attributes().map(|(_, value)| value).chain(node.text()).find(is_raw);
        if let Some(raw) = raw {
            let of = node.described(node.name());
            return Err(Refusal(format!("{of} has {}; {}", shown(raw), table::RAW)));
        }
    }
    Ok(())
}

type Links<'a> = BTreeMap<&'a str, Node<'a>>;

fn links<'a>(root: Node<'a>) -> Result<Links<'a>, Refusal> {
    let mut links = BTreeMap::new();
    for node in root.elements_named("link") {
        let of = node.described("link");
        let name = node.attribute("name").ok_or_else(|| Refusal(format!("{of} has no `name`")))?;
        if links.insert(name, node).is_some() {
            return Err(Refusal(format!("{of} is there twice")));
        }
    }
    Ok(links)
}

/// An attribute of a part of an element.
fn attribute<'a>(node: Node<'a>, part: &'static str, name: &str) -> Option<&'a str> {
    node.elements_named(part).next().and_then(|part| part.attribute(name))
}

fn number(node: Node<'_>, part: &'static str, name: &str, of: &str) -> Result<Option<f64>, Refusal> {
    let found = attribute(node, part, name).map(|text| exactly::<1>(text, name, of)).transpose()?;
    Ok(found.map(|[number]| number))
}

/// The frame of an `origin`: roll, pitch and yaw turn about axes that do not move.
fn origin(node: Node<'_>, of: &str) -> Result<Pose, Refusal> {
    let at = attribute(node, "origin", "xyz").map_or(Ok([0.0; 3]), |text| exactly(text, "xyz", of))?;
    let angles = attribute(node, "origin", "rpy").map_or(Ok([0.0; 3]), |text| exactly(text, "rpy", of))?;
    Ok(Pose { at, turn: Rotation::of_roll_pitch_yaw(angles) })
}

fn lump(link: Node<'_>, of: &str) -> Result<Option<Lump>, Refusal> {
    let Some(inertial) = link.elements_named("inertial").next() else { return Ok(None) };
    let mass = number(inertial, "mass", "value", of)?
        .ok_or_else(|| Refusal(format!("{of} has no value of its `mass`")))?;
    let mut entries = [0.0; 6];
    for (entry, name) in entries.iter_mut().zip(["ixx", "iyy", "izz", "ixy", "ixz", "iyz"]) {
        *entry = number(inertial, "inertia", name, of)?.unwrap_or_default();
    }
    Lump::new(of, mass, &origin(inertial, of)?, symmetric(entries)).map(Some)
}

struct Reader {
    robot: Robot,
}

/// A joint with the names of the links that it joins.
struct Edge<'a> {
    node: Node<'a>,
    of: String,
    parent: &'a str,
    child: &'a str,
}

impl Reader {
    /// The bodies from the root on.
    fn tree<'a>(&mut self, root: Node<'a>, links: &Links<'a>) -> Result<(), Refusal> {
        let mut edges: Vec<Edge<'a>> = Vec::new();
        for node in root.elements_named("joint") {
            let edge = edge(node, links)?;
            // others are coupled to joints by their names
            let name = node.attribute("name");
            if name.is_some() && edges.iter().any(|other| other.node.attribute("name") == name) {
                return Err(Refusal(format!("{} is there twice", edge.of)));
            }
            edges.push(edge);
            // Each of them has a body.
            if edges.len() > MOST_BODIES {
                return Err(super::too_many_bodies());
            }
        }
        for (at, edge) in edges.iter().enumerate() {
            if edges.iter().take(at).any(|other| other.child == edge.child) {
                let (of, child) = (&edge.of, shown(edge.child));
                return Err(Refusal(format!(
                    "{of}: its child {child} has another parent already, and URDF has trees alone"
                )));
            }
        }
        // The world needs no element of its own.
        let world = edges.iter().map(|edge| edge.parent).find(|parent| *parent == WORLD);
        let world = world.filter(|world| !links.contains_key(world));
        let is_root = |link: &&str| edges.iter().all(|edge| edge.child != *link);
        let mut roots = world.into_iter().chain(links.keys().copied().filter(is_root));
        let ground = roots.next().ok_or_else(|| Refusal("no link is the root of a tree".into()))?;
        if let Some(other) = roots.next() {
            let (first, other) = (shown(ground), shown(other));
            return Err(Refusal(format!(
                "the links {first} and {other} hang on no joint: one of them would be the ground"
            )));
        }
        if ground != WORLD {
            self.robot.notes.push(format!("the link {} is the ground", shown(ground)));
        }
        let mut bodies = BTreeMap::from([(ground, GROUND)]);
        while let Some(at) = edges.iter().position(|edge| bodies.contains_key(edge.parent)) {
            let edge = edges.remove(at);
            let parent = bodies.get(edge.parent).copied().unwrap_or(GROUND);
            let Some(link) = links.get(edge.child) else { continue };
            bodies.insert(edge.child, self.body(&edge, *link, parent)?);
        }
        match edges.first() {
            Some(edge) => {
                Err(Refusal(format!("{} is in a circle of joints, and URDF has trees alone", edge.of)))
            }
            None => Ok(()),
        }
    }

    fn body(&mut self, edge: &Edge<'_>, link: Node<'_>, parent: usize) -> Result<usize, Refusal> {
        let of = link.described("link");
        let joints = self.joints(edge)?;
        self.coupling(edge)?;
        self.robot.body(Body {
            name: edge.child.to_owned(),
            parent,
            pose: origin(edge.node, &edge.of)?,
            joints,
            lumps: lump(link, &of)?.into_iter().collect(),
            marks: Vec::new(),
            of,
        })
    }

    fn joints(&mut self, edge: &Edge<'_>) -> Result<Vec<Joint>, Refusal> {
        let Edge { node, of, .. } = edge;
        let kind = match node.attribute("type").unwrap_or_default() {
            "fixed" => return Ok(Vec::new()),
            "revolute" | "continuous" => Kind::Hinge,
            "prismatic" => Kind::Slide,
            "floating" => {
                return Err(Refusal(format!("{of} lets its link move through space: it is not planar")));
            }
            other => {
                return Err(Refusal(format!("{of} is of the type {}, which is not imported", shown(other))));
            }
        };
        let axis =
            attribute(*node, "axis", "xyz").map_or(Ok([1.0, 0.0, 0.0]), |text| exactly(text, "xyz", of))?;
        let axis = unit(axis).ok_or_else(|| Refusal(format!("{of}: its `axis` has no direction")))?;
        let name = node.attribute("name").unwrap_or("joint").to_owned();
        let mut joint = Joint::new(name, of.clone(), kind, [0.0; 3], axis);
        let damping = number(*node, "dynamics", "damping", of)?.unwrap_or_default();
        joint.damping = not_negative(damping, "damping", of)?;
        if number(*node, "dynamics", "friction", of)?.is_some_and(|friction| friction != 0.0) {
            self.robot.lost(format!("the dry friction of {of}"));
        }
        if node.elements_named("limit").next().is_some() {
            self.robot.lost(format!("the limits of {of}"));
        }
        Ok(vec![joint])
    }

    fn coupling(&mut self, edge: &Edge<'_>) -> Result<(), Refusal> {
        let Edge { node, of, .. } = edge;
        if node.elements_named("mimic").next().is_none() {
            return Ok(());
        }
        let leader = attribute(*node, "mimic", "joint");
        let leader =
            leader.ok_or_else(|| Refusal(format!("{of} has a `mimic` without its `joint`")))?.to_owned();
        let factor = number(*node, "mimic", "multiplier", of)?.unwrap_or(1.0);
        let offset = number(*node, "mimic", "offset", of)?.unwrap_or_default();
        let follower = node.attribute("name").unwrap_or("joint").to_owned();
        self.robot.couplings.push(Coupling::mimic(of, follower, leader, vec![offset, factor]));
        Ok(())
    }

    /// A motor at a joint.
    fn transmission(&mut self, node: Node<'_>) -> Result<(), Refusal> {
        let of = node.described("transmission");
        let joint = attribute(node, "joint", "name")
            .ok_or_else(|| Refusal(format!("{of} has no `joint` with a name")))?;
        if node.elements_named("joint").count() > 1 {
            return Err(Refusal(format!("{of} drives more than one joint, which is not imported")));
        }
        let motor = node.elements_named("actuator").next();
        let name = motor
            .and_then(|motor| motor.attribute("name"))
            .map_or_else(|| format!("{joint}_motor"), str::to_owned);
        let reduction = motor
            .into_iter()
            .chain([node])
            .flat_map(|part| part.elements_named("mechanicalReduction"))
            .next();
        let gear = match reduction.and_then(|reduction| reduction.text()) {
            Some(text) => exactly::<1>(text, "mechanicalReduction", &of)?[0],
            None => 1.0,
        };
        let joint = joint.to_owned();
        self.robot.actuators.push(Actuator {
            name,
            of,
            joint,
            gear,
            gain: 1.0,
            bias: [0.0; 3],
            input: Input::Effort,
        });
        Ok(())
    }
}

fn edge<'a>(node: Node<'a>, links: &Links<'a>) -> Result<Edge<'a>, Refusal> {
    let of = node.described("joint");
    let end = |part: &'static str| {
        let name = attribute(node, part, "link")
            .ok_or_else(|| Refusal(format!("{of} has no `{part}` with a link")))?;
        let missing =
            || Refusal(format!("{of} refers to the link {}, which the file does not have", shown(name)));
        let is_world = part == "parent" && name == WORLD;
        (is_world || links.contains_key(name)).then_some(name).ok_or_else(missing)
    };
    let (parent, child) = (end("parent")?, end("child")?);
    Ok(Edge { node, of, parent, child })
}
