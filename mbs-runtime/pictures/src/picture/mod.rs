//! Pictures of mechanisms: what is drawn between points whose places are known
//! at every instant, apart from how it is drawn.
//!
//! A [`Motion`] says where the points of a [sketch](mbs_runtime::Sketch) are
//! during a run; [`Picture::of`] finds the shapes that belong there. Figures
//! draw a picture still, with earlier and later poses behind it; reports let it
//! move.

mod geometry;
pub mod json;
mod shapes;

use mbs_runtime::Sketch;

pub use geometry::Extent;

/// More places than this are not kept of a run: they would only make pages long.
const MOST_PLACES: usize = 12_000;
/// More instants than this are not kept of a run.
const MOST_INSTANTS: usize = 240;
/// As many instants are kept of any mechanism.
const FEWEST_INSTANTS: usize = 24;

/// Where the points of a mechanism are at some instants of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Which points there are, and what joins them.
    pub sketch: &'static Sketch,
    /// The instants, ascending, in s.
    pub times: Vec<f64>,
    /// For every instant the places of all points, in m.
    pub places: Vec<Vec<[f64; 2]>>,
}

/// Positions, evenly spread over `0..rows`, of the rows of a recording that a
/// motion of this many points keeps: the first, the last, and not too many.
pub fn kept(rows: usize, points: usize) -> Vec<usize> {
    let most = (MOST_PLACES / points.max(1)).clamp(FEWEST_INSTANTS, MOST_INSTANTS);
    let count = rows.min(most);
    let last = rows.saturating_sub(1);
    (0..count)
        .map(|k| (k * last + count / 2) / count.saturating_sub(1).max(1))
        .map(|at| at.min(last))
        .collect()
}

/// A mechanism as shapes between moving points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// The instants, ascending, in s.
    pub times: Vec<f64>,
    /// For every instant the points, in m.
    pub points: Vec<Vec<[f64; 2]>>,
    /// The shapes that are drawn, from back to front.
    pub shapes: Vec<Shape>,
    /// Points whose path is drawn, with their colours.
    pub traced: Vec<(usize, usize)>,
    /// Size of joints and width of bars, 1 where there is room; small
    /// mechanisms of many bodies need less.
    pub weight: f64,
}

/// Something drawn at points, given by their positions in the list of points.
/// Colours are positions in [`SERIES_COLOURS`](crate::figure::SERIES_COLOURS),
/// which repeats.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A thin line on which a block slides.
    Rail {
        /// A point on the line.
        from: usize,
        /// Another, in its direction.
        ahead: usize,
        /// From where to where it is drawn, in m from the first towards the second.
        reach: [f64; 2],
    },
    /// A place that stands still: a hatched triangle.
    Ground {
        /// Its tip.
        at: usize,
    },
    /// A massless rod.
    Link {
        /// Its ends.
        between: [usize; 2],
    },
    /// A circle.
    Circle {
        /// Its centre.
        at: usize,
        /// A point on it.
        rim: usize,
        /// The colour of its body; none for the ground.
        colour: Option<usize>,
    },
    /// A spring.
    Spring {
        /// Its ends.
        between: [usize; 2],
    },
    /// A body of two points, or of points on a line.
    Bar {
        /// Its ends.
        between: [usize; 2],
        /// Its colour.
        colour: usize,
    },
    /// A body of points that are not on a line.
    Plate {
        /// Its corners, in order.
        corners: Vec<usize>,
        /// Its colour.
        colour: usize,
    },
    /// A body of which no other point is known than its centre.
    Dot {
        /// Its centre.
        at: usize,
        /// Its colour.
        colour: usize,
    },
    /// A block that slides along a line.
    Block {
        /// Its middle.
        at: usize,
        /// A point on the line.
        from: usize,
        /// Another, in its direction.
        ahead: usize,
        /// Its colour.
        colour: usize,
    },
    /// A spring between the angles of two bodies.
    Coil {
        /// Its middle.
        at: usize,
    },
    /// A joint that lets its bodies turn.
    Pin {
        /// Its place.
        at: usize,
    },
    /// A joint that does not.
    Weld {
        /// Its place.
        at: usize,
    },
    /// A centre of mass.
    Centre {
        /// Its place.
        at: usize,
    },
    /// A joint of a kind that has no shape of its own: its word, at a dashed line.
    Mark {
        /// The points that it connects.
        between: [usize; 2],
        /// The word.
        text: String,
    },
    /// The name of a body.
    Label {
        /// The name.
        text: String,
        /// It stands at the middle of these.
        near: Vec<usize>,
        /// The colour of the body.
        colour: usize,
    },
}

impl Shape {
    /// The points at which it is drawn; those that only give a direction are left out.
    pub fn points(&self) -> Vec<usize> {
        match self {
            Self::Rail { .. } => Vec::new(),
            Self::Link { between } | Self::Spring { between } => between.to_vec(),
            Self::Circle { at, rim, .. } => vec![*at, *rim],
            Self::Bar { between, .. } | Self::Mark { between, .. } => between.to_vec(),
            Self::Plate { corners, .. } => corners.clone(),
            Self::Label { near, .. } => near.clone(),
            Self::Ground { at } | Self::Coil { at } | Self::Pin { at } => vec![*at],
            Self::Weld { at } | Self::Centre { at } => vec![*at],
            Self::Dot { at, .. } | Self::Block { at, .. } => vec![*at],
        }
    }
}

impl Picture {
    /// The picture of a mechanism in motion.
    pub fn of(motion: &Motion) -> Self {
        let times = motion.times.clone();
        let mut picture = Self { times, points: motion.places.clone(), weight: 1.0, ..Self::default() };
        shapes::draw(motion.sketch, &mut picture);
        picture
    }

    /// A point at an instant; not a number where there is none.
    pub fn place(&self, instant: usize, point: usize) -> [f64; 2] {
        let places = self.points.get(instant);
        places.and_then(|places| places.get(point)).copied().unwrap_or([f64::NAN; 2])
    }

    /// All points at a time, on straight lines between those of the instants around it.
    #[cfg(feature = "figure")]
    pub(crate) fn places_at(&self, time: f64) -> Vec<[f64; 2]> {
        let after = self.times.partition_point(|instant| *instant < time);
        let before = after.saturating_sub(1);
        let (Some(a), Some(b)) = (self.points.get(before), self.points.get(after)) else {
            return self.points.last().cloned().unwrap_or_default();
        };
        let span = self.times[after] - self.times[before];
        let part = if span > 0.0 { (time - self.times[before]) / span } else { 0.0 };
        let between =
            |(a, b): (&[f64; 2], &[f64; 2])| [0, 1].map(|axis| a[axis] + part * (b[axis] - a[axis]));
        a.iter().zip(b).map(between).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instants_are_few_and_reach_both_ends() {
        assert_eq!(kept(3, 10), [0, 1, 2]);
        assert_eq!(kept(1, 10), [0]);
        assert!(kept(0, 10).is_empty());
        for (rows, points) in [(2001, 4), (5000, 300), (100, 4000), (240, 1)] {
            let kept = kept(rows, points);
            assert_eq!((kept.first(), kept.last()), (Some(&0), Some(&(rows - 1))));
            assert!(kept.is_sorted_by(|a, b| a < b), "{kept:?}");
            assert!(
                kept.len() <= MOST_INSTANTS
                    && kept.len() * points <= MOST_PLACES.max(points * FEWEST_INSTANTS)
            );
        }
    }
}
