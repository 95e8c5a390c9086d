//! What must hold before code is emitted: the degrees of freedom of the
//! contract, independent constraints, an assembly at the declared dimensions.

mod closure;
mod floating;
mod rank;
mod samples;

use mbs_symbolic::{Undetermined, Unknown};

pub use closure::check_closure;
pub use samples::Samples;

use crate::derive::Equations;
use crate::diagnostics::{Diagnostic, Diagnostics, listing};
use crate::model::Model;

/// Checks the equations before they are planned.
///
/// # Errors
/// All violations, in mechanism words.
pub fn check_equations(model: &Model, equations: &Equations, samples: &Samples) -> Result<(), Diagnostics> {
    let mut errors = Diagnostics::default();
    check_declared_values(model, &mut errors);
    let independent = rank::check_independence(model, equations, samples, &mut errors);
    rank::check_contract(model, equations, samples, independent, &mut errors);
    errors.finish(())
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
