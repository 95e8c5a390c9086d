//! Positions on Φ = 0 found numerically, also where Φ_q is singular there.
//!
//! The programs that are emitted cannot do this: their elimination needs
//! independent constraints, and which ones are is what is to be found out.

use mbs_symbolic::Tape;

use super::correction::least_correction;
use super::samples::units;
use super::size::sizes;
use super::sparse::{SparseRow, scale};
use crate::derive::Equations;
use crate::model::{Meaning, Model};

const ITERATIONS: usize = 100;

/// The least damping, relative to the squares of the scaled rows: above the
/// rounding of the products, so that the damped matrix stays positive definite.
const LEAST_DAMPING: f64 = 1e-13;

/// Violations below this, relative to the size of the position, are closed:
/// what the emitted programs are held to as well.
pub const CLOSED: f64 = 1e-10;

/// A residual is rounding below this share of the terms that it is made of: some ten
/// operations, each to ε.
pub const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// A row whose slope over a typical length falls below this share of its terms
/// restricts nothing: far below that of an eccentric of a micrometre at a metre, far
/// above what Newton's iteration leaves of a double root.
const FLAT: f64 = 1e-9;

/// Coordinates and time.
#[derive(Clone, Debug)]
pub struct Position {
    pub q: Vec<f64>,
    pub t: f64,
}

impl Position {
    fn value(&self, meaning: Meaning) -> f64 {
        match meaning {
            Meaning::Time => self.t,
            Meaning::Coordinate(coordinate) => self.q[coordinate],
            _ => f64::NAN,
        }
    }
}

/// Where an assembly ended.
pub struct Closing {
    pub at: Position,
    /// Φ there, all rows.
    pub phi: Vec<f64>,
    /// The largest violation of the rows that were asked for, as a distance.
    pub violation: f64,
    /// True if the rows that were asked for are met.
    pub is_closed: bool,
}

/// Φ and Φ_q as functions of numbers.
pub struct Assembly<'a> {
    model: &'a Model,
    phi: Tape,
    /// The entries of Φ_q that are not 0, and where they stand.
    phi_q: Tape,
    pattern: Vec<Vec<usize>>,
    phi_t: Tape,
    depends_on_time: bool,
    /// The size that counts as 1 in each coordinate: a typical length, a radian.
    pub units: Vec<f64>,
}

impl<'a> Assembly<'a> {
    pub fn new(model: &'a Model, equations: &Equations) -> Self {
        let entries: Vec<_> = equations.phi_q.iter().flat_map(|row| row.values().copied()).collect();
        Self {
            model,
            phi: Tape::new(&model.arena, &equations.phi),
            phi_q: Tape::new(&model.arena, &entries),
            pattern: equations.phi_q.iter().map(|row| row.keys().copied().collect()).collect(),
            phi_t: Tape::new(&model.arena, &equations.phi_t),
            depends_on_time: equations.phi_t.iter().any(|&rate| !model.arena.is_zero(rate)),
            units: units(model),
        }
    }

    fn evaluate(&self, tape: &Tape, at: &Position) -> Vec<f64> {
        let values = self.model.values(|meaning| at.value(meaning));
        tape.evaluate(&self.model.arena, &values)
    }

    fn phi(&self, at: &Position) -> Vec<f64> {
        self.evaluate(&self.phi, at)
    }

    /// Φ_q in the units of the coordinates, each row divided by its largest
    /// entry, and these divisors.
    pub fn jacobian(&self, at: &Position) -> (Vec<SparseRow<f64>>, Vec<f64>) {
        let mut entries = self.evaluate(&self.phi_q, at).into_iter();
        let scaled = |columns: &Vec<usize>| {
            let entries = columns.iter().copied().zip(entries.by_ref());
            let in_units = entries.map(|(column, entry)| (column, entry * self.units[column]));
            let mut row: SparseRow<f64> = in_units.filter(|(_, entry)| entry.is_finite()).collect();
            let divisor = scale(&mut row);
            (row, divisor)
        };
        self.pattern.iter().map(scaled).unzip()
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.pattern.len()
    }

    /// True if a constraint changes with time.
    pub fn depends_on_time(&self) -> bool {
        self.depends_on_time
    }

    /// How fast the drives move the mechanism, in units of the coordinates.
    pub fn drive_speed(&self, at: &Position) -> f64 {
        let phi_t = self.evaluate(&self.phi_t, at);
        let (jacobian, scales) = self.jacobian(at);
        let rate: Vec<f64> = phi_t.iter().zip(&scales).map(|(rate, scale)| rate / scale).collect();
        let jacobian: Vec<_> = jacobian.iter().collect();
        largest(&least_correction(&jacobian, self.units.len(), &rate, LEAST_DAMPING))
    }

    /// The size of a position, in units of its coordinates.
    fn size(&self, at: &Position) -> f64 {
        at.q.iter().zip(&self.units).fold(0.0, |size: f64, (q, unit)| size.max((q / unit).abs()))
    }

    /// How far two positions are apart, in units of their coordinates.
    pub fn distance(&self, a: &Position, b: &Position) -> f64 {
        let apart = a.q.iter().zip(&b.q).zip(&self.units).map(|((a, b), unit)| ((a - b) / unit).abs());
        apart.fold(0.0, f64::max)
    }

    /// True if every one of these rows is met.
    pub fn are_met(&self, rows: &[usize], at: &Position) -> bool {
        let phi = self.phi(at);
        self.met(at, &phi, rows).into_iter().all(|is_met| is_met)
    }

    /// Of each of these rows, true if it is met: by its residual as a distance in the
    /// coordinates, or to the rounding of its terms.
    pub fn met(&self, at: &Position, phi: &[f64], rows: &[usize]) -> Vec<bool> {
        let scales = self.jacobian(at).1;
        let sizes = self.sizes(at);
        let limit = CLOSED * (1.0 + self.size(at));
        let is_met = |&row: &usize| {
            let violation = phi[row].abs();
            violation <= limit * scales[row] || violation <= ROUNDING * sizes[row]
        };
        rows.iter().map(is_met).collect()
    }

    /// Σ|terms| of every row of Φ.
    fn sizes(&self, at: &Position) -> Vec<f64> {
        let rows: Vec<_> = self.model.constraints.iter().map(|constraint| constraint.phi).collect();
        let values = self.model.values(|meaning| at.value(meaning));
        sizes(&self.model.arena, &rows, &values)
    }

    /// The row that is violated most where an assembly ended, as a distance.
    pub fn worst(&self, rows: &[usize], closing: &Closing) -> Option<usize> {
        let scales = self.jacobian(&closing.at).1;
        let violation = |row: usize| (closing.phi[row] / scales[row]).abs();
        rows.iter().copied().max_by(|&a, &b| violation(a).total_cmp(&violation(b)))
    }

    /// The rows whose derivatives vanish against what they compare: they restrict no
    /// motion there, as (x − y)² = 0 where it is met.
    pub fn flat_rows(&self, at: &Position) -> Vec<usize> {
        let (jacobian, scales) = self.jacobian(at);
        let sizes = self.sizes(at);
        // over a typical length, or over all of a coordinate that is larger
        let reach = |column: usize| (at.q[column] / self.units[column]).abs().max(1.0);
        let slope = |row: usize| {
            let entries = jacobian[row].iter().map(|&(column, entry)| entry.abs() * reach(column));
            scales[row] * entries.fold(0.0, f64::max)
        };
        let is_flat = |row: &usize| slope(*row) <= FLAT * sizes[*row];
        (0..sizes.len()).filter(is_flat).collect()
    }

    /// By how much a row is violated, as a distance, where others were assembled; `None` where it is met, or the
    /// others are not.
    pub fn violation(&self, row: usize, closing: &Closing) -> Option<f64> {
        let violation = (closing.phi[row] / self.jacobian(&closing.at).1[row]).abs();
        let is_met = self.met(&closing.at, &closing.phi, &[row]) == [true];
        (closing.is_closed && !is_met).then_some(violation)
    }

    /// A position near `guess` at its time where `rows` are met.
    pub fn close(&self, rows: &[usize], guess: &Position) -> Closing {
        self.close_with(rows, guess, &[])
    }

    /// The same with some coordinates kept as they are, by the method of Levenberg and
    /// Marquardt: the damping, of the order of the violation, keeps the convergence
    /// quadratic where the rows depend on each other (Yamashita and Fukushima 2001).
    pub fn close_with(&self, rows: &[usize], guess: &Position, kept: &[usize]) -> Closing {
        let rows = &self.model.of_positions(rows);
        let mut at = guess.clone();
        let mut phi = self.phi(&at);
        let mut damping = 1e-2;
        let mut violation = f64::INFINITY;
        for _ in 0..ITERATIONS {
            let (mut jacobian, scales) = self.jacobian(&at);
            if !kept.is_empty() {
                jacobian.iter_mut().for_each(|row| row.retain(|(column, _)| !kept.contains(column)));
            }
            let scaled = |phi: &[f64]| rows.iter().map(|&row| phi[row] / scales[row]).collect::<Vec<_>>();
            let residual = scaled(&phi);
            violation = largest(&residual);
            let chosen: Vec<_> = rows.iter().map(|&row| &jacobian[row]).collect();
            let size = norm(&residual);
            let mu = (damping * size).max(LEAST_DAMPING);
            let step = least_correction(&chosen, self.units.len(), &residual, mu);
            let next = Position {
                q: at.q.iter().zip(step).zip(&self.units).map(|((q, d), unit)| q - d * unit).collect(),
                t: at.t,
            };
            let next_phi = self.phi(&next);
            if norm(&scaled(&next_phi)) < size {
                (at, phi) = (next, next_phi);
                damping *= 0.1;
            } else if damping * size <= LEAST_DAMPING || damping > 1e12 || violation == 0.0 {
                break;
            } else if violation <= 1e-14 {
                // rounding decides from here on
                damping = 0.0;
            } else {
                damping *= 10.0;
            }
        }
        let is_closed = violation <= CLOSED * (1.0 + self.size(&at));
        Closing { at, phi, violation, is_closed }
    }
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The largest magnitude, infinite where a value is no number.
fn largest(values: &[f64]) -> f64 {
    values.iter().map(|x| if x.is_nan() { f64::INFINITY } else { x.abs() }).fold(0.0, f64::max)
}
