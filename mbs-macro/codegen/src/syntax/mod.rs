//! The declaration as it was written: shapes are right, names are unresolved.

mod blocks;
mod choices;
mod clocks;
mod elements;
mod formula;
mod groups;
mod indices;
mod items;
mod joints;
mod keywords;
mod loose;
mod modes;
mod outlines;
mod particles;
mod roles;
mod solver;
mod statements;
mod tables;
mod words;

use mbs_interface::Tableau;
use mbs_symbolic::units::Unit;
use mbs_symbolic::{Beyond, Interpolation, Number};
use proc_macro2::{Ident, Span, TokenStream};

pub use clocks::{Every, Set};
pub use items::parse;
pub use keywords::{Keyword, KeywordKind, keywords};
pub use modes::When;
pub use outlines::Outline;
pub use roles::{EnergyRole, Role};

use crate::mechanics::elements::ElementKind;
use crate::mechanics::joints::JointKind;
use crate::quantity::{Comparison, Crossing};

/// A whole `mechanism! { … }`.
pub struct Declaration {
    pub doc: String,
    pub visibility: TokenStream,
    pub name: Ident,
    pub items: Vec<Item>,
}

/// One statement.
#[derive(Clone)]
pub struct Item {
    pub doc: String,
    /// Which statement of the source it is; copies that a loop makes share it.
    pub position: usize,
    pub kind: ItemKind,
}

#[derive(Clone)]
pub enum ItemKind {
    /// `dof = 0;`
    Dof { keyword: Span, value: i64 },
    /// `redundant = minimum_norm;`
    Redundant { keyword: Span },
    /// `states = reduced;`
    States { keyword: Span, are_reduced: bool },
    /// `limit operations = 200;`
    Limit { keyword: Span, limited: Limited, value: u32 },
    /// `step = 0.5 [ms];`
    Step { keyword: Span, value: Formula },
    /// `method = rk4;`
    Method { keyword: Span, scheme: &'static Tableau },
    /// `gradients = reverse;`
    Gradients { keyword: Span },
    /// `feedback = held(alpha, beta);`
    Feedback { keyword: Span, is_held: bool, gains: [Formula; 2] },
    /// `closes = 0 [s] .. 0.3 [s];`, or over a coordinate.
    Closes { keyword: Span, coordinate: Option<Ident>, from: Formula, to: Formula },
    /// `crate = path;`
    Crate { keyword: Span, path: TokenStream },
    /// `param l = 1 [m] where l > 0;`
    Parameter { name: Ident, value: Formula, condition: Option<Condition> },
    /// `const l = 1 [m];`
    Constant { name: Ident, value: Formula },
    /// `input torque [N*m];`, or with its value at first, `input push [N] = 2 [kN];`.
    Input { name: Ident, unit: UnitText, value: Option<Formula> },
    /// `state current [A] = 0;`
    State { name: Ident, unit: UnitText, value: Option<Formula> },
    /// `coordinate w [mm];`
    Coordinate { name: Ident, unit: UnitText },
    /// `particle bob at rod.tip { mass = m; }`
    Particle { name: Ident, at: Attachment, properties: Vec<Property> },
    /// `memory integral [rad] = 0;`
    Memory { name: Ident, unit: UnitText, value: Option<Formula> },
    /// `every 1 [ms] offset 0.2 [ms] { … }`
    Every(Every),
    /// `set integral = integral + error;`, `enter engaged;` or `leave engaged;`
    Set(Set),
    /// `mode engaged { … }`, whose constraints are statements of their own before it
    Mode { name: Ident, value: Option<Formula>, rows: Vec<Ident> },
    /// `when x < 0 [m] { … }`
    When(When),
    /// `der(current) = (u - R*current)/L;`
    Rate { prefix: Vec<Ident>, state: Ident, value: Formula },
    /// `require l1 < l2;`, or the condition of a parameter that is bound.
    Require { of: Option<Ident>, condition: Condition },
    /// A size of a joint with play, such as its `clearance`, which has to be positive.
    Size { word: &'static str, of: Ident, value: Formula },
    /// `assembly Leg { … }`; gone after composition.
    Assembly { name: Ident, items: Vec<Item> },
    /// `instance left: Leg { phase = 120 [deg]; }`; gone after composition.
    Instance { name: Ident, assembly: Ident, bindings: Vec<Property> },
    /// A parameter of an assembly that its instance gives a value; made by
    /// composition.
    Binding { name: Ident, value: Formula, default: Formula },
    /// `let x = …;`
    Let { name: Ident, value: Formula },
    /// `gravity = (gx, gy);`
    Gravity { keyword: Span, value: Vector },
    /// `body rod (x, y, theta) { mass = …; inertia = …; }`
    Body { name: Ident, coordinates: Vec<Coordinate>, properties: Vec<Property> },
    /// `constraint name: left = right;`, or another [`Role`] before it.
    Constraint { name: Ident, role: Role, left: Formula, equals: Span, right: Formula },
    /// `force name on target = …;`, in a body's frame `… in body = …;`, or `torque name on target = …;`
    Force { name: Ident, is_torque: bool, target: Attachment, frame: Option<Ident>, value: Load },
    /// `potential magnet = k/x;`, `dissipation oil = c*der(x)^2/2;`
    Energy { name: Ident, role: EnergyRole, value: Formula },
    /// `point tip on crank = (l/2, 0);`, or with an [`Outline`] about it
    Point { name: Ident, body: Ident, value: Vector, outline: Box<Outline> },
    /// `revolute pin (crank.tip, rod.base);`
    Joint(Box<Joint>),
    /// `table gas(angle) = [(0, 0), …] cubic outside hold;`, or a `profile`.
    Table(Table),
    /// `spring s (a.p, b.q) { stiffness = k; length = l; damping = c; }`
    Element(Box<Element>),
    /// `start { … }`
    Start { entries: Vec<StartEntry> },
    /// `stop end: x <= 0.2 [m] { restitution = 0.4; }`
    Stop { name: Ident, condition: Condition, properties: Vec<Property> },
    /// `event hit: x = 0.2 [m] rising;`
    Event { name: Ident, left: Formula, equals: Span, right: Formula, crossing: Crossing },
    /// `output name [unit] = …;`
    Output { name: Ident, unit: Option<UnitText>, value: Formula },
}

/// `where left < right`
#[derive(Clone)]
pub struct Condition {
    pub left: Formula,
    pub comparison: Comparison,
    pub comparison_span: Span,
    pub right: Formula,
    /// As it was written.
    pub text: String,
    pub left_text: String,
}

/// A quantity that `limit` bounds.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Limited {
    /// Operations that one evaluation of the right-hand side may take.
    Operations,
    /// Bytes of stack that a step in `f64` may take.
    Stack,
    /// Instructions of a program before its repeated parts become loops.
    Unrolled,
}

/// A coordinate of a body, with its direction where that was written:
/// `x = s`.
#[derive(Clone)]
pub struct Coordinate {
    pub direction: Option<Ident>,
    pub name: Ident,
    /// As it was written: by its beginning the direction may be told.
    pub written: String,
}

/// `mass = …;` in a body.
#[derive(Clone)]
pub struct Property {
    pub name: Ident,
    pub value: Formula,
}

/// A joint between two places.
#[derive(Clone)]
pub struct Joint {
    pub kind: &'static JointKind,
    pub name: Ident,
    pub first: Attachment,
    pub second: Attachment,
    /// Each kind of clause at most once, those that the joint needs and takes.
    pub clauses: Vec<Clause>,
}

/// A clause of a joint, behind its two places.
#[derive(Clone)]
pub enum Clause {
    /// `along (1, 0)`: a direction in the frame of the second body.
    Along(Vector),
    /// `at 30 [deg]`: a constant angle between the bodies.
    Angle(Formula),
    /// `at 20 [mm]`: where on a line both angles are equal.
    Place(Formula),
    /// `= 0.5 [m]`
    Distance(Formula),
    /// `= r0*(1 + 0.2*cos(angle))`: the profile of a cam.
    Profile(Formula),
    /// `radius r`
    Radius(Formula),
    /// `radii (r1, r2)`
    Radii(Vector),
    /// `teeth (20, 40)`
    Teeth(Vector),
    /// `carrier arm`: the body relative to which the others turn.
    Carrier(Ident),
}

/// A function through points.
#[derive(Clone)]
pub struct Table {
    /// The word of its statement.
    pub word: &'static str,
    pub name: Ident,
    pub points: Points,
    pub interpolation: Interpolation,
}

/// The points of a table, and what is outside of them.
#[derive(Clone)]
pub enum Points {
    /// (argument, value)
    Curve(Vec<Vector>, Outside),
    /// (first argument, second argument, value), and what is outside along each argument.
    Grid(Vec<[Formula; 3]>, [Beyond; 2]),
}

/// The values of a table outside of its points.
#[derive(Clone)]
pub enum Outside {
    /// `outside hold`
    By(Beyond),
    /// `period 360 [deg]`, after which the first point returns.
    After(Formula),
}

/// A force element: spring, motor, friction, drag.
#[derive(Clone)]
pub struct Element {
    pub name: Ident,
    pub kind: &'static ElementKind,
    pub first: Attachment,
    /// The other end, where it has one.
    pub second: Option<Attachment>,
    /// The direction in which it acts, in the frame of the second body.
    pub along: Option<Vector>,
    pub properties: Vec<ElementProperty>,
}

/// `stiffness = …;` in an element.
#[derive(Clone)]
pub struct ElementProperty {
    pub name: Ident,
    pub value: Load,
}

/// A place on a body: `crank.tip`, or `crank` for its centre.
#[derive(Clone)]
pub struct Attachment {
    /// The instances of assemblies that lead to the body; empty after composition.
    pub prefix: Vec<Ident>,
    pub body: Ident,
    pub point: Option<Ident>,
}

impl Attachment {
    /// The place at `first.rest`: of two names and more, the last is a point.
    pub fn of_path(first: Ident, mut rest: Vec<Ident>) -> Self {
        let point = rest.pop();
        match rest.pop() {
            None => Self { prefix: Vec::new(), body: first, point },
            Some(body) => {
                rest.insert(0, first);
                Self { prefix: rest, body, point }
            }
        }
    }
}

/// `(x, y)`, or a scalar.
#[derive(Clone)]
pub enum Load {
    Scalar(Formula),
    Vector(Vector),
}

/// `(x, y)` with an optional unit for both.
#[derive(Clone)]
pub struct Vector {
    pub span: Span,
    pub x: Formula,
    pub y: Formula,
}

/// `theta = 0;`, `der(theta) = omega;` or either with `guess` before it.
#[derive(Clone)]
pub struct StartEntry {
    pub is_guess: bool,
    pub is_rate: bool,
    /// The instances of assemblies that lead to it; empty after composition.
    pub prefix: Vec<Ident>,
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
#[derive(Clone)]
pub struct Formula {
    pub span: Span,
    pub kind: FormulaKind,
}

/// A value by a condition.
#[derive(Clone)]
pub struct Choice {
    pub test: Test,
    /// The value where the condition holds,
    pub value: Formula,
    /// and where it does not.
    pub otherwise: Formula,
}

/// The condition of a choice.
#[derive(Clone)]
pub enum Test {
    Compared { sides: Box<[Formula; 2]>, comparison: Comparison, span: Span },
    Both(Box<[Test; 2]>),
    Either(Box<[Test; 2]>),
    Not(Box<Test>),
}

impl Test {
    /// The formulas that are compared, from left to right.
    pub fn formulas(&self) -> Vec<&Formula> {
        match self {
            Self::Compared { sides, .. } => sides.iter().collect(),
            Self::Both(both) | Self::Either(both) => both.iter().flat_map(Self::formulas).collect(),
            Self::Not(inner) => inner.formulas(),
        }
    }

    /// The same to be changed.
    pub fn formulas_mut(&mut self) -> Vec<&mut Formula> {
        match self {
            Self::Compared { sides, .. } => sides.iter_mut().collect(),
            Self::Both(both) | Self::Either(both) => both.iter_mut().flat_map(Self::formulas_mut).collect(),
            Self::Not(inner) => inner.formulas_mut(),
        }
    }
}

/// An operator of a chain with what stands behind it.
#[derive(Clone)]
pub struct Operation {
    pub op: Operator,
    pub op_span: Span,
    pub operand: Formula,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Operator {
    Plus,
    Minus,
    Times,
    Over,
}

#[derive(Clone)]
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
    /// `a + b - c`, or `a*b/c`: from left to right. A list, so that a long one
    /// is not deep.
    Chain {
        first: Box<Formula>,
        rest: Vec<Operation>,
    },
    Power {
        base: Box<Formula>,
        op_span: Span,
        exponent: Box<Formula>,
    },
    Call {
        function: Ident,
        arguments: Vec<Formula>,
    },
    /// `if a < b { p } else { q }`
    Choice(Box<Choice>),
    /// `reaction(pin, rod).x`
    Component {
        call: Box<Formula>,
        member: Ident,
    },
    /// `( … ) [unit]`
    WithUnit {
        inner: Box<Formula>,
        unit: UnitText,
    },
}
