//! Looks through a step for changes of sign.

use super::attempt::is_healthy;
use super::change::last_change;
use super::events::{Happened, Watched};
use super::gaps::{self, bits};
use super::{Adaptive, AdaptiveScheme, Dynamics};
use crate::{Error, Real, vectors};

/// A step is looked through in so many parts of equal length.
pub(super) const PARTS: u32 = 4;
/// The share of a part over which slopes are taken.
const SLOPE: f64 = 1e-5;
/// Golden sections of a part, after which its extremum is known to a thousandth of its length.
const SECTIONS: u32 = 16;

/// A value that is a smaller share than this of the largest one in a step may be zero at its start,
const NEAR: f64 = 1e-9;
/// and is, until it has changed by so many roundings of the polynomial, or so many times by the least that it
/// changes: what a thousandth of it is rounding of, an impact loses.
const ROUNDINGS: f64 = 512.0;
const CHANGES: f64 = 1024.0;
/// The first part of a step is halved so often, to see a value leave zero, of which the shortest tell
/// how it is rounded.
const HALVINGS: u32 = 48;
const SHORTEST: u32 = 8;
/// The share of a step over which the rate of a value is taken where a program has turned it,
const RATE: f64 = 1e-4;
/// and the share of the rate before that counts as none.
const STILL: f64 = 1e-6;

/// Two times between which a value changes its sign.
#[derive(Clone, Copy)]
pub(super) struct Bracket<T> {
    pub from: T,
    pub to: T,
    pub is_rising: bool,
}

/// From when on a value has a sign, the value then, and how it is rounded.
struct Beginning<T> {
    /// The value at the start of the step, if its sign counts.
    first: T,
    t: T,
    value: T,
    rounding: T,
    /// `true` if a value that begins at its event is zero to rounding in the whole step.
    is_zero: bool,
}

impl<D: Dynamics, S: AdaptiveScheme> Adaptive<D, S> {
    /// Looks for the first event in the last step. If there is one, the step ends right behind it,
    /// and whatever has happened by then is due. Where the step that ends there does not meet the tolerance, the run
    /// is where it began.
    ///
    /// # Errors
    /// [`Error::EndlessEvents`]; the run is then where the step began.
    pub(super) fn look_back(&mut self, watched: &mut Watched<'_, D>) -> Result<(), Error> {
        if watched.bits(&self.dynamics).next().is_none() {
            return Ok(());
        }
        self.look_between();
        if self.leave(watched)? {
            return Ok(());
        }
        let mut first: Option<(D::Real, usize)> = None;
        for (index, _) in watched.bits(&self.dynamics) {
            if let Some(bracket) = self.bracket(index, watched) {
                let t = self.locate(index, bracket, watched);
                first = first.filter(|(earlier, _)| *earlier <= t).or(Some((t, index)));
            }
        }
        let is_shorter = self.is_shorter();
        let Some((first, which)) = first.filter(|_| !is_shorter) else { return self.check_gaps() };
        let mut happened = self.happened;
        for (index, bit) in watched.bits(&self.dynamics) {
            if let Some(bracket) = self.bracket(index, watched)
                && self.locate(index, bracket, watched) <= first
            {
                happened.all |= bit;
                happened.rising = happened.rising & !bit | if bracket.is_rising { bit } else { 0 };
            }
        }
        let first = self.differentiated(first, which, watched);
        if !self.end_at(first)? {
            return Ok(());
        }
        // what happens is no longer kept from before
        let kept = !happened.all;
        let (judged, turned) = (happened.judged & kept, happened.turned & kept);
        self.happened = Happened { due: happened.all, judged, turned, ..happened };
        self.reach_stops();
        Ok(())
    }

    /// Looks at values that were at their events where the step began, in a state that a program has set
    /// there. One that is zero still is looked at again after the next step. True if it is the gap of a stop that
    /// is not left: the run is then where the step began, and rests on it.
    ///
    /// # Errors
    /// [`Error::EndlessEvents`] of one that the program has turned around, and that is back behind its event
    /// before it has left zero by more than rounding; the run is then where the step began.
    fn leave(&mut self, watched: &mut Watched<'_, D>) -> Result<bool, Error> {
        let Happened { all, rising, judged, turned, is_set, .. } = self.happened_before;
        let at_events = if is_set { all | judged } else { judged };
        let mut kept = Happened::default();
        let stops = gaps::watched(0, self.dynamics.info());
        for (index, bit) in stops.chain(bits(watched.count)).filter(|(_, bit)| at_events & bit != 0) {
            let is_rising = rising & bit != 0;
            let Beginning { value, rounding, is_zero, .. } = self.beginning(index, watched);
            let is_turned = match judged & bit != 0 {
                true => turned & bit != 0,
                false => self.is_turned(index, is_rising, rounding, watched),
            };
            if is_zero || self.is_held_by_others(index, watched) || self.is_idle_at_stops(index) {
                kept.judged |= bit;
                kept.rising |= rising & bit;
                kept.turned |= if is_turned { bit } else { 0 };
            } else if is_turned && is_rising == (value > D::Real::default()) {
                let events = self.dynamics.info().events;
                let declared = events.get(index).filter(|_| watched.is_declared);
                let stop = gaps::stop_in(self.dynamics.equations(), index);
                let known = stop.and_then(|_| self.dynamics.info().event_name(index));
                let name = declared.map(|event| event.name).or(known).unwrap_or("");
                self.step_back();
                if stop.is_some_and(|stop| self.is_stuck(stop)) {
                    return Ok(true);
                }
                return Err(Error::EndlessEvents { t: self.now.t.to_f64(), name, index });
            }
        }
        self.happened = kept;
        Ok(false)
    }

    /// Reports whether a program has turned a value around at its event: in the state that it has set, the value does
    /// not go on past the event as it came. Rates below rounding count as none.
    fn is_turned(
        &mut self,
        index: usize,
        is_rising: bool,
        rounding: D::Real,
        watched: &mut Watched<'_, D>,
    ) -> bool {
        let share = D::Real::from_f64(RATE) * (self.now.t - self.before.t);
        let mut rate = |is_arrival: bool| {
            let mut value = |dt: D::Real| {
                let Self { arrival, before, next, dynamics, inputs, all, .. } = self;
                let from = if is_arrival { arrival } else { before };
                next.t = from.t + dt;
                for (to, x, rate) in [(&mut next.q, &from.q, &from.v), (&mut next.v, &from.v, &from.a)] {
                    vectors::copy(to.as_mut(), x.as_ref());
                    vectors::add_scaled(to.as_mut(), dt, rate.as_ref());
                }
                watched.value(index, (dynamics, inputs), next, all)
            };
            let behind = value(-share);
            let rate = value(share) - behind;
            if is_rising { rate } else { -rate }
        };
        let came = rate(true);
        let goes = rate(false);
        goes <= D::Real::from_f64(STILL) * came + rounding
    }

    /// Where a value changes its sign for the first time in the last step, on the polynomial
    /// between its ends.
    ///
    /// A value that has the same sign at both ends of a part, and runs towards zero at the first
    /// and away from it at the second, may have crossed zero twice: its extremum decides.
    fn bracket(&mut self, index: usize, watched: &mut Watched<'_, D>) -> Option<Bracket<D::Real>> {
        let (number, zero) = (D::Real::from_f64, D::Real::default());
        let direction = watched.direction(&self.dynamics, index)?;
        let (start, end) = (self.before.t, self.now.t);
        if D::JUMPS
            && let Some(transition) = gaps::transition_in(self.dynamics.equations(), index)
        {
            return self.beginning_to_hold(index, transition, watched);
        }
        let Beginning { first, t: mut from, value: mut before, is_zero, .. } = self.beginning(index, watched);
        if is_zero || self.is_held_by_others(index, watched) {
            return None;
        }
        if let Some(is_rising) = direction.met(first, before) {
            return Some(Bracket { from: start, to: from, is_rising });
        }
        // friction that holds with all that it can at the start, and then more
        if D::JUMPS && first == zero && before < zero && !self.is_at_event(index) && self.is_sticking(index) {
            return Some(Bracket { from: start, to: from, is_rising: false });
        }
        if D::JUMPS && gaps::stop_in(self.dynamics.equations(), index).is_some() {
            return self.closing(index, (from, before), watched);
        }
        for part in 1..=PARTS {
            let share = number(f64::from(part) / f64::from(PARTS));
            let to = if part == PARTS { end } else { start + share * (end - start) };
            if to <= from {
                continue;
            }
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

    /// True if a value was at its event where the last step began.
    fn is_at_event(&self, index: usize) -> bool {
        let Happened { all, judged, is_set, .. } = self.happened_before;
        let bit = u32::try_from(index).ok().and_then(|index| 1_u64.checked_shl(index)).unwrap_or(0);
        (judged | if is_set { all } else { 0 }) & bit != 0
    }

    /// From where on a value has a sign in the last step. In a state that a program has set it is zero if it
    /// is that to rounding, and has then the sign with which it leaves zero.
    fn beginning(&mut self, index: usize, watched: &mut Watched<'_, D>) -> Beginning<D::Real> {
        let number = D::Real::from_f64;
        let (start, end) = (self.before.t, self.now.t);
        let value = self.value_between(start, index, watched);
        let (is_set, is_at_event) = (self.happened_before.is_set, self.is_at_event(index));
        // at its event a value has a sign by rounding
        let first = if is_at_event { D::Real::default() } else { value };
        let mut found = Beginning { first, t: start, value, rounding: D::Real::default(), is_zero: false };
        if !is_set && !is_at_event {
            return found;
        }
        let mut largest = value.abs();
        for part in 1..=PARTS {
            let t = start + number(f64::from(part) / f64::from(PARTS)) * (end - start);
            largest = largest.max(self.value_between(t, index, watched).abs());
        }
        if !is_at_event && value.abs() > number(NEAR) * largest {
            return found;
        }
        found.rounding = value.abs();
        // of what the polynomial adds to the start
        let rounded = number(ROUNDINGS) * D::Real::EPSILON * largest;
        let mut share = (0..HALVINGS).fold(number(1.0), |share, _| number(0.5) * share);
        // the least change, which is that by one rounding where the value is a difference of larger ones
        let (mut last, mut least) = (value, number(f64::INFINITY));
        for halving in 0..=HALVINGS {
            let t = start + share * (end - start);
            let value = self.value_between(t, index, watched);
            let change = (value - last).abs();
            least = if change > D::Real::default() { least.min(change) } else { least };
            last = value;
            let rounded = (share * rounded).max(number(CHANGES) * least);
            if halving < SHORTEST {
                found.rounding = found.rounding.max(value.abs());
            } else if value.abs() > rounded.max(number(4.0) * found.rounding) {
                return Beginning { t, value, ..found };
            }
            share = number(2.0) * share;
        }
        Beginning { is_zero: is_at_event, ..found }
    }

    /// Where a value of the same sign at both ends of a part has the other sign between, if it
    /// does.
    pub(super) fn extremum(
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
            let (of_left, of_right) = (distance(self, left), distance(self, right));
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
    pub(super) fn value_between(
        &mut self,
        t: D::Real,
        index: usize,
        watched: &mut Watched<'_, D>,
    ) -> D::Real {
        let Self { before, now, next, dynamics, inputs, attempt, all, between, .. } = self;
        let moment = if t <= before.t {
            before
        } else if t >= now.t {
            now
        } else {
            before.between(between.terms(), now, t, &mut next.q, &mut next.v);
            next.t = t;
            if S::RELAXES {
                before.acceleration(now, t, &mut next.a);
                S::relax((&*dynamics, &*inputs), now.t - before.t, &mut attempt.there, next);
            }
            next
        };
        watched.value(index, (dynamics, inputs), moment, all)
    }

    /// A value at the end of a step from the start of the last one to `t`, projected; by
    /// interpolation where there is no such step.
    pub(super) fn value_of_step(
        &mut self,
        t: D::Real,
        index: usize,
        watched: &mut Watched<'_, D>,
    ) -> D::Real {
        let Self { dynamics, inputs, before, next, attempt, all, between, .. } = self;
        between.lose_stages();
        match attempt.step::<D, S>((&*dynamics, &*inputs), before, t, next) {
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
