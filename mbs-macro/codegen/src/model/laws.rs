//! Laws of motion as formulas name them: what they are given is read and judged here.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Algebra, Expr, Number};
use proc_macro2::Ident;

use super::Requirement;
use super::known::Typed;
use super::names::{Place, Scope};
use crate::diagnostics::{Diagnostic, Diagnostics, described};
use crate::mechanics::laws::{Law, LawKind, clamped};
use crate::quantity::Comparison;
use crate::syntax::Formula;

impl Scope<'_> {
    pub(super) fn law(
        &mut self,
        law: &Law,
        name: &Ident,
        arguments: &[Formula],
        place: Place,
        errors: &mut Diagnostics,
    ) -> Option<Typed> {
        let expr = match (&law.kind, arguments) {
            (LawKind::Plain(value), [s]) => {
                let s = self.progress(name, s, place, errors)?;
                value(Algebra::new(&mut self.arena).scalar(s)).expr()
            }
            (LawKind::Trapezoidal(value), [s, share]) => {
                let s = self.progress(name, s, place, errors);
                let share = self.share(share, errors);
                let algebra = Algebra::new(&mut self.arena);
                value(algebra.scalar(s?), algebra.scalar(share?)).expr()
            }
            (kind, _) => {
                let (count, form) = match kind {
                    LawKind::Plain(_) => ("1 argument", format!("{name}(t/(2 [s]))")),
                    LawKind::Trapezoidal(_) => ("2 arguments", format!("{name}(t/(2 [s]), 0.25)")),
                };
                let message = format!("`{name}` takes {count}, not {}", arguments.len());
                errors.push(Diagnostic::new(name.span(), message).help(format!("write `{form}`")));
                return None;
            }
        };
        Some(Typed { expr, dimension: Some(Dimension::NONE) })
    }

    /// The progress, between 0 and 1.
    fn progress(
        &mut self,
        name: &Ident,
        formula: &Formula,
        place: Place,
        errors: &mut Diagnostics,
    ) -> Option<Expr> {
        let s = self.formula(formula, place, errors)?;
        if let Some(dimension) = s.dimension.filter(|dimension| *dimension != Dimension::NONE) {
            let message =
                format!("`{name}` takes a progress from 0 to 1, but this is {}", described(dimension));
            errors.push(
                Diagnostic::new(formula.span, message)
                    .help("divide it by what the whole motion takes, as in `t/(2 [s])`"),
            );
            return None;
        }
        Some(clamped(Algebra::new(&mut self.arena).scalar(s.expr)).expr())
    }

    /// The share of the time in which a trapezoid accelerates.
    fn share(&mut self, formula: &Formula, errors: &mut Diagnostics) -> Option<Expr> {
        let what = ("the share of the time that accelerates", Dimension::NONE);
        let share = self.formula_of(formula, Place::Property, what, errors)?;
        let value = self.arena.as_number(share).map(Number::to_f64);
        if value.is_some_and(|value| value <= 0.0 || value > 0.5) {
            let message = "a trapezoid cannot accelerate in this share of its time";
            errors.push(
                Diagnostic::new(formula.span, message)
                    .help("write a number above 0, at most 1/2: it decelerates in an equal share"),
            );
            return None;
        }
        if value.is_none() {
            let half = self.arena.number(Number::ratio(1, 2));
            let algebra = Algebra::new(&mut self.arena);
            let above_half = (algebra.scalar(share) - algebra.scalar(half)).expr();
            let ends = [(share, Comparison::Greater), (above_half, Comparison::LessOrEqual)];
            self.requirements.extend(ends.map(|(difference, comparison)| Requirement {
                name: "the share of a trapezoid".to_owned(),
                value: share,
                difference,
                comparison,
                text: "a trapezoid accelerates in a share of its time above 0, at most 1/2".to_owned(),
                span: formula.span,
            }));
        }
        Some(share)
    }
}
