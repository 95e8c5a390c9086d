//! The equations of a mechanism and how they are solved, for people to read.

/// The derived equations, as text in the notation of the language and as LaTeX.
///
/// A constant apart from [`Info`](crate::Info), so that a program that does not
/// show it does not carry it. Entries that are 0 are left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivation {
    /// The coordinates that are not integrated, by those that are.
    pub given: &'static [Formula],
    /// Φ, by constraint.
    pub phi: &'static [Formula],
    /// Φ_q, by constraint and coordinate.
    pub phi_q: &'static [Formula],
    /// Φ_t, by constraint.
    pub phi_t: &'static [Formula],
    /// Φ̇, by constraint.
    pub phi_dot: &'static [Formula],
    /// γ, by constraint.
    pub gamma: &'static [Formula],
    /// The diagonal of M by coordinate, and its other entries by pairs of coordinates.
    pub mass: &'static [Formula],
    /// Q, by coordinate.
    pub forces: &'static [Formula],
    /// The rates of the states of the declaration's own.
    pub rates: &'static [Formula],
    /// The values that clocks set memories to, by those before the sample; `by` is the period of the clock.
    pub samples: &'static [Formula],
    /// True if neither constraints, potentials nor declared forces depend on time, velocities, states, reactions or
    /// inputs. Forces that depend on places alone may still have no potential.
    pub keeps_energy: bool,
    /// The kinetic energy.
    pub kinetic_energy: Formula,
    /// The potential energy.
    pub potential_energy: Formula,
    /// In which order pivots are taken, in words.
    pub strategy: &'static str,
    /// The steps of the elimination, in order.
    pub order: &'static [Elimination],
}

/// A formula and what it is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Formula {
    /// The constraint or coordinate.
    pub of: &'static str,
    /// The same as LaTeX.
    pub of_latex: &'static str,
    /// The coordinate of a derivative; empty otherwise.
    pub by: &'static str,
    /// The same as LaTeX.
    pub by_latex: &'static str,
    /// The formula in the notation of the language.
    pub text: &'static str,
    /// The formula as LaTeX, for math mode.
    pub latex: &'static str,
}

/// A step of the elimination.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Elimination {
    /// The unknowns that it eliminates: coordinates (their accelerations) and
    /// multipliers, `lambda(row)`.
    pub unknowns: &'static [&'static str],
    /// The pivot that the step divides by.
    pub pivot: &'static str,
    /// The pivot as LaTeX.
    pub latex: &'static str,
    /// True if the pivot may vanish, and is watched.
    pub is_watched: bool,
}
