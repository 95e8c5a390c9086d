//! `mbs explain`: the equations of a mechanism, how they are eliminated, what
//! that costs.

use std::fmt::Write;

use clap::{Arg, ArgAction, ArgMatches, Command};
use mbs_runtime::{Derivation, Formula, Info};

use crate::StartValue;
use crate::models::Models;
use crate::number::significant;
use crate::{Error, Model, Table, say};

pub(crate) fn command() -> Command {
    Command::new("explain")
        .about("Print a mechanism's equations, their elimination and its cost")
        .arg(Arg::new("mechanism").required(true).help("its name, see `list`"))
        .arg(
            Arg::new("latex")
                .long("latex")
                .action(ArgAction::SetTrue)
                .help("print the equations as a LaTeX document"),
        )
}

pub(crate) fn run(models: &Models, matches: &ArgMatches) -> Result<(), Error> {
    let name = matches.get_one::<String>("mechanism").map_or("", String::as_str);
    let found = models.find(name)?;
    let model = found.model();
    let (info, derivation) = (model.info(), model.derivation());
    let text = if matches.get_flag("latex") {
        latex(info, derivation)
    } else {
        plain(info, derivation) + &start(&model.start_values()?)
    };
    say(text.trim_end())
}

/// The heading of what is not integrated, which is shown where there is any.
const GIVEN: &str = "Coordinates that constraints give; the others are integrated";

/// A heading, what stands under it, and how its formulas are called.
type Section = (&'static str, &'static [Formula], fn(&Formula) -> (String, String));

fn sections(derivation: &'static Derivation) -> [Section; 8] {
    [
        (GIVEN, derivation.given, |f| (f.of.to_owned(), f.of_latex.to_owned())),
        ("Constraints Φ(q, t) = 0", derivation.phi, |f| named("Φ", r"\Phi", f)),
        ("Jacobian Φ_q", derivation.phi_q, |f| {
            let latex = format!(
                r"\frac{{\partial \Phi_{{\mathrm{{{}}}}}}}{{\partial {}}}",
                escaped(f.of),
                f.by_latex
            );
            (format!("∂{}/∂{}", f.of, f.by), latex)
        }),
        ("Partial time derivative Φ_t; velocities satisfy Φ_q v = −Φ_t", derivation.phi_t, |f| {
            named("Φ_t", r"\Phi_t", f)
        }),
        (
            "γ = −(Φ_q v)_q v − 2Φ_qt v − Φ_tt; accelerations satisfy Φ_q q̈ = γ",
            derivation.gamma,
            |f| named("γ", r"\gamma", f),
        ),
        ("Mass matrix M, its diagonal", derivation.mass, |f| {
            (format!("M[{}]", f.of), format!("M_{{{}}}", f.of_latex))
        }),
        ("Generalized forces Q", derivation.forces, |f| {
            (format!("Q[{}]", f.of), format!("Q_{{{}}}", f.of_latex))
        }),
        ("Energies", &[], |_| (String::new(), String::new())),
    ]
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

fn named(symbol: &str, latex: &str, formula: &Formula) -> (String, String) {
    let index = escaped(formula.of);
    (format!("{symbol}[{}]", formula.of), format!(r"{latex}^{{\mathrm{{{index}}}}}"))
}

fn escaped(name: &str) -> String {
    name.replace('_', r"\_")
}

fn energies(derivation: &Derivation) -> [(&'static str, Formula); 2] {
    [("T", derivation.kinetic_energy), ("V", derivation.potential_energy)]
}

fn plain(info: &Info, derivation: &'static Derivation) -> String {
    let mut text = format!("{}\n", info.name);
    for line in info.doc.trim().lines() {
        let _ = writeln!(text, "  {}", line.trim());
    }
    let (n, m) = (info.coordinates.len(), info.constraints.len());
    let _ = writeln!(
        text,
        "\n{n} coordinates, {m} constraints, {} degrees of freedom.\n\
         M q̈ + Φ_qᵀ λ = Q,  Φ_q q̈ = γ − 2αΦ̇ − β²Φ;  SI units, angles in radians.",
        info.dof
    );
    for (heading, formulas, name) in sections(derivation) {
        let mut lines: Vec<_> = formulas.iter().map(|formula| (name(formula).0, formula.text)).collect();
        if heading == GIVEN && lines.is_empty() {
            continue;
        }
        if heading == "Energies" {
            lines = energies(derivation).map(|(name, formula)| (name.to_owned(), formula.text)).into();
        }
        let width = lines.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0);
        let _ = write!(text, "\n{heading}\n");
        if lines.is_empty() {
            text.push_str("  all 0\n");
        }
        for (name, formula) in lines {
            let _ = writeln!(text, "  {name:width$} = {formula}");
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

/// The declared start, and by how much the constraints move it.
fn start(values: &[StartValue]) -> String {
    let mut table = Table::new(["", "declared", "starts at", "moved by", ""]);
    for StartValue { name, declared, kept, unit } in values {
        let [declared, kept, moved] = [*declared, *kept, kept - declared].map(|value| significant(value, 6));
        table.row([name, &declared, &kept, &moved, unit]);
    }
    let mut text = String::new();
    section(&mut text, "Start, made consistent with the constraints", &table);
    text
}

fn section(text: &mut String, heading: &str, table: &Table) {
    let _ = write!(text, "\n{heading}\n");
    for line in table.to_string().lines().filter(|line| !line.trim().is_empty()) {
        let _ = writeln!(text, "  {line}");
    }
}

/// Headings with their formulas in LaTeX, both sides of each; headings without any are left out.
pub(crate) fn typeset(
    derivation: &'static Derivation,
) -> impl Iterator<Item = (&'static str, Vec<(String, &'static str)>)> {
    let sections = sections(derivation).into_iter().map(|(heading, formulas, name)| {
        let mut lines: Vec<_> = formulas.iter().map(|formula| (name(formula).1, formula.latex)).collect();
        if heading == "Energies" {
            lines = energies(derivation).map(|(name, formula)| (name.to_owned(), formula.latex)).into();
        }
        (heading, lines)
    });
    sections.filter(|(_, lines)| !lines.is_empty())
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
