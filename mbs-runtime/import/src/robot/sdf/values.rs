//! Values that stand as texts in elements.

use crate::xml::Node;

use crate::Refusal;
use crate::robot::numbers::exactly;
use crate::robot::space::{Pose, Rotation};

/// The text in a part of an element.
pub(super) fn text<'a>(node: Node<'a>, part: &'static str) -> Option<&'a str> {
    node.elements_named(part).next().map(|part| part.text().unwrap_or_default().trim())
}

pub(super) fn number(node: Node<'_>, part: &'static str, of: &str) -> Result<Option<f64>, Refusal> {
    Ok(text(node, part).map(|text| exactly::<1>(text, part, of)).transpose()?.map(|[number]| number))
}

/// True if a part of an element is there and says yes.
pub(super) fn is_set(node: Node<'_>, part: &'static str) -> bool {
    text(node, part).is_some_and(is_true)
}

pub(super) fn is_true(text: &str) -> bool {
    text == "1" || text.eq_ignore_ascii_case("true")
}

/// The `pose` of an element, and the frame that it says it is relative to.
pub(super) fn pose<'a>(node: Node<'a>, of: &str) -> Result<(Pose, Option<&'a str>), Refusal> {
    let Some(pose) = node.elements_named("pose").next() else { return Ok((Pose::NONE, None)) };
    // Until SDF 1.6 the attribute was called `frame`.
    let relative_to = pose.attribute("relative_to").or(pose.attribute("frame"));
    let relative_to = relative_to.filter(|name| !name.is_empty());
    let text = pose.text().unwrap_or_default();
    if pose.attribute("rotation_format") == Some("quat_xyzw") {
        let [a, b, c, x, y, z, w] = exactly(text, "pose", of)?;
        let turn = Rotation::of_quaternion([w, x, y, z]);
        let turn =
            turn.ok_or_else(|| Refusal(format!("{of}: the quaternion of its `pose` has no direction")))?;
        return Ok((Pose { at: [a, b, c], turn }, relative_to));
    }
    if text.trim().is_empty() {
        return Ok((Pose::NONE, relative_to));
    }
    let [x, y, z, angles @ ..] = exactly::<6>(text, "pose", of)?;
    let is_in_degrees = pose.attribute("degrees").is_some_and(is_true);
    let angles = if is_in_degrees { angles.map(f64::to_radians) } else { angles };
    Ok((Pose { at: [x, y, z], turn: Rotation::of_roll_pitch_yaw(angles) }, relative_to))
}
