//! Types of mechanisms as [`Dynamics`] on vectors, so that no run knows them.

use std::sync::Arc;

use mbs_runtime::equations::{At, Correction, Described, Room, correction};
use mbs_runtime::explicit::Beside;
use mbs_runtime::{Components, Dynamics, Error, Mechanism, Real, Scheme, State};

/// A mechanism of a type behind its equations on slices.
#[derive(Clone)]
pub(crate) struct OfType<T> {
    mechanism: Arc<dyn Described<T> + Send + Sync>,
    start: (T, Vec<T>, Vec<T>),
    inputs: Vec<T>,
    no_feedback: Vec<T>,
}

impl<T: Real> OfType<T> {
    /// The mechanism, its type forgotten.
    pub fn new<M: Mechanism<Real = T>>(mechanism: M) -> Self {
        let numbers = |array: &dyn AsRef<[T]>| array.as_ref().to_vec();
        let State { t, q, v } = mechanism.declared_start();
        Self {
            start: (t, numbers(&q.into_array()), numbers(&v.into_array())),
            inputs: numbers(&M::Inputs::default().into_array()),
            no_feedback: vec![T::ZERO; M::INFO.constraints.len()],
            mechanism: Arc::new(mechanism),
        }
    }
}

impl<T: Real> Dynamics for OfType<T> {
    type Real = T;
    type Coordinates = Vec<T>;
    type States = Vec<T>;
    type Constraints = Vec<T>;
    type Inputs = Vec<T>;

    fn described(&self) -> &dyn Described<T> {
        &*self.mechanism
    }

    fn declared_start(&self) -> (T, Vec<T>, Vec<T>) {
        self.start.clone()
    }

    fn states(&self, all: &Vec<T>) -> Vec<T> {
        let mut states = vec![T::ZERO; self.mechanism.info().states.len()];
        self.mechanism.states(all, &mut states);
        states
    }

    fn complete(&self, t: T, q: &Vec<T>, v: &Vec<T>, [q_all, v_all]: &mut [Vec<T>; 2]) {
        self.mechanism.complete(At { t, q, v }, q_all, v_all);
    }

    fn no_feedback(&self) -> Vec<T> {
        self.no_feedback.clone()
    }

    fn default_inputs(&self) -> Vec<T> {
        self.inputs.clone()
    }

    fn with_inputs<R>(&self, inputs: &mut Vec<T>, what: impl FnOnce(&mut [T]) -> R) -> R {
        what(inputs)
    }

    fn with_room<S: Scheme>(
        &self,
        what: impl FnOnce(&mut Room<'_, T>) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let info = self.mechanism.info();
        let mut numbers = vec![T::ZERO; Room::<T>::len(info, S::TABLEAU.stage_count())];
        what(&mut Room::within(&mut numbers, info))
    }

    fn events(&self, at: At<'_, T>, inputs: &Vec<T>, values: &mut [T]) {
        self.mechanism.events(at, inputs, values);
    }

    fn free_acceleration(
        &self,
        t: T,
        q: &Vec<T>,
        v: &Vec<T>,
        inputs: &Vec<T>,
        acceleration: &mut Vec<T>,
    ) -> T {
        let at = At { t, q, v };
        self.mechanism.constrained(at, inputs, &self.no_feedback, acceleration)
    }

    fn implicit(
        &self,
        t: T,
        [q, v]: [&Vec<T>; 2],
        inputs: &Vec<T>,
        (shift, predicted): (T, &Vec<T>),
        acceleration: &mut Vec<T>,
    ) -> T {
        self.mechanism.implicit(At { t, q, v }, inputs, shift, predicted, acceleration)
    }

    fn correction(&self, t: T, at: &Beside<'_, Vec<T>>, delta: &mut Vec<T>) -> T {
        let [mut q, mut v, mut all] = [(); 3].map(|()| self.start.1.clone());
        let mut violation = self.no_feedback.clone();
        let room = Correction { all: [&mut q, &mut v, &mut all], violation: &mut violation };
        correction(&*self.mechanism, t, at.q, at.v.map(Vec::as_slice), room, delta)
    }

    fn correction_along(&self, from: (T, &Vec<T>), t: T, q: &Vec<T>, delta: &mut Vec<T>) -> T {
        let [mut all, mut unread, mut correction] = [(); 3].map(|()| self.start.1.clone());
        let mut violation = self.no_feedback.clone();
        // positions do not depend on velocities
        self.mechanism.complete(At { t, q, v: q }, &mut all, &mut unread);
        self.mechanism.phi(t, &all, &mut violation);
        let (t, q) = from;
        self.mechanism.complete(At { t, q, v: q }, &mut all, &mut unread);
        let growth = self.mechanism.projection(t, &all, &violation, &mut correction);
        self.mechanism.states(&correction, delta);
        growth
    }
}
