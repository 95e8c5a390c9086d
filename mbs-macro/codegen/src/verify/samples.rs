//! Random positions at the declared parameters, and what the equations are there.

use std::collections::BTreeSet;

use mbs_symbolic::{Arena, Expr, Symbol};

use super::assembly::Position;
use super::echelon::{Echelon, row_echelon};
use super::sparse::{SparseRow, scale};
use crate::derive::Equations;
use crate::model::{Meaning, Model};

/// How many positions are looked at.
const POSITIONS: usize = 5;

/// Symbol values at a few random positions. The sequence is fixed, so that the
/// same declaration always compiles to the same code.
pub struct Samples {
    values: Vec<Vec<f64>>,
    /// The declared start: coordinates that it leaves out at 0, t = 0.
    start: Vec<f64>,
}

impl Samples {
    /// Random coordinates, velocities and times; declared parameters.
    pub fn new(model: &Model) -> Self {
        let mut generator = Generator::new();
        let length = typical_length(model);
        let values = (0..POSITIONS)
            .map(|_| {
                model
                    .meanings
                    .iter()
                    .map(|&meaning| match meaning {
                        Meaning::Parameter(at) => model.parameters[at].value,
                        Meaning::Coordinate(at)
                            if model.coordinates[at].quantity.dimension != Default::default() =>
                        {
                            length * generator.symmetric()
                        }
                        // angles all around; rates, times and the rest of order 1
                        Meaning::Coordinate(_) => 3.0 * generator.symmetric(),
                        _ => generator.symmetric(),
                    })
                    .collect()
            })
            .collect();
        Self { values, start: declared_start(model) }
    }

    /// Coordinates at the declared start, t = 0.
    pub fn start_position(&self, model: &Model) -> Position {
        let q = model.coordinates.iter().map(|coordinate| self.start[coordinate.position.index()]).collect();
        Position { q, t: 0.0 }
    }

    /// The values of expressions at one of the positions.
    pub fn evaluate(&self, arena: &Arena, roots: &[Expr], position: usize) -> Vec<f64> {
        evaluate_at(arena, roots, &self.values[position])
    }

    /// The value of a symbol at one of the positions.
    pub fn value(&self, symbol: Symbol, position: usize) -> f64 {
        self.values[position].get(symbol.index()).copied().unwrap_or(0.0)
    }

    /// The number of positions.
    pub fn positions(&self) -> std::ops::Range<usize> {
        0..self.values.len()
    }

    /// The smallest |e| over the positions; 0 where it is not finite.
    pub fn smallest_magnitude(&self, arena: &Arena, expr: Expr) -> f64 {
        let magnitude = |position| {
            let value = self.evaluate(arena, &[expr], position)[0].abs();
            if value.is_finite() { value } else { 0.0 }
        };
        self.positions().map(magnitude).fold(f64::INFINITY, f64::min)
    }

    /// Which of `coordinates` can be held, in this order, such that these rows of
    /// Φ_q keep their rank without their columns: those whose unit vectors depend
    /// neither on the rows nor on one another. Judged at the declared start, or,
    /// should that be singular, where the rank is the generic one.
    pub fn holdable(
        &self,
        model: &Model,
        equations: &Equations,
        rows: &[usize],
        coordinates: &[usize],
    ) -> BTreeSet<usize> {
        let units = coordinates.iter().map(|&at| vec![(at, 1.0)]);
        let with_units = |sample: &Vec<f64>| {
            let jacobian = jacobian_at(model, equations, rows, &BTreeSet::new(), sample);
            row_echelon(jacobian.into_iter().chain(units.clone()).collect())
        };
        let rank = |echelon: &Echelon| {
            rows.len() - echelon.dependent.iter().filter(|(row, _)| *row < rows.len()).count()
        };
        let generic = self.values.iter().map(with_units).max_by_key(rank);
        let at_start = with_units(&self.start);
        let echelon = generic.filter(|generic| rank(&at_start) < rank(generic)).unwrap_or(at_start);
        let spare: BTreeSet<usize> = echelon.dependent.iter().map(|(row, _)| *row).collect();
        let is_holdable = |(place, _): &(usize, &usize)| !spare.contains(&(rows.len() + place));
        coordinates.iter().enumerate().filter(is_holdable).map(|(_, &at)| at).collect()
    }

    /// The rank of these rows of Φ_q without the columns in `held`: the largest
    /// over the positions, which is the generic one.
    pub fn rank(
        &self,
        model: &Model,
        equations: &Equations,
        rows: &[usize],
        held: &BTreeSet<usize>,
    ) -> usize {
        let rank = |sample: &Vec<f64>| rank_at(model, equations, rows, held, sample);
        self.values.iter().map(rank).max().unwrap_or(0)
    }

    /// All of Φ_q at a position, in echelon form.
    pub fn echelon(&self, model: &Model, equations: &Equations, position: usize) -> Echelon {
        let rows: Vec<usize> = (0..equations.phi.len()).collect();
        row_echelon(jacobian_at(model, equations, &rows, &BTreeSet::new(), &self.values[position]))
    }
}

fn rank_at(
    model: &Model,
    equations: &Equations,
    rows: &[usize],
    held: &BTreeSet<usize>,
    sample: &[f64],
) -> usize {
    row_echelon(jacobian_at(model, equations, rows, held, sample)).rank()
}

fn evaluate_at(arena: &Arena, roots: &[Expr], sample: &[f64]) -> Vec<f64> {
    arena.evaluate(roots, &|symbol: Symbol| sample.get(symbol.index()).copied().unwrap_or(0.0))
}

/// Rows of Φ_q, each scaled to a largest entry of 1.
fn jacobian_at(
    model: &Model,
    equations: &Equations,
    rows: &[usize],
    held: &BTreeSet<usize>,
    sample: &[f64],
) -> Vec<SparseRow<f64>> {
    let entries = rows.iter().flat_map(|&row| equations.phi_q[row].values().copied());
    let mut values = evaluate_at(&model.arena, &entries.collect::<Vec<_>>(), sample).into_iter();
    let mut row = |at: &usize| {
        let entries = equations.phi_q[*at].keys().copied().zip(values.by_ref());
        let is_kept = |(column, value): &(usize, f64)| value.is_finite() && !held.contains(column);
        let mut row: SparseRow<f64> = entries.filter(is_kept).collect();
        scale(&mut row);
        row
    };
    rows.iter().map(&mut row).collect()
}

/// Symbol values at the declared start.
fn declared_start(model: &Model) -> Vec<f64> {
    let parameters = model.values(|_| 0.0);
    let position = |at: usize| {
        let start = model.start.iter().find(|start| start.coordinate == at && !start.is_rate);
        start.map_or(0.0, |start| model.arena.evaluate(&[start.value], &parameters)[0])
    };
    let value = |&meaning: &Meaning| match meaning {
        Meaning::Parameter(at) => model.parameters[at].value,
        Meaning::Coordinate(at) => position(at),
        _ => 0.0,
    };
    model.meanings.iter().map(value).collect()
}

/// The size of the mechanism: the largest parameter that is a length, or 1 m.
pub fn typical_length(model: &Model) -> f64 {
    let lengths =
        model.parameters.iter().filter(|p| p.quantity.dimension == mbs_symbolic::units::Dimension::LENGTH);
    let largest = lengths.map(|p| p.value.abs()).fold(0.0, f64::max);
    if largest > 0.0 && largest.is_finite() { largest } else { 1.0 }
}

/// A small fixed generator (SplitMix64, Steele et al. 2014).
pub struct Generator(u64);

impl Generator {
    /// Always the same sequence.
    pub fn new() -> Self {
        Self(0x9e37_79b9_7f4a_7c15)
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in −1 … 1.
    pub fn symmetric(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}
