//! Equations of motion: bodies, forces and names are gone, only expressions
//! are left.

use std::collections::{BTreeMap, HashMap};

use mbs_symbolic::{Expr, Number, Symbol};

use crate::model::{Direction, Meaning, Model, energies};

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
pub fn derive(model: &mut Model) -> Equations {
    let mass = mass(model);
    let phi: Vec<Expr> = model.constraints.iter().map(|constraint| constraint.phi).collect();
    let phi_q = phi.iter().map(|&row| jacobian_row(model, row)).collect();
    let time = HashMap::from([(model.symbols.time, model.arena.one())]);
    let phi_t = phi.iter().map(|&row| model.arena.derivative(row, &time)).collect();

    let along_motion = motion_direction(model);
    let phi_dot: Vec<Expr> = phi.iter().map(|&row| model.arena.derivative(row, &along_motion)).collect();
    // Φ̈ = Φ_q q̈ − γ, and the direction holds velocities constant
    let gamma = phi_dot
        .iter()
        .map(|&row| {
            let second = model.arena.derivative(row, &along_motion);
            model.arena.neg(second)
        })
        .collect();
    let feedback = phi.iter().zip(&phi_dot).map(|(&phi, &phi_dot)| feedback(model, phi, phi_dot)).collect();
    let inertias = energies::inertias(&model.coordinates, &model.bodies, model.gravity);
    let kinetic_energy = energies::kinetic(&mut model.arena, &inertias);
    let potential_energy = energies::potential(&mut model.arena, &inertias, &model.potentials);
    let forces = forces(model);
    let total_forces = total_forces(model, &forces);
    Equations {
        mass,
        forces,
        total_forces,
        phi,
        phi_q,
        phi_t,
        phi_dot,
        gamma,
        feedback,
        kinetic_energy,
        potential_energy,
    }
}

/// Coordinates change at their velocities, t at 1, velocities not at all.
fn motion_direction(model: &mut Model) -> HashMap<Symbol, Expr> {
    let mut direction = HashMap::from([(model.symbols.time, model.arena.one())]);
    for coordinate in &model.coordinates {
        direction.insert(coordinate.position, model.arena.variable(coordinate.velocity));
    }
    direction
}

fn jacobian_row(model: &mut Model, row: Expr) -> BTreeMap<usize, Expr> {
    let mut entries = BTreeMap::new();
    for symbol in model.arena.symbols_in(row) {
        if let Meaning::Coordinate(at) = model.meanings[symbol.index()] {
            let entry = model.arena.partial(row, symbol);
            if !model.arena.is_zero(entry) {
                entries.insert(at, entry);
            }
        }
    }
    entries
}

fn feedback(model: &mut Model, phi: Expr, phi_dot: Expr) -> Expr {
    let (phi, phi_dot) = (model.arena.share(phi), model.arena.share(phi_dot));
    let minus_two_alpha = model.arena.variable(model.symbols.minus_two_alpha);
    let minus_beta_squared = model.arena.variable(model.symbols.minus_beta_squared);
    let damping = model.arena.mul(minus_two_alpha, phi_dot);
    let stiffness = model.arena.mul(minus_beta_squared, phi);
    model.arena.add(damping, stiffness)
}

fn mass(model: &Model) -> Vec<Expr> {
    let of = |coordinate: &crate::model::Coordinate| {
        let body = &model.bodies[coordinate.body];
        if coordinate.direction == Direction::Angle { body.inertia } else { body.mass }
    };
    model.coordinates.iter().map(of).collect()
}

fn forces(model: &mut Model) -> Vec<Expr> {
    let mut forces = Vec::new();
    for (at, coordinate) in model.coordinates.iter().enumerate() {
        let mut terms: Vec<_> = model
            .loads
            .iter()
            .filter(|load| load.coordinate == at)
            .map(|load| (load.value, Number::ONE))
            .collect();
        if let Some(gravity) = gravity_along(model, coordinate.direction) {
            let mass = model.bodies[coordinate.body].mass;
            terms.push((model.arena.mul(mass, gravity), Number::ONE));
        }
        forces.push(model.arena.sum(&terms));
    }
    forces
}

fn total_forces(model: &mut Model, forces: &[Expr]) -> Vec<Expr> {
    let mut total = forces.to_vec();
    for load in &model.reactive_loads {
        for &(coordinate, slope) in &load.along {
            let force = model.arena.mul(load.force, slope);
            total[coordinate] = model.arena.add(total[coordinate], force);
        }
    }
    total
}

fn gravity_along(model: &Model, direction: Direction) -> Option<Expr> {
    match direction {
        Direction::X => Some(model.gravity[0]),
        Direction::Y => Some(model.gravity[1]),
        Direction::Angle => None,
    }
}
