//! Heun's method on the first-order form (q, v)˙ = (v, q̈).

use crate::mechanism::growth_limit;
use crate::{Components, Error, Feedback, Gains, Mechanism, Pivot, Real, State};

/// One step of Heun's method (Jiang 2025, Eq. 9):
///
/// ```text
/// predict   q* = q + h v,            v* = v + h q̈(t, q, v)
/// correct   q⁺ = q + h/2 (v + v*),   v⁺ = v + h/2 (q̈(t, q, v) + q̈(t + h, q*, v*))
/// ```
///
/// Second order: the local error is O(h³), the global error O(h²).
///
/// `t_next` is t + h, passed in so that time is k·h and not a sum of k roundings.
///
/// # Errors
/// [`Error::Singular`] and [`Error::NonFinite`]; the given state is untouched.
#[inline]
pub(crate) fn heun_step<M: Mechanism, F: Feedback>(
    mechanism: &M,
    at: &State<M::Coordinates>,
    inputs: &M::Inputs,
    gains: &Gains<M::Real>,
    h: M::Real,
    t_next: M::Real,
) -> Result<State<M::Coordinates>, Error> {
    let half_h = M::Real::from_f64(0.5) * h;
    let here = mechanism.stabilized(at, inputs, gains);

    let predicted = State {
        t: t_next,
        q: at.q.zip_map(at.v, |q, v| q + h * v),
        v: at.v.zip_map(here.acceleration, |v, a| v + h * a),
    };
    let (there, there_growth) = if F::IS_HELD {
        let solved = mechanism.constrained(&predicted, inputs, &here.feedback);
        (solved.acceleration, solved.growth)
    } else {
        let solved = mechanism.stabilized(&predicted, inputs, gains);
        (solved.acceleration, solved.growth)
    };

    let mean = here.acceleration.zip_map(there, |a, b| a + b);
    let next = State {
        t: t_next,
        q: at.q.zip_map(at.v.zip_map(predicted.v, |v, w| v + w), |q, sum| q + half_h * sum),
        v: at.v.zip_map(mean, |v, sum| v + half_h * sum),
    };
    // One test per step; written so that a NaN fails it.
    let healthy = here.growth + there_growth < growth_limit() && next.q.is_finite() && next.v.is_finite();
    if healthy { Ok(next) } else { Err(diagnose(mechanism, [at, &predicted], [here.acceleration, there])) }
}

/// Names what went wrong in a step that failed its test: a pivot in one of its
/// two stages, else what first ceased to be finite.
#[cold]
fn diagnose<M: Mechanism>(
    mechanism: &M,
    stages: [&State<M::Coordinates>; 2],
    accelerations: [M::Coordinates; 2],
) -> Error {
    for (stage, acceleration) in stages.into_iter().zip(accelerations) {
        if let Err(error) = check_finite(stage) {
            return error;
        }
        let worst = mechanism.worst_pivot(stage.t, &stage.q);
        if let Some(singular) = singular(stage.t, worst, M::INFO.pivots) {
            return singular;
        }
        if let Some(error) = non_finite(stage.t, acceleration) {
            return error;
        }
    }
    // Both stages are healthy, so the sum that leaves them is not.
    let [_, last] = stages;
    Error::NonFinite { t: last.t.to_f64(), coordinate: "the state" }
}

/// What [`check_solution`] looks at.
pub(crate) struct Solution<'a, C: Components> {
    pub t: C::Real,
    pub q: &'a C,
    pub value: &'a C,
    pub growth: C::Real,
    /// The pivots of its elimination.
    pub pivots: &'static [Pivot],
}

/// `Ok` if a solution is finite and the growth leaves digits in every pivot,
/// else the error that names the pivot or the coordinate; `worst` finds it.
pub(crate) fn check_solution<C: Components>(
    solution: &Solution<'_, C>,
    worst: impl FnOnce() -> Option<(usize, C::Real)>,
) -> Result<(), Error> {
    let Solution { t, q, value, growth, pivots } = *solution;
    if value.is_finite() && growth < growth_limit() {
        return Ok(());
    }
    let cause = non_finite(t, *q).or_else(|| singular(t, worst(), pivots)).or_else(|| non_finite(t, *value));
    // Several pivots, each still good, can add up to the limit.
    Err(cause.unwrap_or(Error::Singular {
        t: t.to_f64(),
        constraint: "",
        coordinate: "",
        growth: growth.to_f64(),
    }))
}

/// The singular-position error, if the worst pivot is over the limit.
fn singular<T: Real>(t: T, worst: Option<(usize, T)>, pivots: &[Pivot]) -> Option<Error> {
    let (at, growth) = worst?;
    if growth < growth_limit() {
        return None;
    }
    let Pivot { constraint, coordinate } = *pivots.get(at)?;
    Some(Error::Singular { t: t.to_f64(), constraint, coordinate, growth: growth.to_f64() })
}

/// `Ok` if positions and velocities are finite.
pub(crate) fn check_finite<C: Components>(state: &State<C>) -> Result<(), Error> {
    match non_finite(state.t, state.q).or_else(|| non_finite(state.t, state.v)) {
        Some(error) => Err(error),
        None => Ok(()),
    }
}

/// The error that names the first component that is not finite.
fn non_finite<C: Components>(t: C::Real, components: C) -> Option<Error> {
    let array = components.into_array();
    let at = array.as_ref().iter().position(|x| !x.is_finite())?;
    let coordinate = C::NAMES.get(at).copied()?;
    Some(Error::NonFinite { t: t.to_f64(), coordinate })
}
