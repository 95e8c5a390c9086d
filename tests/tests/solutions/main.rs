//! Equations and their solutions: those by hand, those of a dense solver, and the same numbers on every way to them.

mod cancellations;
mod coincidences;
mod dense;
mod derivatives;
mod duals;
mod fused_step;
mod loops;
mod massless;
mod pendulum_by_hand;
mod redundant;
mod scales;
mod sine_cosine;
mod single_precision;
mod singular_positions;
