//! Dry and viscous friction, along a direction or about a pin, at the sliding speed v.
//!
//! * `law = smooth`: F = −(μ |N| tanh(v/v_t) + c v). The hyperbolic tangent stands for the sign of v: below the transition
//!   speed v_t the friction is a stiff damper, so what should stick creeps at up to v_t.
//! * `law = coulomb`: F = −(μ |N| s + c v), s = ±1 the direction of sliding, which a run keeps in a memory. Where s = 0 it
//!   sticks: F is what keeps v = 0, up to μ₀ |N|.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Function, Scalar};

use super::properties::{FORCE, Given, Property, RATE, SPEED, TORQUE, Unsaid};
use super::{Effects, Element, ElementKind, Freedom, Places, Sticks};
use crate::mechanics::joints::Holds;

const LAW: &str = "law";
const SMOOTH: &str = "smooth";
/// The law of friction that sticks.
pub const COULOMB: &str = "coulomb";
const LAWS: &[&str] = &[SMOOTH, COULOMB];
const STATIC: &str = "static";
const BREAKAWAY: &str = "breakaway";

pub const FRICTION: ElementKind = ElementKind {
    word: "friction",
    meaning: "brakes what slides",
    example: "(block, ground) along (1, 0) { coefficient = 0.3; normal = 20 [N]; transition = 1e-3 [m/s]; }",
    places: Places::TwoAlong,
    properties: &[
        Property::word(LAW, LAWS),
        Property::varying("coefficient", Dimension::NONE).not_negative(),
        Property::varying(STATIC, Dimension::NONE).not_negative(),
        Property::varying("normal", FORCE),
        Property::fixed("transition", SPEED).positive(),
        Property::varying("viscous", Dimension::of(1, 0, -1)).not_negative(),
    ],
    said: |given| {
        let example = "{ coefficient = 0.3; normal = 20 [N]; transition = 1e-3 [m/s]; }";
        is_said(given, &["coefficient", "normal"], [example; 2])
    },
    knows: &[],
    moved: |friction| vec![slide(friction)],
    mend: "let it act where two bodies slide along each other",
    needs: Some(Freedom {
        from: Holds::Place,
        verb: "slides",
        mend: "friction of a pin is `torsion_friction`",
    }),
    forces: |friction, effects| {
        let force = resist(friction, slide(friction), effects);
        effects.exert(force, FORCE);
        Some(())
    },
};

pub const TORSION_FRICTION: ElementKind = ElementKind {
    word: "torsion_friction",
    meaning: "brakes what turns",
    example: "(arm, ground) { torque = 0.1 [N*m]; transition = 0.1 [rad/s]; }",
    places: Places::Two,
    properties: &[
        Property::word(LAW, LAWS),
        Property::varying("torque", TORQUE).not_negative(),
        Property::varying(BREAKAWAY, TORQUE).not_negative(),
        Property::varying("coefficient", Dimension::NONE).not_negative(),
        Property::varying(STATIC, Dimension::NONE).not_negative(),
        Property::varying("normal", FORCE),
        Property::fixed("radius", Dimension::LENGTH).not_negative(),
        Property::fixed("transition", RATE).positive(),
        Property::varying("viscous", Dimension::of(1, 2, -1)).not_negative(),
    ],
    said: |given| {
        let by_torque = "{ torque = 0.1 [N*m]; transition = 0.1 [rad/s]; }";
        let by_force = "{ coefficient = 0.1; normal = 20 [N]; radius = 5 [mm]; transition = 0.1 [rad/s]; }";
        is_said(given, &["coefficient", "normal", "radius"], [by_torque, by_force])
    },
    knows: &[],
    moved: |friction| vec![friction.relative_angle()],
    mend: "one of its bodies has to turn",
    needs: Some(Freedom { from: Holds::Angle, verb: "turns", mend: "friction of a guide is `friction`" }),
    forces: |friction, effects| {
        let torque = resist(friction, friction.relative_angle(), effects);
        effects.exert(torque, TORQUE);
        Some(())
    },
};

/// Either all of the dry part is given, `dry` or a torque with the transition,
/// or the viscous part alone. Of the examples, the second has the properties `dry`.
fn is_said(given: &Given<'_>, dry: &'static [&'static str], examples: [&str; 2]) -> Result<(), Unsaid> {
    let of_dry = dry.iter().find(|name| given.has(name));
    if let (true, Some(second)) = (given.has("torque"), of_dry) {
        let keep = "give `torque`, or `coefficient`, `normal` and `radius`";
        return Err(Unsaid::Twice { first: "torque", second, keep });
    }
    let example = examples[usize::from(of_dry.is_some())];
    let is_dry = given.has("torque") || of_dry.is_some() || given.has("transition") || given.has(LAW);
    if !is_dry && given.has("viscous") {
        return Ok(());
    }
    let sticking = example.replace("transition = 1e-3 [m/s]", "law = coulomb");
    let sticking = sticking.replace("transition = 0.1 [rad/s]", "law = coulomb");
    let example = if given.word(LAW) == Some(COULOMB) { &*sticking } else { example };
    if !given.has("torque") {
        given.all(dry, example)?;
    }
    let sticks = given.word(LAW) == Some(COULOMB);
    if sticks && given.has("transition") {
        let keep = "`law = coulomb` sticks and has no transition: leave it out";
        return Err(Unsaid::Twice { first: LAW, second: "transition", keep });
    }
    for (most, of) in [(STATIC, "coefficient"), (BREAKAWAY, "torque")] {
        if given.has(most) && !(sticks && given.has(of)) {
            let what = format!("`law = {COULOMB}` and its `{of}`, beside which it has a `{most}`");
            let example = format!("{{ {of} = …; {most} = …; law = {COULOMB}; }}");
            return Err(Unsaid::Missing { what, example });
        }
    }
    if sticks { Ok(()) } else { given.all(&["transition"], example) }
}

/// u·(p₁ − p₂): how far the first place is along the direction on the
/// second body. Its variation is what the friction force does work along,
/// with the reaction at the first place.
fn slide<'a>(friction: &Element<'a>) -> Scalar<'a> {
    friction.first.offset_along(friction.second, friction.along)
}

/// −(limit tanh(v/v_t) + c v) for the motion s, or −(limit d + c v) in a direction d, applied.
fn resist<'a>(friction: &Element<'a>, s: Scalar<'a>, effects: &mut Effects<'_>) -> Scalar<'a> {
    let limit = dry_limit(friction, "torque", "coefficient");
    let speed = effects.rate(s);
    let mut force = -(friction.get_or_zero("viscous") * speed);
    if let (Some(limit), Some([direction, held])) = (limit, friction.memories) {
        let [direction, held] = [direction, held].map(|memory| friction.algebra.scalar(memory));
        let limit = limit.shared();
        let most = dry_limit(friction, BREAKAWAY, STATIC).map_or(limit, |most| most.max(limit));
        effects.sticks = Some(Sticks { slip: s.expr(), limits: [limit.expr(), most.expr()] });
        let force = (force - limit * direction).shared();
        effects.apply(force, s);
        return force + held;
    }
    if let (Some(limit), Some(transition)) = (limit, friction.get("transition")) {
        force = force - limit * (speed / transition).tanh();
    }
    let force = force.shared();
    effects.apply(force, s);
    force
}

/// The largest dry friction: μ |N|, times the radius of a pin; or as given.
fn dry_limit<'a>(friction: &Element<'a>, torque: &str, coefficient: &str) -> Option<Scalar<'a>> {
    if let Some(torque) = friction.get(torque) {
        return Some(torque);
    }
    let (coefficient, normal) = (friction.get(coefficient)?, friction.get("normal")?);
    let normal = match normal.function() {
        // The size of a reaction is one already.
        Some(Function::Abs | Function::Sqrt) => normal,
        _ => normal.abs(),
    };
    let radius = friction.get("radius").unwrap_or_else(|| friction.algebra.number(1));
    Some(coefficient * normal * radius)
}
