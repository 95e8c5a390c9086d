//! Elimination steps and the solution for a right-hand side.

use std::collections::{BTreeMap, BTreeSet};

use super::matrix::{Kkt, Unknown};
use super::order::{Pivot, Strategy};
use super::steps::Step;
use super::unit;
use crate::arena::{Arena, Expr, Node, Stage};
use crate::number::Number;
use crate::operators::Function;

/// Matrix entries with more terms than this are computed once instead of
/// being opened in the sums that use them.
const LONGEST_OPEN_SUM: usize = 12;

/// A pivot that may vanish, with its growth: the size of what it was made of
/// over its own size.
#[derive(Clone, Copy, Debug)]
pub struct WatchedPivot {
    /// The constraint of the pivot.
    pub row: Option<usize>,
    /// The coordinate of the pivot.
    pub coordinate: Option<usize>,
    /// Its growth.
    pub growth: Expr,
    /// What of it is linear in 1/pivot, and the square of the rest.
    parts: [Option<Expr>; 2],
    /// Whether the growth can signal a lost pivot before it is exactly 0.
    pub can_cancel: bool,
}

/// One step of the elimination, for people to read.
#[derive(Clone, Debug)]
pub struct Elimination {
    /// What is eliminated: one unknown, a row with its coordinate, or a row with two.
    pub unknowns: Vec<Unknown>,
    /// What the step divides by.
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
struct Reduction {
    entry: Expr,
    coupling: Expr,
    pivot: Expr,
}

pub(super) struct Work<'a> {
    pub arena: &'a mut Arena,
    pub matrix: Kkt,
    unit: Expr,
    per_unit: Expr,
    /// Σ of the contributions to a diagonal entry that enlarge it.
    gross: BTreeMap<Unknown, Expr>,
    /// Entries that were reduced by a later pivot of their own kind.
    reduced: BTreeSet<Unknown>,
    /// What a diagonal entry is measured against, in parameters alone; filled
    /// when the first diagonal pivot is taken.
    scales: Option<BTreeMap<Unknown, Expr>>,
    /// What the pivot of the step before left of rows.
    reductions: BTreeMap<Unknown, Reduction>,
    is_open: bool,
    pub(super) steps: Vec<Step>,
    order: Vec<Elimination>,
    pivots: Vec<WatchedPivot>,
}

impl<'a> Work<'a> {
    pub fn new(arena: &'a mut Arena, kkt: &Kkt, strategy: Strategy) -> Self {
        let mut matrix = kkt.clone();
        let unit = unit::of_masses(arena, &matrix);
        let per_unit = arena.powi(unit, -1);
        for unknown in kkt.unknowns() {
            if let Some(mass) = matrix.get(unknown, unknown) {
                let mass = arena.mul(mass, per_unit);
                matrix.set(arena, unknown, unknown, mass);
            }
        }
        let gross = matrix.unknowns().filter_map(|u| Some((u, matrix.get(u, u)?))).collect();
        let is_open = strategy == Strategy::NullSpace;
        Self {
            arena,
            matrix,
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
                self.matrix.set(self.arena, i, j, entry);
                if let (Unknown::Coordinate(at), true) = (i, i == j && self.arena.is_positive(entry)) {
                    self.matrix.mark_massive(at);
                }
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
                self.matrix.set(self.arena, i, j, updated);
            }
        }
        self.watch_diagonal(unknown, pivot, inverse);
        self.matrix.remove(unknown);
        self.steps.push(Step::Diagonal { unknown, inverse, multipliers });
    }

    /// The entry (i, j), computed once. That of a row with itself is made of
    /// negative squares, and its negative is what is computed.
    fn close(&mut self, i: Unknown, j: Unknown, entry: Expr) -> Expr {
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

    /// Leaves a short entry open to algebra, closes a long one.
    fn settle(&mut self, entry: Expr) -> Expr {
        let length = match self.arena.node(entry) {
            Node::Sum(_, terms) => terms.len(),
            _ => 1,
        };
        if self.is_open && length <= LONGEST_OPEN_SUM { entry } else { self.arena.share(entry) }
    }

    fn enlarge(&mut self, unknown: Unknown, contribution: Expr) {
        let gross = self.gross.get(&unknown).copied().unwrap_or(self.arena.zero());
        let gross = self.arena.add(gross, contribution);
        let gross = if self.is_open { self.settle(gross) } else { self.close(unknown, unknown, gross) };
        self.gross.insert(unknown, gross);
    }

    /// A pivot of the other kind (a mass for a row) enlarges an entry of the
    /// Schur complement, one of the same kind reduces it.
    fn track(&mut self, pivot: Unknown, unknown: Unknown, contribution: Expr) {
        let same_kind = matches!(pivot, Unknown::Row(_)) == matches!(unknown, Unknown::Row(_));
        if same_kind {
            self.reduced.insert(unknown);
        } else {
            let negative = self.arena.neg(contribution);
            self.enlarge(unknown, negative);
        }
    }

    fn watch_pair(&mut self, row: Unknown, coordinate: Unknown, pivot: Expr, inverse: Expr) {
        if self.arena.as_number(pivot).is_some() {
            return;
        }
        let bound = self.arena.bound(pivot);
        let size = bound.unwrap_or_else(|| self.arena.share(pivot));
        let growth = self.ratio(size, inverse);
        self.watch(Some(row), Some(coordinate), [Some(growth), None], bound.is_some());
    }

    /// The size that diagonal entries have in a healthy position: of a mass,
    /// what it never falls below before other masses reduce it; of a row, the
    /// bound of Σ Φ_q²/M over its coordinates. Left out where coordinates enter
    /// otherwise than through sines and cosines.
    fn scales(&mut self) -> BTreeMap<Unknown, Expr> {
        let mut scales = BTreeMap::new();
        for unknown in self.matrix.unknowns().collect::<Vec<_>>() {
            let diagonal = self.matrix.get(unknown, unknown);
            let scale = match unknown {
                Unknown::Coordinate(_) => diagonal.and_then(|mass| self.arena.anchor(mass)),
                Unknown::Row(_) => self.row_scale(unknown),
            };
            scales.extend(scale.map(|scale| (unknown, scale)));
        }
        scales
    }

    pub(super) fn row_scale(&mut self, row: Unknown) -> Option<Expr> {
        let mut terms = Vec::new();
        for (coordinate, entry) in self.matrix.neighbours(row).collect::<Vec<_>>() {
            let mass = self.matrix.get(coordinate, coordinate)?;
            let (bound, mass) = (self.arena.bound(entry)?, self.arena.anchor(mass)?);
            terms.push((self.arena.product(&[(bound, 2), (mass, -1)]), Number::ONE));
        }
        (!terms.is_empty()).then(|| self.arena.sum(&terms))
    }

    /// A mass that nothing reduced is positive, and needs no watch; a row can
    /// vanish as a whole.
    fn watch_diagonal(&mut self, unknown: Unknown, pivot: Expr, inverse: Expr) {
        if self.arena.as_number(pivot).is_some() {
            return;
        }
        let is_reduced = self.reduced.contains(&unknown);
        let scale = self.scales.as_ref().and_then(|scales| scales.get(&unknown)).copied();
        let gross = self.gross.get(&unknown).copied().filter(|_| is_reduced);
        let (row, coordinate, [linear, squared]) = match unknown {
            Unknown::Coordinate(_) => (None, Some(unknown), [scale.filter(|_| is_reduced).or(gross), None]),
            Unknown::Row(_) => (Some(unknown), None, [gross, scale]),
        };
        let can_cancel = linear.or(squared).is_some();
        let linear = if can_cancel { linear } else { Some(pivot) };
        let parts = [linear, squared].map(|size| size.map(|size| self.ratio(size, inverse)));
        self.watch(row, coordinate, parts, can_cancel);
    }

    /// |size/pivot|, kept from simplifying where both are the same.
    ///
    /// A pivot made of squares may be small without having lost digits: there the root of the
    /// ratio, that of what was squared, is the growth.
    pub(super) fn ratio(&mut self, size: Expr, inverse: Expr) -> Expr {
        let size = self.arena.share(size);
        let ratio = self.arena.mul(size, inverse);
        self.arena.call(Function::Abs, ratio)
    }

    pub(super) fn watch(
        &mut self,
        row: Option<Unknown>,
        coordinate: Option<Unknown>,
        parts: [Option<Expr>; 2],
        can_cancel: bool,
    ) {
        let index = |unknown| match unknown {
            Unknown::Row(index) | Unknown::Coordinate(index) => index,
        };
        let (row, coordinate) = (row.map(index), coordinate.map(index));
        let growth = total(self.arena, parts.map(|part| part.into_iter().collect()));
        self.pivots.push(WatchedPivot { row, coordinate, growth, parts, can_cancel });
    }
}

impl Factorization {
    /// The solution for the right-hand side `rhs`, 0 where it has no entry.
    pub fn solve(&self, arena: &mut Arena, rhs: &BTreeMap<Unknown, Expr>) -> BTreeMap<Unknown, Expr> {
        let mut b = rhs.clone();
        for (unknown, force) in &mut b {
            if matches!(unknown, Unknown::Coordinate(_)) {
                *force = arena.mul(*force, self.per_unit);
            }
        }
        let halves: Vec<_> = self.steps.iter().map(|step| step.forward(arena, &mut b)).collect();
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

    /// The growth of the pivots that can cancel, together: Σ, with one root over all that
    /// stands under roots.
    pub fn growth(&self, arena: &mut Arena) -> Expr {
        let parts = |part: usize| {
            let watched = self.pivots.iter().filter(|pivot| pivot.can_cancel);
            watched.filter_map(|pivot| pivot.parts[part]).collect()
        };
        total(arena, [parts(0), parts(1)])
    }
}

/// Σ linear + √(Σ squared)
fn total(arena: &mut Arena, [linear, squared]: [Vec<Expr>; 2]) -> Expr {
    let sum = |arena: &mut Arena, terms: Vec<Expr>| {
        arena.sum(&terms.into_iter().map(|term| (term, Number::ONE)).collect::<Vec<_>>())
    };
    let (linear, squared) = (sum(arena, linear), sum(arena, squared));
    let root = arena.call(Function::Sqrt, squared);
    arena.add(linear, root)
}
