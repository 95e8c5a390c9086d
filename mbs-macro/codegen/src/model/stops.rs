//! `stop end: x <= 0.2 [m] { restitution = 0.4; }`: ends of the way, which what moves hits and rests on.
//!
//! A stop is a gap g(q, t) that is never negative. It has no row among the constraints: while it is open, nothing is
//! computed of it. A run that finds it closed asks for the response of the mechanism to an impulse along ∂g/∂q.
//! A memory is 1 while it is rested on, and another one sums up its impulses: every path has memories.
//!
//! With `friction = mu; along = s;` what rests on it, or hits it, rubs along s: a [friction](super::frictions) of its own,
//! whose size is μ beside the force, or the impulse, of the stop.

use std::collections::BTreeMap;

use mbs_symbolic::units::{Dimension, Unit};
use mbs_symbolic::{Expr, Node, Number, Pieces, Stage};
use proc_macro2::{Ident, Span};

use super::declare::quantity;
use super::known::Value;
use super::names::Place;
use super::resolver::Resolver;
use super::{Contact, Meaning, Requirement, Stop};
use crate::diagnostics::{Diagnostic, listing, nearest};
use crate::mechanics::elements::Sticks;
use crate::quantity::{Comparison, Quantity, Setting};
use crate::syntax::{Condition, Property};

/// A run looks at the stops and the frictions that act together in all combinations that its pivots lead through.
const MOST_CONTACTS: usize = 16;

const RESTITUTION: &str = "restitution";
const SETTLE: &str = "settle";
const FRICTION: &str = "friction";
const ALONG: &str = "along";
const PROPERTIES: [&str; 4] = [RESTITUTION, SETTLE, FRICTION, ALONG];
/// The share of the longest flight below which a stop is not left again, where none is declared.
const SETTLED: f64 = 1e-6;

impl Resolver<'_> {
    /// The memories of a stop: whether it is rested on, and the impulse that it has given so far; and those of its friction.
    pub(super) fn declare_stop(&mut self, name: &Ident, properties: &[Property]) {
        self.scope.first_memory = self.scope.first_memory.min(self.inputs.len());
        let symbol = self.scope.symbol(&name.to_string(), Stage::Variable, Meaning::Input(self.inputs.len()));
        let value = Value::Symbol { symbol, dimension: Dimension::NONE, span: name.span() };
        self.scope.declare(name, value, &mut self.errors);
        self.stop_memory(quantity(name, "1 while it is rested on", "", Unit::ONE));
        let meaning = Meaning::Input(self.inputs.len());
        let impulse = impulse_of(name);
        self.scope.symbol(&impulse.to_string(), Stage::Variable, meaning);
        self.stop_memory(quantity(&impulse, "the sum of the impulses of its impacts", "", Unit::ONE));
        if properties.iter().any(|property| property.name == FRICTION) {
            self.declare_sticking(name);
        }
    }

    fn stop_memory(&mut self, quantity: Quantity) {
        self.inputs.push(Setting { quantity, value: 0.0 });
    }

    pub(super) fn resolve_stop(&mut self, name: &Ident, condition: &Condition, properties: &[Property]) {
        let Some((gap, dimension)) = self.gap(name, condition) else { return };
        let memory = self.inputs.iter().position(|input| *name == input.quantity.name);
        let is_first = self.stops.iter().all(|stop| *name != stop.quantity.name);
        let Some(memory) = memory.filter(|_| is_first) else { return };
        self.know_impulse(name, memory + 1, dimension);
        let values = self.stop_properties(name, dimension, properties);
        let Some(Properties { restitution, settle, friction }) = values else { return };
        let contact = self.contact(gap);
        if friction.is_some_and(|(_, along)| !self.crosses(name, &contact, along)) {
            return;
        }
        let unit = Unit { scale: Number::ONE, dimension };
        let quantity = quantity(name, "", &dimension.si_unit(), unit);
        let span = name.span();
        let stop = self.stops.len();
        self.stops.push(Stop { quantity, contact, restitution, settle, memory, span });
        if let Some((size, slip)) = friction {
            self.push_friction_at(name, stop, Sticks { slip, limits: [size, size] });
        }
    }

    /// The gap, which is 0 where the stop is touched, and its dimension.
    fn gap(&mut self, name: &Ident, condition: &Condition) -> Option<(Expr, Dimension)> {
        let Condition { left, comparison, comparison_span, right, .. } = condition;
        let [left, right] =
            [left, right].map(|side| self.scope.formula(side, Place::Constraint, &mut self.errors));
        let (left, right) = (left?, right?);
        let (smaller, larger) = match comparison {
            Comparison::LessOrEqual => (left, right),
            Comparison::GreaterOrEqual => (right, left),
            Comparison::Less | Comparison::Greater => {
                let message = format!("what rests on `{name}` is at its end");
                let help = "write `<=` or `>=`";
                self.errors.push(Diagnostic::new(*comparison_span, message).help(help));
                return None;
            }
        };
        let difference = self.difference(larger, smaller, *comparison_span);
        let (gap, dimension) = self.errors.take(difference)?;
        if self.coordinates_in(gap) == 0 {
            let message = format!("`{name}` does not stop anything: no coordinate is left in it");
            let help = "write where a motion ends, as in `x <= 0.2 [m]` or `distance(a.p, b.q) >= r`";
            self.errors.push(Diagnostic::new(name.span(), message).help(help));
            return None;
        }
        if self.bends(gap) {
            let message = format!("`{name}` has a corner: an impact there has no direction");
            let help = "write a stop for each side of it, or take a `cubic` table";
            self.errors.push(Diagnostic::new(name.span(), message).help(help));
            return None;
        }
        let help = "leave some out, or make soft ones of them: `force end on x = -k*ramp(x - gap);`";
        self.has_room_for(name, "stop", help)?;
        Some((gap, dimension))
    }

    /// Refuses one stop or friction more than there may be.
    pub(super) fn has_room_for(&mut self, name: &Ident, what: &str, help: &str) -> Option<()> {
        if self.stops.len() + self.frictions.len() + self.locks.len() < MOST_CONTACTS {
            return Some(());
        }
        let message = format!(
            "`{name}` is one {what} too many: a mechanism has at most {MOST_CONTACTS} stops, frictions that stick and \
             constraints of modes"
        );
        self.errors.push(Diagnostic::new(name.span(), message).help(help));
        None
    }

    /// True if a formula has pieces, or a table with corners, of positions.
    fn bends(&self, gap: Expr) -> bool {
        let arena = &self.scope.arena;
        let is_of_positions = |node: Expr| {
            let mut symbols = arena.symbols_in(node).into_iter();
            symbols.any(|symbol| matches!(self.scope.meaning(symbol), Meaning::Coordinate(_)))
        };
        arena.reachable(&[gap]).into_iter().any(|node| {
            let has_corners = match *arena.node(node) {
                Node::Call(function, _) => function.row().pieces != Pieces::One,
                Node::Spline(id, ..) => arena
                    .splines()
                    .get(id.index())
                    .is_some_and(|spline| spline.jump(0).or(spline.jump(1)).is_some()),
                _ => false,
            };
            has_corners && is_of_positions(node)
        })
    }

    /// Enters the impulse of a stop, whose unit its gap decides.
    fn know_impulse(&mut self, name: &Ident, memory: usize, gap: Dimension) {
        // what changes the energy by a rate of the gap
        let dimension = Dimension::of(1, 2, -1).over(gap);
        let Some(input) = self.inputs.get_mut(memory) else { return };
        (input.quantity.dimension, input.quantity.unit) = (dimension, dimension.si_unit());
        let Some(symbol) = self.scope.symbol_of(Meaning::Input(memory)) else { return };
        let value = Value::Symbol { symbol, dimension, span: name.span() };
        self.scope.declare(&impulse_of(name), value, &mut self.errors);
    }

    /// The restitution, the share of the longest flight below which a stop is not left again, and its friction.
    fn stop_properties(
        &mut self,
        name: &Ident,
        gap: Dimension,
        properties: &[Property],
    ) -> Option<Properties> {
        let mut found: BTreeMap<String, Expr> = BTreeMap::new();
        for Property { name: property, value } in properties {
            let text = property.to_string();
            if !PROPERTIES.contains(&&*text) {
                self.errors.push(unknown_property(property));
                return None;
            }
            let what = format!("the {text} of `{name}`");
            let (place, dimension) = match &*text {
                ALONG => (Place::Constraint, gap),
                _ => (Place::Property, Dimension::NONE),
            };
            let expr = self.scope.formula_of(value, place, (&*what, dimension), &mut self.errors)?;
            match &*text {
                FRICTION => self.not_negative(&format!("the {text} of {name}"), expr, value.span),
                ALONG => self.slides(name, expr, value.span)?,
                _ => self.within_one(&format!("the {text} of {name}"), expr, value.span),
            }
            if found.insert(text, expr).is_some() {
                let help = "keep one of them";
                let message = format!("{what} is given twice");
                self.errors.push(Diagnostic::new(property.span(), message).help(help));
            }
        }
        let friction =
            self.friction_at(name, [FRICTION, ALONG].map(|property| found.get(property).copied()))?;
        let Some(&restitution) = found.get(RESTITUTION) else {
            let message = format!("`{name}` does not say how it throws back what hits it");
            let help = "give it a restitution from 0 (it stays) to 1 (it bounces without loss): \
                        `{ restitution = 0.4; }`";
            self.errors.push(Diagnostic::new(name.span(), message).help(help));
            return None;
        };
        let settled = self.scope.arena.number(Number::from(SETTLED));
        let settle = found.get(SETTLE).copied().unwrap_or(settled);
        Some(Properties { restitution, settle, friction })
    }

    /// The coefficient of friction and along what it rubs: both, or none.
    fn friction_at(&mut self, name: &Ident, given: [Option<Expr>; 2]) -> Option<Option<(Expr, Expr)>> {
        let (message, help) = match given {
            [Some(size), Some(along)] => return Some(Some((size, along))),
            [None, None] => return Some(None),
            [Some(_), None] => (
                format!("`{name}` does not say along what it rubs"),
                "give the way that what touches it slides, as in `along = foot.tip.x;`",
            ),
            [None, Some(_)] => (
                format!("`{name}` does not say how much it rubs"),
                "give a coefficient of friction, as in `friction = 0.3;`, or leave `along` out",
            ),
        };
        self.errors.push(Diagnostic::new(name.span(), message).help(help));
        None
    }

    /// Refuses a way of sliding without a coordinate, or with a corner.
    fn slides(&mut self, name: &Ident, along: Expr, span: Span) -> Option<()> {
        let (message, help) = if self.coordinates_in(along) == 0 {
            (
                format!("nothing slides along the stop `{name}`: no coordinate is left in it"),
                "write the way that what touches it slides, as in `along = foot.tip.x;`",
            )
        } else if self.bends(along) {
            (
                format!(
                    "what slides along the stop `{name}` turns a corner: friction has no direction there"
                ),
                "take a smooth way, or a `cubic` table",
            )
        } else {
            return Some(());
        };
        self.errors.push(Diagnostic::new(span, message).help(help));
        None
    }

    /// Refuses a way of sliding that is the way of the gap.
    fn crosses(&mut self, name: &Ident, gap: &Contact, along: Expr) -> bool {
        let slopes = self.contact(along).slopes;
        let arena = &mut self.scope.arena;
        let opposite: Vec<_> = slopes.iter().map(|&(at, slope)| (at, arena.neg(slope))).collect();
        if slopes != gap.slopes && opposite != gap.slopes {
            return true;
        }
        let message = format!("nothing that rests on `{name}` slides along its gap");
        let help = "write the way across it, as in `stop floor: foot.y >= 0 [m] { friction = 0.3; along = foot.x; … }`";
        self.errors.push(Diagnostic::new(name.span(), message).help(help));
        false
    }

    /// Asks that a value is from 0 to 1.
    pub(super) fn within_one(&mut self, what: &str, value: Expr, span: Span) {
        let (zero, one) = (self.scope.arena.zero(), self.scope.arena.one());
        for (bound, comparison) in [(zero, Comparison::GreaterOrEqual), (one, Comparison::LessOrEqual)] {
            self.beside(what, (value, comparison, bound), "it has to be from 0 to 1", span);
        }
    }

    /// Asks that a value is not negative.
    fn not_negative(&mut self, what: &str, value: Expr, span: Span) {
        let zero = self.scope.arena.zero();
        self.beside(what, (value, Comparison::GreaterOrEqual, zero), "it must not be negative", span);
    }

    fn beside(
        &mut self,
        what: &str,
        (value, comparison, bound): (Expr, Comparison, Expr),
        text: &str,
        span: Span,
    ) {
        let difference = self.scope.arena.sub(value, bound);
        let (name, text) = (what.to_owned(), text.to_owned());
        self.scope.requirements.push(Requirement { name, value, difference, comparison, text, span });
    }

    /// Refuses what does not go with stops.
    pub(super) fn check_stops(&mut self) {
        let Some(stop) = self.stops.first() else { return };
        let (name, span) = (stop.quantity.name.clone(), stop.span);
        let mut refuse = |message: String, help: &str| {
            self.errors.push(Diagnostic::new(span, message).help(help));
        };
        if self.solver.has_reduced_states() {
            refuse(
                format!("`{name}` stops coordinates that are not integrated"),
                "leave `states = reduced;` out where there are stops",
            );
        }
        if self.solver.reverse.is_some() {
            refuse(
                format!("no way leads back through the impacts of `{name}`"),
                "leave `gradients = reverse;` out: derivatives by dual numbers go through impacts",
            );
        }
    }
}

/// The values of a stop beside its gap.
struct Properties {
    restitution: Expr,
    settle: Expr,
    /// The coefficient of friction, and the way along which it rubs.
    friction: Option<(Expr, Expr)>,
}

/// The error for a property that stops do not have.
fn unknown_property(property: &Ident) -> Diagnostic {
    let text = property.to_string();
    let help = match (&*text, nearest(&text, PROPERTIES)) {
        ("stiffness" | "damping", _) => {
            "a soft end is a force: `force end on x = -k*ramp(x - gap);`".to_owned()
        }
        ("static", _) => "what sticks at a stop holds with its `friction`, too".to_owned(),
        (_, Some(near)) => format!("did you mean `{near}`?"),
        _ => format!("its properties are {}", listing(PROPERTIES)),
    };
    Diagnostic::new(property.span(), format!("a stop has no `{text}`")).help(help)
}

/// The name of the memory that sums up impulses.
pub(super) fn impulse_of(name: &Ident) -> Ident {
    Ident::new(&format!("{}_impulse", name.to_string().trim_start_matches("r#")), name.span())
}
