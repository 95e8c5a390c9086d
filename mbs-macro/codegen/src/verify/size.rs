//! Sizes of expressions: what the terms of a sum amount to before they cancel.

use mbs_symbolic::{Arena, Expr, Node, Symbol, Tape};

/// A value, and the sum of the magnitudes of the terms that it is made of.
#[derive(Clone, Copy, Default)]
struct Sized {
    value: f64,
    size: f64,
}

/// Of every root, Σ|terms|: what rounding is measured against, and how large the
/// quantities are that an equation compares.
pub fn sizes(arena: &Arena, roots: &[Expr], symbol: &dyn Fn(Symbol) -> f64) -> Vec<f64> {
    let of_value = |value: f64| Sized { value, size: value.abs() };
    let sized = Tape::new(arena, roots).run(arena, |node, values: &mbs_symbolic::Values<Sized>| match node {
        Node::Number(number) => of_value(number.to_f64()),
        Node::Symbol(s) => of_value(symbol(*s)),
        Node::Sum(constant, terms) => {
            terms.iter().fold(of_value(constant.to_f64()), |sum, (term, coefficient)| {
                let (term, coefficient) = (values.of(*term), coefficient.to_f64());
                Sized {
                    value: sum.value + coefficient * term.value,
                    size: sum.size + coefficient.abs() * term.size,
                }
            })
        }
        Node::Product(factors) => {
            factors.iter().fold(Sized { value: 1.0, size: 1.0 }, |product, (factor, exponent)| {
                let factor = values.of(*factor);
                let value = factor.value.powi(*exponent);
                // a divisor that cancels makes its quotient no larger than it is
                let size = if *exponent > 0 { factor.size.powi(*exponent) } else { value.abs() };
                Sized { value: product.value * value, size: product.size * size }
            })
        }
        Node::Call(function, x) => of_value((function.row().value)(values.of(*x).value, 0.0)),
        Node::Call2(function, x, y) => {
            of_value((function.row().value)(values.of(*x).value, values.of(*y).value))
        }
        Node::Spline(spline, order, x) => {
            of_value(arena.splines()[spline.index()].derivative(*order, values.of(*x).value))
        }
        Node::Shared(x) => values.of(*x),
    });
    sized.into_iter().map(|sized| sized.size).collect()
}
