//! About what the commands that linearize do so.
//!
//! `mbs linearize`, `mbs modes` and `mbs bode` share these options, responses (`responses`) and pictures of
//! modes (`shapes`).

use clap::Args;
use mbs_analysis::{Equilibrium, Linearization, Stability};

use super::options::{Named, Values, pairs};
use crate::console::{Warnings, complain};
use crate::models::{Found, Models};
use crate::notes::held;
use crate::operating::{PARTS, doubt};
use crate::sweep::Progress;
use crate::{About, Error, Operating, PortNames};

/// Which mechanism, with which values, and about what it is linearized.
#[derive(Args)]
pub(crate) struct Point {
    #[command(flatten)]
    model: Named,
    #[command(flatten)]
    values: Values,
    /// Look for the equilibrium from this value of a coordinate; repeatable
    #[arg(long, value_name = "NAME=VALUE")]
    from: Vec<String>,
    /// Hold drives and forces where they are at this time [default: 0s]
    #[arg(long, value_name = "TIME")]
    at: Option<String>,
    /// Go where the mechanism would come to rest, past unstable equilibria
    #[arg(long)]
    relax: bool,
    /// Linearize at rest at the start or at --from, in equilibrium or not
    #[arg(long, conflicts_with = "relax")]
    here: bool,
    /// Linearize in motion, this time after the start, with drives that move on
    #[arg(long, value_name = "TIME", conflicts_with_all = ["from", "at", "relax", "here"])]
    after: Option<String>,
}

/// Options that choose states, inputs and outputs of the linear system.
#[derive(Args)]
pub(crate) struct Ports {
    /// The coordinates that are states [default: those that move most, angles first]
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    states: Option<Vec<String>>,
    /// The inputs of the linear system [default: all]
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    inputs: Option<Vec<String>>,
    /// Parameters that are inputs of the linear system too
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    parameters: Vec<String>,
    /// Its outputs, also x, der(x), lambda(row), and patterns with * [default: the declared ones, or all
    /// coordinates]
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    outputs: Option<Vec<String>>,
}

impl Point {
    pub fn find<'a>(&self, models: &'a Models) -> Result<Found<'a>, Error> {
        self.model.find(models)
    }

    /// The mechanism at the point.
    pub fn operating<'a>(&self, found: &'a Found<'_>) -> Result<Operating<'a>, Error> {
        let values = self.values.constants("inputs are constants of an operating point")?;
        let options = values.asked(found.model().info())?;
        held(found.model().info()).into_iter().for_each(|note| complain(format_args!("note: {note}")));
        let about = About {
            from: pairs(&self.from)?,
            at: self.at.clone(),
            is_relaxed: self.relax,
            is_here: self.here,
            after: self.after.clone(),
        };
        let progress = Progress::new("to the state in motion", PARTS);
        let told = &mut |done, _| progress.reached(done as usize);
        let operating = Operating::of(found.name(), found.model(), &options, &about, told);
        progress.finish();
        operating.map_err(|error| match error {
            Error::Analysis(
                error @ (mbs_analysis::Error::NoEquilibrium { .. } | mbs_analysis::Error::NoRest { .. }),
            ) => Error::NoEquilibrium(error),
            other => other,
        })
    }
}

impl From<&Ports> for PortNames {
    fn from(ports: &Ports) -> Self {
        let Ports { states, inputs, parameters, outputs } = ports;
        Self {
            states: states.clone(),
            inputs: inputs.clone(),
            parameters: parameters.clone(),
            outputs: outputs.clone(),
        }
    }
}

/// The linear system with these ports.
pub(super) fn linearized(operating: &Operating<'_>, ports: &PortNames) -> Result<Linearization, Error> {
    let linear = operating.linearized(ports)?;
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
