//! The margins of what holds: forces at stops, and what is left of frictions that stick until they break loose.

use super::dynamics::Dynamics;
use crate::contact::{Each, MOST_CONTACTS, has};
use crate::equations::At;
use crate::pressing::{held, pressed};
use crate::sticking::{Limits, frictions};
use crate::{Real, rubbing, vectors};

/// The forces at stops that are rested on, and by how much those of frictions that stick are below what they can be.
pub(super) fn margins<D: Dynamics>(
    dynamics: &D,
    at: At<'_, D::Real>,
    inputs: &[D::Real],
    a: &mut D::Coordinates,
) -> Each<D::Real> {
    let (equations, mut lambda) = (dynamics.equations(), dynamics.no_feedback());
    if held(equations, inputs) == 0 {
        vectors::fill(a.as_mut(), D::Real::default());
        return [D::Real::default(); MOST_CONTACTS];
    }
    equations.free_reactions(at, inputs, a.as_mut(), lambda.as_mut());
    let (_, mut forces) = pressed(equations, at, inputs, a.as_mut(), Some(lambda.as_mut()));
    let limits = Limits::of(equations, at, inputs, ([a.as_ref(), lambda.as_ref()], &forces));
    for (row, _) in frictions(equations.info()) {
        if let Some(force) = forces.get_mut(row) {
            *force = limits.sticking(row) - force.abs();
        }
    }
    forces
}

/// True of friction that slides and has no force, or whose stop is open: its direction does not matter.
pub(super) fn is_idle<D: Dynamics>(
    dynamics: &D,
    at: At<'_, D::Real>,
    inputs: &[D::Real],
    row: usize,
) -> bool {
    let (mut a, mut lambda) = (dynamics.declared_start().1, dynamics.no_feedback());
    let equations = dynamics.equations();
    if has(rubbing::all_rubbing(equations.info()), row) {
        let rests = has(rubbing::borne(equations.info(), held(equations, inputs)), row);
        return !rests || rubbing::sizes(equations).get(row).is_none_or(|size| size.to_f64() <= 0.0);
    }
    equations.free_reactions(at, inputs, a.as_mut(), lambda.as_mut());
    let none = [D::Real::default(); MOST_CONTACTS];
    let limits = Limits::of(equations, at, inputs, ([a.as_ref(), lambda.as_ref()], &none));
    limits.sticking(row).to_f64() <= 0.0
}
