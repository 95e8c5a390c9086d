//! Stops at the ends of the steps of a run.

use mbs_runtime::equations::{At, Equations, Pushed, Vectors, begin_at_stops, push, strike};
use mbs_runtime::{Error, Real};

use super::Run;

impl<T: Real> Run<T> {
    /// A step, and what stops make of its end.
    pub(super) fn step_to_stops(&mut self) -> Result<(), Error> {
        let (q, v, inputs) = (self.q.clone(), self.v.clone(), self.inputs.clone());
        let (t, steps, watch) = (self.t, self.steps, self.watch);
        let [q_before, v_before] = self.completed();
        let before = At { t, q: &q_before, v: &v_before };
        let led = self.push().and_then(|pushed| {
            self.step_between()?;
            self.strike(&pushed, before)
        });
        if led.is_err() {
            (self.q, self.v, self.inputs) = (q, v, inputs);
            (self.t, self.steps, self.watch) = (t, steps, watch);
        }
        led
    }

    /// The stops that push before a step.
    fn push(&mut self) -> Result<Pushed<T>, Error> {
        let [q, mut v] = self.completed();
        let mut vectors = Vectors::new(vec![T::ZERO; q.len()], vec![T::ZERO; self.multipliers]);
        let pushed =
            push(&self.mechanism, (self.step, vectors.changes()), (self.t, &q, &mut v), &mut self.inputs)?;
        if pushed.is_any() {
            self.mechanism.states(&v, &mut self.v);
        }
        Ok(pushed)
    }

    fn strike(&mut self, pushed: &Pushed<T>, before: At<'_, T>) -> Result<(), Error> {
        let [mut q, mut v] = self.completed();
        let mut vectors = Vectors::new(vec![T::ZERO; q.len()], vec![T::ZERO; self.multipliers]);
        let end = (self.t, [&mut q[..], &mut v[..]]);
        if strike(&self.mechanism, (self.step, vectors.changes()), (pushed, before), end, &mut self.inputs)? {
            self.mechanism.states(&q, &mut self.q);
            self.mechanism.states(&v, &mut self.v);
        }
        Ok(())
    }

    /// Rests on the stops that the start touches.
    pub(super) fn touch(&mut self) -> Result<(), Error> {
        if !self.mechanism.declared_info().jumps() {
            return Ok(());
        }
        let [q, v] = self.completed();
        let mut vectors = Vectors::new(vec![T::ZERO; q.len()], vec![T::ZERO; self.multipliers]);
        let at = At { t: self.t, q: &q, v: &v };
        begin_at_stops(&self.mechanism, (self.step, vectors.changes()), at, &mut self.inputs)
    }
}
