//! The references of the library hold for reduced states, on every path that a step can take.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test says by panicking what is wrong")]

extern crate reduced as models;

#[path = "../../../models/tests/references/main.rs"]
mod references;
