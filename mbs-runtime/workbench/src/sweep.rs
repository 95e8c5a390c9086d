//! Sweeps: one computation for every point of a grid, in parallel.

use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;

/// `count` values from `low` to `high`, both included.
///
/// # Example
/// ```
/// assert_eq!(mbs_workbench::sweep::evenly(200.0, 2000.0, 4), [200.0, 800.0, 1400.0, 2000.0]);
/// ```
pub fn evenly(low: f64, high: f64, count: usize) -> Vec<f64> {
    let last = count.saturating_sub(1).max(1) as f64;
    // Weighted so that both ends come out exactly.
    (0..count).map(|k| k as f64 / last).map(|s| (1.0 - s) * low + s * high).collect()
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
    let bar = ProgressBar::new(items.len() as u64).with_message(title.to_owned()).with_style(
        ProgressStyle::with_template("{msg:24} {bar:40} {pos}/{len}, {eta} left")
            .unwrap_or_else(|_| ProgressStyle::default_bar()),
    );
    let results = items.par_iter().map(|item| {
        let result = f(item);
        bar.inc(1);
        result
    });
    let results = results.collect();
    bar.finish_and_clear();
    results
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
