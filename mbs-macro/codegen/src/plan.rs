//! Equations to programs: the elimination is fixed, what depends on parameters
//! alone is hoisted, and every function has its instructions.

mod clock;
mod correction;
mod minimum_norm;
mod step;
mod system;

use mbs_symbolic::{
    Elimination, Expr, Hoisted, Inconsistency, Program, Strategy, Undetermined, Unknown, WatchedPivot, lower,
    lower_whole,
};
use rustc_hash::FxHashMap as HashMap;

use crate::derive::Equations;
use crate::independence::{Rows, Samples};
use crate::inputs::Inputs;
use crate::model::Model;
use crate::reactive::Circular;
use crate::reduction::Reduction;
use crate::stiff::Stiffness;
pub use clock::Clocked;
use correction::correction;
pub use step::{FusedStep, Kinds};
use system::{Problem, cheapest};

/// The programs of all generated functions.
pub struct Plan {
    /// The meanings of the symbols of its programs.
    pub inputs: Inputs,
    pub strategy: Strategy,
    /// The steps of the elimination, in order.
    pub order: Vec<Elimination>,
    pub rows: Rows,
    /// The coordinates that rows give, which are not integrated.
    pub reduction: Reduction,
    /// The formulas that depend on parameters alone.
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
    /// q and v, from those that are integrated
    pub complete: Program,
    /// q̈ of the states, feedback, growth
    pub stabilized: Program,
    /// q̈ of the states, growth
    pub constrained: Program,
    /// q̈ of the states in an implicit stage, growth
    pub implicit: Program,
    /// True if a force depends on positions or velocities.
    pub has_stiffness: bool,
    /// q̈, λ, growth
    pub reactions: Program,
    /// Δq, growth
    pub position_correction: Program,
    /// Δv, growth
    pub velocity_correction: Program,
    /// Δ, growth
    pub projection: Program,
    /// A whole step, of a mechanism that is small enough.
    pub fused_step: Option<FusedStep>,
    /// Growth of every watched pivot.
    pub pivots: Program,
    /// The same of the corrections of a start.
    pub start_pivots: Program,
    pub outputs: Program,
    /// The values whose changes of sign are events.
    pub events: Program,
    /// x and y of every point of the sketch.
    pub points: Program,
    /// (constraint, coordinate) of every watched pivot.
    pub pivot_names: Vec<(Option<usize>, Option<usize>)>,
    pub start_pivot_names: Vec<(Option<usize>, Option<usize>)>,
}

impl Plan {
    /// The operations of one evaluation of a step's right-hand side, the watch over the
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
/// Unknowns or loads that the equations of motion leave open, and mistakes of the compiler.
pub fn plan(
    model: &mut Model,
    equations: &Equations,
    rows: &Rows,
    samples: &Samples,
    inputs: Inputs,
    reduction: Reduction,
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
    let problem = Problem { equations, rows, inputs: &inputs, reduction: &reduction };
    let solver = cheapest(model, problem)?;
    let strategy = solver.strategy;
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
    let stabilized = solver.stabilized(model, problem);
    let constrained = solver.constrained(model, problem);
    let stiffness = Stiffness::new(model, equations, &inputs, &reduction);
    let implicit = match stiffness.is_none() {
        true => solver.without_feedback(model, problem),
        false => system::implicit(model, problem, &stiffness, strategy)?.without_feedback(model, problem),
    };
    let reactions = solver.reactions(model, problem);
    let reactions_in_states = reduction.in_states(&mut model.arena, &reactions);
    let projection = solver.projection(model, rows, &inputs);
    let complete = reduction.complete(model);
    let growths = |pivots: &[WatchedPivot]| pivots.iter().map(|pivot| pivot.growth).collect::<Vec<_>>();
    let names = |pivots: &[WatchedPivot]| pivots.iter().map(|pivot| (pivot.row, pivot.coordinate)).collect();
    let outputs: Vec<Expr> = model.outputs.iter().map(|output| output.value).collect();
    let events: Vec<Expr> = model.events.iter().map(|event| event.value).collect();

    let unrolled = model.solver.unrolled();
    let mut program = |roots: &[Expr]| lower(&mut model.arena, roots, &mut hoisted, unrolled);
    let mut plan = Plan {
        inputs,
        reduction,
        strategy,
        order: solver.factorization.order.clone(),
        rows: rows.clone(),
        phi: program(&equations.phi)?,
        phi_dot: program(&equations.phi_dot)?,
        phi_q: program(&entries().map(|(_, entry)| entry).collect::<Vec<_>>())?,
        phi_q_places: entries().map(|(place, _)| place).collect(),
        phi_t: program(&equations.phi_t)?,
        gamma: program(&equations.gamma)?,
        baumgarte_rhs: program(&rhs)?,
        mass: program(&equations.mass)?,
        forces: program(&solver.forces.values)?,
        kinetic_energy: program(&[equations.kinetic_energy])?,
        potential_energy: program(&[equations.potential_energy])?,
        stabilized: program(&stabilized)?,
        constrained: program(&constrained)?,
        implicit: program(&implicit)?,
        has_stiffness: !stiffness.is_none(),
        reactions: program(&reactions)?,
        position_correction: program(&positions)?,
        velocity_correction: program(&velocities)?,
        projection: program(&projection)?,
        complete: program(&complete)?,
        pivots: program(&growths(&solver.factorization.pivots))?,
        start_pivots: program(&growths(&start_pivots))?,
        outputs: program(&outputs)?,
        events: program(&events)?,
        hoisted: Vec::new(),
        prepare: Program::default(),
        requirements: Program::default(),
        start: Program::default(),
        points: Program::default(),
        fused_step: None,
        pivot_names: names(&solver.factorization.pivots),
        start_pivot_names: names(&start_pivots),
    };
    let reactions = program(&reactions_in_states)?;
    let stages =
        step::Stages { stabilized: &plan.stabilized, constrained: &plan.constrained, reactions: &reactions };
    let fused_step = step::fused(model, &mut plan.inputs, stages)?;
    let requirements = requirements(model, equations);
    let start = declared_start(model);
    let points = model.sketch.places(&mut model.arena);
    Ok(Plan {
        fused_step,
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
