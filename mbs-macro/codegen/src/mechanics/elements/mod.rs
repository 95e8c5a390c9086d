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
    /// What it does.
    pub meaning: &'static str,
    /// What follows its name.
    pub example: &'static str,
    pub places: Places,
    pub properties: &'static [Property],
    /// Whether the properties that are given say what it does.
    pub said: fn(&Given<'_>) -> Result<(), Unsaid>,
    /// What has to move, at least one of these.
    pub moved: for<'a> fn(&Element<'a>) -> Vec<Scalar<'a>>,
    /// How to mend one of which nothing moves.
    pub mend: &'static str,
    /// What joints must leave free between its places.
    pub needs: Option<Freedom>,
    /// What comes of it; nothing where a property is missing, which has its error.
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
    /// What would take it away.
    pub from: Holds,
    /// What something does that has it.
    pub verb: &'static str,
    /// How to mend an element without it.
    pub mend: &'static str,
}
