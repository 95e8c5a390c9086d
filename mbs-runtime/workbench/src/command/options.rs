//! The options that say how a mechanism is run.

use clap::builder::PossibleValuesParser;
use clap::{Arg, ArgAction, ArgMatches};
use mbs_runtime::{Dimension, Quantity};

use crate::{Error, FeedbackKind, Model, Settings, StartKind, quantity};

const TIME: Dimension = Dimension { mass: 0, length: 0, time: 1 };
const RATE: Dimension = Dimension { mass: 0, length: 0, time: -1 };

/// An option with a value, which may begin with a minus sign.
pub(super) fn option(name: &'static str, value: &'static str, help: &'static str) -> Arg {
    Arg::new(name).long(name).value_name(value).help(help).allow_hyphen_values(true)
}

/// Those that every command with runs has.
pub(super) fn of_a_run() -> Vec<Arg> {
    vec![
        option("set", "NAME=VALUE", "A parameter, such as omega=300rpm or l1=70mm; repeatable")
            .action(ArgAction::Append),
        option("input", "NAME=VALUE", "An input, such as crank_torque=0.5N*m; repeatable")
            .action(ArgAction::Append),
        option("step", "TIME", "Step [default: 0.5ms, or what a fast mechanism asks for]"),
        option("end", "TIME", "End time [default: 1s]"),
        option("alpha", "RATE", "Feedback of the velocity violation in 1/s [default: deadbeat]"),
        option("beta", "RATE", "Feedback of the position violation in 1/s [default: deadbeat]"),
        option("feedback", "WHEN", "When the violation is fed back")
            .value_parser(PossibleValuesParser::new(["held", "per-stage"]))
            .default_value("held"),
        option("start", "WHERE", "The declared start, made consistent or as it is")
            .value_parser(PossibleValuesParser::new(["consistent", "declared"]))
            .default_value("consistent"),
        Arg::new("allow-unstable")
            .long("allow-unstable")
            .action(ArgAction::SetTrue)
            .help("Accept gains under which the violation grows"),
    ]
}

/// What they say, and the mechanism's defaults where they do not.
pub(super) fn settings(model: &dyn Model, matches: &ArgMatches) -> Result<Settings, Error> {
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
        every: matches.try_get_one::<u64>("every").ok().flatten().copied().unwrap_or(defaults.every),
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
