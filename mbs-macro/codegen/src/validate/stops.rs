//! The stops at the declared start.

use crate::diagnostics::Diagnostic;
use crate::independence::assembly::Position;
use crate::model::{Contact, Meaning, Model, Stop};
use crate::validate::start::rounded;

/// A start is behind a stop by more than this share of its size, as runs see it.
const BEHIND: f64 = 1e-9;
const LEAST_SIZE: f64 = 1e-3;
/// Two slopes are opposite within this.
const ROUNDING: f64 = 1e-12;

/// A gap at a position, and its derivatives by the coordinates.
struct Gap<'m> {
    stop: &'m Stop,
    gap: f64,
    slopes: Vec<f64>,
}

/// The error for a start behind a stop: that of two stops with nothing between them, where that is the reason.
pub fn behind(model: &Model, at: &Position) -> Option<Diagnostic> {
    let gaps: Vec<_> = model.stops.iter().map(|stop| gap(model, stop, at)).collect();
    let lines = &at.q[..model.line_count()];
    let size = BEHIND * (LEAST_SIZE + lines.iter().fold(0.0_f64, |size, q| size.max(q.abs())));
    let allowed = |it: &Gap<'_>| size * it.slopes.iter().map(|slope| slope.abs()).sum::<f64>();
    let found = gaps.iter().find(|it| it.gap < -allowed(it))?;
    let faces = |it: &&Gap<'_>| {
        let mut both = it.slopes.iter().zip(&found.slopes);
        both.all(|(a, b)| (a + b).abs() <= ROUNDING * a.abs()) && it.gap + found.gap < -allowed(found)
    };
    let name = &found.stop.quantity.name;
    if let Some(other) = gaps.iter().find(faces) {
        let message = format!("`{name}` and `{}` leave no place between them", other.stop.quantity.name);
        let help = "each of them is beyond the other: check their values, and on which side of `<=` they are";
        let error =
            Diagnostic::new(found.stop.span, message).note(other.stop.span, "the other one is declared here");
        return Some(error.help(help));
    }
    let unit = found.stop.quantity.dimension.si_unit();
    let by = format!("{} {unit}", rounded(-found.gap));
    let message = format!("the declared start is behind the stop `{name}`, by {}", by.trim_end());
    let help = "a mechanism starts before its stops: check its values, its guesses, and on which side of `<=` the value of the stop is";
    Some(Diagnostic::new(found.stop.span, message).help(help))
}

fn gap<'m>(model: &Model, stop: &'m Stop, at: &Position) -> Gap<'m> {
    let symbols = model.values(|meaning| match meaning {
        Meaning::Coordinate(coordinate) => at.q.get(coordinate).copied().unwrap_or(f64::NAN),
        Meaning::Time => at.t,
        _ => f64::NAN,
    });
    let Contact { gap, slopes, .. } = &stop.contact;
    let exprs: Vec<_> = [*gap].into_iter().chain(slopes.iter().map(|(_, slope)| *slope)).collect();
    let values = model.arena.evaluate(&exprs, &symbols);
    let mut dense = vec![0.0; model.coordinates.len()];
    for ((coordinate, _), value) in slopes.iter().zip(&values[1..]) {
        dense[*coordinate] = *value;
    }
    Gap { stop, gap: values[0], slopes: dense }
}
