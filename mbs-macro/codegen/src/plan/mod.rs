//! Equations to programs: the elimination is fixed, what depends on parameters
//! alone is hoisted, and every function has its instructions.

mod corners;
mod correction;
mod masses;
mod minimum_norm;
mod programs;
mod seams;
mod step;
mod system;
mod unsolvable;

use mbs_interface::FunctionId;
use mbs_symbolic::{
    Elimination, Expr, Hoisted, Strategy, Undetermined, Unknown, WatchedPivot, lower, lower_whole,
};

use crate::derive::Equations;
use crate::independence::{Rows, Samples};
use crate::inputs::Inputs;
use crate::model::Model;
use crate::reactive;
use crate::reduction::Reduction;
use crate::stiff::Stiffness;
use corners::corners;
pub use corners::{Corner, Knots, Switch};
use correction::correction;
pub use programs::Programs;
use programs::roots;
pub use step::{FusedStep, Kinds};
use system::{Problem, cheapest};
pub use unsolvable::Unsolvable;

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
    /// The program of every function.
    pub programs: Programs,
    /// Row and column of each entry of Φ_q that is not 0.
    pub phi_q_places: Vec<(usize, usize)>,
    /// Row and column of each entry of M that need not be 0, one half of the symmetric matrix.
    pub mass_places: Vec<(usize, usize)>,
    /// True if a force depends on positions or velocities.
    pub has_stiffness: bool,
    /// A whole step, of a mechanism that is small enough.
    pub fused_step: Option<FusedStep>,
    /// Values over time at whose knots something bends or jumps.
    pub corners: Vec<Corner>,
    /// The same of values of the motion.
    pub switches: Vec<Switch>,
    /// (constraint, coordinate) of every watched pivot.
    pub pivot_names: Vec<(Option<usize>, Option<usize>)>,
    pub start_pivot_names: Vec<(Option<usize>, Option<usize>)>,
}

impl Plan {
    /// The operations of one evaluation of a step's right-hand side, the watch over the
    /// pivots included.
    pub fn operations(&self) -> u32 {
        self.programs[FunctionId::Stabilized].operations().total()
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
    reactive::settle(model, &solver.factorization)?;
    let strategy = solver.strategy;
    let (positions, mut start_pivots) =
        correction(model, equations, rows, strategy, (samples, &inputs), false)?;
    let (velocities, more) = correction(model, equations, rows, strategy, (samples, &inputs), true)?;
    start_pivots.extend(
        more.into_iter()
            .filter(|new| start_pivots.iter().all(|old| old.growth != new.growth))
            .collect::<Vec<_>>(),
    );

    let stiffness = Stiffness::new(model, equations, &inputs, &reduction);
    let has_stiffness = !stiffness.is_none();
    let mut roots = roots(model, problem, &solver, stiffness)?;
    roots.set(FunctionId::PositionCorrection, positions);
    roots.set(FunctionId::VelocityCorrection, velocities);
    roots.set(FunctionId::StartPivots, start_pivots.iter().map(|pivot| pivot.growth).collect());
    let (corners, switches) = corners(model, equations, &inputs);
    roots.set(FunctionId::Switches, switches.iter().map(|switch| switch.value).collect());
    roots.set(FunctionId::Corners, corners.iter().flat_map(|corner| [corner.rate, corner.offset]).collect());
    let reactions_in_states = reduction.in_states(&mut model.arena, roots.of(FunctionId::Reactions));
    let mut hoisted = Hoisted::default();
    let mut programs = Programs::new(model, &roots, &mut hoisted)?;
    let unrolled = model.solver.unrolled();
    let fused_reactions = lower(&mut model.arena, &reactions_in_states, &mut hoisted, unrolled)?;
    programs[FunctionId::Hoisted] = lower_whole(&mut model.arena, hoisted.values(), unrolled)?;
    let stages = step::Stages {
        stabilized: &programs[FunctionId::Stabilized],
        constrained: &programs[FunctionId::Constrained],
        reactions: &fused_reactions,
    };
    let fused_step = step::fused(model, &inputs, stages)?;
    let entries = equations.phi_q.iter().enumerate();
    let phi_q_places = entries.flat_map(|(row, entries)| entries.keys().map(move |&column| (row, column)));
    let names = |pivots: &[WatchedPivot]| pivots.iter().map(|pivot| (pivot.row, pivot.coordinate)).collect();
    Ok(Plan {
        phi_q_places: phi_q_places.collect(),
        mass_places: masses::places(equations),
        corners,
        switches,
        pivot_names: names(&solver.factorization.pivots),
        start_pivot_names: names(&start_pivots),
        order: solver.factorization.order.clone(),
        rows: rows.clone(),
        hoisted: hoisted.values().to_vec(),
        has_stiffness,
        strategy,
        inputs,
        reduction,
        programs,
        fused_step,
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
