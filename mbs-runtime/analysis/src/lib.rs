//! What an engineer asks of a mechanism beside its motion: where it rests, and whether it stays
//! there.
//!
//! Everything works on the equations of a mechanism on slices
//! ([`Described`](mbs_runtime::equations::Described)), which every type of `mechanism!` is, and
//! every text that `mbs-live` has compiled. Vectors are in the order of
//! [`Info`](mbs_runtime::Info), in SI units and rad.
//!
//! * [`equilibrium`]: positions at which nothing moves, and whether they are stable.
#![forbid(unsafe_code)]

mod equilibrium;
mod error;
mod tangent;

pub use equilibrium::{Equilibrium, Search, Stability, Strategy, equilibrium};
pub use error::Error;

#[doc = include_str!("../README.md")]
#[cfg(doctest)]
struct Readme;
