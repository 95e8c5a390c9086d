//! The mechanisms of the library, declared with `states = reduced;`.
#![allow(missing_docs, reason = "the library has them")]

pub use paths::{Case, EXHAUSTIVE, Instant, Run, bisect, through_fused_path};

include!(concat!(env!("OUT_DIR"), "/library.rs"));
