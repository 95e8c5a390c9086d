//! Inputs that change during a run.

use std::path::Path;

use mbs_runtime::{Info, System};

use crate::sheet::Sheet;
use crate::{Error, Settings, Unit, quantity};

/// Values of inputs over time, with straight lines between the instants; before the first
/// and after the last one they stay.
///
/// As every input they are held over a step, at their value in its middle: the error of that is
/// O(h²), as that of Heun's method.
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
        let sheet = Sheet::read(path)?;
        sheet.are_known("input", info.inputs)?;
        Self::of(&sheet, info)
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
        Ok(Self { times, inputs })
    }

    /// The inputs among the columns of a table.
    ///
    /// # Errors
    /// [`Error::Value`] for what is no number.
    pub(crate) fn of(sheet: &Sheet, info: &Info) -> Result<Self, Error> {
        let mut inputs = Vec::new();
        for column in &sheet.columns {
            let Some(input) = info.inputs.iter().find(|input| input.name == column.name) else { continue };
            let values = sheet.complete(column, |text| quantity::parse_as(input, text))?;
            inputs.push((input.name.to_owned(), values));
        }
        Ok(Self { times: sheet.times.clone(), inputs })
    }

    /// The names of the inputs.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.inputs.iter().map(|(name, _)| name.as_str())
    }

    /// The value of an input at a time in s, by its place in [`Info`]; nothing of inputs that do not change.
    pub fn by_place(self, info: &Info) -> impl Fn(f64, usize) -> Option<f64> + use<> {
        let numbers: Vec<Option<usize>> =
            info.inputs.iter().map(|input| self.names().position(|name| name == input.name)).collect();
        move |t: f64, place: usize| Some(self.value((*numbers.get(place)?)?, t))
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
        let t = run.time() + 0.5 * run.step_size();
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

    /// ẋ(2 s) = (½ · 500 N · 1 s + 500 N · 1 s)/1000 kg: the middle of a step has the mean of a line.
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
