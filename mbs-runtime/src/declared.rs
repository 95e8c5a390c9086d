//! Stops, friction that sticks and events, as they are declared.

use crate::info::{Dimension, Direction};

/// An end of the way that is declared: its gap is 0 where it is touched, and never negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeclaredStop {
    /// Its name.
    pub name: &'static str,
    /// Its documentation.
    pub doc: &'static str,
    /// The unit of its gap.
    pub unit: &'static str,
    /// The dimension of its gap.
    pub dimension: Dimension,
    /// The place among the inputs of the memory that is 1 while it is rested on; that of the sum of its impulses is behind
    /// it.
    pub memory: usize,
    /// The place among the inputs of the memory of the force with which it bears what rests on it, if an output or a
    /// condition asks for that.
    pub force: Option<usize>,
    /// The gap, unless it is too long to read.
    pub formula: &'static str,
}

/// Friction that is declared with `law = coulomb`, or at a stop: it holds still what does not overcome it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DeclaredFriction {
    /// Its name.
    pub name: &'static str,
    /// The place among the inputs of the memory of the direction in which it slides, −1 or 1, and 0 while it sticks; that of
    /// the force with which it holds is behind it.
    pub memory: usize,
    /// The size of the force while it slides, and the largest one with which it sticks, unless they are too long to read.
    pub limits: [&'static str; 2],
    /// The stop that it rubs on by its place, of whose force the limits are shares then.
    pub stop: Option<usize>,
}

/// The modes of a mechanism: constraints that come and go, and what enters and leaves them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Modes {
    /// The modes.
    pub modes: &'static [DeclaredMode],
    /// Their constraints.
    pub locks: &'static [DeclaredLock],
    /// Their transitions.
    pub transitions: &'static [DeclaredTransition],
}

impl Modes {
    /// A mechanism without modes and transitions.
    pub const NONE: Self = Self { modes: &[], locks: &[], transitions: &[] };
}

/// Constraints that come and go together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DeclaredMode {
    /// Its name.
    pub name: &'static str,
    /// The place among the inputs of the memory that is 1 while it holds.
    pub memory: usize,
}

/// A constraint of a mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DeclaredLock {
    /// Its name.
    pub name: &'static str,
    /// The place among the inputs of the memory of its mode.
    pub mode: usize,
    /// That of the memory of its multiplier while it holds.
    pub held: usize,
    /// True of an equation between rates, which restricts no position.
    pub is_rate: bool,
    /// Φ, or Φ̇ of an equation between rates, unless it is too long to read.
    pub formula: &'static str,
}

/// A transition: a sample, as a clock takes them, at the moment in which a condition begins to hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DeclaredTransition {
    /// The condition as it was written.
    pub condition: &'static str,
    /// True if it holds where its value is positive.
    pub is_rising: bool,
    /// True if it does not hold where its value is 0 at the start.
    pub is_strict: bool,
    /// True if it holds within rounding of 0: unless it is strict and of inputs alone, which jump.
    pub holds_near: bool,
    /// True if its value depends on forces or accelerations, which a run solves for.
    pub sees_forces: bool,
    /// The place among the inputs of the memory of the sign that the value had last.
    pub memory: usize,
}

/// A declared change of sign of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeclaredEvent {
    /// Its name.
    pub name: &'static str,
    /// Its doc comment.
    pub doc: &'static str,
    /// Dimension of the value.
    pub dimension: Dimension,
    /// Which changes of sign it is.
    pub direction: Direction,
}
