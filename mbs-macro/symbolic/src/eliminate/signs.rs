//! Bounds and signs of values at any position.

use crate::arena::{Arena, Expr, Node, Stage};
use crate::number::Number;
use crate::operators::{Function, Range};

/// A bound above this says nothing of digits that cancel: that of a derivative through forty definitions that
/// build on each other, 1 + cos at each, is 2⁴⁰, while what it bounds may be 0.
const LOOSE: f64 = 1e6;

impl Arena {
    /// A bound of |e| that depends on parameters alone, with |sin| and |cos|
    /// at most 1; `None` where coordinates or velocities enter otherwise, and where it would be loose.
    pub(super) fn bound(&mut self, expr: Expr) -> Option<Expr> {
        if self.stage(expr) <= Stage::Parameter {
            return Some(self.call(Function::Abs, expr));
        }
        if let Some(known) = self.bounds.get(&expr) {
            return *known;
        }
        let bound = self.bound_of_node(expr);
        let bound = bound.filter(|bound| self.as_number(*bound).is_none_or(|bound| bound.to_f64() < LOOSE));
        self.bounds.insert(expr, bound);
        bound
    }

    fn bound_of_node(&mut self, expr: Expr) -> Option<Expr> {
        match self.node(expr).clone() {
            Node::Sum(constant, terms) => {
                let mut bounds = vec![(self.number(constant.abs()), Number::ONE)];
                for (term, coefficient) in terms {
                    bounds.push((self.bound(term)?, coefficient.abs()));
                }
                Some(self.sum(&bounds))
            }
            Node::Product(factors) => {
                let mut bounds = Vec::new();
                for (factor, exponent) in factors {
                    let is_safe = exponent > 0 || self.stage(factor) <= Stage::Parameter;
                    bounds.push((self.bound(factor).filter(|_| is_safe)?, exponent));
                }
                Some(self.product(&bounds))
            }
            Node::Call(function, _) if function.row().range == Range::Unit && function.row().arity == 1 => {
                Some(self.one())
            }
            Node::Shared(x) => self.bound(x),
            _ => None,
        }
    }

    /// True if the value is positive in every position, as a sum of squares
    /// with at least one term that depends on parameters alone.
    ///
    /// Parameters count as positive: they are masses and lengths. One that is
    /// not shows in the growth of the pivot.
    pub(super) fn is_positive(&mut self, expr: Expr) -> bool {
        match self.node(expr).clone() {
            Node::Number(value) => !value.is_zero() && !value.is_negative(),
            Node::Shared(x) => self.is_positive(x),
            Node::Sum(constant, terms) => {
                let is_not_negative = self.is_not_negative(expr);
                let anchored = |(term, _): &(Expr, Number)| self.stage(*term) <= Stage::Parameter;
                is_not_negative && (!constant.is_zero() || terms.iter().any(anchored))
            }
            _ => self.stage(expr) <= Stage::Parameter && self.is_not_negative(expr),
        }
    }

    /// The part of a positive value that depends on parameters alone: a lower
    /// bound of it.
    pub(super) fn anchor(&mut self, expr: Expr) -> Option<Expr> {
        if !self.is_positive(expr) {
            return None;
        }
        match self.node(expr).clone() {
            Node::Shared(x) => self.anchor(x),
            Node::Sum(constant, terms) => {
                let mut early = vec![(self.number(constant), Number::ONE)];
                early.extend(terms.into_iter().filter(|(term, _)| self.stage(*term) <= Stage::Parameter));
                Some(self.sum(&early))
            }
            _ => Some(expr),
        }
    }

    fn is_not_negative(&mut self, expr: Expr) -> bool {
        if let Some(&known) = self.never_negative.get(&expr) {
            return known;
        }
        let known = self.is_node_not_negative(expr);
        self.never_negative.insert(expr, known);
        known
    }

    fn is_node_not_negative(&mut self, expr: Expr) -> bool {
        match self.node(expr).clone() {
            Node::Number(value) => !value.is_negative(),
            Node::Symbol(_) => self.stage(expr) <= Stage::Parameter,
            Node::Sum(constant, terms) => {
                let mut fits = |(term, c): &(Expr, Number)| !c.is_negative() && self.is_not_negative(*term);
                !constant.is_negative() && terms.iter().all(&mut fits)
            }
            Node::Product(factors) => {
                factors.iter().all(|(factor, exponent)| exponent % 2 == 0 || self.is_not_negative(*factor))
            }
            Node::Call(function, _) => function.row().range == Range::NotNegative,
            Node::Spline(..) => false,
            Node::Shared(x) => self.is_not_negative(x),
        }
    }
}
