//! Outlines of bodies, where they touch each other.

use mbs_symbolic::{Algebra, Expr, Scalar, Vector};

/// An outline about a place of a body, in the frame of the body.
#[derive(Clone)]
pub enum Outline<T = Expr> {
    /// A full circle; a point where the radius is 0.
    Circle { radius: T },
    /// A round hole.
    Bore { radius: T },
    /// A straight line through the place, the material on the right of its direction.
    Line { along: Vector<T> },
    /// Between two straight sides, so far on both sides of the place.
    Slot { along: Vector<T>, half: T },
    /// From the place to one that is so far away, with a round edge.
    Segment { way: Vector<T>, radius: T },
    /// A thin part of a circle, from half of its angle before the middle to half of it behind.
    Arc { radius: T, middle: T, half: T },
    /// Convex, from the place to corners that are so far from it, counter-clockwise, with a round edge.
    Polygon { ways: Vec<Vector<T>>, radius: T },
}

impl Outline {
    /// The same, to compute with.
    pub fn on<'a>(&self, algebra: &'a Algebra<'a>) -> Outline<Scalar<'a>> {
        let scalar = |x: Expr| algebra.scalar(x);
        match self {
            &Self::Circle { radius } => Outline::Circle { radius: scalar(radius) },
            &Self::Bore { radius } => Outline::Bore { radius: scalar(radius) },
            Self::Line { along } => Outline::Line { along: along.map(scalar) },
            Self::Slot { along, half } => Outline::Slot { along: along.map(scalar), half: scalar(*half) },
            &Self::Segment { way, radius } => {
                Outline::Segment { way: way.map(scalar), radius: scalar(radius) }
            }
            &Self::Arc { radius, middle, half } => {
                Outline::Arc { radius: scalar(radius), middle: scalar(middle), half: scalar(half) }
            }
            Self::Polygon { ways, radius } => Outline::Polygon {
                ways: ways.iter().map(|way| way.map(scalar)).collect(),
                radius: scalar(*radius),
            },
        }
    }
}
