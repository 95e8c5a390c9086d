//! Symbolic engine.
#![forbid(unsafe_code)]

mod arena;
mod construct;
mod differentiate;
mod display;
mod eliminate;
mod evaluate;
mod lower;
mod number;
mod operators;
mod program;
pub mod units;

pub use arena::{Arena, Expr, Node, Stage, Symbol};
pub use eliminate::{Factorization, Kkt, Strategy, Undetermined, Unknown, WatchedPivot, factor};
pub use lower::{Hoisted, lower, lower_whole};
pub use number::Number;
pub use operators::{Function, Parity, Row, TABLE as FUNCTIONS};
pub use program::{Instruction, Operand, Operation, Operations, Program};
