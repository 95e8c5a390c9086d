//! Outlines of bodies.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Algebra, Expr, Number, Scalar};
use proc_macro2::{Ident, Span};

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
            syntax::Outline::Slot { along, width } => {
                let what = ("the width of a slot", Dimension::LENGTH);
                let width = self.scope.formula_of(width, Place::Property, what, &mut self.errors);
                let (along, width) = (self.direction_of(name, along)?.into(), width?);
                self.asks_for("width", name, width, name.span(), true);
                let half = (Algebra::new(&mut self.scope.arena).scalar(width) / 2).expr();
                Outline::Slot { along, half }
            }
            syntax::Outline::Segment { to, radius } => {
                let way = self.way(name, body, to)?;
                self.asks_for_length(name, [[zero; 2], way], to);
                Outline::Segment { way: way.into(), radius: self.edge(name, radius.as_ref())? }
            }
            syntax::Outline::Arc { radius, from, to } => {
                let what = ("the end of an arc", Dimension::NONE);
                let [begin, end] = [from, to]
                    .map(|angle| self.scope.formula_of(angle, Place::Property, what, &mut self.errors));
                let radius = self.radius(name, radius)?;
                let (begin, end) = (begin?, end?);
                let algebra = Algebra::new(&mut self.scope.arena);
                let [begin, end] = [begin, end].map(|angle| algebra.scalar(angle));
                let (middle, angle) = ((begin + end) / 2, end - begin);
                let full = algebra.number(Number::pi(2, 1));
                let (middle, half) = (middle.expr(), (angle / 2).expr());
                let [angle, rest] = [angle, full - angle].map(Scalar::expr);
                self.asks_for("angle", name, angle, to.span, true);
                self.asks_for("rest of a full turn", name, rest, to.span, false);
                Outline::Arc { radius, middle, half }
            }
            syntax::Outline::Polygon { to, radius } => {
                let ways = to.iter().map(|to| self.way(name, body, to)).collect::<Option<Vec<_>>>()?;
                self.asks_for_turns(name, &ways, to);
                let ways = ways.into_iter().map(Into::into).collect();
                Outline::Polygon { ways, radius: self.edge(name, radius.as_ref())? }
            }
        })
    }

    /// From the place of an outline to another one of its corners.
    fn way(&mut self, name: &Ident, body: &Ident, to: &syntax::Vector) -> Option<[Expr; 2]> {
        let what = ("a corner of an outline", Dimension::LENGTH);
        let [x, y] = [&to.x, &to.y]
            .map(|formula| self.scope.formula_of(formula, Place::Point, what, &mut self.errors));
        let (x, y, [from_x, from_y]) = (x?, y?, self.scope.local(body, name, &mut self.errors)?);
        let arena = &mut self.scope.arena;
        Some([arena.sub(x, from_x), arena.sub(y, from_y)])
    }

    /// The radius of a round edge, 0 where it is left out.
    fn edge(&mut self, name: &Ident, radius: Option<&Formula>) -> Option<Expr> {
        match radius {
            Some(radius) => self.radius(name, radius),
            None => Some(self.scope.arena.zero()),
        }
    }

    /// Corners that follow each other are apart.
    fn asks_for_length(&mut self, name: &Ident, [from, to]: [[Expr; 2]; 2], at: &syntax::Vector) {
        let algebra = Algebra::new(&mut self.scope.arena);
        let length = (algebra.vector(to) - algebra.vector(from)).norm().expr();
        self.asks_for("length", name, length, at.span, true);
    }

    /// A polygon turns to the left at each of its corners, and once about all of them.
    fn asks_for_turns(&mut self, name: &Ident, ways: &[[Expr; 2]], at: &[syntax::Vector]) {
        let zero = self.scope.arena.zero();
        let algebra = Algebra::new(&mut self.scope.arena);
        let place = algebra.vector([zero; 2]);
        let corners: Vec<_> = ways.iter().map(|&way| algebra.vector(way)).collect();
        let mut turns = Vec::new();
        for (index, corner) in corners.iter().enumerate() {
            let before =
                index.checked_sub(1).and_then(|before| corners.get(before)).copied().unwrap_or(place);
            let next = corners.get(index + 1).copied().unwrap_or(place);
            turns.push((*corner - before).perpendicular().dot(next - *corner).expr());
        }
        // seen from the place, corners follow each other to the left: together with the turns, one turn about all
        let is_fan = corners.len() > 2;
        let fan = corners.windows(2).map(|pair| pair[0].perpendicular().dot(pair[1]).expr());
        let fan: Vec<_> = fan.filter(|_| is_fan).collect();
        for (turn, to) in turns.into_iter().zip(at).chain(fan.into_iter().zip(&at[1..])) {
            self.asks_for("counter-clockwise turn at a corner", name, turn, to.span, true);
        }
    }

    fn radius(&mut self, name: &Ident, radius: &Formula) -> Option<Expr> {
        let what = format!("the radius of `{name}`");
        let what = (&*what, Dimension::LENGTH);
        let value = self.scope.formula_of(radius, Place::Property, what, &mut self.errors)?;
        self.asks_for("radius", name, value, radius.span, true);
        Some(value)
    }

    /// Asks for a value that is positive, or not negative.
    fn asks_for(&mut self, property: &'static str, name: &Ident, value: Expr, span: Span, is_strict: bool) {
        let owner = name.to_string();
        self.checks.push(Check { value, is_strict, property, owner, span, zero_help: None });
    }

    /// The outline at a place; about a centre there is none.
    pub(super) fn outline_at(&self, place: &Attachment) -> Option<Outline> {
        let place = self.scope.on_body(place);
        let Some(name) = &place.point else {
            return Some(Outline::Circle { radius: self.scope.arena.zero() });
        };
        self.scope.bodies.get(&place.body.to_string())?.points.get(&name.to_string())?.outline.clone()
    }
}
