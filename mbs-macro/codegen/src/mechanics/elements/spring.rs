//! Springs with dampers, between two points or between two bodies' angles.
//!
//! With the elongation s (distance minus free length, or relative angle minus
//! free angle) and a preload P the tension is F = P + k s + c ṡ. It does the virtual work −F δs, so
//! the generalized forces are −F ∂s/∂q, and the spring holds the energy P s + ½ k s².
//!
//! The distance |r| has no derivative where the places coincide, so a spring with a
//! free length has no direction there. Without one it pulls with k r, which is as
//! regular as r, and its damper with c times the component of ṙ along r. Along a
//! single coordinate that is c ṙ. In the plane it is c ṙ where the places coincide,
//! too: a motion through r = 0 goes along ṙ, before and behind it.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Scalar, Vector};

use super::properties::{FORCE, Given, Property, TORQUE, Unsaid};
use super::{Effects, Element, ElementKind, Places};
use crate::mechanics::norm;

/// Places nearer to each other than an atom is wide coincide: (1e-10 m)². Roundings of positions
/// up to a kilometre are below that.
const COINCIDENT: f64 = 1e-20;

pub const SPRING: ElementKind = ElementKind {
    word: "spring",
    meaning: "pulls two points together or apart, with a damper",
    example: "(arm.end, ground) { stiffness = 100 [N/m]; length = 0.1 [m]; }",
    places: Places::Two,
    properties: &[
        Property::fixed("stiffness", Dimension::of(1, 0, -2)),
        Property::fixed("damping", Dimension::of(1, 0, -1)),
        Property::fixed("length", Dimension::LENGTH),
        Property::fixed("preload", FORCE),
    ],
    said: |given| is_said(given, "length"),
    knows: &[],
    moved: |spring| between(spring).components().into(),
    mend: "let it act between points that move apart",
    needs: None,
    refuses: |_| None,
    forces: |spring, effects| {
        let free = spring.get_or_zero("length");
        if free.is_zero() && spring.get_or_zero("preload").is_zero() {
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
        Property::fixed("preload", TORQUE),
    ],
    said: |given| is_said(given, "angle"),
    knows: &[],
    moved: |spring| vec![spring.relative_angle()],
    mend: "one of its bodies has to turn",
    needs: None,
    refuses: |_| None,
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
    let acts = given.has("damping") || given.has_some("preload");
    let what = match (given.has_some("stiffness"), acts, given.has(free)) {
        (false, false, _) => "`stiffness`, `damping` or `preload`".to_owned(),
        (true, _, false) => format!("`{free}`, at which it has its preload or none"),
        _ => return Ok(()),
    };
    Err(Unsaid::Missing { what, example: format!("{{ stiffness = …; {free} = …; damping = …; }}") })
}

fn between<'a>(spring: &Element<'a>) -> Vector<Scalar<'a>> {
    spring.first.position - spring.second.position
}

/// The tension F = P + k s + c ṡ of an elongation s, applied as −F δs; P s + ½ k s² is stored.
fn pull<'a>(spring: &Element<'a>, s: Scalar<'a>, effects: &mut Effects<'_>) -> Scalar<'a> {
    let [k, c, preload] = ["stiffness", "damping", "preload"].map(|property| spring.get_or_zero(property));
    let rate = effects.rate(s);
    let tension = (preload + k * s + c * rate).shared();
    effects.store(k, s);
    if !preload.is_zero() {
        effects.energies.push((preload * s).expr());
    }
    effects.apply(-tension, s);
    tension
}

/// A spring without length: it pulls with k r + c ṙ along a single coordinate, else with k r and
/// c times the rate along r.
fn pull_together(spring: &Element<'_>, effects: &mut Effects<'_>) {
    let (k, c) = (spring.get_or_zero("stiffness"), spring.get_or_zero("damping"));
    let r = between(spring);
    let rate = r.map(|component| effects.rate(component));
    for component in r.components() {
        effects.store(k, component);
    }
    let opening = if let Some((s, rate)) = only(r, rate) {
        effects.apply(-(k * s + c * rate), s);
        // from s = 0 on the places move apart
        let is_apart = s.sign().squared();
        s.sign() * rate + (1 - is_apart) * rate.abs()
    } else {
        let (squares, [along, across]) = (r.dot(r), shares_along(r, rate));
        for (component, rate) in r.components().into_iter().zip(rate.components()) {
            effects.apply(-((k + c * along) * component + c * across * rate), component);
        }
        // 0 at rest, where the norm is kept from its kink
        let speed = rate.dot(rate) / norm(rate);
        squares * (squares + r.x.algebra().number(COINCIDENT)).sqrt().powi(-1) * along + across * speed
    };
    let length = spring.first.distance_to(spring.second);
    effects.exert(k * length + c * opening, FORCE);
}

/// The component that a vector has, with its rate, if the other one is always 0.
fn only<'a>(r: Vector<Scalar<'a>>, rate: Vector<Scalar<'a>>) -> Option<(Scalar<'a>, Scalar<'a>)> {
    match (r.x.is_zero(), r.y.is_zero()) {
        (_, true) => Some((r.x, rate.x)),
        (true, false) => Some((r.y, rate.y)),
        (false, false) => None,
    }
}

/// The shares a and b of the rate along r, which is a r + b ṙ: (r·ṙ) r/|r|², and ṙ where |r| ≪ ε,
///
/// ```text
/// (r (r·ṙ) + ε² ṙ)/(|r|² + ε²)
/// ```
///
/// A rate along r is kept as it is, however long r is. Of one across it ε²/(|r|² + ε²) is left, a
/// rounding from 10 mm on.
fn shares_along<'a>(r: Vector<Scalar<'a>>, rate: Vector<Scalar<'a>>) -> [Scalar<'a>; 2] {
    let algebra = r.x.algebra();
    let coincident = algebra.number(COINCIDENT);
    let squares = r.components().map(|component| component.squared());
    let inverse = algebra.sum(squares.into_iter().chain([coincident])).powi(-1).shared();
    [(inverse * r.dot(rate)).shared(), (inverse * coincident).shared()]
}
