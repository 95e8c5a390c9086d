//! A run to a tolerance of a mechanism whose coordinates have names.

use super::events::Happened;
use super::{Adaptive, AdaptiveScheme, Moment};
use crate::vectors::assign;
use crate::{Components, Error, Mechanism, Real, State};

impl<M: Mechanism, S: AdaptiveScheme> Adaptive<M, S> {
    /// The mechanism.
    pub fn mechanism(&self) -> &M {
        &self.dynamics
    }

    /// The present state: that at the end of the last step.
    pub fn state(&self) -> State<M::Coordinates> {
        let Moment { t, q, v, .. } = self.now;
        let states = State { t, q: Components::from_array(q), v: Components::from_array(v) };
        Mechanism::complete(&self.dynamics, &states)
    }

    /// The state at `t` seconds, within the last step: positions are those of the polynomial of
    /// fifth degree that has q, v and q̈ of both ends, projected onto the constraints. It is off
    /// by O(h⁶) and its velocities by O(h⁵), beside the errors of the ends.
    ///
    /// [`Dop853`](crate::Dop853) has a polynomial of seventh degree of its own, off by O(h⁸), which takes
    /// three evaluations more in a step that is looked into. [`cover`](Self::cover) keeps them for all
    /// times of a step.
    ///
    /// # Errors
    /// [`Error::EndTime`] for a time outside of the last step; [`cover`](Self::cover) takes steps
    /// until it is inside.
    pub fn at(&self, t: f64) -> Result<State<M::Coordinates>, Error> {
        let t = M::Real::from_f64(t);
        let (q, v) = if S::INTERPOLANT.is_none() || self.between.is_known() {
            self.interpolate(t)?
        } else {
            let mut looked_into = self.clone();
            looked_into.look_between();
            looked_into.interpolate(t)?
        };
        let states = State { t, q: Components::from_array(q), v: Components::from_array(v) };
        Ok(Mechanism::complete(&self.dynamics, &states))
    }

    /// ‖Φ‖ of the present state.
    pub fn violation(&self) -> M::Real {
        Mechanism::phi(&self.dynamics, self.now.t, &self.state().q).norm()
    }

    /// Goes on from another state at the present time or at any other, as a program makes it at an
    /// event: after an impact, or with a latch that has opened. Events at the same time that were
    /// not told yet are told by the next call; those of another time are forgotten.
    ///
    /// Where the state is set at an event, the value of which it turns around, the value counts as before
    /// the event again, whatever its rounding says: a ball whose velocity is turned at the ground is above
    /// it. If it is back before rounding can tell, the next step ends with [`Error::EndlessEvents`].
    ///
    /// # Errors
    /// [`Error::Inconsistent`] for one that violates the constraints, [`Error::NonFinite`].
    pub fn set_state(&mut self, state: State<M::Coordinates>) -> Result<(), Error> {
        crate::start::check(&self.dynamics, &state, M::Real::from_f64(1e-3))?;
        if state.t != self.now.t {
            self.happened = Happened::default();
        } else if !self.happened.is_set {
            self.arrival = self.now;
        }
        self.happened.is_set = true;
        assign(&mut self.now.q, &M::states(state.q).into_array());
        assign(&mut self.now.v, &M::states(state.v).into_array());
        self.now.t = state.t;
        self.is_solved = false;
        self.before = self.now;
        self.between.begin(false);
        self.progress.go_on();
        Ok(())
    }
}
