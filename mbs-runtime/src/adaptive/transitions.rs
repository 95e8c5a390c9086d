//! Conditions of transitions that begin to hold within a step.

use super::crossing::{Bracket, PARTS};
use super::events::Watched;
use super::{Adaptive, AdaptiveScheme, Dynamics};
use crate::Real;

impl<D: Dynamics, S: AdaptiveScheme> Adaptive<D, S> {
    /// Where the value of a transition falls through 0 for the first time in the last step, on the polynomial between its
    /// ends: as of other values each part is looked through for one extremum.
    pub(super) fn beginning_to_hold(
        &mut self,
        index: usize,
        transition: usize,
        watched: &mut Watched<'_, D>,
    ) -> Option<Bracket<D::Real>> {
        let (number, zero) = (D::Real::from_f64, D::Real::default());
        let (start, end) = (self.before.t, self.now.t);
        let (mut holds, size) = self.seen(transition);
        let off = self.stopping.off * size;
        let (mut from, mut before) = (start, self.value_between(start, index, watched));
        for part in 1..=PARTS {
            let to = if part == PARTS {
                end
            } else {
                start + number(f64::from(part) / f64::from(PARTS)) * (end - start)
            };
            let after = self.value_between(to, index, watched);
            let extremum = self.extremum([from, to], [before, after], index, watched);
            for (t, value) in extremum.into_iter().chain([(to, after)]) {
                if holds {
                    // the polynomial knows less of what a mode keeps at its limit than a step that ends there
                    let is_off = |value: D::Real| value.to_f64() > off;
                    holds = !(is_off(value) && is_off(self.value_of_step(t, index, watched)));
                } else if before >= zero && value < zero || before > zero && value <= zero {
                    return Some(Bracket { from, to: t, is_rising: false });
                }
                (from, before) = (t, value);
            }
        }
        None
    }

    /// True if the condition of a transition held where it was looked at last; and the largest difference of its sides.
    fn seen(&mut self, transition: usize) -> (bool, f64) {
        let Self { dynamics, inputs, .. } = self;
        let declared = dynamics.info().modes.transitions.get(transition);
        let Some(declared) = declared else { return (false, 0.0) };
        let side = if declared.is_rising { 1.0 } else { -1.0 };
        let seen =
            dynamics.with_inputs(inputs, |inputs| inputs.get(declared.memory).map(|seen| seen.to_f64()));
        let seen = seen.unwrap_or(0.0);
        (side * seen > 0.0, seen.abs())
    }
}
