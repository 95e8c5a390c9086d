//! Kinds of force elements.

use mbs_symbolic::Scalar;
use mbs_symbolic::units::Dimension;

use super::effects::{Effects, Element};
use super::properties::{Given, Property, Unsaid};
use crate::mechanics::joints::Holds;

/// A kind of force element.
pub struct ElementKind {
    /// The word that declares it.
    pub word: &'static str,
    /// Its effect in words.
    pub meaning: &'static str,
    /// An example of the text behind its name.
    pub example: &'static str,
    pub places: Places,
    pub properties: &'static [Property],
    /// Checks that the properties that are given say how it acts.
    pub said: fn(&Given<'_>) -> Result<(), Unsaid>,
    /// The names that its properties know beside those of all formulas.
    pub knows: &'static [Known],
    /// The lengths or angles of which at least one has to depend on coordinates.
    pub moved: for<'a> fn(&Element<'a>) -> Vec<Scalar<'a>>,
    /// How to mend one of which nothing moves.
    pub mend: &'static str,
    /// The motion that joints must leave free between its places.
    pub needs: Option<Freedom>,
    /// Why it cannot act where it is, and how to mend that.
    pub refuses: for<'a> fn(&Element<'a>) -> Option<[&'static str; 2]>,
    /// Adds its effects; `None` where a property is missing, which has its error.
    pub forces: for<'a> fn(&Element<'a>, &mut Effects<'_>) -> Option<()>,
}

/// A quantity of an element that its properties may name.
pub struct Known {
    pub name: &'static str,
    pub dimension: Dimension,
    pub value: for<'a> fn(&Element<'a>, &Effects<'_>) -> Scalar<'a>,
}

/// Where an element acts.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Places {
    /// `on` a place.
    One,
    /// Between two places.
    Two,
    /// Between two places, `along` a direction on the second body.
    TwoAlong,
}

/// A motion that an element needs.
#[derive(Clone, Copy)]
pub struct Freedom {
    /// The kind of row that takes it away.
    pub from: Holds,
    /// The verb for it, such as `slides`.
    pub verb: &'static str,
    /// How to mend an element without it.
    pub mend: &'static str,
}
