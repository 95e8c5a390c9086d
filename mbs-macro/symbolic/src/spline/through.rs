//! Splines through points.

use super::{Beyond, Interpolation, Outside, Segment, Spline};

/// A table that refuses what is outside has so many roundings of its points for arguments at its ends.
const ROUNDINGS: f64 = 4.0;

impl Spline {
    /// The periodic cubic spline through `points` of (argument, value). The first point returns after the
    /// period by itself. `None` as for [`through`](Self::through).
    pub fn periodic(name: &str, points: &[(f64, f64)], period: f64) -> Option<Self> {
        Self::through(name, points, Interpolation::Cubic, Outside::Periodic(period))
    }

    /// The spline through `points` with a rule for what is outside of them. `None` as for
    /// [`through`](Self::through), and where the last point of a periodic one has another value than the first.
    pub fn by_rule(
        name: &str,
        points: &[(f64, f64)],
        interpolation: Interpolation,
        beyond: Beyond,
    ) -> Option<Self> {
        let outside = match beyond {
            Beyond::Hold => Outside::Hold,
            Beyond::Extend => Outside::Extend,
            Beyond::Refuse => Outside::Refuse,
            Beyond::Periodic => {
                let (first, (last, points)) = (points.first()?, points.split_last()?);
                let outside = Outside::Periodic(last.0 - first.0);
                return (last.1 == first.1)
                    .then(|| Self::through(name, points, interpolation, outside))
                    .flatten();
            }
        };
        Self::through(name, points, interpolation, outside)
    }

    /// The spline through `points` of (argument, value). `None` unless there are two or more, of a periodic
    /// cubic one three, ascending and within one period, and everything is finite.
    pub fn through(
        name: &str,
        points: &[(f64, f64)],
        interpolation: Interpolation,
        outside: Outside,
    ) -> Option<Self> {
        let (first, last) = (*points.first()?, *points.last()?);
        let ascends = points.windows(2).all(|pair| pair[0].0 < pair[1].0);
        let period = if let Outside::Periodic(period) = outside { Some(period) } else { None };
        let needed = if period.is_some() && interpolation == Interpolation::Cubic { 3 } else { 2 };
        let is_within = period.is_none_or(|period| period.is_finite() && last.0 - first.0 < period);
        let is_finite = points.iter().all(|(x, y)| x.is_finite() && y.is_finite());
        if points.len() < needed || !ascends || !is_within || !is_finite {
            return None;
        }
        let end = period.map(|period| (first.0 + period, first.1));
        let knots: Vec<_> = points.iter().map(|&(x, y)| (x - first.0, y)).collect();
        let knots = Knots::of(knots, end.map(|(_, value)| (period.unwrap_or_default(), value)));
        let mut segments: Vec<Segment> = match interpolation {
            Interpolation::Linear => knots.segments(|at| [knots.values[at], knots.slopes[at], 0.0, 0.0]),
            Interpolation::Step => knots.segments(|at| [knots.values[at], 0.0, 0.0, 0.0]),
            Interpolation::Cubic => {
                let curvatures = knots.curvatures();
                knots.segments(|at| knots.with_curvatures(at, curvatures[at], curvatures[at + 1]))
            }
            Interpolation::Monotone => {
                let slopes = knots.monotone_slopes();
                knots.segments(|at| knots.with_slopes(at, slopes[at], slopes[at + 1]))
            }
        };
        if !segments.iter().flat_map(|segment| segment.coefficients).all(f64::is_finite) {
            return None;
        }
        let constant = |from, value| Segment { from, coefficients: [value, 0.0, 0.0, 0.0] };
        let length = last.0 - first.0;
        // the outermost pieces, counted from the outermost points
        let begin = segments.first()?.coefficients;
        let end = match interpolation {
            Interpolation::Step => [last.1, 0.0, 0.0, 0.0],
            _ => segments.last()?.counted_from(length, last.1),
        };
        match outside {
            Outside::Periodic(_) => {}
            // what was there before the first point is continued
            Outside::Extend => match interpolation {
                Interpolation::Linear | Interpolation::Cubic => {}
                Interpolation::Step => segments.push(constant(length, last.1)),
                Interpolation::Monotone => {
                    // a cubic that goes on turns around
                    let line =
                        |from, [c0, c1, ..]: [f64; 4]| Segment { from, coefficients: [c0, c1, 0.0, 0.0] };
                    segments.insert(0, line(0.0, begin));
                    segments.push(line(length, end));
                }
            },
            Outside::Hold => {
                segments.insert(0, constant(0.0, first.1));
                segments.push(constant(length, last.1));
            }
            Outside::Refuse => {
                let none = |from| Segment { from, coefficients: [f64::NAN; 4] };
                // an argument that is an end but for its rounding is within
                let slack = ROUNDINGS * f64::EPSILON * first.0.abs().max(last.0.abs());
                segments.insert(0, Segment { from: -slack, coefficients: begin });
                segments.insert(0, none(-slack));
                segments.push(Segment { from: length, coefficients: end });
                segments.push(none(length + slack));
            }
        }
        Some(Self { name: name.to_owned(), origin: first.0, period, segments, bends: None })
    }
}

/// Points, counted from the first argument, with what lies between them.
struct Knots {
    from: Vec<f64>,
    values: Vec<f64>,
    /// The distance to the next point.
    widths: Vec<f64>,
    /// The slope of the chord to the next point.
    slopes: Vec<f64>,
    is_periodic: bool,
}

impl Knots {
    fn of(points: Vec<(f64, f64)>, closing: Option<(f64, f64)>) -> Self {
        let is_periodic = closing.is_some();
        let points: Vec<_> = points.into_iter().chain(closing).collect();
        let widths: Vec<f64> = points.windows(2).map(|pair| pair[1].0 - pair[0].0).collect();
        let slopes =
            points.windows(2).zip(&widths).map(|(pair, width)| (pair[1].1 - pair[0].1) / width).collect();
        let (from, values) = points.into_iter().unzip();
        Self { from, values, widths, slopes, is_periodic }
    }

    fn segments(&self, coefficients: impl Fn(usize) -> [f64; 4]) -> Vec<Segment> {
        (0..self.widths.len())
            .map(|at| Segment { from: self.from[at], coefficients: coefficients(at) })
            .collect()
    }

    /// The cubic with these second derivatives at its ends.
    fn with_curvatures(&self, at: usize, here: f64, next: f64) -> [f64; 4] {
        let (width, slope) = (self.widths[at], self.slopes[at]);
        let first_slope = slope - width * (2.0 * here + next) / 6.0;
        [self.values[at], first_slope, here / 2.0, (next - here) / (6.0 * width)]
    }

    /// The cubic with these slopes at its ends.
    fn with_slopes(&self, at: usize, here: f64, next: f64) -> [f64; 4] {
        let (width, slope) = (self.widths[at], self.slopes[at]);
        let second = (3.0 * slope - 2.0 * here - next) / width;
        [self.values[at], here, second, (here + next - 2.0 * slope) / (width * width)]
    }

    /// The second derivatives M at the points, with which the first derivative is continuous:
    ///
    /// ```text
    /// h₋ M₋ + 2(h₋ + h) M + h M₊ = 6(s − s₋)
    /// ```
    ///
    /// where h are the widths and s the slopes of the chords.
    fn curvatures(&self) -> Vec<f64> {
        let (widths, slopes, n) = (&self.widths, &self.slopes, self.widths.len());
        if self.is_periodic {
            let rhs: Vec<f64> = (0..n).map(|at| 6.0 * (slopes[at] - slopes[(at + n - 1) % n])).collect();
            let mut curvatures = solve_cyclic(widths, &rhs);
            curvatures.push(curvatures[0]);
            return curvatures;
        }
        let diagonal: Vec<f64> = widths.windows(2).map(|pair| 2.0 * (pair[0] + pair[1])).collect();
        let rhs: Vec<f64> = slopes.windows(2).map(|pair| 6.0 * (pair[1] - pair[0])).collect();
        let inner = if rhs.is_empty() { Vec::new() } else { solve_line(&widths[1..], &diagonal, &rhs) };
        [0.0].into_iter().chain(inner).chain([0.0]).collect()
    }

    /// The slopes of Fritsch and Butland: 0 where the chords do not agree in sign, a weighted harmonic mean of
    /// theirs elsewhere. At the ends it is that of the parabola through three points, as far as that keeps the
    /// direction.
    fn monotone_slopes(&self) -> Vec<f64> {
        let (widths, slopes, n) = (&self.widths, &self.slopes, self.widths.len());
        let between = |before: usize, behind: usize| {
            let (h, s) = ([widths[before], widths[behind]], [slopes[before], slopes[behind]]);
            let weights = [h[0] + 2.0 * h[1], 2.0 * h[0] + h[1]];
            let agree = s[0].signum() == s[1].signum() && s[0] != 0.0 && s[1] != 0.0;
            if agree { (weights[0] + weights[1]) / (weights[0] / s[0] + weights[1] / s[1]) } else { 0.0 }
        };
        let end = |near: usize, far: usize| {
            let (h, s) = ([widths[near], widths[far]], [slopes[near], slopes[far]]);
            let slope = ((2.0 * h[0] + h[1]) * s[0] - h[0] * s[1]) / (h[0] + h[1]);
            let turns = s[0].signum() != s[1].signum();
            if slope.signum() != s[0].signum() || s[0] == 0.0 {
                0.0
            } else if turns && slope.abs() > 3.0 * s[0].abs() {
                3.0 * s[0]
            } else {
                slope
            }
        };
        let inner = (1..n).map(|at| between(at - 1, at));
        let ends = match n {
            _ if self.is_periodic => [between(n - 1, 0); 2],
            1 => [slopes[0]; 2],
            _ => [end(0, 1), end(n - 1, n - 2)],
        };
        [ends[0]].into_iter().chain(inner).chain([ends[1]]).collect()
    }
}

/// Solves h₋x₋ + 2(h₋ + h)x + h x₊ = r in a circle, where h₋ is the h before.
///
/// The matrix is that of a line with both corners added, the product of a
/// column and a row: two solutions of the line give that of the circle (the
/// formula of Sherman and Morrison). It is diagonally dominant, so no pivot is
/// small.
fn solve_cyclic(h: &[f64], r: &[f64]) -> Vec<f64> {
    let n = h.len();
    let corner = h[n - 1];
    let mut diagonal: Vec<f64> = (0..n).map(|at| 2.0 * (h[(at + n - 1) % n] + h[at])).collect();
    // the column is (−d, 0, …, corner), the row (1, 0, …, −corner/d)
    let d = diagonal[0];
    diagonal[0] += d;
    diagonal[n - 1] += corner * corner / d;
    let mut column = vec![0.0; n];
    (column[0], column[n - 1]) = (-d, corner);
    let x = solve_line(h, &diagonal, r);
    let z = solve_line(h, &diagonal, &column);
    let along = |values: &[f64]| values[0] - corner / d * values[n - 1];
    let factor = along(&x) / (1.0 + along(&z));
    x.iter().zip(&z).map(|(x, z)| x - factor * z).collect()
}

/// Solves a symmetric system with this diagonal and h beside it.
fn solve_line(h: &[f64], diagonal: &[f64], r: &[f64]) -> Vec<f64> {
    let n = diagonal.len();
    let (mut pivots, mut x) = (diagonal.to_vec(), r.to_vec());
    for at in 1..n {
        let factor = h[at - 1] / pivots[at - 1];
        pivots[at] -= factor * h[at - 1];
        x[at] -= factor * x[at - 1];
    }
    x[n - 1] /= pivots[n - 1];
    for at in (0..n - 1).rev() {
        x[at] = (x[at] - h[at] * x[at + 1]) / pivots[at];
    }
    x
}
