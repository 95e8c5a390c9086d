//! Dry and viscous friction, along a direction or about a pin:
//! F = −(μ |N| tanh(v/v_t) + c v) at the sliding speed v.
//!
//! The hyperbolic tangent stands for the sign of v (Coulomb's law made smooth):
//! below the transition speed v_t the friction is a stiff damper, so what should
//! stick creeps at up to v_t.

use std::collections::BTreeMap;

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Algebra, Expr, Function, Node, Number};
use proc_macro2::Span;

use super::super::measures::Exerts;
use super::super::reactions::KnownJoint;
use super::super::resolver::Resolver;
use super::{FORCE, Property, RATE, Resolved, SPEED, TORQUE, all_said};
use crate::diagnostics::Diagnostic;
use crate::mechanics::joints::Holds;
use crate::syntax::{Attachment, Element, ElementKind};

pub const SLIDING: &[Property] = &[
    Property::varying("coefficient", Dimension::NONE).not_negative(),
    Property::varying("normal", FORCE),
    Property::fixed("transition", SPEED).positive(),
    Property::varying("viscous", Dimension::of(1, 0, -1)).not_negative(),
];

pub const TURNING: &[Property] = &[
    Property::varying("torque", TORQUE).not_negative(),
    Property::varying("coefficient", Dimension::NONE).not_negative(),
    Property::varying("normal", FORCE),
    Property::fixed("radius", Dimension::LENGTH).not_negative(),
    Property::fixed("transition", RATE).positive(),
    Property::varying("viscous", Dimension::of(1, 2, -1)).not_negative(),
];

/// Either all of the dry part is given, `dry` or a torque with the transition,
/// or the viscous part alone.
pub fn is_said(element: &Element, given: &BTreeMap<String, Span>, dry: &[&str]) -> Result<(), Diagnostic> {
    let has = |name: &str| given.contains_key(name);
    let of_dry = dry.iter().find(|name| has(name));
    if let (true, Some(twice)) = (has("torque"), of_dry) {
        let message = format!("`{}` says its `torque` and its `{twice}`", element.name);
        return Err(Diagnostic::new(element.name.span(), message)
            .help("give `torque`, or `coefficient`, `normal` and `radius`"));
    }
    let example = match (element.kind, of_dry) {
        (ElementKind::Friction, _) => "{ coefficient = 0.3; normal = 20 [N]; transition = 1e-3 [m/s]; }",
        (_, None) => "{ torque = 0.1 [N*m]; transition = 0.1 [rad/s]; }",
        (_, Some(_)) => "{ coefficient = 0.1; normal = 20 [N]; radius = 5 [mm]; transition = 0.1 [rad/s]; }",
    };
    let is_dry = has("torque") || of_dry.is_some() || has("transition");
    match (is_dry, has("torque")) {
        (false, _) if has("viscous") => Ok(()),
        (_, true) => all_said(element, given, &["transition"], example),
        _ => {
            all_said(element, given, dry, example)?;
            all_said(element, given, &["transition"], example)
        }
    }
}

impl Resolver<'_> {
    pub(super) fn resolve_friction(&mut self, friction: &Resolved<'_>) {
        let element = friction.element;
        let is_sliding = element.kind == ElementKind::Friction;
        let (moved, help) = if is_sliding {
            let Some(moved) = self.slide(friction) else { return };
            (moved, "let it act where two bodies slide along each other")
        } else {
            let angle = self.scope.arena.sub(friction.first.angle, friction.second.angle);
            (angle, "one of its bodies has to turn")
        };
        if !self.check_motion(element, &[moved], help) || !self.check_freedom(element) {
            return;
        }
        let limit = self.dry_limit(friction);
        let speed = self.scope.rate(moved);
        let viscous = self.value_or_zero(friction, "viscous");
        let arena = &mut self.scope.arena;
        let mut terms = vec![(arena.mul(viscous, speed), Number::MINUS_ONE)];
        if let (Some(limit), Some(transition)) = (limit, friction.get("transition")) {
            let share = arena.product(&[(speed, 1), (transition, -1)]);
            let direction = arena.call(Function::Tanh, share);
            terms.push((arena.mul(limit, direction), Number::MINUS_ONE));
        }
        let force = arena.sum(&terms);
        let force = arena.share(force);
        self.apply(&element.name, force, moved);
        let dimension = if is_sliding { FORCE } else { TORQUE };
        self.exerts(&element.name, Exerts { value: force, dimension });
    }

    /// Refuses friction where a joint leaves nothing to rub: sliding of points
    /// that coincide, turning of bodies that keep their angle.
    fn check_freedom(&mut self, element: &Element) -> bool {
        let Some(second) = &element.second else { return true };
        let ends = [&element.first, second];
        let is_sliding = element.kind == ElementKind::Friction;
        let same = |a: &Attachment, b: &Attachment| a.body == b.body && (!is_sliding || a.point == b.point);
        let holds = |joint: &&KnownJoint| {
            let [first, second] = joint.ends.each_ref();
            let is_between = (same(ends[0], first) && same(ends[1], second))
                || (same(ends[0], second) && same(ends[1], first));
            is_between && joint.kind.holds(if is_sliding { Holds::Place } else { Holds::Angle })
        };
        let Some(joint) = self.scope.joints.values().find(holds) else { return true };
        let (what, help) = match is_sliding {
            true => ("slides", "friction of a pin is `torsion_friction`"),
            false => ("turns", "friction of a guide is `friction`"),
        };
        let message = format!("nothing {what} at `{}`", element.name);
        let error = Diagnostic::new(element.name.span(), message).help(help);
        self.errors.push(error.note(joint.span, "this joint holds its places together"));
        false
    }

    /// u·(p₁ − p₂): how far the first place is along the direction on the
    /// second body. Its variation is what the friction force does work along,
    /// with the reaction at the first place.
    fn slide(&mut self, friction: &Resolved<'_>) -> Option<Expr> {
        let element = friction.element;
        let along = element.along.as_ref()?;
        let along = self.direction_of(&element.name, along)?;
        let algebra = Algebra::new(&mut self.scope.arena);
        let [first, second] = [friction.first.on(&algebra), friction.second.on(&algebra)];
        Some(first.offset_along(second, algebra.vector(along)).expr())
    }

    /// The largest dry friction: μ |N|, times the radius of a pin; or as given.
    fn dry_limit(&mut self, friction: &Resolved<'_>) -> Option<Expr> {
        if friction.has("torque") {
            return friction.get("torque");
        }
        let (coefficient, normal) = (friction.get("coefficient")?, friction.get("normal")?);
        let arena = &mut self.scope.arena;
        let radius = friction.get("radius").unwrap_or(arena.one());
        let normal = match arena.node(normal) {
            // The size of a reaction is one already.
            Node::Call(Function::Abs | Function::Sqrt, _) => normal,
            _ => arena.call(Function::Abs, normal),
        };
        Some(arena.product(&[(coefficient, 1), (normal, 1), (radius, 1)]))
    }
}
