//! Mechanisms in C: built by the C compilers of this machine, run as programs of their own,
//! and compared with their programs, which are evaluated here.

mod build;
mod declarations;
mod evaluate;

pub use build::{Built, Choice, Fault, WARNINGS, build, build_around, compile, compilers, is_there};
pub use declarations::declarations;
pub use evaluate::Evaluator;
