//! The watch over a run from step to step: how close its elimination came to a singular
//! position, and when a step has to be examined.
//!
//! # How it works
//!
//! The pivot growths of the stages of a step are added. An integrator compares the sum with an alarm once
//! per step, together with a test for finite values. The alarm is 1.25 times the growth of the step before,
//! and at most the growth that would be remembered next. That one never exceeds 1/(1024 ε).
//!
//! A step over the alarm is made again in stages. Newton's iteration then tells whether its constraints can
//! still be met (`reach.rs`). A drive that leads beyond reach lets a pivot fall with the root of the time
//! that is left. A separate function finds the pivot and its names. The worst growth of a run is kept with
//! its place.

use core::f64::consts::LN_10;

use crate::mechanism::growth_limit;
use crate::{Info, Real};

/// Below this growth, two digits, nobody asks for the place.
const REMEMBERED_FROM: f64 = 64.0;

/// The watch over the pivot growth of a run.
///
/// A step is *calm* if its growth is not over [`alarm`](Self::alarm): that is the one
/// comparison of a healthy step. A growth is over it that has risen by a quarter within a
/// step, or that has doubled since its pivot was looked for. Such a step is examined:
/// whether its constraints can still be met, and which pivot it is.
///
/// # Example
/// ```
/// use mbs_runtime::equations::Watch;
///
/// let mut watch = Watch::new(f64::INFINITY);
/// assert!(!watch.is_new(10.0) && watch.is_new(100.0));
/// watch.remember(100.0, 0.3, None);
/// watch.note_examined(100.0);
/// // the next one has to be twice as large
/// assert_eq!((watch.worst, watch.remembered_from()), (100.0, 200.0));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Watch<T> {
    /// A growth over this is examined.
    pub alarm: T,
    /// The largest growth of a step so far.
    pub worst: T,
    /// A growth of this size is remembered with time and place.
    remembered_from: T,
    /// When one was remembered last, and at which pivot.
    t: T,
    pivot: Option<u32>,
    /// The size of the mechanism, by which redundant constraints are judged; infinite
    /// where nobody asks.
    pub length: T,
}

/// Where and when a run came closest to a singular position; see
/// [`Simulation::worst_place`](crate::Simulation::worst_place).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorstPlace {
    /// When, in s: the first step whose growth was at least half of the worst.
    pub t: f64,
    /// The constraint of the pivot that grew; empty for a pure mass pivot.
    pub constraint: &'static str,
    /// The coordinate of the pivot; empty for a pure constraint pivot.
    pub coordinate: &'static str,
}

impl<T: Real> Watch<T> {
    /// The watch over a run that begins: its first step has none to be compared with.
    pub fn new(length: T) -> Self {
        let remembered_from = T::from_f64(REMEMBERED_FROM);
        let nothing = T::default();
        let alarm = remembered_from;
        Self { alarm, worst: nothing, remembered_from, t: nothing, pivot: None, length }
    }

    /// A step was taken.
    #[inline(always)]
    pub fn note(&mut self, growth: T) {
        self.worst = if growth > self.worst { growth } else { self.worst };
        let rise = rise_after(growth);
        self.alarm = if rise < self.remembered_from { rise } else { self.remembered_from };
    }

    /// A step was taken that was examined: as long as the growth does not fall back, those
    /// after it are examined too, up to some ten of them. A first step is no rise: long
    /// chains have many pivots and so a large growth wherever they are.
    pub fn note_examined(&mut self, growth: T) {
        let is_first = self.worst <= T::default();
        let before = T::from_f64(1.125) * self.alarm;
        self.note(growth);
        self.alarm = if is_first || self.alarm < before { self.alarm } else { before };
    }

    /// True if a growth is worth a name.
    pub fn is_new(&self, growth: T) -> bool {
        growth > self.remembered_from
    }

    /// A growth is remembered; the next one has to be twice as large.
    pub fn remember(&mut self, growth: T, t: T, pivot: Option<usize>) {
        let double = T::from_f64(2.0) * growth;
        let limit = growth_limit();
        self.remembered_from = if double < limit { double } else { limit };
        self.t = t;
        self.pivot = pivot.and_then(|at| u32::try_from(at).ok());
    }

    /// When the worst growth was remembered, and its pivot, if it was.
    fn remembered(&self) -> Option<(T, Option<usize>)> {
        let is_remembered = self.remembered_from > T::from_f64(REMEMBERED_FROM);
        is_remembered.then_some((self.t, self.pivot.map(|at| at as usize)))
    }

    /// The place of the worst growth; see
    /// [`Simulation::worst_place`](crate::Simulation::worst_place).
    pub fn worst_place(&self, info: &Info) -> Option<WorstPlace> {
        let (t, pivot) = self.remembered()?;
        let pivot = pivot.and_then(|at| info.pivots.get(at));
        let (constraint, coordinate) = pivot.map_or(("", ""), |pivot| (pivot.constraint, pivot.coordinate));
        Some(WorstPlace { t: t.to_f64(), constraint, coordinate })
    }

    /// The decimal digits that the worst growth left: −log₁₀(ε · growth), at least 0; see
    /// [`Simulation::digits_left`](crate::Simulation::digits_left).
    pub fn digits_left(&self) -> f64 {
        let one = T::from_f64(1.0);
        let growth = if self.worst > one { self.worst } else { one };
        let digits = -Real::ln((T::EPSILON * growth).to_f64()) / LN_10;
        if digits > 0.0 { digits } else { 0.0 }
    }

    /// The same watch with what has changed in steps that were calm.
    pub fn after_calm_steps(self, alarm: T, worst: T) -> Self {
        let alarm = if alarm < self.remembered_from { alarm } else { self.remembered_from };
        Self { alarm, worst, ..self }
    }

    /// The same watch for steps from elsewhere, which has no step to compare the next one with.
    #[must_use]
    pub fn anew(self) -> Self {
        Self { alarm: self.remembered_from, ..self }
    }

    /// The growth that a calm step does not have.
    #[inline(always)]
    pub fn remembered_from(&self) -> T {
        self.remembered_from
    }
}

/// The growth over which the step after one with this growth is examined.
///
/// Where a drive leads beyond what a mechanism can reach, a pivot falls to zero with the
/// root of the time that is left, so that its growth rises by more than 40 % in the last
/// step; other pivots add to the sum, which rises by less. In a motion that its steps
/// resolve it rises by a few per cent.
#[inline(always)]
pub(crate) fn rise_after<T: Real>(growth: T) -> T {
    T::from_f64(1.25) * growth
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_step_of_a_long_chain_is_no_rise() {
        let mut watch = Watch::new(f64::INFINITY);
        assert!(800.0 > watch.alarm, "a first step with a large growth is examined");
        watch.remember(800.0, 0.0, None);
        watch.note_examined(800.0);
        assert_eq!(watch.alarm, rise_after(800.0), "those after it are not");
        // after a rise, those that follow are
        watch.note_examined(1500.0);
        assert!(watch.alarm < 1500.0);
    }
}
