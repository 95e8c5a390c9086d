//! Two pulleys with a belt that neither slips nor stretches, on a carrier (the
//! ground, if none is given): Φ = r₁(φ₁ − φ_c − at) ∓ r₂(φ₂ − φ_c), minus for an
//! open belt, plus for a crossed one (Norton, Design of Machinery).
//!
//! λ with `radii`: the difference between the tensions of the two spans, positive
//! where the belt drives the second pulley of an open belt on in its positive
//! sense. So the torques are −r₁λ on the first pulley, ±r₂λ on the second, and
//! (r₁ ∓ r₂)λ on the carrier. With `teeth`, Φ is divided by r₁ and λ a torque:
//! −λ on the first, ±λ z₂/z₁ on the second. The sum of the tensions is not
//! determined by the motion, and bearings are without the belt's pull.

use super::JointKind;
use super::gear::{GEAR, OPPOSITE, SAME_WAY};

pub const BELT: JointKind = JointKind {
    word: "belt",
    meaning: "two pulleys turn the same way",
    example: "(driver, driven) radii (30 [mm], 60 [mm])",
    rows: &[SAME_WAY],
    ..GEAR
};

pub const CROSSED_BELT: JointKind =
    JointKind { word: "crossed_belt", meaning: "two pulleys turn opposite ways", rows: &[OPPOSITE], ..BELT };
