//! The tables that the compiler of mechanisms and their runtime agree on: the functions of a mechanism
//! ([`FUNCTIONS`]), one-step schemes, the formula of sine and cosine.
//!
//! # Schemes
//! An explicit scheme is a [`Tableau`], a diagonally implicit one an [`Implicit`]. Whatever takes a step
//! (generated code, the runtime, an interpreter) reads its numbers there.
//!
//! The first-order form of the equations of motion is (q, v)˙ = (v, q̈(t, q, v)). Stage i
//! has the slopes vᵢ of q and q̈ᵢ of v. The first stage stands at the start of the step. A
//! [`Row`] leads to each of the others, and the last one to the end:
//!
//! ```text
//! x = x₀ + (share · h) (w₁ k₁ + w₂ k₂ + …)
//! ```
//!
//! # One order of operations
//! All who take a step do it in the same operations, so that their results agree to the last
//! bit: (share · h) is one multiplication, or h itself where the share is 1; the slopes are
//! summed from the first to the last, without those whose weight is 0, and without a
//! multiplication where a weight is 1. The time of a stage is t + c h, and that of the end of
//! the step where c = 1.
//!
//! # Sine and cosine
//! The same holds for [`sine`]: its constants and the order of its operations are those of all who
//! compute a sine.
//!
//! # A new scheme
//! A new scheme is a constant in `schemes.rs` and its line in [`explicit_schemes!`]; stability and gains follow
//! from it.
//!
//! # Example
//! ```
//! use mbs_interface::{Explicit, HEUN, RK4};
//!
//! assert_eq!((HEUN.order, RK4.order), (2, 4));
//! // the gains that remove a violation within two steps of 1 ms
//! let held = Explicit::held(&RK4);
//! assert_eq!(held.deadbeat(1e-3), [750.0, 1000.0]);
//! assert!(held.is_stable([750.0, 1000.0], 1e-3) && !held.is_stable([3000.0, 1000.0], 1e-3));
//! ```
#![no_std]
#![forbid(unsafe_code)]

mod composition;
mod explicit;
mod functions;
pub mod implicit;
mod interpolant;
mod response;
mod roots;
pub mod schemes;
pub mod sine;
mod tableau;
#[cfg(test)]
mod trees;

pub use composition::{COMPOSITIONS, Composition, RATTLE, RATTLE4};
pub use explicit::{Explicit, Stabilization};
pub use functions::{Argument, FUNCTIONS, FunctionId, FunctionRow, Property, Results};
pub use implicit::*;
pub use interpolant::Interpolant;
pub use response::Response;
pub use schemes::*;
pub use tableau::{Estimate, MOST_STAGES, Row, Tableau};
