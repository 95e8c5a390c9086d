//! Errors as the exceptions that the package declares in Python.
//!
//! The package declares the exceptions, so that a module of other mechanisms (`module!`) raises the same
//! ones.

use mbs_live::{Location, Note, Problem};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

/// The exceptions stand in Python, so that modules of other mechanisms raise the same.
const MODULE: &str = "mbs.errors";

/// An exception of the package with a message.
pub fn raised(py: Python<'_>, message: &str) -> PyErr {
    instance(py, "Error", (message,)).unwrap_or_else(|error| error)
}

/// The Python exception for an error of the workbench.
pub fn of(py: Python<'_>, error: &mbs_workbench::Error) -> PyErr {
    match error {
        mbs_workbench::Error::Declaration(error) => of_declaration(py, error),
        other => raised(py, &pythonic(&other.to_string())),
    }
}

/// The Python exception for an error of a run.
pub fn of_run(py: Python<'_>, error: mbs_runtime::Error) -> PyErr {
    of(py, &error.into())
}

/// The Python exception for an error of an analysis.
pub fn of_analysis(py: Python<'_>, error: mbs_analysis::Error) -> PyErr {
    of(py, &error.into())
}

/// The Python exception for a declaration with errors: its text with the underlined source, and all problems
/// for tools.
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

/// Arguments that the command line has as options, with the value of those that are flags there.
const ARGUMENTS: [(&str, Option<&str>); 17] = [
    ("step", None),
    ("end", None),
    ("alpha", None),
    ("beta", None),
    ("method", None),
    ("rtol", None),
    ("atol", None),
    ("max-step", None),
    ("feedback", None),
    ("until", None),
    ("start", None),
    ("every", None),
    ("at", None),
    ("after", None),
    ("here", Some("True")),
    ("relax", Some("True")),
    ("allow-unstable", Some("True")),
];

/// A message in the words of Python: `--every 3` is `every=3` there, and `max-step` is `max_step`.
pub fn pythonic(message: &str) -> String {
    let mut said = String::with_capacity(message.len());
    // values are keywords of their own
    let message = message.replace("--input ", "").replace("--from ", "");
    let mut rest = message.as_str();
    while let Some(place) = rest.find("--") {
        let (before, option) = rest.split_at(place);
        said.push_str(before);
        let end = option[2..]
            .find(|c: char| !(c.is_ascii_lowercase() || c == '-'))
            .map_or(option.len(), |at| at + 2);
        let (word, after) = option.split_at(end);
        rest = after;
        let Some((name, flag)) = ARGUMENTS.iter().find(|(name, _)| *name == &word[2..]) else {
            said.push_str(word);
            continue;
        };
        said.push_str(&name.replace('-', "_"));
        said.push('=');
        let value = after.strip_prefix(' ').unwrap_or_default();
        let value = &value[..value.find([' ', ',', ';', ':', '`']).unwrap_or(value.len())];
        match flag {
            Some(value) => said.push_str(value),
            None if value.parse::<f64>().is_ok() => {
                said.push_str(value);
                rest = &after[1 + value.len()..];
            }
            None if value.starts_with(|c: char| c.is_ascii_digit()) => {
                said.push_str(&format!("\"{value}\""));
                rest = &after[1 + value.len()..];
            }
            None => said.push('…'),
        }
    }
    said.push_str(rest);
    said.replace("max-step", "max_step").replace("allow-unstable", "allow_unstable")
}
