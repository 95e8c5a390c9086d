//! The links of a model as a tree of bodies, and what closes its loops.

use std::collections::BTreeMap;

use crate::xml::Node;

use super::frames::{Frames, WORLD};
use super::joints::{Edge, Hold};
use super::links;
use crate::robot::space::{Pose, scaled};

use crate::robot::{Body, Closing, GROUND, Joint, LoopJoint, Mark, Robot};
use crate::{Refusal, shown};

/// The bodies of a model from the ground on.
///
/// # Errors
/// Links that no joint leads to, and links that a ball alone holds.
pub(super) fn grow<'a>(
    model: Node<'a>,
    frames: &Frames<'a>,
    mut edges: Vec<Edge<'a>>,
    robot: &mut Robot,
) -> Result<(), Refusal> {
    let nodes = model.elements_named("link");
    let nodes = nodes.map(|node| (node.attribute("name").unwrap_or_default(), node)).collect();
    let ground = ground(frames, &edges, robot);
    let mut tree = Tree {
        frames,
        nodes,
        bodies: BTreeMap::from([(ground, GROUND)]),
        poses: vec![Pose::NONE],
        moving: vec![false],
    };
    // Links that are fixed to each other are one part, whatever else joins them; a ball closes a
    // loop, and holds no link in a plane.
    edges.sort_by_key(|edge| match edge.hold {
        Hold::Fixed => 0,
        Hold::Moves(_) => 1,
        Hold::Ball => 2,
    });
    while let Some(at) = edges.iter().position(|edge| tree.has(edge.parent) != tree.has(edge.child)) {
        tree.body(edges.remove(at), robot)?;
    }
    if let Some(link) =
        model.elements_named("link").find(|link| link.attribute("name").is_none_or(|name| !tree.has(name)))
    {
        return Err(Refusal(format!(
            "{}: no joint leads from it to {}, which is the ground",
            link.described("link"),
            if ground == WORLD { "the world".into() } else { format!("the link {}", shown(ground)) }
        )));
    }
    edges.into_iter().for_each(|edge| tree.close(edge, robot));
    tree.marks(robot)
}

/// The ground: the world, or the canonical link of a model that no joint holds there.
fn ground<'a>(frames: &Frames<'a>, edges: &[Edge<'a>], robot: &mut Robot) -> &'a str {
    if edges.iter().any(|edge| edge.parent == WORLD) {
        return WORLD;
    }
    let note = format!(
        "no joint leads to the world: the link {} is the ground, which contacts would hold",
        shown(frames.canonical)
    );
    robot.notes.push(note);
    frames.canonical
}

struct Tree<'a, 'r> {
    frames: &'r Frames<'a>,
    nodes: BTreeMap<&'a str, Node<'a>>,
    /// The body of each link that was reached.
    bodies: BTreeMap<&'a str, usize>,
    /// Where the bodies are in the world.
    poses: Vec<Pose>,
    /// True if they move.
    moving: Vec<bool>,
}

impl<'a> Tree<'a, '_> {
    fn has(&self, link: &str) -> bool {
        self.bodies.contains_key(link)
    }

    fn at(&self, link: &str) -> (usize, Pose) {
        let at = self.bodies.get(link).copied().unwrap_or(GROUND);
        (at, self.poses.get(at).copied().unwrap_or(Pose::NONE))
    }

    /// One more link, which hangs on its joint's child or on its parent.
    fn body(&mut self, edge: Edge<'a>, robot: &mut Robot) -> Result<(), Refusal> {
        let is_reversed = self.has(edge.child);
        let (link, above) = if is_reversed { (edge.parent, edge.child) } else { (edge.child, edge.parent) };
        let Some(node) = self.nodes.get(link).copied() else { return Ok(()) };
        let (pose, (parent, around)) = (self.frames.place(link, &edge.of)?, self.at(above));
        let joints = match edge.hold {
            Hold::Fixed => Vec::new(),
            Hold::Moves(joint) => vec![local(joint, &pose, is_reversed)],
            Hold::Ball => {
                return Err(Refusal(format!(
                    "{} is a ball, and no other joint keeps the link {} in a plane",
                    edge.of,
                    shown(link)
                )));
            }
        };
        let moves = !joints.is_empty() || self.moving.get(parent).is_some_and(|moves| *moves);
        let body = links::body(node, parent, pose.seen_from(&around), moves, robot)?;
        let at = robot.body(Body { joints, ..body })?;
        self.bodies.insert(link, at);
        self.poses.push(pose);
        self.moving.push(moves);
        Ok(())
    }

    /// A joint between links that are in the tree already.
    fn close(&self, edge: Edge<'a>, robot: &mut Robot) {
        let ((child, pose), (parent, around)) = (self.at(edge.child), self.at(edge.parent));
        let (bodies, of, name) = ([child, parent], edge.of, edge.name.to_owned());
        let closing = match edge.hold {
            Hold::Moves(joint) => {
                robot.loops.push(LoopJoint { bodies, joint: local(joint, &pose, false) });
                return;
            }
            Hold::Fixed => {
                let fixed = around.seen_from(&pose);
                Closing { name, of, bodies, at: [fixed.at, [0.0; 3]], fixed: Some(fixed) }
            }
            Hold::Ball => {
                let at = [pose, around].map(|body| edge.pose.seen_from(&body).at);
                Closing { name, of, bodies, at, fixed: None }
            }
        };
        robot.closings.push(closing);
    }

    /// Marks the places of the file's frames.
    fn marks(&self, robot: &mut Robot) -> Result<(), Refusal> {
        for mark in self.frames.marks()? {
            let (at, pose) = self.at(mark.link);
            let place = Pose { at: mark.at, ..Pose::NONE }.seen_from(&pose).at;
            let mark =
                Mark { name: mark.name.to_owned(), of: mark.of.to_owned(), at: place, is_shape: false };
            if let Some(body) = robot.bodies.get_mut(at) {
                body.marks.push(mark);
            }
        }
        Ok(())
    }
}

/// A joint of the world in the frame of a body. Of the parent's motion against the child, the
/// coordinate grows the other way round the axis.
fn local(joint: Joint, body: &Pose, is_reversed: bool) -> Joint {
    let axis = body.turn.back().apply(joint.axis);
    let axis = if is_reversed { scaled(axis, -1.0) } else { axis };
    let at = Pose { at: joint.at, ..Pose::NONE }.seen_from(body).at;
    Joint { at, axis, ..joint }
}
