//! The clauses that joints can have behind their places.

use std::fmt;

/// A kind of clause.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClauseKind {
    /// A direction in the frame of the second body.
    Along,
    /// The angle between the bodies.
    Angle,
    /// The place on a line at which both angles are equal.
    Place,
    /// How far the places are apart.
    Distance,
    /// The polar radius of a cam.
    Profile,
    /// That of a body that rolls on a line.
    Radius,
    /// Those of two bodies that roll on each other.
    Radii,
    /// The same, counted.
    Teeth,
    /// The body relative to which the others turn.
    Carrier,
}

impl ClauseKind {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::Along,
        Self::Angle,
        Self::Place,
        Self::Radius,
        Self::Radii,
        Self::Teeth,
        Self::Carrier,
        Self::Distance,
        Self::Profile,
    ];

    /// Stands for the word of a clause that begins with `=`.
    pub const EQUALS: &'static str = "= …";

    /// The word with which it begins. A joint takes one kind of each word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Along => "along",
            Self::Angle | Self::Place => "at",
            Self::Distance | Self::Profile => Self::EQUALS,
            Self::Radius => "radius",
            Self::Radii => "radii",
            Self::Teeth => "teeth",
            Self::Carrier => "carrier",
        }
    }
}

impl fmt::Display for ClauseKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}`", self.word())
    }
}
