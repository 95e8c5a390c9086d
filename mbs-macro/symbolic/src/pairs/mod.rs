//! Straight-line code on pairs: two equal operations as one on two lanes.
//!
//! Processors compute on two doubles as fast as on one, but compilers are poor at
//! finding the pairs in long straight-line code. A mechanism is full of them: the x
//! and the y of a place, two angles, two stages of a step.
//!
//! 1. `choose` decides which instructions share a vector;
//! 2. `weave` writes them down, with what brings operands into their lanes, and `sines` the
//!    operations of sines and cosines;
//! 3. `order` puts each where its time comes.
//!
//! Results are those of the program, bit for bit but for the sign of a zero: lanes
//! do the same operations on the same operands. Where one lane adds and the other
//! subtracts, an operand is held with one lane negated, which is exact.
//!
//! # Which pairs pay
//!
//! A pair waits for the operands of both lanes. It is formed only if the time per step does not grow: the
//! larger of the critical path from step to step, and of the operations over the throughput (`interval`). No
//! pair waits for itself.

mod ancestors;
mod angles;
mod choose;
mod interval;
mod kinds;
mod layout;
mod nodes;
mod order;
mod sines;
mod steps;
mod trial;
mod weave;
mod woven;

pub(crate) use self::angles::is_sine_or_cosine;
pub(crate) use self::kinds::kind;
pub use self::layout::Layout;
pub use self::steps::{Given, Lane, Scalar, Step, Term};
pub use self::woven::Woven;
use crate::program::Program;

/// Weaves a program.
pub fn weave(program: &Program, layout: &Layout<'_>) -> Woven {
    let angles = angles::pair_angles(program);
    let partners = choose::choose(program, &angles, layout);
    order::in_order(&weave::weave(program, &partners, &angles, layout), layout)
}
