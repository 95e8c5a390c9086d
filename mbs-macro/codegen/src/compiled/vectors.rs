//! The vectors that the symbols of programs are components of, for targets that write
//! long programs as loops.

use mbs_symbolic::layout::{self, Component, Layout};
use mbs_symbolic::{Block, Inconsistency, Program, Symbol};

use super::{Compiled, Input};

/// A vector that programs are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Vector {
    /// The parameters.
    Parameters,
    /// The inputs.
    Inputs,
    /// q
    Positions,
    /// v
    Velocities,
    /// The positions that are integrated, where those are not all.
    StatePositions,
    /// Their velocities.
    StateVelocities,
    /// q̈
    Accelerations,
    /// λ
    Multipliers,
    /// Amounts added to γ.
    Feedback,
    /// Predicted accelerations of what is integrated.
    Predicted,
    /// Weights of the results of a function, of its transpose; or a direction, of its tangent.
    Weights,
}

impl Input {
    /// The vector and the place in it; `None` of a single quantity.
    pub fn component(self) -> Option<Component<Vector>> {
        let (vector, place) = match self {
            Self::Parameter(at) => (Vector::Parameters, at),
            Self::Input(at) => (Vector::Inputs, at),
            Self::Position(at) => (Vector::Positions, at),
            Self::Velocity(at) => (Vector::Velocities, at),
            Self::StatePosition(at) => (Vector::StatePositions, at),
            Self::StateVelocity(at) => (Vector::StateVelocities, at),
            Self::Acceleration(at) => (Vector::Accelerations, at),
            Self::Multiplier(at) => (Vector::Multipliers, at),
            Self::Feedback(at) => (Vector::Feedback, at),
            Self::Predicted(at) => (Vector::Predicted, at),
            Self::Weight(at) => (Vector::Weights, at),
            Self::Time
            | Self::MinusTwoAlpha
            | Self::MinusBetaSquared
            | Self::Step
            | Self::HalfStep
            | Self::Shift
            | Self::NextTime => return None,
        };
        Some(Component { vector, place })
    }
}

impl Compiled {
    /// The number of components of a vector; nothing of weights, whose number depends on the function.
    pub fn components(&self, vector: Vector) -> usize {
        match vector {
            Vector::Parameters => self.parameters.len(),
            Vector::Inputs => self.inputs.len(),
            Vector::Positions | Vector::Velocities | Vector::Accelerations => self.coordinates.len(),
            Vector::StatePositions | Vector::StateVelocities | Vector::Predicted => self.states.len(),
            Vector::Multipliers | Vector::Feedback => self.constraints.len(),
            Vector::Weights => 0,
        }
    }

    /// The blocks that a program is written in, within the limit that was declared; a program
    /// of one block needs no layout.
    pub fn blocks(&self, program: &Program) -> Vec<Block> {
        layout::blocks(program, self.choices.unrolled, &|symbol| self.component(symbol))
    }

    /// The layout of a program in these blocks, with arrays of these lengths for its first
    /// outputs; see [`Layout::new`].
    ///
    /// # Errors
    /// The layout does not compute what the program does.
    pub fn layout(
        &self,
        program: &Program,
        blocks: &[Block],
        results: &[usize],
    ) -> Result<Layout<Vector>, Inconsistency> {
        Layout::new(program, blocks, results, &|symbol| self.component(symbol))
    }

    fn component(&self, symbol: Symbol) -> Option<Component<Vector>> {
        self.input(symbol).component()
    }
}
