//! Whether the sums of a right-hand side are computed once or multiplied out.

use crate::arena::{Arena, Expr, Node};
use crate::number::Number;

/// Sums with more terms than this are computed once instead of being opened where they
/// are used.
pub(super) const LONGEST_OPEN: usize = 12;

/// What becomes of the sums that a right-hand side goes through in the steps of an elimination.
/// The solution is the same; which form is cheaper depends on the mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sums {
    /// Each is computed once.
    Closed,
    /// Short ones are multiplied out, and terms that cancel are gone: of a body that turns
    /// about a pivot, what centripetal accelerations along x and y do to its angle.
    Open,
}

impl Sums {
    /// A value that is used several times.
    pub(super) fn settle(self, arena: &mut Arena, value: Expr) -> Expr {
        match self {
            Self::Open if length(arena, value) <= LONGEST_OPEN => value,
            _ => arena.share(value),
        }
    }

    /// x·y
    pub(super) fn product(self, arena: &mut Arena, x: Expr, y: Expr) -> Expr {
        if self == Self::Closed || length(arena, x) * length(arena, y) > LONGEST_OPEN {
            return arena.mul(x, y);
        }
        let (xs, ys) = (terms(arena, x), terms(arena, y));
        let mut products = Vec::with_capacity(xs.len() * ys.len());
        for &(x, of_x) in &xs {
            for &(y, of_y) in &ys {
                products.push((arena.mul(x, y), of_x * of_y));
            }
        }
        arena.sum(&products)
    }
}

/// The number of terms of a sum, 1 of any other value.
pub(super) fn length(arena: &Arena, value: Expr) -> usize {
    match arena.node(value) {
        Node::Sum(constant, terms) => terms.len() + usize::from(!constant.is_zero()),
        _ => 1,
    }
}

fn terms(arena: &Arena, value: Expr) -> Vec<(Expr, Number)> {
    match arena.node(value) {
        Node::Sum(constant, terms) => {
            let constant = (!constant.is_zero()).then_some((arena.one(), *constant));
            terms.iter().copied().chain(constant).collect()
        }
        _ => vec![(value, Number::ONE)],
    }
}
