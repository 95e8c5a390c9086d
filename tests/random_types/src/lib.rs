//! Random mechanisms as types, which the build makes.
#![allow(missing_docs, clippy::all, reason = "generated")]

use mbs_runtime::Mechanism;

/// What is done with each mechanism.
pub trait Visit {
    /// With this one, given its declaration.
    fn visit<M: Mechanism<Real = f64>>(&mut self, text: &str);
}

include!(concat!(env!("OUT_DIR"), "/mechanisms.rs"));
