//! Mechanisms from texts for C: what stands behind `include/mbs.h`, which documents every function.
//!
//! A function of the interface is written in `exports` as a safe function: its arguments are of the types in
//! `border`, the one place with `unsafe`, which turn pointers into references, texts and numbers, or into a status.
//! `guard` sees to it that an error is kept for `mbs_error` and that no panic gets into C.
#![deny(unsafe_code)]
// functions for C are tested through C; in tests of the border they would only be compiled once more
#![cfg_attr(test, allow(dead_code, unused_macros, reason = "the functions for C are left out"))]

#[macro_use]
mod guard;
mod border;
#[cfg(not(test))]
mod exports;
mod last;
mod mechanism;
mod method;
mod motion;
mod run;
mod status;

#[cfg(not(test))]
pub use exports::*;
pub use last::Problem;
pub use mechanism::{Mechanism, Quantity};
pub use run::Run;

/// The header promises that a mechanism is used by any number of threads at once, and a run by one after the other.
const _: () = {
    const fn is_shared<T: Send + Sync>() {}
    const fn is_sent<T: Send>() {}
    is_shared::<Mechanism>();
    is_sent::<Run>();
};
