//! Compliant contact of two outlines, by circles that touch the other one ([`pairs`]): a circle itself, or corners.
//!
//! With the distance g of the outlines and the normal n from the second to the first, the penetration is δ = −g. Where it is
//! positive, the first body is pushed along n by N, which is not less than 0:
//!
//! * `stiffness` k: N = k δ + c δ̇, with a `damping` c.
//! * `modulus` E*: N = K δ^(3/2), K = ⁴⁄₃ E* √R, `law = hertz` of spheres, which need not be said; 1/R is the sum of the curvatures.
//! * With a `restitution` e at a `speed` v₀ both are multiplied by 1 + χ δ̇/v₀. By Hunt and Crossley (1975) χ is 3(1 − e)/2, by
//!   Lankarani and Nikravesh (1990) 3(1 − e²)/4, by Flores, Machado, Silva and Martins (2011) 8(1 − e)/(5e).
//!
//! Friction is −μ N tanh(v/v_t), v the speed of sliding at the point of contact, in the middle of
//! the penetration.

use mbs_symbolic::Scalar;
use mbs_symbolic::units::Dimension;

use super::nearest::{Nearest, Pair, pairs};
use super::properties::{FORCE, Given, Property, SPEED, Unsaid};
use super::{Effects, Element, ElementKind, Places};
use crate::mechanics::Outline;

const LAW: &str = "law";
const HUNT_CROSSLEY: &str = "hunt_crossley";
const LANKARANI_NIKRAVESH: &str = "lankarani_nikravesh";
const FLORES: &str = "flores";
/// That of a `modulus` alone, which loses nothing.
const HERTZ: &str = "hertz";
const WORDS: &[&str] = &[HUNT_CROSSLEY, LANKARANI_NIKRAVESH, FLORES, HERTZ];
const EXAMPLE: &str =
    "{ stiffness = 1 [MN/m]; restitution = 0.6; speed = 1 [m/s]; coefficient = 0.3; transition = 1 [mm/s]; }";

/// The properties of a contact, behind others.
macro_rules! properties {
    ($($size:literal),*) => {
        &[
            $(Property::fixed($size, Dimension::LENGTH).positive(),)*
            Property::word(LAW, WORDS),
            Property::fixed("stiffness", Dimension::of(1, 0, -2)).positive(),
            Property::fixed("modulus", Dimension::of(1, -1, -2)).positive(),
            Property::fixed("damping", Dimension::of(1, 0, -1)).not_negative(),
            Property::fixed("restitution", Dimension::NONE).share(),
            Property::fixed("speed", SPEED).positive(),
            Property::varying("coefficient", Dimension::NONE).not_negative(),
            Property::fixed("transition", SPEED).positive(),
        ]
    };
}

pub const CONTACT: ElementKind = ElementKind {
    word: "contact",
    meaning: "pushes outlines apart where they touch, and rubs",
    example: "(wheel.rim, ground.floor) { stiffness = 1 [MN/m]; restitution = 0.6; speed = 1 [m/s]; }",
    places: Places::Two,
    properties: properties!(),
    said,
    knows: &[],
    moved: |contact| (contact.first.position - contact.second.position).components().into(),
    mend: "let it act between bodies that move against each other",
    needs: None,
    refuses,
    forces: act,
};

/// A pin with play in its bore.
pub const LOOSE_REVOLUTE: ElementKind = ElementKind {
    word: "revolute",
    example: "(crank.tip, rod.eye) clearance = 0.1 [mm] { radius = 10 [mm]; modulus = 1 [GPa]; restitution = 0.9; speed = 0.1 [m/s]; }",
    properties: properties!("clearance", "radius"),
    said: |given| {
        given.all(
            &["radius"],
            "{ radius = 10 [mm]; modulus = 1 [GPa]; restitution = 0.9; speed = 0.1 [m/s]; }",
        )?;
        said(given)
    },
    ..CONTACT
};

/// A block with play in its guide.
pub const LOOSE_PRISMATIC: ElementKind = ElementKind {
    word: "prismatic",
    example: "(slider, ground) along (1, 0) clearance = 1 [mm] { length = 100 [mm]; height = 50 [mm]; stiffness = 10 [MN/m]; damping = 1 [kN*s/m]; }",
    properties: properties!("clearance", "length", "height"),
    said: |given| {
        given.all(
            &["length", "height"],
            "{ length = 100 [mm]; height = 50 [mm]; stiffness = 10 [MN/m]; damping = 1 [kN*s/m]; }",
        )?;
        said(given)
    },
    ..CONTACT
};

fn said(given: &Given<'_>) -> Result<(), Unsaid> {
    for (first, second, keep) in [
        ("stiffness", "modulus", "keep one of them: a force of the penetration, or of its power 3/2"),
        ("damping", "restitution", "keep one of them: a force of the speed, or one of speed and penetration"),
    ] {
        if given.has(first) && given.has(second) {
            return Err(Unsaid::Twice { first, second, keep });
        }
    }
    if !given.has("modulus") && !given.has("stiffness") {
        let what = "`stiffness` or `modulus`".to_owned();
        return Err(Unsaid::Missing { what, example: EXAMPLE.to_owned() });
    }
    let is_hertz = given.word(LAW) == Some(HERTZ);
    if is_hertz {
        if let Some(property) = ["restitution", "speed"].into_iter().find(|property| given.has(property)) {
            let others = WORDS.iter().copied().filter(|word| *word != HERTZ).collect();
            return Err(Unsaid::OfOthers { property, word: HERTZ, others });
        }
        for (second, keep) in [
            ("stiffness", "`law = hertz` takes a `modulus`: keep one of them"),
            ("damping", "`law = hertz` loses nothing: keep one of them"),
        ] {
            if given.has(second) {
                return Err(Unsaid::Twice { first: LAW, second, keep });
            }
        }
    }
    let of_law = if is_hertz { "modulus" } else { "restitution" };
    let pairs = [("restitution", "speed"), ("speed", "restitution"), (LAW, of_law)];
    for (of, needed) in
        pairs.into_iter().chain([("coefficient", "transition"), ("transition", "coefficient")])
    {
        if given.has(of) {
            given.all(&[needed], EXAMPLE)?;
        }
    }
    Ok(())
}

fn refuses(contact: &Element<'_>) -> Option<[&'static str; 2]> {
    let pairs = pairs(contact);
    // that sizes of a joint with play are missing has its error
    if pairs.is_empty() && contact.get("clearance").is_none() {
        return Some([
            "is between outlines that no contact knows",
            "a point or a `circle` touches every outline; corners of a `segment` or a `polygon` touch a `line`, a `bore`, a \
             `segment` or a `polygon`",
        ]);
    }
    let has_circle = contact.outlines.iter().any(|outline| matches!(outline, Outline::Circle { .. }));
    if !has_circle && pairs.iter().any(Pair::is_sharp) {
        return Some([
            "is between sharp corners, which slip past each other's sides",
            "give one of both outlines a `radius`, larger than they are pressed together: `… to (a, b) radius 1 [mm];`",
        ]);
    }
    if pairs.iter().any(Pair::is_thin) {
        return Some([
            "is between outlines without thickness, which touch nowhere",
            "give one of them a radius: `circle rim on wheel = (0, 0) radius r;`",
        ]);
    }
    let is_dead = contact.get("restitution").is_some_and(Scalar::is_zero);
    if is_dead && contact.words.get(LAW) == Some(&FLORES) {
        return Some([
            "divides by its `restitution`, which is 0",
            "take `law = hunt_crossley;`, or a `damping`",
        ]);
    }
    let is_pointed = contact.get("modulus").is_some() && pairs.iter().any(Pair::is_pointed);
    is_pointed.then_some([
        "has a `modulus` and a point, which has no curvature",
        "give it a radius, or the contact a `stiffness`",
    ])
}

fn act<'a>(contact: &Element<'a>, effects: &mut Effects<'_>) -> Option<()> {
    let pushes =
        pairs(contact).iter().map(|pair| push_apart(contact, pair, effects)).collect::<Option<Vec<_>>>()?;
    effects.exert(contact.algebra.sum(pushes), FORCE);
    Some(())
}

/// Applies the forces between a circle and what it touches, and gives the normal one.
fn push_apart<'a>(contact: &Element<'a>, pair: &Pair<'a>, effects: &mut Effects<'_>) -> Option<Scalar<'a>> {
    let Nearest { normal, distance, arm: [ahead, aside] } = pair.nearest();
    let Pair { circle, radius, other, .. } = *pair;
    let (d, tangent) = (circle.position - other.position, -normal.perpendicular());
    let rates = d.map(|component| effects.rate(component));
    let [spin, other_spin] = [circle.angle, other.angle].map(|angle| effects.rate(angle));
    let parting = normal.dot(rates) - aside * other_spin;
    let depth = (-distance).shared();
    let push = pushed(contact, pair, [depth, -parting], effects)?.shared();
    let (mut force, mut moments) = (push * normal, [contact.algebra.number(0), -aside * push]);
    if let (Some(coefficient), Some(transition)) = (contact.get("coefficient"), contact.get("transition")) {
        // the point of contact is in the middle of the penetration
        let reach = (radius - depth / 2).shared();
        let ahead = ahead - reach;
        let slip = tangent.dot(rates) + reach * spin + ahead * other_spin;
        let rub = (-(coefficient * push * (slip / transition).tanh())).shared();
        force = force + rub * tangent;
        moments = [reach * rub, moments[1] + ahead * rub];
    }
    effects.apply(force.x, d.x);
    effects.apply(force.y, d.y);
    effects.apply(moments[0], circle.angle);
    effects.apply(moments[1], other.angle);
    Some(push)
}

/// N ≥ 0 of a penetration and its rate; what is elastic in it is stored.
fn pushed<'a>(
    contact: &Element<'a>,
    pair: &Pair<'a>,
    [depth, rate]: [Scalar<'a>; 2],
    effects: &mut Effects<'_>,
) -> Option<Scalar<'a>> {
    let number = |value: i64| contact.algebra.number(value);
    let zero = number(0);
    let touches = depth.greater(zero).shared();
    let (press, energy) = match (contact.get("stiffness"), contact.get("modulus")) {
        (Some(stiffness), _) => (stiffness * depth, stiffness * depth.squared() / 2),
        (_, Some(modulus)) => {
            // the root of what is gated
            let root = (zero.max(depth) / pair.curvature()).sqrt();
            let press = (number(4) * modulus / 3 * root * depth).shared();
            (press, number(2) * press * depth / 5)
        }
        _ => return None,
    };
    effects.energies.push(touches.gate(energy).expr());
    let push = match (contact.get("restitution"), contact.get("speed"), contact.get("damping")) {
        (Some(e), Some(speed), _) => {
            let lost = number(1) - e;
            let factor = match contact.words.get(LAW).copied() {
                Some(LANKARANI_NIKRAVESH) => number(3) * (number(1) - e.squared()) / 4,
                Some(FLORES) => number(8) * lost / (number(5) * e),
                _ => number(3) * lost / 2,
            };
            press * (number(1) + factor / speed * rate)
        }
        (_, _, Some(damping)) => press + damping * rate,
        _ => press,
    };
    Some(touches.gate(zero.max(push)))
}
