//! Rows of numbers brought to echelon form.

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
pub fn row_echelon(rows: Vec<Vec<f64>>) -> Echelon {
    /// A reduced row, its pivot column, and how it came from the given rows.
    struct Reduced {
        entries: Vec<f64>,
        pivot: usize,
        history: Vec<f64>,
    }
    let count = rows.len();
    let mut basis: Vec<Reduced> = Vec::new();
    let mut echelon = Echelon { rank: 0, dependent: Vec::new(), independence: Vec::new() };
    for (at, mut entries) in rows.into_iter().enumerate() {
        let mut history = vec![0.0; count];
        history[at] = 1.0;
        for earlier in &basis {
            let factor = entries[earlier.pivot] / earlier.entries[earlier.pivot];
            subtract(&mut entries, factor, &earlier.entries);
            subtract(&mut history, factor, &earlier.history);
        }
        let scale = largest(&history).1;
        let (pivot, size) = largest(&entries);
        echelon.independence.push(size / scale);
        if size > RANK_TOLERANCE * scale {
            basis.push(Reduced { entries, pivot, history });
        } else {
            let used = (0..at).filter(|&other| history[other].abs() > RANK_TOLERANCE * scale).collect();
            echelon.dependent.push((at, used));
        }
    }
    echelon.rank = basis.len();
    echelon
}

fn largest(row: &[f64]) -> (usize, f64) {
    row.iter().map(|x| x.abs()).enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0))
}

/// Most factors are 0 in a large mechanism, whose rows are sparse.
fn subtract(row: &mut [f64], factor: f64, other: &[f64]) {
    if factor == 0.0 {
        return;
    }
    for (x, y) in row.iter_mut().zip(other) {
        *x -= factor * y;
    }
}
