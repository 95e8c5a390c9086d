//! The words of targets for quantities, pivots and errors of runs.

use std::fmt::Write;

use mbs_symbolic::units::{self, Dimension};

use crate::compiled::{Compiled, Pivot, Quantity, Setting};
use crate::diagnostics::described;

/// A quantity with its unit and declared value.
pub fn quantity(quantity: &Quantity, declared: Option<f64>) -> String {
    let mut text = quantity.doc.clone();
    if !text.is_empty() {
        text.push_str("\n\n");
    }
    let what = kind(quantity);
    match declared {
        Some(value) if quantity.unit.is_empty() => {
            let _ = write!(text, "`{}`: {what}, declared as {value}.", quantity.name);
        }
        Some(value) => {
            let _ = write!(
                text,
                "`{}`: {what}, declared as {} {} = {value} in SI units.",
                quantity.name,
                value / quantity.scale,
                quantity.unit
            );
        }
        None => {
            let _ = write!(text, "`{}`: {what}.", quantity.name);
        }
    }
    text
}

/// An input with its unit, and with its value at first unless that is 0.
pub fn input(Setting { quantity: of, value }: &Setting) -> String {
    quantity(of, (*value != 0.0).then_some(*value))
}

/// A coordinate, or an own state and where it stands.
pub fn coordinate(compiled: &Compiled, at: usize) -> String {
    let text = compiled.coordinates.get(at).map_or_else(String::new, |it| quantity(it, None));
    if at < compiled.line_count {
        return text;
    }
    format!("{text} An own state: its value stands among velocities, its integral among positions.")
}

/// The kind of a quantity, with its article: `a length [m]`, `an angle [rad]`.
fn kind(quantity: &Quantity) -> String {
    let is_angle = |unit| units::lookup(unit).is_some_and(|unit| unit.dimension == Dimension::NONE);
    match quantity.dimension == Dimension::NONE {
        true if is_angle(&quantity.unit) => "an angle [rad]".to_owned(),
        true => "a bare number".to_owned(),
        false => described(quantity.dimension),
    }
}

/// The names of a watched pivot: of its constraint, of its coordinate, or of both.
pub fn pivot(Pivot { constraint, coordinate }: &Pivot) -> String {
    let between = if constraint.is_empty() || coordinate.is_empty() { "" } else { " of " };
    format!("{constraint}{between}{coordinate}")
}

/// The errors of runs that targets print: code and words. Those of parameters and of conditions follow
/// in C, one for each.
pub fn errors() -> impl Iterator<Item = (&'static str, &'static str)> {
    include_str!("errors.txt").lines().filter_map(|line| line.split_once(": "))
}
