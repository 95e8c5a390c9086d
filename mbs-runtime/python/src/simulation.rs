//! A mechanism in the loop of a Python program.

use std::sync::{Mutex, MutexGuard, PoisonError};

use mbs_analysis::Signal;
use mbs_runtime::Info;
use mbs_workbench::{Error, Settings, Start, StartState, Unit};
use numpy::ndarray::Array2;
use numpy::{PyArray1, PyArray2, PyReadonlyArray2};
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;

use crate::asked::Asked;
use crate::error;
use crate::mechanism::Mechanism;
use crate::stepped::{Ports, Saved, Stepped};

/// Settings and start of a run in a loop. Its end is at infinity, so that it bounds no step.
pub(crate) fn start(mechanism: &Mechanism, asked: Asked) -> Result<(Settings, Start), Error> {
    let model = mechanism.model.as_ref();
    let options = asked.options(model.info())?;
    let settings = Settings { end: f64::INFINITY, ..options.settings(model)? };
    let start = Start::of(model, &settings)?;
    Ok((settings, start))
}

/// The same at a state that is given whole, positions and rates in their order; it has to be consistent.
pub(crate) fn at(start: &Start, start_time: f64, mut state: Vec<f64>) -> Start {
    let v = state.split_off(state.len() / 2);
    Start { state: Some(StartState { start_time, steps_taken: 0, q: state, v }), ..start.clone() }
}

/// A row for each step, or for each run.
type Rows<'py> = Bound<'py, PyArray2<f64>>;

/// Name and unit.
type Named = (String, String);

/// Positions, then rates.
fn states(info: &Info) -> Vec<Named> {
    let named = |signal: Signal| {
        let unit = Unit::of_signal(info, &signal).name().to_owned();
        (signal.name, unit)
    };
    Signal::states(info).into_iter().map(named).collect()
}

/// Room for so many rows, if there is.
fn rows_of(count: usize, width: usize) -> PyResult<Array2<f64>> {
    let none = || PyMemoryError::new_err(format!("there is no memory for {count} rows of {width} numbers"));
    let numbers = count.checked_mul(width).ok_or_else(none)?;
    let mut room = Vec::new();
    room.try_reserve_exact(numbers).map_err(|_| none())?;
    room.resize(numbers, f64::NAN);
    Array2::from_shape_vec((count, width), room).map_err(|_| none())
}

pub(crate) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // a run that panicked is where its last good step ended
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// So many steps are taken without looking whether the program is interrupted,
pub(crate) const UNWATCHED: u64 = 4096;

/// and so many samples of a run to a tolerance, each of which may take many steps.
const UNWATCHED_SAMPLES: u64 = 16;

/// A mechanism in motion, step by step.
#[pyclass(frozen, module = "mbs._native")]
pub struct Simulation {
    mechanism: Py<Mechanism>,
    ports: Ports,
    settings: Settings,
    start: Start,
    run: Mutex<Stepped>,
}

impl Simulation {
    fn copied(&self, py: Python<'_>, run: Stepped) -> Self {
        Self {
            mechanism: self.mechanism.clone_ref(py),
            ports: Ports::of(self.ports.info),
            settings: self.settings.clone(),
            start: self.start.clone(),
            run: Mutex::new(run),
        }
    }

    fn places(&self) -> usize {
        2 * self.ports.info.coordinates.len()
    }

    fn outputs_of(&self, run: &Stepped) -> Result<Vec<f64>, mbs_runtime::Error> {
        let [_, mut outputs] = run.measured(self.ports.info)?;
        outputs.iter_mut().zip(&self.ports.outputs).for_each(|(value, unit)| *value = unit.shown(*value));
        Ok(outputs)
    }
}

#[pymethods]
impl Simulation {
    /// A run at its start.
    #[new]
    fn new(mechanism: Bound<'_, Mechanism>, asked: Asked) -> PyResult<Self> {
        let py = mechanism.py();
        let native = mechanism.get();
        let begun = start(native, asked).and_then(|(settings, start)| {
            let run = Mutex::new(Stepped::begun(native, &start)?);
            Ok((settings, start, run))
        });
        let (settings, start, run) = begun.map_err(|error| error::of(py, &error))?;
        let ports = Ports::of(native.model.info());
        Ok(Self { mechanism: mechanism.unbind(), ports, settings, start, run })
    }

    /// Names and units of the state.
    fn states(&self) -> Vec<Named> {
        states(self.ports.info)
    }

    /// Time in s, steps since the start, and the length of a step in s.
    fn clock(&self) -> (f64, u64, f64) {
        let run = lock(&self.run);
        (run.run().time(), run.run().steps(), run.run().step_size())
    }

    /// Positions, then rates.
    fn state<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let mut state = vec![f64::NAN; self.places()];
        lock(&self.run).write_state(&mut state);
        PyArray1::from_vec(py, state)
    }

    /// The inputs, in their units.
    fn inputs<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let run = lock(&self.run);
        let shown = run.inputs.iter().zip(&self.ports.inputs).map(|(value, unit)| unit.shown(*value));
        PyArray1::from_iter(py, shown)
    }

    /// Sets inputs, which are held over the steps that follow.
    fn set_inputs(&self, given: &Bound<'_, PyAny>) -> PyResult<()> {
        let mut inputs = lock(&self.run).inputs.clone();
        self.ports.set(given, &mut inputs)?;
        lock(&self.run).inputs = inputs;
        Ok(())
    }

    /// The outputs, in their units.
    fn outputs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let outputs = self.outputs_of(&lock(&self.run));
        Ok(PyArray1::from_vec(py, outputs.map_err(|error| error::of_run(py, error))?))
    }

    /// The multipliers, in SI units.
    fn multipliers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let measured = lock(&self.run).measured(self.ports.info);
        let [multipliers, _] = measured.map_err(|error| error::of_run(py, error))?;
        Ok(PyArray1::from_vec(py, multipliers))
    }

    /// Takes some steps, with these inputs if some are given; the state after them.
    #[pyo3(signature = (inputs=None, steps=1))]
    fn step<'py>(
        &self,
        py: Python<'py>,
        inputs: Option<&Bound<'py, PyAny>>,
        steps: u64,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        if let Some(given) = inputs {
            self.set_inputs(given)?;
        }
        let is_sampled = lock(&self.run).run().effort().is_some();
        let unwatched = if is_sampled { UNWATCHED_SAMPLES } else { UNWATCHED };
        let mut left = steps;
        while left > 0 {
            let some = left.min(unwatched);
            let taken = if some == 1 {
                lock(&self.run).advance(1)
            } else {
                py.detach(|| lock(&self.run).advance(some))
            };
            taken.map_err(|error| error::of_run(py, error))?;
            left -= some;
            if left > 0 {
                py.check_signals()?;
            }
        }
        Ok(self.state(py))
    }

    /// A step with each row of inputs; the states after them, and the outputs there if they are wanted.
    fn advance<'py>(
        &self,
        py: Python<'py>,
        inputs: PyReadonlyArray2<'py, f64>,
        has_outputs: bool,
    ) -> PyResult<(Rows<'py>, Option<Rows<'py>>)> {
        let inputs = inputs.as_array().to_owned();
        self.ports.check(py, inputs.view())?;
        let count = inputs.nrows();
        let mut states = rows_of(count, self.places())?;
        let width = if has_outputs { self.ports.outputs.len() } else { 0 };
        let mut outputs = rows_of(count, width)?;
        let rows = inputs.outer_iter().zip(states.outer_iter_mut()).zip(outputs.outer_iter_mut());
        let mut rows = rows.peekable();
        while rows.peek().is_some() {
            let some = rows.by_ref().take(UNWATCHED as usize);
            let taken = py.detach(|| -> Result<(), mbs_runtime::Error> {
                let mut run = lock(&self.run);
                for ((inputs, mut state), mut outputs) in some {
                    let given = inputs.iter().zip(&self.ports.inputs).map(|(value, unit)| unit.read(*value));
                    run.inputs.iter_mut().zip(given).for_each(|(input, value)| *input = value);
                    run.advance(1)?;
                    if let Some(state) = state.as_slice_mut() {
                        run.write_state(state);
                    }
                    if has_outputs {
                        let measured = self.outputs_of(&run)?;
                        outputs.iter_mut().zip(measured).for_each(|(to, from)| *to = from);
                    }
                }
                Ok(())
            });
            taken.map_err(|error| error::of_run(py, error))?;
            py.check_signals()?;
        }
        drop(rows);
        let outputs = has_outputs.then(|| PyArray2::from_owned_array(py, outputs));
        Ok((PyArray2::from_owned_array(py, states), outputs))
    }

    /// Back to the start, with other values in it, or to a state that is given whole.
    #[pyo3(signature = (values, state=None, t=None))]
    fn reset(
        &self,
        py: Python<'_>,
        values: Vec<(String, String)>,
        state: Option<Vec<f64>>,
        t: Option<f64>,
    ) -> PyResult<()> {
        let native = self.mechanism.get();
        let begun = (|| -> Result<Stepped, Error> {
            let model = native.model.as_ref();
            let mut start = match state {
                Some(state) => at(&self.start, t.unwrap_or_else(|| lock(&self.run).start_time()), state),
                None if values.is_empty() => self.start.clone(),
                None => {
                    let given = StartState::values(model.info(), &values)?;
                    let kept = self
                        .settings
                        .from
                        .iter()
                        .filter(|(name, _)| given.iter().all(|(new, _)| new != name));
                    let values: Vec<_> = kept.cloned().chain(given.iter().cloned()).collect();
                    Start { state: None, ..self.start.clone() }.with_values(model, &values)?
                }
            };
            start.inputs.clone_from(&self.start.inputs);
            Stepped::begun(native, &start)
        })();
        *lock(&self.run) = begun.map_err(|error| error::of(py, &error))?;
        Ok(())
    }

    /// A copy, which goes on by itself.
    fn copy(&self, py: Python<'_>) -> Self {
        let run = lock(&self.run).clone();
        self.copied(py, run)
    }

    /// Where the run is, for another process.
    fn saved(&self) -> Saved {
        lock(&self.run).saved()
    }

    /// The run that was where it is saved.
    fn restored(&self, py: Python<'_>, saved: Saved) -> PyResult<Self> {
        let run = Stepped::restored(self.mechanism.get(), &self.start, saved);
        Ok(self.copied(py, run.map_err(|error| error::of(py, &error))?))
    }
}
