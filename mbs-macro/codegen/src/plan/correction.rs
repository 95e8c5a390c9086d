//! How a start is made consistent.
//!
//! A correction solves a system of the same kind as a step does, with the prescribed coordinates held. So
//! Newton's iteration moves the others least in the norm of the mass matrix. The rank of Φ_q at the declared
//! start decides which coordinates can be held.

use std::collections::{BTreeMap, BTreeSet};

use mbs_symbolic::{Expr, Strategy, Undetermined, Unknown, WatchedPivot, factor};

use super::system::system;
use crate::derive::Equations;
use crate::independence::{Rows, Samples};
use crate::inputs::Inputs;
use crate::model::Model;

/// Δ and growth of a correction that keeps what `start` prescribes, as far as
/// the constraints leave it free.
pub(super) fn correction(
    model: &mut Model,
    equations: &Equations,
    rows: &Rows,
    strategy: Strategy,
    (samples, inputs): (&Samples, &Inputs),
    of_velocities: bool,
) -> Result<(Vec<Expr>, Vec<WatchedPivot>), Undetermined> {
    let rows = &if of_velocities { rows.clone() } else { of_positions(model, rows) };
    let held = held(model, equations, rows, samples, of_velocities);
    let kkt = system(model, equations, rows, &held);
    let factorization = match factor(&mut model.arena, &kkt, strategy) {
        // The rank with these coordinates held was misjudged: scales are too far
        // apart. Without holding any there is a correction.
        Err(_) if !held.is_empty() => {
            let kkt = system(model, equations, rows, &BTreeSet::new());
            factor(&mut model.arena, &kkt, strategy)?
        }
        result => result?,
    };
    let mut rhs = BTreeMap::new();
    for at in rows.eliminated() {
        rhs.insert(Unknown::Row(at), model.arena.variable(inputs.feedback[at]));
    }
    let solution = factorization.solve(&mut model.arena, &rhs);
    let mut roots: Vec<Expr> = (0..model.coordinates.len())
        .map(|at| solution.get(&Unknown::Coordinate(at)).copied().unwrap_or(model.arena.zero()))
        .collect();
    roots.push(factorization.growth(&mut model.arena));
    Ok((roots, factorization.pivots))
}

/// Rows without the equations between rates, of which none is redundant.
fn of_positions(model: &Model, rows: &Rows) -> Rows {
    let basis = model.of_positions(&rows.basis);
    let of_rates = rows.basis.iter().filter(|row| !basis.contains(row));
    let left_out = rows.left_out.iter().chain(of_rates).copied().collect();
    Rows { basis, left_out, ..rows.clone() }
}

/// The coordinates that keep their start values: in the order of declaration,
/// as long as the constraints can be met by moving the others. Judged at the
/// declared start, where x² + y² = l² cannot be met by moving y if y = 0; or,
/// should the start be singular as it is declared, at a random position.
fn held(
    model: &Model,
    equations: &Equations,
    rows: &Rows,
    samples: &Samples,
    of_velocities: bool,
) -> BTreeSet<usize> {
    let declared = model.start.iter().filter(|start| start.is_rate == of_velocities && !start.is_guess);
    let coordinates: Vec<usize> = declared.map(|start| start.coordinate).collect();
    samples.holdable(model, equations, &rows.basis, &coordinates)
}
