//! Runs to a tolerance, and with a constant step of other methods than schemes, of mechanisms whose type is no longer known.
//!
//! Such runs are compiled once, here, for all types and texts. A type is behind its equations on slices, vectors are on the
//! heap, and what calls a run knows neither.

use mbs_analysis::{Driven, Trials};
use mbs_runtime::equations::{At, Described, Partials, Room};
use mbs_runtime::explicit::Beside;
use mbs_runtime::{
    Adaptive, AdaptiveScheme, ConstantStepBuilder, Dynamics, Error, Kernel, Mechanism, Method, MethodVisitor,
    Rattle, Real, Sampled, Scheme, SystemClone, Tolerances, TrBdf2, implicit, with_type,
};

use crate::of_type::OfType;
use crate::settings::{OtherMethod, Start, StartKind, StartState};
use crate::stages::Stages;

/// Starts a run to a tolerance with the scheme that is asked for, looked at in steps of the given length.
pub(crate) fn start(
    dynamics: Erased,
    tolerances: Tolerances,
    start: &Start,
) -> Result<Box<dyn SystemClone>, Error> {
    let started = Started { dynamics: driven(dynamics, start), tolerances, start };
    let (name, found) = match start.other {
        Some(OtherMethod::Implicit(scheme)) => (scheme.word, implicit::with_type(scheme, started)),
        _ => (start.method.tableau.word, with_type(start.method, started)),
    };
    found.unwrap_or(Err(Error::Scheme { name }))
}

/// Starts a run with a constant step of a method of another kind.
pub(crate) fn constant(
    dynamics: Erased,
    method: OtherMethod,
    start: &Start,
) -> Result<Box<dyn SystemClone>, Error> {
    let dynamics = driven(dynamics, start);
    match method {
        OtherMethod::Rattle(composition) => {
            begun(Rattle::builder(dynamics, start.step).composition(composition), start)
        }
        OtherMethod::Implicit(_) => begun(TrBdf2::builder(dynamics, start.step), start),
    }
}

/// Starts a run with a constant step of a scheme, with inputs from a table.
pub(crate) fn in_stages(dynamics: Erased, start: &Start) -> Result<Box<dyn SystemClone>, Error> {
    begun(ConstantStepBuilder::new(driven(dynamics, start), start.step, Stages::new(start)), start)
}

/// The mechanism with the inputs that change, and the time at which it starts.
fn driven(dynamics: Erased, start: &Start) -> Driven<Erased> {
    Driven::new(dynamics, start.table.clone()).starting_at(start.start_time)
}

fn begun<K>(
    builder: ConstantStepBuilder<Driven<Erased>, K>,
    start: &Start,
) -> Result<Box<dyn SystemClone>, Error>
where
    K: Kernel<Driven<Erased>> + Clone + 'static,
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

struct Started<'a> {
    dynamics: Driven<Erased>,
    tolerances: Tolerances,
    start: &'a Start,
}

impl MethodVisitor for Started<'_> {
    type Result = Result<Box<dyn SystemClone>, Error>;

    fn visit<X: Method>(self) -> Self::Result {
        self.with_scheme::<X::Scheme>()
    }
}

impl implicit::Visitor for Started<'_> {
    type Result = Result<Box<dyn SystemClone>, Error>;

    fn visit<S: AdaptiveScheme>(self) -> Self::Result {
        self.with_scheme::<S>()
    }
}

impl Started<'_> {
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

/// A mechanism of a type or of a text, of which runs need not know more. `T` is its scalar: `f64`, or [`Partials`] for
/// derivatives.
pub(crate) struct Erased<T = f64>(Box<dyn OnVectors<T>>);

impl<T: Real> Erased<T> {
    /// A mechanism whose vectors are on the heap, as those of texts.
    pub fn new<D>(dynamics: D) -> Self
    where
        D: Dynamics<Real = T, Coordinates = Vec<T>, States = Vec<T>, Constraints = Vec<T>, Inputs = Vec<T>>
            + 'static,
    {
        Self(Box::new(dynamics))
    }

    /// A mechanism of a type.
    pub fn of_type<M: Mechanism<Real = T>>(mechanism: M) -> Self {
        Self::new(OfType::new(mechanism))
    }
}

impl<T> Clone for Erased<T> {
    fn clone(&self) -> Self {
        Self(self.0.copied())
    }
}

/// [`Dynamics`] on vectors, without functions that know types.
trait OnVectors<T>: Send {
    fn copied(&self) -> Box<dyn OnVectors<T>>;
    fn described(&self) -> &dyn Described<T>;
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

impl<T: Real, D> OnVectors<T> for D
where
    D: Dynamics<Real = T, Coordinates = Vec<T>, States = Vec<T>, Constraints = Vec<T>, Inputs = Vec<T>>
        + 'static,
{
    fn copied(&self) -> Box<dyn OnVectors<T>> {
        Box::new(self.clone())
    }

    fn described(&self) -> &dyn Described<T> {
        Dynamics::described(self)
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

/// A vector of zeros; what a run computes with on the heap.
fn zeros<T: Real>(count: usize) -> Vec<T> {
    vec![T::ZERO; count]
}

impl<T: Real> Dynamics for Erased<T> {
    type Real = T;
    type Coordinates = Vec<T>;
    type States = Vec<T>;
    type Constraints = Vec<T>;
    type Inputs = Vec<T>;

    fn described(&self) -> &dyn Described<T> {
        self.0.described()
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
        zeros(self.0.described().info().constraints.len())
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
        let info = self.0.described().info();
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

/// Runs of a mechanism with derivatives, by what makes it from parameters.
pub(crate) fn trials(make: fn(&[Partials]) -> Result<Erased<Partials>, Error>) -> Box<dyn Trials + Sync> {
    Box::new(make)
}
