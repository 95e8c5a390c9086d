//! Runs to a tolerance, and with a constant step of other methods than schemes, of mechanisms whose type is no longer known.
//!
//! Such runs are compiled once, here, for all types and texts. A type is behind its equations on slices, vectors are on the
//! heap, and what calls a run knows neither.

use mbs_analysis::{Driven, Trials};
use mbs_runtime::equations::Partials;
use mbs_runtime::{
    Adaptive, AdaptiveScheme, ConstantStepBuilder, Error, Kernel, Method, MethodVisitor, Rattle, Sampled,
    SystemClone, Tolerances, TrBdf2, implicit, with_type,
};

use crate::erased::Erased;
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
        // nothing more is compiled for a scheme without an estimate
        if const { S::ESTIMATE.is_none() } {
            return Err(Error::NoEstimate { scheme: S::WORD });
        }
        let Self { dynamics, tolerances, start } = self;
        let mut builder =
            Adaptive::builder(dynamics).scheme::<S>().tolerances(tolerances).inputs(start.inputs.clone());
        if let Some(StartState { start_time, steps_taken, q, v }) = start.state.clone() {
            builder = builder.from_vectors(start_time, q, v);
            builder = if steps_taken > 0 { builder.goes_on() } else { builder };
        }
        if start.is_looked_at {
            builder = builder.goes_on();
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

/// Runs of a mechanism with derivatives, by what makes it from parameters.
pub(crate) fn trials(make: fn(&[Partials]) -> Result<Erased<Partials>, Error>) -> Box<dyn Trials + Sync> {
    Box::new(make)
}
