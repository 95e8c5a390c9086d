//! How many degrees of freedom a linkage has where it is drawn.

use super::geometry::{Point, minus};
use super::linkage::{GROUND, Linkage, Motion};

/// The degrees of freedom of a linkage, and its redundant constraints.
pub(super) struct Mobility {
    /// Degrees of freedom.
    pub dof: usize,
    /// How many constraints repeat others.
    pub repeated: usize,
}

/// Counts the independent constraints at the start. The motions of the links are x and y of
/// the origin in parts of the linkage's size, and angles.
pub(super) fn of(linkage: &Linkage) -> Mobility {
    let rows = Rows { linkage, size: linkage.size(), rows: Vec::new() }.all();
    let columns = 3 * (linkage.links.len() - 1);
    let count = rows.len();
    let rank = rank(rows);
    Mobility { dof: columns - rank, repeated: count - rank }
}

struct Rows<'a> {
    linkage: &'a Linkage,
    size: f64,
    rows: Vec<Vec<f64>>,
}

impl Rows<'_> {
    fn all(mut self) -> Vec<Vec<f64>> {
        for pin in 0..self.linkage.pins.len() {
            let links: Vec<usize> = self.linkage.on(pin).collect();
            for &link in links.iter().skip(1) {
                let at = self.linkage.pins[pin].at;
                self.row(&[(links[0], 1.0), (link, -1.0)], at, [1.0, 0.0]);
                self.row(&[(links[0], 1.0), (link, -1.0)], at, [0.0, 1.0]);
            }
        }
        for slot in &self.linkage.slots {
            let Some(rider) = self.linkage.rider(slot) else { continue };
            let length = slot.along[0].hypot(slot.along[1]);
            let normal = [-slot.along[1] / length, slot.along[0] / length];
            self.row(&[(rider, 1.0), (slot.link, -1.0)], self.linkage.pins[slot.pin].at, normal);
            if slot.keeps_angle {
                self.turn(&[(rider, 1.0), (slot.link, -1.0)]);
            }
        }
        for drive in &self.linkage.drives {
            let links = [(drive.link, 1.0), (drive.against, -1.0)];
            match drive.motion {
                Motion::Slide { along, .. } => self.row(&links, self.linkage.pins[drive.to].at, along),
                _ => self.turn(&links),
            }
        }
        self.rows
    }

    /// How fast links move at a place along a direction.
    fn row(&mut self, links: &[(usize, f64)], at: Point, along: Point) {
        let [x, y] = minus(at, self.linkage.pins[0].at).map(|number| number / self.size);
        self.entries(links, [along[0], along[1], along[1] * x - along[0] * y]);
    }

    /// How fast links turn.
    fn turn(&mut self, links: &[(usize, f64)]) {
        self.entries(links, [0.0, 0.0, 1.0]);
    }

    fn entries(&mut self, links: &[(usize, f64)], of: [f64; 3]) {
        let mut row = vec![0.0; 3 * (self.linkage.links.len() - 1)];
        for &(link, sign) in links.iter().filter(|(link, _)| *link != GROUND) {
            for (entry, value) in row.iter_mut().skip(3 * (link - 1)).zip(of) {
                *entry += sign * value;
            }
        }
        self.rows.push(row);
    }
}

/// The rank of a matrix by elimination with complete pivots.
pub(super) fn rank(mut rows: Vec<Vec<f64>>) -> usize {
    let columns = rows.first().map_or(0, Vec::len);
    let mut rank = 0;
    while rank < rows.len() {
        let entries = (rank..rows.len()).flat_map(|row| (0..columns).map(move |column| (row, column)));
        let size = |&(row, column): &(usize, usize)| rows[row][column].abs();
        let Some(pivot) = entries.max_by(|a, b| size(a).total_cmp(&size(b))) else { break };
        // Drawings are exact to some digits, and elimination loses a few of the others.
        if size(&pivot) < 1e-9 {
            break;
        }
        rows.swap(rank, pivot.0);
        let (done, left) = rows.split_at_mut(rank + 1);
        let top = &done[rank];
        for row in left {
            let factor = row[pivot.1] / top[pivot.1];
            row.iter_mut().zip(top).for_each(|(entry, above)| *entry -= factor * above);
            row[pivot.1] = 0.0;
        }
        rank += 1;
    }
    rank
}
