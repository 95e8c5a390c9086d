//! Samples of clocks in runs to a tolerance: a step ends at each.
//!
//! A sample is taken before the next step, or where the run is looked at. Until then the last step is known with the
//! memories that it was taken with.

use super::events::{Happened, MOST_EVENTS, Watched};
use super::gaps::bits;
use super::{Adaptive, AdaptiveScheme, Dynamics};
use crate::samples::{is_sample, next_sample, sample_at};
use crate::{Error, vectors};

impl<D: Dynamics, S: AdaptiveScheme> Adaptive<D, S> {
    /// The first time behind the present one at which a step ends: at a corner of the accelerations, or at a sample.
    pub(super) fn next_corner(&self) -> D::Real {
        let corner = self.dynamics.next_corner(self.now.t, &self.inputs);
        if !D::SAMPLES || self.dynamics.info().sampling.clocks == 0 {
            return corner;
        }
        let sample = next_sample(self.dynamics.equations(), self.now.t, self.sampled);
        if sample < corner { sample } else { corner }
    }

    /// True if a sample is due at the present time that has not been taken. Between steps it is not before its time, where a
    /// table may jump; at the end of a run it is if it is before that by a rounding.
    fn is_due(&self, is_exact: bool) -> bool {
        D::SAMPLES && is_sample(self.dynamics.equations(), self.now.t, self.sampled, is_exact)
    }

    /// Takes the samples that are due at the present time, once, and makes the jumps of the modes that they enter.
    ///
    /// # Errors
    /// Those of the jump.
    pub(super) fn sample(&mut self, is_exact: bool) -> Result<(), Error> {
        if !D::SAMPLES || !self.is_due(is_exact) {
            return Ok(());
        }
        self.take_samples();
        self.look_at_rests()
    }

    /// Takes the samples of a start, if some are due.
    pub(super) fn sample_at_start(&mut self) {
        if D::SAMPLES && self.is_due(false) {
            self.take_samples();
        }
    }

    fn take_samples(&mut self) {
        // what lies behind was computed with the memories of before
        self.inputs_mut();
        self.with_memories(|equations, at, inputs, _| sample_at(equations, at, inputs));
        self.sampled = Some(self.now.t);
    }

    /// Makes the jump and takes the samples that are due; a value that changes its sign by them is an event at the
    /// present time.
    ///
    /// # Errors
    /// Those of the jump.
    pub(super) fn sample_and_look(
        &mut self,
        is_exact: bool,
        watched: &mut Watched<'_, D>,
    ) -> Result<(), Error> {
        if !(D::SAMPLES || D::JUMPS) || !(self.is_due(is_exact) || self.stopping.reached != 0) {
            return Ok(());
        }
        let before = self.watched_now(watched);
        self.jump()?;
        self.sample(is_exact)?;
        let after = self.watched_now(watched);
        for (index, bit) in bits(watched.count) {
            let direction = (watched.direction)(index);
            let met = before.get(index).zip(after.get(index)).and_then(|(a, b)| direction?.met(*a, *b));
            let Happened { all, rising, due, .. } = &mut self.happened;
            if let Some(is_rising) = met {
                *all |= bit;
                *due |= bit;
                *rising = *rising & !bit | if is_rising { bit } else { 0 };
            }
        }
        Ok(())
    }

    /// The watched values of the present state.
    fn watched_now(&mut self, watched: &mut Watched<'_, D>) -> [D::Real; MOST_EVENTS] {
        let Self { dynamics, inputs, now, all, .. } = self;
        vectors::each(&mut |index| match index < watched.count {
            true => watched.value(index, (&*dynamics, &*inputs), now, all),
            false => D::Real::default(),
        })
    }
}
