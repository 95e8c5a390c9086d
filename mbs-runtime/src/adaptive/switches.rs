//! Values of the motion at whose knots laws bend or jump.
//!
//! A run looks at them at the ends of its steps. Behind a jump it takes steps as long as before, and where a jump
//! leads back to itself from both sides, it ends.

use super::switching::Switching;
use super::{Adaptive, AdaptiveScheme, Dynamics, Moment};
use crate::corners::MOST_SWITCHES;
use crate::equations::At;
use crate::{Error, Real, vectors};

/// A run ends where three looks in sequence find that a knot leads back to itself from both sides, or sixty that a value
/// has turned around at it,
const MOST_TURNS: u8 = 60;
const LEADS_BACK: u8 = 20;
const TURNED: u8 = 1;
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
/// Steps that grow again after a rejection are forgotten by this factor a step.
const FORGET: f64 = 0.9;

impl<D: Dynamics, S: AdaptiveScheme> Adaptive<D, S> {
    /// Looks at the switches at the end of a step.
    ///
    /// # Errors
    /// [`Error::Sliding`] and [`Error::Undecided`].
    pub(super) fn look_at_switches(&mut self, was_rejected: bool) -> Result<(), Error> {
        let switches = self.dynamics.equations().switching();
        if switches.is_empty() {
            return Ok(());
        }
        let next = self.control.next;
        let calm = if was_rejected { 0.0 } else { next };
        self.switching.calm = calm.max(FORGET * self.switching.calm);
        let now = self.now.clone();
        let values = self.switches_at(&now, 0.0);
        let mut pieces = [0.0; MOST_SWITCHES];
        for ((piece, value), switch) in pieces.iter_mut().zip(values).zip(switches) {
            *piece = switch.knots.piece(value);
        }
        let Some(before) = self.switching.pieces.replace(pieces) else { return Ok(()) };
        if pieces != before {
            self.control.next = next.max(self.switching.calm);
        }
        if was_rejected { self.look_ahead(now, values, [before, pieces]) } else { Ok(()) }
    }

    /// Looks behind the knots to which values run.
    fn look_ahead(
        &mut self,
        mut now: Moment<D::Real, D::States>,
        values: [f64; MOST_SWITCHES],
        [before, pieces]: [[f64; MOST_SWITCHES]; 2],
    ) -> Result<(), Error> {
        let rates = self.rates(&mut now);
        let mut start = self.before.clone();
        let rates_before = self.rates(&mut start);
        let size =
            vectors::largest(now.v.as_ref()).1.to_f64().max(vectors::largest(now.a.as_ref()).1.to_f64());
        let rounding =
            vectors::largest(now.q.as_ref()).1.to_f64().max(size) * ROUNDINGS * D::Real::EPSILON.to_f64();
        let held = (HELD * size).max(rounding / (RATE * self.effort.longest));
        let h = (now.t - self.before.t).to_f64();
        let near = if h < SHORT * self.effort.longest { NEAR * h } else { 0.0 };
        for (index, switch) in self.dynamics.equations().switching().iter().enumerate() {
            let all = (values.get(index), rates.get(index), before.get(index), pieces.get(index));
            let (Some(&value), Some(&rate), Some(from), Some(to)) = all else { continue };
            let is_passed = from != to;
            let t = self.now.t.to_f64();
            if rate.abs() <= held {
                if is_passed && self.count(index, 1, |switching| &mut switching.rounded) >= MOST_ROUNDED {
                    return Err(Error::Undecided { t, name: switch.name });
                }
                continue;
            }
            let knot = switch.knots.ahead(value, rate > 0.0);
            let until = knot.map_or(f64::INFINITY, |knot| (knot - value) / rate);
            let came = rates_before.get(index).copied().unwrap_or(f64::NAN) * (to - from);
            let found = if until <= near && self.leads_back(&now, index, rate, until) {
                LEADS_BACK
            } else if is_passed && came > 0.0 && rate * (to - from) < 0.0 {
                TURNED
            } else if is_passed {
                if let Some(turned) = self.switching.turned.get_mut(index) {
                    *turned = 0;
                }
                continue;
            } else {
                continue;
            };
            if self.count(index, found, |switching| &mut switching.turned) >= MOST_TURNS {
                return Err(Error::Sliding { t, name: switch.name });
            }
        }
        Ok(())
    }

    /// Counts more of what is remembered of a switch.
    fn count(&mut self, index: usize, more: u8, of: fn(&mut Switching) -> &mut [u8; MOST_SWITCHES]) -> u8 {
        let Some(count) = of(&mut self.switching).get_mut(index) else { return 0 };
        *count = count.saturating_add(more);
        *count
    }

    /// Reports whether a value that comes to its knot after some time has the opposite rate right behind it, by a jump:
    /// by how the rate changes on this side it would go on.
    fn leads_back(&mut self, now: &Moment<D::Real, D::States>, index: usize, rate: f64, until: f64) -> bool {
        let half = 0.5 * until;
        let behind = 2.0 * until + BEHIND * self.effort.longest;
        let [here, there] = [half, behind].map(|dt| {
            let mut moment = moved(now, dt);
            self.rates(&mut moment).get(index).copied().unwrap_or(f64::NAN)
        });
        let expected = if half > 0.0 { rate + (here - rate) * behind / half } else { rate };
        expected * rate > 0.0 && there * rate < 0.0
    }

    /// The rates of the values in a state, whose accelerations are found.
    fn rates(&mut self, moment: &mut Moment<D::Real, D::States>) -> [f64; MOST_SWITCHES] {
        let Moment { t, q, v, a } = moment;
        self.dynamics.acceleration(*t, q, v, &self.inputs, a);
        let dt = RATE * self.effort.longest;
        let [ahead, behind] = [dt, -dt].map(|dt| self.switches_at(moment, dt));
        let mut rates = [f64::NAN; MOST_SWITCHES];
        for (rate, (ahead, behind)) in rates.iter_mut().zip(ahead.iter().zip(behind)) {
            *rate = (ahead - behind) / (2.0 * dt);
        }
        rates
    }

    /// The values in a state, some time later.
    fn switches_at(&mut self, moment: &Moment<D::Real, D::States>, dt: f64) -> [f64; MOST_SWITCHES] {
        let Self { dynamics, inputs, all, .. } = self;
        let Moment { t, q, v, .. } = if dt == 0.0 { moment.clone() } else { moved(moment, dt) };
        dynamics.complete(t, &q, &v, all);
        let [q, v] = all;
        let at = At { t, q: q.as_ref(), v: v.as_ref() };
        let mut values = [D::Real::from_f64(f64::NAN); MOST_SWITCHES];
        let equations = dynamics.described();
        dynamics.with_inputs(&mut inputs.clone(), |inputs| equations.switches(at, inputs, &mut values));
        values.map(Real::to_f64)
    }

    /// The error of a step that was tried, as it is judged: of one that passes a switch the estimate, which sees
    /// the two sides with weights of the scheme, may be much less than the error.
    pub(super) fn judged(&mut self, ratio: f64) -> f64 {
        let switches = self.dynamics.equations().switching();
        let Some(pieces) = self.switching.pieces.filter(|_| ratio <= 1.0 && !switches.is_empty()) else {
            return ratio;
        };
        let next = self.next.clone();
        let values = self.switches_at(&next, 0.0);
        let known = switches.iter().zip(pieces).zip(self.switching.rounded);
        // rounding decides of which piece a value is that is held
        let mut ends = values.into_iter().zip(known).filter(|(_, (_, rounded))| *rounded == 0);
        let passes = ends.any(|(value, ((switch, piece), _))| switch.knots.piece(value) != piece);
        if passes { STRICT * ratio } else { ratio }
    }
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
