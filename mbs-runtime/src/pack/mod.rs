//! Several simulations of one mechanism that advance together.
#![allow(
    clippy::needless_range_loop,
    reason = "the compiler makes vectors of loops over indices, not of iterators over arrays"
)]

mod instances;
mod long;
mod snapshot;

use core::array::from_fn;
use core::borrow::Borrow;
use core::marker::PhantomData;

pub use instances::unpack;
pub use snapshot::{Snapshot, and};

use crate::components::sum_of;
use crate::explicit::{Span, Trial, trial_in_place};
use crate::lanes::{Lane, Lanes};
use crate::mechanism::is_fused_for;
use crate::straight::Straight;
use crate::watch::Watch;
use crate::{Components, Mechanism, Method, Real, Simulation, State, spare};
use instances::{Instances, Moment, Pace, push, sample, steps_to_sample, strike};
use long::{lane_after_lane, step_in_place};

/// The mechanism `M` over `N` lanes of its own scalar.
pub type Many<M, const N: usize> = <M as Mechanism>::Over<Lanes<<M as Mechanism>::Real, N>>;

/// The mechanism `M` in a loop over lanes.
type Each<M> = <M as Mechanism>::Over<Straight<<M as Mechanism>::Real>>;

/// The coordinates of `N` instances.
pub type ManyCoordinates<M, const N: usize> = <Many<M, N> as Mechanism>::Coordinates;

/// The coordinates of `N` instances that are integrated.
pub type ManyStates<M, const N: usize> = <Many<M, N> as Mechanism>::States;

/// The outputs of `N` instances.
pub type ManyOutputs<M, const N: usize> = <Many<M, N> as Mechanism>::Outputs;

/// How many steps are tested for health together: at first, by what factor the number rises from
/// one test to the next, and at most. A test costs about as much as a step. Where one step of them
/// has to be examined, up to twice as many are computed in vain. That is why the number begins
/// small: the first step of a long chain is examined.
const FIRST_STRIDE: u64 = 4;
const LENGTHENING: u64 = 4;
const LONGEST_STRIDE: u64 = 1024;

/// `N` simulations that advance by a step at once, one in each lane: parameters,
/// inputs, states, gains, steps and times are their own.
///
/// In `f64` a lane does what its [`Simulation`] would do alone, bit for bit; in `f32`
/// within what [`Lanes`] says. A lane that cannot make a step stays where it is and
/// does not touch the others.
///
/// # Example
/// ```
/// use mbs_runtime::{Pack, Simulation, mechanism};
///
/// mechanism! {
///     /// A weight on a massless rod.
///     pub Pendulum {
///         dof = 1;
///         param length = 1 [m];
///         gravity = (0, -9.81) [m/s^2];
///         body bob (x, y) { mass = 2 [kg]; }
///         constraint rod: x^2 + y^2 = length^2;
///         start { x = length; guess y = 0; }
///     }
/// }
///
/// let lengths = [0.5, 1.0, 1.5, 2.0];
/// let mut alone = [Simulation::new(Pendulum::declared(), 1e-3)?; 4];
/// for (run, length) in alone.iter_mut().zip(lengths) {
///     *run = Simulation::new(Pendulum::new(PendulumParameters { length })?, 1e-3)?;
/// }
/// let mut pack = Pack::new(alone);
/// for _ in 0..500 {
///     assert_eq!(pack.step(), [true; 4]);
/// }
/// alone[2].advance_to(0.5)?;
/// assert_eq!(pack.simulation(2).state(), alone[2].state());
///
/// // borrowed, which spares copies of them
/// let mut pair = Pack::new([&alone[0], &alone[3]]);
/// pair.step();
/// assert_eq!((pair.steps(1), alone[3].steps()), (1, 0));
/// # Ok::<(), mbs_runtime::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct Pack<M: Mechanism<Real: Lane>, X: Method, const N: usize, S = Simulation<M, X>> {
    /// As they were packed.
    members: [S; N],
    instances: Instances<M, N>,
    pace: Pace<M::Real, N>,
    now: Moment<M, N>,
    /// The watches of the members. Of all steps, only those of [`step_each`](Self::step_each)
    /// change them.
    watches: [Watch<M::Real>; N],
    feedback: PhantomData<X>,
}

impl<M, X, const N: usize, S> Pack<M, X, N, S>
where
    M: Mechanism<Real: Lane>,
    X: Method,
    S: Borrow<Simulation<M, X>> + Copy,
{
    /// The simulations, each from where it is.
    #[inline]
    pub fn new(members: [S; N]) -> Self {
        const { assert!(N > 0, "a pack needs a lane") };
        let each = from_fn(|lane| members[lane].borrow());
        let (instances, pace, now) = (Instances::of(each), Pace::of(each), Moment::of(each));
        Self {
            members,
            instances,
            pace,
            now,
            watches: each.map(|member| *member.watch()),
            feedback: PhantomData,
        }
    }

    /// Advances every lane by a step; `true` for those that did. For another one, a step of
    /// [`simulation`](Self::simulation) gives the reason.
    pub fn step(&mut self) -> [bool; N] {
        if self.stride(1) { [true; N] } else { self.step_each() }
    }

    /// Advances all lanes together by up to a number of steps, and says by how many: up
    /// to one before one that not every lane can make, or not with what lanes can compute.
    ///
    /// Steps are tested for health many at a time. That misses nothing: what has ceased to
    /// be finite stays so, because a step adds to what there is, and the worst growth and
    /// its steepest rise are kept. Where something has gone wrong, bisection finds the steps before.
    #[inline(always)]
    pub fn advance(&mut self, steps: u64) -> u64 {
        let (mut taken, mut good) = (0, steps);
        let mut stride = FIRST_STRIDE;
        while taken < good {
            let next = stride.min(good - taken).min(steps_to_sample(&self.members, &self.now));
            if self.stride(next) {
                taken += next;
            } else {
                // one of them is bad
                good = taken + next - 1;
            }
            let is_longer = good == steps;
            stride =
                if is_longer { LONGEST_STRIDE.min(LENGTHENING * stride) } else { (good - taken).div_ceil(2) };
        }
        taken
    }

    /// The same, a step at a time, up to one after which `look` does not want more.
    #[inline(always)]
    pub fn advance_and_look(&mut self, steps: u64, mut look: impl FnMut(&Snapshot<'_, M, N>) -> bool) -> u64 {
        let Self { members, instances, pace, watches, .. } = self;
        let mut now = self.now;
        let mut taken = 0;
        while taken < steps {
            let mut next = now;
            let Some(pushed) = push(members, instances, &mut next) else { break };
            let mut margin = Lanes::default();
            step_all::<M, X, N>(instances, pace, watches, 1.0, &mut next, &mut margin);
            next.count(1.0);
            if !is_calm(&margin, &next, watches) {
                break;
            }
            if !strike(members, instances, &now, (&pushed, &mut next)) {
                break;
            }
            now = next;
            taken += 1;
            sample(members, instances, &now);
            if !look(&Snapshot { instances, moment: &now }) {
                break;
            }
        }
        self.now = now;
        taken
    }

    /// Advances by a number of steps, if all of them are good.
    ///
    /// In this loop the numbers are nobody else's, so they can stay in registers.
    #[inline(always)]
    fn stride(&mut self, steps: u64) -> bool {
        let Self { members, instances, pace, watches, .. } = self;
        let mut now = self.now;
        let Some(pushed) = push(members, instances, &mut now) else { return false };
        let mut margin = Lanes::default();
        if const { !is_fused_for::<M, X>() } && is_in_loops::<M>() {
            lane_after_lane::<M, X, S, N>(members, instances, watches, steps, &mut now, &mut margin);
        } else {
            // a float, because the conversion of an integer would take as long as ten operations
            let mut taken = 0.0;
            for _ in 0..steps {
                taken += 1.0;
                step_all::<M, X, N>(instances, pace, watches, taken, &mut now, &mut margin);
            }
        }
        now.count(steps as f64);
        let are_calm = is_calm(&margin, &now, watches)
            && strike(&self.members, &mut self.instances, &self.now, (&pushed, &mut now));
        if are_calm {
            self.now = now;
            sample(&self.members, &mut self.instances, &now);
        }
        are_calm
    }

    /// A step lane after lane, with all that a scalar can compute.
    #[cold]
    #[inline(never)]
    fn step_each(&mut self) -> [bool; N] {
        let mut members = from_fn(|lane| self.simulation(lane));
        let healthy = members.each_mut().map(|member| member.step().is_ok());
        self.now = Moment::of(members.each_ref());
        self.instances.take_memories(members.each_ref());
        self.watches = members.each_ref().map(|member| *member.watch());
        healthy
    }

    /// Puts a copy of what is in one lane into another; beyond the last lane, the last one
    /// is meant.
    pub fn copy(&mut self, from: usize, to: usize) {
        let (from, to) = (from.min(N - 1), to.min(N - 1));
        let mut now = self.now;
        now.copy(from, to);
        let (mut members, mut watches) = (self.members, self.watches);
        members[to] = members[from];
        watches[to] = watches[from];
        let inputs = self.instances.inputs;
        *self = Self { now, watches, ..Self::new(members) };
        self.instances.inputs = inputs;
        self.instances.copy_inputs(from, to);
    }

    /// The simulation in a lane, as it is now: the last one, beyond the last lane.
    pub fn simulation(&self, lane: usize) -> Simulation<M, X> {
        let lane = lane.min(N - 1);
        let watch = self.watches[lane].after_calm_steps(self.now.alarm.0[lane], self.now.worst.0[lane]);
        let at = (self.now.scalar_state(lane), self.instances.scalar_inputs(lane));
        self.members[lane].borrow().moved_to(at, self.steps(lane), watch)
    }

    /// Time, positions and velocities in a lane: the last one, beyond the last lane.
    #[inline]
    pub fn state(&self, lane: usize) -> State<M::Coordinates> {
        let lane = lane.min(N - 1);
        self.members[lane].borrow().mechanism().complete(&self.now.scalar_state(lane))
    }

    /// Steps since the start in a lane: the last one, beyond the last lane.
    #[inline]
    pub fn steps(&self, lane: usize) -> u64 {
        self.now.steps.0[lane.min(N - 1)] as u64
    }

    /// All lanes as they are now, to be observed.
    #[inline(always)]
    pub fn snapshot(&self) -> Snapshot<'_, M, N> {
        Snapshot { instances: &self.instances, moment: &self.now }
    }
}

/// A step of every lane, with the time after as many steps as `now` does not count yet.
/// `margin` keeps the worst distance of a growth from its alarm: as a magnitude, to which
/// a growth over the alarm gives a minus sign.
///
/// The scalar's step in a loop over lanes: compilers make better vectors of that than
/// of a step of which every operation is a loop.
#[inline(always)]
fn step_all<M: Mechanism<Real: Lane>, X: Method, const N: usize>(
    instances: &Instances<M, N>,
    pace: &Pace<M::Real, N>,
    watches: &[Watch<M::Real>; N],
    uncounted: f64,
    now: &mut Moment<M, N>,
    margin: &mut Lanes<M::Real, N>,
) {
    if const { N > 1 && !is_fused_for::<M, X>() } && !is_in_loops::<M>() {
        step_together::<M, X, N>(instances, pace, watches, uncounted, now, margin);
        return;
    }
    for lane in 0..N {
        let (gains, step, start_time) = pace.of_lane(lane);
        let taken = now.steps.0[lane] + uncounted;
        let t = start_time + Straight::from_f64(taken) * step;
        let (mechanism, inputs) = (instances.mechanism_of(lane), instances.inputs_of(lane));
        let at = now.state_of(lane);
        // without a closure, which may be a function of its own, of a target that has no such vectors
        let fused = match const { is_fused_for::<M, X>() } {
            true => mechanism.fused_step::<X>(&at, &inputs, &gains, step, t),
            false => None,
        };
        let (next, growth) = match fused {
            Some(stepped) => (stepped.next, stepped.growth.0),
            None => {
                let mut next = at;
                let growth = step_in_place::<Each<M>, X>(&mechanism, &mut next, &inputs, &gains, step, t);
                (next, growth.0)
            }
        };
        let spare = match const { M::INFO.redundant.is_empty() } {
            true => None,
            false => Some(spare::margin(&mechanism, &next, Straight(watches[lane].length)).0),
        };
        now.note(lane, growth, spare, margin);
        now.put(lane, next);
    }
}

/// True if programs of a mechanism became loops, which go lane after lane.
#[inline(always)]
fn is_in_loops<M: Mechanism>() -> bool {
    M::INFO.functions.iter().any(|function| function.loops > 0)
}

/// A step of every lane of a method that has no fused step: its stages are a loop, of which a loop
/// over lanes around it would make no vectors. So every operation is one of all lanes.
#[inline(always)]
fn step_together<M: Mechanism<Real: Lane>, X: Method, const N: usize>(
    instances: &Instances<M, N>,
    pace: &Pace<M::Real, N>,
    watches: &[Watch<M::Real>; N],
    uncounted: f64,
    now: &mut Moment<M, N>,
    margin: &mut Lanes<M::Real, N>,
) {
    let mut t_next = Lanes::default();
    for lane in 0..N {
        let (_, step, start_time) = pace.of_lane(lane);
        t_next.0[lane] = (start_time + Straight::from_f64(now.steps.0[lane] + uncounted) * step).0;
    }
    let at = State { t: now.t, q: Components::from_array(now.q), v: Components::from_array(now.v) };
    let inputs = Components::from_array(instances.inputs);
    let span = Span { t: now.t, h: pace.step, t_next };
    let Trial { next, growth } =
        trial_in_place::<Many<M, N>, X>(&instances.mechanism, &at, &inputs, &pace.gains, &span);
    (now.t, now.q, now.v) = (next.t, next.q.into_array(), next.v.into_array());
    for lane in 0..N {
        let spare = match const { M::INFO.redundant.is_empty() } {
            true => None,
            false => {
                let (mechanism, next) = (instances.mechanism_of(lane), now.state_of(lane));
                Some(spare::margin(&mechanism, &next, Straight(watches[lane].length)).0)
            }
        };
        now.note(lane, growth.0[lane], spare, margin);
    }
}

/// True if no growth was over its alarm or is to be remembered, and all is finite, in
/// every lane.
#[inline(always)]
fn is_calm<M: Mechanism<Real: Lane>, const N: usize>(
    margin: &Lanes<M::Real, N>,
    at: &Moment<M, N>,
    watches: &[Watch<M::Real>; N],
) -> bool {
    let infinity = M::Real::from_f64(f64::INFINITY);
    let mut sick = 0_u64;
    for lane in 0..N {
        let State { q, v, .. } = at.state_of(lane);
        let is_finite = trouble_of(sum_of(q) + sum_of(v)).0 < infinity;
        let is_old = at.worst.0[lane] <= watches[lane].remembered_from();
        sick |= u64::from(!(is_finite & is_old & margin.0[lane].is_below(infinity)));
    }
    sick == 0
}

/// 0 if a sum is finite, else NaN, which is below no limit.
#[inline(always)]
#[allow(clippy::eq_op, reason = "infinity minus infinity is not 0")]
fn trouble_of<T: Real>(sum: T) -> T {
    sum - sum
}
