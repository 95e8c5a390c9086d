//! Drag of a fluid at a place: F = −½ ρ c A |w| w, w the velocity against the
//! fluid, which itself moves with the wind.

use mbs_symbolic::units::Dimension;

use super::properties::{FORCE, Property, SPEED};
use super::{Effects, Element, ElementKind, Places};
use crate::mechanics::norm;

pub const DRAG: ElementKind = ElementKind {
    word: "drag",
    meaning: "brakes what moves through a fluid",
    example: "on plate { density = 1.2 [kg/m^3]; area = 0.1 [m^2]; coefficient = 1; }",
    places: Places::One,
    properties: &[
        Property::varying("density", Dimension::of(1, -3, 0)).not_negative(),
        Property::varying("area", Dimension::of(0, 2, 0)).not_negative(),
        Property::varying("coefficient", Dimension::NONE).not_negative(),
        Property::varying("wind", SPEED).vector(),
    ],
    said: |given| {
        let example = "{ density = 1.2 [kg/m^3]; area = 0.1 [m^2]; coefficient = 1; }";
        given.all(&["density", "area", "coefficient"], example)
    },
    knows: &[],
    moved: |drag| drag.first.position.components().into(),
    mend: "let it act on a body that has a position",
    needs: None,
    refuses: |_| None,
    forces,
};

fn forces(drag: &Element<'_>, effects: &mut Effects<'_>) -> Option<()> {
    let (rho, area, coefficient) = (drag.get("density")?, drag.get("area")?, drag.get("coefficient")?);
    let place = drag.first.position;
    let velocity = place.map(|component| effects.rate(component));
    let against = match drag.vector("wind") {
        Some(wind) => velocity - wind,
        None => velocity,
    };
    let speed = norm(against);
    let factor = (-(rho * area * coefficient * speed) / 2).shared();
    effects.exert(-(factor * speed), FORCE);
    effects.apply(factor * against.x, place.x);
    effects.apply(factor * against.y, place.y);
    Some(())
}
