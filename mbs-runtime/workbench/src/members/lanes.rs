//! Members of a sweep in lanes, many to a vector instruction.

use std::marker::PhantomData;
use std::ops::Range;
use std::sync::atomic::AtomicBool;

use mbs_ensemble::lanes::{Lane, Lanes, ManyCoordinates, ManyOutputs, Snapshot, unpack};
use mbs_ensemble::{Cancelled, Ensemble, Observe};
use mbs_runtime::{Components, Explicit, Held, Mechanism, Method, State};

use super::extent::{Extent, Member};
use crate::settings::Start;
use crate::simulated::simulation;

/// Runs with constant inputs, many at once.
pub trait InLanes: Send + Sync {
    /// True if they can be those of a method.
    fn can_take(&self, method: Explicit) -> bool;

    /// Members to a vector instruction.
    fn width(&self) -> usize;

    /// Runs some members, and hands them over in order. Their values are in SI units.
    ///
    /// # Errors
    /// It was cancelled.
    fn run(&self, batch: &Batch<'_>, take: &mut dyn FnMut(usize, Member)) -> Result<(), Cancelled>;
}

/// Some members of a sweep.
pub struct Batch<'a> {
    /// The indices of the members.
    pub members: Range<usize>,
    /// The start of the member with an index.
    pub start: &'a (dyn Fn(usize) -> Start + Sync),
    /// When they end, in s.
    pub end: f64,
    /// Is called with how many of them are done, now and then.
    pub progress: &'a (dyn Fn(usize) + Sync),
    /// Ends them soon after it is set.
    pub cancel: &'a AtomicBool,
}

/// Those of a type that the compiler knew.
pub(crate) struct Typed<M>(pub PhantomData<M>);

impl<M: Mechanism<Real = f64>> InLanes for Typed<M> {
    // One method, because each takes some seconds to compile.
    fn can_take(&self, method: Explicit) -> bool {
        method == Held::<M::Scheme>::EXPLICIT
    }

    fn width(&self) -> usize {
        8
    }

    fn run(&self, batch: &Batch<'_>, take: &mut dyn FnMut(usize, Member)) -> Result<(), Cancelled> {
        let Batch { members, start, end, progress, cancel } = batch;
        let report = |done: usize, _: usize| progress(done);
        let ensemble = Ensemble::new(*end).progress(&report).cancelled_by(cancel);
        ensemble.for_each(
            members.len(),
            |at| simulation::<M, Held<M::Scheme>>(&start(members.start + at)),
            &Extents,
            |at, outcome| {
                let ended = |run: mbs_ensemble::Run<M, Vec<Extent>>| run.ended.map_or(Ok(run.observed), Err);
                take(members.start + at, outcome.and_then(ended));
            },
        )
    }
}

/// The coordinates of a state, the first `lines` of which are of bodies; of an own state its value.
#[inline(always)]
fn shown<C: Components>(State { q, v, .. }: State<C>, lines: usize) -> C {
    let (mut shown, states) = (q.into_array(), v.into_array());
    for (shown, state) in shown.as_mut().iter_mut().zip(states.as_ref()).skip(lines) {
        *shown = *state;
    }
    C::from_array(shown)
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

    /// The notes of a lane that cannot be looked at do not matter: its run has ended.
    #[inline(always)]
    fn observe<const N: usize>(&self, notes: &mut Self::Notes<N>, at: &Snapshot<'_, M, N>) -> [bool; N] {
        let (outputs, healthy) = at.outputs();
        notes.0.see(shown(at.state(), M::INFO.lines));
        notes.1.see(outputs);
        healthy
    }

    fn finish<const N: usize>(&self, notes: &Self::Notes<N>, lane: usize) -> Self::Result {
        let mut extents = notes.0.extents::<M::Coordinates>(lane);
        extents.extend(notes.1.extents::<M::Outputs>(lane));
        extents
    }
}
