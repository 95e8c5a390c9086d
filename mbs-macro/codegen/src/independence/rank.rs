//! Independent constraints and the degrees of freedom.

use std::collections::BTreeSet;

use super::Samples;
use super::assembly::Assembly;
use super::generic;
use super::manifold::Manifold;
use super::redundancy;
use super::rows::{Dependent, Rows};
use super::words::{Part, repeats, touches};
use crate::derive::Equations;
use crate::diagnostics::{Diagnostic, Diagnostics, counted, listing};
use crate::model::Model;

/// Every constraint adds something that the ones before it do not say, in
/// general and wherever the mechanism is assembled at its declared dimensions,
/// unless it may be redundant; and the degrees of freedom that are left are
/// what the declaration promises.
pub fn check_independence(
    model: &Model,
    equations: &Equations,
    samples: &Samples,
    errors: &mut Diagnostics,
) -> Rows {
    let count = equations.phi.len();
    let assembly = Assembly::new(model, equations);
    let all = Rows::without(count, Vec::new());
    let manifold = Manifold::explore(&assembly, samples, model, &all.basis);
    let touching = manifold.as_ref().map_or_else(Vec::new, |manifold| manifold.touching(&assembly));
    if !touching.is_empty() {
        // what is missing is said first: a joint that was forgotten leaves others in odd positions
        let is_missing = model.line_count() as i64 - count as i64 > model.dof.0;
        match is_missing {
            true => check_contract(model, equations, samples, &all, errors),
            false => report_touching(model, &touching, errors),
        }
        return all;
    }
    if let Some(statement) = model.minimum_norm {
        let chosen = redundancy::choose(model, &assembly, samples, manifold.as_ref(), statement);
        let Some(rows) = errors.take(chosen) else { return all };
        check_contract(model, equations, samples, &rows, errors);
        return rows;
    }
    let generic = generic_dependence(model, equations, samples);
    let at_dimensions = manifold.as_ref().map_or(&[][..], Manifold::redundant);
    if generic.is_empty() {
        report(model, at_dimensions, " in every position at its declared dimensions", errors);
    } else {
        report(model, &generic, "", errors);
    }
    let dependent = if at_dimensions.len() > generic.len() { at_dimensions } else { &generic };
    let independent = Rows::without(count, dependent.iter().map(|(row, _)| *row).collect());
    check_contract(model, equations, samples, &independent, errors);
    all
}

/// The rows that depend on others whatever the dimensions and the position.
fn generic_dependence(model: &Model, equations: &Equations, samples: &Samples) -> Vec<Dependent> {
    let exact = generic::judge(&model.arena, equations);
    if let Some(verdict) = &exact
        && verdict.is_exact
    {
        return verdict.dependent.clone();
    }
    let known = exact.map_or_else(Vec::new, |verdict| verdict.dependent);
    let echelons = samples.positions().map(|position| samples.echelon(model, equations, position));
    let sampled =
        echelons.max_by_key(|echelon| echelon.rank()).map_or_else(Vec::new, |echelon| echelon.dependent);
    if sampled.len() > known.len() { sampled } else { known }
}

/// One error for each joint or equation that is too many.
fn report(model: &Model, dependent: &[Dependent], whenever: &str, errors: &mut Diagnostics) {
    for part in Part::of(model, dependent.iter().map(|(row, _)| *row)) {
        let Some(constraint) = part.row() else { continue };
        let of_part = |row: usize| model.constraints[row].source == *part.source;
        let combinations = dependent.iter().filter(|(row, _)| of_part(*row));
        let rows: Vec<usize> = combinations.flat_map(|(_, rows)| rows.iter().copied()).collect();
        // rows of its own are worth a word only where there are no others
        let is_alone = rows.iter().all(|&row| of_part(row));
        let others = Part::of(model, rows.into_iter().filter(|&row| is_alone || !of_part(row)));
        let message = if others.is_empty() {
            format!("{part} {} not restrict any motion{whenever}", part.verb("does", "do"))
        } else {
            format!("{}{whenever}", repeats(&part, &others))
        };
        let mut error = Diagnostic::new(constraint.span, message);
        for other in &others {
            if let Some(row) = other.row() {
                error = error.note(row.span, format!("`{}` is one of them", other.source.name));
            }
        }
        let remove = if others.is_empty() { "remove it" } else { "remove one of them" };
        let correct = match part.source.bodies {
            Some(_) => "correct the places of the one that was meant to join others",
            None => "correct the equation that was meant to say something else",
        };
        let on_purpose = if others.is_empty() || constraint.is_drive {
            ""
        } else {
            "; if it is there on purpose, as a spare link is, add `redundant = minimum_norm;`"
        };
        errors.push(error.help(format!("{remove}, or {correct}{on_purpose}")));
    }
}

/// One error for each joint or equation that touches others.
fn report_touching(model: &Model, dependent: &[Dependent], errors: &mut Diagnostics) {
    for part in Part::of(model, dependent.iter().map(|(row, _)| *row)) {
        let Some(constraint) = part.row() else { continue };
        let of_part = |row: usize| model.constraints[row].source == *part.source;
        let combinations = dependent.iter().filter(|(row, _)| of_part(*row));
        let rows = combinations.flat_map(|(_, rows)| rows.iter().copied()).filter(|&row| !of_part(row));
        let others = Part::of(model, rows);
        let mut error = Diagnostic::new(constraint.span, touches(&part, &others));
        for other in &others {
            if let Some(row) = other.row() {
                error = error.note(row.span, format!("`{}` is one of them", other.source.name));
            }
        }
        errors.push(error.help(
            "wherever the mechanism can go, they repeat each other to first order; in place of this one state what \
             it adds: a `pin_slot` or `point_on_line` where a pin holds too much, or an equation such as `y1 = y2`",
        ));
    }
}

/// The degrees of freedom that the independent constraints leave are what the
/// declaration promises; the others are reported for themselves.
fn check_contract(
    model: &Model,
    equations: &Equations,
    samples: &Samples,
    rows: &Rows,
    errors: &mut Diagnostics,
) {
    let (declared, span) = model.dof;
    let (n, m) = (model.line_count() as i64, rows.basis.len() as i64);
    if n - m == declared {
        return;
    }
    let independent = if rows.redundant.is_empty() { "" } else { "independent " };
    let message = format!(
        "`{}` declares dof = {declared}, but {} − {} leave {}",
        model.name,
        counted(n, "coordinate"),
        counted(m, &format!("{independent}constraint")),
        n - m
    );
    let help = if n - m > declared {
        let free = free_coordinates(model, equations, samples, &rows.basis);
        let missing = n - m - declared;
        let s = if missing == 1 { "" } else { "s" };
        let pins = if missing == 1 { "" } else { " (a `revolute` is two constraints)" };
        let floating = super::floating::floating_bodies(model);
        let help =
            format!("{missing} constraint{s} or drive{s} missing{pins}; free to move are {}", listing(free));
        match floating.as_slice() {
            [] => help,
            _ => format!("{help}; no joint leads from {} to the ground", listing(floating)),
        }
    } else {
        let surplus = counted(declared - (n - m), "constraint");
        let drives = match model.constraints.iter().any(|constraint| constraint.is_drive) {
            true => "; a drive is a constraint too",
            false => "",
        };
        let left = n - m;
        format!("{surplus} too many for that; remove or correct, or declare dof = {left}{drives}")
    };
    errors.push(Diagnostic::new(span, message).help(help));
}

/// Coordinates that move in some motion that the constraints allow.
fn free_coordinates<'a>(
    model: &'a Model,
    equations: &Equations,
    samples: &Samples,
    rows: &[usize],
) -> Vec<&'a str> {
    let full = samples.rank(model, equations, rows, &BTreeSet::new());
    let is_free = |at: &usize| {
        // A column that the rank does not need belongs to a free motion.
        samples.rank(model, equations, rows, &BTreeSet::from([*at])) == full
    };
    (0..model.line_count()).filter(is_free).map(|at| model.coordinates[at].quantity.name.as_str()).collect()
}
