//! Kinetic and potential energy.

use mbs_symbolic::{Arena, Expr, Number, Symbol};

use super::{Body, Coordinate, Direction};

/// What a coordinate moves.
pub struct Inertia {
    pub position: Symbol,
    pub velocity: Symbol,
    /// Mass, or moment of inertia of an angle.
    pub mass: Expr,
    /// Gravity along it; none along an angle.
    pub gravity: Option<Expr>,
}

/// The inertias along all coordinates.
pub fn inertias(coordinates: &[Coordinate], bodies: &[Body], gravity: [Expr; 2]) -> Vec<Inertia> {
    let inertia = |coordinate: &Coordinate| {
        let body = &bodies[coordinate.body];
        let (mass, gravity) = match coordinate.direction {
            Direction::X => (body.mass, Some(gravity[0])),
            Direction::Y => (body.mass, Some(gravity[1])),
            Direction::Angle => (body.inertia, None),
        };
        Inertia { position: coordinate.position, velocity: coordinate.velocity, mass, gravity }
    };
    coordinates.iter().map(inertia).collect()
}

/// ½ vᵀMv
pub fn kinetic(arena: &mut Arena, inertias: &[Inertia]) -> Expr {
    let mut terms = Vec::new();
    for inertia in inertias {
        let velocity = arena.variable(inertia.velocity);
        terms.push((arena.product(&[(inertia.mass, 1), (velocity, 2)]), Number::ratio(1, 2)));
    }
    arena.sum(&terms)
}

/// −Σ m g·x, and the energies of springs.
pub fn potential(arena: &mut Arena, inertias: &[Inertia], springs: &[Expr]) -> Expr {
    let mut terms: Vec<_> = springs.iter().map(|&energy| (energy, Number::ONE)).collect();
    for inertia in inertias {
        let Some(gravity) = inertia.gravity else { continue };
        let position = arena.variable(inertia.position);
        let energy = arena.product(&[(inertia.mass, 1), (gravity, 1), (position, 1)]);
        terms.push((energy, Number::MINUS_ONE));
    }
    arena.sum(&terms)
}
