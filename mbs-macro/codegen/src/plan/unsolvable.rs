//! Why there is no plan.

use mbs_symbolic::{Inconsistency, Undetermined};

use crate::reactive::{Circular, Unsettled};

/// The reason why a mechanism has no plan.
#[derive(Debug)]
pub enum Unsolvable {
    /// Unknowns that no pivot determines; `verify` has already seen to it that
    /// there are none where the constraints are independent.
    Unknowns(Undetermined),
    /// A load that is undetermined by the reactions on which it depends.
    Load(Circular),
    /// A contact that changes the reactions on which a load depends.
    Contact(Unsettled),
    /// A load that depends on reactions which redundant constraints share.
    Shared,
    /// A mistake of the compiler.
    Inconsistent(Inconsistency),
}

impl From<Inconsistency> for Unsolvable {
    fn from(mistake: Inconsistency) -> Self {
        Self::Inconsistent(mistake)
    }
}

impl From<Undetermined> for Unsolvable {
    fn from(unknowns: Undetermined) -> Self {
        Self::Unknowns(unknowns)
    }
}

impl From<Circular> for Unsolvable {
    fn from(load: Circular) -> Self {
        Self::Load(load)
    }
}

impl From<Unsettled> for Unsolvable {
    fn from(contact: Unsettled) -> Self {
        Self::Contact(contact)
    }
}
