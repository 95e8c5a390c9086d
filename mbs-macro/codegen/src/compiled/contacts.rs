//! Stops and friction that sticks.

use proc_macro2::Span;

use super::{Compiled, Quantity};

/// An end of the way; see [`FunctionId::Gaps`](super::FunctionId::Gaps).
pub struct Stop {
    /// Its name, and the unit of its gap.
    pub quantity: Quantity,
    /// The place among the inputs of the memory that is 1 while it is rested on; that of its impulse is behind it.
    pub memory: usize,
    /// That of the memory of its force, if something asks for it.
    pub force: Option<usize>,
    /// The gap, unless it is too long to read.
    pub formula: String,
    /// Where it is declared.
    pub span: Span,
}

/// Friction that sticks; see [`FunctionId::Limits`](super::FunctionId::Limits).
pub struct Friction {
    /// Its name.
    pub name: String,
    /// The place among the inputs of the memory of the direction of sliding; that of the force that holds is behind it.
    pub memory: usize,
    /// The size of the force while it slides, and the largest one with which it sticks, unless they are too long to read.
    pub limits: [String; 2],
    /// The stop that it rubs on, of whose force the limits are shares then.
    pub stop: Option<usize>,
    /// Where it is declared.
    pub span: Span,
}

/// Constraints that come and go together.
pub struct Mode {
    /// Its name.
    pub name: String,
    /// The place among the inputs of the memory that is 1 while it holds.
    pub memory: usize,
}

/// A constraint of a mode.
pub struct Lock {
    /// Its name.
    pub name: String,
    /// The place among the inputs of the memory of its mode.
    pub mode: usize,
    /// That of the memory of its multiplier.
    pub held: usize,
    /// True of an equation between rates, which restricts no position.
    pub is_rate: bool,
    /// Φ, or Φ̇ of an equation between rates, unless it is too long to read.
    pub formula: String,
    /// Where it is declared.
    pub span: Span,
}

/// A transition: memories that are set where a condition begins to hold; see [`FunctionId::Transitions`](super::FunctionId::Transitions).
pub struct Transition {
    /// The condition as it was written.
    pub text: String,
    /// True if it holds where the value is positive.
    pub is_rising: bool,
    /// True if it does not hold where the value is 0 at the start.
    pub is_strict: bool,
    /// True if it holds within rounding of 0: unless it is strict and of inputs alone, which jump.
    pub holds_near: bool,
    /// True if its value depends on forces or accelerations, which a run solves for.
    pub sees_forces: bool,
    /// The place among the inputs of the memory of the sign that the value had last.
    pub memory: usize,
}

impl Compiled {
    /// The number of results of [`FunctionId::Contacts`](super::FunctionId::Contacts).
    pub(super) fn contact_count(&self) -> usize {
        let contacts = self.contacts();
        let response = 2 * self.coordinates.len() + self.constraints.len() + contacts;
        if contacts == 0 { 0 } else { contacts * (response + 1) + 1 }
    }

    /// The place of the first memory of every stop, behind them of every friction that sticks, and behind these of the modes
    /// of constraints.
    pub fn contact_memories(&self) -> impl Iterator<Item = usize> {
        let frictions = self.frictions.iter().map(|friction| friction.memory);
        let modes = self.locks.iter().map(|lock| lock.mode);
        self.stops.iter().map(|stop| stop.memory).chain(frictions).chain(modes)
    }

    /// The contacts whose forces have a memory of their own, with its place: stops that are asked for theirs, and the
    /// constraints of modes.
    pub fn noted(&self) -> impl Iterator<Item = [usize; 2]> {
        let stops = self.stops.iter().enumerate().filter_map(|(row, stop)| Some([row, stop.force?]));
        let locks = (self.stops.len() + self.frictions.len()..).zip(&self.locks);
        stops.chain(locks.map(|(row, lock)| [row, lock.held]))
    }

    /// True if memories have forces that a run finds: of frictions that stick, of stops, or of constraints of modes.
    pub fn holds(&self) -> bool {
        !self.frictions.is_empty() || self.noted().next().is_some()
    }

    /// The number of stops, of frictions that stick and of constraints of modes.
    pub fn contacts(&self) -> usize {
        self.stops.len() + self.frictions.len() + self.locks.len()
    }

    /// The frictions of stops.
    pub fn rubbing(&self) -> impl Iterator<Item = &Friction> {
        self.frictions.iter().filter(|friction| friction.stop.is_some())
    }

    /// Their rows among the contacts, each with that of its stop.
    pub fn rubbing_rows(&self) -> impl Iterator<Item = [usize; 2]> {
        let rows = (self.stops.len()..).zip(&self.frictions);
        rows.filter_map(|(row, friction)| Some([row, friction.stop?]))
    }

    /// True if conditions of transitions depend on forces or accelerations.
    pub fn sees_forces(&self) -> bool {
        self.transitions.iter().any(|transition| transition.sees_forces)
    }

    /// True if velocities or memories may jump at the end of a step.
    pub fn jumps(&self) -> bool {
        self.contacts() > 0 || !self.transitions.is_empty()
    }
}
