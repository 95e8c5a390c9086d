//! Equalities and actuators.

use roxmltree::Node;

use super::Reader;
use super::classes::Element;
use crate::import::robot::plane::poses;
use crate::import::robot::space::{Pose, Rotation, Vector};
use crate::import::robot::xml::{described, elements};
use crate::import::robot::{Actuator, Closing, Coupling, GROUND, Input};
use crate::import::{Refusal, shown};

impl<'a, 'i> Reader<'a, 'i> {
    pub(super) fn equalities(&mut self, section: Node<'a, 'i>) -> Result<(), Refusal> {
        for node in elements(section) {
            let of = described(node.tag_name().name(), node);
            let element = self.element(node, "equality", None)?;
            if element.get("active") == Some("false") {
                self.robot.lost(format!("{of}, which is not active"));
                continue;
            }
            match node.tag_name().name() {
                kind @ ("connect" | "weld") => {
                    let closing = self.closing(&element, kind == "weld")?;
                    self.robot.closings.push(closing);
                }
                "joint" => {
                    let coupling = coupling(&element)?;
                    self.robot.couplings.push(coupling);
                }
                _ => return Err(Refusal(format!("{of} is not imported"))),
            }
        }
        if !self.robot.closings.is_empty() {
            let note = "equalities are stiff springs in MuJoCo; here they are joints, which do not give way";
            self.robot.notes.push(note.into());
        }
        Ok(())
    }

    fn closing(&self, element: &Element<'_, '_, '_>, is_weld: bool) -> Result<Closing, Refusal> {
        let of = element.of.clone();
        let name = element.node.attribute("name").unwrap_or("closing").to_owned();
        let has_sites = element.get("site1").is_some();
        let poses = poses(&self.robot);
        if has_sites && is_weld {
            return Err(Refusal(format!("{of} joins sites; a weld is imported of bodies alone")));
        }
        if has_sites {
            let [first, second] = ["site1", "site2"].map(|end| self.site_of(element, end));
            let ((first, from), (second, to)) = (first?, second?);
            return Ok(Closing { name, of, bodies: [first, second], at: [from, to], fixed: None });
        }
        let first =
            self.find(element.get("body1").ok_or_else(|| Refusal(format!("{of} has no `body1`")))?, &of)?;
        let second = element.get("body2").map_or(Ok(GROUND), |body| self.find(body, &of))?;
        let drawn = poses[second].seen_from(&poses[first]);
        if !is_weld {
            let anchor = element.vector("anchor")?.ok_or_else(|| Refusal(format!("{of} has no `anchor`")))?;
            let to = poses[first].seen_from(&poses[second]).place(anchor);
            return Ok(Closing { name, of, bodies: [first, second], at: [anchor, to], fixed: None });
        }
        let fixed = match element.exactly::<7>("relpose")? {
            Some([x, y, z, quaternion @ ..]) => {
                Rotation::of_quaternion(quaternion).map(|turn| Pose { at: [x, y, z], turn })
            }
            None => None,
        };
        let fixed = fixed.unwrap_or(drawn);
        Ok(Closing { name, of, bodies: [first, second], at: [fixed.at, [0.0; 3]], fixed: Some(fixed) })
    }

    /// The body of a site that an attribute names, and its place.
    fn site_of(&self, element: &Element<'_, '_, '_>, attribute: &str) -> Result<(usize, Vector), Refusal> {
        let of = &element.of;
        let name = element.get(attribute).ok_or_else(|| Refusal(format!("{of} has no `{attribute}`")))?;
        let sites = self
            .robot
            .bodies
            .iter()
            .enumerate()
            .flat_map(|(at, body)| body.marks.iter().map(move |mark| (at, mark)));
        let found = sites.into_iter().find(|(_, mark)| !mark.is_shape && mark.name == name);
        let missing =
            || Refusal(format!("{of} refers to the site {}, which the file does not have", shown(name)));
        found.map(|(at, mark)| (at, mark.at)).ok_or_else(missing)
    }

    pub(super) fn actuators(&mut self, section: Node<'a, 'i>) -> Result<(), Refusal> {
        for node in elements(section) {
            let element = self.element(node, "general", None)?;
            let actuator = actuator(&element)?;
            let mut lost = Vec::new();
            for range in ["ctrlrange", "forcerange"] {
                if element.list(range)?.iter().any(|limit| *limit != 0.0) {
                    lost.push(format!("the limits (`{range}`) of {}", element.of));
                }
            }
            lost.into_iter().for_each(|what| self.robot.lost(what));
            self.robot.actuators.push(actuator);
        }
        Ok(())
    }
}

fn coupling(element: &Element<'_, '_, '_>) -> Result<Coupling, Refusal> {
    let of = element.of.clone();
    let joint = |attribute: &str| element.get(attribute).map(str::to_owned);
    let follower = joint("joint1").ok_or_else(|| Refusal(format!("{of} has no `joint1`")))?;
    let leader = joint("joint2");
    let mut coefficients = match element.list("polycoef")? {
        none if none.is_empty() => vec![0.0, 1.0],
        coefficients => coefficients,
    };
    // Without another joint the first coefficient alone counts: the joint is fixed there.
    if leader.is_none() {
        coefficients.truncate(1);
    }
    let name = element.node.attribute("name").unwrap_or("coupling").to_owned();
    Ok(Coupling { name, of, follower, leader, coefficients })
}

/// The gain and the bias of an actuator, as MuJoCo makes them of the short forms.
fn actuator(element: &Element<'_, '_, '_>) -> Result<Actuator, Refusal> {
    let of = element.of.clone();
    let Some(joint) = element.get("joint").or(element.get("jointinparent")) else {
        return Err(Refusal(format!("{of} has no `joint`; what acts on other things is not imported")));
    };
    let gear = element.list("gear")?.first().copied().unwrap_or(1.0);
    let (input, gain, bias) = match element.node.tag_name().name() {
        "motor" => (Input::Effort, 1.0, [0.0; 3]),
        "position" => position(element)?,
        "velocity" => {
            let kv = element.number("kv")?.unwrap_or(1.0);
            (Input::Velocity, kv, [0.0, 0.0, -kv])
        }
        "general" => general(element)?,
        _ => return Err(Refusal(format!("{of} is not imported; motor, position, velocity and general are"))),
    };
    let name = element.node.attribute("name").map_or_else(|| format!("{joint}_motor"), str::to_owned);
    Ok(Actuator { name, of, joint: joint.to_owned(), gear, gain, bias, input })
}

type Law = (Input, f64, [f64; 3]);

fn position(element: &Element<'_, '_, '_>) -> Result<Law, Refusal> {
    let of = &element.of;
    for attribute in ["dampratio", "timeconst", "inheritrange"] {
        if element.number(attribute)?.is_some_and(|number| number != 0.0) {
            return Err(Refusal(format!("{of}: `{attribute}` is not imported")));
        }
    }
    let kp = element.number("kp")?.unwrap_or(1.0);
    Ok((Input::Position, kp, [0.0, -kp, -element.number("kv")?.unwrap_or_default()]))
}

fn general(element: &Element<'_, '_, '_>) -> Result<Law, Refusal> {
    let of = &element.of;
    for (attribute, known) in [("dyntype", "none"), ("gaintype", "fixed")] {
        if let Some(other) = element.get(attribute).filter(|value| *value != known) {
            return Err(Refusal(format!("{of}: `{attribute}` = {} is not imported", shown(other))));
        }
    }
    let gain = element.list("gainprm")?.first().copied().unwrap_or(1.0);
    let given = element.list("biasprm")?;
    let bias = match element.get("biastype").unwrap_or("none") {
        "none" => [0.0; 3],
        "affine" => [0, 1, 2].map(|at: usize| given.get(at).copied().unwrap_or_default()),
        other => return Err(Refusal(format!("{of}: `biastype` = {} is not imported", shown(other)))),
    };
    Ok((Input::Number, gain, bias))
}
