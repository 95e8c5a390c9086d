//! The shortest correction that removes residuals of sparse rows.
//!
//! The Cholesky factorization works within the envelope of the matrix. Rows are in Cuthill and McKee's
//! order, which makes the envelope narrow.

use std::collections::VecDeque;

use super::sparse::SparseRow;

/// Jᵀ (J Jᵀ + μ)⁻¹ r, the shortest correction as far as μ allows, of as many
/// coordinates as `columns` says; by Cholesky's method within the envelope of the
/// matrix, with the rows in an order that makes it narrow.
pub fn least_correction(rows: &[&SparseRow<f64>], columns: usize, residual: &[f64], mu: f64) -> Vec<f64> {
    let mut holders: Vec<Vec<(usize, f64)>> = vec![Vec::new(); columns];
    for (at, row) in rows.iter().enumerate() {
        row.iter().for_each(|&(column, entry)| holders[column].push((at, entry)));
    }
    let order = narrow_order(rows, &holders);
    let mut places = vec![0; rows.len()];
    order.iter().enumerate().for_each(|(place, &row)| places[row] = place);

    let mut factor: Vec<Line> = Vec::with_capacity(rows.len());
    let mut y: Vec<f64> = Vec::with_capacity(rows.len());
    for (i, &row) in order.iter().enumerate() {
        let mut line = products(rows[row], &holders, &places, i);
        let Line { first, entries } = &mut line;
        for j in *first..=i {
            let sum = if j == i {
                entries[..i - *first].iter().map(|x| x * x).sum()
            } else {
                let from = factor[j].first.max(*first);
                let others = &factor[j].entries[from - factor[j].first..];
                entries[from - *first..j - *first].iter().zip(others).map(|(x, y)| x * y).sum::<f64>()
            };
            let entry = entries[j - *first] - sum;
            entries[j - *first] =
                if j == i { (entry + mu).max(mu * 1e-3).sqrt() } else { entry / factor[j].diagonal() };
        }
        let known: f64 = line.entries.iter().zip(&y[line.first..]).map(|(x, y)| x * y).sum();
        y.push((residual[row] - known) / line.diagonal());
        factor.push(line);
    }
    for (i, line) in factor.iter().enumerate().rev() {
        y[i] /= line.diagonal();
        let known = y[i];
        line.entries.iter().zip(&mut y[line.first..i]).for_each(|(x, y)| *y -= x * known);
    }
    let mut correction = vec![0.0; columns];
    for (&row, y) in order.iter().zip(y) {
        rows[row].iter().for_each(|&(column, entry)| correction[column] += entry * y);
    }
    correction
}

/// A row of a triangular matrix from its first entry to the diagonal.
struct Line {
    first: usize,
    entries: Vec<f64>,
}

impl Line {
    fn diagonal(&self) -> f64 {
        self.entries.last().copied().unwrap_or(1.0)
    }
}

/// The products of a row, the one at the place `last`, with those before it and
/// with itself.
fn products(row: &SparseRow<f64>, holders: &[Vec<(usize, f64)>], places: &[usize], last: usize) -> Line {
    let met =
        || row.iter().flat_map(|&(column, x)| holders[column].iter().map(move |&(r, y)| (places[r], x * y)));
    let first = met().map(|(place, _)| place).min().unwrap_or(last);
    let mut entries = vec![0.0; last + 1 - first];
    met().filter(|(place, _)| *place <= last).for_each(|(place, product)| entries[place - first] += product);
    Line { first, entries }
}

/// The rows outwards from an end of the mechanism, neighbours next to each other
/// (Cuthill and McKee 1969).
fn narrow_order(rows: &[&SparseRow<f64>], holders: &[Vec<(usize, f64)>]) -> Vec<usize> {
    let neighbours =
        |row: usize| rows[row].iter().flat_map(|(column, _)| &holders[*column]).map(|(row, _)| *row);
    let outwards = |start: usize, seen: &mut Vec<bool>| {
        let mut order = Vec::new();
        let mut queue = VecDeque::from([start]);
        seen[start] = true;
        while let Some(row) = queue.pop_front() {
            order.push(row);
            let mut next: Vec<usize> =
                neighbours(row).filter(|&row| !std::mem::replace(&mut seen[row], true)).collect();
            next.sort_by_key(|&row| neighbours(row).count());
            queue.extend(next);
        }
        order
    };
    let mut order = Vec::with_capacity(rows.len());
    let mut seen = vec![false; rows.len()];
    for start in 0..rows.len() {
        if seen[start] {
            continue;
        }
        // what is reached last is an end
        let end = outwards(start, &mut seen.clone()).pop().unwrap_or(start);
        order.extend(outwards(end, &mut seen));
    }
    order
}
