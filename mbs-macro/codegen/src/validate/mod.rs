//! Checks of a mechanism before a target sees it: it closes from its start and is regular
//! there, keeps its promises, and its programs compute what was declared.
//!
//! # How it works
//!
//! * `closure` assembles the mechanism from its start by `programs`, as the runtime will do it. `start`
//!   holds declared values to a thousandth of the mechanism, `stops` looks on which side of its stops it is.
//! * `span` follows the span that `closes` promises, by continuation from the start.
//! * `validation` runs the programs at random points against jets, which take derivatives by the chain
//!   rule on numbers. Bounds of running errors say how far they may differ. A disagreement is an error that
//!   asks for a report.
//!
//! Three more things are run as they are written and compared to the bit, each where it is made: a fused
//! step against its stages (`plan/step.rs`), pairs against their program (`pairs` of `mbs-symbolic`), and
//! blocks, slots and loops of a long program (`layout` there).
//!
//! Checks on equations, before the plan, stand in `independence`.

mod closure;
mod programs;
mod span;
mod start;
mod stops;
mod validation;

use mbs_symbolic::{Undetermined, Unknown};

pub use closure::check_closure;
pub use validation::check_programs;
#[cfg(test)]
pub(crate) use validation::tests as planned;

use crate::diagnostics::{Diagnostic, Diagnostics, listing};
use crate::model::{Coordinate, Model};
use crate::plan::{Plan, Unsolvable};
use crate::reactive::{Circular, Unsettled};

/// The error for a mechanism that cannot be planned.
pub fn unsolvable(model: &Model, error: &Unsolvable) -> Diagnostics {
    match error {
        Unsolvable::Unknowns(unknowns) => undetermined(model, unknowns),
        Unsolvable::Inconsistent(mistake) => Diagnostic::internal(model.name.span(), mistake).into(),
        Unsolvable::Shared => {
            let span = model.reactive_loads.first().map_or(model.name.span(), |load| load.span);
            Diagnostic::new(
                span,
                "this load depends on reactions, which redundant constraints share in more than one way",
            )
            .help("remove the spare constraints, or give the load a force that is known")
            .into()
        }
        Unsolvable::Contact(contact) => unsettled(model, contact).into(),
        Unsolvable::Load(Circular(at)) => {
            let span = model.reactive_loads.get(*at).map_or(model.name.span(), |load| load.span);
            Diagnostic::new(span, "this load changes the reaction that it depends on by its own size or more, so nothing determines it")
                .help("let it follow a smaller part of the reaction, or another one")
                .into()
        }
    }
}

/// The error for a contact that changes the reactions on which a load depends.
fn unsettled(model: &Model, &Unsettled { contact, load }: &Unsettled) -> Diagnostic {
    let of_load = model.reactive_loads.get(load).map(|load| load.span);
    let note = "it depends on a reaction";
    let diagnostic = match (model.stops.get(contact), contact.checked_sub(model.stops.len())) {
        (Some(stop), _) => {
            let name = &stop.quantity.name;
            let message =
                format!("an impact at `{name}` makes a reaction infinite, on which a force depends");
            let help = "let the force depend on positions and velocities, or on a reaction that the stop does not change";
            Diagnostic::new(stop.span, message).help(help)
        }
        (None, Some(friction)) if let Some(friction) = model.frictions.get(friction) => {
            let name = &friction.quantity.name;
            let message =
                format!("`{name}` changes a reaction while it sticks, on which another force depends");
            let help = match friction.stop {
                Some(_) => {
                    "leave the friction of the stop out, or let the other force depend on what is known"
                }
                None => {
                    "take `law = smooth;` with a `transition`, or let the other force depend on what is known"
                }
            };
            Diagnostic::new(friction.span, message).help(help)
        }
        _ => Diagnostic::new(model.name.span(), "a contact changes a reaction on which a force depends"),
    };
    match of_load {
        Some(span) => diagnostic.note(span, note),
        None => diagnostic,
    }
}

/// The code is as cheap as its declaration promises.
///
/// # Errors
/// By how much it is not.
pub fn check_limit(model: &Model, plan: &Plan) -> Result<(), Diagnostics> {
    let operations = plan.operations();
    match model.solver.operations {
        Some((limit, span)) if operations > limit => Err(Diagnostic::new(
            span,
            format!(
                "a right-hand side of `{}` takes {operations} operations, {limit} are allowed",
                model.name
            ),
        )
        .help("use fewer coordinates (a body needs those only that something acts along), or raise the limit")
        .into()),
        _ => Ok(()),
    }
}

/// The error for unknowns that no pivot determines.
fn undetermined(model: &Model, error: &Undetermined) -> Diagnostics {
    let coordinates: Vec<_> = error
        .unknowns
        .iter()
        .filter_map(|unknown| match unknown {
            Unknown::Coordinate(at) => model.coordinates.get(*at),
            Unknown::Row(_) => None,
        })
        .collect();
    let Some(first) = coordinates.first() else {
        return Diagnostic::internal(model.name.span(), error).into();
    };
    let names: Vec<_> = coordinates.iter().map(|c| c.quantity.name.as_str()).collect();
    // a mass that is 0 by a parameter is none that the declaration says
    let is_none = |c: &&Coordinate| match c.body().map(|body| &model.bodies[body]) {
        Some(body) => model.arena.is_zero(if c.is_angle() { body.inertia } else { body.mass }),
        None => true,
    };
    let where_zero = if coordinates.iter().all(is_none) {
        ""
    } else {
        ", whose mass or inertia is 0 at the declared values of its parameters"
    };
    let message = format!("nothing determines the acceleration of {}{where_zero}", listing(names));
    let help = match first.body() {
        Some(_) => "give its body a mass or inertia, or constrain it",
        None => {
            "let a particle move with it in a direction of its own, or give it by a `constraint`; with other coordinates \
             that move particles alike it is one coordinate too many"
        }
    };
    Diagnostic::new(first.span, message).help(help).into()
}
