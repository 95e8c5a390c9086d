//! Whether a state is consistent.
//!
//! A state that a program gives is kept to the bit and checked here. `projection` makes another one
//! consistent.

use super::assembly::rounding;
use super::jacobian::Jacobian;
use crate::diagnosis::check_finite;
use crate::equations::{At, Equations};
use crate::reach::out_of_reach;
use crate::room::Room;
use crate::{Error, Info, Real, vectors};

/// The share of the size of a mechanism by which a start that is given may violate its
/// constraints.
const SHARE: f64 = 1e-3;
/// The share of its size by which something moves while accelerations are looked at.
const LONGEST: f64 = 0.1;
/// Roundings of positions that a rate may amount to within a step.
const ROUNDINGS: f64 = 1024.0;

/// `Ok` if a state can be the start of a run with steps of `step` seconds just as it is;
/// see [`start::check`](crate::start::check).
///
/// # Errors
/// [`Error::Inconsistent`], [`Error::NonFinite`].
pub fn check<T: Real>(
    equations: &dyn Equations<T>,
    at: At<'_, T>,
    step: T,
    room: &mut Room<'_, T>,
) -> Result<(), Error> {
    check_finite(equations.info(), at)?;
    let share = T::from_f64(SHARE);
    let at_rest = T::from_f64(ROUNDINGS) * T::EPSILON / step;
    check_sizes(equations, at, room, |size, _, rate| (share * size, share * rate + at_rest * size))
}

/// `Ok` if a violation is small enough for its feedback to be small beside the motion.
///
/// Feedback changes velocities by the order of Φ̇, and positions by that of Φ, times the
/// pivot growth: that has to stay below a tenth of the velocities, and of the size.
pub(crate) fn check_feedback<T: Real>(
    equations: &dyn Equations<T>,
    at: At<'_, T>,
    growth: T,
    step: T,
    room: &mut Room<'_, T>,
) -> Result<(), Error> {
    check_finite(equations.info(), at)?;
    let share = T::from_f64(0.1) / growth;
    let at_rest = T::from_f64(ROUNDINGS) * T::EPSILON / step;
    check_sizes(equations, at, room, |size, motion, _| (share * size, share * motion + at_rest * size))
}

/// `Ok` if a state came out consistent, far within what [`check`] allows.
pub(super) fn check_projected<T: Real>(
    equations: &dyn Equations<T>,
    at: At<'_, T>,
    room: &mut Room<'_, T>,
) -> Result<(), Error> {
    let share = T::EPSILON.sqrt();
    check_sizes(equations, at, room, |size, _, rate| (share * size, share * rate))
}

/// Refuses a state with more violation of a constraint or of its rate than `allowed` by
/// the size Sᵢ, by Σⱼ |∂Φᵢ/∂qⱼ vⱼ| + |∂Φᵢ/∂t|, and by the larger of that and Sᵢ maxⱼ |vⱼ|/sⱼ.
/// The rounding with which an assembly ends is never refused: a constraint such as x + a = b has no
/// size where a is b and x is 0.
fn check_sizes<T: Real>(
    equations: &dyn Equations<T>,
    at: At<'_, T>,
    room: &mut Room<'_, T>,
    allowed: impl Fn(T, T, T) -> (T, T),
) -> Result<(), Error> {
    let [direction, ..] = &mut room.coordinates;
    let [rows, rates, phi_t, found, ..] = &mut room.constraints;
    let mut jacobian = Jacobian::new(equations, at.t, at.q, direction, phi_t);
    let fastest = measure(&mut jacobian, at.v, rows, rates, found);
    for (row, rate) in rows.iter_mut().zip(rates.iter_mut()) {
        (*row, *rate) = allowed(*row, *rate, rate.max(*row * fastest));
    }
    let [of_positions, of_rates] = [at.q, at.v].map(|vector| rounding(equations.info().of_bodies(vector)));
    vectors::map(rows, |row| if row > of_positions { row } else { of_positions });
    vectors::map(rates, |rate| if rate > of_rates { rate } else { of_rates });
    equations.phi(at.t, at.q, found);
    check_rows(equations.info(), at.t, found, rows, false)?;
    equations.phi_dot(at, found);
    check_rows(equations.info(), at.t, found, rates, true)
}

/// Refuses the row that exceeds what is allowed by the largest factor.
fn check_rows<T: Real>(info: &Info, t: T, found: &[T], allowed: &[T], is_rate: bool) -> Result<(), Error> {
    let mut worst: Option<(usize, T, T)> = None;
    for (row, (found, &allowed)) in found.iter().zip(allowed).enumerate() {
        let violation = found.abs();
        let is_kept = violation <= allowed;
        if !is_kept && worst.is_none_or(|(_, most, limit)| violation * limit > most * allowed) {
            worst = Some((row, violation, allowed));
        }
    }
    match worst {
        None => Ok(()),
        Some((row, violation, allowed)) => Err(Error::Inconsistent {
            t: t.to_f64(),
            constraint: info.constraint_name(row),
            is_rate,
            violation: violation.to_f64(),
            allowed: allowed.to_f64(),
        }),
    }
}

/// Refuses a start in which redundant constraints are met, but not by its accelerations:
/// with parameters for which they fit at this instant only.
///
/// Φ̈ is the difference of Φ̇ a sixteenth of a step ahead and behind, or of the time in which something moves by a tenth of its
/// size, where that is less. A violation that Φ̈ causes over a
/// step counts as none if it is no more than the rounding of positions: a structure at rest has
/// accelerations that are rounding.
pub(super) fn check_redundant_accelerations<T: Real>(
    equations: &dyn Equations<T>,
    at: At<'_, T>,
    inputs: &[T],
    step: T,
    room: &mut Room<'_, T>,
) -> Result<(), Error> {
    let [acceleration, q, v, direction, ..] = &mut room.coordinates;
    let [difference, rows, rates, phi_t, entries, ..] = &mut room.constraints;
    let (zero, number) = (T::default(), T::from_f64);
    let no_feedback = &mut *entries;
    vectors::fill(no_feedback, zero);
    equations.accelerations(at, inputs, no_feedback, acceleration);
    if !vectors::is_finite(acceleration) {
        // the first step says why
        return Ok(());
    }
    let mut jacobian = Jacobian::new(equations, at.t, at.q, direction, phi_t);
    let fastest = measure(&mut jacobian, at.v, rows, rates, entries);
    // what moves far within a step is looked at over less
    let step = if step * fastest > number(LONGEST) { number(LONGEST) / fastest } else { step };
    let apart = number(1.0 / 16.0) * step;
    let mut rates_after = |h: T, phi_dot: &mut [T]| {
        vectors::copy(v, at.v);
        vectors::add_scaled(v, number(0.5) * h, acceleration);
        vectors::copy(q, at.q);
        vectors::add_scaled(q, h, v);
        vectors::copy(v, at.v);
        vectors::add_scaled(v, h, acceleration);
        equations.phi_dot(At { t: at.t + h, q, v }, phi_dot);
    };
    rates_after(apart, difference);
    rates_after(-apart, entries);
    vectors::zip_map(difference, entries, |ahead, behind| ahead - behind);

    vectors::zip_map(rates, rows, |motion, size| {
        let rate = motion.max(size * fastest);
        let turning = if size > zero { rate * rate / size } else { zero };
        let rounding = number(64.0) * T::EPSILON * (rate / apart + number(2.0) * size / (step * step));
        number(SHARE) * turning + rounding
    });
    let allowed = rates;
    for (j, &a) in acceleration.iter().enumerate() {
        jacobian.column(j, entries);
        vectors::zip_map(allowed, entries, |sum, entry| sum + number(SHARE) * (entry * a).abs());
    }
    for &row in equations.info().redundant {
        let acceleration = vectors::magnitude(difference, row) / (number(2.0) * apart);
        if acceleration > vectors::magnitude(allowed, row) {
            let violation = number(0.5) * step * step * acceleration;
            return Err(out_of_reach(equations, at.t + step, row, violation));
        }
    }
    Ok(())
}

/// How large constraints and their rates are: `rows` become Sᵢ, and `rates` become
/// Σⱼ |∂Φᵢ/∂qⱼ vⱼ| + |∂Φᵢ/∂t|. Gives maxⱼ |vⱼ|/sⱼ.
fn measure<T: Real>(
    jacobian: &mut Jacobian<'_, T>,
    v: &[T],
    rows: &mut [T],
    rates: &mut [T],
    entries: &mut [T],
) -> T {
    let zero = T::default();
    let (info, length) = (jacobian.info(), length(jacobian, entries));
    vectors::fill(rows, zero);
    vectors::copy(rates, jacobian.phi_t);
    vectors::map(rates, Real::abs);
    let mut fastest = zero;
    for (j, (coordinate, v)) in jacobian.info().coordinates.iter().zip(info.of_bodies(v)).enumerate() {
        let scale = if coordinate.dimension.length == 0 { T::from_f64(1.0) } else { length };
        jacobian.column(j, entries);
        vectors::zip_map(rows, entries, |sum, entry| sum + entry.abs() * scale);
        vectors::zip_map(rates, entries, |sum, entry| sum + entry.abs() * v.abs());
        if scale > zero {
            fastest = fastest.max(v.abs() / scale);
        }
    }
    fastest
}

/// The largest coordinate that is a length, or lever arm of an angle, in m.
pub(super) fn length<T: Real>(jacobian: &mut Jacobian<'_, T>, entries: &mut [T]) -> T {
    let mut largest = T::default();
    let (info, q) = (jacobian.info(), jacobian.q);
    for (j, (coordinate, q)) in info.coordinates.iter().zip(info.of_bodies(q)).enumerate() {
        if coordinate.dimension.length != 0 {
            largest = largest.max(q.abs());
            continue;
        }
        jacobian.column(j, entries);
        for (constraint, entry) in info.constraints.iter().zip(entries.iter()) {
            if constraint.dimension.length == 1 {
                largest = largest.max(entry.abs());
            }
        }
    }
    largest
}
