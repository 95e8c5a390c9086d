//! `mbs drift`: how well the constraints stay closed over a long run.

use clap::{ArgMatches, Command};
use mbs_workbench::number::significant;
use mbs_workbench::{Settings, Summary, Table, model, say};

use crate::library;

/// Steps of a run; twice as many with half the step.
const STEPS: f64 = 20_000.0;

/// The command as clap knows it.
pub fn command() -> Command {
    Command::new("drift")
        .about("Run every mechanism for a long time: constraint violation and energy, with h and h/2")
}

/// Carries the command out.
///
/// # Errors
/// A run that fails.
pub fn run(_: &ArgMatches) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
    let headings =
        ["mechanism", "dof", "h", "end", "max ‖Φ‖", "with h/2", "max ‖dΦ/dt‖", "with h/2", "ΔE", "with h/2"];
    let mut table = Table::new(headings);
    for entry in library() {
        let model = model::from_text(&entry.text(), entry.defaults())?;
        let step = model.defaults().step;
        let end = STEPS * step;
        let summary = |step: f64| -> Result<Summary, mbs_workbench::Error> {
            let settings = Settings { step, end, every: u64::MAX, ..model.defaults() };
            let recording = model.simulate(&settings, &mut |_, _| ())?;
            recording.ended.map_or(Ok(recording.summary), |error| Err(error.into()))
        };
        let (coarse, fine) = (summary(step)?, summary(step / 2.0)?);
        let digits = |value: f64| significant(value, 2);
        // drives do work, so energy says something of free mechanisms only
        let energy = |summary: &Summary| match model.info().dof {
            0 => "–".to_owned(),
            _ => digits(summary.energy_end - summary.energy_start),
        };
        table.row([
            entry.name.to_owned(),
            model.info().dof.to_string(),
            format!("{} s", digits(step)),
            format!("{} s", digits(end)),
            digits(coarse.max_phi),
            digits(fine.max_phi),
            digits(coarse.max_phi_dot),
            digits(fine.max_phi_dot),
            energy(&coarse),
            energy(&fine),
        ]);
    }
    say(table.to_string().trim_end())?;
    say("Φ in m and rad, dΦ/dt per second, ΔE in J from start to end, losses in dampers included.")?;
    Ok(())
}
