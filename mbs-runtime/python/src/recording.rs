//! A run that was recorded.

use mbs_workbench::{Column, Settings};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error;
use crate::mechanism::Mechanism;

/// Columns of numbers, and what there is to say about a run.
#[pyclass(frozen, module = "mbs._native")]
pub struct Recording {
    mechanism: Py<Mechanism>,
    settings: Settings,
    recording: mbs_workbench::Recording,
}

impl Recording {
    pub fn new(mechanism: Py<Mechanism>, settings: Settings, recording: mbs_workbench::Recording) -> Self {
        Self { mechanism, settings, recording }
    }
}

/// Name, unit and values.
type Named<'py> = (String, String, Bound<'py, PyArray1<f64>>);

#[pymethods]
impl Recording {
    /// Name, unit and values of each column, the time first; of those that fit some patterns, if such are given.
    #[pyo3(signature = (patterns=None))]
    fn columns<'py>(&self, py: Python<'py>, patterns: Option<Vec<String>>) -> PyResult<Vec<Named<'py>>> {
        let of = |column: &Column| {
            (column.name.clone(), column.unit.clone(), PyArray1::from_slice(py, &column.values))
        };
        let Some(patterns) = patterns else { return Ok(self.recording.columns.iter().map(of).collect()) };
        let named = ["t"].into_iter().chain(patterns.iter().map(String::as_str));
        let found = self.recording.select(named).map_err(|error| error::of(py, &error))?;
        Ok(found.into_iter().map(of).collect())
    }

    /// The figures of the run that one looks at first.
    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let summary = &self.recording.summary;
        let found = PyDict::new(py);
        found.set_item("steps", summary.effort.map_or(summary.steps, |effort| effort.steps))?;
        found.set_item("rejected", summary.effort.map(|effort| effort.rejected))?;
        found.set_item("end", summary.end)?;
        found.set_item("violation", summary.max_phi)?;
        found.set_item("violation_rate", summary.max_phi_dot)?;
        found.set_item("energy_start", summary.energy_start)?;
        found.set_item("energy_end", summary.energy_end)?;
        Ok(found)
    }

    /// Name, time in s and direction of each event.
    fn events(&self) -> Vec<(String, f64, bool)> {
        let events = self.recording.occurrences.iter();
        events.map(|event| (event.name.clone(), event.t, event.is_rising)).collect()
    }

    /// The condition that was to end the run and did not.
    fn unmet(&self) -> Option<String> {
        self.recording.unmet.as_ref().map(|unmet| unmet.condition.clone())
    }

    /// Why the run ended early, if it did.
    fn ended(&self) -> Option<String> {
        self.recording.ended.map(|error| error::pythonic(&error.to_string()))
    }

    /// Why its numbers should not be trusted.
    fn doubts(&self) -> Vec<String> {
        self.recording.doubts.iter().map(|doubt| error::pythonic(&doubt.to_string())).collect()
    }

    /// Notes on how the run differs from what one may expect, in the words of Python.
    fn notes(&self) -> Vec<String> {
        self.recording.notes.iter().map(|note| error::pythonic(note)).collect()
    }

    /// A page with the mechanism in motion and its curves.
    fn page(&self, py: Python<'_>) -> PyResult<String> {
        let model = self.mechanism.get().model.as_ref();
        let page = model.page(model.info().name, &self.settings, &self.recording);
        page.and_then(|page| page.html()).map_err(|error| error::of(py, &error))
    }
}
