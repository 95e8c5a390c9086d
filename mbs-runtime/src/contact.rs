//! Impacts and rests at stops.
//!
//! A gap g(q, t) ≥ 0 closes. With the responses Y to unit impulses along ∂g/∂q of the stops that are closed and
//! W = ∂g/∂q Y, impulses Λ change velocities by Y Λ and the rates of the gaps by W Λ; forces λ do the same to
//! accelerations. Joints hold meanwhile, as Φ_q Y = 0. So both laws are one problem,
//!
//! ```text
//! W x + b ≥ 0    x ≥ 0    xᵀ(W x + b) = 0
//! ```
//!
//! * of an impact x is Λ, and b the rate ġ before, of a gap that closes (1 + e)ġ: ġ⁺ ≥ −e ġ⁻, and ġ⁺ = −e ġ⁻ where
//!   there is an impulse (Newton's law; Glocker 2001 for several at once). Energy does not grow for e ≤ 1;
//! * of a rest x is λ, and b the second derivative g̈ without it.
//!
//! Where a stop rubs, x of its friction is −μ d times x of the stop while that slides in the direction d, and what holds it, of
//! any sign, while it sticks: the [column](Contacts::sliding) of the stop takes that in.
//!
//! W is positive semidefinite. Pivots by the least index (Murty 1974), and exchanges where stops depend on each other, end after
//! finitely many, and there are few stops.

use crate::Real;
use crate::declared::DeclaredFriction;
use crate::eliminating::eliminate;
use crate::equations::{At, Equations};
pub(crate) use crate::info::MOST_CONTACTS;

/// A number per stop.
pub(crate) type Each<T> = [T; MOST_CONTACTS];

/// Pivots, after which there is no solution: more than all sets of eight stops.
const MOST_PIVOTS: usize = 512;
/// A negative value is rounding up to this share of the terms of which it is made.
const ROUNDING: f64 = 1e-12;
/// The roundings of a few operations.
pub(crate) const OPERATIONS: f64 = 64.0;
/// A pivot below this share of its row depends on those before it: these stops press one way.
pub(crate) const DEPENDENT: f64 = 1e-10;

/// The share below which a value is rounding: at least that of some operations in the scalar.
pub(crate) fn share<T: Real>(least: f64) -> f64 {
    least.max(OPERATIONS * T::EPSILON.to_f64())
}

/// The gaps of stops in a state.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gaps<T> {
    /// g
    pub gap: Each<T>,
    /// ġ
    pub rate: Each<T>,
    /// g̈
    pub acceleration: Each<T>,
}

impl<T: Real> Gaps<T> {
    /// In a state with given accelerations.
    pub fn of(equations: &dyn Equations<T>, at: At<'_, T>, acceleration: &[T]) -> Self {
        let mut values = [T::default(); 3 * MOST_CONTACTS];
        let count = equations.info().contacts();
        if let Some(values) = values.get_mut(..3 * count) {
            equations.gaps(at, acceleration, values);
        }
        let each = |which: usize| {
            core::array::from_fn(|stop| values.get(3 * stop + which).copied().unwrap_or_default())
        };
        Self { gap: each(0), rate: each(1), acceleration: each(2) }
    }
}

/// The responses of a mechanism to unit impulses along the gaps of its stops.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contacts<'a, T> {
    stops: usize,
    /// The frictions that stick: they stand behind the stops,
    frictions: (usize, &'static [DeclaredFriction]),
    /// and the first constraint of a mode behind them.
    locks: usize,
    coordinates: usize,
    constraints: usize,
    values: &'a [T],
    /// The x of the friction that slides on a stop, as a multiple of that of the stop.
    slides: Each<T>,
}

impl<'a, T: Real> Contacts<'a, T> {
    /// Does something with the responses at a position.
    pub fn at<R>(
        equations: &dyn Equations<T>,
        (t, q): (T, &[T]),
        what: impl FnOnce(Contacts<'_, T>) -> R,
    ) -> Option<R> {
        let info = equations.info();
        let (stops, coordinates) = (info.contacts(), info.coordinates.len());
        let (locks, frictions) = (info.watched_contacts(), (info.stops.len(), info.frictions));
        let (constraints, slides) = (info.constraints.len(), [T::ZERO; MOST_CONTACTS]);
        let (mut what, mut result) = (Some(what), None);
        equations.contacts(t, q, &mut |values| {
            if let Some(what) = what.take() {
                let contacts = Contacts { stops, frictions, locks, coordinates, constraints, values, slides };
                result = Some(what(contacts));
            }
        });
        result
    }

    /// With what slides on stops: x of the friction of a stop is so many times that of the stop.
    pub fn sliding(self, slides: Each<T>) -> Self {
        Self { slides, ..self }
    }

    /// The number of stops.
    pub fn stops(&self) -> usize {
        self.stops
    }

    /// The frictions of stops, with these.
    pub fn rubbing(&self) -> impl Iterator<Item = (usize, usize)> + use<T> {
        let (first, frictions) = self.frictions;
        (first..).zip(frictions).filter_map(|(row, friction)| Some((row, friction.stop?)))
    }

    /// True if the friction of a stop has one in a set; of any other row.
    fn is_borne(&self, row: usize, set: u32) -> bool {
        let at = row.checked_sub(self.frictions.0);
        let stop = at.and_then(|at| self.frictions.1.get(at)).and_then(|friction| friction.stop);
        stop.is_none_or(|stop| has(set, stop))
    }

    /// The friction that slides on a stop, and how many times the x of the stop its x is.
    fn slide(&self, stop: usize) -> Option<(usize, T)> {
        let slide = *self.slides.get(stop)?;
        let slides = slide.to_f64() != 0.0 || T::ORDER > 0;
        let row = self.rubbing().find(|(_, of)| slides && *of == stop);
        row.map(|(row, _)| (row, slide))
    }

    /// The change of the rate of one gap by a unit impulse at a stop, and by that of what slides on it.
    pub fn slid_mobility(&self, of: usize, by: usize) -> T {
        let own = self.mobility(of, by);
        self.slide(by).map_or(own, |(row, slide)| own + slide * self.mobility(of, row))
    }

    fn each(&self) -> usize {
        2 * self.coordinates + self.constraints
    }

    /// Σ |∂g/∂q| of a stop: its gap is known to so many roundings of the coordinates.
    pub fn slope(&self, stop: usize) -> f64 {
        let from = stop * self.each() + self.coordinates + self.constraints;
        let slopes = self.values.get(from..from + self.coordinates).unwrap_or_default();
        slopes.iter().map(|slope| slope.to_f64().abs()).sum()
    }

    /// Y of a stop.
    pub fn response(&self, stop: usize) -> &'a [T] {
        let from = stop * self.each();
        self.values.get(from..from + self.coordinates).unwrap_or_default()
    }

    /// The multipliers of a unit impulse at a stop.
    pub fn reactions(&self, stop: usize) -> &'a [T] {
        let from = stop * self.each() + self.coordinates;
        self.values.get(from..from + self.constraints).unwrap_or_default()
    }

    /// The change of the rate of one gap by a unit impulse at a stop.
    pub fn mobility(&self, of: usize, by: usize) -> T {
        let at = self.stops * self.each() + by * self.stops + of;
        self.values.get(at).copied().unwrap_or_default()
    }

    /// The mobility of a row by its own impulse if there were no joints; where masses do not determine it, the one with joints.
    fn free_mobility(&self, row: usize) -> f64 {
        let at = self.stops * (self.each() + self.stops) + row;
        let free = self.values.get(at).map_or(0.0, |free| free.to_f64());
        if free.is_finite() && free > 0.0 { free } else { self.mobility(row, row).to_f64() }
    }

    /// The pivot growth of the elimination.
    pub fn growth(&self) -> T {
        self.values.last().copied().unwrap_or(T::from_f64(f64::NAN))
    }

    /// x of a set of stops with W x + b = 0 there; 0 where it depends on others of the set.
    pub fn solve(&self, set: u32, b: &Each<T>) -> Each<T> {
        let mut rows = [[T::default(); MOST_CONTACTS + 1]; MOST_CONTACTS];
        let (mut members, mut count) = ([0; MOST_CONTACTS], 0);
        // modes hold before stops press, and these before friction holds, where they depend on each other
        let locks = those(self.stops, |row| row >= self.locks && has(set, row)).count_ones() as usize;
        let is_member = |row: &usize| has(set, *row) && self.is_borne(*row, set);
        for stop in (self.locks..self.stops).chain(0..self.locks).filter(is_member) {
            if let Some(member) = members.get_mut(count) {
                *member = stop;
                count += 1;
            }
        }
        let members = members.get(..count).unwrap_or_default();
        for (row, &of) in rows.iter_mut().zip(members) {
            for (entry, &by) in row.iter_mut().zip(members) {
                *entry = self.slid_mobility(of, by);
            }
            if let (Some(last), Some(b)) = (row.last_mut(), b.get(of)) {
                *last = -*b;
            }
        }
        let mut solution = [T::default(); MOST_CONTACTS];
        let free = core::array::from_fn(|at| members.get(at).map_or(0.0, |&row| self.free_mobility(row)));
        let found = eliminate(&mut rows, [locks, count], &free);
        for (&stop, x) in members.iter().zip(found) {
            if let Some(to) = solution.get_mut(stop) {
                *to = x;
            }
            let slide = self.slide(stop).and_then(|(row, slide)| Some((solution.get_mut(row)?, slide)));
            if let Some((to, slide)) = slide {
                *to = slide * x;
            }
        }
        solution
    }

    /// x ≥ 0 with W x + b ≥ 0 of a set, of which one or the other is 0 at each, and the set of those where W x + b is;
    /// nothing where there is none. At those that are `bound` x has any sign, and W x + b = 0.
    pub fn complementary(&self, set: u32, bound: u32, b: &Each<T>) -> Option<(u32, Each<T>)> {
        // stops press before friction holds, where they depend on each other
        let mut active = if bound & set == 0 { 0 } else { set };
        for _ in 0..MOST_PIVOTS {
            let x = self.solve(active, b);
            let Some(wrong) = self.least_wrong(set & !bound, active, b, &x) else {
                let held = those(self.stops, |row| has(active, row) && self.is_borne(row, active));
                return Some((held, x));
            };
            // one that closes with others, or although it is active, depends on them: it takes the place of one of them
            let is_dependent = match has(active, wrong) {
                true => number(&x, wrong) == 0.0,
                false => self.depends(wrong, active),
            };
            let left = if is_dependent { bit(self.exchanged(active, (wrong, bound), &x)?) } else { 0 };
            active = if is_dependent { (active | bit(wrong)) ^ left } else { active ^ bit(wrong) };
        }
        None
    }

    /// True if an impulse at a stop does what impulses at the active ones can do.
    pub fn depends(&self, stop: usize, active: u32) -> bool {
        let shares = self.shares(active, stop);
        let own = self.slid_mobility(stop, stop).to_f64();
        let of_others = |by: usize| self.slid_mobility(stop, by).to_f64() * number(&shares, by);
        let rest = (0..self.stops).filter(|by| has(active, *by)).fold(own, |rest, by| rest - of_others(by));
        rest <= share::<T>(DEPENDENT) * own
    }

    /// The impulses at active stops that do what a unit impulse at another one does, as far as they can.
    fn shares(&self, active: u32, by: usize) -> Each<T> {
        let column =
            core::array::from_fn(
                |of| if of < self.stops { -self.slid_mobility(of, by) } else { T::default() },
            );
        self.solve(active & !bit(by), &column)
    }

    /// The stops of a set that others of it and what is `bound` keep closed: no impulses open them.
    pub fn kept_closed(&self, set: u32, bound: u32) -> u32 {
        let opening = |stop: usize| {
            core::array::from_fn(|row| if row == stop { T::from_f64(-1.0) } else { T::default() })
        };
        those(self.stops, |stop| {
            has(set & !bound, stop) && self.complementary(set | bound, bound, &opening(stop)).is_none()
        })
    }

    /// The first active stop whose impulse becomes 0 where that of one grows that depends on them.
    fn exchanged(&self, active: u32, (by, bound): (usize, u32), x: &Each<T>) -> Option<usize> {
        let shares = self.shares(active, by);
        let ratio = |stop: usize| number(x, stop) / number(&shares, stop);
        let is_shrinking =
            |stop: &usize| !has(bound, *stop) && number(&shares, *stop) > share::<T>(DEPENDENT);
        let shrinking = (0..self.stops).filter(is_shrinking);
        shrinking.reduce(|first, stop| if ratio(stop) < ratio(first) { stop } else { first })
    }

    /// The first stop of a set that is pulled, or that is left free and closes.
    fn least_wrong(&self, set: u32, active: u32, b: &Each<T>, x: &Each<T>) -> Option<usize> {
        let largest = x.iter().fold(0.0_f64, |largest, x| largest.max(x.to_f64().abs()));
        (0..self.stops).filter(|stop| has(set, *stop)).find(|&stop| {
            let own = number(x, stop);
            if has(active, stop) && own < -share::<T>(ROUNDING) * largest {
                return true;
            }
            let (rate, size) = self.rate(stop, b, x);
            rate < -share::<T>(ROUNDING) * size
        })
    }

    /// W x + b of a row, and the sum of the sizes of its terms.
    pub fn rate(&self, row: usize, b: &Each<T>, x: &Each<T>) -> (f64, f64) {
        let b = number(b, row);
        x.iter().enumerate().take(self.stops).fold((b, b.abs()), |(rate, size), (by, x)| {
            let term = self.mobility(row, by).to_f64() * x.to_f64();
            (rate + term, size + term.abs())
        })
    }

    /// Adds Σ Y x to velocities or accelerations.
    pub fn add(&self, x: &Each<T>, to: &mut [T]) {
        for (stop, &x) in x.iter().enumerate().take(self.stops) {
            if x.to_f64() != 0.0 || T::ORDER > 0 {
                for (to, y) in to.iter_mut().zip(self.response(stop)) {
                    *to = *to + x * *y;
                }
            }
        }
    }

    /// Adds what x does to multipliers.
    pub fn react(&self, x: &Each<T>, multipliers: &mut [T]) {
        for (stop, &force) in x.iter().enumerate().take(self.stops) {
            for (to, y) in multipliers.iter_mut().zip(self.reactions(stop)) {
                *to = *to + force * *y;
            }
        }
    }

    /// W x, how impulses change the rates of the gaps.
    pub fn rates(&self, x: &Each<T>) -> Each<T> {
        core::array::from_fn(|of| {
            let terms = x.iter().enumerate().take(self.stops);
            terms.fold(T::default(), |sum, (by, &x)| sum + self.mobility(of, by) * x)
        })
    }
}

/// True if a set has a stop.
pub(crate) fn has(set: u32, stop: usize) -> bool {
    set & bit(stop) != 0
}

/// The set of one stop.
pub(crate) fn bit(stop: usize) -> u32 {
    u32::try_from(stop).ok().and_then(|stop| 1_u32.checked_shl(stop)).unwrap_or(0)
}

/// The set of those of so many stops for which something holds.
pub(crate) fn those(count: usize, holds: impl Fn(usize) -> bool) -> u32 {
    those_of(count, &holds)
}

/// [`those`] with the function behind a pointer, so that it is compiled once.
fn those_of(count: usize, holds: &dyn Fn(usize) -> bool) -> u32 {
    (0..count).filter(|stop| holds(*stop)).fold(0, |set, stop| set | bit(stop))
}

/// The number of a stop, without derivatives.
pub(crate) fn number<T: Real>(of: &Each<T>, stop: usize) -> f64 {
    of.get(stop).map_or(0.0, |x| x.to_f64())
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use super::{Contacts, MOST_CONTACTS};

    /// Responses of so many rows that have W alone, the constraints of modes from one of them on.
    fn responses([stops, locks]: [usize; 2], values: &[f64]) -> Contacts<'_, f64> {
        let slides = [0.0; MOST_CONTACTS];
        Contacts { stops, frictions: (stops, &[]), locks, coordinates: 0, constraints: 0, values, slides }
    }

    /// x of stops that have W alone.
    fn solved<const N: usize>(w: [[f64; N]; N], b: [f64; N]) -> Option<(u32, [f64; N])> {
        let mut values: Vec<f64> = w.into_iter().flatten().collect();
        values.extend((0..N).map(|row| w[row][row]).chain([0.0]));
        let contacts = responses([N, N], &values);
        let mut all = [0.0; MOST_CONTACTS];
        all[..N].copy_from_slice(&b);
        let (active, x) = contacts.complementary((1 << N) - 1, 0, &all)?;
        Some((active, core::array::from_fn(|at| x[at])))
    }

    #[test]
    fn one_or_the_other_is_zero() {
        assert_eq!(solved([[2.0]], [-3.0]), Some((1, [1.5])));
        assert_eq!(solved([[2.0]], [3.0]), Some((0, [0.0])));
        // both are pressed, but the first one holds the second one off
        assert_eq!(solved([[1.0, 0.9], [0.9, 1.0]], [-1.0, -0.5]), Some((1, [1.0, 0.0])));
        assert_eq!(solved([[1.0, -0.5], [-0.5, 1.0]], [-1.0, 0.25]), Some((3, [7.0 / 6.0, 1.0 / 3.0])));
    }

    #[test]
    fn stops_that_press_one_way_share() {
        // a third corner on the line of two others
        let w = [[2.0, 0.0, 1.0], [0.0, 2.0, 1.0], [1.0, 1.0, 1.0]];
        let (_, x) = solved(w, [-2.0, -2.0, -2.0]).unwrap();
        let rates: [f64; 3] =
            core::array::from_fn(|of| (0..3).map(|by| w[of][by] * x[by]).sum::<f64>() - 2.0);
        assert!(
            x.iter().all(|x| *x >= 0.0) && rates.iter().all(|rate| rate.abs() < 1e-14),
            "{x:?} {rates:?}"
        );
        // of two that say the same the one with the larger restitution decides
        let (active, x) = solved([[1.0, 1.0], [1.0, 1.0]], [-1.0, -2.0]).unwrap();
        assert_eq!((active, x), (2, [0.0, 2.0]));
        // the wrong way round there is nothing
        assert_eq!(solved([[1.0, -1.0], [-1.0, 1.0]], [-1.0, -1.0]), None);
    }

    #[test]
    fn stops_against_each_other_keep_closed() {
        // a block that fits between two walls, and another one before a third
        let w = [[1.0, -1.0, 0.0], [-1.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let values: Vec<f64> = w.into_iter().flatten().chain([1.0, 1.0, 1.0, 0.0]).collect();
        let contacts = responses([3, 3], &values);
        assert_eq!([0b111, 0b101, 0b110].map(|set| contacts.kept_closed(set, 0)), [0b011, 0, 0]);
        // a stop whose gap a mode holds, behind it
        let values = [1.0, -1.0, -1.0, 1.0, 1.0, 1.0, 0.0];
        let contacts = responses([2, 1], &values);
        assert_eq!((contacts.kept_closed(0b01, 0b10), contacts.kept_closed(0b01, 0)), (0b01, 0));
    }
}
