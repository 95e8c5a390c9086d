//! Types in the programs of a workbench: doubts about runs, fits, runs along tables, new crates, and sweeps.

mod doubts;
mod fits;
mod new_crate;
mod signals;
mod sweeps;
