//! Shared pieces of the cross-checks: the slider-crank written out by hand,
//! numbers that carry derivatives, random states, random declarations.

pub mod by_hand;
pub mod by_hand_on_pairs;
pub mod fuzzing;
pub mod jet;
pub mod operators;
pub mod random;

/// The README's example compiles and runs.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
