//! The quantities of a pack that can be observed.
#![allow(
    clippy::needless_range_loop,
    reason = "the compiler makes vectors of loops over indices, not of iterators over arrays"
)]

use super::instances::{Instances, Moment, put};
use super::{Each, Many, ManyCoordinates, ManyOutputs, trouble_of};
use crate::components::sum_of;
use crate::equations::measured;
use crate::lanes::{Lane, Lanes};
use crate::mechanism::growth_limit;
use crate::simulation::press;
use crate::straight::Straight;
use crate::{Components, Mechanism, State};

/// `N` instances at an instant.
///
/// # Example
/// ```
/// # use mbs_runtime::{Lanes, Mechanism, Pack, Simulation, mechanism};
/// # mechanism! {
/// #     pub Pendulum {
/// #         dof = 1;
/// #         param length = 1 [m];
/// #         gravity = (0, -9.81) [m/s^2];
/// #         body bob (x, y) { mass = 2 [kg]; }
/// #         constraint rod: x^2 + y^2 = length^2;
/// #         start { x = length; guess y = 0; }
/// #     }
/// # }
/// let short = PendulumParameters { length: 0.5 };
/// let runs = [
///     Simulation::new(Pendulum::new(short)?, 1e-3)?,
///     Simulation::new(Pendulum::declared(), 1e-3)?,
/// ];
/// let mut pack = Pack::new(runs);
/// assert_eq!(pack.advance(500), 500);
/// let all = pack.snapshot();
/// assert_eq!(all.time(), Lanes([0.5; 2]));
/// assert_eq!(all.state().q.x.0, [pack.state(0).q.x, pack.state(1).q.x]);
/// assert!(all.violation() < Lanes([1e-5; 2]) && all.velocity_violation() < Lanes([1e-3; 2]));
/// # Ok::<(), mbs_runtime::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct Snapshot<'a, M: Mechanism<Real: Lane>, const N: usize> {
    pub(super) instances: &'a Instances<M, N>,
    pub(super) moment: &'a Moment<M, N>,
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
        let states = State { t, q: Components::from_array(q), v: Components::from_array(v) };
        self.mechanism().complete(&states)
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
            let mechanism = self.instances.mechanism_of(lane);
            let State { t, q, .. } = mechanism.complete(&self.moment.state_of(lane));
            norms.0[lane] = mechanism.phi(t, &q).norm().0;
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
            let mechanism = self.instances.mechanism_of(lane);
            let at = mechanism.complete(&self.moment.state_of(lane));
            norms.0[lane] = mechanism.phi_dot(&at).norm().0;
        }
        norms
    }

    /// The declared outputs, and the lanes in which the position has any, and all are finite.
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
            let at = mechanism.complete(&self.moment.state_of(lane));
            let mut reactions = mechanism.reactions(&at, &inputs, &none);
            press(&mechanism, &at, &inputs, &mut reactions);
            let values = measured(&mechanism, &at, &inputs, &reactions);
            let trouble = trouble_of(sum_of(reactions.acceleration)) + trouble_of(sum_of(values));
            healthy[lane] = reactions.growth + trouble < growth_limit();
            put(&mut outputs, lane, values);
        }
        (ManyOutputs::<M, N>::from_array(outputs), healthy)
    }

    /// A single lane may branch: it has all that a scalar can compute.
    fn outputs_of_one(&self) -> (ManyOutputs<M, N>, [bool; N]) {
        let (at, inputs) = (self.state(), self.inputs());
        let none = <Many<M, N> as Mechanism>::Constraints::splat(Lanes::default());
        let mut reactions = self.mechanism().reactions(&at, &inputs, &none);
        press(self.mechanism(), &at, &inputs, &mut reactions);
        let outputs = measured(self.mechanism(), &at, &inputs, &reactions);
        let is_finite = reactions.acceleration.is_finite() && outputs.is_finite();
        (outputs, [is_finite && reactions.growth < growth_limit(); N])
    }
}

/// Where both are set.
#[inline(always)]
pub fn and<const N: usize>(mut mask: [bool; N], other: [bool; N]) -> [bool; N] {
    for lane in 0..N {
        mask[lane] &= other[lane];
    }
    mask
}
