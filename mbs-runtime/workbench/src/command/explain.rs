//! `mbs explain`: the equations of a mechanism, how they are eliminated, what
//! that costs.
//!
//! The command prints `DERIVATION` under the headings of `derivation.rs`, and the start.

use std::fmt::Write;

use clap::Args;
use mbs_runtime::{
    DeclaredFriction, DeclaredLock, DeclaredStop, DeclaredTransition, Derivation, Info, Knots, Switch,
};

use super::options::Named;
use crate::StartValue;
use crate::derivation::{GIVEN, RATES, SAMPLES, energies, escaped, sections, typeset};
use crate::models::Models;
use crate::number::{counted, significant};
use crate::settings::Start;
use crate::{Error, Model, StartKind, Table, Unit, say};

/// So many knots of a table are shown.
const MOST_KNOTS: usize = 6;

#[derive(Args)]
#[command(about = "Print a mechanism's equations, their elimination and its cost")]
pub(crate) struct Arguments {
    #[command(flatten)]
    model: Named,
    /// Print the equations as a LaTeX document
    #[arg(long)]
    latex: bool,
}

impl Arguments {
    pub fn run(&self, models: &Models) -> Result<(), Error> {
        let found = self.model.find(models)?;
        let model = found.model();
        let (info, derivation) = (model.info(), model.derivation());
        let text = if self.latex {
            latex(info, derivation)
        } else {
            let declared = Start { kind: StartKind::Declared, ..Start::of(model, &model.defaults())? };
            let run = model.start(&declared)?;
            let switches = switches(run.equations().switching());
            plain(info, derivation)
                + &switches
                + &stops(info)
                + &start(&model.start_values()?, info)
                + &inputs(info)
        };
        say(text.trim_end())
    }
}

impl dyn Model + '_ {
    /// The equations, their elimination and its cost, as text.
    pub fn explanation(&self) -> String {
        plain(self.info(), self.derivation())
    }

    /// The equations and their elimination as a LaTeX document.
    pub fn latex(&self) -> String {
        latex(self.info(), self.derivation())
    }
}

/// How many coordinates there are, and how many own states, if there are such.
pub(super) fn coordinates(info: &Info) -> String {
    let coordinates = counted(info.lines, "coordinate");
    match info.coordinates.len() - info.lines {
        0 => coordinates,
        states => format!("{coordinates}, {}", counted(states, "state")),
    }
}

fn plain(info: &Info, derivation: &'static Derivation) -> String {
    let mut text = format!("{}\n", info.name);
    for line in info.doc.trim().lines() {
        let _ = writeln!(text, "  {}", line.trim());
    }
    let has_rates = info.constraints.iter().any(|row| row.is_rate);
    let _ = writeln!(
        text,
        "\n{}, {}, {} of freedom.\n\
         M q̈ + Φ_qᵀ λ = Q,  Φ_q q̈ = γ − 2αΦ̇ − β²Φ{};  SI units, angles in radians.",
        coordinates(info),
        counted(info.constraints.len(), "constraint"),
        counted(info.dof, "degree"),
        if has_rates { ", γ − αΦ̇ of rates" } else { "" },
    );
    for (heading, formulas, name) in sections(derivation) {
        let mut lines: Vec<_> = formulas.iter().map(|formula| (name(formula).0, formula.text)).collect();
        if [GIVEN, RATES, SAMPLES].contains(&heading) && lines.is_empty() {
            continue;
        }
        if heading == "Energies" {
            lines = energies(derivation).map(|(name, formula)| (name.to_owned(), formula.text)).into();
        }
        let width = lines.iter().map(|(name, _)| columns(name)).max().unwrap_or(0);
        let _ = write!(text, "\n{heading}\n");
        if lines.is_empty() {
            text.push_str("  all 0\n");
        }
        for (name, formula) in lines {
            let room = width - columns(&name);
            let _ = writeln!(text, "  {name}{:room$} = {formula}", "");
        }
    }
    let mut table = Table::new(["", "unknowns", "divided by", ""]);
    for (at, step) in derivation.order.iter().enumerate() {
        let watched = if step.is_watched { "watched" } else { "" };
        table.row([&(at + 1).to_string(), &step.unknowns.join(", "), step.pivot, watched]);
    }
    section(&mut text, &format!("Elimination: {}", derivation.strategy), &table);
    let mut table =
        Table::new(["function", "mul", "add", "div", "sincos", "other", "watch", "written", "loops"]);
    for function in info.functions {
        let o = function.operations;
        let counts = [o.mul, o.add, o.div, o.sin_cos, o.other, o.watch, function.written, function.loops]
            .map(|count| count.to_string());
        table.row(std::iter::once(function.name).chain(counts.iter().map(String::as_str)));
    }
    section(&mut text, "Operations per call, instructions as written, and loops over repeated parts", &table);
    text
}

/// Where laws bend or jump, beside times; nothing where none does.
fn switches(switching: &[Switch]) -> String {
    let mut text = String::new();
    if switching.is_empty() {
        return text;
    }
    let mut table = Table::new(["", "at"]);
    for Switch { name, knots: Knots { at, period, .. } } in switching {
        let mut knots = match at {
            [first, .., last] if at.len() > MOST_KNOTS => {
                format!("{} points from {} to {}", at.len(), significant(*first, 6), significant(*last, 6))
            }
            _ => at.iter().map(|knot| significant(*knot, 6)).collect::<Vec<_>>().join(", "),
        };
        if *period > 0.0 {
            let _ = write!(knots, ", every {}", significant(*period, 6));
        }
        table.row([*name, &knots]);
    }
    section(&mut text, "Switches: laws bend or jump where these values pass", &table);
    text
}

/// The ends of the way; nothing without one.
fn stops(info: &Info) -> String {
    let mut text = String::new();
    if !info.frictions.is_empty() {
        let mut table = Table::new(["", "sliding", "sticking, at most"]);
        for DeclaredFriction { name, limits, stop, .. } in info.frictions {
            let of = stop.and_then(|stop| info.stops.get(stop));
            let limits = limits.map(|limit| match of {
                Some(stop) => format!("({limit}) × force at {}", stop.name),
                None => limit.to_owned(),
            });
            table.row([*name, &limits[0], &limits[1]]);
        }
        let title = "Friction that sticks: its size while it slides, and the largest one with which it holds";
        section(&mut text, title, &table);
    }
    modes(info, &mut text);
    if info.stops.is_empty() {
        return text;
    }
    let mut table = Table::new(["", "gap", "unit"]);
    for DeclaredStop { name, formula, unit, .. } in info.stops {
        table.row([*name, *formula, *unit]);
    }
    section(
        &mut text,
        "Stops: these gaps are never negative; runs to a tolerance end a step where one closes",
        &table,
    );
    text
}

/// The constraints that come and go, and what is set at which moment; nothing without one.
fn modes(info: &Info, text: &mut String) {
    let memory = |at: usize| info.inputs.get(at).map_or("", |input| input.name);
    if !info.modes.locks.is_empty() {
        let mut table = Table::new(["", "of the mode", "at first", "is 0 while it holds"]);
        for DeclaredLock { name, mode, formula, .. } in info.modes.locks {
            let holds = info.inputs.get(*mode).is_some_and(|mode| mode.default > 0.5);
            table.row([*name, memory(*mode), if holds { "holds" } else { "" }, *formula]);
        }
        section(
            text,
            "Modes: constraints that come and go; a right-hand side has a part of those that hold",
            &table,
        );
    }
    if !info.modes.transitions.is_empty() {
        let mut table = Table::new(["where this begins to hold", "these are set"]);
        for (at, DeclaredTransition { condition, .. }) in info.modes.transitions.iter().enumerate() {
            let own = info.sampling.samples.iter().filter(|[of, _]| *of == info.sampling.clocks + at);
            let names: Vec<&str> = own.map(|[_, at]| memory(*at)).collect();
            table.row([*condition, &names.join(", ")]);
        }
        section(text, "Transitions", &table);
    }
}

/// The columns that a name takes: a dot over a letter takes none.
fn columns(name: &str) -> usize {
    name.chars().filter(|letter| *letter != '\u{307}').count()
}

/// The declared start, and by how much the constraints move it.
fn start(values: &[StartValue], info: &Info) -> String {
    let mut table = Table::new(["", "declared", "starts at", "moved by", ""]);
    // integrals of own states begin at 0
    let integrals = info.lines..info.coordinates.len();
    let shown = values.iter().enumerate().filter(|(at, _)| !integrals.contains(at));
    for (_, StartValue { name, declared, kept, unit }) in shown {
        let [declared, kept, moved] = [*declared, *kept, kept - declared].map(|value| significant(value, 6));
        table.row([name, &declared, &kept, &moved, unit]);
    }
    let mut text = String::new();
    section(&mut text, "Start, made consistent with the constraints", &table);
    text
}

/// The values with which inputs begin; nothing where all are 0.
fn inputs(info: &Info) -> String {
    let mut text = String::new();
    if info.free_inputs().iter().all(|input| input.default == 0.0) {
        return text;
    }
    let mut table = Table::new(["", "at first"]);
    for input in info.free_inputs() {
        table.row([input.name, &Unit::of(input).text(input.default, 6)]);
    }
    section(&mut text, "Inputs, until they are set", &table);
    text
}

fn section(text: &mut String, heading: &str, table: &Table) {
    let _ = write!(text, "\n{heading}\n");
    for line in table.to_string().lines().filter(|line| !line.trim().is_empty()) {
        let _ = writeln!(text, "  {line}");
    }
}

fn latex(info: &Info, derivation: &'static Derivation) -> String {
    let mut text = format!(
        "\\documentclass{{article}}\n\\usepackage{{amsmath}}\n\\allowdisplaybreaks\n\\begin{{document}}\n\\section*{{{}}}\n\
         \\[ M \\ddot q + \\Phi_q^T \\lambda = Q, \\qquad \\Phi_q \\ddot q = \\gamma - 2 \\alpha \\dot\\Phi - \\beta^2 \\Phi \\]\n",
        escaped(info.name)
    );
    for (heading, formulas) in typeset(derivation) {
        let lines: Vec<String> =
            formulas.iter().map(|(name, formula)| format!("{name} &= {formula}")).collect();
        let title = latex_title(heading);
        let _ = writeln!(
            text,
            "\\subsection*{{{title}}}\n\\begin{{align*}}\n{}\n\\end{{align*}}",
            lines.join(" \\\\\n")
        );
    }
    let _ = writeln!(text, "\\subsection*{{Elimination}}\n{}.\n\\begin{{enumerate}}", derivation.strategy);
    for step in derivation.order {
        let _ = writeln!(text, "\\item {}: divided by ${}$", escaped(&step.unknowns.join(", ")), step.latex);
    }
    text.push_str("\\end{enumerate}\n\\end{document}\n");
    text
}

/// Headings in letters that every LaTeX knows.
fn latex_title(heading: &str) -> String {
    let symbols = [("Φ_q", r"$\Phi_q$"), ("Φ_t", r"$\Phi_t$"), ("γ", r"$\gamma$")];
    let short = heading.split_once([';', '=']).map_or(heading, |(short, _)| short);
    let short = short.replace("Φ(q, t)", r"$\Phi(q, t)$");
    symbols.iter().fold(short, |text, (symbol, latex)| text.replace(symbol, latex)).trim().to_owned()
}
