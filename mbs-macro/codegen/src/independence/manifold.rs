//! The rank of Φ_q where the mechanism is assembled at its declared
//! dimensions: at the start, and at other positions that it can reach.

use super::Samples;
use super::assembly::{Assembly, Closing, Position};
use super::echelon::{Echelon, row_echelon};
use super::samples::Generator;
use crate::model::Model;

/// Positions that are looked at beside the start.
const POSITIONS: usize = 4;

/// How far a position is moved before it is assembled again, in radians or
/// typical lengths: far enough to leave a singular position, near enough to stay
/// on the branch of the start.
const STRIDE: f64 = 0.3;

/// Positions closer than this are the same one.
const SAME: f64 = 1e-3;

/// Assembled positions and Φ_q there.
pub struct Manifold {
    pub start: Position,
    echelons: Vec<Echelon>,
    /// Whether the mechanism has only this one position although Φ_q would let
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
        let Closing { at: start, is_closed: true, .. } = assembly.close(rows, &samples.start_position(model))
        else {
            return None;
        };
        let mut positions = vec![start.clone()];
        let mut generator = Generator::new();
        for t in instants(assembly, &start) {
            let from = positions[positions.len() - 1].clone();
            positions.extend(stride(assembly, rows, &from, t, &mut generator));
        }
        let echelons: Vec<Echelon> =
            positions.iter().map(|position| row_echelon(assembly.jacobian(position).0)).collect();
        let can_move = echelons[0].rank() < model.coordinates.len();
        let is_isolated =
            can_move && positions.iter().all(|position| assembly.distance(position, &start) < SAME);
        Some(Self { start, echelons, is_isolated })
    }

    /// The times at which the mechanism is looked at beside its start.
    pub fn instants(&self, assembly: &Assembly<'_>) -> Vec<f64> {
        instants(assembly, &self.start)
    }

    /// What holds at every position that was looked at: the echelon of the one
    /// with the largest rank.
    pub fn generic(&self) -> &Echelon {
        let first = &self.echelons[0];
        self.echelons.iter().fold(first, |best, next| if next.rank() > best.rank() { next } else { best })
    }

    /// The constraints that repeat others at every position, if there are any.
    pub fn redundant(&self) -> &[(usize, Vec<usize>)] {
        if self.is_isolated { &[] } else { &self.generic().dependent }
    }
}

/// Times between which the drives move the mechanism by about one stride; that of
/// the start again and again where nothing depends on time.
fn instants(assembly: &Assembly<'_>, start: &Position) -> Vec<f64> {
    let interval = if assembly.depends_on_time() {
        let speed = assembly.drive_speed(start);
        // A drive that starts from rest says nothing: a tenth of a second.
        if speed > 1e-6 && speed.is_finite() { STRIDE / speed } else { 0.1 }
    } else {
        0.0
    };
    (1..=POSITIONS).map(|step| start.t + interval * step as f64).collect()
}

/// Another assembled position near `from`, if one is found.
fn stride(
    assembly: &Assembly<'_>,
    rows: &[usize],
    from: &Position,
    t: f64,
    generator: &mut Generator,
) -> Option<Position> {
    let mut length = STRIDE;
    for _ in 0..3 {
        let moved =
            from.q.iter().zip(&assembly.units).map(|(q, unit)| q + length * unit * generator.symmetric());
        let closing = assembly.close(rows, &Position { q: moved.collect(), t });
        // Another branch may have another rank; drives move as far as they do.
        let is_near = t != from.t || assembly.distance(&closing.at, from) <= 4.0 * STRIDE;
        if closing.is_closed && is_near {
            return Some(closing.at);
        }
        length *= 0.3;
    }
    None
}
