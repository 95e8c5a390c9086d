//! Number of digits of the reactions that are more than rounding.

use mbs_runtime::System;
use mbs_runtime::equations::At;

use crate::doubt::{DIGITS, Doubt};
use crate::run::Instant;

/// Every position is moved by so many of its roundings.
const ROUNDINGS: f64 = 2.0;
/// Reactions are looked at that are larger than this share of the weight of the heaviest body: in a mechanism
/// without loads they are rounding.
const LOADED: f64 = 1e-6;
/// m/s²
const GRAVITY: f64 = 9.81;

/// The digits of reactions, looked at where they are twice as large as where they were last.
#[derive(Default)]
pub(crate) struct Reactions {
    /// The largest ones that were looked at, by the power of the length in their constraints.
    seen: Vec<(i8, f64)>,
    worst: Option<Doubt>,
}

impl Reactions {
    /// Sees q̈ and λ of an instant of a mechanism of this size.
    pub fn see(&mut self, run: &dyn System, now: &Instant, size: f64) {
        let constraints = run.equations().info().constraints;
        let mut largest: Vec<(i8, f64)> = Vec::new();
        for (row, multiplier) in constraints.iter().zip(&now.multipliers) {
            let power = row.dimension.length;
            match largest.iter_mut().find(|(other, _)| *other == power) {
                Some((_, of)) => *of = of.max(multiplier.abs()),
                None => largest.push((power, multiplier.abs())),
            }
        }
        let seen = |power: i8| self.seen.iter().find(|(other, _)| *other == power).map_or(0.0, |(_, of)| *of);
        if !largest.iter().any(|(power, of)| *of > 2.0 * seen(*power)) {
            return;
        }
        let weight = GRAVITY * heaviest(run, now, size);
        let Some(changes) = changes(run, now) else { return };
        for (at, row) in constraints.iter().enumerate() {
            let power = row.dimension.length;
            let of = largest.iter().find(|(other, _)| *other == power).map_or(0.0, |(_, of)| *of);
            let is_loaded = of > LOADED * weight * size.powi(1 - i32::from(power));
            let left = -(changes[at] / of).log10();
            if is_loaded && left < DIGITS && self.left() > left {
                self.worst = Some(Doubt::Digits { left: left.max(0.0), at: run.time(), name: row.name });
            }
        }
        self.seen = largest;
    }

    fn left(&self) -> f64 {
        match &self.worst {
            Some(Doubt::Digits { left, .. }) => *left,
            _ => f64::INFINITY,
        }
    }

    /// The doubt of the reactions with the fewest digits.
    pub fn doubt(self) -> Option<Doubt> {
        self.worst
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
        run.described().reactions(at, &inputs, &mut acceleration, &mut multipliers);
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
