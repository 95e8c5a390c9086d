//! Rows of numbers brought to echelon form.

use super::sparse::{Pivots, SparseRow, subtract};

/// The part of a row that earlier rows do not explain counts as 0 below this,
/// measured against the row's largest entry and the largest factor that went
/// into it: far above rounding (1e-16 times a few hundred operations), far
/// below what a position of a regular mechanism gives.
pub const RANK_TOLERANCE: f64 = 1e-9;

/// What elimination in the order of declaration found.
#[derive(Clone)]
pub struct Echelon {
    rank: usize,
    /// Rows that are combinations of earlier ones, and of which.
    pub dependent: Vec<(usize, Vec<usize>)>,
    /// Per row, the relative size of what earlier rows do not explain.
    pub independence: Vec<f64>,
}

impl Echelon {
    pub fn rank(&self) -> usize {
        self.rank
    }
}

/// Gaussian elimination, row by row with the largest entry of each as pivot,
/// so that a dependent row is the one declared last.
pub fn row_echelon(rows: Vec<SparseRow<f64>>) -> Echelon {
    /// A reduced row, its pivot, and how it came from the given rows.
    struct Reduced {
        entries: SparseRow<f64>,
        pivot: f64,
        history: SparseRow<f64>,
    }
    let mut basis: Vec<Reduced> = Vec::new();
    let mut pivots = Pivots::default();
    let mut echelon = Echelon { rank: 0, dependent: Vec::new(), independence: Vec::new() };
    for (at, mut entries) in rows.into_iter().enumerate() {
        let mut history = vec![(at, 1.0)];
        let mut next = 0;
        while let Some((earlier, column, entry)) = pivots.first(&entries, next) {
            let Reduced { entries: others, pivot, history: past } = &basis[earlier];
            let factor = entry / pivot;
            entries = subtract(&entries, factor, others);
            // exactly, whatever rounding left
            entries.retain(|(other, _)| *other != column);
            history = subtract(&history, factor, past);
            next = earlier + 1;
        }
        let scale = largest(&history).1.abs();
        let (column, pivot) = largest(&entries);
        echelon.independence.push(pivot.abs() / scale);
        if pivot.abs() > RANK_TOLERANCE * scale {
            pivots.insert(column, basis.len());
            basis.push(Reduced { entries, pivot, history });
        } else {
            let is_used =
                |(other, factor): &(usize, f64)| *other != at && factor.abs() > RANK_TOLERANCE * scale;
            echelon
                .dependent
                .push((at, history.into_iter().filter(is_used).map(|(other, _)| other).collect()));
        }
    }
    echelon.rank = basis.len();
    echelon
}

fn largest(row: &SparseRow<f64>) -> (usize, f64) {
    row.iter().copied().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())).unwrap_or((0, 0.0))
}
