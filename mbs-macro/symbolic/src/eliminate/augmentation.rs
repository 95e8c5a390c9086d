//! Rows added to the mass block, for coordinates without mass.
//!
//! ⎡M Gᵀ⎤ ⎡u⎤   ⎡f⎤                ⎡M + GᵀWG  Gᵀ⎤ ⎡u⎤   ⎡f + GᵀWh⎤
//! ⎣G 0 ⎦ ⎣λ⎦ = ⎣h⎦   is equal to  ⎣G         0 ⎦ ⎣λ⎦ = ⎣h       ⎦
//!
//! with the same u and λ, for any W: the second row says Gu = h. (The method of
//! augmented Lagrangians, Fortin and Glowinski 1983, with its exact multipliers.)
//! With W > 0, xᵀ(M + GᵀWG)x = 0 only where Mx = 0 and Gx = 0, which in a regular
//! position holds for x = 0 alone. So the mass block becomes positive definite,
//! and each of its diagonal pivots is safe in any order.
//!
//! M is definite already but for coordinates without a mass of their own, so it is
//! enough to add the rows that touch these.

use super::factorization::Work;
use super::matrix::Unknown;
use super::steps::Step;
use crate::arena::{Arena, Expr};
use crate::number::Number;

impl Work<'_> {
    /// Adds rows to the mass block.
    pub(super) fn augment(&mut self, rows: &[Unknown]) {
        for &row in rows {
            let entries: Vec<(Unknown, Expr)> = self.matrix.neighbours(row).collect();
            let weight = self.weight(&entries);
            let weighted: Vec<(Unknown, Expr)> =
                entries.iter().map(|&(unknown, entry)| (unknown, self.arena.mul(weight, entry))).collect();
            for (at, &(i, weighted)) in weighted.iter().enumerate() {
                for &(j, entry) in &entries[at..] {
                    let product = self.arena.mul(weighted, entry);
                    let sum = match self.matrix.get(i, j) {
                        Some(mass) => self.arena.add(mass, product),
                        None => product,
                    };
                    let sum = self.settle(sum);
                    self.set(i, j, sum);
                }
            }
            for &(unknown, entry) in &entries {
                // what it adds in a healthy position
                let size = self.arena.bound(entry).unwrap_or(entry);
                let contribution = self.arena.product(&[(weight, 1), (size, 2)]);
                self.enlarge(unknown, contribution);
                self.reduced.insert(unknown);
            }
            self.steps.push(Step::Augmentation { row, weighted: weighted.into_iter().collect() });
        }
    }

    /// The weight of a row: such that it adds what the mass of one of its
    /// coordinates is, so that neither hides the other in rounding. An entry that is
    /// a plain number says how; others may be what rounding left of a cancelled one,
    /// and count together.
    fn weight(&mut self, entries: &[(Unknown, Expr)]) -> Expr {
        let of_number = entries.iter().find_map(|&(unknown, entry)| {
            let number = self.arena.as_number(entry)?;
            let is_sound = (1e-3..1e3).contains(&number.abs().to_f64());
            let mass = self.mass_of(unknown).filter(|_| is_sound)?;
            Some(self.arena.product(&[(mass, 1), (entry, -2)]))
        });
        if let Some(weight) = of_number {
            return weight;
        }
        let unknowns: Vec<_> =
            entries.iter().map(|(unknown, _)| *unknown).chain(self.matrix.unknowns()).collect();
        let mass = unknowns.into_iter().find_map(|unknown| self.mass_of(unknown));
        let mass = mass.unwrap_or(self.arena.one());
        let size = square_sum(self.arena, entries);
        self.arena.product(&[(mass, 1), (size, -1)])
    }

    /// A lower bound of the mass of a coordinate; `None` for one without a mass of its own.
    fn mass_of(&mut self, unknown: Unknown) -> Option<Expr> {
        let mass = self.matrix.get(unknown, unknown).filter(|_| self.matrix.is_massive(unknown))?;
        self.arena.anchor(mass)
    }
}

/// Σ bound², or Σ entry² where an entry has no bound: 0 only where the row is.
fn square_sum(arena: &mut Arena, entries: &[(Unknown, Expr)]) -> Expr {
    let bounds: Option<Vec<Expr>> = entries.iter().map(|&(_, entry)| arena.bound(entry)).collect();
    let sizes = bounds.unwrap_or_else(|| entries.iter().map(|&(_, entry)| entry).collect());
    let squares: Vec<_> = sizes.into_iter().map(|size| (arena.powi(size, 2), Number::ONE)).collect();
    let sum = arena.sum(&squares);
    arena.share(sum)
}
