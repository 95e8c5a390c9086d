//! Kinematic analysis: the motion from the constraints alone.

use crate::diagnosis::{Solution, check_inputs, check_solution, singular};
use crate::equations::{Arrays, At, Equations, assemble, project_velocities};
use crate::room::{OnStack, Room};
use crate::run::check_outputs;
use crate::{Components, Error, Mechanism, Quantity, Reactions, Real, State, vectors};

/// A position is on the motion that was predicted if it is nearer to that than this share of 1 rad, or of the
/// size of the mechanism.
const NEAR: f64 = 0.05;
/// The size of a mechanism in m that stands at the origin, within a nanometre.
const USUAL: f64 = 0.1;
const NOTHING: f64 = 1e-9;
/// Steps are at least this share of the way to an instant.
const SHORTEST: f64 = 1.0 / 1_048_576.0;

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
/// Each instant is reached from the one before, the first one from the declared start: by steps along
/// the velocity, corrected by Newton's method and halved where a correction is not small beside the
/// mechanism. So the assembly stays on its branch however far instants are apart, and a motion that leads
/// to where the mechanism cannot be closed ends with the time at which that is.
///
/// Mechanisms with degrees of freedom whose motion is prescribed are analysed by `mbs-analysis::inverse`.
///
/// # Example
/// ```
/// use mbs_runtime::{Kinematics, mechanism};
///
/// mechanism! {
///     pub Crank {
///         dof = 0;
///         body crank (angle = phi) { inertia = 0.5 [kg*m^2]; }
///         drive motor: phi = 3 [rad/s^2]*t^2;
///         output torque [N*m] = effort(motor);
///     }
/// }
///
/// let mut kinematics = Kinematics::new(Crank::declared())?;
/// let motion = kinematics.at(2.0)?;
/// assert!((motion.state.v.phi - 12.0).abs() < 1e-12);
/// let outputs = kinematics.outputs(&motion, &Default::default())?;
/// assert!((outputs.torque - 0.5 * 6.0).abs() < 1e-12);
/// # Ok::<(), mbs_runtime::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Kinematics<M: Mechanism> {
    mechanism: M,
    /// Where it was last, and whether that was on the constraints.
    last: State<M::Coordinates>,
    is_assembled: bool,
    /// The largest length that a coordinate has had, in m.
    size: f64,
}

impl<M: Mechanism> Kinematics<M> {
    /// The kinematics of a mechanism, starting from its declared positions.
    ///
    /// # Errors
    /// [`Error::NotDriven`] unless there is a constraint for every coordinate; [`Error::OwnState`] and
    /// [`Error::Rates`] for a mechanism with states of its own or equations between rates.
    pub fn new(mechanism: M) -> Result<Self, Error> {
        if let Some(state) = M::INFO.coordinates.get(M::INFO.lines) {
            return Err(Error::OwnState { state: state.name });
        }
        M::INFO.refuse_rates("kinematics")?;
        match M::INFO.dof {
            0 => Ok(Self { mechanism, last: mechanism.declared_start(), is_assembled: false, size: 0.0 }),
            dof => Err(Error::NotDriven { dof }),
        }
    }

    /// The motion at `t` seconds.
    ///
    /// # Errors
    /// [`Error::NotAssembled`] or [`Error::Singular`] with the time beyond which the motion cannot be
    /// followed; [`Error::Time`] for one that is not finite. The next instant is reached from where the
    /// last good one was.
    pub fn at(&mut self, t: M::Real) -> Result<Motion<M::Coordinates>, Error> {
        if !t.is_finite() {
            return Err(Error::Time { t: t.to_f64(), step: 0.0 });
        }
        let mut arrays = Arrays::of(&self.last);
        let mut acceleration = M::Coordinates::splat(M::Real::default()).into_array();
        let mut predicted = acceleration;
        let mut space = OnStack::<M>::new();
        let room = &mut space.room();
        let Arrays { t: from, q, v } = &mut arrays;
        let mut way =
            Way { equations: &self.mechanism, t: *from, q: q.as_mut(), v: v.as_mut(), size: self.size };
        if !self.is_assembled {
            assemble(way.equations, way.t, way.q, room)?;
            project_velocities(way.equations, way.t, way.q, way.v, room)?;
        }
        way.follow(t, predicted.as_mut(), room)?;
        let inputs = M::Inputs::default().into_array();
        way.acceleration(inputs.as_ref(), acceleration.as_mut(), room)?;
        self.size = way.size;
        *from = way.t;
        self.last = arrays.state();
        self.is_assembled = true;
        Ok(Motion { state: self.last, acceleration: Components::from_array(acceleration) })
    }

    /// The multipliers of a motion that [`at`](Self::at) gave, the forces of its drives among them.
    ///
    /// # Errors
    /// [`Error::Singular`], [`Error::Input`].
    pub fn reactions(
        &self,
        motion: &Motion<M::Coordinates>,
        inputs: &M::Inputs,
    ) -> Result<Reactions<M::Coordinates, M::Constraints>, Error> {
        check_inputs(M::INFO, inputs.into_array().as_ref())?;
        let none = M::Constraints::splat(M::Real::default());
        let solved = Mechanism::reactions(&self.mechanism, &motion.state, inputs, &none);
        let (q, value) = (motion.state.q.into_array(), solved.acceleration.into_array());
        let solution = Solution {
            t: motion.state.t,
            q: q.as_ref(),
            value: value.as_ref(),
            growth: solved.growth,
            info: M::INFO,
            pivots: M::INFO.pivots,
        };
        check_solution(&solution, || {
            Mechanism::worst_pivot(&self.mechanism, motion.state.t, &motion.state.q)
        })?;
        Ok(solved)
    }

    /// The declared outputs of a motion that [`at`](Self::at) gave.
    ///
    /// # Errors
    /// As [`reactions`](Self::reactions); [`Error::Undefined`] if an output is not finite.
    pub fn outputs(&self, motion: &Motion<M::Coordinates>, inputs: &M::Inputs) -> Result<M::Outputs, Error> {
        let reactions = self.reactions(motion, inputs)?;
        let measured = Mechanism::outputs(&self.mechanism, &motion.state, inputs, &reactions);
        check_outputs(M::INFO, motion.state.t, measured.into_array().as_ref())?;
        Ok(measured)
    }
}

/// A mechanism on its way through time.
struct Way<'a, T> {
    equations: &'a dyn Equations<T>,
    t: T,
    q: &'a mut [T],
    v: &'a mut [T],
    /// The largest length so far, in m.
    size: f64,
}

impl<T: Real> Way<'_, T> {
    /// Leads it to `end`; `predicted` is room for coordinates.
    fn follow(&mut self, end: T, predicted: &mut [T], room: &mut Room<'_, T>) -> Result<(), Error> {
        let whole = end - self.t;
        let (shortest, mut step) = (SHORTEST * whole.to_f64().abs(), whole);
        while self.t != end {
            let left = end - self.t;
            let is_last = left.to_f64().abs() <= step.to_f64().abs();
            let next = if is_last { end } else { self.t + step };
            match self.step(next, predicted, room) {
                Ok(()) => {
                    project_velocities(self.equations, self.t, self.q, self.v, room)?;
                    step = step + step;
                }
                Err(error) if step.to_f64().abs() <= shortest || next == self.t => return Err(error),
                Err(_) => step = T::from_f64(0.5) * if is_last { left } else { step },
            }
        }
        Ok(())
    }

    /// Positions at `next`, if they are near to where the velocity leads.
    fn step(&mut self, next: T, there: &mut [T], room: &mut Room<'_, T>) -> Result<(), Error> {
        let length = next - self.t;
        vectors::copy(there, self.q);
        vectors::add_scaled(there, length, self.v);
        assemble(self.equations, next, there, room)?;
        let allowed = self.allowed();
        let info = self.equations.info();
        let coordinates = info.coordinates.iter().take(info.lines).zip(&*there).zip(&*self.q).zip(&*self.v);
        let away = |(((coordinate, there), q), v): (((&Quantity, &T), &T), &T)| {
            let share = if coordinate.dimension.length == 0 { NEAR } else { allowed };
            (*there - (*q + length * *v)).to_f64().abs() > share
        };
        if coordinates.clone().any(away) {
            return Err(self.jumped());
        }
        vectors::copy(self.q, there);
        self.t = next;
        Ok(())
    }

    /// How far a length may be from where it was predicted.
    fn allowed(&mut self) -> f64 {
        let info = self.equations.info();
        let coordinates = info.coordinates.iter().zip(info.of_bodies(self.q));
        let lengths = coordinates.filter(|(q, _)| q.dimension.length != 0).map(|(_, q)| q.to_f64().abs());
        self.size = lengths.fold(self.size, f64::max);
        NEAR * if self.size > NOTHING { self.size } else { USUAL }
    }

    /// Beyond this position there is none near, but one on another branch.
    fn jumped(&self) -> Error {
        let worst = self.equations.worst_start_pivot(self.t, self.q);
        let info = self.equations.info();
        let growth = worst.map_or(T::from_f64(f64::INFINITY), |(_, growth)| growth);
        singular(info, self.t, worst.and_then(|(at, _)| info.start_pivots.get(at)), growth)
    }

    fn acceleration(
        &self,
        inputs: &[T],
        acceleration: &mut [T],
        room: &mut Room<'_, T>,
    ) -> Result<(), Error> {
        let [feedback, ..] = &mut room.constraints;
        vectors::fill(feedback, T::default());
        let at = At { t: self.t, q: self.q, v: self.v };
        let growth = self.equations.accelerations(at, inputs, feedback, acceleration);
        let info = self.equations.info();
        let solution =
            Solution { t: self.t, q: self.q, value: acceleration, growth, info, pivots: info.pivots };
        check_solution(&solution, || self.equations.worst_pivot(self.t, self.q))
    }
}
