//! The places at which outlines are nearest: circles about points of one outline touch the other one.

use mbs_symbolic::{Number, Scalar, Vector};

use super::Element;
use crate::mechanics::{Outline, Placed};

/// Below this length a distance has no direction.
const NOWHERE: f64 = 1e-15;

/// A circle and what it touches.
pub struct Pair<'a> {
    pub circle: Placed<Scalar<'a>>,
    pub radius: Scalar<'a>,
    pub other: Placed<Scalar<'a>>,
    pub outline: Outline<Scalar<'a>>,
}

/// The place at which a circle is nearest to an outline.
pub struct Nearest<'a> {
    /// n, from the other outline to the circle.
    pub normal: Vector<Scalar<'a>>,
    pub distance: Scalar<'a>,
    /// From the place of the other outline to the centre of the circle, along n and along t, which is n turned to the right.
    pub arm: [Scalar<'a>; 2],
}

/// The circles of a contact with what they touch: a circle with the other outline, or each corner of both with the other one.
pub fn pairs<'a>(contact: &Element<'a>) -> Vec<Pair<'a>> {
    let (first, second) = (contact.first, contact.second);
    let pair = |circle, radius, other, outline: &Outline<_>| Pair {
        circle,
        radius,
        other,
        outline: outline.clone(),
    };
    if let Some(clearance) = contact.get("clearance") {
        return with_play(contact, clearance);
    }
    let [of_first, of_second] = &contact.outlines;
    match (of_first, of_second) {
        (&Outline::Circle { radius }, outline) => vec![pair(first, radius, second, outline)],
        (outline, &Outline::Circle { radius }) => vec![pair(second, radius, first, outline)],
        (Outline::Arc { .. }, _) | (_, Outline::Arc { .. }) => Vec::new(),
        _ => {
            let corners = |at: Placed<Scalar<'a>>, of: &Outline<Scalar<'a>>, other, outline| {
                let (corners, radius) = corners(of, contact);
                corners.into_iter().map(move |corner| pair(at.point(corner), radius, other, outline))
            };
            let first_on_second = corners(first, of_first, second, of_second);
            first_on_second.chain(corners(second, of_second, first, of_first)).collect()
        }
    }
}

/// Those of a joint with play: the pin in its bore, or the corners of a block in its guide.
fn with_play<'a>(joint: &Element<'a>, clearance: Scalar<'a>) -> Vec<Pair<'a>> {
    let (circle, other) = (joint.first, joint.second);
    let [radius, length, height] = ["radius", "length", "height"].map(|size| joint.get(size));
    if let Some(radius) = radius {
        return vec![Pair { circle, radius, other, outline: Outline::Bore { radius: radius + clearance } }];
    }
    let (Some(length), Some(height)) = (length, height) else { return Vec::new() };
    let outline = Outline::Slot { along: joint.along, half: height / 2 + clearance };
    let ahead = joint.along / joint.along.norm();
    let (fore, above) = (length / 2 * ahead, height / 2 * ahead.perpendicular());
    let corners = [-fore - above, fore - above, fore + above, -fore + above];
    let radius = joint.algebra.number(0);
    corners
        .map(|corner| Pair { circle: circle.point(corner), radius, other, outline: outline.clone() })
        .into()
}

/// The corners of an outline that has some, from its place, and the radius about them.
fn corners<'a>(
    outline: &Outline<Scalar<'a>>,
    contact: &Element<'a>,
) -> (Vec<Vector<Scalar<'a>>>, Scalar<'a>) {
    let zero = contact.algebra.number(0);
    let place = Vector { x: zero, y: zero };
    match outline {
        Outline::Segment { way, radius } => (vec![place, *way], *radius),
        Outline::Polygon { ways, radius } => {
            ([place].into_iter().chain(ways.iter().copied()).collect(), *radius)
        }
        Outline::Circle { .. }
        | Outline::Bore { .. }
        | Outline::Line { .. }
        | Outline::Slot { .. }
        | Outline::Arc { .. } => (Vec::new(), zero),
    }
}

impl<'a> Pair<'a> {
    /// True of a point and sharp edges. A corner near the end of an edge would be pushed aside, by the side that is nearer there.
    pub fn is_sharp(&self) -> bool {
        let edge = match self.outline {
            Outline::Segment { radius, .. } | Outline::Polygon { radius, .. } => radius,
            _ => return false,
        };
        self.radius.is_zero() && edge.is_zero()
    }

    /// True if neither of them has a thickness: they touch nowhere.
    pub fn is_thin(&self) -> bool {
        let edge = match self.outline {
            Outline::Circle { radius } | Outline::Segment { radius, .. } => radius,
            Outline::Arc { .. } => self.radius.algebra().number(0),
            Outline::Bore { .. } | Outline::Line { .. } | Outline::Slot { .. } | Outline::Polygon { .. } => {
                return false;
            }
        };
        self.radius.is_zero() && edge.is_zero()
    }

    /// True if one of them is a point.
    pub fn is_pointed(&self) -> bool {
        self.radius.is_zero() || matches!(self.outline, Outline::Circle { radius } if radius.is_zero())
    }

    pub fn nearest(&self) -> Nearest<'a> {
        let d = self.circle.position - self.other.position;
        let zero = self.radius.algebra().number(0);
        match &self.outline {
            &Outline::Circle { radius } => {
                let (normal, length) = away(d);
                Nearest { normal, distance: length - self.radius - radius, arm: [length, zero] }
            }
            &Outline::Bore { radius } => {
                let (direction, length) = away(d);
                let distance = radius - self.radius - length;
                Nearest { normal: -direction, distance, arm: [-length, zero] }
            }
            Outline::Line { along } => {
                let along = (along.rotated(self.other.angle) / along.norm()).map(Scalar::shared);
                let normal = along.perpendicular();
                let height = normal.dot(d).shared();
                Nearest { normal, distance: height - self.radius, arm: [height, along.dot(d)] }
            }
            Outline::Slot { along, half } => {
                let along = (along.rotated(self.other.angle) / along.norm()).map(Scalar::shared);
                let height = along.perpendicular().dot(d).shared();
                let side = (2 * height.chooses(zero) - 1).shared();
                let normal = (-side * along.perpendicular()).map(Scalar::shared);
                let arm = [-side * height, -normal.perpendicular().dot(d)];
                Nearest { normal, distance: *half - side * height - self.radius, arm }
            }
            &Outline::Segment { way, radius } => {
                let length = way.norm();
                let along = (way.rotated(self.other.angle) / length).map(Scalar::shared);
                let foot = along.dot(d).max(zero).min(length).shared();
                self.beyond(d, foot * along, radius)
            }
            &Outline::Arc { radius, middle, half } => {
                let ahead =
                    Vector { x: middle.cos(), y: middle.sin() }.rotated(self.other.angle).map(Scalar::shared);
                let (_, length) = away(d);
                let (along, across) = (ahead.dot(d).shared(), ahead.perpendicular().dot(d).shared());
                // at an end where the direction is outside of the arc
                let is_outside = (length * half.cos()).chooses(along).shared();
                let side = 1 - 2 * zero.chooses(across);
                let cosine = chosen(is_outside, half.cos(), along / length);
                let sine = chosen(is_outside, side * half.sin(), across / length);
                self.beyond(d, radius * (cosine * ahead + sine * ahead.perpendicular()), zero)
            }
            Outline::Polygon { ways, radius } => self.nearest_of_polygon(d, ways, *radius),
        }
    }

    /// From the nearest place of a thin outline, which has a round edge.
    fn beyond(&self, d: Vector<Scalar<'a>>, foot: Vector<Scalar<'a>>, edge: Scalar<'a>) -> Nearest<'a> {
        let (normal, height) = away(d - foot);
        let arm = [normal.dot(d), -normal.perpendicular().dot(d)];
        Nearest { normal, distance: height - self.radius - edge, arm }
    }

    /// The edge that the circle is farthest beyond is the nearest one. Outside of its ends, its corner is nearest.
    fn nearest_of_polygon(
        &self,
        d: Vector<Scalar<'a>>,
        ways: &[Vector<Scalar<'a>>],
        round: Scalar<'a>,
    ) -> Nearest<'a> {
        let zero = self.radius.algebra().number(0);
        let place = Vector { x: zero, y: zero };
        let local = d.rotated(-self.other.angle).map(Scalar::shared);
        let from = [place].into_iter().chain(ways.iter().copied());
        let to = ways.iter().copied().chain([place]);
        let edges = from.zip(to).map(|(from, to)| Edge::beyond(local, from, to));
        let edge = edges.reduce(Edge::farther).unwrap_or(Edge::beyond(local, place, place));
        let turned = |v: Vector<Scalar<'a>>| v.rotated(self.other.angle);
        let along = turned(edge.along).map(Scalar::shared);
        let is_point = self.radius.is_zero() && round.is_zero();
        let (normal, height) = if is_point {
            // it touches nothing outside
            (-along.perpendicular(), edge.height)
        } else {
            let is_outside = edge.height.chooses(zero).shared();
            let aside = is_outside.gate(edge.at - edge.at.max(edge.ends[0]).min(edge.ends[1])).shared();
            let (direction, length) = away(Vector { x: aside, y: edge.height });
            let side = 2 * is_outside - 1;
            let normal = direction.x * along - direction.y * side * along.perpendicular();
            (normal, side * length)
        };
        let normal = normal.map(Scalar::shared);
        let arm = [normal.dot(d), -normal.perpendicular().dot(d)];
        Nearest { normal, distance: height - self.radius - round, arm }
    }

    /// 1/R, the sum of the curvatures; a point has none, and what is straight adds none.
    pub fn curvature(&self) -> Scalar<'a> {
        let of = |radius: Scalar<'a>| self.radius.algebra().number(1) / radius;
        match self.outline {
            Outline::Circle { radius } => of(self.radius) + of(radius),
            Outline::Bore { radius } => of(self.radius) - of(radius),
            Outline::Arc { radius, .. } => {
                let d = self.circle.position - self.other.position;
                // it touches from within, or from outside
                of(self.radius) + of(radius) * (2 * away(d).1.chooses(radius) - 1)
            }
            Outline::Line { .. }
            | Outline::Slot { .. }
            | Outline::Segment { .. }
            | Outline::Polygon { .. } => of(self.radius),
        }
    }
}

/// An edge of a polygon, as a place sees it.
#[derive(Clone, Copy)]
struct Edge<'a> {
    /// Its direction; the inside is on the left.
    along: Vector<Scalar<'a>>,
    /// The distance of the place beyond it, and along it.
    height: Scalar<'a>,
    at: Scalar<'a>,
    /// Along it, where it begins and ends.
    ends: [Scalar<'a>; 2],
}

impl<'a> Edge<'a> {
    fn beyond(place: Vector<Scalar<'a>>, from: Vector<Scalar<'a>>, to: Vector<Scalar<'a>>) -> Self {
        let way = to - from;
        let along = way / way.norm();
        let height = (-along.perpendicular().dot(place - from)).shared();
        Self { along, height, at: along.dot(place), ends: [from, to].map(|end| along.dot(end)) }
    }

    /// The edge that the place is farther beyond. Where both are equal, their common corner is nearest.
    fn farther(self, other: Self) -> Self {
        let is_other = other.height.chooses(self.height).shared();
        let chosen = |one, other| chosen(is_other, other, one).shared();
        let [x, y] =
            [(self.along.x, other.along.x), (self.along.y, other.along.y)].map(|(a, b)| chosen(a, b));
        Self {
            along: Vector { x, y },
            height: chosen(self.height, other.height),
            at: chosen(self.at, other.at),
            ends: [chosen(self.ends[0], other.ends[0]), chosen(self.ends[1], other.ends[1])],
        }
    }
}

/// The one where a condition, 0 or 1, holds, and the other one elsewhere.
fn chosen<'a>(holds: Scalar<'a>, one: Scalar<'a>, other: Scalar<'a>) -> Scalar<'a> {
    holds.gate(one) + (1 - holds).gate(other)
}

/// The direction of a difference, 0 where it has no length, and its length.
fn away<'a>(d: Vector<Scalar<'a>>) -> (Vector<Scalar<'a>>, Scalar<'a>) {
    let nowhere = d.x.algebra().number(Number::float(NOWHERE * NOWHERE));
    let length = d.dot(d).max(nowhere).sqrt().shared();
    ((d / length).map(Scalar::shared), length)
}
