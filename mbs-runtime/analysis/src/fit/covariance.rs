//! How well the data determine what was looked for.

use nalgebra::DMatrix;

use super::Experiment;
use super::least_squares::Minimum;
use crate::Error;
use crate::singular::Singular;

/// Columns of the Jacobian whose combination is smaller than this part of them cannot be told from columns
/// that depend on each other: their derivatives are known to about ten times the tolerance of the runs.
const DEPENDENT: f64 = 1e-6;
/// An unknown that changes by less than this part of the largest change is not named.
const NAMED: f64 = 1e-2;

/// (JᵀJ)⁻¹ of the unknowns that are free; zeros for the others.
///
/// # Errors
/// [`Error::Undetermined`].
pub fn covariance(experiment: &Experiment, best: &Minimum, free: &[usize]) -> Result<DMatrix<f64>, Error> {
    let mut covariance = DMatrix::zeros(best.x.len(), best.x.len());
    if free.is_empty() {
        return Ok(covariance);
    }
    let jacobian = best.local.jacobian.select_columns(free);
    let norms: Vec<f64> = jacobian.column_iter().map(|column| column.norm()).collect();
    if let Some(at) = norms.iter().position(|norm| *norm == 0.0) {
        return Err(undetermined(experiment, &[(free[at], 1.0)]));
    }
    let size = |at: usize| best.x[free[at]].abs();
    let scaled = DMatrix::from_fn(jacobian.nrows(), free.len(), |row, at| jacobian[(row, at)] / norms[at]);
    if scaled.iter().any(|entry| !entry.is_finite()) {
        return Err(Error::NoPrediction);
    }
    let Singular { values: s, v_t, .. } = Singular::new(&scaled.qr().r());
    let (least, smallest) = s
        .iter()
        .enumerate()
        .fold((0, f64::INFINITY), |best, (at, s)| if *s < best.1 { (at, *s) } else { best });
    if smallest < DEPENDENT {
        // a direction along which the data stay the same, as changes relative to the values
        let change = |at: usize| {
            let own = v_t[(least, at)] / norms[at];
            (free[at], if size(at) > 0.0 { own / best.x[free[at]] } else { own })
        };
        let changes: Vec<(usize, f64)> = (0..free.len()).map(change).collect();
        return Err(undetermined(experiment, &changes));
    }
    for (a, &row) in free.iter().enumerate() {
        for (b, &column) in free.iter().enumerate() {
            let sum: f64 = (0..s.len()).map(|k| v_t[(k, a)] * v_t[(k, b)] / (s[k] * s[k])).sum();
            covariance[(row, column)] = sum / (norms[a] * norms[b]);
        }
    }
    Ok(covariance)
}

/// The changes, of which the largest is 1.
fn undetermined(experiment: &Experiment, changes: &[(usize, f64)]) -> Error {
    let largest = changes
        .iter()
        .map(|(_, change)| *change)
        .fold(0.0, |best: f64, change| if change.abs() > best.abs() { change } else { best });
    let named = changes.iter().filter(|(_, change)| (change / largest).abs() > NAMED);
    let along = named.map(|(at, change)| (experiment.unknown[*at].name.clone(), change / largest)).collect();
    Error::Undetermined { along }
}
