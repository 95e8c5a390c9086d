//! Consistent starts: positions on Φ = 0, velocities on Φ̇ = 0.

mod consistency;
mod jacobian;
mod projection;

pub use consistency::check;
pub(crate) use consistency::{check_feedback, check_redundant_accelerations, length};
pub use projection::project;

use crate::heun::{Solution, check_solution};
use crate::{Accelerations, Components, Error, Mechanism, Real, State};

const NEWTON_ITERATIONS: usize = 50;
const STEP_HALVINGS: usize = 10;

/// The state nearest to `guess` that satisfies Φ = 0 and Φ̇ = 0.
///
/// Coordinates and velocities that the declaration's `start` prescribes keep
/// their values; the others move least in the norm of the mass matrix.
/// Positions come from a damped Newton iteration, velocities from one linear
/// solve and one refinement of it.
///
/// # Errors
/// [`Error::NotAssembled`] if Φ = 0 is not reached, [`Error::Singular`] if the
/// constraints depend on each other on the way.
pub fn consistent<M: Mechanism>(
    mechanism: &M,
    guess: &State<M::Coordinates>,
) -> Result<State<M::Coordinates>, Error> {
    let q = assemble(mechanism, guess.t, &guess.q)?;
    let v = project_velocities(mechanism, &State { q, ..*guess })?;
    Ok(State { t: guess.t, q, v })
}

/// Positions on Φ(q, t) = 0 near `guess`.
///
/// Newton's iteration; a step that would enlarge ‖Φ‖ is halved. It ends when a
/// full correction is below rounding, 4ε (1 + ‖q‖∞).
///
/// # Errors
/// As [`consistent`].
pub fn assemble<M: Mechanism>(
    mechanism: &M,
    t: M::Real,
    guess: &M::Coordinates,
) -> Result<M::Coordinates, Error> {
    newton(mechanism, t, guess, |q, residual| {
        let correction = mechanism.position_correction(t, q, residual);
        check_correction(mechanism, t, q, &correction).map(|()| correction.acceleration)
    })
}

/// Newton's iteration with a correction of positions for each residual.
fn newton<M: Mechanism>(
    mechanism: &M,
    t: M::Real,
    guess: &M::Coordinates,
    correct: impl Fn(&M::Coordinates, &M::Constraints) -> Result<M::Coordinates, Error>,
) -> Result<M::Coordinates, Error> {
    let mut q = *guess;
    let mut phi = mechanism.phi(t, &q);
    for _ in 0..NEWTON_ITERATIONS {
        let delta = correct(&q, &phi.map(|x| -x))?;
        let rounding = M::Real::from_f64(4.0) * M::Real::EPSILON * (M::Real::from_f64(1.0) + q.largest().1);
        if delta.largest().1 <= rounding {
            let q = q.zip_map(delta, |q, d| q + d);
            check_redundant(mechanism, t, &q)?;
            return Ok(q);
        }
        let (next, next_phi) = damped(mechanism, t, &q, &delta, phi.norm());
        (q, phi) = (next, next_phi);
    }
    let (row, violation) = phi.largest();
    let constraint = M::Constraints::NAMES.get(row).copied().unwrap_or("");
    // Newton may circle at rounding level, where Φ itself is at rounding.
    let rounding = M::Real::from_f64(64.0) * M::Real::EPSILON * (M::Real::from_f64(1.0) + q.largest().1);
    if violation <= rounding {
        check_redundant(mechanism, t, &q)?;
        return Ok(q);
    }
    Err(Error::NotAssembled { t: t.to_f64(), constraint, violation: violation.to_f64() })
}

/// Redundant constraints take no part in the corrections: with parameters for
/// which they do not fit, they stay violated.
fn check_redundant<M: Mechanism>(mechanism: &M, t: M::Real, q: &M::Coordinates) -> Result<(), Error> {
    if M::INFO.redundant.is_empty() {
        return Ok(());
    }
    let phi = mechanism.phi(t, q).into_array();
    // Half the digits: far above the rounding of any assembly.
    let limit = M::Real::EPSILON.sqrt() * (M::Real::from_f64(1.0) + q.largest().1);
    for &row in M::INFO.redundant {
        let violation = phi.as_ref().get(row).map_or(M::Real::default(), |x| x.abs());
        if violation > limit {
            let constraint = M::Constraints::NAMES.get(row).copied().unwrap_or("");
            return Err(Error::NotAssembled { t: t.to_f64(), constraint, violation: violation.to_f64() });
        }
    }
    Ok(())
}

/// q + δ, or the longest halved step that does not enlarge ‖Φ‖.
fn damped<M: Mechanism>(
    mechanism: &M,
    t: M::Real,
    q: &M::Coordinates,
    delta: &M::Coordinates,
    violation: M::Real,
) -> (M::Coordinates, M::Constraints) {
    let mut length = M::Real::from_f64(1.0);
    let mut halvings = 0;
    loop {
        let next = q.zip_map(*delta, |q, d| q + length * d);
        let phi = mechanism.phi(t, &next);
        if phi.norm() < violation || halvings == STEP_HALVINGS {
            return (next, phi);
        }
        length = M::Real::from_f64(0.5) * length;
        halvings += 1;
    }
}

/// Velocities on Φ_q v = −Φ_t near `at.v`.
///
/// # Errors
/// [`Error::Singular`].
pub fn project_velocities<M: Mechanism>(
    mechanism: &M,
    at: &State<M::Coordinates>,
) -> Result<M::Coordinates, Error> {
    let mut state = *at;
    for _ in 0..2 {
        let residual = mechanism.phi_dot(&state).map(|x| -x);
        let correction = mechanism.velocity_correction(state.t, &state.q, &residual);
        check_correction(mechanism, state.t, &state.q, &correction)?;
        state.v = state.v.zip_map(correction.acceleration, |v, d| v + d);
    }
    Ok(state.v)
}

fn check_correction<M: Mechanism>(
    mechanism: &M,
    t: M::Real,
    q: &M::Coordinates,
    correction: &Accelerations<M::Coordinates>,
) -> Result<(), Error> {
    let Accelerations { acceleration, growth } = correction;
    let pivots = M::INFO.start_pivots;
    let solution = Solution { t, q, value: acceleration, growth: *growth, pivots };
    check_solution(&solution, || mechanism.worst_start_pivot(t, q))
}
