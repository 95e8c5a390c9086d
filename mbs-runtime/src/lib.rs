//! Declare a mechanism, get a solver.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "std")]
extern crate std;

mod baumgarte;
mod components;
mod error;
mod heun;
mod info;
mod kinematics;
mod mechanism;
mod real;
mod simulation;
pub mod start;

pub use baumgarte::{Baumgarte, Feedback, Held, PerStage};
pub use components::{Components, NoComponents};
pub use error::Error;
pub use info::{Constraint, Dimension, Function, Info, Operations, Pivot, Quantity};
pub use kinematics::{Kinematics, Motion};
pub use mbs_macro::mechanism;
pub use mechanism::{Accelerations, Gains, Mechanism, Reactions, Stabilized, State, growth_limit};
pub use real::Real;
pub use simulation::{Builder, Simulation};

/// What generated code calls. Not part of the public interface.
#[doc(hidden)]
pub mod __private;
