//! The JSON of `mechanism_to_json`: joints with places, and links with the joints on them.

use serde_json::Value;

use super::values;
use crate::geometry::{from, minus, polar};
use crate::linkage::{Drive, GROUND, Linkage, Motion, Slot};
use crate::{Refusal, shown};

/// A joint of the file with its pin.
struct Joint<'a> {
    id: &'a str,
    pin: usize,
    value: &'a Value,
    kind: &'a str,
}

pub(super) fn read(joints: &[Value], file: &Value, linkage: &mut Linkage) -> Result<(), Refusal> {
    let mut known: Vec<Joint<'_>> = Vec::new();
    for value in joints {
        let joint = joint(value, &known, linkage)?;
        known.push(joint);
    }
    links(values::list(file, "links", "the file")?, &known, linkage)?;
    for joint in &known {
        match joint.kind {
            "ground" => linkage.links[GROUND].pins.push(joint.pin),
            "prismatic" => slider(joint, linkage)?,
            "tracker" => tracker(joint, &known, linkage)?,
            _ => {}
        }
    }
    Ok(())
}

fn joint<'a>(value: &'a Value, known: &[Joint<'a>], linkage: &mut Linkage) -> Result<Joint<'a>, Refusal> {
    let id = values::text(value, "id", "a joint")?;
    let of = format!("the joint {}", shown(id));
    if known.iter().any(|joint| joint.id == id) {
        return Err(Refusal(format!("{of} is there twice")));
    }
    let kind = value.get("type").and_then(Value::as_str).unwrap_or("revolute");
    if !["ground", "revolute", "prismatic", "tracker"].contains(&kind) {
        return Err(Refusal(format!("{of} is of the type {}, which is not known", shown(kind))));
    }
    let at = match kind {
        "tracker" => tracked(value, known, linkage, &of)?,
        _ => values::pair(value, "position", &of)?,
    };
    let name = value.get("name").and_then(Value::as_str).unwrap_or(id);
    Ok(Joint { id, pin: linkage.pin(name, of, at)?, value, kind })
}

fn find<'a, 'b>(known: &'b [Joint<'a>], id: &str, by: &str) -> Result<&'b Joint<'a>, Refusal> {
    known.iter().find(|joint| joint.id == id).ok_or_else(|| Linkage::missing("the joint", id, by))
}

/// Where a tracker is: at a distance from its first joint, at an angle to the second.
fn tracked(value: &Value, known: &[Joint<'_>], linkage: &Linkage, of: &str) -> Result<[f64; 2], Refusal> {
    let pin = |key: &str| Ok(linkage.pins[find(known, values::text(value, key, of)?, of)?.pin].at);
    let [first, second] = [pin("ref_joint1_id")?, pin("ref_joint2_id")?];
    let (length, angle) = (values::number(value, "distance", of)?, values::number(value, "angle", of)?);
    Ok(from(first, length, polar(minus(second, first)) + angle))
}

fn links(links: &[Value], known: &[Joint<'_>], linkage: &mut Linkage) -> Result<(), Refusal> {
    for value in links {
        let id = values::text(value, "id", "a link")?;
        let of = format!("the link {}", shown(id));
        let mut pins = Vec::new();
        for joint in values::list(value, "joints", &of)? {
            let id = joint.as_str().ok_or_else(|| Refusal(format!("{of} has a joint without a name")))?;
            pins.push(find(known, id, &of)?.pin);
        }
        let name = value.get("name").and_then(Value::as_str).unwrap_or(id);
        match value.get("type").and_then(Value::as_str).unwrap_or("link") {
            "ground" => linkage.links[GROUND].pins.extend(pins),
            "link" => drop(linkage.link(name, of, pins)),
            kind @ ("driver" | "arc_driver") => {
                let link = linkage.link(name, of.clone(), pins);
                let drive = drive(value, kind, link, known, linkage, of)?;
                linkage.has_steps = true;
                linkage.drives.push(drive);
            }
            other => {
                return Err(Refusal(format!("{of} is of the type {}, which is not known", shown(other))));
            }
        }
    }
    Ok(())
}

fn drive(
    value: &Value,
    kind: &str,
    link: usize,
    known: &[Joint<'_>],
    linkage: &mut Linkage,
    of: String,
) -> Result<Drive, Refusal> {
    let motor = find(known, values::text(value, "motor_joint", &of)?, &of)?.pin;
    let pins = &linkage.links[link].pins;
    let &[to] = pins.iter().filter(|pin| **pin != motor).copied().collect::<Vec<_>>().as_slice() else {
        return Err(Refusal(format!("{of} is driven and has not exactly one joint beside its motor's")));
    };
    linkage.links[GROUND].pins.push(motor);
    let per_step = values::number(value, "angular_velocity", &of)?;
    let start = values::optional(value, "initial_angle", &of)?;
    let motion = match kind {
        "driver" => Motion::PerStep(per_step),
        _ => {
            let (from, to) =
                (values::number(value, "arc_start", &of)?, values::number(value, "arc_end", &of)?);
            if from >= to {
                return Err(Refusal(format!("{of}: `arc_end` has to be larger than `arc_start`")));
            }
            linkage.note(format!(
                "{of} turns back at once in pylinkage; here it swings as a sine does, as fast in the middle"
            ));
            Motion::Swing { per_step, from, to }
        }
    };
    Ok(Drive { link, against: GROUND, of, start, from: motor, to, motion })
}

/// A joint that stays on a line of the ground.
fn slider(joint: &Joint<'_>, linkage: &mut Linkage) -> Result<(), Refusal> {
    let of = format!("the joint {}", shown(joint.id));
    let along = values::pair(joint.value, "axis", &of)?;
    let through = values::pair(joint.value, "line_point", &of)?;
    if !(along[0].hypot(along[1]) > 0.0 && along.iter().chain(&through).all(|number| number.abs() < 1e9)) {
        return Err(Refusal(format!("{of} has no axis along which it could slide")));
    }
    linkage.slots.push(Slot {
        pin: joint.pin,
        rider: None,
        link: GROUND,
        through,
        along,
        keeps_angle: false,
    });
    Ok(())
}

/// A tracker is carried by the link that has both of its joints.
fn tracker(joint: &Joint<'_>, known: &[Joint<'_>], linkage: &mut Linkage) -> Result<(), Refusal> {
    let of = format!("the joint {}", shown(joint.id));
    let pin = |key: &str| Ok(find(known, values::text(joint.value, key, &of)?, &of)?.pin);
    let [first, second] = [pin("ref_joint1_id")?, pin("ref_joint2_id")?];
    match linkage.links.iter_mut().find(|link| link.pins.contains(&first) && link.pins.contains(&second)) {
        Some(link) => link.pins.push(joint.pin),
        None => linkage.note(format!("{of} follows two joints that no link has both of: it was left out")),
    }
    Ok(())
}
