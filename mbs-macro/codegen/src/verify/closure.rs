//! The assembly at the declared dimensions.

use mbs_symbolic::units::Dimension;

use super::assembly::CLOSED;
use super::echelon::row_echelon;
use super::redundancy::does_not_fit;
use super::sparse::{SparseRow, scale};
use super::words::{Part, repeats};
use crate::diagnostics::{Diagnostic, Diagnostics, joined};
use crate::model::{Meaning, Model};
use crate::plan::Plan;

const ITERATIONS: usize = 50;
const HALVINGS: usize = 10;

/// Positions on Φ = 0 at t = 0, found with the very programs that are emitted.
///
/// # Errors
/// The constraint that cannot be met.
pub fn check_closure(model: &Model, plan: &Plan) -> Result<(), Diagnostics> {
    let assembly = Assembly::new(model, plan);
    let mut q = assembly.start.clone();
    let mut phi = assembly.phi(&q);
    let mut best = phi.clone();
    for _ in 0..ITERATIONS {
        if norm(&phi) < norm(&best) {
            best.clone_from(&phi);
        }
        let delta = assembly.correction(&q, &phi);
        let size = largest(&delta).1;
        if !size.is_finite() {
            return Err(dependent(&assembly, &q, largest(&phi).0).into());
        }
        if size <= 1e-12 * (1.0 + largest(&q).1) {
            return check_redundant(model, plan, &q, &phi);
        }
        let mut length = 1.0;
        for _ in 0..=HALVINGS {
            let next: Vec<f64> = q.iter().zip(&delta).map(|(q, d)| q + length * d).collect();
            let next_phi = assembly.phi(&next);
            let improves = norm(&next_phi) < norm(&phi);
            if improves || length < 1.0 / f64::from(1 << (HALVINGS - 1)) {
                (q, phi) = (next, next_phi);
                break;
            }
            length *= 0.5;
        }
    }
    // The iteration wanders where there is nothing to find: its best is said.
    let (row, violation) = largest(&best);
    if violation.is_finite() && violation <= CLOSED * (1.0 + largest(&q).1) {
        return Ok(());
    }
    let Some(constraint) = model.constraints.get(row) else { return Ok(()) };
    Err(Diagnostic::new(
        constraint.span,
        format!(
            "the mechanism does not close at its declared dimensions: {} stays violated by {violation:.1e}{}",
            joined(Part::of(model, [row])),
            unit(constraint.dimension)
        ),
    )
    .help("check the lengths (can the links reach each other?), or give closer `guess` values in `start`")
    .into())
}

/// Redundant constraints are met with the others, also on the branch on which
/// the programs close.
fn check_redundant(model: &Model, plan: &Plan, q: &[f64], phi: &[f64]) -> Result<(), Diagnostics> {
    let sizes = plan.rows.redundant.iter().map(|&row| (row, phi[row].abs()));
    match sizes.max_by(|a, b| a.1.total_cmp(&b.1)) {
        Some((row, violation)) if violation > CLOSED * (1.0 + largest(q).1) => {
            Err(does_not_fit(model, row, violation, 0.0).into())
        }
        _ => Ok(()),
    }
}

/// The error where the equations for a correction are singular at `q`: some
/// constraint repeats others there, if not everywhere.
fn dependent(assembly: &Assembly<'_>, q: &[f64], worst: usize) -> Diagnostic {
    let model = assembly.model;
    let found = row_echelon(assembly.jacobian(q)).dependent.pop();
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
    Diagnostic::new(constraint.span, format!("near the declared start, {what}"))
        .help("remove a constraint that is too many, or declare a start away from this singular position")
}

/// The SI unit of a violation, where it is that of a length.
pub fn unit(dimension: Dimension) -> &'static str {
    if dimension == Dimension::LENGTH { " m" } else { "" }
}

struct Assembly<'a> {
    model: &'a Model,
    plan: &'a Plan,
    hoisted: Vec<f64>,
    start: Vec<f64>,
}

impl<'a> Assembly<'a> {
    fn new(model: &'a Model, plan: &'a Plan) -> Self {
        let declared = model.values(|_| f64::NAN);
        let hoisted = plan.prepare.evaluate(&declared, &[]);
        let mut start = plan.start.evaluate(&declared, &[]);
        start.truncate(model.coordinates.len());
        Self { model, plan, hoisted, start }
    }

    fn phi(&self, q: &[f64]) -> Vec<f64> {
        self.plan.phi.evaluate(&self.model.values(|meaning| at_position(meaning, q, &[])), &self.hoisted)
    }

    /// Φ_q, each row scaled to a largest entry of 1.
    fn jacobian(&self, q: &[f64]) -> Vec<SparseRow<f64>> {
        let values = self.model.values(|meaning| at_position(meaning, q, &[]));
        let entries = self.plan.phi_q.evaluate(&values, &self.hoisted);
        let mut rows = vec![SparseRow::new(); self.model.constraints.len()];
        for (&(row, column), entry) in self.plan.phi_q_places.iter().zip(entries) {
            rows[row].push((column, entry));
        }
        rows.iter_mut().for_each(|row| {
            scale(row);
        });
        rows
    }

    fn correction(&self, q: &[f64], phi: &[f64]) -> Vec<f64> {
        let residual: Vec<f64> = phi.iter().map(|x| -x).collect();
        let values = self.model.values(|meaning| at_position(meaning, q, &residual));
        let mut delta = self.plan.position_correction.evaluate(&values, &self.hoisted);
        delta.truncate(q.len());
        delta
    }
}

fn at_position(meaning: Meaning, q: &[f64], residual: &[f64]) -> f64 {
    let known = match meaning {
        Meaning::Time => Some(0.0),
        Meaning::Coordinate(at) => q.get(at).copied(),
        Meaning::Feedback(at) => residual.get(at).copied(),
        _ => None,
    };
    known.unwrap_or(f64::NAN)
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn largest(values: &[f64]) -> (usize, f64) {
    let magnitude = |x: &f64| if x.is_nan() { f64::INFINITY } else { x.abs() };
    values.iter().map(magnitude).enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0))
}
