//! Random mechanisms as types, which the build makes.
#![allow(missing_docs, clippy::all, reason = "generated")]

use mbs_runtime::Mechanism;

/// A visitor of mechanisms.
pub trait Visit {
    /// Visits a mechanism, given its declaration.
    fn visit<M: Mechanism<Real = f64>>(&mut self, text: &str);
}

include!(concat!(env!("OUT_DIR"), "/mechanisms.rs"));
