//! A guess made consistent by moving some of its coordinates.

use super::consistency::check_projected;
use super::jacobian::{along, column, unit};
use super::newton;
use crate::heun::check_finite;
use crate::{Components, Error, Mechanism, Real, State};

/// The consistent state nearest to `guess` that keeps the coordinates called `positions`
/// and the velocities of those called `velocities`, to the bit.
///
/// The others move least in the norm of the mass matrix; massless coordinates count as
/// much as the lightest of the others. As many values can be kept as there are degrees of
/// freedom, if the constraints leave them free. [`consistent`](super::consistent) does
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
/// let mut guess = *Simulation::new(pendulum, 1e-3)?.state();
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
    let [positions, velocities] = [free::<M>(positions)?, free::<M>(velocities)?];
    check_finite(guess)?;
    let mobility = mobility(mechanism, guess);
    let masked = |mask: M::Coordinates| mobility.zip_map(mask, |mobility, free| mobility * free);
    let (of_positions, of_velocities) = (masked(positions), masked(velocities));
    let mut state = *guess;
    state.q = newton(mechanism, guess.t, &guess.q, |q, residual| {
        Ok(least(mechanism, &State { q: *q, ..*guess }, of_positions, residual))
    })?;
    // two refinements, because one solution is as good as its rounding
    for _ in 0..3 {
        let residual = mechanism.phi_dot(&state).map(|x| -x);
        let correction = least(mechanism, &state, of_velocities, &residual);
        state.v = state.v.zip_map(correction, |v, d| v + d);
    }
    check_projected(mechanism, &state).map(|()| state)
}

/// 0 for coordinates to keep, 1 for the others.
fn free<M: Mechanism>(keep: &[&'static str]) -> Result<M::Coordinates, Error> {
    let mut free = M::Coordinates::splat(M::Real::from_f64(1.0));
    for &name in keep {
        free = free.with(name, M::Real::default()).ok_or(Error::NoCoordinate { name })?;
    }
    Ok(free)
}

/// 1/√mⱼ, with mⱼ = 2T for q̇ⱼ = 1.
fn mobility<M: Mechanism>(mechanism: &M, at: &State<M::Coordinates>) -> M::Coordinates {
    let (zero, one) = (M::Real::default(), M::Real::from_f64(1.0));
    let mut array = M::Coordinates::splat(zero).into_array();
    for (j, mobility) in array.as_mut().iter_mut().enumerate() {
        let mass = M::Real::from_f64(2.0) * mechanism.kinetic_energy(&State { v: unit(j), ..*at });
        *mobility = if mass > zero { one / mass.sqrt() } else { zero };
    }
    let mobility: M::Coordinates = Components::from_array(array);
    let lightest = mobility.largest().1;
    let of_massless = if lightest > zero { lightest } else { one };
    mobility.map(|mobility| if mobility > zero { mobility } else { of_massless })
}

/// The Δ of Φ_q Δ = `residual` for which Σ (Δⱼ/wⱼ)² is least, with the mobilities w; 0
/// where they are 0. Conjugate gradients of ‖residual − Φ_q W y‖², Δ = W y.
fn least<M: Mechanism>(
    mechanism: &M,
    at: &State<M::Coordinates>,
    mobility: M::Coordinates,
    residual: &M::Constraints,
) -> M::Coordinates {
    let forward = |y: M::Coordinates| along(mechanism, at, y.zip_map(mobility, |y, w| y * w));
    let backward = |rows: M::Constraints| {
        let mut array = mobility.into_array();
        for (j, w) in array.as_mut().iter_mut().enumerate() {
            if *w != M::Real::default() {
                *w = *w * dot(column(mechanism, at, j), rows);
            }
        }
        <M::Coordinates as Components>::from_array(array)
    };
    let mut y = M::Coordinates::splat(M::Real::default());
    let mut rest = *residual;
    let mut slope = backward(rest);
    let mut direction = slope;
    let small = M::Real::EPSILON * residual.norm();
    for _ in 0..2 * M::Coordinates::NAMES.len() {
        let steepness = dot(slope, slope);
        let image = forward(direction);
        let length = steepness / dot(image, image);
        if !length.is_finite() {
            break;
        }
        y = y.zip_map(direction, |y, d| y + length * d);
        rest = rest.zip_map(image, |rest, d| rest - length * d);
        if rest.norm() <= small {
            break;
        }
        slope = backward(rest);
        let turn = dot(slope, slope) / steepness;
        direction = slope.zip_map(direction, |slope, d| slope + turn * d);
    }
    y.zip_map(mobility, |y, w| y * w)
}

fn dot<C: Components>(a: C, b: C) -> C::Real {
    let (a, b) = (a.into_array(), b.into_array());
    a.as_ref().iter().zip(b.as_ref()).fold(C::Real::default(), |sum, (&a, &b)| sum + a * b)
}
