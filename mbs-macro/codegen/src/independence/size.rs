//! Sizes of equations: what their terms amount to before they cancel.

use mbs_symbolic::{Arena, Expr, Node, Symbol, Tape, Values};

#[derive(Clone, Copy, Default)]
struct Sized {
    value: f64,
    /// Of a sum, the sum of the magnitudes of its terms.
    terms: f64,
    /// The same, where a power of a sum counts by that of the sum's terms.
    size: f64,
}

impl Sized {
    fn of(value: f64) -> Self {
        Self { value, terms: value.abs(), size: value.abs() }
    }
}

/// Of every root, Σ|terms|: what rounding is measured against, and how large the
/// quantities are that an equation compares. Of (x − y)² that is (|x| + |y|)². It looks
/// no deeper than that: in nested definitions the magnitudes of all terms would grow
/// beyond anything that is compared.
pub fn sizes(arena: &Arena, roots: &[Expr], symbol: &dyn Fn(Symbol) -> f64) -> Vec<f64> {
    let sized = Tape::new(arena, roots).run(arena, |node, values: &Values<Sized>| match node {
        Node::Number(number) => Sized::of(number.to_f64()),
        Node::Symbol(s) => Sized::of(symbol(*s)),
        Node::Sum(constant, terms) => {
            terms.iter().fold(Sized::of(constant.to_f64()), |sum, (term, coefficient)| {
                let (term, coefficient) = (values.of(*term), coefficient.to_f64());
                Sized {
                    value: sum.value + coefficient * term.value,
                    terms: sum.terms + (coefficient * term.value).abs(),
                    size: sum.size + coefficient.abs() * term.size,
                }
            })
        }
        Node::Product(factors) => {
            let one = Sized::of(1.0);
            factors.iter().fold(one, |product, (factor, exponent)| {
                let factor = values.of(*factor);
                let value = factor.value.powi(*exponent);
                let size = if *exponent > 1 { factor.terms.powi(*exponent) } else { value.abs() };
                let value = product.value * value;
                Sized { value, terms: value.abs(), size: product.size * size }
            })
        }
        Node::Call(function, [x, y]) => {
            Sized::of((function.row().value)(values.of(*x).value, values.of(*y).value))
        }
        Node::Spline(spline, order, x) => {
            Sized::of(arena.splines()[spline.index()].derivative(*order, values.of(*x).value))
        }
        Node::Shared(x) => values.of(*x),
    });
    sized.into_iter().map(|sized| sized.size).collect()
}
