//! Dry and viscous friction, along a direction or about a pin, at the sliding speed v.
//!
//! * `law = smooth`: F = −(μ |N| tanh(v/v_t) + c v). The hyperbolic tangent stands for the sign of v: below the transition
//!   speed v_t the friction is a stiff damper, so what should stick creeps at up to v_t.
//! * `law = coulomb`: F = −(μ |N| s + c v), s = ±1 the direction of sliding, which a run keeps in a memory. Where s = 0 it
//!   sticks: F is what keeps v = 0, up to μ₀ |N|.
//! * `law = lugre`: F = −(μ |N| (z + τ ż)/z_c + c v), ż = v − |v| z/(z_c g), g = 1 + (μ₀/μ − 1) exp(−(v/v_s)²). The own
//!   state z is how far the bristles between the surfaces are bent (Canudas de Wit, Olsson, Åström and Lischinsky 1995,
//!   whose σ₀ is μ |N|/z_c and σ₁ is τ σ₀).

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Function, Scalar, Stage};

use super::properties::{FORCE, Given, Property, RATE, SPEED, TORQUE, Unsaid};
use super::{Effects, Element, ElementKind, Freedom, Places, Sticks};
use crate::mechanics::joints::Holds;

const LAW: &str = "law";
const SMOOTH: &str = "smooth";
/// The law of friction that sticks.
pub const COULOMB: &str = "coulomb";
/// The law of friction by bristles that bend.
pub const LUGRE: &str = "lugre";
const WORDS: &[&str] = &[SMOOTH, COULOMB, LUGRE];
const TRANSITION: &str = "transition";
const STATIC: &str = "static";
const BREAKAWAY: &str = "breakaway";
/// The bend of bristles that slide.
pub const PRESLIDING: &str = "presliding";
const RELAXATION: &str = "relaxation";
const STRIBECK: &str = "stribeck";

/// The largest friction, and that of sliding.
const LARGEST: [(&str, &str); 2] = [(STATIC, "coefficient"), (BREAKAWAY, "torque")];

/// True of a friction of sliding by which bristles divide the largest one.
pub fn is_divisor(property: &str, has: impl Fn(&str) -> bool) -> bool {
    LARGEST.iter().any(|(most, of)| *of == property && has(most)) && has(PRESLIDING)
}

/// A law of dry friction.
struct Law {
    word: &'static str,
    /// The properties that not all laws have.
    has: &'static [&'static str],
    /// Those without which it says nothing.
    needs: &'static [&'static str],
}

const LAWS: [Law; 3] = [
    Law { word: SMOOTH, has: &[TRANSITION], needs: &[TRANSITION] },
    Law { word: COULOMB, has: &[STATIC, BREAKAWAY], needs: &[] },
    Law { word: LUGRE, has: &[STATIC, BREAKAWAY, PRESLIDING, RELAXATION, STRIBECK], needs: &[PRESLIDING] },
];

pub const FRICTION: ElementKind = ElementKind {
    word: "friction",
    meaning: "brakes what slides",
    example: "(block, ground) along (1, 0) { coefficient = 0.3; normal = 20 [N]; transition = 1e-3 [m/s]; }",
    places: Places::TwoAlong,
    properties: &[
        Property::word(LAW, WORDS),
        Property::varying("coefficient", Dimension::NONE).not_negative(),
        Property::varying(STATIC, Dimension::NONE).not_negative(),
        Property::varying("normal", FORCE),
        Property::fixed(TRANSITION, SPEED).positive(),
        Property::fixed(PRESLIDING, Dimension::LENGTH).positive(),
        Property::fixed(RELAXATION, Dimension::TIME).not_negative(),
        Property::fixed(STRIBECK, SPEED).positive(),
        Property::varying("viscous", Dimension::of(1, 0, -1)).not_negative(),
    ],
    said: |given| {
        let example = "{ coefficient = 0.3; normal = 20 [N]; … }";
        let of_laws = ["transition = 1e-3 [m/s];", "presliding = 10 [um];"];
        is_said(given, &["coefficient", "normal"], [example; 2], of_laws)
    },
    knows: &[],
    moved: |friction| vec![slide(friction)],
    mend: "let it act where two bodies slide along each other",
    needs: Some(Freedom {
        from: Holds::Place,
        verb: "slides",
        mend: "friction of a pin is `torsion_friction`",
    }),
    refuses: |_| None,
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
        Property::word(LAW, WORDS),
        Property::varying("torque", TORQUE).not_negative(),
        Property::varying(BREAKAWAY, TORQUE).not_negative(),
        Property::varying("coefficient", Dimension::NONE).not_negative(),
        Property::varying(STATIC, Dimension::NONE).not_negative(),
        Property::varying("normal", FORCE),
        Property::fixed("radius", Dimension::LENGTH).not_negative(),
        Property::fixed(TRANSITION, RATE).positive(),
        Property::angle(PRESLIDING).positive(),
        Property::fixed(RELAXATION, Dimension::TIME).not_negative(),
        Property::fixed(STRIBECK, RATE).positive(),
        Property::varying("viscous", Dimension::of(1, 2, -1)).not_negative(),
    ],
    said: |given| {
        let by_torque = "{ torque = 0.1 [N*m]; … }";
        let by_force = "{ coefficient = 0.1; normal = 20 [N]; radius = 5 [mm]; … }";
        let of_laws = ["transition = 0.1 [rad/s];", "presliding = 0.1 [deg];"];
        is_said(given, &["coefficient", "normal", "radius"], [by_torque, by_force], of_laws)
    },
    knows: &[],
    moved: |friction| vec![friction.relative_angle()],
    mend: "one of its bodies has to turn",
    needs: Some(Freedom { from: Holds::Angle, verb: "turns", mend: "friction of a guide is `friction`" }),
    refuses: |_| None,
    forces: |friction, effects| {
        let torque = resist(friction, friction.relative_angle(), effects);
        effects.exert(torque, TORQUE);
        Some(())
    },
};

/// Either all of the dry part is given, `dry` or a torque, with what its law needs, or the viscous
/// part alone. Of the examples, the second has the properties `dry`; both have … where those of a law stand.
fn is_said(
    given: &Given<'_>,
    dry: &'static [&'static str],
    examples: [&str; 2],
    [transition, presliding]: [&str; 2],
) -> Result<(), Unsaid> {
    let of_dry = dry.iter().find(|name| given.has(name));
    if let (true, Some(second)) = (given.has("torque"), of_dry) {
        let keep = "give `torque`, or `coefficient`, `normal` and `radius`";
        return Err(Unsaid::Twice { first: "torque", second, keep });
    }
    let of_laws = LAWS.iter().flat_map(|law| law.has).find(|name| given.has(name));
    let is_dry = of_dry.is_some() || of_laws.is_some() || given.has("torque") || given.has(LAW);
    if !is_dry && given.has("viscous") {
        return Ok(());
    }
    let word = given.word(LAW).unwrap_or(SMOOTH);
    let Some(law) = LAWS.iter().find(|law| law.word == word) else { return Ok(()) };
    let of_law = match word {
        SMOOTH => transition.to_owned(),
        LUGRE => format!("{presliding} law = {LUGRE};"),
        _ => format!("law = {word};"),
    };
    let example = examples[usize::from(of_dry.is_some())].replace('…', &of_law);
    if !given.has("torque") {
        given.all(dry, &example)?;
    }
    let is_of_others = |name: &&&str| given.has(name) && !law.has.contains(name);
    if let Some(property) = LAWS.iter().flat_map(|law| law.has).find(is_of_others) {
        let others = LAWS.iter().filter(|law| law.has.contains(property)).map(|law| law.word).collect();
        return Err(Unsaid::OfOthers { property, word, others });
    }
    given.all(law.needs, &example)?;
    largest_is_said(given, word)
}

/// The largest friction stands beside that of sliding. Bristles have the speed at which it is lost, too.
fn largest_is_said(given: &Given<'_>, word: &str) -> Result<(), Unsaid> {
    let largest = LARGEST.into_iter().find(|(most, _)| given.has(most));
    let missing = match largest {
        Some((most, of)) if !given.has(of) => Some((of, most)),
        Some((most, _)) if word == LUGRE && !given.has(STRIBECK) => Some((STRIBECK, most)),
        None if given.has(STRIBECK) => Some((if given.has("torque") { BREAKAWAY } else { STATIC }, STRIBECK)),
        _ => None,
    };
    let Some((missing, beside)) = missing else { return Ok(()) };
    let what = format!("`{missing}`, which a `{beside}` needs beside it");
    Err(Unsaid::Missing { what, example: format!("{{ {missing} = …; {beside} = …; law = {word}; }}") })
}

/// u·(p₁ − p₂): how far the first place is along the direction on the
/// second body. Its variation is what the friction force does work along,
/// with the reaction at the first place.
fn slide<'a>(friction: &Element<'a>) -> Scalar<'a> {
    friction.first.offset_along(friction.second, friction.along)
}

/// −(limit tanh(v/v_t) + c v) for the motion s, or by one of the other laws, applied.
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
    if let (Some(limit), Some(transition)) = (limit, friction.get(TRANSITION)) {
        force = force - limit * (speed / transition).tanh();
    }
    if let (Some(limit), Some(bent)) = (limit, bristles(friction, speed, effects)) {
        force = force - limit * bent;
    }
    let force = force.shared();
    effects.apply(force, s);
    force
}

/// (z + τ ż)/z_c: how far bristles are bent, as a share of how far they are while they slide.
fn bristles<'a>(friction: &Element<'a>, speed: Scalar<'a>, effects: &mut Effects<'_>) -> Option<Scalar<'a>> {
    let (z, sliding) = (friction.algebra.scalar(friction.state?), friction.get(PRESLIDING)?);
    let one = friction.algebra.number(1);
    let ratio = |most, of| Some(friction.get(most)? / friction.get(of)?);
    let largest = ratio(STATIC, "coefficient").or_else(|| ratio(BREAKAWAY, "torque"));
    let weakening = match (largest, friction.get(STRIBECK)) {
        (Some(largest), Some(stribeck)) => {
            one + (largest.max(one) - one) * (-(speed / stribeck).squared()).exp()
        }
        _ => one,
    };
    let share = (z / sliding).shared();
    let rate = (speed - speed.abs() * share / weakening).shared();
    effects.state_rate = Some(rate.expr());
    let relaxation = friction.get_or_zero(RELAXATION);
    Some(share + relaxation * rate / sliding)
}

/// A size that counts as 0 where it varies and becomes negative: friction does not push.
fn braking(size: Scalar<'_>) -> Scalar<'_> {
    let is_negative_nowhere = matches!(size.function(), Some(Function::Abs | Function::Sqrt | Function::Exp));
    if is_negative_nowhere || size.stage() < Stage::Variable {
        size
    } else {
        size.max(size.algebra().number(0))
    }
}

/// The largest dry friction: μ |N|, times the radius of a pin; or as given.
fn dry_limit<'a>(friction: &Element<'a>, torque: &str, coefficient: &str) -> Option<Scalar<'a>> {
    if let Some(torque) = friction.get(torque) {
        return Some(braking(torque));
    }
    let (coefficient, normal) = (braking(friction.get(coefficient)?), friction.get("normal")?);
    let normal = match normal.function() {
        // The size of a reaction is one already.
        Some(Function::Abs | Function::Sqrt) => normal,
        _ => normal.abs(),
    };
    let radius = friction.get("radius").unwrap_or_else(|| friction.algebra.number(1));
    Some(coefficient * normal * radius)
}
