//! What a declaration may say, one module a kind of statement: its values, its motions, and what refuses it.

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
