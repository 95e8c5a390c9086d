//! Runs to a tolerance, and with a constant step of other methods than schemes, of mechanisms whose type is no longer known.
//!
//! Such runs are compiled once for all types. A type is behind its equations on slices here, and vectors are
//! on the heap.

use std::sync::Arc;

use mbs_analysis::{Driven, Trials};
use mbs_runtime::equations::{At, Correction, Described, Partials, Room, correction};
use mbs_runtime::explicit::Beside;
use mbs_runtime::{
    Adaptive, AdaptiveScheme, Components, ConstantStepBuilder, Dynamics, Error, Kernel, Mechanism, Method,
    MethodVisitor, Rattle, Real, Sampled, Scheme, State, SystemClone, Tolerances, TrBdf2, implicit,
    with_type,
};

use crate::settings::{OtherMethod, Start, StartKind, StartState};
use crate::simulated::components;
use crate::stages::Stages;

/// Dynamics of which runs are made here: coordinates and inputs are vectors of `f64`. Every mechanism has this
/// form behind its equations on slices.
pub(crate) trait OnVectors:
    Dynamics<Real = f64, Coordinates = Vec<f64>, Inputs = Vec<f64>> + Clone + Send + 'static
{
}

impl<D> OnVectors for D where
    D: Dynamics<Real = f64, Coordinates = Vec<f64>, Inputs = Vec<f64>> + Clone + Send + 'static
{
}

/// Starts a run to a tolerance with the scheme that is asked for, looked at in steps of the given length.
pub(crate) fn start<D>(
    dynamics: D,
    tolerances: Tolerances,
    start: &Start,
) -> Result<Box<dyn SystemClone>, Error>
where
    D: OnVectors,
{
    let started = Started { dynamics: driven(dynamics, start), tolerances, start };
    let (name, found) = match start.other {
        Some(OtherMethod::Implicit(scheme)) => (scheme.word, implicit::with_type(scheme, started)),
        _ => (start.method.tableau.word, with_type(start.method, started)),
    };
    found.unwrap_or(Err(Error::Scheme { name }))
}

/// Starts a run with a constant step of a method of another kind.
pub(crate) fn constant<D>(
    dynamics: D,
    method: OtherMethod,
    start: &Start,
) -> Result<Box<dyn SystemClone>, Error>
where
    D: OnVectors,
{
    let dynamics = driven(dynamics, start);
    match method {
        OtherMethod::Rattle(composition) => {
            begun(Rattle::builder(dynamics, start.step).composition(composition), start)
        }
        OtherMethod::Implicit(_) => begun(TrBdf2::builder(dynamics, start.step), start),
    }
}

/// Starts a run with a constant step of a scheme, with inputs from a table.
pub(crate) fn in_stages<D>(dynamics: D, start: &Start) -> Result<Box<dyn SystemClone>, Error>
where
    D: OnVectors,
{
    begun(ConstantStepBuilder::new(driven(dynamics, start), start.step, Stages::new(start)), start)
}

/// The mechanism with the inputs that change, and the time at which it starts.
fn driven<D: Dynamics>(dynamics: D, start: &Start) -> Driven<D> {
    Driven::new(dynamics, start.table.clone()).starting_at(start.start_time)
}

fn begun<D, K>(builder: ConstantStepBuilder<D, K>, start: &Start) -> Result<Box<dyn SystemClone>, Error>
where
    D: OnVectors,
    K: Kernel<D> + Clone + 'static,
{
    let mut builder = builder.inputs(start.inputs.clone());
    if let Some(StartState { start_time, steps_taken, q, v }) = start.state.clone() {
        builder = builder.from_vectors(start_time, q, v).steps_taken(steps_taken);
    }
    if start.kind == StartKind::Declared {
        builder = builder.as_declared();
    }
    Ok(Box::new(builder.build()?))
}

struct Started<'a, D> {
    dynamics: D,
    tolerances: Tolerances,
    start: &'a Start,
}

impl<D> MethodVisitor for Started<'_, D>
where
    D: OnVectors,
{
    type Result = Result<Box<dyn SystemClone>, Error>;

    fn visit<X: Method>(self) -> Self::Result {
        self.with_scheme::<X::Scheme>()
    }
}

impl<D> implicit::Visitor for Started<'_, D>
where
    D: OnVectors,
{
    type Result = Result<Box<dyn SystemClone>, Error>;

    fn visit<S: AdaptiveScheme>(self) -> Self::Result {
        self.with_scheme::<S>()
    }
}

impl<D> Started<'_, D>
where
    D: OnVectors,
{
    fn with_scheme<S: AdaptiveScheme>(self) -> Result<Box<dyn SystemClone>, Error> {
        let Self { dynamics, tolerances, start } = self;
        let mut builder =
            Adaptive::builder(dynamics).scheme::<S>().tolerances(tolerances).inputs(start.inputs.clone());
        if let Some(StartState { start_time, steps_taken, q, v }) = start.state.clone() {
            builder = builder.from_vectors(start_time, q, v);
            builder = if steps_taken > 0 { builder.goes_on() } else { builder };
        }
        if start.kind == StartKind::Declared {
            builder = builder.as_declared();
        }
        let run = Sampled::new(builder.build()?, start.step)?;
        Ok(Box::new(match start.threshold {
            Some(threshold) => run.watching(threshold),
            None => run,
        }))
    }
}

/// A mechanism behind its equations on slices, so that runs to a tolerance are compiled once for
/// all of them. `T` is its scalar: `f64`, or [`Partials`] for derivatives.
#[derive(Clone)]
pub(crate) struct Erased<T = f64> {
    mechanism: Arc<dyn Described<T> + Send + Sync>,
    start: (T, Vec<T>, Vec<T>),
    inputs: Vec<T>,
    no_feedback: Vec<T>,
}

impl<T: Real> Erased<T> {
    /// The same mechanism, its type forgotten.
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

impl<T: Real> Dynamics for Erased<T> {
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

/// Runs of a type with derivatives.
pub(crate) fn trials<M: Mechanism<Real = f64>>() -> Box<dyn Trials + Sync> {
    let mechanism = |parameters: &[Partials]| M::Over::<Partials>::new(components(parameters));
    Box::new(move |parameters: &[Partials]| mechanism(parameters).map(Erased::new))
}
