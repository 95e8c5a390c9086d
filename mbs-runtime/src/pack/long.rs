//! Steps of lanes that no vectors compute: of long chains, whose programs became loops.
#![allow(clippy::needless_range_loop, reason = "lanes are counted through several arrays")]

use core::borrow::Borrow;

use super::instances::{Instances, Moment};
use crate::explicit::{Span, Trial, trial};
use crate::lanes::{Lane, Lanes};
use crate::watch::Watch;
use crate::{Gains, Mechanism, Method, Real, Simulation, State, spare};

/// Takes steps in each lane before the next one begins, as its scalar does. It watches the same as
/// [`step_all`](super::step_all).
#[inline(never)]
pub(super) fn lane_after_lane<M, X, S, const N: usize>(
    members: &[S; N],
    instances: &Instances<M, N>,
    watches: &[Watch<M::Real>; N],
    steps: u64,
    now: &mut Moment<M, N>,
    margin: &mut Lanes<M::Real, N>,
) where
    M: Mechanism<Real: Lane>,
    X: Method,
    S: Borrow<Simulation<M, X>>,
{
    for lane in 0..N {
        let member = members[lane].borrow();
        let (mechanism, gains, h) = (member.mechanism(), member.baumgarte().gains(), member.step_size());
        let (mut at, inputs) = (now.scalar_state(lane), instances.scalar_inputs(lane));
        for taken in 1..=steps {
            let t = member.start_time() + M::Real::from_f64(now.steps.0[lane] + taken as f64) * h;
            let growth = step_in_place::<M, X>(mechanism, &mut at, &inputs, &gains, h, t);
            let spare = match const { M::INFO.redundant.is_empty() } {
                true => None,
                false => Some(spare::margin(mechanism, &at, watches[lane].length)),
            };
            now.note(lane, growth, spare, margin);
        }
        now.put_scalar(lane, &at);
    }
}

/// A step of a mechanism that is too large for a fused one, and its growth: of one whose programs
/// became loops on arrays, and else stage by stage.
#[inline(always)]
pub(super) fn step_in_place<M: Mechanism, X: Method>(
    mechanism: &M,
    at: &mut State<M::States>,
    inputs: &M::Inputs,
    gains: &Gains<M::Real>,
    h: M::Real,
    t_next: M::Real,
) -> M::Real {
    // which growths are alarming is found out for many steps at once
    let alarm = M::Real::from_f64(f64::INFINITY);
    if let Some(growth) = mechanism.long_step::<X>(at, inputs, gains, h, t_next, alarm) {
        return growth;
    }
    let Trial { next, growth } = trial::<M, X>(mechanism, at, inputs, gains, &Span { t: at.t, h, t_next });
    *at = next;
    growth
}
