//! The effect of each elimination step on a right-hand side, there and back.

use std::collections::BTreeMap;

use super::matrix::Unknown;
use super::single_loop::SingleLoop;
use super::sums::Sums;
use crate::arena::{Arena, Expr};
use crate::number::Number;

/// The numbers that a step keeps of a right-hand side for the way back: (g, f) of a pair,
/// b/d of a diagonal pivot, (y, h/s, f, g) of a loop; the rest is 0.
pub(super) type Half = [Expr; 4];

/// One elimination step: what the right-hand side has to go through.
pub(super) enum Step {
    /// u_c = g − Σ wⱼ uⱼ and u_r = (f − Σ kⱼ uⱼ)/p …, see `eliminate_pair`.
    Pair {
        row: Unknown,
        coordinate: Unknown,
        /// 1/p
        inverse: Expr,
        /// K_cc
        mass: Expr,
        /// wⱼ = K_rj/p
        weights: BTreeMap<Unknown, Expr>,
        /// kⱼ = K_cj
        couplings: BTreeMap<Unknown, Expr>,
    },
    /// The last row and its two coordinates, see [`super::single_loop`].
    Loop(SingleLoop),
    /// f ← f + GᵀWh, see [`super::augmentation`].
    Augmentation {
        row: Unknown,
        /// W_r G_rj
        weighted: BTreeMap<Unknown, Expr>,
    },
    /// u = b/d − Σ lⱼ uⱼ
    Diagonal { unknown: Unknown, inverse: Expr, multipliers: BTreeMap<Unknown, Expr> },
}

impl Step {
    /// Carries the right-hand side `b` through this step and gives what the
    /// way back needs.
    pub fn forward(&self, arena: &mut Arena, b: &mut BTreeMap<Unknown, Expr>, sums: Sums) -> Half {
        let zero = arena.zero();
        match self {
            Self::Pair { row, coordinate, inverse, mass, weights, couplings } => {
                let of_row = b.remove(row).unwrap_or(zero);
                let g = sums.product(arena, of_row, *inverse);
                let g = sums.settle(arena, g);
                let of_coordinate = b.remove(coordinate).unwrap_or(zero);
                let inertia = sums.product(arena, *mass, g);
                let f = arena.sub(of_coordinate, inertia);
                let f = sums.settle(arena, f);
                for (other, factor, value) in
                    weights.iter().map(|(u, w)| (u, w, f)).chain(couplings.iter().map(|(u, k)| (u, k, g)))
                {
                    let product = sums.product(arena, *factor, value);
                    subtract(arena, b, *other, product);
                }
                [g, f, zero, zero]
            }
            Self::Loop(single_loop) => single_loop.forward(arena, b, sums),
            Self::Augmentation { row, weighted } => {
                let of_row = b.get(row).copied().unwrap_or(zero);
                let negative = arena.neg(of_row);
                for (other, factor) in weighted {
                    let product = arena.mul(*factor, negative);
                    subtract(arena, b, *other, product);
                }
                [zero; 4]
            }
            Self::Diagonal { unknown, inverse, multipliers } => {
                let own = b.remove(unknown).unwrap_or(zero);
                let own = sums.close(arena, own);
                for (other, multiplier) in multipliers {
                    let product = arena.mul(*multiplier, own);
                    subtract(arena, b, *other, product);
                }
                [arena.mul(own, *inverse), zero, zero, zero]
            }
        }
    }

    pub fn backward(&self, arena: &mut Arena, half: Half, solution: &mut BTreeMap<Unknown, Expr>) {
        match self {
            Self::Pair { row, coordinate, inverse, mass, weights, couplings } => {
                let [g, f, ..] = half;
                let correction = inner_product(arena, weights, solution);
                let u = arena.sub(g, correction);
                let u = arena.share(u);
                // f holds b_c − K_cc g, and u_c differs from g by the correction
                let others = inner_product(arena, couplings, solution);
                let inertia = arena.mul(*mass, correction);
                let balance =
                    arena.sum(&[(f, Number::ONE), (inertia, Number::ONE), (others, Number::MINUS_ONE)]);
                let multiplier = arena.mul(balance, *inverse);
                let multiplier = arena.share(multiplier);
                solution.insert(*coordinate, u);
                solution.insert(*row, multiplier);
            }
            Self::Loop(single_loop) => single_loop.backward(arena, half, solution),
            // it has changed the right-hand side, not the solution
            Self::Augmentation { .. } => {}
            Self::Diagonal { unknown, multipliers, .. } => {
                let correction = inner_product(arena, multipliers, solution);
                let u = arena.sub(half[0], correction);
                let u = arena.share(u);
                solution.insert(*unknown, u);
            }
        }
    }
}

fn subtract(arena: &mut Arena, b: &mut BTreeMap<Unknown, Expr>, at: Unknown, product: Expr) {
    let entry = b.get(&at).copied().unwrap_or(arena.zero());
    let entry = arena.sub(entry, product);
    b.insert(at, entry);
}

/// Σ factor·solution, computed once.
fn inner_product(
    arena: &mut Arena,
    factors: &BTreeMap<Unknown, Expr>,
    solution: &BTreeMap<Unknown, Expr>,
) -> Expr {
    let mut terms = Vec::new();
    for (unknown, &factor) in factors {
        if let Some(&value) = solution.get(unknown) {
            terms.push((arena.mul(factor, value), Number::ONE));
        }
    }
    let sum = arena.sum(&terms);
    arena.share(sum)
}
