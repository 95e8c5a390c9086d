//! Notes on how a run differs from what one may expect. They are no reason to doubt it.

#[cfg(feature = "desk")]
use mbs_runtime::Info;
use mbs_runtime::System;

use crate::number::significant;
use crate::{Model, OtherMethod, Settings, Signals, Start, StartKind, StartValue};

/// Times that are nearer to each other than this share of a step are not a step apart but for rounding.
const NEARLY: f64 = 1.0 - 1e-6;

/// Declared events that are not looked for, a declared method in whose place another one is taken, and what is made
/// of a table of inputs.
pub(crate) fn notes(model: &dyn Model, settings: &Settings) -> Vec<String> {
    let Settings { other, scheme, .. } = settings;
    let declared = model.scheme();
    let taken = other.map_or(scheme.unwrap_or(declared).word, OtherMethod::word);
    let is_adaptive = settings.tolerances_of_run(model.info()).is_some();
    let mut notes = Vec::new();
    if let ([event, ..], false) = (model.info().events, is_adaptive) {
        notes.push(format!(
            "events such as `{}` are not looked for with the constant steps of `{taken}`; --rtol 1e-6 finds \
             them",
            event.name
        ));
    }
    if is_adaptive
        && scheme.is_none()
        && other.is_none()
        && model.declares_scheme()
        && !declared.is_adaptive()
    {
        notes.push(format!(
            "the declared method `{}` cannot tell the error of its steps: this run to a tolerance takes `dopri5`",
            declared.word
        ));
    }
    let step = Start::of(model, settings).map_or(settings.step, |start| start.step);
    if step < settings.step {
        notes.push(format!(
            "steps of {} s lead to the samples of the clocks, and those of {} s do not",
            significant(step, 7),
            significant(settings.step, 7)
        ));
    }
    notes.extend(settings.signals.iter().flat_map(Signals::notes));
    let closest = settings.signals.as_ref().map(Signals::closest).filter(|closest| *closest < step * NEARLY);
    if let (Some(closest), false) = (closest, is_adaptive) {
        notes.push(format!(
            "rows of the inputs lie {} s apart, and steps of {} s pass what is between them; --rtol 1e-6 ends a step \
             where a value jumps or bends",
            significant(closest, 4),
            significant(step, 4)
        ));
    }
    notes.extend(lost_start_values(model, settings));
    notes
}

/// The memories that hold where no clock acts.
#[cfg(feature = "desk")]
pub(crate) fn held(info: &Info) -> Option<String> {
    let names: Vec<String> = info.memories().iter().map(|memory| format!("`{}`", memory.name)).collect();
    let is_held = !names.is_empty() && info.sampling.clocks > 0;
    let names = names.join(", ");
    is_held.then(|| format!("clocks do not act here: memories hold as the start leaves them ({names})"))
}

/// A run with a constant step that ends beside the time that was asked for.
pub(crate) fn end_note(run: &dyn System, steps: u64, end: f64) -> Option<String> {
    let step = run.step_size();
    let reached = run.time() + steps as f64 * step;
    let is_there = run.effort().is_some() || (reached - end).abs() <= 1e-6 * step;
    (!is_there).then(|| {
        // as many digits as tell the two times from each other
        let texts = (7..=17).map(|digits| [step, end, reached].map(|x| significant(x, digits)));
        let [step, end, reached] =
            texts.into_iter().find(|[_, end, reached]| end != reached).unwrap_or_default();
        format!("steps of {step} s do not end at {end} s: the run ends at {reached} s")
    })
}

/// Start values that are declared, and no guesses, but do not hold with the parameters that are set: the
/// constraints move them. It says so of those that move by more than a thousandth of the largest of their kind.
pub(crate) fn lost_start_values(model: &dyn Model, settings: &Settings) -> Vec<String> {
    let is_declared = settings.parameters.is_empty() || settings.start != StartKind::Consistent;
    if is_declared || !settings.from.is_empty() {
        return Vec::new();
    }
    let info = model.info();
    let mut notes = Vec::new();
    let values = model.start_values_with(settings).unwrap_or_default();
    let (positions, rates) = values.split_at(info.coordinates.len().min(values.len()));
    for (values, kept) in [positions, rates].into_iter().zip(info.kept) {
        let largest = values.iter().flat_map(|value| [value.declared.abs(), value.kept.abs()]);
        let largest = largest.fold(f64::MIN_POSITIVE, f64::max);
        let kept = kept.iter().filter_map(|&at| values.get(at));
        let is_kept = |value: &StartValue| (value.kept - value.declared).abs() <= 1e-3 * largest;
        let lost = kept.filter(|value| !is_kept(value));
        notes.extend(lost.map(|StartValue { name, declared, kept, unit }| {
            let [declared, kept] = [declared, kept].map(|x| significant(*x, 6));
            let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
            format!(
                "`{name}` does not start at {declared}{unit} with these parameters: the constraints make it \
                 {kept}{unit}"
            )
        }));
    }
    notes
}
