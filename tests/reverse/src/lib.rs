//! Mechanisms of the library, declared with `gradients = reverse;`.
#![allow(missing_docs, reason = "the library has them")]

include!(concat!(env!("OUT_DIR"), "/library.rs"));
