//! The rank of Φ_q where the mechanism is assembled at its declared
//! dimensions: at the start, and at other positions that it can reach.
//!
//! The mechanism is followed along its manifold. A row that depends on others in every position on the way
//! is redundant. One that does so at the start alone makes the mechanism singular there. A row that depends
//! on others, but is violated where they are met nearby, touches them.

use super::Samples;
use super::assembly::{Assembly, Closing, Position};
use super::echelon::{Echelon, RANK_TOLERANCE, row_echelon_within};
use super::rows::Dependent;
use super::samples::Generator;
use crate::model::Model;

/// Positions that are looked at beside the start.
const POSITIONS: usize = 4;

/// How far a position is moved before it is assembled again, in radians or
/// typical lengths: far enough to leave a singular position, near enough to stay
/// on the branch of the start.
pub const STRIDE: f64 = 0.3;

/// Positions closer than this are the same one.
pub const SAME: f64 = 1e-3;

/// Where constraints touch, as a circle touches its tangent, a violation δ² leaves a distance of
/// the order of δ, and so much of a row that others do not explain. Some ten times that.
const DOUBLE_ROOT: f64 = 30.0;

/// How far a position is moved to tell constraints that repeat each other from constraints that
/// touch, in radians or typical lengths: these are violated by its square, those not at all.
const NUDGE: f64 = 1e-3;

/// A quarter of a nudge violates a constraint that touches by a sixteenth. One that is violated by
/// the same, or no longer, was left for another branch of the others.
const QUARTERS: i32 = 6;

/// The ratio of two such violations, with the terms of third order.
const SQUARE: std::ops::Range<f64> = 1.0 / 64.0..1.0 / 4.0;

/// An assembled position and Φ_q there.
struct Place {
    at: Position,
    echelon: Echelon,
}

impl Place {
    fn new(assembly: &Assembly<'_>, closing: Closing) -> Self {
        let tolerance = RANK_TOLERANCE.max(DOUBLE_ROOT * closing.violation.max(f64::EPSILON).sqrt());
        let echelon = row_echelon_within(assembly.jacobian(&closing.at).0, tolerance);
        Self { at: closing.at, echelon }
    }
}

/// Assembled positions and Φ_q there.
pub struct Manifold {
    /// The start and others; never empty.
    places: Vec<Place>,
    /// True if the mechanism has only this one position although Φ_q would let
    /// it move: then it is singular there, and no constraint is redundant.
    is_isolated: bool,
}

impl Manifold {
    /// The mechanism assembled near its declared start and followed from there;
    /// `None` if it does not assemble.
    pub fn explore(
        assembly: &Assembly<'_>,
        samples: &Samples,
        model: &Model,
        rows: &[usize],
    ) -> Option<Self> {
        let closing = assembly.close(rows, &samples.start_position(model));
        if !closing.is_closed {
            return None;
        }
        let start = Place::new(assembly, closing);
        let mut places = Vec::new();
        let mut from = start.at.clone();
        let mut generator = Generator::new();
        for t in instants(assembly, &start.at) {
            let mut anywhere = || (0..assembly.units.len()).map(|_| generator.symmetric()).collect();
            if let Some(closing) = stride(assembly, rows, &from, t, &mut anywhere) {
                from = closing.at.clone();
                places.push(Place::new(assembly, closing));
            }
        }
        let can_move = start.echelon.rank() < model.line_count();
        let is_isolated =
            can_move && places.iter().all(|place| assembly.distance(&place.at, &start.at) < SAME);
        places.insert(0, start);
        Some(Self { places, is_isolated })
    }

    /// The start, assembled.
    pub fn start(&self) -> &Position {
        &self.places[0].at
    }

    /// The times at which the mechanism is looked at beside its start.
    pub fn instants(&self, assembly: &Assembly<'_>) -> Vec<f64> {
        instants(assembly, self.start())
    }

    /// The position with the largest rank, where what holds there holds at every position that was
    /// looked at.
    fn generic(&self) -> &Place {
        let mut generic = &self.places[0];
        for place in &self.places {
            if place.echelon.rank() > generic.echelon.rank() {
                generic = place;
            }
        }
        generic
    }

    /// The constraints that repeat others at every position, if there are any.
    pub fn redundant(&self) -> &[Dependent] {
        if self.is_isolated { &[] } else { &self.generic().echelon.dependent }
    }

    /// Those of the redundant constraints that touch others instead of repeating them: nearby, where
    /// the others are met, they are violated by the square of the distance. A longer way may lead to
    /// another branch of the others, on which they are violated by what both are apart.
    pub fn touching(&self, assembly: &Assembly<'_>) -> Vec<Dependent> {
        let redundant = self.redundant();
        if redundant.is_empty() {
            return Vec::new();
        }
        let is_redundant = |row: &usize| redundant.iter().any(|(dependent, _)| dependent == row);
        let basis: Vec<usize> = (0..assembly.rows()).filter(|row| !is_redundant(row)).collect();
        let mut generator = Generator::new();
        let at = &self.generic().at;
        let nearby: Vec<Vec<Closing>> = (0..POSITIONS)
            .map(|_| {
                let direction: Vec<f64> =
                    assembly.units.iter().map(|unit| NUDGE * unit * generator.symmetric()).collect();
                let nudged = |quarters: i32| {
                    let length = 0.25_f64.powi(quarters);
                    let q = at.q.iter().zip(&direction).map(|(q, d)| q + length * d).collect();
                    assembly.close(&basis, &Position { q, t: at.t })
                };
                (0..QUARTERS).map(nudged).collect()
            })
            .collect();
        // the larger one is not 0 where both are violations
        let is_square = |row: usize, pair: &[Closing]| match pair {
            [far, near] => {
                let violation = |closing| assembly.violation(row, closing);
                violation(far).zip(violation(near)).is_some_and(|(far, near)| SQUARE.contains(&(near / far)))
            }
            _ => false,
        };
        let is_violated =
            |row: usize| nearby.iter().any(|closings| closings.windows(2).any(|pair| is_square(row, pair)));
        redundant.iter().filter(|(row, _)| is_violated(*row)).cloned().collect()
    }
}

/// The time in which the drives move the mechanism by about one stride; 0 where nothing depends on time.
pub fn interval(assembly: &Assembly<'_>, start: &Position) -> f64 {
    if !assembly.depends_on_time() {
        return 0.0;
    }
    let speed = assembly.drive_speed(start);
    // A drive that starts from rest says nothing: a tenth of a second.
    if speed > 1e-6 && speed.is_finite() { STRIDE / speed } else { 0.1 }
}

/// Times between which the drives move the mechanism by about one stride; that of
/// the start again and again where nothing depends on time.
fn instants(assembly: &Assembly<'_>, start: &Position) -> Vec<f64> {
    let interval = interval(assembly, start);
    (1..=POSITIONS).map(|step| start.t + interval * step as f64).collect()
}

/// Another assembled position near `from` in some direction, in units of the coordinates, if one is found.
pub fn stride(
    assembly: &Assembly<'_>,
    rows: &[usize],
    from: &Position,
    t: f64,
    direction: &mut dyn FnMut() -> Vec<f64>,
) -> Option<Closing> {
    let mut length = STRIDE;
    for _ in 0..3 {
        let moved = from.q.iter().zip(&assembly.units).zip(direction());
        let moved = moved.map(|((q, unit), along)| q + length * unit * along);
        let closing = assembly.close(rows, &Position { q: moved.collect(), t });
        // Another branch may have another rank; drives move as far as they do.
        let is_near = t != from.t || assembly.distance(&closing.at, from) <= 4.0 * STRIDE;
        if closing.is_closed && is_near {
            return Some(closing);
        }
        length *= 0.3;
    }
    None
}
