//! The joints of a model: what they join, what they leave, and which ones follow each other.

use crate::xml::Node;

use super::frames::{Frames, WORLD};
use super::values::{is_set, number, text};
use crate::robot::numbers::{exactly, not_negative};
use crate::robot::space::{Pose, Rotation, Vector, dot, unit};
use crate::robot::{Coupling, Joint, Kind, Robot};
use crate::{Refusal, shown};

/// The version from which an axis is along the frame of its joint; before it was along that of the model.
const AXES_OF_JOINTS: u32 = 5;

/// The version from which an axis names the frame that it is along, if it is not that of its joint.
const AXES_BY_NAME: u32 = 7;

/// A limit from here on is none.
const UNLIMITED: f64 = 1e16;

/// How far directions of length 1 may be apart in their product that are to be the same axis.
const ALONG: f64 = 1e-4;

/// The motion that a joint leaves to its links.
pub(super) enum Hold {
    Fixed,
    /// A hinge or a slide, with its place and its axis in the world.
    Moves(Joint),
    /// A point of both links.
    Ball,
}

/// A joint with the links that it joins.
pub(super) struct Edge<'a> {
    pub name: &'a str,
    pub of: String,
    pub parent: &'a str,
    pub child: &'a str,
    /// Where it is in the world.
    pub pose: Pose,
    pub hold: Hold,
}

/// A reader of joints, with the frames and the version of the file.
struct Reader<'a, 'r> {
    frames: &'r Frames<'a>,
    version: u32,
    robot: &'r mut Robot,
}

/// Reads the joints of a model. Their couplings, and notes on what is lost, go to the robot.
pub(super) fn read<'a>(
    model: Node<'a>,
    frames: &Frames<'a>,
    version: u32,
    robot: &mut Robot,
) -> Result<Vec<Edge<'a>>, Refusal> {
    let mut reader = Reader { frames, version, robot };
    let is_gearbox = |node: &Node<'_>| node.attribute("type") == Some("gearbox");
    let (gearboxes, joints): (Vec<_>, Vec<_>) = model.elements_named("joint").partition(is_gearbox);
    let edges = joints.into_iter().map(|node| reader.edge(node)).collect::<Result<Vec<_>, _>>()?;
    for node in gearboxes {
        reader.gearbox(node, &edges)?;
    }
    Ok(edges)
}

impl<'a> Reader<'a, '_> {
    fn edge(&mut self, node: Node<'a>) -> Result<Edge<'a>, Refusal> {
        let of = node.described("joint");
        let (parent, child) = self.links(node, &of)?;
        let below = text(node, "child").unwrap_or_default();
        let pose = self.frames.joint(node, below, &of)?;
        let hold = self.hold(node, &pose, &of)?;
        Ok(Edge { name: node.attribute("name").unwrap_or("joint"), of, parent, child, pose, hold })
    }

    /// The links that a joint joins, or the world above one.
    fn links(&self, node: Node<'a>, of: &str) -> Result<(&'a str, &'a str), Refusal> {
        let end = |part: &'static str| match text(node, part) {
            None | Some("") => Err(Refusal(format!("{of} has no `{part}`"))),
            Some(name) => match self.frames.link(name, of)? {
                WORLD if part == "child" => Err(Refusal(format!(
                    "{of} has the world as its child; it is the parent, and the link the child"
                ))),
                link => Ok(link),
            },
        };
        let (parent, child) = (end("parent")?, end("child")?);
        match parent == child {
            true => Err(Refusal(format!("{of} joins the link {} with itself", shown(child)))),
            false => Ok((parent, child)),
        }
    }

    fn hold(&mut self, node: Node<'a>, pose: &Pose, of: &str) -> Result<Hold, Refusal> {
        let kind = match node.attribute("type").unwrap_or_default() {
            "fixed" => return Ok(Hold::Fixed),
            "ball" => return Ok(Hold::Ball),
            "revolute" | "continuous" => Kind::Hinge,
            "prismatic" => Kind::Slide,
            "screw" => {
                return Err(Refusal(format!(
                    "{of} is a screw, which slides along the axis about which it turns: it is not planar"
                )));
            }
            other @ ("universal" | "revolute2") => {
                return Err(Refusal(format!("{of} ({other}) turns about two axes: it is not planar")));
            }
            other => {
                return Err(Refusal(format!("{of} is of the type {}, which is not known", shown(other))));
            }
        };
        let axis = node.elements_named("axis").next();
        let axis = axis.ok_or_else(|| Refusal(format!("{of} has no `axis`")))?;
        if self.is_locked(axis, of)? {
            let note = format!("{of} has limits that leave it no motion: it counts as fixed");
            self.robot.notes.push(note);
            return Ok(Hold::Fixed);
        }
        if self.version >= AXES_BY_NAME && is_set(axis, "use_parent_model_frame") {
            let what = "`use_parent_model_frame`, which means nothing since SDF 1.7,";
            self.robot.lost(format!("{what} of {of}"));
        }
        let name = node.attribute("name").unwrap_or("joint").to_owned();
        let direction = self.direction(axis, "axis", pose, of)?;
        let mut joint = Joint::new(name, of.to_owned(), kind, pose.at, direction);
        self.dynamics(axis, &mut joint)?;
        self.mimic(axis, &joint)?;
        Ok(Hold::Moves(joint))
    }

    /// An axis in the world.
    fn direction(&self, axis: Node<'a>, what: &str, pose: &Pose, of: &str) -> Result<Vector, Refusal> {
        let xyz = axis.elements_named("xyz").next();
        let given = match xyz.and_then(|xyz| xyz.text()) {
            Some(text) => exactly(text, "xyz", of)?,
            None => [0.0, 0.0, 1.0],
        };
        let given = unit(given).ok_or_else(|| Refusal(format!("{of}: its `{what}` has no direction")))?;
        let expressed_in = xyz.and_then(|xyz| xyz.attribute("expressed_in")).filter(|name| !name.is_empty());
        // SDF 1.5 and 1.6 have a flag in the place of the attribute.
        let is_flagged = self.version < AXES_BY_NAME && is_set(axis, "use_parent_model_frame");
        let is_of_model = self.version < AXES_OF_JOINTS || is_flagged;
        let turn: Rotation = match expressed_in {
            Some(name) => self.frames.place(name, of)?.turn,
            None if is_of_model => self.frames.place("__model__", of)?.turn,
            None => pose.turn,
        };
        Ok(turn.apply(given))
    }

    /// True if limits leave a joint no motion: files fixed links so before there were fixed joints.
    fn is_locked(&mut self, axis: Node<'a>, of: &str) -> Result<bool, Refusal> {
        let Some(limit) = axis.elements_named("limit").next() else { return Ok(false) };
        let bound = |part: &'static str| -> Result<Option<f64>, Refusal> {
            let Some(text) = text(limit, part) else { return Ok(None) };
            let wrong = || Refusal(format!("{of}: `{part}` has {} in the place of a number", shown(text)));
            // Limits are larger than other numbers may be, where there is none.
            let bound = text.parse::<f64>().ok().filter(|bound| !bound.is_nan()).ok_or_else(wrong)?;
            Ok(Some(bound).filter(|bound| bound.abs() < UNLIMITED))
        };
        let [lower, upper, effort, velocity] =
            [bound("lower")?, bound("upper")?, bound("effort")?, bound("velocity")?];
        if lower == Some(0.0) && upper == Some(0.0) {
            return Ok(true);
        }
        let is_less = |bound: Option<f64>| bound.is_some_and(|bound| bound >= 0.0);
        if lower.is_some() || upper.is_some() || is_less(effort) || is_less(velocity) {
            self.robot.lost(format!("the limits of {of}"));
        }
        Ok(false)
    }

    fn dynamics(&mut self, axis: Node<'a>, joint: &mut Joint) -> Result<(), Refusal> {
        let of = joint.of.as_str();
        if number(axis, "initial_position", of)?.is_some_and(|position| position != 0.0) {
            self.robot.lost(format!("the `initial_position` of {of}: it begins at zero"));
        }
        let Some(dynamics) = axis.elements_named("dynamics").next() else { return Ok(()) };
        let coefficient =
            |part: &'static str| not_negative(number(dynamics, part, of)?.unwrap_or_default(), part, of);
        (joint.damping, joint.stiffness) = (coefficient("damping")?, coefficient("spring_stiffness")?);
        joint.rest = number(dynamics, "spring_reference", of)?.unwrap_or_default();
        if number(dynamics, "friction", of)?.is_some_and(|friction| friction != 0.0) {
            self.robot.lost(format!("the dry friction of {of}"));
        }
        Ok(())
    }

    fn mimic(&mut self, axis: Node<'a>, joint: &Joint) -> Result<(), Refusal> {
        let of = joint.of.as_str();
        let Some(mimic) = axis.elements_named("mimic").next() else { return Ok(()) };
        let leader = mimic.attribute("joint").filter(|name| !name.is_empty());
        let leader = leader.ok_or_else(|| Refusal(format!("{of} has a `mimic` without its `joint`")))?;
        if mimic.attribute("axis").is_some_and(|axis| axis != "axis") {
            return Err(Refusal(format!(
                "{of} mimics another axis than the first one, which is not imported"
            )));
        }
        let factor = number(mimic, "multiplier", of)?.unwrap_or(1.0);
        let offset = number(mimic, "offset", of)?.unwrap_or_default();
        let reference = number(mimic, "reference", of)?.unwrap_or_default();
        let coefficients = vec![offset - factor * reference, factor];
        let coupling = Coupling::mimic(of, joint.name.clone(), leader.to_owned(), coefficients);
        self.robot.couplings.push(coupling);
        Ok(())
    }

    /// Gears between two links: the hinges that each of them has to the reference body follow
    /// each other.
    fn gearbox(&mut self, node: Node<'a>, edges: &[Edge<'a>]) -> Result<(), Refusal> {
        let of = node.described("joint");
        let (parent, child) = self.links(node, &of)?;
        let pose = self.frames.joint(node, text(node, "child").unwrap_or_default(), &of)?;
        let reference = match text(node, "gearbox_reference_body") {
            None | Some("") => return Err(Refusal(format!("{of} has no `gearbox_reference_body`"))),
            Some(name) => self.frames.link(name, &of)?,
        };
        let ratio = number(node, "gearbox_ratio", &of)?.unwrap_or(1.0);
        let hinge = |link: &str, part: &'static str| {
            let axis = node.elements_named(part).next();
            let axis = axis.ok_or_else(|| Refusal(format!("{of} has no `{part}`")))?;
            let direction = self.direction(axis, part, &pose, &of)?;
            hinge(edges, [reference, link], direction).ok_or_else(|| {
                Refusal(format!(
                    "{of}: {} has no hinge about its `{part}` to the reference body {}",
                    shown(link),
                    shown(reference)
                ))
            })
        };
        let ((leader, sign), (follower, other)) = (hinge(parent, "axis")?, hinge(child, "axis2")?);
        self.robot.couplings.push(Coupling {
            name: node.attribute("name").unwrap_or("gearbox").to_owned(),
            of,
            follower: follower.to_owned(),
            leader: Some(leader.to_owned()),
            coefficients: vec![0.0, -ratio * sign * other],
        });
        Ok(())
    }
}

/// The hinge between two links about an axis: its name, and the sign of its coordinate against
/// the turn of the second link about the axis.
fn hinge<'a>(edges: &[Edge<'a>], ends: [&str; 2], axis: Vector) -> Option<(&'a str, f64)> {
    edges.iter().find_map(|edge| {
        let way = match [edge.parent, edge.child] {
            same if same == ends => 1.0,
            [parent, child] if [child, parent] == ends => -1.0,
            _ => return None,
        };
        match &edge.hold {
            Hold::Moves(joint) if joint.kind == Kind::Hinge => {
                let product = dot(joint.axis, axis);
                (product.abs() > 1.0 - ALONG).then_some((edge.name, way * product.signum()))
            }
            _ => None,
        }
    })
}
