//! Dimensions for a path, a function or given positions.

use mbs_analysis::{Signal, Synthesis, Task, Unknown, Variable};
use mbs_runtime::Info;
use mbs_workbench::{Error, RunOptions, Start, Unit, quantity};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::asked::Asked;
use crate::derivatives::named;
use crate::error;
use crate::mechanism::Mechanism;
use crate::watched::{Watch, watched};

/// The positions that a mechanism is to pass, and the parameters that may be changed.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct AskedTask {
    /// Coordinates and outputs, and their values at each position in declared units; NaN for one that is free.
    positions: Vec<(String, Vec<f64>)>,
    /// Parameters and the texts of their bounds.
    unknown: Vec<(String, String, String)>,
    drive: Option<String>,
    /// In SI units.
    tolerance: Option<f64>,
    starts: Option<usize>,
    enough: Option<usize>,
    seed: Option<u64>,
}

#[pymethods]
impl Mechanism {
    /// Looks for dimensions with which the mechanism passes given positions.
    #[pyo3(signature = (asked, task, progress=None))]
    fn synthesize<'py>(
        &self,
        py: Python<'py>,
        asked: Asked,
        task: AskedTask,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let wrong = |error: Error| error::of(py, &error);
        let info = self.model.info();
        let options = asked.options(info).map_err(wrong)?;
        let task = self.task(&options, &task).map_err(wrong)?;
        let found = watched(py, progress.as_ref(), |watch| self.synthesized(&task, watch))?;
        shown(py, info, &task, &found.map_err(wrong)?)
    }
}

impl Mechanism {
    fn task(&self, options: &RunOptions, asked: &AskedTask) -> Result<Task, Error> {
        let model = self.model.as_ref();
        let info = model.info();
        let of_position =
            |signal: &Signal| matches!(signal.variable, Variable::Coordinate(_) | Variable::Output(_));
        let known: Vec<Signal> = Signal::observable(info).into_iter().filter(of_position).collect();
        let mut columns = Vec::new();
        for (name, values) in &asked.positions {
            let unit = Unit::of_signal(info, &named("coordinate or output", &known, name)?);
            columns
                .push(values.iter().map(|x| Some(unit.read(*x)).filter(|x| !x.is_nan())).collect::<Vec<_>>());
        }
        let count = columns.iter().map(Vec::len).max().unwrap_or(0);
        let row = |row: usize| columns.iter().map(|column| column.get(row).copied().flatten()).collect();
        let unknown = asked.unknown.iter().map(|bounded| unknown(info, bounded));
        let usual = Task::of(info);
        Ok(Task {
            parameters: Start::of(model, &options.values(model)?)?.parameters,
            unknown: unknown.collect::<Result<_, _>>()?,
            columns: asked.positions.iter().map(|(name, _)| name.clone()).collect(),
            positions: (0..count).map(row).collect(),
            drive: asked.drive.clone(),
            tolerance: asked.tolerance.unwrap_or(usual.tolerance),
            starts: asked.starts.unwrap_or(usual.starts),
            enough: asked.enough.unwrap_or(usual.enough),
            seed: asked.seed.unwrap_or(usual.seed),
            ..usual
        })
    }

    fn synthesized(&self, task: &Task, watch: &Watch) -> Result<Synthesis, Error> {
        let trials = self.trials()?;
        Ok(task.synthesize_while(&*trials, &mut |starts, _| {
            watch.reached(starts, task.starts);
            watch.goes_on()
        })?)
    }
}

/// A parameter and its bounds.
fn unknown(info: &Info, (name, low, high): &(String, String, String)) -> Result<Unknown, Error> {
    let known = info.parameters;
    let found = known.iter().find(|parameter| parameter.name == name);
    let found = found.ok_or_else(|| Error::unknown("parameter", name, known.iter().map(|p| p.name)))?;
    let bounds = [quantity::parse_as(found, low)?, quantity::parse_as(found, high)?];
    Ok(Unknown { name: name.clone(), guess: None, bounds })
}

/// The mechanisms that were found, in declared units.
fn shown<'py>(
    py: Python<'py>,
    info: &Info,
    task: &Task,
    synthesis: &Synthesis,
) -> PyResult<Bound<'py, PyDict>> {
    let unit = |name: &str| info.parameters.iter().find(|q| q.name == name).map(Unit::of);
    let linkages = synthesis.linkages.iter().map(|linkage| {
        let values = PyDict::new(py);
        for (unknown, value) in task.unknown.iter().zip(&linkage.values) {
            values.set_item(&unknown.name, unit(&unknown.name).map_or(*value, |unit| unit.shown(*value)))?;
        }
        let path = PyDict::new(py);
        for (at, q) in info.coordinates.iter().enumerate() {
            let column = linkage.path.iter().map(|place| place.get(at).copied().unwrap_or(f64::NAN));
            path.set_item(q.name, PyArray1::from_vec(py, column.collect()))?;
        }
        let shown = PyDict::new(py);
        shown.set_item("parameters", values)?;
        shown.set_item("missed", linkage.missed)?;
        shown.set_item("path", path)?;
        Ok(shown)
    });
    let found = PyDict::new(py);
    found.set_item("linkages", linkages.collect::<PyResult<Vec<_>>>()?)?;
    let refused =
        synthesis.refused.iter().map(|(defect, count)| (format!("{defect:?}").to_lowercase(), *count));
    found.set_item("refused", refused.collect::<Vec<_>>())?;
    found.set_item("starts", synthesis.starts)?;
    found.set_item("nearest", synthesis.nearest)?;
    Ok(found)
}
