//! The mechanisms of the library, declared with `states = reduced;`.
#![allow(missing_docs, reason = "the library has them")]

include!(concat!(env!("OUT_DIR"), "/library.rs"));
