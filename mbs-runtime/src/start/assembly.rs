//! Positions on Φ = 0 and velocities on Φ̇ = 0, near a guess.
//!
//! `position_correction` and `velocity_correction` solve a system like that of a step, with the prescribed
//! coordinates held. So Newton's iteration moves the others least in the norm of the mass matrix. The
//! compiler has decided which coordinates can be held.

use crate::diagnosis::{Solution, check_solution};
use crate::equations::{At, Equations};
use crate::room::Room;
use crate::{Error, Real, vectors};

const NEWTON_ITERATIONS: usize = 50;
const STEP_HALVINGS: usize = 10;
/// An iteration that turns a body so many times as far as angles were, or by so many rad, has lost its way. Of
/// such an angle no digits are left that matter, and its rounding would pass for a small correction.
const FAR: f64 = 1e9;

/// Makes (q, v) the nearest state that satisfies Φ = 0 and Φ̇ = 0; see
/// [`start::consistent`](crate::start::consistent).
///
/// # Errors
/// [`Error::NotAssembled`], [`Error::Singular`]; q and v are left where the iteration was.
pub fn consistent<T: Real>(
    equations: &dyn Equations<T>,
    t: T,
    q: &mut [T],
    v: &mut [T],
    room: &mut Room<'_, T>,
) -> Result<(), Error> {
    assemble(equations, t, q, room)?;
    project_velocities(equations, t, q, v, room)
}

/// Moves q onto Φ(q, t) = 0; see [`start::assemble`](crate::start::assemble).
///
/// # Errors
/// As [`consistent`].
pub fn assemble<T: Real>(
    equations: &dyn Equations<T>,
    t: T,
    q: &mut [T],
    room: &mut Room<'_, T>,
) -> Result<(), Error> {
    let [delta, next, ..] = &mut room.coordinates;
    let [phi, residual, ..] = &mut room.constraints;
    newton(equations, t, q, Iterate { delta, next, phi, residual }, |q, residual, delta| {
        let growth = equations.position_correction(t, q, residual, delta);
        check_correction(equations, t, q, delta, growth)
    })
}

/// The vectors of Newton's iteration.
pub(super) struct Iterate<'a, T> {
    /// A correction of positions.
    pub delta: &'a mut [T],
    /// The positions after a part of the correction.
    pub next: &'a mut [T],
    /// Φ
    pub phi: &'a mut [T],
    /// −Φ
    pub residual: &'a mut [T],
}

/// Newton's iteration on q with a correction for each residual.
pub(super) fn newton<T: Real>(
    equations: &dyn Equations<T>,
    t: T,
    q: &mut [T],
    room: Iterate<'_, T>,
    mut correct: impl FnMut(&[T], &[T], &mut [T]) -> Result<(), Error>,
) -> Result<(), Error> {
    let Iterate { delta, next, phi, residual } = room;
    equations.phi(t, q, phi);
    let info = equations.info();
    let far = T::from_f64(FAR) * (T::from_f64(1.0) + largest_angle(equations, q));
    for _ in 0..NEWTON_ITERATIONS {
        if largest_angle(equations, q) > far {
            break;
        }
        vectors::copy(residual, phi);
        vectors::negate(residual);
        correct(q, residual, delta)?;
        let rounding =
            T::from_f64(4.0) * T::EPSILON * (T::from_f64(1.0) + vectors::largest(info.of_bodies(q)).1);
        if vectors::largest(delta).1 <= rounding {
            vectors::add(q, delta);
            converge_partials(equations, t, q, [delta, phi, residual], correct)?;
            return check_redundant(equations, t, q, phi);
        }
        damped(equations, t, q, delta, next, phi);
    }
    let (row, violation) = vectors::largest(phi);
    // Newton may circle at rounding level, where Φ itself is at rounding.
    if violation <= rounding(info.of_bodies(q)) && largest_angle(equations, q) <= far {
        converge_partials(equations, t, q, [delta, phi, residual], correct)?;
        return check_redundant(equations, t, q, phi);
    }
    Err(not_assembled(equations, t, row, violation))
}

/// The largest magnitude of an angle among the coordinates.
fn largest_angle<T: Real>(equations: &dyn Equations<T>, q: &[T]) -> T {
    let info = equations.info();
    let coordinates = info.coordinates.iter().zip(info.of_bodies(q));
    let angles = coordinates.filter(|(coordinate, _)| coordinate.dimension.length == 0);
    angles.fold(T::default(), |largest, (_, q)| largest.max(q.abs()))
}

/// The rounding of a constraint whose terms are of the order of the positions, of 1 at least: 64 ε (1 + maxⱼ |qⱼ|).
pub(super) fn rounding<T: Real>(q: &[T]) -> T {
    T::from_f64(64.0) * T::EPSILON * (T::from_f64(1.0) + vectors::largest(q).1)
}

/// Positions whose value has converged get the derivatives of the solution, an order with each
/// full correction: the map of Newton's iteration has no slope there, so that what the
/// derivatives of q were before does not matter. Nothing is done for scalars without derivatives.
fn converge_partials<T: Real>(
    equations: &dyn Equations<T>,
    t: T,
    q: &mut [T],
    [delta, phi, residual]: [&mut [T]; 3],
    mut correct: impl FnMut(&[T], &[T], &mut [T]) -> Result<(), Error>,
) -> Result<(), Error> {
    for _ in 0..T::ORDER {
        equations.phi(t, q, phi);
        vectors::copy(residual, phi);
        vectors::negate(residual);
        correct(q, residual, delta)?;
        vectors::zip_map(q, delta, |q, delta| q.with_partials_of(q + delta));
    }
    Ok(())
}

/// Redundant constraints take no part in the corrections: with parameters for
/// which they do not fit, they stay violated.
fn check_redundant<T: Real>(equations: &dyn Equations<T>, t: T, q: &[T], phi: &mut [T]) -> Result<(), Error> {
    let info = equations.info();
    let redundant = info.redundant;
    if redundant.is_empty() {
        return Ok(());
    }
    equations.phi(t, q, phi);
    // Half the digits: far above the rounding of any assembly.
    let limit = T::EPSILON.sqrt() * (T::from_f64(1.0) + vectors::largest(info.of_bodies(q)).1);
    for &row in redundant {
        let violation = vectors::magnitude(phi, row);
        if violation > limit {
            return Err(not_assembled(equations, t, row, violation));
        }
    }
    Ok(())
}

fn not_assembled<T: Real>(equations: &dyn Equations<T>, t: T, row: usize, violation: T) -> Error {
    let constraint = equations.info().constraint_name(row);
    Error::NotAssembled { t: t.to_f64(), constraint, violation: violation.to_f64() }
}

/// q becomes q + δ, or what the longest halved step that does not enlarge ‖Φ‖ leads to,
/// and Φ what it is there.
fn damped<T: Real>(
    equations: &dyn Equations<T>,
    t: T,
    q: &mut [T],
    delta: &[T],
    next: &mut [T],
    phi: &mut [T],
) {
    let violation = vectors::norm(phi);
    let mut length = T::from_f64(1.0);
    for halvings in 0..=STEP_HALVINGS {
        vectors::copy(next, q);
        vectors::add_scaled(next, length, delta);
        equations.phi(t, next, phi);
        if vectors::norm(phi) < violation || halvings == STEP_HALVINGS {
            break;
        }
        length = T::from_f64(0.5) * length;
    }
    vectors::copy(q, next);
}

/// Moves v onto Φ_q v = −Φ_t; see
/// [`start::project_velocities`](crate::start::project_velocities).
///
/// # Errors
/// [`Error::Singular`].
pub fn project_velocities<T: Real>(
    equations: &dyn Equations<T>,
    t: T,
    q: &[T],
    v: &mut [T],
    room: &mut Room<'_, T>,
) -> Result<(), Error> {
    let [delta, ..] = &mut room.coordinates;
    let [residual, ..] = &mut room.constraints;
    for _ in 0..2 {
        equations.phi_dot(At { t, q, v }, residual);
        vectors::negate(residual);
        let growth = equations.velocity_correction(t, q, residual, delta);
        check_correction(equations, t, q, delta, growth)?;
        vectors::add(v, delta);
    }
    Ok(())
}

fn check_correction<T: Real>(
    equations: &dyn Equations<T>,
    t: T,
    q: &[T],
    value: &[T],
    growth: T,
) -> Result<(), Error> {
    let info = equations.info();
    let solution = Solution { t, q, value, growth, info, pivots: info.start_pivots };
    check_solution(&solution, || equations.worst_start_pivot(t, q))
}
