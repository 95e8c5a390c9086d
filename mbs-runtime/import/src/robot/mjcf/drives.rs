//! Equalities and actuators.

use crate::xml::Node;

use super::Reader;
use super::classes::Element;
use crate::robot::plane::poses;
use crate::robot::space::{Pose, Rotation, Vector};

use crate::robot::{Actuator, Closing, Coupling, GROUND};
use crate::{Refusal, shown};

impl<'a> Reader<'a> {
    pub(super) fn equalities(&mut self, section: Node<'a>) -> Result<(), Refusal> {
        for node in section.elements() {
            self.robot.is_limited()?;
            let of = node.described(node.name());
            let element = self.element(node, "equality", None)?;
            if element.get("active") == Some("false") {
                self.robot.lost(format!("{of}, which is not active"));
                continue;
            }
            match node.name() {
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

    fn closing(&self, element: &Element<'_, '_>, is_weld: bool) -> Result<Closing, Refusal> {
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
        let anchor = element.vector("anchor")?.unwrap_or_default();
        // Without torque it holds a place of the two bodies, and not their angle.
        let turns = element.number("torquescale")? == Some(0.0);
        let at = [fixed.place(anchor), anchor];
        Ok(Closing { name, of, bodies: [first, second], at, fixed: (!turns).then_some(fixed) })
    }

    /// The body of a site that an attribute names, and its place.
    fn site_of(&self, element: &Element<'_, '_>, attribute: &str) -> Result<(usize, Vector), Refusal> {
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

    pub(super) fn actuators(&mut self, section: Node<'a>) -> Result<(), Refusal> {
        for node in section.elements() {
            self.robot.is_limited()?;
            let element = self.element(node, "general", None)?;
            let actuator = actuator(&element)?;
            let parts = [element.coefficient("damping")?, element.number("armature")?.unwrap_or_default()];
            let group = element.number("group")?.unwrap_or_default();
            let of = element.of.clone();
            let mut lost = Vec::new();
            for range in ["ctrlrange", "forcerange"] {
                if element.list(range)?.iter().any(|limit| *limit != 0.0) {
                    lost.push(format!("the limits (`{range}`) of {of}"));
                }
            }
            // A part that belongs to the joint, whether or not the actuator acts.
            self.reflect(&actuator, parts);
            if self.settings.disabled_groups.contains(&group) {
                self.robot.lost(format!("{of}: `actuatorgroupdisable` takes it away"));
                continue;
            }
            if let Some(capped) = self.capped.get(&actuator.joint) {
                return Err(Refusal(format!(
                    "{capped}: `actuatorfrcrange` limits what {of} does to it, which is not imported"
                )));
            }
            lost.into_iter().for_each(|what| self.robot.lost(what));
            self.robot.actuators.push(actuator);
        }
        Ok(())
    }

    /// Gives the joint of an actuator the damping and the inertia of that, as its gear shows them.
    fn reflect(&mut self, actuator: &Actuator, [damping, armature]: [f64; 2]) {
        let joints = self.robot.bodies.iter_mut().flat_map(|body| &mut body.joints);
        let scale = actuator.gear * actuator.gear;
        for joint in joints.filter(|joint| joint.name == actuator.joint) {
            joint.damping += scale * damping;
            joint.armature += scale * armature;
        }
    }
}

fn coupling(element: &Element<'_, '_>) -> Result<Coupling, Refusal> {
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

/// An actuator at a joint.
fn actuator(element: &Element<'_, '_>) -> Result<Actuator, Refusal> {
    let of = element.of.clone();
    let Some(joint) = element.get("joint").or(element.get("jointinparent")) else {
        return Err(Refusal(format!("{of} has no `joint`; what acts on other things is not imported")));
    };
    let gear = element.list("gear")?.first().copied().unwrap_or(1.0);
    let (input, gain, bias) = element.law()?.imported(element.node, &of)?;
    let name = element.node.attribute("name").map_or_else(|| format!("{joint}_motor"), str::to_owned);
    Ok(Actuator { name, of, joint: joint.to_owned(), gear, gain, bias, input })
}
