//! The meanings of the names of a declaration, as far as they are known.

use std::collections::BTreeMap;

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Expr, SplineId, Symbol};
use proc_macro2::Span;

use crate::mechanics::elements::Exerts;
use crate::mechanics::joints::{self, Connection, JointKind};
use crate::mechanics::{self, Inertia, Outline, Particle, Work};
use crate::syntax::{Attachment, Formula, Vector};

/// The name of the body without coordinates, at the origin.
pub const GROUND: &str = "ground";

/// An expression with its dimension; `None` for the literal 0, which fits any.
#[derive(Clone, Copy)]
pub struct Typed {
    pub expr: Expr,
    pub dimension: Option<Dimension>,
}

/// The meaning of a name in a formula.
pub enum Value<'a> {
    Symbol {
        symbol: Symbol,
        dimension: Dimension,
        span: Span,
    },
    Definition(Definition<'a>),
    /// Declared with an error: what uses it has none of its own.
    Refused(Span),
}

/// A `let` or `const`, resolved when first needed.
pub struct Definition<'a> {
    pub formula: &'a Formula,
    pub is_constant: bool,
    pub span: Span,
    pub state: State,
}

#[derive(Clone, Copy)]
pub enum State {
    Untouched,
    /// Being resolved: meeting it again is a cycle.
    Open,
    Done(Typed),
    Failed,
}

impl Value<'_> {
    pub fn span(&self) -> Span {
        match self {
            Self::Symbol { span, .. } => *span,
            Self::Definition(definition) => definition.span,
            Self::Refused(span) => *span,
        }
    }
}

/// A body as the frame of its points.
pub struct Frame<'a> {
    /// The names of its coordinates.
    pub coordinates: Vec<String>,
    pub origin: [Expr; 2],
    pub angle: Expr,
    /// Its coordinates have errors: what uses it has none of its own.
    pub is_broken: bool,
    pub points: BTreeMap<String, Point<'a>>,
}

/// A point on a body.
pub struct Point<'a> {
    pub span: Span,
    pub place: &'a Vector,
    pub local: Local,
    /// The outline about it, once that is read.
    pub outline: Option<Outline>,
}

/// The place of a point on its body.
#[derive(Clone, Copy)]
pub enum Local {
    Untouched,
    /// Being resolved: meeting it again is a cycle.
    Open,
    Failed,
    Done([Expr; 2]),
}

impl Frame<'_> {
    pub fn new(coordinates: Vec<String>, origin: [Expr; 2], angle: Expr) -> Self {
        Self { coordinates, origin, angle, is_broken: false, points: BTreeMap::new() }
    }

    /// The place on the body of the point called `name`, if there is one.
    pub fn local(&self, name: &str) -> Option<[Expr; 2]> {
        match self.points.get(name)?.local {
            Local::Done(local) => Some(local),
            Local::Untouched | Local::Open | Local::Failed => None,
        }
    }
}

/// A table as formulas know it.
pub struct Table<'a> {
    pub span: Span,
    pub points: &'a crate::syntax::Table,
    pub curve: Curve,
}

/// The spline of a table.
#[derive(Clone, Copy)]
pub enum Curve {
    Untouched,
    /// Being resolved: meeting it again is a cycle.
    Open,
    Failed,
    Done {
        spline: SplineId,
        argument: Dimension,
        value: Dimension,
    },
    /// Of two arguments: where it stands among the surfaces.
    Surface {
        at: usize,
        arguments: [Dimension; 2],
        value: Dimension,
    },
}

/// A stop.
#[derive(Clone, Copy)]
pub struct KnownStop {
    pub impulse: Symbol,
    /// Nothing where no output and no condition asks for it.
    pub force: Option<Symbol>,
    /// The dimension of its force, once its gap is read.
    pub dimension: Option<Dimension>,
}

/// A constraint or a drive.
pub struct Row {
    /// Its place among the constraints; nothing of a row of a mode.
    pub position: Option<usize>,
    pub is_drive: bool,
    pub span: Span,
    pub multiplier: Symbol,
    /// Dimension of Φ; known once the constraint is resolved.
    pub dimension: Option<Dimension>,
    /// Known with the dimension.
    pub phi: Option<Expr>,
    /// The same of an equation between rates.
    pub rate: Option<Expr>,
    /// Its equation has errors, which are reported there.
    pub is_broken: bool,
}

/// A declared joint.
pub struct KnownJoint {
    pub kind: &'static JointKind,
    pub span: Span,
    pub ends: [Attachment; 2],
    /// Those of its rows that it has, with their multipliers.
    pub rows: Vec<(&'static joints::Row, Symbol)>,
    /// Known once its rows are.
    pub connection: Option<Connection>,
}

/// A named force, torque or element.
pub struct Source {
    /// The word that declares it.
    pub word: &'static str,
    pub span: Span,
    /// Where it acts between two places.
    pub ends: Option<[Attachment; 2]>,
    pub work: Vec<Work>,
    /// The scalar that it exerts, if it has one.
    pub exerts: Option<Exerts>,
}

/// The parts of the energies: inertias, particles, and the energies of springs.
pub struct Energies {
    pub inertias: Vec<Inertia>,
    pub particles: Vec<Particle>,
    pub gravity: [Expr; 2],
    pub springs: Vec<Expr>,
}

impl Energies {
    /// The same, borrowed.
    pub fn parts(&self) -> mechanics::Energies<'_> {
        let Self { inertias, particles, gravity, springs } = self;
        mechanics::Energies { inertias, particles, gravity: *gravity, springs }
    }
}
