//! MJCF, the models of MuJoCo: nested bodies with joints, geoms that give masses, equalities
//! that close loops, and actuators.
//!
//! A body is drawn where it is while its joints are at their `ref`. Angles are in degrees
//! unless the compiler's `angle` says otherwise.

mod classes;
mod drives;
mod laws;
mod mass;
mod settings;
mod table;

use crate::xml::Node;

use std::collections::BTreeMap;

use super::numbers::parsed;
use super::space::{Pose, unit};
use super::table::Table;
use super::{Body, GROUND, Joint, Kind, Mark, Robot};
use crate::Refusal;
use classes::{Classes, Element};
use settings::Settings;

/// Reads a file.
pub(super) fn read(text: &str) -> Result<Robot, Refusal> {
    let document = parsed(text, "mujoco")?;
    let root = document.root();
    let mut robot = Robot::new("MuJoCo", root.attribute("model").unwrap_or_default(), [0.0; 3]);
    let table = Table::new(table::ROWS);
    robot.notes = table.check(root, |_| false)?;
    let settings = settings::read(root, &mut robot)?;
    let classes = Classes::read(root, table)?;
    let mut reader = Reader { robot, settings, classes, has_geoms: false, capped: BTreeMap::new() };
    for world in root.elements_named("worldbody") {
        reader.inside(world, GROUND, None)?;
    }
    reader.scale();
    for section in root.elements_named("equality") {
        if reader.settings.has_equalities {
            reader.equalities(section)?;
        } else {
            reader.robot.lost(format!("{}: a flag takes it away", section.described("equality")));
        }
    }
    for section in root.elements_named("actuator") {
        reader.actuators(section)?;
    }
    if reader.has_geoms && reader.settings.has_contacts {
        reader.robot.lost("contacts: bodies pass through each other");
    }
    Ok(reader.robot)
}

struct Reader<'a> {
    robot: Robot,
    settings: Settings,
    classes: Classes<'a>,
    /// Joints whose actuators have limits together, as they are in messages.
    capped: BTreeMap<String, String>,
    /// True if there are geoms that could touch.
    has_geoms: bool,
}

impl<'a> Reader<'a> {
    fn element(
        &self,
        node: Node<'a>,
        kind: &'static str,
        inherited: Option<&'a str>,
    ) -> Result<Element<'a, '_>, Refusal> {
        self.classes.element(node, kind, inherited)
    }

    /// Gives the bodies the mass that the file wants of all together.
    fn scale(&mut self) {
        let total: f64 = self.robot.bodies.iter().flat_map(|body| &body.lumps).map(|lump| lump.mass).sum();
        let Some(wanted) = self.settings.total_mass.filter(|_| total > 0.0) else { return };
        for lump in self.robot.bodies.iter_mut().flat_map(|body| &mut body.lumps) {
            lump.mass *= wanted / total;
            lump.inertia = lump.inertia.map(|row| row.map(|entry| entry * wanted / total));
        }
    }

    /// Reads the contents of a body. Each body comes before those in it, and there are not many, so that
    /// these calls do not nest deeply.
    fn inside(&mut self, node: Node<'a>, at: usize, inherited: Option<&'a str>) -> Result<(), Refusal> {
        let inherited = node.attribute("childclass").or(inherited);
        self.masses(node, at, inherited)?;
        for child in node.elements() {
            match child.name() {
                "body" => self.body(child, at, inherited)?,
                "joint" => self.joint(child, at, inherited)?,
                "freejoint" => return Err(free(child)),
                "site" => self.site(child, at, inherited)?,
                "geom" | "inertial" | "camera" | "light" => {}
                other => return Err(Refusal(format!("{} is not imported", child.described(other)))),
            }
        }
        Ok(())
    }

    fn body(&mut self, node: Node<'a>, parent: usize, inherited: Option<&'a str>) -> Result<(), Refusal> {
        let of = node.described("body");
        let inherited = node.attribute("childclass").or(inherited);
        // A body has no defaults; its own attributes are read as those of the others.
        let element = self.element(node, "body", None)?;
        let pose =
            Pose { at: element.vector("pos")?.unwrap_or_default(), turn: element.turn(&self.settings)? };
        let name = match node.attribute("name").unwrap_or_default() {
            "" => "body".to_owned(),
            name => name.to_owned(),
        };
        let (joints, lumps, marks) = (Vec::new(), Vec::new(), Vec::new());
        let at = self.robot.body(Body { name, of, parent, pose, joints, lumps, marks })?;
        self.inside(node, at, inherited)
    }

    fn joint(&mut self, node: Node<'a>, at: usize, inherited: Option<&'a str>) -> Result<(), Refusal> {
        let of = node.described("joint");
        if at == GROUND {
            return Err(Refusal(format!("{of} is on the ground, which does not move")));
        }
        let element = self.element(node, "joint", inherited)?;
        let kind = match element.get("type").unwrap_or("hinge") {
            "hinge" => Kind::Hinge,
            "slide" => Kind::Slide,
            "free" => return Err(free(node)),
            "ball" => {
                return Err(Refusal(format!(
                    "{of} is a ball, which turns about every axis: it is not planar"
                )));
            }
            other => {
                return Err(Refusal(format!(
                    "{of} is of the type `{}`, which is not known",
                    other.escape_debug()
                )));
            }
        };
        let axis = element.vector("axis")?.unwrap_or([0.0, 0.0, 1.0]);
        let axis = unit(axis).ok_or_else(|| Refusal(format!("{of}: its `axis` has no direction")))?;
        let body = &self.robot.bodies[at];
        let name = match node.attribute("name").unwrap_or_default() {
            "" => format!("{}_{}", body.name, if kind == Kind::Hinge { "hinge" } else { "slide" }),
            name => name.to_owned(),
        };
        // The coordinate of a slide is a length: no unit of angles applies to it.
        let travel = |value: f64| if kind == Kind::Hinge { self.settings.angle(value) } else { value };
        let mut joint = Joint::new(name, of.clone(), kind, element.vector("pos")?.unwrap_or_default(), axis);
        joint.reference = travel(element.number("ref")?.unwrap_or_default());
        joint.rest = travel(element.number("springref")?.unwrap_or_default());
        joint.stiffness = element.coefficient("stiffness")?;
        joint.damping = element.coefficient("damping")?;
        joint.armature = element.number("armature")?.unwrap_or_default();
        let is_limited = element.get("limited").is_none_or(|limited| limited != "false");
        let has_range = is_limited && element.list("range")?.iter().any(|number| *number != 0.0);
        let rubs = element.number("frictionloss")?.is_some_and(|loss| loss != 0.0);
        let is_capped = element.get("actuatorfrclimited").is_none_or(|limited| limited != "false");
        if is_capped && element.list("actuatorfrcrange")?.iter().any(|number| *number != 0.0) {
            self.capped.insert(joint.name.clone(), of.clone());
        }
        if has_range {
            self.robot.lost(format!("the stops (`range`) of {of}"));
        }
        if rubs {
            self.robot.lost(format!("the dry friction (`frictionloss`) of {of}"));
        }
        self.robot.bodies[at].joints.push(joint);
        Ok(())
    }

    fn site(&mut self, node: Node<'a>, at: usize, inherited: Option<&'a str>) -> Result<(), Refusal> {
        let element = self.element(node, "site", inherited)?;
        let place = match element.ends()? {
            Some([a, b]) => [0, 1, 2].map(|axis| 0.5 * (a[axis] + b[axis])),
            None => element.vector("pos")?.unwrap_or_default(),
        };
        let name = node.attribute("name").unwrap_or("site").to_owned();
        let mark = Mark { name, of: element.of.clone(), at: place, is_shape: false };
        self.robot.bodies[at].marks.push(mark);
        Ok(())
    }

    /// The body of a name.
    fn find(&self, name: &str, of: &str) -> Result<usize, Refusal> {
        if name == "world" {
            return Ok(GROUND);
        }
        let found = self.robot.bodies.iter().skip(1).position(|body| body.name == name);
        found.map(|at| at + 1).ok_or_else(|| {
            Refusal(format!("{of} refers to the body {}, which the file does not have", crate::shown(name)))
        })
    }
}

fn free(node: Node<'_>) -> Refusal {
    let of = node.described(node.name());
    Refusal(format!(
        "{of} lets its body move through space: it is not planar; two slides and a hinge move in a plane"
    ))
}
