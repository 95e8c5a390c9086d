//! Independent constraints and the degrees of freedom.

use std::collections::BTreeSet;

use super::Samples;
use super::samples::RANK_TOLERANCE;
use crate::derive::Equations;
use crate::diagnostics::{Diagnostic, Diagnostics, listing};
use crate::model::Model;

/// Every constraint adds something that the ones before it do not say. Gives
/// how many of them do.
pub fn check_independence(
    model: &Model,
    equations: &Equations,
    samples: &Samples,
    errors: &mut Diagnostics,
) -> usize {
    let echelons: Vec<Echelon> = samples
        .positions()
        .map(|position| row_echelon(samples.jacobian(model, equations, position)))
        .collect();
    let Some(generic) = echelons.iter().max_by_key(|echelon| echelon.rank()) else { return 0 };
    for (row, combination) in &generic.dependent {
        let constraint = &model.constraints[*row];
        let others: Vec<_> =
            combination.iter().map(|&other| model.constraints[other].name.as_str()).collect();
        let what = if constraint.is_drive { "drive" } else { "constraint" };
        let say = if others.len() == 1 { "says" } else { "say" };
        let mut error = if others.is_empty() {
            Diagnostic::new(
                constraint.span,
                format!("{what} `{}` does not restrict any motion", constraint.name),
            )
        } else {
            Diagnostic::new(
                constraint.span,
                format!("{what} `{}` repeats what {} already {say}", constraint.name, listing(&others)),
            )
        };
        for &other in combination {
            let other = &model.constraints[other];
            error = error.note(other.span, format!("`{}` is one of them", other.name));
        }
        let which = if others.is_empty() { "it" } else { "one of them" };
        errors.push(
            error.help(format!(
                "remove {which}, or correct the equation that was meant to say something else"
            )),
        );
    }
    generic.rank()
}

/// The degrees of freedom that the independent constraints leave are what the
/// declaration promises; the others are reported for themselves.
pub fn check_contract(
    model: &Model,
    equations: &Equations,
    samples: &Samples,
    independent: usize,
    errors: &mut Diagnostics,
) {
    let (declared, span) = model.dof;
    let (n, m) = (model.coordinates.len() as i64, independent as i64);
    if n - m == declared {
        return;
    }
    let message = format!(
        "`{}` declares dof = {declared}, but {n} coordinates − {m} constraints leave {}",
        model.name,
        n - m
    );
    let help = if n - m > declared {
        let free = free_coordinates(model, equations, samples);
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
        let surplus = declared - (n - m);
        let s = if surplus == 1 { "" } else { "s" };
        let drives = match model.constraints.iter().any(|constraint| constraint.is_drive) {
            true => "; a drive is a constraint too",
            false => "",
        };
        let left = n - m;
        format!(
            "{surplus} constraint{s} too many for that; remove or correct, or declare dof = {left}{drives}"
        )
    };
    errors.push(Diagnostic::new(span, message).help(help));
}

/// Coordinates that move in some motion that the constraints allow.
fn free_coordinates<'a>(model: &'a Model, equations: &Equations, samples: &Samples) -> Vec<&'a str> {
    let nothing = BTreeSet::new();
    let full = samples.rank(model, equations, &nothing);
    let is_free = |at: &usize| {
        // A column that the rank does not need belongs to a free motion.
        samples.rank(model, equations, &BTreeSet::from([*at])) == full
    };
    (0..model.coordinates.len())
        .filter(is_free)
        .map(|at| model.coordinates[at].quantity.name.as_str())
        .collect()
}

/// Rows brought to echelon form.
pub struct Echelon {
    rank: usize,
    /// Rows that are combinations of earlier ones, and of which.
    pub dependent: Vec<(usize, Vec<usize>)>,
}

impl Echelon {
    pub fn rank(&self) -> usize {
        self.rank
    }
}

/// Gaussian elimination, row by row with the largest entry of each as pivot,
/// so that a dependent row is the one declared last.
pub fn row_echelon(rows: Vec<Vec<f64>>) -> Echelon {
    /// A reduced row, its pivot column, and how it came from the given rows.
    struct Reduced {
        entries: Vec<f64>,
        pivot: usize,
        history: Vec<f64>,
    }
    let count = rows.len();
    let mut basis: Vec<Reduced> = Vec::new();
    let mut dependent = Vec::new();
    for (at, mut entries) in rows.into_iter().enumerate() {
        let mut history = vec![0.0; count];
        history[at] = 1.0;
        for earlier in &basis {
            let factor = entries[earlier.pivot] / earlier.entries[earlier.pivot];
            subtract(&mut entries, factor, &earlier.entries);
            subtract(&mut history, factor, &earlier.history);
        }
        let largest = |row: &[f64]| {
            row.iter().map(|x| x.abs()).enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0))
        };
        let scale = largest(&history).1;
        match largest(&entries) {
            (pivot, size) if size > RANK_TOLERANCE * scale => basis.push(Reduced { entries, pivot, history }),
            _ => {
                let used = (0..at).filter(|&other| history[other].abs() > RANK_TOLERANCE * scale).collect();
                dependent.push((at, used));
            }
        }
    }
    Echelon { rank: basis.len(), dependent }
}

fn subtract(row: &mut [f64], factor: f64, other: &[f64]) {
    for (x, y) in row.iter_mut().zip(other) {
        *x -= factor * y;
    }
}
