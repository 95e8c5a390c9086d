//! Synthesis: parameters with which a mechanism passes given positions.
//!
//! # How it works
//!
//! * `task` is the question. `system` has the equations of all positions, with their derivatives.
//! * `blocks` is a damped step that eliminates each position by itself. `descent` iterates it.
//! * `circuit` follows the curve of a mechanism through its positions and tells defects.
//! * `search` makes random starts in batches on all cores, so that a seed has one result.

mod blocks;
mod circuit;
mod descent;
mod search;
mod system;
mod task;

pub use task::{Defect, Linkage, Task};

/// The result of a [`Task`]. See the example of [`Task::synthesize`].
#[derive(Clone, Debug, PartialEq)]
pub struct Synthesis {
    /// Mechanisms without defects: those that miss least first, and smaller ones before larger ones.
    pub linkages: Vec<Linkage>,
    /// The number of mechanisms that were refused, for each defect.
    pub refused: [(Defect, usize); 3],
    /// The number of starts.
    pub starts: usize,
    /// The smallest difference from the values that were asked for, of all starts, with or without a defect. Infinite
    /// if the search gave up all starts before, far from the positions or where the mechanism takes no such parameters.
    pub nearest: f64,
}
