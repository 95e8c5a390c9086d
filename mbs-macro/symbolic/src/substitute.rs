//! Expressions in the place of symbols.

use rustc_hash::FxHashMap as HashMap;
use rustc_hash::FxHashMap;

use crate::arena::{Arena, Expr, Node, Symbol};
use crate::number::Number;

impl Arena {
    /// The expression with every symbol that `values` has replaced by its value
    /// there, all at once: what a value contains is not replaced again.
    ///
    /// The result is canonical; what holds no such symbol stays the same node.
    pub fn substitute(&mut self, expr: Expr, values: &HashMap<Symbol, Expr>) -> Expr {
        self.substituted(&[expr], values)[&expr]
    }

    /// The same of several expressions; what they have in common is looked at once.
    pub fn substitute_all(&mut self, exprs: &[Expr], values: &HashMap<Symbol, Expr>) -> Vec<Expr> {
        let known = self.substituted(exprs, values);
        exprs.iter().map(|expr| known[expr]).collect()
    }

    /// The expression with another one in the place of a part of it.
    pub fn replace(&mut self, expr: Expr, part: Expr, other: Expr) -> Expr {
        let mut known: FxHashMap<Expr, Expr> = FxHashMap::default();
        for operand in self.reachable(&[expr]) {
            let replaced = match operand == part {
                true => other,
                false => self.substitute_in_node(operand, &HashMap::default(), &known),
            };
            known.insert(operand, replaced);
        }
        known[&expr]
    }

    /// The substitute of every expression that these are made of.
    fn substituted(&mut self, exprs: &[Expr], values: &HashMap<Symbol, Expr>) -> FxHashMap<Expr, Expr> {
        let mut known: FxHashMap<Expr, Expr> = FxHashMap::default();
        for operand in self.reachable(exprs) {
            let substituted = self.substitute_in_node(operand, values, &known);
            known.insert(operand, substituted);
        }
        known
    }

    fn substitute_in_node(
        &mut self,
        expr: Expr,
        values: &HashMap<Symbol, Expr>,
        known: &FxHashMap<Expr, Expr>,
    ) -> Expr {
        if let Node::Symbol(symbol) = self.node(expr) {
            return values.get(symbol).copied().unwrap_or(expr);
        }
        if self.operands(expr).iter().all(|operand| known[operand] == *operand) {
            return expr;
        }
        match self.node(expr).clone() {
            Node::Number(_) | Node::Symbol(_) => expr,
            Node::Sum(constant, terms) => {
                let constant = self.number(constant);
                let mut terms: Vec<_> = terms.iter().map(|(term, c)| (known[term], *c)).collect();
                terms.push((constant, Number::ONE));
                self.sum(&terms)
            }
            Node::Product(factors) => {
                let factors: Vec<_> = factors.iter().map(|(factor, e)| (known[factor], *e)).collect();
                self.product(&factors)
            }
            Node::Call(function, both) => self.apply(function, both.map(|x| known[&x])),
            Node::Spline(spline, order, x) => self.spline_derivative(spline, order, known[&x]),
            Node::Shared(x) => self.share(known[&x]),
        }
    }
}
