//! A run on a path.

use mbs_runtime::{Error, Mechanism, Method, Real, Simulation, State};

use crate::Start;
use crate::steps::{Steps, cast, with_step};

/// A mechanism on a path.
pub struct Run<M: Mechanism<Real = f64>, X: Method> {
    begin: Start<M, X>,
    from: Simulation<M, X>,
    steps: Box<dyn Steps<M>>,
    taken: u64,
}

impl<M: Mechanism<Real = f64>, X: Method> Run<M, X> {
    pub(crate) fn new(begin: Start<M, X>, from: Simulation<M, X>) -> Result<Self, Error> {
        Ok(Self { begin, from, steps: begin(&from)?, taken: 0 })
    }

    /// As [`Simulation::advance_to`].
    ///
    /// # Errors
    /// As there.
    pub fn advance_to(&mut self, end: f64) -> Result<(), Error> {
        let steps = self.from.steps_to(end)?.saturating_sub(self.taken);
        self.advance(steps)
    }

    /// Takes steps.
    ///
    /// # Errors
    /// As [`Simulation::step`].
    pub fn advance(&mut self, steps: u64) -> Result<(), Error> {
        self.taken += steps;
        self.steps.advance(steps)
    }

    /// Where it is.
    ///
    /// # Errors
    /// As [`Simulation::reactions`].
    pub fn now(&self) -> Result<Instant<M>, Error> {
        self.steps.now()
    }

    /// Steps until `value` changes sign, then repeats the last step with the length
    /// at which it vanishes: the event is met to rounding, whatever the step.
    ///
    /// # Errors
    /// As [`Simulation::step`].
    pub fn advance_to_zero(&mut self, value: impl Fn(&Instant<M>) -> f64) -> Result<Instant<M>, Error> {
        loop {
            let before = self.now()?;
            let sign = value(&before).signum();
            self.advance(1)?;
            if value(&self.now()?).signum() == sign {
                continue;
            }
            let shortened = |length: f64| self.one_step(&before, length);
            let (mut low, mut high) = (0.0, self.from.step_size());
            for _ in 0..50 {
                let middle = f64::midpoint(low, high);
                if value(&shortened(middle)?).signum() == sign { low = middle } else { high = middle }
            }
            return shortened(high);
        }
    }

    /// A step of another length, on the same path.
    fn one_step(&self, at: &Instant<M>, length: f64) -> Result<Instant<M>, Error> {
        let from = with_step(&self.from, at.state(), length)?;
        let mut partial = Self::new(self.begin, from)?;
        partial.advance(1)?;
        partial.now()
    }
}

/// A mechanism at an instant, whatever it was computed in.
pub struct Instant<M: Mechanism> {
    /// Time in s.
    pub t: f64,
    /// Positions.
    pub q: M::Coordinates,
    /// Velocities.
    pub v: M::Coordinates,
    /// Accelerations, without feedback.
    pub acceleration: M::Coordinates,
    /// Multipliers, without feedback.
    pub multipliers: M::Constraints,
    /// The declared outputs.
    pub outputs: M::Outputs,
}

impl<M: Mechanism<Real = f64>> Instant<M> {
    pub(crate) fn of<S: Mechanism, X: Method>(run: &Simulation<S, X>) -> Result<Self, Error> {
        let reactions = run.reactions()?;
        Ok(Self {
            t: run.time().to_f64(),
            q: cast(run.state().q),
            v: cast(run.state().v),
            acceleration: cast(reactions.acceleration),
            multipliers: cast(reactions.multipliers),
            outputs: cast(run.outputs()?),
        })
    }

    fn state(&self) -> State<M::Coordinates> {
        State { t: self.t, q: self.q, v: self.v }
    }
}
