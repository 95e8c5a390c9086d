//! Inputs that change during a run.

use std::path::Path;

use mbs_runtime::{Dimension, Info, System};

use crate::quantity::TIME;
use crate::{Error, Settings, Unit, quantity};

/// Values of inputs over time, with straight lines between the instants; before the first
/// and after the last one they stay.
///
/// As every input they are set at the beginning of a step and held over it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Signals {
    times: Vec<f64>,
    inputs: Vec<(String, Vec<f64>)>,
}

impl Signals {
    /// Reads a table: time in the first column, an input in each of the others, under
    /// headings such as `t [s]` and `crank_torque [N*mm]`. Without a unit in its heading,
    /// time is in s and an input in the unit of its declaration.
    ///
    /// # Errors
    /// [`Error::File`] if it cannot be read, [`Error::Unknown`] for a heading that is no
    /// input, [`Error::Value`] for what is no number, and where time does not ascend.
    pub fn read(path: &Path, info: &Info) -> Result<Self, Error> {
        let known: Vec<Known> = info.inputs.iter().map(|q| (q.name, q.dimension, Unit::of(q))).collect();
        let (times, inputs) = over_time(path, "input", &known)?;
        Ok(Self { times, inputs })
    }

    /// The names of the inputs.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.inputs.iter().map(|(name, _)| name.as_str())
    }

    fn value(&self, input: usize, t: f64) -> f64 {
        let Some((_, values)) = self.inputs.get(input) else { return f64::NAN };
        let after = self.times.partition_point(|time| *time <= t);
        let at = |index: usize| Some((*self.times.get(index)?, *values.get(index)?));
        match (after.checked_sub(1).and_then(at), at(after)) {
            (Some((t0, x0)), Some((t1, x1))) => x0 + (x1 - x0) * (t - t0) / (t1 - t0),
            (Some((_, x)), None) | (None, Some((_, x))) => x,
            (None, None) => f64::NAN,
        }
    }
}

/// What a column of a table may be: its name, its dimension, and the unit of bare numbers.
pub(crate) type Known = (&'static str, Dimension, Unit);

/// The columns of a table by name, in SI units.
pub(crate) type Columns = Vec<(String, Vec<f64>)>;

/// Reads a table with time in its first column and quantities of one kind in the others.
pub(crate) fn over_time(
    path: &Path,
    kind: &'static str,
    known: &[Known],
) -> Result<(Vec<f64>, Columns), Error> {
    let unreadable = |error: csv::Error| Error::file("read", path)(error.into());
    let mut table = csv::ReaderBuilder::new().trim(csv::Trim::All).from_path(path).map_err(unreadable)?;
    let headings = table.headers().map_err(unreadable)?.clone();
    let named = |heading: &str| match heading.split_once('[') {
        Some((name, unit)) => (name.trim().to_owned(), unit.trim_end_matches(']').trim().to_owned()),
        None => (heading.to_owned(), String::new()),
    };
    let mut headings = headings.iter().map(named);
    let (_, time_unit) = headings.next().unwrap_or_default();
    let mut columns: Vec<(&Known, String)> = Vec::new();
    for (name, unit) in headings {
        let Some(quantity) = known.iter().find(|(known, ..)| *known == name) else {
            return Err(Error::unknown(kind, name, known.iter().map(|(name, ..)| *name)));
        };
        if columns.iter().any(|((other, ..), _)| *other == name) {
            let reason = format!("{} has two columns of that name", path.display());
            return Err(Error::Name { name, reason });
        }
        columns.push((quantity, unit));
    }
    let mut times: Vec<f64> = Vec::new();
    let mut values: Columns =
        columns.iter().map(|((name, ..), _)| ((*name).to_owned(), Vec::new())).collect();
    for (row, record) in table.records().enumerate() {
        let record = record.map_err(unreadable)?;
        let place = |what: &str| format!("{}, row {}: {what}", path.display(), row + 1);
        let cell = |at: usize| record.get(at).unwrap_or_default();
        let time = quantity::parse(&place("time"), &with_unit(cell(0), &time_unit), TIME)?;
        if times.last().is_some_and(|last| *last >= time) {
            let reason = "time has to rise from row to row".into();
            return Err(Error::Value { what: place("time"), text: cell(0).into(), reason });
        }
        times.push(time);
        for (at, (((name, dimension, usual), unit), (_, list))) in columns.iter().zip(&mut values).enumerate()
        {
            let text = with_unit(cell(at + 1), unit);
            let value = quantity::parse_in(name, &text, *dimension, usual);
            list.push(value.map_err(|error| error.about(place(name)))?);
        }
    }
    if times.is_empty() || values.is_empty() {
        let reason = format!("it needs a column for time, one for {} {kind}, and a row", article(kind));
        return Err(Error::Name { name: path.display().to_string(), reason });
    }
    Ok((times, values))
}

fn article(kind: &str) -> &'static str {
    if kind.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" }
}

fn with_unit(number: &str, unit: &str) -> String {
    format!("{number} {unit}").trim().to_owned()
}

/// Sets the inputs of a simulation to what signals say.
pub(crate) struct Player<'a> {
    signals: &'a Signals,
    /// Of every signal, the place among the inputs.
    places: Vec<usize>,
}

impl<'a> Player<'a> {
    pub fn of(info: &Info, settings: &'a Settings) -> Result<Option<Self>, Error> {
        let Some(signals) = &settings.signals else { return Ok(None) };
        let known = || info.inputs.iter().map(|input| input.name);
        let place = |name: &str| {
            known().position(|input| input == name).ok_or_else(|| Error::unknown("input", name, known()))
        };
        Ok(Some(Self { signals, places: signals.names().map(place).collect::<Result<_, _>>()? }))
    }

    /// Sets the inputs of a run; `inputs` is room for them.
    pub fn set(&self, run: &mut dyn System, inputs: &mut [f64]) {
        let t = run.time();
        run.inputs(inputs);
        for (signal, place) in self.places.iter().enumerate() {
            if let Some(input) = inputs.get_mut(*place) {
                *input = self.signals.value(signal, t);
            }
        }
        run.set_inputs(inputs);
    }
}

#[cfg(test)]
mod tests {
    use mbs_runtime::Mechanism;

    use super::*;
    use crate::model;

    mbs_runtime::mechanism! {
        /// A cart that is pushed.
        pub Cart {
            dof = 1;
            input push [kN];
            body cart (x) { mass = 1000 [kg]; }
            force f on cart = (push, 0);
            start { x = 0; }
        }
    }

    fn read(text: &str) -> Result<Signals, Error> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("in.csv");
        std::fs::write(&path, text).unwrap();
        Signals::read(&path, <Cart as Mechanism>::INFO)
    }

    #[test]
    fn straight_lines_between_instants() {
        let signals = read("t [ms], push [N]\n0, 0\n1000, 500\n2000, 500\n").unwrap();
        assert_eq!([-1.0, 0.5, 1.5, 9.0].map(|t| signals.value(0, t)), [0.0, 250.0, 500.0, 500.0]);
        assert_eq!(read("t,push\n0,2").unwrap().value(0, 0.0), 2000.0);
    }

    /// ẋ(2 s) = (½ · 500 N · 1 s + 500 N · 1 s)/1000 kg, to the inputs' being held over steps.
    #[test]
    fn a_run_follows_them() {
        let signals = read("t,push [N]\n0,0\n1,500\n2,500").unwrap();
        let settings = Settings { end: 2.0, step: 1e-3, signals: Some(signals), ..Settings::default() };
        let run = model::of::<Cart>().simulate(&settings, &mut |_, _| ()).unwrap();
        let speed = *run.column("der(x)").unwrap().values.last().unwrap();
        assert!((speed - 0.75).abs() < 0.5e-3, "{speed}");
    }

    #[test]
    fn tables_that_are_none() {
        let message = |text| read(text).unwrap_err().to_string();
        assert!(message("t,pull\n0,1").contains("no input `pull`, did you mean `push`?"));
        assert!(message("t,push\n0,1\n0,2").contains("row 2: time = `0`: time has to rise"));
        assert!(message("t,push\n0,x").contains("row 1: push = `x`"), "{}", message("t,push\n0,x"));
        assert!(message("t,push [mm]\n0,1").contains("a length [m] was given"));
        assert!(message("t,push\n").contains("a row"));
        assert!(message("t,push,push\n0,1,2").contains("two columns"));
    }
}
