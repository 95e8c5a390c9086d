//! Heun's method on the first-order form (q, v)˙ = (v, q̈).

use crate::{Components, Feedback, Gains, Mechanism, Real, State};

/// A step whose health has not been tested.
pub(crate) struct Trial<M: Mechanism> {
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
    Trial { next, here: (here.acceleration, here.growth), there }
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
