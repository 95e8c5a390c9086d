//! Force elements, a file each: how they are declared, their properties, and the forces
//! that come of them. A new element is such a file and a row of [`ELEMENTS`].

mod drag;
mod effects;
mod friction;
mod motor;
mod properties;
mod spring;

use mbs_symbolic::Scalar;

pub use effects::{Effects, Element, Exerts};
pub use properties::{Given, Property, Range, Unsaid};

use super::joints::Holds;

/// Every kind of element.
pub const ELEMENTS: &[&ElementKind] = &[
    &spring::SPRING,
    &spring::TORSION_SPRING,
    &motor::MOTOR,
    &friction::FRICTION,
    &friction::TORSION_FRICTION,
    &drag::DRAG,
];

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
    /// The lengths or angles of which at least one has to depend on coordinates.
    pub moved: for<'a> fn(&Element<'a>) -> Vec<Scalar<'a>>,
    /// How to mend one of which nothing moves.
    pub mend: &'static str,
    /// The motion that joints must leave free between its places.
    pub needs: Option<Freedom>,
    /// Adds its effects; `None` where a property is missing, which has its error.
    pub forces: for<'a> fn(&Element<'a>, &mut Effects<'_>) -> Option<()>,
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
