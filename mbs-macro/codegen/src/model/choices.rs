//! Values of pieces: `if a < b { p } else { q }`, `clamp`, `step` and `ramp`.
//!
//! A condition is a number, 1 where it holds and 0 where it does not. It opens the gate of one value and shuts that
//! of the other, so that a choice is the sum of both and has the derivatives of the piece that holds. What a
//! gate shuts out may be no number.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Algebra, Expr};
use proc_macro2::{Ident, Span};

use super::known::Typed;
use super::names::{Place, Scope};
use crate::diagnostics::{Diagnostic, Diagnostics, described};
use crate::quantity::Comparison;
use crate::syntax::{Choice, Formula, Test};

/// Functions that are made of pieces.
pub const PIECES: &[&str] = &["clamp", "step", "ramp"];

impl Scope<'_> {
    pub(super) fn choice(
        &mut self,
        Choice { test, value, otherwise }: &Choice,
        place: Place,
        errors: &mut Diagnostics,
    ) -> Option<Typed> {
        let holds = self.test(test, place, errors);
        let found = [value, otherwise].map(|branch| self.formula(branch, place, errors));
        let (holds, [Some(x), Some(y)]) = (holds?, found) else { return None };
        let dimension = errors.take(common(otherwise.span, [x, y], |x, y| {
            format!("this is {x} where the condition of its `if` holds, and {y} where it does not")
        }))?;
        let algebra = Algebra::new(&mut self.arena);
        let [holds, x, y] = [holds, x.expr, y.expr].map(|expr| algebra.scalar(expr));
        let expr = (holds.gate(x) + (1 - holds).gate(y)).expr();
        Some(Typed { expr, dimension })
    }

    /// A condition as 1 or 0.
    fn test(&mut self, test: &Test, place: Place, errors: &mut Diagnostics) -> Option<Expr> {
        match test {
            Test::Compared { sides, comparison, span } => {
                let found = sides.each_ref().map(|side| self.formula(side, place, errors));
                let [Some(x), Some(y)] = found else { return None };
                errors.take(common(*span, [x, y], |x, y| format!("this compares {x} with {y}")))?;
                let algebra = Algebra::new(&mut self.arena);
                let [x, y] = [x, y].map(|side| algebra.scalar(side.expr));
                let holds = match comparison {
                    Comparison::Greater => x.greater(y),
                    Comparison::Less => y.greater(x),
                    Comparison::GreaterOrEqual => 1 - y.greater(x),
                    Comparison::LessOrEqual => 1 - x.greater(y),
                };
                Some(holds.expr())
            }
            Test::Both(both) => {
                let [x, y] = self.tests(both, place, errors)?;
                Some(self.arena.mul(x, y))
            }
            Test::Either(both) => {
                let [x, y] = self.tests(both, place, errors)?;
                let algebra = Algebra::new(&mut self.arena);
                Some(algebra.scalar(x).max(algebra.scalar(y)).expr())
            }
            Test::Not(inner) => {
                let holds = self.test(inner, place, errors)?;
                let algebra = Algebra::new(&mut self.arena);
                Some((1 - algebra.scalar(holds)).expr())
            }
        }
    }

    fn tests(&mut self, both: &[Test; 2], place: Place, errors: &mut Diagnostics) -> Option<[Expr; 2]> {
        let [x, y] = both.each_ref().map(|test| self.test(test, place, errors));
        Some([x?, y?])
    }

    /// `clamp(x, low, high)`, `step(x)` or `ramp(x)`.
    pub(super) fn pieces(
        &mut self,
        name: &Ident,
        arguments: &[Formula],
        place: Place,
        errors: &mut Diagnostics,
    ) -> Option<Typed> {
        let form = if name == "clamp" { "clamp(x, low, high)".to_owned() } else { format!("{name}(x)") };
        let count = form.split(',').count();
        if arguments.len() != count {
            let s = if count == 1 { "" } else { "s" };
            let message = format!("`{name}` takes {count} argument{s}, not {}", arguments.len());
            errors.push(Diagnostic::new(name.span(), message).help(format!("write `{form}`")));
            return None;
        }
        let found: Vec<_> = arguments.iter().map(|argument| self.formula(argument, place, errors)).collect();
        let found: Vec<Typed> = found.into_iter().collect::<Option<_>>()?;
        let mut dimension = found.first()?.dimension;
        for (argument, bound) in arguments.iter().zip(&found).skip(1) {
            let first = Typed { dimension, ..*bound };
            dimension = errors.take(common(argument.span, [first, *bound], |x, y| {
                format!("`{name}` compares {x} with {y}")
            }))?;
        }
        let algebra = Algebra::new(&mut self.arena);
        let scalars: Vec<_> = found.iter().map(|typed| algebra.scalar(typed.expr)).collect();
        let zero = algebra.number(0);
        let (expr, dimension) = match scalars[..] {
            [x, low, high] => (x.min(high).max(low), dimension),
            [x] if name == "step" => (1 - zero.greater(x), Some(Dimension::NONE)),
            [x] => (zero.max(x), dimension),
            _ => return None,
        };
        let typed = Typed { expr: expr.expr(), dimension };
        let operands: Vec<_> = found.iter().map(|typed| typed.expr).collect();
        self.finite(typed, &operands, name.span(), errors)
    }
}

/// The dimension of two values that have the same.
fn common(
    span: Span,
    [x, y]: [Typed; 2],
    message: impl Fn(String, String) -> String,
) -> Result<Option<Dimension>, Diagnostic> {
    match (x.dimension, y.dimension) {
        (Some(a), Some(b)) if a != b => {
            let message = message(described(a).to_string(), described(b).to_string());
            Err(Diagnostic::new(span, message)
                .help("both need the same dimension; check the units and factors"))
        }
        (a, b) => Ok(a.or(b)),
    }
}
