//! The quantities that a sweep looks at.

use crate::members::quantities;
use crate::{Error, Model, Unit};

/// A quantity of a mechanism that a sweep looks at.
pub struct Watched {
    /// Its place among all [`quantities`].
    pub at: usize,
    pub name: &'static str,
    pub unit: Unit,
}

/// The named quantities; all outputs if none are named, all coordinates if there are
/// no outputs.
pub fn watched(model: &dyn Model, names: &[String]) -> Result<Vec<Watched>, Error> {
    let info = model.info();
    let all = quantities(info).into_iter().enumerate();
    let all: Vec<_> = all.map(|(at, (name, unit))| Watched { at, name, unit }).collect();
    for (at, name) in names.iter().enumerate() {
        if names.iter().take(at).any(|other| other == name) {
            return Err(Error::Name { name: name.clone(), reason: "it is named twice".into() });
        }
        if !all.iter().any(|quantity| quantity.name == *name) {
            return Err(Error::unknown("output", name, all.iter().map(|quantity| quantity.name)));
        }
    }
    let outputs = if info.outputs.is_empty() { 0 } else { info.coordinates.len() };
    let is_wanted = |quantity: &Watched| match names {
        [] => quantity.at >= outputs,
        names => names.iter().any(|name| *name == quantity.name),
    };
    Ok(all.into_iter().filter(is_wanted).collect())
}
