//! The start that settings mean for a mechanism.

use mbs_runtime::equations::Grid;
use mbs_runtime::{DOPRI5, Explicit, Info, Quantity, Stabilization, Tableau, Tolerances};

use crate::{Error, Model, OtherMethod, Settings, Signals, Start, Until, start_state};

impl Start {
    /// The start that these settings mean for a mechanism.
    ///
    /// # Errors
    /// A step that is not positive, a name that the mechanism does not have, feedback or gains
    /// where the constraints are kept by projection, a method of another kind and what it has no use for.
    pub fn of(model: &dyn Model, settings: &Settings) -> Result<Self, Error> {
        let info = model.info();
        if !(settings.step > 0.0 && settings.step.is_finite()) {
            return Err(mbs_runtime::Error::Step { step: settings.step }.into());
        }
        let parameters = assigned("parameter", info.parameters, &settings.parameters)?;
        let step = step(model, settings, &parameters)?;
        if let Some(other) = settings.other {
            has_no_other(other, settings)?;
        }
        let method = method(info, model.scheme(), settings)?;
        let [alpha, beta] = method.deadbeat(step);
        let start = Self {
            parameters,
            inputs: inputs(info, &settings.inputs)?,
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
            tolerances: settings.tolerances_of_run(info).map(|tolerances| Tolerances {
                max_step: tolerances.max_step.min(settings.end.max(step)),
                ..tolerances
            }),
            threshold: settings.until.as_ref().and_then(Until::threshold),
            kind: settings.start,
            state: None,
            is_looked_at: false,
            allow_unstable: settings.allow_unstable,
        };
        if settings.from.is_empty() { Ok(start) } else { start.with_values(model, &settings.from) }
    }

    /// The same where no mode holds: its constraints need not be met where a search or another start is to meet them.
    pub(crate) fn without_modes(&self, info: &Info) -> Self {
        let mut start = self.clone();
        for mode in info.modes.modes {
            start.inputs[mode.memory] = 0.0;
        }
        start
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
}

/// The step of the settings, or where nobody asked for it, the longest one that is no longer and leads to the samples of
/// the clocks.
fn step(model: &dyn Model, settings: &Settings, parameters: &[f64]) -> Result<f64, Error> {
    let has_clocks = model.info().sampling.clocks > 0;
    if !(has_clocks && settings.fits_clocks && settings.tolerances_of_run(model.info()).is_none()) {
        return Ok(settings.step);
    }
    let grid = Grid {
        start: settings.signals.as_ref().and_then(Signals::start_time).unwrap_or(0.0),
        step: settings.step,
    };
    let fitted = grid.fitted(model.clocks(parameters)?.into_iter(), f64::EPSILON);
    Ok(fitted.map_or(settings.step, |grid| grid.step))
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
fn method(info: &Info, declared: &'static Tableau, settings: &Settings) -> Result<Explicit, Error> {
    let Settings { scheme, stabilization, alpha, beta, .. } = settings;
    let is_adaptive = settings.tolerances_of_run(info).is_some();
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
    let mut values = defaults(quantities);
    for (name, value) in settings {
        *place(kind, quantities, name, &mut values)? = *value;
    }
    Ok(values)
}

/// The inputs with values that are set, and memories as they are declared. A mode may be set, too: 1 where it holds from
/// the start, else 0.
fn inputs(info: &Info, settings: &[(String, f64)]) -> Result<Vec<f64>, Error> {
    let known = settable(info);
    let is_mode = |name: &str| info.modes.modes.iter().any(|mode| mode.name == name);
    if let Some((name, value)) =
        settings.iter().find(|(name, value)| is_mode(name) && value * value != *value)
    {
        let reason = format!("a mode holds, 1, or does not, 0, and cannot be {value}");
        return Err(Error::Name { name: name.clone(), reason });
    }
    let given = assigned("input", &known, settings)?;
    let mut inputs = defaults(info.inputs);
    for (at, value) in info.settable_inputs().zip(given) {
        inputs[at] = value;
    }
    Ok(inputs)
}

/// The inputs that may be set for a run, with modes.
pub(crate) fn settable(info: &Info) -> Vec<Quantity> {
    info.settable_inputs().filter_map(|at| info.inputs.get(at).copied()).collect()
}

/// The declared values.
fn defaults(quantities: &[Quantity]) -> Vec<f64> {
    quantities.iter().map(|quantity| quantity.default).collect()
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
