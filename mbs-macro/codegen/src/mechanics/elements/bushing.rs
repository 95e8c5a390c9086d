//! An elastic bearing: springs with dampers along both axes of the second body, and between the angles.
//!
//! With r the place of the first in the axes of the second, whose origin is its place, and φ the relative angle, it
//! acts with −k_x r_x − c_x ṙ_x along x, likewise along y, and with −k (φ − a) − c φ̇ on the first body. Each does the
//! virtual work of its own coordinate, so that the moments of the forces about both bodies balance.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Scalar, Vector};

use super::properties::{FORCE, Given, Property, Unsaid};
use super::{Effects, Element, ElementKind, Places};
use crate::mechanics::norm;

pub const BUSHING: ElementKind = ElementKind {
    word: "bushing",
    meaning: "holds two points together, elastically, in the axes of the second body",
    example: "(arm.eye, frame.eye) { stiffness = (5, 1) [kN/mm]; damping = (400, 100) [N*s/m]; torsion = 20 [N*m]; }",
    places: Places::Two,
    properties: &[
        Property::fixed("stiffness", Dimension::of(1, 0, -2)).vector(),
        Property::fixed("damping", Dimension::of(1, 0, -1)).vector(),
        Property::fixed("torsion", Dimension::of(1, 2, -2)),
        Property::fixed("torsion_damping", Dimension::of(1, 2, -1)),
        Property::angle("angle"),
    ],
    said,
    knows: &[],
    moved: |bushing| {
        let r = bushing.first.position - bushing.second.position;
        r.components().into_iter().chain([bushing.relative_angle()]).collect()
    },
    mend: "let it act between points that move apart",
    needs: None,
    refuses: |_| None,
    forces,
};

fn said(given: &Given<'_>) -> Result<(), Unsaid> {
    given.all(&["stiffness"], "{ stiffness = (…, …); damping = (…, …); torsion = …; torsion_damping = …; }")
}

fn forces(bushing: &Element<'_>, effects: &mut Effects<'_>) -> Option<()> {
    let none = || bushing.algebra.vector([bushing.algebra.number(0); 2]);
    let (k, c) = (bushing.vector("stiffness")?, bushing.vector("damping").unwrap_or_else(none));
    let r = (bushing.first.position - bushing.second.position).rotated(-bushing.second.angle);
    let (x, y) = (pull(effects, [k.x, c.x, r.x]), pull(effects, [k.y, c.y, r.y]));
    let turn = bushing.relative_angle() - bushing.get_or_zero("angle");
    pull(effects, [bushing.get_or_zero("torsion"), bushing.get_or_zero("torsion_damping"), turn]);
    effects.exert(norm(Vector { x, y }), FORCE);
    Some(())
}

/// The tension k s + c ṡ, applied and stored.
fn pull<'a>(effects: &mut Effects<'_>, [k, c, s]: [Scalar<'a>; 3]) -> Scalar<'a> {
    let tension = (k * s + c * effects.rate(s)).shared();
    effects.store(k, s);
    effects.apply(-tension, s);
    tension
}
