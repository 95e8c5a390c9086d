//! The constrained system, eliminated, and the solutions that functions give.
//!
//! # Which order
//!
//! The function that runs most is compiled with each `Strategy`. The one with the fewest operations is kept.
//! One with hardly more operations is preferred if its critical path is shorter by a quarter. The null space
//! is given up where it changes more than 24 entries per unknown.
//!
//! # One elimination
//!
//! `factor` treats the matrix, and `Factorization::solve` any right-hand side. So accelerations, reactions
//! and projections share one elimination. An implicit stage and the corrections of a start have matrices of
//! their own.

use std::collections::{BTreeMap, BTreeSet};

use mbs_symbolic::{
    Expr, Factorization, Hoisted, Kkt, Strategy, Sums, Undetermined, Unknown, factor, factor_within, lower,
};

use super::unsolvable::Unsolvable;
use super::{masses, minimum_norm};
use crate::derive::Equations;
use crate::independence::Rows;
use crate::inputs::Inputs;
use crate::model::Model;
use crate::reactive::{self, Forces};
use crate::reduction::Reduction;
use crate::stiff::{Rate, Stiffness};

/// The constrained system with the coordinates in `held` left out.
pub fn system(model: &Model, equations: &Equations, rows: &Rows, held: &BTreeSet<usize>) -> Kkt {
    let mut kkt = Kkt::new();
    let massive = masses::positive(model, equations);
    for (at, &mass) in equations.mass.iter().enumerate() {
        if held.contains(&at) {
            continue;
        }
        let unknown = Unknown::Coordinate(at);
        kkt.add_unknown(unknown);
        kkt.set(&model.arena, unknown, unknown, mass);
        if massive.contains(&at) {
            kkt.mark_massive(at);
        }
        if model.coordinates[at].is_angle() {
            kkt.mark_angle(at);
        }
    }
    for (&(i, j), &entry) in &equations.couplings {
        if !held.contains(&i) && !held.contains(&j) {
            kkt.set(&model.arena, Unknown::Coordinate(i), Unknown::Coordinate(j), entry);
        }
    }
    for at in rows.eliminated() {
        kkt.add_unknown(Unknown::Row(at));
        for (&column, &entry) in equations.phi_q[at].iter().filter(|(column, _)| !held.contains(column)) {
            kkt.set(&model.arena, Unknown::Row(at), Unknown::Coordinate(column), entry);
        }
    }
    rows.sets.iter().for_each(|set| kkt.mark_set(set));
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

/// The equations to be solved, and the states that they are solved for.
#[derive(Clone, Copy)]
pub struct Problem<'a> {
    pub equations: &'a Equations,
    pub rows: &'a Rows,
    pub inputs: &'a Inputs,
    pub reduction: &'a Reduction,
}

/// An eliminated system, and the forces that it is solved for.
pub struct Solver {
    pub strategy: Strategy,
    pub factorization: Factorization,
    pub forces: Forces,
    /// How the rates of own states follow in an implicit stage.
    rates: Vec<Rate>,
    /// How right-hand sides of steps go through the elimination.
    sums: Sums,
}

/// An order that changes more entries than this per unknown fills the matrix of a
/// chain, and is given up.
const LARGEST_FILL: usize = 24;

/// The cost of the function that runs most, with an elimination.
#[derive(Clone, Copy)]
struct Cost {
    operations: u32,
    critical_path: u32,
}

impl Cost {
    /// True if this is better than fewer operations: hardly more of them, with a way through them
    /// that is shorter by a quarter. Less than that is lost beside what a processor does meanwhile.
    fn is_better_than(self, fewer: Self) -> bool {
        let has_hardly_more = self.operations <= fewer.operations + fewer.operations / 20;
        has_hardly_more && 4 * self.critical_path <= 3 * fewer.critical_path
    }
}

/// The elimination that costs least in the function that runs most: the one with the fewest
/// operations, unless another [is better](Cost::is_better_than).
pub fn cheapest(model: &mut Model, problem: Problem<'_>) -> Result<Solver, Unsolvable> {
    let kkt = system(model, problem.equations, problem.rows, &BTreeSet::new());
    let mut found = Vec::new();
    for strategy in Strategy::ALL {
        let Some(mut solver) = eliminated(model, problem, &kkt, strategy)? else { continue };
        found.push((solver.choose_sums(model, problem)?, solver));
    }
    let fewest = found.iter().map(|(cost, _)| *cost).min_by_key(|cost| cost.operations);
    // Eliminations that are better come first, the shortest way before others.
    let rank = |cost: Cost| match fewest.is_some_and(|fewest| cost.is_better_than(fewest)) {
        true => (0, cost.critical_path),
        false => (1, cost.operations),
    };
    let best = found.into_iter().min_by_key(|(cost, _)| rank(*cost));
    best.map(|(_, solver)| solver).ok_or_else(|| Undetermined { unknowns: Vec::new() }.into())
}

/// The elimination in an order of pivots, `None` where that fills the matrix.
fn eliminated(
    model: &mut Model,
    problem: Problem<'_>,
    kkt: &Kkt,
    strategy: Strategy,
) -> Result<Option<Solver>, Unsolvable> {
    let equations = problem.equations;
    let most = match strategy {
        Strategy::NullSpace => LARGEST_FILL * (model.coordinates.len() + model.constraints.len()),
        Strategy::Cheapest | Strategy::BothEnds => usize::MAX,
    };
    let factorization = factor_within(&mut model.arena, kkt, strategy, most)?;
    let Some(factorization) = factorization else { return Ok(None) };
    let forces = reactive::forces(model, &equations.forces, equations, &factorization)?;
    Ok(Some(Solver { strategy, factorization, forces, rates: Vec::new(), sums: Sums::Closed }))
}

/// The elimination of an implicit stage, in the order that is cheapest for the others.
pub fn implicit(
    model: &mut Model,
    problem: Problem<'_>,
    stiffness: Stiffness,
    strategy: Strategy,
) -> Result<Solver, Unsolvable> {
    let Problem { equations, rows, .. } = problem;
    let mut kkt = system(model, equations, rows, &BTreeSet::new());
    stiffness.add_to(model, &mut kkt);
    let factorization = factor(&mut model.arena, &kkt, strategy)?;
    let forces = reactive::forces(model, &stiffness.forces, equations, &factorization)?;
    Ok(Solver { strategy, factorization, forces, rates: stiffness.rates, sums: Sums::Closed })
}

impl Solver {
    /// Takes the sums with which the function that runs most has the fewest operations; what it
    /// costs with them.
    fn choose_sums(&mut self, model: &mut Model, problem: Problem<'_>) -> Result<Cost, Unsolvable> {
        let closed = self.cost(model, problem)?;
        // Behind closed entries nothing cancels, and where all coordinates are integrated their
        // feedback keeps most terms apart.
        if self.strategy != Strategy::NullSpace || problem.reduction.rows.is_empty() {
            return Ok(closed);
        }
        self.sums = Sums::Open;
        let open = self.cost(model, problem)?;
        if closed.operations <= open.operations {
            self.sums = Sums::Closed;
            return Ok(closed);
        }
        Ok(open)
    }

    /// The cost of the function that runs most.
    fn cost(&self, model: &mut Model, problem: Problem<'_>) -> Result<Cost, Unsolvable> {
        let roots = self.stabilized(model, problem);
        let program = lower(&mut model.arena, &roots, &mut Hoisted::default(), model.solver.unrolled())?;
        let operations = program.operations_for(roots.len() - 1).total();
        Ok(Cost { operations, critical_path: program.critical_path() })
    }

    /// q̈ of the states, the feedback and the growth, with feedback from the states.
    pub fn stabilized(&self, model: &mut Model, problem: Problem<'_>) -> Vec<Expr> {
        let Problem { equations, reduction, .. } = problem;
        // Shared, so that the function can hand out the very value it used.
        let feedback = equations.feedback.iter().enumerate().map(|(row, &feedback)| {
            // what a row gives meets the row
            if reduction.rows.contains(&row) { model.arena.zero() } else { model.arena.share(feedback) }
        });
        let feedback: Vec<Expr> = feedback.collect();
        let solution = self.solution(model, problem, &feedback, self.sums);
        let mut roots = accelerations_of_states(model, problem, &solution);
        roots.extend(feedback);
        roots.push(self.growth(model));
        in_states(model, problem, &roots)
    }

    /// q̈ of the states and the growth, with given feedback.
    pub fn constrained(&self, model: &mut Model, problem: Problem<'_>) -> Vec<Expr> {
        let Problem { inputs, reduction, .. } = problem;
        let feedback = inputs.feedback.iter().enumerate().map(|(row, &feedback)| {
            if reduction.rows.contains(&row) { model.arena.zero() } else { model.arena.variable(feedback) }
        });
        let feedback: Vec<Expr> = feedback.collect();
        let solution = self.solution(model, problem, &feedback, self.sums);
        let mut roots = accelerations_of_states(model, problem, &solution);
        roots.push(self.growth(model));
        in_states(model, problem, &roots)
    }

    /// q̈ of the states and the growth, without feedback.
    pub fn without_feedback(&self, model: &mut Model, problem: Problem<'_>) -> Vec<Expr> {
        let none = vec![model.arena.zero(); model.constraints.len()];
        let solution = self.solution(model, problem, &none, self.sums);
        let mut roots = accelerations_of_states(model, problem, &solution);
        roots.push(self.growth(model));
        in_states(model, problem, &roots)
    }

    /// q̈ and λ of all coordinates and constraints, and the growth, with given feedback.
    pub fn reactions(&self, model: &mut Model, problem: Problem<'_>) -> Vec<Expr> {
        let Problem { equations, rows, inputs, .. } = problem;
        let feedback: Vec<Expr> = inputs.feedback.iter().map(|&row| model.arena.variable(row)).collect();
        let solution = self.solution(model, problem, &feedback, Sums::Closed);
        let mut roots = accelerations(model, &solution);
        let factorization = &self.factorization;
        let multipliers =
            minimum_norm::multipliers(&mut model.arena, equations, rows, factorization, &solution);
        for (constraint, multiplier) in model.constraints.iter().zip(multipliers) {
            model.arena.label(multiplier, &format!("lambda_{}", constraint.name));
            roots.push(multiplier);
        }
        roots.push(self.growth(model));
        roots
    }

    /// The roots of `projection`: what leads back to the constraints, with nothing above and the
    /// given violation below.
    pub fn projection(&self, model: &mut Model, rows: &Rows, inputs: &Inputs) -> Vec<Expr> {
        let mut rhs = BTreeMap::new();
        for at in rows.eliminated() {
            rhs.insert(Unknown::Row(at), model.arena.variable(inputs.feedback[at]));
        }
        let solution = self.factorization.solve(&mut model.arena, &rhs);
        let zero = model.arena.zero();
        let component = |at| solution.get(&Unknown::Coordinate(at)).copied().unwrap_or(zero);
        let mut roots: Vec<Expr> = (0..model.coordinates.len()).map(component).collect();
        roots.push(self.factorization.growth(&mut model.arena));
        roots
    }

    /// The response to a unit impulse along every contact g, of velocities and multipliers, and ∂g/∂q; how impulses change
    /// the rates of all of them, by how much each its own without joints, and the growth; nothing without contacts.
    pub fn contacts(&self, model: &mut Model, problem: Problem<'_>) -> Vec<Expr> {
        let Problem { equations, rows, .. } = problem;
        let gaps: Vec<_> = model.contacts().map(|contact| contact.slopes.clone()).collect();
        if gaps.is_empty() {
            return Vec::new();
        }
        let (mut roots, mut mobility) = (Vec::new(), Vec::new());
        for gap in &gaps {
            let rhs = gap.iter().map(|&(at, slope)| (Unknown::Coordinate(at), slope)).collect();
            let solution = self.factorization.solve(&mut model.arena, &rhs);
            let arena = &mut model.arena;
            let zero = arena.zero();
            let response = |at| solution.get(&Unknown::Coordinate(at)).copied().unwrap_or(zero);
            roots.extend((0..model.coordinates.len()).map(response));
            let factorization = &self.factorization;
            roots.extend(minimum_norm::multipliers(arena, equations, rows, factorization, &solution));
            let slopes: BTreeMap<usize, Expr> = gap.iter().copied().collect();
            roots.extend((0..model.coordinates.len()).map(|at| slopes.get(&at).copied().unwrap_or(zero)));
            for other in &gaps {
                let terms = other.iter().map(|&(at, slope)| arena.mul(slope, response(at)));
                let terms: Vec<Expr> = terms.collect();
                mobility.push(terms.into_iter().fold(zero, |sum, term| arena.add(sum, term)));
            }
        }
        roots.extend(mobility);
        let masses = masses::entries(equations);
        for gap in &gaps {
            let arena = &mut model.arena;
            let mut free = arena.zero();
            for &(at, slope) in gap {
                let Some(&mass) = masses.get(at).filter(|mass| !arena.is_zero(**mass)) else { continue };
                let squared = arena.mul(slope, slope);
                let inverse = arena.powi(mass, -1);
                let term = arena.mul(squared, inverse);
                free = arena.add(free, term);
            }
            roots.push(free);
        }
        // of positions alone: loads that depend on reactions have their own in the other functions
        roots.push(self.factorization.growth(&mut model.arena));
        roots
    }

    /// q̈ and λ with Q above and γ + `feedback` below.
    fn solution(
        &self,
        model: &mut Model,
        problem: Problem<'_>,
        feedback: &[Expr],
        sums: Sums,
    ) -> BTreeMap<Unknown, Expr> {
        let Problem { equations, rows, .. } = problem;
        let mut rhs: BTreeMap<Unknown, Expr> = BTreeMap::new();
        for (at, &force) in self.forces.values.iter().enumerate() {
            rhs.insert(Unknown::Coordinate(at), force);
        }
        for at in rows.eliminated() {
            rhs.insert(Unknown::Row(at), model.arena.add(equations.gamma[at], feedback[at]));
        }
        let mut solution = self.factorization.solve_with(&mut model.arena, &rhs, sums);
        let arena = &mut model.arena;
        for Rate { state, predicted, slopes } in &self.rates {
            let mut rate = *predicted;
            for &(line, slope, predicted) in slopes {
                let solved = solution.get(&Unknown::Coordinate(line)).copied().unwrap_or(arena.zero());
                let change = arena.sub(solved, predicted);
                let change = arena.mul(slope, change);
                rate = arena.add(rate, change);
            }
            solution.insert(Unknown::Coordinate(*state), arena.share(rate));
        }
        solution
    }

    /// The growth of the elimination, and of what solves for the forces.
    fn growth(&self, model: &mut Model) -> Expr {
        let growth = self.factorization.growth(&mut model.arena);
        model.arena.add(growth, self.forces.growth)
    }
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

/// q̈ of the coordinates that are integrated.
fn accelerations_of_states(
    model: &mut Model,
    problem: Problem<'_>,
    solution: &BTreeMap<Unknown, Expr>,
) -> Vec<Expr> {
    let all = accelerations(model, solution);
    problem.inputs.states.iter().map(|state| all[state.coordinate]).collect()
}

/// The roots of a step as functions of the coordinates that are integrated, the accelerations
/// among them with their names.
fn in_states(model: &mut Model, problem: Problem<'_>, roots: &[Expr]) -> Vec<Expr> {
    let Problem { inputs, reduction, .. } = problem;
    let roots = reduction.in_states(&mut model.arena, roots);
    for (state, &acceleration) in inputs.states.iter().zip(&roots) {
        let name = &model.coordinates[state.coordinate].quantity.name;
        model.arena.label(acceleration, &format!("acc_{name}"));
    }
    roots
}
