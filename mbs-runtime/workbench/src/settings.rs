//! What a run is asked to do.

use mbs_runtime::{Explicit, Quantity, Tableau};

use crate::{Error, Model, Signals};

/// When the feedback is evaluated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FeedbackKind {
    /// Once a step ([`mbs_runtime::Held`]).
    #[default]
    Held,
    /// In every stage of a step ([`mbs_runtime::PerStage`]).
    PerStage,
}

/// Where a run starts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StartKind {
    /// The declared start, made consistent with the constraints.
    #[default]
    Consistent,
    /// The declared start as it is.
    Declared,
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
    /// When the feedback is evaluated.
    pub feedback: FeedbackKind,
    /// Where the run starts.
    pub start: StartKind,
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
            feedback: FeedbackKind::default(),
            start: StartKind::default(),
            allow_unstable: false,
        }
    }
}

/// What a run starts with: settings in which every quantity of a mechanism has its number.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// The parameters in SI units, in the order of [`Info::parameters`](mbs_runtime::Info::parameters).
    pub parameters: Vec<f64>,
    /// The inputs in SI units, in the order of [`Info::inputs`](mbs_runtime::Info::inputs).
    pub inputs: Vec<f64>,
    /// The scheme, and when the feedback is evaluated.
    pub method: Explicit,
    /// α in 1/s.
    pub alpha: f64,
    /// β in 1/s.
    pub beta: f64,
    /// Step in s.
    pub step: f64,
    /// Where the run starts.
    pub kind: StartKind,
    /// Accept gains under which violations grow.
    pub allow_unstable: bool,
}

impl Start {
    /// What these settings mean for a mechanism.
    ///
    /// # Errors
    /// A step that is not positive, a name that the mechanism does not have.
    pub fn of(model: &dyn Model, settings: &Settings) -> Result<Self, Error> {
        let info = model.info();
        let step = settings.step;
        if !(step > 0.0 && step.is_finite()) {
            return Err(mbs_runtime::Error::Step { step }.into());
        }
        let method = Explicit {
            tableau: settings.scheme.unwrap_or(model.scheme()),
            is_held: settings.feedback == FeedbackKind::Held,
        };
        let [alpha, beta] = method.deadbeat(step);
        Ok(Self {
            parameters: assigned("parameter", info.parameters, &settings.parameters)?,
            inputs: assigned("input", info.inputs, &settings.inputs)?,
            method,
            alpha: settings.alpha.unwrap_or(alpha),
            beta: settings.beta.unwrap_or(beta),
            step,
            kind: settings.start,
            allow_unstable: settings.allow_unstable,
        })
    }
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
