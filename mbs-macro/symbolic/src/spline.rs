//! Periodic cubic splines: functions given by a table.
//!
//! The compiler solves for the coefficients. Generated code holds them as a constant.

use crate::arena::Expr;

/// A spline: a handle into an [`Arena`](crate::Arena)'s list of splines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SplineId(pub(crate) u32);

impl SplineId {
    /// Its position in the list of splines.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// The derivative of a derivative of this order; `None` where a cubic has none
/// but 0.
pub(crate) fn next_order(order: u8) -> Option<u8> {
    (order < 3).then_some(order + 1)
}

/// One cubic: c₀ + c₁u + c₂u² + c₃u³ from `from` on, u counted from there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Distance from the first point.
    pub from: f64,
    /// c₀ … c₃
    pub coefficients: [f64; 4],
}

/// A function of period P through given points, cubic between them, with two
/// continuous derivatives everywhere.
#[derive(Clone, Debug, PartialEq)]
pub struct Spline {
    /// The way in which it is called.
    pub name: String,
    /// The argument of the first point.
    pub origin: f64,
    /// P
    pub period: f64,
    /// From point to point, the last one back to the first.
    pub segments: Vec<Segment>,
}

impl Spline {
    /// The spline through `points` of (argument, value). `None` unless they are
    /// three or more, ascending and within one period, and everything is finite.
    pub fn periodic(name: &str, points: &[(f64, f64)], period: f64) -> Option<Self> {
        let (first, last) = (points.first()?, points.last()?);
        let ascends = points.windows(2).all(|pair| pair[0].0 < pair[1].0);
        let is_finite = points.iter().all(|(x, y)| x.is_finite() && y.is_finite()) && period.is_finite();
        if points.len() < 3 || !ascends || !is_finite || last.0 - first.0 >= period {
            return None;
        }
        let n = points.len();
        let ends = points[1..].iter().map(|&(x, y)| (x - first.0, y)).chain([(period, first.1)]);
        // width and slope of the chord of every segment
        let chords: Vec<(f64, f64)> = points
            .iter()
            .zip(ends)
            .map(|(&(x, y), (end, next))| (end - (x - first.0), next - y))
            .map(|(width, rise)| (width, rise / width))
            .collect();
        let before = |at: usize| chords[(at + n - 1) % n];
        // h₋ M₋ + 2(h₋ + h) M + h M₊ = 6(s − s₋) with the second derivatives M:
        // the first derivative is continuous
        let widths: Vec<f64> = chords.iter().map(|chord| chord.0).collect();
        let rhs: Vec<f64> = (0..n).map(|at| 6.0 * (chords[at].1 - before(at).1)).collect();
        let curvatures = solve_cyclic(&widths, &rhs);
        let segments: Vec<Segment> = (0..n)
            .map(|at| {
                let (width, slope) = chords[at];
                let (here, next) = (curvatures[at], curvatures[(at + 1) % n]);
                let first_slope = slope - width * (2.0 * here + next) / 6.0;
                let coefficients = [points[at].1, first_slope, here / 2.0, (next - here) / (6.0 * width)];
                Segment { from: points[at].0 - first.0, coefficients }
            })
            .collect();
        let is_finite = segments.iter().flat_map(|s| s.coefficients).all(f64::is_finite);
        is_finite.then(|| Self { name: name.to_owned(), origin: first.0, period, segments })
    }

    /// Overshoots between neighbouring points of equal values: the index of the first point, and the largest distance
    /// of the cubic from that value. The cubic leaves the value where it has a slope at both ends.
    pub fn overshoots(&self) -> impl Iterator<Item = (usize, f64)> {
        let next = self.segments.iter().skip(1).chain(self.segments.first());
        self.segments.iter().zip(next).enumerate().filter_map(|(at, (segment, next))| {
            let Segment { from, coefficients: [c0, c1, c2, c3] } = *segment;
            let end = if at + 1 == self.segments.len() { self.period } else { next.from };
            // u (c₁ + u (c₂ + u c₃)) vanishes at both ends; where it is flat, its slope does
            let root = (c2 * c2 - 3.0 * c1 * c3).sqrt();
            let flat = [-c2 - root, -c2 + root].map(|q| [q / (3.0 * c3), c1 / q]);
            let inside = flat.into_iter().flatten().filter(|u| *u > 0.0 && *u < end - from);
            let away = inside.map(|u| (u * (c1 + u * (c2 + u * c3))).abs()).fold(0.0, f64::max);
            (next.coefficients[0] == c0).then_some((at, away))
        })
    }

    /// The derivative of this order at x, the function itself for 0; as the
    /// runtime computes it.
    pub fn derivative(&self, order: u8, x: f64) -> f64 {
        let x = x - self.origin;
        let u = x - (x / self.period).floor() * self.period;
        let at = self.segments.partition_point(|segment| segment.from <= u).saturating_sub(1);
        let Some(Segment { from, coefficients: [c0, c1, c2, c3] }) = self.segments.get(at).copied() else {
            return f64::NAN;
        };
        let u = u - from;
        match order {
            0 => c0 + u * (c1 + u * (c2 + u * c3)),
            1 => c1 + u * (2.0 * c2 + u * (3.0 * c3)),
            2 => 2.0 * c2 + u * (6.0 * c3),
            _ => 6.0 * c3,
        }
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

impl crate::Arena {
    /// Adds a spline.
    pub fn add_spline(&mut self, spline: Spline) -> SplineId {
        self.splines.push(std::rc::Rc::new(spline));
        SplineId((self.splines.len() - 1) as u32)
    }

    /// The splines, by their index.
    pub fn splines(&self) -> &[std::rc::Rc<Spline>] {
        &self.splines
    }

    /// The value of a spline at x.
    pub fn spline(&mut self, spline: SplineId, x: Expr) -> Expr {
        self.spline_derivative(spline, 0, x)
    }
}
