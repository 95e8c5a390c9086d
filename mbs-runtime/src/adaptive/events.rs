//! When a value changes its sign on the way.
//!
//! Declared events are a function of the mechanism, as its outputs are. Those of a program are a closure. A
//! step that was taken is looked through on the polynomial between its ends (`crossing`). The first change
//! of sign is located, and the step ends there (`ending`).

use super::dense::Moment;
use super::gaps;
use super::{Adaptive, AdaptiveScheme, Dynamics};
use crate::equations::At;
use crate::info::Direction;
use crate::{Error, Mechanism, Real, State, vectors};

/// A change of sign that a run has come to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// Which one of the values.
    pub index: usize,
    /// When, in s.
    pub t: f64,
    /// True if it became positive.
    pub is_rising: bool,
}

pub use crate::info::MOST_EVENTS;

/// Writes values of a mechanism with these inputs in a state.
type Values<'a, D> =
    dyn FnMut(&D, &<D as Dynamics>::Inputs, At<'_, <D as Dynamics>::Real>, &mut [<D as Dynamics>::Real]) + 'a;

/// The values that are watched, the changes of their signs that count, and room for the values.
pub(super) struct Watched<'a, D: Dynamics> {
    pub count: usize,
    pub direction: &'a dyn Fn(usize) -> Option<Direction>,
    pub values: &'a mut Values<'a, D>,
    pub room: &'a mut [D::Real],
    /// `true` if the first of the values are those of the declared events, in their order.
    pub is_declared: bool,
}

/// Events at a moment as sets of bits: bit i is that of the watched value i.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Happened {
    /// The events at this moment.
    pub all: u64,
    /// The events of `all` and of `judged` that rise.
    pub rising: u64,
    /// The events of `all` that were not told yet.
    pub due: u64,
    /// Events, of earlier moments too, whose value is still zero, and of which it is known whether a
    /// program has turned the value around.
    pub judged: u64,
    /// The events of `judged` whose value a program has turned around.
    pub turned: u64,
    /// `true` if the state was set, at the start or by a program, and is not the end of a step.
    pub is_set: bool,
}

impl Direction {
    /// The change of sign between two values, and whether it rises, if it is one in this
    /// direction. A zero is the end of a change, and not the beginning of one.
    pub(super) fn met<T: Real>(self, before: T, after: T) -> Option<bool> {
        let zero = T::default();
        let rises = before < zero && after >= zero;
        let falls = before > zero && after <= zero;
        let is_met = match self {
            Self::Rising => rises,
            Self::Falling => falls,
            Self::Either => rises || falls,
        };
        is_met.then_some(rises)
    }
}

impl<D: Dynamics, S: AdaptiveScheme> Adaptive<D, S> {
    /// Takes steps until the first event, or until `end`.
    pub(super) fn until(&mut self, end: f64, watched: &mut Watched<'_, D>) -> Result<Option<Event>, Error> {
        let last = D::Real::from_f64(end);
        if !(end.is_finite() && last >= self.now.t) {
            return Err(Error::EndTime { end, now: self.now.t.to_f64() });
        }
        loop {
            self.sample_and_look(self.now.t < last, watched)?;
            self.forget_stops();
            if let Some(event) = self.due() {
                return Ok(Some(event));
            }
            if self.now.t >= last {
                self.jump()?;
                return Ok(None);
            }
            self.step_to(last)?;
            self.look_back(watched)?;
        }
    }

    /// Takes steps until the first of the declared events, or until `end`: `index` is its place in
    /// [`Info::events`](crate::Info::events). The state is right behind it; see
    /// [`advance_until`](Adaptive::advance_until) for how it is found.
    ///
    /// # Example
    /// ```
    /// use mbs_runtime::{Adaptive, Mechanism, mechanism};
    /// mechanism! {
    ///     pub Ball {
    ///         dof = 1;
    ///         gravity = (0, -9.81) [m/s^2];
    ///         body ball (y) { mass = 1 [kg]; }
    ///         event top: der(y) = 0 falling;
    ///         event ground: y = 0 falling;
    ///         start { y = 1 [m]; der(y) = 2 [m/s]; }
    ///     }
    /// }
    /// let mut run = Adaptive::builder(Ball::declared()).build()?;
    /// let mut names = Vec::new();
    /// while let Some(event) = run.advance_to_event(1.0)? {
    ///     names.push(Ball::<f64>::INFO.events[event.index].name);
    /// }
    /// assert_eq!(names, ["top", "ground"]);
    /// # Ok::<(), mbs_runtime::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`advance_until`](Adaptive::advance_until).
    pub fn advance_to_event(&mut self, end: f64) -> Result<Option<Event>, Error> {
        let events = self.dynamics.info().events;
        let mut watched = Watched {
            count: events.len(),
            direction: &|index| events.get(index).map(|event| event.direction),
            values: &mut |dynamics: &D, inputs: &D::Inputs, at, found| dynamics.events(at, inputs, found),
            room: &mut [D::Real::default(); MOST_EVENTS],
            is_declared: true,
        };
        self.until(end, &mut watched)
    }

    /// The first of the events that have happened at the present time and were not told.
    fn due(&mut self) -> Option<Event> {
        let Happened { due, rising, .. } = &mut self.happened;
        let index = due.trailing_zeros();
        let bit = 1_u64.checked_shl(index)?;
        *due &= !bit;
        let is_rising = *rising & bit != 0;
        Some(Event { index: index as usize, t: self.now.t.to_f64(), is_rising })
    }

    /// Takes a step that ends at `limit` at the latest, or at its first event if it has one.
    pub(super) fn step_or_event(
        &mut self,
        limit: D::Real,
        watched: &mut Watched<'_, D>,
    ) -> Result<Option<Event>, Error> {
        self.sample_and_look(true, watched)?;
        if let Some(event) = self.due() {
            return Ok(Some(event));
        }
        self.step_to(limit)?;
        self.look_back(watched)?;
        self.forget_releases();
        Ok(self.due())
    }
}

impl<D: Dynamics> Watched<'_, D> {
    /// The places of the values, and those of stops, with their bits.
    pub(super) fn bits(&self, dynamics: &D) -> impl Iterator<Item = (usize, u64)> + use<D> {
        gaps::watched(self.count, dynamics.info())
    }

    /// Which changes of sign of a value count.
    pub(super) fn direction(&self, dynamics: &D, index: usize) -> Option<Direction> {
        let equations = dynamics.equations();
        match gaps::stop_in(equations, index).or(gaps::transition_in(equations, index)) {
            Some(_) => Some(gaps::DIRECTION),
            None => (self.direction)(index),
        }
    }

    /// One of the values.
    pub(super) fn value(
        &mut self,
        index: usize,
        (dynamics, inputs): (&D, &D::Inputs),
        Moment { t, q, v, .. }: &Moment<D::Real, D::States>,
        all: &mut [D::Coordinates; 2],
    ) -> D::Real {
        dynamics.complete(*t, q, v, all);
        let [q, v] = all;
        let at = At { t: *t, q: q.as_ref(), v: v.as_ref() };
        if D::JUMPS
            && let Some(stop) = gaps::stop_in(dynamics.equations(), index)
        {
            return gaps::value(dynamics, inputs, at, stop);
        }
        if D::JUMPS
            && let Some(transition) = gaps::transition_in(dynamics.equations(), index)
        {
            return gaps::value_of_transition(dynamics, inputs, at, transition);
        }
        (self.values)(dynamics, inputs, at, self.room);
        self.room.get(index).copied().unwrap_or(D::Real::from_f64(f64::NAN))
    }
}

impl<M: Mechanism, S: AdaptiveScheme> Adaptive<M, S> {
    /// Takes steps until one of some values of the state changes its sign, or until `end`.
    ///
    /// The state is then that right behind the change: the last step is made again with its end
    /// there, located to rounding, and projected onto the constraints. Events at the same time, or
    /// nearer to each other than rounding, are told by calls one after the other, in the order of
    /// their indices; others in the order of time.
    ///
    /// A value that is zero at the start has no sign yet and so no event; it gets its sign from
    /// what follows. So does one that is zero to rounding in a state that a program has set: a ball
    /// that leaves the ground from an atom's width below it is above the ground from then on. A value
    /// that touches zero has no event. Each quarter of a step is looked
    /// through for one extremum, so that a value that oscillates faster may cross zero unseen:
    /// a [`max_step`](crate::Tolerances::max_step) bounds for how long.
    ///
    /// # Example
    /// A ball that bounces with half of its speed:
    /// ```
    /// use mbs_runtime::{Adaptive, Direction, mechanism};
    /// mechanism! {
    ///     pub Ball {
    ///         dof = 1;
    ///         gravity = (0, -9.81) [m/s^2];
    ///         body ball (y) { mass = 1 [kg]; }
    ///         start { y = 1 [m]; }
    ///     }
    /// }
    /// let mut run = Adaptive::builder(Ball::declared()).build()?;
    /// let mut impacts = Vec::new();
    /// while let Some(impact) = run.advance_until(2.0, [Direction::Falling], |at| [at.q.y])? {
    ///     impacts.push(impact.t);
    ///     let mut state = run.state();
    ///     state.v.y *= -0.5;
    ///     run.set_state(state)?;
    ///     # if impacts.len() == 3 { break; }
    /// }
    /// let fall = (2.0 / 9.81_f64).sqrt();
    /// assert!((impacts[0] - fall).abs() < 1e-12 && (impacts[1] - 2.0 * fall).abs() < 1e-12);
    /// # Ok::<(), mbs_runtime::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`step`](Self::step); [`Error::EndTime`] for an end that is past; [`Error::EndlessEvents`] where a
    /// program turns a value around at its event and it is back before rounding can tell.
    pub fn advance_until<const N: usize>(
        &mut self,
        end: f64,
        directions: [Direction; N],
        mut values: impl FnMut(&State<M::Coordinates>) -> [M::Real; N],
    ) -> Result<Option<Event>, Error> {
        const { assert!(N <= MOST_EVENTS, "at most 64 events are watched at once") };
        let mut watched = Watched {
            count: N,
            direction: &|index| directions.get(index).copied(),
            values: &mut |_: &M, _: &M::Inputs, at, found| vectors::copy(found, &values(&at.state())),
            room: &mut [M::Real::default(); N],
            is_declared: false,
        };
        self.until(end, &mut watched)
    }
}
