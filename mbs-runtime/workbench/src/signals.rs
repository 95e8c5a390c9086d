//! Inputs that change during a run.

#[cfg(feature = "desk")]
use std::path::Path;
use std::sync::Arc;

use mbs_analysis::{Beyond, InputTable, Interpolation, Way, own_clock};
use mbs_runtime::Info;

use crate::names::some_of;
use crate::{Error, Unit};
#[cfg(feature = "desk")]
use crate::{quantity, sheet::Sheet};

/// Values of inputs over time. Unless another [`Way`] is asked for, they are straight lines between the instants, and stay
/// before the first and after the last one.
///
/// Every stage of a step sees the inputs of its own time. A step to a tolerance ends where they bend or jump.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Signals {
    inputs: Vec<Signal>,
    /// Columns of a table that are no inputs.
    skipped: Vec<String>,
}

/// An input over time.
#[derive(Clone, Debug, PartialEq)]
struct Signal {
    name: String,
    times: Vec<f64>,
    values: Vec<f64>,
    way: Way,
}

impl Signal {
    fn new(name: &str, times: &[f64], values: Vec<f64>) -> Self {
        Self { name: name.to_owned(), times: times.to_vec(), values, way: Way::default() }
    }
}

impl Signals {
    /// Reads a table: a column of time and an input in each of the others, under headings such as `t [s]` and
    /// `crank_torque [N*mm]`. Without a unit in its heading, time is in s and an input in the unit of its
    /// declaration. Other columns are skipped, and [`notes`](Self::notes) says so.
    ///
    /// # Errors
    /// [`Error::File`] if it cannot be read, [`Error::Unknown`] if no column is an input, [`Error::Value`] for
    /// what is no number, and where time does not ascend.
    #[cfg(feature = "desk")]
    pub fn read(path: &Path, info: &Info) -> Result<Self, Error> {
        let sheet = Sheet::read(path)?;
        let mut signals = Self::of(&sheet, info)?;
        let others = sheet.columns.iter().filter(|column| signals.names().all(|name| name != column.name));
        let others: Vec<String> = others.map(|column| column.name.clone()).collect();
        match others.first() {
            Some(first) if signals.inputs.is_empty() => {
                Err(Error::unknown("input", first, info.free_inputs().iter().map(|input| input.name)))
            }
            _ => {
                signals.skipped = others;
                Ok(signals)
            }
        }
    }

    /// Reads one input from a table: the column of its name, or the only one beside the time.
    ///
    /// # Errors
    /// As [`read`](Self::read); [`Error::Unknown`] for a name that is no input, [`Error::Column`] if the table
    /// does not have it.
    #[cfg(feature = "desk")]
    pub fn read_input(path: &Path, info: &Info, name: &str) -> Result<Self, Error> {
        let known = || info.free_inputs().iter().map(|input| input.name);
        let input = info.free_inputs().iter().find(|input| input.name == name);
        let input = input.ok_or_else(|| Error::unknown("input", name, known()))?;
        let sheet = Sheet::read(path)?;
        let column = match (sheet.columns.iter().find(|column| column.name == name), &*sheet.columns) {
            (Some(column), _) | (None, [column]) => column,
            (None, columns) => {
                let known = columns.iter().map(|column| column.name.clone()).collect();
                return Err(Error::Column { file: path.into(), name: name.into(), known });
            }
        };
        let values = sheet.complete(column, |text| quantity::parse_as(input, text))?;
        Ok(Self { inputs: vec![Signal::new(name, &sheet.times, values)], skipped: Vec::new() })
    }

    /// The inputs of both.
    ///
    /// # Errors
    /// [`Error::Name`] for an input that both have.
    pub fn with(self, other: Self) -> Result<Self, Error> {
        if let Some(name) = self.names().find(|name| other.names().any(|other| other == *name)) {
            let reason = "two tables have it; leave one of them out".into();
            return Err(Error::Name { name: name.to_owned(), reason });
        }
        let inputs = [self.inputs, other.inputs].concat();
        Ok(Self { inputs, skipped: [self.skipped, other.skipped].concat() })
    }

    /// The same inputs by the words of a [table](mbs_runtime::language#tables): the way from instant to instant, and
    /// behind `outside` the rule for what is before the first and after the last one, such as
    /// `cubic outside periodic`. What is left out stays as it is.
    ///
    /// # Errors
    /// [`Error::Unknown`] for other words; [`Error::Name`] for instants that do not fit them.
    pub fn led(mut self, words: &str) -> Result<Self, Error> {
        if words.trim().is_empty() {
            return Ok(self);
        }
        for Signal { name, times, values, way } in &mut self.inputs {
            *way = led(*way, words)?;
            let fits = InputTable::led(times.clone(), vec![(0, values.clone())], *way);
            fits.map_err(|error| {
                let reason = format!("by `{}` {error}", words.trim());
                Error::Name { name: name.clone(), reason }
            })?;
        }
        Ok(self)
    }

    /// Inputs at ascending times in s; values are in the units of their declarations.
    ///
    /// # Errors
    /// [`Error::Unknown`] for a name that is no input; [`Error::Name`] for times that do not ascend, and for values
    /// that are not finite or not as many as there are times.
    pub fn new(info: &Info, times: Vec<f64>, columns: Vec<(String, Vec<f64>)>) -> Result<Self, Error> {
        let refused =
            |name: &str, reason: &str| Err(Error::Name { name: name.into(), reason: reason.into() });
        let is_finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
        let ascends = times.iter().zip(times.iter().skip(1)).all(|(before, after)| before < after);
        if times.is_empty() || !is_finite(&times) || !ascends {
            return refused("t", "the times of inputs are finite and ascend, and there is at least one");
        }
        let mut inputs = Vec::new();
        for (name, values) in columns {
            let known = || info.free_inputs().iter().map(|input| input.name);
            let input = info.free_inputs().iter().find(|input| input.name == name);
            let unit = Unit::of(input.ok_or_else(|| Error::unknown("input", &name, known()))?);
            if values.len() != times.len() || !is_finite(&values) {
                return refused(&name, "an input that changes has a finite value at each of the times");
            }
            inputs.push(Signal::new(
                &name,
                &times,
                values.into_iter().map(|value| unit.read(value)).collect(),
            ));
        }
        Ok(Self { inputs, skipped: Vec::new() })
    }

    /// When the table begins and ends, in s.
    pub fn span(&self) -> [f64; 2] {
        let times = || self.inputs.iter().flat_map(|input| &input.times).copied();
        [times().reduce(f64::min), times().reduce(f64::max)].map(|end| end.unwrap_or(0.0))
    }

    /// The shortest time between two rows of an input, in s; infinite without two.
    pub fn closest(&self) -> f64 {
        let gaps = self.inputs.iter().flat_map(|input| input.times.windows(2).map(|pair| pair[1] - pair[0]));
        gaps.fold(f64::INFINITY, f64::min)
    }

    /// When a run begins that takes these inputs, where the table has a clock of its own; see [`own_clock`].
    pub fn start_time(&self) -> Option<f64> {
        own_clock(self.span())
    }

    /// Notes on the use of the table: columns that are no inputs, and a start on a clock of its own.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if !self.skipped.is_empty() {
            notes.push(format!("columns that are no inputs are not used: {}", some_of(&self.skipped)));
        }
        if let Some(start) = self.start_time() {
            notes.push(format!(
                "the inputs begin at {start} s on a clock of their own, and so does the run; a row for 0 s lets it \
                 begin then"
            ));
        }
        notes
    }

    /// The inputs among the columns of a table.
    ///
    /// # Errors
    /// [`Error::Value`] for what is no number.
    #[cfg(feature = "desk")]
    pub(crate) fn of(sheet: &Sheet, info: &Info) -> Result<Self, Error> {
        let mut inputs = Vec::new();
        for column in &sheet.columns {
            let Some(input) = info.free_inputs().iter().find(|input| input.name == column.name) else {
                continue;
            };
            let values = sheet.complete(column, |text| quantity::parse_as(input, text))?;
            inputs.push(Signal::new(input.name, &sheet.times, values));
        }
        Ok(Self { inputs, skipped: Vec::new() })
    }

    /// The names of the inputs.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.inputs.iter().map(|input| input.name.as_str())
    }

    /// The same by the places of the inputs of a mechanism.
    ///
    /// # Errors
    /// [`Error::Unknown`] for an input that it does not have.
    pub fn table(&self, info: &Info) -> Result<Arc<InputTable>, Error> {
        let known = || info.free_inputs().iter().map(|input| input.name);
        let mut table = InputTable::default();
        for Signal { name, times, values, way } in &self.inputs {
            let place = known().position(|input| input == name);
            let place = place.ok_or_else(|| Error::unknown("input", name, known()))?;
            table = table.with(InputTable::led(times.clone(), vec![(place, values.clone())], *way)?);
        }
        Ok(Arc::new(table))
    }
}

/// A way with what words say of it: `cubic`, `outside hold`, or both.
fn led(mut way: Way, words: &str) -> Result<Way, Error> {
    let mut rest: &[&str] = &words.split_whitespace().collect::<Vec<_>>();
    if let [between, behind @ ..] = rest
        && *between != "outside"
    {
        way.between = meaning("way from instant to instant", between, &Interpolation::WORDS)?;
        rest = behind;
    }
    match rest {
        [] => Ok(way),
        ["outside", rule] => {
            way.outside = meaning("rule for what is outside", rule, &Beyond::WORDS)?;
            Ok(way)
        }
        _ => {
            let reason = "write a way from instant to instant, `outside` and a rule for what is outside of them, as in \
                          `cubic outside hold`";
            Err(Error::Name { name: words.trim().into(), reason: reason.into() })
        }
    }
}

/// The meaning of a word.
fn meaning<T: Copy>(kind: &'static str, word: &str, words: &[(&'static str, T)]) -> Result<T, Error> {
    let found = words.iter().find(|(known, _)| *known == word);
    found
        .map(|(_, meaning)| *meaning)
        .ok_or_else(|| Error::unknown(kind, word, words.iter().map(|(known, _)| *known)))
}
