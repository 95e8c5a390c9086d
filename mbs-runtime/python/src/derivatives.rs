//! Derivatives of a run by parameters and by its start.

use mbs_analysis::{Signal, Trial, Variable};
use mbs_runtime::equations::{PARTIALS, Partials};
use mbs_runtime::{Info, System, Tolerances};
use mbs_workbench::{Error, Settings, Start, Unit};
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::asked::Asked;
use crate::error;
use crate::mechanism::Mechanism;
use crate::watched::{Watch, watched};

/// Values and derivatives of columns at some times, each in declared units.
struct Derivatives {
    /// Of every time, a value for each column.
    values: Vec<f64>,
    /// Of every time and column, a derivative by each variable.
    derivatives: Vec<f64>,
}

/// Times, values, derivatives, and the units of columns and variables.
type Found<'py> = ([Bound<'py, PyArray1<f64>>; 3], Vec<String>, Vec<String>);

#[pymethods]
impl Mechanism {
    /// Values and exact derivatives of `columns` at `times` of a run, or at its end, by parameters and start values.
    #[pyo3(signature = (asked, columns, by, times=None, progress=None))]
    fn derivatives<'py>(
        &self,
        py: Python<'py>,
        asked: Asked,
        columns: Vec<String>,
        by: Vec<String>,
        times: Option<Vec<f64>>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Found<'py>> {
        let model = self.model.as_ref();
        let info = model.info();
        let wrong = |error: Error| error::of(py, &error);
        let settings = asked.options(info).and_then(|options| options.settings(model)).map_err(wrong)?;
        let columns = columns.iter().map(|name| named("column", &Signal::observable(info), name));
        let columns = columns.collect::<Result<Vec<_>, _>>().map_err(wrong)?;
        let variables = by.iter().map(|name| variable(info, name)).collect::<Result<Vec<_>, _>>();
        let variables = variables.map_err(wrong)?;
        let times = times.unwrap_or_else(|| vec![settings.end]);
        let found = watched(py, progress.as_ref(), |watch| {
            self.follow(&settings, &columns, &variables, &times, watch)
        })?;
        let Derivatives { values, derivatives } = found.map_err(wrong)?;
        let units = |signals: &[Signal]| -> Vec<String> {
            signals.iter().map(|signal| Unit::of_signal(info, signal).name().to_owned()).collect()
        };
        let arrays = [times, values, derivatives].map(|numbers| PyArray1::from_vec(py, numbers));
        Ok((arrays, units(&columns), units(&variables)))
    }
}

/// A parameter, or a value of the start.
pub fn variable(info: &Info, name: &str) -> Result<Signal, Error> {
    named("parameter or start value", &Signal::adjustable(info), name)
}

/// The signal with a name.
pub fn named(kind: &'static str, known: &[Signal], name: &str) -> Result<Signal, Error> {
    let names = || known.iter().map(|signal| signal.name.as_str());
    let found = known.iter().find(|signal| signal.name == name);
    found.cloned().ok_or_else(|| Error::unknown(kind, name, names()))
}

impl Mechanism {
    /// A run for every [`PARTIALS`] variables.
    fn follow(
        &self,
        settings: &Settings,
        columns: &[Signal],
        variables: &[Signal],
        times: &[f64],
        watch: &Watch,
    ) -> Result<Derivatives, Error> {
        let model = self.model.as_ref();
        let info = model.info();
        let start = Start::of(model, settings)?;
        let trials = self.trials()?;
        // unless others are asked for
        let usual = Tolerances::relative(1e-9);
        let mut found = Derivatives {
            values: vec![f64::NAN; times.len() * columns.len()],
            derivatives: vec![f64::NAN; times.len() * columns.len() * variables.len()],
        };
        let units: Vec<Unit> = columns.iter().map(|column| Unit::of_signal(info, column)).collect();
        for (group, part) in variables.chunks(PARTIALS).enumerate() {
            let seeded = |variable: Variable, value: f64| {
                let at = part.iter().position(|signal| signal.variable == variable);
                at.map_or(Partials::constant(value), |at| Partials::variable(value, at))
            };
            let parameters = start.parameters.iter().enumerate();
            let parameters: Vec<Partials> =
                parameters.map(|(at, value)| seeded(Variable::Parameter(at), *value)).collect();
            let seed_start = |q: &mut [Partials], v: &mut [Partials]| {
                for (at, (q, v)) in q.iter_mut().zip(v).enumerate() {
                    for (number, kind) in [(q, Variable::Coordinate(at)), (v, Variable::Velocity(at))] {
                        if let Some(place) = part.iter().position(|signal| signal.variable == kind) {
                            number.partials[place] = 1.0;
                        }
                    }
                }
            };
            let trial = Trial {
                parameters: &parameters,
                start: &seed_start,
                times,
                start_time: start.start_time,
                inputs: &start.inputs,
                table: &start.table,
                tolerances: settings.tolerances.unwrap_or(usual),
                most_steps: u64::MAX,
            };
            trials.follow(&trial, &mut |row, run| {
                let seen = see(run, columns)?;
                for (column, (number, unit)) in seen.iter().zip(&units).enumerate() {
                    let place = row * columns.len() + column;
                    found.values[place] = unit.shown(number.value);
                    for (at, signal) in part.iter().enumerate() {
                        let scale = Unit::of_signal(info, signal).read(1.0);
                        found.derivatives[place * variables.len() + group * PARTIALS + at] =
                            unit.shown(number.partials[at]) * scale;
                    }
                }
                watch
                    .reached(group * times.len() + row + 1, variables.len().div_ceil(PARTIALS) * times.len());
                Ok(())
            })?;
        }
        Ok(found)
    }
}

/// The values of the columns in the present state.
fn see(run: &dyn System<Partials>, columns: &[Signal]) -> Result<Vec<Partials>, mbs_runtime::Error> {
    let info = run.equations().info();
    let zeros = |count: usize| vec![Partials::default(); count];
    let n = info.coordinates.len();
    let (mut q, mut v, mut acceleration) = (zeros(n), zeros(n), zeros(n));
    let (mut multipliers, mut outputs) = (zeros(info.constraints.len()), zeros(info.outputs.len()));
    run.state(&mut q, &mut v);
    run.reactions(&mut acceleration, &mut multipliers)?;
    run.outputs(&acceleration, &multipliers, &mut outputs)?;
    let of = |column: &Signal| match column.variable {
        Variable::Coordinate(at) => q.get(at),
        Variable::Velocity(at) => v.get(at),
        Variable::Output(at) => outputs.get(at),
        Variable::Multiplier(at) => multipliers.get(at),
        Variable::Input(_) | Variable::Parameter(_) => None,
    };
    Ok(columns.iter().map(|column| of(column).copied().unwrap_or_default()).collect())
}
