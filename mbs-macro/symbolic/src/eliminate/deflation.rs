//! Rows of which one is spare, but not the same one in every position.
//!
//! A rod on three parallel cranks is held once too often. No row can be left out for a whole turn, since each says
//! nothing of its own in some position of the cranks.
//!
//! Such rows are eliminated last. The matrix K over m of them is then semidefinite of rank m − 1, with K n = 0. In its place
//!
//! K + (tr K) c cᵀ
//!
//! is eliminated (deflation, Wielandt 1944). It is regular for every c that is not normal to n. A right-hand side b of K has
//! n·b = 0, and so the solution λ has c·λ = 0 and K λ = b. Rounding leaves a part of b along n, which moves nothing.
//!
//! The adjugate of K is a multiple of n nᵀ. So c cᵀ = adj K / tr adj K needs neither a choice nor a root. The minors cancel:
//! with the other eigenvalues s₁ ≥ s₂ ≥ s₃ of K they are known to ε s₁²/(s₂ s₃). The matrix is squared twice, so that it is of
//! rank 1 to the fourth power of that. Of two rows nothing is squared: there K + (tr K) c cᵀ is tr K times 1.

use super::factorization::Work;
use super::matrix::Unknown;
use crate::arena::{Arena, Expr};
use crate::number::Number;

impl Work<'_> {
    /// K ← K + (tr K) adj K / tr adj K
    pub(super) fn deflate(&mut self, rows: &[Unknown]) {
        let zero = self.arena.zero();
        let mut block = Vec::new();
        for &a in rows {
            let entries: Vec<Expr> = rows.iter().map(|&b| self.matrix.get(a, b).unwrap_or(zero)).collect();
            block.push(entries.into_iter().zip(rows).map(|(entry, &b)| self.close(a, b, entry)).collect());
        }
        let of_block = trace(self.arena, &block);
        let mut projection = adjugate(self.arena, &block);
        let mut size = trace(self.arena, &projection);
        if rows.len() > 2 {
            for _ in 0..SQUARINGS {
                projection = squared(self.arena, &projection, size);
                size = trace(self.arena, &projection);
            }
        }
        let factor = self.arena.product(&[(of_block, 1), (size, -1)]);
        let factor = self.arena.share(factor);
        for (i, &a) in rows.iter().enumerate() {
            for (j, &b) in rows.iter().enumerate().skip(i) {
                let addition = self.arena.mul(factor, projection[i][j]);
                let entry = self.arena.add(block[i][j], addition);
                let entry = self.close(a, b, entry);
                self.set(a, b, entry);
            }
        }
        // what the step before made of the diagonal is no longer there
        self.reductions.clear();
        self.matrix.release(rows);
    }
}

/// After two squarings an error of 10⁻⁴ is a rounding.
const SQUARINGS: usize = 2;

fn trace(arena: &mut Arena, matrix: &[Vec<Expr>]) -> Expr {
    let diagonal: Vec<_> = matrix.iter().enumerate().map(|(at, row)| (row[at], Number::ONE)).collect();
    arena.sum(&diagonal)
}

/// (A/s)² of a symmetric matrix A.
fn squared(arena: &mut Arena, matrix: &[Vec<Expr>], size: Expr) -> Vec<Vec<Expr>> {
    let per_size = arena.powi(size, -1);
    let per_size = arena.share(per_size);
    let of_size_one: Vec<Vec<Expr>> = matrix
        .iter()
        .map(|row| {
            row.iter()
                .map(|&entry| {
                    let entry = arena.mul(entry, per_size);
                    arena.share(entry)
                })
                .collect()
        })
        .collect();
    let mut square = Vec::new();
    for a in &of_size_one {
        let mut row = Vec::new();
        for b in &of_size_one {
            let terms: Vec<_> = a.iter().zip(b).map(|(&a, &b)| (arena.mul(a, b), Number::ONE)).collect();
            let entry = arena.sum(&terms);
            row.push(arena.share(entry));
        }
        square.push(row);
    }
    square
}

/// The adjugate of a symmetric matrix: the cofactors, each computed once.
fn adjugate(arena: &mut Arena, matrix: &[Vec<Expr>]) -> Vec<Vec<Expr>> {
    let size = matrix.len();
    let mut cofactors = vec![vec![arena.zero(); size]; size];
    for (i, j) in (0..size).flat_map(|i| (i..size).map(move |j| (i, j))) {
        let without = |skipped: usize| (0..size).filter(|at| *at != skipped).collect::<Vec<_>>();
        let minor = determinant(arena, matrix, &without(i), &without(j));
        let cofactor = if (i + j) % 2 == 0 { minor } else { arena.neg(minor) };
        (cofactors[i][j], cofactors[j][i]) = (cofactor, cofactor);
    }
    cofactors
}

/// The determinant of some rows and columns, by the first row; of none it is 1.
fn determinant(arena: &mut Arena, matrix: &[Vec<Expr>], rows: &[usize], columns: &[usize]) -> Expr {
    let Some((&first, rest)) = rows.split_first() else { return arena.one() };
    let mut terms = Vec::new();
    for (at, &column) in columns.iter().enumerate() {
        let others: Vec<usize> = columns.iter().copied().filter(|other| *other != column).collect();
        let minor = determinant(arena, matrix, rest, &others);
        let sign = if at % 2 == 0 { Number::ONE } else { Number::MINUS_ONE };
        terms.push((arena.mul(matrix[first][column], minor), sign));
    }
    let sum = arena.sum(&terms);
    arena.share(sum)
}
