//! The assembly at the declared dimensions, from the declared start.
//!
//! * Residuals are judged as distances, or against the terms that they are made of (`independence/size.rs`).
//! * No equation may be met where its derivatives vanish.
//! * No pivot of the equations of motion may be lost.
//! * Values that are no guesses are kept.
//!
//! Where one of these fails, starts nearby are tried, for the help of the message.

use super::programs::{Closing, Declared, Programs};
use super::span::check_span;
use super::{start, stops};
use crate::derive::Equations;
use crate::diagnostics::{Diagnostic, Diagnostics, joined};
use crate::independence::assembly::{CLOSED, Position};
use crate::independence::echelon::row_echelon;
use crate::independence::redundancy::does_not_fit;
use crate::independence::samples::Generator;
use crate::independence::words::{Part, repeats, unit};
use crate::model::Model;
use crate::plan::Plan;

/// Other starts that are tried where the declared one leads nowhere, and how far
/// from it the last of them lies, in units of the coordinates.
const ATTEMPTS: usize = 12;
const FARTHEST: f64 = 1.5;

/// The mechanism is assembled from its declared start, is regular there, and starts
/// with the values that are declared; found with the very programs that are emitted.
///
/// # Errors
/// The constraint that cannot be met, the position that is singular, or the values
/// that cannot be kept.
pub fn check_closure(model: &Model, equations: &Equations, plan: &Plan) -> Result<(), Diagnostics> {
    let programs = Programs::new(model, equations, plan);
    let declared = programs.declared();
    let (at, phi) = match programs.close(&declared.at) {
        Closing::Closed(at, phi) => (at, phi),
        failure => {
            let error = start::without_place(model, &declared.at);
            return Err(error.unwrap_or_else(|| failed(model, &programs, &declared, failure)).into());
        }
    };
    if let Some(error) = start::without_place(model, &at).or_else(|| stops::behind(model, &at)) {
        return Err(error.into());
    }
    check_redundant(model, plan, &programs, &at, &phi)?;
    if let Some(error) = flat(model, &programs, &at) {
        return Err(error.into());
    }
    if let Some(pivot) = programs.lost_pivot(&at) {
        return Err(start::singular(model, pivot, away(model, &programs, &declared)).into());
    }
    check_span(model, &programs.assembly, &plan.rows.basis, &at)?;
    let beyond = || beyond_dead_centre(model, plan, &programs, &declared);
    start::check_kept(model, &programs, &declared, &at, beyond)
}

/// Guesses from which the mechanism is assembled with the values that are declared, where it was not:
/// the declared guesses are at a dead centre, where the coordinates that have to move do not move the
/// constraints.
fn beyond_dead_centre(
    model: &Model,
    plan: &Plan,
    programs: &Programs<'_>,
    declared: &Declared,
) -> Option<String> {
    let kept: Vec<usize> = model
        .start
        .iter()
        .filter(|start| !start.is_rate && !start.is_guess)
        .map(|start| start.coordinate)
        .collect();
    let closings = starts(model, programs, declared)
        .map(|start| programs.assembly.close_with(&plan.rows.basis, &start, &kept))
        .filter(|closing| closing.is_closed);
    // the nearest one
    let found = closings.min_by(|a, b| {
        let [a, b] = [a, b].map(|closing| programs.assembly.distance(&closing.at, &declared.at));
        a.total_cmp(&b)
    })?;
    guesses(model, programs, declared, &found.at)
}

/// The error where the declared start leads to no assembly; with another start that
/// does, if one is found.
fn failed(model: &Model, programs: &Programs<'_>, declared: &Declared, failure: Closing) -> Diagnostic {
    let elsewhere = away(model, programs, declared);
    match failure {
        Closing::Singular(at, row) if elsewhere.is_some() => dependent(programs, model, &at, row, elsewhere),
        // Where no start leads to a closed position, the least violation is the reason.
        Closing::Singular(at, row) => {
            let open = starts(model, programs, declared).filter_map(|start| match programs.close(&start) {
                Closing::Open(row, violation) => Some((row, violation)),
                _ => None,
            });
            match open.min_by(|a, b| a.1.total_cmp(&b.1)) {
                Some((row, violation)) if violation.is_finite() => {
                    does_not_close(model, row, violation, None)
                }
                _ => dependent(programs, model, &at, row, None),
            }
        }
        Closing::Open(row, violation) => does_not_close(model, row, violation, elsewhere),
        Closing::Closed(..) => Diagnostic::internal(model.name.span(), "an assembly failed and did not"),
    }
}

fn does_not_close(model: &Model, row: usize, violation: f64, elsewhere: Option<String>) -> Diagnostic {
    let Some(constraint) = model.constraints.get(row) else {
        return Diagnostic::internal(model.name.span(), "an assembly without constraints stays open");
    };
    let (from, help) = match elsewhere {
        Some(guess) => (" from its declared start", format!("start closer, for example with `{guess}`")),
        None => (
            "",
            "check the lengths (can the links reach each other?), or give closer `guess` values in `start`"
                .to_owned(),
        ),
    };
    let unit = unit(constraint.dimension);
    let what = joined(Part::of(model, [row]));
    // where terms vanish only at infinity, what is left is small and all there is
    let left = if violation < CLOSED {
        "is not met by any values: what is left of it is as large as its terms".to_owned()
    } else {
        format!("stays violated by {violation:.1e}{unit}")
    };
    let message = format!("the mechanism does not close at its declared dimensions{from}: {what} {left}");
    Diagnostic::new(constraint.span, message).help(help)
}

/// Starts around the declared one, nearer ones first.
fn starts<'a>(
    model: &'a Model,
    programs: &'a Programs<'_>,
    declared: &'a Declared,
) -> impl Iterator<Item = Position> + 'a {
    let mut generator = Generator::new();
    (1..=ATTEMPTS).map(move |attempt| {
        let length = FARTHEST * attempt as f64 / ATTEMPTS as f64;
        let is_kept = |at: usize| {
            model.start.iter().any(|start| start.coordinate == at && !start.is_rate && !start.is_guess)
        };
        let moved = declared.at.q.iter().zip(&programs.units).enumerate().map(|(at, (q, unit))| {
            let shift = length * unit * generator.symmetric();
            if is_kept(at) { *q } else { q + shift }
        });
        Position { q: moved.collect(), t: declared.at.t }
    })
}

/// Guesses for the coordinates that the declaration does not fix, from which the
/// mechanism is assembled and regular, as entries of `start`.
fn away(model: &Model, programs: &Programs<'_>, declared: &Declared) -> Option<String> {
    let found = starts(model, programs, declared).find_map(|start| match programs.close(&start) {
        Closing::Closed(at, _) if programs.lost_pivot(&at).is_none() => Some(at),
        _ => None,
    })?;
    guesses(model, programs, declared, &found)
}

/// Entries of `start` that lead from the declared one to a position.
fn guesses(model: &Model, programs: &Programs<'_>, declared: &Declared, found: &Position) -> Option<String> {
    let apart = |at: usize| ((found.q[at] - declared.at.q[at]) / programs.units[at]).abs();
    // the coordinates that moved most say where it is
    let mut moved: Vec<usize> = (0..found.q.len()).filter(|&at| apart(at) > 1e-2).collect();
    moved.sort_by(|&a, &b| apart(b).total_cmp(&apart(a)));
    moved.truncate(3);
    moved.sort_unstable();
    let entry = |&at: &usize| {
        format!("guess {} = {};", model.coordinates[at].quantity.name, start::value(model, at, found.q[at]))
    };
    let entries: Vec<String> = moved.iter().map(entry).collect();
    (!entries.is_empty()).then(|| entries.join(" "))
}

/// Redundant constraints are met with the others, also on the branch on which
/// the programs close.
fn check_redundant(
    model: &Model,
    plan: &Plan,
    programs: &Programs<'_>,
    at: &Position,
    phi: &[f64],
) -> Result<(), Diagnostics> {
    let redundant = &plan.rows.redundant;
    let met = programs.assembly.met(at, phi, redundant);
    let open = redundant.iter().zip(met).filter(|(_, is_met)| !is_met).map(|(&row, _)| (row, phi[row].abs()));
    match open.max_by(|a, b| a.1.total_cmp(&b.1)) {
        Some((row, violation)) => Err(does_not_fit(model, row, violation, at.t).into()),
        None => Ok(()),
    }
}

/// The error for an equation that is met where its derivatives vanish.
fn flat(model: &Model, programs: &Programs<'_>, at: &Position) -> Option<Diagnostic> {
    let row = programs.assembly.flat_rows(at).into_iter().next()?;
    let constraint = model.constraints.get(row)?;
    let what = joined(Part::of(model, [row]));
    let message = format!("{what} restricts no motion where it is met: its derivatives vanish there");
    Some(Diagnostic::new(constraint.span, message).help(
        "state what is equal, not that a square of it vanishes: `x = y` and not `(x - y)^2 = 0`; or start where \
         the mechanism can move",
    ))
}

/// The error where the equations for a correction are singular: some constraint
/// repeats others there, if not everywhere.
fn dependent(
    programs: &Programs<'_>,
    model: &Model,
    at: &Position,
    worst: usize,
    elsewhere: Option<String>,
) -> Diagnostic {
    let found = row_echelon(programs.assembly.jacobian(at).0).dependent.pop();
    let (row, others) = found.clone().unwrap_or((worst, Vec::new()));
    let Some(constraint) = model.constraints.get(row) else {
        return Diagnostic::internal(model.name.span(), "an assembly without constraints is singular");
    };
    let part = Part::of(model, [row]);
    let what = match (found, part.as_slice()) {
        (Some(_), [part]) if others.is_empty() => format!("{part} restricts no motion"),
        (Some(_), [part]) => repeats(part, &Part::of(model, others)),
        _ => format!("{} and others are not independent", joined(&part)),
    };
    let help = match elsewhere {
        Some(guess) => {
            format!("declare a start away from this singular position, for example with `{guess}`")
        }
        None => "remove a constraint that is too many, or declare a start away from this singular position"
            .to_owned(),
    };
    Diagnostic::new(constraint.span, format!("near the declared start, {what}")).help(help)
}
