//! A library of mechanisms, one a file.

#[macro_use]
mod temporary;
pub mod slider_crank;
pub mod slider_crank_free;

pub use slider_crank::{SliderCrank, SliderCrankParameters};
pub use slider_crank_free::{SliderCrankFree, SliderCrankFreeInputs, SliderCrankFreeParameters};
