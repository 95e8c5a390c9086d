//! The parts of a picture of a mechanism: bodies, their points, joints and springs.
//!
//! The places themselves are given by [`Mechanism::points`](crate::Mechanism::points);
//! here are names, and positions in that list.

/// A mechanism as a drawing of lines between points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sketch {
    /// The name of every point: `crank` for the centre of a body, `crank.tip`
    /// for a point of it.
    pub points: &'static [&'static str],
    /// The bodies, in the order of declaration, and behind them the points of the ground that move with
    /// coordinates, each as a body of one point.
    pub bodies: &'static [Body],
    /// The points of the ground that stand still: the origin, then those that were declared.
    pub ground: &'static [usize],
    /// The points at which particles are, in the order of declaration.
    pub particles: &'static [usize],
    /// The joints: first what holds bodies that lack coordinates (one that has
    /// x alone is `prismatic` on the x axis) under the bodies' names, then those
    /// that were declared, in order.
    pub joints: &'static [Joint],
    /// The springs, in the order of declaration.
    pub springs: &'static [Spring],
}

/// A body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Body {
    /// Its name.
    pub name: &'static str,
    /// Its centre of mass, then its points in the order of declaration.
    pub points: &'static [usize],
    /// False if the place of one of its points on it depends on coordinates.
    pub is_rigid: bool,
}

/// A joint between two places.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Joint {
    /// Its name.
    pub name: &'static str,
    /// The word that declares such a joint, such as `revolute`. There may be
    /// more kinds than a program knows.
    pub kind: &'static str,
    /// The point on the first body.
    pub first: usize,
    /// The point on the second body.
    pub second: usize,
    /// A point somewhere ahead of the second one in the direction of the
    /// joint's line, if it has one.
    pub ahead: Option<usize>,
}

/// A spring between two places.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spring {
    /// Its name.
    pub name: &'static str,
    /// The word that declares such a spring, such as `spring` or
    /// `torsion_spring`. There may be more kinds than a program knows.
    pub kind: &'static str,
    /// The point on the first body.
    pub first: usize,
    /// The point on the second body.
    pub second: usize,
}
