//! How many degrees of freedom a mechanism has where its file draws it.

use super::GROUND;
use super::flat::{Coordinate, Flat, Freedom, Measure};
use crate::geometry::{Point, minus, turned};
use crate::mobility::{Mobility, rank};

/// Counts the independent constraints at the start. The motions of the parts are x and y of
/// the origin in parts of the mechanism's size, and angles.
pub(super) fn of(flat: &Flat<'_>) -> Mobility {
    let mut rows = Rows { flat, rows: Vec::new() };
    rows.joints();
    rows.closings();
    rows.couplings();
    let columns = 3 * (flat.parts.len() - 1);
    let count = rows.rows.len();
    let rank = rank(rows.rows);
    Mobility { dof: columns - rank, repeated: count - rank }
}

struct Rows<'a> {
    flat: &'a Flat<'a>,
    rows: Vec<Vec<f64>>,
}

impl Rows<'_> {
    fn joints(&mut self) {
        for held in &self.flat.joints {
            let at = self.flat.parts[held.parts[0]].start(held.at[0]);
            let normal = |part: usize, [x, y]: Point| turned([-y, x], self.flat.parts[part].angle);
            let of_parent = |along| normal(held.parts[1], along);
            match held.freedom {
                Freedom::Turn => self.point(held.parts, at),
                Freedom::Slide { along } => {
                    let row = self.relative(held.parts, at, of_parent(along));
                    self.rows.push(row);
                    self.turn(held.parts);
                }
                Freedom::SlideAndTurn { along } => {
                    let row = self.relative(held.parts, at, of_parent(along));
                    self.rows.push(row);
                }
                Freedom::TurnAndSlide { along } => {
                    let row = self.relative(held.parts, at, normal(held.parts[0], along));
                    self.rows.push(row);
                }
                Freedom::Shift => self.turn(held.parts),
                Freedom::All => {}
            }
        }
    }

    fn closings(&mut self) {
        for closed in &self.flat.closings {
            let at = self.flat.parts[closed.parts[0]].start(closed.at[0]);
            self.point(closed.parts, at);
            if closed.angle.is_some() {
                self.turn(closed.parts);
            }
        }
    }

    fn couplings(&mut self) {
        for coupled in &self.flat.couplings {
            let mut row = self.coordinate(coupled.follower);
            if let Some(leader) = coupled.leader {
                let slope = coupled.coupling.coefficients.get(1).copied().unwrap_or_default();
                let other = self.coordinate(leader);
                row.iter_mut().zip(other).for_each(|(entry, other)| *entry -= slope * other);
            }
            self.rows.push(row);
        }
    }

    fn point(&mut self, parts: [usize; 2], at: Point) {
        for along in [[1.0, 0.0], [0.0, 1.0]] {
            let row = self.relative(parts, at, along);
            self.rows.push(row);
        }
    }

    fn turn(&mut self, parts: [usize; 2]) {
        let row = self.entries(parts, [0.0, 0.0, 1.0]);
        self.rows.push(row);
    }

    /// How fast a coordinate grows, with lengths in parts of the mechanism's size.
    fn coordinate(&self, at: usize) -> Vec<f64> {
        let Coordinate { held, measure, .. } = &self.flat.coordinates[at];
        let held = &self.flat.joints[*held];
        match *measure {
            Measure::Angle { sign } => self.entries(held.parts, [0.0, 0.0, sign]),
            Measure::Along { along, is_of_body } => {
                let frame = if is_of_body { held.parts[0] } else { held.parts[1] };
                let along = turned(along, self.flat.parts[frame].angle);
                let place = self.flat.parts[held.parts[0]].start(held.at[0]);
                self.relative(held.parts, place, along)
            }
        }
    }

    /// How fast the first part moves against the second at a place along a direction.
    fn relative(&self, parts: [usize; 2], at: Point, along: Point) -> Vec<f64> {
        let [x, y] = minus(at, self.flat.parts[GROUND].at).map(|number| number / self.flat.size);
        self.entries(parts, [along[0], along[1], along[1] * x - along[0] * y])
    }

    fn entries(&self, parts: [usize; 2], of: [f64; 3]) -> Vec<f64> {
        let mut row = vec![0.0; 3 * (self.flat.parts.len() - 1)];
        for (part, sign) in parts.into_iter().zip([1.0, -1.0]).filter(|(part, _)| *part != GROUND) {
            for (entry, value) in row.iter_mut().skip(3 * (part - 1)).zip(of) {
                *entry += sign * value;
            }
        }
        row
    }
}
