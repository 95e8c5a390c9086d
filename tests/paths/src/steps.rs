//! Runs that take the steps of a path.

use mbs_runtime::lanes::Lane;
use mbs_runtime::{Components, Error, Mechanism, Method, Pack, Real, Simulation, State};

use crate::Instant;

/// A run that takes the steps of a path.
pub trait Steps<M: Mechanism<Real = f64>> {
    fn advance(&mut self, steps: u64) -> Result<(), Error>;
    fn now(&self) -> Result<Instant<M>, Error>;
}

pub struct InStages<S: Mechanism, X: Method>(pub Simulation<S, X>);

impl<M: Mechanism<Real = f64>, S: Mechanism, X: Method> Steps<M> for InStages<S, X> {
    fn advance(&mut self, steps: u64) -> Result<(), Error> {
        (0..steps).try_for_each(|_| self.0.step_in_stages())
    }
    fn now(&self) -> Result<Instant<M>, Error> {
        Instant::of(&self.0)
    }
}

pub struct Fused<S: Mechanism, X: Method>(pub Simulation<S, X>);

impl<M: Mechanism<Real = f64>, S: Mechanism, X: Method> Steps<M> for Fused<S, X> {
    fn advance(&mut self, steps: u64) -> Result<(), Error> {
        (0..steps).try_for_each(|_| self.0.step())
    }
    fn now(&self) -> Result<Instant<M>, Error> {
        Instant::of(&self.0)
    }
}

/// The last lane is the one that is looked at.
pub struct InLanes<S: Mechanism<Real: Lane>, X: Method, const N: usize>(Pack<S, X, N>);

impl<M, S, X, const N: usize> Steps<M> for InLanes<S, X, N>
where
    M: Mechanism<Real = f64>,
    S: Mechanism<Real: Lane>,
    X: Method,
{
    fn advance(&mut self, steps: u64) -> Result<(), Error> {
        let mut taken = 0;
        while taken < steps {
            taken += self.0.advance(steps - taken);
            if taken < steps {
                self.step_apart()?;
                taken += 1;
            }
        }
        Ok(())
    }
    fn now(&self) -> Result<Instant<M>, Error> {
        Instant::of(&self.0.simulation(N - 1))
    }
}

impl<S: Mechanism<Real: Lane>, X: Method, const N: usize> InLanes<S, X, N> {
    /// In the last lane, beside neighbours that take shorter steps, each its own.
    pub fn beside_others(from: &Simulation<S, X>) -> Result<Self, Error> {
        let mut members = [*from; N];
        for (at, member) in members.iter_mut().rev().enumerate() {
            // shorter steps lead to the samples of clocks, too
            let share = match S::INFO.sampling.clocks {
                0 => 1.0 - at as f64 / 64.0,
                _ => 1.0 / (1.0 + at as f64),
            };
            *member = with_step(from, from.state(), share * from.step_size().to_f64())?;
        }
        Ok(Self(Pack::new(members)))
    }

    /// A step lane by lane; a neighbour that cannot make it starts again from here.
    fn step_apart(&mut self) -> Result<(), Error> {
        let healthy = self.0.step();
        if !healthy[N - 1] {
            return self.0.simulation(N - 1).step();
        }
        for lane in (0..N).filter(|&lane| !healthy[lane]) {
            self.0.copy(N - 1, lane);
        }
        Ok(())
    }
}

/// The same in another state, with steps of another length.
pub fn with_step<S: Mechanism, X: Method>(
    from: &Simulation<S, X>,
    state: State<S::Coordinates>,
    step: f64,
) -> Result<Simulation<S, X>, Error> {
    let builder = Simulation::builder(*from.mechanism(), step).baumgarte(*from.baumgarte());
    builder.from_state(state).inputs(unsampled(from)).as_declared().build()
}

/// The inputs of a run, with memories as they are declared: another run from its start takes the first samples anew.
fn unsampled<M: Mechanism, X: Method>(from: &Simulation<M, X>) -> M::Inputs {
    let (mut inputs, declared) = (from.inputs().into_array(), M::Inputs::default().into_array());
    let free = M::INFO.free_inputs().len();
    let memories = inputs.as_mut().iter_mut().zip(declared.as_ref()).skip(free);
    memories.for_each(|(memory, declared)| *memory = *declared);
    M::Inputs::from_array(inputs)
}

/// The same in single precision.
pub fn narrowed<M: Mechanism<Real = f64>, X: Method>(
    from: &Simulation<M, X>,
) -> Result<Simulation<M::Over<f32>, X>, Error> {
    let mechanism = <M::Over<f32>>::new(cast(*from.mechanism().parameters()))?;
    let State { t, q, v } = from.state();
    let builder = Simulation::builder(mechanism, from.step_size()).baumgarte(*from.baumgarte());
    let start = State { t: t as f32, q: cast(q), v: cast(v) };
    builder.from_state(start).inputs(cast(unsampled(from))).as_declared().build()
}

/// Component by component, rounded to the other scalar.
pub fn cast<A: Components, B: Components>(from: A) -> B {
    let mut to = B::splat(B::Real::default()).into_array();
    for (to, from) in to.as_mut().iter_mut().zip(from.into_array().as_ref()) {
        *to = B::Real::from_f64(from.to_f64());
    }
    B::from_array(to)
}
