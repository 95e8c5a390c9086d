//! A pinion, the first body, meshes with a rack on the second one, along the
//! direction u of the second: Φ = u·(p₁ − p₂) + r(φ₁ − φ₂) − at (Nikravesh 1988,
//! ch. 4). The rack is on the right of u: its pitch line touches the pinion in
//! p₁ − r n, n = u turned by 90°.
//!
//! λ: the tooth force on the rack is λ u at that point; the pinion feels −λ u
//! there, and so a torque of −rλ about its centre.

use mbs_symbolic::Scalar;

use super::{ClauseKind, Holds, Joint, JointKind, Part, Row};

pub const RACK: JointKind = JointKind {
    word: "rack",
    meaning: "a pinion meshes with a rack",
    example: "(pinion, bar) along (1, 0) radius 15 [mm]",
    needs: &[&[ClauseKind::Along], &[ClauseKind::Radius]],
    takes: &[ClauseKind::Place],
    rows: &[MESH],
    turns: &[(Part::First, Part::Second)],
    ..JointKind::PLAIN
};

pub const MESH: Row = Row {
    suffix: "",
    restricts: "",
    holds: Holds::Length,
    phi,
    wrench: Some(|joint| joint.force_along_line()),
};

fn phi<'a>(joint: &Joint<'a>) -> Scalar<'a> {
    let [radius, _] = joint.sizes;
    joint.along_line() + radius * joint.relative_angle() - joint.at
}
