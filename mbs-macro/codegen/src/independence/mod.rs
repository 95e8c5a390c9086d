//! Which constraints are solved for: they are independent, in general and at the declared
//! dimensions, where the mechanism can be assembled.
//!
//! # How it works
//!
//! * `generic` finds the rank whatever the dimensions are, in exact arithmetic (`exact`). Where functions
//!   have stand-ins, floating-point samples are asked as well (`samples`).
//! * `assembly` finds positions numerically. `manifold` finds the rank at the declared dimensions.
//! * `echelon`, `sparse` and `correction` are the linear algebra behind them, on sparse rows.
//! * `redundancy` chooses rows under `redundant = minimum_norm;`, and `sets` those of which another
//!   one is spare in every position.
//! * `words` speaks of rows as joints and bodies.
//!
//! Checks on equations, before the plan, stand here. Checks on the programs that are emitted stand in
//! `validate`.

pub mod assembly;
mod correction;
pub mod echelon;
mod exact;
mod floating;
mod gaps;
mod generic;
mod manifold;
mod rank;
pub mod redundancy;
mod rows;
pub mod samples;
pub mod sets;
mod size;
pub mod sparse;
mod ways;
pub mod words;

use mbs_symbolic::{Stage, Symbol};

pub use rows::Rows;
pub use samples::Samples;

use crate::derive::Equations;
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::model::Model;

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
            let value = model.arena.evaluate(&[requirement.value], &values)[0];
            let (message, help) = match requirement.is_written() {
                true => (
                    format!("the declared value of `{}` violates its own condition", requirement.name),
                    "change the value or the condition",
                ),
                false => (
                    format!("`{}` is {value}, but {}", requirement.name, requirement.text),
                    "change the value",
                ),
            };
            errors.push(Diagnostic::new(requirement.span, message).help(help));
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
    check_declared_step(model, &values, errors);
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

/// A declared step leads to the samples of the clocks.
fn check_declared_step(model: &Model, values: &dyn Fn(Symbol) -> f64, errors: &mut Diagnostics) {
    let Some((step, span)) = model.solver.step else { return };
    let slack = 8.0 * f64::EPSILON;
    let is_whole = |seconds: f64| {
        (seconds / step - (seconds / step).round()).abs() <= slack * (1.0 + (seconds / step).abs())
    };
    for clock in &model.clocks {
        let found = model.arena.evaluate(&[clock.period, clock.offset], values);
        let (period, offset) = (found[0], found[1]);
        if !(is_whole(period) && period >= (1.0 - slack) * step && is_whole(offset)) {
            let memory = clock.sets.first().map_or("", |(memory, _)| &model.inputs[*memory].quantity.name);
            let from = if offset == 0.0 { String::new() } else { format!(" from {offset:?} s on") };
            let message = format!(
                "no whole number of steps of {step:?} s leads to the samples of `{memory}`, every {period:?} s{from}"
            );
            errors.push(
                Diagnostic::new(span, message).help("take a step of which periods and offsets are multiples"),
            );
        }
    }
}
