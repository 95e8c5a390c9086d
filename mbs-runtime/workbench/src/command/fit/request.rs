//! The request of a fit, read from a command line.

use std::path::PathBuf;

use mbs_analysis::{Experiment, Signal, Unknown, Variable, clock_of};
use mbs_runtime::{Dimension, Info};

use super::Arguments;
use crate::measurements::Measurements;
use crate::number::significant;
use crate::quantity;
use crate::settings::Start;
use crate::{Error, Model, Signals, Unit};

/// An experiment, with the units in which it is shown.
pub(super) struct Request {
    pub info: &'static Info,
    path: PathBuf,
    pub data: Measurements,
    pub unknown: Vec<Unknown>,
    /// The units of what is looked for.
    pub units: Vec<Unit>,
    start: Start,
    starts: usize,
    confidence: f64,
}

/// The dimension and the unit of a value that is looked for.
struct Place {
    dimension: Dimension,
    unit: Unit,
}

impl Request {
    pub fn of(model: &dyn Model, asked: &Arguments) -> Result<Self, Error> {
        let info = model.info();
        let mut settings = asked.values.settings(model)?;
        let path = asked.data.clone();
        let mut data = Measurements::read(&path, info, &asked.columns)?;
        settings.signals = inputs(settings.signals, &mut data, &path)?;
        let start = Start { start_time: clock_of(&data.measured), ..Start::of(model, &settings)? };
        let mut request = Self {
            info,
            path,
            data,
            unknown: Vec::new(),
            units: Vec::new(),
            start,
            starts: usize::from(asked.starts),
            confidence: confidence(asked.confidence.as_ref())?,
        };
        request.look_for("param", &asked.param)?;
        request.look_for("start", &asked.start)?;
        if request.unknown.is_empty() {
            let reason =
                "nothing is to be found; name parameters with --param k,c or start values with --start x";
            return Err(Error::Name { name: "fit".into(), reason: reason.into() });
        }
        asked.bounds.iter().try_for_each(|text| request.bound(text))?;
        asked.sigma.iter().try_for_each(|text| request.deviate(text))?;
        Ok(request)
    }

    /// When the runs start, where the data have a clock of their own.
    pub fn start_time(&self) -> Option<f64> {
        self.start.start_time
    }

    /// Takes names, with or without a guess.
    fn look_for(&mut self, option: &str, texts: &[String]) -> Result<(), Error> {
        for text in texts {
            let (name, guess) = match text.split_once('=') {
                Some((name, guess)) => (name.trim(), Some(guess)),
                None => (text.trim(), None),
            };
            let Place { dimension, unit } =
                if option == "param" { self.parameter(name)? } else { self.start_value(name)? };
            let guess = guess.map(|text| quantity::parse_in(name, text, dimension, &unit)).transpose()?;
            let bounds = [f64::NEG_INFINITY, f64::INFINITY];
            self.unknown.push(Unknown { name: name.into(), guess, bounds });
            self.units.push(unit);
        }
        Ok(())
    }

    fn parameter(&self, name: &str) -> Result<Place, Error> {
        let known = self.info.parameters;
        let found = known.iter().find(|parameter| parameter.name == name);
        let found = found.ok_or_else(|| Error::unknown("parameter", name, known.iter().map(|p| p.name)))?;
        Ok(Place { dimension: found.dimension, unit: Unit::of(found) })
    }

    fn start_value(&self, name: &str) -> Result<Place, Error> {
        let known: Vec<Signal> = Signal::observable(self.info)
            .into_iter()
            .filter(|signal| matches!(signal.variable, Variable::Coordinate(_) | Variable::Velocity(_)))
            .collect();
        let found = known.iter().find(|signal| signal.name == name);
        let names = || known.iter().map(|signal| signal.name.as_str());
        let found = found.ok_or_else(|| Error::unknown("start value", name, names()))?;
        Ok(Place { dimension: found.dimension, unit: Unit::of_signal(self.info, found) })
    }

    /// Takes `NAME=LOW..HIGH`, of which an end may be empty.
    fn bound(&mut self, text: &str) -> Result<(), Error> {
        let (name, range) = quantity::split_setting(text)?;
        let known = || self.unknown.iter().map(|unknown| unknown.name.as_str());
        let at = known().position(|other| other == name);
        let at = at.ok_or_else(|| Error::unknown("value that is looked for called", name, known()))?;
        let (low, high) = range.split_once("..").ok_or_else(|| Error::Value {
            what: format!("the bounds of {name}"),
            text: range.into(),
            reason: "that is not a range; write NAME=LOW..HIGH, for instance k=1N/mm..5N/mm or c=0..".into(),
        })?;
        let is_parameter = self.info.parameters.iter().any(|parameter| parameter.name == name);
        let place = if is_parameter { self.parameter(name)? } else { self.start_value(name)? };
        for (bound, text) in self.unknown[at].bounds.iter_mut().zip([low, high]) {
            if !text.trim().is_empty() {
                *bound = quantity::parse_in(name, text, place.dimension, &place.unit)?;
            }
        }
        let [low, high] = self.unknown[at].bounds;
        if low < high {
            return Ok(());
        }
        let what = format!("the bounds of {name}");
        Err(Error::Value { what, text: range.into(), reason: "the lower one comes first".into() })
    }

    /// Takes `NAME=VALUE` of a compared column.
    fn deviate(&mut self, text: &str) -> Result<(), Error> {
        let (name, value) = quantity::split_setting(text)?;
        let mut measured = self.data.measured.iter_mut().zip(&self.data.units);
        let found = measured.find(|(measured, _)| measured.name == name);
        let signal = Signal::observable(self.info).into_iter().find(|signal| signal.name == name);
        let Some(((measured, unit), signal)) = found.zip(signal) else {
            let known = self.data.measured.iter().map(|measured| measured.name.as_str());
            return Err(Error::unknown("compared column", name, known));
        };
        let value = quantity::parse_in(name, value, signal.dimension, unit)?;
        measured.deviation = Some(value);
        Ok(())
    }

    /// An error about values, in the units of the command line.
    pub fn in_its_units(&self, error: mbs_analysis::Error) -> Error {
        let (name, guess, low, high) = match error {
            mbs_analysis::Error::Bounds { name, guess, low, high } => (name, guess, low, high),
            mbs_analysis::Error::Mechanism(mbs_runtime::Error::TooManySteps { t, steps }) => {
                return self.too_long(t, steps);
            }
            other => return other.into(),
        };
        let unit = self.unknown.iter().zip(&self.units).find(|(unknown, _)| unknown.name == name);
        let text = |value: f64| unit.map_or_else(|| value.to_string(), |(_, unit)| unit.text(value, 6));
        let [guess, low, high] = [guess, low, high].map(text);
        let reason = format!(
            "it is looked for from {guess}, which does not lie within its bounds {low} to {high}; give another \
             guess with --param {name}=…, or widen --bounds"
        );
        Error::Name { name, reason }
    }

    /// The refusal of data that no run comes to the end of.
    fn too_long(&self, t: f64, steps: u64) -> Error {
        let last = self.data.measured.iter().filter_map(|measured| measured.times.last());
        let last = last.copied().fold(f64::NEG_INFINITY, f64::max);
        let reason = format!(
            "its times go on until {last} s, and a run came to {} s in {steps} steps, the most that a fit takes; \
             are they in the unit of their heading? Leave out what comes later, or begin with softer forces \
             (--param NAME=GUESS)",
            significant(t, 4)
        );
        Error::Name { name: self.path.display().to_string(), reason }
    }

    /// The experiment that the analysis is asked to make.
    pub fn experiment(&self) -> Experiment {
        let experiment = Experiment::of(self.info)
            .parameters(self.start.parameters.clone())
            .inputs(self.start.inputs.clone())
            .driven_by(self.start.table.clone())
            .starts(self.starts)
            .confidence(self.confidence);
        let experiment = match self.start.start_time {
            Some(start) => experiment.starting_at(start),
            None => experiment,
        };
        let experiment = self.data.measured.iter().cloned().fold(experiment, Experiment::with);
        self.unknown.iter().cloned().fold(experiment, Experiment::looking_for)
    }
}

/// The inputs of a file of their own, or of the data.
fn inputs(
    given: Option<Signals>,
    data: &mut Measurements,
    path: &std::path::Path,
) -> Result<Option<Signals>, Error> {
    match (given, data.inputs.take()) {
        (Some(given), Some(own)) if given.names().any(|name| own.names().any(|other| other == name)) => {
            let reason = format!(
                "{} has columns of the inputs that --input reads; leave one of them out",
                path.display()
            );
            Err(Error::Name { name: "--input".into(), reason })
        }
        (Some(_), Some(_)) => {
            let reason =
                format!("{} has columns of other inputs; put all of them into one file", path.display());
            Err(Error::Name { name: "--input".into(), reason })
        }
        (given, own) => Ok(given.or(own)),
    }
}

/// A probability, such as `95%` or `0.95`.
fn confidence(text: Option<&String>) -> Result<f64, Error> {
    let Some(text) = text else { return Ok(0.95) };
    let (number, unit) = text.trim().strip_suffix('%').map_or((text.trim(), 1.0), |number| (number, 0.01));
    let wrong =
        |reason: &str| Error::Value { what: "confidence".into(), text: text.clone(), reason: reason.into() };
    let value: f64 = number.trim().parse().map_err(|_| wrong("write it as 95% or 0.95"))?;
    let value = unit * value;
    if value > 0.0 && value < 1.0 {
        Ok(value)
    } else {
        Err(wrong("it is above 0 and below 100 %, such as 95%"))
    }
}
