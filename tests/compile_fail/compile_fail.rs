//! Mistakes in declarations as rustc shows them: it points to their places, also through other macros and in several
//! mechanisms, and finds faults itself in the code that it is given.
//!
//! The answers to all mistakes are in `mbs-runtime/live/tests/mistakes`.
//!
//! The `.stderr` files are never edited: after a change of wording,
//! `TRYBUILD=overwrite cargo test --release -p compile_fail` writes them anew,
//! and the difference is what to review. How rustc frames a message depends on
//! its version; they are written with rustc 1.95.

#[test]
fn mistakes_are_shown_by_rustc() {
    trybuild::TestCases::new().compile_fail("ui/*.rs");
}
