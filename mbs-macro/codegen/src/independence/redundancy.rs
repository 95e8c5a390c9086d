//! Constraints that are redundant on purpose: which ones are solved for, and
//! whether the others are met with them.

use proc_macro2::Span;

use super::Samples;
use super::assembly::{Assembly, Closing};
use super::echelon::row_echelon;
use super::manifold::Manifold;
use super::rows::{Dependent, Rows};
use super::sets;
use super::words::{Part, repeats, unit};
use crate::diagnostics::{Diagnostic, joined};
use crate::model::Model;

/// The rows to solve for, in the order of declaration as long as each adds
/// something, judged where the mechanism is assembled.
///
/// # Errors
/// A redundant constraint that is violated where the others are met, or none
/// that is redundant.
pub fn choose(
    model: &Model,
    assembly: &Assembly<'_>,
    samples: &Samples,
    manifold: Option<&Manifold>,
    statement: Span,
) -> Result<Rows, Diagnostic> {
    let count = model.constraints.len();
    // As many rows as the contract asks for; all if it asks for more.
    let wanted = usize::try_from(model.line_count() as i64 - model.dof.0).unwrap_or(0).min(count);
    if let Some(manifold) = manifold {
        let redundant: Vec<usize> = manifold.redundant().iter().map(|(row, _)| *row).collect();
        if count - redundant.len() <= wanted {
            if redundant.is_empty() {
                return Err(nothing_redundant(model, statement));
            }
            no_rates(model, manifold)?;
            let mut rows = Rows::without(count, redundant);
            fits_in_time(model, assembly, &rows, manifold)?;
            sets::find(model, assembly, manifold, &mut rows);
            return Ok(rows);
        }
    }
    // All together they do not close, or leave less motion than promised: the
    // ones that add least are the ones that were meant to be redundant.
    let all: Vec<usize> = (0..count).collect();
    let near = assembly.close(&all, &samples.start_position(model)).at;
    let independence = row_echelon(assembly.jacobian(&near).0).independence;
    let mut by_weakness = all;
    by_weakness.sort_by(|&a, &b| independence[a].total_cmp(&independence[b]));
    let mut spare: Vec<usize> = by_weakness.into_iter().take(count - wanted).collect();
    spare.sort_unstable();
    let rows = Rows::without(count, spare);
    let closing = assembly.close(&rows.basis, &samples.start_position(model));
    match largest_violation(assembly, &rows.redundant, &closing) {
        Some((row, violation)) => Err(does_not_fit(model, row, violation, 0.0)),
        // If the mechanism does not close even so, the programs themselves find that.
        // If it closes, the contract tells of it.
        _ if manifold.is_some() => Ok(Rows::without(count, Vec::new())),
        _ => Ok(rows),
    }
}

/// Refuses spare equations between rates: a row that repeats others is watched by its Φ, which they have not.
fn no_rates(model: &Model, manifold: &Manifold) -> Result<(), Diagnostic> {
    let is_rate = |row: &usize| model.constraints[*row].rate.is_some();
    let of_rates = |(row, others): &&Dependent| is_rate(row) || others.iter().any(is_rate);
    let Some((row, others)) = manifold.redundant().iter().find(of_rates) else { return Ok(()) };
    let part = Part::of(model, [*row]);
    let others = Part::of(model, others.iter().copied());
    let message = match part.as_slice() {
        [part] => repeats(part, &others),
        _ => format!("{} and others are not independent", joined(&part)),
    };
    Err(Diagnostic::new(
        model.constraints[*row].span,
        format!("{message}, and nothing holds both at one rate"),
    )
    .help("of equations between rates none may be spare: remove one of them"))
}

/// Redundant drives keep in step with the others: what closes at t = 0 also
/// closes later. All rows are closed together: those that are solved for may depend on each other on the way.
fn fits_in_time(
    model: &Model,
    assembly: &Assembly<'_>,
    rows: &Rows,
    manifold: &Manifold,
) -> Result<(), Diagnostic> {
    let mut from = manifold.start().clone();
    let all: Vec<usize> = (0..assembly.rows()).collect();
    for t in manifold.instants(assembly) {
        from.t = t;
        let closing = assembly.close(&all, &from);
        if !closing.is_closed {
            let closing = assembly.close(&rows.basis, &from);
            if let Some((row, violation)) = largest_violation(assembly, &rows.redundant, &closing) {
                return Err(does_not_fit(model, row, violation, t));
            }
        }
        from = closing.at;
    }
    Ok(())
}

/// The redundant row that is violated most, if the others are met and it is not.
fn largest_violation(
    assembly: &Assembly<'_>,
    redundant: &[usize],
    closing: &Closing,
) -> Option<(usize, f64)> {
    let sizes = redundant.iter().map(|&row| (row, closing.phi[row].abs()));
    let (row, violation) = sizes.max_by(|a, b| a.1.total_cmp(&b.1))?;
    assembly.violation(row, closing).map(|_| (row, violation))
}

/// The error for a redundant constraint that stays violated where the others
/// are met, at the time `t`.
pub fn does_not_fit(model: &Model, row: usize, violation: f64, t: f64) -> Diagnostic {
    let constraint = &model.constraints[row];
    let unit = unit(constraint.dimension);
    let what = joined(Part::of(model, [row]));
    let when = if t == 0.0 { String::new() } else { format!(" at t = {t:.2e} s") };
    Diagnostic::new(
        constraint.span,
        format!(
            "{what}, which is redundant, does not fit: it stays violated by {violation:.1e}{unit}{when} where \
             the others are met"
        ),
    )
    .help(
        "a redundant constraint has to hold wherever the others do; correct its dimensions, best by a formula \
         of the parameters that the others use",
    )
}

fn nothing_redundant(model: &Model, statement: Span) -> Diagnostic {
    Diagnostic::new(statement, format!("no constraint of `{}` is redundant", model.name))
        .help("remove `redundant = minimum_norm;`")
}
