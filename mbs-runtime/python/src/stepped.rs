//! A run that takes its steps when it is asked to, and the inputs that Python gives it.

use mbs_analysis::Signal;
use mbs_runtime::{Info, SystemClone};
use mbs_workbench::{Error, Start, StartKind, StartState, Unit, quantity};
use numpy::PyReadonlyArray1;
use numpy::ndarray::ArrayView2;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyFloat, PyInt};

use crate::error;
use crate::mechanism::Mechanism;

/// Where a run is: the time of its start, steps since then, positions, rates, and inputs in SI units.
pub type Saved = (f64, u64, Vec<f64>, Vec<f64>, Vec<f64>);

/// A run, and room for what is seen of it.
pub struct Stepped {
    run: Box<dyn SystemClone>,
    /// The time at which it started, in s.
    start_time: f64,
    /// True if it goes on with another run, whose samples have been taken.
    goes_on: bool,
    /// The inputs of the next step, in SI units.
    pub inputs: Vec<f64>,
    /// Those of the last one.
    held: Vec<f64>,
    q: Vec<f64>,
    v: Vec<f64>,
    /// The units in which positions and rates are shown.
    units: Vec<Unit>,
}

impl Clone for Stepped {
    fn clone(&self) -> Self {
        let Self { run, start_time, goes_on, inputs, held, q, v, units } = self;
        Self {
            run: run.boxed_clone(),
            start_time: *start_time,
            goes_on: *goes_on,
            inputs: inputs.clone(),
            held: held.clone(),
            q: q.clone(),
            v: v.clone(),
            units: units.clone(),
        }
    }
}

impl Stepped {
    /// A run at its start.
    pub fn begun(mechanism: &Mechanism, start: &Start) -> Result<Self, Error> {
        let (run, info) = (mechanism.model.start(start)?, mechanism.model.info());
        let n = info.coordinates.len();
        let units = Signal::states(info).iter().map(|signal| Unit::of_signal(info, signal)).collect();
        let start_time = start.state.as_ref().map_or_else(|| run.time(), |state| state.start_time);
        let goes_on = start.state.as_ref().is_some_and(|state| state.steps_taken > 0);
        let (inputs, held) = (start.inputs.clone(), start.inputs.clone());
        Ok(Self { run, start_time, goes_on, inputs, held, q: vec![f64::NAN; n], v: vec![f64::NAN; n], units })
    }

    /// The run that was where it is saved. One that has a constant step goes on to the same bits.
    pub fn restored(mechanism: &Mechanism, start: &Start, saved: Saved) -> Result<Self, Error> {
        let (start_time, steps_taken, q, v, inputs) = saved;
        let state = Some(StartState { start_time, steps_taken, q, v });
        Self::begun(mechanism, &Start { state, inputs, kind: StartKind::Declared, ..start.clone() })
    }

    /// Where it is.
    pub fn saved(&mut self) -> Saved {
        self.see();
        // a run to a tolerance counts samples from where it begins
        let is_sampled = self.run.effort().is_some();
        let start_time = if is_sampled { self.run.time() } else { self.start_time };
        let mut inputs = self.inputs.clone();
        let steps = self.run.steps().max(u64::from(self.goes_on));
        // a run at its start takes its first samples anew
        if steps > 0 {
            let mut now = inputs.clone();
            self.run.inputs(&mut now);
            let free = self.run.equations().info().free_inputs().len();
            inputs.iter_mut().zip(now).skip(free).for_each(|(memory, now)| *memory = now);
        }
        (start_time, steps, self.q.clone(), self.v.clone(), inputs)
    }

    fn see(&mut self) {
        self.run.state(&mut self.q, &mut self.v);
    }

    /// Positions and rates, one after the other, in the units in which they are shown.
    pub fn write_state(&mut self, to: &mut [f64]) {
        self.see();
        let values = self.q.iter().chain(&self.v).zip(&self.units).map(|(value, unit)| unit.shown(*value));
        to.iter_mut().zip(values).for_each(|(to, from)| *to = from);
    }

    /// Takes some steps with the inputs as they are.
    pub fn advance(&mut self, steps: u64) -> Result<(), mbs_runtime::Error> {
        // a method that carries accelerations over to the next step begins anew where inputs are set
        if self.inputs != self.held {
            self.run.set_inputs(&self.inputs);
            self.held.clone_from(&self.inputs);
        }
        self.run.advance(steps)
    }

    /// The multipliers and the outputs, in SI units.
    pub fn measured(&self, info: &Info) -> Result<[Vec<f64>; 2], mbs_runtime::Error> {
        let mut accelerations = vec![f64::NAN; info.coordinates.len()];
        let mut multipliers = vec![f64::NAN; info.constraints.len()];
        let mut outputs = vec![f64::NAN; info.outputs.len()];
        self.run.reactions(&mut accelerations, &mut multipliers)?;
        self.run.outputs(&accelerations, &multipliers, &mut outputs)?;
        Ok([multipliers, outputs])
    }

    /// The time at which it started, in s.
    pub fn start_time(&self) -> f64 {
        self.start_time
    }

    /// The run itself.
    pub fn run(&self) -> &dyn SystemClone {
        &*self.run
    }
}

/// Inputs and outputs of a mechanism, with the units in which Python gives and gets them.
pub struct Ports {
    pub info: &'static Info,
    pub inputs: Vec<Unit>,
    pub outputs: Vec<Unit>,
}

impl Ports {
    /// Those of a mechanism.
    pub fn of(info: &'static Info) -> Self {
        let units = |quantities: &[mbs_runtime::Quantity]| quantities.iter().map(Unit::of).collect();
        Self { info, inputs: units(info.free_inputs()), outputs: units(info.outputs) }
    }

    /// Takes inputs in SI units from Python: a number, numbers in their order, or numbers and texts by name.
    pub fn set(&self, given: &Bound<'_, PyAny>, inputs: &mut [f64]) -> PyResult<()> {
        if let Ok(named) = given.cast::<PyDict>() {
            return named
                .iter()
                .try_for_each(|(name, value)| self.set_one(&name.extract::<String>()?, &value, inputs));
        }
        if given.is_instance_of::<PyFloat>() || given.is_instance_of::<PyInt>() {
            return self.set_all(&[given.extract()?], given, inputs);
        }
        if let Ok(array) = given.extract::<PyReadonlyArray1<'_, f64>>() {
            return self.set_all(&array.as_array().iter().copied().collect::<Vec<_>>(), given, inputs);
        }
        let numbers: Vec<f64> = given.extract().map_err(|_| self.wrong(given))?;
        self.set_all(&numbers, given, inputs)
    }

    fn set_one(&self, name: &str, value: &Bound<'_, PyAny>, inputs: &mut [f64]) -> PyResult<()> {
        let py = value.py();
        let known = self.info.free_inputs();
        let Some(at) = known.iter().position(|input| input.name == name) else {
            return Err(error::of(py, &Error::unknown("input", name, known.iter().map(|input| input.name))));
        };
        inputs[at] = if let Ok(number) = value.extract::<f64>() {
            self.read(py, at, number)?
        } else if let Ok(text) = value.extract::<String>() {
            quantity::parse_as(&known[at], &text).map_err(|error| error::of(py, &error))?
        } else {
            let found = value.get_type().name()?.to_string();
            let message = format!("the input `{name}` takes a number or a text such as \"3 N\", not {found}");
            return Err(PyTypeError::new_err(message));
        };
        Ok(())
    }

    fn set_all(&self, numbers: &[f64], given: &Bound<'_, PyAny>, inputs: &mut [f64]) -> PyResult<()> {
        if numbers.len() != self.inputs.len() {
            return Err(self.wrong(given));
        }
        for (at, (to, from)) in inputs.iter_mut().zip(numbers).enumerate() {
            *to = self.read(given.py(), at, *from)?;
        }
        Ok(())
    }

    /// An input in SI units; what is not finite is refused before it is held.
    pub fn read(&self, py: Python<'_>, at: usize, shown: f64) -> PyResult<f64> {
        let value = self.inputs[at].read(shown);
        if value.is_finite() {
            return Ok(value);
        }
        Err(error::of_run(py, mbs_runtime::Error::Input { name: self.info.inputs[at].name, value }))
    }

    /// Refuses rows of inputs of which one is not finite.
    pub fn check(&self, py: Python<'_>, rows: ArrayView2<'_, f64>) -> PyResult<()> {
        rows.indexed_iter().try_for_each(|((_, at), value)| self.read(py, at, *value).map(drop))
    }

    /// The `TypeError` for a value that cannot be the inputs of the mechanism. Its message names what steps take.
    fn wrong(&self, given: &Bound<'_, PyAny>) -> PyErr {
        let found = given.get_type().name().map_or_else(|_| "that".to_owned(), |name| name.to_string());
        let found = given.len().map_or(found.clone(), |count| format!("{found} of {count}"));
        let name = self.info.name;
        let names: Vec<&str> = self.info.free_inputs().iter().map(|input| input.name).collect();
        PyTypeError::new_err(match &names[..] {
            [] => format!("{name} has no inputs, so its steps take none"),
            [input] => {
                format!("{name} has one input, `{input}`: its steps take a number or a dict, not {found}")
            }
            _ => format!(
                "{name} has {} inputs ({}): its steps take a number for each in this order, or a dict, not {found}",
                names.len(),
                names.join(", ")
            ),
        })
    }
}
