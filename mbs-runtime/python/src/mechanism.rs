//! A compiled mechanism.
//!
//! A mechanism is a `Box<dyn Model>`, so that a text and a type are the same to Python.

use std::path::PathBuf;

use mbs_analysis::Trials;
use mbs_live::Text;
use mbs_runtime::Quantity;
use mbs_workbench::{Error, Model, Unit, model};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::asked::Asked;
use crate::error;
use crate::recording::Recording;
use crate::watched::watched;

/// A mechanism that was compiled, by whomever.
#[pyclass(frozen, module = "mbs._native")]
pub struct Mechanism {
    pub(crate) model: Box<dyn Model>,
}

/// Compiles a declaration: the text that is given, or the contents of a file. `name` chooses among several
/// mechanisms in a Rust file.
#[pyfunction]
#[pyo3(signature = (text, file, name=None))]
pub fn compile(
    py: Python<'_>,
    text: Option<String>,
    file: PathBuf,
    name: Option<String>,
) -> PyResult<Mechanism> {
    let text = match text {
        Some(text) if file.extension().is_some_and(|ending| ending == "rs") => {
            Text::rust(file.display().to_string(), text)
        }
        Some(text) => Text::declaration(file.display().to_string(), text),
        None => Text::read(&file)?,
    };
    // a text that no file has is called `declaration`
    let text = match file.extension().and(file.parent()) {
        Some(folder) => text.in_folder(folder),
        None => text,
    };
    let text = match name {
        Some(name) => text.named(name),
        None => text,
    };
    let compiled = py.detach(|| model::as_declared(&text));
    compiled.map(Mechanism::of).map_err(|error| error::of(py, &error))
}

/// Name, documentation, unit and value, in that unit.
type Described = (&'static str, &'static str, String, f64);

fn described(quantities: &'static [Quantity], unit: impl Fn(&Quantity) -> Unit) -> Vec<Described> {
    let of = |q: &'static Quantity| {
        let unit = unit(q);
        (q.name, q.doc, unit.name().to_owned(), unit.shown(q.default))
    };
    quantities.iter().map(of).collect()
}

impl Mechanism {
    /// A model as a Python object.
    pub fn of(model: Box<dyn Model>) -> Self {
        Self { model }
    }

    /// Its runs with derivatives.
    pub(crate) fn trials(&self) -> Result<Box<dyn Trials + Sync + '_>, Error> {
        self.model.trials().ok_or_else(|| Error::Name {
            name: self.model.info().name.to_owned(),
            reason: "its type was compiled without derivatives".into(),
        })
    }
}

#[pymethods]
impl Mechanism {
    /// Names, units and declared values.
    fn info<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let info = self.model.info();
        let found = PyDict::new(py);
        found.set_item("name", info.name)?;
        found.set_item("doc", info.doc)?;
        found.set_item("dof", info.dof)?;
        found.set_item("parameters", described(info.parameters, Unit::of))?;
        found.set_item("inputs", described(info.free_inputs(), Unit::of))?;
        found.set_item("memories", described(info.memories(), Unit::of))?;
        let modes: Vec<_> = info.modes.modes.iter().map(|mode| mode.name).collect();
        found.set_item("modes", modes)?;
        let (coordinates, states) = info.coordinates.split_at(info.lines.min(info.coordinates.len()));
        found.set_item("coordinates", described(coordinates, Unit::of_coordinate))?;
        found.set_item("states", described(states, Unit::of))?;
        found.set_item("outputs", described(info.outputs, Unit::of))?;
        let rows = info.constraints.iter();
        let rows: Vec<_> = rows
            .map(|row| (row.name, row.doc, Unit::of_multiplier(row.dimension).name().to_owned(), row.formula))
            .collect();
        found.set_item("constraints", rows)?;
        let events: Vec<_> = info.events.iter().map(|event| (event.name, event.doc)).collect();
        found.set_item("events", events)?;
        Ok(found)
    }

    /// The equations, their elimination and its cost.
    fn explanation(&self) -> String {
        self.model.explanation()
    }

    /// The same as a LaTeX document.
    fn latex(&self) -> String {
        self.model.latex()
    }

    /// A run, recorded.
    #[pyo3(signature = (asked, progress=None))]
    fn simulate(slf: Bound<'_, Self>, asked: Asked, progress: Option<Py<PyAny>>) -> PyResult<Recording> {
        let py = slf.py();
        let model = slf.get().model.as_ref();
        let settings = asked.options(model.info()).and_then(|options| options.settings(model));
        let settings = settings.map_err(|error| error::of(py, &error))?;
        let recorded = watched(py, progress.as_ref(), |watch| {
            model.simulate_while(&settings, &mut |done, all| {
                watch.reached(done as usize, all as usize);
                watch.goes_on()
            })
        })?;
        let recording = recorded.map_err(|error| error::of(py, &error))?;
        Ok(Recording::new(slf.unbind(), settings, recording))
    }
}
