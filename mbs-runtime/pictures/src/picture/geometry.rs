//! Where the shapes of a picture lie.

use super::{Picture, Shape};

/// A rectangle around places, in m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Its lower left corner.
    pub low: [f64; 2],
    /// Its upper right corner.
    pub high: [f64; 2],
}

impl Extent {
    /// The smallest rectangle around places; those that are not finite do not
    /// count. `None` if there are none.
    pub fn around(places: impl IntoIterator<Item = [f64; 2]>) -> Option<Self> {
        let finite = places.into_iter().filter(|[x, y]| x.is_finite() && y.is_finite());
        finite.fold(None, |extent: Option<Self>, place| {
            let Self { low, high } = extent.unwrap_or(Self { low: place, high: place });
            let at = |k: usize, f: fn(f64, f64) -> f64, bound: [f64; 2]| f(bound[k], place[k]);
            Some(Self {
                low: [at(0, f64::min, low), at(1, f64::min, low)],
                high: [at(0, f64::max, high), at(1, f64::max, high)],
            })
        })
    }

    /// Width and height.
    pub fn size(&self) -> [f64; 2] {
        [self.high[0] - self.low[0], self.high[1] - self.low[1]]
    }

    /// Its middle.
    pub fn middle(&self) -> [f64; 2] {
        [0.5 * (self.low[0] + self.high[0]), 0.5 * (self.low[1] + self.high[1])]
    }

    /// The larger of width and height.
    pub fn span(&self) -> f64 {
        self.size()[0].max(self.size()[1])
    }
}

impl Picture {
    /// The frame around everything that is drawn, at all instants, with some air. Its size is positive even
    /// where nothing moves.
    pub fn extent(&self) -> Extent {
        let mut shown: Vec<usize> = self.shapes.iter().flat_map(Shape::points).collect();
        shown.sort_unstable();
        shown.dedup();
        let all = || 0..self.points.len();
        let drawn = all().flat_map(|instant| shown.iter().map(move |&point| self.place(instant, point)));
        let rails = self.shapes.iter().filter_map(|shape| match shape {
            Shape::Rail { from, ahead, reach } => Some((*from, *ahead, *reach)),
            _ => None,
        });
        let ends = rails.flat_map(|(from, ahead, reach)| {
            all().flat_map(move |instant| reach.map(|s| self.along(instant, from, ahead, s)))
        });
        let rings = self.shapes.iter().filter_map(|shape| match shape {
            Shape::Circle { at, rim, .. } => Some((*at, *rim)),
            _ => None,
        });
        let rims = rings.flat_map(|(at, rim)| {
            all().flat_map(move |instant| {
                let ([x, y], radius) = (self.place(instant, at), self.apart(instant, at, rim));
                [[x - radius, y - radius], [x + radius, y + radius]]
            })
        });
        let around =
            Extent::around(drawn.chain(ends).chain(rims)).unwrap_or(Extent { low: [0.0; 2], high: [0.0; 2] });
        let far = around.low.iter().chain(&around.high).fold(0.0_f64, |far, x| far.max(x.abs()));
        // A mechanism at one place has no size of its own.
        let span = if around.span() > 1e-9 * far { around.span() } else { far.max(1.0) };
        let air = 0.09 * span;
        let least = |k: usize| (0.5 * (0.3 * span - around.size()[k])).max(air);
        Extent {
            low: [around.low[0] - least(0), around.low[1] - least(1)],
            high: [around.high[0] + least(0), around.high[1] + least(1)],
        }
    }

    /// The place that lies `distance` from one point towards another.
    pub fn along(&self, instant: usize, from: usize, ahead: usize, distance: f64) -> [f64; 2] {
        let ([x, y], [u, v]) = (self.place(instant, from), self.direction(instant, from, ahead));
        [x + distance * u, y + distance * v]
    }

    /// The distance of two points.
    pub fn apart(&self, instant: usize, from: usize, to: usize) -> f64 {
        distance(self.place(instant, from), self.place(instant, to))
    }

    /// The unit vector from one point to another; along x where they coincide.
    pub fn direction(&self, instant: usize, from: usize, to: usize) -> [f64; 2] {
        let (a, b) = (self.place(instant, from), self.place(instant, to));
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let length = dx.hypot(dy);
        if length > 0.0 { [dx / length, dy / length] } else { [1.0, 0.0] }
    }

    /// Up to `count` instants at which the mechanism stands as differently as
    /// it can from the start and from each other.
    #[cfg(feature = "figure")]
    pub(crate) fn poses(&self, count: usize) -> Vec<usize> {
        let shown: Vec<usize> = self.shapes.iter().flat_map(Shape::points).collect();
        let apart = |a: usize, b: usize| -> f64 {
            shown.iter().map(|&point| distance(self.place(a, point), self.place(b, point)).powi(2)).sum()
        };
        let mut nearest: Vec<f64> = (0..self.points.len()).map(|at| apart(at, 0)).collect();
        let mut poses = Vec::new();
        let least = 1e-3 * self.extent().span();
        for _ in 0..count {
            let farthest = nearest.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
            let Some((at, _)) = farthest.filter(|(_, square)| *square > least * least) else { break };
            poses.push(at);
            for (other, nearest) in nearest.iter_mut().enumerate() {
                *nearest = nearest.min(apart(other, at));
            }
        }
        poses
    }
}

pub(super) fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// How far `c` lies left of the line from `a` to `b`, times the length of that.
fn cross(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// The outline of places as positions in the list: the corners of the convex
/// hull, counter-clockwise (Andrew 1979); of places on a line, within `tolerance`,
/// its two ends; of places that coincide, the first.
pub(super) fn outline(places: &[[f64; 2]], tolerance: f64) -> Vec<usize> {
    let mut order: Vec<usize> = (0..places.len()).collect();
    order.sort_by(|&a, &b| {
        places[a][0].total_cmp(&places[b][0]).then(places[a][1].total_cmp(&places[b][1])).then(a.cmp(&b))
    });
    let pairs = || order.iter().flat_map(|&a| order.iter().map(move |&b| (a, b)));
    let length = |&(a, b): &(usize, usize)| distance(places[a], places[b]);
    let Some(widest) = pairs().max_by(|a, b| length(a).total_cmp(&length(b))) else { return Vec::new() };
    if length(&widest) <= tolerance {
        return vec![0];
    }
    let (a, b) = (widest.0.min(widest.1), widest.0.max(widest.1));
    let off_line = |&c: &usize| cross(places[a], places[b], places[c]).abs() / length(&widest);
    if order.iter().all(|c| off_line(c) <= tolerance) {
        return vec![a, b];
    }
    let half = |order: &mut dyn Iterator<Item = usize>| {
        let mut hull: Vec<usize> = Vec::new();
        for c in order {
            while let [.., a, b] = hull[..]
                && cross(places[a], places[b], places[c]) <= 0.0
            {
                hull.pop();
            }
            hull.push(c);
        }
        hull.pop();
        hull
    };
    let mut hull = half(&mut order.iter().copied());
    hull.extend(half(&mut order.iter().rev().copied()));
    hull
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outlines_of_points_lines_and_plates() {
        assert_eq!(outline(&[[1.0, 1.0], [1.0, 1.0]], 1e-6), [0]);
        assert_eq!(outline(&[[0.0, 0.0], [-1.0, -1.0], [2.0, 2.0]], 1e-6), [1, 2]);
        // the last one lies inside
        assert_eq!(outline(&[[0.0, 0.0], [2.0, 0.0], [0.0, 2.0], [0.5, 0.5]], 1e-6), [0, 1, 2]);
        assert!(outline(&[], 1e-6).is_empty());
    }

    #[test]
    fn an_extent_is_finite_and_has_a_size() {
        let picture = |places: Vec<[f64; 2]>| Picture {
            times: vec![0.0],
            shapes: (0..places.len()).map(|at| Shape::Pin { at }).collect(),
            points: vec![places],
            ..Picture::default()
        };
        for places in [vec![], vec![[0.0; 2]; 3], vec![[1e3, -1e3]; 2], vec![[f64::NAN, 0.0]]] {
            let extent = picture(places).extent();
            let size = extent.size();
            assert!(size.iter().all(|side| *side > 0.0 && side.is_finite()), "{extent:?}");
        }
        let extent = picture(vec![[0.0, 0.0], [10.0, 0.0]]).extent();
        assert!(extent.low[0] < 0.0 && extent.high[0] > 10.0 && extent.low[1] < 0.0);
    }

    #[test]
    fn poses_differ_from_the_start_and_from_each_other() {
        let turn = |k: usize| vec![[(k as f64 * 0.1).cos(), (k as f64 * 0.1).sin()]];
        let picture = Picture {
            times: (0..100).map(|k| k as f64).collect(),
            points: (0..100).map(turn).collect(),
            shapes: vec![Shape::Pin { at: 0 }],
            ..Picture::default()
        };
        let poses = picture.poses(3);
        assert_eq!(poses.len(), 3);
        // three on a circle beside the start: the opposite one, then those between
        for &pose in &poses {
            assert!(distance(picture.place(pose, 0), [1.0, 0.0]) > 1.2, "{poses:?}");
        }
        let still = Picture { points: vec![vec![[1.0, 2.0]]; 5], ..picture };
        assert!(still.poses(3).is_empty());
    }
}
