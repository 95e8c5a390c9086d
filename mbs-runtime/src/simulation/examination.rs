//! What is done where a step or a result is not healthy: finding out whether anything
//! went wrong, and what.

use super::Simulation;
use crate::diagnosis::{Solution, check_defined, check_inputs, check_solution};
use crate::equations::{Arrays, At, Equations, Named};
use crate::mechanism::growth_limit;
use crate::reach::reach;
use crate::room::{OnStack, Room};
use crate::start::consistency::{check, check_feedback};
use crate::watch::Watch;
use crate::{Components, Error, Feedback, Gains, Mechanism, Real, State, spare, vectors};

/// A run to be examined, in its last good state.
#[derive(Clone, Copy)]
pub struct Examination<'a, T> {
    /// The mechanism.
    pub equations: &'a dyn Equations<T>,
    /// The last good state.
    pub at: At<'a, T>,
    /// The inputs, held over the step.
    pub inputs: &'a [T],
    /// The gains of the feedback.
    pub gains: Gains<T>,
    /// The step in s.
    pub step: T,
    /// Whether violations of the constraints are meant to decay.
    pub keeps_constraints: bool,
}

impl<T: Real> Examination<'_, T> {
    /// Examines a step to `next` after which the growth has risen: whether its constraints
    /// can still be met, whether it has kept its digits, and which pivot it is, which the
    /// watch remembers.
    ///
    /// # Errors
    /// [`Error::OutOfReach`], [`Error::Singular`].
    pub fn examine_step(
        &self,
        next: At<'_, T>,
        growth: T,
        watch: &mut Watch<T>,
        room: &mut Room<'_, T>,
    ) -> Result<(), Error> {
        let Self { equations, at: At { t, q, .. }, inputs, step, .. } = *self;
        if self.keeps_constraints {
            reach(equations, next.t, next.q, inputs, step, room)?;
        }
        let [phi, ..] = &mut room.constraints;
        spare::check(equations, next.t, next.q, watch.length, phi)?;
        self.keeps_digits(next, growth, room)?;
        if watch.is_new(growth) {
            let share = T::from_f64(0.125) * growth;
            let worst = equations.worst_pivot(t, q).filter(|(_, growth)| *growth > share);
            watch.remember(growth, t, worst.map(|(at, _)| at));
        }
        Ok(())
    }

    /// Refuses a step from which rounding has taken half of its digits, growth > 1/√ε, and
    /// that has left many times the violation of before, whose feedback would change the
    /// motion as a whole: within some steps it would leave every scale.
    fn keeps_digits(&self, next: At<'_, T>, growth: T, room: &mut Room<'_, T>) -> Result<(), Error> {
        let Self { equations, at, step, .. } = *self;
        let has_lost_half = T::EPSILON * growth * growth > T::from_f64(1.0);
        if !has_lost_half || !self.keeps_constraints || check(equations, at, step, room).is_err() {
            return Ok(());
        }
        let [before, after] = [at, next].map(|at| violations(equations, at, room));
        if before.iter().zip(after).all(|(&before, after)| after <= T::from_f64(32.0) * before) {
            return Ok(());
        }
        let [here, there] = [at, next].map(|at| equations.worst_pivot(at.t, at.q));
        let after = there.map_or(T::from_f64(1.0), |(_, growth)| growth);
        if check_feedback(equations, next, after, step, room).is_ok() {
            return Ok(());
        }
        let worst = match [here, there] {
            [Some(here), Some(there)] if there.1 > here.1 => Some(there),
            [here, there] => here.or(there),
        };
        let pivot = worst.and_then(|(at, _)| equations.info().pivots.get(at));
        let (constraint, coordinate) = pivot.map_or(("", ""), |pivot| (pivot.constraint, pivot.coordinate));
        Err(Error::Singular { t: at.t.to_f64(), constraint, coordinate, growth: growth.to_f64() })
    }

    /// Why a step to `t_next` failed: an input, or a position that cannot be reached from
    /// one that was good, or what the step says.
    pub fn cause(&self, error: Error, t_next: T, room: &mut Room<'_, T>) -> Error {
        let Self { equations, at, inputs, step, .. } = *self;
        if let Err(input) = check_inputs(equations.info(), inputs) {
            return input;
        }
        if !self.is_good(t_next, room) || !self.keeps_constraints {
            return error;
        }
        let mut reach_at = |t| reach(equations, t, at.q, inputs, step, room);
        if reach_at(at.t).is_err() {
            return error;
        }
        reach_at(t_next).err().unwrap_or(error)
    }

    /// Whether the state has accelerations, and its positions constraints at `t_next`.
    fn is_good(&self, t_next: T, room: &mut Room<'_, T>) -> bool {
        let Self { equations, at, inputs, gains, .. } = self;
        let [acceleration, ..] = &mut room.coordinates;
        let [feedback, phi, ..] = &mut room.constraints;
        let growth = equations.stabilized(*at, inputs, gains, acceleration, feedback);
        equations.phi(t_next, at.q, phi);
        growth < growth_limit() && vectors::is_finite(phi)
    }

    /// Examines q̈ and λ of the state.
    ///
    /// # Errors
    /// [`Error::Input`], [`Error::Singular`], [`Error::NonFinite`] of an acceleration,
    /// [`Error::Undefined`] of a multiplier.
    pub fn examine(&self, acceleration: &[T], multipliers: &[T], growth: T) -> Result<(), Error> {
        let Self { equations, at: At { t, q, .. }, inputs, .. } = *self;
        let info = equations.info();
        let solution = Solution { t, q, value: acceleration, growth, info, pivots: info.pivots };
        let name = |row| info.constraint_name(row);
        check_solution(&solution, || equations.worst_pivot(t, q))
            .and_then(|()| check_defined(t, "the multiplier of constraint", multipliers, name))
            // an input that is not finite is the cause of whatever failed after it
            .map_err(|error| check_inputs(info, inputs).err().unwrap_or(error))
    }
}

/// ‖Φ‖ and ‖Φ̇‖
fn violations<T: Real>(equations: &dyn Equations<T>, at: At<'_, T>, room: &mut Room<'_, T>) -> [T; 2] {
    let [rows, ..] = &mut room.constraints;
    equations.phi(at.t, at.q, rows);
    let violation = vectors::norm(rows);
    equations.phi_dot(at, rows);
    [violation, vectors::norm(rows)]
}

/// What is done with a run to be examined.
type Examine<'a, T> = dyn FnMut(&Examination<'_, T>, &mut Room<'_, T>) -> Result<(), Error> + 'a;

impl<M: Mechanism, F: Feedback> Simulation<M, F> {
    /// What `examine` finds out about this run. By reference, so that this is compiled once
    /// for all that is to be found out.
    #[cold]
    #[inline(never)]
    fn examined(&self, examine: &mut Examine<'_, M::Real>) -> Result<(), Error> {
        let (state, inputs) = (Arrays::of(&self.state), self.inputs.into_array());
        let run = Examination {
            equations: &Named(&self.mechanism),
            at: state.at(),
            inputs: inputs.as_ref(),
            gains: self.gains,
            step: self.step,
            keeps_constraints: self.baumgarte.is_stable(self.step.to_f64()),
        };
        examine(&run, &mut OnStack::<M>::new().room())
    }

    /// See [`Examination::examine_step`].
    #[cold]
    pub(super) fn examine_step(
        &mut self,
        next: &State<M::Coordinates>,
        growth: M::Real,
    ) -> Result<(), Error> {
        // `run` borrows what the watch belongs to
        let mut watch = self.watch;
        let next = Arrays::of(next);
        self.examined(&mut |run, room| run.examine_step(next.at(), growth, &mut watch, room))?;
        self.watch = watch;
        Ok(())
    }

    /// See [`Examination::cause`].
    #[cold]
    pub(super) fn cause(&self, error: Error, t_next: M::Real) -> Error {
        self.examined(&mut |run, room| Err(run.cause(error, t_next, room))).err().unwrap_or(error)
    }

    /// Takes values and not references, so that what is healthy need not be in memory.
    #[cold]
    pub(super) fn examine(
        &self,
        acceleration: M::Coordinates,
        multipliers: M::Constraints,
        growth: M::Real,
    ) -> Result<(), Error> {
        let (acceleration, multipliers) = (acceleration.into_array(), multipliers.into_array());
        self.examined(&mut |run, _| run.examine(acceleration.as_ref(), multipliers.as_ref(), growth))
    }

    /// Whether redundant constraints, which steps do not look at, are met all the same.
    #[inline(always)]
    pub(super) fn keeps_redundant(&self, at: &State<M::Coordinates>) -> bool {
        spare::margin(&self.mechanism, at, self.watch.length) >= M::Real::default()
    }
}
