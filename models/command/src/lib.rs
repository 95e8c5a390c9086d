//! What the `mbs` command knows: the library's mechanisms as texts, and the mechanism of the
//! paper compiled, because thousands of its runs make the paper's figures.

pub mod drift;
pub mod library;
pub mod paper;
#[path = "../../src/slider_crank.rs"]
pub mod slider_crank;

pub use library::{Entry, library};
pub use slider_crank::{SliderCrank, SliderCrankParameters};
