//! Multipliers of constraints of which some repeat others.
//!
//! A redundant row d is a combination of the rows that are eliminated, dᵀ = Σ cᵣ Φ_q,ᵣᵀ, with the c that
//! M u + Φ_qᵀ c = dᵀ, Φ_q u = 0 gives. So n = c − e_d holds nothing: Φ_qᵀ n = 0. Of all multipliers with the same
//! force those of least norm have no part along any n. The vectors n are made orthogonal one after the other
//! (Gram and Schmidt), and the part along each is taken away.
//!
//! In a set one row is spare (`independence/sets.rs`), and every row gives a multiple g of the same n. One multiple may
//! vanish, but not all. The part along n is Σ g (g·λ) / Σ g·g over all of them.
//!
//! The solutions for c come from the factorization of the step. The redundant rows themselves are watched by
//! the runtime (`spare.rs`).

use std::collections::BTreeMap;

use mbs_symbolic::{Arena, Expr, Factorization, Number, Unknown};

use crate::derive::Equations;
use crate::independence::Rows;

/// The multipliers of all rows, given those of the rows that are eliminated.
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
    for row in rows.eliminated() {
        multipliers[row] = arena.share(multipliers[row]);
    }
    let mut directions: Vec<Direction> = Vec::new();
    let alone = rows.left_out.iter().map(std::slice::from_ref);
    for set in rows.sets.iter().map(Vec::as_slice).chain(alone) {
        let vectors =
            set.iter().map(|&row| null_vector(arena, equations, rows, factorization, row)).collect();
        let direction = Direction::new(arena, vectors, &directions);
        directions.push(direction);
    }
    for direction in &directions {
        for (row, part) in direction.part(arena, |row| multipliers[*row]) {
            multipliers[row] = arena.sub(multipliers[row], part);
        }
    }
    multipliers
}

/// A combination of rows that holds nothing, by row.
type Vector = BTreeMap<usize, Expr>;

/// Parallel vectors of which one does not vanish, and 1/Σ g·g.
struct Direction {
    vectors: Vec<Vector>,
    per_square: Expr,
}

impl Direction {
    /// The parts of these vectors that are orthogonal to the directions before.
    fn new(arena: &mut Arena, mut vectors: Vec<Vector>, before: &[Self]) -> Self {
        for vector in &mut vectors {
            for direction in before {
                let zero = arena.zero();
                let part = direction.part(arena, |row| vector.get(row).copied().unwrap_or(zero));
                for (row, part) in part {
                    let entry = vector.get(&row).copied().unwrap_or(zero);
                    let entry = arena.sub(entry, part);
                    vector.insert(row, arena.share(entry));
                }
            }
        }
        let squares: Vec<_> = vectors.iter().flat_map(|vector| vector.values()).collect();
        let squares: Vec<_> = squares.into_iter().map(|&entry| (arena.powi(entry, 2), Number::ONE)).collect();
        let square = arena.sum(&squares);
        let per_square = arena.powi(square, -1);
        let per_square = arena.share(per_square);
        Self { vectors, per_square }
    }

    /// The part along this direction of what has these values by row.
    fn part(&self, arena: &mut Arena, of: impl Fn(&usize) -> Expr) -> Vec<(usize, Expr)> {
        let mut part: BTreeMap<usize, Vec<(Expr, Number)>> = BTreeMap::new();
        for vector in &self.vectors {
            let terms: Vec<_> =
                vector.iter().map(|(row, &entry)| (arena.mul(entry, of(row)), Number::ONE)).collect();
            let along = arena.sum(&terms);
            let along = arena.mul(along, self.per_square);
            let along = arena.share(along);
            for (&row, &entry) in vector {
                part.entry(row).or_default().push((arena.mul(entry, along), Number::ONE));
            }
        }
        part.into_iter().map(|(row, terms)| (row, arena.sum(&terms))).collect()
    }
}

/// c − e_d for a row d that is left out, or of a set.
fn null_vector(
    arena: &mut Arena,
    equations: &Equations,
    rows: &Rows,
    factorization: &Factorization,
    row: usize,
) -> Vector {
    let entries = equations.phi_q[row].iter();
    let rhs = entries.map(|(&column, &entry)| (Unknown::Coordinate(column), entry)).collect();
    let solution = factorization.solve(arena, &rhs);
    let of = |row: usize| Some((row, *solution.get(&Unknown::Row(row))?));
    let mut vector: Vector = rows.eliminated().filter_map(of).collect();
    let zero = arena.zero();
    let own = vector.get(&row).copied().unwrap_or(zero);
    let one = arena.one();
    vector.insert(row, arena.sub(own, one));
    vector.retain(|_, entry| !arena.is_zero(*entry));
    vector.into_iter().map(|(row, entry)| (row, arena.share(entry))).collect()
}
