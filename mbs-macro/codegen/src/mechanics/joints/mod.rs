//! Joints, a file each: how they are declared, their rows and what these exert. A new
//! joint is such a file and a row of [`JOINTS`].
//!
//! A row is Φ with its multiplier's meaning: the generalized constraint forces
//! are −Φ_qᵀ λ, so a row Φ = p₁ − p₂ has in λ the force that acts on the second
//! body at p₂, while the first feels −λ.

mod belt;
mod cam;
mod clauses;
mod connection;
mod distance;
mod fixed;
mod gear;
mod kind;
mod point_on_line;
mod prismatic;
mod rack;
mod revolute;
mod rolling;

pub use clauses::ClauseKind;
pub use connection::{Connection, Joint, Part, Wrench};
pub use kind::{Holds, JointKind, Mend, Row};

/// Every kind of joint.
/// The name of the polar angle in the profile of a cam.
pub const POLAR_ANGLE: &str = "angle";

pub const JOINTS: &[&JointKind] = &[
    &revolute::REVOLUTE,
    &fixed::FIXED,
    &prismatic::PRISMATIC,
    &point_on_line::POINT_ON_LINE,
    &distance::DISTANCE,
    &gear::GEAR,
    &gear::INTERNAL_GEAR,
    &belt::BELT,
    &belt::CROSSED_BELT,
    &rack::RACK,
    &rolling::ROLLING,
    &cam::CAM,
];

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::{ClauseKind, JOINTS, JointKind};

    fn differ<T: Ord>(mut all: impl Iterator<Item = T>) -> bool {
        let mut known = BTreeSet::new();
        all.all(|one| known.insert(one))
    }

    /// Every kind has words, an example and rows, and nothing is named twice.
    #[test]
    fn every_kind_is_whole() {
        assert!(differ(JOINTS.iter().flat_map(|kind| kind.words().map(|(word, _)| word))));
        for kind in JOINTS {
            let JointKind { word, example, rows, .. } = kind;
            assert!(kind.words().all(|(word, meaning)| !word.is_empty() && !meaning.is_empty()));
            assert!(!example.is_empty() && !rows.is_empty(), "{word}");
            assert!(differ(rows.iter().map(|row| row.suffix)), "{word}");
            assert!(differ(kind.clauses().map(ClauseKind::word)), "{word}");
        }
    }
}
