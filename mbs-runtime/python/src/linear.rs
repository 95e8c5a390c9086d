//! Linear systems, modes and responses.

use mbs_analysis::nalgebra::{Complex, DMatrix};
use mbs_analysis::{Linearization, Signal};
use mbs_workbench::{About, Error, Operating, PortNames, RunOptions, Unit, doubt};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::asked::{Asked, AskedPoint, AskedPorts};
use crate::error;
use crate::mechanism::Mechanism;
use crate::watched::watched;

/// A linear system in SI units.
#[pyclass(frozen, module = "mbs._native")]
pub struct Linear {
    linear: Linearization,
    about: String,
    coordinates: Vec<&'static str>,
}

/// Names and SI units.
type Signals = Vec<(String, String)>;

fn signals(signals: &[Signal]) -> Signals {
    signals.iter().map(|signal| (signal.name.clone(), Unit::si(signal.dimension).name().to_owned())).collect()
}

/// A matrix as an array.
fn array<'py>(py: Python<'py>, matrix: &DMatrix<f64>) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let rows: Vec<f64> = matrix.transpose().as_slice().to_vec();
    PyArray1::from_vec(py, rows).reshape([matrix.nrows(), matrix.ncols()])
}

#[pymethods]
impl Mechanism {
    /// The linear system about a point.
    fn linearize(
        &self,
        py: Python<'_>,
        asked: Asked,
        point: AskedPoint,
        ports: AskedPorts,
    ) -> PyResult<Linear> {
        let options = asked.options(self.model.info()).map_err(|error| error::of(py, &error))?;
        let found = watched(py, None, |_| self.linear(&options, &point.into(), &ports.into()))?;
        found.map_err(|error| error::of(py, &error))
    }
}

impl Mechanism {
    fn linear(&self, options: &RunOptions, about: &About, ports: &PortNames) -> Result<Linear, Error> {
        let info = self.model.info();
        let operating = Operating::of(info.name, self.model.as_ref(), options, about, &mut |_, _| ())?;
        Ok(Linear {
            linear: operating.linearized(ports)?,
            about: operating.words(),
            coordinates: info.coordinates.iter().map(|q| q.name).collect(),
        })
    }
}

#[pymethods]
impl Linear {
    /// Its names, and A, B, C and D.
    fn describe<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let linear = &self.linear;
        let found = PyDict::new(py);
        found.set_item("about", &self.about)?;
        found.set_item("doubt", doubt(linear))?;
        found.set_item("t", linear.point.t)?;
        found.set_item("states", signals(&linear.states))?;
        found.set_item("inputs", signals(&linear.inputs))?;
        found.set_item("outputs", signals(&linear.outputs))?;
        for (name, matrix) in [("A", &linear.a), ("B", &linear.b), ("C", &linear.c), ("D", &linear.d)] {
            found.set_item(name, array(py, matrix)?)?;
        }
        found.set_item("values", linear.values.as_slice().to_vec())?;
        Ok(found)
    }

    /// Eigenvalue, natural frequency in rad/s, damping ratio, behaviour and shape of each mode.
    fn modes<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let modes = self.linear.modes().map_err(|error| error::of_analysis(py, error))?;
        let of = |mode: &mbs_analysis::Mode| {
            let shape = PyDict::new(py);
            for (name, part) in self.coordinates.iter().zip(mode.shape.iter()) {
                shape.set_item(name, *part)?;
            }
            let found = PyDict::new(py);
            found.set_item("eigenvalue", mode.eigenvalue)?;
            found.set_item("natural_frequency", mode.natural_frequency())?;
            found.set_item("damping_ratio", mode.damping_ratio())?;
            found.set_item("behaviour", mode.behaviour.words())?;
            found.set_item("is_unstable", mode.behaviour.is_unstable())?;
            found.set_item("shape", shape)?;
            Ok(found)
        };
        modes.iter().map(of).collect()
    }

    /// H(iω) at some frequencies in rad/s, one after the other: outputs × inputs each.
    fn response<'py>(
        &self,
        py: Python<'py>,
        frequencies: Vec<f64>,
    ) -> PyResult<Bound<'py, PyArray1<Complex<f64>>>> {
        let mut values = Vec::new();
        for omega in frequencies {
            let response =
                self.linear.frequency_response(omega).map_err(|error| error::of_analysis(py, error))?;
            values.extend(response.transpose().iter().copied());
        }
        Ok(PyArray1::from_vec(py, values))
    }

    /// Times, and the outputs behind a unit step of an input, one instant after the other.
    fn step_response<'py>(
        &self,
        py: Python<'py>,
        input: &str,
        end: f64,
        steps: usize,
    ) -> PyResult<(Vec<f64>, Bound<'py, PyArray2<f64>>)> {
        let found = self.linear.step_response(input, end, steps);
        let found = found.map_err(|error| error::of_analysis(py, error))?;
        Ok((found.times.clone(), array(py, &found.outputs)?))
    }
}
