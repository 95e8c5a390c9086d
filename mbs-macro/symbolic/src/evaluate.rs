//! Values of expressions, straight from the nodes.

use crate::arena::{Arena, Expr, Node, Symbol};

/// The nodes that some expressions are made of, operands before users: to
/// evaluate the same expressions again and again, in any kind of number.
pub struct Tape {
    order: Vec<Expr>,
    roots: Vec<Expr>,
    length: usize,
}

/// The values of the nodes that a [`Tape`] has passed.
pub struct Values<V>(Vec<V>);

impl<V: Copy> Values<V> {
    /// The value of an operand of the node that is being evaluated.
    pub fn of(&self, operand: Expr) -> V {
        self.0[operand.index()]
    }
}

impl Tape {
    /// The tape that ends in `roots`.
    pub fn new(arena: &Arena, roots: &[Expr]) -> Self {
        let order = arena.reachable(roots);
        let length = order.iter().map(|e| e.index() + 1).max().unwrap_or(0);
        Self { order, roots: roots.to_vec(), length }
    }

    /// The values of the roots, where `node` gives that of a node from those of
    /// its operands.
    pub fn run<V: Copy + Default>(
        &self,
        arena: &Arena,
        mut node: impl FnMut(&Node, &Values<V>) -> V,
    ) -> Vec<V> {
        let mut values = Values(vec![V::default(); self.length]);
        for &expr in &self.order {
            let value = node(arena.node(expr), &values);
            values.0[expr.index()] = value;
        }
        self.roots.iter().map(|&root| values.of(root)).collect()
    }

    /// The values of the roots where symbols have the values that `symbol` gives.
    pub fn evaluate(&self, arena: &Arena, symbol: &dyn Fn(Symbol) -> f64) -> Vec<f64> {
        self.run(arena, |node, values: &Values<f64>| match node {
            Node::Number(number) => number.to_f64(),
            Node::Symbol(s) => symbol(*s),
            Node::Sum(constant, terms) => {
                terms.iter().fold(constant.to_f64(), |sum, (term, c)| sum + c.to_f64() * values.of(*term))
            }
            Node::Product(factors) => {
                factors.iter().fold(1.0, |product, (factor, e)| product * values.of(*factor).powi(*e))
            }
            Node::Call(function, x) => (function.row().value)(values.of(*x), 0.0),
            Node::Call2(function, x, y) => (function.row().value)(values.of(*x), values.of(*y)),
            Node::Spline(spline, order, x) => {
                arena.splines()[spline.index()].derivative(*order, values.of(*x))
            }
            Node::Shared(x) => values.of(*x),
        })
    }
}

impl Arena {
    /// The values of `roots` where symbols have the values that `symbol` gives.
    pub fn evaluate(&self, roots: &[Expr], symbol: &dyn Fn(Symbol) -> f64) -> Vec<f64> {
        Tape::new(self, roots).evaluate(self, symbol)
    }
}
