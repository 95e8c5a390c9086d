//! Many runs of one mechanism that differ in parameters, reduced to what each of its
//! quantities was at least, at most and in the end.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use mbs_ensemble::lanes::{Lane, Lanes, ManyCoordinates, ManyOutputs, Snapshot, unpack};
use mbs_ensemble::{Cancelled, Ensemble, Observe};
use mbs_runtime::{Components, Feedback, Held, Info, Mechanism, PerStage, Quantity, Simulation};
use rayon::prelude::*;

use crate::model::{Start, seen, step};
use crate::signals::Player;
use crate::{Error, FeedbackKind, Settings, Unit};

/// What happens to the members of a sweep.
pub struct Members<'a> {
    /// The parameters that differ,
    pub names: Vec<String>,
    /// how many members there are,
    pub count: usize,
    /// and the values, in SI units, of the member with an index.
    pub values: &'a (dyn Fn(usize) -> Vec<f64> + Sync),
    /// Is called with every member, in order.
    pub take: &'a mut dyn FnMut(usize, Member),
    /// Is called with the members that are done, now and then.
    pub progress: &'a (dyn Fn(usize) + Sync),
    /// Ends the sweep soon after it is set.
    pub cancel: &'a AtomicBool,
}

/// What every quantity of [`quantities`] was, or why the run did not reach its end.
pub type Member = Result<Vec<Extent>, mbs_runtime::Error>;

/// Of a quantity, over all steps of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// The smallest value,
    pub low: f64,
    /// the largest,
    pub high: f64,
    /// and the one at the end.
    pub last: f64,
}

/// Names and units of what a sweep looks at: coordinates, then outputs.
pub fn quantities(info: &Info) -> Vec<(&'static str, Unit)> {
    let coordinate = |q: &Quantity| (q.name, Unit::of_coordinate(q));
    let output = |q: &Quantity| (q.name, Unit::of(q));
    info.coordinates.iter().map(coordinate).chain(info.outputs.iter().map(output)).collect()
}

/// Runs them eight to a vector and on all cores, if their feedback is held.
pub(crate) fn in_lanes<M: Mechanism<Real = f64>>(
    settings: &Settings,
    members: Members<'_>,
) -> Result<(), Error> {
    // An ensemble holds its inputs.
    if settings.feedback == FeedbackKind::PerStage || settings.signals.is_some() {
        return one_by_one::<M>(settings, members);
    }
    let Members { names, count, values, take, progress, cancel } = members;
    let start = Start::<M, Held>::of(settings)?;
    check_names::<M>(&names)?;
    let units = units::<M>();
    let member = |index: usize| start.simulation(assigned::<M>(start.parameters, &names, &values(index)));
    in_batches(count, LANES * rayon::current_num_threads(), |batch| {
        let first = batch.start;
        let report = |done: usize, _: usize| progress(first + done);
        let ensemble = Ensemble::new(settings.end).progress(&report).cancelled_by(cancel);
        let taken = ensemble.for_each(
            batch.len(),
            |at| member(first + at),
            &Extents,
            |at, outcome| {
                let outcome = outcome.and_then(|run| run.ended.map_or(Ok(run.observed), Err));
                take(first + at, outcome.map(|extents| shown(&extents, &units)));
            },
        );
        taken.map_err(|Cancelled { finished }| interrupted(first + finished, count))
    })
}

/// Runs them one by one on all cores: some times slower, and no code of its own to be
/// compiled.
pub(crate) fn one_by_one<M: Mechanism<Real = f64>>(
    settings: &Settings,
    members: Members<'_>,
) -> Result<(), Error> {
    match settings.feedback {
        FeedbackKind::Held => each::<M, Held>(settings, members),
        FeedbackKind::PerStage => each::<M, PerStage>(settings, members),
    }
}

fn each<M: Mechanism<Real = f64>, F: Feedback>(
    settings: &Settings,
    members: Members<'_>,
) -> Result<(), Error> {
    let Members { names, count, values, take, progress, cancel } = members;
    let start = Start::<M, F>::of(settings)?;
    check_names::<M>(&names)?;
    let units = units::<M>();
    let player = Player::of::<M>(settings)?;
    let member = |index: usize| {
        let simulation = start.simulation(assigned::<M>(start.parameters, &names, &values(index)))?;
        let extents = extents(simulation, player.as_ref(), settings.end, cancel)?;
        Ok(extents.map(|extents| shown(&extents, &units)))
    };
    in_batches(count, rayon::current_num_threads(), |batch| {
        let (first, last) = (batch.start, batch.end);
        let done: Vec<Option<Member>> =
            batch.into_par_iter().map(|index| member(index).transpose()).collect();
        // What is finished is kept, even where a neighbour is not.
        let finished = first + done.iter().flatten().count();
        let members = done.into_iter().enumerate();
        members
            .filter_map(|(at, member)| Some((at, member?)))
            .for_each(|(at, member)| take(first + at, member));
        progress(finished);
        if finished < last { Err(interrupted(finished, count)) } else { Ok(()) }
    })
}

/// Members to a vector instruction.
const LANES: usize = 8;
/// What an interruption may lose of the work.
const GRAIN: Duration = Duration::from_millis(500);

/// Runs members in batches that take about [`GRAIN`], at least `smallest` at once: what a
/// batch has computed is handed over, and safe, when it ends.
fn in_batches(
    count: usize,
    smallest: usize,
    mut run: impl FnMut(Range<usize>) -> Result<(), Error>,
) -> Result<(), Error> {
    let (mut first, mut at_once) = (0, smallest.max(1));
    while first < count {
        let last = count.min(first + at_once);
        let start = Instant::now();
        run(first..last)?;
        let took = start.elapsed();
        if took < GRAIN / 2 {
            at_once *= 2;
        } else if took > GRAIN {
            at_once = (at_once / 2).max(smallest.max(1));
        }
        first = last;
    }
    Ok(())
}

fn interrupted(finished: usize, of: usize) -> Error {
    Error::Interrupted { finished, of, kept: String::new() }
}

/// `None` if it was cancelled.
fn extents<M: Mechanism<Real = f64>, F: Feedback>(
    mut simulation: Simulation<M, F>,
    player: Option<&Player<'_>>,
    end: f64,
    cancel: &AtomicBool,
) -> Result<Option<Vec<Extent>>, mbs_runtime::Error> {
    let steps = simulation.steps_to(end)?;
    let mut extents: Vec<Extent> = Vec::new();
    for taken in 0..=steps {
        if taken.is_multiple_of(1024) && cancel.load(Ordering::Relaxed) {
            return Ok(None);
        }
        if let Some(player) = player {
            player.set(&mut simulation);
        }
        let outputs = seen(&simulation)?.1;
        if !outputs.is_finite() {
            // names the first that is no number
            simulation.outputs()?;
        }
        let (q, outputs) = (simulation.state().q.into_array(), outputs.into_array());
        let now = q.as_ref().iter().chain(outputs.as_ref());
        if taken == 0 {
            extents.extend(now.map(|&x| Extent { low: x, high: x, last: x }));
        } else {
            extents.iter_mut().zip(now).for_each(|(extent, &x)| extent.see(x));
        }
        if taken < steps {
            step(&mut simulation)?;
        }
    }
    Ok(Some(extents))
}

fn check_names<M: Mechanism>(names: &[String]) -> Result<(), Error> {
    let known = M::Parameters::NAMES;
    match names.iter().find(|name| !known.contains(&name.as_str())) {
        Some(unknown) => Err(Error::unknown("parameter", unknown, known.iter().copied())),
        None => Ok(()),
    }
}

fn assigned<M: Mechanism<Real = f64>>(
    declared: M::Parameters,
    names: &[String],
    values: &[f64],
) -> M::Parameters {
    let assigned = names.iter().zip(values);
    assigned.fold(declared, |parameters, (name, value)| parameters.with(name, *value).unwrap_or(parameters))
}

fn units<M: Mechanism>() -> Vec<Unit> {
    quantities(M::INFO).into_iter().map(|(_, unit)| unit).collect()
}

fn shown(extents: &[Extent], units: &[Unit]) -> Vec<Extent> {
    extents.iter().zip(units).map(|(extent, unit)| extent.shown_in(unit)).collect()
}

impl Extent {
    fn see(&mut self, x: f64) {
        // NaN stays.
        if x < self.low || x.is_nan() {
            self.low = x;
        }
        if x > self.high || x.is_nan() {
            self.high = x;
        }
        self.last = x;
    }

    fn shown_in(self, unit: &Unit) -> Self {
        let Self { low, high, last } = self;
        Self { low: unit.shown(low), high: unit.shown(high), last: unit.shown(last) }
    }
}

/// Observes [`Extent`]s.
struct Extents;

/// Those of some components in all lanes.
struct Of<C> {
    low: C,
    high: C,
    last: C,
}

impl<T: Lane, C: Components<Real = Lanes<T, N>>, const N: usize> Of<C> {
    fn none() -> Self {
        let all = |x: f64| C::splat(Lanes([T::from_f64(x); N]));
        Self { low: all(f64::INFINITY), high: all(f64::NEG_INFINITY), last: all(f64::NAN) }
    }

    #[inline(always)]
    fn see(&mut self, now: C) {
        // NaN stays.
        #[allow(clippy::eq_op, reason = "what is not equal to itself is NaN, in lanes too")]
        let least = |x: T, low: T| if x < low || x != x { x } else { low };
        #[allow(clippy::eq_op, reason = "as above")]
        let most = |x: T, high: T| if x > high || x != x { x } else { high };
        self.low = now.zip_map(self.low, |x, low| x.zip_map(low, least));
        self.high = now.zip_map(self.high, |x, high| x.zip_map(high, most));
        self.last = now;
    }

    fn extents<S: Components<Real = T>>(&self, lane: usize) -> Vec<Extent> {
        let of = |components: C| unpack::<S, _, _, N>(components, lane).into_array();
        let (low, high, last) = (of(self.low), of(self.high), of(self.last));
        let all = low.as_ref().iter().zip(high.as_ref()).zip(last.as_ref());
        all.map(|((low, high), last)| Extent { low: low.to_f64(), high: high.to_f64(), last: last.to_f64() })
            .collect()
    }
}

impl<M: Mechanism<Real: Lane>> Observe<M> for Extents {
    type Notes<const N: usize> = (Of<ManyCoordinates<M, N>>, Of<ManyOutputs<M, N>>);
    type Result = Vec<Extent>;

    fn begin<const N: usize>(&self) -> Self::Notes<N> {
        (Of::none(), Of::none())
    }

    /// What a lane that cannot be looked at leaves in its notes does not matter: its
    /// run has ended.
    #[inline(always)]
    fn observe<const N: usize>(&self, notes: &mut Self::Notes<N>, at: &Snapshot<'_, M, N>) -> [bool; N] {
        let (outputs, healthy) = at.outputs();
        notes.0.see(at.state().q);
        notes.1.see(outputs);
        healthy
    }

    fn finish<const N: usize>(&self, notes: &Self::Notes<N>, lane: usize) -> Self::Result {
        let mut extents = notes.0.extents::<M::Coordinates>(lane);
        extents.extend(notes.1.extents::<M::Outputs>(lane));
        extents
    }
}
