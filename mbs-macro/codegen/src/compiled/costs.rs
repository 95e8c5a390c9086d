//! The cost of the functions of a compiled mechanism.

use mbs_interface::{FunctionId, Property};
use mbs_symbolic::Operations;

use super::Compiled;

/// The cost of a call of a function.
pub struct Count {
    /// The function.
    pub function: FunctionId,
    /// Its operations, without those that watch pivots.
    pub operations: Operations,
    /// The operations that watch pivots.
    pub watch: u32,
}

impl Compiled {
    /// The functions that the mechanism has in every language.
    pub fn functions(&self) -> impl Iterator<Item = FunctionId> {
        let is_there = |function: &FunctionId| {
            (self.has_stiffness || !function.is(Property::Stiff))
                && (self.sampling.clocks + self.transitions.len() > 0 || !function.is(Property::Sampled))
                && (self.contacts() > 0 || !function.is(Property::Stopping))
        };
        FunctionId::all().filter(is_there).filter(|function| !function.is(Property::Adaptive))
    }

    /// The costs of the functions that people ask for.
    pub fn counts(&self) -> Vec<Count> {
        let counted = self.functions().filter(|it| it.is(Property::Counted));
        counted.map(|function| self.count(function)).collect()
    }

    /// The cost of a function.
    pub fn count(&self, function: FunctionId) -> Count {
        let program = self.program(function);
        let outputs = program.outputs.len();
        let operations = program.operations_for(outputs - usize::from(function.solves()));
        let watch = program.operations_for(outputs).total() - operations.total();
        Count { function, operations, watch }
    }
}
