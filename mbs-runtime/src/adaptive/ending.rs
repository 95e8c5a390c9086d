//! The end of a step at an event.

use super::attempt::is_healthy;
use super::dense::is_instant;
use super::events::Watched;
use super::{Adaptive, AdaptiveScheme, Dynamics, Happened};
use crate::{Error, Real, vectors};

impl<D: Dynamics, S: AdaptiveScheme> Adaptive<D, S> {
    /// Ends the last step at `t`, which lies in it; true if that step meets the tolerance. It may not, though the
    /// longer one did, if one of its stages meets a force that no stage of the longer one has met. Then the run goes
    /// back to where the step began, and its next step is shorter.
    pub(super) fn end_at(&mut self, t: D::Real) -> Result<bool, Error> {
        // a time with derivatives moves the end even where its value does not
        if t >= self.now.t && D::Real::ORDER == 0 {
            return Ok(true);
        }
        let Self { dynamics, inputs, before, next, attempt, between, estimate, tolerances, .. } = self;
        between.lose_stages();
        let growth = attempt.step::<D, S>((&*dynamics, &*inputs), before, t, next);
        if growth.is_some_and(|growth| is_healthy(growth, next)) {
            let ratio = attempt.error(estimate, tolerances, before, next);
            let h = (t - before.t).to_f64();
            let is_good = ratio <= 1.0 || is_instant(h, t.to_f64(), D::Real::EPSILON.to_f64());
            if !is_good {
                self.control.judge(h, ratio, estimate);
                self.effort.rejected += 1;
                self.step_back();
                return Ok(false);
            }
            core::mem::swap(&mut self.now, &mut self.next);
            self.between.begin(true);
            return Ok(true);
        }
        let start = before.clone();
        self.rewind_to(t.to_f64())?;
        self.before = start;
        self.solve()?;
        Ok(true)
    }

    /// Goes back to where the last step began, as if it had not been taken.
    pub(super) fn step_back(&mut self) {
        self.now = self.before.clone();
        self.happened = Happened { due: 0, ..self.happened_before };
        self.switching.pieces = None;
        self.stopping.reached = 0;
        self.between.begin(false);
    }

    /// The time of an event with its first derivatives. The watched value g vanishes at it
    /// whatever the variables p are:
    ///
    /// ```text
    /// g(t(p), p) = 0      dt/dp = −(∂g/∂p)/ġ
    /// ```
    ///
    /// Where g only touches zero, ġ = 0 and the derivatives are not finite.
    pub(super) fn differentiated(
        &mut self,
        t: D::Real,
        index: usize,
        watched: &mut Watched<'_, D>,
    ) -> D::Real {
        if D::Real::PARTIALS == 0 {
            return t;
        }
        let t = t.without_partials();
        let Self { dynamics, inputs, before, next, attempt, all, between, .. } = self;
        between.lose_stages();
        let growth = attempt.step::<D, S>((&*dynamics, &*inputs), before, t, next);
        if !growth.is_some_and(|growth| is_healthy(growth, next)) {
            return t;
        }
        let value = watched.value(index, (dynamics, inputs), next, all);
        // ġ is the derivative along the motion, for which the first partial has room, beside that of parameters and inputs
        let along = |x: D::Real, rate: D::Real| x.without_partials().plus_partial(0, rate.to_f64());
        let mut rate_at = |speed: f64| {
            let along = |x: D::Real, rate: D::Real| along(x, D::Real::from_f64(speed) * rate);
            vectors::zip_map(next.q.as_mut(), next.v.as_ref(), along);
            vectors::zip_map(next.v.as_mut(), next.a.as_ref(), along);
            next.t = along(t, D::Real::from_f64(1.0));
            watched.value(index, (&*dynamics, &*inputs), next, all).partial(0)
        };
        let rate = rate_at(1.0) - rate_at(0.0);
        (0..D::Real::PARTIALS).fold(t, |t, at| {
            let change = value.partial(at);
            if change == 0.0 { t } else { t.plus_partial(at, -change / rate) }
        })
    }
}
