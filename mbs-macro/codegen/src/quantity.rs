//! Quantities with their units, and how numbers compare.

use mbs_symbolic::units::Dimension;

/// A number of the mechanism that has a name and a unit: a parameter, an input, a
/// coordinate or an output.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// The name in the declaration.
    pub name: String,
    /// Its documentation there, possibly empty.
    pub doc: String,
    /// The unit in which it is declared, as it was written; empty of a bare number.
    pub unit: String,
    /// One of these units in SI units.
    pub scale: f64,
    /// Powers of kg, m and s.
    pub dimension: Dimension,
}

/// A quantity that is set from outside, a parameter or an input.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// Its name and unit.
    pub quantity: Quantity,
    /// Its declared value in SI units; 0 of an input that is declared without one.
    pub value: f64,
}

/// Which changes of sign are an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crossing {
    /// From negative to positive.
    Rising,
    /// From positive to negative.
    Falling,
    /// Both.
    Either,
}

/// How a number compares with another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comparison {
    /// <
    Less,
    /// ≤
    LessOrEqual,
    /// >
    Greater,
    /// ≥
    GreaterOrEqual,
}

impl Comparison {
    /// True if `difference` compares so with 0.
    pub fn holds(self, difference: f64) -> bool {
        match self {
            Self::Less => difference < 0.0,
            Self::LessOrEqual => difference <= 0.0,
            Self::Greater => difference > 0.0,
            Self::GreaterOrEqual => difference >= 0.0,
        }
    }
}
