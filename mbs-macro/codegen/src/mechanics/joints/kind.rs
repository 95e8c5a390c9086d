//! Kinds of joints, and their equations.

use mbs_symbolic::Scalar;
use mbs_symbolic::units::Dimension;

use super::clauses::ClauseKind;
use super::connection::{Joint, Part, Wrench};

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
    pub(super) const PLAIN: Self = Self {
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
