//! Dependencies: which results a given number reaches at once, and not only through an
//! integrator. Importers order their calls by them, and look for loops.

use std::collections::BTreeSet;

use mbs_symbolic::{Operand, Symbol};

use super::variables::{Group, References};
use crate::compiled::{Compiled, FunctionId, Input};

/// Which parameters may be changed while a run goes on: those that act on accelerations, outputs or events,
/// and of which no constraint knows. A state stays consistent when they change.
pub fn tunable(compiled: &Compiled) -> Vec<bool> {
    let read = |functions: &[FunctionId]| -> BTreeSet<usize> {
        functions.iter().flat_map(|function| parameters(compiled, *function)).collect()
    };
    let held = read(&[FunctionId::Phi, FunctionId::PhiDot, FunctionId::Complete]);
    let acting = read(&[FunctionId::Reactions, FunctionId::Outputs, FunctionId::Events]);
    (0..compiled.parameters.len()).map(|at| acting.contains(&at) && !held.contains(&at)).collect()
}

/// The parameters that a function reads, also by what is computed of parameters once.
fn parameters(compiled: &Compiled, function: FunctionId) -> BTreeSet<usize> {
    let hoisted = compiled.program(FunctionId::Hoisted).reads();
    let program = compiled.program(function);
    let operands = program.instructions.iter().flat_map(|it| [it.a, it.b]);
    let symbols = operands.chain(program.outputs.iter().copied()).flat_map(|operand| match operand {
        Operand::Symbol(symbol) => BTreeSet::from([symbol]),
        Operand::Hoisted(at) => hoisted[at].clone(),
        Operand::Number(_) | Operand::Value(_) => BTreeSet::new(),
    });
    let parameter = |symbol| match compiled.input(symbol) {
        Input::Parameter(at) => Some(at),
        _ => None,
    };
    symbols.filter_map(parameter).collect()
}

/// The value references of the time, inputs and states that some results depend on.
pub struct Dependencies<'a> {
    compiled: &'a Compiled,
    references: &'a References,
    /// Of every coordinate, what its position depends on, and its velocity: themselves, if they are
    /// integrated.
    places: [Vec<BTreeSet<usize>>; 2],
    /// The dependencies of accelerations and multipliers, which are solved for together.
    reactions: BTreeSet<usize>,
}

impl<'a> Dependencies<'a> {
    pub fn new(compiled: &'a Compiled, references: &'a References) -> Self {
        let none = Self { compiled, references, places: Default::default(), reactions: BTreeSet::new() };
        let mut reads = compiled.program(FunctionId::Complete).reads();
        let velocities = reads.split_off(compiled.coordinates.len().min(reads.len()));
        let places = [reads, velocities].map(|reads| reads.iter().map(|read| none.of(read)).collect());
        let placed = Self { places, ..none };
        let reads = compiled.program(FunctionId::Reactions).reads();
        let reactions = placed.of(&reads.into_iter().flatten().collect());
        Self { reactions, ..placed }
    }

    /// The dependencies of the accelerations of the states, one after the other.
    pub fn accelerations(&self) -> Vec<BTreeSet<usize>> {
        let reads = self.compiled.program(FunctionId::Stabilized).reads();
        reads.iter().take(self.compiled.states.len()).map(|read| self.of(read)).collect()
    }

    /// The dependencies of the outputs.
    pub fn outputs(&self) -> Vec<BTreeSet<usize>> {
        self.compiled.program(FunctionId::Outputs).reads().iter().map(|read| self.of(read)).collect()
    }

    /// The dependencies of the events.
    pub fn events(&self) -> Vec<BTreeSet<usize>> {
        self.compiled.program(FunctionId::Events).reads().iter().map(|read| self.of(read)).collect()
    }

    /// The dependencies of a result that reads these symbols.
    fn of(&self, read: &BTreeSet<Symbol>) -> BTreeSet<usize> {
        let at = |group, place: usize| BTreeSet::from([self.references.of(group) + place]);
        let state = |group, place: usize| at(group, self.compiled.states[place]);
        let placed = |group, which: usize, place: usize| match self.places[which].get(place) {
            Some(known) => known.clone(),
            // while the places are found themselves
            None => at(group, place),
        };
        let of = |symbol: &Symbol| match self.compiled.input(*symbol) {
            Input::Time => at(Group::Time, 0),
            // a memory holds, so that nothing depends on it between samples
            Input::Input(place)
                if place < self.references.of(Group::Memories) - self.references.of(Group::Inputs) =>
            {
                at(Group::Inputs, place)
            }
            Input::Position(place) => placed(Group::Positions, 0, place),
            Input::Velocity(place) => placed(Group::Velocities, 1, place),
            Input::StatePosition(place) => state(Group::Positions, place),
            Input::StateVelocity(place) => state(Group::Velocities, place),
            Input::Acceleration(_) | Input::Multiplier(_) => self.reactions.clone(),
            _ => BTreeSet::new(),
        };
        read.iter().flat_map(of).collect()
    }
}
