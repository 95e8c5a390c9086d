//! Simulations of a known type from settings of any.

use mbs_runtime::{Baumgarte, Components, Error, Mechanism, Method, Simulation, State};

use crate::settings::{Start, StartKind, StartState};

/// A simulation of a known type.
pub(crate) fn simulation<M: Mechanism<Real = f64>, X: Method>(
    start: &Start,
) -> Result<Simulation<M, X>, Error> {
    let mut builder = Simulation::builder(M::new(components(&start.parameters))?, start.step)
        .baumgarte(Baumgarte::<X>::new(start.alpha, start.beta)?)
        .inputs(components(&start.inputs));
    if let Some(StartState { start_time, q, v, .. }) = &start.state {
        builder = builder.from_state(State { t: *start_time, q: components(q), v: components(v) });
    }
    if start.kind == StartKind::Declared {
        builder = builder.as_declared();
    }
    if start.allow_unstable {
        builder = builder.allow_unstable();
    }
    builder.build()
}

/// Components from as many numbers.
pub(crate) fn components<C: Components>(values: &[C::Real]) -> C {
    let mut array = C::splat(C::Real::default()).into_array();
    array.as_mut().iter_mut().zip(values).for_each(|(component, value)| *component = *value);
    C::from_array(array)
}
