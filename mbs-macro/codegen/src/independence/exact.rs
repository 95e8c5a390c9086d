//! Rows that depend on others, in exact arithmetic.

use mbs_symbolic::Residue;

use super::sparse::{Pivots, SparseRow, subtract};

/// The rows that are combinations of earlier ones, and of which: exact.
pub fn dependent_rows(rows: Vec<SparseRow<Residue>>) -> Vec<(usize, Vec<usize>)> {
    /// Divided by its pivot, with how it came from the given rows.
    struct Reduced {
        entries: SparseRow<Residue>,
        history: SparseRow<Residue>,
    }
    let mut basis: Vec<Reduced> = Vec::new();
    let mut pivots = Pivots::default();
    let mut dependent = Vec::new();
    for (at, mut entries) in rows.into_iter().enumerate() {
        entries.retain(|(_, entry)| *entry != Residue::ZERO);
        let mut history = vec![(at, Residue::ONE)];
        let mut next = 0;
        while let Some((earlier, _, factor)) = pivots.first(&entries, next) {
            entries = subtract(&entries, factor, &basis[earlier].entries);
            history = subtract(&history, factor, &basis[earlier].history);
            next = earlier + 1;
        }
        let first = entries.first().and_then(|(pivot, entry)| Some((*pivot, entry.inverse()?)));
        let Some((pivot, inverse)) = first else {
            dependent.push((at, history.into_iter().map(|(row, _)| row).filter(|&row| row != at).collect()));
            continue;
        };
        for (_, entry) in entries.iter_mut().chain(&mut history) {
            *entry = *entry * inverse;
        }
        pivots.insert(pivot, basis.len());
        basis.push(Reduced { entries, history });
    }
    dependent
}

#[cfg(test)]
mod tests {
    use super::{Residue, SparseRow, dependent_rows};

    #[test]
    fn a_dependent_row_names_the_rows_it_is_made_of() {
        let row = |entries: &[i64]| -> SparseRow<Residue> {
            entries.iter().enumerate().map(|(at, &x)| (at, Residue::integer(x))).collect()
        };
        let rows = vec![row(&[1, 2, 3]), row(&[0, 1, 1]), row(&[1, 0, 0]), row(&[2, 5, 7]), row(&[0, 0, 0])];
        assert_eq!(dependent_rows(rows), [(3, vec![0, 1]), (4, vec![])]);
    }
}
