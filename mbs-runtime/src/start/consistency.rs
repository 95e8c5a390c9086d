//! Whether a state is consistent.

use super::jacobian::column;
use crate::heun::check_finite;
use crate::{Components, Error, Mechanism, Real, State, spare};

/// The share of the size of a mechanism by which a start that is given may violate its
/// constraints.
const SHARE: f64 = 1e-3;
/// Roundings of positions that a rate may amount to within a step.
const ROUNDINGS: f64 = 1024.0;

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
    check_finite(state)?;
    let sizes = Sizes::of(mechanism, state);
    let share = M::Real::from_f64(SHARE);
    let at_rest = M::Real::from_f64(ROUNDINGS) * M::Real::EPSILON / step;
    let allowed = sizes.rows.map(|size| share * size);
    let allowed_rates = sizes.rates.zip_map(sizes.rows, |rate, size| share * rate + at_rest * size);
    check_rows(state.t, mechanism.phi(state.t, &state.q), allowed, false)?;
    check_rows(state.t, mechanism.phi_dot(state), allowed_rates, true)
}

/// `Ok` if a state came out consistent, far within what [`check`] allows.
pub(super) fn check_projected<M: Mechanism>(
    mechanism: &M,
    state: &State<M::Coordinates>,
) -> Result<(), Error> {
    let sizes = Sizes::of(mechanism, state);
    let share = M::Real::EPSILON.sqrt();
    let allowed = |sizes: M::Constraints| sizes.map(|size| share * size);
    check_rows(state.t, mechanism.phi(state.t, &state.q), allowed(sizes.rows), false)?;
    check_rows(state.t, mechanism.phi_dot(state), allowed(sizes.rates), true)
}

/// `Ok` if a violation is small enough for its feedback to be small beside the motion.
///
/// Feedback changes velocities by the order of Φ̇, and positions by that of Φ, times the
/// pivot growth: that has to stay below a tenth of the velocities, and of the size.
pub(crate) fn check_feedback<M: Mechanism>(
    mechanism: &M,
    state: &State<M::Coordinates>,
    growth: M::Real,
    step: M::Real,
) -> Result<(), Error> {
    check_finite(state)?;
    let sizes = Sizes::of(mechanism, state);
    let share = M::Real::from_f64(0.1) / growth;
    let at_rest = M::Real::from_f64(ROUNDINGS) * M::Real::EPSILON / step;
    let allowed = sizes.rows.map(|size| share * size);
    let allowed_rates = sizes.motion.zip_map(sizes.rows, |motion, size| share * motion + at_rest * size);
    check_rows(state.t, mechanism.phi(state.t, &state.q), allowed, false)?;
    check_rows(state.t, mechanism.phi_dot(state), allowed_rates, true)
}

/// Refuses a start in which redundant constraints are met, but not by its accelerations:
/// with parameters for which they fit at this instant only.
///
/// Φ̈ is the difference of Φ̇ a sixteenth of a step ahead and behind.
pub(crate) fn check_redundant_accelerations<M: Mechanism>(
    mechanism: &M,
    state: &State<M::Coordinates>,
    inputs: &M::Inputs,
    step: M::Real,
) -> Result<(), Error> {
    let zero = M::Real::default();
    let number = M::Real::from_f64;
    let a = mechanism.constrained(state, inputs, &M::Constraints::splat(zero)).acceleration;
    if !a.is_finite() {
        // the first step says why
        return Ok(());
    }
    let apart = number(1.0 / 16.0) * step;
    let rates = |h: M::Real| {
        let speed = state.v.zip_map(a, |v, a| v + number(0.5) * h * a);
        let q = state.q.zip_map(speed, |q, v| q + h * v);
        mechanism.phi_dot(&State { t: state.t + h, q, v: state.v.zip_map(a, |v, a| v + h * a) })
    };
    let difference = rates(apart).zip_map(rates(-apart), |ahead, behind| ahead - behind);
    let sizes = Sizes::of(mechanism, state);
    let mut allowed = sizes.rates.zip_map(sizes.rows, |rate, size| {
        let turning = if size > zero { rate * rate / size } else { zero };
        number(SHARE) * turning + number(64.0) * M::Real::EPSILON * rate / apart
    });
    for (at, a) in a.into_array().as_ref().iter().enumerate() {
        let entries = column(mechanism, state, at);
        allowed = allowed.zip_map(entries, |sum, entry| sum + number(SHARE) * (entry * *a).abs());
    }
    let (found, allowed) = (difference.into_array(), allowed.into_array());
    for &row in M::INFO.redundant {
        let [Some(found), Some(allowed)] = [found.as_ref().get(row), allowed.as_ref().get(row)] else {
            continue;
        };
        let acceleration = found.abs() / (number(2.0) * apart);
        if acceleration > *allowed {
            let violation = number(0.5) * step * step * acceleration;
            return Err(spare::out_of_reach::<M>(state.t + step, row, violation.to_f64()));
        }
    }
    Ok(())
}

/// Refuses the row that exceeds what is allowed by the largest factor.
fn check_rows<R: Components>(t: R::Real, rows: R, allowed: R, is_rate: bool) -> Result<(), Error> {
    let mut worst: Option<(&'static str, R::Real, R::Real)> = None;
    let (rows, allowed) = (rows.into_array(), allowed.into_array());
    for ((&row, &allowed), &name) in rows.as_ref().iter().zip(allowed.as_ref()).zip(R::NAMES) {
        let violation = row.abs();
        let is_kept = violation <= allowed;
        if !is_kept && worst.is_none_or(|(_, most, limit)| violation * limit > most * allowed) {
            worst = Some((name, violation, allowed));
        }
    }
    match worst {
        None => Ok(()),
        Some((constraint, violation, allowed)) => Err(Error::Inconsistent {
            t: t.to_f64(),
            constraint,
            is_rate,
            violation: violation.to_f64(),
            allowed: allowed.to_f64(),
        }),
    }
}

/// How large constraints and their rates are.
struct Sizes<R> {
    /// Sᵢ
    rows: R,
    /// Σⱼ |∂Φᵢ/∂qⱼ vⱼ| + |∂Φᵢ/∂t|
    motion: R,
    /// max(Σⱼ |∂Φᵢ/∂qⱼ vⱼ| + |∂Φᵢ/∂t|, Sᵢ maxⱼ |vⱼ|/sⱼ)
    rates: R,
}

impl<R: Components> Sizes<R> {
    fn of<M: Mechanism<Constraints = R, Real = R::Real>>(
        mechanism: &M,
        state: &State<M::Coordinates>,
    ) -> Self {
        let zero = R::Real::default();
        let length = length(mechanism, state);
        let one = R::Real::from_f64(1.0);
        let mut rows = R::splat(zero);
        let mut motion =
            mechanism.phi_dot(&State { v: M::Coordinates::splat(zero), ..*state }).map(Real::abs);
        let mut fastest = zero;
        let velocities = state.v.into_array();
        for (at, (coordinate, &v)) in M::INFO.coordinates.iter().zip(velocities.as_ref()).enumerate() {
            let scale = if coordinate.dimension.length == 0 { one } else { length };
            let entries = column(mechanism, state, at).map(Real::abs);
            rows = rows.zip_map(entries, |sum, entry| sum + entry * scale);
            motion = motion.zip_map(entries, |sum, entry| sum + entry * v.abs());
            if scale > zero {
                fastest = fastest.max(v.abs() / scale);
            }
        }
        let rates = motion.zip_map(rows, |rate, size| rate.max(size * fastest));
        Self { rows, motion, rates }
    }
}

/// The largest coordinate that is a length, or lever arm of an angle.
pub(crate) fn length<M: Mechanism>(mechanism: &M, state: &State<M::Coordinates>) -> M::Real {
    let mut largest = M::Real::default();
    let positions = state.q.into_array();
    for (at, (coordinate, q)) in M::INFO.coordinates.iter().zip(positions.as_ref()).enumerate() {
        if coordinate.dimension.length != 0 {
            largest = largest.max(q.abs());
            continue;
        }
        let entries = column(mechanism, state, at).into_array();
        for (constraint, entry) in M::INFO.constraints.iter().zip(entries.as_ref()) {
            if constraint.dimension.length == 1 {
                largest = largest.max(entry.abs());
            }
        }
    }
    largest
}
