//! Masses of links: those that a file says, and thin bars where it says none.

use super::geometry::{Point, distance};

/// The mass of a link as a file says it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mass {
    /// In kg.
    pub mass: f64,
    /// About the centre, in kg times the square of the file's unit of length.
    pub inertia: f64,
    /// The centre of mass at the start.
    pub centre: Point,
}

impl Mass {
    /// That of two links which are one rigid part, by the parallel axis theorem.
    pub fn joined(self, other: Self) -> Self {
        let mass = self.mass + other.mass;
        let mean = |axis: usize| (self.mass * self.centre[axis] + other.mass * other.centre[axis]) / mass;
        let centre = [mean(0), mean(1)];
        let about = |part: Self| part.inertia + part.mass * distance(part.centre, centre).powi(2);
        Self { mass, inertia: about(self) + about(other), centre }
    }
}

/// Thin bars along the sides of the polygon through some places.
pub(super) struct Outline {
    pub centre: Point,
    pub length: f64,
    /// About the centre, per mass of a unit length.
    pub inertia: f64,
}

/// The outline of a link by its pins.
pub(super) fn outline(places: &[Point]) -> Outline {
    let count = if places.len() == 2 { 1 } else { places.len() };
    let sides = || (0..count).map(|at| (places[at], places[(at + 1) % places.len()]));
    let length: f64 = sides().map(|(a, b)| distance(a, b)).sum();
    if length == 0.0 {
        return Outline { centre: places.first().copied().unwrap_or_default(), length, inertia: 0.0 };
    }
    let middle = |a: Point, b: Point| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
    let mean = |axis: usize| sides().map(|(a, b)| distance(a, b) * middle(a, b)[axis]).sum::<f64>() / length;
    let centre = [mean(0), mean(1)];
    let about = |(a, b): (Point, Point)| {
        let (side, arm) = (distance(a, b), distance(middle(a, b), centre));
        side * (side * side / 12.0 + arm * arm)
    };
    Outline { centre, length, inertia: sides().map(about).sum() }
}
