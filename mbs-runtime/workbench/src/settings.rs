//! Settings of a run.

use std::sync::Arc;

use mbs_analysis::InputTable;
use mbs_runtime::{
    COMPOSITIONS, Composition, DOPRI5, Explicit, IMPLICIT, Implicit, Quantity, Stabilization, TRBDF2,
    Tableau, Threshold, Tolerances,
};

use crate::start_state::{self, StartState};
use crate::{Error, Model, Signals, Until};

/// Where a run starts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StartKind {
    /// The declared start, made consistent with the constraints.
    #[default]
    Consistent,
    /// The declared start as it is.
    Declared,
}

/// A method that is more than the stages of an explicit scheme. It keeps the constraints itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OtherMethod {
    /// RATTLE, for forces that do not depend on velocities, with what a step is composed of. Its steps are
    /// constant.
    Rattle(&'static Composition),
    /// An implicit scheme, for stiff forces. Of TR-BDF2 without tolerances the steps are constant.
    Implicit(&'static Implicit),
}

impl OtherMethod {
    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        COMPOSITIONS.into_iter().map(Self::Rattle).chain(IMPLICIT.into_iter().map(Self::Implicit))
    }

    /// The one with this word.
    pub fn find(word: &str) -> Option<Self> {
        Self::all().find(|method| method.word() == word)
    }

    /// The word that asks for it on the command line.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Rattle(composition) => composition.word,
            Self::Implicit(scheme) => scheme.word,
        }
    }

    /// `true` if its steps are constant where no tolerances are given.
    fn is_constant(self) -> bool {
        match self {
            Self::Rattle(_) => true,
            Self::Implicit(scheme) => scheme.word == TRBDF2.word,
        }
    }
}

/// A run of a mechanism. Values are in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Parameters that differ from their declared values.
    pub parameters: Vec<(String, f64)>,
    /// Inputs that differ from their defaults and are constant over the run.
    pub inputs: Vec<(String, f64)>,
    /// Inputs that change during the run.
    pub signals: Option<Signals>,
    /// Step in s.
    pub step: f64,
    /// End time in s.
    pub end: f64,
    /// Every how many steps a row is recorded; 0 counts as 1.
    pub every: u64,
    /// α in 1/s; `None` for the deadbeat gain of the step.
    pub alpha: Option<f64>,
    /// β in 1/s; `None` for the deadbeat gain of the step.
    pub beta: Option<f64>,
    /// The scheme of the steps; `None` for the one that the mechanism declares.
    pub scheme: Option<&'static Tableau>,
    /// A method of another kind in place of a scheme.
    pub other: Option<OtherMethod>,
    /// The way in which the constraints are kept. `None` for projection of a run to a tolerance, and for held
    /// feedback of one with a constant step.
    pub stabilization: Option<Stabilization>,
    /// For a run to a tolerance: its steps are as long as their error permits, and `step` is the
    /// time between two samples of it.
    pub tolerances: Option<Tolerances>,
    /// The condition at which it ends, of a run to a tolerance.
    pub until: Option<Until>,
    /// Where the run starts.
    pub start: StartKind,
    /// Start values of coordinates `x` and rates `der(x)` in place of the declared ones.
    pub from: Vec<(String, f64)>,
    /// Accept gains under which violations grow.
    pub allow_unstable: bool,
}

impl Default for Settings {
    /// One second in steps of 0.5 ms, everything else as recommended.
    fn default() -> Self {
        Self {
            parameters: Vec::new(),
            inputs: Vec::new(),
            signals: None,
            step: 0.5e-3,
            end: 1.0,
            every: 1,
            alpha: None,
            beta: None,
            scheme: None,
            other: None,
            stabilization: None,
            tolerances: None,
            until: None,
            start: StartKind::default(),
            from: Vec::new(),
            allow_unstable: false,
        }
    }
}

impl Settings {
    /// The tolerances of a run: those that are given, and the usual ones where the method takes no constant steps,
    /// or a condition ends the run. Nothing of a run with a constant step.
    pub(crate) fn tolerances_of_run(&self) -> Option<Tolerances> {
        let is_adaptive = self.until.is_some() || self.other.is_some_and(|other| !other.is_constant());
        self.tolerances.or(is_adaptive.then(Tolerances::default))
    }
}

/// The start of a run: settings in which every quantity of a mechanism has its number.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// The parameters in SI units, in the order of [`Info::parameters`](mbs_runtime::Info::parameters).
    pub parameters: Vec<f64>,
    /// The inputs in SI units, in the order of [`Info::inputs`](mbs_runtime::Info::inputs).
    pub inputs: Vec<f64>,
    /// The inputs that change with time; of those, the values above do not count.
    pub table: Arc<InputTable>,
    /// When the run starts, in s, unless as the mechanism declares it.
    pub start_time: Option<f64>,
    /// The scheme, and what keeps the constraints.
    pub method: Explicit,
    /// A method of another kind in its place.
    pub other: Option<OtherMethod>,
    /// α in 1/s.
    pub alpha: f64,
    /// β in 1/s.
    pub beta: f64,
    /// Step in s; of a run to a tolerance, the time between two samples of it.
    pub step: f64,
    /// The tolerances of a run that keeps such.
    pub tolerances: Option<Tolerances>,
    /// A threshold that it watches beside its declared events.
    pub threshold: Option<Threshold>,
    /// Where the run starts.
    pub kind: StartKind,
    /// The state in place of the declared start. It has to be consistent, unless the start is
    /// [`Declared`](StartKind::Declared).
    pub state: Option<StartState>,
    /// Accept gains under which violations grow.
    pub allow_unstable: bool,
}

impl Start {
    /// The start that these settings mean for a mechanism.
    ///
    /// # Errors
    /// A step that is not positive, a name that the mechanism does not have, feedback or gains
    /// where the constraints are kept by projection, a method of another kind and what it has no use for.
    pub fn of(model: &dyn Model, settings: &Settings) -> Result<Self, Error> {
        let info = model.info();
        let step = settings.step;
        if !(step > 0.0 && step.is_finite()) {
            return Err(mbs_runtime::Error::Step { step }.into());
        }
        if let Some(other) = settings.other {
            has_no_other(other, settings)?;
        }
        let method = method(model.scheme(), settings)?;
        let [alpha, beta] = method.deadbeat(step);
        let start = Self {
            parameters: assigned("parameter", info.parameters, &settings.parameters)?,
            inputs: assigned("input", info.inputs, &settings.inputs)?,
            table: settings
                .signals
                .as_ref()
                .map(|signals| signals.table(info))
                .transpose()?
                .unwrap_or_default(),
            start_time: settings.signals.as_ref().and_then(Signals::start_time),
            method,
            other: settings.other,
            alpha: settings.alpha.unwrap_or(alpha),
            beta: settings.beta.unwrap_or(beta),
            step,
            // a longer step would leave the run
            tolerances: settings.tolerances_of_run().map(|tolerances| Tolerances {
                max_step: tolerances.max_step.min(settings.end.max(step)),
                ..tolerances
            }),
            threshold: settings.until.as_ref().and_then(Until::threshold),
            kind: settings.start,
            state: None,
            allow_unstable: settings.allow_unstable,
        };
        if settings.from.is_empty() { Ok(start) } else { start.with_values(model, &settings.from) }
    }

    /// The same with these start values of coordinates `x` and rates `der(x)` in place of the declared ones, made
    /// consistent: what is given keeps its value, the others move to the constraints.
    ///
    /// # Errors
    /// Names that the mechanism does not have, a start from which it cannot be assembled.
    pub fn with_values(self, model: &dyn Model, values: &[(String, f64)]) -> Result<Self, Error> {
        let state = Some(start_state::with_values(model, &self, values)?);
        Ok(Self { state, ..self })
    }

    /// `true` if inputs from a table change with time.
    pub(crate) fn has_signals(&self) -> bool {
        !self.table.is_empty()
    }
}

/// Refuses what methods of another kind have no use for, since they keep the constraints themselves.
fn has_no_other(method: OtherMethod, settings: &Settings) -> Result<(), Error> {
    let Settings { stabilization, alpha, beta, tolerances, until, .. } = settings;
    let is_rattle = matches!(method, OtherMethod::Rattle(_));
    let refused = [
        (stabilization.is_some(), "feedback"),
        (alpha.is_some(), "alpha"),
        (beta.is_some(), "beta"),
        (tolerances.is_some() && is_rattle, "rtol"),
        (until.is_some() && is_rattle, "until"),
    ];
    match refused.into_iter().find(|(is_given, _)| *is_given) {
        None => Ok(()),
        Some((_, name)) => Err(Error::Name {
            name: name.into(),
            reason: format!(
                "the method `{}` {}; leave it out, or take another method",
                method.word(),
                if is_rattle {
                    "takes constant steps and keeps the constraints itself, so it has no use for feedback, \
                     gains, tolerances or events"
                } else {
                    "keeps the constraints itself, so it has no use for feedback or gains"
                }
            ),
        }),
    }
}

/// The method that settings ask for, of a mechanism with this scheme.
fn method(declared: &'static Tableau, settings: &Settings) -> Result<Explicit, Error> {
    let Settings { scheme, stabilization, alpha, beta, .. } = settings;
    let is_adaptive = settings.tolerances_of_run().is_some();
    let (tableau, stabilization) = match (is_adaptive, stabilization) {
        (true, Some(Stabilization::Held | Stabilization::PerStage)) => {
            let reason = "a run to a tolerance keeps the constraints by projection; leave the feedback out, \
                          or the tolerances for a constant step";
            return Err(Error::Name { name: "feedback".into(), reason: reason.into() });
        }
        (true, _) => {
            let declared = if declared.is_adaptive() { declared } else { &DOPRI5 };
            (scheme.unwrap_or(declared), Stabilization::Projection)
        }
        (false, stabilization) => (scheme.unwrap_or(declared), stabilization.unwrap_or_default()),
    };
    let method = Explicit { tableau, stabilization };
    for (name, gain) in [("alpha", alpha), ("beta", beta)] {
        if let (true, Some(value)) = (method.is_projected(), *gain) {
            return Err(mbs_runtime::Error::NoUseOfGain { name, value }.into());
        }
    }
    Ok(method)
}

/// The declared values with those that are set.
fn assigned(
    kind: &'static str,
    quantities: &[Quantity],
    settings: &[(String, f64)],
) -> Result<Vec<f64>, Error> {
    let mut values: Vec<f64> = quantities.iter().map(|quantity| quantity.default).collect();
    for (name, value) in settings {
        *place(kind, quantities, name, &mut values)? = *value;
    }
    Ok(values)
}

/// The value of the quantity with a name.
pub(crate) fn place<'a>(
    kind: &'static str,
    quantities: &[Quantity],
    name: &str,
    values: &'a mut [f64],
) -> Result<&'a mut f64, Error> {
    let at = quantities.iter().position(|quantity| quantity.name == name);
    let known = || quantities.iter().map(|quantity| quantity.name);
    at.and_then(|at| values.get_mut(at)).ok_or_else(|| Error::unknown(kind, name, known()))
}
