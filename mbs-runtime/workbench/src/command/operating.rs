//! About what the commands that linearize do so.

use clap::{Arg, ArgAction, ArgMatches};
use mbs_analysis::{
    Equilibrium, Family, Linearization, OperatingPoint, Ports, Search, Signal, Stability, Strategy,
    equilibrium, linearize,
};
use mbs_runtime::equations::Described;
use mbs_runtime::{Info, System, Tolerances};

use super::equilibrium::positions;
use super::options::{self, option};
use crate::app::Warnings;
use crate::models::Models;
use crate::quantity::{self, TIME};
use crate::settings::Start;
use crate::{Error, Model, Settings, StartKind, names};

/// Derivatives that are known to fewer digits than these are in doubt.
const DOUBTFUL: f64 = 1e-6;

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

/// What goes into the linear system and comes out of it.
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

/// A mechanism and the point about which it is linearized.
pub(super) struct Operating<'a> {
    pub name: &'a str,
    pub model: &'a dyn Model,
    pub run: Box<dyn System>,
    pub point: OperatingPoint,
    /// Where the point is an equilibrium that was found.
    pub rest: Option<Equilibrium>,
    /// How it was looked for.
    pub search: Search,
    start: Start,
}

impl<'a> Operating<'a> {
    /// The point that a command line asks for.
    pub fn of(name: &'a str, model: &'a dyn Model, matches: &ArgMatches) -> Result<Self, Error> {
        refuse_signals(matches, "inputs are constants of an operating point")?;
        let settings = options::values(model, matches)?;
        let start = Start::of(model, &settings)?;
        if let Some(text) = matches.get_one::<String>("after") {
            let run = after(model, settings, quantity::parse("after", text, TIME)?)?;
            let point = OperatingPoint::of_run(&*run);
            return Ok(Self { name, model, run, point, rest: None, search: Search::default(), start });
        }
        let run = model.start(&start)?;
        let t = match matches.get_one::<String>("at") {
            Some(text) => quantity::parse("at", text, TIME)?,
            None => run.time(),
        };
        let from = matches.get_many::<String>("from").unwrap_or_default().map(String::as_str);
        let q = positions(&*run, t, from)?;
        let strategy = if matches.get_flag("relax") { Strategy::Relaxation } else { Strategy::Automatic };
        let search = Search { from: Some(q.clone()), inputs: Some(start.inputs.clone()), t, strategy };
        let found = if matches.get_flag("here") { None } else { Some(equilibrium(run.described(), &search)) };
        let rest = found.transpose().map_err(|error| match error {
            error @ mbs_analysis::Error::NoEquilibrium { .. } => Error::NoEquilibrium(error),
            other => other.into(),
        })?;
        let point =
            rest.as_ref().map_or_else(|| OperatingPoint::at_rest(t, &q, &start.inputs), OperatingPoint::from);
        Ok(Self { name, model, run, point, rest, search, start })
    }

    pub fn info(&self) -> &'static Info {
        self.model.info()
    }

    /// The linear system with the ports that a command line asks for.
    pub fn linearized(&self, matches: &ArgMatches) -> Result<Linearization, Error> {
        let list = |name: &str| -> Option<Vec<String>> {
            Some(matches.try_get_many::<String>(name).ok().flatten()?.cloned().collect())
        };
        let outputs = list("outputs").map(|patterns| self.outputs(&patterns)).transpose()?;
        let ports = Ports {
            states: list("states"),
            inputs: list("inputs"),
            outputs,
            parameters: list("parameters").unwrap_or_default(),
            family: Some(self),
        };
        Ok(linearize(self.run.described(), &self.point, &ports)?)
    }

    /// The names that fit some patterns, in their order.
    fn outputs(&self, patterns: &[String]) -> Result<Vec<String>, Error> {
        let info = self.info();
        let known: Vec<String> = Signal::observable(info).into_iter().map(|y| y.name).collect();
        let mut found: Vec<String> = Vec::new();
        for pattern in patterns {
            let mut fitting = known.iter().filter(|name| names::fits(pattern, name)).peekable();
            if fitting.peek().is_none() {
                return Err(Error::unknown("output", pattern, known.iter().map(String::as_str)));
            }
            let new: Vec<String> = fitting.filter(|name| !found.contains(name)).cloned().collect();
            found.extend(new);
        }
        Ok(found)
    }

    /// About what it is linearized, in words.
    pub fn words(&self) -> String {
        let t = crate::number::significant(self.point.t, 6);
        match &self.rest {
            Some(rest) => {
                let stability = match rest.stability() {
                    Stability::Stable => "a stable equilibrium",
                    Stability::Indifferent => "an indifferent equilibrium",
                    Stability::Unstable { .. } => "an unstable equilibrium (--relax finds where it falls to)",
                };
                if self.point.t == 0.0 {
                    stability.into()
                } else {
                    format!("{stability}, drives held at {t} s")
                }
            }
            None if self.point.drives == mbs_analysis::Drives::Held => "a position at rest".into(),
            None => format!("the motion at t = {t} s"),
        }
    }
}

impl Family for Operating<'_> {
    fn with(
        &self,
        parameters: &[f64],
        look: &mut dyn FnMut(&dyn Described<f64>),
    ) -> Result<(), mbs_runtime::Error> {
        let start =
            Start { parameters: parameters.to_vec(), kind: StartKind::Declared, ..self.start.clone() };
        look(self.model.start(&start)?.described());
        Ok(())
    }
}

/// A run to a tolerance that is over.
fn after(model: &dyn Model, settings: Settings, time: f64) -> Result<Box<dyn System>, Error> {
    if !(time >= 0.0 && time.is_finite()) {
        let reason = "it has to be 0 or later".into();
        return Err(Error::Value { what: "after".into(), text: format!("{time} s"), reason });
    }
    let tolerances = Some(Tolerances { rtol: 1e-10, atol: 1e-12, ..Tolerances::default() });
    // what is declared for constant steps has no use here
    let (stabilization, alpha, beta) = (None, None, None);
    let step = if time > 0.0 { time } else { settings.step };
    let settings = Settings { step, end: step, tolerances, stabilization, alpha, beta, ..settings };
    let mut run = model.start(&Start::of(model, &settings)?)?;
    if time > 0.0 {
        run.step()?;
    }
    Ok(run)
}

/// What is to be said of a linear system whose derivatives are not known well.
pub(super) fn warnings(linear: &Linearization) -> Warnings {
    if linear.uncertainty < DOUBTFUL {
        return Warnings::new();
    }
    let digits = (-linear.uncertainty.log10()).floor().max(0.0);
    vec![format!(
        "the accelerations are not smooth at this point (a stop, or friction that changes its sign): their \
         derivatives are known to {digits} digits"
    )]
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
