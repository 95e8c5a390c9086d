//! Values of expressions, straight from the nodes.

use crate::arena::{Arena, Expr, Node, Symbol};

impl Arena {
    /// The values of `roots` where symbols have the values that `symbol` gives.
    pub fn evaluate(&self, roots: &[Expr], symbol: &dyn Fn(Symbol) -> f64) -> Vec<f64> {
        let order = self.reachable(roots);
        let largest = order.iter().map(|e| e.0 as usize + 1).max().unwrap_or(0);
        let mut values = vec![f64::NAN; largest];
        for &expr in &order {
            let value = |e: &Expr| values[e.0 as usize];
            values[expr.0 as usize] = match self.node(expr) {
                Node::Number(number) => number.to_f64(),
                Node::Symbol(s) => symbol(*s),
                Node::Sum(constant, terms) => {
                    terms.iter().fold(constant.to_f64(), |sum, (term, c)| sum + c.to_f64() * value(term))
                }
                Node::Product(factors) => {
                    factors.iter().fold(1.0, |product, (factor, e)| product * value(factor).powi(*e))
                }
                Node::Call(function, x) => (function.row().value)(value(x), 0.0),
                Node::Call2(function, x, y) => (function.row().value)(value(x), value(y)),
                Node::Spline(spline, order, x) => self.splines()[spline.index()].derivative(*order, value(x)),
                Node::Shared(x) => value(x),
            };
        }
        roots.iter().map(|root| values[root.0 as usize]).collect()
    }
}
