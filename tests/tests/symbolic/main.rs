//! Algebra of expressions: its results are those of the formulas as they were written.

mod adjoint;
mod algebra;
mod common;
mod documented_units;
mod elimination;
mod expressions;
mod factoring;
mod layout;
mod numbers;
mod open_sums;
mod operation_counts;
mod operators;
mod pairs;
mod repetition;
mod rules;
mod splines;
mod substitution;
mod surfaces;
mod tables;
mod tangent;
