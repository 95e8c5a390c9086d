//! Springs with dampers that act in one direction: a rope pulls, a strut pushes.
//!
//! With the elongation s = d − l of a rope, d the distance of its places and l its length without force, the tension
//! is F = max(0, k s + c ṡ) for s > 0, and 0 for s ≤ 0. Of a strut s = l − d, and F pushes. F does the virtual work
//! −F δs, and ½ k max(0, s)² is stored. Neither pulls what only touches it: a damper alone would.

use mbs_symbolic::Scalar;
use mbs_symbolic::units::Dimension;

use super::properties::{FORCE, Given, Property, Unsaid};
use super::{Effects, Element, ElementKind, Places};

const PROPERTIES: &[Property] = &[
    Property::fixed("stiffness", Dimension::of(1, 0, -2)).not_negative(),
    Property::fixed("damping", Dimension::of(1, 0, -1)).not_negative(),
    Property::fixed("length", Dimension::LENGTH).not_negative(),
];

pub const ROPE: ElementKind = ElementKind {
    word: "rope",
    meaning: "pulls two points together beyond its length, and goes slack",
    example: "(load, ground.hook) { stiffness = 20 [kN/m]; length = 1.5 [m]; damping = 200 [N*s/m]; }",
    forces: |rope, effects| {
        let tension = act(rope, effects, |distance, length| distance - length)?;
        effects.exert(tension, FORCE);
        Some(())
    },
    ..STRUT
};

pub const STRUT: ElementKind = ElementKind {
    word: "strut",
    meaning: "pushes two points apart below its length, as a bumper does",
    example: "(load, ground.base) { stiffness = 20 [kN/m]; length = 0.2 [m]; damping = 200 [N*s/m]; }",
    places: Places::Two,
    properties: PROPERTIES,
    said,
    knows: &[],
    moved: |strut| (strut.first.position - strut.second.position).components().into(),
    mend: "let it act between points that move apart",
    needs: None,
    refuses: |_| None,
    forces: |strut, effects| {
        let push = act(strut, effects, |distance, length| length - distance)?;
        effects.exert(-push, FORCE);
        Some(())
    },
};

fn said(given: &Given<'_>) -> Result<(), Unsaid> {
    given.all(&["stiffness", "length"], "{ stiffness = …; length = …; damping = …; }")
}

/// The force of an elongation, applied and stored.
fn act<'a>(
    element: &Element<'a>,
    effects: &mut Effects<'_>,
    elongation: fn(Scalar<'a>, Scalar<'a>) -> Scalar<'a>,
) -> Option<Scalar<'a>> {
    let (k, c) = (element.get("stiffness")?, element.get_or_zero("damping"));
    let (length, zero) = (element.get("length")?, element.algebra.number(0));
    let distance = element.first.distance_to(element.second);
    effects.gap = Some((distance.expr(), length.expr()));
    let s = elongation(distance, length);
    let pull = k * s + c * effects.rate(s);
    let force = s.greater(zero).gate(zero.max(pull)).shared();
    effects.store(k, zero.max(s));
    effects.apply(-force, s);
    Some(force)
}
