//! Panels as data for the page's script.

use serde_json::{Value, json};

use crate::figure::{Axis, Content, Panel, Series, Stroke};

/// A number with the seven digits that a screen can show; `null` if it is not finite.
pub(super) fn number(x: f64) -> Value {
    if !x.is_finite() {
        return Value::Null;
    }
    let rounded: f64 = format!("{x:.6e}").parse().unwrap_or(x);
    json!(rounded)
}

fn axis(axis: &Axis) -> Value {
    json!({ "label": axis.heading(), "log": axis.log, "range": axis.range.map(|(a, b)| [a, b]), "tick": axis.unit_tick })
}

fn series(series: &Series, shown: (f64, f64)) -> Value {
    // Points outside a prescribed range would only make the page longer.
    let points = || series.points.iter().filter(|p| p[0] >= shown.0 && p[0] <= shown.1);
    let coordinate = |at: usize| points().map(|p| number(p[at])).collect::<Vec<_>>();
    let stroke = match series.stroke {
        Stroke::Solid => "solid",
        Stroke::Dashed => "dashed",
        Stroke::Dotted => "dotted",
        Stroke::Points => "points",
    };
    json!({ "name": series.name, "stroke": stroke, "x": coordinate(0), "y": coordinate(1) })
}

/// A panel of curves.
pub(super) fn panel(panel: &Panel) -> Value {
    let shown = panel.x.range.unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
    let curves = match &panel.content {
        Content::Lines(curves) => curves.iter().map(|curve| series(curve, shown)).collect::<Vec<_>>(),
        Content::Map(_) | Content::Mechanism(_) => Vec::new(),
    };
    let marks: Vec<Value> = panel.marks.iter().map(|mark| number(*mark)).collect();
    json!({ "kind": "lines", "x": axis(&panel.x), "y": axis(&panel.y), "series": curves, "marks": marks })
}
