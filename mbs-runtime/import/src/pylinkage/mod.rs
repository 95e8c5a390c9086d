//! Files of pylinkage (HugoFara): JSON of a mechanism with joints and links, and the older
//! JSON of a linkage whose joints say what they hang on.

mod joints;
mod mechanism;

use serde_json::Value;

use super::linkage::Linkage;
use super::{Refusal, values};

/// The names that the older form has for its joints.
const OLDER: [&str; 7] = ["Static", "_StaticBase", "Crank", "Fixed", "Linear", "Prismatic", "Revolute"];

/// Reads a file. Its lengths have no unit; they count as metres unless one is given.
pub(super) fn read(text: &str) -> Result<Linkage, Refusal> {
    let file: Value = serde_json::from_str(text.trim_start_matches('\u{feff}'))
        .map_err(|error| Refusal(format!("it is no complete JSON: {error}")))?;
    if file.get("nodes").is_some() || file.get("hyperedges").is_some() {
        let reason = "it has the topology of a linkage alone, without lengths; \
                      write it with `mechanism_to_json`";
        return Err(Refusal(reason.into()));
    }
    let joints = values::list(&file, "joints", "the file")?;
    let is_older =
        |joint: &Value| joint.get("type").and_then(Value::as_str).is_some_and(|of| OLDER.contains(&of));
    let mut linkage = Linkage::new("pylinkage", "m");
    linkage.name = file.get("name").and_then(Value::as_str).unwrap_or_default().to_owned();
    linkage.note("Lengths of pylinkage have no unit; they count as metres, if --unit says nothing else");
    if joints.iter().any(is_older) {
        joints::read(joints, &mut linkage)?;
    } else {
        mechanism::read(joints, &file, &mut linkage)?;
    }
    Ok(linkage)
}
