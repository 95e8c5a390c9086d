//! Elimination of the constrained system at compile time.
//!
//! The matrix ⎡M Φ_qᵀ; Φ_q 0⎤ is symmetric. It is eliminated by two kinds of
//! pivots that are safe in every regular position:
//!
//! * a *pair* of a constraint row and a coordinate that this row determines:
//!   a congruence step, so what is left is a smaller system of the same kind
//!   whose mass block is still positive definite;
//! * a *diagonal* entry: a mass (positive), or, once every coordinate that a
//!   row touches is gone, that row's entry of the Schur complement (negative
//!   while the constraints are independent).
//! * a row with its last two coordinates at once (`single_loop`): the one degree
//!   of freedom that a closed loop leaves.
//!
//! [`factor`] fixes the order and the multipliers for the matrix;
//! [`Factorization::solve`] then gives the solution for any right-hand side,
//! as expressions.

mod factorization;
mod matrix;
mod order;
mod signs;
mod single_loop;
mod steps;
mod unit;
mod watch;

pub use factorization::{Elimination, Factorization};
pub use matrix::{Kkt, Unknown};
pub use order::{Strategy, Undetermined};
pub use watch::WatchedPivot;

use crate::arena::{Arena, Expr};

/// Eliminates the matrix in the order that `strategy` chooses.
///
/// `magnitude` tells how small an expression becomes over sampled positions;
/// it decides between pivots of which none is safe by its form.
///
/// # Errors
/// [`Undetermined`] names the unknowns for which no pivot is left.
pub fn factor(
    arena: &mut Arena,
    kkt: &Kkt,
    strategy: Strategy,
    magnitude: &dyn Fn(&Arena, Expr) -> f64,
) -> Result<Factorization, Undetermined> {
    let factorization = factor_within(arena, kkt, strategy, magnitude, usize::MAX)?;
    factorization.ok_or_else(|| Undetermined { unknowns: kkt.unknowns().collect() })
}

/// The same, as long as no more than `most` entries of the matrix change on the
/// way: `None` where the order fills the matrix.
///
/// # Errors
/// As those of [`factor`].
pub fn factor_within(
    arena: &mut Arena,
    kkt: &Kkt,
    strategy: Strategy,
    magnitude: &dyn Fn(&Arena, Expr) -> f64,
    most: usize,
) -> Result<Option<Factorization>, Undetermined> {
    let mut work = factorization::Work::new(arena, kkt, strategy);
    let mut order = order::Order::new(work.arena, &work.matrix, strategy);
    let mut changed = 0;
    // every pivot takes out an unknown or more
    while let Some(pivot) = order.choose(work.arena, &work.matrix, magnitude)? {
        let taken = pivot.unknowns();
        let touched = work.matrix.touched_by(&taken);
        changed += touched.len() * (touched.len() + 1) / 2;
        if changed > most {
            return Ok(None);
        }
        work.eliminate(pivot);
        order.update(work.arena, &work.matrix, &taken, &touched);
    }
    Ok(Some(work.finish()))
}
