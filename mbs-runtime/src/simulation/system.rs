//! A simulation as tools see it.

use super::Simulation;
use crate::equations::{Equations, measured, read, write};
use crate::mechanism::is_fused_for;
use crate::watch::WorstPlace;
use crate::{Components, Derivation, Error, Mechanism, Method, Reactions, Sketch, System};

impl<M: Mechanism, X: Method> System<M::Real> for Simulation<M, X> {
    fn equations(&self) -> &dyn Equations<M::Real> {
        self.mechanism()
    }

    fn derivation(&self) -> &Derivation {
        M::DERIVATION
    }

    fn sketch(&self) -> &Sketch {
        M::SKETCH
    }

    fn time(&self) -> M::Real {
        self.time()
    }

    fn state(&self, q: &mut [M::Real], v: &mut [M::Real]) {
        let state = self.state();
        write(state.q, q);
        write(state.v, v);
    }

    fn inputs(&self, inputs: &mut [M::Real]) {
        write(*self.inputs(), inputs);
    }

    fn set_inputs(&mut self, inputs: &[M::Real]) {
        let mut own = self.inputs().into_array();
        M::INFO.sampling.set_inputs(own.as_mut(), inputs);
        *self.inputs_mut() = Components::from_array(own);
    }

    fn step_size(&self) -> M::Real {
        self.step_size()
    }

    fn steps(&self) -> u64 {
        self.steps()
    }

    fn steps_to(&self, end: f64) -> Result<u64, Error> {
        self.steps_to(end)
    }

    // Other methods than the declared one run in stages on slices, which give the same numbers
    // and are compiled once for all of them.
    fn step(&mut self) -> Result<(), Error> {
        if const { is_fused_for::<M, X>() && X::EXPLICIT.is_held() } {
            self.step()
        } else {
            self.step_in_stages()
        }
    }

    fn reactions(&self, acceleration: &mut [M::Real], multipliers: &mut [M::Real]) -> Result<(), Error> {
        let solved = self.reactions()?;
        write(solved.acceleration, acceleration);
        write(solved.multipliers, multipliers);
        Ok(())
    }

    fn outputs(
        &self,
        acceleration: &[M::Real],
        multipliers: &[M::Real],
        outputs: &mut [M::Real],
    ) -> Result<(), Error> {
        let growth = M::Real::default();
        let reactions =
            Reactions { acceleration: read(acceleration), multipliers: read(multipliers), growth };
        let measured = measured(self.mechanism(), &self.state(), self.inputs(), &reactions);
        write(measured, outputs);
        self.check_outputs(measured)
    }

    fn violations(&self) -> [M::Real; 2] {
        [self.violation(), self.velocity_violation()]
    }

    fn worst_growth(&self) -> M::Real {
        self.worst_growth()
    }

    fn worst_place(&self) -> Option<WorstPlace> {
        self.worst_place()
    }

    fn digits_left(&self) -> f64 {
        self.digits_left()
    }
}
