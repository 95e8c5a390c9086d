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

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Scalar, Vector};

use super::properties::{FORCE, Given, Property, TORQUE, Unsaid};
use super::{Effects, Element, ElementKind, Places};
use crate::mechanics::norm;

pub const SPRING: ElementKind = ElementKind {
    word: "spring",
    meaning: "pulls two points together or apart, with a damper",
    example: "(arm.end, ground) { stiffness = 100 [N/m]; length = 0.1 [m]; }",
    places: Places::Two,
    properties: &[
        Property::fixed("stiffness", Dimension::of(1, 0, -2)),
        Property::fixed("damping", Dimension::of(1, 0, -1)),
        Property::fixed("length", Dimension::LENGTH),
    ],
    said: |given| is_said(given, "length"),
    moved: |spring| between(spring).components().into(),
    mend: "let it act between points that move apart",
    needs: None,
    forces: |spring, effects| {
        let free = spring.get_or_zero("length");
        if free.is_zero() {
            pull_together(spring, effects);
            return Some(());
        }
        let distance = spring.first.distance_to(spring.second);
        effects.gap = Some((distance.expr(), free.expr()));
        let tension = pull(spring, distance - free, effects);
        effects.exert(tension, FORCE);
        Some(())
    },
};

pub const TORSION_SPRING: ElementKind = ElementKind {
    word: "torsion_spring",
    meaning: "turns two bodies against each other, with a damper",
    example: "(arm, ground) { stiffness = 5 [N*m]; angle = 0; }",
    places: Places::Two,
    properties: &[
        Property::fixed("stiffness", Dimension::of(1, 2, -2)),
        Property::fixed("damping", Dimension::of(1, 2, -1)),
        Property::angle("angle"),
    ],
    said: |given| is_said(given, "angle"),
    moved: |spring| vec![spring.relative_angle()],
    mend: "one of its bodies has to turn",
    needs: None,
    forces: |spring, effects| {
        let elongation = spring.relative_angle() - spring.get_or_zero("angle");
        let tension = pull(spring, elongation, effects);
        effects.exert(-tension, TORQUE);
        Some(())
    },
};

/// A spring without stiffness and damping does nothing; one with stiffness
/// needs to know where it is at rest, and one without does not.
fn is_said(given: &Given<'_>, free: &str) -> Result<(), Unsaid> {
    let what = match (given.has_some("stiffness"), given.has("damping"), given.has(free)) {
        (false, false, _) => "`stiffness` or `damping`".to_owned(),
        (true, _, false) => format!("`{free}`, at which it is free of force"),
        _ => return Ok(()),
    };
    Err(Unsaid::Missing { what, example: format!("{{ stiffness = …; {free} = …; damping = …; }}") })
}

fn between<'a>(spring: &Element<'a>) -> Vector<Scalar<'a>> {
    spring.first.position - spring.second.position
}

/// The tension F = k s + c ṡ of an elongation s, applied as −F δs; ½ k s² is stored.
fn pull<'a>(spring: &Element<'a>, s: Scalar<'a>, effects: &mut Effects<'_>) -> Scalar<'a> {
    let (k, c) = (spring.get_or_zero("stiffness"), spring.get_or_zero("damping"));
    let rate = effects.rate(s);
    let tension = (k * s + c * rate).shared();
    effects.store(k, s);
    effects.apply(-tension, s);
    tension
}

/// A spring without length: the elastic force is −k r, component by component.
fn pull_together(spring: &Element<'_>, effects: &mut Effects<'_>) {
    let (k, c) = (spring.get_or_zero("stiffness"), spring.get_or_zero("damping"));
    let r = between(spring);
    for component in r.components() {
        effects.apply(-(k * component), component);
        effects.store(k, component);
    }
    let distance = norm(r);
    let viscous = (c * effects.rate(distance)).shared();
    effects.apply(-viscous, distance);
    let length = spring.first.distance_to(spring.second);
    effects.exert(k * length + viscous, FORCE);
}
