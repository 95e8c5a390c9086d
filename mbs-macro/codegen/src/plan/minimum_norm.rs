//! Multipliers of constraints of which some repeat others.
//!
//! Only the independent rows B are solved for; the redundant ones are D = C·B,
//! with the C that M u + Bᵀ cᵀ = Dᵀ, B u = 0 gives. The force Bᵀ λ_b is then
//! shared by all rows: of the multipliers with Bᵀ λ + Dᵀ μ = Bᵀ λ_b, those of
//! least norm are μ = (1 + C Cᵀ)⁻¹ C λ_b and λ = λ_b − Cᵀ μ.
//!
//! The solutions for C come from the factorization of the step. The redundant rows themselves are watched by
//! the runtime (`spare.rs`).
//!
//! # Limits
//!
//! The independent rows are fixed at compile time. So a motion ends in a position where they depend on each
//! other, even if other rows would lead on.

use std::collections::BTreeMap;

use mbs_symbolic::{Arena, Expr, Factorization, Number, Unknown};

use crate::derive::Equations;
use crate::independence::Rows;

/// The multipliers of all rows, given those of the independent ones.
pub fn multipliers(
    arena: &mut Arena,
    equations: &Equations,
    rows: &Rows,
    factorization: &Factorization,
    solution: &BTreeMap<Unknown, Expr>,
) -> Vec<Expr> {
    let zero = arena.zero();
    let of = |row: usize| solution.get(&Unknown::Row(row)).copied().unwrap_or(zero);
    let mut multipliers: Vec<Expr> = (0..equations.phi.len()).map(of).collect();
    if rows.redundant.is_empty() {
        return multipliers;
    }
    for &row in &rows.basis {
        multipliers[row] = arena.share(multipliers[row]);
    }
    let combinations: Vec<Combination> =
        rows.redundant.iter().map(|&row| combination(arena, equations, rows, factorization, row)).collect();
    let mut forces = Vec::new();
    for combination in &combinations {
        let terms: Vec<_> = combination.iter().map(|(&row, &entry)| (entry, multipliers[row])).collect();
        forces.push(contraction(arena, &terms));
    }
    let gram = gram(arena, &combinations);
    let shares = solve(arena, gram, forces);
    for (&row, &share) in rows.redundant.iter().zip(&shares) {
        multipliers[row] = share;
    }
    for &row in &rows.basis {
        let mut terms = vec![(multipliers[row], Number::ONE)];
        for (combination, &share) in combinations.iter().zip(&shares) {
            if let Some(&entry) = combination.get(&row) {
                terms.push((arena.mul(entry, share), Number::MINUS_ONE));
            }
        }
        multipliers[row] = arena.sum(&terms);
    }
    multipliers
}

/// A redundant row as a combination of independent ones.
type Combination = BTreeMap<usize, Expr>;

fn combination(
    arena: &mut Arena,
    equations: &Equations,
    rows: &Rows,
    factorization: &Factorization,
    redundant: usize,
) -> Combination {
    let entries = equations.phi_q[redundant].iter();
    let rhs = entries.map(|(&column, &entry)| (Unknown::Coordinate(column), entry)).collect();
    let solution = factorization.solve(arena, &rhs);
    let of = |&row: &usize| Some((row, *solution.get(&Unknown::Row(row))?));
    let found: Vec<(usize, Expr)> = rows.basis.iter().filter_map(of).collect();
    let found = found.into_iter().filter(|(_, entry)| !arena.is_zero(*entry)).collect::<Vec<_>>();
    found.into_iter().map(|(row, entry)| (row, arena.share(entry))).collect()
}

/// The lower half of 1 + C Cᵀ: positive definite whatever C is.
fn gram(arena: &mut Arena, combinations: &[Combination]) -> Vec<Vec<Expr>> {
    let mut matrix = Vec::new();
    for (i, a) in combinations.iter().enumerate() {
        let mut line = Vec::new();
        for b in &combinations[..=i] {
            let terms: Vec<_> = a.iter().filter_map(|(row, &x)| Some((x, *b.get(row)?))).collect();
            line.push(contraction(arena, &terms));
        }
        let one = arena.one();
        line[i] = arena.add(line[i], one);
        matrix.push(line);
    }
    matrix
}

/// The solution of a positive definite system of which the lower half is given,
/// by elimination in the given order.
fn solve(arena: &mut Arena, mut matrix: Vec<Vec<Expr>>, mut rhs: Vec<Expr>) -> Vec<Expr> {
    let size = rhs.len();
    let mut inverses = Vec::new();
    for k in 0..size {
        let pivot = arena.share(matrix[k][k]);
        let inverse = arena.powi(pivot, -1);
        let inverse = arena.share(inverse);
        inverses.push(inverse);
        for i in k + 1..size {
            let factor = arena.mul(matrix[i][k], inverse);
            let factor = arena.share(factor);
            let column: Vec<Expr> = matrix[k + 1..=i].iter().map(|line| line[k]).collect();
            for (entry, other) in matrix[i][k + 1..].iter_mut().zip(column) {
                let product = arena.mul(factor, other);
                let updated = arena.sub(*entry, product);
                *entry = arena.share(updated);
            }
            let product = arena.mul(factor, rhs[k]);
            let entry = arena.sub(rhs[i], product);
            rhs[i] = arena.share(entry);
        }
    }
    for k in (0..size).rev() {
        let mut terms = vec![(rhs[k], Number::ONE)];
        for i in k + 1..size {
            terms.push((arena.mul(matrix[i][k], rhs[i]), Number::MINUS_ONE));
        }
        let sum = arena.sum(&terms);
        let value = arena.mul(sum, inverses[k]);
        rhs[k] = arena.share(value);
    }
    rhs
}

/// Σ a·b
fn contraction(arena: &mut Arena, pairs: &[(Expr, Expr)]) -> Expr {
    let terms: Vec<_> = pairs.iter().map(|&(a, b)| (arena.mul(a, b), Number::ONE)).collect();
    arena.sum(&terms)
}
