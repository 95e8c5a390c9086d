//! `mbs simulate`: one run of one mechanism.

use std::path::PathBuf;

use clap::{Arg, ArgAction, ArgMatches, Command, value_parser};
use indicatif::{ProgressBar, ProgressStyle};

use super::options::{self, option, settings};
use super::page;
use crate::app::Models;
use crate::figure::Figure;
use crate::{Error, Model, Picture, Settings, say};

pub(crate) fn command() -> Command {
    Command::new("simulate")
        .about("Simulate a mechanism and record its motion")
        .arg(Arg::new("model").value_name("MODEL").required(true).help("A name from `list`"))
        .args(options::of_a_run())
        .arg(
            option("every", "N", "Record every N-th step")
                .value_parser(value_parser!(u64).range(1..))
                .default_value("1"),
        )
        .arg(
            Arg::new("all")
                .long("all")
                .action(ArgAction::SetTrue)
                .help("Print all coordinates, however many there are"),
        )
        .arg(
            option("out", "FILE.csv", "Write everything that was recorded")
                .value_parser(value_parser!(PathBuf)),
        )
        .arg(
            option("plot", "FILE.svg|.png", "Draw coordinates, outputs and violation")
                .value_parser(value_parser!(PathBuf)),
        )
        .arg(
            option("sketch", "FILE.svg|.png", "Draw the mechanism, its later poses and its paths")
                .value_parser(value_parser!(PathBuf)),
        )
        .arg(
            option("report", "FILE.html", "Write a page with the mechanism in motion and all curves")
                .value_parser(value_parser!(PathBuf)),
        )
}

pub(crate) fn run(models: &Models, matches: &ArgMatches) -> Result<(), Error> {
    let text = |name: &str| matches.get_one::<String>(name).map(String::as_str);
    let name = text("model").unwrap_or_default();
    let model = models.get(name)?;
    let settings = settings(model, matches)?;
    let path = |name: &str| matches.get_one::<PathBuf>(name).cloned();
    let files =
        Files { csv: path("out"), plot: path("plot"), sketch: path("sketch"), report: path("report") };
    let shown = if matches.get_flag("all") { page::Shown::All } else { page::Shown::Some };
    carry_out(name, model, &settings, &files, shown)
}

/// What the program does without a command: the mechanism as it is declared,
/// recorded to `NAME.csv`, drawn to `NAME.svg` and `NAME-mechanism.svg`, and
/// shown in motion in `NAME.html`.
pub(crate) fn by_default(name: &str, model: &dyn Model) -> Result<(), Error> {
    let path = |ending: &str| Some(PathBuf::from(format!("{name}{ending}")));
    let files = Files {
        csv: path(".csv"),
        plot: path(".svg"),
        sketch: path("-mechanism.svg"),
        report: path(".html"),
    };
    carry_out(name, model, &model.defaults(), &files, page::Shown::Some)
}

/// What a run is to be written to.
struct Files {
    csv: Option<PathBuf>,
    plot: Option<PathBuf>,
    sketch: Option<PathBuf>,
    report: Option<PathBuf>,
}

fn carry_out(
    name: &str,
    model: &dyn Model,
    settings: &Settings,
    files: &Files,
    shown: page::Shown,
) -> Result<(), Error> {
    let Files { csv, plot, sketch, report } = files;
    let bar = ProgressBar::new(0).with_style(
        ProgressStyle::with_template("{bar:40} {pos}/{len} steps, {eta} left")
            .unwrap_or_else(|_| ProgressStyle::default_bar()),
    );
    let recording = model.simulate(settings, &mut |done, all| {
        bar.set_length(all);
        bar.set_position(done);
    })?;
    bar.finish_and_clear();

    let mut kept = String::new();
    if let Some(path) = csv {
        recording.write_csv(path)?;
        kept = format!("; the motion up to there is in {}", path.display());
    }
    if let Some(path) = plot {
        page::curves(name, model.info(), &recording).save(path)?;
    }
    if sketch.is_some() || report.is_some() {
        let picture = Picture::of(&model.motion(settings, &recording)?);
        if let Some(path) = report {
            page::page(name, model.info(), &recording, &picture).save(path)?;
        }
        if let Some(path) = sketch {
            Figure::mechanism(name, picture).save(path)?;
        }
    }
    if let Some(cause) = recording.ended {
        return Err(Error::EndedEarly { cause, kept });
    }
    say(page::summary(name, &recording, shown).to_string().trim_end());
    for path in [csv, plot, sketch, report].into_iter().flatten() {
        say(format_args!("written: {}", path.display()));
    }
    Ok(())
}
