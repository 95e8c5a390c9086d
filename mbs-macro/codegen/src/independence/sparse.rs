//! Rows of which most entries are 0, as those of a large mechanism are.

use rustc_hash::FxHashMap as HashMap;
use std::ops::{Mul, Sub};

/// The entries that are not 0, with their columns in order.
pub type SparseRow<V> = Vec<(usize, V)>;

/// row − factor·other
pub fn subtract<V>(row: &SparseRow<V>, factor: V, other: &SparseRow<V>) -> SparseRow<V>
where
    V: Copy + Default + PartialEq + Mul<Output = V> + Sub<Output = V>,
{
    let mut difference = Vec::with_capacity(row.len() + other.len());
    let (mut rest, mut others) = (row.as_slice(), other.as_slice());
    while let Some(&(column, entry)) = others.first() {
        let before = rest.partition_point(|(earlier, _)| *earlier < column);
        difference.extend_from_slice(&rest[..before]);
        rest = &rest[before..];
        others = &others[1..];
        let own = match rest.first() {
            Some(&(same, own)) if same == column => {
                rest = &rest[1..];
                own
            }
            _ => V::default(),
        };
        let entry = own - factor * entry;
        if entry != V::default() {
            difference.push((column, entry));
        }
    }
    difference.extend_from_slice(rest);
    difference
}

/// Divides a row by its largest entry, and gives that; 1 where there is none.
pub fn scale(row: &mut SparseRow<f64>) -> f64 {
    let largest = row.iter().fold(0.0_f64, |largest, (_, x)| largest.max(x.abs()));
    let scale = if largest > 0.0 { largest } else { 1.0 };
    row.iter_mut().for_each(|(_, x)| *x /= scale);
    scale
}

/// Which row of a basis has its pivot in which column.
#[derive(Default)]
pub struct Pivots {
    rows: HashMap<usize, usize>,
}

impl Pivots {
    pub fn insert(&mut self, column: usize, row: usize) {
        self.rows.insert(column, row);
    }

    /// The first row of the basis, from `next` on, whose pivot column has an
    /// entry in `entries`; that column, and the entry.
    pub fn first<V: Copy>(&self, entries: &SparseRow<V>, next: usize) -> Option<(usize, usize, V)> {
        let met =
            entries.iter().filter_map(|&(column, entry)| Some((*self.rows.get(&column)?, column, entry)));
        met.filter(|(row, ..)| *row >= next).min_by_key(|(row, ..)| *row)
    }
}
