//! Equations of motion: bodies, forces and names are gone, only expressions
//! are left.

use std::collections::BTreeMap;

use mbs_symbolic::{Algebra, Arena, Expr, Scalar, Symbol};
use rustc_hash::FxHashMap as HashMap;

use super::{Inertia, Load, Motion, Work, energies};

/// The inertias, constraints and loads of a mechanism.
pub struct Mechanism<'m> {
    /// Of every coordinate.
    pub inertias: &'m [Inertia],
    /// Φ
    pub phi: Vec<Expr>,
    pub loads: &'m [Load],
    /// Forces that depend on multipliers.
    pub reactive_loads: Vec<&'m Work>,
    /// Energies of springs.
    pub potentials: &'m [Expr],
    pub motion: &'m Motion,
    pub time: Symbol,
    pub minus_two_alpha: Symbol,
    pub minus_beta_squared: Symbol,
}

/// The equations of a mechanism; see design symbols in the crate docs.
pub struct Equations {
    /// M, diagonal: every body is described by its own coordinates.
    pub mass: Vec<Expr>,
    /// Q without the loads that depend on multipliers.
    pub forces: Vec<Expr>,
    /// Q
    pub total_forces: Vec<Expr>,
    /// Φ
    pub phi: Vec<Expr>,
    /// Φ_q, row by row, entries that are 0 left out.
    pub phi_q: Vec<BTreeMap<usize, Expr>>,
    /// Φ_t
    pub phi_t: Vec<Expr>,
    /// Φ̇ = Φ_q v + Φ_t
    pub phi_dot: Vec<Expr>,
    /// γ = −(Φ_q v)_q v − 2Φ_qt v − Φ_tt
    pub gamma: Vec<Expr>,
    /// −2αΦ̇ − β²Φ
    pub feedback: Vec<Expr>,
    /// ½ vᵀMv
    pub kinetic_energy: Expr,
    /// −Σ m g·x, and the energies of springs
    pub potential_energy: Expr,
}

/// Derives the equations. Cannot fail.
pub fn derive(arena: &mut Arena, mechanism: &Mechanism<'_>) -> Equations {
    let algebra = &Algebra::new(arena);
    let &Mechanism { inertias, motion, .. } = mechanism;
    let phi: Vec<_> = mechanism.phi.iter().map(|&row| algebra.scalar(row)).collect();
    let phi_q = phi.iter().map(|&row| motion.slopes(row).into_iter().collect()).collect();
    let phi_t: Vec<_> = phi.iter().map(|&row| row.partial(mechanism.time)).collect();
    let along_motion = along_motion(algebra, mechanism);
    let phi_dot: Vec<_> = phi.iter().map(|&row| row.derivative(&along_motion)).collect();
    // Φ̈ = Φ_q q̈ − γ, and the direction holds velocities constant
    let gamma: Vec<_> = phi_dot.iter().map(|&rate| -rate.derivative(&along_motion)).collect();
    let feedback: Vec<_> =
        phi.iter().zip(&phi_dot).map(|(&phi, &rate)| feedback(mechanism, phi, rate)).collect();
    let kinetic_energy = energies::kinetic(algebra, inertias).expr();
    let potential_energy = energies::potential(algebra, inertias, mechanism.potentials).expr();
    let forces = forces(algebra, mechanism);
    let total_forces = total_forces(algebra, mechanism, &forces);
    Equations {
        mass: inertias.iter().map(|inertia| inertia.mass).collect(),
        forces: exprs(&forces),
        total_forces: exprs(&total_forces),
        phi: exprs(&phi),
        phi_q,
        phi_t: exprs(&phi_t),
        phi_dot: exprs(&phi_dot),
        gamma: exprs(&gamma),
        feedback: exprs(&feedback),
        kinetic_energy,
        potential_energy,
    }
}

fn exprs(scalars: &[Scalar<'_>]) -> Vec<Expr> {
    scalars.iter().map(|scalar| scalar.expr()).collect()
}

/// Coordinates change at their velocities, t at 1, velocities not at all.
fn along_motion<'a>(algebra: &'a Algebra<'a>, mechanism: &Mechanism<'_>) -> HashMap<Symbol, Expr> {
    let time = (mechanism.time, algebra.number(1).expr());
    let velocity = |inertia: &Inertia| (inertia.position, algebra.variable(inertia.velocity).expr());
    [time].into_iter().chain(mechanism.inertias.iter().map(velocity)).collect()
}

/// −2αΦ̇ − β²Φ
fn feedback<'a>(mechanism: &Mechanism<'_>, phi: Scalar<'a>, phi_dot: Scalar<'a>) -> Scalar<'a> {
    let algebra = phi.algebra();
    let (phi, phi_dot) = (phi.shared(), phi_dot.shared());
    let gains = [mechanism.minus_two_alpha, mechanism.minus_beta_squared];
    let [minus_two_alpha, minus_beta_squared] = gains.map(|symbol| algebra.variable(symbol));
    minus_two_alpha * phi_dot + minus_beta_squared * phi
}

/// Loads and weights along every coordinate.
fn forces<'a>(algebra: &'a Algebra<'a>, mechanism: &Mechanism<'_>) -> Vec<Scalar<'a>> {
    let along = |(at, inertia): (usize, &Inertia)| {
        let loads = mechanism.loads.iter().filter(|load| load.coordinate == at);
        let loads = loads.map(|load| algebra.scalar(load.value));
        let weight = inertia.gravity.map(|gravity| algebra.scalar(inertia.mass) * algebra.scalar(gravity));
        algebra.sum(loads.chain(weight))
    };
    mechanism.inertias.iter().enumerate().map(along).collect()
}

fn total_forces<'a>(
    algebra: &'a Algebra<'a>,
    mechanism: &Mechanism<'_>,
    forces: &[Scalar<'a>],
) -> Vec<Scalar<'a>> {
    let mut total = forces.to_vec();
    for load in &mechanism.reactive_loads {
        for &(coordinate, slope) in &load.along {
            let force = algebra.scalar(load.force) * algebra.scalar(slope);
            total[coordinate] = total[coordinate] + force;
        }
    }
    total
}
