//! Expressions with the signs of mathematics, for formulas that are read by people.
//!
//! An [`Algebra`] borrows an arena, and hands out [`Scalar`]s and [`Vector`]s. They are
//! handles and copied freely. Each sign makes the nodes that the constructors of the arena
//! make, operands first and from left to right. The order of terms in generated code follows from it.
//!
//! ```
//! use mbs_symbolic::{Algebra, Arena, Stage};
//!
//! let mut arena = Arena::new();
//! let symbols = ["m", "phi"].map(|name| arena.symbol(name, Stage::Variable));
//! let algebra = Algebra::new(&mut arena);
//! let [m, phi] = symbols.map(|symbol| algebra.variable(symbol));
//! let along = algebra.vector([algebra.number(1), algebra.number(0)]).rotated(phi);
//! let energy = m * along.dot(along) / 2;
//! assert!((2 * energy - m).is_zero());
//! ```

mod operators;
mod vector;

use rustc_hash::FxHashMap as HashMap;
use std::cell::RefCell;

use crate::arena::{Arena, Expr, Node, Stage, Symbol};
use crate::arithmetic::Arithmetic;
use crate::number::Number;
use crate::operators::Function;

pub use vector::Vector;

/// An arena whose expressions have the signs of mathematics.
pub struct Algebra<'a> {
    arena: RefCell<&'a mut Arena>,
}

/// An expression of an [`Algebra`].
#[derive(Clone, Copy)]
pub struct Scalar<'a> {
    algebra: &'a Algebra<'a>,
    expr: Expr,
}

impl<'a> Algebra<'a> {
    /// The algebra of the expressions of this arena.
    pub fn new(arena: &'a mut Arena) -> Self {
        Self { arena: RefCell::new(arena) }
    }

    /// An expression of the arena.
    pub fn scalar(&'a self, expr: Expr) -> Scalar<'a> {
        Scalar { algebra: self, expr }
    }

    /// The vector with these components.
    pub fn vector<T: Into<Expr>>(&'a self, [x, y]: [T; 2]) -> Vector<Scalar<'a>> {
        Vector { x: self.scalar(x.into()), y: self.scalar(y.into()) }
    }

    /// The expression that is just this symbol.
    pub fn variable(&'a self, symbol: Symbol) -> Scalar<'a> {
        self.make(symbol, Arena::variable)
    }

    /// A constant.
    pub fn number(&'a self, value: impl Into<Number>) -> Scalar<'a> {
        self.make(value.into(), Arena::number)
    }

    /// The sum, which is 0 of no terms: made at once, without the sums of the first few.
    pub fn sum(&'a self, terms: impl IntoIterator<Item = Scalar<'a>>) -> Scalar<'a> {
        let terms: Vec<_> = terms.into_iter().map(|term| (term.expr, Number::ONE)).collect();
        self.make(terms, |arena, terms| arena.sum(&terms))
    }

    /// The one place where the arena is changed. The given function captures nothing, so it
    /// cannot come back here.
    fn make<T>(&'a self, operands: T, make: fn(&mut Arena, T) -> Expr) -> Scalar<'a> {
        let expr = make(&mut self.arena.borrow_mut(), operands);
        self.scalar(expr)
    }

    /// The one place where the arena is read; as [`Algebra::make`].
    fn read<T>(&self, expr: Expr, read: fn(&Arena, Expr) -> T) -> T {
        read(&self.arena.borrow(), expr)
    }
}

impl<'a> Scalar<'a> {
    /// The expression in the arena.
    pub fn expr(self) -> Expr {
        self.expr
    }

    /// The algebra that it belongs to.
    pub fn algebra(self) -> &'a Algebra<'a> {
        self.algebra
    }

    /// Its value if it is a constant.
    pub fn number(self) -> Option<Number> {
        self.algebra.read(self.expr, Arena::as_number)
    }

    /// True if it is the constant 0.
    pub fn is_zero(self) -> bool {
        self.algebra.read(self.expr, Arena::is_zero)
    }

    /// The function of one argument whose value it is, if it is one.
    pub fn function(self) -> Option<Function> {
        self.algebra.read(self.expr, |arena, expr| match arena.node(expr) {
            Node::Call(function, _) if function.row().arity == 1 => Some(*function),
            _ => None,
        })
    }

    /// When it is known.
    pub fn stage(self) -> Stage {
        self.algebra.read(self.expr, Arena::stage)
    }

    /// The symbols that it depends on, in order.
    pub fn symbols(self) -> Vec<Symbol> {
        self.algebra.read(self.expr, Arena::symbols_in)
    }

    /// Itself, marked as one value to be computed once.
    pub fn shared(self) -> Self {
        self.algebra.make(self.expr, Arena::share)
    }

    /// The same with terms of equal powers collected; see [`Arena::collected`].
    pub fn collected(self) -> Self {
        self.algebra.make(self.expr, Arena::collected)
    }

    /// x to an integer power.
    pub fn powi(self, exponent: i32) -> Self {
        self.algebra.make((self.expr, exponent), |arena, (x, exponent)| arena.powi(x, exponent))
    }

    /// xʸ
    pub fn pow(self, y: Self) -> Self {
        self.algebra.make((self.expr, y.expr), |arena, (x, y)| arena.pow(x, y))
    }

    /// x²
    pub fn squared(self) -> Self {
        self.powi(2)
    }

    /// √x
    pub fn sqrt(self) -> Self {
        self.of(Function::Sqrt)
    }

    /// sin x
    pub fn sin(self) -> Self {
        self.of(Function::Sin)
    }

    /// cos x
    pub fn cos(self) -> Self {
        self.of(Function::Cos)
    }

    /// tanh x
    pub fn tanh(self) -> Self {
        self.of(Function::Tanh)
    }

    /// eˣ
    pub fn exp(self) -> Self {
        self.of(Function::Exp)
    }

    /// ln x
    pub fn ln(self) -> Self {
        self.of(Function::Ln)
    }

    /// −1, 0 or 1
    pub fn sign(self) -> Self {
        self.of(Function::Sign)
    }

    /// |x|
    pub fn abs(self) -> Self {
        self.of(Function::Abs)
    }

    /// The angle of the vector (x, y), of y.
    pub fn atan2(self, x: Self) -> Self {
        self.call(Function::Atan2, x)
    }

    /// The smaller one; at equal values, with the slope of the second.
    pub fn min(self, other: Self) -> Self {
        self.call(Function::Min, other)
    }

    /// The larger one; at equal values, with the slope of the second.
    pub fn max(self, other: Self) -> Self {
        self.call(Function::Max, other)
    }

    /// 1 if it is larger than the other one, else 0.
    pub fn greater(self, other: Self) -> Self {
        self.call(Function::Greater, other)
    }

    /// The same, for a choice between values that are equal where both are.
    pub fn chooses(self, other: Self) -> Self {
        self.call(Function::Choice, other)
    }

    /// The other one where this, which is 0 or 1, is 1; else 0.
    pub fn gate(self, other: Self) -> Self {
        self.call(Function::Gate, other)
    }

    /// ∂x/∂symbol
    pub fn partial(self, symbol: Symbol) -> Self {
        self.algebra.make((self.expr, symbol), |arena, (x, symbol)| arena.partial(x, symbol))
    }

    /// Σ ∂x/∂s · direction(s); see [`Arena::derivative`].
    pub fn derivative(self, direction: &HashMap<Symbol, Expr>) -> Self {
        self.algebra.make((self.expr, direction), |arena, (x, direction)| arena.derivative(x, direction))
    }

    /// The same with values in the place of symbols.
    pub fn substitute(self, values: &HashMap<Symbol, Expr>) -> Self {
        self.algebra.make((self.expr, values), |arena, (x, values)| arena.substitute(x, values))
    }
}

impl Arithmetic for Scalar<'_> {
    fn constant(self, value: i64) -> Self {
        self.algebra.number(value)
    }

    fn half(self) -> Self {
        self / 2
    }

    fn call(self, function: Function, y: Self) -> Self {
        self.algebra
            .make((function, [self.expr, y.expr]), |arena, (function, both)| arena.apply(function, both))
    }

    fn is_number(self) -> bool {
        self.number().is_some()
    }
}

impl From<Scalar<'_>> for Expr {
    fn from(scalar: Scalar<'_>) -> Self {
        scalar.expr
    }
}
