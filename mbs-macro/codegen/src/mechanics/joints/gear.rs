//! Two gears in mesh on a carrier (the ground, if none is given), whose pitch
//! circles roll on each other: Φ = r₁(φ₁ − φ_c − at) ± r₂(φ₂ − φ_c), plus for
//! teeth outside on both, minus where one is a ring with teeth inside. This is
//! Willis' equation of a planetary train, integrated (Norton, Design of
//! Machinery; Nikravesh 1988, ch. 4).
//!
//! λ with `radii`: the tooth force on the second gear at the pitch point, along
//! n, the unit vector from the first centre to the pitch point turned by 90°;
//! the first feels −λ n. So the torques are −r₁λ on the first gear, ∓r₂λ on the
//! second, and (r₁ ± r₂)λ on the carrier. With `teeth`, Φ is divided by r₁ and
//! λ a torque: −λ on the first gear, ∓λ z₂/z₁ on the second, (1 ± z₂/z₁)λ on the
//! carrier.
//!
//! These torques are all that the row exerts. A tooth force at the pitch point
//! is such a torque and the same force at the centre, where the bearing takes
//! it: the multipliers of bearings are without it, and what they would carry of
//! it turns the carrier by the torque above.

use super::{ClauseKind, Holds, JointKind, Part, Row};

pub const GEAR: JointKind = JointKind {
    word: "gear",
    meaning: "two gears turn against each other",
    example: "(sun, planet) radii (20 [mm], 40 [mm]) carrier arm",
    needs: &[&[ClauseKind::Radii, ClauseKind::Teeth]],
    takes: &[ClauseKind::Carrier, ClauseKind::Angle],
    rows: &[OPPOSITE],
    turns: &[(Part::First, Part::Carrier), (Part::Second, Part::Carrier)],
    ..JointKind::PLAIN
};

pub const INTERNAL_GEAR: JointKind = JointKind {
    word: "internal_gear",
    meaning: "a gear turns in a ring",
    example: "(ring, planet) radii (80 [mm], 20 [mm]) carrier arm",
    rows: &[SAME_WAY],
    ..GEAR
};

/// The bodies turn against each other.
pub const OPPOSITE: Row = Row {
    suffix: "",
    restricts: "",
    holds: Holds::Turns,
    phi: |joint| {
        let [first, second] = joint.turns();
        first + second
    },
    wrench: None,
};

/// The bodies turn the same way.
pub const SAME_WAY: Row = Row {
    phi: |joint| {
        let [first, second] = joint.turns();
        first - second
    },
    ..OPPOSITE
};
