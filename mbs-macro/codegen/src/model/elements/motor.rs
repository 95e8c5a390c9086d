//! A motor by its torque–speed line: T = stall·(level − ω/no_load) on the first
//! body, the reaction on the second, ω = φ̇₁ − φ̇₂.
//!
//! A direct-current machine with a constant voltage has this line; `level` is
//! the voltage as a share of the nominal one.

use std::collections::BTreeMap;

use mbs_symbolic::Number;
use mbs_symbolic::units::Dimension;
use proc_macro2::Span;

use super::super::measures::Exerts;
use super::super::resolver::Resolver;
use super::{Property, RATE, Resolved, TORQUE, all_said};
use crate::diagnostics::Diagnostic;
use crate::syntax::Element;

pub const PROPERTIES: &[Property] = &[
    Property::fixed("stall", TORQUE).not_negative(),
    Property::fixed("no_load", RATE).positive(),
    Property::varying("level", Dimension::NONE),
];

pub fn is_said(element: &Element, given: &BTreeMap<String, Span>) -> Result<(), Diagnostic> {
    all_said(element, given, &["stall", "no_load"], "{ stall = 2 [N*m]; no_load = 3000 [rpm]; }")
}

impl Resolver<'_> {
    pub(super) fn resolve_motor(&mut self, motor: &Resolved<'_>) {
        let arena = &mut self.scope.arena;
        let angle = arena.sub(motor.first.angle, motor.second.angle);
        if !self.check_motion(motor.element, &[angle], "one of its bodies has to turn") {
            return;
        }
        let (Some(stall), Some(no_load)) = (motor.get("stall"), motor.get("no_load")) else { return };
        let level = motor.get("level").unwrap_or(self.scope.arena.one());
        let speed = self.scope.rate(angle);
        let arena = &mut self.scope.arena;
        let share = arena.product(&[(speed, 1), (no_load, -1)]);
        let left = arena.sum(&[(level, Number::ONE), (share, Number::MINUS_ONE)]);
        let torque = arena.mul(stall, left);
        let torque = arena.share(torque);
        self.apply(&motor.element.name, torque, angle);
        self.exerts(&motor.element.name, Exerts { value: torque, dimension: TORQUE });
    }
}
