//! The paths that a step can take: in stages, fused, in single precision, in lanes.
//! A reference states what it compares once, and is held to it on each of them, or where somebody waits
//! ([`EXHAUSTIVE`]) on the fused one.
#![allow(clippy::panic, reason = "a test says by panicking what is wrong")]

mod compare;
mod run;
mod sample;
mod steps;

pub use compare::{Case, bisect};
pub use run::{Instant, Run};
pub use sample::{EXHAUSTIVE, STRIDE, some_of};

use compare::Widening;
use mbs_runtime::{Error, Mechanism, Method, Simulation};
use steps::{Fused, InLanes, InStages, Steps, narrowed};

/// The comparison in single precision.
#[derive(Clone, Copy)]
pub enum Single {
    /// Steps so many times as long, to tolerances wider by the square of that: Heun's
    /// method is of second order. Long enough, truncation outweighs rounding.
    Longer(f64),
    /// The same steps, where rounding is all that limits the agreement: tolerances
    /// wider by the ratio of both ε.
    Rounding,
    /// Nothing; the case says why.
    LeftOut,
}

/// Makes `comparison` on every path, each from `start` with a step.
///
/// # Errors
/// Those of `start` and `comparison`.
///
/// # Panics
/// If a number deviates.
pub fn through_every_path<M: Mechanism<Real = f64>, X: Method>(
    name: &str,
    step: f64,
    single: Single,
    start: impl Fn(f64) -> Result<Simulation<M, X>, Error>,
    comparison: impl Fn(&mut Case, &mut Run<M, X>) -> Result<(), Error>,
) -> Result<(), Error> {
    if !EXHAUSTIVE {
        return through_fused_path(name, step, start, comparison);
    }
    let of_rounding = f64::from(f32::EPSILON) / f64::EPSILON;
    let (longer, of_truncation) = match single {
        Single::Longer(factor) => (factor, factor * factor),
        Single::Rounding | Single::LeftOut => (1.0, of_rounding),
    };
    compare_along(&double(), name, Widening::NONE, || start(step), &comparison)?;
    if !matches!(single, Single::LeftOut) {
        let widening = Widening { of_truncation, of_rounding };
        compare_along(&narrow(), name, widening, || start(longer * step), &comparison)?;
    }
    Ok(())
}

/// The same, with no code for single precision.
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
    if !EXHAUSTIVE {
        return through_fused_path(name, step, start, comparison);
    }
    compare_along(&double(), name, Widening::NONE, || start(step), &comparison)
}

/// Makes `comparison` on the fused path alone, from `start` with a step: of mechanisms whose other paths are
/// known to give the same bits.
///
/// # Errors
/// Those of `start` and `comparison`.
///
/// # Panics
/// If a number deviates.
pub fn through_fused_path<M: Mechanism<Real = f64>, X: Method>(
    name: &str,
    step: f64,
    start: impl Fn(f64) -> Result<Simulation<M, X>, Error>,
    comparison: impl Fn(&mut Case, &mut Run<M, X>) -> Result<(), Error>,
) -> Result<(), Error> {
    compare_along(&[fused()], name, Widening::NONE, || start(step), &comparison)
}

fn compare_along<M: Mechanism<Real = f64>, X: Method>(
    paths: &[Path<M, X>],
    name: &str,
    widening: Widening,
    start: impl Fn() -> Result<Simulation<M, X>, Error>,
    comparison: &impl Fn(&mut Case, &mut Run<M, X>) -> Result<(), Error>,
) -> Result<(), Error> {
    for (path, begin) in paths {
        let mut case = Case::widened(&format!("{name}, {path}"), widening);
        comparison(&mut case, &mut Run::new(*begin, start()?)?)?;
        case.finish();
    }
    Ok(())
}

/// The name of a path, and how it begins.
type Path<M, X> = (&'static str, Start<M, X>);

type Start<M, X> = fn(&Simulation<M, X>) -> Result<Box<dyn Steps<M>>, Error>;

fn fused<M: Mechanism<Real = f64>, X: Method>() -> Path<M, X> {
    ("fused", |from| Ok(Box::new(Fused(*from))))
}

fn double<M: Mechanism<Real = f64>, X: Method>() -> [Path<M, X>; 3] {
    [
        ("in stages", |from| Ok(Box::new(InStages(*from)))),
        fused(),
        ("in 8 lanes", |from| Ok(Box::new(InLanes::<_, _, 8>::beside_others(from)?))),
    ]
}

fn narrow<M: Mechanism<Real = f64>, X: Method>() -> [Path<M, X>; 2] {
    [
        ("in single precision", |from| Ok(Box::new(Fused(narrowed(from)?)))),
        ("in 16 single lanes", |from| Ok(Box::new(InLanes::<_, _, 16>::beside_others(&narrowed(from)?)?))),
    ]
}
