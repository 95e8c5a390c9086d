//! Stops among what a run watches: their places, their values, and what the run remembers of them.

use super::control::Tolerances;
use super::dynamics::Dynamics;
use super::effort::Effort;
use super::margins::{is_idle, margins};
use crate::contact::{Each, Gaps, MOST_CONTACTS, bit, has, those};
use crate::equations::{At, Equations};
use crate::info::{Direction, MOST_EVENTS};
use crate::pressing::held;
use crate::sticking::{all_frictions, direction};
use crate::vectors;
use crate::{Info, Real, modes};

/// The constraints of a mode are met within so many times the tolerance.
const TOLERANCES: f64 = 100.0;

/// The share of the longest step within which things follow each other often.
const OFTEN: f64 = 1e-6;

/// When something happened last, and how often it did in close sequence.
#[derive(Clone, Copy, Debug)]
pub(super) struct Often(f64, u32);

impl Often {
    const NEVER: Self = Self(f64::NEG_INFINITY, 0);

    /// It happens at this time; the number of times in close sequence before.
    pub fn at(&mut self, t: f64, longest_step: f64) -> u32 {
        let count = if t - self.0 < OFTEN * longest_step { self.1 + 1 } else { 0 };
        *self = Self(t, count);
        count
    }
}

/// The memory of a run of its stops.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stopping {
    /// The longest flight from each stop so far, in s.
    pub longest: Each<f64>,
    /// The largest coordinate at a jump so far, and at least the least size.
    pub size: f64,
    /// The absolute tolerance: a flight that rises no more than a step may be off is not flown. Without restitution's loss
    /// it would go on without end.
    pub lowest: f64,
    /// Constraints of modes are met within this share of the size of the coordinates.
    pub closed: f64,
    /// Conditions that hold are off by this share of the largest difference of their sides.
    pub off: f64,
    /// The stops that are rested on from the next jump on, as they were not left by more than rounding.
    pub stuck: u32,
    /// The stops at which the next jump is.
    pub reached: u32,
    /// When that was found last, and how often.
    pub looks: (f64, u8),
    /// The effort before the last step.
    pub effort: Effort,
    /// True if the last step was too long to see what gaps do in it.
    pub is_too_long: bool,
    /// The stops that are rested on because they were not left, until they push.
    pub kept: u32,
    /// Conditions that began to hold without being found.
    pub passed: Often,
    /// Impacts.
    pub struck: Often,
}

impl Stopping {
    pub fn new(tolerances: &Tolerances) -> Self {
        Self {
            longest: [0.0; MOST_CONTACTS],
            size: tolerances.atol / tolerances.rtol,
            lowest: tolerances.atol,
            off: modes::OFF.max(0.1 * TOLERANCES * tolerances.rtol),
            closed: modes::CLOSED.max(TOLERANCES * tolerances.rtol),
            stuck: 0,
            reached: 0,
            looks: (f64::NAN, 0),
            effort: Effort::NONE,
            is_too_long: false,
            kept: 0,
            passed: Often::NEVER,
            struck: Often::NEVER,
        }
    }
}

/// The bit of a stop among those of what is watched: the last ones.
pub(super) const fn place(stop: usize) -> usize {
    MOST_EVENTS - 1 - stop
}

/// The stop that is watched in a place, if it is one.
pub(super) fn stop_in<T: Real>(equations: &dyn Equations<T>, place: usize) -> Option<usize> {
    let stop = (MOST_EVENTS - 1).checked_sub(place)?;
    (stop < equations.info().watched_contacts()).then_some(stop)
}

/// The transition that is watched in a place, if it is one.
pub(super) fn transition_in<T: Real>(equations: &dyn Equations<T>, place: usize) -> Option<usize> {
    let transition = (MOST_EVENTS - 1 - MOST_CONTACTS).checked_sub(place)?;
    (transition < equations.info().modes.transitions.len()).then_some(transition)
}

/// The value of a transition, which falls where its condition begins to hold.
pub(super) fn value_of_transition<D: Dynamics>(
    dynamics: &D,
    inputs: &D::Inputs,
    at: At<'_, D::Real>,
    transition: usize,
) -> D::Real {
    let mut inputs = dynamics.inputs_at(at.t, inputs);
    let (mut a, mut lambda) = (dynamics.declared_start().1, dynamics.no_feedback());
    dynamics.with_inputs(&mut inputs, |inputs| {
        modes::margin(dynamics.equations(), at, (inputs, [a.as_mut(), lambda.as_mut()]), transition)
    })
}

/// The set of what a run watches by itself: stops, frictions, and behind all contacts transitions.
pub(super) fn of_run(info: &Info) -> u32 {
    those(info.watched_contacts(), |_| true) | transitions(info)
}

/// The set of all transitions.
pub(super) fn transitions(info: &Info) -> u32 {
    those(info.modes.transitions.len(), |_| true) << MOST_CONTACTS
}

/// The watched value of a stop: its gap while it is open, the force at it while it is rested on; and of a friction: its speed
/// in the direction in which it slides, and by how much its force is below what it can be while it sticks.
pub(super) fn value<D: Dynamics>(
    dynamics: &D,
    inputs: &D::Inputs,
    at: At<'_, D::Real>,
    stop: usize,
) -> D::Real {
    let equations = dynamics.equations();
    let mut inputs = dynamics.inputs_at(at.t, inputs);
    dynamics.with_inputs(&mut inputs, |inputs| {
        let mut a = dynamics.declared_start().1;
        vectors::fill(a.as_mut(), D::Real::default());
        let value = |of: &Each<D::Real>| of.get(stop).copied().unwrap_or_default();
        if has(held(equations, inputs), stop) {
            return value(&margins(dynamics, at, inputs, &mut a));
        }
        let gaps = Gaps::of(equations, at, a.as_ref());
        match has(all_frictions(equations.info()), stop) {
            true if is_idle(dynamics, at, inputs, stop) => D::Real::from_f64(1.0),
            true => D::Real::from_f64(direction(equations.info(), inputs, stop)) * value(&gaps.rate),
            false => value(&gaps.gap),
        }
    })
}

/// The contacts and transitions whose events are among these.
pub(super) fn among(happened: u64, info: &Info) -> u32 {
    happened.reverse_bits() as u32 & of_run(info)
}

/// The bits of a set of stops among those of what is watched, from the last one down.
pub(super) fn watched_of(stops: u32) -> u64 {
    u64::from(stops).reverse_bits()
}

/// The places of what is watched: values, and behind them what a run watches by itself from the last place on.
pub(super) fn watched(count: usize, info: &Info) -> impl Iterator<Item = (usize, u64)> + use<> {
    let of_run = of_run(info);
    let rows = (0..u32::BITS as usize).filter(move |row| has(of_run, *row));
    bits(count).chain(rows.map(|row| (place(row), watched_of(bit(row)))))
}

/// A gap that opens is no event, nor is a force that grows.
pub(super) const DIRECTION: Direction = Direction::Falling;

/// The watched values with their bits.
pub(super) fn bits(count: usize) -> impl Iterator<Item = (usize, u64)> {
    (0..count).zip((0..).map_while(|at| 1_u64.checked_shl(at)))
}
