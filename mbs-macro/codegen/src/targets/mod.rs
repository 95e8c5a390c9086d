//! Targets: the forms in which a compiled mechanism is printed. A target sees [`Compiled`]
//! alone.

mod c;
mod fmi;
#[cfg(feature = "rust")]
mod rust;
#[cfg(feature = "wasm")]
mod wasm;
mod words;

use crate::compiled::Compiled;
use crate::diagnostics::{Diagnostic, Diagnostics};

pub use c::{CSources, File, Scalar, c, c_with_tangents};
pub use fmi::{Experiment, Fmu, Version, fmi};
#[cfg(feature = "rust")]
pub use rust::rust;
#[cfg(feature = "wasm")]
pub use wasm::{RUN_SCRIPTS, Wasm, wasm};

/// Refuses the friction of stops, for targets that do not have it.
fn refuse_rubbing(compiled: &Compiled, target: &str) -> Result<(), Diagnostics> {
    let Some(friction) = compiled.rubbing().next() else { return Ok(()) };
    let stop = friction.stop.and_then(|stop| compiled.stops.get(stop));
    let name = stop.map_or("", |stop| &stop.quantity.name);
    let message = format!("the stop `{name}` rubs, and {target} knows stops without friction alone");
    let help = "leave `friction` and `along` out there; types, texts, lanes and Python have them";
    Err(Diagnostic::new(friction.span, message).help(help).into())
}
