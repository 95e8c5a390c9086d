//! When a value changes its sign on the way.

use super::attempt::is_healthy;
use super::change::last_change;
use super::dense::Moment;
use super::{Adaptive, Dynamics};
use crate::equations::At;
use crate::{Error, Mechanism, Real, Scheme, State, vectors};

/// Which changes of sign are events.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// From negative to positive.
    Rising,
    /// From positive to negative.
    Falling,
    /// Both.
    Either,
}

/// A change of sign that a run has come to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// Which one of the values.
    pub index: usize,
    /// When, in s.
    pub t: f64,
    /// Whether it became positive.
    pub is_rising: bool,
}

/// At most so many events are watched at once.
pub const MOST_EVENTS: usize = 64;

/// A step is looked through in so many parts of equal length.
const PARTS: u32 = 4;
/// The share of a part over which slopes are taken.
const SLOPE: f64 = 1e-5;
/// Golden sections of a part, after which its extremum is known to a thousandth of its length.
const SECTIONS: u32 = 16;

/// Writes values of a mechanism with these inputs in a state.
type Values<'a, D> =
    dyn FnMut(&D, &<D as Dynamics>::Inputs, At<'_, <D as Dynamics>::Real>, &mut [<D as Dynamics>::Real]) + 'a;

/// What is watched: values, which of their changes of sign count, and room for the values.
pub(super) struct Watched<'a, D: Dynamics> {
    pub count: usize,
    pub direction: &'a dyn Fn(usize) -> Option<Direction>,
    pub values: &'a mut Values<'a, D>,
    pub room: &'a mut [D::Real],
}

/// Two times between which a value changes its sign.
#[derive(Clone, Copy)]
struct Bracket<T> {
    from: T,
    to: T,
    is_rising: bool,
}

impl Direction {
    /// The change of sign between two values, and whether it rises, if it is one in this
    /// direction. A zero is the end of a change, and not the beginning of one.
    fn met<T: Real>(self, before: T, after: T) -> Option<bool> {
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

impl<D: Dynamics, S: Scheme> Adaptive<D, S> {
    /// Takes steps until the first event, or until `end`.
    pub(super) fn until(&mut self, end: f64, watched: &mut Watched<'_, D>) -> Result<Option<Event>, Error> {
        let last = D::Real::from_f64(end);
        if !(end.is_finite() && last >= self.now.t) {
            return Err(Error::EndTime { end, now: self.now.t.to_f64() });
        }
        loop {
            if let Some(event) = self.due() {
                return Ok(Some(event));
            }
            if self.now.t >= last {
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
    /// As [`step`](Self::step), and [`Error::EndTime`] for an end that is past.
    pub fn advance_to_event(&mut self, end: f64) -> Result<Option<Event>, Error> {
        let events = self.dynamics.equations().info().events;
        let mut watched = Watched {
            count: events.len(),
            direction: &|index| events.get(index).map(|event| event.direction),
            values: &mut |dynamics: &D, inputs: &D::Inputs, at, found| dynamics.events(at, inputs, found),
            room: &mut [D::Real::default(); MOST_EVENTS],
        };
        self.until(end, &mut watched)
    }

    /// The first of the events that have happened at the present time and were not told.
    fn due(&mut self) -> Option<Event> {
        let index = self.due.trailing_zeros();
        let bit = 1_u64.checked_shl(index)?;
        self.due &= !bit;
        let is_rising = self.due_rising & bit != 0;
        Some(Event { index: index as usize, t: self.now.t.to_f64(), is_rising })
    }

    /// Takes a step, which ends at its first event if it has one.
    pub(super) fn step_or_event(&mut self, watched: &mut Watched<'_, D>) -> Result<Option<Event>, Error> {
        if let Some(event) = self.due() {
            return Ok(Some(event));
        }
        self.step()?;
        self.look_back(watched)?;
        Ok(self.due())
    }

    /// Looks for the first event in the last step. If there is one, the step ends right behind it,
    /// and whatever has happened by then is due.
    fn look_back(&mut self, watched: &mut Watched<'_, D>) -> Result<(), Error> {
        let mut first: Option<(D::Real, usize)> = None;
        for index in 0..watched.count {
            if let Some(bracket) = self.bracket(index, watched) {
                let t = self.locate(index, bracket, watched);
                first = first.filter(|(earlier, _)| *earlier <= t).or(Some((t, index)));
            }
        }
        let Some((first, which)) = first else { return Ok(()) };
        (self.due, self.due_rising) = (0, 0);
        for (index, bit) in (0..watched.count).zip((0..).map_while(|at| 1_u64.checked_shl(at))) {
            if let Some(bracket) = self.bracket(index, watched)
                && self.locate(index, bracket, watched) <= first
            {
                self.due |= bit;
                self.due_rising |= if bracket.is_rising { bit } else { 0 };
            }
        }
        let first = self.differentiated(first, which, watched);
        self.end_at(first)
    }

    /// Where a value changes its sign for the first time in the last step, on the polynomial
    /// between its ends.
    ///
    /// A value that has the same sign at both ends of a part, and runs towards zero at the first
    /// and away from it at the second, may have crossed zero twice: its extremum decides.
    fn bracket(&mut self, index: usize, watched: &mut Watched<'_, D>) -> Option<Bracket<D::Real>> {
        let (number, zero) = (D::Real::from_f64, D::Real::default());
        let direction = (watched.direction)(index)?;
        let (start, end) = (self.before.t, self.now.t);
        let (mut from, mut before) = (start, self.value_between(start, index, watched));
        for part in 1..=PARTS {
            let share = number(f64::from(part) / f64::from(PARTS));
            let to = if part == PARTS { end } else { start + share * (end - start) };
            let after = self.value_between(to, index, watched);
            let extremum = self.extremum([from, to], [before, after], index, watched);
            for (t, value) in extremum.into_iter().chain([(to, after)]) {
                if let Some(is_rising) = direction.met(before, value) {
                    return Some(Bracket { from, to: t, is_rising });
                }
                // a value of zero keeps the sign that it had
                before = if value == zero { before } else { value };
                from = t;
            }
        }
        None
    }

    /// Where a value of the same sign at both ends of a part has the other sign between, if it
    /// does.
    fn extremum(
        &mut self,
        [from, to]: [D::Real; 2],
        [before, after]: [D::Real; 2],
        index: usize,
        watched: &mut Watched<'_, D>,
    ) -> Option<(D::Real, D::Real)> {
        let (number, zero) = (D::Real::from_f64, D::Real::default());
        let is_negative = after < zero;
        if after == zero || (before > zero && is_negative) || (before < zero && !is_negative) {
            return None;
        }
        // positive at both ends
        let mut distance = |run: &mut Self, t| {
            let value = run.value_between(t, index, watched);
            if is_negative { -value } else { value }
        };
        let little = number(SLOPE) * (to - from);
        let (near, far) = (distance(self, from), distance(self, to));
        if distance(self, from + little) >= near || distance(self, to - little) >= far {
            return None;
        }
        let golden = number(0.618_033_988_749_894_9);
        let (mut low, mut high) = (from, to);
        for _ in 0..SECTIONS {
            let width = golden * (high - low);
            let [left, right] = [high - width, low + width];
            let [of_left, of_right] = [left, right].map(|t| distance(self, t));
            // what has crossed zero is enough
            if let Some((t, found)) =
                [(left, of_left), (right, of_right)].into_iter().find(|(_, d)| *d < zero)
            {
                return Some((t, if is_negative { -found } else { found }));
            }
            (low, high) = if of_left < of_right { (low, right) } else { (left, high) };
        }
        None
    }

    /// A value at a time within the last step, by interpolation.
    fn value_between(&mut self, t: D::Real, index: usize, watched: &mut Watched<'_, D>) -> D::Real {
        let Self { before, now, next, dynamics, inputs, all, .. } = self;
        let moment = if t <= before.t {
            before
        } else if t >= now.t {
            now
        } else {
            before.interpolate(now, t, &mut next.q, &mut next.v);
            next.t = t;
            next
        };
        watched.value(index, (dynamics, inputs), moment, all)
    }

    /// A value at the end of a step from the start of the last one to `t`, projected; by
    /// interpolation where there is no such step.
    fn value_of_step(&mut self, t: D::Real, index: usize, watched: &mut Watched<'_, D>) -> D::Real {
        let Self { dynamics, inputs, before, next, attempt, all, .. } = self;
        match attempt.step((&*dynamics, Self::TABLEAU), inputs, before, t, next) {
            Some(growth) if is_healthy(growth, next) => watched.value(index, (dynamics, inputs), next, all),
            _ => self.value_between(t, index, watched),
        }
    }

    /// The time right behind a change of sign: first on the polynomial between the ends of the
    /// step, then with steps that end there, to rounding.
    fn locate(
        &mut self,
        index: usize,
        Bracket { from, to, is_rising }: Bracket<D::Real>,
        watched: &mut Watched<'_, D>,
    ) -> D::Real {
        let (number, zero) = (D::Real::from_f64, D::Real::default());
        // positive behind the event
        let signed = |value: D::Real| if is_rising { value } else { -value };
        let t = last_change([from, to], |t| signed(self.value_between(t, index, watched)));
        let mut stepped = |t: D::Real| signed(self.value_of_step(t, index, watched));
        // the error of the polynomial is a small part of the step
        let mut width = number(1e-6) * (to - from);
        let (mut low, mut high) = (t, t);
        for _ in 0..8 {
            (low, high) = ((t - width).max(from), (t + width).min(to));
            let is_before = low <= from || stepped(low) < zero;
            let is_behind = high >= to || stepped(high) >= zero;
            if is_before && is_behind {
                break;
            }
            width = number(16.0) * width;
        }
        last_change([low, high], stepped)
    }
}

impl<D: Dynamics> Watched<'_, D> {
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
        (self.values)(dynamics, inputs, at, self.room);
        self.room.get(index).copied().unwrap_or(D::Real::from_f64(f64::NAN))
    }
}

impl<M: Mechanism, S: Scheme> Adaptive<M, S> {
    /// Takes steps until one of some values of the state changes its sign, or until `end`.
    ///
    /// The state is then that right behind the change: the last step is made again with its end
    /// there, located to rounding, and projected onto the constraints. Events at the same time, or
    /// nearer to each other than rounding, are told by calls one after the other, in the order of
    /// their indices; others in the order of time.
    ///
    /// A value that is zero at the start has no sign yet and so no event; it gets its sign from
    /// what follows. A value that touches zero has no event. Each quarter of a step is looked
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
    /// As [`step`](Self::step), and [`Error::EndTime`] for an end that is past.
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
        };
        self.until(end, &mut watched)
    }
}
