//! Springs with dampers, between two points or between two bodies' angles.
//!
//! With the elongation s (distance minus free length, or relative angle minus
//! free angle) the tension is F = k s + c ṡ. It does the virtual work −F δs, so
//! the generalized forces are −F ∂s/∂q, and the spring holds the energy ½ k s².

use std::collections::BTreeMap;

use mbs_symbolic::Number;
use mbs_symbolic::units::Dimension;
use proc_macro2::Span;

use super::super::joints;
use super::super::measures::Exerts;
use super::super::resolver::Resolver;
use super::{FORCE, Property, Resolved, TORQUE, missing};
use crate::diagnostics::Diagnostic;
use crate::syntax::{Element, ElementKind};

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
/// needs to know where it is at rest.
pub fn is_said(element: &Element, given: &BTreeMap<String, Span>, free: &str) -> Result<(), Diagnostic> {
    let has = |name: &str| given.contains_key(name);
    let what = match (has("stiffness"), has("damping"), has(free)) {
        (false, false, _) => "`stiffness` or `damping`".to_owned(),
        (true, _, false) => format!("`{free}`, at which it is free of force"),
        _ => return Ok(()),
    };
    Err(missing(element, &what, &format!("{{ stiffness = …; {free} = …; damping = …; }}")))
}

impl Resolver<'_> {
    pub(super) fn resolve_spring(&mut self, spring: &Resolved<'_>) {
        let is_torsion = spring.element.kind == ElementKind::TorsionSpring;
        let (stretch, free, dimension, help) = if is_torsion {
            let relative = self.scope.arena.sub(spring.first.angle, spring.second.angle);
            (relative, "angle", TORQUE, "one of its bodies has to turn")
        } else {
            let distance = joints::distance_between(&mut self.scope.arena, &spring.first, &spring.second);
            (distance, "length", FORCE, "let it act between points that move apart")
        };
        if !self.check_motion(spring.element, &[stretch], help) {
            return;
        }
        let free = self.value_or_zero(spring, free);
        let elongation = self.scope.arena.sub(stretch, free);
        let (stiffness, damping) =
            (self.value_or_zero(spring, "stiffness"), self.value_or_zero(spring, "damping"));
        let rate = self.scope.rate(elongation);
        let arena = &mut self.scope.arena;
        let (elastic, viscous) = (arena.mul(stiffness, elongation), arena.mul(damping, rate));
        let tension = arena.add(elastic, viscous);
        let tension = arena.share(tension);
        let energy = arena.product(&[(stiffness, 1), (elongation, 2)]);
        self.potentials.push(arena.scale(energy, Number::ratio(1, 2)));
        let pull = self.scope.arena.neg(tension);
        self.apply(&spring.element.name, pull, elongation);
        let exerted = if is_torsion { pull } else { tension };
        self.exerts(&spring.element.name, Exerts { value: exerted, dimension });
    }
}
