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
/// `t_next` is t + h, passed in so that time is k·h and not a sum of k roundings. With
/// the state comes the growth of both stages.
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
) -> Result<(State<M::Coordinates>, M::Real), Error> {
    let trial = trial::<M, F>(mechanism, at, inputs, gains, h, t_next);
    let Trial { predicted, next, here, there } = trial;
    let growth = here.1 + there.1;
    // One test per step; written so that a NaN fails it.
    let healthy = growth < growth_limit() && next.q.is_finite() && next.v.is_finite();
    if healthy { Ok((next, growth)) } else { Err(diagnose(mechanism, [at, &predicted], [here, there])) }
}

/// A step that nobody has looked at yet.
pub(crate) struct Trial<M: Mechanism> {
    /// q*, v*
    pub predicted: State<M::Coordinates>,
    /// q⁺, v⁺
    pub next: State<M::Coordinates>,
    /// q̈ and growth of the first stage,
    pub here: (M::Coordinates, M::Real),
    /// and of the second.
    pub there: (M::Coordinates, M::Real),
}

/// The step itself, without a branch.
#[inline(always)]
pub(crate) fn trial<M: Mechanism, F: Feedback>(
    mechanism: &M,
    at: &State<M::Coordinates>,
    inputs: &M::Inputs,
    gains: &Gains<M::Real>,
    h: M::Real,
    t_next: M::Real,
) -> Trial<M> {
    let here = mechanism.stabilized(at, inputs, gains);

    // Each vector becomes an array once: of long chains these are calls.
    let (q, v, a) = (at.q.into_array(), at.v.into_array(), here.acceleration.into_array());
    let (mut q_next, mut v_next) = (q, v);
    predict(h, a.as_ref(), q_next.as_mut(), v_next.as_mut());
    let predicted = State { t: t_next, q: Components::from_array(q_next), v: Components::from_array(v_next) };
    let there = if F::IS_HELD {
        let solved = mechanism.constrained(&predicted, inputs, &here.feedback);
        (solved.acceleration, solved.growth)
    } else {
        let solved = mechanism.stabilized(&predicted, inputs, gains);
        (solved.acceleration, solved.growth)
    };

    let b = there.0.into_array();
    correct(h, [q.as_ref(), v.as_ref()], [a.as_ref(), b.as_ref()], q_next.as_mut(), v_next.as_mut());
    let next = State { t: t_next, q: Components::from_array(q_next), v: Components::from_array(v_next) };
    Trial { predicted, next, here: (here.acceleration, here.growth), there }
}

/// (q, v) becomes (q*, v*).
#[inline(always)]
pub(crate) fn predict<T: Real>(h: T, a: &[T], q: &mut [T], v: &mut [T]) {
    for ((q, v), &a) in q.iter_mut().zip(v).zip(a) {
        *q = *q + h * *v;
        *v = *v + h * a;
    }
}

/// (q*, v*) becomes (q⁺, v⁺), from the state at the start and the q̈ of both stages.
#[inline(always)]
pub(crate) fn correct<T: Real>(
    h: T,
    [q, v]: [&[T]; 2],
    [here, there]: [&[T]; 2],
    q_next: &mut [T],
    v_next: &mut [T],
) {
    let half_h = T::from_f64(0.5) * h;
    let next = q_next.iter_mut().zip(v_next);
    let rates = here.iter().zip(there);
    for (((q_next, v_next), (&q, &v)), (&here, &there)) in next.zip(q.iter().zip(v)).zip(rates) {
        *q_next = q + half_h * (v + *v_next);
        *v_next = v + half_h * (here + there);
    }
}

/// Names what went wrong in a step that failed its test: a pivot in one of its
/// two stages, else what first ceased to be finite.
#[cold]
fn diagnose<M: Mechanism>(
    mechanism: &M,
    stages: [&State<M::Coordinates>; 2],
    solved: [(M::Coordinates, M::Real); 2],
) -> Error {
    // If only the sum of two growths is over the limit, the larger is over half.
    let half_limit = M::Real::from_f64(0.5) * growth_limit();
    for (stage, (acceleration, growth)) in stages.into_iter().zip(solved) {
        if let Err(error) = check_finite(stage) {
            return error;
        }
        if is_over(growth, half_limit) || !acceleration.is_finite() {
            let worst = mechanism.worst_pivot(stage.t, &stage.q);
            let pivots = M::INFO.pivots;
            let solution = Solution { t: stage.t, q: &stage.q, value: &acceleration, growth, pivots };
            return solution.cause(half_limit, worst);
        }
    }
    // Both stages are healthy, so the sum that leaves them is not.
    let [_, last] = stages;
    Error::NonFinite { t: last.t.to_f64(), coordinate: "the state" }
}

/// Whether a growth reaches a limit; one that is no number does.
fn is_over<T: Real>(growth: T, limit: T) -> bool {
    let is_below = growth < limit;
    !is_below
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
    if solution.value.is_finite() && solution.growth < growth_limit() {
        return Ok(());
    }
    Err(solution.cause(growth_limit(), worst()))
}

impl<C: Components> Solution<'_, C> {
    /// Why the solution is no good: a position that is not finite, a pivot, or,
    /// with all pivots healthy, the component that is not finite.
    fn cause(&self, limit: C::Real, worst: Option<(usize, C::Real)>) -> Error {
        if let Some(error) = non_finite(self.t, *self.q) {
            return error;
        }
        let worst_growth = worst.map_or(self.growth, |(_, growth)| growth);
        if !is_over(self.growth, limit)
            && !is_over(worst_growth, limit)
            && let Some(error) = non_finite(self.t, *self.value)
        {
            return error;
        }
        // Where every pivot is healthy, something else has no solution: friction
        // that jams.
        let share = C::Real::from_f64(1.0 / 64.0) * limit;
        let culprit = worst.filter(|(_, growth)| is_over(*growth, share));
        let pivot = culprit.and_then(|(at, _)| self.pivots.get(at));
        let (constraint, coordinate) = pivot.map_or(("", ""), |pivot| (pivot.constraint, pivot.coordinate));
        let growth = if is_over(self.growth, limit) { self.growth } else { worst_growth };
        Error::Singular { t: self.t.to_f64(), constraint, coordinate, growth: growth.to_f64() }
    }
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
