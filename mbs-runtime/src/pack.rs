//! Several simulations of one mechanism that advance together.
#![allow(
    clippy::needless_range_loop,
    reason = "the compiler makes vectors of loops over indices, not of iterators over arrays"
)]

use core::array::from_fn;

use crate::heun::{Trial, trial};
use crate::lanes::{Lane, Lanes};
use crate::mechanism::growth_limit;
use crate::straight::Straight;
use crate::{Components, Feedback, Gains, Mechanism, Real, Simulation, State, Stepped};

/// The mechanism `M` over `N` lanes of its own scalar.
pub type Many<M, const N: usize> = <M as Mechanism>::Over<Lanes<<M as Mechanism>::Real, N>>;

/// Coordinate by coordinate, the lanes.
type Array<M, const N: usize> = <ManyCoordinates<M, N> as Components>::Array;

/// The mechanism `M` in a loop over lanes.
type Each<M> = <M as Mechanism>::Over<Straight<<M as Mechanism>::Real>>;

/// The coordinates of `N` instances.
pub type ManyCoordinates<M, const N: usize> = <Many<M, N> as Mechanism>::Coordinates;

/// The outputs of `N` instances.
pub type ManyOutputs<M, const N: usize> = <Many<M, N> as Mechanism>::Outputs;

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
/// # Ok::<(), mbs_runtime::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct Pack<M: Mechanism<Real: Lane>, F: Feedback, const N: usize> {
    /// As they were packed, or put into their lanes.
    members: [Simulation<M, F>; N],
    instances: Instances<M, N>,
    pace: Pace<M::Real, N>,
    now: Moment<M, N>,
}

impl<M: Mechanism<Real: Lane>, F: Feedback, const N: usize> Pack<M, F, N> {
    /// The simulations, each from where it is.
    pub fn new(members: [Simulation<M, F>; N]) -> Self {
        let now = Moment::of(&members);
        let (instances, pace) = (Instances::of(&members), Pace::of(&members));
        Self { members, instances, pace, now }
    }

    /// Advances every lane by a step; those that did. What a step of
    /// [`simulation`](Self::simulation) says is why another did not.
    pub fn step(&mut self) -> [bool; N] {
        if self.advance(1, |_| true) == 1 { [true; N] } else { self.step_each() }
    }

    /// Advances all lanes together by up to a number of steps, and says by how many: up
    /// to one after which `look` does not want more, or before one that not every lane
    /// can make, or not with what lanes can compute.
    ///
    /// In this loop the numbers are nobody else's, so they can stay in registers.
    #[inline(always)]
    pub fn advance(&mut self, steps: u64, mut look: impl FnMut(&Snapshot<'_, M, N>) -> bool) -> u64 {
        let Self { instances, pace, .. } = self;
        let mut now = self.now;
        let mut taken = 0;
        while taken < steps {
            let mut next = now;
            let health = trial_of_all::<M, F, N>(instances, pace, &now, &mut next);
            let health = health.zip_map(next.trouble(), |a, b| a + b);
            if !(health < Lanes([growth_limit(); N])) {
                break;
            }
            now = next;
            taken += 1;
            if !look(&Snapshot { instances, moment: &now }) {
                break;
            }
        }
        self.now = now;
        taken
    }

    /// Blind
    #[inline(always)]
    pub fn run(&mut self, steps: u64) -> u64 {
        let mut taken = 0;
        while taken < steps {
            let count = (steps - taken).min(64);
            if !self.chunk(count) {
                return taken + self.advance(count, |_| true);
            }
            taken += count;
        }
        taken
    }

    #[inline(always)]
    fn chunk(&mut self, steps: u64) -> bool {
        let Self { instances, pace, .. } = self;
        let mut now = self.now;
        let mut total = Lanes::default();
        for _ in 0..steps {
            let mut next = now;
            let health = trial_of_all::<M, F, N>(instances, pace, &now, &mut next);
            total = total + health;
            now = next;
        }
        let good = total + now.trouble() < Lanes([growth_limit(); N]);
        if good {
            self.now = now;
        }
        good
    }

    /// A step lane after lane, with all that a scalar can compute.
    #[cold]
    #[inline(never)]
    fn step_each(&mut self) -> [bool; N] {
        let mut members = from_fn(|lane| self.simulation(lane));
        let healthy = members.each_mut().map(|member| member.step().is_ok());
        self.now = Moment::of(&members);
        healthy
    }

    /// Puts a copy of what is in one lane into another.
    pub fn copy(&mut self, from: usize, to: usize) {
        *self = Self::new(from_fn(|lane| self.simulation(if lane == to { from } else { lane })));
    }

    /// The simulation in a lane, as it is now: the last one, beyond the last lane.
    pub fn simulation(&self, lane: usize) -> Simulation<M, F> {
        let lane = lane.min(N - 1);
        let State { t, q, v } = self.snapshot().state();
        let state = State { t: t.0[lane], q: unpack(q, lane), v: unpack(v, lane) };
        self.members[lane].moved_to(state, self.now.steps.0[lane] as u64)
    }

    /// What can be observed of all lanes.
    #[inline(always)]
    pub fn snapshot(&self) -> Snapshot<'_, M, N> {
        Snapshot { instances: &self.instances, moment: &self.now }
    }
}

/// A step of every lane; whether all of them are healthy.
///
/// The scalar's step in a loop over lanes: compilers make better vectors of that than
/// of a step of which every operation is a loop.
#[inline(always)]
fn trial_of_all<M: Mechanism<Real: Lane>, F: Feedback, const N: usize>(
    instances: &Instances<M, N>,
    pace: &Pace<M::Real, N>,
    now: &Moment<M, N>,
    next: &mut Moment<M, N>,
) -> Lanes<M::Real, N> {
    let mut health = Lanes::default();
    for lane in 0..N {
        let (gains, step, start_time) = pace.of_lane(lane);
        let taken = now.steps.0[lane] + 1.0;
        let t = start_time + Straight::from_f64(taken) * step;
        let (mechanism, inputs) = (instances.mechanism_of(lane), instances.inputs_of(lane));
        let at = now.state_of(lane);
        let stepped = match mechanism.fused_step::<F>(&at, &inputs, &gains, step, t) {
            Some(stepped) => stepped,
            None => staged_step::<Each<M>, F>(&mechanism, &at, &inputs, &gains, step, t),
        };
        health.0[lane] = stepped.growth.0;
        next.steps.0[lane] = taken;
        next.t.0[lane] = t.0;
        put(&mut next.q, lane, stepped.next.q);
        put(&mut next.v, lane, stepped.next.v);
    }
    health
}

/// A step stage by stage, of mechanisms that are too large for another.
#[inline(always)]
fn staged_step<M: Mechanism, F: Feedback>(
    mechanism: &M,
    at: &State<M::Coordinates>,
    inputs: &M::Inputs,
    gains: &Gains<M::Real>,
    h: M::Real,
    t_next: M::Real,
) -> Stepped<M::Coordinates> {
    let Trial { next, here, there, .. } = trial::<M, F>(mechanism, at, inputs, gains, h, t_next);
    Stepped { next, growth: here.1 + there.1, sum: sum_of(next.q) + sum_of(next.v) }
}

/// What does not change while simulations advance: what they are,
#[derive(Clone, Copy)]
struct Instances<M: Mechanism<Real: Lane>, const N: usize> {
    mechanism: Many<M, N>,
    // As arrays, which a loop over lanes reads in place.
    parameters: <<Many<M, N> as Mechanism>::Parameters as Components>::Array,
    inputs: <<Many<M, N> as Mechanism>::Inputs as Components>::Array,
}

impl<M: Mechanism<Real: Lane>, const N: usize> Instances<M, N> {
    fn of<F: Feedback>(members: &[Simulation<M, F>; N]) -> Self {
        let parameters: <Many<M, N> as Mechanism>::Parameters =
            pack(|lane| *members[lane].mechanism().parameters());
        let inputs: <Many<M, N> as Mechanism>::Inputs = pack(|lane| *members[lane].inputs());
        let hoisted = members.each_ref().map(|member| member.mechanism().hoisted());
        Self {
            mechanism: Many::<M, N>::from_hoisted(parameters, |at| Lanes(hoisted.map(|hoisted| hoisted[at]))),
            parameters: parameters.into_array(),
            inputs: inputs.into_array(),
        }
    }

    #[inline(always)]
    fn mechanism_of(&self, lane: usize) -> Each<M> {
        let hoisted = self.mechanism.hoisted();
        Each::<M>::from_hoisted(take(&self.parameters, lane), |at| Straight(hoisted[at].0[lane]))
    }

    #[inline(always)]
    fn inputs_of(&self, lane: usize) -> <Each<M> as Mechanism>::Inputs {
        take(&self.inputs, lane)
    }
}

/// and how they advance.
#[derive(Clone, Copy)]
struct Pace<T, const N: usize> {
    gains: Gains<Lanes<T, N>>,
    step: Lanes<T, N>,
    start_time: Lanes<T, N>,
}

impl<T: Lane, const N: usize> Pace<T, N> {
    fn of<M: Mechanism<Real = T>, F: Feedback>(members: &[Simulation<M, F>; N]) -> Self {
        let gains = members.each_ref().map(|member| member.baumgarte().gains());
        Self {
            gains: Gains {
                minus_two_alpha: Lanes(gains.map(|gains: Gains<T>| gains.minus_two_alpha)),
                minus_beta_squared: Lanes(gains.map(|gains| gains.minus_beta_squared)),
            },
            step: Lanes(members.each_ref().map(Simulation::step_size)),
            start_time: Lanes(members.each_ref().map(Simulation::start_time)),
        }
    }

    #[inline(always)]
    fn of_lane(&self, lane: usize) -> (Gains<Straight<T>>, Straight<T>, Straight<T>) {
        let gains = Gains {
            minus_two_alpha: Straight(self.gains.minus_two_alpha.0[lane]),
            minus_beta_squared: Straight(self.gains.minus_beta_squared.0[lane]),
        };
        (gains, Straight(self.step.0[lane]), Straight(self.start_time.0[lane]))
    }
}

/// Where simulations are.
#[derive(Clone, Copy)]
struct Moment<M: Mechanism<Real: Lane>, const N: usize> {
    t: Lanes<M::Real, N>,
    q: Array<M, N>,
    v: Array<M, N>,
    /// Steps since the start; exact, and a number that vectors can compute with.
    steps: Lanes<f64, N>,
}

impl<M: Mechanism<Real: Lane>, const N: usize> Moment<M, N> {
    fn of<F: Feedback>(members: &[Simulation<M, F>; N]) -> Self {
        let q: ManyCoordinates<M, N> = pack(|lane| members[lane].state().q);
        let v: ManyCoordinates<M, N> = pack(|lane| members[lane].state().v);
        Self {
            t: Lanes(members.each_ref().map(|member| member.state().t)),
            q: q.into_array(),
            v: v.into_array(),
            steps: Lanes(members.each_ref().map(|member| member.steps() as f64)),
        }
    }

    #[inline(always)]
    fn trouble(&self) -> Lanes<M::Real, N> {
        let mut trouble = Lanes::default();
        for lane in 0..N {
            let mut sum = M::Real::default();
            for x in self.q.as_ref().iter().chain(self.v.as_ref()) {
                sum = sum + x.0[lane];
            }
            trouble.0[lane] = trouble_of(sum);
        }
        trouble
    }
    #[inline(always)]
    fn state_of(&self, lane: usize) -> State<<Each<M> as Mechanism>::Coordinates> {
        State { t: Straight(self.t.0[lane]), q: take(&self.q, lane), v: take(&self.v, lane) }
    }
}

/// `N` instances at an instant.
#[derive(Clone, Copy)]
pub struct Snapshot<'a, M: Mechanism<Real: Lane>, const N: usize> {
    instances: &'a Instances<M, N>,
    moment: &'a Moment<M, N>,
}

impl<'a, M: Mechanism<Real: Lane>, const N: usize> Snapshot<'a, M, N> {
    /// The instances, in lanes.
    pub fn mechanism(&self) -> &'a Many<M, N> {
        &self.instances.mechanism
    }

    /// Time, positions and velocities.
    #[inline(always)]
    pub fn state(&self) -> State<ManyCoordinates<M, N>> {
        let Moment { t, q, v, .. } = *self.moment;
        State { t, q: Components::from_array(q), v: Components::from_array(v) }
    }

    /// The time in s.
    #[inline(always)]
    pub fn time(&self) -> Lanes<M::Real, N> {
        self.moment.t
    }

    /// The inputs.
    #[inline(always)]
    pub fn inputs(&self) -> <Many<M, N> as Mechanism>::Inputs {
        Components::from_array(self.instances.inputs)
    }

    /// Constraint violations ‖Φ‖.
    #[inline(always)]
    pub fn violation(&self) -> Lanes<M::Real, N> {
        if N == 1 {
            let State { t, q, .. } = self.state();
            return self.mechanism().phi(t, &q).norm();
        }
        let mut norms = Lanes::default();
        for lane in 0..N {
            let State { t, q, .. } = self.moment.state_of(lane);
            norms.0[lane] = self.instances.mechanism_of(lane).phi(t, &q).norm().0;
        }
        norms
    }

    /// Constraint violations in velocities ‖Φ̇‖.
    #[inline(always)]
    pub fn velocity_violation(&self) -> Lanes<M::Real, N> {
        if N == 1 {
            return self.mechanism().phi_dot(&self.state()).norm();
        }
        let mut norms = Lanes::default();
        for lane in 0..N {
            let at = self.moment.state_of(lane);
            norms.0[lane] = self.instances.mechanism_of(lane).phi_dot(&at).norm().0;
        }
        norms
    }

    /// The declared outputs, and the lanes in which the position has any.
    #[inline(always)]
    pub fn outputs(&self) -> (ManyOutputs<M, N>, [bool; N]) {
        if N == 1 {
            return self.outputs_of_one();
        }
        let mut outputs = ManyOutputs::<M, N>::splat(Lanes::default()).into_array();
        let mut healthy = [false; N];
        let none = <Each<M> as Mechanism>::Constraints::splat(Straight::default());
        for lane in 0..N {
            let (mechanism, inputs) = (self.instances.mechanism_of(lane), self.instances.inputs_of(lane));
            let at = self.moment.state_of(lane);
            let reactions = mechanism.reactions(&at, &inputs, &none);
            put(&mut outputs, lane, mechanism.outputs(&at, &inputs, &reactions));
            healthy[lane] = reactions.growth + trouble_of(sum_of(reactions.acceleration)) < growth_limit();
        }
        (ManyOutputs::<M, N>::from_array(outputs), healthy)
    }

    /// A single lane may branch: it has all that a scalar can compute.
    fn outputs_of_one(&self) -> (ManyOutputs<M, N>, [bool; N]) {
        let (at, inputs) = (self.state(), self.inputs());
        let none = <Many<M, N> as Mechanism>::Constraints::splat(Lanes::default());
        let reactions = self.mechanism().reactions(&at, &inputs, &none);
        let is_healthy = reactions.growth < growth_limit() && reactions.acceleration.is_finite();
        (self.mechanism().outputs(&at, &inputs, &reactions), [is_healthy; N])
    }
}

/// 0 if a sum is finite, else NaN, which is below no limit.
#[inline(always)]
#[allow(clippy::eq_op, reason = "infinity minus infinity is not 0")]
fn trouble_of<T: Real>(sum: T) -> T {
    sum - sum
}

/// Not finite if a component is not.
#[inline(always)]
fn sum_of<C: Components>(components: C) -> C::Real {
    let array = components.into_array();
    let sum = array.as_ref().iter().copied().reduce(|sum, x| sum + x);
    sum.unwrap_or_default()
}

/// Where both are set.
#[inline(always)]
pub fn and<const N: usize>(mut mask: [bool; N], other: [bool; N]) -> [bool; N] {
    for lane in 0..N {
        mask[lane] &= other[lane];
    }
    mask
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
fn put<S, T, const N: usize>(packed: &mut impl AsMut<[Lanes<T, N>]>, lane: usize, scalars: S)
where
    T: Lane,
    S: Components<Real = Straight<T>>,
{
    for (lanes, scalar) in packed.as_mut().iter_mut().zip(scalars.into_array().as_ref()) {
        lanes.0[lane] = scalar.0;
    }
}

/// The components of one lane; 0 beyond the last one.
pub fn unpack<S, C, T, const N: usize>(packed: C, lane: usize) -> S
where
    T: Lane,
    S: Components<Real = T>,
    C: Components<Real = Lanes<T, N>>,
{
    let mut scalars = S::splat(T::default()).into_array();
    for (scalar, lanes) in scalars.as_mut().iter_mut().zip(packed.into_array().as_ref()) {
        *scalar = lanes.0.get(lane).copied().unwrap_or_default();
    }
    S::from_array(scalars)
}
