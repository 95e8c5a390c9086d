//! The mechanisms of the library, declared with `states = reduced;`.
#![allow(missing_docs, reason = "the library has them")]

mod fused;

pub use fused::{through_double_paths, through_every_path};
pub use paths::{Case, EXHAUSTIVE, Instant, Run, Single, bisect};

include!(concat!(env!("OUT_DIR"), "/library.rs"));
