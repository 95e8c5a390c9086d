//! An explicit step of a mechanism, whose health has not been tested.

use core::marker::PhantomData;

use mbs_interface::Stabilization;

use super::{Beside, Slopes, Solve, Span, project, step_of};
use crate::arrays::States;
use crate::{Components, Gains, Mechanism, Method, Scheme, State};

/// The correction of the states of a mechanism, for [`project`].
#[inline(always)]
pub(crate) fn correct<M: Mechanism>(
    mechanism: &M,
    t: M::Real,
    at: &Beside<'_, States<M>>,
    delta: &mut States<M>,
) -> M::Real {
    let v = at.v.unwrap_or(at.q);
    let at_states = State { t, q: Components::from_array(*at.q), v: Components::from_array(*v) };
    let all = mechanism.complete(&at_states);
    let violation = match at.v {
        None => mechanism.phi(t, &all.q),
        Some(_) => mechanism.phi_dot(&all),
    };
    let solved = mechanism.projection(t, &all.q, &violation);
    *delta = M::states(solved.acceleration).into_array();
    solved.growth
}

/// A step of a mechanism whose health has not been tested.
pub(crate) struct Trial<M: Mechanism> {
    /// q⁺, v⁺
    pub next: State<M::States>,
    /// The growths of all stages, added.
    pub growth: M::Real,
}

/// The stages of a step of a mechanism.
struct Stages<'a, M: Mechanism, X> {
    mechanism: &'a M,
    inputs: &'a M::Inputs,
    gains: &'a Gains<M::Real>,
    /// That of the first stage, where it is held.
    feedback: Option<M::Constraints>,
    method: PhantomData<X>,
}

impl<M: Mechanism, X: Method> Solve<M::Real, States<M>> for Stages<'_, M, X> {
    #[inline(always)]
    fn solve(&mut self, _: usize, t: M::Real, q: &States<M>, v: &States<M>, a: &mut States<M>) -> M::Real {
        let at = State { t, q: Components::from_array(*q), v: Components::from_array(*v) };
        let given = match X::EXPLICIT.stabilization {
            Stabilization::Held => self.feedback,
            Stabilization::PerStage => None,
            Stabilization::Projection => Some(Components::splat(M::Real::default())),
        };
        if let Some(given) = &given {
            let solved = self.mechanism.constrained(&at, self.inputs, given);
            *a = solved.acceleration.into_array();
            solved.growth
        } else {
            let solved = self.mechanism.stabilized(&at, self.inputs, self.gains);
            (*a, self.feedback) = (solved.acceleration.into_array(), Some(solved.feedback));
            solved.growth
        }
    }
}

/// The step of a mechanism stage by stage, without a branch.
#[inline(always)]
pub(crate) fn trial<M: Mechanism, X: Method>(
    mechanism: &M,
    at: &State<M::States>,
    inputs: &M::Inputs,
    gains: &Gains<M::Real>,
    span: &Span<M::Real>,
) -> Trial<M> {
    let mut stages = Stages::<M, X> { mechanism, inputs, gains, feedback: None, method: PhantomData };
    let solve = |stage: usize, t: M::Real, q: &States<M>, v: &States<M>, a: &mut States<M>| {
        stages.solve(stage, t, q, v, a)
    };
    tried::<M, X>(mechanism, at, span, solve)
}

/// The same with all stages in place, for lanes.
#[inline(always)]
pub(crate) fn trial_in_place<M: Mechanism, X: Method>(
    mechanism: &M,
    at: &State<M::States>,
    inputs: &M::Inputs,
    gains: &Gains<M::Real>,
    span: &Span<M::Real>,
) -> Trial<M> {
    let stages = Stages::<M, X> { mechanism, inputs, gains, feedback: None, method: PhantomData };
    tried::<M, X>(mechanism, at, span, stages)
}

#[inline(always)]
fn tried<M: Mechanism, X: Method>(
    mechanism: &M,
    at: &State<M::States>,
    span: &Span<M::Real>,
    solve: impl Solve<M::Real, States<M>>,
) -> Trial<M> {
    // Each vector becomes an array once: of long chains these are calls.
    let (mut q, v) = (at.q.into_array(), at.v.into_array());
    let (mut velocities, mut accelerations) = (X::Scheme::stages(v), X::Scheme::stages(v));
    let slopes = Slopes { velocities: velocities.as_mut(), accelerations: accelerations.as_mut() };
    let mut there = q;
    let mut growth = step_of(X::Scheme::TABLEAU, span, &mut q, slopes, &mut there, solve);
    let [v, ..] = velocities.as_mut() else { return Trial { next: *at, growth } };
    if X::EXPLICIT.is_projected() {
        growth =
            growth + project(&mut q, v, &mut there, |at, delta| correct(mechanism, span.t_next, &at, delta));
    }
    let (q, v) = (Components::from_array(q), Components::from_array(*v));
    Trial { next: State { t: span.t_next, q, v }, growth }
}
