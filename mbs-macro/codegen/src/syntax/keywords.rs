//! The words that begin statements: what they are, how they are written, what
//! they do. Parser, messages, documentation and tests read this one table, to
//! which joints and elements add their own.

use proc_macro2::Span;
use syn::Result;
use syn::parse::ParseStream;

use super::{EnergyRole, ItemKind, Role, clocks, items, modes, outlines, particles, solver, tables};
use crate::mechanics::elements::ELEMENTS;
use crate::mechanics::joints::JOINTS;

/// A word with which a statement begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Keyword {
    /// The word.
    pub word: &'static str,
    /// The kind of statement.
    pub kind: KeywordKind,
    /// How the statement is written; of a joint or an element, what stands
    /// behind its name.
    pub form: &'static str,
    /// Its effect, in a few words.
    pub meaning: &'static str,
}

/// A kind of statement, by what it declares.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KeywordKind {
    /// Quantities, bodies, equations, loads, settings.
    Statement,
    /// A joint between two places.
    Joint,
    /// A force element with a block of properties.
    Element,
    /// Statements that repeat, choose or gather others.
    Block,
}

/// Reads what follows the word, whose span is given.
type Read = fn(ParseStream<'_>, Span) -> Result<ItemKind>;

/// A word, how its statement is written, what that does, and what reads it.
pub type Statement = (&'static str, &'static str, &'static str, Read);

#[rustfmt::skip]
pub const STATEMENTS: &[Statement] = &[
    ("dof", "dof = 1;", "the degrees of freedom that are left, as a contract", items::dof),
    ("redundant", "redundant = minimum_norm;", "lets constraints repeat others", solver::redundant),
    ("states", "states = reduced;", "leaves coordinates that constraints give out of the integration", solver::states),
    ("limit", "limit operations = 200;", "bounds what the generated code may cost", solver::limit),
    ("step", "step = 0.5 [ms];", "the step that the mechanism is meant for", solver::step),
    ("method", "method = rk4;", "the scheme that it is integrated with", solver::method),
    ("feedback", "feedback = held(1500 [1/s], 2000 [1/s]);", "the gains that it is meant for", solver::feedback),
    ("gradients", "gradients = reverse;", "lets runs be differentiated by many variables at once", solver::gradients),
    ("closes", "closes = 0 [s] .. 0.3 [s];", "the span over which it has to be assembled", solver::closes),
    ("crate", "crate = ::my_runtime;", "where generated code finds the runtime", items::crate_path),
    ("param", "param l = 60 [mm] where l > 0;", "a quantity that a program may change", |input, _| items::parameter(input)),
    ("const", "const k = 1/12;", "a number that is folded into the code", |input, _| items::constant(input)),
    ("input", "input u [V] = 12;", "a quantity that a program sets at every step, and its value at first", |input, _| items::input_item(input)),
    ("state", "state current [A] = 0;", "a state of its own, which an equation drives", |input, _| items::state(input)),
    ("coordinate", "coordinate w [mm];", "a coordinate of its own, with which points move", |input, _| particles::coordinate(input)),
    ("memory", "memory integral [rad] = 0;", "a value that holds until a clock sets it", |input, _| clocks::memory(input)),
    ("set", "set integral = integral + error;", "gives a memory a value, in an `every` or a `when`", |input, _| clocks::set(input)),
    ("enter", "enter engaged;", "lets the constraints of a mode hold, in an `every` or a `when`", modes::enter),
    ("leave", "leave engaged;", "lets the constraints of a mode go", modes::leave),
    ("der", "der(current) = (u - R*current)/L;", "the rate of a state", |input, _| items::rate(input)),
    ("let", "let s = sin(theta);", "a name for an expression", |input, _| items::let_item(input)),
    ("gravity", "gravity = (0, -9.81) [m/s^2];", "acts on every body that has a mass", items::gravity),
    ("body", "body rod (x, y, theta) { mass = m; inertia = j; }", "a rigid body with its coordinates", |input, _| items::body(input)),
    ("point", "point tip on rod = (l/2, 0);", "a place on a body", |input, _| outlines::point(input)),
    ("circle", "circle rim on wheel = (0, 0) radius r;", "an outline of a body for contacts, round about a point", |input, _| outlines::circle(input)),
    ("bore", "bore hole on housing = (0, 0) radius r;", "a round hole of a body for contacts", |input, _| outlines::bore(input)),
    ("line", "line floor on ground = (0, 0) along (1, 0);", "a straight outline of a body for contacts, its material on the right", |input, _| outlines::line(input)),
    ("slot", "slot groove on wheel = (0, 0) along (1, 0) width 10.2 [mm];", "two straight sides of a body for contacts of what is between them", |input, _| outlines::slot(input)),
    ("segment", "segment edge on door = (0, 0) to (0.8 [m], 0);", "a straight outline of a body with two ends for contacts, round with a `radius`", |input, _| outlines::segment(input)),
    ("arc", "arc rim on wheel = (0, 0) radius r from -45 [deg] to 45 [deg];", "a thin part of a circle of a body for contacts with circles", |input, _| outlines::arc(input)),
    ("polygon", "polygon hull on block = (0, 0) to (a, 0) to (a, b) to (0, b);", "an outline of a body with corners for contacts, round with a `radius`", |input, _| outlines::polygon(input)),
    ("particle", "particle bob at rod.tip { mass = m; }", "a point mass at a place", |input, _| particles::particle(input)),
    ("constraint", "constraint rod: x = l*cos(theta);", "an equation between coordinates", |input, _| items::constraint(input, Role::Constraint)),
    ("drive", "drive motor: theta = omega*t;", "an equation that is enforced from outside", |input, _| items::constraint(input, Role::Drive)),
    ("coupler", "coupler screw: x = lead/(2*pi)*theta;", "an equation that is a transmission", |input, _| items::constraint(input, Role::Coupler)),
    ("rate", "rate edge: der(y)*cos(phi) = der(x)*sin(phi);", "an equation between rates, which restricts no position", |input, _| items::constraint(input, Role::Rate)),
    ("table", "table damping(speed) = [(-1 [m/s], -900 [N]), …] linear outside extend;", "a function through points", |input, _| tables::table(input)),
    ("profile", "profile lift = spline((0 [deg], 20 [mm]), …) period 360 [deg];", "a periodic function through points", |input, _| tables::profile(input)),
    ("force", "force push on rod.tip = (fx, fy);", "a force on a body, or along a coordinate", |input, _| items::force(input, false)),
    ("torque", "torque turn on rod = m;", "a torque on a body", |input, _| items::force(input, true)),
    ("potential", "potential magnet = k/x;", "an energy of the position, whose slopes are forces", |input, _| items::energy(input, EnergyRole::Potential)),
    ("dissipation", "dissipation oil = c*der(x)^2/2;", "a function of the rates, whose slopes are forces that resist", |input, _| items::energy(input, EnergyRole::Dissipation)),
    ("start", "start { theta = 30 [deg]; guess x = l; }", "where the motion starts", |input, _| items::start(input)),
    ("output", "output power [W] = u*der(theta);", "a value to be recorded", |input, _| items::output(input)),
    ("event", "event hit: x = 0.2 [m] rising;", "a moment that a run finds", |input, _| items::event(input)),
    ("stop", "stop end: x <= 0.2 [m] { restitution = 0.4; }", "an end of the way, which what moves hits and rests on", |input, _| items::stop(input)),
    ("require", "require l1 < l2;", "a condition between parameters", |input, _| items::require(input)),
    ("instance", "instance left: Leg { length = 0.5 [m]; }", "a part that an assembly describes", |input, _| items::instance(input)),
];

/// Statements with statements in them, which are read on tokens.
#[rustfmt::skip]
const BLOCKS: &[(&str, &str, &str)] = &[
    ("for", "for i in 1..=N { … }", "repeats statements"),
    ("if", "if i > 1 { … } else { … }", "chooses statements by whole numbers"),
    ("every", "every 1 [ms] { … }", "sets memories at sample times, one after the other"),
    ("mode", "mode engaged { … }", "has constraints that come and go"),
    ("when", "when x < 0 [m] { … }", "sets memories, and enters and leaves modes, where a condition begins to hold"),
    ("assembly", "assembly Leg { … }", "describes a part that is used more than once"),
];

/// All words with which statements begin, in the order of the language page.
pub fn keywords() -> Vec<Keyword> {
    let of = |kind| move |(word, form, meaning)| Keyword { word, kind, form, meaning };
    let statements = STATEMENTS.iter().map(|&(word, form, meaning, _)| (word, form, meaning));
    let joints =
        JOINTS.iter().flat_map(|kind| kind.words().map(|(word, meaning)| (word, kind.example, meaning)));
    let elements = ELEMENTS.iter().map(|kind| (kind.word, kind.example, kind.meaning));
    let mut all: Vec<Keyword> = statements.map(of(KeywordKind::Statement)).collect();
    all.extend(joints.map(of(KeywordKind::Joint)));
    all.extend(elements.map(of(KeywordKind::Element)));
    all.extend(BLOCKS.iter().copied().map(of(KeywordKind::Block)));
    all
}

/// Words that begin no statement here, though they do elsewhere, and what to
/// write for them.
#[rustfmt::skip]
const NEIGHBOURS: &[(&[&str], &str)] = &[
    (&["hinge", "pin", "pivot", "bearing", "rotational", "revolute_joint"], "two places that coincide are a `revolute` joint: `revolute pin (crank.tip, rod.base);`"),
    (&["joint"], "a joint begins with its kind: `revolute`, `prismatic`, `fixed`, `point_on_line`, `distance`, `gear`, `belt`, `rack`, `rolling` or `cam`"),
    (&["collision", "impact", "limit_stop", "bumper"], "bodies that touch have a `contact` between their outlines; a hard end is a `stop`: `stop end: x <= 0.2 [m] { restitution = 0.4; }`, a soft one has a `stiffness` and a `damping` in place of the restitution; between two points a soft end is a `strut`"),
    (&["damper", "dashpot", "shock_absorber"], "a damper is a spring without stiffness: `spring name (a.p, b.q) { damping = c; }`, or `torsion_spring` between angles"),
    (&["torsional_spring", "rotational_spring", "spiral_spring"], "a spring between angles is a `torsion_spring`"),
    (&["slider", "guide", "rail", "translational", "slot", "groove"], "what slides without turning is a `prismatic` joint, a pin in a slot a `pin_slot`: `prismatic name (block, ground) along (1, 0);`"),
    (&["mount", "pad", "elastomer"], "an elastic bearing is a `bushing`: `bushing name (a.p, b.q) { stiffness = (kx, ky); }`"),
    (&["weld", "rigid", "clamp", "lock"], "two bodies that move as one are a `fixed` joint"),
    (&["link", "bar", "rod", "cable", "string", "wire"], "what pulls and goes slack is a `rope`: `rope name (a.p, b.q) { stiffness = k; length = l; }`; a link with a mass is a `body`, one without is a `distance` joint: `distance name (a.p, b.q) = l;`"),
    (&["pulley", "chain", "timing_belt"], "two pulleys or sprockets are a `belt` joint"),
    (&["mass", "inertia", "point_mass"], "masses and inertias are properties of bodies: `body rod (x, y, theta) { mass = …; inertia = …; }`; a point mass at a place is a `particle`: `particle bob at rod.tip { mass = m; }`"),
    (&["wheel", "disc", "disk", "part", "solid"], "what moves is a `body`: `body wheel (x, y, phi) { mass = …; inertia = …; }`"),
    (&["screw", "nut", "transmission", "ratio"], "a transmission between coordinates is a `coupler`: `coupler screw: x = lead/(2*pi)*phi;`"),
    (&["rack_pinion", "pinion"], "a pinion on a rack is a `rack` joint"),
    (&["planetary", "sun", "ring", "spur_gear"], "gears of a planetary train are `gear` and `internal_gear` joints with a `carrier`"),
    (&["actuator", "cylinder", "servo"], "what is prescribed is a `drive`: `drive push: distance(a.p, b.q) = l + v*t;`; what pushes with a known force is a `force`"),
    (&["velocity", "speed", "position", "motion", "prescribe"], "a prescribed motion is a `drive`: `drive motor: theta = omega*t;`"),
    (&["equation", "eq", "condition"], "an equation between coordinates is a `constraint`, a condition between parameters a `require`"),
    (&["load", "moment"], "a load is a `force` or a `torque`"),
    (&["sensor", "measure", "record", "plot"], "what is to be recorded is an `output`"),
    (&["trigger", "zero_crossing", "until"], "a moment that a run finds is an `event`: `event hit: x = 0.2 [m] rising;`"),
    (&["sample", "sampled", "periodic", "clock", "controller", "discrete"], "what a controller does at sample times stands in `every 1 [ms] { set u = …; }`, where `memory u [V] = 0;` holds the value"),
    (&["initial", "init", "initially"], "the motion begins where `start { … }` says"),
    (&["variable", "var"], "coordinates belong to bodies: `body rod (x, y, theta) { … }`; one with which points move is a `coordinate`: `coordinate w [mm];`; what is no position is a `state`: `state current [A] = 0; der(current) = …;`"),
    (&["marker", "frame", "node"], "a place on a body is a `point`: `point tip on rod = (l/2, 0);`"),
    (&["ground", "fixed_body", "world", "base"], "the ground is a body that is there already, called `ground`"),
    (&["component", "subsystem", "module", "submodel"], "a part that is used more than once is an `assembly`"),
];

/// The help for a word that other programs know.
pub fn neighbour(word: &str) -> Option<&'static str> {
    let word = word.to_lowercase();
    NEIGHBOURS.iter().find(|(words, _)| words.contains(&word.as_str())).map(|(_, help)| *help)
}
