//! Where a gap closes for the first time in a step.
//!
//! A step may be long beside the motion of a gap: a block that spins in free flight is one polynomial, its corners are not.
//! So a step is divided until parabolas through three values foretell two more, or leave no doubt that the gap is open.

use super::crossing::Bracket;
use super::events::Watched;
use super::{Adaptive, AdaptiveScheme, Dynamics};
use crate::Real;

/// A step is divided into so many parts at least,
const PARTS: u32 = 8;
/// and each of them is halved so often at most.
const HALVINGS: usize = 14;
/// A part is halved no further where parabolas foretell values to this share of the largest one.
const FORETOLD: f64 = 1e-3;
/// Shares of half a piece at which the parabola is compared, too.
const ASKEW: [f64; 2] = [-0.723_6, 0.587_1];
/// The deviations of values that are seen stand for others, as many times larger.
const UNSEEN: f64 = 8.0;
/// A step is divided into so many pieces in all.
const MOST_PIECES: u32 = 2000;

/// Three values at equal distances.
#[derive(Clone, Copy)]
struct Piece<T> {
    from: T,
    to: T,
    values: [f64; 3],
    halvings: usize,
}

impl<D: Dynamics, S: AdaptiveScheme> Adaptive<D, S> {
    /// Where a value that is positive at `from` stops being so in the last step.
    pub(super) fn closing(
        &mut self,
        index: usize,
        (from, first): (D::Real, D::Real),
        watched: &mut Watched<'_, D>,
    ) -> Option<Bracket<D::Real>> {
        let mut left = MOST_PIECES;
        let number = D::Real::from_f64;
        let end = self.now.t;
        let width = (end - from) * number(1.0 / f64::from(PARTS));
        let mut begin = (from, first.to_f64());
        for part in 1..=PARTS {
            let to = if part == PARTS { end } else { from + number(f64::from(part)) * width };
            let mut value = |t| self.value_between(t, index, watched).to_f64();
            let values = [begin.1, value(middle(begin.0, to)), value(to)];
            let whole = Piece { from: begin.0, to, values, halvings: 0 };
            if let Some([from, to]) = first_fall(whole, &mut left, value) {
                return Some(Bracket { from, to, is_rising: false });
            }
            begin = (to, values[2]);
        }
        // a step that is so much longer than what happens in it is taken again
        self.stopping.is_too_long |= left == 0;
        None
    }
}

/// Half of the way.
fn middle<T: Real>(from: T, to: T) -> T {
    from + T::from_f64(0.5) * (to - from)
}

/// The first two times of which a value is positive at one and not at the next.
fn first_fall<T: Real>(whole: Piece<T>, left: &mut u32, mut value: impl FnMut(T) -> f64) -> Option<[T; 2]> {
    let mut open = [whole; HALVINGS + 2];
    let mut count = 1_usize;
    while let Some(Piece { from, to, values: [a, m, b], halvings }) =
        count.checked_sub(1).and_then(|last| open.get(last)).copied()
    {
        count -= 1;
        let half = middle(from, to);
        let times = [from, middle(from, half), half, middle(half, to), to];
        let [near, far] = [value(times[1]), value(times[3])];
        let samples = [a, near, m, far, b];
        // with values at shares that no oscillation has a period of
        let [before, behind] = ASKEW;
        let mut beside = |share: f64| value(half + T::from_f64(0.5 * share) * (to - from));
        let (x, y) = (beside(before), beside(behind));
        let checks = [(-0.5, near), (0.5, far), (before, x), (behind, y)].into_iter();
        let off = checks.map(|(share, found)| (found - parabola([a, m, b], share)).abs());
        let off = UNSEEN * off.fold(0.0, f64::max);
        let largest = samples.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        if a > 0.0 && least([a, m, b]).min(least(samples)).min(x).min(y) > off {
            continue;
        }
        *left = left.checked_sub(1)?;
        if off <= FORETOLD * largest || halvings >= HALVINGS {
            let pairs = samples.windows(2).zip(times.windows(2));
            for (values, times) in pairs {
                if let ([before, after], [from, to]) = (values, times)
                    && *before > 0.0
                    && *after <= 0.0
                {
                    return Some([*from, *to]);
                }
            }
            if let Some(dip) = dip(&samples, &times, &mut value) {
                return Some(dip);
            }
            continue;
        }
        // the first half is looked at first
        let second = Piece { from: half, to, values: [m, far, b], halvings: halvings + 1 };
        let first = Piece { from, to: half, values: [a, near, m], halvings: halvings + 1 };
        for piece in [second, first] {
            if let Some(place) = open.get_mut(count) {
                *place = piece;
                count += 1;
            }
        }
    }
    None
}

/// The parabola through values at −1, 0 and 1.
fn parabola([a, m, b]: [f64; 3], share: f64) -> f64 {
    m + share * (0.5 * (b - a) + share * (0.5 * (a + b) - m))
}

/// The least value of the parabola through three, between them.
fn least<const N: usize>(values: [f64; N]) -> f64 {
    let lowest = values.iter().fold(f64::INFINITY, |least, x| least.min(*x));
    let [a, m, b] = [values[0], values[N / 2], values[N - 1]];
    let (slope, curvature) = (0.5 * (b - a), a - 2.0 * m + b);
    let vertex = -slope / curvature;
    if curvature > 0.0 && vertex.abs() <= 1.0 {
        lowest.min(m - 0.5 * slope * slope / curvature)
    } else {
        lowest
    }
}

/// A fall between samples that are all positive, at the vertex of a parabola through three of them. It may lie beside the
/// first one or the last: a body that an impact throws softly against a pull has turned long before the second.
fn dip<T: Real>(samples: &[f64; 5], times: &[T; 5], mut value: impl FnMut(T) -> f64) -> Option<[T; 2]> {
    let triples = samples.windows(3).zip(times.windows(3));
    for (values, times) in triples {
        let ([a, m, b], [from, half, to]) = (values, times) else { continue };
        let (slope, curvature) = (0.5 * (b - a), a - 2.0 * m + b);
        let vertex = -slope / curvature;
        if *a > 0.0 && curvature > 0.0 && vertex.abs() <= 1.0 {
            let width = T::from_f64(0.5) * (*to - *from);
            let t = *half + T::from_f64(vertex) * width;
            if value(t) <= 0.0 {
                return Some([*from, t]);
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::{Piece, first_fall, middle};

    fn found(value: impl Fn(f64) -> f64, to: f64) -> (Option<[f64; 2]>, u32) {
        let mut count = 0;
        let values = [value(0.0), value(middle(0.0, to)), value(to)];
        let whole = Piece { from: 0.0, to, values, halvings: 0 };
        let fall = first_fall(whole, &mut 400, |t| {
            count += 1;
            value(t)
        });
        (fall, count)
    }

    #[test]
    fn the_first_fall_is_found() {
        // a corner that turns twenty times in the step of a falling block
        let corner = |t: f64| 100.0 - 4.9 * t * t - 12.0 * (30.0 * t).sin().abs();
        let (fall, _) = found(corner, 8.0);
        let [from, to] = fall.unwrap();
        let mut t = 0.0;
        while corner(t) > 0.0 {
            t += 1e-5;
        }
        assert!(from <= t && t - 1e-5 <= to && to - from < 0.02, "{from} {to} {t}");
        // a disc that is small beside its way
        let disc = |t: f64| (50.0 * t - 100.0).abs() - 1e-3;
        let [from, to] = found(disc, 4.1).0.unwrap();
        assert!((from..=to).contains(&(2.0 - 2e-5)), "{from} {to}");
        // what touches nothing costs little
        let (fall, count) = found(|t| 10.0 + t * (1.0 - t), 3.0);
        assert!(fall.is_none() && count == 4, "{count}");
        assert!(found(|t| 1e-9 + (t - 0.3) * (t - 0.3), 1.0).0.is_none());
        // a dip beside the first sample, and one beside the last
        for vertex in [0.01, 0.99] {
            let dip = |t: f64| (t - vertex) * (t - vertex) - 0.9e-4;
            let [from, to] = found(dip, 1.0).0.unwrap();
            assert!(dip(from) > 0.0 && dip(to) <= 0.0 && to < vertex + 1e-6, "{from} {to}");
        }
    }
}
