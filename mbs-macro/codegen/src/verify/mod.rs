//! What must hold before code is emitted: the degrees of freedom of the
//! contract, independent constraints, an assembly at the declared dimensions.

mod assembly;
mod closure;
mod echelon;
mod generic;
mod jets;
mod manifold;
mod prime_field;
mod rank;
mod redundancy;
mod rounding;
mod samples;
mod validation;

use mbs_symbolic::{Undetermined, Unknown};

pub use closure::check_closure;
pub use rank::Rows;
pub use samples::Samples;
pub use validation::check_programs;

use crate::derive::Equations;
use crate::diagnostics::{Diagnostic, Diagnostics, listing};
use crate::model::Model;
use crate::plan::Plan;

/// Checks the equations before they are planned, and gives the constraints to
/// solve for.
///
/// # Errors
/// All violations, in mechanism words.
pub fn check_equations(model: &Model, equations: &Equations, samples: &Samples) -> Result<Rows, Diagnostics> {
    let mut errors = Diagnostics::default();
    check_declared_values(model, &mut errors);
    let rows = rank::check_independence(model, equations, samples, &mut errors);
    errors.finish(rows)
}

/// Declared parameters satisfy their own conditions; no mass is negative.
fn check_declared_values(model: &Model, errors: &mut Diagnostics) {
    let values = model.values(|_| f64::NAN);
    for parameter in &model.parameters {
        let Some(requirement) = &parameter.requirement else { continue };
        let difference = model.arena.evaluate(&[requirement.difference], &values);
        if !requirement.comparison.holds(difference[0]) {
            errors.push(
                Diagnostic::new(
                    requirement.span,
                    format!("the declared value of `{}` violates its own condition", parameter.quantity.name),
                )
                .help("change the value or the condition"),
            );
        }
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
            if value < 0.0 || !value.is_finite() {
                errors.push(
                    Diagnostic::new(
                        body.span,
                        format!("the {what} of `{}` is {value} {unit} at the declared parameters", body.name),
                    )
                    .help("it has to be finite and not negative"),
                );
            }
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
pub fn undetermined(model: &Model, error: &Undetermined) -> Diagnostics {
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
