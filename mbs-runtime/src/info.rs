//! The description of a mechanism for tools: names, units, equations, counts.

use crate::declared::{DeclaredEvent, DeclaredFriction, DeclaredStop, Modes};
use crate::error::Error;

/// At most so many contacts has a mechanism: stops, behind them frictions that stick, and constraints of modes.
pub(crate) const MOST_CONTACTS: usize = 16;

/// At most so many events are watched at once.
pub const MOST_EVENTS: usize = 64;

/// A mechanism described for people and tools.
#[doc = include_str!("info.md")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Info {
    /// The declared name.
    pub name: &'static str,
    /// The doc comment, without leading spaces.
    pub doc: &'static str,
    /// Coordinates minus independent constraints.
    pub dof: i32,
    /// The parameters; `default` is the declared value.
    pub parameters: &'static [Quantity],
    /// The inputs; `default` is the declared value, with which every run begins, 0 without one. The last ones may be
    /// memories, which the mechanism sets itself; see [`sampling`](Self::sampling).
    pub inputs: &'static [Quantity],
    /// The coordinates of bodies, and behind them the states of the declaration's own; `default` is the
    /// declared start.
    ///
    /// An own state z is the velocity `v` in its place, and z dt is summed up in `q`; unit and dimension
    /// are those of z.
    pub coordinates: &'static [Quantity],
    /// How many of them are coordinates of bodies.
    pub lines: usize,
    /// The outputs.
    pub outputs: &'static [Quantity],
    /// The moments that runs to a tolerance find.
    pub events: &'static [DeclaredEvent],
    /// The constraints, drives included, in the order of λ.
    pub constraints: &'static [Constraint],
    /// Which coordinates are integrated, as indices; constraints give the others.
    pub states: &'static [usize],
    /// The constraints that are met with others, as indices, and are watched: those that repeat others, and then
    /// those that take turns with them.
    pub redundant: &'static [usize],
    /// Along which coordinates forces act that depend on velocities or on reactions, as indices:
    /// dampers, friction. All other forces are functions of positions, time, inputs and parameters.
    pub velocity_forces: &'static [usize],
    /// Which coordinates start at a declared value that is no guess, as indices, and which start with such a
    /// rate. With other parameters than the declared ones, the constraints may move them.
    pub kept: [&'static [usize]; 2],
    /// The pivots that can vanish.
    pub pivots: &'static [Pivot],
    /// The pivots of the corrections of a start that can vanish.
    pub start_pivots: &'static [Pivot],
    /// The clocks, and the memories among the inputs that they set.
    pub sampling: Sampling,
    /// The ends of the way, which runs to a tolerance hit and rest on.
    pub stops: &'static [DeclaredStop],
    /// Friction that sticks.
    pub frictions: &'static [DeclaredFriction],
    /// Constraints that come and go.
    pub modes: Modes,
    /// Operation counts of the generated functions.
    pub functions: &'static [Function],
}

/// The clocks of a mechanism, and the memories that they set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampling {
    /// The number of memories, the last of the inputs: the mechanism sets them, and no program.
    pub memories: usize,
    /// The number of clocks.
    pub clocks: usize,
    /// Of every value that a sample gives, its clock and its memory, by its place among the inputs.
    pub samples: &'static [[usize; 2]],
}

impl Sampling {
    /// A mechanism without clocks.
    pub const NONE: Self = Self { memories: 0, clocks: 0, samples: &[] };

    /// Sets inputs to what a program gives; memories stay.
    pub(crate) fn set_inputs<T: Copy>(&self, own: &mut [T], given: &[T]) {
        let count = own.len().saturating_sub(self.memories);
        own.iter_mut().zip(given).take(count).for_each(|(own, given)| *own = *given);
    }

    /// Sets memories to those among some inputs.
    pub(crate) fn set_memories<T: Copy>(&self, own: &mut [T], given: &[T]) {
        let count = own.len().saturating_sub(self.memories);
        own.iter_mut().zip(given).skip(count).for_each(|(own, given)| *own = *given);
    }
}

/// A named physical quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// Its name.
    pub name: &'static str,
    /// Its doc comment.
    pub doc: &'static str,
    /// The unit in which it was declared, as text; empty for a bare number.
    pub unit: &'static str,
    /// SI value of one such unit.
    pub scale: f64,
    /// Its dimension.
    pub dimension: Dimension,
    /// Declared value in SI units; 0 where none was declared.
    pub default: f64,
}

/// Which changes of sign are events.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// From negative to positive.
    Rising,
    /// From positive to negative.
    Falling,
    /// Both.
    Either,
}

/// Exponents of the base units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dimension {
    /// The exponent of kg.
    pub mass: i8,
    /// The exponent of m.
    pub length: i8,
    /// The exponent of s.
    pub time: i8,
    /// The exponent of A.
    pub current: i8,
    /// The exponent of K.
    pub temperature: i8,
}

impl Dimension {
    /// kgᵃ·mᵇ·sᶜ
    pub const fn of(mass: i8, length: i8, time: i8) -> Self {
        Self::from_exponents([mass, length, time, 0, 0])
    }

    /// The dimension with these exponents of (mass, length, time, current, temperature).
    pub const fn from_exponents([mass, length, time, current, temperature]: [i8; 5]) -> Self {
        Self { mass, length, time, current, temperature }
    }

    /// The exponents of (mass, length, time, current, temperature).
    pub const fn exponents(self) -> [i8; 5] {
        [self.mass, self.length, self.time, self.current, self.temperature]
    }

    /// The dimension of a quotient.
    ///
    /// # Example
    /// ```
    /// use mbs_runtime::Dimension;
    ///
    /// let (energy, length, time) = (Dimension::of(1, 2, -2), Dimension::of(0, 1, 0), Dimension::of(0, 0, 1));
    /// assert_eq!(energy.over(length), Dimension::of(1, 1, -2));
    /// assert_eq!(length.over(time), Dimension::of(0, 1, -1));
    /// let charge = Dimension::from_exponents([0, 0, 1, 1, 0]);
    /// assert_eq!(energy.over(charge).exponents(), [1, 2, -3, -1, 0]); // V
    /// ```
    #[must_use]
    pub const fn over(self, other: Self) -> Self {
        let (mut exponents, others, mut at) = (self.exponents(), other.exponents(), 0);
        while at < exponents.len() {
            exponents[at] = exponents[at].saturating_sub(others[at]);
            at += 1;
        }
        Self::from_exponents(exponents)
    }
}

/// One constraint row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constraint {
    /// Its name.
    pub name: &'static str,
    /// Its doc comment.
    pub doc: &'static str,
    /// Φ as a formula; of an equation between rates Φ̇.
    pub formula: &'static str,
    /// True if it was declared as a drive.
    pub is_drive: bool,
    /// True of an equation between rates: its Φ is 0, and it restricts no position.
    pub is_rate: bool,
    /// Dimension of Φ.
    pub dimension: Dimension,
}

/// The constraint and the coordinate that a pivot of the elimination pairs; a missing one has no name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pivot {
    /// The constraint.
    pub constraint: &'static str,
    /// The coordinate.
    pub coordinate: &'static str,
}

/// The cost of a generated function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Function {
    /// Its name.
    pub name: &'static str,
    /// Its operations per call.
    pub operations: Operations,
    /// Instructions in its text. Straight lines have one per operation; a loop
    /// has those of one pass.
    pub written: u32,
    /// Loops over repeated parts, of which long functions consist.
    pub loops: u32,
}

/// Floating-point operations, loops counted in full.
///
/// A negation, a subtraction and an addition each count as one addition.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Multiplications.
    pub mul: u32,
    /// Additions, subtractions and negations.
    pub add: u32,
    /// Divisions.
    pub div: u32,
    /// Sine–cosine pairs (a sine or cosine alone counts as one).
    pub sin_cos: u32,
    /// Other elementary functions, comparisons and square roots.
    pub other: u32,
    /// Operations that watch the pivots, counted in none of the above.
    pub watch: u32,
}

impl Info {
    /// The operation counts of the function called `name`.
    pub fn operations(&self, name: &str) -> Option<Operations> {
        self.functions.iter().find(|f| f.name == name).map(|f| f.operations)
    }

    /// The name of a coordinate; empty where there is none.
    pub(crate) fn coordinate_name(&self, at: usize) -> &'static str {
        self.coordinates.get(at).map_or("", |coordinate| coordinate.name)
    }

    /// The name of a coordinate that is integrated; empty where there is none.
    pub(crate) fn state_name(&self, state: usize) -> &'static str {
        let coordinate = self.states.get(state).and_then(|&at| self.coordinates.get(at));
        coordinate.map_or("", |coordinate| coordinate.name)
    }

    /// The part of a vector that is about coordinates of bodies, without own states.
    pub(crate) fn of_bodies<'a, T>(&self, vector: &'a [T]) -> &'a [T] {
        vector.get(..self.lines).unwrap_or(vector)
    }

    /// True if a place among the coordinates is that of an own state.
    pub fn is_own(&self, coordinate: usize) -> bool {
        coordinate >= self.lines
    }

    /// True if constraints give some coordinates, which are not integrated.
    pub fn has_reduced_states(&self) -> bool {
        self.states.len() < self.coordinates.len()
    }

    /// The inputs that a program sets: all but the memories.
    pub fn free_inputs(&self) -> &'static [Quantity] {
        let count = self.inputs.len().saturating_sub(self.sampling.memories);
        self.inputs.get(..count).unwrap_or_default()
    }

    /// The memories, which clocks set.
    pub fn memories(&self) -> &'static [Quantity] {
        self.inputs.get(self.free_inputs().len()..).unwrap_or_default()
    }

    /// The places among the inputs of those that may be set for a run: the inputs of a program, and the modes.
    pub fn settable_inputs(&self) -> impl Iterator<Item = usize> + use<> {
        (0..self.free_inputs().len()).chain(self.modes.modes.iter().map(|mode| mode.memory))
    }

    /// The memories that tell what state a mechanism is in, by their places among the inputs: of clocks and conditions, of
    /// stops and modes, and the directions of frictions. The forces with which stops, frictions and modes hold are no part
    /// of it, nor is what a run remembers of conditions.
    pub fn told_memories(&self) -> impl Iterator<Item = usize> + use<> {
        let (info, first) = (*self, self.free_inputs().len());
        let is_kept = move |at: &usize| {
            info.force_memories().any(|(_, memory)| memory == *at)
                || info.modes.transitions.iter().any(|transition| transition.memory == *at)
        };
        (first..self.inputs.len()).filter(move |at| !is_kept(at))
    }

    /// The name of an event by its index: that of a declared one, or of a stop, which count down from the last of
    /// [`MOST_EVENTS`](crate::MOST_EVENTS), behind them of a friction that sticks, or the condition of a transition.
    pub fn event_name(&self, index: usize) -> Option<&'static str> {
        if let Some(event) = self.events.get(index) {
            return Some(event.name);
        }
        let row = (MOST_EVENTS - 1).checked_sub(index)?;
        if let Some(transition) = row.checked_sub(MOST_CONTACTS) {
            return self.modes.transitions.get(transition).map(|transition| transition.condition);
        }
        match row.checked_sub(self.stops.len()) {
            Some(friction) => self.frictions.get(friction).map(|friction| friction.name),
            None => self.stops.get(row).map(|stop| stop.name),
        }
    }

    /// The error of a position behind a stop, by its place and its gap in SI units.
    pub fn behind(&self, t: f64, stop: usize, gap: f64) -> Error {
        let [stop, unit] = self.stops.get(stop).map_or([""; 2], |stop| [stop.name, stop.unit]);
        Error::Behind { t, stop, gap, unit }
    }

    /// The number of values along which impulses act: the gaps of stops, behind them the ways of frictions that stick, and
    /// behind these the constraints of modes.
    pub const fn contacts(&self) -> usize {
        self.watched_contacts() + self.modes.locks.len()
    }

    /// Those of them that decide themselves whether they hold: stops and frictions.
    pub(crate) const fn watched_contacts(&self) -> usize {
        self.stops.len() + self.frictions.len()
    }

    /// True if conditions of transitions depend on forces or accelerations.
    pub(crate) fn sees_forces(&self) -> bool {
        self.modes.transitions.iter().any(|transition| transition.sees_forces)
    }

    /// True if velocities or memories may jump at the end of a step.
    pub const fn jumps(&self) -> bool {
        self.contacts() + self.modes.transitions.len() > 0
    }

    /// The name of a constraint; empty where there is none.
    pub(crate) fn constraint_name(&self, row: usize) -> &'static str {
        self.constraints.get(row).map_or("", |constraint| constraint.name)
    }

    /// An `Info` from its parts. For generated code.
    #[doc(hidden)]
    #[allow(clippy::too_many_arguments, reason = "one argument per field, called by generated code only")]
    pub const fn from_parts(
        name: &'static str,
        doc: &'static str,
        dof: i32,
        parameters: &'static [Quantity],
        inputs: &'static [Quantity],
        coordinates: &'static [Quantity],
        lines: usize,
        outputs: &'static [Quantity],
        events: &'static [DeclaredEvent],
        constraints: &'static [Constraint],
        states: &'static [usize],
        redundant: &'static [usize],
        velocity_forces: &'static [usize],
        kept: [&'static [usize]; 2],
        pivots: &'static [Pivot],
        start_pivots: &'static [Pivot],
        sampling: Sampling,
        stops: &'static [DeclaredStop],
        frictions: &'static [DeclaredFriction],
        modes: Modes,
        functions: &'static [Function],
    ) -> Self {
        Self {
            name,
            doc,
            dof,
            parameters,
            inputs,
            coordinates,
            lines,
            outputs,
            events,
            constraints,
            states,
            redundant,
            velocity_forces,
            kept,
            pivots,
            start_pivots,
            sampling,
            stops,
            frictions,
            modes,
            functions,
        }
    }
}
