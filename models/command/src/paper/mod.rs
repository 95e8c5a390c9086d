//! `mbs paper`: Jiang (2025), "Dynamic Modeling of Multi-body Systems: A
//! Numerical Study on Crank-slider Mechanism", reproduced.
//! <https://doi.org/10.26855/oajrcap.2025.12.001>

mod crank;
mod figures;
mod page;
mod scalars;
mod setup;
mod study;
mod torque;
mod verdict;

use std::path::{Path, PathBuf};

use clap::{Arg, ArgMatches, Command, value_parser};
use mbs_workbench::figure::Save;
use mbs_workbench::{Error, check_writable, say, sweep, write_csv};

use figures::Picture;

const DEFAULT_FOLDER: &str = "paper";

/// The command as clap knows it.
pub fn command() -> Command {
    Command::new("paper")
        .about("Reproduce the slider-crank paper: Figures 4–14, Table 3, and what it did not see")
        .arg(
            Arg::new("out")
                .long("out")
                .value_name("DIR")
                .value_parser(value_parser!(PathBuf))
                .help("Where figures and report go [default: ./paper; with --json alone: none are made]"),
        )
        .arg(
            Arg::new("json")
                .long("json")
                .value_name("FILE")
                .value_parser(value_parser!(PathBuf))
                .help("Write all scalar results as flat JSON"),
        )
}

/// Carries the command out.
///
/// # Errors
/// A file that cannot be written; runs that fail are results.
pub fn run(matches: &ArgMatches) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
    let (json, out) = (matches.get_one::<PathBuf>("json"), matches.get_one::<PathBuf>("out"));
    let folder = match (json, out) {
        (_, Some(folder)) => Some(folder.clone()),
        (None, None) => Some(DEFAULT_FOLDER.into()),
        (Some(_), None) => None,
    };
    // Before the work, so that a bad name is told at once.
    json.map_or(Ok(()), |path| check_writable(path))?;
    if let Some(folder) = &folder {
        std::fs::create_dir_all(folder).map_err(Error::file("create", folder))?;
    }
    let study = study::study(crank::Crank::new()?)?;
    let scalars = scalars::scalars(&study);
    let results = verdict::table(&study, &scalars);
    say(&results)?;
    if let Some(path) = json {
        std::fs::write(path, scalars.json()).map_err(Error::file("write", path))?;
        say(format_args!("written: {}", path.display()))?;
    }
    if let Some(folder) = &folder {
        let pictures = [
            figures::drift(&study),
            figures::stabilized(&study),
            figures::gains(&study),
            figures::torques(&study, &scalars),
        ];
        save(folder, &pictures)?;
        let feedbacks = verdict::feedbacks(&study, &scalars);
        let report = page::report(&study, page::Parts { results, feedbacks, pictures });
        let index = folder.join("index.html");
        report.save(&index)?;
        say(format_args!("written: {} and the figures beside it", index.display()))?;
    }
    Ok(())
}

/// Every picture as SVG, PNG and CSV.
fn save(folder: &Path, pictures: &[Vec<Picture>]) -> Result<(), Error> {
    let jobs: Vec<_> =
        pictures.iter().flatten().flat_map(|p| ["svg", "png", "csv"].map(|ending| (p, ending))).collect();
    let outcomes = sweep::map("figures", &jobs, |(picture, ending)| {
        let path = folder.join(picture.file).with_extension(ending);
        if *ending == "csv" {
            write_csv(&path, &picture.figure.columns())
        } else {
            picture.figure.save(&path)
        }
    });
    outcomes.into_iter().collect()
}
