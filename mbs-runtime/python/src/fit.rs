//! Parameters from measured motions.

use mbs_analysis::{Experiment, Fit, Measurement, Signal, Unknown, clock_of};
use mbs_runtime::Info;
use mbs_workbench::{Error, RunOptions, Start, Unit, quantity};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::asked::Asked;
use crate::derivatives::{named, variable};
use crate::error;
use crate::mechanism::Mechanism;
use crate::watched::{Watch, watched};

/// A measured quantity: its name, times in s, values, and perhaps the deviation of their noise, in
/// declared units.
type Measured = (String, Vec<f64>, Vec<f64>, Option<f64>);

/// An unknown: its name, perhaps a guess, and the bounds, in texts.
type Wanted = (String, Option<String>, [Option<String>; 2]);

/// How a fit is made.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct AskedFit {
    measured: Vec<Measured>,
    unknown: Vec<Wanted>,
    starts: usize,
    confidence: f64,
}

/// The unknowns and their units.
struct Unknowns {
    unknown: Vec<Unknown>,
    units: Vec<Unit>,
}

#[pymethods]
impl Mechanism {
    /// Fits parameters and start values to measured motions.
    #[pyo3(signature = (asked, fit, progress=None))]
    fn fit<'py>(
        &self,
        py: Python<'py>,
        asked: Asked,
        fit: AskedFit,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let info = self.model.info();
        let wrong = |error: Error| error::of(py, &error);
        let options = asked.options(info).map_err(wrong)?;
        let unknowns = fit.unknowns(info).map_err(wrong)?;
        let (measured, units) = fit.measurements(info).map_err(wrong)?;
        let found = watched(py, progress.as_ref(), |watch| {
            self.fitted(&options, &fit, &unknowns.unknown, &measured, watch)
        })?;
        shown(py, &found.map_err(wrong)?, &unknowns.units, &units)
    }
}

impl AskedFit {
    fn unknowns(&self, info: &Info) -> Result<Unknowns, Error> {
        let mut found = Unknowns { unknown: Vec::new(), units: Vec::new() };
        for (name, guess, [low, high]) in &self.unknown {
            let signal = variable(info, name)?;
            let unit = Unit::of_signal(info, &signal);
            let read = |text: &String| quantity::parse_in(name, text, signal.dimension, &unit);
            let guess = guess.as_ref().map(read).transpose()?;
            let low = low.as_ref().map(read).transpose()?.unwrap_or(f64::NEG_INFINITY);
            let high = high.as_ref().map(read).transpose()?.unwrap_or(f64::INFINITY);
            found.unknown.push(Unknown { name: name.clone(), guess, bounds: [low, high] });
            found.units.push(unit);
        }
        Ok(found)
    }

    fn measurements(&self, info: &Info) -> Result<(Vec<Measurement>, Vec<Unit>), Error> {
        let known = Signal::observable(info);
        let of = |(name, times, values, deviation): &Measured| {
            let unit = Unit::of_signal(info, &named("column", &known, name)?);
            let measurement = Measurement {
                name: name.clone(),
                times: times.clone(),
                values: values.iter().map(|value| unit.read(*value)).collect(),
                deviation: deviation.map(|deviation| unit.read(deviation)),
            };
            Ok((measurement, unit))
        };
        let pairs: Vec<(Measurement, Unit)> = self.measured.iter().map(of).collect::<Result<_, Error>>()?;
        Ok(pairs.into_iter().unzip())
    }
}

impl Mechanism {
    fn fitted(
        &self,
        options: &RunOptions,
        fit: &AskedFit,
        unknown: &[Unknown],
        measured: &[Measurement],
        watch: &Watch,
    ) -> Result<Fit, Error> {
        let model = self.model.as_ref();
        let settings = options.values(model)?;
        let start = Start::of(model, &settings)?;
        let trials = self.trials()?;
        let experiment = Experiment::of(model.info())
            .parameters(start.parameters)
            .inputs(start.inputs)
            .driven_by(start.table)
            .starts(fit.starts)
            .confidence(fit.confidence);
        let experiment = match clock_of(measured) {
            Some(start) => experiment.starting_at(start),
            None => experiment,
        };
        let experiment = measured.iter().cloned().fold(experiment, Experiment::with);
        let experiment = unknown.iter().cloned().fold(experiment, Experiment::looking_for);
        Ok(experiment.fit_while(&*trials, &mut |now| {
            watch.reached(now.start, now.starts);
            watch.goes_on()
        })?)
    }
}

/// Estimates and what they leave over, in declared units.
fn shown<'py>(
    py: Python<'py>,
    fit: &Fit,
    units: &[Unit],
    of_columns: &[Unit],
) -> PyResult<Bound<'py, PyDict>> {
    let found = PyDict::new(py);
    let estimates = fit.estimates.iter().zip(units).map(|(estimate, unit)| {
        let [low, high] = estimate.interval.map(|x| unit.shown(x));
        let shown = PyDict::new(py);
        shown.set_item("name", &estimate.name)?;
        shown.set_item("unit", unit.name())?;
        shown.set_item("value", unit.shown(estimate.value))?;
        shown.set_item("standard_error", unit.shown(estimate.standard_error))?;
        shown.set_item("interval", (low, high))?;
        shown.set_item("guess", unit.shown(estimate.guess))?;
        shown.set_item("is_at_bound", estimate.is_at_bound)?;
        Ok(shown)
    });
    found.set_item("estimates", estimates.collect::<PyResult<Vec<_>>>()?)?;
    let remainders = fit.remainders.iter().zip(of_columns).map(|(remainder, unit)| {
        let in_unit =
            |values: &[f64]| PyArray1::from_vec(py, values.iter().map(|x| unit.shown(*x)).collect());
        let shown = PyDict::new(py);
        shown.set_item("unit", unit.name())?;
        shown.set_item("predicted", in_unit(&remainder.predicted))?;
        shown.set_item("residuals", in_unit(&remainder.residuals))?;
        shown.set_item("deviation", unit.shown(remainder.deviation))?;
        shown.set_item("is_estimated", remainder.is_estimated)?;
        Ok(shown)
    });
    found.set_item("remainders", remainders.collect::<PyResult<Vec<_>>>()?)?;
    // in the product of the units of both
    let scales: Vec<f64> = units.iter().map(|unit| unit.read(1.0)).collect();
    let covariance = scales.iter().enumerate().flat_map(|(row, a)| {
        let entry = move |(column, b): (usize, &f64)| {
            fit.covariance.get((row, column)).copied().unwrap_or(0.0) / (a * b)
        };
        scales.iter().enumerate().map(entry)
    });
    found.set_item("covariance", PyArray1::from_vec(py, covariance.collect()))?;
    found.set_item("chi_squared", fit.chi_squared)?;
    found.set_item("freedom", fit.freedom)?;
    found.set_item("has_converged", fit.has_converged)?;
    found.set_item("runs", fit.runs)?;
    found.set_item("confidence", fit.confidence)?;
    Ok(found)
}
