//! Heun's method on the first-order form (q, v)˙ = (v, q̈).

use crate::mechanism::growth_limit;
use crate::{Components, Error, Feedback, Gains, Mechanism, Real, State};

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
    if healthy { Ok(next) } else { Err(diagnose(mechanism, at, &predicted, here.growth)) }
}

/// Names what went wrong in a step that failed its test.
#[cold]
fn diagnose<M: Mechanism>(
    mechanism: &M,
    at: &State<M::Coordinates>,
    predicted: &State<M::Coordinates>,
    growth_at: M::Real,
) -> Error {
    if let Err(singular) = check_solution(mechanism, at.t, &at.q, (&at.q, growth_at)) {
        return singular;
    }
    let there = if predicted.q.is_finite() { predicted } else { at };
    if let Some(singular) = singular(mechanism, there.t, &there.q, None) {
        return singular;
    }
    non_finite(predicted)
}

/// `Ok` if `solution` is finite and the growth leaves digits in every pivot,
/// else the error that names the pivot.
pub(crate) fn check_solution<M: Mechanism>(
    mechanism: &M,
    t: M::Real,
    q: &M::Coordinates,
    (solution, growth): (&M::Coordinates, M::Real),
) -> Result<(), Error> {
    if solution.is_finite() && growth < growth_limit() {
        return Ok(());
    }
    if !q.is_finite() {
        return Err(non_finite(&State { t, q: *q, v: *q }));
    }
    Err(singular(mechanism, t, q, Some(growth)).unwrap_or(Error::Singular {
        t: t.to_f64(),
        constraint: "",
        coordinate: "",
        growth: growth.to_f64(),
    }))
}

/// The singular-position error at (t, q): unconditionally if its growth is
/// given, else only if the worst pivot is over the limit there.
fn singular<M: Mechanism>(
    mechanism: &M,
    t: M::Real,
    q: &M::Coordinates,
    known_growth: Option<M::Real>,
) -> Option<Error> {
    let growth = match known_growth {
        Some(growth) => growth,
        None => {
            let none = M::Constraints::splat(M::Real::default());
            let growth = mechanism.position_correction(t, q, &none).growth;
            if growth < growth_limit() {
                return None;
            }
            growth
        }
    };
    let pivot = mechanism.worst_pivot(t, q).and_then(|at| M::INFO.pivots.get(at));
    Some(Error::Singular {
        t: t.to_f64(),
        constraint: pivot.map_or("", |p| p.constraint),
        coordinate: pivot.map_or("", |p| p.coordinate),
        growth: growth.to_f64(),
    })
}

/// `Ok` if positions and velocities are finite.
pub(crate) fn check_finite<C: Components>(state: &State<C>) -> Result<(), Error> {
    if state.q.is_finite() && state.v.is_finite() { Ok(()) } else { Err(non_finite(state)) }
}

/// The error that names the first component that is not finite.
fn non_finite<C: Components>(state: &State<C>) -> Error {
    let first = |components: C| {
        let array = components.into_array();
        let at = array.as_ref().iter().position(|x| !x.is_finite())?;
        C::NAMES.get(at).copied()
    };
    let coordinate = first(state.q).or_else(|| first(state.v)).unwrap_or("acceleration");
    Error::NonFinite { t: state.t.to_f64(), coordinate }
}
