//! The commands that every [`App`](crate::App) has, one a file.
//!
//! Commands, figures, reports, sweeps with their progress, and files need a terminal or a folder. They stand
//! behind the feature `desk`. The rest of this crate runs mechanisms and writes the page in which one runs,
//! on every target of Rust.

mod bode;
#[cfg(feature = "live")]
mod check;
mod compare;
mod completions;
mod curves;
mod equilibrium;
mod explain;
#[cfg(feature = "live")]
mod export;
mod extremes;
mod fit;
#[cfg(feature = "live")]
mod import;
mod inverse;
mod json;
mod linearize;
pub(crate) mod list;
mod merge;
mod modes;
pub(crate) mod new;
mod operating;
mod options;
mod page;
mod responses;
mod shapes;
pub(crate) mod simulate;
mod sweep;
mod synthesize;
mod travel;
#[cfg(feature = "live")]
mod watch;

use clap::{Command, Subcommand};

use crate::Error;
use crate::console::Warnings;
use crate::models::Models;

/// The commands with their arguments, in the order of `mbs --help`.
#[derive(Subcommand)]
pub(crate) enum Builtin {
    #[cfg(feature = "live")]
    Check(check::Arguments),
    #[cfg(feature = "live")]
    Watch(watch::Arguments),
    #[cfg(feature = "live")]
    Import(import::Arguments),
    #[cfg(feature = "live")]
    Export(export::Arguments),
    List(list::Arguments),
    Equilibrium(equilibrium::Arguments),
    Linearize(linearize::Arguments),
    Modes(modes::Arguments),
    Bode(bode::Arguments),
    Inverse(inverse::Arguments),
    Travel(travel::Arguments),
    Fit(fit::Arguments),
    Synthesize(synthesize::Arguments),
    Explain(explain::Arguments),
    Simulate(simulate::Arguments),
    Sweep(sweep::Arguments),
    Merge(merge::Arguments),
    New(new::Arguments),
    Completions(completions::Arguments),
}

impl Builtin {
    /// `parser` gives the whole command line.
    pub fn run(&self, models: &Models, parser: impl FnOnce() -> Command) -> Result<Warnings, Error> {
        let done = match self {
            #[cfg(feature = "live")]
            Self::Check(command) => command.run(),
            #[cfg(feature = "live")]
            Self::Watch(command) => command.run(),
            #[cfg(feature = "live")]
            Self::Import(command) => command.run(),
            #[cfg(feature = "live")]
            Self::Export(command) => command.run(models),
            Self::List(command) => command.run(models),
            Self::Equilibrium(command) => command.run(models),
            Self::Linearize(command) => return command.run(models),
            Self::Modes(command) => return command.run(models),
            Self::Bode(command) => return command.run(models),
            Self::Inverse(command) => command.run(models),
            Self::Travel(command) => command.run(models),
            Self::Fit(command) => return command.run(models),
            Self::Synthesize(command) => command.run(models),
            Self::Explain(command) => command.run(models),
            Self::Simulate(command) => return command.run(models),
            Self::Sweep(command) => return command.run(models),
            Self::Merge(command) => command.run(),
            Self::New(command) => command.run(),
            Self::Completions(command) => command.run(models, parser()),
        };
        done.map(|()| Warnings::new())
    }
}
