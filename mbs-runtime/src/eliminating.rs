//! Gauss's elimination of few rows, some of which depend on others.

use crate::Real;
use crate::contact::{DEPENDENT, Each, MOST_CONTACTS, OPERATIONS, share};

/// Gauss's elimination of the first rows, symmetric and positive semidefinite but for what slides, with their right sides behind them: of some
/// in the order of their pivots, and of the others in which they stand. A pivot is rounding beside what it was before the
/// others; of the first ones, which hold where joints may hold, too, also beside what W would be without joints.
pub(crate) fn eliminate<T: Real>(
    rows: &mut [[T; MOST_CONTACTS + 1]; MOST_CONTACTS],
    [sorted, count]: [usize; 2],
    free: &Each<f64>,
) -> Each<T> {
    let entry = |rows: &[[T; MOST_CONTACTS + 1]; MOST_CONTACTS], row: usize, column: usize| {
        rows.get(row).and_then(|row| row.get(column)).copied().unwrap_or_default()
    };
    let diagonal: Each<f64> = core::array::from_fn(|at| entry(rows, at, at).to_f64());
    let [mut is_pivot, mut is_done] = [[false; MOST_CONTACTS]; 2];
    for turn in 0..count {
        let is_left = |at: &usize| is_done.get(*at).is_some_and(|done| !done);
        let ratio = |at: usize| entry(rows, at, at).to_f64() / free.get(at).copied().unwrap_or(1.0);
        let largest =
            (0..sorted).filter(is_left).reduce(|most, at| if ratio(at) > ratio(most) { at } else { most });
        let at = largest.unwrap_or(turn);
        let pivot = entry(rows, at, at);
        let [before, free] = [&diagonal, free].map(|of| of.get(at).copied().unwrap_or_default());
        let rounding = if at < sorted { OPERATIONS * T::EPSILON.to_f64() * free } else { 0.0 };
        let least = (share::<T>(DEPENDENT) * before).max(rounding);
        let is_independent = pivot.to_f64() > least;
        if let (Some(is_pivot), Some(is_done)) = (is_pivot.get_mut(at), is_done.get_mut(at)) {
            (*is_pivot, *is_done) = (is_independent, true);
        }
        let Some(&above) = rows.get(at).filter(|_| is_independent) else { continue };
        for (_, row) in rows.iter_mut().enumerate().take(count).filter(|(other, _)| *other != at) {
            let factor = row.get(at).copied().unwrap_or_default() / pivot;
            for (entry, above) in row.iter_mut().zip(above) {
                *entry = *entry - factor * above;
            }
        }
    }
    core::array::from_fn(|at| match is_pivot.get(at) {
        Some(true) if at < count => entry(rows, at, MOST_CONTACTS) / entry(rows, at, at),
        _ => T::default(),
    })
}
