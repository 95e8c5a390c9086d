//! Whether the sums of a right-hand side are computed once or multiplied out.

use crate::arena::{Arena, Expr, Node, Stage};
use crate::number::Number;

/// Sums with more terms than this are computed once instead of being opened where they
/// are used.
pub(super) const LONGEST_OPEN: usize = 12;

/// The form of the sums that a right-hand side goes through in the steps of an elimination.
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

    /// A value that is computed once. An open sum gets its common factors back, the most frequent
    /// first: x p + x q + r = x (p + q) + r.
    pub(super) fn close(self, arena: &mut Arena, value: Expr) -> Expr {
        let mut left = terms(arena, value);
        let mut grouped = Vec::new();
        while self == Self::Open
            && let Some(factor) = most_frequent(arena, &left)
        {
            // each round takes two terms at least
            let (with, without): (Vec<_>, _) =
                left.into_iter().partition(|&(term, _)| factors(arena, term).contains(&factor));
            let (base, exponent) = factor;
            let cofactors =
                with.iter().map(|&(term, of_term)| (arena.product(&[(term, 1), (base, -exponent)]), of_term));
            let cofactors: Vec<_> = cofactors.collect();
            let cofactor = arena.sum(&cofactors);
            let cofactor = arena.share(cofactor);
            grouped.push((arena.product(&[(base, exponent), (cofactor, 1)]), Number::ONE));
            left = without;
        }
        grouped.extend(left);
        let value = arena.sum(&grouped);
        arena.share(value)
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

/// The factors of a term that do not depend on parameters alone.
fn factors(arena: &Arena, term: Expr) -> Vec<(Expr, i32)> {
    let factors = match arena.node(term) {
        Node::Product(factors) => factors.clone(),
        _ => vec![(term, 1)],
    };
    factors.into_iter().filter(|&(factor, _)| arena.stage(factor) > Stage::Parameter).collect()
}

/// The factor that most terms have, two at least; of several the first.
fn most_frequent(arena: &Arena, terms: &[(Expr, Number)]) -> Option<(Expr, i32)> {
    let mut counts: Vec<((Expr, i32), usize)> = Vec::new();
    for factor in terms.iter().flat_map(|&(term, _)| factors(arena, term)) {
        match counts.iter_mut().find(|(known, _)| *known == factor) {
            Some((_, count)) => *count += 1,
            None => counts.push((factor, 1)),
        }
    }
    let most = counts.iter().map(|(_, count)| *count).max().filter(|&most| most > 1)?;
    counts.into_iter().find(|&(_, count)| count == most).map(|(factor, _)| factor)
}
