//! What is done where a step or a result is not healthy: finding out whether anything
//! went wrong, and what.

use super::Simulation;
use crate::heun::{Solution, check_solution};
use crate::mechanism::growth_limit;
use crate::reach::reach;
use crate::{Components, Error, Feedback, Mechanism, Real, State, spare, start};

impl<M: Mechanism, F: Feedback> Simulation<M, F> {
    /// A step after which the growth has risen: whether its constraints can still be met,
    /// whether it has kept its digits, and which pivot it is.
    #[cold]
    pub(super) fn examine_step(
        &mut self,
        next: &State<M::Coordinates>,
        growth: M::Real,
    ) -> Result<(), Error> {
        if self.keeps_constraints() {
            reach(&self.mechanism, next, &self.inputs, self.step)?;
        }
        spare::check(&self.mechanism, next, self.watch.length)?;
        self.keeps_digits(next, growth)?;
        if self.watch.is_new(growth) {
            let State { t, q, .. } = &self.state;
            let share = M::Real::from_f64(0.125) * growth;
            let worst = self.mechanism.worst_pivot(*t, q).filter(|(_, growth)| *growth > share);
            self.watch.remember(growth, *t, worst.map(|(at, _)| at));
        }
        Ok(())
    }

    /// Refuses a step from which rounding has taken half of its digits, growth > 1/√ε, and
    /// that has left many times the violation of before, whose feedback would change the
    /// motion as a whole: within some steps it would leave every scale.
    #[cold]
    fn keeps_digits(&self, next: &State<M::Coordinates>, growth: M::Real) -> Result<(), Error> {
        let Self { mechanism, state, step, .. } = self;
        let has_lost_half = M::Real::EPSILON * growth * growth > M::Real::from_f64(1.0);
        let many = |before: M::Real, after: M::Real| after > M::Real::from_f64(32.0) * before;
        let violation = |at: &State<M::Coordinates>| mechanism.phi(at.t, &at.q).norm();
        let rate = |at: &State<M::Coordinates>| mechanism.phi_dot(at).norm();
        let has_jumped = || many(violation(state), violation(next)) || many(rate(state), rate(next));
        // The check looks at every entry of the Jacobian matrix, so it comes last.
        let was_consistent = || self.keeps_constraints() && start::check(mechanism, state, *step).is_ok();
        if !has_lost_half || !has_jumped() || !was_consistent() {
            return Ok(());
        }
        let [here, there] = [state, next].map(|at| mechanism.worst_pivot(at.t, &at.q));
        let after = there.map_or(M::Real::from_f64(1.0), |(_, growth)| growth);
        if start::check_feedback(mechanism, next, after, *step).is_ok() {
            return Ok(());
        }
        let worst = match [here, there] {
            [Some(here), Some(there)] if there.1 > here.1 => Some(there),
            [here, there] => here.or(there),
        };
        let pivot = worst.and_then(|(at, _)| M::INFO.pivots.get(at));
        let (constraint, coordinate) = pivot.map_or(("", ""), |pivot| (pivot.constraint, pivot.coordinate));
        Err(Error::Singular { t: state.t.to_f64(), constraint, coordinate, growth: growth.to_f64() })
    }

    /// Why a step failed: an input, or a position that cannot be reached from one that
    /// was good, or what the step says.
    #[cold]
    pub(super) fn cause(&self, error: Error, t_next: M::Real) -> Error {
        if let Err(input) = check_inputs::<M>(&self.inputs) {
            return input;
        }
        let Self { mechanism, state, inputs, gains, step, .. } = self;
        let is_good = mechanism.stabilized(state, inputs, gains).growth < growth_limit()
            && mechanism.phi(t_next, &state.q).is_finite();
        if !is_good || !self.keeps_constraints() || reach(mechanism, state, inputs, *step).is_err() {
            return error;
        }
        reach(mechanism, &State { t: t_next, ..*state }, inputs, *step).err().unwrap_or(error)
    }

    /// Whether redundant constraints, which steps do not look at, are met all the same.
    #[inline(always)]
    pub(super) fn keeps_redundant(&self, at: &State<M::Coordinates>) -> bool {
        spare::margin(&self.mechanism, at, self.watch.length) >= M::Real::default()
    }

    /// Whether a violation is meant to decay.
    fn keeps_constraints(&self) -> bool {
        self.baumgarte.is_stable(self.step.to_f64())
    }

    /// Takes values and not references, so that what is healthy need not be in memory.
    #[cold]
    pub(super) fn examine(
        &self,
        acceleration: M::Coordinates,
        multipliers: M::Constraints,
        growth: M::Real,
    ) -> Result<(), Error> {
        let (t, q) = (self.state.t, &self.state.q);
        let solution = Solution { t, q, value: &acceleration, growth, pivots: M::INFO.pivots };
        check_solution(&solution, || self.mechanism.worst_pivot(t, q))
            .and_then(|()| check_defined(t, "the multiplier of constraint", multipliers))
            .map_err(|error| self.blame_inputs(error))
    }

    /// An input that is not finite is the cause of whatever failed after it.
    #[cold]
    fn blame_inputs(&self, error: Error) -> Error {
        match check_inputs::<M>(&self.inputs) {
            Ok(()) => error,
            Err(bad_input) => bad_input,
        }
    }
}

/// Refuses results that are not finite.
#[cold]
pub(super) fn check_defined<C: Components>(t: C::Real, what: &'static str, results: C) -> Result<(), Error> {
    for (&value, &name) in results.into_array().as_ref().iter().zip(C::NAMES) {
        if !value.is_finite() {
            return Err(Error::Undefined { t: t.to_f64(), what, name, value: value.to_f64() });
        }
    }
    Ok(())
}

pub(super) fn check_inputs<M: Mechanism>(inputs: &M::Inputs) -> Result<(), Error> {
    let array = inputs.into_array();
    for (&value, &name) in array.as_ref().iter().zip(M::Inputs::NAMES) {
        if !value.is_finite() {
            return Err(Error::Input { name, value: value.to_f64() });
        }
    }
    Ok(())
}
