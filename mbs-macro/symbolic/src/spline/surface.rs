//! Functions of two arguments given on a grid, made of functions of one.
//!
//! Between two lines of the grid f(x, y) = Σ s^p C_p(y), s = x − xᵢ. For each p the C_p of all i stand one behind the
//! other in one spline, each row a stride behind the one before: of x two step functions find xᵢ and the place of the
//! row, and the splines there take y. So a surface costs some searches of a logarithm of its points each, and needs
//! nothing of its own in a target. A place in a row is off by a rounding of the length of all rows.

use super::{Bends, Interpolation, Outside, Segment, Spline, SplineId};
use crate::arena::{Arena, Expr};
use crate::number::Number;

/// Values on a grid: those of all y for the first x, and so on.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// The values of the first argument, in ascending order.
    pub x: Vec<f64>,
    /// Those of the second one.
    pub y: Vec<f64>,
    /// f(x₀, y₀), f(x₀, y₁) …
    pub values: Vec<f64>,
}

/// A function of two arguments in an arena.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    axes: [Axis; 2],
    /// xᵢ
    begin: SplineId,
    /// The place of a row.
    row: SplineId,
    /// C_p, for each power p.
    parts: Vec<SplineId>,
}

/// An argument of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Axis {
    /// The argument, brought within the grid.
    within: SplineId,
    /// True if the surface goes on beyond the grid by lines.
    is_extended: bool,
}

/// One axis of a grid, before it is in an arena.
struct Lines<'a> {
    at: &'a [f64],
    outside: Outside,
    interpolation: Interpolation,
}

impl Lines<'_> {
    fn period(&self) -> Option<f64> {
        if let Outside::Periodic(period) = self.outside { Some(period) } else { None }
    }

    /// The end of the last piece.
    fn end(&self) -> Option<f64> {
        let (first, last) = (self.at.first()?, self.at.last()?);
        Some(self.period().map_or(*last, |period| first + period))
    }

    /// The pieces of the function through values, without what is outside of them.
    fn pieces(&self, values: &[f64]) -> Option<Vec<Segment>> {
        let outside = self.period().map_or(Outside::Extend, Outside::Periodic);
        let points: Vec<_> = self.at.iter().copied().zip(values.iter().copied()).collect();
        let mut pieces = Spline::through("", &points, self.interpolation, outside)?.segments;
        pieces.truncate(self.count());
        Some(pieces)
    }

    /// The number of pieces: of a step function the last value is one, too.
    fn count(&self) -> usize {
        let is_closed = self.period().is_some() || self.interpolation == Interpolation::Step;
        if is_closed { self.at.len() } else { self.at.len() - 1 }
    }

    /// The step function that has a value on each piece.
    fn steps(&self, name: &str, values: &[f64]) -> Option<Spline> {
        let points: Vec<_> = self.at.iter().copied().zip(values.iter().copied()).collect();
        let steps = match *points {
            // a step function through points has two or more
            [(origin, value)] => {
                let segments = vec![Segment { from: 0.0, coefficients: [value, 0.0, 0.0, 0.0] }];
                Spline { name: name.to_owned(), origin, period: None, segments, bends: None }
            }
            _ => Spline::through(name, &points, Interpolation::Step, Outside::Hold)?,
        };
        Some(Spline { bends: Some(Bends::default()), ..steps })
    }

    /// An argument of a surface, brought within the lines; it bends at them if the surface does.
    fn axis(&self, arena: &mut Arena, of: &str, name: &str) -> Option<Axis> {
        let ends = [*self.at.first()?, *self.at.last()?].map(|end| (end, end));
        let mut spline = match self.outside {
            Outside::Periodic(period) => Spline {
                name: name.to_owned(),
                origin: ends[0].0,
                period: Some(period),
                segments: vec![Segment { from: 0.0, coefficients: [ends[0].0, 1.0, 0.0, 0.0] }],
                bends: None,
            },
            Outside::Refuse => Spline::through(name, &ends, Interpolation::Linear, Outside::Refuse)?,
            Outside::Hold | Outside::Extend => {
                Spline::through(name, &ends, Interpolation::Linear, Outside::Hold)?
            }
        };
        let is_extended = self.outside == Outside::Extend;
        let (at, order) = match (self.interpolation, self.outside) {
            (Interpolation::Step, _) => (self.at.to_vec(), 0),
            (Interpolation::Linear, _) => (self.at.to_vec(), 1),
            (_, Outside::Hold) => (ends.map(|(end, _)| end).to_vec(), 1),
            (_, Outside::Extend) => (ends.map(|(end, _)| end).to_vec(), 2),
            (_, Outside::Periodic(_) | Outside::Refuse) => (Vec::new(), 3),
        };
        spline.bends = Some(Bends { of: of.to_owned(), at, order });
        Some(Axis { within: arena.add_spline(spline), is_extended })
    }
}

impl Arena {
    /// The surface over a grid; `None` unless both axes ascend and have two lines or more, periodic cubic ones three,
    /// and everything is finite. `Interpolation::Monotone` has none.
    pub fn add_surface(
        &mut self,
        name: &str,
        grid: &Grid,
        interpolation: Interpolation,
        outside: [Outside; 2],
    ) -> Option<Surface> {
        let [x, y] = [(&grid.x, outside[0]), (&grid.y, outside[1])].map(|(at, outside)| Lines {
            at,
            outside,
            interpolation,
        });
        let is_grid = x.at.len() >= 2 && y.at.len() >= 2 && grid.values.len() == x.at.len() * y.at.len();
        if !is_grid || interpolation == Interpolation::Monotone {
            return None;
        }
        let first = *y.at.first()?;
        // between two rows there is room for arguments that are an end but for their rounding
        let stride = (y.end()? - first) * (1.0 + 1.0 / y.count() as f64);
        let rows: Vec<f64> = (0..x.count()).map(|at| at as f64 * stride).collect();
        let parts = parts(grid, [&x, &y], &rows)?.into_iter().enumerate().map(|(power, segments)| {
            let (name, bends) = (format!("{name}_c{power}"), Some(Bends::default()));
            self.add_spline(Spline { name, origin: first, period: None, segments, bends })
        });
        let parts = parts.collect();
        let begin = x.steps(&format!("{name}_x"), x.at.get(..x.count())?)?;
        let row = x.steps(&format!("{name}_row"), &rows)?;
        let [begin, row] = [begin, row].map(|steps| self.add_spline(steps));
        let axes = [x.axis(self, name, &format!("{name}_in1"))?, y.axis(self, name, &format!("{name}_in2"))?];
        Some(Surface { axes, begin, row, parts })
    }

    /// The value of a surface at (x, y).
    pub fn surface(&mut self, surface: &Surface, [x, y]: [Expr; 2]) -> Expr {
        let [along, across] = surface.axes;
        let [within_x, within_y] = [(along, x), (across, y)].map(|(axis, z)| self.spline(axis.within, z));
        let beyond = [(along, x, within_x), (across, y, within_y)]
            .map(|(axis, z, within)| axis.is_extended.then(|| self.sub(z, within)));
        let mut terms = Vec::new();
        for (order_x, by_x) in [(0, None), (1, beyond[0])] {
            for (order_y, by_y) in [(0, None), (1, beyond[1])] {
                if (order_x > 0 && by_x.is_none()) || (order_y > 0 && by_y.is_none()) {
                    continue;
                }
                let slope = self.of_surface(surface, [within_x, within_y], [order_x, order_y]);
                let factors = by_x.into_iter().chain(by_y);
                let term = factors.fold(slope, |term, factor| self.mul(term, factor));
                terms.push((term, Number::ONE));
            }
        }
        self.sum(&terms)
    }

    /// A derivative within the grid, of order 0 or 1 by x and y: Σ s^p C_p(y) or Σ p s^(p−1) C_p(y).
    fn of_surface(&mut self, surface: &Surface, [x, y]: [Expr; 2], [by_x, by_y]: [u8; 2]) -> Expr {
        let [begin, row] = [surface.begin, surface.row].map(|steps| self.spline(steps, x));
        let (s, place) = (self.sub(x, begin), self.add(row, y));
        let mut value = self.zero();
        for (power, &part) in surface.parts.iter().enumerate().skip(usize::from(by_x)).rev() {
            let part = self.spline_derivative(part, by_y, place);
            let part = if by_x > 0 { self.scale(part, Number::integer(power as i64)) } else { part };
            let before = self.mul(s, value);
            value = self.add(before, part);
        }
        value
    }
}

/// The pieces of C_p, for each power p, all rows one behind the other.
fn parts(grid: &Grid, [x, y]: [&Lines<'_>; 2], rows: &[f64]) -> Option<Vec<Vec<Segment>>> {
    let powers = match x.interpolation {
        Interpolation::Step => 1,
        Interpolation::Linear => 2,
        Interpolation::Cubic | Interpolation::Monotone => 4,
    };
    // along x for each y: the coefficients of each piece
    let along_x = (0..y.at.len()).map(|at| {
        let values: Vec<f64> = grid.values.iter().skip(at).step_by(y.at.len()).copied().collect();
        x.pieces(&values)
    });
    let along_x: Vec<Vec<Segment>> = along_x.collect::<Option<_>>()?;
    let part = |power: usize| {
        let mut segments = Vec::new();
        for (at, row) in rows.iter().enumerate() {
            let values: Vec<f64> = along_x.iter().map(|pieces| pieces[at].coefficients[power]).collect();
            segments.extend(row_segments(y, y.pieces(&values)?, *row)?);
        }
        Some(segments)
    };
    (0..powers).map(part).collect()
}

/// The pieces of a row at its place, and what is behind its end.
fn row_segments(y: &Lines<'_>, pieces: Vec<Segment>, row: f64) -> Option<Vec<Segment>> {
    let first = *y.at.first()?;
    // as the place of an argument is computed: the row plus y, counted from the first y
    let place = |y: f64| (row + y) - first;
    let (last, end) = (*pieces.last()?, y.end()?);
    let width = (end - first) - last.from;
    let [c0, c1, c2, c3] = last.coefficients;
    let behind = last.counted_from(last.from + width, c0 + width * (c1 + width * (c2 + width * c3)));
    let mut segments: Vec<Segment> =
        pieces.iter().zip(y.at).map(|(piece, at)| Segment { from: place(*at), ..*piece }).collect();
    segments.push(Segment { from: place(end), coefficients: behind });
    segments.iter().flat_map(|segment| segment.coefficients).all(f64::is_finite).then_some(segments)
}
