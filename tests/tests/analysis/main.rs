//! Rests of mechanisms, their vibrations, and the forces that motions take.

// first, since others use its macro
#[macro_use]
mod common;

mod equilibrium;
mod first_order;
mod held_modes;
mod inverse;
mod linearization;
mod modes;
mod motion;
mod own_states;
mod redundant;
mod responses;
mod sensitivities;
mod stiff_equilibrium;
mod stops;
mod travel;
