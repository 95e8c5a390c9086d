//! Equations to programs: the elimination is fixed, what depends on parameters
//! alone is hoisted, and every function has its instructions.

mod correction;
mod minimum_norm;
mod step;

use std::collections::{BTreeMap, BTreeSet, HashMap};

use mbs_symbolic::{
    Elimination, Expr, Factorization, Hoisted, Inconsistency, Kkt, Program, Strategy, Undetermined, Unknown,
    WatchedPivot, factor_within, lower, lower_whole,
};

use crate::derive::Equations;
use crate::independence::{Rows, Samples};
use crate::inputs::Inputs;
use crate::model::{Direction, Model};
use crate::reactive::{self, Circular, Forces};
use correction::correction;
pub use step::{FusedStep, Kinds};

/// An order that changes more entries than this per unknown fills the matrix of a
/// chain, and is given up.
const LARGEST_FILL: usize = 24;

/// The programs of all generated functions.
pub struct Plan {
    /// What the symbols of its programs stand for.
    pub inputs: Inputs,
    pub strategy: Strategy,
    /// The steps of the elimination, in order.
    pub order: Vec<Elimination>,
    pub rows: Rows,
    /// What depends on parameters alone, as formulas.
    pub hoisted: Vec<Expr>,
    /// Computes the hoisted values.
    pub prepare: Program,
    /// left − right and value of every requirement, then masses and inertias,
    /// then properties of elements.
    pub requirements: Program,
    /// Declared positions, velocities and time of the start.
    pub start: Program,
    pub phi: Program,
    pub phi_dot: Program,
    /// The entries of Φ_q that are not 0, row by row.
    pub phi_q: Program,
    /// Row and column of each.
    pub phi_q_places: Vec<(usize, usize)>,
    pub phi_t: Program,
    pub gamma: Program,
    pub baumgarte_rhs: Program,
    /// The diagonal of M.
    pub mass: Program,
    pub forces: Program,
    pub kinetic_energy: Program,
    pub potential_energy: Program,
    /// q̈, feedback, growth
    pub stabilized: Program,
    /// q̈, growth
    pub constrained: Program,
    /// q̈, λ, growth
    pub reactions: Program,
    /// Δq, growth
    pub position_correction: Program,
    /// Δv, growth
    pub velocity_correction: Program,
    /// A whole step, of a mechanism that is small enough.
    pub fused_step: Option<FusedStep>,
    /// Growth of every watched pivot.
    pub pivots: Program,
    /// The same of the corrections of a start.
    pub start_pivots: Program,
    pub outputs: Program,
    /// x and y of every point of the sketch.
    pub points: Program,
    /// (constraint, coordinate) of every watched pivot.
    pub pivot_names: Vec<(Option<usize>, Option<usize>)>,
    pub start_pivot_names: Vec<(Option<usize>, Option<usize>)>,
}

impl Plan {
    /// What one evaluation of a step's right-hand side takes, the watch over the
    /// pivots included.
    pub fn operations(&self) -> u32 {
        self.stabilized.operations().total()
    }
}

/// Why there is no plan.
#[derive(Debug)]
pub enum Unsolvable {
    /// Unknowns that no pivot determines; `verify` has already seen to it that
    /// there are none where the constraints are independent.
    Unknowns(Undetermined),
    /// A load that is undetermined by the reactions on which it depends.
    Load(Circular),
    /// A load that depends on reactions which redundant constraints share.
    Shared,
    /// A mistake of the compiler.
    Inconsistent(Inconsistency),
}

impl From<Inconsistency> for Unsolvable {
    fn from(mistake: Inconsistency) -> Self {
        Self::Inconsistent(mistake)
    }
}

impl From<Undetermined> for Unsolvable {
    fn from(unknowns: Undetermined) -> Self {
        Self::Unknowns(unknowns)
    }
}

impl From<Circular> for Unsolvable {
    fn from(load: Circular) -> Self {
        Self::Load(load)
    }
}

/// Plans all functions. The accelerations and corrections are solved for with
/// the independent constraints; the redundant ones have their share of the
/// multipliers.
///
/// # Errors
/// What the equations of motion leave open.
pub fn plan(
    model: &mut Model,
    equations: &Equations,
    rows: &Rows,
    samples: &Samples,
    inputs: Inputs,
) -> Result<Plan, Unsolvable> {
    if rows.basis.len() < equations.phi.len() && !model.reactive_loads.is_empty() {
        return Err(Unsolvable::Shared);
    }
    let unknowns = samples.undetermined(model, equations, &rows.basis);
    if !unknowns.is_empty() {
        let unknowns = unknowns.into_iter().map(Unknown::Coordinate).collect();
        return Err(Undetermined { unknowns }.into());
    }
    label(model, equations);
    let Solver { strategy, factorization, forces } = cheapest(model, equations, rows)?;
    let (positions, mut start_pivots) =
        correction(model, equations, rows, strategy, (samples, &inputs), false)?;
    let (velocities, more) = correction(model, equations, rows, strategy, (samples, &inputs), true)?;
    start_pivots.extend(
        more.into_iter()
            .filter(|new| start_pivots.iter().all(|old| old.growth != new.growth))
            .collect::<Vec<_>>(),
    );

    let mut hoisted = Hoisted::default();
    let entries = || {
        let rows = equations.phi_q.iter().enumerate();
        rows.flat_map(|(row, entries)| entries.iter().map(move |(&column, &entry)| ((row, column), entry)))
    };
    let rhs: Vec<Expr> = equations
        .gamma
        .iter()
        .zip(&equations.feedback)
        .map(|(&gamma, &feedback)| model.arena.add(gamma, feedback))
        .collect();
    let stabilized = stabilized(model, equations, rows, &forces, &factorization);
    let (constrained, reactions) =
        with_given_feedback(model, equations, rows, (&forces, &inputs), &factorization);
    let growths = |pivots: &[WatchedPivot]| pivots.iter().map(|pivot| pivot.growth).collect::<Vec<_>>();
    let names = |pivots: &[WatchedPivot]| pivots.iter().map(|pivot| (pivot.row, pivot.coordinate)).collect();
    let outputs: Vec<Expr> = model.outputs.iter().map(|output| output.value).collect();

    let unrolled = model.solver.unrolled();
    let mut program = |roots: &[Expr]| lower(&mut model.arena, roots, &mut hoisted, unrolled);
    let plan = Plan {
        inputs,
        strategy,
        order: factorization.order.clone(),
        rows: rows.clone(),
        phi: program(&equations.phi)?,
        phi_dot: program(&equations.phi_dot)?,
        phi_q: program(&entries().map(|(_, entry)| entry).collect::<Vec<_>>())?,
        phi_q_places: entries().map(|(place, _)| place).collect(),
        phi_t: program(&equations.phi_t)?,
        gamma: program(&equations.gamma)?,
        baumgarte_rhs: program(&rhs)?,
        mass: program(&equations.mass)?,
        forces: program(&forces.values)?,
        kinetic_energy: program(&[equations.kinetic_energy])?,
        potential_energy: program(&[equations.potential_energy])?,
        stabilized: program(&stabilized)?,
        constrained: program(&constrained)?,
        reactions: program(&reactions)?,
        position_correction: program(&positions)?,
        velocity_correction: program(&velocities)?,
        pivots: program(&growths(&factorization.pivots))?,
        start_pivots: program(&growths(&start_pivots))?,
        outputs: program(&outputs)?,
        hoisted: Vec::new(),
        prepare: Program::default(),
        requirements: Program::default(),
        start: Program::default(),
        points: Program::default(),
        fused_step: None,
        pivot_names: names(&factorization.pivots),
        start_pivot_names: names(&start_pivots),
    };
    let stages = step::Stages {
        stabilized: &plan.stabilized,
        constrained: &plan.constrained,
        reactions: &plan.reactions,
    };
    let requirements = requirements(model, equations);
    let start = declared_start(model);
    let points = model.sketch.places(&mut model.arena);
    Ok(Plan {
        fused_step: step::fused(model, &plan.inputs, stages)?,
        prepare: lower_whole(&mut model.arena, hoisted.values(), unrolled)?,
        hoisted: hoisted.values().to_vec(),
        requirements: lower_whole(&mut model.arena, &requirements, unrolled)?,
        start: lower_whole(&mut model.arena, &start, unrolled)?,
        // Pictures are no reason to carry more hoisted values through a step.
        points: lower_whole(&mut model.arena, &points, unrolled)?,
        ..plan
    })
}

/// Names for values in generated code.
fn label(model: &mut Model, equations: &Equations) {
    for (at, constraint) in model.constraints.iter().enumerate() {
        for (prefix, expr) in [
            ("phi", equations.phi[at]),
            ("phi_dot", equations.phi_dot[at]),
            ("gamma", equations.gamma[at]),
            ("feedback", equations.feedback[at]),
        ] {
            model.arena.label(expr, &format!("{prefix}_{}", constraint.name));
        }
        for (&column, &entry) in &equations.phi_q[at] {
            let coordinate = &model.coordinates[column].quantity.name;
            model.arena.label(entry, &format!("phi_q_{}_{coordinate}", constraint.name));
        }
    }
}

/// The constrained system with the coordinates in `held` left out.
fn system(model: &Model, equations: &Equations, rows: &Rows, held: &BTreeSet<usize>) -> Kkt {
    let mut kkt = Kkt::new();
    for (at, &mass) in equations.mass.iter().enumerate() {
        if held.contains(&at) {
            continue;
        }
        let unknown = Unknown::Coordinate(at);
        kkt.add_unknown(unknown);
        kkt.set(&model.arena, unknown, unknown, mass);
        if !model.arena.is_zero(mass) {
            kkt.mark_massive(at);
        }
        if model.coordinates[at].direction == Direction::Angle {
            kkt.mark_angle(at);
        }
    }
    for &at in &rows.basis {
        kkt.add_unknown(Unknown::Row(at));
        for (&column, &entry) in equations.phi_q[at].iter().filter(|(column, _)| !held.contains(column)) {
            kkt.set(&model.arena, Unknown::Row(at), Unknown::Coordinate(column), entry);
        }
    }
    if let Some(unit) = extreme_mass(model, equations) {
        kkt.set_mass_unit(unit.into());
    }
    kkt
}

/// Elimination multiplies up to four masses or their reciprocals: within these powers
/// of ten the products are doubles.
const LARGEST_MASS_EXPONENT: f64 = 60.0;

/// A power of two near the geometric mean of the declared masses and inertias, if that
/// is so large or so small that their products would leave the range of a double.
fn extreme_mass(model: &Model, equations: &Equations) -> Option<f64> {
    let masses = model.arena.evaluate(&equations.mass, &model.values(|_| f64::NAN));
    let exponents: Vec<f64> =
        masses.into_iter().filter(|mass| *mass > 0.0 && mass.is_finite()).map(f64::log10).collect();
    let mean = exponents.iter().sum::<f64>() / exponents.len() as f64;
    (mean.abs() > LARGEST_MASS_EXPONENT).then(|| (mean / 2_f64.log10()).round().exp2())
}

/// An eliminated system, and the forces that it is solved for.
struct Solver {
    strategy: Strategy,
    factorization: Factorization,
    forces: Forces,
}

/// The elimination that costs least in the function that runs most.
fn cheapest(model: &mut Model, equations: &Equations, rows: &Rows) -> Result<Solver, Unsolvable> {
    let kkt = system(model, equations, rows, &BTreeSet::new());
    let unknowns = model.coordinates.len() + model.constraints.len();
    let mut best: Option<(u32, Solver)> = None;
    let last = Strategy::ALL.len() - 1;
    for (at, strategy) in Strategy::ALL.into_iter().enumerate() {
        let most = match strategy {
            Strategy::NullSpace => LARGEST_FILL * unknowns,
            Strategy::Cheapest => usize::MAX,
        };
        let factorization = factor_within(&mut model.arena, &kkt, strategy, most)?;
        let Some(factorization) = factorization else { continue };
        let forces = reactive::forces(model, equations, &factorization)?;
        let solver = Solver { strategy, factorization, forces };
        if best.is_none() && at == last {
            // nothing to compare with
            return Ok(solver);
        }
        let roots = stabilized(model, equations, rows, &solver.forces, &solver.factorization);
        let program = lower(&mut model.arena, &roots, &mut Hoisted::default(), model.solver.unrolled())?;
        let cost = program.operations_for(roots.len() - 1).total();
        if best.as_ref().is_none_or(|(least, _)| cost < *least) {
            best = Some((cost, solver));
        }
    }
    best.map(|(_, solver)| solver).ok_or_else(|| Undetermined { unknowns: Vec::new() }.into())
}

/// q̈, the feedback and the growth, with feedback from the state.
fn stabilized(
    model: &mut Model,
    equations: &Equations,
    rows: &Rows,
    forces: &Forces,
    factorization: &Factorization,
) -> Vec<Expr> {
    // Shared, so that the function can hand out the very value it used.
    let feedback: Vec<Expr> = equations.feedback.iter().map(|&row| model.arena.share(row)).collect();
    let mut rhs: BTreeMap<Unknown, Expr> = BTreeMap::new();
    for (at, &force) in forces.values.iter().enumerate() {
        rhs.insert(Unknown::Coordinate(at), force);
    }
    for &at in &rows.basis {
        rhs.insert(Unknown::Row(at), model.arena.add(equations.gamma[at], feedback[at]));
    }
    let solution = factorization.solve(&mut model.arena, &rhs);
    let mut roots = accelerations(model, &solution);
    roots.extend(feedback);
    roots.push(growth(model, forces, factorization));
    roots
}

/// The growth of the elimination, and of what solves for the forces.
fn growth(model: &mut Model, forces: &Forces, factorization: &Factorization) -> Expr {
    let growth = factorization.growth(&mut model.arena);
    model.arena.add(growth, forces.growth)
}

/// The roots of `constrained` and of `reactions`, where the feedback is given.
fn with_given_feedback(
    model: &mut Model,
    equations: &Equations,
    rows: &Rows,
    (forces, inputs): (&Forces, &Inputs),
    factorization: &Factorization,
) -> (Vec<Expr>, Vec<Expr>) {
    let mut rhs: BTreeMap<Unknown, Expr> = BTreeMap::new();
    for (at, &force) in forces.values.iter().enumerate() {
        rhs.insert(Unknown::Coordinate(at), force);
    }
    for &at in &rows.basis {
        let feedback = model.arena.variable(inputs.feedback[at]);
        rhs.insert(Unknown::Row(at), model.arena.add(equations.gamma[at], feedback));
    }
    let solution = factorization.solve(&mut model.arena, &rhs);
    let growth = growth(model, forces, factorization);
    let mut constrained = accelerations(model, &solution);
    let mut reactions = constrained.clone();
    constrained.push(growth);
    let multipliers = minimum_norm::multipliers(&mut model.arena, equations, rows, factorization, &solution);
    for (constraint, multiplier) in model.constraints.iter().zip(multipliers) {
        model.arena.label(multiplier, &format!("lambda_{}", constraint.name));
        reactions.push(multiplier);
    }
    reactions.push(growth);
    (constrained, reactions)
}

fn accelerations(model: &mut Model, solution: &BTreeMap<Unknown, Expr>) -> Vec<Expr> {
    let mut roots = Vec::new();
    for (at, coordinate) in model.coordinates.iter().enumerate() {
        let acceleration = solution.get(&Unknown::Coordinate(at)).copied().unwrap_or(model.arena.zero());
        model.arena.label(acceleration, &format!("acc_{}", coordinate.quantity.name));
        roots.push(acceleration);
    }
    roots
}

fn requirements(model: &Model, equations: &Equations) -> Vec<Expr> {
    let declared = model.requirements.iter().flat_map(|r| [r.difference, r.value]);
    let checks = model.known_checks().map(|check| check.value);
    declared.chain(equations.mass.iter().copied()).chain(checks).collect()
}

fn declared_start(model: &Model) -> Vec<Expr> {
    let declared = model.start.iter().map(|start| ((start.coordinate, start.is_rate), start.value));
    let declared: HashMap<(usize, bool), Expr> = declared.collect();
    let value =
        |at: usize, is_rate: bool| declared.get(&(at, is_rate)).copied().unwrap_or(model.arena.zero());
    let n = model.coordinates.len();
    let positions = (0..n).map(|at| value(at, false));
    positions.chain((0..n).map(|at| value(at, true))).chain([model.start_time]).collect()
}
