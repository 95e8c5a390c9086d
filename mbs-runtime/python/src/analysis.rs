//! Where a mechanism is at rest.

use mbs_analysis::{Equilibrium, OperatingPoint, Stability, equilibrium};
use mbs_runtime::Quantity;
use mbs_runtime::equations::At;
use mbs_workbench::{About, Error, RunOptions, Start, Unit};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::asked::{Asked, AskedPoint};
use crate::error;
use crate::mechanism::Mechanism;
use crate::watched::watched;

/// An equilibrium with what the mechanism measures there.
struct Found {
    rest: Equilibrium,
    outputs: Vec<f64>,
    potential_energy: f64,
}

/// Names, values and units.
type Values = Vec<(&'static str, f64, String)>;

fn shown(quantities: &'static [Quantity], values: &[f64], unit: impl Fn(&Quantity) -> Unit) -> Values {
    let of = |(q, value): (&'static Quantity, &f64)| {
        let unit = unit(q);
        (q.name, unit.shown(*value), unit.name().to_owned())
    };
    quantities.iter().zip(values).map(of).collect()
}

#[pymethods]
impl Mechanism {
    /// Where the mechanism is at rest.
    fn equilibrium<'py>(
        &self,
        py: Python<'py>,
        asked: Asked,
        point: AskedPoint,
    ) -> PyResult<Bound<'py, PyDict>> {
        let info = self.model.info();
        let options = asked.options(info).map_err(|error| error::of(py, &error))?;
        let found = watched(py, None, |_| self.at_rest(&options, &point.into()))?;
        let Found { rest, outputs, potential_energy } = found.map_err(|error| error::of(py, &error))?;
        let (stability, directions) = match rest.stability() {
            Stability::Stable => ("stable", 0),
            Stability::Indifferent => ("indifferent", 0),
            Stability::Unstable { directions } => ("unstable", directions),
        };
        let rows = info.constraints.iter().zip(&rest.multipliers);
        let of_modes = rest.held.iter().filter_map(|(at, value)| {
            let lock = info.modes.locks.get(*at)?;
            Some((lock.name, *value, Unit::of(info.inputs.get(lock.held)?).name().to_owned()))
        });
        let reactions: Values = rows
            .map(|(row, value)| (row.name, *value, Unit::of_multiplier(row.dimension).name().to_owned()))
            .chain(of_modes)
            .collect();
        let shown_all = PyDict::new(py);
        shown_all.set_item("t", rest.t)?;
        let (coordinates, states) = info.coordinates.split_at(info.lines.min(info.coordinates.len()));
        let (positions, values) = rest.q.split_at(coordinates.len().min(rest.q.len()));
        shown_all.set_item("coordinates", shown(coordinates, positions, Unit::of_coordinate))?;
        shown_all.set_item("states", shown(states, values, Unit::of))?;
        shown_all.set_item("outputs", shown(info.outputs, &outputs, Unit::of))?;
        shown_all.set_item("multipliers", reactions)?;
        let rests = rest.rests.iter().filter_map(|(at, force)| Some((info.stops.get(*at)?, *force)));
        let rests: Values = rests
            .map(|(stop, force)| (stop.name, force, Unit::of_multiplier(stop.dimension).name().to_owned()))
            .collect();
        shown_all.set_item("rests", rests)?;
        shown_all.set_item("potential_energy", potential_energy)?;
        shown_all.set_item("stability", stability)?;
        shown_all.set_item("directions", directions)?;
        shown_all.set_item("stiffness", rest.stiffness)?;
        Ok(shown_all)
    }
}

impl Mechanism {
    fn at_rest(&self, options: &RunOptions, about: &About) -> Result<Found, Error> {
        let model = self.model.as_ref();
        let (run, search) = about.search(model, &Start::of(model, &options.values(model)?)?)?;
        let rest = equilibrium(run.equations(), &search)?;
        let (still, point) = (vec![0.0; rest.q.len()], OperatingPoint::from(&rest));
        let at = At { t: rest.t, q: &point.q, v: &point.v };
        let mut outputs = vec![f64::NAN; model.info().outputs.len()];
        run.equations().outputs(at, &rest.inputs, [&still, &rest.multipliers], &mut outputs);
        let [_, potential_energy] = run.energies(at);
        Ok(Found { rest, outputs, potential_energy })
    }
}
