//! The equations of a mechanism under their headings, for texts and pages.

use mbs_runtime::{Derivation, Formula};

/// The heading of what is not integrated, which is shown where there is any.
pub(crate) const GIVEN: &str = "Coordinates that constraints give; the others are integrated";

/// The heading of the rates of own states, which is shown where there are such.
pub(crate) const RATES: &str = "Rates of states";

/// The heading of what clocks set, which is shown where there are clocks.
pub(crate) const SAMPLES: &str = "Memories, from a sample of their clocks on";

/// A heading, what stands under it, and how its formulas are called.
pub(crate) type Section = (&'static str, &'static [Formula], fn(&Formula) -> (String, String));

pub(crate) fn sections(derivation: &'static Derivation) -> [Section; 10] {
    [
        (GIVEN, derivation.given, |f| (f.of.to_owned(), f.of_latex.to_owned())),
        ("Constraints Φ(q, t) = 0", derivation.phi, |f| match f.by {
            "" => named("Φ", r"\Phi", f),
            _ => named("Φ̇", r"\dot{\Phi}", f),
        }),
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
        ("Mass matrix M", derivation.mass, |f| (format!("M[{}]", f.of), format!("M_{{{}}}", f.of_latex))),
        ("Generalized forces Q", derivation.forces, |f| {
            (format!("Q[{}]", f.of), format!("Q_{{{}}}", f.of_latex))
        }),
        (RATES, derivation.rates, |f| (format!("der({})", f.of), format!(r"\dot{{{}}}", f.of_latex))),
        (SAMPLES, derivation.samples, |f| {
            (
                format!("{}, every {} s", f.of, f.by),
                format!(r"{}\ (\text{{every }} {})", f.of_latex, f.by_latex),
            )
        }),
        ("Energies", &[], |_| (String::new(), String::new())),
    ]
}

fn named(symbol: &str, latex: &str, formula: &Formula) -> (String, String) {
    let index = escaped(formula.of);
    (format!("{symbol}[{}]", formula.of), format!(r"{latex}^{{\mathrm{{{index}}}}}"))
}

/// A name as LaTeX takes it.
pub(crate) fn escaped(name: &str) -> String {
    name.replace('_', r"\_")
}

/// Kinetic and potential energy.
pub(crate) fn energies(derivation: &Derivation) -> [(&'static str, Formula); 2] {
    [("T", derivation.kinetic_energy), ("V", derivation.potential_energy)]
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
