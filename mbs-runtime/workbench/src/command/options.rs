//! The options that say how a mechanism is run.

use std::path::Path;

use clap::builder::PossibleValuesParser;
use clap::{Arg, ArgAction, ArgMatches};
use mbs_runtime::{Info, Stabilization};

use crate::{Error, Model, RunOptions, Settings, Signals, Unit, quantity, start_state};

/// An option with a value, which may begin with a minus sign.
pub(crate) fn option(name: &'static str, value: &'static str, help: &'static str) -> Arg {
    Arg::new(name).long(name).value_name(value).help(help).allow_hyphen_values(true)
}

/// Those that give parameters and inputs their values.
pub(super) fn of_values() -> [Arg; 2] {
    [
        option(
            "set",
            "NAME=VALUE",
            "A parameter, such as omega=300rpm; a bare number is in the unit of `list`; repeatable",
        )
        .action(ArgAction::Append),
        option(
            "input",
            "NAME=VALUE|[NAME=]@FILE.csv",
            "An input, in the same way; NAME=@FILE.csv with time and the input in columns, or @FILE.csv for all inputs \
             that it has; repeatable",
        )
        .action(ArgAction::Append),
    ]
}

/// Those that every command with runs has.
pub(super) fn of_a_run() -> Vec<Arg> {
    let others = [
        option(
            "step",
            "TIME",
            "Step in s, or with a unit; with --rtol or --atol the time between samples \
             [default: as declared, 0.5ms, or what a fast mechanism asks for]",
        ),
        option("end", "TIME", "End time in s, or with a unit [default: 1s]"),
        option(
            "alpha",
            "RATE",
            "Feedback of the velocity violation in 1/s [default: as declared, or deadbeat]",
        ),
        option(
            "beta",
            "RATE",
            "Feedback of the position violation in 1/s [default: as declared, or deadbeat]",
        ),
        option(
            "method",
            "SCHEME",
            "The scheme of the steps [default: as declared, heun, or dopri5 to a tolerance]; rattle and \
             rattle4 keep the energy where no force depends on velocities, trbdf2 and esdirk4 take stiff \
             forces, esdirk4 to a tolerance always",
        )
        .value_parser(PossibleValuesParser::new(RunOptions::methods())),
        option(
            "rtol",
            "NUMBER",
            "Steps as long as this relative error of a step permits, with projection [default: 1e-6]",
        ),
        option("atol", "NUMBER", "The same for its absolute error, in SI units [default: 1e-9]"),
        option("max-step", "TIME", "The longest step of a run to a tolerance"),
        option(
            "feedback",
            "KIND",
            "What keeps the constraints: the violation is fed back, or the state projected \
             [default: as declared, or held]",
        )
        .value_parser(PossibleValuesParser::new(Stabilization::ALL.map(Stabilization::word))),
        option("start", "WHERE", "The declared start, made consistent or as it is")
            .value_parser(PossibleValuesParser::new(RunOptions::STARTS))
            .default_value("consistent"),
        Arg::new("allow-unstable")
            .long("allow-unstable")
            .action(ArgAction::SetTrue)
            .help("Accept gains under which the violation grows"),
    ];
    of_values().into_iter().chain(others).collect()
}

/// The mechanism's defaults with the parameters and inputs that are given.
pub(super) fn values(model: &dyn Model, matches: &ArgMatches) -> Result<Settings, Error> {
    asked(model.info(), matches)?.values(model)
}

/// Settings of a run that looks for no declared events: what the options say, else the defaults of the mechanism.
pub(super) fn settings(model: &dyn Model, matches: &ArgMatches) -> Result<Settings, Error> {
    of_a_run_with(false, model, matches)
}

/// The same of a run in which declared events are looked for.
pub(super) fn settings_with_events(model: &dyn Model, matches: &ArgMatches) -> Result<Settings, Error> {
    of_a_run_with(true, model, matches)
}

fn of_a_run_with(finds_events: bool, model: &dyn Model, matches: &ArgMatches) -> Result<Settings, Error> {
    let mut asked = asked(model.info(), matches)?;
    for name in RunOptions::NAMES {
        // not every command has all of them
        if let Some(text) = matches.try_get_one::<String>(name).ok().flatten() {
            asked.set(name, text)?;
        }
    }
    let from = matches.try_get_many::<String>("from").ok().flatten().unwrap_or_default();
    asked.from = from.map(|text| split(text)).collect::<Result<_, _>>()?;
    asked.every = matches.try_get_one::<u64>("every").ok().flatten().copied();
    asked.finds_events = finds_events;
    asked.allow_unstable =
        matches.try_get_one::<bool>("allow-unstable").ok().flatten().copied() == Some(true);
    asked.settings(model)
}

/// The parameters and inputs that are given.
pub(super) fn asked(info: &Info, matches: &ArgMatches) -> Result<RunOptions, Error> {
    let texts = |name: &str| matches.get_many::<String>(name).unwrap_or_default().map(String::as_str);
    let is_file = |text: &&str| text.starts_with('@') || text.split('=').nth(1).is_some_and(is_table);
    let (files, inputs): (Vec<&str>, Vec<&str>) = texts("input").partition(is_file);
    let mut signals: Option<Signals> = None;
    for text in files {
        let read = match text.strip_prefix('@') {
            Some(path) => Signals::read(Path::new(path), info)?,
            None => {
                let (name, path) = quantity::split_setting(text)?;
                Signals::read_input(Path::new(path.trim_start_matches('@')), info, name)?
            }
        };
        signals = Some(match signals.take() {
            Some(others) => others.with(read)?,
            None => read,
        });
    }
    Ok(RunOptions {
        parameters: texts("set").map(split).collect::<Result<_, _>>()?,
        inputs: inputs.into_iter().map(split).collect::<Result<_, _>>()?,
        signals,
        ..RunOptions::default()
    })
}

/// The name and the value of `NAME=VALUE`.
fn split(text: &str) -> Result<(String, String), Error> {
    quantity::split_setting(text).map(|(name, value)| (name.into(), value.into()))
}

/// `true` if the value of an input is the file of a table: `@FILE`.
fn is_table(value: &str) -> bool {
    value.trim_start().starts_with('@')
}

/// The name of a quantity that was set, its value in SI units, and the unit in which it is shown.
pub(super) type Given = (String, f64, Unit);

/// The values of the settings that replace declared ones.
pub(super) fn given(info: &'static Info, settings: &Settings) -> Vec<Given> {
    let set = settings.parameters.iter().chain(&settings.inputs);
    let quantity = |name: &str| info.parameters.iter().chain(info.inputs).find(|q| q.name == name);
    let set = set.filter_map(|(name, value)| Some((name.clone(), *value, Unit::of(quantity(name)?))));
    let from = settings.from.iter();
    set.chain(from.filter_map(|(name, value)| Some((name.clone(), *value, start_state::unit(info, name)?))))
        .collect()
}

/// Every file is written once.
pub(super) fn check_files<'a>(files: impl IntoIterator<Item = &'a Path>) -> Result<(), Error> {
    let mut seen: Vec<&Path> = Vec::new();
    for file in files {
        if seen.iter().any(|other| is_same(other, file)) {
            let reason = "two options write to it".into();
            return Err(Error::Name { name: file.display().to_string(), reason });
        }
        seen.push(file);
    }
    Ok(())
}

/// Whether two names are those of one plain file.
pub(super) fn is_same(a: &Path, b: &Path) -> bool {
    let real = |path: &Path| path.canonicalize().ok().filter(|path| path.is_file());
    (a == b && !a.starts_with("/dev")) || real(a).is_some_and(|a| Some(a) == real(b))
}
