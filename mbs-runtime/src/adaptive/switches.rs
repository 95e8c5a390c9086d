//! Values of the motion at whose knots laws bend or jump.
//!
//! A run looks at them at the ends of its steps. Behind a jump it takes steps as long as before, and where a jump
//! leads back to itself from both sides, it ends.

use super::corners::{Knots, floor};
use super::events::MOST_EVENTS;
use super::{Adaptive, AdaptiveScheme, Dynamics, Moment};
use crate::equations::At;
use crate::{Error, Real, vectors};

/// A value at whose knots laws bend or jump.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Switch {
    /// As people read it.
    pub name: &'static str,
    /// Its knots.
    pub knots: Knots,
}

/// Steps, beyond those that went on as they came, which turned back at a knot and after which a run has no motion to
/// follow.
const MOST_TURNS: u8 = 50;
/// Only steps shorter than this share of the longest one can be held by a knot,
const SHORT: f64 = 0.01;
/// and only those that are to change the value by more than so many roundings.
const ROUNDINGS: f64 = 1e5;
/// The share of a step over which the rate of a value is taken.
const RATE: f64 = 1e-4;
/// The estimate of the error of a step that passes a switch counts so many times.
const STRICT: f64 = 100.0;
/// Steps that grow again after a rejection are forgotten by this factor a step.
const FORGET: f64 = 0.9;

/// What a run remembers of the switches.
#[derive(Clone, Copy, Debug)]
pub(super) struct Switching {
    /// The pieces on which the values are, if they are known.
    pieces: Option<[f64; MOST_EVENTS]>,
    /// How many steps of each switch were turned back, less those that went on.
    turned: [u8; MOST_EVENTS],
    /// The length of steps before the last rejections in s.
    calm: f64,
}

impl Switching {
    pub const fn new() -> Self {
        Self { pieces: None, turned: [0; MOST_EVENTS], calm: 0.0 }
    }

    /// From another state, or with other inputs.
    pub fn go_on(&mut self) {
        *self = Self::new();
    }
}

impl Knots {
    /// The number of the piece on which a value is; knots count as pieces of their own.
    fn piece(&self, value: f64) -> f64 {
        let first = self.at.first().copied().unwrap_or_default();
        let rounds = if self.period > 0.0 { floor((value - first) / self.period) } else { 0.0 };
        let within = value - rounds * self.period;
        let [below, reached] =
            [self.at.partition_point(|knot| *knot < within), self.at.partition_point(|knot| *knot <= within)];
        2.0 * rounds * self.at.len() as f64 + (below + reached) as f64
    }
}

impl<D: Dynamics, S: AdaptiveScheme> Adaptive<D, S> {
    /// Looks at the switches at the end of a step.
    ///
    /// # Errors
    /// [`Error::Sliding`].
    pub(super) fn look_at_switches(&mut self, was_rejected: bool) -> Result<(), Error> {
        let switches = self.dynamics.equations().switching();
        if switches.is_empty() {
            return Ok(());
        }
        let next = self.control.next;
        let calm = if was_rejected { 0.0 } else { next };
        self.switching.calm = calm.max(FORGET * self.switching.calm);
        let values = self.switch_values(false, 0.0);
        let mut pieces = [0.0; MOST_EVENTS];
        for ((piece, value), switch) in pieces.iter_mut().zip(values).zip(switches) {
            *piece = switch.knots.piece(value.to_f64());
        }
        let Some(before) = self.switching.pieces.replace(pieces) else { return Ok(()) };
        let is_short = (self.now.t - self.before.t).to_f64() < SHORT * self.effort.longest;
        if pieces == before && !is_short {
            return Ok(());
        }
        let at = |is_before: bool, run: &mut Self| {
            [0.0, RATE, -RATE].map(|share| run.switch_values(is_before, share))
        };
        let ways = [at(true, self), at(false, self)];
        for (index, (switch, turns)) in switches.iter().zip(&mut self.switching.turned).enumerate() {
            let of = |[value, ahead, behind]: &[[D::Real; MOST_EVENTS]; 3]| {
                let [value, ahead, behind] = [value, ahead, behind].map(|values| values.get(index).copied());
                Some((value?.to_f64(), ahead?.to_f64() - behind?.to_f64()))
            };
            let (Some(from), Some(to)) = (before.get(index), pieces.get(index)) else { continue };
            let [Some(start), Some(end)] = ways.each_ref().map(of) else { continue };
            let is_passed = from != to && !to.is_nan();
            let is_turned =
                if is_passed { turned_behind(start, end) } else { is_held::<D::Real>(start, end) };
            match is_turned {
                true => *turns += 1,
                false if is_passed => {
                    *turns = 0;
                    self.control.next = next.max(self.switching.calm);
                }
                false => *turns = turns.saturating_sub(1),
            }
            if *turns >= MOST_TURNS {
                return Err(Error::Sliding { t: self.now.t.to_f64(), name: switch.name });
            }
        }
        Ok(())
    }

    /// The values at the start or the end of the last step, and a share of it later.
    fn switch_values(&mut self, is_before: bool, share: f64) -> [D::Real; MOST_EVENTS] {
        let Self { before, now, next, .. } = self;
        let dt = D::Real::from_f64(share) * (now.t - before.t);
        let from = if is_before { before } else { now };
        next.t = from.t + dt;
        for (to, x, rate) in [(&mut next.q, &from.q, &from.v), (&mut next.v, &from.v, &from.a)] {
            vectors::copy(to.as_mut(), x.as_ref());
            vectors::add_scaled(to.as_mut(), dt, rate.as_ref());
        }
        self.switches_of_next()
    }

    /// The values at the end of the step that was tried.
    fn switches_of_next(&mut self) -> [D::Real; MOST_EVENTS] {
        let Self { dynamics, inputs, next: Moment { t, q, v, .. }, all, .. } = self;
        dynamics.complete(*t, q, v, all);
        let [q, v] = all;
        let at = At { t: *t, q: q.as_ref(), v: v.as_ref() };
        let mut values = [D::Real::from_f64(f64::NAN); MOST_EVENTS];
        let equations = dynamics.described();
        dynamics.with_inputs(&mut inputs.clone(), |inputs| equations.switches(at, inputs, &mut values));
        values
    }

    /// The error of a step that was tried, as it is judged: of one that passes a switch the estimate, which sees
    /// the two sides with weights of the scheme, may be much less than the error.
    pub(super) fn judged(&mut self, ratio: f64) -> f64 {
        let switches = self.dynamics.equations().switching();
        let Some(pieces) = self.switching.pieces.filter(|_| ratio <= 1.0 && !switches.is_empty()) else {
            return ratio;
        };
        let values = self.switches_of_next();
        let mut ends = values.iter().zip(switches).zip(pieces);
        let passes = ends.any(|((value, switch), piece)| switch.knots.piece(value.to_f64()) != piece);
        if passes { STRICT * ratio } else { ratio }
    }
}

/// Reports whether a value that has passed a knot in a step, from a value with a change over two shares [`RATE`] of
/// it to another one, runs back towards the knot.
fn turned_behind((from, came): (f64, f64), (to, goes): (f64, f64)) -> bool {
    came * (to - from) > 0.0 && came * goes < 0.0
}

/// Reports whether a value did not go half of the way that its rates at both ends of a short step tell.
fn is_held<T: Real>((from, came): (f64, f64), (to, goes): (f64, f64)) -> bool {
    // by the trapezoidal rule
    let expected = (came + goes) / (4.0 * RATE);
    let rounding = ROUNDINGS * T::EPSILON.to_f64() * from.abs().max(to.abs());
    came * goes > 0.0 && came.signum() * (to - from) < 0.5 * expected.abs() && expected.abs() > rounding
}
