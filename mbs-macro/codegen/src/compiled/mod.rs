//! A compiled mechanism as a value: what a target prints, or runs at once.
//!
//! # What a target needs to know
//! A [`Compiled`] holds programs: lists of instructions on scalars without branches or
//! loops, one per [`FunctionId`], in SI units. An instruction reads numbers, results of
//! earlier instructions, values that depend on parameters alone, and symbols:
//! [`Compiled::input`] tells what a symbol stands for (a parameter, a coordinate, the
//! time, …). [`FunctionId::arguments`] lists what a function is given,
//! [`FunctionId::results`] what its outputs are, one kind after the other;
//! [`Compiled::length`] counts them.
//!
//! - [`FunctionId::Hoisted`] computes what depends on parameters alone, once per set of
//!   parameters; all other functions read its results as [`Operand::Hoisted`].
//! - [`FunctionId::Conditions`] gives numbers that [`Compiled::conditions`] judge: a
//!   target refuses parameters that fail one, with the words that stand there.
//! - [`FunctionId::Stabilized`] gives the accelerations of the first stage of a step,
//!   [`FunctionId::Constrained`] those of the stages that are given its feedback, [`FunctionId::Reactions`] those without feedback and the
//!   multipliers. The last output of a function that solves is its pivot growth. Where
//!   the growth exceeds [`GROWTH_LIMIT`] or is not a number, the
//!   position is singular and the result must not be used.
//!
//! The example `python` of this crate is a whole target in fifty lines;
//! [`targets::c`](crate::targets::c) is one with loops, a start and a watch.
//!
//! # Example
//! ```
//! use mbs_codegen::{FunctionId, analyse};
//!
//! let declaration = "Pendulum {
//!     dof = 1;
//!     param length = 1 [m];
//!     gravity = (0, -9.81) [m/s^2];
//!     body bob (x, y) { mass = 2 [kg]; }
//!     constraint rod: x^2 + y^2 = length^2;
//!     start { x = length; guess y = 0; }
//! }";
//! let compiled = analyse(declaration.parse()?)?;
//! assert_eq!(compiled.name, "Pendulum");
//! let phi = compiled.program(FunctionId::Phi);
//! assert_eq!(phi.outputs.len(), compiled.constraints.len());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod build;
mod contacts;
mod costs;
mod derivation;
mod tangents;
mod transposes;
mod vectors;

use std::rc::Rc;

use mbs_interface::Tableau;
use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Operand, Program, Spline, Symbol};
use proc_macro2::{Ident, Span, TokenStream};

use crate::diagnostics::Diagnostic;

pub use crate::inputs::Input;
pub use crate::plan::{FusedStep, Kinds, Knots};
pub use crate::quantity::{Comparison, Crossing, Quantity, Setting};
pub use contacts::{Friction, Lock, Mode, Stop, Transition};
pub use costs::Count;
pub use derivation::{Derivation, Elimination, Formula};
pub use mbs_interface::{Argument, FunctionId, Property, Results};
pub use transposes::{Transposed, Transposes};
pub use vectors::Vector;

/// The pivot growth from which on a position is singular to double precision: of 53 bits
/// ten are left.
pub const GROWTH_LIMIT: f64 = 1.0 / (1024.0 * f64::EPSILON);

/// A compiled mechanism; see the [module](self).
pub struct Compiled {
    /// The name of the mechanism.
    pub name: String,
    /// Its documentation in the declaration.
    pub doc: String,
    /// Numbers that are set once, with their declared values.
    pub parameters: Vec<Setting>,
    /// The conditions on parameters.
    pub conditions: Vec<Condition>,
    /// Numbers that the embedding program may change from step to step, with their values at first.
    pub inputs: Vec<Setting>,
    /// The coordinates q of bodies, whose rates v have the same names, and behind them the states of the
    /// declaration's own: each is the rate in a block of which q is its integral.
    pub coordinates: Vec<Quantity>,
    /// How many coordinates are of bodies: own states stand behind them.
    pub line_count: usize,
    /// The coordinates that are integrated, by position: all, unless the declaration reduces
    /// them to those that no constraint gives.
    pub states: Vec<usize>,
    /// Coordinates, by position, that are the x of a body whose y follows.
    pub places: Vec<usize>,
    /// The constraints Φ(q, t) = 0, one multiplier each.
    pub constraints: Vec<Constraint>,
    /// The declared outputs.
    pub outputs: Vec<Quantity>,
    /// Moments that runs find.
    pub events: Vec<Event>,
    /// Coordinates less independent constraints.
    pub degrees_of_freedom: i32,
    /// Constraints that are met with others, by position, and watched: those that repeat what others say, and then those
    /// with which they take turns. All share the multipliers by the minimum norm.
    pub redundant: Vec<usize>,
    /// True if forces depend on positions or velocities, so that an implicit stage is more than
    /// an explicit one.
    pub has_stiffness: bool,
    /// The coordinates, by position, along which forces act that depend on velocities or on
    /// reactions.
    pub velocity_forces: Vec<usize>,
    /// The coordinates, by position, whose value at the start is declared and no guess, and those whose rate
    /// is.
    pub kept: [Vec<usize>; 2],
    /// q, v and t of the start with declared parameters, before guesses are corrected.
    pub start: Vec<f64>,
    /// Functions given by a table, in the order of their handles.
    pub splines: Vec<Rc<Spline>>,
    /// The knots of the values of [`FunctionId::Corners`].
    pub corners: Vec<Knots>,
    /// The values of [`FunctionId::Switches`], as people read them, with their knots.
    pub switches: Vec<(String, Knots)>,
    /// The clocks and the memories that they set.
    pub sampling: Sampling,
    /// The ends of the way.
    pub stops: Vec<Stop>,
    /// Friction that sticks.
    pub frictions: Vec<Friction>,
    /// The modes.
    pub modes: Vec<Mode>,
    /// Their constraints.
    pub locks: Vec<Lock>,
    /// The conditions that enter and leave them, and set memories.
    pub transitions: Vec<Transition>,
    /// Row and column of every result of [`FunctionId::PhiQ`].
    pub jacobian: Vec<(usize, usize)>,
    /// Row and column of every result of [`FunctionId::Mass`], each pair of coordinates once.
    pub masses: Vec<(usize, usize)>,
    /// The pivot of each result of [`FunctionId::Pivots`].
    pub pivots: Vec<Pivot>,
    /// The pivot of each result of [`FunctionId::StartPivots`].
    pub start_pivots: Vec<Pivot>,
    /// A whole step as one program, where the mechanism is small enough for that to pay.
    pub fused_step: Option<FusedStep>,
    /// The equations and their elimination, for people to read.
    pub derivation: Derivation,
    /// The points, bodies and links of a picture.
    pub sketch: Sketch,
    /// The declared choices for the integration.
    pub choices: Choices,
    /// Warnings about parts that compile and are likely mistakes: parameters, inputs, definitions and tables that
    /// nothing uses, and those that leave their dwells.
    pub warnings: Vec<Diagnostic>,
    /// The parts that the Rust target takes over as they were written.
    pub written: Written,
    symbols: Vec<(String, Input)>,
    programs: Vec<Program>,
}

/// A condition on parameters: how a result of [`FunctionId::Conditions`] has to compare
/// with 0.
pub struct Condition {
    /// The name of the parameter, formula or property that is judged, as people call it.
    pub name: String,
    /// Its value, a result of [`FunctionId::Conditions`].
    pub value: usize,
    /// The result that is compared with 0, another one or the same.
    pub difference: usize,
    /// The comparison that has to hold.
    pub comparison: Comparison,
    /// The condition in words.
    pub requirement: String,
}

/// A constraint.
pub struct Constraint {
    /// Its name.
    pub name: String,
    /// Its documentation.
    pub doc: String,
    /// Φ, or Φ̇ of an equation between rates, unless it is too long to read.
    pub formula: String,
    /// True if it prescribes a motion over time.
    pub is_drive: bool,
    /// True of an equation between rates: its Φ is 0, and it restricts no position.
    pub is_rate: bool,
    /// The dimension of Φ.
    pub dimension: Dimension,
}

/// The clocks of a mechanism, and what they set: memories, which stand behind the inputs that a program sets.
pub struct Sampling {
    /// The number of memories, the last of the inputs.
    pub memories: usize,
    /// The number of clocks.
    pub clocks: usize,
    /// The clock and the memory, by its place among the inputs, of every result of [`FunctionId::Samples`]. Transitions
    /// count behind the clocks.
    pub samples: Vec<[usize; 2]>,
}

/// A change of sign of a value that [`FunctionId::Events`] gives.
pub struct Event {
    /// Its name, documentation and unit.
    pub quantity: Quantity,
    /// Which changes of sign it is.
    pub crossing: Crossing,
}

/// A watched pivot of the elimination: the names of its row and its column, empty
/// where it has none.
pub struct Pivot {
    /// The name of the constraint.
    pub constraint: String,
    /// The name of the coordinate.
    pub coordinate: String,
}

/// The names and links of a picture; [`FunctionId::Points`] gives x and y of every point.
#[derive(Default)]
pub struct Sketch {
    /// Names of the points.
    pub points: Vec<String>,
    /// The bodies, and behind them the points of the ground that move, each as one.
    pub bodies: Vec<SketchBody>,
    /// The points of the ground, the origin first.
    pub ground: Vec<usize>,
    /// The points at which particles are.
    pub particles: Vec<usize>,
    /// The joints between points.
    pub joints: Vec<Link>,
    /// The springs and other elements between two points.
    pub springs: Vec<Link>,
}

/// A body of a picture.
pub struct SketchBody {
    /// Its name.
    pub name: String,
    /// Its points, its centre first.
    pub points: Vec<usize>,
    /// False if a point of it moves on it.
    pub is_rigid: bool,
}

/// A joint or a spring between two points.
#[derive(Clone)]
pub struct Link {
    /// Its name.
    pub name: String,
    /// The word that declares it.
    pub kind: &'static str,
    /// Its points, by position.
    pub first: usize,
    /// The other one.
    pub second: usize,
    /// A point ahead of the second one in the direction of a joint.
    pub ahead: Option<usize>,
}

/// The choices of a declaration for its integration.
pub struct Choices {
    /// Instructions that a program may have before its repeated parts become loops.
    pub unrolled: usize,
    /// Bytes of stack that a step in doubles may take.
    pub stack: Option<u32>,
    /// The step in s.
    pub step: Option<f64>,
    /// The scheme of its steps, which is that of [`Compiled::fused_step`].
    pub scheme: &'static Tableau,
    /// `true` if the declaration names the scheme, `false` if it is the default.
    pub declares_scheme: bool,
    /// The feedback of the constraint violation; it comes with a step.
    pub feedback: Option<Feedback>,
    /// True if runs are to be differentiated in reverse, which takes [`Compiled::transposes`].
    pub has_reverse: bool,
}

/// Feedback −2αΦ̇ − β²Φ of the constraint violation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feedback {
    /// True if all stages of a step are given that of the first.
    pub is_held: bool,
    /// α in 1/s
    pub alpha: f64,
    /// β in 1/s
    pub beta: f64,
}

impl Feedback {
    /// The message of the error for feedback that is unstable with steps of `step` seconds.
    pub fn refusal(&self, step: f64) -> String {
        let Self { is_held, alpha, beta } = self;
        let word = if *is_held { "held" } else { "per-stage" };
        format!(
            "the gains alpha = {alpha} 1/s, beta = {beta} 1/s are unstable with {word} feedback and a step of {step} s: \
             the constraint violation would grow; reduce them or the step"
        )
    }
}

/// The parts of the declaration that the Rust target takes over as they were written.
pub struct Written {
    /// The name with its place.
    pub name: Ident,
    /// `pub`, or what else stands before the name.
    pub visibility: TokenStream,
    /// The path of the runtime.
    pub runtime: TokenStream,
    /// The place of the limit of the stack.
    pub stack: Option<Span>,
    /// The place of the feedback.
    pub feedback: Option<Span>,
}

impl Compiled {
    /// The program of a function.
    pub fn program(&self, function: FunctionId) -> &Program {
        &self.programs[function as usize]
    }

    /// The meaning of a symbol of the programs. The symbols behind those of the mechanism are the weights
    /// of a transposed program.
    pub fn input(&self, symbol: Symbol) -> Input {
        let weight = || Input::Weight(symbol.index() - self.symbols.len());
        self.symbols.get(symbol.index()).map_or_else(weight, |(_, input)| *input)
    }

    /// How many symbols the mechanism has.
    pub fn symbol_count(&self) -> usize {
        self.symbols.len()
    }

    /// The name of a symbol.
    pub fn symbol_name(&self, symbol: Symbol) -> &str {
        self.symbols.get(symbol.index()).map_or("weight", |(name, _)| name)
    }

    /// The meaning of an operand, if it is a symbol.
    pub fn input_of(&self, operand: Operand) -> Option<Input> {
        match operand {
            Operand::Symbol(symbol) => Some(self.input(symbol)),
            _ => None,
        }
    }

    /// The declared start of a coordinate, or of an own state.
    pub fn declared_start(&self, coordinate: usize) -> f64 {
        let is_own = coordinate >= self.line_count;
        let at = if is_own { self.coordinates.len() + coordinate } else { coordinate };
        self.start.get(at).copied().unwrap_or_default()
    }

    /// True if an input begins at another value than 0.
    pub fn has_declared_inputs(&self) -> bool {
        self.inputs.iter().any(|input| input.value != 0.0)
    }

    /// True if some coordinates are not integrated.
    pub fn has_reduced_states(&self) -> bool {
        self.states.len() < self.coordinates.len()
    }

    /// The length of a kind of results.
    pub fn length(&self, result: Results) -> usize {
        match result {
            Results::Hoisted => self.program(FunctionId::Hoisted).outputs.len(),
            Results::Conditions => self.program(FunctionId::Conditions).outputs.len(),
            Results::Coordinates => self.coordinates.len(),
            Results::States => self.states.len(),
            Results::Constraints => self.constraints.len(),
            Results::Jacobian => self.jacobian.len(),
            Results::Masses => self.masses.len(),
            Results::Pivots => self.pivots.len(),
            Results::StartPivots => self.start_pivots.len(),
            Results::Outputs => self.outputs.len(),
            Results::Events => self.events.len(),
            Results::Corners => 2 * self.corners.len(),
            Results::Switches => self.switches.len(),
            Results::Clocks => 2 * self.sampling.clocks,
            Results::Samples => self.sampling.samples.len(),
            Results::Transitions => self.transitions.len(),
            Results::Stops => 2 * self.stops.len() + self.rubbing().count(),
            Results::Gaps => 3 * self.contacts(),
            Results::Limits => 2 * self.frictions.len(),
            Results::Contacts => self.contact_count(),
            Results::Points => 2 * self.sketch.points.len(),
            Results::Scalar | Results::Growth => 1,
        }
    }
}
