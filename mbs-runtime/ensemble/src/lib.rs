//! Many parameter sets or initial states of one mechanism at once.
//!
//! The code that `mechanism!` generates is generic in its scalar. An
//! [`Ensemble`] runs it with [`Lanes`](mbs_runtime::Lanes): a block of eight members
//! takes a step with the instructions of one, blocks are spread over the cores,
//! and what is asked for is reduced while they run.
//!
//! # Example
//! ```
//! use mbs_ensemble::{Ensemble, Extremes};
//! use mbs_runtime::{Simulation, mechanism};
//!
//! mechanism! {
//!     /// A weight on a massless rod.
//!     pub Pendulum {
//!         dof = 1;
//!         param length = 1 [m] where length > 0;
//!         gravity = (0, -9.81) [m/s^2];
//!         body bob (x, y) { mass = 2 [kg]; }
//!         constraint rod: x^2 + y^2 = length^2;
//!         start { x = length; guess y = 0; }
//!         output tension [N] = 2*lambda(rod)*sqrt(x^2 + y^2);
//!     }
//! }
//!
//! // A member is a simulation that is ready to start, or why there is none.
//! let member = |index: usize| {
//!     let length = 0.5 + 0.01 * index as f64;
//!     Simulation::new(Pendulum::new(PendulumParameters { length })?, 1e-3)
//! };
//! let runs = Ensemble::new(1.0).run(100, member, &Extremes::default())?;
//! for run in &runs {
//!     let run = run.as_ref().expect("a start");
//!     assert_eq!((run.steps, run.ended), (1000, None));
//!     // dropped from the height of the hook: 3 m g at the bottom
//!     assert!((run.observed.high.tension - 2.0 * 3.0 * 9.81).abs() < 1e-2);
//! }
//! # Ok::<(), mbs_ensemble::Cancelled>(())
//! ```
//!
//! # What comes out
//!
//! Per member its final state, its steps, the error that ended it early if one
//! did, how many digits its worst step left, and what an [`Observe`]r made of its
//! states: [`Extremes`] of outputs, the largest [`Violation`]s, [`Samples`] of the
//! states, a pair of these, `()` for nothing, or an observer of your own.
//!
//! # Errors
//!
//! Members do not touch each other. One that cannot start, meets a singular
//! position or ceases to be finite ends with the [`Error`] that
//! its [`Simulation`] gives alone; its final state is that
//! of the last good step. The others go on.
//!
//! # Same digits
//!
//! In `f64` every member comes out bit for bit as its `Simulation` alone does,
//! whoever its neighbours are, whatever the number of threads, and on every
//! processor for which elementary functions other than sine and cosine come out
//! the same: vectors of any width round as scalars do, and no multiplication is
//! fused with an addition. Lanes do not compute sines of angles beyond 10⁹ rad: there a
//! block goes on lane after lane. In `f32` lanes, sines and cosines may
//! differ from those of the scalar in the last place.
//!
//! # Memory
//!
//! A block lives on the stack of its thread. Each member leaves a
//! [`Run`]: nothing grows with the number of steps, but for
//! [`Samples`]. [`Ensemble::for_each`] hands over members as they are finished, in
//! order, and so needs memory for a bounded number of them, however many there are.
//!
//! # Processors
//!
//! Which vector instructions there are is found out at run time, once a block: the
//! step is compiled for AVX-512, AVX2 and the baseline of the target. Systems with
//! more than 64 unknowns are too large to be inlined into a step; they are
//! compiled for the baseline alone.
#![deny(unsafe_code)]

mod block;
mod extremes;
mod observe;
mod samples;
mod violation;

pub use mbs_runtime::lanes;

pub use extremes::{Extremes, OfOutputs};
pub use observe::Observe;
pub use samples::Samples;
pub use violation::{OfConstraints, Violation};

use std::fmt;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use mbs_runtime::lanes::Lane;
use mbs_runtime::{Error, Mechanism, Method, Simulation, State, WorstPlace};
use rayon::prelude::*;

/// Blocks that are computed before their members are handed over.
const BLOCKS_PER_THREAD: usize = 64;

/// The end of all runs in s, and the settings of a sweep. `N` is the number of lanes, 8 by default.
///
/// # Example
/// Balls fall under different gravity:
/// ```
/// use std::sync::atomic::{AtomicUsize, Ordering};
///
/// use mbs_ensemble::Ensemble;
/// # use mbs_runtime::{Simulation, mechanism};
/// # mechanism! {
/// #     pub Fall {
/// #         dof = 1;
/// #         param g = 9.81 [m/s^2];
/// #         gravity = (0, -g);
/// #         body ball (y) { mass = 1 [kg]; }
/// #     }
/// # }
///
/// let member = |index: usize| Simulation::new(Fall::new(FallParameters { g: index as f64 })?, 1e-2);
/// let most = AtomicUsize::new(0);
/// let report = |done: usize, _all: usize| {
///     most.fetch_max(done, Ordering::Relaxed);
/// };
/// let runs = Ensemble::new(2.0).lanes::<4>().progress(&report).run(10, member, &())?;
/// assert_eq!(most.load(Ordering::Relaxed), 10);
/// for (index, run) in runs.into_iter().enumerate() {
///     // a member that could not start would be an error here
///     let run = run?;
///     // y = −g t²/2
///     assert!((run.state.q.y + 2.0 * index as f64).abs() < 1e-12);
///     assert_eq!((run.steps, run.ended), (200, None));
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy)]
pub struct Ensemble<'a, const N: usize = 8> {
    end: f64,
    cancel: Option<&'a AtomicBool>,
    progress: Option<&'a (dyn Fn(usize, usize) + Sync)>,
}

/// The end of a member's run; see the example of [`Ensemble`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run<M: Mechanism, R> {
    /// The last good state.
    pub state: State<M::Coordinates>,
    /// The steps that led to it.
    pub steps: u64,
    /// The error that ended it early.
    pub ended: Option<Error>,
    /// The digits that its worst step left; see [`Simulation::digits_left`].
    pub digits_left: f64,
    /// The place closest to a singular position, if the member lost more than two digits there;
    /// see [`Simulation::worst_place`].
    pub worst_place: Option<WorstPlace>,
    /// The result of the observer.
    pub observed: R,
}

/// The run of a member, or the error that kept it from starting. See the example of [`Ensemble`].
pub type Outcome<M, R> = Result<Run<M, R>, Error>;

/// The ensemble was stopped from outside; see [`Ensemble::cancelled_by`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cancelled {
    /// The members that were handed over before.
    pub finished: usize,
}

impl fmt::Display for Cancelled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "cancelled after {} members", self.finished)
    }
}

impl std::error::Error for Cancelled {}

impl Ensemble<'_> {
    /// Runs members to `end` seconds. See the example of [`Ensemble`].
    pub fn new(end: f64) -> Self {
        Self { end, cancel: None, progress: None }
    }
}

impl<'a, const N: usize> Ensemble<'a, N> {
    const HAS_LANES: () = assert!(N > 0, "an ensemble needs a lane");

    /// Sets the number of lanes: so many members take a step together. 8 suits `f64`, 16 `f32`. In `f64` the
    /// results are the same for every number. See the example of [`Ensemble`].
    #[must_use]
    pub fn lanes<const LANES: usize>(self) -> Ensemble<'a, LANES> {
        Ensemble { end: self.end, cancel: self.cancel, progress: self.progress }
    }

    /// Stops soon after the flag is set, from another thread or a signal.
    ///
    /// # Example
    /// ```
    /// # use mbs_ensemble::{Cancelled, Ensemble};
    /// # use mbs_runtime::{Simulation, mechanism};
    /// # mechanism! {
    /// #     /// A ball that falls.
    /// #     pub Fall {
    /// #         dof = 1;
    /// #         param g = 9.81 [m/s^2];
    /// #         gravity = (0, -g);
    /// #         body ball (y) { mass = 1 [kg]; }
    /// #         output height [m] = y;
    /// #     }
    /// # }
    /// use std::sync::atomic::{AtomicBool, Ordering};
    ///
    /// let flag = AtomicBool::new(false);
    /// let sweep = Ensemble::new(1.0).cancelled_by(&flag);
    /// // a member that asks for the end of all
    /// let member = |index: usize| {
    ///     flag.fetch_or(index == 3, Ordering::Relaxed);
    ///     Simulation::new(Fall::declared(), 1e-2)
    /// };
    /// assert_eq!(sweep.run(10, member, &()).err(), Some(Cancelled { finished: 0 }));
    /// ```
    #[must_use]
    pub fn cancelled_by(self, flag: &'a AtomicBool) -> Self {
        Self { cancel: Some(flag), ..self }
    }

    /// Reports progress: `report` is called with the number of members that are done and the number of all, on any
    /// thread and in no certain order. See the example of [`Ensemble`].
    #[must_use]
    pub fn progress(self, report: &'a (dyn Fn(usize, usize) + Sync)) -> Self {
        Self { progress: Some(report), ..self }
    }

    /// Runs members 0 … `count` − 1 on the threads of the current `rayon` pool. See the example of [`Ensemble`].
    ///
    /// # Errors
    /// [`Cancelled`]. Errors of members are in their [`Outcome`].
    pub fn run<M, X, O>(
        &self,
        count: usize,
        member: impl Fn(usize) -> Result<Simulation<M, X>, Error> + Sync,
        observer: &O,
    ) -> Result<Vec<Outcome<M, O::Result>>, Cancelled>
    where
        M: Mechanism<Real: Lane>,
        X: Method,
        O: Observe<M>,
    {
        let mut outcomes = Vec::with_capacity(count);
        self.for_each(count, member, observer, |_, outcome| outcomes.push(outcome))?;
        Ok(outcomes)
    }

    /// Runs members as [`run`](Self::run) does, and hands each one over instead of keeping it: `take` is called
    /// with indices in ascending order.
    ///
    /// # Example
    /// ```
    /// # use mbs_ensemble::Ensemble;
    /// # use mbs_runtime::{Simulation, mechanism};
    /// # mechanism! {
    /// #     /// A ball that falls.
    /// #     pub Fall {
    /// #         dof = 1;
    /// #         param g = 9.81 [m/s^2];
    /// #         gravity = (0, -g);
    /// #         body ball (y) { mass = 1 [kg]; }
    /// #         output height [m] = y;
    /// #     }
    /// # }
    /// let member = |index: usize| Simulation::new(Fall::new(FallParameters { g: index as f64 })?, 1e-2);
    /// // the sum of −g t²/2 over 0 … 99, without a list of runs
    /// let mut sum = 0.0;
    /// Ensemble::new(1.0).for_each(100, member, &(), |_, run| {
    ///     sum += run.map_or(f64::NAN, |run| run.state.q.y);
    /// })?;
    /// assert!((sum + 0.5 * 4950.0).abs() < 1e-9);
    /// # Ok::<(), mbs_ensemble::Cancelled>(())
    /// ```
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn for_each<M, X, O>(
        &self,
        count: usize,
        member: impl Fn(usize) -> Result<Simulation<M, X>, Error> + Sync,
        observer: &O,
        mut take: impl FnMut(usize, Outcome<M, O::Result>),
    ) -> Result<(), Cancelled>
    where
        M: Mechanism<Real: Lane>,
        X: Method,
        O: Observe<M>,
    {
        let () = Self::HAS_LANES;
        let done = AtomicUsize::new(0);
        let is_cancelled = || self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed));
        let run_block = |block: usize| {
            let members = block * N..count.min((block + 1) * N);
            let length = members.len();
            let outcomes = block::run::<M, X, O, N>(members, &member, observer, self.end, &is_cancelled)?;
            if let Some(report) = self.progress {
                report(done.fetch_add(length, Ordering::Relaxed) + length, count);
            }
            Some(outcomes)
        };
        let blocks = count.div_ceil(N);
        let at_once = BLOCKS_PER_THREAD * rayon::current_num_threads();
        let mut index = 0;
        for first in (0..blocks).step_by(at_once) {
            let last = blocks.min(first + at_once);
            let slots: Vec<_> = (first..last).map(|_| Mutex::new(None)).collect();
            in_parallel(slots.len(), &|at| {
                let outcomes = run_block(first + at);
                *slots[at].lock().unwrap_or_else(PoisonError::into_inner) = outcomes;
            });
            let outcomes: Option<Vec<_>> = slots
                .into_iter()
                .map(|slot| slot.into_inner().unwrap_or_else(PoisonError::into_inner))
                .collect();
            for block in outcomes.ok_or(Cancelled { finished: index })? {
                for outcome in block.into_iter().flatten() {
                    take(index, outcome);
                    index += 1;
                }
            }
        }
        Ok(())
    }
}

/// Calls `work` with 0 … `count` − 1 on the threads of the current pool. It knows no mechanism, so that threads are compiled once.
fn in_parallel(count: usize, work: &(dyn Fn(usize) + Sync)) {
    (0..count).into_par_iter().for_each(work);
}
