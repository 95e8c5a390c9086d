//! JSON for scripts.

use serde_json::{Map, Value, json};

use super::options;
use super::simulate::Request;
use crate::{Model, Recording, Settings, Unit};

/// A number; what is not finite, for which JSON has no number, as text.
pub(super) fn number(x: f64) -> Value {
    if x.is_finite() { json!(x) } else { json!(x.to_string()) }
}

fn value(x: f64, unit: &str) -> Value {
    json!({ "value": number(x), "unit": unit })
}

/// The summary of a run.
pub(super) fn run(request: &Request<'_>, settings: &Settings, recording: &Recording) -> Value {
    let summary = &recording.summary;
    let last = |column: &crate::Column| {
        let last = column.values.last().copied().unwrap_or(f64::NAN);
        (column.name.clone(), value(last, &column.unit))
    };
    let given = options::given(request.model.info(), settings);
    let given: Map<_, _> =
        given.iter().map(|(name, x, unit)| (name.clone(), value(unit.shown(*x), unit.name()))).collect();
    json!({
        "mechanism": request.name,
        "given": given,
        "steps": summary.steps,
        "effort": summary.effort.map(|effort| json!({
            "steps": effort.steps, "rejected": effort.rejected,
            "shortest_s": number(effort.shortest), "longest_s": number(effort.longest),
        })),
        "events": recording.occurrences.iter().map(|event| json!({
            "name": event.name, "t_s": number(event.t), "rising": event.is_rising,
        })).collect::<Vec<_>>(),
        "unmet": recording.unmet.as_ref().map(|unmet| &unmet.condition),
        "end_s": number(summary.end),
        "max_phi": number(summary.max_phi),
        "max_phi_dot": number(summary.max_phi_dot),
        "energy_change_J": number(summary.energy_end - summary.energy_start),
        "final": recording.columns.iter().map(last).collect::<Map<_, _>>(),
        "error": recording.ended.map(|error| error.to_string()),
        "warnings": recording.doubts.iter().map(ToString::to_string).collect::<Vec<_>>(),
        "notes": recording.notes,
        "files": request.files.all().into_iter().flatten().map(|path| path.display().to_string()).collect::<Vec<_>>(),
    })
}

/// The mechanisms and what can be set on them.
pub(super) fn list(models: &[(&str, &dyn Model)]) -> Value {
    let quantity = |q: &mbs_runtime::Quantity| {
        let unit = Unit::of(q);
        json!({ "name": q.name, "doc": q.doc, "unit": unit.name(), "value": number(unit.shown(q.default)) })
    };
    let output =
        |q: &mbs_runtime::Quantity| json!({ "name": q.name, "doc": q.doc, "unit": Unit::of(q).name() });
    let coordinate = |q: &mbs_runtime::Quantity| json!({ "name": q.name, "doc": q.doc, "unit": Unit::of_coordinate(q).name() });
    let model = |(name, model): &(&str, &dyn Model)| {
        let info = model.info();
        json!({
            "name": name, "doc": info.doc, "dof": info.dof,
            "parameters": info.parameters.iter().map(quantity).collect::<Vec<_>>(),
            "inputs": info.free_inputs().iter().map(quantity).collect::<Vec<_>>(),
            "memories": info.memories().iter().map(quantity).collect::<Vec<_>>(),
            "coordinates": info.coordinates.iter().take(info.lines).map(coordinate).collect::<Vec<_>>(),
            "states": info.coordinates.iter().skip(info.lines).map(quantity).collect::<Vec<_>>(),
            "outputs": info.outputs.iter().map(output).collect::<Vec<_>>(),
        })
    };
    models.iter().map(model).collect()
}
