//! Errors of a solution or a state, in the names of the declaration.

use crate::equations::{At, Equations};
use crate::mechanism::growth_limit;
use crate::{Error, Info, Pivot, Real, vectors};

/// A solution that [`check_solution`] examines.
pub(crate) struct Solution<'a, T> {
    pub t: T,
    pub q: &'a [T],
    /// Accelerations, or a correction of positions or velocities.
    pub value: &'a [T],
    pub growth: T,
    pub info: &'a Info,
    /// The pivots of its elimination.
    pub pivots: &'static [Pivot],
}

/// `Ok` if a solution is finite and the growth leaves digits in every pivot,
/// else the error that names the pivot or the coordinate; `worst` finds it.
pub(crate) fn check_solution<T: Real>(
    solution: &Solution<'_, T>,
    worst: impl FnOnce() -> Option<(usize, T)>,
) -> Result<(), Error> {
    if vectors::is_finite(solution.value) && solution.growth < growth_limit() {
        return Ok(());
    }
    let info = solution.info;
    Err(solution.cause(growth_limit(), worst(), |at| info.coordinate_name(at)))
}

/// The error of a stage with this q̈ and growth, if it has one: something is not finite, or the growth
/// of a pivot is over `limit`. q and v are room for all coordinates.
pub(crate) fn stage_error<T: Real>(
    equations: &dyn Equations<T>,
    states: At<'_, T>,
    acceleration: &[T],
    growth: T,
    limit: T,
    [q, v]: [&mut [T]; 2],
) -> Option<Error> {
    let info = equations.info();
    let At { t, .. } = states;
    let non_finite = |components| non_finite(t, components, |at| info.state_name(at));
    if let Some(error) = non_finite(states.q).or_else(|| non_finite(states.v)) {
        return Some(error);
    }
    if !is_over(growth, limit) && vectors::is_finite(acceleration) {
        return None;
    }
    equations.complete(states, q, v);
    let solution = Solution { t, q, value: acceleration, growth, info, pivots: info.pivots };
    let error = solution.cause(limit, equations.worst_pivot(t, q), |at| info.state_name(at));
    let undefined = || {
        let is_own = |at: usize| info.states.get(at).is_some_and(|&at| info.is_own(at));
        let is_of_own = vectors::first_non_finite(acceleration).is_some_and(|(at, _)| is_own(at));
        let what = if is_of_own { "the rate of" } else { "the acceleration of" };
        check_defined(t, what, acceleration, |at| info.state_name(at)).err()
    };
    match error {
        // no motion that runs away, but a force without a value, such as the root of a negative number
        Error::NonFinite { .. } if is_moderate(states) => undefined().or(Some(error)),
        _ => Some(error),
    }
}

/// `true` for a state that is far from where products of its numbers overflow.
fn is_moderate<T: Real>(states: At<'_, T>) -> bool {
    [states.q, states.v].iter().all(|vector| vectors::largest(vector).1 < T::from_f64(MODERATE))
}

/// Its square is finite in single precision too.
const MODERATE: f64 = 1e18;

/// True if a growth reaches a limit; one that is no number does.
fn is_over<T: Real>(growth: T, limit: T) -> bool {
    let is_below = growth < limit;
    !is_below
}

impl<T: Real> Solution<'_, T> {
    /// Why the solution is no good: a position that is not finite, a pivot, or,
    /// with all pivots healthy, the component that is not finite.
    fn cause(&self, limit: T, worst: Option<(usize, T)>, name: impl Fn(usize) -> &'static str) -> Error {
        if let Some(error) = non_finite(self.t, self.q, |at| self.info.coordinate_name(at)) {
            return error;
        }
        let worst_growth = worst.map_or(self.growth, |(_, growth)| growth);
        if !is_over(self.growth, limit)
            && !is_over(worst_growth, limit)
            && let Some(error) = non_finite(self.t, self.value, name)
        {
            return error;
        }
        // Where every pivot is healthy, something else has no solution: friction
        // that jams.
        let share = T::from_f64(1.0 / 64.0) * limit;
        let culprit = worst.filter(|(_, growth)| is_over(*growth, share));
        let growth = if is_over(self.growth, limit) { self.growth } else { worst_growth };
        singular(self.info, self.t, culprit.and_then(|(at, _)| self.pivots.get(at)), growth)
    }
}

/// A singular position at the time `t`, where this pivot has grown.
pub(crate) fn singular<T: Real>(info: &Info, t: T, pivot: Option<&Pivot>, growth: T) -> Error {
    let (constraint, coordinate) = pivot.map_or(("", ""), |pivot| (pivot.constraint, pivot.coordinate));
    let (t, growth, has_redundant) = (t.to_f64(), growth.to_f64(), !info.redundant.is_empty());
    Error::Singular { t, constraint, coordinate, growth, has_redundant }
}

/// `Ok` if positions and velocities are finite.
pub(crate) fn check_finite<T: Real>(info: &Info, at: At<'_, T>) -> Result<(), Error> {
    let non_finite = |components| non_finite(at.t, components, |at| info.coordinate_name(at));
    match non_finite(at.q).or_else(|| non_finite(at.v)) {
        Some(error) => Err(error),
        None => Ok(()),
    }
}

/// The error that names the first component that is not finite.
fn non_finite<T: Real>(t: T, components: &[T], name: impl Fn(usize) -> &'static str) -> Option<Error> {
    let (at, _) = vectors::first_non_finite(components)?;
    Some(Error::NonFinite { t: t.to_f64(), coordinate: name(at) })
}

/// `Ok` if the inputs are finite.
pub(crate) fn check_inputs<T: Real>(info: &Info, inputs: &[T]) -> Result<(), Error> {
    let Some((at, value)) = vectors::first_non_finite(inputs) else { return Ok(()) };
    let name = info.inputs.get(at).map_or("", |input| input.name);
    if at >= info.free_inputs().len() {
        return Err(Error::Sample { memory: name, value: value.to_f64() });
    }
    Err(Error::Input { name, value: value.to_f64() })
}

/// Refuses results that are not finite; `name` gives that of each.
#[cold]
pub(crate) fn check_defined<T: Real>(
    t: T,
    what: &'static str,
    results: &[T],
    name: impl Fn(usize) -> &'static str,
) -> Result<(), Error> {
    let Some((at, value)) = vectors::first_non_finite(results) else { return Ok(()) };
    Err(Error::Undefined { t: t.to_f64(), what, name: name(at), value: value.to_f64() })
}
