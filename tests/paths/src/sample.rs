//! Samples of tests with many cases.

/// True if tests take all cases: what `EXHAUSTIVE=1` asks for when they are compiled, as `.ci/run` does.
/// Without it nobody waits for the code of cases that are not taken.
pub const EXHAUSTIVE: bool = option_env!("EXHAUSTIVE").is_some();

/// Every how many cases one is tried: all of them, or one in five where somebody waits.
pub const STRIDE: usize = if EXHAUSTIVE { 1 } else { 5 };
