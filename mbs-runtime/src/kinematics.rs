//! Kinematic analysis: the motion from the constraints alone.

use crate::diagnosis::{Solution, check_solution};
use crate::equations::{Arrays, At, Equations, consistent};
use crate::room::{OnStack, Room};
use crate::{Components, Error, Mechanism, Real, State, vectors};

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
        let still = M::Coordinates::splat(M::Real::default()).into_array();
        let (mut q, mut v, mut acceleration) = (self.guess.into_array(), still, still);
        let (equations, inputs) = (&self.mechanism, M::Inputs::default().into_array());
        let mut room = OnStack::<M>::new();
        let [of_q, of_v, of_a] = [&mut q, &mut v, &mut acceleration].map(AsMut::as_mut);
        solve(equations, t, [of_q, of_v, of_a], inputs.as_ref(), &mut room.room())?;
        let state = Arrays { t, q, v }.state();
        self.guess = state.q;
        Ok(Motion { state, acceleration: Components::from_array(acceleration) })
    }
}

/// Moves q onto Φ = 0, v onto Φ̇ = 0, and gives q̈.
fn solve<T: Real>(
    equations: &dyn Equations<T>,
    t: T,
    [q, v, acceleration]: [&mut [T]; 3],
    inputs: &[T],
    room: &mut Room<'_, T>,
) -> Result<(), Error> {
    consistent(equations, t, q, v, room)?;
    let [feedback, ..] = &mut room.constraints;
    vectors::fill(feedback, T::default());
    let growth = equations.accelerations(At { t, q, v }, inputs, feedback, acceleration);
    let info = equations.info();
    let solution = Solution { t, q, value: acceleration, growth, info, pivots: info.pivots };
    check_solution(&solution, || equations.worst_pivot(t, q))
}
