//! `mbs simulate`: one run of one mechanism, or some that are compared.

use std::path::PathBuf;

use clap::{Arg, ArgAction, ArgMatches, Command, value_parser};
use indicatif::{ProgressBar, ProgressStyle};

use super::compare::{self, Comparison};
use super::curves::{Choice, curves};
use super::options::{self, option, settings_with_events};
use super::{json, page};
use crate::app::Warnings;
use crate::console::complain;
use crate::figure::Figure;
use crate::models::Models;
use crate::{Error, Model, Picture, Recording, Settings, say, write_csv};

pub(crate) fn command() -> Command {
    let file = |name: &'static str, value: &'static str, help: &'static str| {
        option(name, value, help).value_parser(value_parser!(PathBuf))
    };
    let flag = |name: &'static str, help: &'static str| {
        Arg::new(name).long(name).action(ArgAction::SetTrue).help(help)
    };
    Command::new("simulate")
        .about("Simulate a mechanism and record its motion")
        .after_help(EXAMPLES)
        .arg(Arg::new("model").value_name("MODEL").required(true).help("A name from `list`, or a file"))
        .args(options::of_a_run())
        .arg(option(
            "until",
            "CONDITION",
            "End where this becomes true, 'x3 > 200mm' or 'der(theta) < 0', or at this declared event; a run to a \
             tolerance",
        ))
        .arg(
            option(
                "from",
                "NAME=VALUE",
                "Start with this value of a coordinate x or a rate der(x), the others following; repeatable",
            )
            .action(ArgAction::Append),
        )
        .arg(
            option("every", "N", "Record every N-th step")
                .value_parser(value_parser!(u64).range(1..))
                .default_value("1"),
        )
        .arg(
            option("columns", "NAME,…", "Record, draw and print these: x1, der(theta*), lambda(pin*), …")
                .value_delimiter(',')
                .action(ArgAction::Append),
        )
        .arg(option("x", "NAME", "Draw over this instead of time"))
        .arg(compare::option())
        .arg(flag("all", "Print all coordinates, however many there are"))
        .arg(flag("json", "Print the summary as JSON"))
        .arg(file("out", "FILE.csv", "Write what was recorded"))
        .arg(file("plot", "FILE.svg|.png", "Draw coordinates, outputs and violation, or --columns"))
        .arg(file("sketch", "FILE.svg|.png", "Draw the mechanism, its later poses and its paths"))
        .arg(file("report", "FILE.html", "Write a page with the mechanism in motion and all curves"))
}

const EXAMPLES: &str = "\
Examples:
  mbs simulate four-bar --columns 'theta*' --plot run.svg
  mbs simulate slider-crank-free --rtol 1e-8 --until 'x3 < 200mm'
  mbs simulate jansen --columns yf --x xf --plot path.svg
  mbs simulate slider-crank --compare omega=100rpm,200rpm --columns drive_torque --plot both.svg

A run whose numbers are in doubt is written as any other, with a warning and exit code 3.";

pub(crate) fn run(models: &Models, matches: &ArgMatches) -> Result<Warnings, Error> {
    let text = |name: &str| matches.get_one::<String>(name).map(String::as_str);
    let name = text("model").unwrap_or_default();
    let found = models.find(name)?;
    let (name, model) = (found.name(), found.model());
    let settings = settings_with_events(model, matches)?;
    let path = |name: &str| matches.get_one::<PathBuf>(name).cloned();
    let request = Request {
        name,
        model,
        files: Files { csv: path("out"), plot: path("plot"), sketch: path("sketch"), report: path("report") },
        choice: Choice {
            columns: matches.get_many::<String>("columns").unwrap_or_default().cloned().collect(),
            x: text("x").map(str::to_owned),
        },
        all: matches.get_flag("all"),
        json: matches.get_flag("json"),
    };
    request.files.check()?;
    // Whether there are such columns.
    request.choice.written(&Recording::empty(model.info()))?;
    match Comparison::of(model.info(), &settings, matches)? {
        Some(comparison) => compare::carry_out(&request, &comparison),
        None => request.carry_out(&settings),
    }
}

/// Runs a program that is given no command: simulates the mechanism as it is declared, records it to
/// `NAME.csv`, draws it to `NAME.svg` and `NAME-mechanism.svg`, and shows it in motion in `NAME.html`.
pub(crate) fn by_default(name: &str, model: &dyn Model) -> Result<Warnings, Error> {
    let path = |ending: &str| Some(PathBuf::from(format!("{name}{ending}")));
    let files = Files {
        csv: path(".csv"),
        plot: path(".svg"),
        sketch: path("-mechanism.svg"),
        report: path(".html"),
    };
    Request { name, model, files, choice: Choice::default(), all: false, json: false }
        .carry_out(&model.defaults())
}

/// A run that is asked for, and its outputs.
pub(super) struct Request<'a> {
    pub name: &'a str,
    pub model: &'a dyn Model,
    pub files: Files,
    pub choice: Choice,
    pub all: bool,
    pub json: bool,
}

/// The files that a run is written to.
pub(super) struct Files {
    pub csv: Option<PathBuf>,
    pub plot: Option<PathBuf>,
    pub sketch: Option<PathBuf>,
    pub report: Option<PathBuf>,
}

impl Files {
    pub fn all(&self) -> impl Iterator<Item = &PathBuf> {
        [&self.csv, &self.plot, &self.sketch, &self.report].into_iter().flatten()
    }

    /// Before the work, so that a bad name is told at once.
    fn check(&self) -> Result<(), Error> {
        options::check_files(self.all().map(PathBuf::as_path))?;
        [&self.plot, &self.sketch].into_iter().flatten().try_for_each(|path| Figure::check_ending(path))
    }
}

impl Request<'_> {
    fn carry_out(&self, settings: &Settings) -> Result<Warnings, Error> {
        let recording = recorded(self.model, settings)?;
        let kept = self.write(settings, &recording)?;
        let warnings: Warnings = recording.doubts.iter().map(ToString::to_string).collect();
        if self.json {
            say(json::run(self, settings, &recording))?;
        }
        recording.notes.iter().for_each(|note| complain(format_args!("note: {note}")));
        if let Some(cause) = recording.ended {
            return Err(Error::EndedEarly { cause, kept });
        }
        if !self.json {
            say(self.table(settings, &recording)?.to_string().trim_end())?;
            self.files.all().try_for_each(|path| say(format_args!("written: {}", path.display())))?;
        }
        Ok(warnings)
    }

    /// Writes the files; says where the recording is, as a clause to append.
    fn write(&self, settings: &Settings, recording: &Recording) -> Result<String, Error> {
        let Files { csv, plot, sketch, report } = &self.files;
        let mut kept = String::new();
        if let Some(path) = csv {
            write_csv(path, &self.choice.written(recording)?)?;
            kept = format!("; the motion up to there is in {}", path.display());
        }
        if let Some(path) = plot {
            curves(self.name, recording, &self.choice)?.save(path)?;
        }
        if sketch.is_some() || report.is_some() {
            let picture = Picture::of(&self.model.motion(settings, recording)?);
            if let Some(path) = report {
                page::page(self.name, self.model.info(), recording, &picture, &self.choice)?.save(path)?;
            }
            if let Some(path) = sketch {
                Figure::mechanism(self.name, picture).save(path)?;
            }
        }
        Ok(kept)
    }

    fn table(&self, settings: &Settings, recording: &Recording) -> Result<crate::Table, Error> {
        let given = options::given(self.model.info(), settings);
        Ok(page::summary(self.name, &given, recording, self.shown(recording)?))
    }

    /// Whose values at the end are printed.
    pub fn shown<'r>(&self, recording: &'r Recording) -> Result<page::Shown<'r>, Error> {
        Ok(match (self.choice.columns.is_empty(), self.all) {
            (false, _) => page::Shown::Chosen(self.choice.drawn(recording)?),
            (true, true) => page::Shown::All,
            (true, false) => page::Shown::Ends,
        })
    }
}

/// A run with a progress bar.
pub(super) fn recorded(model: &dyn Model, settings: &Settings) -> Result<Recording, Error> {
    let bar = ProgressBar::new(0).with_style(
        ProgressStyle::with_template("{bar:40} {pos}/{len} steps, {eta} left")
            .unwrap_or_else(|_| ProgressStyle::default_bar()),
    );
    let recording = model.simulate(settings, &mut |done, all| {
        bar.set_length(all);
        bar.set_position(done);
    });
    bar.finish_and_clear();
    recording
}
