//! Properties of elements, and which of them are given.

use std::collections::BTreeMap;

use mbs_symbolic::units::Dimension;

pub const FORCE: Dimension = Dimension::of(1, 1, -2);
pub const TORQUE: Dimension = Dimension::of(1, 2, -2);
pub const RATE: Dimension = Dimension::of(0, 0, -1);
pub const SPEED: Dimension = Dimension::of(0, 1, -1);

/// A property of an element, and the values that it takes.
pub struct Property {
    pub name: &'static str,
    pub dimension: Dimension,
    /// True if it may change with the motion.
    pub varies: bool,
    pub range: Range,
    pub is_vector: bool,
    /// True if a bare number is meant in radians.
    pub is_angle: bool,
    /// The words of which it is one, in the place of a value.
    pub words: &'static [&'static str],
}

/// The values that make sense.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Range {
    All,
    NotNegative,
    Positive,
    /// From 0 to 1.
    Share,
}

impl Property {
    /// A value that may change with the motion.
    pub const fn varying(name: &'static str, dimension: Dimension) -> Self {
        let (range, words) = (Range::All, &[] as &[_]);
        Self { name, dimension, varies: true, range, is_vector: false, is_angle: false, words }
    }

    /// One of some words.
    pub const fn word(name: &'static str, words: &'static [&'static str]) -> Self {
        Self { words, ..Self::fixed(name, Dimension::NONE) }
    }

    /// A value in parameters and constants.
    pub const fn fixed(name: &'static str, dimension: Dimension) -> Self {
        Self { varies: false, ..Self::varying(name, dimension) }
    }

    /// A fixed angle.
    pub const fn angle(name: &'static str) -> Self {
        Self { is_angle: true, ..Self::fixed(name, Dimension::NONE) }
    }

    pub const fn not_negative(self) -> Self {
        Self { range: Range::NotNegative, ..self }
    }

    pub const fn share(self) -> Self {
        Self { range: Range::Share, ..self }
    }

    pub const fn positive(self) -> Self {
        Self { range: Range::Positive, ..self }
    }

    pub const fn vector(self) -> Self {
        Self { is_vector: true, ..self }
    }
}

/// The properties that a declaration gives.
pub struct Given<'g> {
    /// Each with whether it is written as the number 0.
    pub names: Vec<(&'g str, bool)>,
    /// Those that are words.
    pub words: BTreeMap<&'static str, &'static str>,
}

/// Why the properties do not say what the element does.
pub enum Unsaid {
    /// This is not given; with properties that are complete.
    Missing { what: String, example: String },
    /// Two properties say the same; with what to keep.
    Twice { first: &'static str, second: &'static str, keep: &'static str },
    /// A property of other laws than the one with this word.
    OfOthers { property: &'static str, word: &'static str, others: Vec<&'static str> },
}

impl Given<'_> {
    pub fn has(&self, name: &str) -> bool {
        self.names.iter().any(|(given, _)| *given == name)
    }

    /// True if it is given, and not as the number 0.
    pub fn has_some(&self, name: &str) -> bool {
        self.names.iter().any(|&(given, is_zero)| given == name && !is_zero)
    }

    /// The word of a property.
    pub fn word(&self, name: &str) -> Option<&'static str> {
        self.words.get(name).copied()
    }

    /// That these properties are given.
    ///
    /// # Errors
    /// The first one that is not.
    pub fn all(&self, needed: &[&str], example: &str) -> Result<(), Unsaid> {
        match needed.iter().find(|name| !self.has(name)) {
            Some(name) => Err(Unsaid::Missing { what: format!("`{name}`"), example: example.to_owned() }),
            None => Ok(()),
        }
    }
}
