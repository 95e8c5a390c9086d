//! Pictures of mechanisms and figures of curves.
//!
//! - [`picture`] finds what a mechanism looks like from its sketch and a run.
//! - `figure`, behind a feature of its name, draws pictures, curves and heat maps to SVG, PNG and GIF.
#![forbid(unsafe_code)]

mod column;
#[cfg(feature = "figure")]
mod error;
#[cfg(feature = "figure")]
pub mod figure;
pub mod picture;

pub use column::{Column, heading};
#[cfg(feature = "figure")]
pub use error::Error;
