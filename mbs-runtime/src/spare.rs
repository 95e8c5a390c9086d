//! Redundant constraints take no part in a step: they are watched, because with parameters
//! for which they fit at one instant only they would be violated in silence.

use crate::{Components, Error, Mechanism, Real, State};

/// The share of the size of a mechanism by which a redundant constraint may be violated:
/// as much as in a start that is given.
const SHARE: f64 = 1e-3;

/// The distance of the redundant constraint that is violated most from what is allowed, for
/// a mechanism of this size; negative or NaN if that is exceeded. Costs nothing where no
/// constraint is redundant.
#[inline(always)]
pub(crate) fn margin<M: Mechanism>(mechanism: &M, at: &State<M::Coordinates>, length: M::Real) -> M::Real {
    let mut margin = length;
    if M::INFO.redundant.is_empty() {
        return margin;
    }
    let phi = mechanism.phi(at.t, &at.q).into_array();
    for &row in M::INFO.redundant {
        if let Some(phi) = phi.as_ref().get(row) {
            margin = margin.min(allowed::<M>(row, length) - phi.abs());
        }
    }
    margin
}

/// What is allowed, in the unit of the constraint.
#[inline(always)]
fn allowed<M: Mechanism>(row: usize, length: M::Real) -> M::Real {
    let exponent = M::INFO.constraints.get(row).map_or(0, |constraint| constraint.dimension.length);
    (0..exponent).fold(M::Real::from_f64(SHARE), |size, _| size * length)
}

/// The error that names the redundant constraint which is violated most, if one is.
pub(crate) fn check<M: Mechanism>(
    mechanism: &M,
    at: &State<M::Coordinates>,
    length: M::Real,
) -> Result<(), Error> {
    let phi = mechanism.phi(at.t, &at.q).into_array();
    let mut worst: Option<(usize, M::Real)> = None;
    for &row in M::INFO.redundant {
        let violation = phi.as_ref().get(row).map_or(M::Real::default(), |phi| phi.abs());
        let excess = violation / allowed::<M>(row, length);
        let is_kept = excess <= M::Real::from_f64(1.0);
        if !is_kept && worst.is_none_or(|(_, most)| excess > most) {
            worst = Some((row, excess));
        }
    }
    let Some((row, _)) = worst else { return Ok(()) };
    Err(out_of_reach::<M>(at.t, row, phi.as_ref().get(row).map_or(f64::NAN, |phi| phi.abs().to_f64())))
}

/// What cannot be met at a time.
pub(crate) fn out_of_reach<M: Mechanism>(t: M::Real, row: usize, violation: f64) -> Error {
    let constraint = M::Constraints::NAMES.get(row).copied().unwrap_or("");
    Error::OutOfReach { t: t.to_f64(), constraint, violation }
}
