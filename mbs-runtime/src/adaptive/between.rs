//! Slopes and terms of interpolants. Some schemes need them beside both ends of a step, so that states between the
//! ends are as accurate as the step.

use mbs_interface::{Interpolant, Row};

use super::attempt::Attempt;
use super::{Dynamics, Moment};
use crate::mechanism::growth_limit;
use crate::vectors::assign;
use crate::{Real, vectors};

/// Slopes of an interpolant and then its terms, of positions and of velocities; see [`Interpolant`].
#[derive(Clone)]
pub struct Between<R> {
    room: R,
    /// `true` if `room` has the terms of the last step.
    is_known: bool,
    /// `true` if the attempt has the stages of the last step, of which the terms are made.
    has_stages: bool,
}

impl<R> Between<R> {
    /// Of no step yet.
    pub fn new(room: R) -> Self {
        Self { room, is_known: false, has_stages: false }
    }

    /// The attempt is another step from now on.
    pub fn lose_stages(&mut self) {
        self.has_stages = false;
    }

    /// The last step is the one that the attempt has the stages of, or none.
    pub fn begin(&mut self, has_stages: bool) {
        (self.is_known, self.has_stages) = (false, has_stages);
    }

    /// `true` if the stages of the last step have to be computed again before its terms are made.
    pub fn wants_stages(&self) -> bool {
        !self.has_stages
    }

    /// `true` if the terms of the last step are known.
    pub fn is_known(&self) -> bool {
        self.is_known
    }

    /// The terms for positions and velocities, if they are known.
    pub fn terms<V>(&self) -> Option<&[[V; 2]; 4]>
    where
        R: AsRef<[[V; 2]]>,
    {
        self.room.as_ref().last_chunk().filter(|_| self.is_known)
    }

    /// Makes the terms of a step from the stages of the attempt; `there` is room.
    pub fn find<D, V, Stages>(
        &mut self,
        (dynamics, interpolant): (&D, &Interpolant),
        inputs: &D::Inputs,
        attempt: &Attempt<V, Stages>,
        [from, to]: [&Moment<D::Real, V>; 2],
        there: &mut Moment<D::Real, V>,
    ) where
        D: Dynamics<States = V>,
        R: AsMut<[[V; 2]]>,
        V: Clone + AsRef<[D::Real]> + AsMut<[D::Real]>,
        Stages: AsRef<[V]> + AsMut<[V]>,
    {
        let Interpolant { stages, terms, .. } = interpolant;
        let h = to.t - from.t;
        let (velocities, accelerations) = (attempt.velocities.as_ref(), attempt.accelerations.as_ref());
        self.is_known = false;
        for (at, row) in stages.iter().chain(terms).enumerate() {
            let (known, unknown) = self.room.as_mut().split_at_mut(at);
            let Some([of_q, of_v]) = unknown.first_mut() else { return };
            // behind the slopes of the stages come that of the end and those that are known
            let slopes =
                |of: usize| velocities.iter().chain([&to.v]).chain(known.iter().map(|[v, _]| v)).nth(of);
            let rates =
                |of: usize| accelerations.iter().chain([&to.a]).chain(known.iter().map(|[_, a]| a)).nth(of);
            let is_slope = at < stages.len();
            sum(row, h, slopes, is_slope.then_some(&from.q), if is_slope { &mut there.q } else { of_q });
            sum(row, h, rates, is_slope.then_some(&from.v), if is_slope { &mut there.v } else { of_v });
            if is_slope {
                there.t = from.t + D::Real::from_f64(row.node()) * h;
                let growth = dynamics.acceleration(there.t, &there.q, &there.v, inputs, of_v);
                assign(of_q, &there.v);
                let is_healthy = growth < growth_limit() && vectors::is_finite(of_v.as_ref());
                if !is_healthy {
                    return;
                }
            }
        }
        self.is_known = true;
    }
}

/// x = x₀ + h Σ w k, without x₀ where there is none.
fn sum<'a, T: Real, V: AsRef<[T]> + AsMut<[T]> + 'a>(
    row: &Row,
    h: T,
    slopes: impl Fn(usize) -> Option<&'a V>,
    from: Option<&V>,
    to: &mut V,
) {
    vectors::fill(to.as_mut(), T::default());
    for (of, weight) in row.terms() {
        if let Some(slope) = slopes(of) {
            vectors::add_scaled(to.as_mut(), T::from_f64(weight), slope.as_ref());
        }
    }
    let factor = T::from_f64(row.share) * h;
    match from {
        Some(from) => vectors::zip_map(to.as_mut(), from.as_ref(), |sum, from| from + factor * sum),
        None => vectors::map(to.as_mut(), |sum| factor * sum),
    }
}
