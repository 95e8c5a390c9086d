//! Outlines of bodies.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Algebra, Expr};
use proc_macro2::Ident;

use super::Check;
use super::names::Place;
use super::resolver::Resolver;
use crate::mechanics::Outline;
use crate::syntax::{self, Attachment, Formula};

impl Resolver<'_> {
    /// Reads the outline about a point.
    pub(super) fn resolve_outline(&mut self, name: &Ident, body: &Ident, outline: &syntax::Outline) {
        let Some(outline) = self.outline(name, body, outline) else { return };
        let frame = self.scope.bodies.get_mut(&body.to_string());
        if let Some(point) = frame.and_then(|frame| frame.points.get_mut(&name.to_string())) {
            point.outline = Some(outline);
        }
    }

    fn outline(&mut self, name: &Ident, body: &Ident, outline: &syntax::Outline) -> Option<Outline> {
        let zero = self.scope.arena.zero();
        Some(match outline {
            syntax::Outline::Point => Outline::Circle { radius: zero },
            syntax::Outline::Circle { radius } => Outline::Circle { radius: self.radius(name, radius)? },
            syntax::Outline::Bore { radius } => Outline::Bore { radius: self.radius(name, radius)? },
            syntax::Outline::Line { along } => {
                Outline::Line { along: self.direction_of(name, along)?.into() }
            }
            syntax::Outline::Segment { to, radius } => {
                let what = ("the end of a segment", Dimension::LENGTH);
                let x = self.scope.formula_of(&to.x, Place::Point, what, &mut self.errors);
                let y = self.scope.formula_of(&to.y, Place::Point, what, &mut self.errors);
                let radius = match radius {
                    Some(radius) => self.radius(name, radius)?,
                    None => zero,
                };
                let (x, y, [from_x, from_y]) = (x?, y?, self.scope.local(body, name, &mut self.errors)?);
                let arena = &mut self.scope.arena;
                let way = [arena.sub(x, from_x), arena.sub(y, from_y)];
                let length = Algebra::new(arena).vector(way).norm().expr();
                self.asks_for_positive("length", name, length, to.span);
                Outline::Segment { way: way.into(), radius }
            }
        })
    }

    fn radius(&mut self, name: &Ident, radius: &Formula) -> Option<Expr> {
        let what = format!("the radius of `{name}`");
        let what = (&*what, Dimension::LENGTH);
        let value = self.scope.formula_of(radius, Place::Property, what, &mut self.errors)?;
        self.asks_for_positive("radius", name, value, radius.span);
        Some(value)
    }

    fn asks_for_positive(
        &mut self,
        property: &'static str,
        name: &Ident,
        value: Expr,
        span: proc_macro2::Span,
    ) {
        let owner = name.to_string();
        self.checks.push(Check { value, is_strict: true, property, owner, span, zero_help: None });
    }

    /// The outline at a place; about a centre there is none.
    pub(super) fn outline_at(&self, place: &Attachment) -> Option<Outline> {
        let place = self.scope.on_body(place);
        let Some(name) = &place.point else {
            return Some(Outline::Circle { radius: self.scope.arena.zero() });
        };
        self.scope.bodies.get(&place.body.to_string())?.points.get(&name.to_string())?.outline
    }
}
