//! Kinematic analysis: the motion from the constraints alone.

use crate::heun::{Solution, check_solution};
use crate::{Baumgarte, Components, Error, Held, Mechanism, State, start};

/// Position, velocity and acceleration at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion<C: Components> {
    /// Position and velocity.
    pub state: State<C>,
    /// q̈
    pub acceleration: C,
}

/// The motion of a fully driven mechanism (as many constraints as
/// coordinates), solved instant by instant without integration: Φ = 0 for q,
/// Φ_q v = −Φ_t for v, Φ_q q̈ = γ for q̈ (Jiang 2025, Figure 2).
///
/// Each instant starts from the position of the one before, so the assembly
/// branch is kept as long as instants are close.
#[derive(Clone, Copy, Debug)]
pub struct Kinematics<M: Mechanism> {
    mechanism: M,
    guess: M::Coordinates,
}

impl<M: Mechanism> Kinematics<M> {
    /// The kinematics of a mechanism, starting from its declared positions.
    ///
    /// # Errors
    /// [`Error::NotDriven`] unless there is a constraint for every coordinate.
    pub fn new(mechanism: M) -> Result<Self, Error> {
        match M::INFO.dof {
            0 => Ok(Self { mechanism, guess: mechanism.declared_start().q }),
            dof => Err(Error::NotDriven { dof }),
        }
    }

    /// The motion at `t` seconds.
    ///
    /// # Errors
    /// [`Error::NotAssembled`] or [`Error::Singular`].
    pub fn at(&mut self, t: M::Real) -> Result<Motion<M::Coordinates>, Error> {
        let still = M::Coordinates::splat(M::Real::default());
        let state = start::consistent(&self.mechanism, &State { t, q: self.guess, v: still })?;
        let none = Baumgarte::<Held>::NONE.gains();
        let solved = self.mechanism.stabilized(&state, &M::Inputs::default(), &none);
        let q = &state.q;
        let solution =
            Solution { t, q, value: &solved.acceleration, growth: solved.growth, pivots: M::INFO.pivots };
        check_solution(&solution, || self.mechanism.worst_pivot(t, q))?;
        self.guess = state.q;
        Ok(Motion { state, acceleration: solved.acceleration })
    }
}
