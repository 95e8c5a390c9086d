//! Hints at formulas that were meant otherwise.

use crate::diagnostics::Diagnostic;
use crate::syntax::{Formula, FormulaKind, Operator};

/// `0.052/3 [kg]` divides by 3 kg: a unit belongs to the number before it.
pub(super) fn unit_help_for_products(formula: &Formula) -> Option<String> {
    let FormulaKind::Chain { rest, .. } = &formula.kind else { return None };
    let last = rest.last().filter(|last| matches!(last.op, Operator::Times | Operator::Over))?;
    let FormulaKind::Number { unit: Some(unit), .. } = &last.operand.kind else { return None };
    Some(format!("the unit belongs to the number before it alone; write `( … ) [{}]`", unit.text))
}

/// More than a turn, in radians and rounded.
const TURN: f64 = 6.3;

/// A bare number that is an angle is in radians. One of more than a turn is
/// taken for degrees without their unit.
///
/// # Errors
/// That, with both ways to write it.
pub(super) fn in_radians(formula: &Formula) -> Result<(), Diagnostic> {
    let (sign, number) = match &formula.kind {
        FormulaKind::Negative(inner) => ("-", &inner.kind),
        kind => ("", kind),
    };
    let FormulaKind::Number { value, unit: None } = number else { return Ok(()) };
    let value = value.to_f64();
    // the number of a copy, as in `sin(i)`, is not written as one
    let text = formula.span.source_text();
    let is_written = text.is_some_and(|text| text.starts_with(|c: char| c.is_ascii_digit() || c == '-'));
    if value <= TURN || !is_written {
        return Ok(());
    }
    let message = "this angle is more than a turn: a bare number is in radians";
    let help = format!("write `{sign}{value} [deg]`, or `{sign}{value} [rad]`");
    Err(Diagnostic::new(formula.span, message).help(help))
}
