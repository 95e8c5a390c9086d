//! Random positions at the declared parameters, and what the equations are there.

use std::collections::BTreeSet;

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Arena, Expr, Symbol};

use super::assembly::{Position, ROUNDING};
use super::echelon::{Echelon, row_echelon};
use super::size::sizes;
use super::sparse::{SparseRow, scale};
use crate::derive::Equations;
use crate::inputs::{Input, Inputs};
use crate::model::{Meaning, Model};

/// How many positions are looked at.
const POSITIONS: usize = 5;

/// Symbol values at a few random positions. The sequence is fixed, so that the
/// same declaration always compiles to the same code.
pub struct Samples {
    values: Vec<Vec<f64>>,
    /// The declared start: coordinates that it leaves out at 0.
    start: Vec<f64>,
    /// The size that counts as 1 in each coordinate.
    units: Vec<f64>,
}

impl Samples {
    /// Random coordinates, velocities and times; declared parameters.
    pub fn new(model: &Model, inputs: &Inputs) -> Self {
        let mut generator = Generator::new();
        let units = units(model);
        let values = (0..POSITIONS)
            .map(|_| {
                inputs
                    .iter()
                    .map(|input| match input {
                        Input::Parameter(at) => model.parameters[at].value,
                        // angles all around; rates, times and the rest of order 1
                        Input::Position(at) if is_angle(model, at) => 3.0 * generator.symmetric(),
                        Input::Position(at) => units[at] * generator.symmetric(),
                        _ => generator.symmetric(),
                    })
                    .collect()
            })
            .collect();
        Self { values, start: declared_start(model), units }
    }

    /// Coordinates and time of the declared start.
    pub fn start_position(&self, model: &Model) -> Position {
        let q = model.coordinates.iter().map(|coordinate| self.start[coordinate.position.index()]).collect();
        Position { q, t: self.start[model.time.index()] }
    }

    /// The value of a symbol at one of the positions.
    pub fn value(&self, symbol: Symbol, position: usize) -> f64 {
        self.values[position].get(symbol.index()).copied().unwrap_or(0.0)
    }

    /// The number of positions.
    pub fn positions(&self) -> std::ops::Range<usize> {
        0..self.values.len()
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
            let jacobian = self.jacobian_at(model, equations, rows, &BTreeSet::new(), sample);
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

    /// The coordinates without mass that these rows of Φ_q do not determine, at any
    /// of the positions: their columns depend on those of others without mass.
    pub fn undetermined(&self, model: &Model, equations: &Equations, rows: &[usize]) -> Vec<usize> {
        let masses = model.arena.evaluate(&equations.mass, &model.values(|_| f64::NAN));
        let massless: Vec<usize> = (0..masses.len()).filter(|&at| masses[at] == 0.0).collect();
        let dependent = |sample: &Vec<f64>| {
            let jacobian = self.jacobian_at(model, equations, rows, &BTreeSet::new(), sample);
            let column = |&at: &usize| {
                let entry_in = |row: &SparseRow<f64>| {
                    row.iter().find_map(|&(column, entry)| (column == at && entry != 0.0).then_some(entry))
                };
                let entries = jacobian.iter().enumerate();
                let mut column: SparseRow<f64> =
                    entries.filter_map(|(row, entries)| Some((row, entry_in(entries)?))).collect();
                scale(&mut column);
                column
            };
            let dependent = row_echelon(massless.iter().map(column).collect()).dependent;
            dependent.into_iter().map(|(at, _)| massless[at]).collect::<Vec<_>>()
        };
        if massless.is_empty() {
            return Vec::new();
        }
        self.values.iter().map(dependent).min_by_key(Vec::len).unwrap_or_default()
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
        let rank =
            |sample: &Vec<f64>| row_echelon(self.jacobian_at(model, equations, rows, held, sample)).rank();
        self.values.iter().map(rank).max().unwrap_or(0)
    }

    /// All of Φ_q at a position, in echelon form.
    pub fn echelon(&self, model: &Model, equations: &Equations, position: usize) -> Echelon {
        let rows: Vec<usize> = (0..equations.phi.len()).collect();
        row_echelon(self.jacobian_at(model, equations, &rows, &BTreeSet::new(), &self.values[position]))
    }

    /// Rows of Φ_q in the units of the coordinates, each scaled to a largest entry of 1.
    fn jacobian_at(
        &self,
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
            let in_units = entries.map(|(column, entry)| (column, entry * self.units[column]));
            let is_kept = |(column, entry): &(usize, f64)| entry.is_finite() && !held.contains(column);
            let mut row: SparseRow<f64> = in_units.filter(is_kept).collect();
            scale(&mut row);
            row
        };
        rows.iter().map(&mut row).collect()
    }
}

fn evaluate_at(arena: &Arena, roots: &[Expr], sample: &[f64]) -> Vec<f64> {
    arena.evaluate(roots, &|symbol: Symbol| sample.get(symbol.index()).copied().unwrap_or(0.0))
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
        Meaning::Time => model.arena.evaluate(&[model.start_time], &parameters)[0],
        // constraints do not read them
        Meaning::Input(_) | Meaning::Velocity(_) | Meaning::Acceleration(_) | Meaning::Multiplier(_) => 0.0,
    };
    model.meanings.iter().map(value).collect()
}

/// The size of the mechanism in m: the largest length that its constraints compare,
/// which are angles and given lengths where all coordinates that are lengths are 0.
/// Without any, the largest parameter that is a length, or 1 m. A length below the rounding
/// of the places of points is what numbers leave that were meant to cancel.
pub fn typical_length(model: &Model) -> f64 {
    let is_usable = |length: &f64| *length > 0.0 && length.is_finite();
    let mut generator = Generator::new();
    let values: Vec<f64> = model
        .meanings
        .iter()
        .map(|&meaning| match meaning {
            Meaning::Parameter(at) => model.parameters[at].value,
            Meaning::Coordinate(at) if is_angle(model, at) => generator.symmetric(),
            _ => 0.0,
        })
        .collect();
    let value = |symbol: Symbol| values.get(symbol.index()).copied().unwrap_or(0.0);
    let of_dimension = |dimension: Dimension| {
        let rows = model.constraints.iter().filter(|constraint| constraint.dimension == dimension);
        let rows: Vec<Expr> = rows.map(|constraint| constraint.phi).collect();
        let sizes = sizes(&model.arena, &rows, &value);
        rows.into_iter().zip(sizes).filter(|(_, size)| is_usable(size)).collect::<Vec<_>>()
    };
    let squares = of_dimension(Dimension::LENGTH.times(Dimension::LENGTH)).into_iter();
    let squares = squares.map(|(_, size)| size.sqrt());
    let lengths = largest_way(model, &value, of_dimension(Dimension::LENGTH));
    let places: Vec<Expr> = model.sketch.points.iter().filter_map(|point| point.local).flatten().collect();
    let farthest = model.arena.evaluate(&places, &value).into_iter().map(f64::abs).fold(0.0, f64::max);
    let compared = lengths.into_iter().chain(squares).filter(|length| *length > ROUNDING * farthest);
    let parameters = model.parameters.iter().filter(|p| p.quantity.dimension == Dimension::LENGTH);
    let parameters = parameters.map(|p| p.value.abs()).filter(is_usable);
    compared.reduce(f64::max).or_else(|| parameters.reduce(f64::max)).unwrap_or(1.0)
}

/// Rows beyond the largest few are not asked for the way that they measure.
const MOST_ROWS: usize = 32;

/// The largest way by which coordinates would have to change to be worth the size of a row: of (d² − l²)/2l with a distance
/// l that is short beside the coordinates, d²/2l is larger than any length that is compared, and so is its slope.
fn largest_way(model: &Model, value: &dyn Fn(Symbol) -> f64, mut rows: Vec<(Expr, f64)>) -> Option<f64> {
    rows.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut largest: Option<f64> = None;
    for (row, size) in rows.into_iter().take(MOST_ROWS) {
        if largest.is_some_and(|largest| largest >= size) {
            break;
        }
        let moved = |at: Symbol, by: f64| {
            let value = |symbol: Symbol| value(symbol) + if symbol == at { by } else { 0.0 };
            model.arena.evaluate(&[row], &value)[0]
        };
        let is_length = |symbol: &Symbol| match model.meanings.get(symbol.index()) {
            Some(Meaning::Coordinate(at)) => !is_angle(model, *at),
            _ => false,
        };
        let symbols = model.arena.symbols_in(row).into_iter().filter(is_length);
        let slopes = symbols.map(|at| (moved(at, size) - moved(at, -size)).abs() / (2.0 * size));
        let slope = slopes.filter(|slope| slope.is_finite()).fold(1.0, f64::max);
        let way = size / slope;
        largest = Some(largest.map_or(way, |largest| largest.max(way)));
    }
    largest
}

/// The size that counts as 1 in each coordinate: a typical length, a radian.
pub fn units(model: &Model) -> Vec<f64> {
    let length = typical_length(model);
    (0..model.coordinates.len()).map(|at| if is_angle(model, at) { 1.0 } else { length }).collect()
}

fn is_angle(model: &Model, coordinate: usize) -> bool {
    model.coordinates[coordinate].quantity.dimension == Dimension::NONE
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
