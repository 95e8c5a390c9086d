//! Several simulations of one mechanism that advance together.
#![allow(
    clippy::needless_range_loop,
    reason = "the compiler makes vectors of loops over indices, not of iterators over arrays"
)]

use crate::heun::trial;
use crate::lanes::{Lane, Lanes};
use crate::mechanism::growth_limit;
use crate::straight::Straight;
use crate::{Components, Error, Feedback, Gains, Mechanism, Real, Simulation, State};

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
/// What a lane does is what its [`Simulation`] would do alone, within what
/// [`Lanes`] says. A lane that cannot make a step stays where it is and
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
/// let mut pack = Pack::new(alone)?;
/// for _ in 0..500 {
///     assert_eq!(pack.step(), [true; 4]);
/// }
/// alone[2].advance_to(0.5)?;
/// assert_eq!(pack.simulation(2).state(), alone[2].state());
/// # Ok::<(), mbs_runtime::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct Pack<M: Mechanism<Real: Lane>, F: Feedback, const N: usize> {
    /// As they were packed.
    members: [Simulation<M, F>; N],
    /// For steps.
    each: [Each<M>; N],
    /// For observers.
    mechanism: Many<M, N>,
    inputs: <<Many<M, N> as Mechanism>::Inputs as Components>::Array,
    t: Lanes<M::Real, N>,
    /// As arrays, which a loop over lanes reads in place.
    q: Array<M, N>,
    v: Array<M, N>,
    gains: Gains<Lanes<M::Real, N>>,
    step: Lanes<M::Real, N>,
    start_time: Lanes<M::Real, N>,
    /// Steps since the start; exact, and a number that vectors can compute with.
    steps: Lanes<f64, N>,
}

impl<M: Mechanism<Real: Lane>, F: Feedback, const N: usize> Pack<M, F, N> {
    /// The simulations, each from where it is.
    ///
    /// # Errors
    /// None for mechanisms that their own constructor has accepted.
    pub fn new(members: [Simulation<M, F>; N]) -> Result<Self, Error> {
        let parameters: <Many<M, N> as Mechanism>::Parameters =
            pack(|lane| *members[lane].mechanism().parameters());
        let numbers = |f: &dyn Fn(&Simulation<M, F>) -> M::Real| Lanes(members.each_ref().map(f));
        let gains = members.each_ref().map(|member| member.baumgarte().gains());
        let of_lanes = parameters.into_array();
        let mut each = [Each::<M>::new(take(&of_lanes, 0))?; N];
        for lane in 1..N {
            each[lane] = Each::<M>::new(take(&of_lanes, lane))?;
        }
        Ok(Self {
            each,
            mechanism: Many::<M, N>::new(parameters)?,
            inputs: pack::<<Many<M, N> as Mechanism>::Inputs, _, _, N>(|lane| *members[lane].inputs())
                .into_array(),
            t: numbers(&|member| member.state().t),
            q: pack::<ManyCoordinates<M, N>, _, _, N>(|lane| members[lane].state().q).into_array(),
            v: pack::<ManyCoordinates<M, N>, _, _, N>(|lane| members[lane].state().v).into_array(),
            gains: Gains {
                minus_two_alpha: Lanes(gains.map(|gains: Gains<M::Real>| gains.minus_two_alpha)),
                minus_beta_squared: Lanes(gains.map(|gains| gains.minus_beta_squared)),
            },
            step: numbers(&Simulation::step_size),
            start_time: numbers(&Simulation::start_time),
            steps: Lanes(members.each_ref().map(|member| member.steps() as f64)),
            members,
        })
    }

    /// Advances every lane by a step; those that did. What a step of
    /// [`simulation`](Self::simulation) says is why another did not.
    #[inline(always)]
    pub fn step(&mut self) -> [bool; N] {
        if N == 1 {
            return self.step_alone();
        }
        // The scalar's step in a loop over lanes: compilers make better vectors of that
        // than of a step of which every operation is a loop.
        let (mut q, mut v, mut t) = (self.q, self.v, self.t);
        let (mut health, mut steps) = (t, self.steps);
        for lane in 0..N {
            let here = State { t: Straight(self.t.0[lane]), q: take(&self.q, lane), v: take(&self.v, lane) };
            let inputs = take(&self.inputs, lane);
            let gains = Gains {
                minus_two_alpha: Straight(self.gains.minus_two_alpha.0[lane]),
                minus_beta_squared: Straight(self.gains.minus_beta_squared.0[lane]),
            };
            let step = Straight(self.step.0[lane]);
            let taken = steps.0[lane] + 1.0;
            let t_next = Straight(self.start_time.0[lane]) + Straight::from_f64(taken) * step;
            let trial = trial::<Each<M>, F>(&self.each[lane], &here, &inputs, &gains, step, t_next);
            // What is not finite makes the sum NaN, and NaN is below no limit.
            let growth = trial.here.1 + trial.there.1;
            let sum = growth + (trouble_of(trial.next.q) + trouble_of(trial.next.v));
            put(&mut q, lane, trial.next.q);
            put(&mut v, lane, trial.next.v);
            t.0[lane] = t_next.0;
            steps.0[lane] = taken;
            health.0[lane] = sum.0;
        }
        if health < growth_limit() {
            (self.t, self.q, self.v, self.steps) = (t, q, v, steps);
            return [true; N];
        }
        let healthy = health.test(growth_limit(), |health, limit| health < limit);
        self.t = t.select(healthy, self.t);
        self.steps = steps.select(healthy, self.steps);
        keep(&mut self.q, &q, healthy);
        keep(&mut self.v, &v, healthy);
        healthy
    }

    /// A single lane is its simulation, with all that a scalar can compute.
    fn step_alone(&mut self) -> [bool; N] {
        let mut simulation = self.simulation(0);
        let healthy = simulation.step().is_ok();
        let State { t, q, v } = *simulation.state();
        self.t = Lanes([t; N]);
        self.q = pack::<ManyCoordinates<M, N>, _, _, N>(|_| q).into_array();
        self.v = pack::<ManyCoordinates<M, N>, _, _, N>(|_| v).into_array();
        self.steps = Lanes([simulation.steps() as f64; N]);
        [healthy; N]
    }

    /// The simulation in a lane, as it is now: the last one, beyond the last lane.
    pub fn simulation(&self, lane: usize) -> Simulation<M, F> {
        let lane = lane.min(N - 1);
        let State { t, q, v } = self.snapshot().state;
        let state = State { t: t.0[lane], q: unpack(q, lane), v: unpack(v, lane) };
        self.members[lane].moved_to(state, self.steps.0[lane] as u64)
    }

    /// What can be observed of all lanes.
    #[inline(always)]
    pub fn snapshot(&self) -> Snapshot<'_, M, N> {
        let (q, v) = (Components::from_array(self.q), Components::from_array(self.v));
        Snapshot {
            mechanism: &self.mechanism,
            state: State { t: self.t, q, v },
            inputs: Components::from_array(self.inputs),
        }
    }
}

/// `N` instances at an instant.
#[derive(Clone, Copy, Debug)]
pub struct Snapshot<'a, M: Mechanism<Real: Lane>, const N: usize> {
    /// The mechanism.
    pub mechanism: &'a Many<M, N>,
    /// Time, positions and velocities.
    pub state: State<ManyCoordinates<M, N>>,
    /// The inputs.
    pub inputs: <Many<M, N> as Mechanism>::Inputs,
}

impl<M: Mechanism<Real: Lane>, const N: usize> Snapshot<'_, M, N> {
    /// Constraint violations ‖Φ‖.
    #[inline(always)]
    pub fn violation(&self) -> Lanes<M::Real, N> {
        self.mechanism.phi(self.state.t, &self.state.q).norm()
    }

    /// Constraint violations in velocities ‖Φ̇‖.
    #[inline(always)]
    pub fn velocity_violation(&self) -> Lanes<M::Real, N> {
        self.mechanism.phi_dot(&self.state).norm()
    }

    /// The declared outputs, and the lanes in which the position has any.
    #[inline(always)]
    pub fn outputs(&self) -> (ManyOutputs<M, N>, [bool; N]) {
        let none = <Many<M, N> as Mechanism>::Constraints::splat(Lanes::default());
        let reactions = self.mechanism.reactions(&self.state, &self.inputs, &none);
        let health = reactions.growth + trouble_of(reactions.acceleration);
        let healthy = health.test(growth_limit(), |health, limit| health < limit);
        (self.mechanism.outputs(&self.state, &self.inputs, &reactions), healthy)
    }
}

/// 0 if every component is finite, else NaN: lane by lane.
#[inline(always)]
fn trouble_of<C: Components>(components: C) -> C::Real {
    let mut sum = C::Real::default();
    #[allow(clippy::eq_op, reason = "infinity minus infinity is not 0")]
    for x in components.into_array().as_ref() {
        sum = sum + (*x - *x);
    }
    sum
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

/// Takes over what the lanes of a mask have computed.
#[cold]
fn keep<T: Lane, const N: usize>(
    old: &mut impl AsMut<[Lanes<T, N>]>,
    new: &impl AsRef<[Lanes<T, N>]>,
    mask: [bool; N],
) {
    for (old, new) in old.as_mut().iter_mut().zip(new.as_ref()) {
        *old = new.select(mask, *old);
    }
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
