//! The declaration with names resolved and dimensions checked.
//!
//! After this stage there are no names to look up and no units: only symbols,
//! expressions in SI units, and positions in lists.

mod cams;
mod choices;
mod clauses;
mod connections;
mod declare;
mod definitions;
mod elements;
mod energies;
mod events;
mod formula;
mod frictions;
mod functions;
mod hints;
mod known;
mod laws;
mod loads;
mod measures;
mod memories;
mod modes;
mod names;
mod outlines;
mod particles;
mod places;
mod rates;
mod reactions;
mod resolver;
mod samples;
mod settings;
mod sketch;
mod soft_stops;
mod solver;
mod starts;
mod statements;
mod states;
mod stop_properties;
mod stops;
mod surfaces;
mod tables;
mod warnings;

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Arena, Expr, Stage, Symbol};
use proc_macro2::{Span, TokenStream};

pub use memories::{Clock, Contact, Friction, Lock, Mode, Stop, Transition};
pub use resolver::resolve;
pub use sketch::{Body as SketchBody, Link, Sketch};
pub use solver::Solver;

use crate::diagnostics::Diagnostic;
use crate::mechanics::{Inertia, Load, Motion, Particle, Work};
use crate::quantity::{Comparison, Crossing, Quantity, Setting};

/// A resolved mechanism.
pub struct Model {
    pub arena: Arena,
    /// The meaning of each symbol of the arena, by its index.
    pub meanings: Vec<Meaning>,
    pub time: Symbol,
    pub doc: String,
    pub visibility: TokenStream,
    pub name: proc_macro2::Ident,
    /// Where the runtime is found; `::mbs_runtime` by default.
    pub runtime: TokenStream,
    pub dof: (i64, Span),
    /// Where redundant constraints are allowed, if they are.
    pub minimum_norm: Option<Span>,
    pub solver: Solver,
    pub parameters: Vec<Setting>,
    pub requirements: Vec<Requirement>,
    /// The inputs that a program sets, and behind them the memories, which clocks set.
    pub inputs: Vec<Setting>,
    /// The number of memories among the inputs.
    pub memories: usize,
    pub clocks: Vec<Clock>,
    pub coordinates: Vec<Coordinate>,
    pub bodies: Vec<Body>,
    /// The inertia of each coordinate.
    pub inertias: Vec<Inertia>,
    pub particles: Vec<Particle>,
    pub particle_names: Vec<proc_macro2::Ident>,
    pub motion: Motion,
    pub constraints: Vec<Constraint>,
    pub gravity: [Expr; 2],
    pub loads: Vec<Load>,
    /// Loads that depend on multipliers.
    pub reactive_loads: Vec<ReactiveLoad>,
    /// The checks on properties of joints and elements.
    pub checks: Vec<Check>,
    /// Places of springs that must not coincide.
    pub gaps: Vec<Gap>,
    /// Energies of springs.
    pub potentials: Vec<Expr>,
    pub start: Vec<Start>,
    /// The time at which it starts in s.
    pub start_time: Expr,
    pub closes: Option<Closes>,
    pub outputs: Vec<Output>,
    pub events: Vec<Event>,
    pub stops: Vec<Stop>,
    pub frictions: Vec<Friction>,
    pub modes: Vec<Mode>,
    pub locks: Vec<Lock>,
    pub transitions: Vec<Transition>,
    pub sketch: Sketch,
    /// Warnings about parts that compile and are likely mistakes.
    pub warnings: Vec<Diagnostic>,
}

/// The meaning of a symbol.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    Time,
    Parameter(usize),
    Input(usize),
    Coordinate(usize),
    Velocity(usize),
    Acceleration(usize),
    Multiplier(usize),
}

/// A condition on parameters, checked when a mechanism is built.
pub struct Requirement {
    /// The parameter whose condition it is, or the left side as it was written.
    pub name: String,
    /// The value of the parameter or of the left side.
    pub value: Expr,
    /// left − right
    pub difference: Expr,
    pub comparison: Comparison,
    /// In words, for the run-time error.
    pub text: String,
    pub span: Span,
}

impl Requirement {
    /// True if it stands in the declaration as it is told.
    pub fn is_written(&self) -> bool {
        self.text.ends_with("has to hold")
    }
}

/// A coordinate of a body or of its own, or a state of the declaration's own.
///
/// The state of a run is made of blocks of two numbers. A state z of the declaration's own is the
/// velocity of such a block, with a mass of 1: ż = f is the equation of motion of a coordinate
/// without constraints. Its position is ∫ z dt. No formula can name it, so nothing depends on it.
/// In this way every method, target and path that integrates velocities integrates own states.
pub struct Coordinate {
    pub quantity: Quantity,
    pub span: Span,
    pub position: Symbol,
    pub velocity: Symbol,
    pub block: Block,
}

/// The kind of a block of the state.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Block {
    /// A coordinate of a body and its velocity.
    Line { body: usize, direction: Direction },
    /// A coordinate of its own and its velocity: points and equations use it.
    Free,
    /// A state of the declaration's own and its integral.
    Own,
}

impl Coordinate {
    /// Its body, if it has one.
    pub fn body(&self) -> Option<usize> {
        match self.block {
            Block::Line { body, .. } => Some(body),
            Block::Free | Block::Own => None,
        }
    }

    /// Its direction, if it is that of a body.
    pub fn direction(&self) -> Option<Direction> {
        match self.block {
            Block::Line { direction, .. } => Some(direction),
            Block::Free | Block::Own => None,
        }
    }

    /// True if it is an angle, of a body or of its own.
    pub fn is_angle(&self) -> bool {
        match self.block {
            Block::Line { direction, .. } => direction == Direction::Angle,
            Block::Free => self.quantity.dimension == Dimension::NONE,
            Block::Own => false,
        }
    }

    /// True if it is a state of the declaration's own.
    pub fn is_own(&self) -> bool {
        self.block == Block::Own
    }
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Direction {
    X,
    Y,
    Angle,
}

pub struct Body {
    pub name: String,
    pub span: Span,
    /// Positions in `coordinates`.
    pub coordinates: Vec<usize>,
    pub mass: Expr,
    pub inertia: Expr,
}

pub struct Constraint {
    pub name: String,
    pub source: Source,
    pub doc: String,
    pub span: Span,
    pub is_drive: bool,
    /// Φ; 0 of an equation between rates, which no position violates.
    pub phi: Expr,
    /// Φ̇ of an equation between rates, linear in the velocities; that of others is the derivative of Φ.
    pub rate: Option<Expr>,
    /// That of Φ; of an equation between rates, that of its integral over time.
    pub dimension: Dimension,
}

impl Constraint {
    /// The equation as it was declared: Φ̇ between rates, and Φ else.
    pub fn declared(&self) -> Expr {
        self.rate.unwrap_or(self.phi)
    }
}

/// The statement that a constraint comes from, in its own words.
#[derive(Clone, PartialEq, Eq)]
pub struct Source {
    pub kind: &'static str,
    pub name: String,
    /// The bodies that a joint connects.
    pub bodies: Option<[String; 2]>,
}

/// A force that depends on multipliers.
pub struct ReactiveLoad {
    pub work: Work,
    /// The name of what exerts it.
    pub span: Span,
}

/// A property of a joint or an element that must be positive, or just not negative.
pub struct Check {
    pub value: Expr,
    pub is_strict: bool,
    pub property: &'static str,
    /// The name of the joint or element.
    pub owner: String,
    pub span: Span,
    /// How to mend a declared value that is 0, where 0 is not allowed.
    pub zero_help: Option<&'static str>,
}

impl Check {
    /// The condition in words.
    pub fn rule(&self) -> &'static str {
        if self.is_strict { "it has to be positive" } else { "it must not be negative" }
    }
}

/// The distance between the places of a spring that has no direction where
/// they coincide.
pub struct Gap {
    pub distance: Expr,
    /// Its length without force.
    pub free: Expr,
    /// That of the spring.
    pub name: proc_macro2::Ident,
}

pub struct Start {
    pub coordinate: usize,
    pub is_rate: bool,
    pub is_guess: bool,
    pub value: Expr,
    pub span: Span,
}

/// A span of the time or of a coordinate over which the mechanism promises to close.
pub struct Closes {
    /// The coordinate; the time without one.
    pub coordinate: Option<usize>,
    pub from: Expr,
    pub to: Expr,
    pub span: Span,
}

pub struct Output {
    pub quantity: Quantity,
    pub value: Expr,
}

/// A change of sign of a value.
pub struct Event {
    pub quantity: Quantity,
    pub value: Expr,
    pub crossing: Crossing,
}

impl Model {
    /// The values along which impulses act: the gaps of stops, and behind them the ways that friction slides.
    pub fn contacts(&self) -> impl Iterator<Item = &Contact> + Clone {
        let frictions = self.frictions.iter().map(|friction| &friction.contact);
        let locks = self.locks.iter().map(|lock| &lock.contact);
        self.stops.iter().map(|stop| &stop.contact).chain(frictions).chain(locks)
    }

    /// Restitution and settling of every stop, behind them the coefficients of those that rub.
    pub fn stop_laws(&self) -> impl Iterator<Item = Expr> {
        let sizes = self.frictions.iter().filter(|friction| friction.stop.is_some());
        let laws = self.stops.iter().flat_map(|stop| [stop.restitution, stop.settle]);
        laws.chain(sizes.map(|friction| friction.limits[0]))
    }

    /// The coordinate of this direction of a body, if it has one.
    pub fn coordinate_of(&self, body: &Body, direction: Direction) -> Option<usize> {
        body.coordinates.iter().copied().find(|&at| self.coordinates[at].direction() == Some(direction))
    }

    /// The number of coordinates, behind which own states stand.
    pub fn line_count(&self) -> usize {
        self.coordinates.iter().filter(|coordinate| !coordinate.is_own()).count()
    }

    /// The rows of these that are equations between positions. No position violates the others, those between rates.
    pub fn of_positions(&self, rows: &[usize]) -> Vec<usize> {
        rows.iter().copied().filter(|&row| self.constraints[row].rate.is_none()).collect()
    }

    /// The checks that parameters alone decide.
    pub fn known_checks(&self) -> impl Iterator<Item = &Check> {
        self.checks.iter().filter(|check| self.arena.stage(check.value) == Stage::Parameter)
    }

    /// Symbol values for evaluation: declared parameters, and `other` for the rest.
    pub fn values<'a>(&'a self, other: impl Fn(Meaning) -> f64 + 'a) -> impl Fn(Symbol) -> f64 + 'a {
        move |symbol| match self.meanings.get(symbol.index()) {
            Some(Meaning::Parameter(at)) => self.parameters[*at].value,
            Some(meaning) => other(*meaning),
            None => f64::NAN,
        }
    }
}
