//! About what the commands that linearize do so.
//!
//! `mbs linearize`, `mbs modes` and `mbs bode` share these options, responses (`responses`) and pictures of
//! modes (`shapes`).

use clap::{Arg, ArgAction, ArgMatches};
use mbs_analysis::{Equilibrium, Linearization, Stability};

use super::options::{self, option};
use crate::app::Warnings;
use crate::console::complain;
use crate::models::Models;
use crate::operating::doubt;
use crate::{About, Error, Model, Operating, PortNames, quantity};

/// Which mechanism, with which values, and about what it is linearized.
pub(super) fn of_a_point() -> Vec<Arg> {
    let flag = |name: &'static str, help: &'static str| {
        Arg::new(name).long(name).action(ArgAction::SetTrue).help(help)
    };
    let mut arguments =
        vec![Arg::new("model").value_name("MODEL").required(true).help("A name from `list`, or a file")];
    arguments.extend(options::of_values());
    arguments.extend([
        option("from", "NAME=VALUE", "Look for the equilibrium from this value of a coordinate; repeatable")
            .action(ArgAction::Append),
        option("at", "TIME", "Hold drives and forces where they are at this time [default: 0s]"),
        flag("relax", "Go where the mechanism would come to rest, past unstable equilibria"),
        flag("here", "Linearize at rest at the start or at --from, in equilibrium or not")
            .conflicts_with("relax"),
        option("after", "TIME", "Linearize in motion, this time after the start, with drives that move on")
            .conflicts_with_all(["from", "at", "relax", "here"]),
    ]);
    arguments
}

/// Options that choose states, inputs and outputs of the linear system.
pub(super) fn of_ports() -> [Arg; 4] {
    let list = |name: &'static str, help: &'static str| {
        option(name, "NAME,…", help).value_delimiter(',').action(ArgAction::Append)
    };
    [
        list("states", "The coordinates that are states [default: those that move most, angles first]"),
        list("inputs", "The inputs of the linear system [default: all]"),
        list("parameters", "Parameters that are inputs of the linear system too"),
        list(
            "outputs",
            "Its outputs, also x, der(x), lambda(row), and patterns with * \
             [default: the declared ones, or all coordinates]",
        ),
    ]
}

/// The state that a command line names.
pub(super) fn about(matches: &ArgMatches) -> Result<About, Error> {
    // not every command has all of them
    let text = |name: &str| matches.try_get_one::<String>(name).ok().flatten().cloned();
    let flag = |name: &str| matches.try_get_one::<bool>(name).ok().flatten().copied().unwrap_or(false);
    let from = matches.get_many::<String>("from").unwrap_or_default();
    let split =
        |text: &String| quantity::split_setting(text).map(|(name, value)| (name.into(), value.into()));
    Ok(About {
        from: from.map(split).collect::<Result<_, Error>>()?,
        at: text("at"),
        is_relaxed: flag("relax"),
        is_here: flag("here"),
        after: text("after"),
    })
}

/// The mechanism at the point that a command line asks for.
pub(super) fn operating<'a>(
    name: &'a str,
    model: &'a dyn Model,
    matches: &ArgMatches,
) -> Result<Operating<'a>, Error> {
    refuse_signals(matches, "inputs are constants of an operating point")?;
    let options = options::asked(model.info(), matches)?;
    Operating::of(name, model, &options, &about(matches)?).map_err(|error| match error {
        Error::Analysis(error @ mbs_analysis::Error::NoEquilibrium { .. }) => Error::NoEquilibrium(error),
        other => other,
    })
}

/// The linear system with the ports that a command line asks for.
pub(super) fn linearized(operating: &Operating<'_>, matches: &ArgMatches) -> Result<Linearization, Error> {
    let list = |name: &str| -> Option<Vec<String>> {
        Some(matches.try_get_many::<String>(name).ok().flatten()?.cloned().collect())
    };
    let linear = operating.linearized(&PortNames {
        states: list("states"),
        inputs: list("inputs"),
        parameters: list("parameters").unwrap_or_default(),
        outputs: list("outputs"),
    })?;
    for output in &linear.left_out {
        complain(format_args!(
            "note: the output `{}` has no value or no derivative at this position and is left out",
            output.name
        ));
    }
    Ok(linear)
}

/// About what it is linearized, in words.
pub(super) fn words(operating: &Operating<'_>) -> String {
    let is_unstable = |rest: &Equilibrium| matches!(rest.stability(), Stability::Unstable { .. });
    let hint = if operating.rest.as_ref().is_some_and(is_unstable) {
        " (--relax finds where it falls to)"
    } else {
        ""
    };
    format!("{}{hint}", operating.words())
}

/// A warning about a linear system whose derivatives are not known well.
pub(super) fn warnings(linear: &Linearization) -> Warnings {
    doubt(linear).into_iter().collect()
}

/// Refuses inputs that change with time.
pub(super) fn refuse_signals(matches: &ArgMatches, why: &str) -> Result<(), Error> {
    if matches.get_many::<String>("input").unwrap_or_default().any(|text| text.starts_with('@')) {
        let reason = format!("{why}; give a value, such as force=3N");
        return Err(Error::Name { name: "--input @FILE".into(), reason });
    }
    Ok(())
}

/// The mechanism that a command line names.
pub(super) fn named<'a>(models: &'a Models, matches: &ArgMatches) -> Result<crate::models::Found<'a>, Error> {
    models.find(matches.get_one::<String>("model").map_or("", String::as_str))
}
