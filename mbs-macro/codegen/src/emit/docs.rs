//! Documentation of the generated items: the equations and what they cost.

use std::fmt::Write;

use mbs_symbolic::units::{self, Dimension};
use mbs_symbolic::{Elimination, Expr, Strategy, Unknown};

use super::info::{FunctionCount, function_counts};
use crate::derive::Equations;
use crate::diagnostics::described;
use crate::model::{Model, Quantity};
use crate::plan::Plan;

/// Longer listings are cut.
const LONGEST_LISTING: usize = 48;

/// Formulas with more parts than this are not written out: nobody reads on.
pub const LONGEST_FORMULA: usize = 500;

/// The documentation of the mechanism itself.
pub fn mechanism(model: &Model, plan: &Plan, equations: &Equations) -> String {
    let mut text = model.doc.clone();
    let (n, m) = (model.coordinates.len(), model.constraints.len());
    let redundant = match plan.rows.redundant.len() {
        0 => String::new(),
        count => format!(" ({count} of them redundant)"),
    };
    let _ = write!(
        text,
        "\n\n# Equations\n\n{n} coordinates, {m} constraints{redundant}, {} degrees of freedom. Φ(q, t) = 0 is\n",
        n as i64 - plan.rows.basis.len() as i64
    );
    let rows = model.constraints.iter().zip(&equations.phi);
    let lines = rows.map(|(constraint, &phi)| format!("{}: {} = 0", constraint.name, formula(model, phi)));
    text.push_str(&listing(lines));
    let _ = write!(text, "\n# Elimination\n\nOrder: {}.\n\n", strategy(plan.strategy));
    text.push_str(&listing(plan.order.iter().map(|step| elimination(model, step))));
    text.push_str("\n# Cost\n\n");
    let _ = writeln!(
        text,
        "Operations per call:\n\n| function | mul | add | div | sincos | other | pivot watch |\n|---|---|---|---|---|---|---|"
    );
    for FunctionCount { name, operations, watch, .. } in function_counts(plan) {
        let mbs_symbolic::Operations { mul, add, div, sin_cos, other } = operations;
        let _ = writeln!(text, "| `{name}` | {mul} | {add} | {div} | {sin_cos} | {other} | {watch} |");
    }
    text
}

/// In which order pivots are taken, in words.
pub fn strategy(strategy: Strategy) -> &'static str {
    match strategy {
        Strategy::NullSpace => "constraints first, then what motion they leave free (null space)",
        Strategy::Cheapest => "the locally cheapest safe pivot first (Markowitz)",
    }
}

/// `lambda(pin_x), x1: divided by 1`
fn elimination(model: &Model, step: &Elimination) -> String {
    let unknowns: Vec<_> = step.unknowns.iter().map(|&unknown| unknown_name(model, unknown)).collect();
    format!("{}: divided by {}", unknowns.join(", "), short(model, step.pivot))
}

/// `theta1`, or `lambda(pin_x)` for the multiplier of a row.
pub fn unknown_name(model: &Model, unknown: Unknown) -> String {
    match unknown {
        Unknown::Coordinate(at) => model.coordinates[at].quantity.name.clone(),
        Unknown::Row(at) => format!("lambda({})", model.constraints[at].name),
    }
}

/// A formula, unless it is too long for a line.
fn short(model: &Model, expr: Expr) -> String {
    const LONGEST: usize = 60;
    if model.arena.is_shorter(expr, LONGEST) { model.arena.display(expr) } else { "…".to_owned() }
}

/// A formula, unless it is too long for a reader.
pub fn formula(model: &Model, expr: Expr) -> String {
    model.arena.display_within(expr, LONGEST_FORMULA)
}

/// What the hoisted values are.
pub fn hoisted(model: &Model, plan: &Plan) -> String {
    let formulas = plan.hoisted.iter().map(|&value| formula(model, value));
    let lines = formulas.enumerate().map(|(at, formula)| format!("{at}: {formula}"));
    format!("What depends on parameters alone, computed once:\n\n{}", listing(lines))
}

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

/// What a quantity is, with its article: `a length [m]`, `an angle [rad]`.
fn kind(quantity: &Quantity) -> String {
    let is_angle = |unit| units::lookup(unit).is_some_and(|unit| unit.dimension == Dimension::NONE);
    match quantity.dimension == Dimension::NONE {
        true if is_angle(&quantity.unit) => "an angle [rad]".to_owned(),
        true => "a bare number".to_owned(),
        false => described(quantity.dimension),
    }
}

/// Documentation of the functions.
pub struct Functions<'a> {
    model: &'a Model,
    equations: &'a Equations,
    counts: Vec<FunctionCount<'a>>,
}

impl<'a> Functions<'a> {
    pub fn new(model: &'a Model, equations: &'a Equations, plan: &'a Plan) -> Self {
        Self { model, equations, counts: function_counts(plan) }
    }

    pub fn phi(&self) -> String {
        let lines = self.rows(&self.equations.phi);
        self.finish("phi", "Constraints Φ(q, t): 0 where the mechanism is assembled.", lines)
    }

    pub fn phi_q(&self) -> String {
        let rows = self.model.constraints.iter().zip(&self.equations.phi_q);
        let lines = rows.flat_map(|(constraint, row)| {
            row.iter().map(|(&column, &entry)| {
                let coordinate = &self.model.coordinates[column].quantity.name;
                format!("∂{}/∂{coordinate} = {}", constraint.name, formula(self.model, entry))
            })
        });
        let text = "Jacobian Φ_q, one row per constraint, one column per coordinate. Entries that are not 0:";
        self.finish("phi_q", text, lines)
    }

    pub fn phi_t(&self) -> String {
        let lines = self.rows(&self.equations.phi_t);
        self.finish("phi_t", "Partial time derivative Φ_t; velocities satisfy Φ_q v = −Φ_t.", lines)
    }

    pub fn gamma(&self) -> String {
        let lines = self.rows(&self.equations.gamma);
        let text = "γ = −(Φ_q v)_q v − 2Φ_qt v − Φ_tt, so that Φ_q q̈ = γ (Jiang 2025, Eq. 5).";
        self.finish("gamma", text, lines)
    }

    pub fn baumgarte_rhs(&self) -> String {
        let text = "γ − 2αΦ̇ − β²Φ, the right-hand side with feedback of the violation (Jiang 2025, Eq. 8); gains in 1/s.";
        self.finish("baumgarte_rhs", text, std::iter::empty())
    }

    pub fn mass(&self) -> String {
        let lines = self.coordinates(&self.equations.mass);
        self.finish("mass", "Mass matrix M. Its diagonal, all that is not 0:", lines)
    }

    pub fn forces(&self) -> String {
        let lines = self.coordinates(&self.equations.total_forces);
        self.finish("forces", "Generalized forces Q: gravity and applied loads.", lines)
    }

    pub fn accelerations(&self) -> String {
        let text = "Accelerations q̈ and multipliers λ from M q̈ + Φ_qᵀ λ = Q, Φ_q q̈ = γ, without feedback terms.\n\n\
                    In a singular position the result is not finite or its `growth` exceeds \
                    the runtime's `growth_limit`.";
        self.finish("reactions", text, std::iter::empty())
    }

    fn rows(&self, exprs: &[Expr]) -> impl Iterator<Item = String> {
        let rows = self.model.constraints.iter().zip(exprs);
        rows.map(|(constraint, &expr)| format!("{}: {}", constraint.name, formula(self.model, expr)))
    }

    fn coordinates(&self, exprs: &[Expr]) -> impl Iterator<Item = String> {
        let rows = self.model.coordinates.iter().zip(exprs);
        rows.map(|(c, &expr)| format!("{}: {}", c.quantity.name, formula(self.model, expr)))
    }

    fn finish(&self, function: &str, text: &str, lines: impl Iterator<Item = String>) -> String {
        let (mut text, mut lines) = (text.to_owned(), lines.peekable());
        if lines.peek().is_some() {
            text.push_str("\n\n");
            text.push_str(&listing(lines));
        }
        if let Some(count) = self.counts.iter().find(|count| count.name == function) {
            let _ = write!(text, "\n\nCost: {}.", count.operations);
        }
        text
    }
}

/// Lines as a text block, cut where it would be too long to read.
fn listing(mut lines: impl Iterator<Item = String>) -> String {
    let mut text = String::from("```text\n");
    for line in lines.by_ref().take(LONGEST_LISTING) {
        let _ = writeln!(text, "{line}");
    }
    let rest = lines.count();
    if rest > 0 {
        let _ = writeln!(text, "… and {rest} more");
    }
    text.push_str("```\n");
    text
}
