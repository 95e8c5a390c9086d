//! Laws of motion: functions that rise from 0 to 1 as the progress s does, and
//! rest outside (Norton, Cam Design and Manufacturing Handbook).
//!
//! They are built from operators whose derivatives hold from the right: `max`
//! and `min` have the slope of their second argument where both are equal. So a
//! motion that starts at s = 0 has its acceleration there, and none at s = 1.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Arena, Expr, Function, Number};
use proc_macro2::Ident;

use super::names::{Place, Scope, Typed};
use crate::diagnostics::{Diagnostic, Diagnostics, described};
use crate::syntax::Formula;

/// A law as it is written.
pub struct Law {
    pub name: &'static str,
    kind: Kind,
}

enum Kind {
    Plain(fn(&mut Arena, Expr) -> Expr),
    /// Takes the share of the time in which it accelerates.
    Trapezoidal,
}

pub const LAWS: &[Law] = &[
    Law { name: "cycloidal", kind: Kind::Plain(cycloidal) },
    Law { name: "polynomial_345", kind: Kind::Plain(polynomial_345) },
    Law { name: "harmonic", kind: Kind::Plain(harmonic) },
    Law { name: "trapezoidal", kind: Kind::Trapezoidal },
];

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
            (Kind::Plain(value), [s]) => {
                let s = self.progress(name, s, place, errors)?;
                value(&mut self.arena, s)
            }
            (Kind::Trapezoidal, [s, share]) => {
                let s = self.progress(name, s, place, errors);
                let share = self.share(share, errors);
                trapezoidal(&mut self.arena, s?, share?)
            }
            (kind, _) => {
                let (count, form) = match kind {
                    Kind::Plain(_) => ("1 argument", format!("{name}(t/(2 [s]))")),
                    Kind::Trapezoidal => ("2 arguments", format!("{name}(t/(2 [s]), 0.25)")),
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
        Some(clamped(&mut self.arena, s.expr))
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
        Some(share)
    }
}

/// s between 0 and 1.
fn clamped(arena: &mut Arena, s: Expr) -> Expr {
    let (zero, one) = (arena.zero(), arena.one());
    let above = arena.call2(Function::Max, zero, s);
    arena.call2(Function::Min, above, one)
}

/// s − sin(2πs)/2π
fn cycloidal(arena: &mut Arena, s: Expr) -> Expr {
    let turn = arena.number(Number::from(std::f64::consts::TAU));
    let angle = arena.mul(turn, s);
    let sine = arena.call(Function::Sin, angle);
    let sine = arena.product(&[(sine, 1), (turn, -1)]);
    arena.sub(s, sine)
}

/// 10s³ − 15s⁴ + 6s⁵
fn polynomial_345(arena: &mut Arena, s: Expr) -> Expr {
    let terms = [(3, 10), (4, -15), (5, 6)];
    let terms = terms.map(|(exponent, factor)| (arena.powi(s, exponent), Number::integer(factor)));
    arena.sum(&terms)
}

/// (1 − cos πs)/2
fn harmonic(arena: &mut Arena, s: Expr) -> Expr {
    let half_turn = arena.number(Number::PI);
    let angle = arena.mul(half_turn, s);
    let cosine = arena.call(Function::Cos, angle);
    let half = Number::ratio(1, 2);
    let one = arena.one();
    arena.sum(&[(one, half), (cosine, -half)])
}

/// The velocity rises to 1/(1 − a) up to s = a and falls from s = 1 − a on; each
/// change of the acceleration adds a parabola from there.
fn trapezoidal(arena: &mut Arena, s: Expr, a: Expr) -> Expr {
    let (zero, one) = (arena.zero(), arena.one());
    let rest = arena.sub(one, a);
    let mut parabola = |from: Expr| {
        let since = arena.sub(s, from);
        let since = arena.call2(Function::Max, zero, since);
        arena.powi(since, 2)
    };
    let (steady, falling) = (parabola(a), parabola(rest));
    let rising = arena.powi(s, 2);
    let half = Number::ratio(1, 2);
    let sum = arena.sum(&[(rising, half), (steady, -half), (falling, -half)]);
    arena.product(&[(sum, 1), (a, -1), (rest, -1)])
}
