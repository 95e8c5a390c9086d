//! Documentation of the generated items: the equations and what they cost.

use std::fmt::Write;

use crate::compiled::{Compiled, Count, Derivation, Elimination, Formula, FunctionId};
use crate::diagnostics::counted;

/// Longer listings are cut.
const LONGEST_LISTING: usize = 48;

/// The documentation of the mechanism itself.
pub fn mechanism(compiled: &Compiled) -> String {
    let mut text = compiled.doc.clone();
    let coordinates = counted(compiled.coordinates.len(), "coordinate");
    let constraints = counted(compiled.constraints.len(), "constraint");
    let independent = compiled.line_count as i32 - compiled.degrees_of_freedom;
    let redundant = match compiled.constraints.len() as i32 - independent {
        0 => String::new(),
        count => format!(" ({count} of them redundant)"),
    };
    let _ = write!(
        text,
        "\n\n# Equations\n\n{coordinates}, {constraints}{redundant}, {} of freedom.{} Φ(q, t) = 0 is\n",
        counted(compiled.degrees_of_freedom, "degree"),
        states(compiled)
    );
    let lines = compiled.constraints.iter().map(|row| format!("{}: {} = 0", row.name, row.formula));
    text.push_str(&listing(lines));
    let _ = write!(text, "\n# Elimination\n\nOrder: {}.\n\n", compiled.derivation.strategy);
    text.push_str(&listing(compiled.derivation.order.iter().map(elimination)));
    text.push_str("\n# Cost\n\n");
    let _ = writeln!(
        text,
        "Operations per call:\n\n| function | mul | add | div | sincos | other | pivot watch |\n|---|---|---|---|---|---|---|"
    );
    for Count { function, operations, watch } in compiled.counts() {
        let name = function.name();
        let mbs_symbolic::Operations { mul, add, div, sin_cos, other } = operations;
        let _ = writeln!(text, "| `{name}` | {mul} | {add} | {div} | {sin_cos} | {other} | {watch} |");
    }
    text
}

/// Which coordinates are integrated, where that is not all.
fn states(compiled: &Compiled) -> String {
    if !compiled.has_reduced_states() {
        return String::new();
    }
    let name = |&at: &usize| format!("`{}`", compiled.coordinates[at].name);
    match compiled.states.iter().map(name).collect::<Vec<_>>() {
        names if names.is_empty() => " Constraints give all coordinates.".to_owned(),
        names => format!(" Integrated: {}; constraints give the others.", names.join(", ")),
    }
}

/// `lambda(pin_x), x1: divided by 1`
fn elimination(step: &Elimination) -> String {
    format!("{}: divided by {}", step.unknowns.join(", "), step.short)
}

/// The documentation of the hoisted values: their formulas.
pub fn hoisted(compiled: &Compiled) -> String {
    let lines =
        compiled.derivation.hoisted.iter().enumerate().map(|(at, formula)| format!("{at}: {formula}"));
    format!("What depends on parameters alone, computed once:\n\n{}", listing(lines))
}

/// Documentation of the functions.
pub struct Functions<'a> {
    derivation: &'a Derivation,
    counts: Vec<Count>,
}

impl<'a> Functions<'a> {
    pub fn new(compiled: &'a Compiled) -> Self {
        Self { derivation: &compiled.derivation, counts: compiled.counts() }
    }

    /// The documentation of a function: its results, its formulas and its cost.
    pub fn of(&self, function: FunctionId) -> String {
        self.with_text(function, function.row().doc.trim())
    }

    /// The same with another text for its results.
    pub fn with_text(&self, function: FunctionId, text: &str) -> String {
        let Derivation { phi, phi_q, phi_t, gamma, mass, forces, .. } = self.derivation;
        let formulas: &[Formula] = match function {
            FunctionId::Phi => phi,
            FunctionId::PhiQ => phi_q,
            FunctionId::PhiT => phi_t,
            FunctionId::Gamma => gamma,
            FunctionId::Mass => mass,
            FunctionId::Forces => forces,
            _ => &[],
        };
        let mut text = text.to_owned();
        if !formulas.is_empty() {
            text.push_str("\n\n");
            text.push_str(&listing(formulas.iter().map(line)));
        }
        if let Some(count) = self.counts.iter().find(|count| count.function == function) {
            let _ = write!(text, "\n\nCost: {}.", count.operations);
        }
        text
    }
}

/// `rod: x^2 + y^2 - length^2`, or `∂rod/∂x = 2*x`
fn line(formula: &Formula) -> String {
    let Formula { of, by, text, .. } = formula;
    if by.is_empty() { format!("{of}: {text}") } else { format!("∂{of}/∂{by} = {text}") }
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
