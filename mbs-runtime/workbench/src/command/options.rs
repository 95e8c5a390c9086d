//! The options that say how a mechanism is run.

use std::path::Path;

use clap::builder::PossibleValuesParser;
use clap::{Arg, ArgAction, ArgMatches};
use mbs_runtime::{Dimension, Info, Quantity, SCHEMES, Stabilization, Tableau, Tolerances};

use crate::quantity::TIME;
use crate::{ConstantMethod, Error, Model, Settings, Signals, StartKind, Unit, Until, quantity};

const NUMBER: Dimension = Dimension { mass: 0, length: 0, time: 0 };
const RATE: Dimension = Dimension { mass: 0, length: 0, time: -1 };

/// An option with a value, which may begin with a minus sign.
pub(super) fn option(name: &'static str, value: &'static str, help: &'static str) -> Arg {
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
            "NAME=VALUE|@FILE.csv",
            "An input, in the same way, or @FILE.csv with time and inputs in columns; repeatable",
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
             rattle4 keep the energy where no force depends on velocities, trbdf2 takes stiff forces",
        )
        .value_parser(PossibleValuesParser::new(methods())),
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
            .value_parser(PossibleValuesParser::new(["consistent", "declared"]))
            .default_value("consistent"),
        Arg::new("allow-unstable")
            .long("allow-unstable")
            .action(ArgAction::SetTrue)
            .help("Accept gains under which the violation grows"),
    ];
    of_values().into_iter().chain(others).collect()
}

/// The words of all methods.
fn methods() -> impl Iterator<Item = &'static str> {
    let schemes = SCHEMES.into_iter().map(|scheme| scheme.word);
    schemes.chain(ConstantMethod::all().map(ConstantMethod::word))
}

/// The mechanism's defaults with the parameters and inputs that are given.
pub(super) fn values(model: &dyn Model, matches: &ArgMatches) -> Result<Settings, Error> {
    let info = model.info();
    let texts = |name: &str| matches.get_many::<String>(name).unwrap_or_default().map(String::as_str);
    let inputs = assignments("input", info.inputs, texts("input").filter(|text| !text.starts_with('@')))?;
    Ok(Settings {
        parameters: assignments("parameter", info.parameters, texts("set"))?,
        signals: signals(info, texts("input").filter_map(|text| text.strip_prefix('@')), &inputs)?,
        inputs,
        ..model.defaults()
    })
}

/// What they say, and the mechanism's defaults where they do not.
pub(super) fn settings(model: &dyn Model, matches: &ArgMatches) -> Result<Settings, Error> {
    let (info, defaults) = (model.info(), model.defaults());
    let value = |name: &str, dimension| match matches.get_one::<String>(name) {
        Some(text) => quantity::parse(name, text, dimension).map(Some),
        None => Ok(None),
    };
    let choice = |name: &str| matches.get_one::<String>(name).map_or("", String::as_str);
    // not every command looks for events, which are found by runs to a tolerance
    let condition = matches.try_get_one::<String>("until");
    let (looks, condition) = (condition.is_ok(), condition.ok().flatten());
    let until = condition.map(|text| Until::parse(info, text)).transpose()?;
    let has_feedback = ["feedback", "alpha", "beta"].iter().any(|name| matches.contains_id(name));
    let constant = ConstantMethod::find(choice("method"));
    let has_events = looks
        && !info.events.is_empty()
        && !has_feedback
        && defaults.stabilization.is_none()
        && constant.is_none();
    let for_events = (until.is_some() || has_events).then(Tolerances::default);
    let tolerances = tolerances(matches, value("max-step", TIME)?)?.or(defaults.tolerances).or(for_events);
    // feedback that is declared is of use where constraints are not kept otherwise
    let is_fed_back = tolerances.is_none() && constant.is_none();
    let declared = defaults.stabilization.filter(|_| is_fed_back);
    let stabilization = Stabilization::find(choice("feedback")).or(declared);
    let has_gains = is_fed_back && stabilization != Some(Stabilization::Projection);
    let declared_gain = |gain: Option<f64>| gain.filter(|_| has_gains);
    Ok(Settings {
        step: value("step", TIME)?.unwrap_or(defaults.step),
        end: value("end", TIME)?.unwrap_or(defaults.end),
        every: matches.try_get_one::<u64>("every").ok().flatten().copied().unwrap_or(defaults.every),
        alpha: value("alpha", RATE)?.or(declared_gain(defaults.alpha)),
        beta: value("beta", RATE)?.or(declared_gain(defaults.beta)),
        scheme: Tableau::find(choice("method")).or(defaults.scheme),
        constant,
        stabilization,
        tolerances,
        until,
        start: if choice("start") == "declared" { StartKind::Declared } else { StartKind::Consistent },
        allow_unstable: matches.get_flag("allow-unstable"),
        ..values(model, matches)?
    })
}

/// The tolerances, if any option asks for a run to such.
fn tolerances(matches: &ArgMatches, max_step: Option<f64>) -> Result<Option<Tolerances>, Error> {
    let number = |name: &str| match matches.get_one::<String>(name) {
        Some(text) => quantity::parse(name, text, NUMBER).map(Some),
        None => Ok(None),
    };
    let (rtol, atol) = (number("rtol")?, number("atol")?);
    if rtol.is_none() && atol.is_none() && max_step.is_none() {
        return Ok(None);
    }
    let defaults = Tolerances::default();
    let tolerances = Tolerances {
        rtol: rtol.unwrap_or(defaults.rtol),
        atol: atol.unwrap_or(defaults.atol),
        max_step: max_step.unwrap_or(defaults.max_step),
        ..defaults
    };
    tolerances.check::<f64>()?;
    Ok(Some(tolerances))
}

fn assignments<'a>(
    kind: &'static str,
    quantities: &[Quantity],
    texts: impl Iterator<Item = &'a str>,
) -> Result<Vec<(String, f64)>, Error> {
    let mut assigned: Vec<(String, f64)> = Vec::new();
    for text in texts {
        let (name, value) = quantity::split_setting(text)?;
        let quantity = quantities
            .iter()
            .find(|q| q.name == name)
            .ok_or_else(|| Error::unknown(kind, name, quantities.iter().map(|q| q.name)))?;
        if assigned.iter().any(|(other, _)| other == name) {
            return Err(Error::Name { name: name.to_owned(), reason: "it is set twice".into() });
        }
        assigned.push((name.to_owned(), quantity::parse_as(quantity, value)?));
    }
    Ok(assigned)
}

/// The inputs of a file, none of which is set to a value as well.
fn signals<'a>(
    info: &Info,
    mut files: impl Iterator<Item = &'a str>,
    inputs: &[(String, f64)],
) -> Result<Option<Signals>, Error> {
    let Some(file) = files.next() else { return Ok(None) };
    let refused = |name: &str, reason: &str| Err(Error::Name { name: name.into(), reason: reason.into() });
    if let Some(other) = files.next() {
        return refused(other, "the inputs of one file can be read; put their columns into one");
    }
    let signals = Signals::read(Path::new(file), info)?;
    match inputs.iter().find(|(name, _)| signals.names().any(|other| other == name)) {
        Some((name, _)) => refused(name, "it is set to a value and read from a file"),
        None => Ok(Some(signals)),
    }
}

/// What was set, in SI units, and the unit in which it is shown.
pub(super) type Given = (&'static str, f64, Unit);

/// What the settings replace of what was declared.
pub(super) fn given(info: &'static Info, settings: &Settings) -> Vec<Given> {
    let set = settings.parameters.iter().chain(&settings.inputs);
    let quantity = |name: &str| info.parameters.iter().chain(info.inputs).find(|q| q.name == name);
    set.filter_map(|(name, value)| quantity(name).map(|q| (q.name, *value, Unit::of(q)))).collect()
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
fn is_same(a: &Path, b: &Path) -> bool {
    let real = |path: &Path| path.canonicalize().ok().filter(|path| path.is_file());
    (a == b && !a.starts_with("/dev")) || real(a).is_some_and(|a| Some(a) == real(b))
}
