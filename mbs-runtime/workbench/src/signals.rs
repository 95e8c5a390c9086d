//! Inputs that change during a run.

#[cfg(feature = "desk")]
use std::path::Path;
use std::sync::Arc;

use mbs_analysis::{InputTable, own_clock};
use mbs_runtime::Info;

use crate::names::some_of;
use crate::{Error, Unit};
#[cfg(feature = "desk")]
use crate::{quantity, sheet::Sheet};

/// Values of inputs over time, with straight lines between the instants; before the first
/// and after the last one they stay.
///
/// As every input they are held over a step, at their value in its middle: the error of that is
/// O(h²), as that of Heun's method.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Signals {
    times: Vec<f64>,
    inputs: Vec<(String, Vec<f64>)>,
    /// Columns of a table that are no inputs.
    skipped: Vec<String>,
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
                Err(Error::unknown("input", first, info.inputs.iter().map(|input| input.name)))
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
        let known = || info.inputs.iter().map(|input| input.name);
        let input = info.inputs.iter().find(|input| input.name == name);
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
        Ok(Self { times: sheet.times, inputs: vec![(name.to_owned(), values)], skipped: Vec::new() })
    }

    /// The inputs of both, at the instants of both.
    ///
    /// # Errors
    /// [`Error::Name`] for an input that both have.
    pub fn with(self, other: Self) -> Result<Self, Error> {
        if let Some(name) = self.names().find(|name| other.names().any(|other| other == *name)) {
            let reason = "two tables have it; leave one of them out".into();
            return Err(Error::Name { name: name.to_owned(), reason });
        }
        let mut times = [&self.times[..], &other.times].concat();
        times.sort_by(f64::total_cmp);
        times.dedup();
        let mut inputs = Vec::new();
        for of in [&self, &other] {
            for (name, values) in &of.inputs {
                let table = InputTable::new(of.times.clone(), vec![(0, values.clone())])?;
                let at = |t: &f64| {
                    let mut value = [f64::NAN];
                    table.set(*t, &mut value);
                    value[0]
                };
                inputs.push((name.clone(), times.iter().map(at).collect()));
            }
        }
        Ok(Self { times, inputs, skipped: [self.skipped, other.skipped].concat() })
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
            let known = || info.inputs.iter().map(|input| input.name);
            let input = info.inputs.iter().find(|input| input.name == name);
            let unit = Unit::of(input.ok_or_else(|| Error::unknown("input", &name, known()))?);
            if values.len() != times.len() || !is_finite(&values) {
                return refused(&name, "an input that changes has a finite value at each of the times");
            }
            inputs.push((name, values.into_iter().map(|value| unit.read(value)).collect()));
        }
        Ok(Self { times, inputs, skipped: Vec::new() })
    }

    /// When the table begins and ends, in s.
    pub fn span(&self) -> [f64; 2] {
        [self.times.first(), self.times.last()].map(|end| end.copied().unwrap_or(0.0))
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
            let Some(input) = info.inputs.iter().find(|input| input.name == column.name) else { continue };
            let values = sheet.complete(column, |text| quantity::parse_as(input, text))?;
            inputs.push((input.name.to_owned(), values));
        }
        Ok(Self { times: sheet.times.clone(), inputs, skipped: Vec::new() })
    }

    /// The names of the inputs.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.inputs.iter().map(|(name, _)| name.as_str())
    }

    /// The same by the places of the inputs of a mechanism.
    ///
    /// # Errors
    /// [`Error::Unknown`] for an input that it does not have.
    pub fn table(&self, info: &Info) -> Result<Arc<InputTable>, Error> {
        let known = || info.inputs.iter().map(|input| input.name);
        let column = |(name, values): &(String, Vec<f64>)| {
            let place = known().position(|input| input == name);
            Ok((place.ok_or_else(|| Error::unknown("input", name, known()))?, values.clone()))
        };
        let columns = self.inputs.iter().map(column).collect::<Result<_, Error>>()?;
        Ok(Arc::new(InputTable::new(self.times.clone(), columns)?))
    }
}

#[cfg(test)]
mod tests {
    use mbs_runtime::Mechanism;

    use super::*;
    use crate::{Settings, model};

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
    fn values_have_the_units_of_their_headings() {
        let given = |text| {
            let signals = read(text).unwrap();
            (signals.times, signals.inputs)
        };
        let push = |values: &[f64]| vec![("push".to_owned(), values.to_vec())];
        assert_eq!(given("t [ms], push [N]\n0, 0\n1000, 500\n"), (vec![0.0, 1.0], push(&[0.0, 500.0])));
        assert_eq!(given("t,push\n0,2"), (vec![0.0], push(&[2000.0])));
    }

    /// ẋ(2 s) = (½ · 500 N · 1 s + 500 N · 1 s)/1000 kg: Heun's method has the mean of a line.
    #[test]
    fn a_run_follows_them() {
        let signals = read("t,push [N]\n0,0\n1,500\n2,500").unwrap();
        let settings = Settings { end: 2.0, step: 1e-3, signals: Some(signals), ..Settings::default() };
        let run = model::of::<Cart>().simulate(&settings, &mut |_, _| ()).unwrap();
        let speed = *run.column("der(x)").unwrap().values.last().unwrap();
        assert!((speed - 0.75).abs() < 1e-12, "{speed}");
    }

    #[test]
    fn tables_that_are_none() {
        let message = |text| read(text).unwrap_err().to_string();
        assert!(message("t,pull\n0,1").contains("no input `pull`, did you mean `push`?"));
        assert!(message("t,push\n0,1\n0,2").contains("line 3: time = `0`: time has to rise"));
        assert!(message("t,push\n0,x").contains("line 2: push = `x`"), "{}", message("t,push\n0,x"));
        assert!(message("t,push [mm]\n0,1").contains("a length [m] was given"));
        assert!(message("t,push\n").contains("a row"));
        assert!(message("t,push\n0,").contains("line 2: push = ``: it needs a value"));
        assert!(message("t,push,push\n0,1,2").contains("two columns"));
    }
}
