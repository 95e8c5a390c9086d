//! Refusals of mechanisms by methods and analyses.

use crate::{Error, Info};

impl Info {
    /// Refuses equations between rates, for a method.
    pub(crate) fn refuse_rates(&self, method: &'static str) -> Result<(), Error> {
        match self.constraints.iter().find(|row| row.is_rate) {
            Some(row) => Err(Error::Rates { method, constraint: row.name }),
            None => Ok(()),
        }
    }

    /// Refuses constraints that come and go.
    fn refuse_modes(&self, what: &'static str) -> Result<(), Error> {
        match (self.modes.modes.first(), self.modes.transitions.first()) {
            (Some(mode), _) => Err(Error::Modes { what, mode: mode.name }),
            (None, Some(transition)) => Err(Error::Modes { what, mode: transition.condition }),
            (None, None) => Ok(()),
        }
    }

    /// Refuses friction that sticks.
    ///
    /// # Errors
    /// [`Error::Sticks`].
    pub fn refuse_sticking(&self, what: &'static str) -> Result<(), Error> {
        match self.frictions.first() {
            Some(friction) => Err(Error::Sticks { what, friction: friction.name }),
            None => Ok(()),
        }
    }

    /// Refuses stops, friction that sticks and modes, for what sees none of them act.
    ///
    /// # Errors
    /// [`Error::Stops`], [`Error::Sticks`], [`Error::Modes`].
    pub fn refuse_stops(&self, what: &'static str) -> Result<(), Error> {
        self.refuse_modes(what)?;
        self.refuse_sticking(what)?;
        match self.stops.first() {
            Some(stop) => Err(Error::Stops { what, stop: stop.name }),
            None => Ok(()),
        }
    }

    /// Refuses memories that clocks set, for what knows none.
    ///
    /// # Errors
    /// [`Error::Clocks`].
    pub fn refuse_clocks(&self, what: &'static str) -> Result<(), Error> {
        match self.memories().first().filter(|_| self.sampling.clocks > 0) {
            Some(memory) => Err(Error::Clocks { what, memory: memory.name }),
            None => Ok(()),
        }
    }
}
