//! Exact test whether a value is 0.
//!
//! Floats round, so a difference of two of them that should be 0 is some 1e-17. Constants therefore
//! carry their exact value along, as an element of a finite field ([`Residue`]): it is 0 exactly
//! where the constant is. Expressions have such values at a random [`Point`], and one that is 0
//! there is 0 everywhere (Schwartz 1980, Zippel 1979), but for a chance below 1e-12.

mod point;
mod real;
mod residue;

pub use point::{Exact, Point};
pub use real::Real;
pub use residue::Residue;
