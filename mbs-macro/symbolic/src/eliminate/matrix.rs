//! The sparse symmetric matrix under elimination.

use std::collections::{BTreeMap, BTreeSet};

use crate::arena::{Arena, Expr};
use crate::number::Number;

/// An unknown of the constrained system.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Unknown {
    /// The acceleration of a coordinate.
    Coordinate(usize),
    /// The multiplier of a constraint.
    Row(usize),
}

/// ⎡M Φ_qᵀ; Φ_q 0⎤, entries that are 0 left out.
#[derive(Clone, Default)]
pub struct Kkt {
    /// Per unknown, its couplings, both halves of the symmetric matrix.
    couplings: BTreeMap<Unknown, BTreeMap<Unknown, Expr>>,
    /// Coordinates whose mass is positive by declaration.
    massive: BTreeSet<Unknown>,
    /// Coordinates that are angles: entries of theirs are not compared with those of lengths.
    angles: BTreeSet<Unknown>,
    /// Sets of rows of which one is spare, in the order in which they are eliminated; see [`super::deflation`].
    sets: Vec<Vec<Unknown>>,
    /// The unit in which masses are measured, beside the factor that they share.
    mass_unit: Option<Number>,
}

impl Kkt {
    /// A system without unknowns.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds an unknown without couplings.
    pub fn add_unknown(&mut self, unknown: Unknown) {
        self.couplings.entry(unknown).or_default();
    }

    /// Declares that the mass of a coordinate is positive.
    pub fn mark_massive(&mut self, coordinate: usize) {
        self.massive.insert(Unknown::Coordinate(coordinate));
    }

    /// Declares that a coordinate is an angle.
    pub fn mark_angle(&mut self, coordinate: usize) {
        self.angles.insert(Unknown::Coordinate(coordinate));
    }

    /// Declares a set of rows of which one is spare, not the same one in every position. Rows of later sets are not
    /// counted on.
    pub fn mark_set(&mut self, rows: &[usize]) {
        self.sets.push(rows.iter().copied().map(Unknown::Row).collect());
    }

    /// True if a row is one of a set of which one is spare.
    pub(super) fn is_in_set(&self, row: Unknown) -> bool {
        self.sets.iter().any(|set| set.contains(&row))
    }

    /// The first set, if nothing but such rows is left.
    pub(super) fn next_set(&self) -> Option<&[Unknown]> {
        let is_ready = self.couplings.keys().all(|&unknown| self.is_in_set(unknown));
        self.sets.first().filter(|_| is_ready).map(Vec::as_slice)
    }

    /// Lets the rows of a set be eliminated as all others are.
    pub(super) fn release(&mut self, rows: &[Unknown]) {
        self.sets.retain(|set| set != rows);
    }

    /// The entries of a row in the columns of coordinates of one kind, angles or lengths.
    pub(super) fn alike(&self, row: Unknown, coordinate: Unknown) -> impl Iterator<Item = Expr> + '_ {
        let is_angle = self.angles.contains(&coordinate);
        let is_alike = move |other: &Unknown| self.angles.contains(other) == is_angle;
        self.neighbours(row).filter(move |(other, _)| is_alike(other)).map(|(_, entry)| entry)
    }

    /// Measures masses in this unit, so that products of very large or very small
    /// ones stay within the range of a double.
    pub fn set_mass_unit(&mut self, unit: Number) {
        self.mass_unit = Some(unit);
    }

    /// The unit of masses, if one was set.
    pub(super) fn mass_unit(&self) -> Option<Number> {
        self.mass_unit
    }

    /// Sets the entries (a, b) and (b, a).
    pub fn set(&mut self, arena: &Arena, a: Unknown, b: Unknown, value: Expr) {
        for (row, column) in [(a, b), (b, a)] {
            let couplings = self.couplings.entry(row).or_default();
            if arena.is_zero(value) {
                couplings.remove(&column);
            } else {
                couplings.insert(column, value);
            }
        }
    }

    /// The entry (a, b), if it is not 0.
    pub fn get(&self, a: Unknown, b: Unknown) -> Option<Expr> {
        self.couplings.get(&a)?.get(&b).copied()
    }

    /// The entries over two coordinates or one, each once.
    pub(super) fn masses(&self) -> impl Iterator<Item = (Unknown, Unknown, Expr)> + '_ {
        let is_coordinate = |unknown: &Unknown| matches!(unknown, Unknown::Coordinate(_));
        let rows = self.couplings.iter().filter(move |(unknown, _)| is_coordinate(unknown));
        rows.flat_map(move |(&a, couplings)| {
            let others = couplings.range(a..).filter(move |(b, _)| is_coordinate(b));
            others.map(move |(&b, &mass)| (a, b, mass))
        })
    }

    /// True if this unknown is left.
    pub(super) fn contains(&self, unknown: Unknown) -> bool {
        self.couplings.contains_key(&unknown)
    }

    /// The unknowns that are left, in order.
    pub fn unknowns(&self) -> impl Iterator<Item = Unknown> + '_ {
        self.couplings.keys().copied()
    }

    /// The other unknowns that `unknown` is coupled to, with the entries.
    pub fn neighbours(&self, unknown: Unknown) -> impl Iterator<Item = (Unknown, Expr)> + '_ {
        let couplings = self.couplings.get(&unknown).into_iter().flatten();
        couplings.map(|(&other, &entry)| (other, entry)).filter(move |(other, _)| *other != unknown)
    }

    /// The other unknowns that some of `taken` are coupled to.
    pub(super) fn touched_by(&self, taken: &[Unknown]) -> BTreeSet<Unknown> {
        let neighbours = taken.iter().flat_map(|&unknown| self.neighbours(unknown));
        neighbours.map(|(other, _)| other).filter(|other| !taken.contains(other)).collect()
    }

    /// True if the mass of this coordinate is positive by declaration.
    pub fn is_massive(&self, unknown: Unknown) -> bool {
        self.massive.contains(&unknown)
    }

    /// Takes an unknown out.
    pub(super) fn remove(&mut self, unknown: Unknown) {
        for other in self.couplings.remove(&unknown).unwrap_or_default().into_keys() {
            if let Some(couplings) = self.couplings.get_mut(&other) {
                couplings.remove(&unknown);
            }
        }
    }
}
