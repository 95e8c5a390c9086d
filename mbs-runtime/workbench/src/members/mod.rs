//! Many runs of one mechanism that differ in parameters, reduced to what each of its
//! quantities was at least, at most and in the end.
//!
//! Members run in lanes where a model has them: every text, and a type that is listed by `model::in_lanes`,
//! which costs compile time. Otherwise they run one by one on all cores. Ctrl-C ends a sweep and keeps the
//! finished members.

mod extent;
pub mod lanes;

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant as Clock};

use mbs_ensemble::Cancelled;
use mbs_runtime::{Info, Quantity, System};
use rayon::prelude::*;

pub use self::extent::{Extent, Member};
use self::lanes::Batch;
use crate::instant::Instant;
use crate::model::Model;
use crate::settings::{Settings, Start};
use crate::start::place;
use crate::{Error, Unit};

/// The members of a sweep, and where their results go.
pub struct Members<'a> {
    /// The parameters that differ.
    pub names: Vec<String>,
    /// The number of members.
    pub count: usize,
    /// The values of these parameters in SI units, for the member with an index.
    pub values: &'a (dyn Fn(usize) -> Vec<f64> + Sync),
    /// Is called with every member, in order.
    pub take: &'a mut dyn FnMut(usize, Member),
    /// Is called with the members that are done, now and then.
    pub progress: &'a (dyn Fn(usize) + Sync),
    /// Ends the sweep soon after it is set.
    pub cancel: &'a AtomicBool,
}

/// Names and units of what a sweep looks at: coordinates, own states, then outputs.
pub fn quantities(info: &Info) -> Vec<(&'static str, Unit)> {
    let (coordinates, states) = info.coordinates.split_at(info.lines.min(info.coordinates.len()));
    let coordinate = |q: &Quantity| (q.name, Unit::of_coordinate(q));
    let declared = |q: &Quantity| (q.name, Unit::of(q));
    coordinates.iter().map(coordinate).chain(states.iter().chain(info.outputs).map(declared)).collect()
}

impl dyn Model + '_ {
    /// Runs simulations that differ in parameters, on all cores, and in lanes where the
    /// mechanism has them for the method.
    ///
    /// # Errors
    /// Settings that the mechanism does not have or refuses; what happens to a
    /// member is no error here.
    pub fn sweep(&self, settings: &Settings, members: Members<'_>) -> Result<(), Error> {
        let info = self.info();
        let Members { names, count, values, take, progress, cancel } = members;
        let declared = Start::of(self, settings)?;
        for name in &names {
            place("parameter", info.parameters, name, &mut declared.parameters.clone())?;
        }
        let start = |index: usize| {
            let mut start = declared.clone();
            for (name, value) in names.iter().zip(values(index)) {
                if let Ok(parameter) = place("parameter", info.parameters, name, &mut start.parameters) {
                    *parameter = value;
                }
            }
            start
        };
        let units: Vec<Unit> = quantities(info).into_iter().map(|(_, unit)| unit).collect();
        let mut take = |index: usize, observed: Member| {
            let shown =
                |extents: Vec<Extent>| extents.iter().zip(&units).map(|(x, unit)| x.shown_in(unit)).collect();
            take(index, observed.map(shown));
        };
        // In lanes, inputs are constant, and all take the same step.
        let lanes = self.in_lanes().filter(|lanes| lanes.can_take(declared.method));
        let is_alike =
            settings.signals.is_none() && declared.tolerances.is_none() && settings.other.is_none();
        if let Some(lanes) = lanes.filter(|_| is_alike) {
            return in_batches(count, lanes.width() * rayon::current_num_threads(), |members| {
                let first = members.start;
                let progress: &(dyn Fn(usize) + Sync) = &|done| progress(first + done);
                let batch = Batch { members, start: &start, end: settings.end, progress, cancel };
                lanes
                    .run(&batch, &mut take)
                    .map_err(|Cancelled { finished }| interrupted(first + finished, count))
            });
        }
        let member = |index: usize| {
            let run = self.start(&start(index))?;
            extents(run, info, settings.end, cancel)
        };
        in_batches(count, rayon::current_num_threads(), |batch| {
            let (first, last) = (batch.start, batch.end);
            let done: Vec<Option<Member>> =
                batch.into_par_iter().map(|index| member(index).transpose()).collect();
            // Finished members are kept, even where a neighbour is not finished.
            let finished = first + done.iter().flatten().count();
            let members = done.into_iter().enumerate();
            members
                .filter_map(|(at, member)| Some((at, member?)))
                .for_each(|(at, member)| take(first + at, member));
            progress(finished);
            if finished < last { Err(interrupted(finished, count)) } else { Ok(()) }
        })
    }
}

/// The time that a batch should take: the work that an interruption may lose.
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
        let start = Clock::now();
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

/// Follows a run to its end; `None` if it was cancelled.
pub(crate) fn extents(
    mut run: Box<dyn System>,
    info: &Info,
    end: f64,
    cancel: &AtomicBool,
) -> Result<Option<Vec<Extent>>, mbs_runtime::Error> {
    let steps = run.ends_at(end)?;
    let mut now = Instant::new(info);
    let mut extents: Vec<Extent> = Vec::new();
    for taken in 0..=steps {
        if cancel.load(Ordering::Relaxed) {
            return Ok(None);
        }
        now.see(&*run);
        now.solve(&*run)?;
        now.measure(&*run)?;
        let coordinates = now.q.iter().zip(&now.v).enumerate();
        let coordinates = coordinates.map(|(at, (q, v))| if info.is_own(at) { *v } else { *q });
        Extent::see_all(&mut extents, coordinates.chain(now.outputs.iter().copied()));
        if taken < steps {
            run.step()?;
        }
    }
    Ok(Some(extents))
}
