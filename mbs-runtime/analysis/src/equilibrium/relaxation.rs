//! The equilibrium at which a mechanism comes to rest, by pseudo-transient continuation.

use nalgebra::DVector;

use super::correction::Correction;
use super::newton::newton;
use super::stiffness::Stiffness;
use super::{Found, ITERATIONS, LONGEST, lost, near};
use crate::Error;
use crate::tangent::Rest;

/// An unstable equilibrium is left by this many scales.
const PUSH: f64 = 1e-2;
/// An implicit step is solved in at most so many corrections,
const CORRECTIONS: usize = 6;
/// the last of which is less than this share of the first,
const SOLVED: f64 = 1e-3;
/// or than this share of the scales,
const SMALL: f64 = 1e-13;
/// and none of which is more than so many times the first.
const DIVERGED: f64 = 4.0;
/// Steps are chosen to lead as far as this share of the longest one,
const WISHED: f64 = 0.8;
/// and become at most so many times as long or as short at once.
const CHANGE: f64 = 4.0;
/// Newton's method ends a relaxation in at most so many iterations.
const LAST: u32 = 20;

/// Follows q̇ = q̈(q), in which q̈ is that from rest, in implicit Euler steps s (y − q) = q̈(y).
///
/// The equation of a step is solved, because a single linear step leaves the curved valley of a stiff
/// spring. Steps become longer while the mechanism hardly moves, and shorter where their equation is not
/// solved or they lead too far. Where the mechanism falls away at a rate κ, s is at least 2κ: a longer
/// step would lead back to where it falls from. Elsewhere Newton's method, which is the infinitely long
/// step, ends the search if it leads no further than `LONGEST`.
pub fn relax(rest: &Rest<'_>, start: DVector<f64>) -> Result<Found, Error> {
    let mut q = start;
    let mut s = rest.measure(&rest.acceleration(&q).0);
    let mut made = 0;
    for iteration in 1..=ITERATIONS {
        made = iteration;
        let Some(grown) = &near(rest, &q) else { break };
        let Some(stiffness) = Stiffness::at(grown, &q) else { break };
        if let Some(push) = push(grown, &stiffness, &q) {
            q = grown.moved(&q, &push)?;
            continue;
        }
        if stiffness.falling == 0.0
            && let Some(q) = settled(rest, grown, &q)
        {
            return Ok(Found { q, iterations: iteration });
        }
        s = s.max(2.0 * stiffness.falling);
        let Some((y, length)) = implicit_step(grown, &q, s) else {
            s *= CHANGE;
            continue;
        };
        if length <= LONGEST {
            q = y;
        }
        s *= (length / (WISHED * LONGEST)).clamp(1.0 / CHANGE, CHANGE);
    }
    Err(lost(rest, &q, made))
}

/// A displacement by which the mechanism falls further away, if it stands nearer than that to where it
/// balances.
fn push(rest: &Rest<'_>, stiffness: &Stiffness, q: &DVector<f64>) -> Option<DVector<f64>> {
    let unit = PUSH / rest.measure(&stiffness.weakest);
    let away = stiffness.along_weakest(&rest.acceleration(q).0) / stiffness.falling;
    let is_balanced = stiffness.falling > 0.0 && away.abs() < unit;
    is_balanced.then(|| &stiffness.weakest * unit.copysign(away))
}

/// Where Newton's method leads from a position, if that is near and the mechanism does not fall from there.
fn settled(at_first: &Rest<'_>, rest: &Rest<'_>, q: &DVector<f64>) -> Option<DVector<f64>> {
    let found = newton(rest, at_first, q.clone(), LAST).ok()?.q;
    let is_held = Stiffness::at(rest, &found)?.falling == 0.0;
    (is_held && rest.measure(&(&found - q)) <= LONGEST).then_some(found)
}

/// The y of s (y − q) = q̈(y), and how far it is, by Newton's method.
fn implicit_step(rest: &Rest<'_>, q: &DVector<f64>, s: f64) -> Option<(DVector<f64>, f64)> {
    let mut y = q.clone();
    let mut first = f64::INFINITY;
    for _ in 0..CORRECTIONS {
        let missing = rest.acceleration(&y).0 - (&y - q) * s;
        let Correction { step, length, .. } = Correction::at(rest, &y, &missing, s)?;
        if length > DIVERGED * first {
            return None;
        }
        first = if first.is_finite() { first } else { length };
        y = rest.moved(&y, &(step * (LONGEST / length).min(1.0))).ok()?;
        if length <= SOLVED * first || length < SMALL {
            let moved = rest.measure(&(&y - q));
            return Some((y, moved));
        }
    }
    None
}
