//! Statements of a declaration, one module a kind: their values, their motions, and mistakes in them.

mod choices;
mod clocks;
mod composition;
mod couplings;
mod declared_solver;
mod elements;
mod energy_balance;
mod friction;
mod inputs;
mod joints;
mod macros;
mod maps;
mod measures;
mod meters;
mod own_states;
mod particles;
mod profiles;
mod rates;
