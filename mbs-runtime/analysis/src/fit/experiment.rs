//! A measured run, its conditions, and the unknowns of the mechanism.

use std::sync::Arc;

use mbs_runtime::{Info, Tolerances};

use crate::{Error, InputTable, Signal, Variable, own_clock};

/// A measured run of a mechanism and what is unknown of it.
///
/// Values are in SI units and rad. The page on [`identification`](crate::identification) has the equations.
///
/// # Example
/// A block of 1 kg on a spring of unknown stiffness, released at 1 m:
/// ```
/// use mbs_analysis::{Experiment, Measurement, Unknown, trials_of_type};
/// # use mbs_runtime::{Mechanism, Tolerances, mechanism};
/// # mechanism! {
/// #     pub Oscillator {
/// #         dof = 1;
/// #         param k = 3 [N/m] where k > 0;
/// #         body block (x) { mass = 1 [kg]; }
/// #         force spring on x = -k*x;
/// #         start { x = 1 [m]; }
/// #     }
/// # }
///
/// // read from the motion of 4 N/m, cos 2t, by a sensor that errs by 1 mm
/// let times: Vec<f64> = (0..20).map(|at| 0.1 * f64::from(at)).collect();
/// let values = times.iter().map(|t| (2.0 * t).cos()).collect();
/// let fit = Experiment::of(<Oscillator as Mechanism>::INFO)
///     .with(Measurement { name: "x".into(), times, values, deviation: Some(1e-3) })
///     .looking_for(Unknown { name: "k".into(), guess: None, bounds: [1.0, 10.0] })
///     .confidence(0.99)
///     .starts(2)
///     .tolerances(Tolerances { rtol: 1e-10, ..Tolerances::default() })
///     .fit(&trials_of_type::<Oscillator>())?;
/// let k = &fit.estimates[0];
/// assert!((k.value - 4.0).abs() < 1e-6 && k.standard_error < 2e-3);
/// // 99 % of a normal distribution lie within 2.576 deviations
/// assert!((fit.coverage - 2.576).abs() < 1e-3);
/// # Ok::<(), mbs_analysis::Error>(())
/// ```
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

/// A quantity that was measured. See the example of [`Experiment`].
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// Its name: an output, a coordinate `x`, its rate `der(x)`, or a multiplier `lambda(row)`.
    pub name: String,
    /// The instants in s, ascending.
    pub times: Vec<f64>,
    /// The value at each instant.
    pub values: Vec<f64>,
    /// The standard deviation of its noise; `None` to estimate it.
    pub deviation: Option<f64>,
}

/// A quantity that is looked for. See the example of [`Experiment`].
#[derive(Clone, Debug, PartialEq)]
pub struct Unknown {
    /// Its name: a parameter, or a coordinate `x` or rate `der(x)` at the start.
    pub name: String,
    /// The value from which it is looked for; `None` for the declared value.
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
    /// An experiment with a mechanism as it is declared, in which nothing was measured yet. See the example of
    /// [`Experiment`].
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

    /// Sets the parameters that are not looked for, in SI units in the order of [`Info::parameters`].
    ///
    /// # Example
    /// A text, with `trials` as in the example of [`Trials`](crate::Trials):
    /// ```
    /// # use mbs_analysis::Experiment;
    /// # use mbs_live::{Prepared, Text};
    /// # use mbs_runtime::equations::Partials;
    /// let text = "Fall {
    ///     dof = 1;
    ///     param g = 9.81 [m/s^2];
    ///     gravity = (0, -g);
    ///     body ball (y) { mass = 1 [kg]; }
    ///     start { y = 0; der(y) = 0; }
    /// }";
    /// # let live = Text::declaration("fall.mbs", text).compile()?;
    /// # let over = live.over::<Partials>();
    /// # let trials = |values: &[Partials]| {
    /// #     let live = over.with_parameters(|own| own.copy_from_slice(values))?;
    /// #     Ok(Prepared::new(&live))
    /// # };
    ///
    /// // on the moon: thrown upwards with 4 m/s
    /// let times = [0.5, 1.0, 1.5];
    /// let heights = times.map(|t| 4.0 * t - 0.5 * 1.62 * t * t);
    /// let fit = Experiment::of(live.declared_info())
    ///     .parameters(vec![1.62])
    ///     .measured("y", &times, &heights)
    ///     .unknown("der(y)", 1.0)
    ///     .fit(&trials)?;
    /// assert!((fit.estimates[0].value - 4.0).abs() < 1e-6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn parameters(self, parameters: Vec<f64>) -> Self {
        Self { parameters, ..self }
    }

    /// Sets constant inputs in SI units, in the order of [`Info::inputs`]. The page on
    /// [`identification`](crate::identification) has an example.
    #[must_use]
    pub fn inputs(self, inputs: Vec<f64>) -> Self {
        Self { inputs, ..self }
    }

    /// Sets inputs that change with time; the others are those of [`inputs`](Self::inputs). See the example of
    /// [`starting_at`](Self::starting_at).
    #[must_use]
    pub fn driven_by(self, table: Arc<InputTable>) -> Self {
        Self { table, ..self }
    }

    /// Starts at another time than the declared one, in s. It is the time that the clock of the log showed as the motion
    /// began; [`clock_of`] finds it.
    ///
    /// # Example
    /// A text, with `trials` as in the example of [`Trials`](crate::Trials):
    /// ```
    /// # use mbs_analysis::{Experiment, InputTable};
    /// # use mbs_live::{Prepared, Text};
    /// # use mbs_runtime::equations::Partials;
    /// let text = "Cart {
    ///     dof = 1;
    ///     param m = 1 [kg] where m > 0;
    ///     input push [N];
    ///     body cart (x) { mass = m; }
    ///     force pushed on x = push;
    ///     start { x = 0; }
    /// }";
    /// # let live = Text::declaration("cart.mbs", text).compile()?;
    /// # let over = live.over::<Partials>();
    /// # let trials = |values: &[Partials]| {
    /// #     let live = over.with_parameters(|own| own.copy_from_slice(values))?;
    /// #     Ok(Prepared::new(&live))
    /// # };
    ///
    /// // 3 N on 2 kg from 100 s on
    /// let push = InputTable::new(vec![100.0, 101.0], vec![(0, vec![3.0, 3.0])])?;
    /// let fit = Experiment::of(live.declared_info())
    ///     .driven_by(push.into())
    ///     .starting_at(100.0)
    ///     .measured("der(x)", &[100.0, 100.5, 101.0], &[0.0, 0.75, 1.5])
    ///     .unknown("m", 1.0)
    ///     .fit(&trials)?;
    /// assert!((fit.estimates[0].value - 2.0).abs() < 1e-6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn starting_at(self, start_time: f64) -> Self {
        Self { start_time: Some(start_time), ..self }
    }

    /// Adds samples of a quantity, at ascending times in s. The deviation of its noise is estimated from the
    /// residuals. See the example of [`fit`](Self::fit).
    #[must_use]
    pub fn measured(self, name: &str, times: &[f64], values: &[f64]) -> Self {
        let (times, values) = (times.to_vec(), values.to_vec());
        self.with(Measurement { name: name.into(), times, values, deviation: None })
    }

    /// Adds samples of a quantity. See the example of [`Experiment`].
    #[must_use]
    pub fn with(mut self, measured: Measurement) -> Self {
        self.measured.push(measured);
        self
    }

    /// Looks for a quantity without bounds, from a value in SI units on. See the example of [`fit`](Self::fit).
    #[must_use]
    pub fn unknown(self, name: &str, guess: f64) -> Self {
        let bounds = [f64::NEG_INFINITY, f64::INFINITY];
        self.looking_for(Unknown { name: name.into(), guess: Some(guess), bounds })
    }

    /// Looks for a quantity. See the example of [`Experiment`].
    #[must_use]
    pub fn looking_for(mut self, unknown: Unknown) -> Self {
        self.unknown.push(unknown);
        self
    }

    /// Sets the largest number of starts: the given one, and others within a factor of 4 of it. The search ends
    /// earlier if two starts lead to the smallest sum of squares.
    #[must_use]
    pub fn starts(self, starts: usize) -> Self {
        Self { starts: starts.max(1), ..self }
    }

    /// Sets the probability with which an interval contains the true value; 0.95 by default.
    #[must_use]
    pub fn confidence(self, confidence: f64) -> Self {
        Self { confidence, ..self }
    }

    /// Sets the tolerances of the runs; 10⁻⁹ relative and 10⁻¹² absolute by default.
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

/// The start in s of the runs of a fit, if the measurements have a clock of their own; see [`own_clock`].
///
/// # Example
/// ```
/// use mbs_analysis::{Measurement, clock_of};
///
/// let log = |from: f64| {
///     let times = vec![from, from + 1.0, from + 2.0];
///     [Measurement { name: "x".into(), times, values: vec![0.0; 3], deviation: None }]
/// };
/// assert_eq!(clock_of(&log(0.0)), None);
/// assert_eq!(clock_of(&log(1200.0)), Some(1200.0));
/// ```
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
