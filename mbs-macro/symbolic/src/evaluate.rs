//! Values of expressions, straight from the nodes.

use crate::arena::{Arena, Expr, Node, Symbol};
use crate::arithmetic::Numeric;
use crate::moving::{Jet, Moving};
use crate::number::Number;

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
    pub fn evaluate<T: Numeric>(&self, arena: &Arena, symbol: &dyn Fn(Symbol) -> T) -> Vec<T> {
        self.run(arena, |node, values: &Values<T>| match node {
            Node::Number(number) => T::number(*number),
            Node::Symbol(s) => symbol(*s),
            Node::Sum(constant, terms) => terms
                .iter()
                .fold(T::number(*constant), |sum, (term, c)| sum + T::number(*c) * values.of(*term)),
            Node::Product(factors) => factors
                .iter()
                .fold(T::number(Number::ONE), |product, (factor, e)| product * values.of(*factor).powi(*e)),
            Node::Call(function, [x, y]) => values.of(*x).call(*function, values.of(*y)),
            Node::Spline(spline, order, x) => values.of(*x).spline(&arena.splines()[spline.index()], *order),
            Node::Shared(x) => values.of(*x),
        })
    }

    /// The roots with their derivatives where symbols move along a curve. The derivatives come from the chain
    /// rule on numbers, not from those of expressions.
    pub fn jets<T: Numeric>(&self, arena: &Arena, curve: &dyn Fn(Symbol) -> Jet<T>) -> Vec<Jet<T>> {
        let values: Vec<Moving<Moving<T>>> = self.evaluate(arena, &|symbol| curve(symbol).into());
        values.into_iter().map(Jet::from).collect()
    }
}

impl Arena {
    /// The values of `roots` where symbols have the values that `symbol` gives.
    pub fn evaluate(&self, roots: &[Expr], symbol: &dyn Fn(Symbol) -> f64) -> Vec<f64> {
        Tape::new(self, roots).evaluate(self, symbol)
    }
}
