//! Elimination of the constrained system at compile time.
//!
//! The matrix ⎡M Φ_qᵀ; Φ_q 0⎤ is symmetric. It is eliminated by
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
//! Coordinates without mass have no safe diagonal entry. Where pairs do not
//! determine them, their rows are added to the mass block first
//! (`augmentation`), which makes it positive definite.
//!
//! Of some rows one may be spare, in every position another one (`deflation`). They come
//! last, and are made independent first.
//!
//! [`factor`] fixes the order and the multipliers for the matrix;
//! [`Factorization::solve`] then gives the solution for any right-hand side,
//! as expressions.
//!
//! # Why these pivots cannot vanish
//!
//! * The coefficient of a pair is a number, or its row touches nothing else. In the second case it vanishes
//!   exactly where the system is singular. Driven mechanisms become triangular by such pairs.
//! * A mass is positive by declaration, or by its form: a sum of squares with a constant term.
//! * A row of the Schur complement is taken when all its coordinates are eliminated.
//!
//! The second row of a pin follows the first and is coupled with it. There 1/(k − c²/p) is computed as
//! p/(kp − c²), so that the two divisions do not wait for each other.
//!
//! # Files
//!
//! `order` chooses a pivot, `factorization` takes it, and `steps` leads right-hand sides through it. `watch`
//! measures how much of each pivot has cancelled. `unit` takes a common factor out of the masses. `sums`
//! multiplies right-hand sides out where that costs less.

mod augmentation;
mod deflation;
mod factorization;
mod matrix;
mod order;
mod signs;
mod single_loop;
mod steps;
mod sums;
mod unit;
mod watch;

pub use factorization::{Elimination, Factorization};
pub use matrix::{Kkt, Unknown};
pub use order::{Strategy, Undetermined};
pub use sums::Sums;
pub use watch::WatchedPivot;

use crate::arena::Arena;
use order::Next;

/// Eliminates the matrix in the order that `strategy` chooses.
///
/// # Errors
/// [`Undetermined`] names the unknowns for which no pivot is left.
pub fn factor(arena: &mut Arena, kkt: &Kkt, strategy: Strategy) -> Result<Factorization, Undetermined> {
    let factorization = factor_within(arena, kkt, strategy, usize::MAX)?;
    factorization.ok_or_else(|| Undetermined { unknowns: kkt.unknowns().collect() })
}

/// The same, as long as no more than `most` entries of the matrix change on the
/// way: `None` where the order fills the matrix.
///
/// The loop ends: a pivot takes out at least one unknown, rows are added to
/// masses only while some mass is uncertain, which none is afterwards, and each set of rows is deflated once.
///
/// # Errors
/// As those of [`factor`].
pub fn factor_within(
    arena: &mut Arena,
    kkt: &Kkt,
    strategy: Strategy,
    most: usize,
) -> Result<Option<Factorization>, Undetermined> {
    let mut work = factorization::Work::new(arena, kkt, strategy);
    let mut order = order::Order::new(work.arena, &work.matrix, strategy);
    let mut changed = 0;
    while let Some(next) = order.choose(work.arena, &work.matrix)? {
        let (taken, touched) = match &next {
            Next::Pivot(pivot) => {
                let taken = pivot.unknowns();
                let touched = work.matrix.touched_by(&taken);
                (taken, touched)
            }
            Next::Augmentation(rows) => (Vec::new(), work.matrix.touched_by(rows)),
            Next::Deflation(rows) => (Vec::new(), rows.iter().copied().collect()),
        };
        changed += touched.len() * (touched.len() + 1) / 2;
        if changed > most {
            return Ok(None);
        }
        match next {
            Next::Pivot(pivot) => work.eliminate(pivot),
            Next::Augmentation(rows) => work.augment(&rows),
            Next::Deflation(rows) => work.deflate(&rows),
        }
        order.update(work.arena, &work.matrix, &taken, &touched);
    }
    Ok(Some(work.finish()))
}
