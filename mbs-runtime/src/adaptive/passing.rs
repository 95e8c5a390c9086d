//! Steps over several knots at once.
//!
//! The estimate of the error knows both sides of a knot that a step passes. Between two knots lies a piece, such as a
//! narrow zone of a force, that no stage of the step may have met.

use super::switches::switches_at;
use super::{Adaptive, AdaptiveScheme, Dynamics, Moment};
use crate::corners::MOST_SWITCHES;
use crate::{Real, vectors};

/// A step in which a value passes more knots is not taken.
const MOST_PASSED: f64 = 4.0;
/// A step with more passages in all is not taken. Many values may pass at once, as those of six balls that fall on a floor.
const MOST_PASSAGES: usize = MOST_SWITCHES;
/// The share of a step below which what lies between two knots does not count with implicit schemes.
const NARROW: f64 = 1e-6;
/// Nor does a time of so many roundings.
const INSTANT: f64 = 64.0;
/// Such schemes stand at a knot within so many times what a rounding of the state changes its value by.
const ROUNDINGS: f64 = 64.0;
/// Shares of a step between which changes of rates are known at first, and that over which rates are taken.
const RATES: [f64; 3] = [0.0, 0.5, 1.0 - SLOPE];
const SLOPE: f64 = 1e-6;
/// A knot is reached within this share of a step,
const NEAREST: f64 = 1e-6;
/// and passed within so many of them.
const BEHIND: f64 = 4.0;
/// The most looks into a step.
const LOOKS: u32 = 128;
/// Halvings of a step, after which the time of a knot is known.
const HALVINGS: u32 = 30;

impl<D: Dynamics, S: AdaptiveScheme> Adaptive<D, S> {
    /// The change of velocities that a tried step leaves out between the knots that it passes, over the allowed error.
    /// Accelerations there are compared with interpolated ones. A step over one knot leaves nothing out. Implicit
    /// schemes pass one knot a step, because interpolated states would excite stiff forces.
    pub(super) fn left_out(
        &mut self,
        pieces: [f64; MOST_SWITCHES],
        ends: [f64; MOST_SWITCHES],
        counts: impl Fn(usize) -> bool,
    ) -> f64 {
        let switches = self.dynamics.switching();
        // between two knots there is a piece
        let passed = |index: usize| match (switches.get(index), pieces.get(index), ends.get(index)) {
            (Some(switch), Some(piece), Some(end)) if counts(index) => {
                0.5 * (switch.knots.piece(*end) - piece)
            }
            _ => 0.0,
        };
        let count: f64 = (0..switches.len()).map(|index| passed(index).abs()).sum();
        let is_blind = self.is_blind();
        if count < if is_blind { 0.5 } else { 1.5 } {
            return 0.0;
        }
        let most = (0..switches.len()).map(|index| passed(index).abs()).fold(0.0, f64::max);
        if most > MOST_PASSED || count > MOST_PASSAGES as f64 {
            return self.halved();
        }
        let mut times = [f64::INFINITY; MOST_PASSAGES + 1];
        let mut places = times.iter_mut();
        if let (true, Some(place)) = (is_blind, places.next()) {
            *place = 1.0;
        }
        for (index, switch) in switches.iter().enumerate() {
            let (count, rises) = ((passed(index).abs() + 0.5) as usize, passed(index) > 0.0);
            if count == 0 {
                continue;
            }
            let mut value = self.value_at(index, 0.0);
            for _ in 0..count {
                let (Some(knot), Some(place)) = (switch.knots.ahead(value, rises), places.next()) else {
                    break;
                };
                *place = self.passes(index, knot, rises);
                // behind it, so that the next one is found
                value = knot + if rises { f64::EPSILON } else { -f64::EPSILON } * (1.0 + knot.abs());
            }
        }
        times.sort_unstable_by(f64::total_cmp);
        self.switching.knot = times.first().copied().filter(|_| S::RELAXES);
        let pairs = times.windows(2).filter_map(|pair| match pair {
            [from, to] if to.is_finite() => Some((*from, *to)),
            _ => None,
        });
        pairs.map(|(from, to)| self.surprise(from, to)).fold(0.0, f64::max)
    }

    /// True if one of some values leaves the piece of its end within the step that was tried. So does the distance of a ball
    /// from a thin plate that a step leads it through. The step is looked through from its start, by shares in which no value
    /// comes to its next knot by its rate there and the largest change of its rate so far.
    pub(super) fn runs_through(
        &mut self,
        [starts, ends, roundings]: [[f64; MOST_SWITCHES]; 3],
        longest: f64,
        counts: impl Fn(usize) -> bool,
    ) -> bool {
        let switches = self.dynamics.switching();
        let h = (self.next.t - self.now.t).to_f64();
        let held = self.held(&self.now, h).max(self.held(&self.next, h)) * h;
        let [at_first, at_middle, at_last] = RATES;
        let (first, middle, last) = (self.look(at_first), self.look(at_middle), self.look(at_last));
        let mut arrived: [bool; MOST_SWITCHES] =
            vectors::each(&mut |index| starts.get(index) == ends.get(index));
        let mut unknown = roundings;
        unknown.iter_mut().for_each(|x| *x *= 2.0 / SLOPE);
        let (mut share, mut here, mut bends) = (0.0, first, [0.0; MOST_SWITCHES]);
        bend(&mut bends, [&first, &middle], unknown, RATES[1] - RATES[0]);
        bend(&mut bends, [&middle, &last], unknown, RATES[2] - RATES[1]);
        for _ in 0..LOOKS {
            let [values, rates] = here;
            let slopes = rates.into_iter().zip(bends).zip(unknown);
            let known = switches.iter().zip(values).zip(slopes).zip(arrived).enumerate();
            // what has not come to the piece of its end may pass knots
            let known = known.filter(|(index, (_, arrived))| *arrived && counts(*index));
            let reaches = known.map(|(_, (((switch, value), ((rate, bend), unknown)), _))| {
                let reach = |rises: bool| {
                    let way = (switch.knots.ahead(value, rises)? - value).abs();
                    let rate = if rises { rate } else { -rate };
                    // of a value that is held rounding decides, and at a knot it is already
                    (way > 0.0 && rate.abs().max(bend) > held.max(unknown)).then(|| reach(way, rate, bend))
                };
                reach(true).unwrap_or(f64::INFINITY).min(reach(false).unwrap_or(f64::INFINITY))
            });
            let reach = reaches.fold(f64::INFINITY, f64::min);
            // at a knot a look behind it
            let step = if reach < NEAREST { BEHIND * NEAREST } else { reach.min(longest) };
            let is_waiting = arrived.iter().take(switches.len()).any(|arrived| !arrived);
            if share + if is_waiting { step } else { reach } >= 1.0 {
                return false;
            }
            share += step;
            let there = self.look(share);
            for (index, ((switch, value), (end, arrived))) in
                switches.iter().zip(there[0]).zip(ends.iter().zip(&mut arrived)).enumerate()
            {
                let is_at_end = switch.knots.piece(value) == *end;
                if counts(index) && *arrived && !is_at_end {
                    return true;
                }
                *arrived |= is_at_end;
            }
            bend(&mut bends, [&here, &there], unknown, step);
            here = there;
        }
        false
    }

    /// The values of all switches at a share of the step, and their rates.
    fn look(&mut self, share: f64) -> [[f64; MOST_SWITCHES]; 2] {
        let (here, near) = (self.values_at(share), self.values_at(share + SLOPE));
        let mut rates = here;
        for (rate, near) in rates.iter_mut().zip(near) {
            *rate = (near - *rate) / SLOPE;
        }
        [here, rates]
    }

    /// True if the estimate does not know the end of a step. Then the piece behind the last knot is looked at, too.
    fn is_blind(&self) -> bool {
        let stages = self.attempt.accelerations.as_ref().len();
        self.estimate.differences.iter().all(|row| row.weights.len() <= stages)
    }

    /// The values that are at a knot but for rounding. Positions far from 0 are rounded so coarsely that shorter steps do not
    /// move them, and never pass the knot.
    pub(super) fn at_knots(&self, [values, roundings]: [[f64; MOST_SWITCHES]; 2]) -> [bool; MOST_SWITCHES] {
        let switches = self.dynamics.switching();
        vectors::each(&mut |index| match (switches.get(index), values.get(index), roundings.get(index)) {
            (Some(switch), Some(value), Some(rounding)) => {
                let within = ROUNDINGS * rounding;
                let is_near = |rises| {
                    switch.knots.ahead(*value, rises).is_some_and(|knot| (knot - value).abs() <= within)
                };
                is_near(true) || is_near(false)
            }
            _ => false,
        })
    }

    /// The changes of the values of a state by a rounding of it.
    pub(super) fn roundings(
        &mut self,
        mut near: Moment<D::Real, D::States>,
        values: [f64; MOST_SWITCHES],
    ) -> [f64; MOST_SWITCHES] {
        for x in [&mut near.q, &mut near.v] {
            let mut rounding = D::Real::EPSILON * vectors::largest(x.as_ref()).1;
            for x in x.as_mut() {
                *x = *x + rounding;
                rounding = -rounding;
            }
        }
        let Self { dynamics, inputs, all, .. } = self;
        let mut changes = switches_at((&*dynamics, &*inputs), &near, all);
        for (change, value) in changes.iter_mut().zip(values) {
            *change = (*change - value).abs();
        }
        changes
    }

    /// As much of these as is not known of their rates: explicit schemes take no steps in which rounding is all that moves a
    /// stiff value.
    pub(super) fn unknown(
        &mut self,
        near: Moment<D::Real, D::States>,
        values: [f64; MOST_SWITCHES],
    ) -> [f64; MOST_SWITCHES] {
        if S::RELAXES { self.roundings(near, values) } else { [0.0; MOST_SWITCHES] }
    }

    /// The length of a step that ends right behind the first knot which the one of `h` seconds that was tried passes, for schemes
    /// that do not look into a step. It is not so short that the clock could not tell.
    pub(super) fn step_to_knot(&mut self, h: f64) -> Option<f64> {
        let shortest = 0.5 * self.instant();
        self.switching.knot.take().map(|share| (h * (share + 0.5 * NARROW)).max(shortest))
    }

    /// A time in s of some roundings of the present one.
    fn instant(&self) -> f64 {
        INSTANT * D::Real::EPSILON.to_f64() * self.now.t.to_f64().abs()
    }

    /// The error after which the next step is half as long.
    pub(super) fn halved(&self) -> f64 {
        Real::pow(2.0, f64::from(self.estimate.power))
    }

    /// The state at a share of the step that was tried.
    fn within(&self, share: f64) -> Moment<D::Real, D::States> {
        let (from, end) = (&self.now, &self.next);
        let mut there = end.clone();
        there.t = from.t + D::Real::from_f64(share) * (end.t - from.t);
        from.between(None, end, there.t, &mut there.q, &mut there.v);
        from.acceleration(end, there.t, &mut there.a);
        there
    }

    /// The value of a switch at a share of the step.
    fn value_at(&mut self, index: usize, share: f64) -> f64 {
        self.values_at(share).get(index).copied().unwrap_or(f64::NAN)
    }

    /// The values of all switches there.
    fn values_at(&mut self, share: f64) -> [f64; MOST_SWITCHES] {
        let there = self.within(share);
        let Self { dynamics, inputs, all, .. } = self;
        switches_at((&*dynamics, &*inputs), &there, all)
    }

    /// The share of the step at which a value passes a knot.
    fn passes(&mut self, index: usize, knot: f64, rises: bool) -> f64 {
        let (mut before, mut behind) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(before, behind);
            let value = self.value_at(index, middle);
            let is_behind = if rises { value > knot } else { value < knot };
            *(if is_behind { &mut behind } else { &mut before }) = middle;
        }
        behind
    }

    /// The change of velocities between two shares of the step by the acceleration in the middle, less the
    /// interpolated one, over what is allowed.
    fn surprise(&mut self, from: f64, to: f64) -> f64 {
        if S::RELAXES {
            let time = (to - from) * (self.next.t - self.now.t).to_f64();
            return if to - from > NARROW && time > self.instant() { self.halved() } else { 0.0 };
        }
        let there = self.within(f64::midpoint(from, to));
        let mut found = there.a.clone();
        let Self { dynamics, inputs, now, next, attempt, tolerances, .. } = self;
        dynamics.acceleration(there.t, &there.q, &there.v, inputs, &mut found);
        let time = D::Real::from_f64(to - from) * (next.t - now.t);
        vectors::zip_map(found.as_mut(), there.a.as_ref(), |found, expected| time * (found - expected));
        let rtol = D::Real::from_f64(tolerances.rtol);
        let parts = found.as_ref().iter().zip(attempt.atol.as_ref()).zip(there.v.as_ref());
        let shares = parts.map(|((change, atol), v)| (change.abs() / (*atol + rtol * v.abs())).to_f64());
        // where there is no acceleration, the step is not taken
        shares.map(|share| if share.is_nan() { f64::INFINITY } else { share }).fold(0.0, f64::max)
    }
}

/// Takes the changes of rates between two looks where they are larger than those before; less what rounding may change both.
fn bend(
    bends: &mut [f64; MOST_SWITCHES],
    [from, to]: [&[[f64; MOST_SWITCHES]; 2]; 2],
    unknown: [f64; MOST_SWITCHES],
    share: f64,
) {
    for ((bend, unknown), (from, to)) in bends.iter_mut().zip(unknown).zip(from[1].into_iter().zip(to[1])) {
        *bend = bend.max(((to - from).abs() - 2.0 * unknown) / share);
    }
}

/// The first share at which a value with a rate may have gone a way, if its rate grows by `bend`.
fn reach(way: f64, rate: f64, bend: f64) -> f64 {
    let root = Real::sqrt(rate * rate + 2.0 * bend * way);
    if rate > 0.0 { 2.0 * way / (rate + root) } else { (root - rate) / bend }
}
