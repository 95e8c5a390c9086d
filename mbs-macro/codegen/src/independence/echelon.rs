//! Rows of numbers brought to echelon form.
//!
//! Of rows that repeat each other, those are kept that say most of their own.

use super::sparse::{Pivots, SparseRow, subtract};

/// The part of a row that earlier rows do not explain counts as 0 below this,
/// measured against the row's largest entry and the largest factor that went
/// into it: far above rounding (1e-16 times a few hundred operations), far
/// below what a position of a regular mechanism gives.
pub const RANK_TOLERANCE: f64 = 1e-9;

/// A row with less than this of its own waits until those were looked at that have more. Otherwise two bars
/// nearly in line would hold a node across their line, where a third one holds it well.
const LEVELS: [f64; 3] = [0.1, 0.01, 1e-4];

/// The result of an elimination.
#[derive(Clone)]
pub struct Echelon {
    rank: usize,
    /// Rows that are combinations of others, and of which.
    pub dependent: Vec<(usize, Vec<usize>)>,
    /// Per row, the relative size of what the rows looked at before do not explain.
    pub independence: Vec<f64>,
}

impl Echelon {
    pub fn rank(&self) -> usize {
        self.rank
    }
}

/// Gaussian elimination, row by row with the largest entry of each as pivot,
/// so that a dependent row is the one declared last, or else one of those that
/// say little of their own.
pub fn row_echelon(rows: Vec<SparseRow<f64>>) -> Echelon {
    row_echelon_within(rows, RANK_TOLERANCE)
}

/// The same with another share below which the rest of a row counts as 0.
pub fn row_echelon_within(rows: Vec<SparseRow<f64>>, tolerance: f64) -> Echelon {
    let (basis, dependent, independence) = reduced(&rows, tolerance);
    let explained = |rest: Reduced| (rest.at, rest.explained_by(tolerance));
    Echelon {
        rank: basis.rows.len(),
        dependent: dependent.into_iter().map(explained).collect(),
        independence,
    }
}

/// The rest of a row that others explain, at positions that are closed to 1e-10.
const EXPLAINED: f64 = 1e-6;

/// Factors of rows with which they sum to 0, as many as rows depend on others.
pub fn null_vectors(rows: Vec<SparseRow<f64>>) -> Vec<SparseRow<f64>> {
    reduced(&rows, EXPLAINED).1.into_iter().map(|rest| rest.history).collect()
}

/// The columns whose unit vectors are independent of rows and of each other, in the given order.
pub fn free_columns(rows: &[SparseRow<f64>], columns: &[usize]) -> Vec<usize> {
    let mut basis = reduced(rows, EXPLAINED).0;
    let mut free = Vec::new();
    for &column in columns {
        let rest = basis.rest(rows.len() + column, &vec![(column, 1.0)]);
        if !rest.entries.is_empty() && rest.share() > EXPLAINED {
            basis.insert(rest);
            free.push(column);
        }
    }
    free
}

/// A basis, what is left of the rows that depend on others, and how much of each row others do not explain.
fn reduced(rows: &[SparseRow<f64>], tolerance: f64) -> (Basis, Vec<Reduced>, Vec<f64>) {
    let mut basis = Basis::default();
    let mut independence = vec![0.0; rows.len()];
    let mut waiting: Vec<usize> = (0..rows.len()).collect();
    let mut dependent = Vec::new();
    for level in LEVELS.into_iter().filter(|level| *level > tolerance).chain([tolerance]) {
        dependent.clear();
        for at in std::mem::take(&mut waiting) {
            let rest = basis.rest(at, &rows[at]);
            independence[at] = rest.share();
            if rest.share() > level {
                basis.insert(rest);
            } else {
                waiting.push(at);
                dependent.push(rest);
            }
        }
    }
    (basis, dependent, independence)
}

/// A reduced row and how it came from the given rows.
struct Reduced {
    /// The given row that it is what is left of.
    at: usize,
    entries: SparseRow<f64>,
    history: SparseRow<f64>,
}

/// Reduced rows that are independent of each other.
#[derive(Default)]
struct Basis {
    rows: Vec<Reduced>,
    pivots: Pivots,
}

impl Basis {
    /// The part of a row that the rows of the basis do not explain.
    fn rest(&self, at: usize, row: &SparseRow<f64>) -> Reduced {
        let mut rest = Reduced { at, entries: row.clone(), history: vec![(at, 1.0)] };
        let mut next = 0;
        while let Some((earlier, column, entry)) = self.pivots.first(&rest.entries, next) {
            let other = &self.rows[earlier];
            let factor = entry / other.pivot().1;
            rest.entries = subtract(&rest.entries, factor, &other.entries);
            // exactly, whatever rounding left
            rest.entries.retain(|(other, _)| *other != column);
            rest.history = subtract(&rest.history, factor, &other.history);
            next = earlier + 1;
        }
        rest
    }

    fn insert(&mut self, rest: Reduced) {
        self.pivots.insert(rest.pivot().0, self.rows.len());
        self.rows.push(rest);
    }
}

impl Reduced {
    /// The column of the largest entry, and that entry.
    fn pivot(&self) -> (usize, f64) {
        largest(&self.entries)
    }

    /// The largest factor of a given row.
    fn scale(&self) -> f64 {
        largest(&self.history).1.abs()
    }

    /// The size of the row, relative to the largest factor that went into it.
    fn share(&self) -> f64 {
        self.pivot().1.abs() / self.scale()
    }

    /// The given rows that this one is a combination of.
    fn explained_by(self, tolerance: f64) -> Vec<usize> {
        let (at, least) = (self.at, tolerance * self.scale());
        let is_used = |(other, factor): &(usize, f64)| *other != at && factor.abs() > least;
        self.history.into_iter().filter(is_used).map(|(other, _)| other).collect()
    }
}

fn largest(row: &SparseRow<f64>) -> (usize, f64) {
    row.iter().copied().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())).unwrap_or((0, 0.0))
}
