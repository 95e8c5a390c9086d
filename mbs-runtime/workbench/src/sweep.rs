//! Sweeps: one computation for every point of a grid, in parallel.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use mbs_ensemble::lanes::Lane;
use mbs_ensemble::{Cancelled, Ensemble, Observe, Outcome};
use mbs_runtime::{Mechanism, Method, Simulation};
use rayon::prelude::*;

/// Whoever waits longer than this is told how long it will take.
const PATIENCE: Duration = Duration::from_secs(1);

/// `count` values from `low` to `high`, both included.
///
/// # Example
/// ```
/// assert_eq!(mbs_workbench::sweep::evenly(200.0, 2000.0, 4), [200.0, 800.0, 1400.0, 2000.0]);
/// ```
pub fn evenly(low: f64, high: f64, count: usize) -> Vec<f64> {
    (0..count).map(|k| evenly_at(low, high, count, k)).collect()
}

/// The one of these values with the index `k`.
pub(crate) fn evenly_at(low: f64, high: f64, count: usize, k: usize) -> f64 {
    let s = k as f64 / count.saturating_sub(1).max(1) as f64;
    // Weighted so that both ends come out exactly.
    (1.0 - s) * low + s * high
}

/// f(x, y) for every x and y, row after row, all of `x` for the first `y`
/// first. Runs on all cores and shows a progress bar under `title`.
pub fn grid<R: Send>(title: &str, x: &[f64], y: &[f64], f: impl Fn(f64, f64) -> R + Sync) -> Vec<R> {
    let points: Vec<_> = y.iter().flat_map(|&y| x.iter().map(move |&x| (x, y))).collect();
    map(title, &points, |&(x, y)| f(x, y))
}

/// f of every item, in order. Runs on all cores and shows a progress bar
/// under `title`.
pub fn map<T: Sync, R: Send>(title: &str, items: &[T], f: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let progress = Progress::new(title, items.len());
    let results = items.par_iter().map(|item| {
        let result = f(item);
        progress.one_more();
        result
    });
    let results = results.collect();
    progress.finish();
    results
}

/// An ensemble of `count` members to `end` seconds, eight to a vector and on all
/// cores, with a progress bar under `title`.
pub fn ensemble<M, X, O>(
    title: &str,
    end: f64,
    count: usize,
    member: impl Fn(usize) -> Result<Simulation<M, X>, mbs_runtime::Error> + Sync,
    observer: &O,
) -> Vec<Outcome<M, O::Result>>
where
    M: Mechanism<Real: Lane>,
    X: Method,
    O: Observe<M>,
{
    let progress = Progress::new(title, count);
    let report = |done: usize, _: usize| progress.reached(done);
    let runs = Ensemble::new(end).progress(&report).run(count, member, observer);
    progress.finish();
    // without a flag nobody cancels
    runs.unwrap_or_else(|Cancelled { .. }| Vec::new())
}

/// A progress bar that keeps out of sight for a second.
pub(crate) struct Progress {
    bar: ProgressBar,
    start: Instant,
}

impl Progress {
    pub fn new(title: &str, length: usize) -> Self {
        let style = ProgressStyle::with_template("{msg:24} {bar:40} {pos}/{len}, {eta} left")
            .unwrap_or_else(|_| ProgressStyle::default_bar());
        let bar = ProgressBar::with_draw_target(Some(length as u64), ProgressDrawTarget::hidden());
        Self { bar: bar.with_message(title.to_owned()).with_style(style), start: Instant::now() }
    }

    fn one_more(&self) {
        self.bar.inc(1);
        self.show();
    }

    /// Threads report in no certain order, so the largest number counts.
    pub fn reached(&self, done: usize) {
        self.bar.set_position(self.bar.position().max(done as u64));
        self.show();
    }

    fn show(&self) {
        if self.bar.is_hidden() && self.start.elapsed() > PATIENCE {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
    }

    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_the_grid_follow_each_other() {
        let values = grid("test", &[1.0, 2.0], &[10.0, 20.0], |x, y| x + y);
        assert_eq!(values, [11.0, 12.0, 21.0, 22.0]);
        let gains = evenly(200.0, 2000.0, 37);
        assert_eq!((gains[0], gains[36], gains.len()), (200.0, 2000.0, 37));
    }
}
