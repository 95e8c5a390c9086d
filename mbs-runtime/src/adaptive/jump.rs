//! A jump at stops: the impulses of an impact, and the stops that are rested on behind it.

use super::dynamics::Dynamics;
use super::gaps::Stopping;
use super::margins::margins;
use crate::contact::{Contacts, Each, Gaps, MOST_CONTACTS, bit, has, number, those};
use crate::equations::At;
use crate::locks::{all_stops, locked};
use crate::modes::{self, Judging, are_met};
use crate::pressing::held;
use crate::rubbing::{self, Bounds, Hit};
use crate::sticking::{direction, frictions, unanswered};
use crate::touching::LEAST_SIZE;
use crate::{Error, Real, vectors};

/// A gap below this share of the size of the coordinates is closed,
pub(super) const CLOSED: f64 = 1e-12;
/// and one within so many times the gaps of stops that are rested on,
const OFF: f64 = 4.0;
/// and one that closes within this share of the longest step.
const SOON: f64 = 1e-10;
/// A rate of a gap is 0 below this share of the largest one that the kinetic energy lets it have,
const STILL: f64 = 1e-9;
/// where a stop that is rested on has not jumped below so many times as much,
pub(super) const JUMPS: f64 = 1e3;
/// and one with which the gap opens by no more than this share of the size of the coordinates.
const RISE: f64 = 1e-18;
/// So many impacts follow each other at once, where one lets gaps close that had begun to open.
const IN_SEQUENCE: usize = 64;
/// A gap that opens by no more than this share of the size of the coordinates has not been left: its flight is lost in rounding.
const LOW: f64 = 1e-12;

/// A state at stops: what a jump starts from, and what it leads to.
pub(super) struct Jump<'a, D: Dynamics> {
    pub dynamics: &'a D,
    /// With the memories of before, and of the frictions that are decided.
    pub inputs: &'a mut [D::Real],
    pub t: D::Real,
    pub q: D::Coordinates,
    pub v: D::Coordinates,
    pub a: D::Coordinates,
    /// The speed that moves coordinates by rounding in the longest step: friction does not slide below it.
    pub slowest: f64,
}

impl<D: Dynamics> Jump<'_, D> {
    pub(super) fn at(&self) -> At<'_, D::Real> {
        At { t: self.t, q: self.q.as_ref(), v: self.v.as_ref() }
    }

    /// The number of stops.
    fn count(&self) -> usize {
        self.dynamics.info().stops.len()
    }

    /// The gaps, with the accelerations that there are without stops and without friction that sticks.
    pub fn gaps(&mut self) -> Gaps<D::Real> {
        let Self { dynamics, inputs, t, q, v, a, .. } = self;
        let at = At { t: *t, q: q.as_ref(), v: v.as_ref() };
        let equations = dynamics.equations();
        equations.accelerations(at, inputs, dynamics.no_feedback().as_ref(), a.as_mut());
        Gaps::of(equations, at, a.as_ref())
    }

    /// Five sets: the stops that are rested on and pull, with the frictions that hold more than they can or slide against
    /// their direction; the stops that push; the stops that are closed, do not open, and are not rested on; the constraints of
    /// modes that are not met; the transitions whose conditions have begun to hold.
    pub fn look(&mut self, size: f64, off: f64) -> [u32; 5] {
        let locked = locked(self.dynamics.info(), self.inputs);
        let entered = if locked == 0 { 0 } else { self.hit(locked, size) };
        let slopes = self.slopes();
        let Self { dynamics, inputs, t, q, v, a, slowest } = self;
        let at = At { t: *t, q: q.as_ref(), v: v.as_ref() };
        let equations = dynamics.equations();
        let held = held(equations, inputs);
        let margins = margins(*dynamics, at, inputs, a);
        let gaps = Gaps::of(equations, at, a.as_ref());
        let count = equations.info().stops.len();
        let info = equations.info();
        let none = STILL * vectors::largest(a.as_ref()).1.to_f64();
        let unborne = rubbing::all_rubbing(info) & !rubbing::borne(info, held);
        let pulls = those(info.watched_contacts(), |row| {
            if has(unborne, row) {
                return false;
            }
            let against = direction(info, inputs, row) * number(&gaps.rate, row);
            let margin = number(&margins, row);
            // a stop from which a mode pulls
            let is_left = row < count && margin <= 0.0 && number(&gaps.acceleration, row) > none;
            if has(held, row) { margin < 0.0 || is_left } else { against < -*slowest }
        });
        let pushes = those(count, |stop| has(held, stop) && number(&margins, stop) > 0.0);
        let closed = those(count, |stop| {
            let least = CLOSED * size * number(&slopes, stop);
            !has(held, stop) && number(&gaps.gap, stop) <= least && number(&gaps.rate, stop) <= 0.0
        });
        let mut lambda = dynamics.no_feedback();
        let judging = Judging { off, room: [a.as_mut(), lambda.as_mut()] };
        // where a mode has been entered, forces are those behind its impulse
        let (due, _) = modes::due(equations, at, inputs, judging, entered == 0);
        [pulls, pushes, closed, entered, due]
    }

    /// Does something with the responses here.
    pub(super) fn contacts<R>(&self, what: impl FnOnce(Contacts<'_, D::Real>) -> R) -> Option<R> {
        Contacts::at(self.dynamics.equations(), (self.t, self.q.as_ref()), what)
    }

    /// The size of the coordinates of bodies here.
    pub fn size(&self) -> f64 {
        let info = self.dynamics.info();
        LEAST_SIZE + vectors::largest(info.of_bodies(self.q.as_ref())).1.to_f64()
    }

    /// Σ |∂g/∂q| of every gap.
    pub fn slopes(&self) -> Each<f64> {
        let slopes = self.contacts(|contacts| vectors::each(&mut |stop| contacts.slope(stop)));
        slopes.unwrap_or([0.0; MOST_CONTACTS])
    }

    /// The rates below which gaps are still.
    fn still(&self, accelerations: &Each<D::Real>, size: f64) -> Each<f64> {
        let energy = self.dynamics.equations().kinetic_energy(self.at()).to_f64().max(0.0);
        let none = [0.0; MOST_CONTACTS];
        let still = self.contacts(|contacts| {
            vectors::each(&mut |stop| {
                let mobility = contacts.mobility(stop, stop).to_f64().max(0.0);
                STILL * Real::sqrt(2.0 * energy * mobility)
            })
        });
        let mut still = still.unwrap_or(none);
        // by the largest acceleration: between bodies that fall together there is none
        let slopes = self.slopes();
        let of_coordinates = accelerations
            .iter()
            .zip(slopes)
            .filter(|(_, slope)| *slope > 0.0)
            .map(|(a, slope)| a.to_f64().abs() / slope);
        let largest = of_coordinates.fold(0.0, f64::max);
        for (still, slope) in still.iter_mut().zip(slopes) {
            *still += slope * Real::sqrt(2.0 * largest * RISE * size);
        }
        for (row, _) in frictions(self.dynamics.info()) {
            if let Some(still) = still.get_mut(row) {
                *still = still.max(self.slowest);
            }
        }
        still
    }

    /// The stops and frictions of a set that move at more than the error of a step.
    pub fn hit(&mut self, held: u32, size: f64) -> u32 {
        let gaps = self.gaps();
        let mut still = self.still(&gaps.acceleration, size);
        still.iter_mut().for_each(|still| *still *= JUMPS);
        those(self.dynamics.info().contacts(), |stop| has(held, stop) && !is_still(&gaps.rate, &still, stop))
    }

    /// Moves velocities, or positions, so that what is given of the gaps of a set becomes 0.
    pub fn clear(&mut self, set: u32, of: &Each<D::Real>, are_positions: bool) {
        let solved = self.contacts(|contacts| {
            let x = contacts.solve(set, of);
            let mut delta = self.q.clone();
            vectors::fill(delta.as_mut(), D::Real::default());
            contacts.add(&x, delta.as_mut());
            delta
        });
        let Some(delta) = solved else { return };
        let to = if are_positions { &mut self.q } else { &mut self.v };
        vectors::zip_map(to.as_mut(), delta.as_ref(), |x, delta| x + delta);
    }
}

/// Where a jump leads.
pub(super) struct Outcome<T> {
    /// The stops that are rested on, and the frictions that stick.
    pub held: u32,
    /// The stops that are closed, and the frictions that do not move.
    pub closed: u32,
    /// Λ
    pub impulses: Each<T>,
    /// The stops that Λ throws back by more than rounding.
    pub struck: u32,
    /// The time until the next impact in s, as far as the present motion tells.
    pub flight: f64,
}

/// A jump before it is decided which stops are rested on. Stops were reached, were held, or are closed; gaps are those before
/// impacts, slopes Σ |∂g/∂q|, and gaps are still below the rates `still`.
pub(super) struct Before<T> {
    pub reached: u32,
    pub held: u32,
    pub closed: u32,
    pub gaps: Gaps<T>,
    pub slopes: Each<f64>,
    pub still: Each<f64>,
    pub is_impact: bool,
}

impl<D: Dynamics> Jump<'_, D> {
    /// The gaps, with accelerations that the stops of a set have a part in which are closed and still.
    fn pressed(&mut self, closed: u32, size: f64) -> Result<Gaps<D::Real>, Error> {
        let mut gaps = self.gaps();
        let locked = locked(self.dynamics.info(), self.inputs);
        let still = self.still(&gaps.acceleration, size);
        let resting = those(self.count(), |stop| has(closed, stop) && is_still(&gaps.rate, &still, stop));
        let (info, bounds) = (self.dynamics.info(), Bounds::of(self.dynamics.equations()));
        let moves = |row: usize| !is_still(&gaps.rate, &still, row);
        let directions =
            vectors::each(&mut |row| if moves(row) { direction(info, self.inputs, row) } else { 0.0 });
        let rates = &gaps.acceleration;
        let rest = Hit { info, closed: resting, bound: locked, directions, bounds: &bounds, rates };
        let solved = self.contacts(|contacts| Some(contacts.rates(&rest.with(&contacts, rates)?.impulses)));
        let change = solved.flatten().ok_or_else(|| self.unanswered(closed))?;
        for (to, change) in gaps.acceleration.iter_mut().zip(change) {
            *to = *to + change;
        }
        Ok(gaps)
    }

    /// Nothing answers a set of stops.
    pub(super) fn unanswered(&self, set: u32) -> Error {
        unanswered(self.dynamics.info(), self.t.to_f64(), set)
    }

    /// Answers impacts and decides which stops are rested on, and which frictions stick.
    ///
    /// # Errors
    /// [`Error::Impact`], [`Error::Jammed`].
    pub fn lead(
        &mut self,
        reached: u32,
        held: u32,
        longest_step: f64,
        stopping: &mut Stopping,
    ) -> Result<Outcome<D::Real>, Error> {
        let gaps = self.gaps();
        stopping.size = stopping.size.max(self.size());
        let (slopes, info) = (self.slopes(), self.dynamics.info());
        let allowed = |row: usize| stopping.closed * stopping.size * number(&slopes, row);
        let locked = locked(info, self.inputs);
        are_met(info, self.t.to_f64(), locked, |row| number(&gaps.gap, row), allowed)?;
        let touching = self.touching([&gaps.gap, &gaps.rate], &slopes, (held, longest_step, stopping.size));
        let closed = (held | reached) & all_stops(info) | touching;
        let still = self.still(&gaps.acceleration, stopping.size);
        let (impulses, flight) = self.impacts(closed, &still, stopping)?;
        let struck = self.contacts(|contacts| {
            those(self.count(), |stop| {
                let change = contacts.mobility(stop, stop).to_f64() * number(&impulses, stop);
                change > number(&still, stop)
            })
        });
        let before = Before { reached, held, closed, gaps, slopes, still, is_impact: flight.is_some() };
        let [held, closed] = self.rest(&before, stopping)?;
        let (struck, flight) = (struck.unwrap_or(0), flight.unwrap_or(f64::INFINITY));
        Ok(Outcome { held, closed, impulses, struck, flight })
    }

    /// The stops whose gaps are closed, up to rounding.
    fn touching(
        &self,
        [gap, rate]: [&Each<D::Real>; 2],
        slopes: &Each<f64>,
        (held, longest_step, size): (u32, f64, f64),
    ) -> u32 {
        // the gaps of stops that are rested on tell how far positions are off within a step
        let off = |stop: usize| number(gap, stop).abs() / number(slopes, stop);
        let off = (0..self.count()).filter(|stop| has(held, *stop)).map(off).filter(|off| off.is_finite());
        let size = off.fold(CLOSED * size, |size, off| size.max(OFF * off));
        those(self.count(), |stop| {
            let soon = SOON * longest_step * (-number(rate, stop)).max(0.0);
            number(gap, stop) <= size * number(slopes, stop) + soon
        })
    }

    /// Changes velocities by impacts that follow each other at once. Their impulses, and where there were any the time until
    /// the next one.
    fn impacts(
        &mut self,
        closed: u32,
        still: &Each<f64>,
        stopping: &mut Stopping,
    ) -> Result<(Each<D::Real>, Option<f64>), Error> {
        let locked = locked(self.dynamics.info(), self.inputs);
        let (mut impulses, mut flight) = ([D::Real::default(); MOST_CONTACTS], None);
        for turn in 1..=IN_SEQUENCE {
            let rate = self.gaps().rate;
            let moves = |stop: usize| !is_still(&rate, still, stop);
            let opens = |stop: usize| number(&rate, stop) > 0.0 && moves(stop);
            // an accumulation within one moment ends as others do
            let is_last = turn == IN_SEQUENCE;
            let closing = those(self.count(), |stop| has(closed, stop) && (is_last || !opens(stop)));
            if those(MOST_CONTACTS, |row| has(closing | locked, row) && moves(row)) == 0 {
                break;
            }
            let settled = stopping.stuck | if is_last { closing } else { 0 };
            let (more, next) = self.impact(closing, &rate, (settled, stopping))?;
            for (impulse, more) in impulses.iter_mut().zip(more) {
                *impulse = *impulse + more;
            }
            flight = Some(next);
        }
        Ok((impulses, flight))
    }

    /// Changes velocities by the impulses of an impact at stops that close.
    fn impact(
        &mut self,
        closed: u32,
        rates: &Each<D::Real>,
        (mut settled, stopping): (u32, &mut Stopping),
    ) -> Result<(Each<D::Real>, f64), Error> {
        let equations = self.dynamics.equations();
        let (count, locked) = (equations.info().stops.len(), locked(equations.info(), self.inputs));
        let mut laws = [D::Real::default(); 2 * MOST_CONTACTS];
        if let Some(laws) = laws.get_mut(..2 * count) {
            equations.stop_laws(laws);
        }
        let (info, bounds) = (equations.info(), Bounds::of(equations));
        let law = |stop: usize, which: usize| laws.get(2 * stop + which).copied().unwrap_or_default();
        let (lowest, slopes) = (stopping.lowest.max(LOW * self.size()), self.slopes());
        loop {
            let b: Each<D::Real> = vectors::each(&mut |stop| {
                let rate = rates.get(stop).copied().unwrap_or_default();
                let is_thrown = rate.to_f64() < 0.0 && !has(settled, stop);
                if is_thrown { rate + law(stop, 0) * rate } else { rate }
            });
            let before = self.v.clone();
            let solved = self.contacts(|contacts| {
                let directions = [0.0; MOST_CONTACTS];
                let hit = Hit { info, closed, bound: locked, directions, bounds: &bounds, rates };
                let struck = hit.answer(&contacts, &b)?;
                let mut after = before.clone();
                contacts.add(&struck.impulses, after.as_mut());
                Some((struck, after))
            });
            let Some((struck, after)) = solved.flatten() else {
                // what others keep closed throws nothing back
                let kept = self.contacts(|contacts| contacts.kept_closed(closed, locked)).unwrap_or(0);
                if kept & !settled == 0 {
                    return Err(self.unanswered(closed));
                }
                settled |= kept;
                continue;
            };
            self.v = after;
            rubbing::note(info, self.inputs, &struck);
            let thrown = self.pressed(closed, stopping.size)?;
            let (mut more, mut shortest) = (0, f64::INFINITY);
            for stop in (0..count).filter(|stop| has(closed & !settled, *stop)) {
                let flight = flight(&thrown, stop);
                let (Some([flight, height]), Some(longest)) = (flight, stopping.longest.get_mut(stop)) else {
                    continue;
                };
                if flight < law(stop, 1).to_f64() * *longest || height < lowest * number(&slopes, stop) {
                    more |= bit(stop);
                }
                *longest = longest.max(flight);
                shortest = shortest.min(flight);
            }
            if more == 0 {
                return Ok((struck.impulses, shortest));
            }
            settled |= more;
            self.v = before;
        }
    }
}

/// True if a gap does not move.
pub(super) fn is_still<T: Real>(rates: &Each<T>, still: &Each<f64>, stop: usize) -> bool {
    number(rates, stop).abs() <= number(still, stop)
}

/// The time in s until a gap that opens is closed again, and its largest value until then, by its second derivative.
fn flight<T: Real>(gaps: &Gaps<T>, stop: usize) -> Option<[f64; 2]> {
    let (rate, acceleration) = (number(&gaps.rate, stop), number(&gaps.acceleration, stop));
    (rate > 0.0 && acceleration < 0.0)
        .then(|| [-2.0 * rate / acceleration, -0.5 * rate * rate / acceleration])
}
