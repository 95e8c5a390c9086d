//! Expressions at a random point of the field.

use super::residue::Residue;
use crate::arena::{Arena, Expr, Node};
use crate::number::Number;

/// Angles are divided into this many parts, so that fractions of them are known too.
const PARTS: i64 = 5040;

const REASON_SYMBOL: u64 = 11;
const REASON_NODE: u64 = 12;
const REASON_TURN: u64 = 13;

/// An exact value.
#[derive(Clone, Copy, Debug)]
pub struct Exact {
    /// The value; `None` where a denominator is 0.
    pub residue: Option<Residue>,
    /// `true` if every relation of its parts to other values is known; `false` where a function or a number without an
    /// exact rule may stand for itself.
    pub is_whole: bool,
}

/// A random point: every symbol has a value that is related to no other.
///
/// sin² + cos² = 1 holds, and so do sums and fractions of angles. A function without an exact
/// rule, as a root or exp is, stands for itself: relations to others may be missed there, and
/// none is made up.
#[derive(Default)]
pub struct Point {
    /// Of the nodes that were asked for and all before them.
    values: Vec<Exact>,
}

impl Point {
    /// The value of an expression.
    pub fn value(&mut self, arena: &Arena, expr: Expr) -> Exact {
        for at in self.values.len()..=expr.index() {
            let value = self.node(arena, Expr(at as u32));
            self.values.push(value);
        }
        self.values[expr.index()]
    }

    /// Reports whether an expression is 0 wherever it has a value, which its residue at this point decides.
    pub fn is_zero(&mut self, arena: &Arena, expr: Expr) -> bool {
        self.value(arena, expr).residue == Some(Residue::ZERO)
    }

    /// The value of a node whose operands have theirs.
    fn node(&self, arena: &Arena, expr: Expr) -> Exact {
        match arena.node(expr) {
            Node::Number(number) => constant(*number),
            Node::Symbol(symbol) => Exact {
                residue: Some(Residue::stand_in_integer(REASON_SYMBOL, symbol.index() as u64)),
                is_whole: true,
            },
            Node::Sum(first, terms) => {
                let terms = terms.iter().map(|&(term, coefficient)| {
                    combined(constant(coefficient), self.values[term.index()], |a, b| Some(a * b))
                });
                terms.fold(constant(*first), |sum, term| combined(sum, term, |a, b| Some(a + b)))
            }
            Node::Product(factors) => {
                let one = Exact { residue: Some(Residue::ONE), is_whole: true };
                factors.iter().fold(one, |product, &(factor, exponent)| {
                    combined(product, self.values[factor.index()], |a, b| Some(a * b.power(exponent.into())?))
                })
            }
            Node::Call(function, [angle, _]) => match function.row().of_turn {
                Some(of_turn) => {
                    let turn = turn(arena, *angle);
                    Exact { residue: turn.residue.and_then(of_turn), is_whole: turn.is_whole }
                }
                None => itself(expr),
            },
            Node::Spline(..) => itself(expr),
            Node::Shared(inner) => self.values[inner.index()],
        }
    }
}

/// A value without an exact rule.
fn itself(expr: Expr) -> Exact {
    let residue = Residue::stand_in_integer(REASON_NODE, expr.index() as u64);
    Exact { residue: Some(residue), is_whole: false }
}

/// The turn exp(i x) by an angle: the product of those by its terms.
fn turn(arena: &Arena, angle: Expr) -> Exact {
    let one = [(angle, Number::ONE)];
    let (first, terms) = match arena.node(angle) {
        Node::Shared(inner) => return turn(arena, *inner),
        Node::Sum(first, terms) => (*first, &terms[..]),
        Node::Number(value) => (*value, &[][..]),
        _ => (Number::ZERO, &one[..]),
    };
    let first = match first.real().turn() {
        Some(turn) => Exact { residue: Some(turn), is_whole: true },
        None if first.is_zero() => Exact { residue: Some(Residue::ONE), is_whole: true },
        None => Exact {
            residue: Some(Residue::stand_in(REASON_TURN, &[first.real().residue()])),
            is_whole: false,
        },
    };
    terms.iter().fold(first, |turn, &(term, coefficient)| {
        combined(turn, multiple(arena, term, coefficient), |a, b| Some(a * b))
    })
}

/// The turn by a multiple of a term.
fn multiple(arena: &Arena, term: Expr, coefficient: Number) -> Exact {
    let of = [Residue::integer(term.index() as i64)];
    let part = Residue::stand_in(REASON_TURN, &of);
    let count = match coefficient {
        Number::Rational(n, d) if PARTS % d == 0 => n.checked_mul(PARTS / d),
        _ => None,
    };
    let Some(count) = count else {
        let of = [of[0], coefficient.real().residue()];
        return Exact { residue: Some(Residue::stand_in(REASON_TURN, &of)), is_whole: false };
    };
    // only products of symbols are certain to be unrelated
    let is_symbol = |expr: &Expr| matches!(arena.node(*expr), Node::Symbol(_));
    let is_whole = match arena.node(term) {
        Node::Product(factors) => factors.iter().all(|(factor, _)| is_symbol(factor)),
        _ => is_symbol(&term),
    };
    Exact { residue: part.power(count), is_whole }
}

fn constant(number: Number) -> Exact {
    let is_whole = matches!(number, Number::Rational(..));
    Exact { residue: Some(number.real().residue()), is_whole }
}

fn combined(a: Exact, b: Exact, operation: impl Fn(Residue, Residue) -> Option<Residue>) -> Exact {
    let residue = a.residue.zip(b.residue).and_then(|(a, b)| operation(a, b));
    Exact { residue, is_whole: a.is_whole && b.is_whole }
}
