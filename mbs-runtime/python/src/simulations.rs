//! Runs of a mechanism side by side in the loop of a Python program.

use std::sync::Mutex;

use mbs_workbench::{Error, Start};
use numpy::ndarray::Array2;
use numpy::{PyArray1, PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;
use rayon::prelude::*;

use crate::asked::Asked;
use crate::error;
use crate::mechanism::Mechanism;
use crate::simulation::{UNWATCHED, at, lock, start};
use crate::stepped::{Ports, Saved, Stepped};
use crate::sweep::{Axis, Values};

/// A thread takes so many of the runs side by side at least.
const LEAST_SHARE: usize = 32;

/// Runs of one mechanism side by side.
#[pyclass(frozen, module = "mbs._native")]
pub struct Simulations {
    mechanism: Py<Mechanism>,
    ports: Ports,
    members: Mutex<Vec<Member>>,
}

/// One of them.
#[derive(Clone)]
struct Member {
    start: Start,
    run: Stepped,
    /// Why it does not go on.
    failure: Option<String>,
}

#[pymethods]
impl Simulations {
    /// Runs at their starts: `parameters` and `values` of the start have one value for each.
    #[new]
    fn new(
        mechanism: Bound<'_, Mechanism>,
        asked: Asked,
        count: usize,
        parameters: Vec<(String, Values)>,
        values: Vec<(String, Vec<f64>)>,
    ) -> PyResult<Self> {
        let py = mechanism.py();
        let native = mechanism.get();
        let info = native.model.info();
        let axes = parameters.into_iter().map(|(name, values)| Axis::of(info, name, values));
        let axes: Vec<Axis> = axes.collect::<Result<_, _>>().map_err(|error| error::of(py, &error))?;
        let begun = start(native, asked).and_then(|(settings, start)| {
            let member = |index: usize| -> Result<Member, Error> {
                let mut own = Start { state: None, ..start.clone() };
                for Axis { name, values } in &axes {
                    let place = info.parameters.iter().position(|parameter| parameter.name == name);
                    if let (Some(place), Some(value)) = (place, values.get(index)) {
                        own.parameters[place] = *value;
                    }
                }
                let mut from = settings.from.clone();
                from.extend(values.iter().filter_map(|(name, of)| Some((name.clone(), *of.get(index)?))));
                if !from.is_empty() {
                    own = own.with_values(native.model.as_ref(), &from)?;
                }
                let run = Stepped::begun(native, &own)?;
                Ok(Member { start: own, run, failure: None })
            };
            py.detach(|| (0..count).into_par_iter().map(member).collect::<Result<Vec<_>, _>>())
        });
        let members = Mutex::new(begun.map_err(|error| error::of(py, &error))?);
        Ok(Self { mechanism: mechanism.unbind(), ports: Ports::of(info), members })
    }

    /// Times in s.
    fn times<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_iter(py, lock(&self.members).iter().map(|member| member.run.run().time()))
    }

    /// A row for each run with its positions, then its rates; NaN where it failed.
    fn state<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let mut members = lock(&self.members);
        let mut states = Array2::from_elem((members.len(), 2 * self.ports.info.coordinates.len()), f64::NAN);
        for (member, mut row) in members.iter_mut().zip(states.outer_iter_mut()) {
            if let (None, Some(row)) = (&member.failure, row.as_slice_mut()) {
                member.run.write_state(row);
            }
        }
        PyArray2::from_owned_array(py, states)
    }

    /// A row for each run with its outputs; NaN where it failed, or has none.
    fn outputs<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let Self { ports, members, .. } = self;
        let members = lock(members);
        let mut outputs = Array2::from_elem((members.len(), ports.outputs.len()), f64::NAN);
        for (member, mut row) in members.iter().zip(outputs.outer_iter_mut()) {
            if let (None, Ok([_, measured])) = (&member.failure, member.run.measured(ports.info)) {
                let shown = measured.iter().zip(&ports.outputs).map(|(value, unit)| unit.shown(*value));
                row.iter_mut().zip(shown).for_each(|(to, from)| *to = from);
            }
        }
        PyArray2::from_owned_array(py, outputs)
    }

    /// Which runs failed since they were reset, and why.
    fn failures(&self) -> Vec<(usize, String)> {
        let members = lock(&self.members);
        let failed = members.iter().enumerate();
        failed.filter_map(|(at, member)| Some((at, member.failure.clone()?))).collect()
    }

    /// Takes some steps of all runs, with a row of inputs for each if they are given.
    #[pyo3(signature = (inputs, steps))]
    fn step(&self, py: Python<'_>, inputs: Option<PyReadonlyArray2<'_, f64>>, steps: u64) -> PyResult<()> {
        if let Some(inputs) = inputs {
            self.ports.check(py, inputs.as_array())?;
            let mut members = lock(&self.members);
            for (member, row) in members.iter_mut().zip(inputs.as_array().outer_iter()) {
                let given = row.iter().zip(&self.ports.inputs).map(|(value, unit)| unit.read(*value));
                member.run.inputs.iter_mut().zip(given).for_each(|(input, value)| *input = value);
            }
        }
        let mut left = steps;
        while left > 0 {
            let some = left.min(UNWATCHED);
            py.detach(|| {
                lock(&self.members).par_iter_mut().with_min_len(LEAST_SHARE).for_each(|member| {
                    if member.failure.is_none() {
                        let failure = member.run.advance(some).err();
                        member.failure = failure.map(|error| error::pythonic(&error.to_string()));
                    }
                })
            });
            left -= some;
            py.check_signals()?;
        }
        Ok(())
    }

    /// Some runs back to their starts, or to the states that are given whole, a row for each.
    #[pyo3(signature = (which, states=None, t=None))]
    fn reset(
        &self,
        py: Python<'_>,
        which: Vec<usize>,
        states: Option<PyReadonlyArray2<'_, f64>>,
        t: Option<f64>,
    ) -> PyResult<()> {
        let native = self.mechanism.get();
        let states = states.map(|states| states.as_array().to_owned());
        let mut members = lock(&self.members);
        for (row, index) in which.into_iter().enumerate() {
            let Some(member) = members.get_mut(index) else { continue };
            let begun = match &states {
                Some(states) => {
                    at(&member.start, t.unwrap_or_else(|| member.run.start_time()), states.row(row).to_vec())
                }
                None => member.start.clone(),
            };
            let run = Stepped::begun(native, &begun).map_err(|error| error::of(py, &error))?;
            (member.run, member.failure) = (run, None);
        }
        Ok(())
    }

    /// Where the runs are, for another process.
    fn saved(&self) -> Vec<(Saved, Option<String>)> {
        lock(&self.members).iter_mut().map(|member| (member.run.saved(), member.failure.clone())).collect()
    }

    /// Puts the runs where they are saved.
    fn restore(&self, py: Python<'_>, saved: Vec<(Saved, Option<String>)>) -> PyResult<()> {
        let native = self.mechanism.get();
        for (member, (saved, failure)) in lock(&self.members).iter_mut().zip(saved) {
            let run = Stepped::restored(native, &member.start, saved);
            (member.run, member.failure) = (run.map_err(|error| error::of(py, &error))?, failure);
        }
        Ok(())
    }

    /// A copy, whose runs go on by themselves.
    fn copy(&self, py: Python<'_>) -> Self {
        Self {
            mechanism: self.mechanism.clone_ref(py),
            ports: Ports::of(self.ports.info),
            members: Mutex::new(lock(&self.members).clone()),
        }
    }
}
