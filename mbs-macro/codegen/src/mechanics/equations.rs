//! Equations of motion: bodies, forces and names are gone, only expressions
//! are left.

use std::collections::BTreeMap;

use mbs_symbolic::{Algebra, Arena, Expr, Number, Scalar, Symbol};
use rustc_hash::FxHashMap as HashMap;

use super::{Cluster, Inertia, Load, Motion, Particle, Work, energies};

/// The inertias, constraints and loads of a mechanism.
pub struct Mechanism<'m> {
    /// Of every coordinate.
    pub inertias: &'m [Inertia],
    pub particles: &'m [Particle],
    pub gravity: [Expr; 2],
    /// Φ, and Φ̇ where that is no derivative of it.
    pub rows: Vec<(Expr, Option<Expr>)>,
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
    /// The diagonal of M.
    pub mass: Vec<Expr>,
    /// The other entries of M over pairs of coordinates, the first one before the second. Bodies have none, since
    /// every body is described by its own coordinates.
    pub couplings: BTreeMap<(usize, usize), Expr>,
    /// Q without the loads that depend on multipliers.
    pub forces: Vec<Expr>,
    /// Q
    pub total_forces: Vec<Expr>,
    /// Q without what particles add: weights of bodies, and the forces of the declaration.
    pub applied_forces: Vec<Expr>,
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
    /// −2αΦ̇ − β²Φ, and −αΦ̇ of an equation between rates
    pub feedback: Vec<Expr>,
    /// ½ vᵀMv
    pub kinetic_energy: Expr,
    /// −Σ m g·s, and the energies of springs
    pub potential_energy: Expr,
}

/// Derives the equations. Cannot fail.
pub fn derive(arena: &mut Arena, mechanism: &Mechanism<'_>) -> Equations {
    let algebra = &Algebra::new(arena);
    let inertias = mechanism.inertias;
    let along_motion = along_motion(algebra, mechanism);
    let rows = mechanism.rows.iter().map(|&(phi, rate)| match rate {
        Some(rate) => Row::of_rates(algebra, mechanism, algebra.scalar(rate)),
        None => Row::of_positions(mechanism, algebra.scalar(phi), &along_motion),
    });
    let rows: Vec<Row<'_>> = rows.collect();
    let phi_q = rows.iter().map(|row| row.phi_q.clone()).collect();
    let phi: Vec<_> = rows.iter().map(|row| row.phi).collect();
    let phi_t: Vec<_> = rows.iter().map(|row| row.phi_t).collect();
    let phi_dot: Vec<_> = rows.iter().map(|row| row.phi_dot).collect();
    // Φ̈ = Φ_q q̈ − γ, and the direction holds velocities constant
    let gamma: Vec<_> = phi_dot.iter().map(|&rate| -rate.derivative(&along_motion)).collect();
    let feedback: Vec<_> = rows.iter().map(|row| row.feedback(mechanism)).collect();
    let stored = energies::Energies {
        inertias,
        particles: mechanism.particles,
        gravity: mechanism.gravity,
        springs: mechanism.potentials,
    };
    let kinetic_energy = stored.kinetic(algebra, mechanism.motion).expr();
    let potential_energy = stored.potential(algebra, mechanism.motion).expr();
    let mut mass: Vec<_> = inertias.iter().map(|inertia| algebra.scalar(inertia.mass)).collect();
    let mut couplings: BTreeMap<(usize, usize), Scalar<'_>> = BTreeMap::new();
    let mut forces = forces(algebra, mechanism);
    let applied_forces = exprs(&total_forces(algebra, mechanism, &forces));
    for cluster in Cluster::all(algebra, mechanism.motion, mechanism.particles) {
        let inertial = cluster.inertial(mechanism.gravity);
        for ((i, j), entry) in inertial.masses {
            let sum =
                if i == j { &mut mass[i] } else { couplings.entry((i, j)).or_insert(algebra.number(0)) };
            *sum = *sum + entry;
        }
        for (at, force) in inertial.forces {
            forces[at] = forces[at] + force;
        }
    }
    couplings.retain(|_, entry| !entry.is_zero());
    let total_forces = total_forces(algebra, mechanism, &forces);
    Equations {
        mass: exprs(&mass),
        couplings: couplings.into_iter().map(|(pair, entry)| (pair, entry.shared().expr())).collect(),
        forces: exprs(&forces),
        total_forces: exprs(&total_forces),
        applied_forces,
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

/// A constraint and its derivatives.
struct Row<'a> {
    phi: Scalar<'a>,
    phi_q: BTreeMap<usize, Expr>,
    phi_t: Scalar<'a>,
    phi_dot: Scalar<'a>,
    is_of_rates: bool,
}

impl<'a> Row<'a> {
    fn of_positions(
        mechanism: &Mechanism<'_>,
        phi: Scalar<'a>,
        along_motion: &HashMap<Symbol, Expr>,
    ) -> Self {
        let phi_q = mechanism.motion.slopes(phi).into_iter().collect();
        let (phi_t, phi_dot) = (phi.partial(mechanism.time), phi.derivative(along_motion));
        Self { phi, phi_q, phi_t, phi_dot, is_of_rates: false }
    }

    /// Of A v + b = 0: A has the place of Φ_q, and b that of Φ_t.
    fn of_rates(algebra: &'a Algebra<'a>, mechanism: &Mechanism<'_>, rate: Scalar<'a>) -> Self {
        let motion = mechanism.motion;
        let phi_q = motion.slopes_of_rate(rate).into_iter().collect();
        let phi = algebra.number(0);
        Self { phi, phi_q, phi_t: motion.at_standstill(rate), phi_dot: rate, is_of_rates: true }
    }

    /// −2αΦ̇ − β²Φ, which decays with the double rate α where β = α. Of an equation between rates −αΦ̇, which decays
    /// with the rate α: gains with which a method is stable for the others are stable for it.
    fn feedback(&self, mechanism: &Mechanism<'_>) -> Scalar<'a> {
        let algebra = self.phi.algebra();
        let gains = [mechanism.minus_two_alpha, mechanism.minus_beta_squared];
        let [minus_two_alpha, minus_beta_squared] = gains.map(|symbol| algebra.variable(symbol));
        let (phi, phi_dot) = (self.phi.shared(), self.phi_dot.shared());
        match self.is_of_rates {
            true => algebra.number(Number::ratio(1, 2)) * minus_two_alpha * phi_dot,
            false => minus_two_alpha * phi_dot + minus_beta_squared * phi,
        }
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
