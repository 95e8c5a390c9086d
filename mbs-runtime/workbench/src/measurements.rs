//! Measured motions in files.

use std::path::Path;

use mbs_analysis::{Measurement, Signal, Variable};
use mbs_runtime::Info;

use crate::sheet::{Sheet, SheetColumn};
use crate::{Error, Signals, Unit, names, quantity};

/// A measured motion, read from a file.
pub(crate) struct Measurements {
    /// The quantities that are compared with those of the mechanism, in SI units.
    pub measured: Vec<Measurement>,
    /// The units in which they are shown.
    pub units: Vec<Unit>,
    /// The inputs that acted, if the file has columns of such.
    pub inputs: Option<Signals>,
    /// Columns without a meaning for the mechanism.
    pub unused: Vec<String>,
}

impl Measurements {
    /// Reads a table as `mbs simulate --out` writes it: time first, then coordinates `x`, rates `der(x)`,
    /// outputs, multipliers `lambda(row)` and inputs. `wanted` are patterns of names; without any, all
    /// coordinates, rates and outputs are compared. An empty cell is a sample that was not taken.
    ///
    /// # Errors
    /// [`Error::File`], [`Error::Value`], [`Error::Dimension`] with the line, [`Error::Unknown`] for a wanted
    /// column that the file or the mechanism does not have.
    pub fn read(path: &Path, info: &Info, wanted: &[String]) -> Result<Self, Error> {
        let sheet = Sheet::read(path)?;
        let known = Signal::observable(info);
        let of = |column: &SheetColumn| known.iter().find(|signal| signal.name == column.name);
        let is_usual = |signal: &Signal| !matches!(signal.variable, Variable::Multiplier(_));
        let is_wanted = |column: &SheetColumn, signal: &Signal| match wanted {
            [] => is_usual(signal),
            patterns => patterns.iter().any(|pattern| names::fits(pattern, &column.name)),
        };
        for pattern in wanted {
            if !sheet.columns.iter().any(|column| names::fits(pattern, &column.name)) {
                let listed = sheet.columns.iter().map(|column| column.name.as_str());
                return Err(Error::Column { file: path.into(), name: pattern.clone(), known: owned(listed) });
            }
        }
        let (mut measured, mut units, mut unused) = (Vec::new(), Vec::new(), Vec::new());
        for column in &sheet.columns {
            let is_input = info.free_inputs().iter().any(|input| input.name == column.name);
            match of(column).filter(|signal| is_wanted(column, signal)) {
                Some(signal) => {
                    let unit = Unit::of_signal(info, signal);
                    measured.push(samples(&sheet, column, signal, &unit)?);
                    units.push(unit);
                }
                None if !is_input => unused.push(column.name.clone()),
                None => {}
            }
        }
        if measured.is_empty() {
            let kind = "column that can be compared; the mechanism has no quantity called";
            let listed =
                sheet.columns.iter().map(|column| column.name.clone()).collect::<Vec<_>>().join(", ");
            let known = known.iter().filter(|signal| is_usual(signal)).map(|signal| signal.name.as_str());
            return Err(Error::unknown(kind, listed, known));
        }
        let inputs = Signals::of(&sheet, info)?;
        let has_inputs = inputs.names().next().is_some();
        Ok(Self { measured, units, inputs: has_inputs.then_some(inputs), unused })
    }
}

fn owned<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    names.map(str::to_owned).collect()
}

fn samples(sheet: &Sheet, column: &SheetColumn, signal: &Signal, unit: &Unit) -> Result<Measurement, Error> {
    let read = |text: &str| {
        let value = quantity::parse_in(&signal.name, text, signal.dimension, unit);
        value.map_err(|error| match error {
            Error::Value { what, text, reason } if text.to_lowercase().contains("nan") => Error::Value {
                what,
                text,
                reason: format!("{reason}; leave the cell empty where nothing was measured"),
            },
            other => other,
        })
    };
    let (mut times, mut values) = (Vec::new(), Vec::new());
    for (time, value) in sheet.times.iter().zip(sheet.values(column, read)?) {
        if let Some(value) = value {
            times.push(*time);
            values.push(value);
        }
    }
    Ok(Measurement { name: signal.name.clone(), times, values, deviation: None })
}
