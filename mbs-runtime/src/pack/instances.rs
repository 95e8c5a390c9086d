//! The simulations in the lanes of a pack, and their states.
//!
//! Numbers lie per quantity. The loop over steps is inside `Pack::advance`, so that the state stays in
//! registers.
//!
//! A step that one lane cannot make is made by none. Then it is made lane after lane by the scalar code. So
//! members equal their simulations bit for bit, and a singular one does not spoil its neighbours.
#![allow(
    clippy::needless_range_loop,
    reason = "the compiler makes vectors of loops over indices, not of iterators over arrays"
)]

use core::borrow::Borrow;

use super::{Each, Many, ManyStates};
use crate::equations::Arrays;
use crate::lanes::{Lane, Lanes};
use crate::moreau::Pushed;
use crate::simulation::{pushed, struck as stopped};
use crate::straight::Straight;
use crate::watch::rise_after;
use crate::{Components, Gains, Mechanism, Method, Simulation, State};

/// State by state, the lanes.
type Array<M, const N: usize> = <ManyStates<M, N> as Components>::Array;

/// The mechanisms and inputs of simulations, of which memories alone change while these advance.
#[derive(Clone, Copy)]
pub(super) struct Instances<M: Mechanism<Real: Lane>, const N: usize> {
    pub mechanism: Many<M, N>,
    // As arrays, which a loop over lanes reads in place.
    parameters: <<Many<M, N> as Mechanism>::Parameters as Components>::Array,
    pub inputs: <<Many<M, N> as Mechanism>::Inputs as Components>::Array,
}

impl<M: Mechanism<Real: Lane>, const N: usize> Instances<M, N> {
    pub fn of<X: Method>(members: [&Simulation<M, X>; N]) -> Self {
        let parameters: <Many<M, N> as Mechanism>::Parameters =
            pack(|lane| *members[lane].mechanism().parameters());
        let inputs: <Many<M, N> as Mechanism>::Inputs = pack(|lane| *members[lane].inputs());
        let hoisted = members.map(|member| member.mechanism().hoisted());
        Self {
            mechanism: Many::<M, N>::from_hoisted(parameters, |at| Lanes(hoisted.map(|hoisted| hoisted[at]))),
            parameters: parameters.into_array(),
            inputs: inputs.into_array(),
        }
    }

    #[inline(always)]
    pub fn mechanism_of(&self, lane: usize) -> Each<M> {
        let hoisted = self.mechanism.hoisted();
        Each::<M>::from_hoisted(take(&self.parameters, lane), |at| Straight(hoisted[at].0[lane]))
    }

    #[inline(always)]
    pub fn inputs_of(&self, lane: usize) -> <Each<M> as Mechanism>::Inputs {
        take(&self.inputs, lane)
    }
}

impl<M: Mechanism<Real: Lane>, const N: usize> Instances<M, N> {
    /// The inputs in one lane, memories included.
    #[inline]
    pub fn scalar_inputs(&self, lane: usize) -> M::Inputs {
        scalars_of(&self.inputs, lane)
    }

    /// And back.
    pub fn put_inputs(&mut self, lane: usize, inputs: &[M::Real]) {
        for (lanes, input) in self.inputs.as_mut().iter_mut().zip(inputs) {
            lanes.0[lane] = *input;
        }
    }

    /// Takes the memories over that simulations have come to.
    pub fn take_memories<X: Method>(&mut self, members: [&Simulation<M, X>; N]) {
        for lane in 0..N {
            self.put_inputs(lane, members[lane].inputs().into_array().as_ref());
        }
    }

    /// Gives a lane the inputs of another.
    pub fn copy_inputs(&mut self, from: usize, to: usize) {
        for lanes in self.inputs.as_mut() {
            lanes.0[to] = lanes.0[from];
        }
    }
}

/// The gains, steps and start times of simulations.
#[derive(Clone, Copy)]
pub(super) struct Pace<T, const N: usize> {
    pub gains: Gains<Lanes<T, N>>,
    pub step: Lanes<T, N>,
    start_time: Lanes<T, N>,
}

impl<T: Lane, const N: usize> Pace<T, N> {
    pub fn of<M: Mechanism<Real = T>, X: Method>(members: [&Simulation<M, X>; N]) -> Self {
        let gains = members.map(|member| member.baumgarte().gains());
        Self {
            gains: Gains {
                minus_two_alpha: Lanes(gains.map(|gains: Gains<T>| gains.minus_two_alpha)),
                minus_beta_squared: Lanes(gains.map(|gains| gains.minus_beta_squared)),
            },
            step: Lanes(members.map(Simulation::step_size)),
            start_time: Lanes(members.map(Simulation::start_time)),
        }
    }

    #[inline(always)]
    pub fn of_lane(&self, lane: usize) -> (Gains<Straight<T>>, Straight<T>, Straight<T>) {
        let gains = Gains {
            minus_two_alpha: Straight(self.gains.minus_two_alpha.0[lane]),
            minus_beta_squared: Straight(self.gains.minus_beta_squared.0[lane]),
        };
        (gains, Straight(self.step.0[lane]), Straight(self.start_time.0[lane]))
    }
}

/// Where simulations are.
#[derive(Clone, Copy)]
pub(super) struct Moment<M: Mechanism<Real: Lane>, const N: usize> {
    pub t: Lanes<M::Real, N>,
    pub q: Array<M, N>,
    pub v: Array<M, N>,
    /// Steps since the start; exact, and a number that vectors can compute with.
    pub steps: Lanes<f64, N>,
    /// The growth over which the next step is not calm.
    pub alarm: Lanes<M::Real, N>,
    /// The largest growth so far.
    pub worst: Lanes<M::Real, N>,
}

impl<M: Mechanism<Real: Lane>, const N: usize> Moment<M, N> {
    pub fn of<X: Method>(members: [&Simulation<M, X>; N]) -> Self {
        let q: ManyStates<M, N> = pack(|lane| members[lane].integrated().q);
        let v: ManyStates<M, N> = pack(|lane| members[lane].integrated().v);
        Self {
            t: Lanes(members.map(|member| member.integrated().t)),
            q: q.into_array(),
            v: v.into_array(),
            steps: Lanes(members.map(|member| member.steps() as f64)),
            alarm: Lanes(members.map(|member| member.watch().alarm)),
            worst: Lanes(members.map(|member| member.watch().worst)),
        }
    }

    /// The state in one lane.
    #[inline]
    pub fn scalar_state(&self, lane: usize) -> State<M::States> {
        State { t: self.t.0[lane], q: scalars_of(&self.q, lane), v: scalars_of(&self.v, lane) }
    }

    /// And back.
    pub fn put_scalar(&mut self, lane: usize, state: &State<M::States>) {
        self.t.0[lane] = state.t;
        let vectors = [(&mut self.q, state.q.into_array()), (&mut self.v, state.v.into_array())];
        for (vector, scalars) in vectors {
            for (lanes, scalar) in vector.as_mut().iter_mut().zip(scalars.as_ref()) {
                lanes.0[lane] = *scalar;
            }
        }
    }

    #[inline(always)]
    pub fn state_of(&self, lane: usize) -> State<<Each<M> as Mechanism>::States> {
        State { t: Straight(self.t.0[lane]), q: take(&self.q, lane), v: take(&self.v, lane) }
    }

    /// Moves a lane to where another is.
    pub fn copy(&mut self, from: usize, to: usize) {
        self.t.0[to] = self.t.0[from];
        self.steps.0[to] = self.steps.0[from];
        self.alarm.0[to] = self.alarm.0[from];
        self.worst.0[to] = self.worst.0[from];
        for lanes in self.q.as_mut().iter_mut().chain(self.v.as_mut()) {
            lanes.0[to] = lanes.0[from];
        }
    }

    /// Notes the growth of a step in one lane, and where constraints are redundant, what is left to
    /// them. `margin` keeps the worst of it, below zero where the step is not calm.
    #[inline(always)]
    pub fn note(
        &mut self,
        lane: usize,
        growth: M::Real,
        spare: Option<M::Real>,
        margin: &mut Lanes<M::Real, N>,
    ) {
        let mut worst = margin.0[lane].worse(self.alarm.0[lane] - growth);
        if let Some(spare) = spare {
            worst = worst.worse(if spare >= M::Real::default() { growth } else { spare });
        }
        margin.0[lane] = worst;
        self.alarm.0[lane] = rise_after(growth);
        self.worst.0[lane] = self.worst.0[lane].worse(growth);
    }

    /// Counts steps that were taken.
    #[inline(always)]
    pub fn count(&mut self, steps: f64) {
        for lane in 0..N {
            self.steps.0[lane] += steps;
        }
    }

    #[inline(always)]
    pub fn put(&mut self, lane: usize, state: State<<Each<M> as Mechanism>::States>) {
        self.t.0[lane] = state.t.0;
        put(&mut self.q, lane, state.q);
        put(&mut self.v, lane, state.v);
    }
}

/// The number of steps to the next look at stops, or sample in any lane.
#[inline(always)]
pub(super) fn steps_to_sample<
    M: Mechanism<Real: Lane>,
    X: Method,
    S: Borrow<Simulation<M, X>>,
    const N: usize,
>(
    members: &[S; N],
    now: &Moment<M, N>,
) -> u64 {
    if const { M::INFO.jumps() } {
        return 1;
    }
    if const { M::INFO.sampling.clocks == 0 } {
        return u64::MAX;
    }
    let left = members.iter().zip(now.steps.0).map(|(member, steps)| {
        let member = member.borrow();
        member.grid().steps_to_sample(steps as u64, member.mechanism())
    });
    left.min().unwrap_or(u64::MAX)
}

/// The stops that push before a step, lane after lane; nothing where a lane cannot tell.
#[inline(always)]
pub(super) fn push<M: Mechanism<Real: Lane>, X: Method, S: Borrow<Simulation<M, X>>, const N: usize>(
    members: &[S; N],
    instances: &mut Instances<M, N>,
    now: &mut Moment<M, N>,
) -> Option<[Pushed<M::Real>; N]> {
    let mut all = [Pushed::NONE; N];
    if const { !M::INFO.jumps() } {
        return Some(all);
    }
    for lane in 0..N {
        let (member, mut inputs) = (members[lane].borrow(), instances.scalar_inputs(lane));
        let mut state = now.scalar_state(lane);
        all[lane] = pushed(member.mechanism(), member.step_size(), &mut state, &mut inputs).ok()?;
        instances.put_inputs(lane, inputs.into_array().as_ref());
        now.put_scalar(lane, &state);
    }
    Some(all)
}

/// Leads steps back from stops, lane after lane; false where a lane cannot.
#[inline(always)]
pub(super) fn strike<M: Mechanism<Real: Lane>, X: Method, S: Borrow<Simulation<M, X>>, const N: usize>(
    members: &[S; N],
    instances: &mut Instances<M, N>,
    before: &Moment<M, N>,
    (pushed, now): (&[Pushed<M::Real>; N], &mut Moment<M, N>),
) -> bool {
    if const { !M::INFO.jumps() } {
        return true;
    }
    let (mut struck, mut memories) = (*now, *instances);
    for lane in 0..N {
        let (member, mut inputs) = (members[lane].borrow(), instances.scalar_inputs(lane));
        let ends = [before.scalar_state(lane), now.scalar_state(lane)];
        let h = member.step_size();
        let Ok(end) = stopped(member.mechanism(), h, (&pushed[lane], ends.each_ref()), &mut inputs) else {
            return false;
        };
        struck.put_scalar(lane, &end);
        memories.put_inputs(lane, inputs.into_array().as_ref());
    }
    (*now, *instances) = (struck, memories);
    true
}

/// Takes the samples that are due, lane after lane.
#[inline(always)]
pub(super) fn sample<M: Mechanism<Real: Lane>, X: Method, S: Borrow<Simulation<M, X>>, const N: usize>(
    members: &[S; N],
    instances: &mut Instances<M, N>,
    now: &Moment<M, N>,
) {
    if const { M::INFO.sampling.clocks == 0 } {
        return;
    }
    for lane in 0..N {
        let member = members[lane].borrow();
        let (mut inputs, state) = (instances.scalar_inputs(lane).into_array(), now.scalar_state(lane));
        let state = Arrays::of(&member.mechanism().complete(&state));
        member.grid().sample(now.steps.0[lane] as u64, member.mechanism(), state.at(), inputs.as_mut());
        instances.put_inputs(lane, inputs.as_ref());
    }
}

/// Components of all lanes from those of each.
fn pack<C, S, T, const N: usize>(of_lane: impl Fn(usize) -> S) -> C
where
    T: Lane,
    S: Components<Real = T>,
    C: Components<Real = Lanes<T, N>>,
{
    let mut packed = C::splat(Lanes::default()).into_array();
    for lane in 0..N {
        let scalars = of_lane(lane).into_array();
        for (lanes, scalar) in packed.as_mut().iter_mut().zip(scalars.as_ref()) {
            lanes.0[lane] = *scalar;
        }
    }
    C::from_array(packed)
}

/// The components of one lane, for a loop over lanes.
#[inline(always)]
fn take<S, T, const N: usize>(packed: &impl AsRef<[Lanes<T, N>]>, lane: usize) -> S
where
    T: Lane,
    S: Components<Real = Straight<T>>,
{
    let mut scalars = S::splat(Straight(T::default())).into_array();
    for (scalar, lanes) in scalars.as_mut().iter_mut().zip(packed.as_ref()) {
        scalar.0 = lanes.0[lane];
    }
    S::from_array(scalars)
}

/// And back.
#[inline(always)]
pub(super) fn put<S, T, const N: usize>(packed: &mut impl AsMut<[Lanes<T, N>]>, lane: usize, scalars: S)
where
    T: Lane,
    S: Components<Real = Straight<T>>,
{
    for (lanes, scalar) in packed.as_mut().iter_mut().zip(scalars.into_array().as_ref()) {
        lanes.0[lane] = scalar.0;
    }
}

/// The components of one lane; 0 beyond the last one.
#[inline]
pub fn unpack<S, C, T, const N: usize>(packed: C, lane: usize) -> S
where
    T: Lane,
    S: Components<Real = T>,
    C: Components<Real = Lanes<T, N>>,
{
    scalars_of(&packed.into_array(), lane)
}

/// The same, of an array that stays where it is.
#[inline]
fn scalars_of<S, T, const N: usize>(packed: &impl AsRef<[Lanes<T, N>]>, lane: usize) -> S
where
    T: Lane,
    S: Components<Real = T>,
{
    let mut scalars = S::splat(T::default()).into_array();
    for (scalar, lanes) in scalars.as_mut().iter_mut().zip(packed.as_ref()) {
        *scalar = lanes.0.get(lane).copied().unwrap_or_default();
    }
    S::from_array(scalars)
}
