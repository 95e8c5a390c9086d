//! Complementary pivoting: z ≥ 0 and w = M z + q ≥ 0, of which one or the other is 0 at each place (Lemke 1965).
//!
//! It ends with a solution where M is copositive, as that of stops with friction is (Stewart and Trinkle 1996), and there is
//! one without friction; else with one, or by a ray.

/// So many pairs at most: of sixteen contacts, of which eight are frictions with three pairs each.
pub(crate) const MOST_PAIRS: usize = 32;

/// A pivot is 0 below this size, as rows have the size 1,
const LEAST: f64 = 1e-11;
/// and below so many roundings of the largest entry of its row.
const ROUNDINGS: f64 = 1e3;
/// Pivots per pair, after which there is no end.
const PIVOTS: usize = 16;
/// Constants move by about this share where pivots do not end, so that no two rows become 0 at once.
const SHIFT: f64 = 1e-9;

/// Rows of basic variables by those that are 0, behind them the artificial one and the constants.
type Rows = [[f64; MOST_PAIRS + 2]; MOST_PAIRS];

/// A table of pivots.
pub(crate) struct Table {
    count: usize,
    rows: Rows,
    /// The variables of the rows: w by their places, behind them z, and the artificial one.
    basic: [usize; MOST_PAIRS],
    /// Those of the columns.
    zero: [usize; MOST_PAIRS + 1],
}

impl Table {
    /// Of so many pairs.
    pub fn new(count: usize) -> Self {
        let zero = core::array::from_fn(|at| at + count.min(MOST_PAIRS));
        let basic = core::array::from_fn(|at| at);
        Self { count: count.min(MOST_PAIRS), rows: [[0.0; MOST_PAIRS + 2]; MOST_PAIRS], basic, zero }
    }

    /// Adds to an entry of M.
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        if let Some(entry) = self.rows.get_mut(row).and_then(|row| row.get_mut(column)) {
            *entry += value;
        }
    }

    /// Sets q of a row.
    pub fn set(&mut self, row: usize, value: f64) {
        let last = self.count + 1;
        if let Some(entry) = self.rows.get_mut(row).and_then(|row| row.get_mut(last)) {
            *entry = value;
        }
    }

    /// Finds a solution; true if there is one. Where pivots do not end it tries once more with constants that are moved a little.
    pub fn solve(&mut self) -> bool {
        let start = (self.rows, self.basic, self.zero);
        if self.pivots() {
            return true;
        }
        (self.rows, self.basic, self.zero) = start;
        let last = self.count + 1;
        for (at, row) in self.rows.iter_mut().enumerate().take(self.count) {
            if let Some(q) = row.get_mut(last) {
                *q += SHIFT * (1.0 + at as f64 / MOST_PAIRS as f64) * (1.0 + q.abs());
            }
        }
        self.pivots()
    }

    /// True if z of a place may be more than 0, and w is 0.
    pub fn is_active(&self, at: usize) -> bool {
        self.basic.iter().take(self.count).any(|variable| *variable == at + self.count)
    }

    /// w of a place.
    pub fn rest(&self, at: usize) -> f64 {
        let row = self.basic.iter().take(self.count).position(|variable| *variable == at);
        row.map_or(0.0, |row| self.entry(row, self.count + 1))
    }

    fn entry(&self, row: usize, column: usize) -> f64 {
        self.rows.get(row).and_then(|row| row.get(column)).copied().unwrap_or(0.0)
    }

    /// The artificial variable enters, then the other one of each pair that has become 0, until it is 0 itself.
    fn pivots(&mut self) -> bool {
        let (count, artificial) = (self.count, 2 * self.count);
        let constant = |table: &Self, row: usize| table.entry(row, count + 1);
        let least = (0..count).reduce(
            |least, row| {
                if constant(self, row) < constant(self, least) { row } else { least }
            },
        );
        let Some(first) = least.filter(|row| constant(self, *row) < 0.0) else { return true };
        for row in self.rows.iter_mut().take(count) {
            if let Some(entry) = row.get_mut(count) {
                *entry = 1.0;
            }
        }
        let mut left = self.pivot(first, count);
        for _ in 0..PIVOTS * count {
            if left == artificial {
                return true;
            }
            let enters = if left < count { left + count } else { left - count };
            let column = self.zero.iter().take(count + 1).position(|variable| *variable == enters);
            let Some(column) = column else { return false };
            let Some(row) = self.leaving(column) else { return false };
            left = self.pivot(row, column);
        }
        false
    }

    /// The row that becomes 0 first where a column grows, of several the artificial one, or the first variable.
    fn leaving(&self, column: usize) -> Option<usize> {
        let falls = (0..self.count).filter(|row| self.entry(*row, column) < -self.rounding(*row));
        let ratio = |row: usize| self.entry(row, self.count + 1).max(0.0) / -self.entry(row, column);
        let rank = |row: usize| {
            let variable = self.basic.get(row).copied().unwrap_or(0);
            if variable == 2 * self.count { 0 } else { variable + 1 }
        };
        falls.reduce(|least, row| {
            let (of_least, of_row) = (ratio(least), ratio(row));
            let is_alike = (of_row - of_least).abs() <= LEAST * (of_row + of_least);
            let is_first = if is_alike { rank(row) < rank(least) } else { of_row < of_least };
            if is_first { row } else { least }
        })
    }

    /// Entries of a row up to this size are 0: behind a small pivot they are differences of large ones.
    fn rounding(&self, row: usize) -> f64 {
        let entries = self.rows.get(row).and_then(|row| row.get(..=self.count)).unwrap_or_default();
        entries.iter().fold(LEAST, |most, entry| most.max(ROUNDINGS * f64::EPSILON * entry.abs()))
    }

    /// Exchanges the variables of a row and of a column; gives that of the row.
    fn pivot(&mut self, row: usize, column: usize) -> usize {
        let width = self.count + 2;
        let inverse = 1.0 / self.entry(row, column);
        let Some(&before) = self.rows.get(row) else { return 2 * self.count };
        let above: [f64; MOST_PAIRS + 2] = core::array::from_fn(|at| match before.get(at) {
            _ if at == column => inverse,
            Some(entry) => -(entry * inverse),
            None => 0.0,
        });
        for (at, entries) in self.rows.iter_mut().enumerate().take(self.count) {
            if at == row {
                *entries = above;
                continue;
            }
            let factor = entries.get(column).copied().unwrap_or(0.0);
            for (to, (entry, above)) in entries.iter_mut().zip(above).enumerate().take(width) {
                *entry = if to == column { factor * above } else { *entry + factor * above };
            }
        }
        match (self.basic.get_mut(row), self.zero.get_mut(column)) {
            (Some(basic), Some(zero)) => {
                core::mem::swap(basic, zero);
                *zero
            }
            _ => 2 * self.count,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Table;

    fn active<const N: usize>(m: [[f64; N]; N], q: [f64; N]) -> Option<[bool; N]> {
        let mut table = Table::new(N);
        for (row, (entries, constant)) in m.into_iter().zip(q).enumerate() {
            table.set(row, constant);
            for (column, entry) in entries.into_iter().enumerate() {
                table.add(row, column, entry);
            }
        }
        table.solve().then(|| core::array::from_fn(|at| table.is_active(at)))
    }

    #[test]
    fn one_of_each_pair_is_zero() {
        assert_eq!(active([[2.0]], [-3.0]), Some([true]));
        assert_eq!(active([[2.0]], [3.0]), Some([false]));
        assert_eq!(active([[1.0, 0.9], [0.9, 1.0]], [-1.0, -0.5]), Some([true, false]));
        assert_eq!(active([[1.0, -0.5], [-0.5, 1.0]], [-1.0, 0.25]), Some([true, true]));
        // two that say the same, and two that contradict each other
        assert!(active([[1.0, 1.0], [1.0, 1.0]], [-1.0, -1.0]).is_some());
        assert_eq!(active([[1.0, -1.0], [-1.0, 1.0]], [-1.0, -1.0]), None);
    }

    /// Murty's example of degenerate pivots: least indices end it.
    #[test]
    fn rows_that_become_zero_at_once_end() {
        let m = [[1.0, 2.0, 0.0], [0.0, 1.0, 2.0], [2.0, 0.0, 1.0]];
        assert_eq!(active(m, [-1.0, -1.0, -1.0]), Some([true, true, true]));
    }
}
