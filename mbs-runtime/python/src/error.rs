//! What goes wrong, as the exceptions that the package declares in Python.

use mbs_live::{Location, Note, Problem};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

/// The exceptions stand in Python, so that modules of other mechanisms raise the same.
const MODULE: &str = "mbs.errors";

/// An exception of the package with a message.
pub fn raised(py: Python<'_>, message: &str) -> PyErr {
    instance(py, "Error", (message,)).unwrap_or_else(|error| error)
}

/// What the workbench says.
pub fn of(py: Python<'_>, error: &mbs_workbench::Error) -> PyErr {
    match error {
        mbs_workbench::Error::Declaration(error) => of_declaration(py, error),
        other => raised(py, &other.to_string()),
    }
}

/// What an analysis says.
pub fn of_analysis(py: Python<'_>, error: mbs_analysis::Error) -> PyErr {
    of(py, &error.into())
}

/// What is wrong with a declaration: its text with the underlined source, and all problems for tools.
pub fn of_declaration(py: Python<'_>, error: &mbs_live::Error) -> PyErr {
    let problems = || -> PyResult<Bound<'_, PyList>> {
        let list = PyList::empty(py);
        for found in error.problems() {
            list.append(problem(py, found)?)?;
        }
        Ok(list)
    };
    let text = error.to_string();
    let made = problems().and_then(|problems| instance(py, "DeclarationError", (text.trim_end(), problems)));
    made.unwrap_or_else(|error| error)
}

fn instance<'py>(
    py: Python<'py>,
    class: &str,
    arguments: impl pyo3::call::PyCallArgs<'py>,
) -> PyResult<PyErr> {
    Ok(PyErr::from_value(py.import(MODULE)?.getattr(class)?.call1(arguments)?))
}

fn problem<'py>(py: Python<'py>, problem: &Problem) -> PyResult<Bound<'py, PyDict>> {
    let Problem { message, location, help, notes } = problem;
    let found = placed(py, message, location.as_ref())?;
    found.set_item("help", help)?;
    let list = PyList::empty(py);
    for Note { message, location } in notes {
        list.append(placed(py, message, location.as_ref())?)?;
    }
    found.set_item("notes", list)?;
    Ok(found)
}

fn placed<'py>(py: Python<'py>, message: &str, location: Option<&Location>) -> PyResult<Bound<'py, PyDict>> {
    let found = PyDict::new(py);
    found.set_item("message", message)?;
    for (name, value) in [
        ("line", location.map(|place| place.line)),
        ("column", location.map(|place| place.column)),
        ("length", location.map(|place| place.length)),
    ] {
        found.set_item(name, value)?;
    }
    Ok(found)
}
