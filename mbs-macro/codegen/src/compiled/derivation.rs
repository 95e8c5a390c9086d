//! The equations and their elimination as texts.

use mbs_symbolic::{Arena, Expr, Strategy, Symbol, Unknown, latex_name};

use crate::derive::Equations;
use crate::model::{Clock, Meaning, Model};
use crate::plan::Plan;

/// Formulas with more parts than this are not written out: nobody reads on.
const LONGEST_FORMULA: usize = 500;

/// The same of a formula in the middle of a line.
const LONGEST_IN_A_LINE: usize = 60;

/// The equations and their elimination, for people to read.
pub struct Derivation {
    /// The coordinates that constraints give, by those that are integrated.
    pub given: Vec<Formula>,
    /// Φ; of an equation between rates Φ̇, its derivative by t.
    pub phi: Vec<Formula>,
    /// The entries of Φ_q that are not 0, row by row.
    pub phi_q: Vec<Formula>,
    /// Φ_t
    pub phi_t: Vec<Formula>,
    /// Φ̇
    pub phi_dot: Vec<Formula>,
    /// γ
    pub gamma: Vec<Formula>,
    /// The diagonal of M, and its other entries that are not 0, each once.
    pub mass: Vec<Formula>,
    /// Q
    pub forces: Vec<Formula>,
    /// The rates of own states.
    pub rates: Vec<Formula>,
    /// The values that clocks set memories to, each by the period of its clock.
    pub samples: Vec<Formula>,
    /// True if neither constraints, potentials nor declared forces depend on time, velocities, states, reactions or
    /// inputs: then only forces of places without a potential change the energy.
    pub keeps_energy: bool,
    /// ½ vᵀMv
    pub kinetic_energy: Formula,
    /// That of gravity and springs.
    pub potential_energy: Formula,
    /// The values that depend on parameters alone, as text.
    pub hoisted: Vec<String>,
    /// In which order pivots are taken, in words.
    pub strategy: &'static str,
    /// The steps of the elimination.
    pub order: Vec<Elimination>,
}

/// A formula as text and as LaTeX, or `…` where it is too long to read.
pub struct Formula {
    /// Whose formula it is: a constraint, a coordinate or a letter.
    pub of: String,
    /// The same in LaTeX.
    pub of_latex: String,
    /// The name of the variable that it is a derivative by; empty where it is none.
    pub by: String,
    /// The same in LaTeX.
    pub by_latex: String,
    /// As text.
    pub text: String,
    /// As LaTeX.
    pub latex: String,
    /// True if it is 0.
    pub is_zero: bool,
}

/// A step of the elimination.
pub struct Elimination {
    /// The eliminated unknowns: coordinates, and multipliers as `lambda(row)`.
    pub unknowns: Vec<String>,
    /// The divisor as text.
    pub pivot: String,
    /// The divisor as LaTeX.
    pub latex: String,
    /// The divisor as text, or `…` if it is too long for a line.
    pub short: String,
    /// True if this pivot may vanish and is watched.
    pub is_watched: bool,
}

/// A formula, unless it is too long for a reader.
pub fn readable(arena: &Arena, expr: Expr) -> String {
    arena.display_within(expr, LONGEST_FORMULA)
}

impl Derivation {
    /// The texts of these equations.
    pub(super) fn new(model: &Model, equations: &Equations, plan: &Plan) -> Self {
        let arena = &model.arena;
        let row_name = |at: usize| model.constraints[at].name.as_str();
        let coordinate_name = |at: usize| model.coordinates[at].quantity.name.as_str();
        let rows = |exprs: &[Expr]| {
            exprs.iter().enumerate().map(|(at, &expr)| formula(arena, row_name(at), "", expr)).collect()
        };
        let declared = model.constraints.iter().map(|row| match row.rate {
            Some(rate) => formula(arena, &row.name, "t", rate),
            None => formula(arena, &row.name, "", row.phi),
        });
        let coordinates = |exprs: &[Expr]| {
            exprs
                .iter()
                .enumerate()
                .map(|(at, &expr)| formula(arena, coordinate_name(at), "", expr))
                .collect()
        };
        let entries = equations
            .phi_q
            .iter()
            .enumerate()
            .flat_map(|(row, entries)| entries.iter().map(move |(&column, &entry)| (row, column, entry)));
        let lines = model.line_count();
        let rates = equations.total_forces.iter().enumerate().skip(lines);
        let given = plan.reduction.given(model);
        let given = given.into_iter().map(|(at, value)| formula(arena, coordinate_name(at), "", value));
        Self {
            given: given.collect(),
            phi: declared.collect(),
            phi_q: entries
                .map(|(row, column, entry)| formula(arena, row_name(row), coordinate_name(column), entry))
                .collect(),
            phi_t: rows(&equations.phi_t),
            phi_dot: rows(&equations.phi_dot),
            gamma: rows(&equations.gamma),
            mass: masses(model, equations),
            forces: coordinates(&equations.total_forces[..lines]),
            rates: rates.map(|(at, &rate)| formula(arena, coordinate_name(at), "", rate)).collect(),
            samples: model.clocks.iter().flat_map(|clock| samples(model, clock)).collect(),
            keeps_energy: keeps_energy(model, equations),
            kinetic_energy: formula(arena, "T", "", equations.kinetic_energy),
            potential_energy: formula(arena, "V", "", equations.potential_energy),
            hoisted: plan.hoisted.iter().map(|&value| readable(arena, value)).collect(),
            strategy: strategy(plan.strategy),
            order: (plan.order.iter().filter(|step| !is_of_state(model, step)))
                .map(|step| elimination(model, plan, step))
                .collect(),
        }
    }
}

fn masses(model: &Model, equations: &Equations) -> Vec<Formula> {
    let name = |at: usize| model.coordinates[at].quantity.name.as_str();
    let lines = equations.mass.iter().enumerate().take(model.line_count());
    let diagonal = lines.map(|(at, &mass)| formula(&model.arena, name(at), "", mass));
    let couplings = equations.couplings.iter().map(|(&(i, j), &entry)| {
        let (of, of_latex) = (format!("{}, {}", name(i), name(j)), [i, j].map(|at| latex_name(name(at))));
        Formula { of_latex: of_latex.join(", "), ..formula(&model.arena, &of, "", entry) }
    });
    diagonal.chain(couplings).collect()
}

fn keeps_energy(model: &Model, equations: &Equations) -> bool {
    let arena = &model.arena;
    let changes_it = |symbol: Symbol| {
        let meaning = model.meanings.get(symbol.index());
        !matches!(meaning, Some(Meaning::Coordinate(_) | Meaning::Parameter(_)))
    };
    let lines = equations.applied_forces.iter().take(model.line_count());
    let mut formulas = lines.chain([&equations.potential_energy]);
    // an impact may lose energy, and so does friction
    model.contacts().next().is_none()
        && equations.phi_t.iter().all(|&rate| arena.is_zero(rate))
        && !formulas.any(|&formula| arena.symbols_in(formula).into_iter().any(changes_it))
}

fn samples(model: &Model, clock: &Clock) -> impl Iterator<Item = Formula> {
    let arena = &model.arena;
    let period = readable(arena, clock.period);
    clock
        .sets
        .iter()
        .map(move |(memory, value)| formula(arena, &model.inputs[*memory].quantity.name, &period, *value))
}

fn formula(arena: &Arena, of: &str, by: &str, expr: Expr) -> Formula {
    Formula {
        of: of.to_owned(),
        of_latex: latex_name(of),
        by: by.to_owned(),
        by_latex: latex_name(by),
        text: readable(arena, expr),
        latex: arena.latex_within(expr, LONGEST_FORMULA),
        is_zero: arena.is_zero(expr),
    }
}

/// True if a step is about an own state, which is known without a division.
fn is_of_state(model: &Model, step: &mbs_symbolic::Elimination) -> bool {
    let is_own =
        |unknown: &Unknown| matches!(unknown, Unknown::Coordinate(at) if model.coordinates[*at].is_own());
    step.unknowns.iter().all(is_own)
}

fn elimination(model: &Model, plan: &Plan, step: &mbs_symbolic::Elimination) -> Elimination {
    let arena = &model.arena;
    // `theta1`, or `lambda(pin_x)` for the multiplier of a row
    let name = |&unknown: &Unknown| match unknown {
        Unknown::Coordinate(at) => model.coordinates[at].quantity.name.clone(),
        Unknown::Row(at) => format!("lambda({})", model.constraints[at].name),
    };
    let is_watched = |unknown: &Unknown| {
        plan.pivot_names.iter().any(|&(row, coordinate)| match *unknown {
            Unknown::Row(at) => row == Some(at),
            Unknown::Coordinate(at) => row.is_none() && coordinate == Some(at),
        })
    };
    let is_short = arena.is_shorter(step.pivot, LONGEST_IN_A_LINE);
    Elimination {
        unknowns: step.unknowns.iter().map(name).collect(),
        pivot: readable(arena, step.pivot),
        latex: arena.latex_within(step.pivot, LONGEST_FORMULA),
        short: if is_short { arena.display(step.pivot) } else { "…".to_owned() },
        is_watched: step.unknowns.iter().any(is_watched),
    }
}

fn strategy(strategy: Strategy) -> &'static str {
    match strategy {
        Strategy::NullSpace => "constraints first, then what motion they leave free (null space)",
        Strategy::Cheapest => "the locally cheapest safe pivot first (Markowitz)",
        Strategy::BothEnds => "masses first, then constraints, a chain from both ends at once",
    }
}
