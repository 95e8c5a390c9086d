//! A measured run, its conditions, and the unknowns of the mechanism.

use std::sync::Arc;

use mbs_runtime::{Info, Tolerances};

use crate::{Error, InputTable, Signal, Variable, own_clock};

/// A measured run of a mechanism and what is unknown of it.
///
/// Values are in SI units and rad. See [`fit`](crate::identification) for an example.
#[derive(Clone)]
pub struct Experiment {
    pub(super) info: &'static Info,
    pub(super) parameters: Vec<f64>,
    pub(super) inputs: Vec<f64>,
    pub(super) table: Arc<InputTable>,
    pub(super) start_time: Option<f64>,
    pub(super) tolerances: Tolerances,
    pub(super) measured: Vec<Measurement>,
    pub(super) unknown: Vec<Unknown>,
    pub(super) starts: usize,
    pub(super) confidence: f64,
}

/// A quantity that was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// Its name: an output, a coordinate `x`, its rate `der(x)`, or a multiplier `lambda(row)`.
    pub name: String,
    /// The instants in s, ascending.
    pub times: Vec<f64>,
    /// The value at each instant.
    pub values: Vec<f64>,
    /// The standard deviation of its noise; where it is not known, it is estimated.
    pub deviation: Option<f64>,
}

/// A quantity that is looked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Unknown {
    /// Its name: a parameter, or a coordinate `x` or rate `der(x)` at the start.
    pub name: String,
    /// From where it is looked for; `None` for the declared value.
    pub guess: Option<f64>,
    /// The smallest and the largest value that it may have.
    pub bounds: [f64; 2],
}

/// The runs of a fit unless others are asked for: their error lies well below that of a measurement.
const TOLERANCES: [f64; 2] = [1e-9, 1e-12];
/// Values beyond this have no squares that are numbers.
const LARGEST: f64 = 1e100;
/// From so many starts it looks at most.
const STARTS: usize = 12;

impl Experiment {
    /// An experiment with a mechanism as it is declared, in which nothing was measured yet.
    pub fn of(info: &'static Info) -> Self {
        let defaults = |list: &[mbs_runtime::Quantity]| list.iter().map(|q| q.default).collect();
        let [rtol, atol] = TOLERANCES;
        Self {
            info,
            parameters: defaults(info.parameters),
            inputs: defaults(info.inputs),
            table: Arc::default(),
            start_time: None,
            tolerances: Tolerances { rtol, atol, ..Tolerances::default() },
            measured: Vec::new(),
            unknown: Vec::new(),
            starts: STARTS,
            confidence: 0.95,
        }
    }

    /// With these parameters, in the order of [`Info::parameters`].
    #[must_use]
    pub fn parameters(self, parameters: Vec<f64>) -> Self {
        Self { parameters, ..self }
    }

    /// With these constant inputs, in the order of [`Info::inputs`].
    #[must_use]
    pub fn inputs(self, inputs: Vec<f64>) -> Self {
        Self { inputs, ..self }
    }

    /// With inputs that change with time.
    #[must_use]
    pub fn driven_by(self, table: Arc<InputTable>) -> Self {
        Self { table, ..self }
    }

    /// Starts at another time than the declared one, in s: when a clock of its own showed this as the motion began.
    #[must_use]
    pub fn starting_at(self, start_time: f64) -> Self {
        Self { start_time: Some(start_time), ..self }
    }

    /// With samples of a quantity whose noise is estimated from what the model leaves over.
    #[must_use]
    pub fn measured(self, name: &str, times: &[f64], values: &[f64]) -> Self {
        let (times, values) = (times.to_vec(), values.to_vec());
        self.with(Measurement { name: name.into(), times, values, deviation: None })
    }

    /// With samples of a quantity.
    #[must_use]
    pub fn with(mut self, measured: Measurement) -> Self {
        self.measured.push(measured);
        self
    }

    /// Looks for a quantity, from a value on.
    #[must_use]
    pub fn unknown(self, name: &str, guess: f64) -> Self {
        let bounds = [f64::NEG_INFINITY, f64::INFINITY];
        self.looking_for(Unknown { name: name.into(), guess: Some(guess), bounds })
    }

    /// Looks for a quantity.
    #[must_use]
    pub fn looking_for(mut self, unknown: Unknown) -> Self {
        self.unknown.push(unknown);
        self
    }

    /// Looks from so many starts at most: the given one, and others within a factor of 4 of it. It looks
    /// from others until two lead to the same sum of squares, the smallest of all.
    #[must_use]
    pub fn starts(self, starts: usize) -> Self {
        Self { starts: starts.max(1), ..self }
    }

    /// With intervals that contain the true value with this probability; 0.95 unless it is said.
    #[must_use]
    pub fn confidence(self, confidence: f64) -> Self {
        Self { confidence, ..self }
    }

    /// With runs to these tolerances.
    #[must_use]
    pub fn tolerances(self, tolerances: Tolerances) -> Self {
        Self { tolerances, ..self }
    }

    /// The signals of what was measured.
    pub(super) fn channels(&self) -> Result<Vec<Variable>, Error> {
        let names: Vec<String> = self.measured.iter().map(|measured| measured.name.clone()).collect();
        Ok(Signal::outputs(self.info, Some(&names))?.into_iter().map(|signal| signal.variable).collect())
    }

    /// The places of what is looked for.
    pub(super) fn places(&self) -> Result<Vec<Variable>, Error> {
        let known = Signal::adjustable(self.info);
        let find = |unknown: &Unknown| {
            let found = known.iter().find(|signal| signal.name == unknown.name);
            found.map(|signal| signal.variable).ok_or_else(|| Error::Unknown {
                kind: "parameter or start value",
                name: unknown.name.clone(),
                known: known.iter().map(|signal| signal.name.clone()).collect(),
            })
        };
        self.unknown.iter().map(find).collect()
    }

    /// Checks that samples and settings can be used.
    pub(super) fn check(&self) -> Result<(), Error> {
        if !(self.confidence > 0.0 && self.confidence < 1.0) {
            return Err(Error::Confidence { value: self.confidence });
        }
        for (what, found, expected) in [
            ("parameters", self.parameters.len(), self.info.parameters.len()),
            ("inputs", self.inputs.len(), self.info.inputs.len()),
        ] {
            if found != expected {
                return Err(Error::Length { what, found, expected });
            }
        }
        for (at, unknown) in self.unknown.iter().enumerate() {
            if self.unknown.iter().take(at).any(|other| other.name == unknown.name) {
                return Err(Error::Twice { name: unknown.name.clone() });
            }
        }
        self.measured.iter().try_for_each(Measurement::check)?;
        let samples = self.measured.iter().map(|measured| measured.times.len()).sum();
        let unknowns = self.unknown.len();
        if unknowns == 0 || samples <= unknowns {
            return Err(Error::FewSamples { samples, unknowns });
        }
        Ok(())
    }
}

/// When the runs of a fit start, where what was measured has a clock of its own; see [`own_clock`].
pub fn clock_of(measured: &[Measurement]) -> Option<f64> {
    let ends =
        measured.iter().filter_map(|measured| Some([*measured.times.first()?, *measured.times.last()?]));
    let both = |[first, last]: [f64; 2], other: [f64; 2]| [first.min(other[0]), last.max(other[1])];
    own_clock(ends.fold([f64::INFINITY, f64::NEG_INFINITY], both))
}

impl Measurement {
    fn check(&self) -> Result<(), Error> {
        let Self { name, times, values, deviation } = self;
        if times.len() != values.len() {
            let (what, found, expected) = ("the values of a measured quantity", values.len(), times.len());
            return Err(Error::Length { what, found, expected });
        }
        let wrong =
            |index: usize, reason: &'static str| Err(Error::Sample { name: name.clone(), index, reason });
        for (index, (time, value)) in times.iter().zip(values).enumerate() {
            if !(time.is_finite() && value.is_finite()) {
                return wrong(index, "it is not a finite number; leave out what was not measured");
            }
            if value.abs() > LARGEST {
                return wrong(index, "it is out of all measure, beyond 1e100");
            }
            if index > 0 && times[index - 1] >= *time {
                return wrong(index, "its time is not after the one before it");
            }
        }
        match deviation {
            Some(deviation) if !(*deviation > 0.0 && deviation.is_finite()) => {
                Err(Error::Deviation { name: name.clone(), value: *deviation })
            }
            _ => Ok(()),
        }
    }
}
