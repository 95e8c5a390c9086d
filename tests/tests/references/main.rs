//! Published results and closed forms, one module per case.
#![allow(clippy::excessive_precision, reason = "references are copied with all their digits")]

mod cart_npendulum_sympy;
mod compare;
mod ladder_sliding;
mod pendulum_damped_modelica;
mod pendulum_iftomm_a01;
mod pendulum_period_table;
mod pendulum_sundials_period2;
mod rod_pendulum_reactions;
mod slotted_pendulum_modelica;
