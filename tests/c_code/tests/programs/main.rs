//! The printed C code, compiled and run: one program, so that its tests run beside each other.

#[path = "../../../src/chains.rs"]
#[macro_use]
mod chains;
#[path = "../../../src/between_stops.rs"]
mod between_stops;
#[path = "../../../src/linkages.rs"]
mod linkages;
#[path = "../../../src/random.rs"]
mod random;
#[path = "../../../src/rough.rs"]
mod rough;
#[path = "../../../src/thrown.rs"]
mod thrown;

mod fmi;
mod inputs;
mod library;
mod package;
mod printers;
mod refusals;
mod tangents;
mod typed;

/// Bits are the same at every level of optimization; of two, the one that compiles faster serves a sample.
const OPTIMIZATION: &str = if paths::EXHAUSTIVE { "-O2" } else { "-O1" };
