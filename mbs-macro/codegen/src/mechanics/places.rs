//! Places on bodies, in the ground frame.

use mbs_symbolic::{Algebra, Expr, Scalar, Vector};

/// A place on a body, in the ground frame.
#[derive(Clone, Copy)]
pub struct Placed<T = Expr> {
    pub position: Vector<T>,
    /// Angle of the body.
    pub angle: T,
}

impl Placed {
    /// The same, to compute with.
    pub fn on<'a>(&self, algebra: &'a Algebra<'a>) -> Placed<Scalar<'a>> {
        Placed { position: self.position.map(|x| algebra.scalar(x)), angle: algebra.scalar(self.angle) }
    }
}

impl<'a> Placed<Scalar<'a>> {
    /// Where a point of this body is: p + R(φ)·local.
    pub fn point(self, local: Vector<Scalar<'a>>) -> Self {
        Self { position: self.position + local.rotated(self.angle), ..self }
    }

    /// How far another place is.
    pub fn distance_to(self, other: Self) -> Scalar<'a> {
        (self.position - other.position).norm()
    }

    /// How far it is from another place, along a direction of the other's body.
    pub fn offset_along(self, other: Self, direction: Vector<Scalar<'a>>) -> Scalar<'a> {
        let turned = direction.rotated(other.angle);
        turned.dot(self.position - other.position) / direction.norm()
    }

    /// The direction to another place, as an angle in the frame of this one.
    pub fn polar_angle_of(self, other: Self) -> Scalar<'a> {
        let to = other.position - self.position;
        to.y.atan2(to.x) - self.angle
    }

    /// The same, of nobody's algebra.
    pub fn exprs(self) -> Placed {
        Placed { position: self.position.exprs().into(), angle: self.angle.expr() }
    }
}
