//! Files `.pmks` of 2019: JSON with the list `Joints`.

use serde_json::Value;

use super::{Joint, Kind, Sheet, Speed};
use crate::values::{list, number, optional, text};
use crate::{Refusal, shown};

pub(super) fn read(file: &str) -> Result<Sheet, Refusal> {
    let file: Value =
        serde_json::from_str(file).map_err(|error| Refusal(format!("it is no complete JSON: {error}")))?;
    let mut sheet = Sheet {
        name: file.get("Name").and_then(Value::as_str).unwrap_or_default().to_owned(),
        ..Sheet::default()
    };
    for (at, joint) in list(&file, "Joints", "the file")?.iter().enumerate() {
        let of = format!("the joint P{at}");
        let kind = Kind::of(text(joint, "TypeOfJoint", &of)?, &of)?;
        let links: Vec<String> =
            list(joint, "Links", &of)?.iter().filter_map(Value::as_str).map(str::to_owned).collect();
        if links.is_empty() {
            return Err(Refusal(format!("{of} is on no link")));
        }
        let place = [number(joint, "X", &of)?, number(joint, "Y", &of)?];
        let angle = angle(joint, &of)?;
        sheet.joints.push(Joint { kind, at: place, angle, links });
    }
    if let Some(speed) = optional(&file, "InputSpeed", "the file")?.filter(|speed| *speed != 0.0) {
        sheet.speed = Some(Speed::OfTheLibrary(speed));
    }
    sheet.input = match file.get("DrivingIndex") {
        None | Some(Value::Null) => None,
        Some(index) => {
            let number = index.as_u64().and_then(|index| usize::try_from(index).ok());
            Some(number.ok_or_else(|| {
                Refusal(format!(
                    "`DrivingIndex` = {} is not the number of a joint",
                    shown(&index.to_string())
                ))
            })?)
        }
    };
    Ok(sheet)
}

/// In rad; a joint that does not slide may have `NaN` there.
fn angle(joint: &Value, of: &str) -> Result<f64, Refusal> {
    match joint.get("Angle") {
        Some(Value::String(text)) if text == "NaN" => Ok(0.0),
        _ => Ok(optional(joint, "Angle", of)?.unwrap_or(0.0)),
    }
}
