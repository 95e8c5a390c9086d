//! The chapters of the book that have examples in Rust; each example is a test.
//!
//! # How the book is made
//!
//! `src` has the chapters that are written by hand. `models/command/tests/command/book` reads them as a reader
//! would. `models/command/examples/book` puts the book together: chapters with the pictures of the test, the
//! gallery (`gallery.rs`), and as reference the pages of rustdoc and the help of the commands
//! (`reference.rs`). mdBook makes HTML of it, in which `links.rs` follows every link. Nothing that is
//! generated is kept.
#![forbid(unsafe_code)]

/// Chapter "Rust".
#[doc = include_str!("src/rust.md")]
pub mod rust {}

/// Chapter "Microcontrollers and real time".
#[doc = include_str!("src/real-time.md")]
pub mod real_time {}
