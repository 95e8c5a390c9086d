//! Runs with a constant step as a [`System`].

use super::{ConstantStep, Kernel};
use crate::equations::{At, Equations};
use crate::simulation::clock;
use crate::view::View;
use crate::watch::WorstPlace;
use crate::{Derivation, Dynamics, Error, Real, Sketch, System, vectors};

impl<D: Dynamics, K: Kernel<D>> ConstantStep<D, K> {
    /// The mechanism in its present state.
    fn view(&self) -> View<'_, D> {
        let [q, v] = &self.all;
        let at = At { t: self.now.t, q: q.as_ref(), v: v.as_ref() };
        View { dynamics: &self.dynamics, inputs: &self.inputs, at }
    }
}

impl<D: Dynamics, K: Kernel<D>> System<D::Real> for ConstantStep<D, K> {
    fn equations(&self) -> &dyn Equations<D::Real> {
        self.dynamics.equations()
    }

    fn derivation(&self) -> &Derivation {
        self.dynamics.derivation()
    }

    fn sketch(&self) -> &Sketch {
        self.dynamics.sketch()
    }

    fn time(&self) -> D::Real {
        self.now.t
    }

    fn state(&self, q: &mut [D::Real], v: &mut [D::Real]) {
        let At { q: own_q, v: own_v, .. } = self.view().at;
        vectors::copy(q, own_q);
        vectors::copy(v, own_v);
    }

    fn inputs(&self, inputs: &mut [D::Real]) {
        self.view().with_inputs(|own| vectors::copy(inputs, own));
    }

    fn set_inputs(&mut self, inputs: &[D::Real]) {
        let Self { dynamics, inputs: own, .. } = self;
        let sampling = dynamics.equations().info().sampling;
        dynamics.with_inputs(own, |own| sampling.set_inputs(own, inputs));
        self.is_solved = false;
    }

    fn step_size(&self) -> D::Real {
        self.step
    }

    fn steps(&self) -> u64 {
        self.steps
    }

    fn steps_to(&self, end: f64) -> Result<u64, Error> {
        clock::steps_to::<D::Real>(self.start_time, self.step.to_f64(), self.steps, end)
    }

    fn step(&mut self) -> Result<(), Error> {
        self.step()
    }

    fn reactions(&self, acceleration: &mut [D::Real], multipliers: &mut [D::Real]) -> Result<(), Error> {
        self.view().reactions(acceleration, multipliers)
    }

    fn outputs(
        &self,
        acceleration: &[D::Real],
        multipliers: &[D::Real],
        outputs: &mut [D::Real],
    ) -> Result<(), Error> {
        self.view().outputs(acceleration, multipliers, outputs)
    }

    fn violations(&self) -> [D::Real; 2] {
        self.view().violations()
    }

    fn worst_growth(&self) -> D::Real {
        self.watch.worst
    }

    fn worst_place(&self) -> Option<WorstPlace> {
        self.watch.worst_place(self.dynamics.equations().info())
    }

    fn digits_left(&self) -> f64 {
        self.watch.digits_left()
    }
}
