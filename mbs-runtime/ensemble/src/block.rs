//! One block: as many members as there are lanes.
//!
//! Threads take blocks. A lane whose member has ended copies one that runs. An `Observe` reduces each run
//! while it goes, so memory does not grow with steps.
#![allow(clippy::needless_range_loop, reason = "lanes are counted through several arrays")]
#![allow(clippy::type_complexity, reason = "an outcome per lane, where there is one, unless cancelled")]

use std::array::from_fn;
use std::ops::Range;

use mbs_runtime::lanes::{Lane, Pack};
use mbs_runtime::{Components, Error, Lanes, Mechanism, Method, Real, Simulation};

use crate::{Observe, Outcome, Run};

/// Steps between two looks at the cancelling flag.
const STEPS_AT_ONCE: u64 = 256;

/// The outcomes of these members, at most `N`, in order, none of them `None`; or nothing if
/// cancelled.
pub fn run<M, X, O, const N: usize>(
    indices: Range<usize>,
    member: &(impl Fn(usize) -> Result<Simulation<M, X>, Error> + Sync),
    observer: &O,
    end: f64,
    is_cancelled: &dyn Fn() -> bool,
) -> Option<Vec<Option<Outcome<M, O::Result>>>>
where
    M: Mechanism<Real: Lane>,
    X: Method,
    O: Observe<M>,
{
    let members: Vec<Result<_, Error>> = indices.map(member).collect();
    let in_lane = |lane: usize| members.get(lane).and_then(|member| member.as_ref().ok());
    let steps_in = |lane: usize| in_lane(lane).and_then(|simulation| simulation.steps_to(end).ok());
    let mut runs: Vec<_> = members.iter().map(|_| None).collect();
    if let Some(filler) = members.iter().flatten().next() {
        let simulations = from_fn(|lane| in_lane(lane).unwrap_or(filler));
        Block::<_, _, _, N>::together(simulations, from_fn(steps_in), observer, is_cancelled, &mut runs)?;
    }
    for (member, run) in members.iter().zip(&mut runs) {
        if run.is_none() {
            *run = Some(match member {
                Ok(simulation) => alone(simulation, end, observer, is_cancelled)?,
                Err(error) => Err(*error),
            });
        }
    }
    Some(runs)
}

/// A member that left the range of the lanes, by itself from its start on; or why it cannot
/// come to the end.
fn alone<M, X, O>(
    simulation: &Simulation<M, X>,
    end: f64,
    observer: &O,
    is_cancelled: &dyn Fn() -> bool,
) -> Option<Outcome<M, O::Result>>
where
    M: Mechanism<Real: Lane>,
    X: Method,
    O: Observe<M>,
{
    let steps = match simulation.steps_to(end) {
        Ok(steps) => steps,
        Err(error) => return Some(Err(error)),
    };
    let mut run = [None];
    Block::together([simulation], [Some(steps)], observer, is_cancelled, &mut run)?;
    let [run] = run;
    Some(run.unwrap_or_else(|| Err(not_computable(simulation))))
}

struct Block<'a, M: Mechanism<Real: Lane>, X: Method, O: Observe<M>, const N: usize> {
    pack: Pack<M, X, N, &'a Simulation<M, X>>,
    observer: &'a O,
    notes: O::Notes<N>,
    /// The steps to go; `None` where nobody is running any more.
    left: [Option<u64>; N],
    runs: &'a mut [Option<Outcome<M, O::Result>>],
}

impl<'a, M: Mechanism<Real: Lane>, X: Method, O: Observe<M>, const N: usize> Block<'a, M, X, O, N> {
    /// Runs lanes with steps to go to their ends; `None` if cancelled. Without an outcome
    /// are then those that had none, and those that have to be run alone.
    fn together(
        simulations: [&'a Simulation<M, X>; N],
        left: [Option<u64>; N],
        observer: &'a O,
        is_cancelled: &dyn Fn() -> bool,
        runs: &'a mut [Option<Outcome<M, O::Result>>],
    ) -> Option<()> {
        let pack = Pack::new(simulations);
        let mut block = Block { pack, observer, notes: observer.begin(), left, runs };
        block.look();
        while let Some(steps) = block.steps_in_common() {
            if is_cancelled() {
                return None;
            }
            block.advance(steps.min(STEPS_AT_ONCE));
        }
        Some(())
    }

    /// How far all that are running can go together; ends those that are there.
    fn steps_in_common(&mut self) -> Option<u64> {
        for lane in 0..N {
            if self.left[lane] == Some(0) {
                self.end(lane, None);
            }
        }
        self.left.into_iter().flatten().min()
    }

    fn advance(&mut self, steps: u64) {
        let (taken, stop) = advance(&mut self.pack, self.observer, &mut self.notes, steps);
        self.count(taken, [true; N]);
        match stop {
            Stop::AllTaken => {}
            Stop::Stuck => {
                let moved = self.pack.step();
                self.count(1, moved);
                self.end_where_not(moved, |block, lane| block.pack.simulation(lane).step().err());
                self.look();
            }
            Stop::Unseen { seen } => self.end_unseen(seen),
        }
    }

    /// Counts steps of the lanes that have taken them.
    fn count(&mut self, steps: u64, moved: [bool; N]) {
        for (left, moved) in self.left.iter_mut().zip(moved) {
            if let (Some(left), true) = (left, moved) {
                *left = left.saturating_sub(steps);
            }
        }
    }

    /// Looks at the present states.
    fn look(&mut self) {
        let seen = self.observer.observe(&mut self.notes, &self.pack.snapshot());
        self.end_unseen(seen);
    }

    fn end_unseen(&mut self, seen: [bool; N]) {
        self.end_where_not(seen, |block, lane| unseen(&block.pack.simulation(lane)));
    }

    /// Ends lanes that are not in a mask, with what the scalar says is the cause. If
    /// it finds none, it can compute what lanes cannot.
    fn end_where_not(&mut self, mask: [bool; N], cause: impl Fn(&Self, usize) -> Option<Error>) {
        for lane in 0..N {
            if mask[lane] || self.left[lane].is_none() {
                continue;
            }
            match cause(self, lane) {
                Some(error) => self.end(lane, Some(error)),
                None if N == 1 => self.end(lane, Some(not_computable(&self.pack.simulation(lane)))),
                None => self.left[lane] = None,
            }
        }
        self.fill();
    }

    fn end(&mut self, lane: usize, ended: Option<Error>) {
        let observed = self.observer.finish(&self.notes, lane);
        let simulation = self.pack.simulation(lane);
        let run = Run {
            state: simulation.state(),
            steps: simulation.steps(),
            ended,
            digits_left: simulation.digits_left(),
            worst_place: simulation.worst_place(),
            observed,
        };
        self.left[lane] = None;
        if let Some(slot) = self.runs.get_mut(lane) {
            *slot = Some(Ok(run));
        }
    }

    /// Lanes that nobody needs any more do what one does that is still running, so
    /// that they hold nobody up.
    fn fill(&mut self) {
        let Some(running) = self.left.iter().position(Option::is_some) else { return };
        for lane in 0..N {
            if self.left[lane].is_none() {
                self.pack.copy(running, lane);
            }
        }
    }
}

/// Why a state could not be looked at: an output, or a violation, that is not finite.
fn unseen<M: Mechanism, X: Method>(simulation: &Simulation<M, X>) -> Option<Error> {
    let (mechanism, at) = (simulation.mechanism(), simulation.state());
    let t = at.t.to_f64();
    let not_finite = |what, rows: M::Constraints| {
        let mut rows = M::Constraints::NAMES.iter().zip(rows.into_array().as_ref().to_vec());
        rows.find(|(_, row)| !row.is_finite()).map(|(name, row)| Error::Undefined {
            t,
            what,
            name,
            value: row.to_f64(),
        })
    };
    let of_outputs = simulation.outputs().err();
    of_outputs
        .or_else(|| not_finite("the violation of constraint", mechanism.phi(at.t, &at.q)))
        .or_else(|| not_finite("the rate of constraint", mechanism.phi_dot(&at)))
}

/// The error for a healthy state in which an observer found no number.
fn not_computable<M: Mechanism, X: Method>(simulation: &Simulation<M, X>) -> Error {
    Error::NonFinite { t: simulation.time().to_f64(), coordinate: "what is observed" }
}

/// Why steps came to an end.
enum Stop<const N: usize> {
    AllTaken,
    /// Not every lane can make the next one, or not as a lane.
    Stuck,
    /// Not every lane could be looked at after the last one.
    Unseen {
        seen: [bool; N],
    },
}

/// Steps, each looked at, until one goes wrong; and how many were taken.
///
/// All that it calls is inlined, so that it is compiled for these targets too.
/// AVX-512 comes as a processor of any server has it, and without fused operations,
/// which nobody writes here: results do not depend on the target.
#[multiversion::multiversion(targets(
    "x86_64+avx+avx2+fma+avx512f+avx512dq+avx512vl+avx512bw+avx512cd",
    "x86_64+avx+avx2+fma",
))]
fn advance<M, X, O, const N: usize>(
    pack: &mut Pack<M, X, N, &Simulation<M, X>>,
    observer: &O,
    notes: &mut O::Notes<N>,
    steps: u64,
) -> (u64, Stop<N>)
where
    M: Mechanism<Real: Lane>,
    X: Method,
    O: Observe<M>,
{
    // Makes the compiler align its stack to 64 bytes: numbers that find no register
    // would lie across two lines of the cache.
    std::hint::black_box(&mut Lanes([0.0_f64; 8]));
    let mut seen = [true; N];
    let taken = if O::LOOKS {
        pack.advance_and_look(steps, |at| {
            seen = observer.observe(notes, at);
            seen == [true; N]
        })
    } else {
        pack.advance(steps)
    };
    let stop = match seen == [true; N] {
        false => Stop::Unseen { seen },
        true if taken < steps => Stop::Stuck,
        true => Stop::AllTaken,
    };
    (taken, stop)
}
