//! Properties of stops: what they may be, and the conditions on them.

use std::collections::BTreeMap;

use mbs_symbolic::Expr;
use mbs_symbolic::units::Dimension;
use proc_macro2::{Ident, Span};

use super::Requirement;
use super::names::Place;
use super::resolver::Resolver;
use crate::diagnostics::{Diagnostic, listing, nearest};
use crate::quantity::Comparison;
use crate::syntax::Property;

pub(super) const RESTITUTION: &str = "restitution";
pub(super) const FRICTION: &str = "friction";
pub(super) const ALONG: &str = "along";

/// A property of a stop.
pub(super) type Row = (&'static str, Takes);

/// Values of a property; some have a dimension that follows from that of the gap.
#[derive(Clone, Copy)]
pub(super) enum Takes {
    /// From 0 to 1.
    Share,
    NotNegative(fn(Dimension) -> Dimension),
    Positive(fn(Dimension) -> Dimension),
    /// The way that slides.
    Way,
}

impl Resolver<'_> {
    /// The values of the properties of a stop with a gap of a dimension, of those that it may have.
    pub(super) fn read_properties(
        &mut self,
        name: &Ident,
        gap: Dimension,
        (known, properties): (&[Row], &[Property]),
    ) -> Option<BTreeMap<String, Expr>> {
        let mut found: BTreeMap<String, Expr> = BTreeMap::new();
        for Property { name: property, value } in properties {
            let text = property.to_string();
            let Some((_, takes)) = known.iter().find(|(name, _)| *name == text) else {
                self.errors.push(unknown_property(property, known));
                return None;
            };
            let what = format!("the {text} of `{name}`");
            let (place, dimension) = match takes {
                Takes::Way => (Place::Constraint, gap),
                Takes::Share => (Place::Property, Dimension::NONE),
                Takes::NotNegative(dimension) | Takes::Positive(dimension) => {
                    (Place::Property, dimension(gap))
                }
            };
            let expr = self.scope.formula_of(value, place, (&*what, dimension), &mut self.errors)?;
            let told = format!("the {text} of {name}");
            match takes {
                Takes::Way => self.slides(name, expr, value.span)?,
                Takes::Share => self.within_one(&told, expr, value.span),
                Takes::NotNegative(_) => self.not_negative(&told, expr, value.span),
                Takes::Positive(_) => self.positive(&told, expr, value.span),
            }
            if found.insert(text, expr).is_some() {
                let help = "keep one of them";
                let message = format!("{what} is given twice");
                self.errors.push(Diagnostic::new(property.span(), message).help(help));
            }
        }
        Some(found)
    }

    /// The coefficient of friction and along what it rubs: both, or none.
    pub(super) fn friction_at(
        &mut self,
        name: &Ident,
        given: [Option<Expr>; 2],
    ) -> Option<Option<(Expr, Expr)>> {
        let (message, help) = match given {
            [Some(size), Some(along)] => return Some(Some((size, along))),
            [None, None] => return Some(None),
            [Some(_), None] => (
                format!("`{name}` does not say along what it rubs"),
                "give the way that what touches it slides, as in `along = foot.tip.x;`",
            ),
            [None, Some(_)] => (
                format!("`{name}` does not say how much it rubs"),
                "give a coefficient of friction, as in `friction = 0.3;`, or leave `along` out",
            ),
        };
        self.errors.push(Diagnostic::new(name.span(), message).help(help));
        None
    }

    /// Refuses a way of sliding without a coordinate, or with a corner.
    fn slides(&mut self, name: &Ident, along: Expr, span: Span) -> Option<()> {
        let (message, help) = if self.coordinates_in(along) == 0 {
            (
                format!("nothing slides along the stop `{name}`: no coordinate is left in it"),
                "write the way that what touches it slides, as in `along = foot.tip.x;`",
            )
        } else if self.bends(along) {
            (
                format!(
                    "what slides along the stop `{name}` turns a corner: friction has no direction there"
                ),
                "take a smooth way, or a `cubic` table",
            )
        } else {
            return Some(());
        };
        self.errors.push(Diagnostic::new(span, message).help(help));
        None
    }

    /// Asks that a value is from 0 to 1.
    pub(super) fn within_one(&mut self, what: &str, value: Expr, span: Span) {
        let (zero, one) = (self.scope.arena.zero(), self.scope.arena.one());
        for (bound, comparison) in [(zero, Comparison::GreaterOrEqual), (one, Comparison::LessOrEqual)] {
            self.beside(what, (value, comparison, bound), "it has to be from 0 to 1", span);
        }
    }

    /// Asks that a value is not negative.
    fn not_negative(&mut self, what: &str, value: Expr, span: Span) {
        let zero = self.scope.arena.zero();
        self.beside(what, (value, Comparison::GreaterOrEqual, zero), "it must not be negative", span);
    }

    /// Asks that a value is positive.
    fn positive(&mut self, what: &str, value: Expr, span: Span) {
        let zero = self.scope.arena.zero();
        self.beside(what, (value, Comparison::Greater, zero), "it has to be positive", span);
    }

    fn beside(
        &mut self,
        what: &str,
        (value, comparison, bound): (Expr, Comparison, Expr),
        text: &str,
        span: Span,
    ) {
        let difference = self.scope.arena.sub(value, bound);
        let (name, text) = (what.to_owned(), text.to_owned());
        self.scope.requirements.push(Requirement { name, value, difference, comparison, text, span });
    }
}

/// The error for a property that such a stop does not have.
fn unknown_property(property: &Ident, known: &[Row]) -> Diagnostic {
    let text = property.to_string();
    let names = known.iter().map(|(name, _)| *name);
    let is_soft = !names.clone().any(|name| name == RESTITUTION);
    let help = match (&*text, nearest(&text, names.clone())) {
        ("static", _) if !is_soft => "what sticks at a stop holds with its `friction`, too".to_owned(),
        (RESTITUTION, _) => "keep its `restitution`, and it hits in no time, or its `stiffness`".to_owned(),
        (_, Some(near)) => format!("did you mean `{near}`?"),
        _ => format!("its properties are {}", listing(names)),
    };
    let kind = if is_soft { "stop with a `stiffness`" } else { "stop" };
    Diagnostic::new(property.span(), format!("a {kind} has no `{text}`")).help(help)
}
