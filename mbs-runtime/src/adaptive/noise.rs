//! Where rounding is more than the tolerance: near a singular position, which magnifies it.

use super::{Adaptive, AdaptiveScheme, Dynamics, Moment};
use crate::diagnosis::singular;
use crate::explicit::{Beside, subtract};
use crate::{Error, Real, vectors};

/// Near a singular position the growth of a step is so many times the least of the run,
pub(crate) const RISEN: f64 = 100.0;
/// and steps that rounding holds up are shorter than this share of the longest one.
const SHORT: f64 = 0.01;
/// Rounding holds a step up that adds more than this share of what is allowed to its error.
const DROWNED: f64 = 0.1;
/// A run ends after so many of them in sequence.
const MOST: u32 = 10;

/// Progress of a run, which rounding holds up near a singular position.
#[derive(Clone, Copy, Debug)]
pub(super) struct Progress<T> {
    /// The least growth of a step so far.
    least: T,
    /// Steps in sequence that rounding held up.
    held_up: u32,
}

impl<T: Real> Progress<T> {
    /// Before the first step.
    pub fn new() -> Self {
        Self { least: T::from_f64(f64::INFINITY), held_up: 0 }
    }

    /// From another state, or with other inputs.
    pub fn go_on(&mut self) {
        self.held_up = 0;
    }
}

impl<D: Dynamics, S: AdaptiveScheme> Adaptive<D, S> {
    /// Refuses a step after some that rounding held up near a singular position: shorter ones would not be
    /// more accurate, and would have no end.
    ///
    /// # Errors
    /// [`Error::Singular`].
    pub(super) fn is_held_up(&mut self) -> Result<(), Error> {
        if self.progress.held_up < MOST { Ok(()) } else { Err(self.singular()) }
    }

    /// Counts the steps that rounding holds up, of which the last one was or was not.
    pub(super) fn note_progress(&mut self, growth: D::Real) {
        let h = self.now.t - self.before.t;
        let Progress { least, held_up } = &mut self.progress;
        *least = least.min(growth);
        let is_near = growth > D::Real::from_f64(RISEN) * *least;
        let is_short = h.to_f64() <= SHORT * self.effort.longest;
        let held_up = *held_up + 1;
        self.progress.held_up = if is_near && is_short && self.is_drowned(h) { held_up } else { 0 };
    }

    /// Why no step is short enough.
    pub(super) fn too_short(&mut self, step: f64) -> Error {
        // the next step would be shorter than the clock can tell
        let shortest = 4.0 * D::Real::EPSILON.to_f64() * self.now.t.to_f64().abs();
        if self.is_drowned(D::Real::from_f64(step.max(shortest))) && self.is_near_singular() {
            return self.singular();
        }
        Error::StepTooShort { t: self.now.t.to_f64(), step }
    }

    /// Reports whether the rounding of the present state adds more to the error of a step of `h` seconds than the
    /// tolerance allows. The time, every position and velocity are moved by a rounding and led back to the constraints. The
    /// changes of velocities and accelerations, times `h`, are compared with the tolerance.
    fn is_drowned(&mut self, h: D::Real) -> bool {
        let Self { dynamics, inputs, tolerances, now, next, attempt, .. } = self;
        // the time too: a drive follows it
        next.t = now.t + D::Real::EPSILON * now.t.abs();
        for (to, from) in [(&mut next.q, &now.q), (&mut next.v, &now.v)] {
            let rounding = D::Real::EPSILON * vectors::largest(from.as_ref()).1;
            let mut sign = D::Real::from_f64(1.0);
            for (to, from) in to.as_mut().iter_mut().zip(from.as_ref()) {
                *to = *from + sign * rounding;
                sign = -sign;
            }
        }
        let delta = &mut attempt.there;
        dynamics.correction(next.t, &Beside { q: &next.q, v: None }, delta);
        subtract(&mut next.q, delta);
        dynamics.correction(next.t, &Beside { q: &next.q, v: Some(&next.v) }, delta);
        subtract(&mut next.v, delta);
        let Moment { t, q, v, a } = next;
        dynamics.acceleration(*t, q, v, inputs, a);
        vectors::zip_map(v.as_mut(), now.v.as_ref(), |there, here| h * (there - here));
        vectors::zip_map(a.as_mut(), now.a.as_ref(), |there, here| h * (there - here));
        let share = tolerances.size(&attempt.atol, [&now.q, &now.v], [&*v, &*a]);
        share.is_nan() || share > DROWNED
    }

    /// Reports whether the worst pivot in the present position has grown so much that digits are lost.
    fn is_near_singular(&mut self) -> bool {
        self.worst_pivot().is_some_and(|(_, growth)| growth > D::Real::from_f64(RISEN))
    }

    fn worst_pivot(&mut self) -> Option<(usize, D::Real)> {
        let Self { dynamics, now, all, .. } = self;
        dynamics.complete(now.t, &now.q, &now.v, all);
        dynamics.equations().worst_pivot(now.t, all[0].as_ref())
    }

    /// The present position as a singular one.
    fn singular(&mut self) -> Error {
        let worst = self.worst_pivot();
        let growth = worst.map_or(self.watch.worst, |(_, growth)| growth);
        let info = self.dynamics.info();
        singular(info, self.now.t, worst.and_then(|(at, _)| info.pivots.get(at)), growth)
    }
}
