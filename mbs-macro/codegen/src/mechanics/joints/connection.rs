//! A joint with its places and clauses, and what its formulas have in common.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Algebra, Expr, Scalar, Vector};

use crate::mechanics::Placed;

/// A joint with its places and clauses resolved; what plays no part in it has
/// the value that changes nothing.
#[derive(Clone, Copy)]
pub struct Connection<T = Expr> {
    pub first: Placed<T>,
    pub second: Placed<T>,
    /// A direction in the frame of the second body; (1, 0) without one.
    pub along: Vector<T>,
    /// Constant relative angle or displacement; 0 without one.
    pub at: T,
    /// Constant distance, or the polar radius of a cam; 0 without one.
    pub value: T,
    /// Radii, or 1 and the ratio of the second to the first.
    pub sizes: [T; 2],
    /// A length, or of no dimension where the sizes are a ratio.
    pub unit: Dimension,
    /// Angle of the body relative to which the others turn; 0 for the ground.
    pub carrier: T,
}

/// A joint to compute with.
pub type Joint<'a> = Connection<Scalar<'a>>;

/// A body that takes part in a joint.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Part {
    First,
    Second,
    Carrier,
}

/// A force or a torque on the second body; the first feels the opposite.
#[derive(Clone, Copy)]
pub enum Wrench<'a> {
    /// In the ground frame.
    Force(Vector<Scalar<'a>>),
    Torque(Scalar<'a>),
}

impl Connection {
    /// The same, to compute with.
    pub fn on<'a>(&self, algebra: &'a Algebra<'a>) -> Joint<'a> {
        let scalar = |expr| algebra.scalar(expr);
        Connection {
            first: self.first.on(algebra),
            second: self.second.on(algebra),
            along: self.along.map(scalar),
            at: scalar(self.at),
            value: scalar(self.value),
            sizes: self.sizes.map(scalar),
            unit: self.unit,
            carrier: scalar(self.carrier),
        }
    }

    /// The angle of a body.
    pub fn angle(&self, part: Part) -> Expr {
        match part {
            Part::First => self.first.angle,
            Part::Second => self.second.angle,
            Part::Carrier => self.carrier,
        }
    }
}

impl<'a> Joint<'a> {
    /// p₁ − p₂
    pub fn separation(&self) -> Vector<Scalar<'a>> {
        self.first.position - self.second.position
    }

    /// φ₁ − φ₂
    pub fn relative_angle(&self) -> Scalar<'a> {
        self.first.angle - self.second.angle
    }

    /// u·(p₁ − p₂): how far the first place is along the direction u.
    pub fn along_line(&self) -> Scalar<'a> {
        self.first.offset_along(self.second, self.along)
    }

    /// n·(p₁ − p₂): how far it is across, n = u turned by 90°.
    pub fn across_line(&self) -> Scalar<'a> {
        self.first.offset_along(self.second, self.along.perpendicular())
    }

    /// u in the ground frame, as a force of size 1.
    pub fn force_along_line(&self) -> Wrench<'a> {
        Wrench::Force(self.along.rotated(self.second.angle) / self.along.norm())
    }

    /// n in the ground frame, as a force of size 1.
    pub fn force_across_line(&self) -> Wrench<'a> {
        Wrench::Force(self.along.perpendicular().rotated(self.second.angle) / self.along.norm())
    }

    /// r₁(φ₁ − φ_c − at) and r₂(φ₂ − φ_c): how far two bodies turn relative to a third.
    pub fn turns(&self) -> [Scalar<'a>; 2] {
        let [r1, r2] = self.sizes;
        let (driving, driven) = (self.first.angle - self.carrier - self.at, self.second.angle - self.carrier);
        [r1 * driving, r2 * driven]
    }

    /// Its algebra.
    pub fn algebra(&self) -> &'a Algebra<'a> {
        self.at.algebra()
    }
}
