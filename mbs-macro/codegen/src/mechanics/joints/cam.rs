//! A point of the second body (a knife edge, or the centre of a roller on its
//! pitch curve) stays on a curve that is fixed in the first, the cam, in polar
//! form about p₁: Φ = ρ(ψ) − |d|, with d = p₂ − p₁ and the polar angle
//! ψ = atan2(d) − φ₁ (Norton, Cam Design and Manufacturing Handbook). The
//! arctangent jumps by a turn where d points to −x: ρ has to have that period.
//!
//! λ: the component of the contact force on the second body along d, positive
//! where the cam pushes it outward. The force is normal to the curve: along d
//! turned by 90° it is −λ ρ′/|d|. The cam feels the opposite at p₂, about p₁ a
//! torque of λρ′.

use super::{ClauseKind, Holds, JointKind, Row};

pub const CAM: JointKind = JointKind {
    word: "cam",
    meaning: "a point follows the profile of a cam",
    example: "(disk, follower.tip) = r0*(1 + 0.2*cos(angle))",
    needs: &[&[ClauseKind::Profile]],
    rows: &[Row {
        suffix: "",
        restricts: "",
        holds: Holds::Length,
        phi: |joint| joint.value - joint.first.distance_to(joint.second),
        wrench: None,
    }],
    ..JointKind::PLAIN
};
