//! The contents of the `mbs` command: the library's mechanisms as texts, and the study of a paper.

pub mod library;
pub mod paper;

pub use library::{Entry, library};
