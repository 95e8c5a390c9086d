//! Targets: the forms in which a compiled mechanism is printed. A target sees [`Compiled`]
//! alone.

mod c;
mod fmi;
#[cfg(feature = "rust")]
mod rust;
#[cfg(feature = "wasm")]
mod wasm;
mod words;

use crate::Compiled;
use crate::diagnostics::Diagnostic;

pub use c::{CSources, File, Scalar, c, c_with_tangents};
pub use fmi::{Experiment, Fmu, Version, fmi};
#[cfg(feature = "rust")]
pub use rust::rust;
#[cfg(feature = "wasm")]
pub use wasm::{RUN_SCRIPT, Wasm, wasm};

/// Refuses stops for a target whose runs see no impact.
fn without_stops(compiled: &Compiled, what: &str) -> Result<(), Diagnostic> {
    let Some(stop) = compiled.stops.first() else { return Ok(()) };
    let message = format!(
        "{what} takes constant steps, which do not see the impacts of the stop `{}`",
        stop.quantity.name
    );
    Err(Diagnostic::new(stop.span, message)
        .help("run it to a tolerance; for other programs make a soft stop of it: `force end on x = -k*ramp(x - gap);`"))
}
