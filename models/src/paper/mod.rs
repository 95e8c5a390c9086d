//! `mbs paper`: Jiang (2025), "Dynamic Modeling of Multi-body Systems: A
//! Numerical Study on Crank-slider Mechanism", reproduced.
//! <https://doi.org/10.26855/oajrcap.2025.12.001>

mod scalars;
mod setup;
mod study;
mod torque;

use clap::{ArgMatches, Command};

pub fn command() -> Command {
    Command::new("paper")
}
pub fn run(_: &ArgMatches) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
    let study = study::study()?;
    print!("{}", scalars::scalars(&study).json());
    Ok(())
}
