//! Kinetic and potential energy.

use mbs_symbolic::{Algebra, Expr, Scalar, Symbol};

use super::{Cluster, Motion, Particle};

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

/// The parts of the energies of a mechanism.
#[derive(Clone, Copy)]
pub struct Energies<'m> {
    pub inertias: &'m [Inertia],
    pub particles: &'m [Particle],
    pub gravity: [Expr; 2],
    /// Energies of springs.
    pub springs: &'m [Expr],
}

impl Energies<'_> {
    /// ½ vᵀMv
    pub fn kinetic<'a>(&self, algebra: &'a Algebra<'a>, motion: &Motion) -> Scalar<'a> {
        let energy = |inertia: &Inertia| {
            let velocity = algebra.variable(inertia.velocity);
            algebra.scalar(inertia.mass) * velocity.squared() / 2
        };
        let bodies = self.inertias.iter().filter(|inertia| inertia.has_energy).map(energy);
        let clusters = Cluster::all(algebra, motion, self.particles);
        algebra.sum(bodies.chain(clusters.iter().map(Cluster::kinetic)))
    }

    /// −Σ m g·s, and the energies of springs.
    pub fn potential<'a>(&self, algebra: &'a Algebra<'a>, motion: &Motion) -> Scalar<'a> {
        let height = |inertia: &Inertia| {
            let [mass, gravity] = [inertia.mass, inertia.gravity?].map(|expr| algebra.scalar(expr));
            Some(-(mass * gravity * algebra.variable(inertia.position)))
        };
        let springs = self.springs.iter().map(|&energy| algebra.scalar(energy));
        let clusters = Cluster::all(algebra, motion, self.particles);
        let weights = clusters.iter().map(|cluster| cluster.potential(self.gravity));
        algebra.sum(springs.chain(self.inertias.iter().filter_map(height)).chain(weights))
    }
}
