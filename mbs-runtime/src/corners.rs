//! Times at which laws bend or jump, where a step ends.

use crate::Real;
use crate::spline::floor;

/// The arguments at which a function bends or jumps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knots {
    /// In ascending order; of a periodic function those within one period.
    pub at: &'static [f64],
    /// After which they come again; 0 without one.
    pub period: f64,
    /// False where it is known that the function only bends.
    pub jumps: bool,
}

impl Knots {
    /// The number of the piece on which a value is; knots count as pieces of their own.
    pub(crate) fn piece(&self, value: f64) -> f64 {
        let (periods, within) = self.wrapped(value);
        let [below, reached] =
            [self.at.partition_point(|knot| *knot < within), self.at.partition_point(|knot| *knot <= within)];
        2.0 * periods * self.at.len() as f64 + (below + reached) as f64
    }

    /// The next knot from a value on, upwards or downwards; the value itself if it is one.
    pub(crate) fn ahead(&self, value: f64, is_upwards: bool) -> Option<f64> {
        let (periods, within) = self.wrapped(value);
        let next = match is_upwards {
            true => self.at.partition_point(|knot| *knot < within) as f64,
            false => self.at.partition_point(|knot| *knot <= within) as f64 - 1.0,
        };
        self.knot(periods, next)
    }

    /// The number of periods by which a value is behind the first one, and the value within that.
    fn wrapped(&self, value: f64) -> (f64, f64) {
        let periods = match self.at.first() {
            Some(first) if self.period > 0.0 => floor((value - first) / self.period),
            _ => 0.0,
        };
        (periods, value - periods * self.period)
    }

    /// The knot of a number, counted from the first one of a period; of a periodic function those of other periods,
    /// too.
    fn knot(&self, periods: f64, number: f64) -> Option<f64> {
        let count = self.at.len() as f64;
        let turns = if self.period > 0.0 { floor(number / count) } else { 0.0 };
        let index = number - turns * count;
        let knot = self.at.get(index as usize).filter(|_| index >= 0.0)?;
        Some(knot + (periods + turns) * self.period)
    }
}

/// At most so many switches are watched.
pub(crate) const MOST_SWITCHES: usize = 64;

/// A value of the motion at whose knots laws bend or jump.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Switch {
    /// As people read it.
    pub name: &'static str,
    /// Its knots.
    pub knots: Knots,
}

/// Roundings of the argument a t + b, within which a knot may be on either side.
const ROUNDINGS: f64 = 4.0;

/// The first time behind `t` at which one of some values a t + b passes a knot; infinite without one.
///
/// Every passage is two times, right before and right behind all roundings of it: the step that ends at the first one
/// sees nothing of what is behind, and the one between them, as short as rounding, changes nothing.
pub fn next_corner<T: Real>(t: T, lines: &[[T; 2]], knots: &[Knots]) -> T {
    let times = lines.iter().zip(knots).flat_map(|(line, knots)| passages(t, *line, knots));
    times
        .flatten()
        .filter(|time| *time > t)
        .fold(T::from_f64(f64::INFINITY), |first, time| if time < first { time } else { first })
}

/// The times around the knots next to a t + b.
fn passages<T: Real>(t: T, [rate, offset]: [T; 2], knots: &Knots) -> [[T; 2]; 4] {
    let (a, b) = (rate.to_f64(), offset.to_f64());
    let value = a * t.to_f64() + b;
    let (periods, within) = knots.wrapped(value);
    let next = knots.at.partition_point(|knot| *knot <= within) as f64;
    [-2.0, -1.0, 0.0, 1.0].map(|beside| {
        let Some(knot) = knots.knot(periods, next + beside) else { return [T::from_f64(f64::NAN); 2] };
        let time = (T::from_f64(knot) - offset) / rate;
        let size = time.to_f64().abs() + (b.abs() + knot.abs()) / a.abs();
        let width = T::from_f64(ROUNDINGS * T::EPSILON.to_f64() * size);
        [time - width, time + width]
    })
}

#[cfg(test)]
mod tests {
    use std::vec;
    use std::vec::Vec;

    use super::{Knots, next_corner};

    /// Times as a run meets them, each twice.
    fn times(line: [f64; 2], knots: Knots, end: f64) -> Vec<f64> {
        let mut times = Vec::new();
        let mut t = 0.0;
        loop {
            t = next_corner(t, &[line], &[knots]);
            if t > end {
                return times;
            }
            times.push(t);
        }
    }

    #[test]
    fn every_passage_is_met_on_both_sides() {
        let knots = Knots { at: &[1.0, 2.0, 4.0], period: 0.0, jumps: false };
        for (line, expected) in [
            ([1.0, 0.0], vec![1.0, 2.0, 4.0]),
            ([2.0, -1.0], vec![1.0, 1.5, 2.5]),
            ([-1.0, 5.0], vec![1.0, 3.0, 4.0]),
            ([1.0, 5.0], vec![]),
        ] {
            let found = times(line, knots, 100.0);
            let pairs: Vec<&[f64]> = found.chunks(2).collect();
            assert_eq!(pairs.len(), expected.len(), "{line:?}: {found:?}");
            for (pair, expected) in pairs.into_iter().zip(expected) {
                let inside = pair[0] < expected && expected < pair[1];
                assert!(inside && pair[1] - pair[0] < 1e-13, "{line:?}: {pair:?} {expected}");
            }
        }
    }

    #[test]
    fn a_period_comes_again() {
        let knots = Knots { at: &[0.0, 0.25], period: 1.0, jumps: false };
        for (line, count) in [([1.0, 0.0], 21), ([-1.0, 0.0], 20), ([10.0, 0.1], 200)] {
            // the corner at 0 is behind the start, or just before it
            let found = times(line, knots, 10.0 + 1e-9);
            assert!(found.len().abs_diff(2 * count) <= 2, "{line:?}: {} {found:?}", found.len());
        }
    }
}
