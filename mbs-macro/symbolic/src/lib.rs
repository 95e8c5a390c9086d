//! Symbolic engine.
#![forbid(unsafe_code)]

mod number;
pub mod units;

pub use number::Number;
