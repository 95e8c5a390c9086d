//! The references of the library hold for reduced states, fused.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test says by panicking what is wrong")]

extern crate reduced as models;
extern crate reduced as paths;

#[path = "../../../models/tests/references/main.rs"]
mod references;
