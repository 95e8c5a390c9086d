//! Drag of a fluid at a place: F = −½ ρ c A |w| w, w the velocity against the
//! fluid, which itself moves with the wind.

use std::collections::BTreeMap;

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Algebra, Number};
use proc_macro2::Span;

use super::super::measures::Exerts;
use super::super::resolver::Resolver;
use super::{FORCE, Property, Resolved, SPEED, all_said};
use crate::diagnostics::Diagnostic;
use crate::mechanics::norm;
use crate::syntax::Element;

pub const PROPERTIES: &[Property] = &[
    Property::varying("density", Dimension::of(1, -3, 0)).not_negative(),
    Property::varying("area", Dimension::of(0, 2, 0)).not_negative(),
    Property::varying("coefficient", Dimension::NONE).not_negative(),
    Property::varying("wind", SPEED).vector(),
];

pub fn is_said(element: &Element, given: &BTreeMap<String, Span>) -> Result<(), Diagnostic> {
    let example = "{ density = 1.2 [kg/m^3]; area = 0.1 [m^2]; coefficient = 1; }";
    all_said(element, given, &["density", "area", "coefficient"], example)
}

impl Resolver<'_> {
    pub(super) fn resolve_drag(&mut self, drag: &Resolved<'_>) {
        let place = drag.first.position.components();
        let help = "let it act on a body that has a position";
        if !self.check_motion(drag.element, &place, help) {
            return;
        }
        let (Some(density), Some(area), Some(coefficient)) =
            (drag.get("density"), drag.get("area"), drag.get("coefficient"))
        else {
            return;
        };
        let zero = self.scope.arena.zero();
        let wind = drag.vector("wind").unwrap_or([zero; 2]);
        let velocity = place.map(|component| self.scope.rate(component));
        let arena = &mut self.scope.arena;
        let against = [arena.sub(velocity[0], wind[0]), arena.sub(velocity[1], wind[1])];
        let algebra = Algebra::new(arena);
        let speed = norm(algebra.vector(against)).expr();
        let arena = &mut self.scope.arena;
        let factor = arena.product(&[(density, 1), (area, 1), (coefficient, 1), (speed, 1)]);
        let factor = arena.scale(factor, Number::ratio(-1, 2));
        let factor = arena.share(factor);
        let magnitude = arena.mul(factor, speed);
        let magnitude = arena.neg(magnitude);
        for (moved, against) in place.into_iter().zip(against) {
            let force = self.scope.arena.mul(factor, against);
            self.apply(&drag.element.name, force, moved);
        }
        self.exerts(&drag.element.name, Exerts { value: magnitude, dimension: FORCE });
    }
}
