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
mod point_on_line;
mod prismatic;
mod rack;
mod revolute;
mod rolling;

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Scalar, Vector};

pub use clauses::ClauseKind;
pub use connection::{Connection, Joint, Part};

/// Every kind of joint.
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

/// A kind of joint between two places.
pub struct JointKind {
    /// The word that declares it.
    pub word: &'static str,
    /// Its effect in words.
    pub meaning: &'static str,
    /// Another word for it, and what that says it does.
    pub also: Option<(&'static str, &'static str)>,
    /// How its places and clauses are written.
    pub example: &'static str,
    /// Of each of these groups, one clause is needed and no other is taken.
    pub needs: &'static [&'static [ClauseKind]],
    /// Clauses that may be left out.
    pub takes: &'static [ClauseKind],
    /// Its equations, in the order of their names.
    pub rows: &'static [Row],
    /// The parts that have to be able to turn, each with the part against which it turns.
    pub turns: &'static [(Part, Part)],
    /// The remedy for a row in which nothing can move.
    pub mend: Mend,
}

/// An equation Φ = 0 of a joint.
#[derive(Clone, Copy)]
pub struct Row {
    /// The end of the name of the row behind that of the joint, as in `pin_x`.
    pub suffix: &'static str,
    /// The restricted direction in words, such as ` along x`; it may be empty.
    pub restricts: &'static str,
    pub holds: Holds,
    pub phi: for<'a> fn(&Joint<'a>) -> Scalar<'a>,
    /// The wrench on the second body for λ = 1. `None` unless the first body feels the opposite at a
    /// known place.
    pub wrench: Option<for<'a> fn(&Joint<'a>) -> Wrench<'a>>,
}

/// The kind of quantity that a row holds.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Holds {
    /// A component of the place that both bodies have in common.
    Place,
    /// Another length.
    Length,
    /// The angle between the bodies.
    Angle,
    /// How far bodies turn, times their sizes.
    Turns,
}

/// A force or a torque on the second body; the first feels the opposite.
#[derive(Clone, Copy)]
pub enum Wrench<'a> {
    /// In the ground frame.
    Force(Vector<Scalar<'a>>),
    Torque(Scalar<'a>),
}

/// A remedy for a row in which nothing can move.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Mend {
    /// Remove the joint.
    Remove,
    /// Remove it, or give its first body the position that is missing.
    RemoveOrMove,
    /// Give its first body the position that is missing, for this reason.
    Move(&'static str),
}

impl JointKind {
    /// A joint without clauses, to which nothing turns.
    const PLAIN: Self = Self {
        word: "",
        meaning: "",
        also: None,
        example: "",
        needs: &[],
        takes: &[],
        rows: &[],
        turns: &[],
        mend: Mend::Remove,
    };

    /// Its words, each with what it says that the joint does.
    pub fn words(&self) -> impl Iterator<Item = (&'static str, &'static str)> {
        [(self.word, self.meaning)].into_iter().chain(self.also)
    }

    /// All clauses that it takes.
    pub fn clauses(&self) -> impl Iterator<Item = ClauseKind> {
        self.needs.iter().copied().flatten().chain(self.takes).copied()
    }

    /// True if it leaves no motion of this kind between its places.
    pub fn holds(&self, what: Holds) -> bool {
        self.rows.iter().any(|row| row.holds == what)
    }
}

impl Row {
    /// Its dimension, where sizes of bodies have the given one.
    pub fn dimension(&self, sizes: Dimension) -> Dimension {
        match self.holds {
            Holds::Place | Holds::Length => Dimension::LENGTH,
            Holds::Angle => Dimension::NONE,
            Holds::Turns => sizes,
        }
    }
}

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
