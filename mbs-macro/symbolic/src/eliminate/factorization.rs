//! Elimination steps and the solution for a right-hand side.

use std::collections::{BTreeMap, BTreeSet};

use super::matrix::{Kkt, Unknown};
use super::order::{Pivot, Strategy};
use super::single_loop::SingleLoop;
use super::steps::Step;
use super::sums::{LONGEST_OPEN, Sums, length};
use super::unit;
use super::watch::WatchedPivot;
use crate::arena::{Arena, Expr, Stage};
use crate::number::Number;

/// One step of the elimination, for people to read.
#[derive(Clone, Debug)]
pub struct Elimination {
    /// The eliminated unknowns: one alone, a row with its coordinate, or a row with two.
    pub unknowns: Vec<Unknown>,
    /// The divisor of the step.
    pub pivot: Expr,
}

/// An eliminated matrix.
pub struct Factorization {
    steps: Vec<Step>,
    /// 1/μ and μ, where masses are measured in units of μ.
    per_unit: Expr,
    unit: Expr,
    /// The steps, in order.
    pub order: Vec<Elimination>,
    /// The pivots that may vanish, in the order of elimination.
    pub pivots: Vec<WatchedPivot>,
}

/// K_ii − K_ip²/K_pp, before it is subtracted.
pub(super) struct Reduction {
    entry: Expr,
    coupling: Expr,
    pivot: Expr,
}

pub(super) struct Work<'a> {
    pub arena: &'a mut Arena,
    pub matrix: Kkt,
    /// The matrix before any elimination.
    pub(super) whole: &'a Kkt,
    unit: Expr,
    per_unit: Expr,
    /// Σ of the contributions to a diagonal entry that enlarge it.
    pub(super) gross: BTreeMap<Unknown, Expr>,
    /// Entries that were reduced by a later pivot of their own kind.
    pub(super) reduced: BTreeSet<Unknown>,
    /// The sizes that diagonal entries are measured against, in parameters alone; filled
    /// when the first diagonal pivot is taken.
    pub(super) scales: Option<BTreeMap<Unknown, Expr>>,
    /// The diagonal entries of rows that the pivot of the step before reduced.
    pub(super) reductions: BTreeMap<Unknown, Reduction>,
    pub(super) is_open: bool,
    pub(super) steps: Vec<Step>,
    order: Vec<Elimination>,
    pub(super) pivots: Vec<WatchedPivot>,
}

impl<'a> Work<'a> {
    pub fn new(arena: &'a mut Arena, kkt: &'a Kkt, strategy: Strategy) -> Self {
        let mut matrix = kkt.clone();
        let unit = unit::of_masses(arena, &matrix);
        let per_unit = arena.powi(unit, -1);
        for (a, b, mass) in kkt.masses() {
            let mass = arena.mul(mass, per_unit);
            matrix.set(arena, a, b, mass);
        }
        let gross = matrix.unknowns().filter_map(|u| Some((u, matrix.get(u, u)?))).collect();
        let is_open = strategy == Strategy::NullSpace;
        Self {
            arena,
            matrix,
            whole: kkt,
            unit,
            per_unit,
            gross,
            reduced: BTreeSet::new(),
            scales: None,
            reductions: BTreeMap::new(),
            is_open,
            steps: Vec::new(),
            order: Vec::new(),
            pivots: Vec::new(),
        }
    }

    pub fn finish(self) -> Factorization {
        let Self { steps, order, pivots, unit, per_unit, .. } = self;
        Factorization { steps, order, pivots, unit, per_unit }
    }

    pub fn eliminate(&mut self, pivot: Pivot) {
        let (row, column) = match pivot {
            Pivot::Pair { row, coordinate } => (row, coordinate),
            Pivot::Diagonal(unknown) => (unknown, unknown),
            Pivot::Loop { row, coordinates } => (row, coordinates[0]),
        };
        let entry = self.matrix.get(row, column).unwrap_or(self.arena.zero());
        // as it is without a unit of mass
        let entry = match pivot {
            Pivot::Diagonal(Unknown::Coordinate(_)) => self.arena.mul(entry, self.unit),
            Pivot::Diagonal(Unknown::Row(_)) => self.arena.mul(entry, self.per_unit),
            _ => entry,
        };
        self.order.push(Elimination { unknowns: pivot.unknowns(), pivot: entry });
        let reductions = std::mem::take(&mut self.reductions);
        match pivot {
            Pivot::Pair { row, coordinate } => self.eliminate_pair(row, coordinate),
            Pivot::Diagonal(unknown) => self.eliminate_diagonal(unknown, reductions.get(&unknown)),
            Pivot::Loop { row, coordinates } => self.eliminate_loop(row, coordinates),
        }
    }

    /// With p = K_rc and K_rr = 0, row r gives u_c = (b_r − Σ K_rj u_j)/p, and
    /// with w_j = K_rj/p what is left is
    /// K′_ij = K_ij − w_i K_cj − K_ic w_j + w_i K_cc w_j.
    fn eliminate_pair(&mut self, row: Unknown, coordinate: Unknown) {
        let zero = self.arena.zero();
        let pivot = self.matrix.get(row, coordinate).unwrap_or(zero);
        let mass = self.matrix.get(coordinate, coordinate).unwrap_or(zero);
        let inverse = self.inverse(pivot);
        let is_other = |other: &Unknown| *other != row && *other != coordinate;
        let of_row: Vec<_> = self.matrix.neighbours(row).filter(|(u, _)| is_other(u)).collect();
        let weights: BTreeMap<_, _> = of_row
            .into_iter()
            .map(|(other, entry)| {
                let weight = self.arena.mul(entry, inverse);
                (other, self.settle(weight))
            })
            .collect();
        let couplings: BTreeMap<_, _> =
            self.matrix.neighbours(coordinate).filter(|(u, _)| is_other(u)).collect();

        let touched: BTreeSet<_> = weights.keys().chain(couplings.keys()).copied().collect();
        for &i in &touched {
            for &j in touched.range(i..) {
                let weight = |u: &Unknown| weights.get(u).copied();
                let coupling = |u: &Unknown| couplings.get(u).copied();
                if weight(&i).is_none() && weight(&j).is_none() {
                    continue;
                }
                let entry = self.matrix.get(i, j).unwrap_or(zero);
                let mut terms = vec![(entry, Number::ONE)];
                for (w, k) in [(weight(&i), coupling(&j)), (weight(&j), coupling(&i))] {
                    if let (Some(w), Some(k)) = (w, k) {
                        terms.push((self.arena.mul(w, k), Number::MINUS_ONE));
                    }
                }
                if let (Some(wi), Some(wj)) = (weight(&i), weight(&j)) {
                    let square = self.arena.product(&[(wi, 1), (wj, 1), (mass, 1)]);
                    if i == j {
                        self.enlarge(i, square);
                    }
                    terms.push((square, Number::ONE));
                }
                let entry = self.arena.sum(&terms);
                let entry = self.settle(entry);
                self.set(i, j, entry);
            }
        }
        self.watch_pair(row, coordinate, pivot, inverse);
        self.matrix.remove(row);
        self.matrix.remove(coordinate);
        self.steps.push(Step::Pair { row, coordinate, inverse, mass, weights, couplings });
    }

    /// K′_ij = K_ij − K_ip K_pj / K_pp
    fn eliminate_diagonal(&mut self, unknown: Unknown, reduction: Option<&Reduction>) {
        if self.scales.is_none() {
            self.scales = Some(self.scales());
        }
        let zero = self.arena.zero();
        let pivot = self.matrix.get(unknown, unknown).unwrap_or(zero);
        let pivot = self.close(unknown, unknown, pivot);
        let inverse = match reduction {
            Some(reduction) => self.inverse_of_reduced(reduction),
            None => self.inverse(pivot),
        };
        let couplings: BTreeMap<_, _> = self
            .matrix
            .neighbours(unknown)
            .collect::<Vec<_>>()
            .into_iter()
            .map(|(other, entry)| (other, self.close(unknown, other, entry)))
            .collect();
        // a factor that is hoisted costs nothing where others stand beside it
        let is_constant = self.arena.stage(inverse) <= Stage::Parameter;
        let multipliers: BTreeMap<_, _> = couplings
            .iter()
            .map(|(&other, &entry)| {
                let multiplier = self.arena.mul(entry, inverse);
                (other, if is_constant { multiplier } else { self.arena.share(multiplier) })
            })
            .collect();
        for (&i, &multiplier) in &multipliers {
            for (&j, &coupling) in couplings.range(i..) {
                let product = self.arena.mul(multiplier, coupling);
                let entry = self.matrix.get(i, j).unwrap_or(zero);
                let updated = self.arena.sub(entry, product);
                if i == j {
                    self.track(unknown, i, product);
                    if !is_constant && [unknown, i].iter().all(|u| matches!(u, Unknown::Row(_))) {
                        self.reductions.insert(i, Reduction { entry, coupling, pivot });
                    }
                }
                let updated = self.close(i, j, updated);
                self.set(i, j, updated);
            }
        }
        self.watch_diagonal(unknown, pivot, inverse);
        self.matrix.remove(unknown);
        self.steps.push(Step::Diagonal { unknown, inverse, multipliers });
    }

    /// The last row with its two coordinates, see [`super::single_loop`].
    fn eliminate_loop(&mut self, row: Unknown, coordinates: [Unknown; 2]) {
        let taken = SingleLoop::new(self.arena, &self.matrix, row, coordinates);
        self.watch_loop(&taken);
        for unknown in [row, coordinates[0], coordinates[1]] {
            self.matrix.remove(unknown);
        }
        self.steps.push(Step::Loop(taken));
    }

    /// The entry (i, j), computed once. That of a row with itself is made of
    /// negative squares, and its negative is what is computed.
    pub(super) fn close(&mut self, i: Unknown, j: Unknown, entry: Expr) -> Expr {
        if [i, j].iter().any(|unknown| matches!(unknown, Unknown::Coordinate(_))) {
            return self.arena.share(entry);
        }
        let negative = self.arena.neg(entry);
        let negative = self.arena.share(negative);
        self.arena.neg(negative)
    }

    /// 1/p, computed once.
    pub(super) fn inverse(&mut self, pivot: Expr) -> Expr {
        let inverse = self.arena.powi(pivot, -1);
        self.arena.share(inverse)
    }

    /// 1/(k − c²/p) = p/(kp − c²), computed once: a division that does not wait for that
    /// by p. The rows of a pin are eliminated one after the other, and chains of pins
    /// would wait for two divisions each.
    fn inverse_of_reduced(&mut self, reduction: &Reduction) -> Expr {
        let Reduction { entry, coupling, pivot } = *reduction;
        let product = self.arena.mul(entry, pivot);
        let square = self.arena.powi(coupling, 2);
        let determinant = self.arena.sub(product, square);
        let inverse = self.inverse(determinant);
        let inverse = self.arena.mul(pivot, inverse);
        self.arena.share(inverse)
    }

    /// Sets the entries (i, j) and (j, i); what is 0 in exact arithmetic is no entry.
    pub(super) fn set(&mut self, i: Unknown, j: Unknown, entry: Expr) {
        let entry = if self.arena.vanishes(entry) { self.arena.zero() } else { entry };
        self.matrix.set(self.arena, i, j, entry);
    }

    /// Leaves a short entry open to algebra, closes a long one.
    pub(super) fn settle(&mut self, entry: Expr) -> Expr {
        let is_short = length(self.arena, entry) <= LONGEST_OPEN;
        if self.is_open && is_short { entry } else { self.arena.share(entry) }
    }
}

impl Factorization {
    /// The solution for the right-hand side `rhs`, 0 where it has no entry.
    pub fn solve(&self, arena: &mut Arena, rhs: &BTreeMap<Unknown, Expr>) -> BTreeMap<Unknown, Expr> {
        self.solve_with(arena, rhs, Sums::Closed)
    }

    /// The same with sums of `rhs` treated like this.
    pub fn solve_with(
        &self,
        arena: &mut Arena,
        rhs: &BTreeMap<Unknown, Expr>,
        sums: Sums,
    ) -> BTreeMap<Unknown, Expr> {
        let mut b = rhs.clone();
        for (unknown, force) in &mut b {
            if matches!(unknown, Unknown::Coordinate(_)) {
                *force = arena.mul(*force, self.per_unit);
            }
        }
        let halves: Vec<_> = self.steps.iter().map(|step| step.forward(arena, &mut b, sums)).collect();
        let mut solution = BTreeMap::new();
        for (step, half) in self.steps.iter().zip(halves).rev() {
            step.backward(arena, half, &mut solution);
        }
        for (unknown, value) in &mut solution {
            if matches!(unknown, Unknown::Row(_)) {
                *value = arena.mul(*value, self.unit);
            }
        }
        solution
    }
}
