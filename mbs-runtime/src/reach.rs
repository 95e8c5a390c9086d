//! Whether constraints can be met at all.

use crate::equations::{At, Equations};
use crate::room::Room;
use crate::{Error, Real, vectors};

const NEWTON_ITERATIONS: usize = 30;

/// `Ok` if Φ(q, t) = 0 has a solution near `q`, else [`Error::OutOfReach`]; h is the step
/// in s.
///
/// Newton's iteration, undamped, that moves all coordinates as little as it can in the
/// norm of the mass matrix. It has to come to rest at rounding, which a pivot growth
/// magnifies. Beyond a dead end it cannot: there the violation is s² + c along the
/// direction s in which the constraints have become dependent, so that each correction of
/// s is (s² + c)/2s, at least √c.
///
/// The corrections are the differences of accelerations with and without feedback, in a
/// state at rest, so that no velocity adds to their rounding.
///
/// # Example
/// A drive that pulls an arm of 1 m out to 2t:
/// ```
/// use mbs_runtime::equations::{Room, reach};
/// use mbs_runtime::{Error, Mechanism, mechanism};
/// # mechanism! {
/// #     pub Arm {
/// #         dof = 0;
/// #         body tip (x, y) { mass = 2 [kg]; }
/// #         constraint rod: x^2 + y^2 = 1 [m^2];
/// #         drive pull: x = 2 [m/s]*t;
/// #         start { guess y = -1 [m]; }
/// #     }
/// # }
/// let mut numbers = vec![0.0; Room::<f64>::len(Arm::<f64>::INFO, 0)];
/// let mut room = Room::within(&mut numbers, Arm::<f64>::INFO);
/// let mut at = |t| reach(&Arm::declared(), t, &[0.8, -0.6], &[], 1e-3, &mut room);
/// assert!(at(0.45).is_ok());
/// assert!(matches!(at(0.55), Err(Error::OutOfReach { .. })));
/// ```
///
/// # Errors
/// [`Error::OutOfReach`].
pub fn reach<T: Real>(
    equations: &dyn Equations<T>,
    t: T,
    q: &[T],
    inputs: &[T],
    h: T,
    room: &mut Room<'_, T>,
) -> Result<(), Error> {
    let [position, still, moved, unmoved, ..] = &mut room.coordinates;
    let [phi, best, feedback, no_feedback, ..] = &mut room.constraints;
    let number = T::from_f64;
    vectors::copy(position, q);
    vectors::fill(still, T::default());
    vectors::fill(no_feedback, T::default());
    equations.phi(t, position, best);
    for iteration in 0..NEWTON_ITERATIONS {
        equations.phi(t, position, phi);
        if vectors::norm(phi) < vectors::norm(best) {
            vectors::copy(best, phi);
        }
        vectors::copy(feedback, phi);
        vectors::map(feedback, |x| -(x / (h * h)));
        let at = At { t, q: position, v: still };
        let growth = equations.accelerations(at, inputs, feedback, moved);
        equations.accelerations(at, inputs, no_feedback, unmoved);
        vectors::zip_map(moved, unmoved, |a, b| h * h * (a - b));
        let correction: &[T] = moved;
        let size = vectors::largest(equations.info().of_bodies(correction)).1;
        let roundings = number(64.0) + growth;
        let is_at_rest = size
            <= roundings
                * T::EPSILON
                * (number(1.0) + vectors::largest(equations.info().of_bodies(position)).1);
        // without a first correction it is a drive that ends, and not a position
        if is_at_rest || (iteration == 0 && !size.is_finite()) {
            return Ok(());
        }
        if !size.is_finite() {
            break;
        }
        vectors::add(position, correction);
    }
    let (row, violation) = vectors::largest(best);
    Err(out_of_reach(equations, t, row, violation))
}

/// The error for a constraint that cannot be met at a time.
pub(crate) fn out_of_reach<T: Real>(equations: &dyn Equations<T>, t: T, row: usize, violation: T) -> Error {
    let constraint = equations.info().constraint_name(row);
    Error::OutOfReach { t: t.to_f64(), constraint, violation: violation.to_f64() }
}
