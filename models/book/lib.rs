//! The chapters of the book that have examples in Rust; each example is a test.
#![forbid(unsafe_code)]

/// Chapter "Rust".
#[doc = include_str!("src/rust.md")]
pub mod rust {}

/// Chapter "Microcontrollers and real time".
#[doc = include_str!("src/real-time.md")]
pub mod real_time {}
