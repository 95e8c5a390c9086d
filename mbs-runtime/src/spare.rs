//! Redundant constraints take no part in a step: they are watched, because with parameters
//! for which they fit at one instant only they would be violated in silence.
//!
//! A start is checked by Φ̈, and every step by Φ.

use crate::equations::Equations;
use crate::reach::out_of_reach;
use crate::{Components, Error, Info, Mechanism, Real, State, vectors};

/// The share of the size of a mechanism by which a redundant constraint may be violated:
/// as much as in a start that is given.
const SHARE: f64 = 1e-3;
/// Roundings of 1 m, or 1 rad, that are no violation: all there is where a mechanism stands at the origin.
const ROUNDINGS: f64 = 64.0;

/// The distance of the redundant constraint that is violated most from what is allowed, for
/// a mechanism of this size; negative or NaN if that is exceeded. Costs nothing where no
/// constraint is redundant.
#[inline(always)]
pub(crate) fn margin<M: Mechanism>(mechanism: &M, at: &State<M::States>, length: M::Real) -> M::Real {
    if const { M::INFO.redundant.is_empty() } {
        return length;
    }
    let all = mechanism.complete(at);
    least(M::INFO, mechanism.phi(all.t, &all.q).into_array().as_ref(), length)
}

/// The same on slices.
pub(crate) fn margin_on<T: Real>(equations: &dyn Equations<T>, t: T, q: &[T], length: T, phi: &mut [T]) -> T {
    let info = equations.info();
    if info.redundant.is_empty() {
        return length;
    }
    equations.phi(t, q, phi);
    least(info, phi, length)
}

/// The least of what is left to the redundant rows, from Φ.
#[inline(always)]
fn least<T: Real>(info: &Info, phi: &[T], length: T) -> T {
    let mut margin = length;
    for &row in info.redundant {
        if let Some(phi) = phi.get(row) {
            margin = margin.min(allowed(info, row, length) - phi.abs());
        }
    }
    margin
}

/// The largest allowed violation of a redundant constraint, in its own unit.
#[inline(always)]
fn allowed<T: Real>(info: &Info, row: usize, length: T) -> T {
    let exponent = info.constraints.get(row).map_or(0, |constraint| constraint.dimension.length);
    let share = (0..exponent).fold(T::from_f64(SHARE), |size, _| size * length);
    share.max(T::from_f64(ROUNDINGS) * T::EPSILON)
}

/// The error that names the redundant constraint which is violated most, if one is.
pub(crate) fn check<T: Real>(
    equations: &dyn Equations<T>,
    t: T,
    q: &[T],
    length: T,
    phi: &mut [T],
) -> Result<(), Error> {
    let info = equations.info();
    equations.phi(t, q, phi);
    let mut worst: Option<(usize, T)> = None;
    for &row in info.redundant {
        let (violation, allowed) = (vectors::magnitude(phi, row), allowed(info, row, length));
        let excess = violation / allowed;
        let is_kept = excess <= T::from_f64(1.0);
        if !is_kept && worst.is_none_or(|(_, most)| excess > most) {
            worst = Some((row, excess));
        }
    }
    match worst {
        None => Ok(()),
        Some((row, _)) => Err(out_of_reach(equations, t, row, vectors::magnitude(phi, row))),
    }
}
