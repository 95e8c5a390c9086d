//! Types and texts of mechanisms as one type on vectors, so that no run knows them.

use std::sync::Arc;

use mbs_runtime::equations::{At, Correction, Equations, Room, correction};
use mbs_runtime::explicit::Beside;
use mbs_runtime::{Components, Derivation, Dynamics, Error, Mechanism, Real, Scheme, Sketch, State};

/// A mechanism of a type or of a text, of which runs need not know more. `T` is its scalar: `f64`, or
/// [`Partials`](mbs_runtime::equations::Partials) for derivatives.
pub(crate) struct Erased<T = f64>(Box<dyn OnVectors<T>>);

impl<T: Real> Erased<T> {
    /// A mechanism whose vectors are on the heap already, such as that of a text.
    #[cfg(feature = "live")]
    pub fn new<D>(dynamics: D) -> Self
    where
        D: Dynamics<Real = T, Coordinates = Vec<T>, States = Vec<T>, Constraints = Vec<T>, Inputs = Vec<T>>
            + 'static,
    {
        Self(Box::new(dynamics))
    }

    /// A mechanism of a type.
    pub fn of_type<M: Mechanism<Real = T>>(mechanism: M) -> Self {
        Self(Box::new(OfType::new(mechanism)))
    }
}

impl<T> Clone for Erased<T> {
    fn clone(&self) -> Self {
        Self(self.0.copied())
    }
}

/// [`Dynamics`] on vectors, without functions that know types.
#[allow(clippy::ptr_arg, reason = "the vectors of `Dynamics`")]
trait OnVectors<T>: Send {
    fn copied(&self) -> Box<dyn OnVectors<T>>;
    fn equations(&self) -> &dyn Equations<T>;
    fn derivation(&self) -> &Derivation;
    fn sketch(&self) -> &Sketch;
    fn declared_start(&self) -> (T, Vec<T>, Vec<T>);
    fn states(&self, all: &Vec<T>) -> Vec<T>;
    fn complete(&self, t: T, q: &Vec<T>, v: &Vec<T>, all: &mut [Vec<T>; 2]);
    fn default_inputs(&self) -> Vec<T>;
    fn events(&self, at: At<'_, T>, inputs: &Vec<T>, values: &mut [T]);
    fn free_acceleration(&self, t: T, at: [&Vec<T>; 2], inputs: &Vec<T>, acceleration: &mut Vec<T>) -> T;
    fn implicit(
        &self,
        t: T,
        at: [&Vec<T>; 2],
        inputs: &Vec<T>,
        given: (T, &Vec<T>),
        acceleration: &mut Vec<T>,
    ) -> T;
    fn correction(&self, t: T, at: &Beside<'_, Vec<T>>, delta: &mut Vec<T>) -> T;
    fn correction_along(&self, from: (T, &Vec<T>), t: T, q: &Vec<T>, delta: &mut Vec<T>) -> T;
}

#[cfg(feature = "live")]
impl<T: Real, D> OnVectors<T> for D
where
    D: Dynamics<Real = T, Coordinates = Vec<T>, States = Vec<T>, Constraints = Vec<T>, Inputs = Vec<T>>
        + 'static,
{
    fn copied(&self) -> Box<dyn OnVectors<T>> {
        Box::new(self.clone())
    }

    fn equations(&self) -> &dyn Equations<T> {
        Dynamics::equations(self)
    }

    fn derivation(&self) -> &Derivation {
        Dynamics::derivation(self)
    }

    fn sketch(&self) -> &Sketch {
        Dynamics::sketch(self)
    }

    fn declared_start(&self) -> (T, Vec<T>, Vec<T>) {
        Dynamics::declared_start(self)
    }

    fn states(&self, all: &Vec<T>) -> Vec<T> {
        Dynamics::states(self, all)
    }

    fn complete(&self, t: T, q: &Vec<T>, v: &Vec<T>, all: &mut [Vec<T>; 2]) {
        Dynamics::complete(self, t, q, v, all);
    }

    fn default_inputs(&self) -> Vec<T> {
        Dynamics::default_inputs(self)
    }

    fn events(&self, at: At<'_, T>, inputs: &Vec<T>, values: &mut [T]) {
        Dynamics::events(self, at, inputs, values);
    }

    fn free_acceleration(&self, t: T, [q, v]: [&Vec<T>; 2], inputs: &Vec<T>, acceleration: &mut Vec<T>) -> T {
        Dynamics::free_acceleration(self, t, q, v, inputs, acceleration)
    }

    fn implicit(
        &self,
        t: T,
        at: [&Vec<T>; 2],
        inputs: &Vec<T>,
        given: (T, &Vec<T>),
        acceleration: &mut Vec<T>,
    ) -> T {
        Dynamics::implicit(self, t, at, inputs, given, acceleration)
    }

    fn correction(&self, t: T, at: &Beside<'_, Vec<T>>, delta: &mut Vec<T>) -> T {
        Dynamics::correction(self, t, at, delta)
    }

    fn correction_along(&self, from: (T, &Vec<T>), t: T, q: &Vec<T>, delta: &mut Vec<T>) -> T {
        Dynamics::correction_along(self, from, t, q, delta)
    }
}

/// A vector of zeros.
fn zeros<T: Real>(count: usize) -> Vec<T> {
    vec![T::ZERO; count]
}

impl<T: Real> Dynamics for Erased<T> {
    type Real = T;
    type Coordinates = Vec<T>;
    type States = Vec<T>;
    type Constraints = Vec<T>;
    type Inputs = Vec<T>;

    fn equations(&self) -> &dyn Equations<T> {
        self.0.equations()
    }

    fn derivation(&self) -> &Derivation {
        self.0.derivation()
    }

    fn sketch(&self) -> &Sketch {
        self.0.sketch()
    }

    fn declared_start(&self) -> (T, Vec<T>, Vec<T>) {
        self.0.declared_start()
    }

    fn states(&self, all: &Vec<T>) -> Vec<T> {
        self.0.states(all)
    }

    fn complete(&self, t: T, q: &Vec<T>, v: &Vec<T>, all: &mut [Vec<T>; 2]) {
        self.0.complete(t, q, v, all);
    }

    fn no_feedback(&self) -> Vec<T> {
        zeros(self.0.equations().info().constraints.len())
    }

    fn default_inputs(&self) -> Vec<T> {
        self.0.default_inputs()
    }

    fn with_inputs<R>(&self, inputs: &mut Vec<T>, what: impl FnOnce(&mut [T]) -> R) -> R {
        what(inputs)
    }

    fn with_room<S: Scheme>(
        &self,
        what: impl FnOnce(&mut Room<'_, T>) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let info = self.0.equations().info();
        let mut numbers = zeros(Room::<T>::len(info, S::TABLEAU.stage_count()));
        what(&mut Room::within(&mut numbers, info))
    }

    fn events(&self, at: At<'_, T>, inputs: &Vec<T>, values: &mut [T]) {
        self.0.events(at, inputs, values);
    }

    fn free_acceleration(
        &self,
        t: T,
        q: &Vec<T>,
        v: &Vec<T>,
        inputs: &Vec<T>,
        acceleration: &mut Vec<T>,
    ) -> T {
        self.0.free_acceleration(t, [q, v], inputs, acceleration)
    }

    fn implicit(
        &self,
        t: T,
        at: [&Vec<T>; 2],
        inputs: &Vec<T>,
        given: (T, &Vec<T>),
        acceleration: &mut Vec<T>,
    ) -> T {
        self.0.implicit(t, at, inputs, given, acceleration)
    }

    fn correction(&self, t: T, at: &Beside<'_, Vec<T>>, delta: &mut Vec<T>) -> T {
        self.0.correction(t, at, delta)
    }

    fn correction_along(&self, from: (T, &Vec<T>), t: T, q: &Vec<T>, delta: &mut Vec<T>) -> T {
        self.0.correction_along(from, t, q, delta)
    }
}

/// A mechanism of a type behind its equations on slices.
#[derive(Clone)]
struct OfType<T> {
    mechanism: Arc<dyn Equations<T> + Send + Sync>,
    derivation: &'static Derivation,
    sketch: &'static Sketch,
    start: (T, Vec<T>, Vec<T>),
    inputs: Vec<T>,
    no_feedback: Vec<T>,
}

impl<T: Real> OfType<T> {
    /// The mechanism, its type forgotten.
    fn new<M: Mechanism<Real = T>>(mechanism: M) -> Self {
        let numbers = |array: &dyn AsRef<[T]>| array.as_ref().to_vec();
        let State { t, q, v } = mechanism.declared_start();
        Self {
            start: (t, numbers(&q.into_array()), numbers(&v.into_array())),
            inputs: numbers(&M::Inputs::default().into_array()),
            no_feedback: vec![T::ZERO; M::INFO.constraints.len()],
            mechanism: Arc::new(mechanism),
            derivation: M::DERIVATION,
            sketch: M::SKETCH,
        }
    }
}

impl<T: Real> OnVectors<T> for OfType<T> {
    fn copied(&self) -> Box<dyn OnVectors<T>> {
        Box::new(self.clone())
    }

    fn equations(&self) -> &dyn Equations<T> {
        &*self.mechanism
    }

    fn derivation(&self) -> &Derivation {
        self.derivation
    }

    fn sketch(&self) -> &Sketch {
        self.sketch
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

    fn default_inputs(&self) -> Vec<T> {
        self.inputs.clone()
    }

    fn events(&self, at: At<'_, T>, inputs: &Vec<T>, values: &mut [T]) {
        self.mechanism.events(at, inputs, values);
    }

    fn free_acceleration(&self, t: T, [q, v]: [&Vec<T>; 2], inputs: &Vec<T>, acceleration: &mut Vec<T>) -> T {
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
