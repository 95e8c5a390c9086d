//! Links, joints and frames of a model by their names, and where they are.

use std::collections::BTreeMap;

use crate::xml::Node;

use super::values::pose;
use crate::robot::space::{Pose, Vector};

use crate::{Refusal, shown};

/// The name of what does not move.
pub(super) const WORLD: &str = "world";
/// The name of the model's own frame.
const MODEL: &str = "__model__";

/// A model has at most so many links, joints and frames.
const MOST: usize = 1000;

/// A frame by name.
struct Frame<'a> {
    /// In the frame of another name.
    pose: Pose,
    relative_to: &'a str,
    /// The name of what it moves with; its own one of a link.
    attached_to: &'a str,
    of: String,
    kind: &'a str,
}

/// The frames of a model.
pub(super) struct Frames<'a> {
    frames: BTreeMap<&'a str, Frame<'a>>,
    /// The model in the world.
    model: Pose,
    /// The link that the model's own frame moves with.
    pub canonical: &'a str,
}

/// A `frame` of the file, which marks a place of a link.
pub(super) struct Marked<'f> {
    pub name: &'f str,
    pub of: &'f str,
    /// The link that has the place, and where it is in the world.
    pub link: &'f str,
    pub at: Vector,
}

impl<'a> Frames<'a> {
    pub fn read(model: Node<'a>) -> Result<Self, Refusal> {
        let of = model.described("model");
        let first = model.elements_named("link").next().and_then(|link| link.attribute("name"));
        let canonical = model.attribute("canonical_link").filter(|name| !name.is_empty()).or(first);
        let canonical = canonical.ok_or_else(|| Refusal(format!("{of} has no link with a name")))?;
        let mut frames = Self { frames: BTreeMap::new(), model: Pose::NONE, canonical };
        for node in model.elements() {
            if matches!(node.name(), "link" | "joint" | "frame") {
                frames.insert(node)?;
            }
        }
        if !frames.is_link(canonical) {
            return Err(Refusal(format!("{of} has no link {}, its `canonical_link`", shown(canonical))));
        }
        let (pose, relative_to) = pose(model, &of)?;
        if let Some(other) = relative_to.filter(|name| *name != WORLD) {
            return Err(Refusal(format!(
                "{of}: its pose is relative to {}; only `world` is imported there",
                shown(other)
            )));
        }
        // The frame that the pose places may be another one than that of the model.
        let placed = model.attribute("placement_frame").filter(|name| !name.is_empty());
        let placed = placed.map_or(Ok(Pose::NONE), |name| frames.pose(name, &of))?;
        frames.model = pose.of(&Pose::NONE.seen_from(&placed));
        Ok(frames)
    }

    fn insert(&mut self, node: Node<'a>) -> Result<(), Refusal> {
        let kind = node.name();
        let of = node.described(kind);
        let name = node.attribute("name").unwrap_or_default();
        if name.is_empty() {
            return Err(Refusal(format!("{of} has no `name`")));
        }
        if name == WORLD || name == MODEL {
            return Err(Refusal(format!("{of} has a name that SDF keeps for itself")));
        }
        let (pose, relative_to) = pose(node, &of)?;
        let (attached_to, usual) = match kind {
            "link" => (name, MODEL),
            "joint" => {
                let child = super::values::text(node, "child").unwrap_or_default();
                (child, child)
            }
            _ => {
                let to = node.attribute("attached_to").filter(|name| !name.is_empty()).unwrap_or(MODEL);
                (to, to)
            }
        };
        let relative_to = relative_to.unwrap_or(usual);
        // Joints had names of their own until SDF 1.6; a link or a frame is what is referred to.
        match self.frames.get(name) {
            Some(other) if (other.kind == "joint") == (kind == "joint") => {
                return Err(Refusal(format!("{of} has the name of {}", other.of)));
            }
            Some(_) if kind == "joint" => return Ok(()),
            _ => {}
        }
        self.frames.insert(name, Frame { pose, relative_to, attached_to, of, kind });
        match self.frames.len() > MOST {
            true => Err(Refusal(format!(
                "it has more than {MOST} links, joints and frames, which is the most that is imported"
            ))),
            false => Ok(()),
        }
    }

    fn frame(&self, name: &str, of: &str) -> Result<&Frame<'a>, Refusal> {
        let missing = || {
            Refusal(format!("{of} refers to {}, which is no link, joint or frame of the model", shown(name)))
        };
        self.frames.get(name).ok_or_else(missing)
    }

    pub fn is_link(&self, name: &str) -> bool {
        self.frames.get(name).is_some_and(|frame| frame.kind == "link")
    }

    /// Where a frame is in the model; `of` refers to it.
    fn pose(&self, name: &str, of: &str) -> Result<Pose, Refusal> {
        let (mut pose, mut name) = (Pose::NONE, name);
        for _ in 0..=self.frames.len() {
            if name == MODEL {
                return Ok(pose);
            }
            if name == WORLD {
                return Ok(Pose::NONE.seen_from(&self.model).of(&pose));
            }
            let frame = self.frame(name, of)?;
            (pose, name) = (frame.pose.of(&pose), frame.relative_to);
        }
        Err(Refusal(format!("{of}: the poses of frames refer to each other in a circle")))
    }

    /// Where a frame is in the world; `of` refers to it.
    pub fn place(&self, name: &str, of: &str) -> Result<Pose, Refusal> {
        Ok(self.model.of(&self.pose(name, of)?))
    }

    /// Where a joint is in the world, which is relative to its child unless it says otherwise.
    pub fn joint(&self, node: Node<'a>, child: &'a str, of: &str) -> Result<Pose, Refusal> {
        let (pose, relative_to) = pose(node, of)?;
        Ok(self.place(relative_to.unwrap_or(child), of)?.of(&pose))
    }

    /// The link that a frame moves with, or the world; `of` refers to it.
    pub fn link(&self, name: &'a str, of: &str) -> Result<&'a str, Refusal> {
        let mut name = name;
        for _ in 0..=self.frames.len() {
            if name == MODEL {
                return Ok(self.canonical);
            }
            if name == WORLD {
                return Ok(WORLD);
            }
            let frame = self.frame(name, of)?;
            if frame.kind == "link" {
                return Ok(name);
            }
            name = frame.attached_to;
        }
        Err(Refusal(format!("{of}: frames are attached to each other in a circle")))
    }

    /// The places that the file marks.
    pub fn marks(&self) -> Result<Vec<Marked<'_>>, Refusal> {
        let frames = self.frames.iter().filter(|(_, frame)| frame.kind == "frame");
        frames
            .map(|(name, frame)| {
                let (of, link) = (frame.of.as_str(), self.link(name, &frame.of)?);
                Ok(Marked { name, of, link, at: self.place(name, of)?.at })
            })
            .collect()
    }
}
