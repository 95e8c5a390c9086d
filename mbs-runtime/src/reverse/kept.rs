//! The states of a run that is gone back through.

use core::ops::Range;
use std::vec::Vec;

use crate::Error;
use crate::equations::At;

/// States of a run: every j-th, and those between two of them.
pub struct Kept {
    /// s
    states: usize,
    /// j
    stride: u64,
    every: Vec<f64>,
    /// Those from a kept one on, until the next; none where all are kept.
    between: Vec<f64>,
    /// The number of the step at which `between` begins, if it was made.
    first: Option<u64>,
}

impl Kept {
    /// As many as fit into so many bytes.
    pub fn within(memory: usize, steps: u64, states: usize) -> Result<Self, Error> {
        let size = 2 * states;
        let kept = |stride: u64| steps.div_ceil(stride) + if stride > 1 { stride } else { 0 };
        let bytes = |stride: u64| {
            usize::try_from(kept(stride)).map_or(usize::MAX, |kept| kept.saturating_mul(8 * size))
        };
        let most = (steps as f64).sqrt().ceil().max(1.0) as u64;
        let mut stride = 1;
        while bytes(stride) > memory && stride < most {
            stride = (2 * stride).min(most);
        }
        if bytes(stride) > memory {
            return Err(Error::Memory { allowed: memory, needed: bytes(stride) });
        }
        let count = |kept: u64| usize::try_from(kept).map_or(0, |kept| kept * size);
        let between = if stride > 1 { count(stride) } else { 0 };
        let room = |count: usize| {
            let mut room = Vec::new();
            let refused = Error::Memory { allowed: memory, needed: bytes(stride) };
            room.try_reserve_exact(count).map_err(|_| refused)?;
            room.resize(count, 0.0);
            Ok(room)
        };
        let (every, between) = (room(count(steps.div_ceil(stride)))?, room(between)?);
        Ok(Self { states, stride, every, between, first: None })
    }

    fn place(&self, at: u64) -> Range<usize> {
        let from = usize::try_from(at).unwrap_or(usize::MAX).saturating_mul(2 * self.states);
        from..from.saturating_add(2 * self.states)
    }

    /// Keeps the state before a step, if it is one of those: `write` gives positions and velocities.
    pub fn keep(&mut self, step: u64, write: impl FnOnce(&mut [f64], &mut [f64])) {
        if step.is_multiple_of(self.stride) {
            let place = self.place(step / self.stride);
            if let Some((q, v)) = self.every.get_mut(place).map(|state| state.split_at_mut(self.states)) {
                write(q, v);
            }
        }
    }

    /// Makes the states between two kept ones again, where the state before a step is not there: `again`
    /// writes the positions and velocities behind a step.
    ///
    /// # Errors
    /// Those of `again`.
    pub fn restore(
        &mut self,
        step: u64,
        mut again: impl FnMut(u64, [&[f64]; 2], [&mut [f64]; 2]) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let first = step - step % self.stride;
        if self.stride == 1 || self.first == Some(first) {
            return Ok(());
        }
        let (from, to) = (self.place(first / self.stride), self.place(0));
        if let (Some(from), Some(to)) = (self.every.get(from), self.between.get_mut(to)) {
            to.copy_from_slice(from);
        }
        for at in first..step {
            let (here, there) = (self.place(at - first), self.place(at - first + 1));
            let middle = here.end.min(self.between.len());
            let (before, behind) = self.between.split_at_mut(middle);
            if let (Some(here), Some(there)) = (before.get(here), behind.get_mut(..there.len())) {
                let ((q, v), next) = (here.split_at(self.states), there.split_at_mut(self.states));
                again(at, [q, v], next.into())?;
            }
        }
        self.first = Some(first);
        Ok(())
    }

    /// The state before a step, at the time `t`.
    pub fn state(&self, step: u64, t: f64) -> Option<At<'_, f64>> {
        let found = match self.stride {
            1 => self.every.get(self.place(step)),
            stride => self.between.get(self.place(step % stride)),
        };
        found.map(|state| state.split_at(self.states)).map(|(q, v)| At { t, q, v })
    }
}
