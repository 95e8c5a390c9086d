//! Kinetic and potential energy.

use mbs_symbolic::{Algebra, Expr, Scalar, Symbol};

/// The mass that a coordinate moves, and gravity along it.
#[derive(Clone)]
pub struct Inertia {
    pub position: Symbol,
    pub velocity: Symbol,
    /// Mass, or moment of inertia of an angle.
    pub mass: Expr,
    /// Gravity along it; none along an angle.
    pub gravity: Option<Expr>,
    /// False of a state of the declaration's own, whose mass of 1 is none.
    pub has_energy: bool,
}

/// ½ vᵀMv
pub fn kinetic<'a>(algebra: &'a Algebra<'a>, inertias: &[Inertia]) -> Scalar<'a> {
    let energy = |inertia: &Inertia| {
        let velocity = algebra.variable(inertia.velocity);
        algebra.scalar(inertia.mass) * velocity.squared() / 2
    };
    algebra.sum(inertias.iter().filter(|inertia| inertia.has_energy).map(energy))
}

/// −Σ m g·x, and the energies of springs.
pub fn potential<'a>(algebra: &'a Algebra<'a>, inertias: &[Inertia], springs: &[Expr]) -> Scalar<'a> {
    let height = |inertia: &Inertia| {
        let [mass, gravity] = [inertia.mass, inertia.gravity?].map(|expr| algebra.scalar(expr));
        Some(-(mass * gravity * algebra.variable(inertia.position)))
    };
    let springs = springs.iter().map(|&energy| algebra.scalar(energy));
    algebra.sum(springs.chain(inertias.iter().filter_map(height)))
}
