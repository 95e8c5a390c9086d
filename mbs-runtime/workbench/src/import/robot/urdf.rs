//! URDF, the robots of ROS: links, and joints that make a tree of them.
//!
//! The frame of a link is that of the joint above it; all joints are at zero where the file
//! draws them. The link that no joint has as its child is the ground.

use std::collections::BTreeMap;

use roxmltree::Node;

use super::space::{Pose, Rotation, symmetric, unit};
use super::xml::{described, elements, elements_named, exactly, not_negative, parsed};
use super::{Actuator, Body, Coupling, GROUND, Input, Joint, Kind, Lump, Robot};
use crate::import::{Refusal, shown};

/// What a file describes.
pub(super) fn read(text: &str) -> Result<Robot, Refusal> {
    let document = parsed(text, "robot")?;
    let root = document.root_element();
    let gravity = [0.0, 0.0, -9.81];
    let mut reader =
        Reader { robot: Robot::new("ROS (URDF)", root.attribute("name").unwrap_or_default(), gravity) };
    reader.robot.notes.push("the file has no gravity: 9.81 m/s^2 against z is assumed".into());
    let links = links(root)?;
    reader.tree(root, &links)?;
    for node in elements_named(root, "transmission") {
        reader.transmission(node)?;
    }
    for node in elements(root) {
        if let name @ ("gazebo" | "sensor") = node.tag_name().name() {
            reader.robot.lost(described(name, node));
        }
    }
    Ok(reader.robot)
}

type Links<'a, 'i> = BTreeMap<&'a str, Node<'a, 'i>>;

fn links<'a, 'i>(root: Node<'a, 'i>) -> Result<Links<'a, 'i>, Refusal> {
    let mut links = BTreeMap::new();
    for node in elements_named(root, "link") {
        let of = described("link", node);
        let name = node.attribute("name").ok_or_else(|| Refusal(format!("{of} has no `name`")))?;
        if links.insert(name, node).is_some() {
            return Err(Refusal(format!("{of} is there twice")));
        }
    }
    Ok(links)
}

/// An attribute of a part of an element.
fn attribute<'a>(node: Node<'a, '_>, part: &'static str, name: &str) -> Option<&'a str> {
    elements_named(node, part).next().and_then(|part| part.attribute(name))
}

fn number(node: Node<'_, '_>, part: &'static str, name: &str, of: &str) -> Result<Option<f64>, Refusal> {
    let found = attribute(node, part, name).map(|text| exactly::<1>(text, name, of)).transpose()?;
    Ok(found.map(|[number]| number))
}

/// The frame of an `origin`: roll, pitch and yaw turn about axes that do not move.
fn origin(node: Node<'_, '_>, of: &str) -> Result<Pose, Refusal> {
    let at = attribute(node, "origin", "xyz").map_or(Ok([0.0; 3]), |text| exactly(text, "xyz", of))?;
    let angles = attribute(node, "origin", "rpy").map_or(Ok([0.0; 3]), |text| exactly(text, "rpy", of))?;
    Ok(Pose { at, turn: Rotation::of_roll_pitch_yaw(angles) })
}

fn lump(link: Node<'_, '_>, of: &str) -> Result<Option<Lump>, Refusal> {
    let Some(inertial) = elements_named(link, "inertial").next() else { return Ok(None) };
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
struct Edge<'a, 'i> {
    node: Node<'a, 'i>,
    of: String,
    parent: &'a str,
    child: &'a str,
}

impl Reader {
    /// The bodies from the root on.
    fn tree<'a>(&mut self, root: Node<'a, '_>, links: &Links<'a, '_>) -> Result<(), Refusal> {
        let mut edges: Vec<Edge<'a, '_>> = Vec::new();
        for node in elements_named(root, "joint") {
            let edge = edge(node, links)?;
            // others are coupled to joints by their names
            let name = node.attribute("name");
            if name.is_some() && edges.iter().any(|other| other.node.attribute("name") == name) {
                return Err(Refusal(format!("{} is there twice", edge.of)));
            }
            edges.push(edge);
        }
        for (at, edge) in edges.iter().enumerate() {
            if edges.iter().take(at).any(|other| other.child == edge.child) {
                let (of, child) = (&edge.of, shown(edge.child));
                return Err(Refusal(format!(
                    "{of}: its child {child} has another parent already, and URDF has trees alone"
                )));
            }
        }
        let mut roots = links.keys().filter(|link| edges.iter().all(|edge| edge.child != **link));
        let ground = *roots.next().ok_or_else(|| Refusal("no link is the root of a tree".into()))?;
        if let Some(other) = roots.next() {
            let (first, other) = (shown(ground), shown(other));
            return Err(Refusal(format!(
                "the links {first} and {other} hang on no joint: one of them would be the ground"
            )));
        }
        if ground != "world" {
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

    fn body(&mut self, edge: &Edge<'_, '_>, link: Node<'_, '_>, parent: usize) -> Result<usize, Refusal> {
        let of = described("link", link);
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

    fn joints(&mut self, edge: &Edge<'_, '_>) -> Result<Vec<Joint>, Refusal> {
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
        if elements_named(*node, "limit").next().is_some() {
            self.robot.lost(format!("the limits of {of}"));
        }
        Ok(vec![joint])
    }

    fn coupling(&mut self, edge: &Edge<'_, '_>) -> Result<(), Refusal> {
        let Edge { node, of, .. } = edge;
        if elements_named(*node, "mimic").next().is_none() {
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
    fn transmission(&mut self, node: Node<'_, '_>) -> Result<(), Refusal> {
        let of = described("transmission", node);
        let joint = attribute(node, "joint", "name")
            .ok_or_else(|| Refusal(format!("{of} has no `joint` with a name")))?;
        if elements_named(node, "joint").count() > 1 {
            return Err(Refusal(format!("{of} drives more than one joint, which is not imported")));
        }
        let motor = elements_named(node, "actuator").next();
        let name = motor
            .and_then(|motor| motor.attribute("name"))
            .map_or_else(|| format!("{joint}_motor"), str::to_owned);
        let reduction = motor
            .into_iter()
            .chain([node])
            .flat_map(|part| elements_named(part, "mechanicalReduction"))
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

fn edge<'a, 'i>(node: Node<'a, 'i>, links: &Links<'a, 'i>) -> Result<Edge<'a, 'i>, Refusal> {
    let of = described("joint", node);
    let end = |part: &'static str| {
        let name = attribute(node, part, "link")
            .ok_or_else(|| Refusal(format!("{of} has no `{part}` with a link")))?;
        let missing =
            || Refusal(format!("{of} refers to the link {}, which the file does not have", shown(name)));
        links.contains_key(name).then_some(name).ok_or_else(missing)
    };
    let (parent, child) = (end("parent")?, end("child")?);
    Ok(Edge { node, of, parent, child })
}
