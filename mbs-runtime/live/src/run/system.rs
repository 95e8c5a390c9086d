//! A run as tools see it.

use mbs_runtime::equations::{self, At, Equations, Room, check_outputs};
use mbs_runtime::{Derivation, Error, Real, Sketch, System, WorstPlace};

use super::{Run, copy};

impl<T: Real> System<T> for Run<T> {
    fn equations(&self) -> &dyn Equations<T> {
        &self.mechanism
    }

    fn derivation(&self) -> &Derivation {
        self.mechanism.derivation()
    }

    fn sketch(&self) -> &Sketch {
        self.mechanism.sketch()
    }

    fn time(&self) -> T {
        self.t
    }

    fn state(&self, q: &mut [T], v: &mut [T]) {
        self.mechanism.complete(self.states(), q, v);
    }

    fn inputs(&self, inputs: &mut [T]) {
        copy(inputs, &self.inputs);
    }

    fn set_inputs(&mut self, inputs: &[T]) {
        let free = self.mechanism.declared_info().free_inputs().len();
        copy(&mut self.inputs[..free], inputs);
    }

    fn step_size(&self) -> T {
        self.step
    }

    fn steps(&self) -> u64 {
        self.steps
    }

    fn steps_to(&self, end: f64) -> Result<u64, Error> {
        equations::steps_to::<T>(self.start_time.to_f64(), self.step.to_f64(), self.steps, end)
    }

    fn step(&mut self) -> Result<(), Error> {
        if !self.mechanism.declared_info().jumps() {
            self.step_between()?;
        } else {
            self.step_to_stops()?;
        }
        self.sample();
        Ok(())
    }

    fn reactions(&self, acceleration: &mut [T], multipliers: &mut [T]) -> Result<(), Error> {
        self.reactions_with(&vec![T::ZERO; multipliers.len()], acceleration, multipliers)
    }
    fn outputs(&self, acceleration: &[T], multipliers: &[T], outputs: &mut [T]) -> Result<(), Error> {
        let [q, v] = self.completed();
        let at = At { t: self.t, q: &q, v: &v };
        Equations::outputs(&self.mechanism, at, &self.inputs, [acceleration, multipliers], outputs);
        check_outputs(self.mechanism.declared_info(), self.t, outputs)
    }

    fn violations(&self) -> [T; 2] {
        let (mut rows, [q, v]) = (vec![T::from_f64(f64::NAN); self.multipliers], self.completed());
        self.mechanism.phi(self.t, &q, &mut rows);
        let violation = norm(&rows);
        self.mechanism.phi_dot(At { t: self.t, q: &q, v: &v }, &mut rows);
        [violation, norm(&rows)]
    }

    fn worst_growth(&self) -> T {
        self.watch.worst
    }

    fn worst_place(&self) -> Option<WorstPlace> {
        self.watch.worst_place(self.mechanism.declared_info())
    }

    fn digits_left(&self) -> f64 {
        self.watch.digits_left()
    }
}

impl<T: Real> Run<T> {
    /// A step of which clocks and stops know nothing.
    pub(super) fn step_between(&mut self) -> Result<(), Error> {
        let t_next = self.start_time + T::from_f64((self.steps + 1) as f64) * self.step;
        let run = on_slices!(self);
        let mut room = Room::within(&mut self.room, self.mechanism.declared_info());
        let growth = self.stepper.step(run.at, run.inputs, &run.gains, run.step, t_next);
        let next = At { t: t_next, q: self.stepper.q(), v: self.stepper.v() };
        let is_finite = next.q.iter().chain(next.v).all(|x| x.is_finite());
        if is_finite && run.is_calm(next, growth, &self.watch, &mut room) {
            self.watch.note(growth);
            copy(&mut self.q, self.stepper.q());
            copy(&mut self.v, self.stepper.v());
        } else {
            let (mut q, mut v) = (self.q.clone(), self.v.clone());
            run.step(t_next, [&mut q, &mut v], &mut self.watch, &mut room)?;
            (self.q, self.v) = (q, v);
        }
        self.t = t_next;
        self.steps += 1;
        Ok(())
    }
}

/// Euclidean norm, summed up in the order in which the core does it.
fn norm<T: Real>(x: &[T]) -> T {
    x.iter().fold(T::ZERO, |sum, &x| sum + x * x).sqrt()
}
