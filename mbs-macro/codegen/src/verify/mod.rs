//! What must hold before code is emitted: the degrees of freedom of the
//! contract, independent constraints, an assembly at the declared dimensions.

mod assembly;
mod closure;
mod correction;
mod echelon;
mod floating;
mod gaps;
mod generic;
mod jets;
mod manifold;
mod prime_field;
mod programs;
mod rank;
mod redundancy;
mod rounding;
mod samples;
mod size;
mod span;
mod sparse;
mod start;
mod validation;
mod words;

use mbs_symbolic::{Stage, Undetermined, Unknown};

pub use closure::check_closure;
pub use rank::Rows;
pub use samples::Samples;
pub use validation::check_programs;
#[cfg(test)]
pub(crate) use validation::tests as planned;

use crate::derive::Equations;
use crate::diagnostics::{Diagnostic, Diagnostics, listing};
use crate::model::Model;
use crate::plan::{Plan, Unsolvable};
use crate::reactive::Circular;

/// Checks the equations before they are planned, and gives the constraints to
/// solve for.
///
/// # Errors
/// All violations, in mechanism words.
pub fn check_equations(model: &Model, equations: &Equations, samples: &Samples) -> Result<Rows, Diagnostics> {
    let mut errors = Diagnostics::default();
    check_declared_values(model, &mut errors);
    // with such values, what follows says nothing
    if !errors.is_empty() {
        return Err(errors);
    }
    let rows = rank::check_independence(model, equations, samples, &mut errors);
    if errors.is_empty() {
        gaps::check_gaps(model, equations, samples, &rows, &mut errors);
    }
    errors.finish(rows)
}

/// Declared parameters satisfy their own conditions; no mass is negative.
fn check_declared_values(model: &Model, errors: &mut Diagnostics) {
    let values = model.values(|_| f64::NAN);
    for requirement in &model.requirements {
        let difference = model.arena.evaluate(&[requirement.difference], &values);
        if !requirement.comparison.holds(difference[0]) {
            errors.push(
                Diagnostic::new(
                    requirement.span,
                    format!("the declared value of `{}` violates its own condition", requirement.name),
                )
                .help("change the value or the condition"),
            );
        }
    }
    for check in &model.checks {
        let value = model.arena.evaluate(&[check.value], &values)[0];
        // what depends on the motion is not known here
        let is_known = model.arena.stage(check.value) != Stage::Variable;
        let is_met = if check.is_strict { value > 0.0 } else { value >= 0.0 };
        if is_known && !is_met {
            let is_number = model.arena.as_number(check.value).is_some();
            let at = if is_number { "" } else { " at the declared parameters" };
            let message = format!("the {} of `{}` is {value}{at}", check.property, check.owner);
            let help = check.zero_help.filter(|_| value == 0.0).unwrap_or(check.rule());
            errors.push(Diagnostic::new(check.span, message).help(help));
        }
    }
    let start_time = model.arena.evaluate(&[model.start_time], &values)[0];
    if !start_time.is_finite() {
        let message = format!("the time of the start is {start_time} s at the declared parameters");
        errors.push(Diagnostic::new(model.name.span(), message).help("it has to be finite"));
    }
    for start in &model.start {
        let value = model.arena.evaluate(&[start.value], &values)[0];
        if !value.is_finite() {
            let name = &model.coordinates[start.coordinate].quantity.name;
            let message = format!("the start of `{name}` is {value} at the declared parameters");
            errors.push(Diagnostic::new(start.span, message).help("it has to be finite"));
        }
    }
    for body in &model.bodies {
        let found = model.arena.evaluate(&[body.mass, body.inertia], &values);
        for (value, what, unit) in [(found[0], "mass", "kg"), (found[1], "inertia", "kg*m^2")] {
            // what is denormal has no reciprocal
            if value < 0.0 || !value.is_finite() || value.is_subnormal() {
                errors.push(
                    Diagnostic::new(
                        body.span,
                        format!(
                            "the {what} of `{}` is {value:?} {unit} at the declared parameters",
                            body.name
                        ),
                    )
                    .help(if value.is_subnormal() {
                        "it is too small to compute with; leave out what has no mass, or write 0"
                    } else {
                        "it has to be finite and not negative"
                    }),
                );
            }
        }
    }
}

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
        Unsolvable::Load(Circular(at)) => {
            let span = model.reactive_loads.get(*at).map_or(model.name.span(), |load| load.span);
            Diagnostic::new(span, "this load changes the reaction that it depends on by its own size or more, so nothing determines it")
                .help("let it follow a smaller part of the reaction, or another one")
                .into()
        }
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
    Diagnostic::new(first.span, format!("nothing determines the acceleration of {}", listing(names)))
        .help("give its body a mass or inertia, or constrain it")
        .into()
}
