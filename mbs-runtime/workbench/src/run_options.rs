//! Options of a run as a person writes them: at the command line, or in another language.
//!
//! Commands and Python translate their arguments into these texts. So units and messages are the same in
//! both.

use mbs_runtime::{Dimension, Info, Quantity, SCHEMES, Stabilization, Tableau, Tolerances};

use crate::quantity::TIME;
use crate::start::settable;
use crate::{Error, Model, OtherMethod, Settings, Signals, Start, StartKind, StartState, Until, quantity};

const NUMBER: Dimension = Dimension::of(0, 0, 0);
const RATE: Dimension = Dimension::of(0, 0, -1);

/// Options of a run, in texts. Values are numbers with or without a unit; what is left out is as the
/// mechanism declares it.
///
/// # Example
/// ```
/// use mbs_workbench::{RunOptions, model};
///
/// mbs_runtime::mechanism! {
///     pub Oscillator {
///         dof = 1;
///         param k = 200 [N/m];
///         body block (x) { mass = 2 [kg]; }
///         force spring on x = -k*x;
///         start { x = 10 [mm]; }
///     }
/// }
///
/// let oscillator = model::of::<Oscillator>();
/// let mut options = RunOptions { parameters: vec![("k".into(), "0.4 N/mm".into())], ..RunOptions::default() };
/// options.set("end", "300 ms")?;
/// options.set("rtol", "1e-8")?;
/// let settings = options.settings(&*oscillator)?;
/// assert_eq!(settings.parameters, [("k".to_owned(), 400.0)]);
/// assert!(settings.end == 0.3 && settings.tolerances.is_some());
/// assert!(options.set("colour", "blue").is_err());
/// # Ok::<(), mbs_workbench::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunOptions {
    /// Parameters and their values; a bare number is in the unit of the declaration.
    pub parameters: Vec<(String, String)>,
    /// Inputs that are constant, in the same way.
    pub inputs: Vec<(String, String)>,
    /// Inputs that change during the run.
    pub signals: Option<Signals>,
    /// Start values of coordinates `x` and rates `der(x)`, in the same way.
    pub from: Vec<(String, String)>,
    /// Every how many steps a row is recorded, if it is said.
    pub every: Option<u64>,
    /// True if declared events are looked for, which makes the run one to a tolerance.
    pub finds_events: bool,
    /// Accept gains under which violations grow.
    pub allow_unstable: bool,
    /// Those of [`NAMES`](Self::NAMES) that are given, by [`set`](Self::set).
    pub texts: Vec<(&'static str, String)>,
}

impl RunOptions {
    /// The options that are texts. Times and rates are in SI units where their text has no unit.
    pub const NAMES: [&'static str; 11] =
        ["step", "end", "alpha", "beta", "method", "rtol", "atol", "max-step", "feedback", "until", "start"];

    /// Where a run can [start](StartKind).
    pub(crate) const STARTS: [&'static str; 2] = ["consistent", "declared"];

    /// The words of all methods.
    pub fn methods() -> impl Iterator<Item = &'static str> {
        let schemes = SCHEMES.into_iter().map(|scheme| scheme.word);
        schemes.chain(OtherMethod::all().map(OtherMethod::word))
    }

    /// Gives one of [`NAMES`](Self::NAMES) its text.
    ///
    /// # Errors
    /// [`Error::Unknown`] for another name.
    pub fn set(&mut self, name: &str, text: impl Into<String>) -> Result<(), Error> {
        let known = Self::NAMES.into_iter().find(|known| *known == name);
        let known = known.ok_or_else(|| Error::unknown("option", name, Self::NAMES))?;
        self.texts.retain(|(other, _)| *other != known);
        self.texts.push((known, text.into()));
        Ok(())
    }

    fn text(&self, name: &str) -> Option<&str> {
        self.texts.iter().find(|(other, _)| *other == name).map(|(_, text)| text.as_str())
    }

    fn value(&self, name: &str, dimension: Dimension) -> Result<Option<f64>, Error> {
        self.text(name).map(|text| quantity::parse(name, text, dimension)).transpose()
    }

    /// The defaults of a mechanism with the parameters and inputs that are given.
    ///
    /// # Errors
    /// Names that the mechanism does not have, values that cannot be read or have another dimension, an input
    /// that has both a value and a signal.
    pub fn values(&self, model: &dyn Model) -> Result<Settings, Error> {
        let info = model.info();
        let inputs = assignments("input", &settable(info), &self.inputs)
            .map_err(|error| of_clocks(error, info, &self.inputs))?;
        if let Some(signals) = &self.signals {
            not_twice(signals, &inputs)?;
        }
        Ok(Settings {
            parameters: assignments("parameter", info.parameters, &self.parameters)
                .map_err(|error| misplaced(error, info, &self.parameters))
                .map_err(|error| of_clocks(error, info, &self.parameters))?,
            signals: self.signals.clone(),
            inputs,
            ..model.defaults()
        })
    }

    /// The settings that the options ask for, with the defaults of a mechanism where they say nothing.
    ///
    /// # Errors
    /// As [`values`](Self::values); words that name no method, feedback or start.
    pub fn settings(&self, model: &dyn Model) -> Result<Settings, Error> {
        let (info, defaults) = (model.info(), model.defaults());
        // inputs on a clock of their own are followed to their end
        let signals = self.signals.as_ref().filter(|signals| signals.start_time().is_some());
        let end_of_clock = signals.map(|signals| signals.span()[1]);
        let until = self.text("until").map(|text| Until::parse(info, text)).transpose()?;
        let (scheme, other) = self.method()?;
        let feedback = self.feedback()?;
        let has_feedback = ["feedback", "alpha", "beta"].iter().any(|name| self.text(name).is_some());
        // a scheme without an estimate that is asked for, or declared, is taken as it is
        let asked = scheme.or(defaults.scheme).or(model.declares_scheme().then(|| model.scheme()));
        let has_events = self.finds_events
            && !info.events.is_empty()
            && !has_feedback
            && defaults.stabilization.is_none()
            && other.is_none()
            && asked.is_none_or(Tableau::is_adaptive);
        let for_events = (until.is_some() || has_events).then(Tolerances::default);
        // what is declared or of use for events is none for a method that takes constant steps
        let takes_tolerances = !matches!(other, Some(OtherMethod::Rattle(_)));
        let usual = defaults.tolerances.or(for_events).filter(|_| takes_tolerances);
        let tolerances = self.tolerances()?.or(usual);
        // feedback that is declared is of use where constraints are not kept otherwise
        let is_fed_back = tolerances.is_none() && other.is_none();
        let declared = defaults.stabilization.filter(|_| is_fed_back);
        let stabilization = feedback.or(declared);
        let has_gains = is_fed_back && stabilization != Some(Stabilization::Projection);
        let declared_gain = |gain: Option<f64>| gain.filter(|_| has_gains);
        // impacts are found by runs to a tolerance, unless a method is declared that takes constant steps
        let for_stops = model.declares_scheme() && !model.scheme().is_adaptive() && info.jumps();
        let end = self.value("end", TIME)?.or(end_of_clock);
        let settings = Settings {
            step: self.value("step", TIME)?.unwrap_or(defaults.step),
            fits_clocks: defaults.fits_clocks && self.text("step").is_none(),
            end: end.unwrap_or(defaults.end),
            every: self.every.unwrap_or(defaults.every),
            alpha: self.value("alpha", RATE)?.or(declared_gain(defaults.alpha)),
            beta: self.value("beta", RATE)?.or(declared_gain(defaults.beta)),
            scheme: scheme.or(defaults.scheme).or(for_stops.then(|| model.scheme())),
            other,
            stabilization,
            tolerances,
            until,
            start: self.start()?,
            from: StartState::values(info, &self.from)?,
            allow_unstable: self.allow_unstable,
            ..self.values(model)?
        };
        // a run takes as long as it does by default, whenever it starts; what is wrong is told by the run
        let start_time = match end {
            Some(_) => 0.0,
            None => Start::of(model, &settings)
                .and_then(|start| Ok(model.start(&Start { kind: StartKind::Declared, ..start })?.time()))
                .unwrap_or(0.0),
        };
        Ok(Settings { end: settings.end + start_time, ..settings })
    }

    fn method(&self) -> Result<(Option<&'static Tableau>, Option<OtherMethod>), Error> {
        let Some(word) = self.text("method") else { return Ok((None, None)) };
        match (Tableau::find(word), OtherMethod::find(word)) {
            (None, None) => Err(Error::unknown("method", word, Self::methods())),
            found => Ok(found),
        }
    }

    fn feedback(&self) -> Result<Option<Stabilization>, Error> {
        let Some(word) = self.text("feedback") else { return Ok(None) };
        let known = || Stabilization::ALL.map(Stabilization::word);
        Stabilization::find(word).map(Some).ok_or_else(|| Error::unknown("feedback", word, known()))
    }

    fn start(&self) -> Result<StartKind, Error> {
        match self.text("start") {
            None | Some("consistent") => Ok(StartKind::Consistent),
            Some("declared") => Ok(StartKind::Declared),
            Some(other) => Err(Error::unknown("start", other, Self::STARTS)),
        }
    }

    /// The tolerances, if any option asks for a run to such.
    fn tolerances(&self) -> Result<Option<Tolerances>, Error> {
        let (rtol, atol) = (self.value("rtol", NUMBER)?, self.value("atol", NUMBER)?);
        let max_step = self.value("max-step", TIME)?;
        if let Some(step) = max_step.filter(|step| *step <= 0.0) {
            let reason = format!("the longest step is {step} s, but it has to be positive");
            return Err(Error::Name { name: "max-step".into(), reason });
        }
        if rtol.is_none() && atol.is_none() && max_step.is_none() {
            return Ok(None);
        }
        let defaults = rtol.map_or_else(Tolerances::default, Tolerances::relative);
        let tolerances = Tolerances {
            atol: atol.unwrap_or(defaults.atol),
            max_step: max_step.unwrap_or(defaults.max_step),
            ..defaults
        };
        tolerances.check::<f64>()?;
        Ok(Some(tolerances))
    }
}

/// Values in SI units of quantities that a mechanism has.
fn assignments(
    kind: &'static str,
    quantities: &[Quantity],
    texts: &[(String, String)],
) -> Result<Vec<(String, f64)>, Error> {
    let mut assigned: Vec<(String, f64)> = Vec::new();
    for (name, text) in texts {
        let found = quantities.iter().find(|q| q.name == *name);
        let quantity = found.ok_or_else(|| Error::unknown(kind, name, quantities.iter().map(|q| q.name)))?;
        if assigned.iter().any(|(other, _)| other == name) {
            return Err(Error::Name { name: name.clone(), reason: "it is set twice".into() });
        }
        assigned.push((name.clone(), quantity::parse_as(quantity, text)?));
    }
    Ok(assigned)
}

/// A memory that is to be set is told as that.
fn of_clocks(error: Error, info: &Info, asked: &[(String, String)]) -> Error {
    let is_memory = |name: &str| info.memories().iter().any(|memory| memory.name == name);
    match asked.iter().find(|(name, _)| is_memory(name)) {
        Some((name, _)) => {
            let is_mode = info.modes.modes.iter().any(|mode| mode.name == name);
            let is_stop = info.stops.iter().any(|stop| stop.name == name);
            let reason = match (is_mode, is_stop) {
                (true, _) => "it is a mode: `--input` takes 1 where it holds from the start, or 0",
                (_, true) => "it is a stop: the run finds where it is rested on",
                _ => {
                    "it is a memory, which its clock or its condition sets; its first value stands in the declaration"
                }
            };
            Error::Name { name: name.clone(), reason: reason.into() }
        }
        None => error,
    }
}

/// An unknown parameter that is an input, or a coordinate, is told as that.
fn misplaced(error: Error, info: &Info, parameters: &[(String, String)]) -> Error {
    let is_known = |quantities: &[Quantity], name: &str| quantities.iter().any(|q| q.name == name);
    let mut others = parameters.iter().filter(|(name, _)| !is_known(info.parameters, name));
    let found = others.find_map(|(name, text)| {
        let (what, option) = if is_known(info.free_inputs(), name) {
            ("an input", "--input")
        } else if let Some(at) = info.coordinates.iter().position(|q| q.name == name) {
            (if info.is_own(at) { "a state" } else { "a coordinate" }, "--from")
        } else {
            return None;
        };
        let reason = format!("it is {what}, and no parameter; give `{option} {name}={text}`");
        Some(Error::Name { name: name.clone(), reason })
    });
    found.unwrap_or(error)
}

/// Refuses an input that has a value and a signal.
fn not_twice(signals: &Signals, inputs: &[(String, f64)]) -> Result<(), Error> {
    match inputs.iter().find(|(name, _)| signals.names().any(|other| other == name)) {
        Some((name, _)) => Err(Error::Name {
            name: name.clone(),
            reason: "it is set to a value and changes with time; leave one of them out".into(),
        }),
        None => Ok(()),
    }
}
