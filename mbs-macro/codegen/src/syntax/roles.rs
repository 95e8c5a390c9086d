//! Statements of one shape that differ by their word.

/// The role of an equation in the mechanism.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Role {
    Constraint,
    /// Enforced from outside.
    Drive,
    /// A transmission between coordinates.
    Coupler,
    /// An equation between rates, which restricts no position.
    Rate,
}

impl Role {
    /// The word with which its statement begins.
    pub fn word(self) -> &'static str {
        match self {
            Self::Constraint => "constraint",
            Self::Drive => "drive",
            Self::Coupler => "coupler",
            Self::Rate => "rate",
        }
    }
}

/// A function of the motion of which forces are derivatives.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum EnergyRole {
    /// V, whose forces are −∂V/∂q.
    Potential,
    /// Rayleigh's R, whose forces are −∂R/∂q̇.
    Dissipation,
}

impl EnergyRole {
    /// The words of both.
    pub const WORDS: [&str; 2] = [Self::Potential.word(), Self::Dissipation.word()];

    /// The word with which its statement begins.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Potential => "potential",
            Self::Dissipation => "dissipation",
        }
    }
}
