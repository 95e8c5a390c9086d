//! Springs with dampers, between two points or between two bodies' angles.
//!
//! With the elongation s (distance minus free length, or relative angle minus
//! free angle) the tension is F = k s + c ṡ. It does the virtual work −F δs, so
//! the generalized forces are −F ∂s/∂q, and the spring holds the energy ½ k s².
//!
//! The distance |r| has no derivative where the places coincide. There the
//! spring has no direction, unless its free length is 0: then it pulls with k r,
//! which is as regular as r, and is written so. The damper of such a spring
//! has the direction of r, kept from its kink at 0.

use std::collections::BTreeMap;

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Algebra, Expr, Number};
use proc_macro2::Span;

use super::super::Gap;
use super::super::measures::Exerts;
use super::super::resolver::Resolver;
use super::{FORCE, Property, Resolved, TORQUE, missing};
use crate::diagnostics::Diagnostic;
use crate::mechanics::norm;
use crate::syntax::{Element, ElementKind, ElementProperty, Formula, FormulaKind, Load};

pub const LINEAR: &[Property] = &[
    Property::fixed("stiffness", Dimension::of(1, 0, -2)),
    Property::fixed("damping", Dimension::of(1, 0, -1)),
    Property::fixed("length", Dimension::LENGTH),
];

pub const TORSIONAL: &[Property] = &[
    Property::fixed("stiffness", Dimension::of(1, 2, -2)),
    Property::fixed("damping", Dimension::of(1, 2, -1)),
    Property::fixed("angle", Dimension::NONE),
];

/// A spring without stiffness and damping does nothing; one with stiffness
/// needs to know where it is at rest, and one without does not.
pub fn is_said(element: &Element, given: &BTreeMap<String, Span>, free: &str) -> Result<(), Diagnostic> {
    let is_zero = |value: &Load| match value {
        Load::Scalar(Formula { kind: FormulaKind::Number { value, .. }, .. }) => value.is_zero(),
        _ => false,
    };
    let is_none = |property: &&ElementProperty| property.name == "stiffness" && is_zero(&property.value);
    let is_elastic = !element.properties.iter().any(|property| is_none(&property));
    let has = |name: &str| given.contains_key(name) && (name != "stiffness" || is_elastic);
    let what = match (has("stiffness"), has("damping"), has(free)) {
        (false, false, _) => "`stiffness` or `damping`".to_owned(),
        (true, _, false) => format!("`{free}`, at which it is free of force"),
        _ => return Ok(()),
    };
    let example = format!("{{ stiffness = …; {free} = …; damping = …; }}");
    Err(missing(element, &what, &example))
}

impl Resolver<'_> {
    pub(super) fn resolve_spring(&mut self, spring: &Resolved<'_>) {
        if spring.element.kind == ElementKind::TorsionSpring {
            self.resolve_torsion_spring(spring);
            return;
        }
        let algebra = Algebra::new(&mut self.scope.arena);
        let [first, second] = [spring.first.on(&algebra), spring.second.on(&algebra)];
        let between = (first.position - second.position).exprs();
        if !self.check_motion(spring.element, &between, "let it act between points that move apart") {
            return;
        }
        let free = self.value_or_zero(spring, "length");
        if self.scope.arena.is_zero(free) {
            self.resolve_spring_without_length(spring, between);
            return;
        }
        let algebra = Algebra::new(&mut self.scope.arena);
        let distance = spring.first.on(&algebra).distance_to(spring.second.on(&algebra)).expr();
        self.gaps.push(Gap { distance, free, name: spring.element.name.clone() });
        let elongation = self.scope.arena.sub(distance, free);
        let tension = self.tension(spring, elongation);
        self.apply_tension(spring, tension, elongation);
        self.exerts(&spring.element.name, Exerts { value: tension, dimension: FORCE });
    }

    fn resolve_torsion_spring(&mut self, spring: &Resolved<'_>) {
        let relative = self.scope.arena.sub(spring.first.angle, spring.second.angle);
        if !self.check_motion(spring.element, &[relative], "one of its bodies has to turn") {
            return;
        }
        let free = self.value_or_zero(spring, "angle");
        let elongation = self.scope.arena.sub(relative, free);
        let tension = self.tension(spring, elongation);
        self.apply_tension(spring, tension, elongation);
        let value = self.scope.arena.neg(tension);
        self.exerts(&spring.element.name, Exerts { value, dimension: TORQUE });
    }

    /// The elastic force is −k r, component by component.
    fn resolve_spring_without_length(&mut self, spring: &Resolved<'_>, between: [Expr; 2]) {
        let name = &spring.element.name;
        let stiffness = self.value_or_zero(spring, "stiffness");
        for component in between {
            let pull = self.scope.arena.mul(stiffness, component);
            let pull = self.scope.arena.neg(pull);
            self.apply(name, pull, component);
            self.store(stiffness, component);
        }
        let damping = self.value_or_zero(spring, "damping");
        let algebra = Algebra::new(&mut self.scope.arena);
        let distance = norm(algebra.vector(between)).expr();
        let rate = self.scope.rate(distance);
        let arena = &mut self.scope.arena;
        let viscous = arena.mul(damping, rate);
        let viscous = arena.share(viscous);
        let drag = arena.neg(viscous);
        self.apply(name, drag, distance);
        let arena = &mut self.scope.arena;
        let algebra = Algebra::new(arena);
        let length = spring.first.on(&algebra).distance_to(spring.second.on(&algebra)).expr();
        let arena = &mut self.scope.arena;
        let elastic = arena.mul(stiffness, length);
        let value = arena.add(elastic, viscous);
        self.exerts(name, Exerts { value, dimension: FORCE });
    }

    /// k s + c ṡ, of an elongation s; the energy is noted.
    fn tension(&mut self, spring: &Resolved<'_>, elongation: Expr) -> Expr {
        let stiffness = self.value_or_zero(spring, "stiffness");
        let damping = self.value_or_zero(spring, "damping");
        let rate = self.scope.rate(elongation);
        let arena = &mut self.scope.arena;
        let (elastic, viscous) = (arena.mul(stiffness, elongation), arena.mul(damping, rate));
        let tension = arena.add(elastic, viscous);
        let tension = arena.share(tension);
        self.store(stiffness, elongation);
        tension
    }

    /// Adds the energy ½ k s².
    fn store(&mut self, stiffness: Expr, elongation: Expr) {
        let arena = &mut self.scope.arena;
        let energy = arena.product(&[(stiffness, 1), (elongation, 2)]);
        self.potentials.push(arena.scale(energy, Number::ratio(1, 2)));
    }

    fn apply_tension(&mut self, spring: &Resolved<'_>, tension: Expr, elongation: Expr) {
        let pull = self.scope.arena.neg(tension);
        self.apply(&spring.element.name, pull, elongation);
    }
}
