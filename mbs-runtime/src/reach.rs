//! Whether constraints can be met at all.

use crate::{Components, Error, Mechanism, Real, State};

const NEWTON_ITERATIONS: usize = 30;

/// `Ok` if Φ(q, t) = 0 has a solution near `at.q`, else [`Error::OutOfReach`].
///
/// Newton's iteration, undamped, that moves all coordinates as little as it can in the
/// norm of the mass matrix. It has to come to rest at rounding, which a pivot growth
/// magnifies. Beyond a dead end it cannot: there the violation is s² + c along the
/// direction s in which the constraints have become dependent, so that each correction of
/// s is (s² + c)/2s, at least √c.
///
/// The corrections are the differences of accelerations with and without feedback, in a
/// state at rest, so that no velocity adds to their rounding.
pub(crate) fn reach<M: Mechanism>(
    mechanism: &M,
    at: &State<M::Coordinates>,
    inputs: &M::Inputs,
    h: M::Real,
) -> Result<(), Error> {
    let zero = M::Real::default();
    let no_feedback = M::Constraints::splat(zero);
    let mut state = State { v: M::Coordinates::splat(zero), ..*at };
    let mut best = mechanism.phi(state.t, &state.q);
    let number = M::Real::from_f64;
    for iteration in 0..NEWTON_ITERATIONS {
        let phi = mechanism.phi(state.t, &state.q);
        if phi.norm() < best.norm() {
            best = phi;
        }
        let feedback = phi.map(|x| -(x / (h * h)));
        let moved = mechanism.constrained(&state, inputs, &feedback);
        let unmoved = mechanism.constrained(&state, inputs, &no_feedback).acceleration;
        let correction = moved.acceleration.zip_map(unmoved, |a, b| h * h * (a - b));
        let size = correction.largest().1;
        let roundings = number(64.0) + moved.growth;
        let is_at_rest = size <= roundings * M::Real::EPSILON * (number(1.0) + state.q.largest().1);
        // without a first correction it is a drive that ends, and not a position
        if is_at_rest || (iteration == 0 && !size.is_finite()) {
            return Ok(());
        }
        if !size.is_finite() {
            break;
        }
        state.q = state.q.zip_map(correction, |q, d| q + d);
    }
    let (row, violation) = best.largest();
    let constraint = M::Constraints::NAMES.get(row).copied().unwrap_or("");
    Err(Error::OutOfReach { t: at.t.to_f64(), constraint, violation: violation.to_f64() })
}
