//! Exact test whether a value is 0.
//!
//! Floats round, so a difference of two of them that should be 0 is some 1e-17. Constants therefore
//! carry their exact value along, as an element of a finite field ([`Residue`]): it is 0 exactly
//! where the constant is. Expressions have such values at a random [`Point`], and one that is 0
//! there is 0 everywhere (Schwartz 1980, Zippel 1979), but for a chance below 1e-12.
//!
//! A constant is a fraction as long as that fits. Beyond, it is a `Real`: a float, a bound of its
//! rounding, and its element of the field.
//!
//! # Who asks
//!
//! `Arena::vanishes` evaluates an expression at a random point of the field. Pivots, rows that give
//! coordinates, and ranks ask there. None of them judges a 0 by the size of a float.

mod point;
mod real;
mod residue;

pub use point::{Exact, Point};
pub use real::Real;
pub use residue::Residue;
