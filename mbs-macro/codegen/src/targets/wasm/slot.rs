//! The parameters of functions.

use wasm_encoder::ValType;

use crate::compiled::Argument;

/// A parameter of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slot {
    /// The address of the parameters, and of what depends on them alone behind them.
    Mechanism,
    Time,
    Positions,
    Velocities,
    Inputs,
    /// The address of −2α and −β².
    Gains,
    Feedback,
    /// The address of q̈, and of λ behind it.
    Reactions,
    Shift,
    Predicted,
    /// h
    Step,
    /// h/2
    HalfStep,
    /// t + h of a whole step.
    NextTime,
}

impl Slot {
    /// Where an argument is found; the states of a step stand in the place of all coordinates.
    pub fn of(argument: Argument) -> Self {
        match argument {
            Argument::Time => Self::Time,
            Argument::Positions | Argument::StatePositions => Self::Positions,
            Argument::Velocities | Argument::StateVelocities => Self::Velocities,
            Argument::Inputs => Self::Inputs,
            Argument::Gains => Self::Gains,
            Argument::Feedback => Self::Feedback,
            Argument::Reactions => Self::Reactions,
            Argument::Shift => Self::Shift,
            Argument::Predicted => Self::Predicted,
        }
    }

    /// A number, or an address.
    pub fn kind(self) -> ValType {
        match self {
            Self::Time | Self::Shift | Self::Step | Self::HalfStep | Self::NextTime => ValType::F64,
            _ => ValType::I32,
        }
    }
}
