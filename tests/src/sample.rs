//! Samples of tests with many cases.

/// Every how many cases one is tried: all of them where the environment asks for it (`EXHAUSTIVE=1`, as `.ci/run`
/// does), and one in five where somebody waits.
pub fn stride() -> usize {
    if std::env::var_os("EXHAUSTIVE").is_some() { 1 } else { 5 }
}
