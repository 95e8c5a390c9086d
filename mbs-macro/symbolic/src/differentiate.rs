//! Derivatives along a direction.
//!
//! A direction gives each symbol its rate. The Jacobian Φ_q uses unit directions. Φ̇ uses q → v and t → 1. γ
//! is minus the same derivative of Φ̇.

use rustc_hash::FxHashMap as HashMap;
use rustc_hash::FxHashMap;

use crate::algebra::{Algebra, Scalar};
use crate::arena::{Arena, Expr, Node, Symbol};
use crate::number::Number;
use crate::operators::Function;

/// The derivative of a product of n factors has n terms of n factors, and the next one n
/// times as many. Longer products are halved first, the halves computed once, so that
/// derivatives are as long as the product.
const LONGEST_OPEN_PRODUCT: usize = 8;

impl Arena {
    /// Σ ∂e/∂s · direction(s) over all symbols s: a partial derivative with the
    /// direction 1 for one symbol, a total time derivative with q → q̇, t → 1.
    ///
    /// Symbols without a direction are held constant.
    pub fn derivative(&mut self, expr: Expr, direction: &HashMap<Symbol, Expr>) -> Expr {
        let mut known: FxHashMap<Expr, Expr> = FxHashMap::default();
        for operand in self.reachable(&[expr]) {
            let derivative = self.derivative_of_node(operand, direction, &known);
            known.insert(operand, derivative);
        }
        known[&expr]
    }

    /// ∂e/∂s
    pub fn partial(&mut self, expr: Expr, symbol: Symbol) -> Expr {
        let direction = HashMap::from_iter([(symbol, self.one())]);
        self.derivative(expr, &direction)
    }

    fn derivative_of_node(
        &mut self,
        expr: Expr,
        direction: &HashMap<Symbol, Expr>,
        known: &FxHashMap<Expr, Expr>,
    ) -> Expr {
        match self.node(expr).clone() {
            Node::Number(_) => self.zero(),
            Node::Symbol(symbol) => direction.get(&symbol).copied().unwrap_or(self.zero()),
            Node::Sum(_, terms) => {
                let terms: Vec<_> = terms.iter().map(|(term, c)| (known[term], *c)).collect();
                self.sum(&terms)
            }
            Node::Product(factors) => self.product_rule(&factors, known),
            // what a gate shuts out need not have a derivative
            Node::Call(Function::Gate, [gate, x]) => self.call2(Function::Gate, gate, known[&x]),
            Node::Call(function, [x, y]) => {
                if self.is_zero(known[&x]) && self.is_zero(known[&y]) {
                    return self.zero();
                }
                let [dx, dy] = self.slopes(function, x, y, expr);
                let along_x = self.mul(dx, known[&x]);
                if function.row().arity == 1 {
                    return along_x;
                }
                let along_y = self.mul(dy, known[&y]);
                self.add(along_x, along_y)
            }
            Node::Spline(spline, order, x) => {
                if self.is_zero(known[&x]) {
                    return self.zero();
                }
                let slope = self.spline_derivative(spline, order + 1, x);
                self.mul(slope, known[&x])
            }
            // computed once as the value is, or sums of a long one would open again
            Node::Shared(x) => self.share(known[&x]),
        }
    }

    /// ∂f/∂x and ∂f/∂y where f(x, y) is this value.
    fn slopes(&mut self, function: Function, x: Expr, y: Expr, value: Expr) -> [Expr; 2] {
        let algebra = Algebra::new(self);
        let [x, y, value] = [x, y, value].map(|expr| algebra.scalar(expr));
        function.slopes(x, y, value).map(Scalar::expr)
    }

    /// (Π fᵢ^eᵢ)′ from the derivatives of the factors.
    fn product_rule(&mut self, factors: &[(Expr, i32)], known: &FxHashMap<Expr, Expr>) -> Expr {
        if factors.len() > LONGEST_OPEN_PRODUCT {
            // (ab)′ = a′b + ab′
            let (a, b) = factors.split_at(factors.len() / 2);
            let slopes = [a, b].map(|half| self.product_rule(half, known));
            let halves = [a, b].map(|half| {
                let product = self.product(half);
                self.share(product)
            });
            let (first, second) = (self.mul(slopes[0], halves[1]), self.mul(halves[0], slopes[1]));
            return self.add(first, second);
        }
        // Π fᵢ^eᵢ · Σ eᵢ fᵢ′/fᵢ, each term written without the division
        let mut terms = Vec::new();
        for (at, &(factor, exponent)) in factors.iter().enumerate() {
            let slope = known[&factor];
            if self.is_zero(slope) {
                continue;
            }
            let mut rest = factors.to_vec();
            rest[at].1 -= 1;
            rest.push((slope, 1));
            terms.push((self.product(&rest), Number::integer(exponent.into())));
        }
        self.sum(&terms)
    }
}
