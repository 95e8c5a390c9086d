//! In the place of the crate `paths`: references are compared on the fused path. That the others give the same
//! bits with reduced states is a test of its own (`tests/steps.rs`).

use mbs_runtime::{Error, Mechanism, Method, Simulation};
use paths::{Case, Run, Single, through_fused_path};

/// As [`paths::through_every_path`], fused.
///
/// # Errors
/// Those of `start` and `comparison`.
///
/// # Panics
/// If a number deviates.
pub fn through_every_path<M: Mechanism<Real = f64>, X: Method>(
    name: &str,
    step: f64,
    _: Single,
    start: impl Fn(f64) -> Result<Simulation<M, X>, Error>,
    comparison: impl Fn(&mut Case, &mut Run<M, X>) -> Result<(), Error>,
) -> Result<(), Error> {
    through_fused_path(name, step, start, comparison)
}

/// As [`paths::through_double_paths`], fused.
///
/// # Errors
/// Those of `start` and `comparison`.
///
/// # Panics
/// If a number deviates.
pub fn through_double_paths<M: Mechanism<Real = f64>, X: Method>(
    name: &str,
    step: f64,
    start: impl Fn(f64) -> Result<Simulation<M, X>, Error>,
    comparison: impl Fn(&mut Case, &mut Run<M, X>) -> Result<(), Error>,
) -> Result<(), Error> {
    through_fused_path(name, step, start, comparison)
}
