//! The system of an implicit stage, for stiff forces.
//!
//! In a stage of a diagonally implicit scheme positions and velocities depend on the acceleration a
//! that is sought, with s the share of the step that the stage has of its own slope:
//!
//! ```text
//! v = v₀ + s a,  q = q₀ + s v,    M a + Φ_qᵀ λ = Q(q, v),  Φ_q a = γ
//! ```
//!
//! One step of Newton's method from a predicted acceleration p, with q and v those that p leads to,
//! is the same system with other masses and forces:
//!
//! ```text
//! (M + D) a + Φ_qᵀ λ = Q + D p,  Φ_q a = γ,    D = −s ∂Q/∂v − s² ∂Q/∂q
//! ```
//!
//! M, Φ_q and γ are taken where p leads to: what they change with a is of the order of s², and
//! has no stiffness. D is made symmetric, as the elimination is; forces between two bodies have a
//! symmetric D, and of others (a follower, a force on one body by the position of another) the
//! antisymmetric part is left out of Newton's matrix. Loads that depend on reactions are taken at
//! p, too.
//!
//! # How it is used
//!
//! The elimination of the accelerations solves this system too, in the order that was cheapest there.
//! `Implicit` is a function of its own. Rust code has it where forces depend on positions or velocities. C
//! does not print it. The derivatives of the constraints are left out of the matrix, since they are not
//! stiff.

use std::collections::BTreeMap;

use mbs_symbolic::{Expr, Kkt, Number, Unknown};

use crate::derive::Equations;
use crate::inputs::{Input, Inputs};
use crate::model::Model;
use crate::reduction::Reduction;

/// The terms that an implicit stage adds to the equations of motion.
pub struct Stiffness {
    /// D over pairs of coordinates, the first one not behind the second.
    entries: BTreeMap<(usize, usize), Expr>,
    /// Q + D p
    pub forces: Vec<Expr>,
}

impl Stiffness {
    /// That of a mechanism: without entries if no force depends on positions or velocities.
    pub fn new(model: &mut Model, equations: &Equations, inputs: &Inputs, reduction: &Reduction) -> Self {
        let entries = entries(model, equations, inputs);
        let predicted = reduction.predicted(model, inputs);
        let mut forces = equations.forces.clone();
        for (&(i, j), &entry) in &entries {
            let mut add = |to: usize, by: usize| {
                let product = model.arena.mul(entry, predicted[by]);
                forces[to] = model.arena.add(forces[to], product);
            };
            add(i, j);
            if i != j {
                add(j, i);
            }
        }
        Self { entries, forces }
    }

    /// True if the stage is that of an explicit scheme.
    pub fn is_none(&self) -> bool {
        self.entries.is_empty()
    }

    /// Adds D to the masses.
    pub fn add_to(&self, model: &mut Model, kkt: &mut Kkt) {
        for (&(i, j), &entry) in &self.entries {
            let [a, b] = [i, j].map(Unknown::Coordinate);
            let sum = match kkt.get(a, b) {
                Some(mass) => model.arena.add(mass, entry),
                None => entry,
            };
            let sum = model.arena.share(sum);
            kkt.set(&model.arena, a, b, sum);
        }
    }
}

/// The entries of D that are not 0.
fn entries(model: &mut Model, equations: &Equations, inputs: &Inputs) -> BTreeMap<(usize, usize), Expr> {
    let shift = model.arena.variable(inputs.shift);
    let square = model.arena.powi(shift, 2);
    let mut entries: BTreeMap<(usize, usize), Expr> = BTreeMap::new();
    for (i, &force) in equations.forces.iter().enumerate() {
        for symbol in model.arena.symbols_in(force) {
            let (j, factor) = match inputs.of(symbol) {
                Some(Input::Position(at)) => (at, square),
                Some(Input::Velocity(at)) => (at, shift),
                _ => continue,
            };
            let slope = model.arena.partial(force, symbol);
            let slope = model.arena.share(slope);
            let product = model.arena.mul(slope, factor);
            // the symmetric part has half of what stands on either side
            let share = if i == j { Number::MINUS_ONE } else { Number::ratio(-1, 2) };
            let product = model.arena.scale(product, share);
            let place = (i.min(j), i.max(j));
            let known = entries.get(&place).copied().unwrap_or(model.arena.zero());
            entries.insert(place, model.arena.add(known, product));
        }
    }
    entries.retain(|_, entry| !model.arena.is_zero(*entry));
    entries.values_mut().for_each(|entry| *entry = model.arena.share(*entry));
    entries
}
