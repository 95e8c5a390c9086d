//! The roots of every function, and the programs that compute them.

use std::ops::{Index, IndexMut};

use mbs_interface::{FunctionId, Property};
use mbs_symbolic::{Expr, Hoisted, Inconsistency, Program, lower, lower_whole};
use rustc_hash::FxHashMap as HashMap;

use super::masses;
use super::system::{self, Problem, Solver};
use super::unsolvable::Unsolvable;
use crate::model::Model;
use crate::stiff::Stiffness;

/// The expressions that the functions compute, in the order of their results.
pub struct Roots(Vec<Vec<Expr>>);

impl Roots {
    /// Those of a function.
    pub fn of(&self, function: FunctionId) -> &[Expr] {
        &self.0[function as usize]
    }

    pub fn set(&mut self, function: FunctionId, roots: Vec<Expr>) {
        self.0[function as usize] = roots;
    }
}

/// The roots of all functions, apart from the corrections of a start.
///
/// # Errors
/// Unknowns that an implicit stage leaves open.
pub fn roots(
    model: &mut Model,
    problem: Problem<'_>,
    solver: &Solver,
    stiffness: Stiffness,
) -> Result<Roots, Unsolvable> {
    let Problem { equations, rows, inputs, reduction } = problem;
    let mut roots = Roots(FunctionId::all().map(|_| Vec::new()).collect());
    let sides = equations.gamma.iter().zip(&equations.feedback);
    let baumgarte_rhs = sides.map(|(&gamma, &feedback)| model.arena.add(gamma, feedback)).collect();
    let stabilized = solver.stabilized(model, problem);
    let constrained = solver.constrained(model, problem);
    let implicit = match stiffness.is_none() {
        true => solver.without_feedback(model, problem),
        false => {
            system::implicit(model, problem, stiffness, solver.strategy)?.without_feedback(model, problem)
        }
    };
    let momentum = masses::momentum(model, equations);
    let entries = equations.phi_q.iter().flat_map(|row| row.values().copied());
    let growths = solver.factorization.pivots.iter().map(|pivot| pivot.growth);
    let sets = model.clocks.iter().map(|clock| &clock.sets);
    let sets = sets.chain(model.transitions.iter().map(|transition| &transition.sets));
    let samples: Vec<Expr> = sets.flatten().map(|(_, value)| *value).collect();
    let contacts = solver.contacts(model, problem);
    for (function, values) in [
        (FunctionId::Phi, equations.phi.clone()),
        (FunctionId::PhiDot, equations.phi_dot.clone()),
        (FunctionId::PhiQ, entries.collect()),
        (FunctionId::PhiT, equations.phi_t.clone()),
        (FunctionId::Gamma, equations.gamma.clone()),
        (FunctionId::BaumgarteRhs, baumgarte_rhs),
        (FunctionId::Mass, masses::entries(equations)),
        (FunctionId::Forces, solver.forces.values.clone()),
        (FunctionId::KineticEnergy, vec![equations.kinetic_energy]),
        (FunctionId::PotentialEnergy, vec![equations.potential_energy]),
        (FunctionId::Stabilized, stabilized),
        (FunctionId::Constrained, constrained),
        (FunctionId::Implicit, implicit),
        (FunctionId::Reactions, solver.reactions(model, problem)),
        (FunctionId::Projection, solver.projection(model, rows, inputs)),
        (FunctionId::Complete, reduction.complete(model)),
        (FunctionId::Pivots, growths.collect()),
        (FunctionId::Outputs, model.outputs.iter().map(|output| output.value).collect()),
        (FunctionId::Events, model.events.iter().map(|event| event.value).collect()),
        (FunctionId::Clocks, model.clocks.iter().flat_map(|clock| [clock.period, clock.offset]).collect()),
        (FunctionId::Samples, samples),
        (FunctionId::Transitions, model.transitions.iter().map(|transition| transition.value).collect()),
        (FunctionId::Stops, model.stop_laws().collect()),
        (
            FunctionId::Gaps,
            model.contacts().flat_map(|contact| [contact.gap, contact.rate, contact.acceleration]).collect(),
        ),
        (FunctionId::Limits, model.frictions.iter().flat_map(|friction| friction.limits).collect()),
        (FunctionId::Contacts, contacts),
        (FunctionId::Conditions, requirements(model)),
        (FunctionId::Start, declared_start(model)),
        (FunctionId::Points, model.sketch.places(&mut model.arena)),
        (FunctionId::KineticMomentum, momentum),
    ] {
        roots.set(function, values);
    }
    Ok(roots)
}

/// A program per function.
pub struct Programs(Vec<Program>);

impl Programs {
    /// The programs of all functions but the one that computes what is hoisted, which is known last.
    ///
    /// # Errors
    /// A mistake of the compiler.
    pub fn new(model: &mut Model, roots: &Roots, hoisted: &mut Hoisted) -> Result<Self, Inconsistency> {
        let unrolled = model.solver.unrolled();
        let program = |function: FunctionId| match function.is(Property::Whole) {
            true => lower_whole(&mut model.arena, roots.of(function), unrolled),
            false => lower(&mut model.arena, roots.of(function), hoisted, unrolled),
        };
        FunctionId::all().map(program).collect::<Result<_, _>>().map(Self)
    }

    /// In the order of the functions.
    pub fn into_vec(self) -> Vec<Program> {
        self.0
    }
}

impl Index<FunctionId> for Programs {
    type Output = Program;

    fn index(&self, function: FunctionId) -> &Program {
        &self.0[function as usize]
    }
}

impl IndexMut<FunctionId> for Programs {
    fn index_mut(&mut self, function: FunctionId) -> &mut Program {
        &mut self.0[function as usize]
    }
}

/// left − right and value of every requirement, then masses and inertias, then properties of elements.
fn requirements(model: &Model) -> Vec<Expr> {
    let declared = model.requirements.iter().flat_map(|r| [r.difference, r.value]);
    let checks = model.known_checks().map(|check| check.value);
    declared.chain(model.inertias.iter().map(|inertia| inertia.mass)).chain(checks).collect()
}

/// Declared positions, velocities and time of the start.
fn declared_start(model: &Model) -> Vec<Expr> {
    let declared = model.start.iter().map(|start| ((start.coordinate, start.is_rate), start.value));
    let declared: HashMap<(usize, bool), Expr> = declared.collect();
    let value =
        |at: usize, is_rate: bool| declared.get(&(at, is_rate)).copied().unwrap_or(model.arena.zero());
    let n = model.coordinates.len();
    let positions = (0..n).map(|at| value(at, false));
    positions.chain((0..n).map(|at| value(at, true))).chain([model.start_time]).collect()
}
