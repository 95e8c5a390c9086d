//! The last row with its two coordinates: what a mechanism of one closed loop
//! and one degree of freedom comes down to.
//!
//! ⎡A  B  a⎤ ⎡u⎤   ⎡f⎤
//! ⎢B  C  b⎥ ⎢v⎥ = ⎢g⎥
//! ⎣a  b  0⎦ ⎣λ⎦   ⎣h⎦
//!
//! With the null vector n = (−b, a) of the row, (u, v) = (a, b) h/s + n y, where
//! s = a² + b² and D = nᵀMn: two divisions that do not wait for each other, and
//! both safe: s vanishes only with the row, D is positive with the masses.

use std::collections::BTreeMap;

use super::factorization::Work;
use super::matrix::Unknown;
use super::steps::{Half, Step};
use crate::arena::{Arena, Expr};
use crate::number::Number;

/// The step; names as in the module's equations.
pub(super) struct SingleLoop {
    row: Unknown,
    coordinates: [Unknown; 2],
    /// (a, b)
    entries: [Expr; 2],
    /// A, B, C
    masses: [Expr; 3],
    /// (Mn)ᵀ(a, b)
    coupling: Expr,
    /// 1/s
    inverse_square: Expr,
    /// 1/D
    inverse_mass: Expr,
}

impl Work<'_> {
    pub(super) fn eliminate_loop(&mut self, row: Unknown, coordinates: [Unknown; 2]) {
        let [first, second] = coordinates;
        let zero = self.arena.zero();
        let mut entry = |one, other| {
            let entry = self.matrix.get(one, other).unwrap_or(zero);
            self.arena.share(entry)
        };
        let [a, b] = [entry(row, first), entry(row, second)];
        let masses = [entry(first, first), entry(first, second), entry(second, second)];

        let momentum = [
            difference(self.arena, (a, masses[1]), (b, masses[0])),
            difference(self.arena, (a, masses[2]), (b, masses[1])),
        ];
        let reduced_mass = difference(self.arena, (a, momentum[1]), (b, momentum[0]));
        let coupling = inner(self.arena, [a, b], momentum);
        let square = inner(self.arena, [a, b], [a, b]);
        let (inverse_square, inverse_mass) = (self.inverse(square), self.inverse(reduced_mass));
        self.watch_loop(row, coordinates, [a, b], inverse_square);

        for unknown in [row, first, second] {
            self.matrix.remove(unknown);
        }
        self.steps.push(Step::Loop(SingleLoop {
            row,
            coordinates,
            entries: [a, b],
            masses,
            coupling,
            inverse_square,
            inverse_mass,
        }));
    }

    /// Measures s against what a and b can be at most.
    fn watch_loop(&mut self, row: Unknown, coordinates: [Unknown; 2], entries: [Expr; 2], inverse: Expr) {
        let [a, b] = entries.map(|entry| self.arena.bound(entry));
        let bound = a.zip(b).map(|(a, b)| inner(self.arena, [a, b], [a, b]));
        let size = bound.unwrap_or_else(|| inner(self.arena, entries, entries));
        let squared = self.ratio(size, inverse);
        self.watch(Some(row), Some(coordinates[1]), [None, Some(squared)], bound.is_some());
    }
}

impl SingleLoop {
    /// Takes (f, g, h) out of the right-hand side; gives y and h/s.
    pub(super) fn forward(&self, arena: &mut Arena, rhs: &mut BTreeMap<Unknown, Expr>) -> Half {
        let zero = arena.zero();
        let mut take = |unknown| {
            let value = rhs.remove(&unknown).unwrap_or(zero);
            arena.share(value)
        };
        let [f, g] = self.coordinates.map(&mut take);
        let h = take(self.row);
        let along = arena.mul(h, self.inverse_square);
        let along = arena.share(along);
        let [a, b] = self.entries;
        let (driven, lost) = (difference(arena, (a, g), (b, f)), arena.mul(self.coupling, along));
        let force = arena.sub(driven, lost);
        let y = arena.mul(force, self.inverse_mass);
        [arena.share(y), along, f, g]
    }

    pub(super) fn backward(
        &self,
        arena: &mut Arena,
        [y, along, f, g]: Half,
        solution: &mut BTreeMap<Unknown, Expr>,
    ) {
        let [a, b] = self.entries;
        let u = difference(arena, (a, along), (b, y));
        let v = inner(arena, [a, b], [y, along]);
        let [m_uu, m_uv, m_vv] = self.masses;
        let (mu, mv) = (inner(arena, [m_uu, m_uv], [u, v]), inner(arena, [m_uv, m_vv], [u, v]));
        let residual = [arena.sub(f, mu), arena.sub(g, mv)];
        let across = inner(arena, [a, b], residual);
        let multiplier = arena.mul(across, self.inverse_square);
        let multiplier = arena.share(multiplier);
        for (unknown, value) in self.coordinates.into_iter().zip([u, v]).chain([(self.row, multiplier)]) {
            solution.insert(unknown, value);
        }
    }
}

/// x₁y₁ − x₂y₂, computed once.
fn difference(arena: &mut Arena, (x1, y1): (Expr, Expr), (x2, y2): (Expr, Expr)) -> Expr {
    let (first, second) = (arena.mul(x1, y1), arena.mul(x2, y2));
    let difference = arena.sub(first, second);
    arena.share(difference)
}

/// x₁y₁ + x₂y₂, computed once.
fn inner(arena: &mut Arena, x: [Expr; 2], y: [Expr; 2]) -> Expr {
    let (first, second) = (arena.mul(x[0], y[0]), arena.mul(x[1], y[1]));
    let sum = arena.sum(&[(first, Number::ONE), (second, Number::ONE)]);
    arena.share(sum)
}
