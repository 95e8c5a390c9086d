//! Values of the motion at whose knots laws bend or jump.
//!
//! A run looks at them at the ends of its steps. Behind a jump it takes steps as long as before, and where a jump
//! leads back to itself from both sides, it ends.

use super::{Adaptive, AdaptiveScheme, Dynamics, Moment};
use crate::corners::{MOST_SWITCHES, Switch};
use crate::equations::At;
use crate::{Error, Real, vectors};

/// A run ends where so many looks in sequence find that a jump leads back to itself from both sides,
const MOST_TURNS: u8 = 3;
/// or where so many steps passed a knot by rounding alone.
const MOST_ROUNDED: u8 = 100;
/// A knot is looked at from as many steps before it,
const NEAR: f64 = 4.0;
/// which are shorter than this share of the longest one.
const SHORT: f64 = 1e-5;
/// The share of the longest step over which the rate of a value is taken,
const RATE: f64 = 1e-5;
/// and how far behind a knot the rate is taken at least.
const BEHIND: f64 = 1e-9;
/// Roundings of a value within which its rate is not known.
const ROUNDINGS: f64 = 64.0;
/// A value whose rate is less than this share of the rates of the states is held, but for rounding.
const HELD: f64 = 1e-9;
/// The estimate of the error of a step that passes a switch counts so many times.
const STRICT: f64 = 100.0;
/// A step longer than this share of the longest one so far is looked into by these shares at most, where its ends see nothing of
/// a knot,
const LONG: f64 = 0.25;
const LOOK: f64 = 1.0 / 32.0;
/// and a shorter one by these.
const SHORT_LOOK: f64 = 0.25;
/// Steps that grow again after a rejection are forgotten by this factor a step.
const FORGET: f64 = 0.9;

impl<D: Dynamics, S: AdaptiveScheme> Adaptive<D, S> {
    /// Looks at the switches at the end of a step.
    ///
    /// # Errors
    /// [`Error::Sliding`] and [`Error::Undecided`].
    pub(super) fn look_at_switches(&mut self, was_rejected: bool) -> Result<(), Error> {
        let switches = self.dynamics.switching();
        if !D::SWITCHES || switches.is_empty() {
            return Ok(());
        }
        let next = self.control.next;
        let calm = if was_rejected { 0.0 } else { next };
        self.switching.calm = calm.max(FORGET * self.switching.calm);
        let Self { dynamics, inputs, now, all, .. } = self;
        let values = switches_at((&*dynamics, &*inputs), now, all);
        let pieces = pieces_of(switches, values);
        let Some(before) = self.switching.pieces.replace(pieces) else { return Ok(()) };
        if pieces != before {
            self.control.next = next.max(self.switching.calm);
        }
        let passed = vectors::each(&mut |index| pieces.get(index) != before.get(index));
        if was_rejected { self.look_ahead(values, passed) } else { Ok(()) }
    }

    /// Looks behind the knots to which values run; some were passed in the last step.
    fn look_ahead(
        &mut self,
        values: [f64; MOST_SWITCHES],
        passed: [bool; MOST_SWITCHES],
    ) -> Result<(), Error> {
        let mut now = self.now.clone();
        let rates = self.rates(&mut now);
        let held = self.held(&now, 0.0);
        let h = (now.t - self.before.t).to_f64();
        let near = if h < SHORT * self.effort.longest { NEAR * h } else { 0.0 };
        let switches = self.dynamics.switching().iter().enumerate();
        for ((((index, switch), value), rate), is_passed) in switches.zip(values).zip(rates).zip(passed) {
            let t = self.now.t.to_f64();
            if rate.abs() <= held {
                let count = self.switching.rounded.get_mut(index);
                // of a law that only bends, rounding decides nothing
                if is_passed && counted(count) >= MOST_ROUNDED && switch.knots.jumps {
                    return Err(Error::Undecided { t, name: switch.name });
                }
                continue;
            }
            let knot = switch.knots.ahead(value, rate > 0.0);
            let until = knot.map_or(f64::INFINITY, |knot| (knot - value) / rate);
            let leads_back = until <= near && self.leads_back(&now, index, rate, until);
            let count = self.switching.turned.get_mut(index);
            if leads_back {
                if counted(count) >= MOST_TURNS {
                    return Err(Error::Sliding { t, name: switch.name });
                }
            } else if let Some(count) = count.filter(|_| is_passed) {
                *count = 0;
            }
        }
        Ok(())
    }

    /// The rate of a value up to which it is held, but for rounding; in steps that may be as long as one.
    pub(super) fn held(&self, now: &Moment<D::Real, D::States>, step: f64) -> f64 {
        let largest = |x: &D::States| vectors::largest(x.as_ref()).1.to_f64();
        let (q, v, a) = (largest(&now.q), largest(&now.v), largest(&now.a));
        let rounding = ROUNDINGS * D::Real::EPSILON.to_f64() * q.max(v).max(a);
        (HELD * v.max(a)).max(rounding / (RATE * self.effort.longest.max(step)))
    }

    /// Reports whether a value that comes to its knot after some time has the opposite rate right behind it, by a jump:
    /// by how the rate changes on this side it would go on.
    fn leads_back(&mut self, now: &Moment<D::Real, D::States>, index: usize, rate: f64, until: f64) -> bool {
        let half = 0.5 * until;
        let behind = 2.0 * until + BEHIND * self.effort.longest;
        let mut rate_after = |dt: f64| {
            let mut moment = moved(now, dt);
            self.rates(&mut moment).get(index).copied().unwrap_or(f64::NAN)
        };
        let (here, there) = (rate_after(half), rate_after(behind));
        let expected = if half > 0.0 { rate + (here - rate) * behind / half } else { rate };
        expected * rate > 0.0 && there * rate < 0.0
    }

    /// The rates of the values in a state, whose accelerations are found.
    fn rates(&mut self, moment: &mut Moment<D::Real, D::States>) -> [f64; MOST_SWITCHES] {
        let Self { dynamics, inputs, all, effort, .. } = self;
        let Moment { t, q, v, a } = &mut *moment;
        dynamics.acceleration(*t, q, v, inputs, a);
        let dt = RATE * effort.longest;
        let mut values = |dt: f64| switches_at((&*dynamics, &*inputs), &moved(moment, dt), all);
        let (ahead, behind) = (values(dt), values(-dt));
        vectors::each(&mut |index| match (ahead.get(index), behind.get(index)) {
            (Some(ahead), Some(behind)) => (ahead - behind) / (2.0 * dt),
            _ => f64::NAN,
        })
    }

    /// The error of a step that was tried, as it is judged: of one that passes a switch the estimate, which sees
    /// the two sides with weights of the scheme, may be much less than the error.
    pub(super) fn judged(&mut self, ratio: f64) -> f64 {
        let switches = self.dynamics.switching();
        let is_good = ratio <= 1.0;
        if !D::SWITCHES || switches.is_empty() || !is_good {
            return ratio;
        }
        let Self { dynamics, inputs, next, all, .. } = self;
        let values = switches_at((&*dynamics, &*inputs), next, all);
        let (ends, rounded) = (pieces_of(switches, values), self.switching.rounded);
        let pieces = match self.switching.pieces {
            Some(pieces) => pieces,
            None => self.begun(ends),
        };
        // rounding decides of which piece a value is that is held
        let counts = |index: usize| rounded.get(index) == Some(&0);
        let is_long = (self.next.t - self.now.t).to_f64() > LONG * self.effort.longest;
        let longest = if is_long { LOOK } else { SHORT_LOOK };
        let unknown = self.unknown(self.next.clone(), values);
        if self.runs_through([pieces, ends, unknown], longest, counts) {
            return self.halved();
        }
        let stays = self.stays(values);
        let counts = |index: usize| counts(index) && stays.get(index) == Some(&false);
        let passes = |index: usize| counts(index) && ends.get(index) != pieces.get(index);
        if !(0..switches.len()).any(passes) {
            return ratio;
        }
        let left_out = self.left_out(pieces, values, counts);
        (STRICT * ratio).max(left_out)
    }

    /// The values that have not passed a knot but for rounding in the step that was tried: a shorter one may not move them.
    /// They end at it; with explicit schemes they begin there, too, since these may pass it in a long step.
    fn stays(&mut self, ends: [f64; MOST_SWITCHES]) -> [bool; MOST_SWITCHES] {
        let roundings = self.roundings(self.next.clone(), ends);
        let at_end = self.at_knots([ends, roundings]);
        if S::RELAXES {
            return at_end;
        }
        let Self { dynamics, inputs, now, all, .. } = self;
        let begins = switches_at((&*dynamics, &*inputs), now, all);
        let at_start = self.at_knots([begins, roundings]);
        vectors::each(&mut |index| at_end.get(index) == Some(&true) && at_start.get(index) == Some(&true))
    }

    /// The pieces on which the values are that a run begins with. One that begins at a knot passes none there: it is on the
    /// piece of its end.
    fn begun(&mut self, ends: [f64; MOST_SWITCHES]) -> [f64; MOST_SWITCHES] {
        let Self { dynamics, inputs, now, all, .. } = self;
        let values = switches_at((&*dynamics, &*inputs), now, all);
        let begins = pieces_of(self.dynamics.switching(), values);
        let unknown = self.unknown(self.now.clone(), values);
        let at_knots = self.at_knots([values, unknown]);
        vectors::each(&mut |index| match (begins.get(index), ends.get(index), at_knots.get(index)) {
            (Some(begin), Some(end), at_knot) if is_knot(*begin) || at_knot == Some(&true) => *end,
            (begin, _, _) => begin.copied().unwrap_or_default(),
        })
    }
}

/// True if a piece is a knot.
fn is_knot(piece: f64) -> bool {
    0.5 * piece != crate::spline::floor(0.5 * piece)
}

/// The pieces on which values are.
fn pieces_of(switches: &[Switch], values: [f64; MOST_SWITCHES]) -> [f64; MOST_SWITCHES] {
    let mut pieces = [0.0; MOST_SWITCHES];
    for ((piece, value), switch) in pieces.iter_mut().zip(values).zip(switches) {
        *piece = switch.knots.piece(value);
    }
    pieces
}

/// Counts one more; 0 where nothing is counted.
fn counted(count: Option<&mut u8>) -> u8 {
    count.map_or(0, |count| {
        *count = count.saturating_add(1);
        *count
    })
}

/// The values of the switches in a state, with room for all coordinates.
pub(super) fn switches_at<D: Dynamics>(
    (dynamics, inputs): (&D, &D::Inputs),
    Moment { t, q, v, .. }: &Moment<D::Real, D::States>,
    all: &mut [D::Coordinates; 2],
) -> [f64; MOST_SWITCHES] {
    dynamics.complete(*t, q, v, all);
    let [q, v] = all;
    let at = At { t: *t, q: q.as_ref(), v: v.as_ref() };
    let mut values = [D::Real::from_f64(f64::NAN); MOST_SWITCHES];
    let equations = dynamics.equations();
    dynamics.with_inputs(&mut inputs.clone(), |inputs| equations.switches(at, inputs, &mut values));
    vectors::numbers(&values)
}

/// A state some time later, with the velocities and accelerations that it has.
fn moved<T: Real, V: Clone + AsRef<[T]> + AsMut<[T]>>(from: &Moment<T, V>, dt: f64) -> Moment<T, V> {
    let dt = T::from_f64(dt);
    let mut moved = from.clone();
    moved.t = from.t + dt;
    vectors::add_scaled(moved.q.as_mut(), dt, from.v.as_ref());
    vectors::add_scaled(moved.v.as_mut(), dt, from.a.as_ref());
    moved
}
