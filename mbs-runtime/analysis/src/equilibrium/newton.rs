//! The nearest equilibrium, by Newton's method.

use nalgebra::DVector;

use super::correction::Correction;
use super::{Found, LONGEST, lost, near};
use crate::Error;
use crate::tangent::Rest;

/// The search has ended when a correction is below this share of the scales.
const SMALL: f64 = 1e-11;
/// A correction that is a rounding ends it too, if it is below this share.
const KNOWN: f64 = 1e-6;
/// A step is halved at most so often.
const HALVINGS: u32 = 6;
/// A correction is compared with so many before it.
const REMEMBERED: usize = 4;

/// Newton's method from a position on the constraints, in steps of a bounded length.
///
/// A step is halved where the correction after it is longer than each of the last few (a non-monotone line
/// search). Accelerations would be no measure: a step along the curved valley of a stiff spring enlarges
/// them, however near it leads. One correction before is not enough: in such a valley a short correction,
/// which leads back to the floor, follows each long one.
/// What balances is measured by the scales `at_first`, those of the position from which the search began.
pub fn newton(
    rest: &Rest<'_>,
    at_first: &Rest<'_>,
    start: DVector<f64>,
    iterations: u32,
) -> Result<Found, Error> {
    let mut q = start;
    let acceleration = rest.acceleration(&q).0;
    let strongest = rest.measure(&acceleration);
    let mut best = (strongest, q.clone());
    let mut lengths = [f64::INFINITY; REMEMBERED];
    let mut correction = Correction::at(rest, &q, &acceleration, 0.0);
    let mut made = 0;
    for iteration in 1..=iterations {
        made = iteration;
        let (Some(grown), Some(now)) = (near(rest, &q), correction) else { break };
        let longest = lengths.into_iter().fold(0.0, f64::max);
        // what is rounding does not fall any more
        let has_stalled = longest < now.rounding.min(KNOWN) && now.length > 0.5 * longest;
        if (now.length < SMALL || has_stalled) && now.is_balanced(strongest, at_first) {
            let q = grown.moved(&q, &now.step)?;
            return Ok(Found { q, iterations: iteration });
        }
        lengths[iteration as usize % REMEMBERED] = now.length;
        let longest = lengths.into_iter().fold(0.0, f64::max);
        (q, correction) = stepped(&grown, &q, &now, longest)?;
        let size = grown.measure(&grown.acceleration(&q).0);
        if size < best.0 {
            best = (size, q.clone());
        }
    }
    Err(lost(rest, &best.1, made))
}

/// Where the longest of step, step/2, step/4 … leads after which the correction is no longer than `longest`,
/// and that correction.
fn stepped(
    rest: &Rest<'_>,
    q: &DVector<f64>,
    now: &Correction,
    longest: f64,
) -> Result<(DVector<f64>, Option<Correction>), Error> {
    let tried = |share: f64| {
        let next = rest.moved(q, &(&now.step * share))?;
        let correction = Correction::at(rest, &next, &rest.acceleration(&next).0, 0.0);
        Ok((next, correction))
    };
    let mut share = (LONGEST / now.length).min(1.0);
    for _ in 0..HALVINGS {
        match tried(share) {
            Ok((next, Some(then))) if then.length <= longest => return Ok((next, Some(then))),
            _ => share *= 0.5,
        }
    }
    tried(share)
}
