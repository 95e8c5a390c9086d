//! Samples of tests with many cases.

/// True if tests take all cases: what `EXHAUSTIVE=1` asks for when they are compiled, as `.ci/run` does.
/// Without it nobody waits for the code of cases that are not taken.
pub const EXHAUSTIVE: bool = option_env!("EXHAUSTIVE").is_some();

/// Every how many cases one is tried: all of them, or one in ten where somebody waits.
pub const STRIDE: usize = if EXHAUSTIVE { 1 } else { 10 };

/// The number of random cases that are tried, of `all`.
pub const fn some_of(all: u64) -> u64 {
    all.div_ceil(STRIDE as u64)
}
