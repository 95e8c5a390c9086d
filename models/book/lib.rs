//! The chapters of the book that have examples in Rust; each is a test.
#![forbid(unsafe_code)]
