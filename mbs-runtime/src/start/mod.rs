//! Consistent starts: positions on Φ = 0, velocities on Φ̇ = 0.

pub(crate) mod assembly;
pub(crate) mod consistency;
mod jacobian;
pub(crate) mod preparation;
pub(crate) mod projection;

use crate::equations::Arrays;
use crate::room::OnStack;
use crate::{Components, Error, Mechanism, State};

/// The state nearest to `guess` that satisfies Φ = 0 and Φ̇ = 0.
///
/// Coordinates and velocities that the declaration's `start` prescribes keep
/// their values; the others move least in the norm of the mass matrix.
/// Positions come from a damped Newton iteration, velocities from one linear
/// solve and one refinement of it.
///
/// # Example
/// ```
/// # use mbs_runtime::{Mechanism, mechanism, start};
/// # mechanism! {
/// #     pub Pendulum {
/// #         dof = 1;
/// #         param length = 1 [m];
/// #         gravity = (0, -9.81) [m/s^2];
/// #         body bob (x, y) { mass = 2 [kg]; }
/// #         constraint rod: x^2 + y^2 = length^2;
/// #         start { x = 0.6 [m]; guess y = 0.7 [m]; }
/// #     }
/// # }
/// let pendulum = Pendulum::declared();
/// let mut guess = pendulum.declared_start();
/// guess.q.x = 0.8;
/// let start = start::consistent(&pendulum, &guess)?;
/// // the declaration gives x, which keeps its value
/// assert!(start.q.x == 0.8 && (start.q.y - 0.6).abs() < 1e-14);
/// # Ok::<(), mbs_runtime::Error>(())
/// ```
///
/// # Errors
/// [`Error::NotAssembled`] if Φ = 0 is not reached, [`Error::Singular`] if the
/// constraints depend on each other on the way.
pub fn consistent<M: Mechanism>(
    mechanism: &M,
    guess: &State<M::Coordinates>,
) -> Result<State<M::Coordinates>, Error> {
    let Arrays { t, mut q, mut v } = Arrays::of(guess);
    let mut room = OnStack::<M>::new();
    assembly::consistent(mechanism, t, q.as_mut(), v.as_mut(), &mut room.room())?;
    Ok(Arrays { t, q, v }.state())
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
    let mut q = guess.into_array();
    assembly::assemble(mechanism, t, q.as_mut(), &mut OnStack::<M>::new().room())?;
    Ok(Components::from_array(q))
}

/// Velocities on Φ_q v = −Φ_t near `at.v`.
///
/// # Example
/// ```
/// # use mbs_runtime::{Mechanism, mechanism, start};
/// # mechanism! {
/// #     pub Pendulum {
/// #         dof = 1;
/// #         param length = 1 [m];
/// #         gravity = (0, -9.81) [m/s^2];
/// #         body bob (x, y) { mass = 2 [kg]; }
/// #         constraint rod: x^2 + y^2 = length^2;
/// #         start { x = length; guess y = 0; }
/// #     }
/// # }
/// let pendulum = Pendulum::declared();
/// let mut at = pendulum.declared_start();
/// (at.q.x, at.q.y, at.v.x, at.v.y) = (0.6, 0.8, 1.0, 1.0);
/// let v = start::project_velocities(&pendulum, &at)?;
/// // along the circle, (0.8, −0.6), it was 0.2 m/s
/// assert!((v.x - 0.16).abs() < 1e-14 && (v.y + 0.12).abs() < 1e-14);
/// # Ok::<(), mbs_runtime::Error>(())
/// ```
///
/// # Errors
/// [`Error::Singular`].
pub fn project_velocities<M: Mechanism>(
    mechanism: &M,
    at: &State<M::Coordinates>,
) -> Result<M::Coordinates, Error> {
    let Arrays { t, q, mut v } = Arrays::of(at);
    let mut room = OnStack::<M>::new();
    assembly::project_velocities(mechanism, t, q.as_ref(), v.as_mut(), &mut room.room())?;
    Ok(Components::from_array(v))
}

/// `Ok` if a state can be the start of a run with steps of `step` seconds just as it is.
///
/// The states of other runs are consistent in this sense, whose violations are of the
/// order of h² or h³ and which the feedback of the next steps removes; a coordinate that
/// was changed by hand is not.
///
/// Each constraint Φᵢ has the size Sᵢ = Σⱼ |∂Φᵢ/∂qⱼ| sⱼ, where sⱼ is 1 rad for an angle,
/// and for a length that of the mechanism: the largest coordinate or lever arm. Allowed is
///
/// ```text
/// |Φᵢ| ≤ 10⁻³ Sᵢ      |Φ̇ᵢ| ≤ 10⁻³ max(Σⱼ |∂Φᵢ/∂qⱼ vⱼ| + |∂Φᵢ/∂t|, Sᵢ maxⱼ |vⱼ|/sⱼ)
/// ```
///
/// and for |Φ̇ᵢ| at rest the rounding 1024 ε Sᵢ/h.
///
/// # Errors
/// [`Error::Inconsistent`], [`Error::NonFinite`].
pub fn check<M: Mechanism>(mechanism: &M, state: &State<M::Coordinates>, step: M::Real) -> Result<(), Error> {
    let mut room = OnStack::<M>::new();
    consistency::check(mechanism, Arrays::of(state).at(), step, &mut room.room())
}

/// The consistent state nearest to `guess` that keeps the coordinates called `positions`
/// and the velocities of those called `velocities`, to the bit.
///
/// The others move least in the norm of the mass matrix; massless coordinates count as
/// much as the lightest of the others. As many values can be kept as there are degrees of
/// freedom, if the constraints leave them free. [`consistent`] does
/// the same with the values that the declaration prescribes, in straight-line code.
///
/// Newton's iteration; each of its linear systems is solved by conjugate gradients, so
/// that a choice made at run time needs neither a matrix nor a heap. It takes about n²
/// evaluations of Φ̇ for n coordinates.
///
/// # Example
/// ```
/// # use mbs_runtime::{Error, Simulation, mechanism, start};
/// # mechanism! {
/// #     pub Pendulum {
/// #         dof = 1;
/// #         param length = 1 [m];
/// #         gravity = (0, -9.81) [m/s^2];
/// #         body bob (x, y) { mass = 2 [kg]; }
/// #         constraint rod: x^2 + y^2 = length^2;
/// #         start { x = length; guess y = 0; }
/// #     }
/// # }
/// let pendulum = Pendulum::declared();
/// let mut guess = Simulation::new(pendulum, 1e-3)?.state();
/// (guess.q.y, guess.v.x) = (-0.6, 1.2);
/// let start = start::project(&pendulum, &guess, &["y"], &["x"])?;
/// assert!((start.q.x - 0.8).abs() < 1e-15 && start.q.y == -0.6);
/// assert!((start.v.y - 1.6).abs() < 1e-15 && start.v.x == 1.2);
/// # Ok::<(), Error>(())
/// ```
///
/// # Errors
/// [`Error::NoCoordinate`], [`Error::NonFinite`]; [`Error::NotAssembled`] or
/// [`Error::Inconsistent`] if there is no such state with so much kept.
pub fn project<M: Mechanism>(
    mechanism: &M,
    guess: &State<M::Coordinates>,
    positions: &[&'static str],
    velocities: &[&'static str],
) -> Result<State<M::Coordinates>, Error> {
    let Arrays { t, mut q, mut v } = Arrays::of(guess);
    let keep = [positions, velocities];
    let mut room = OnStack::<M>::new();
    projection::project(mechanism, t, q.as_mut(), v.as_mut(), keep, &mut room.room())?;
    Ok(Arrays { t, q, v }.state())
}
