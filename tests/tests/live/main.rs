//! Mechanisms from texts: what compiles, what is answered, and runs of what is compiled.

mod costs;
mod cranks;
mod errors;
mod exact;
mod files;
mod inputs;
mod lanes;
mod library;
mod positions;
mod wasm;
