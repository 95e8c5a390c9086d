//! The equations of a mechanism on slices. Rare work on a mechanism (making starts consistent
//! and checking them, finding out why a step failed) is written once, behind this interface,
//! and not compiled again for each mechanism. It also holds mechanisms whose number of
//! coordinates is known at run time only.
//!
//! Vectors have a component per coordinate (`q`, `v`, `acceleration`, `correction`), per
//! constraint (`phi`, `phi_dot`, `feedback`, `residual`) or per input, in the order of
//! [`Info`]. The vectors of a step have a component per coordinate that is integrated
//! ([`Info::states`]). SI units, angles in rad.
#![doc = include_str!("../equations.md")]

mod differentiated;
mod typed;

pub use crate::moreau::{Pushed, Vectors, begin as begin_at_stops, push, strike};
pub use crate::pressing::{are_independent, lean, press};
pub use crate::reach::reach;
pub use crate::room::Room;
pub use crate::run::{Correction, Run, check_outputs, correction};
pub use crate::samples::Grid;
pub use crate::simulation::clock::steps_to;
pub use crate::start::assembly::{assemble, consistent, project_velocities};
pub use crate::start::consistency::check;
pub use crate::start::preparation::{Preparation, Start};
pub use crate::start::projection::project;
pub use crate::sticking::hold;
pub use crate::watch::Watch;
pub use differentiated::{Differentiated, PARTIALS, Partials};
pub(crate) use typed::{Arrays, measured, read, write};

#[cfg(doc)]
use crate::Mechanism;
use crate::{Error, Gains, Info, Real, Switch};

/// Time, positions and velocities as slices.
#[derive(Clone, Copy, Debug)]
pub struct At<'a, T> {
    /// Time in s.
    pub t: T,
    /// Coordinates q: lengths in m, angles in rad.
    pub q: &'a [T],
    /// Velocities v = q̇, per second.
    pub v: &'a [T],
}

/// A mechanism with constraints Φ(q, t) = 0 and the equations of motion of Eq. (8), as
/// [`Mechanism`] has them, on slices.
///
/// Methods that solve a system write the solution into the last slices that they are
/// given and return the pivot growth. None of them panics. Every slice is as long as its
/// vector; what comes from others means nothing.
pub trait Equations<T: Real> {
    /// Names, dimensions, redundant rows and pivots.
    fn info(&self) -> &Info;

    /// Φ(q, t)
    fn phi(&self, t: T, q: &[T], phi: &mut [T]);

    /// Φ̇ = Φ_q v + Φ_t
    fn phi_dot(&self, at: At<'_, T>, phi_dot: &mut [T]);

    /// Writes all coordinates and velocities, from those that are integrated.
    fn complete(&self, states: At<'_, T>, q: &mut [T], v: &mut [T]);

    /// Solves Eq. (8) for q̈ of the states and gives the feedback −2αΦ̇ − β²Φ that went into it.
    fn stabilized(
        &self,
        states: At<'_, T>,
        inputs: &[T],
        gains: &Gains<T>,
        acceleration: &mut [T],
        feedback: &mut [T],
    ) -> T;

    /// Solves for q̈ of the states with γ + `feedback` below.
    fn constrained(&self, states: At<'_, T>, inputs: &[T], feedback: &[T], acceleration: &mut [T]) -> T;

    /// q̈ of the states in an implicit stage; see [`Mechanism::implicit`].
    fn implicit(
        &self,
        states: At<'_, T>,
        inputs: &[T],
        shift: T,
        predicted: &[T],
        acceleration: &mut [T],
    ) -> T;

    /// Solves for q̈ of all coordinates with γ + `feedback` below.
    fn accelerations(&self, at: At<'_, T>, inputs: &[T], feedback: &[T], acceleration: &mut [T]) -> T;

    /// The smallest Δq, in the norm of the mass matrix, with Φ_q Δq = `residual` and
    /// Δq = 0 for coordinates that the start prescribes.
    fn position_correction(&self, t: T, q: &[T], residual: &[T], correction: &mut [T]) -> T;

    /// The smallest Δv, in the norm of the mass matrix, with Φ_q Δv = `residual` and
    /// Δv = 0 for velocities that the start prescribes.
    fn velocity_correction(&self, t: T, q: &[T], residual: &[T], correction: &mut [T]) -> T;

    /// The smallest Δ, in the norm of the mass matrix, with Φ_q Δ = `violation`.
    fn projection(&self, t: T, q: &[T], violation: &[T], correction: &mut [T]) -> T;

    /// Index into [`Info::pivots`] of the pivot with the largest growth, and that growth,
    /// if the elimination has any pivot that can vanish.
    fn worst_pivot(&self, t: T, q: &[T]) -> Option<(usize, T)>;

    /// The same for the corrections of a start, as an index into [`Info::start_pivots`].
    fn worst_start_pivot(&self, t: T, q: &[T]) -> Option<(usize, T)>;

    /// The first time behind `t` at which something bends or jumps; see [`Mechanism::next_corner`].
    fn next_corner(&self, _t: T, _inputs: &[T]) -> T {
        T::from_f64(f64::INFINITY)
    }

    /// The values at whose knots laws bend or jump, as a run to a tolerance watches them.
    fn switching(&self) -> &'static [Switch] {
        &[]
    }

    /// Writes those values.
    fn switches(&self, _at: At<'_, T>, _inputs: &[T], _values: &mut [T]) {}

    /// Writes restitution and settling of every stop, and the friction of those that rub; see [`Mechanism::stop_laws`].
    fn stop_laws(&self, _laws: &mut [T]) {}

    /// Writes the gap of every stop, its rate and its second derivative; see [`Mechanism::gaps`].
    fn gaps(&self, _at: At<'_, T>, _acceleration: &[T], _gaps: &mut [T]) {}

    /// Writes the size of every friction that sticks while it slides, and the largest one with which it sticks, given q̈
    /// and λ; see [`Mechanism::limits`].
    fn limits(&self, _at: At<'_, T>, _inputs: &[T], _reactions: [&[T]; 2], _limits: &mut [T]) {}

    /// q̈ and λ without feedback terms, and without what stops and frictions do that hold; their pivot growth.
    fn free_reactions(&self, at: At<'_, T>, inputs: &[T], acceleration: &mut [T], multipliers: &mut [T])
    -> T;

    /// Does something with the responses to unit impulses along gaps; see [`Mechanism::contacts`].
    fn contacts(&self, _t: T, _q: &[T], _what: &mut dyn FnMut(&[T])) {}

    /// The period and the offset of a clock in s; see [`Mechanism::clock`].
    fn clock(&self, clock: usize) -> [T; 2];

    /// Sets the memories of a clock, which stand behind the inputs; see [`Mechanism::sample`].
    fn sample(&self, at: At<'_, T>, inputs: &mut [T], clock: usize);

    /// Writes the values of transitions, given q̈ and λ; see [`Mechanism::transitions`].
    fn transitions(&self, _at: At<'_, T>, _inputs: &[T], _reactions: [&[T]; 2], _values: &mut [T]) {}

    /// Kinetic energy ½ vᵀMv in J.
    fn kinetic_energy(&self, at: At<'_, T>) -> T;

    /// q̈ and λ without feedback terms; their pivot growth.
    fn reactions(&self, at: At<'_, T>, inputs: &[T], acceleration: &mut [T], multipliers: &mut [T]) -> T;

    /// Writes the declared outputs, given q̈ and λ.
    fn outputs(&self, at: At<'_, T>, inputs: &[T], reactions: [&[T]; 2], outputs: &mut [T]);

    /// Writes the values whose changes of sign are the declared events.
    fn events(&self, at: At<'_, T>, inputs: &[T], values: &mut [T]);

    /// Potential energy of gravity and springs in J.
    fn potential_energy(&self, at: At<'_, T>) -> T;

    /// x and y of every point of the [sketch](crate::System::sketch) in m, one after the other.
    fn points(&self, t: T, q: &[T], points: &mut [T]);

    /// Writes the parameters.
    fn parameters(&self, parameters: &mut [T]);

    /// True if the equations can be had over duals: those of a text, and of a type in [`Differentiated`].
    fn is_differentiable(&self) -> bool {
        false
    }

    /// Does something with the equations over duals, with these parameters: constants, or variables. Nothing is done
    /// where they cannot be had. See [`Differentiated`] for an example.
    ///
    /// # Errors
    /// As [`Mechanism::new`].
    fn with_partials(
        &self,
        _parameters: &[Partials],
        _what: &mut dyn FnMut(&dyn Equations<Partials>),
    ) -> Result<(), Error> {
        Ok(())
    }

    /// Writes those of all coordinates, velocities or accelerations that are integrated.
    fn states(&self, all: &[T], states: &mut [T]) {
        for (state, &at) in states.iter_mut().zip(self.info().states) {
            *state = all.get(at).copied().unwrap_or_default();
        }
    }
}
