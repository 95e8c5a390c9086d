//! The workbench as programs use it. What needs a run stands here and not beside the code: for that all of the crate would be
//! compiled once more.
#![allow(clippy::unwrap_used, reason = "a test says by panicking what is wrong")]

mod arguments;
mod inputs;
mod pages;
