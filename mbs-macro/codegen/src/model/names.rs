//! Names, and where they may stand.

use std::collections::{BTreeMap, BTreeSet};

use mbs_symbolic::{Arena, Stage, Surface, Symbol};
use proc_macro2::{Ident, Span};

use super::Meaning;
use super::Requirement;
use super::known::{Energies, Frame, GROUND, KnownJoint, KnownStop, Row, Source, Table, Typed, Value};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::mechanics::Motion;
use crate::syntax::Attachment;

/// Names that the language itself defines.
pub const RESERVED: &[&str] = &["t", "pi", "der", "lambda", "effort"];

/// Where a formula stands, which decides what it may depend on.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Place {
    Constant,
    Property,
    /// The place of a point on its body.
    Point,
    Constraint,
    /// An equation between rates.
    RateRow,
    /// An energy of the position.
    Potential,
    Load,
    /// The right side of the equation of a state.
    Rate,
    Event,
    /// The value that a clock sets a memory to.
    Sample,
    Anywhere,
}

impl Place {
    pub fn allows(self, meaning: Meaning) -> bool {
        match meaning {
            Meaning::Parameter(_) => self != Self::Constant,
            Meaning::Time => !matches!(self, Self::Constant | Self::Property | Self::Point),
            Meaning::Coordinate(_) => !matches!(self, Self::Constant | Self::Property),
            Meaning::Velocity(_) => !matches!(
                self,
                Self::Constant | Self::Property | Self::Point | Self::Constraint | Self::Potential
            ),
            Meaning::Input(_) => {
                matches!(self, Self::Load | Self::Rate | Self::Event | Self::Sample | Self::Anywhere)
            }
            Meaning::Multiplier(_) => matches!(self, Self::Load | Self::Rate | Self::Anywhere),
            _ => self == Self::Anywhere,
        }
    }

    /// Why something else may not stand here.
    pub fn rule(self) -> &'static str {
        match self {
            Self::Constant => "this value has to be a number: it may use literals, `pi` and `const` names",
            Self::Property => "this value has to be fixed by parameters and constants",
            Self::Point => {
                "the place of a point on its body is written in positions and parameters; what moves it with time is a \
                 `drive` of a `coordinate`"
            }
            Self::Constraint => {
                "a constraint is written in positions, parameters and time; its derivatives are taken for you; an equation \
                 between rates is a `rate`"
            }
            Self::RateRow => {
                "an equation between rates is written in positions, velocities, parameters and time; its derivative is \
                 taken for you"
            }
            Self::Potential => {
                "a potential is written in positions, parameters and time; what depends on velocities, inputs or states is \
                 a `force` or a `dissipation`"
            }
            Self::Load => {
                "a force may depend on positions, velocities, states, reactions, time, inputs and parameters"
            }
            Self::Rate => {
                "the rate of a state may depend on states, positions, velocities, reactions, time, inputs and parameters"
            }
            Self::Event => {
                "an event is written in positions, velocities, states, time, inputs and parameters"
            }
            Self::Sample => {
                "a sample takes positions, velocities, states, memories, time, inputs and parameters; accelerations and \
                 reactions it cannot measure"
            }
            Self::Anywhere => "this cannot stand here",
        }
    }
}

/// A name that is known within one formula only, where it goes before others.
#[derive(Clone, Copy)]
pub struct Local {
    pub name: &'static str,
    pub typed: Typed,
}

/// Everything that a formula can refer to.
pub struct Scope<'a> {
    pub arena: Arena,
    pub meanings: Vec<Meaning>,
    pub motion: Motion,
    pub values: BTreeMap<String, Value<'a>>,
    /// The names of values and tables that formulas use.
    pub used: BTreeSet<String>,
    /// Bodies, and the ground.
    pub bodies: BTreeMap<String, Frame<'a>>,
    /// Where particles are, whose names are those of their places.
    pub particles: BTreeMap<String, &'a Attachment>,
    /// Constraints and drives: position, whether it is a drive, dimension once known.
    pub rows: BTreeMap<String, Row>,
    pub joints: BTreeMap<String, KnownJoint>,
    /// Named forces, torques and elements.
    pub sources: BTreeMap<String, Source>,
    pub stops: BTreeMap<String, KnownStop>,
    /// Known once all forces are.
    pub energies: Option<Energies>,
    pub time: Symbol,
    pub locals: Vec<Local>,
    /// Definitions that are being resolved, one in the other.
    pub depth: usize,
    pub tables: BTreeMap<String, Table<'a>>,
    /// Tables of two arguments.
    pub surfaces: Vec<Surface>,
    /// Where memories begin among the inputs.
    pub first_memory: usize,
    /// Conditions on parameters, those of statements and those of laws in formulas.
    pub requirements: Vec<Requirement>,
}

impl<'a> Scope<'a> {
    pub fn new() -> Self {
        let mut arena = Arena::new();
        let time = arena.symbol("t", Stage::Variable);
        let ground = Frame::new(Vec::new(), [arena.zero(); 2], arena.zero());
        Self {
            arena,
            meanings: vec![Meaning::Time],
            motion: Motion::new(time),
            values: BTreeMap::new(),
            used: BTreeSet::new(),
            bodies: BTreeMap::from([(GROUND.to_owned(), ground)]),
            particles: BTreeMap::new(),
            rows: BTreeMap::new(),
            joints: BTreeMap::new(),
            sources: BTreeMap::new(),
            stops: BTreeMap::new(),
            energies: None,
            time,
            locals: Vec::new(),
            depth: 0,
            first_memory: usize::MAX,
            requirements: Vec::new(),
            tables: BTreeMap::new(),
            surfaces: Vec::new(),
        }
    }

    pub fn symbol(&mut self, name: &str, stage: Stage, meaning: Meaning) -> Symbol {
        self.meanings.push(meaning);
        self.arena.symbol(name, stage)
    }

    pub fn meaning(&self, symbol: Symbol) -> Meaning {
        self.meanings[symbol.index()]
    }

    /// Enters a name that formulas can use.
    pub fn declare(&mut self, name: &Ident, value: Value<'a>, errors: &mut Diagnostics) {
        let text = name.to_string();
        if RESERVED.contains(&text.as_str()) || mbs_symbolic::Function::named(&text).is_some() {
            errors.push(
                Diagnostic::new(
                    name.span(),
                    format!("`{text}` is a word of the language and cannot be declared"),
                )
                .help("choose another name"),
            );
            return;
        }
        if let Some(earlier) = self.values.get(&text) {
            errors.push(duplicate(name, earlier.span()));
            return;
        }
        self.values.insert(text, value);
    }
}

/// The error for a second declaration of a name.
pub fn duplicate(name: &Ident, earlier: Span) -> Diagnostic {
    Diagnostic::new(name.span(), format!("`{name}` is declared twice"))
        .note(earlier, format!("`{name}` is first declared here"))
        .help("rename one of them")
}
