//! Shared pieces of the cross-checks: the slider-crank and the N-pendulum written
//! out by hand, chains of any length, numbers that carry derivatives,
//! derivatives from differences, random states, random declarations.

pub mod bushing;
pub mod by_hand;
pub mod by_hand_on_pairs;
pub mod chains;
pub mod dense;
pub mod differences;
pub mod fuzzing;
pub mod jet;
pub mod linkages;
pub mod operators;
pub mod pendulum;
pub mod random;
pub mod swing;

/// The README's example compiles and runs.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
