//! Many runs that differ in parameters, on all cores.

use std::ops::Range;

use mbs_runtime::Info;
use mbs_workbench::members::{Extent, Members, quantities};
use mbs_workbench::{Error, Settings, Unit, quantity};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::ThreadPoolBuilder;

use crate::asked::Asked;
use crate::error;
use crate::mechanism::Mechanism;
use crate::watched::{Watch, watched};

/// So many failures are kept with their reasons.
const MOST_REASONS: usize = 100;

/// The values of a parameter, in its declared unit, or in texts.
#[derive(FromPyObject)]
pub enum Values {
    Numbers(Vec<f64>),
    Texts(Vec<String>),
}

/// A parameter that differs, and its values in SI units.
pub struct Axis {
    pub name: String,
    pub values: Vec<f64>,
}

impl Axis {
    pub fn of(info: &Info, name: String, values: Values) -> Result<Self, Error> {
        let known = info.parameters;
        let found = known.iter().find(|parameter| parameter.name == name);
        let found = found.ok_or_else(|| Error::unknown("parameter", &name, known.iter().map(|p| p.name)))?;
        let values = match values {
            Values::Numbers(numbers) => numbers.iter().map(|x| Unit::of(found).read(*x)).collect(),
            Values::Texts(texts) => {
                texts.iter().map(|text| quantity::parse_as(found, text)).collect::<Result<_, _>>()?
            }
        };
        Ok(Self { name, values })
    }
}

/// Which members a sweep has: all combinations of the values, the last parameter first as in a nested loop, or
/// one for each place of lists that belong together.
struct Grid {
    axes: Vec<Axis>,
    is_paired: bool,
}

impl Grid {
    fn count(&self) -> usize {
        let mut lengths = self.axes.iter().map(|axis| axis.values.len());
        if self.is_paired { lengths.next().unwrap_or(0) } else { lengths.product() }
    }

    fn values(&self, index: usize) -> Vec<f64> {
        if self.is_paired {
            return self.axes.iter().filter_map(|axis| axis.values.get(index).copied()).collect();
        }
        let mut rest = index;
        let mut values = vec![0.0; self.axes.len()];
        for (value, axis) in values.iter_mut().zip(&self.axes).rev() {
            let count = axis.values.len().max(1);
            *value = axis.values.get(rest % count).copied().unwrap_or(f64::NAN);
            rest /= count;
        }
        values
    }
}

/// The results of the members: the smallest, the largest and the last value of each quantity that is wanted.
struct Kept {
    wanted: Vec<usize>,
    extents: Vec<[Vec<f64>; 3]>,
    failed: usize,
    reasons: Vec<(usize, String)>,
}

impl Kept {
    fn new(wanted: Vec<usize>, count: usize) -> Self {
        let extents = wanted.iter().map(|_| [(); 3].map(|()| vec![f64::NAN; count])).collect();
        Self { wanted, extents, failed: 0, reasons: Vec::new() }
    }

    fn take(&mut self, index: usize, member: Result<Vec<Extent>, mbs_runtime::Error>) {
        let extents = match member {
            Ok(extents) => extents,
            Err(error) => {
                self.failed += 1;
                if self.reasons.len() < MOST_REASONS {
                    self.reasons.push((index, error.to_string()));
                }
                return;
            }
        };
        for (kept, at) in self.extents.iter_mut().zip(&self.wanted) {
            let Some(Extent { low, high, last }) = extents.get(*at).copied() else { continue };
            for (column, value) in kept.iter_mut().zip([low, high, last]) {
                if let Some(place) = column.get_mut(index) {
                    *place = value;
                }
            }
        }
    }
}

#[pymethods]
impl Mechanism {
    /// Runs members `first` to `last` of a sweep. `axes` are parameters and their values, `names` the quantities
    /// that are kept.
    #[pyo3(signature = (asked, axes, paired, names, first, last, threads=None, progress=None))]
    #[allow(clippy::too_many_arguments, reason = "the arguments of the method of the package")]
    fn sweep<'py>(
        &self,
        py: Python<'py>,
        asked: Asked,
        axes: Vec<(String, Values)>,
        paired: bool,
        names: Vec<String>,
        first: usize,
        last: usize,
        threads: Option<usize>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let info = self.model.info();
        let wrong = |error: Error| error::of(py, &error);
        let settings = asked
            .options(info)
            .and_then(|mut options| {
                // members are looked at step by step
                options.finds_events = false;
                options.settings(self.model.as_ref())
            })
            .map_err(wrong)?;
        let axes = axes.into_iter().map(|(name, values)| Axis::of(info, name, values));
        let axes = axes.collect::<Result<_, _>>().map_err(wrong)?;
        let wanted = wanted(info, &names).map_err(wrong)?;
        let units: Vec<Unit> = quantities(info).into_iter().map(|(_, unit)| unit).collect();
        let grid = Grid { axes, is_paired: paired };
        let members = first..last.min(grid.count());
        let mut kept = Kept::new(wanted, members.len());
        let pool = threads.map(|count| ThreadPoolBuilder::new().num_threads(count).build()).transpose();
        let pool = pool.map_err(|error| error::raised(py, &format!("no threads for a sweep: {error}")))?;
        let swept = watched(py, progress.as_ref(), |watch| {
            let run = || self.run(&settings, &grid, members, &mut kept, watch);
            match &pool {
                Some(pool) => pool.install(run),
                None => run(),
            }
        });
        swept?.map_err(wrong)?;
        let found = PyDict::new(py);
        let extents = PyDict::new(py);
        for ((name, at), [low, high, last]) in names.iter().zip(&kept.wanted).zip(kept.extents) {
            let unit = units.get(*at).map_or("", Unit::name);
            let [low, high, last] = [low, high, last].map(|column| PyArray1::from_vec(py, column));
            extents.set_item(name, (unit, low, high, last))?;
        }
        found.set_item("extents", extents)?;
        found.set_item("failed", kept.failed)?;
        found.set_item("reasons", kept.reasons)?;
        Ok(found)
    }
}

impl Mechanism {
    fn run(
        &self,
        settings: &Settings,
        grid: &Grid,
        members: Range<usize>,
        kept: &mut Kept,
        watch: &Watch,
    ) -> Result<(), Error> {
        let (first, count) = (members.start, members.len());
        self.model.sweep(
            settings,
            Members {
                names: grid.axes.iter().map(|axis| axis.name.clone()).collect(),
                count,
                values: &|index| grid.values(first + index),
                take: &mut |index, member| kept.take(index, member),
                progress: &|done| watch.reached(done, count),
                cancel: &watch.cancel,
            },
        )
    }
}

/// The places of quantities among those that a sweep looks at.
fn wanted(info: &Info, names: &[String]) -> Result<Vec<usize>, Error> {
    let known = || quantities(info).into_iter().map(|(name, _)| name);
    let place = |name: &String| {
        let at = known().position(|other| other == name);
        at.ok_or_else(|| Error::unknown("coordinate or output", name, known()))
    };
    names.iter().map(place).collect()
}
