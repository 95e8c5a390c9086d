//! Starts, runs, their errors and their gradients, with types of the tests' own; and members of ensembles.

mod equations;
mod friction;
mod gradients;
mod members;
mod reach;
mod redundant;
mod results;
mod start;
mod system;
