//! Targets: the forms in which a compiled mechanism is printed. A target sees [`Compiled`](crate::Compiled)
//! alone.

mod c;
mod fmi;
#[cfg(feature = "rust")]
mod rust;
#[cfg(feature = "wasm")]
mod wasm;
mod words;

pub use c::{CSources, File, Scalar, c, c_with_tangents};
pub use fmi::{Experiment, Fmu, Version, fmi};
#[cfg(feature = "rust")]
pub use rust::rust;
#[cfg(feature = "wasm")]
pub use wasm::{RUN_SCRIPTS, Wasm, wasm};
