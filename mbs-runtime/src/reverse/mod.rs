//! Derivatives of a sum over a run by going back through it, for any number of variables; see
//! [`gradients`](crate::gradients#many-variables-in-reverse).
//!
//! A declaration with `gradients = reverse;` is [`Transposed`]: for a function y = f(x) it has the product
//! x̄ = (∂f/∂x)ᵀ ȳ, in which ȳ, the *adjoint* of y, is the derivative of the sum by y. The way back through a
//! run with these is written once, for types and texts ([`Reversible`]).

#[cfg(feature = "std")]
mod kept;
#[cfg(feature = "std")]
mod measures;
#[cfg(feature = "std")]
mod projection;
#[cfg(feature = "std")]
mod run;
#[cfg(feature = "std")]
mod step;
#[cfg(feature = "std")]
mod sum;

#[cfg(feature = "std")]
pub use run::Reversible;
#[cfg(feature = "std")]
pub use sum::{Moment, PARTIALS};

use crate::{Gains, Mechanism, Real};

/// A mechanism whose functions can be transposed, which `gradients = reverse;` in its declaration implements.
#[diagnostic::on_unimplemented(
    message = "runs of `{Self}` cannot be differentiated in reverse",
    label = "it was declared without `gradients = reverse;`",
    note = "add `gradients = reverse;` to its declaration, or use `gradient`, which needs no statement"
)]
pub trait Transposed: Mechanism {
    /// True if there is the transpose of a whole step of the declared scheme with feedback.
    const HAS_STEP: bool;

    /// Adds (∂f/∂x)ᵀ `weights` to the adjoints of all x that the function reads. The weights are the
    /// adjoints of its results, one vector after the other, without those of pivot growths.
    ///
    /// It is `None`, and the adjoints mean nothing, where there is no such function, or where a vector is
    /// shorter than what the function reads or adds to.
    fn transposed(
        &self,
        function: Function,
        given: &Given<'_, Self::Real>,
        weights: &[Self::Real],
        adjoints: &mut Adjoints<'_, Self::Real>,
    ) -> Option<()>;
}

/// A function of a mechanism that is transposed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    /// The values that depend on parameters alone.
    Hoisted,
    /// q̈ of the states with feedback of their own violation, and that feedback.
    Stabilized,
    /// q̈ of the states with given feedback.
    Constrained,
    /// q and v of all coordinates, from those that are integrated.
    Complete,
    /// Φ
    Phi,
    /// Φ̇
    PhiDot,
    /// The smallest Δ with Φ_q Δ = the given violation.
    Projection,
    /// q̈ and λ, where the feedback that is given is 0.
    Reactions,
    /// The declared outputs.
    Outputs,
    /// The state behind a whole step with feedback that is held over it.
    StepHeld,
    /// The state behind a whole step with feedback in every stage.
    StepPerStage,
}

impl Function {
    /// All functions, in their order.
    pub const ALL: [Self; 11] = [
        Self::Hoisted,
        Self::Stabilized,
        Self::Constrained,
        Self::Complete,
        Self::Phi,
        Self::PhiDot,
        Self::Projection,
        Self::Reactions,
        Self::Outputs,
        Self::StepHeld,
        Self::StepPerStage,
    ];
}

/// The arguments of a function; those that it does not read may be left empty.
#[derive(Clone, Copy, Debug)]
pub struct Given<'a, T> {
    /// t in s
    pub t: T,
    /// q, or of a stage or a step those that are integrated
    pub q: &'a [T],
    /// v of the same
    pub v: &'a [T],
    /// The inputs.
    pub inputs: &'a [T],
    /// The gains of the feedback.
    pub gains: Gains<T>,
    /// Amounts added to γ; of a projection, the violation.
    pub feedback: &'a [T],
    /// q̈
    pub acceleration: &'a [T],
    /// λ
    pub multipliers: &'a [T],
    /// h of a step in s
    pub h: T,
    /// t + h in s
    pub t_next: T,
}

impl<T: Real> Default for Given<'_, T> {
    /// No number, and no vector.
    fn default() -> Self {
        let none = T::from_f64(f64::NAN);
        Self {
            t: none,
            q: &[],
            v: &[],
            inputs: &[],
            gains: Gains { minus_two_alpha: none, minus_beta_squared: none },
            feedback: &[],
            acceleration: &[],
            multipliers: &[],
            h: none,
            t_next: none,
        }
    }
}

/// The derivatives of a sum by all that functions read.
#[derive(Debug)]
pub struct Adjoints<'a, T> {
    /// By q: as many numbers as coordinates. Of functions of a step, those that are integrated come first.
    pub q: &'a mut [T],
    /// By v, in the same way.
    pub v: &'a mut [T],
    /// By what is added to γ, a number per constraint.
    pub feedback: &'a mut [T],
    /// By the inputs.
    pub inputs: &'a mut [T],
    /// By the parameters.
    pub parameters: &'a mut [T],
    /// By what depends on parameters alone.
    pub hoisted: &'a mut [T],
    /// By q̈ of all coordinates.
    pub acceleration: &'a mut [T],
    /// By λ.
    pub multipliers: &'a mut [T],
}
