//! The paths that a step can take: in stages, fused, in single precision, in lanes.
//! A case states what it compares once, and is held to it on each of them.

use mbs_runtime::lanes::Lane;
use mbs_runtime::{Components, Error, Feedback, Mechanism, Pack, Real, Simulation, State};

use crate::compare::Case;

/// What is compared in single precision.
#[derive(Clone, Copy)]
pub enum Single {
    /// Steps so many times as long, to tolerances wider by the square of that: Heun's
    /// method is of second order. Long enough, truncation outweighs rounding.
    Longer(f64),
    /// The same steps, where rounding is all that limits the agreement: tolerances
    /// wider by the ratio of both ε.
    Rounding,
    /// Nothing; the table in `main.rs` says why.
    LeftOut,
}

/// Makes `comparison` on every path, each from `start` with a step.
///
/// # Panics
/// If a number deviates.
pub fn through_every_path<M: Mechanism<Real = f64>, F: Feedback>(
    name: &str,
    step: f64,
    single: Single,
    start: impl Fn(f64) -> Result<Simulation<M, F>, Error>,
    comparison: impl Fn(&mut Case, &mut Run<M, F>) -> Result<(), Error>,
) -> Result<(), Error> {
    for path in paths() {
        let (step, widening) = match single {
            _ if !path.is_single => (step, 1.0),
            Single::Longer(factor) => (factor * step, factor * factor),
            Single::Rounding => (step, f64::from(f32::EPSILON) / f64::EPSILON),
            Single::LeftOut => continue,
        };
        let mut case = Case::new(&format!("{name}, {}", path.name)).widened(widening);
        comparison(&mut case, &mut Run::new(path, start(step)?)?)?;
        case.finish();
    }
    Ok(())
}

struct Path<M: Mechanism<Real = f64>, F: Feedback> {
    name: &'static str,
    is_single: bool,
    start: Start<M, F>,
}

type Start<M, F> = fn(&Simulation<M, F>) -> Result<Box<dyn Steps<M>>, Error>;

impl<M: Mechanism<Real = f64>, F: Feedback> Clone for Path<M, F> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M: Mechanism<Real = f64>, F: Feedback> Copy for Path<M, F> {}

fn paths<M: Mechanism<Real = f64>, F: Feedback>() -> [Path<M, F>; 7] {
    let double = |name, start| Path { name, is_single: false, start };
    let single = |name, start| Path { name, is_single: true, start };
    [
        double("in stages", |from| Ok(Box::new(InStages(*from)))),
        double("fused", |from| Ok(Box::new(Fused(*from)))),
        double("in 4 lanes", |from| Ok(Box::new(InLanes(packed::<_, _, 4>(from)?)))),
        double("in 8 lanes", |from| Ok(Box::new(InLanes(packed::<_, _, 8>(from)?)))),
        single("in single precision", |from| Ok(Box::new(Fused(narrowed(from)?)))),
        single("in 8 single lanes", |from| Ok(Box::new(InLanes(packed::<_, _, 8>(&narrowed(from)?)?)))),
        single("in 16 single lanes", |from| Ok(Box::new(InLanes(packed::<_, _, 16>(&narrowed(from)?)?)))),
    ]
}

/// A mechanism on a path.
pub struct Run<M: Mechanism<Real = f64>, F: Feedback> {
    path: Path<M, F>,
    from: Simulation<M, F>,
    steps: Box<dyn Steps<M>>,
    taken: u64,
}

impl<M: Mechanism<Real = f64>, F: Feedback> Run<M, F> {
    fn new(path: Path<M, F>, from: Simulation<M, F>) -> Result<Self, Error> {
        Ok(Self { path, from, steps: (path.start)(&from)?, taken: 0 })
    }

    /// As [`Simulation::advance_to`].
    pub fn advance_to(&mut self, end: f64) -> Result<(), Error> {
        let steps = self.from.steps_to(end)?.saturating_sub(self.taken);
        self.advance(steps)
    }

    fn advance(&mut self, steps: u64) -> Result<(), Error> {
        self.taken += steps;
        self.steps.advance(steps)
    }

    /// Where it is.
    pub fn now(&self) -> Result<Instant<M>, Error> {
        self.steps.now()
    }

    /// Steps until `value` changes sign, then repeats the last step with the length
    /// at which it vanishes: the event is met to rounding, whatever the step.
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
        let mut partial = Self::new(self.path, from)?;
        partial.advance(1)?;
        partial.now()
    }
}

/// A mechanism at an instant, whatever it was computed in.
pub struct Instant<M: Mechanism> {
    pub t: f64,
    pub q: M::Coordinates,
    pub v: M::Coordinates,
    pub acceleration: M::Coordinates,
    pub multipliers: M::Constraints,
    pub outputs: M::Outputs,
}

impl<M: Mechanism<Real = f64>> Instant<M> {
    fn of<S: Mechanism, F: Feedback>(run: &Simulation<S, F>) -> Result<Self, Error> {
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

/// What takes the steps.
trait Steps<M: Mechanism<Real = f64>> {
    fn advance(&mut self, steps: u64) -> Result<(), Error>;
    fn now(&self) -> Result<Instant<M>, Error>;
}

struct InStages<S: Mechanism, F: Feedback>(Simulation<S, F>);

impl<M: Mechanism<Real = f64>, S: Mechanism, F: Feedback> Steps<M> for InStages<S, F> {
    fn advance(&mut self, steps: u64) -> Result<(), Error> {
        (0..steps).try_for_each(|_| self.0.step_in_stages())
    }
    fn now(&self) -> Result<Instant<M>, Error> {
        Instant::of(&self.0)
    }
}

struct Fused<S: Mechanism, F: Feedback>(Simulation<S, F>);

impl<M: Mechanism<Real = f64>, S: Mechanism, F: Feedback> Steps<M> for Fused<S, F> {
    fn advance(&mut self, steps: u64) -> Result<(), Error> {
        (0..steps).try_for_each(|_| self.0.step())
    }
    fn now(&self) -> Result<Instant<M>, Error> {
        Instant::of(&self.0)
    }
}

/// The last lane is the one that is looked at.
struct InLanes<S: Mechanism<Real: Lane>, F: Feedback, const N: usize>(Pack<S, F, N>);

impl<M, S, F, const N: usize> Steps<M> for InLanes<S, F, N>
where
    M: Mechanism<Real = f64>,
    S: Mechanism<Real: Lane>,
    F: Feedback,
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

impl<S: Mechanism<Real: Lane>, F: Feedback, const N: usize> InLanes<S, F, N> {
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

/// Beside neighbours that take shorter steps, each its own.
fn packed<S: Mechanism<Real: Lane>, F: Feedback, const N: usize>(
    from: &Simulation<S, F>,
) -> Result<Pack<S, F, N>, Error> {
    let mut members = [*from; N];
    for (at, member) in members.iter_mut().rev().enumerate() {
        let share = 1.0 - at as f64 / 64.0;
        *member = with_step(from, *from.state(), share * from.step_size().to_f64())?;
    }
    Ok(Pack::new(members))
}

/// The same in another state, with steps of another length.
fn with_step<S: Mechanism, F: Feedback>(
    from: &Simulation<S, F>,
    state: State<S::Coordinates>,
    step: f64,
) -> Result<Simulation<S, F>, Error> {
    let builder = Simulation::builder(*from.mechanism(), step).baumgarte(*from.baumgarte());
    builder.from_state(state).inputs(*from.inputs()).as_declared().build()
}

/// The same in single precision.
fn narrowed<M: Mechanism<Real = f64>, F: Feedback>(
    from: &Simulation<M, F>,
) -> Result<Simulation<M::Over<f32>, F>, Error> {
    let mechanism = <M::Over<f32>>::new(cast(*from.mechanism().parameters()))?;
    let State { t, q, v } = *from.state();
    let builder = Simulation::builder(mechanism, from.step_size()).baumgarte(*from.baumgarte());
    let start = State { t: t as f32, q: cast(q), v: cast(v) };
    builder.from_state(start).inputs(cast(*from.inputs())).as_declared().build()
}

/// Component by component, rounded to the other scalar.
fn cast<A: Components, B: Components>(from: A) -> B {
    let mut to = B::splat(B::Real::default()).into_array();
    for (to, from) in to.as_mut().iter_mut().zip(from.into_array().as_ref()) {
        *to = B::Real::from_f64(from.to_f64());
    }
    B::from_array(to)
}
