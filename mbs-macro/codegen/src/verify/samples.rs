//! Random positions at the declared parameters, and what the equations are there.

use std::collections::BTreeSet;

use mbs_symbolic::{Arena, Expr, Symbol};

use crate::derive::Equations;
use crate::model::{Meaning, Model};

/// How many positions are looked at.
const POSITIONS: usize = 5;

/// A singular value of a normalised Jacobian below this counts as 0: far above
/// rounding (1e-16 times a few hundred operations), far below what random
/// positions of a regular mechanism give.
pub const RANK_TOLERANCE: f64 = 1e-9;

/// Symbol values at a few random positions. The sequence is fixed, so that the
/// same declaration always compiles to the same code.
pub struct Samples {
    values: Vec<Vec<f64>>,
}

impl Samples {
    /// Random coordinates, velocities and times; declared parameters.
    pub fn new(model: &Model) -> Self {
        let mut generator = Generator(0x9e37_79b9_7f4a_7c15);
        let length = typical_length(model);
        let values = (0..POSITIONS)
            .map(|_| {
                let sample: Vec<f64> = model
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
                    .collect();
                sample
            })
            .collect();
        Self { values }
    }

    /// The values of expressions at one of the positions.
    pub fn evaluate(&self, arena: &Arena, roots: &[Expr], position: usize) -> Vec<f64> {
        let sample = &self.values[position];
        arena.evaluate(roots, &|symbol: Symbol| sample.get(symbol.index()).copied().unwrap_or(0.0))
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

    /// The rank of Φ_q without the columns in `held`: the largest over the
    /// positions, which is the generic one.
    pub fn rank(&self, model: &Model, equations: &Equations, held: &BTreeSet<usize>) -> usize {
        let rank = |position| {
            let matrix = self.jacobian(model, equations, held, position);
            super::rank::row_echelon(matrix).rank()
        };
        self.positions().map(rank).max().unwrap_or(0)
    }

    /// Φ_q at a position, each row scaled to a largest entry of 1.
    pub fn jacobian(
        &self,
        model: &Model,
        equations: &Equations,
        held: &BTreeSet<usize>,
        position: usize,
    ) -> Vec<Vec<f64>> {
        let n = model.coordinates.len();
        let row = |entries: &std::collections::BTreeMap<usize, Expr>| {
            let (columns, exprs): (Vec<usize>, Vec<Expr>) =
                entries.iter().filter(|(column, _)| !held.contains(column)).map(|(&c, &e)| (c, e)).unzip();
            let mut row = vec![0.0; n];
            for (column, value) in columns.into_iter().zip(self.evaluate(&model.arena, &exprs, position)) {
                row[column] = if value.is_finite() { value } else { 0.0 };
            }
            let largest = row.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
            if largest > 0.0 { row.iter().map(|x| x / largest).collect() } else { row }
        };
        equations.phi_q.iter().map(row).collect()
    }
}

/// The size of the mechanism: the largest parameter that is a length, or 1 m.
fn typical_length(model: &Model) -> f64 {
    let lengths =
        model.parameters.iter().filter(|p| p.quantity.dimension == mbs_symbolic::units::Dimension::LENGTH);
    let largest = lengths.map(|p| p.value.abs()).fold(0.0, f64::max);
    if largest > 0.0 && largest.is_finite() { largest } else { 1.0 }
}

/// A small fixed generator (SplitMix64, Steele et al. 2014).
struct Generator(u64);

impl Generator {
    /// Uniform in −1 … 1.
    fn symmetric(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        (z >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}
