//! The task of a synthesis, read from a command line.

use std::path::Path;

use mbs_analysis::{Signal, Task, Unknown, Variable};
use mbs_runtime::{Dimension, Info};

use super::Arguments;
use crate::quantity;
use crate::settings::Start;
use crate::sheet::Sheet;
use crate::{Error, Model, Unit};

const LENGTH: Dimension = Dimension::of(0, 1, 0);
const ANGLE: Dimension = Dimension::of(0, 0, 0);

/// The task, and the units of its columns.
pub(super) fn task(model: &dyn Model, asked: &Arguments) -> Result<(Task, Vec<Unit>), Error> {
    let info = model.info();
    let settings = asked.values.settings(model)?;
    if let Some((name, _)) = settings.inputs.first() {
        let reason = "inputs push a mechanism and do not lead it; synthesis knows positions alone";
        return Err(Error::Name { name: name.clone(), reason: reason.into() });
    }
    let unknown = asked.param.iter().map(|text| bounded(info, text)).collect::<Result<_, _>>()?;
    let (columns, units, positions) = positions(&asked.through, info)?;
    let drive = asked.drive.clone();
    let known = || info.coordinates.iter().map(|q| q.name);
    if let Some(name) = drive.as_ref().filter(|name| !known().any(|other| other == name.as_str())) {
        return Err(Error::unknown("coordinate", name, known()));
    }
    let usual = Task::of(info);
    let tolerance = asked.tolerance.as_ref().map(|text| tolerance(text)).transpose()?;
    let task = Task {
        parameters: Start::of(model, &settings)?.parameters,
        unknown,
        columns,
        positions,
        drive,
        tolerance: tolerance.unwrap_or(usual.tolerance),
        starts: asked.starts as usize,
        enough: asked.enough as usize,
        seed: asked.seed,
        ..usual
    };
    Ok((task, units))
}

/// A parameter with its bounds, `NAME=LOW..HIGH`.
fn bounded(info: &Info, text: &str) -> Result<Unknown, Error> {
    let wrong =
        |reason: &str| Error::Value { what: "param".into(), text: text.into(), reason: reason.into() };
    let form = "write NAME=LOW..HIGH, for instance l1=20mm..90mm";
    let (name, range) = text.split_once('=').ok_or_else(|| wrong(form))?;
    let name = name.trim();
    let known = info.parameters;
    let found = known.iter().find(|parameter| parameter.name == name);
    let found = found.ok_or_else(|| Error::unknown("parameter", name, known.iter().map(|p| p.name)))?;
    let (low, high) = range.split_once("..").ok_or_else(|| wrong(form))?;
    let bounds = [quantity::parse_as(found, low)?, quantity::parse_as(found, high)?];
    if bounds[0] >= bounds[1] {
        return Err(wrong("the first value has to be smaller than the second"));
    }
    Ok(Unknown { name: name.into(), guess: None, bounds })
}

/// A length, or an angle.
fn tolerance(text: &str) -> Result<f64, Error> {
    let value = match quantity::parse("tolerance", text, LENGTH) {
        Err(Error::Dimension { .. }) => {
            // an angle has a unit, although its dimension is that of a number
            let angle = Unit::of_coordinate(&mbs_runtime::Quantity {
                name: "",
                doc: "",
                unit: "",
                scale: 1.0,
                dimension: ANGLE,
                default: 0.0,
            });
            quantity::parse_in("tolerance", text, ANGLE, &angle)?
        }
        other => other?,
    };
    if value > 0.0 {
        return Ok(value);
    }
    Err(Error::Value { what: "tolerance".into(), text: text.into(), reason: "it has to be above 0".into() })
}

type Positions = (Vec<String>, Vec<Unit>, Vec<Vec<Option<f64>>>);

/// The columns of a table and its rows.
fn positions(path: &Path, info: &Info) -> Result<Positions, Error> {
    let sheet = Sheet::without_time(path)?;
    let known: Vec<Signal> = Signal::observable(info)
        .into_iter()
        .filter(|signal| matches!(signal.variable, Variable::Coordinate(_) | Variable::Output(_)))
        .collect();
    let (mut names, mut units, mut values) = (Vec::new(), Vec::new(), Vec::new());
    for column in &sheet.columns {
        let Some(signal) = known.iter().find(|signal| signal.name == column.name) else {
            let known = known.iter().map(|signal| signal.name.as_str());
            return Err(Error::unknown("coordinate or output", &column.name, known));
        };
        let unit = Unit::of_signal(info, signal);
        values.push(
            sheet.values(column, |text| quantity::parse_in(&signal.name, text, signal.dimension, &unit))?,
        );
        names.push(column.name.clone());
        units.push(unit);
    }
    let count = values.first().map_or(0, Vec::len);
    let row = |row: usize| values.iter().map(|column| column.get(row).copied().flatten()).collect();
    Ok((names, units, (0..count).map(row).collect()))
}
