//! `mbs simulate`: one run of one mechanism.

use std::path::PathBuf;

use clap::builder::PossibleValuesParser;
use clap::{Arg, ArgAction, ArgMatches, Command, value_parser};
use indicatif::{ProgressBar, ProgressStyle};
use mbs_runtime::{Dimension, Quantity};

use super::page;
use crate::app::Models;
use crate::figure::Figure;
use crate::{Error, FeedbackKind, Model, Picture, Settings, StartKind, quantity, say};

const TIME: Dimension = Dimension { mass: 0, length: 0, time: 1 };
const RATE: Dimension = Dimension { mass: 0, length: 0, time: -1 };

pub(crate) fn command() -> Command {
    let option = |name: &'static str, value: &'static str, help: &'static str| {
        Arg::new(name).long(name).value_name(value).help(help).allow_hyphen_values(true)
    };
    Command::new("simulate")
        .about("Simulate a mechanism and record its motion")
        .arg(Arg::new("model").value_name("MODEL").required(true).help("A name from `list`"))
        .arg(
            option("set", "NAME=VALUE", "A parameter, such as omega=300rpm or l1=70mm; repeatable")
                .action(ArgAction::Append),
        )
        .arg(
            option("input", "NAME=VALUE", "An input, such as crank_torque=0.5N*m; repeatable")
                .action(ArgAction::Append),
        )
        .arg(option("step", "TIME", "Step [default: 0.5ms, or what a fast mechanism asks for]"))
        .arg(option("end", "TIME", "End time [default: 1s]"))
        .arg(
            option("every", "N", "Record every N-th step")
                .value_parser(value_parser!(u64).range(1..))
                .default_value("1"),
        )
        .arg(option("alpha", "RATE", "Feedback of the velocity violation in 1/s [default: deadbeat]"))
        .arg(option("beta", "RATE", "Feedback of the position violation in 1/s [default: deadbeat]"))
        .arg(
            option("feedback", "WHEN", "When the violation is fed back")
                .value_parser(PossibleValuesParser::new(["held", "per-stage"]))
                .default_value("held"),
        )
        .arg(
            option("start", "WHERE", "The declared start, made consistent or as it is")
                .value_parser(PossibleValuesParser::new(["consistent", "declared"]))
                .default_value("consistent"),
        )
        .arg(
            Arg::new("allow-unstable")
                .long("allow-unstable")
                .action(ArgAction::SetTrue)
                .help("Accept gains under which the violation grows"),
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
    carry_out(name, model, &settings, &files)
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
    carry_out(name, model, &model.defaults(), &files)
}

/// What a run is to be written to.
struct Files {
    csv: Option<PathBuf>,
    plot: Option<PathBuf>,
    sketch: Option<PathBuf>,
    report: Option<PathBuf>,
}

fn settings(model: &dyn Model, matches: &ArgMatches) -> Result<Settings, Error> {
    let (info, defaults) = (model.info(), model.defaults());
    let value = |name: &str, dimension| match matches.get_one::<String>(name) {
        Some(text) => quantity::parse(name, text, dimension).map(Some),
        None => Ok(None),
    };
    let choice = |name: &str| matches.get_one::<String>(name).map_or("", String::as_str);
    Ok(Settings {
        parameters: assignments("parameter", info.parameters, matches, "set")?,
        inputs: assignments("input", info.inputs, matches, "input")?,
        step: value("step", TIME)?.unwrap_or(defaults.step),
        end: value("end", TIME)?.unwrap_or(defaults.end),
        every: matches.get_one::<u64>("every").copied().unwrap_or(defaults.every),
        alpha: value("alpha", RATE)?,
        beta: value("beta", RATE)?,
        feedback: if choice("feedback") == "per-stage" { FeedbackKind::PerStage } else { FeedbackKind::Held },
        start: if choice("start") == "declared" { StartKind::Declared } else { StartKind::Consistent },
        allow_unstable: matches.get_flag("allow-unstable"),
    })
}

fn assignments(
    kind: &'static str,
    quantities: &[Quantity],
    matches: &ArgMatches,
    option: &str,
) -> Result<Vec<(String, f64)>, Error> {
    let assignment = |text: &String| {
        let (name, value) = quantity::split_setting(text)?;
        let quantity = quantities
            .iter()
            .find(|q| q.name == name)
            .ok_or_else(|| Error::unknown(kind, name, quantities.iter().map(|q| q.name)))?;
        Ok((name.to_owned(), quantity::parse(name, value, quantity.dimension)?))
    };
    matches.get_many::<String>(option).unwrap_or_default().map(assignment).collect()
}

fn carry_out(name: &str, model: &dyn Model, settings: &Settings, files: &Files) -> Result<(), Error> {
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
    say(page::summary(name, &recording).to_string().trim_end());
    for path in [csv, plot, sketch, report].into_iter().flatten() {
        say(format_args!("written: {}", path.display()));
    }
    Ok(())
}
