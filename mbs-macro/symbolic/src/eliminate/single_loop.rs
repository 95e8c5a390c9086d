//! The last row with its two coordinates: what a mechanism of one closed loop
//! and one degree of freedom comes down to.
//!
//! ⎡A  B  a⎤ ⎡u⎤   ⎡f⎤
//! ⎢B  C  b⎥ ⎢v⎥ = ⎢g⎥
//! ⎣a  b  0⎦ ⎣λ⎦   ⎣h⎦
//!
//! By Cramer's rule, with the null vector n = (−b, a) of the row, (p, q) = Mn and
//! D = nᵀMn, the negative of the determinant:
//!
//! u = (q h − b r)/D, v = (a r − p h)/D, λ = (q f − p g − (AC − B²) h)/D, r = a g − b f.
//!
//! One division, and no sum waits for it. D is positive with the masses, and vanishes only
//! with the row.

use std::collections::BTreeMap;

use super::matrix::{Kkt, Unknown};
use super::sums::Sums;
use crate::arena::{Arena, Expr};

/// The step; names as in the module's equations.
pub(super) struct SingleLoop {
    pub(super) row: Unknown,
    pub(super) coordinates: [Unknown; 2],
    /// (a, b)
    pub(super) entries: [Expr; 2],
    /// A, B, C
    pub(super) masses: [Expr; 3],
    /// (p, q)
    momentum: [Expr; 2],
    /// 1/D
    pub(super) inverse: Expr,
}

impl SingleLoop {
    /// The step that takes these unknowns out of the matrix.
    pub(super) fn new(arena: &mut Arena, matrix: &Kkt, row: Unknown, coordinates: [Unknown; 2]) -> Self {
        let [first, second] = coordinates;
        let zero = arena.zero();
        let mut entry = |one, other| {
            let entry = matrix.get(one, other).unwrap_or(zero);
            arena.share(entry)
        };
        let [a, b] = [entry(row, first), entry(row, second)];
        let masses = [entry(first, first), entry(first, second), entry(second, second)];

        let momentum = [
            difference(arena, (a, masses[1]), (b, masses[0])),
            difference(arena, (a, masses[2]), (b, masses[1])),
        ];
        let determinant = difference(arena, (a, momentum[1]), (b, momentum[0]));
        let inverse = arena.powi(determinant, -1);
        let inverse = arena.share(inverse);
        Self { row, coordinates, entries: [a, b], masses, momentum, inverse }
    }

    /// Takes (f, g, h) out of the right-hand side; gives r, h, f and g.
    pub(super) fn forward(
        &self,
        arena: &mut Arena,
        rhs: &mut BTreeMap<Unknown, Expr>,
        sums: Sums,
    ) -> [Expr; 4] {
        let zero = arena.zero();
        let mut take = |unknown| {
            let value = rhs.remove(&unknown).unwrap_or(zero);
            sums.close(arena, value)
        };
        let [f, g] = self.coordinates.map(&mut take);
        let h = take(self.row);
        let [a, b] = self.entries;
        [difference(arena, (a, g), (b, f)), h, f, g]
    }

    pub(super) fn backward(
        &self,
        arena: &mut Arena,
        [r, h, f, g]: [Expr; 4],
        solution: &mut BTreeMap<Unknown, Expr>,
    ) {
        let ([a, b], [p, q]) = (self.entries, self.momentum);
        let [m_uu, m_uv, m_vv] = self.masses;
        let (u, v) = (difference(arena, (q, h), (b, r)), difference(arena, (a, r), (p, h)));
        let driven = difference(arena, (q, f), (p, g));
        let inertia = difference(arena, (m_uu, m_vv), (m_uv, m_uv));
        let multiplier = difference(arena, (driven, arena.one()), (inertia, h));
        for (unknown, numerator) in self.coordinates.into_iter().zip([u, v]).chain([(self.row, multiplier)]) {
            let value = arena.mul(numerator, self.inverse);
            solution.insert(unknown, arena.share(value));
        }
    }
}

/// x₁y₁ − x₂y₂, computed once.
fn difference(arena: &mut Arena, (x1, y1): (Expr, Expr), (x2, y2): (Expr, Expr)) -> Expr {
    let (first, second) = (arena.mul(x1, y1), arena.mul(x2, y2));
    let difference = arena.sub(first, second);
    arena.share(difference)
}
