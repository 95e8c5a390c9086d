//! States within the last step.

use super::attempt::converge_partials;
use super::{Adaptive, AdaptiveScheme, Dynamics, Happened, Moment};
use crate::explicit::{Beside, subtract};
use crate::vectors::assign;
use crate::{Error, Real, vectors};

impl<D: Dynamics, S: AdaptiveScheme> Adaptive<D, S> {
    /// Makes known what lies between the ends of the last step, if its scheme needs more for it than
    /// the ends.
    pub(super) fn look_between(&mut self) {
        let Self { dynamics, inputs, attempt, before, now, next, between, .. } = self;
        let Some(interpolant) = S::INTERPOLANT else { return };
        if between.is_known() || now.t <= before.t {
            return;
        }
        if between.wants_stages() {
            // another step was tried since
            let again = attempt.step::<D, S>((&*dynamics, &*inputs), before, now.t, next);
            if again.is_none() {
                return;
            }
            between.begin(true);
        }
        between.find((&*dynamics, interpolant), inputs, attempt, [before, now], next);
    }

    /// Positions and velocities at `t` seconds, within the last step: interpolated and projected
    /// onto the constraints.
    pub(super) fn interpolate(&self, t: D::Real) -> Result<(D::States, D::States), Error> {
        let Self { before, now, dynamics, inputs, between, .. } = self;
        if !(t >= before.t && t <= now.t) {
            return Err(Error::EndTime { end: t.to_f64(), now: before.t.to_f64() });
        }
        let (mut q, mut v) = (now.q.clone(), now.v.clone());
        // the end of a step at an event moves with derivatives of its own
        let is_end = t >= now.t;
        if !is_end || (!t.is_same(now.t) && now.t > before.t) {
            before.between(between.terms(), now, t, &mut q, &mut v);
            // with the inputs of the step
            let relaxes = S::RELAXES && self.is_solved;
            let (mut delta, mut state) = (before.q.clone(), Moment { t, a: before.a.clone(), q, v });
            if relaxes {
                before.acceleration(now, t, &mut state.a);
            }
            // what the first relaxation leaves of the constraints is of second order, and the second one moves little
            for _ in 0..1 + usize::from(relaxes) {
                let Moment { q, v, .. } = &mut state;
                dynamics.correction(t, &Beside { q: &*q, v: None }, &mut delta);
                subtract(q, &delta);
                converge_partials(dynamics, t, q, &mut delta);
                dynamics.correction(t, &Beside { q: &*q, v: Some(&*v) }, &mut delta);
                subtract(v, &delta);
                if relaxes {
                    S::relax((dynamics, inputs), now.t - before.t, &mut delta, &mut state);
                }
            }
            (q, v) = (state.q, state.v);
            if is_end {
                vectors::zip_map(q.as_mut(), now.q.as_ref(), |q, now| now.with_partials_of(q));
                vectors::zip_map(v.as_mut(), now.v.as_ref(), |v, now| now.with_partials_of(v));
            }
        }
        Ok((q, v))
    }

    /// Goes back to `t` seconds, within the last step, and forgets what lies behind.
    ///
    /// # Errors
    /// [`Error::EndTime`] for a time outside of the last step.
    pub fn rewind_to(&mut self, t: f64) -> Result<(), Error> {
        let at = D::Real::from_f64(t);
        self.look_between();
        let (q, v) = self.interpolate(at)?;
        assign(&mut self.now.q, &q);
        assign(&mut self.now.v, &v);
        self.now.t = at;
        self.is_solved = false;
        self.before = self.now.clone();
        self.between.begin(false);
        self.happened = Happened::default();
        self.progress.go_on();
        self.switching.go_on();
        Ok(())
    }
}
