//! Equations of motion: bodies, forces and names are gone, only expressions
//! are left.

use crate::inputs::Inputs;
pub use crate::mechanics::Equations;
use crate::mechanics::{Mechanism, derive as derived};
use crate::model::Model;

/// Derives the equations. Cannot fail.
pub fn derive(model: &mut Model, inputs: &Inputs) -> Equations {
    let mechanism = Mechanism {
        inertias: &model.inertias,
        particles: &model.particles,
        gravity: model.gravity,
        rows: model.constraints.iter().map(|constraint| (constraint.phi, constraint.rate)).collect(),
        loads: &model.loads,
        reactive_loads: model.reactive_loads.iter().map(|load| &load.work).collect(),
        potentials: &model.potentials,
        motion: &model.motion,
        time: inputs.time,
        minus_two_alpha: inputs.minus_two_alpha,
        minus_beta_squared: inputs.minus_beta_squared,
    };
    derived(&mut model.arena, &mechanism)
}
