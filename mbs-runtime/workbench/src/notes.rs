//! Notes on how a run differs from what one may expect. They are no reason to doubt it.

use crate::{Model, Settings, Signals};

/// Declared events that are not looked for, a declared method in whose place another one is taken, and what is made
/// of a table of inputs.
pub(crate) fn notes(model: &dyn Model, settings: &Settings) -> Vec<String> {
    let Settings { tolerances, constant, scheme, .. } = settings;
    let declared = model.scheme();
    let taken = constant.map_or(scheme.unwrap_or(declared).word, |constant| constant.word());
    let is_adaptive = tolerances.is_some() && constant.is_none();
    let mut notes = Vec::new();
    if let ([event, ..], false) = (model.info().events, is_adaptive) {
        notes.push(format!(
            "events such as `{}` are not looked for with the constant steps of `{taken}`; --rtol 1e-6 finds \
             them",
            event.name
        ));
    }
    if is_adaptive && scheme.is_none() && model.declares_scheme() && !declared.is_adaptive() {
        notes.push(format!(
            "the declared method `{}` cannot tell the error of its steps: this run to a tolerance takes `dopri5`",
            declared.word
        ));
    }
    notes.extend(settings.signals.iter().flat_map(Signals::notes));
    notes
}
