//! The watch over pivots: how much of the digits of a pivot has cancelled.
//!
//! # How it works
//!
//! A pivot that may vanish adds a term to the growth, without a branch: its size in a healthy position over
//! its own size.
//!
//! * The healthy size depends on parameters alone where it can, since sines and cosines are bounded by 1. It
//!   is hoisted then.
//! * A pivot without such a bound is measured against the entries of its row that are of its kind, angles or
//!   lengths.
//! * A pivot that is made of squares adds the root of its ratio. The ratios of all such pivots are added
//!   first, and one root is taken.
//!
//! The first and the second half of the rows have sums of their own. They are the two ends of a chain that
//! is eliminated from both, so magnitudes and sums become operations on pairs.

use std::collections::BTreeMap;

use super::factorization::{Factorization, Work};
use super::matrix::Unknown;
use super::single_loop::SingleLoop;
use crate::arena::{Arena, Expr};
use crate::number::Number;
use crate::operators::Function;

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
    /// The part of the growth that is linear in 1/pivot, and the square of the rest.
    parts: [Option<Expr>; 2],
    /// True if the growth can signal a lost pivot before it is exactly 0.
    pub can_cancel: bool,
}

impl Work<'_> {
    pub(super) fn enlarge(&mut self, unknown: Unknown, contribution: Expr) {
        let gross = self.gross.get(&unknown).copied().unwrap_or(self.arena.zero());
        let gross = self.arena.add(gross, contribution);
        let gross = if self.is_open { self.settle(gross) } else { self.close(unknown, unknown, gross) };
        self.gross.insert(unknown, gross);
    }

    /// A pivot of the other kind (a mass for a row) enlarges an entry of the
    /// Schur complement, one of the same kind reduces it.
    pub(super) fn track(&mut self, pivot: Unknown, unknown: Unknown, contribution: Expr) {
        let same_kind = matches!(pivot, Unknown::Row(_)) == matches!(unknown, Unknown::Row(_));
        if same_kind {
            self.reduced.insert(unknown);
        } else {
            let negative = self.arena.neg(contribution);
            self.enlarge(unknown, negative);
        }
    }

    pub(super) fn watch_pair(&mut self, row: Unknown, coordinate: Unknown, pivot: Expr, inverse: Expr) {
        if self.arena.as_number(pivot).is_some() {
            return;
        }
        let size = self.arena.bound(pivot).or_else(|| self.size_of_row(row, coordinate));
        let can_cancel = size.is_some();
        let size = size.unwrap_or_else(|| self.arena.share(pivot));
        let growth = self.ratio(size, inverse);
        self.watch(Some(row), Some(coordinate), [Some(growth), None], can_cancel);
    }

    /// Measures the determinant D of a [`SingleLoop`] against b²A + a²C: with what a and b can be at most,
    /// and what the masses never fall below.
    pub(super) fn watch_loop(&mut self, taken: &SingleLoop) {
        let SingleLoop { row, coordinates, entries, masses: [mass, _, other], inverse, .. } = *taken;
        let [a, b] = entries.map(|entry| self.arena.bound(entry));
        let bounds = a.zip(b);
        let (a, b) = bounds.unwrap_or((entries[0], entries[1]));
        let [of_a, of_b] = [mass, other].map(|mass| self.arena.anchor(mass).unwrap_or(mass));
        let terms = [&[(b, 2), (of_a, 1)], &[(a, 2), (of_b, 1)]];
        let terms = terms.map(|factors| (self.arena.product(factors), Number::ONE));
        let size = self.arena.sum(&terms);
        let squared = self.ratio(size, inverse);
        self.watch(Some(row), Some(coordinates[1]), [None, Some(squared)], bounds.is_some());
    }

    /// The size that a pivot without a bound is measured against: Σ |Φ_q| over the coordinates of its
    /// row that are of its own kind, itself included. Left out where it is the only one.
    ///
    /// Of x² + y² = l² with a driven x the pivot is 2y, of one term that cannot cancel; it
    /// vanishes all the same where the drive leads as far as it can.
    fn size_of_row(&mut self, row: Unknown, coordinate: Unknown) -> Option<Expr> {
        let entries: Vec<Expr> = self.whole.alike(row, coordinate).collect();
        let sizes = entries.iter().map(|&entry| (self.arena.call(Function::Abs, entry), Number::ONE));
        let sizes: Vec<_> = sizes.collect();
        (sizes.len() > 1).then(|| self.arena.sum(&sizes))
    }

    /// The size that diagonal entries have in a healthy position: of a mass,
    /// what it never falls below before other masses reduce it; of a row, the
    /// bound of Σ Φ_q²/M over its coordinates. Left out where coordinates enter
    /// otherwise than through sines and cosines.
    pub(super) fn scales(&mut self) -> BTreeMap<Unknown, Expr> {
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
    pub(super) fn watch_diagonal(&mut self, unknown: Unknown, pivot: Expr, inverse: Expr) {
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
        let [linear, squared] = parts.map(|part| part.unwrap_or(self.arena.zero()));
        let growth = with_root(self.arena, linear, squared);
        self.pivots.push(WatchedPivot { row, coordinate, growth, parts, can_cancel });
    }
}

impl Factorization {
    /// The growth of the pivots that can cancel, together: Σ, with one root over all that
    /// stands under roots.
    ///
    /// The first and the second half of the rows have sums of their own. These are the two ends of a
    /// chain that is eliminated from both, so pairs of lanes compute them.
    pub fn growth(&self, arena: &mut Arena) -> Expr {
        let mut watched: Vec<_> = self.pivots.iter().filter(|pivot| pivot.can_cancel).collect();
        watched.sort_by_key(|pivot| (pivot.row, pivot.coordinate));
        let (first, second) = watched.split_at(watched.len() / 2);
        let [linear, squared] = [0, 1].map(|part| {
            let [first, second] = [first, second].map(|half| {
                let terms = half.iter().filter_map(|pivot| pivot.parts[part]);
                let sum = arena.sum(&terms.map(|term| (term, Number::ONE)).collect::<Vec<_>>());
                arena.share(sum)
            });
            arena.add(first, second)
        });
        with_root(arena, linear, squared)
    }
}

/// linear + √squared
fn with_root(arena: &mut Arena, linear: Expr, squared: Expr) -> Expr {
    let root = arena.call(Function::Sqrt, squared);
    arena.add(linear, root)
}
