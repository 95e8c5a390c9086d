//! Rows of which one is spare, but not the same one in every position.
//!
//! A rod on three parallel cranks is held once too often. No choice of a row to leave out lasts for a turn:
//! each says nothing of its own in some position of the cranks.
//!
//! Behind all other pivots the matrix K over m such rows has rank m − 1 and is semidefinite, with K n = 0. Its adjugate
//! is a multiple of n nᵀ, so Π = adj K / tr adj K projects on n, without a choice and without a root. In place of K
//!
//! K + (tr K) Π
//!
//! is eliminated, which is regular and has the same solutions for right-hand sides without a part along n (deflation,
//! Wielandt 1944). What rounding leaves along n moves nothing.
//!
//! # Limits
//!
//! Minors of m − 1 rows cancel as the ratios of the eigenvalues of K multiply. For one or two pins in similar lengths
//! and masses these are of the order of 10.

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
        let adjugate = adjugate(self.arena, &block);
        let [trace, of_adjugate] = [&block, &adjugate].map(|matrix| {
            let diagonal: Vec<_> = (0..rows.len()).map(|at| (matrix[at][at], Number::ONE)).collect();
            self.arena.sum(&diagonal)
        });
        let factor = self.arena.product(&[(trace, 1), (of_adjugate, -1)]);
        let factor = self.arena.share(factor);
        for (i, &a) in rows.iter().enumerate() {
            for (j, &b) in rows.iter().enumerate().skip(i) {
                let addition = self.arena.mul(factor, adjugate[i][j]);
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

/// The adjugate of a symmetric matrix: the cofactors, each computed once.
fn adjugate(arena: &mut Arena, matrix: &[Vec<Expr>]) -> Vec<Vec<Expr>> {
    let size = matrix.len();
    let mut cofactors = vec![vec![arena.zero(); size]; size];
    for i in 0..size {
        for j in i..size {
            let without = |skipped: usize| (0..size).filter(|at| *at != skipped).collect::<Vec<_>>();
            let minor = determinant(arena, matrix, &without(i), &without(j));
            let cofactor = if (i + j) % 2 == 0 { minor } else { arena.neg(minor) };
            (cofactors[i][j], cofactors[j][i]) = (cofactor, cofactor);
        }
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
