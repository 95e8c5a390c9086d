//! Many runs of one mechanism that differ in parameters, reduced to what each of its
//! quantities was at least, at most and in the end.

use std::sync::atomic::{AtomicBool, Ordering};

use mbs_ensemble::lanes::{Lane, Lanes, ManyCoordinates, ManyOutputs, Snapshot, unpack};
use mbs_ensemble::{Cancelled, Ensemble, Observe};
use mbs_runtime::{Components, Feedback, Held, Info, Mechanism, PerStage, Quantity, Simulation};
use rayon::prelude::*;

use crate::model::{Start, coordinate_unit, output_unit, seen, step};
use crate::{Error, FeedbackKind, Settings};

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

/// Names, units and scales of what a sweep looks at: coordinates, then outputs.
pub fn quantities(info: &Info) -> Vec<(&'static str, String, f64)> {
    let coordinate = |q: &Quantity| (q.name, coordinate_unit(q), 1.0);
    let output = |q: &Quantity| (q.name, output_unit(q), q.scale);
    info.coordinates.iter().map(coordinate).chain(info.outputs.iter().map(output)).collect()
}

/// Runs them eight to a vector and on all cores, if their feedback is held.
pub(crate) fn in_lanes<M: Mechanism<Real = f64>>(
    settings: &Settings,
    members: Members<'_>,
) -> Result<(), Error> {
    if settings.feedback == FeedbackKind::PerStage {
        return one_by_one::<M>(settings, members);
    }
    let Members { names, count, values, take, progress, cancel } = members;
    let start = Start::<M, Held>::of(settings)?;
    check_names::<M>(&names)?;
    let scales = scales::<M>();
    let member = |index: usize| start.simulation(assigned::<M>(start.parameters, &names, &values(index)));
    let report = |done: usize, _: usize| progress(done);
    let ensemble = Ensemble::new(settings.end).progress(&report).cancelled_by(cancel);
    let taken = ensemble.for_each(count, member, &Extents, |index, outcome| {
        let outcome = outcome.and_then(|run| run.ended.map_or(Ok(run.observed), Err));
        take(index, outcome.map(|extents| scaled(&extents, &scales)));
    });
    taken.map_err(|Cancelled { finished }| interrupted(finished, count))
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
    let scales = scales::<M>();
    let member = |index: usize| {
        let simulation = start.simulation(assigned::<M>(start.parameters, &names, &values(index)))?;
        let extents = extents(simulation, settings.end, cancel)?;
        Ok(extents.map(|extents| scaled(&extents, &scales)))
    };
    let at_once = AT_ONCE * rayon::current_num_threads();
    for first in (0..count).step_by(at_once) {
        let last = count.min(first + at_once);
        let done: Option<Vec<Member>> =
            (first..last).into_par_iter().map(|index| member(index).transpose()).collect();
        let done = done.ok_or_else(|| interrupted(first, count))?;
        done.into_iter().enumerate().for_each(|(at, member)| take(first + at, member));
        progress(last);
    }
    Ok(())
}

/// Members that are computed before they are handed over.
const AT_ONCE: usize = 64;

fn interrupted(finished: usize, of: usize) -> Error {
    Error::Interrupted { finished, of, kept: String::new() }
}

/// `None` if it was cancelled.
fn extents<M: Mechanism<Real = f64>, F: Feedback>(
    mut simulation: Simulation<M, F>,
    end: f64,
    cancel: &AtomicBool,
) -> Result<Option<Vec<Extent>>, mbs_runtime::Error> {
    let steps = simulation.steps_to(end)?;
    let mut extents: Vec<Extent> = Vec::new();
    for taken in 0..=steps {
        if taken.is_multiple_of(1024) && cancel.load(Ordering::Relaxed) {
            return Ok(None);
        }
        let (q, outputs) = (simulation.state().q.into_array(), seen(&simulation)?.1.into_array());
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

fn scales<M: Mechanism>() -> Vec<f64> {
    quantities(M::INFO).into_iter().map(|(_, _, scale)| scale).collect()
}

fn scaled(extents: &[Extent], scales: &[f64]) -> Vec<Extent> {
    extents.iter().zip(scales).map(|(extent, scale)| extent.over(*scale)).collect()
}

impl Extent {
    fn see(&mut self, x: f64) {
        if x < self.low {
            self.low = x;
        }
        if x > self.high {
            self.high = x;
        }
        self.last = x;
    }

    fn over(self, scale: f64) -> Self {
        Self { low: self.low / scale, high: self.high / scale, last: self.last / scale }
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
        self.low = now.zip_map(self.low, |x, low| x.zip_map(low, |x, low| if x < low { x } else { low }));
        self.high =
            now.zip_map(self.high, |x, high| x.zip_map(high, |x, high| if x > high { x } else { high }));
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
