//! The declaration as it was written: shapes are right, names are unresolved.

mod formula;
mod items;
mod joints;
mod solver;
mod springs;

use mbs_symbolic::Number;
use mbs_symbolic::units::Unit;
use proc_macro2::{Ident, Span, TokenStream};

pub use items::parse;

/// A whole `mechanism! { … }`.
pub struct Declaration {
    pub doc: String,
    pub visibility: TokenStream,
    pub name: Ident,
    pub items: Vec<Item>,
}

/// One statement.
pub struct Item {
    pub doc: String,
    pub kind: ItemKind,
}

pub enum ItemKind {
    /// `dof = 0;`
    Dof { keyword: Span, value: i64 },
    /// `redundant = minimum_norm;`
    Redundant { keyword: Span },
    /// `limit operations = 200;` or `limit stack = 4096;`
    Limit { keyword: Span, is_stack: bool, value: u32 },
    /// `step = 0.5 [ms];`
    Step { keyword: Span, value: Formula },
    /// `feedback = held(alpha, beta);`
    Feedback { keyword: Span, is_held: bool, gains: [Formula; 2] },
    /// `crate = path;`
    Crate { keyword: Span, path: TokenStream },
    /// `param l = 1 [m] where l > 0;`
    Parameter { name: Ident, value: Formula, condition: Option<Condition> },
    /// `const l = 1 [m];`
    Constant { name: Ident, value: Formula },
    /// `input torque [N*m];`
    Input { name: Ident, unit: UnitText },
    /// `let x = …;`
    Let { name: Ident, value: Formula },
    /// `gravity = (gx, gy);`
    Gravity { keyword: Span, value: Vector },
    /// `body rod (x, y, theta) { mass = …; inertia = …; }`
    Body { name: Ident, coordinates: Vec<Coordinate>, properties: Vec<Property> },
    /// `constraint name: left = right;` or `drive name: left = right;`
    Constraint { name: Ident, is_drive: bool, left: Formula, equals: Span, right: Formula },
    /// `force name on target = …;` or `torque name on target = …;`
    Force { name: Ident, is_torque: bool, target: Attachment, value: Load },
    /// `point tip on crank = (l/2, 0);`
    Point { name: Ident, body: Ident, value: Vector },
    /// `revolute pin (crank.tip, rod.base);`
    Joint(Box<Joint>),
    /// `spring s (a.p, b.q) { stiffness = k; length = l; damping = c; }`
    Spring(Spring),
    /// `start { … }`
    Start { keyword: Span, entries: Vec<StartEntry> },
    /// `output name [unit] = …;`
    Output { name: Ident, unit: Option<UnitText>, value: Formula },
}

/// `where left < right`
pub struct Condition {
    pub left: Formula,
    pub comparison: Comparison,
    pub comparison_span: Span,
    pub right: Formula,
    /// As it was written.
    pub text: String,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Comparison {
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
}

impl Comparison {
    /// Whether `difference` compares so with 0.
    pub fn holds(self, difference: f64) -> bool {
        match self {
            Self::Less => difference < 0.0,
            Self::LessOrEqual => difference <= 0.0,
            Self::Greater => difference > 0.0,
            Self::GreaterOrEqual => difference >= 0.0,
        }
    }
}

/// A coordinate of a body, with its direction where that was written:
/// `x = s`.
pub struct Coordinate {
    pub direction: Option<Ident>,
    pub name: Ident,
}

/// `mass = …;` in a body.
pub struct Property {
    pub name: Ident,
    pub value: Formula,
}

/// A joint between two places.
pub struct Joint {
    pub kind: JointKind,
    pub name: Ident,
    pub first: Attachment,
    pub second: Attachment,
    /// The direction of motion, in the frame of the second body.
    pub along: Option<Vector>,
    /// The constant angle of the first body relative to the second.
    pub angle: Option<Formula>,
    /// The constant distance.
    pub length: Option<Formula>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    Revolute,
    Fixed,
    Prismatic,
    PointOnLine,
    Distance,
}

/// A spring with a damper between two places, or two angles.
pub struct Spring {
    pub name: Ident,
    pub is_torsion: bool,
    pub first: Attachment,
    pub second: Attachment,
    pub properties: Vec<Property>,
}

/// A place on a body: `crank.tip`, or `crank` for its centre.
pub struct Attachment {
    pub body: Ident,
    pub point: Option<Ident>,
}

/// `(x, y)`, or a scalar.
pub enum Load {
    Scalar(Formula),
    Vector(Vector),
}

/// `(x, y)` with an optional unit for both.
pub struct Vector {
    pub span: Span,
    pub x: Formula,
    pub y: Formula,
}

/// `theta = 0;`, `der(theta) = omega;` or either with `guess` before it.
pub struct StartEntry {
    pub is_guess: bool,
    pub is_rate: bool,
    pub coordinate: Ident,
    pub value: Formula,
}

/// A unit in brackets.
#[derive(Clone)]
pub struct UnitText {
    pub text: String,
    pub unit: Unit,
}

/// A mathematical expression.
pub struct Formula {
    pub span: Span,
    pub kind: FormulaKind,
}

pub enum FormulaKind {
    /// A number, with a unit or bare.
    Number {
        value: Number,
        unit: Option<UnitText>,
    },
    Name(Ident),
    /// `crank.tip.x`
    Member(Vec<Ident>),
    Negative(Box<Formula>),
    /// `op` is one of `+ - * / ^`; the span is the operator's.
    Binary {
        op: char,
        op_span: Span,
        left: Box<Formula>,
        right: Box<Formula>,
    },
    Call {
        function: Ident,
        arguments: Vec<Formula>,
    },
    /// `( … ) [unit]`
    WithUnit {
        inner: Box<Formula>,
        unit: UnitText,
    },
}
