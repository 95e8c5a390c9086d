//! The grid of a sweep.

use mbs_runtime::Info;

use crate::{Error, Settings, Unit, quantity, sweep};

/// More runs than this are refused, before they take days.
const MOST_RUNS: usize = 100_000_000;

/// A parameter and its values.
pub struct GridAxis {
    pub name: &'static str,
    pub unit: Unit,
    pub values: Evenly,
}

/// Evenly spaced values in SI units, ascending.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evenly {
    pub low: f64,
    pub high: f64,
    pub count: usize,
}

impl Evenly {
    /// The value with this index, from 0 on.
    pub fn at(self, index: usize) -> f64 {
        sweep::evenly_at(self.low, self.high, self.count, index)
    }
}

/// Where a run stands among so many values of each parameter: the first one changes from run to run.
pub fn places(mut run: usize, counts: impl Iterator<Item = usize>) -> impl Iterator<Item = usize> {
    counts.map(move |count| {
        let (at, rest) = (run % count.max(1), run / count.max(1));
        run = rest;
        at
    })
}

impl GridAxis {
    /// Reads `name=low..high:count`.
    pub fn parse(text: &str, info: &Info) -> Result<Self, Error> {
        let (name, range) = quantity::split_setting(text)?;
        let parameter = info
            .parameters
            .iter()
            .find(|parameter| parameter.name == name)
            .ok_or_else(|| Error::unknown("parameter", name, info.parameters.iter().map(|p| p.name)))?;
        let wrong = |reason: &str| Error::Value {
            what: name.to_owned(),
            text: range.to_owned(),
            reason: format!("{reason}; write {name}=LOW..HIGH:COUNT, for instance l1=50mm..120mm:20"),
        };
        let (low, rest) = range.split_once("..").ok_or_else(|| wrong("that is not a range"))?;
        let (high, count) = rest.rsplit_once(':').ok_or_else(|| wrong("it is not said how many values"))?;
        let count: usize =
            count.trim().parse().map_err(|_| wrong(&format!("`{count}` is not a number of values")))?;
        let value = |text: &str| quantity::parse_as(parameter, text);
        let (low, high) = (value(low)?, value(high)?);
        if !(2..=MOST_RUNS).contains(&count) {
            return Err(wrong("there have to be two values at least, and not more than 100 million"));
        }
        if low >= high {
            return Err(wrong("the first value has to be smaller than the last"));
        }
        let values = Evenly { low, high, count };
        Ok(Self { name: parameter.name, unit: Unit::of(parameter), values })
    }

    /// The values in the declared unit.
    pub fn shown_values(&self) -> Vec<f64> {
        (0..self.values.count).map(|at| self.unit.shown(self.values.at(at))).collect()
    }
}

/// One or two parameters; the first one changes from run to run.
pub struct Grid {
    pub axes: Vec<GridAxis>,
}

impl Grid {
    pub fn of(axes: Vec<GridAxis>) -> Result<Self, Error> {
        let wrong =
            |name: &str, reason: &str| Error::Name { name: name.to_owned(), reason: reason.to_owned() };
        match axes.as_slice() {
            [x, y] if x.name == y.name => return Err(wrong(x.name, "it is swept twice")),
            [_, _, third, ..] => return Err(wrong(third.name, "one or two parameters are swept at a time")),
            _ => {}
        }
        let grid = Self { axes };
        let count = grid.axes.iter().try_fold(1_usize, |count, axis| count.checked_mul(axis.values.count));
        match count {
            Some(count) if count <= MOST_RUNS => Ok(grid),
            _ => Err(Error::TooManyRuns { most: MOST_RUNS }),
        }
    }

    /// Refuses a parameter that is both swept and set.
    pub fn check_against(&self, settings: &Settings) -> Result<(), Error> {
        let is_set = |axis: &&GridAxis| settings.parameters.iter().any(|(name, _)| name == axis.name);
        match self.axes.iter().find(is_set) {
            Some(axis) => {
                let reason = "it is set with --set and swept with --param".into();
                Err(Error::Name { name: axis.name.to_owned(), reason })
            }
            None => Ok(()),
        }
    }

    pub fn count(&self) -> usize {
        self.axes.iter().map(|axis| axis.values.count).product()
    }

    /// The values of a run, in SI units.
    pub fn values(&self, index: usize) -> Vec<f64> {
        let places = places(index, self.axes.iter().map(|axis| axis.values.count));
        self.axes.iter().zip(places).map(|(axis, at)| axis.values.at(at)).collect()
    }

    /// The same in the declared units.
    pub fn shown_values(&self, index: usize) -> Vec<f64> {
        self.values(index).iter().zip(&self.axes).map(|(value, axis)| axis.unit.shown(*value)).collect()
    }

    /// `l1 = 60 mm, omega = 200 rpm`
    pub fn place(&self, index: usize) -> String {
        let values = self.values(index);
        let named = values.iter().zip(&self.axes);
        let text =
            |(value, axis): (&f64, &GridAxis)| format!("{} = {}", axis.name, axis.unit.text(*value, 6));
        named.map(text).collect::<Vec<_>>().join(", ")
    }
}
