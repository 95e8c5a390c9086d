//! What the symbols of programs stand for.

use crate::model::Meaning;

/// What a symbol of a program stands for: a number, or a component of a vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    /// t in s
    Time,
    /// A parameter.
    Parameter(usize),
    /// An input.
    Input(usize),
    /// A component of q,
    Position(usize),
    /// of v,
    Velocity(usize),
    /// of q̈,
    Acceleration(usize),
    /// or of λ.
    Multiplier(usize),
    /// An amount added to γ of a constraint; of corrections, its residual.
    Feedback(usize),
    /// −2α
    MinusTwoAlpha,
    /// −β²
    MinusBetaSquared,
    /// h of a step,
    Step,
    /// h/2,
    HalfStep,
    /// and t + h.
    NextTime,
}

impl From<Meaning> for Input {
    fn from(meaning: Meaning) -> Self {
        match meaning {
            Meaning::Time => Self::Time,
            Meaning::Parameter(at) => Self::Parameter(at),
            Meaning::Input(at) => Self::Input(at),
            Meaning::Coordinate(at) => Self::Position(at),
            Meaning::Velocity(at) => Self::Velocity(at),
            Meaning::Acceleration(at) => Self::Acceleration(at),
            Meaning::Multiplier(at) => Self::Multiplier(at),
            Meaning::Feedback(at) => Self::Feedback(at),
            Meaning::MinusTwoAlpha => Self::MinusTwoAlpha,
            Meaning::MinusBetaSquared => Self::MinusBetaSquared,
            Meaning::Step => Self::Step,
            Meaning::HalfStep => Self::HalfStep,
            Meaning::NextTime => Self::NextTime,
        }
    }
}
