//! Shared pieces of the cross-checks: the slider-crank and the N-pendulum written
//! out by hand, chains of any length, numbers that carry derivatives,
//! derivatives from differences, random states, random declarations.
//!
//! # What is tested where
//!
//! This crate holds what crosses rooms: golden expansions (one mechanism whole, of others signatures), dense
//! cross-checks, order, allocation, a freestanding link, operation counts, and published references. Each
//! test file starts with what it holds.
//! It also holds the tests of `mbs-runtime`, `mbs-analysis`, `mbs-ensemble`, `mbs-live` and `mbs-workbench` that
//! declare types: this crate is not optimised, so that they compile in a fraction of the time.
//! A folder of `tests` is one program with a module a file. What needs a process of its own, or is called by name, is a
//! file.
//!
//! * `mbs-runtime/live/tests/mistakes` has mistakes in declarations with their answers.
//! * `compile_fail` has what rustc shows of some. It is a crate of its own, since every case is compiled with all
//!   that its crate depends on.
//! * `paths` has the paths of a step: in stages, fused, in single precision, in lanes of four kinds. A
//!   reference is stated once and held on each of them, and as loops. The references of `models` use it too.
//! * `long` has what takes so many steps that optimised code is worth its compilation, and what looks at optimised code.
//! * `tests/symbolic` tests algebra with random expressions.
//! * `models/tests/library` holds every mechanism of the library to balances and the order of the method.
//!   `models/tests/references` holds each to its closed form or to a published result.
//!
//! # Random mechanisms
//!
//! * `dense` draws mechanisms as numbers. `dense_solutions` compares 20,000 of them in `.ci/run`.
//! * `linkages` makes mechanisms that are assembled as they are made.
//! * `fuzzing` makes up, mutates and crosses declarations. `examples/fuzz.rs` compiles them in child
//!   processes with the Rust compiler's stack and a time limit. A failure is cut down into `corpus`, which a
//!   test compiles.

pub mod between_stops;
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
pub mod rough;
pub mod solved;
pub mod swing;
pub mod thrown;

/// The README's example compiles and runs.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
