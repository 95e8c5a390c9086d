//! The workbench as programs use it. Tests that run a mechanism stand here: beside the code they would compile the whole crate
//! once more.
#![allow(clippy::unwrap_used, reason = "a test says by panicking what is wrong")]

mod arguments;
mod inputs;
mod pages;
