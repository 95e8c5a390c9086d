//! Runs to a tolerance, and with a constant step of other methods than schemes, of mechanisms whose type is no longer known.

use std::sync::Arc;

use mbs_runtime::equations::{At, Correction, Described, Equations, Room, correction};
use mbs_runtime::explicit::Beside;
use mbs_runtime::{
    Adaptive, Components, ConstantStepBuilder, Dynamics, Error, Kernel, Mechanism, Method, MethodVisitor,
    Rattle, Sampled, Scheme, State, System, Tolerances, TrBdf2, with_type,
};

use crate::settings::{ConstantMethod, Start, StartKind};

/// Starts a run with the scheme that is asked for, looked at in steps of the given length.
pub(crate) fn start<D>(dynamics: D, tolerances: Tolerances, start: &Start) -> Result<Box<dyn System>, Error>
where
    D: Dynamics<Real = f64, Inputs = Vec<f64>> + Send + 'static,
{
    let name = start.method.tableau.word;
    with_type(start.method, Started { dynamics, tolerances, start }).unwrap_or(Err(Error::Scheme { name }))
}

/// Starts a run with a constant step of a method of its own.
pub(crate) fn constant<D>(
    dynamics: D,
    method: ConstantMethod,
    start: &Start,
) -> Result<Box<dyn System>, Error>
where
    D: Dynamics<Real = f64, Inputs = Vec<f64>> + Send + 'static,
{
    match method {
        ConstantMethod::Rattle(composition) => {
            begun(Rattle::builder(dynamics, start.step).composition(composition), start)
        }
        ConstantMethod::TrBdf2 => begun(TrBdf2::builder(dynamics, start.step), start),
    }
}

fn begun<D, K>(builder: ConstantStepBuilder<D, K>, start: &Start) -> Result<Box<dyn System>, Error>
where
    D: Dynamics<Real = f64, Inputs = Vec<f64>> + Send + 'static,
    K: Kernel<D> + 'static,
{
    let mut builder = builder.inputs(start.inputs.clone());
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
    D: Dynamics<Real = f64, Inputs = Vec<f64>> + Send + 'static,
{
    type Result = Result<Box<dyn System>, Error>;

    fn visit<X: Method>(self) -> Self::Result {
        let Self { dynamics, tolerances, start } = self;
        let mut builder = Adaptive::builder(dynamics)
            .scheme::<X::Scheme>()
            .tolerances(tolerances)
            .inputs(start.inputs.clone());
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
/// all of them.
#[derive(Clone)]
pub(crate) struct Erased {
    mechanism: Arc<dyn Described<f64> + Send + Sync>,
    start: (f64, Vec<f64>, Vec<f64>),
    inputs: Vec<f64>,
    no_feedback: Vec<f64>,
}

impl Erased {
    /// The same mechanism, its type forgotten.
    pub fn new<M: Mechanism<Real = f64>>(mechanism: M) -> Self {
        let numbers = |array: &dyn AsRef<[f64]>| array.as_ref().to_vec();
        let State { t, q, v } = mechanism.declared_start();
        Self {
            start: (t, numbers(&q.into_array()), numbers(&v.into_array())),
            inputs: numbers(&M::Inputs::default().into_array()),
            no_feedback: vec![0.0; M::INFO.constraints.len()],
            mechanism: Arc::new(mechanism),
        }
    }
}

impl Dynamics for Erased {
    type Real = f64;
    type Coordinates = Vec<f64>;
    type States = Vec<f64>;
    type Constraints = Vec<f64>;
    type Inputs = Vec<f64>;

    fn equations(&self) -> &dyn Equations<f64> {
        &*self.mechanism
    }

    fn described(&self) -> &dyn Described<f64> {
        &*self.mechanism
    }

    fn declared_start(&self) -> (f64, Vec<f64>, Vec<f64>) {
        self.start.clone()
    }

    fn states(&self, all: &Vec<f64>) -> Vec<f64> {
        let mut states = vec![0.0; self.mechanism.info().states.len()];
        self.mechanism.states(all, &mut states);
        states
    }

    fn complete(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, [q_all, v_all]: &mut [Vec<f64>; 2]) {
        self.mechanism.complete(At { t, q, v }, q_all, v_all);
    }

    fn no_feedback(&self) -> Vec<f64> {
        self.no_feedback.clone()
    }

    fn default_inputs(&self) -> Vec<f64> {
        self.inputs.clone()
    }

    fn with_inputs<R>(&self, inputs: &mut Vec<f64>, what: impl FnOnce(&mut [f64]) -> R) -> R {
        what(inputs)
    }

    fn with_room<S: Scheme>(
        &self,
        what: impl FnOnce(&mut Room<'_, f64>) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let info = self.mechanism.info();
        let mut numbers = vec![0.0; Room::<f64>::len(info, S::TABLEAU.stage_count())];
        what(&mut Room::within(&mut numbers, info))
    }

    fn events(&self, at: At<'_, f64>, inputs: &Vec<f64>, values: &mut [f64]) {
        self.mechanism.events(at, inputs, values);
    }

    fn acceleration(
        &self,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        inputs: &Vec<f64>,
        acceleration: &mut Vec<f64>,
    ) -> f64 {
        self.mechanism.constrained(At { t, q, v }, inputs, &self.no_feedback, acceleration)
    }

    fn implicit(
        &self,
        t: f64,
        [q, v]: [&Vec<f64>; 2],
        inputs: &Vec<f64>,
        (shift, predicted): (f64, &Vec<f64>),
        acceleration: &mut Vec<f64>,
    ) -> f64 {
        self.mechanism.implicit(At { t, q, v }, inputs, shift, predicted, acceleration)
    }

    fn correction(&self, t: f64, at: &Beside<'_, Vec<f64>>, delta: &mut Vec<f64>) -> f64 {
        let [mut q, mut v, mut all] = [(); 3].map(|()| self.start.1.clone());
        let mut violation = self.no_feedback.clone();
        let room = Correction { all: [&mut q, &mut v, &mut all], violation: &mut violation };
        correction(&*self.mechanism, t, at.q, at.v.map(Vec::as_slice), room, delta)
    }

    fn correction_along(&self, from: (f64, &Vec<f64>), t: f64, q: &Vec<f64>, delta: &mut Vec<f64>) -> f64 {
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
