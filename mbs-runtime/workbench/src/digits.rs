//! Number of digits of the reactions that are more than rounding.

use mbs_runtime::System;
use mbs_runtime::equations::At;

use crate::doubt::{DIGITS, Doubt};
use crate::instant::Instant;

/// Every position is moved by so many of its roundings.
const ROUNDINGS: f64 = 2.0;
/// Reactions are looked at that are larger than this share of the weight of the heaviest body: in a mechanism
/// without loads they are rounding.
const LOADED: f64 = 1e-6;
/// m/s²
const GRAVITY: f64 = 9.81;

/// The digits of reactions, looked at where they are twice as large as where they were last, and judged by the
/// largest ones of the run: where a stiff spring is not stretched its force is rounding, and small.
#[derive(Default)]
pub(crate) struct Reactions {
    /// By the power of the length in their constraints.
    kinds: Vec<Kind>,
}

/// Reactions of constraints with the same power of the length.
struct Kind {
    power: i8,
    largest: f64,
    /// The largest one when it was looked at last.
    seen: f64,
    /// From this on a force counts as a load.
    loaded: f64,
    /// The largest change by rounding, when, and of which constraint.
    worst: Option<(f64, f64, &'static str)>,
}

impl Reactions {
    /// Sees q̈ and λ of an instant of a mechanism of this size.
    pub fn see(&mut self, run: &dyn System, now: &Instant, size: f64) {
        let constraints = run.equations().info().constraints;
        for (row, multiplier) in constraints.iter().zip(&now.multipliers) {
            let power = row.dimension.length;
            match self.kinds.iter_mut().find(|kind| kind.power == power) {
                Some(kind) => kind.largest = kind.largest.max(multiplier.abs()),
                None => {
                    let largest = multiplier.abs();
                    self.kinds.push(Kind { power, largest, seen: 0.0, loaded: 0.0, worst: None });
                }
            }
        }
        if !self.kinds.iter().any(|kind| kind.largest > 2.0 * kind.seen) {
            return;
        }
        let weight = GRAVITY * heaviest(run, now, size);
        let Some(changes) = changes(run, now) else { return };
        for kind in &mut self.kinds {
            kind.seen = kind.largest;
            kind.loaded = LOADED * weight * size.powi(1 - i32::from(kind.power));
            let rows = constraints.iter().zip(&changes).filter(|(row, _)| row.dimension.length == kind.power);
            for (row, change) in rows {
                if kind.worst.is_none_or(|(worst, ..)| *change > worst) {
                    kind.worst = Some((*change, run.time(), row.name));
                }
            }
        }
    }

    /// The doubt of the reactions with the fewest digits.
    pub fn doubt(self) -> Option<Doubt> {
        let doubts = self.kinds.into_iter().filter_map(|kind| {
            let (change, at, name) = kind.worst.filter(|_| kind.largest > kind.loaded)?;
            Some((-(change / kind.largest).log10(), at, name))
        });
        let (left, at, name) = doubts.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (left < DIGITS).then_some(Doubt::Digits { left: left.max(0.0), at, name })
    }
}

/// By how much each multiplier changes where positions change by a rounding.
fn changes(run: &dyn System, now: &Instant) -> Option<Vec<f64>> {
    let info = run.equations().info();
    let mut inputs = vec![0.0; info.inputs.len()];
    run.inputs(&mut inputs);
    let mut changes = vec![0.0_f64; now.multipliers.len()];
    // neighbours apart, and then pairs of them
    for period in [1, 2] {
        let sign = |at: usize| if (at / period).is_multiple_of(2) { 1.0 } else { -1.0 };
        let moved = |(at, q): (usize, &f64)| q + sign(at) * ROUNDINGS * f64::EPSILON * q;
        let q: Vec<f64> = now.q.iter().enumerate().map(moved).collect();
        let mut acceleration = vec![0.0; q.len()];
        let mut multipliers = vec![0.0; changes.len()];
        let at = At { t: run.time(), q: &q, v: &now.v };
        run.equations().reactions(at, &inputs, &mut acceleration, &mut multipliers);
        for (change, (there, here)) in changes.iter_mut().zip(multipliers.iter().zip(&now.multipliers)) {
            *change = change.max((there - here).abs());
        }
    }
    changes.iter().all(|change| change.is_finite()).then_some(changes)
}

/// The largest mass along a coordinate; of an angle, its inertia at the distance of the size.
fn heaviest(run: &dyn System, now: &Instant, size: f64) -> f64 {
    let coordinates = run.equations().info().coordinates;
    let mass = |at: usize| {
        let mut v = vec![0.0; coordinates.len()];
        v[at] = 1.0;
        let [kinetic, _] = run.energies(At { t: run.time(), q: &now.q, v: &v });
        let scale = if coordinates[at].dimension.length != 0 { 1.0 } else { size };
        2.0 * kinetic / (scale * scale)
    };
    (0..coordinates.len()).map(mass).fold(0.0, f64::max)
}
