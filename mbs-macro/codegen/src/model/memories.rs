//! Clocks, stops, friction that sticks, modes and their transitions: a run keeps their decisions in memories.

use mbs_symbolic::Expr;
use proc_macro2::{Ident, Span};

use crate::quantity::Quantity;

/// A clock: it samples at offset + k period, and sets memories one after the other.
pub struct Clock {
    pub period: Expr,
    pub offset: Expr,
    /// The memories by their place among the inputs, each once, with their values in terms of those before the sample.
    pub sets: Vec<(usize, Expr)>,
}

/// A value g of positions along which impulses act: the gap of a stop, or how far friction has slid.
pub struct Contact {
    pub gap: Expr,
    pub rate: Expr,
    /// The second derivative, of the accelerations, too.
    pub acceleration: Expr,
    /// ∂g/∂q for every coordinate q along which it is not 0.
    pub slopes: Vec<(usize, Expr)>,
}

/// Friction that sticks.
pub struct Friction {
    pub quantity: Quantity,
    /// The way that it has slid.
    pub contact: Contact,
    /// The size of the force while it slides, and the largest one with which it sticks; shares of the force of its stop.
    pub limits: [Expr; 2],
    /// The place among the inputs of the memory of the direction of sliding; that of the force that holds is behind it.
    pub memory: usize,
    /// The stop that it rubs on, if it is the friction of one.
    pub stop: Option<usize>,
    pub span: Span,
}

/// Constraints that come and go together.
pub struct Mode {
    pub name: Ident,
    /// The place among the inputs of the memory that is 1 while it holds.
    pub memory: usize,
}

/// A constraint of a mode.
pub struct Lock {
    /// That of a row of a joint, or of a constraint.
    pub name: String,
    pub contact: Contact,
    /// The places among the inputs of the memories of its mode and of its multiplier.
    pub mode: usize,
    pub held: usize,
    pub span: Span,
}

/// A transition: memories that are set where a value changes its sign.
pub struct Transition {
    pub value: Expr,
    pub is_rising: bool,
    pub is_strict: bool,
    /// True if it holds within rounding of 0: unless it is strict and of inputs alone, which jump.
    pub holds_near: bool,
    /// True if its value depends on forces or accelerations, which a run solves for.
    pub sees_forces: bool,
    /// The place among the inputs of the memory of the sign that the value had last.
    pub memory: usize,
    /// The condition as it was written.
    pub text: String,
    /// As those of a clock.
    pub sets: Vec<(usize, Expr)>,
}

/// An end of the way: its gap is 0 there, and never negative.
pub struct Stop {
    /// The name and the unit of the gap.
    pub quantity: Quantity,
    pub contact: Contact,
    pub restitution: Expr,
    pub settle: Expr,
    /// The place among the inputs of the memory that is 1 while it is rested on; that of its impulse is behind it.
    pub memory: usize,
    /// That of the memory of its force, if it is asked for.
    pub force: Option<usize>,
    pub span: Span,
}
