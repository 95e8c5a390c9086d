//! `stop end: x <= 0.2 [m] { restitution = 0.4; }`: ends of the way, which what moves hits and rests on.
//!
//! A stop is a gap g(q, t) that is never negative. It has no row among the constraints: while it is open, nothing is
//! computed of it. A run that finds it closed asks for the response of the mechanism to an impulse along ∂g/∂q.
//! A memory is 1 while it is rested on, another one sums up its impulses, and a third one has its force, where an output or a
//! condition asks for that: every path has memories.
//!
//! With `friction = mu; along = s;` what rests on it, or hits it, rubs along s: a [friction](super::frictions) of its own,
//! whose size is μ beside the force, or the impulse, of the stop.

use mbs_symbolic::units::{Dimension, Unit};
use mbs_symbolic::{Expr, Node, Number, Pieces, Stage};
use proc_macro2::Ident;

use super::declare::quantity;
use super::frictions::memory_of;
use super::known::{KnownStop, Value};
use super::measures::ENERGY;
use super::names::Place;
use super::resolver::Resolver;
use super::soft_stops::is_soft;
use super::stop_properties::{ALONG, FRICTION, RESTITUTION, Row, Takes};
use super::{Contact, Meaning, Stop};
use crate::diagnostics::Diagnostic;
use crate::mechanics::elements::Sticks;
use crate::quantity::{Comparison, Quantity, Setting};
use crate::syntax::{Condition, Formula, Item, ItemKind, Property, When};

/// A run looks at the stops and the frictions that act together in all combinations that its pivots lead through.
const MOST_CONTACTS: usize = 16;

const SETTLE: &str = "settle";
const PROPERTIES: &[Row] = &[
    (RESTITUTION, Takes::Share),
    (SETTLE, Takes::Share),
    (FRICTION, Takes::NotNegative(|_| Dimension::NONE)),
    (ALONG, Takes::Way),
];
/// The share of the longest flight below which a stop is not left again, where none is declared.
const SETTLED: f64 = 1e-6;

impl Resolver<'_> {
    /// The memories of a stop: whether it is rested on, the impulse that it has given so far, and its force if something asks for
    /// it; and those of its friction.
    pub(super) fn declare_stop(&mut self, name: &Ident, properties: &[Property]) {
        if is_soft(properties) {
            return self.declare_source(name, "stop", None);
        }
        self.scope.first_memory = self.scope.first_memory.min(self.inputs.len());
        let symbol = self.scope.symbol(&name.to_string(), Stage::Variable, Meaning::Input(self.inputs.len()));
        let value = Value::Symbol { symbol, dimension: Dimension::NONE, span: name.span() };
        self.scope.declare(name, value, &mut self.errors);
        self.stop_memory(quantity(name, "1 while it is rested on", "", Unit::ONE));
        let meaning = Meaning::Input(self.inputs.len());
        let impulse = memory_of(name, "impulse");
        let sum = self.scope.symbol(&impulse.to_string(), Stage::Variable, meaning);
        self.stop_memory(quantity(&impulse, "the sum of the impulses of its impacts", "", Unit::ONE));
        let force = self.asked.contains(&name.to_string()).then(|| {
            let meaning = Meaning::Input(self.inputs.len());
            self.stop_memory(quantity(
                &memory_of(name, "force"),
                "the force with which it bears what rests on it",
                "",
                Unit::ONE,
            ));
            self.scope.symbol(&format!("force({name})"), Stage::Variable, meaning)
        });
        let known = KnownStop { impulse: sum, force, dimension: None };
        self.scope.stops.entry(name.to_string()).or_insert(known);
        if properties.iter().any(|property| property.name == FRICTION) {
            self.declare_sticking(name);
        }
    }

    /// Finds the names whose force a statement asks for. Where that of a stop is not asked for, no run has to know it.
    pub(super) fn find_asked(&mut self, item: &Item) {
        let formulas: Vec<&Formula> = match &item.kind {
            ItemKind::Let { value, .. } | ItemKind::Output { value, .. } => vec![value],
            ItemKind::When(When { condition, .. }) => vec![&condition.left, &condition.right],
            _ => return,
        };
        let calls = formulas.into_iter().flat_map(Formula::calls_of_names);
        let asked = calls.filter(|[function, _]| *function == "force" || *function == "torque");
        self.asked.extend(asked.map(|[_, name]| name.to_string()));
    }

    fn stop_memory(&mut self, quantity: Quantity) {
        self.inputs.push(Setting { quantity, value: 0.0 });
    }

    pub(super) fn resolve_stop(&mut self, name: &Ident, condition: &Condition, properties: &[Property]) {
        if is_soft(properties) {
            return self.resolve_soft_stop(name, condition, properties);
        }
        let Some((gap, dimension)) = self.gap(name, condition) else { return };
        let help = "leave some out, or give some a `stiffness` in place of the `restitution`";
        if self.has_room_for(name, "stop", help).is_none() {
            return;
        }
        let memory = self.inputs.iter().position(|input| *name == input.quantity.name);
        let is_first = self.stops.iter().all(|stop| *name != stop.quantity.name);
        let Some(memory) = memory.filter(|_| is_first) else { return };
        self.know_impulse(name, memory + 1, dimension);
        let force = self.know_force(name, dimension);
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
        self.stops.push(Stop { quantity, contact, restitution, settle, memory, force, span });
        if let Some((size, slip)) = friction {
            self.push_friction_at(name, stop, Sticks { slip, limits: [size, size] });
        }
    }

    /// The gap, which is 0 where the stop is touched, and its dimension.
    pub(super) fn gap(&mut self, name: &Ident, condition: &Condition) -> Option<(Expr, Dimension)> {
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
    pub(super) fn bends(&self, gap: Expr) -> bool {
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
        self.scope.declare(&memory_of(name, "impulse"), value, &mut self.errors);
    }

    /// The place of the memory of the force of a stop, if something asks for it: its gap decides its unit.
    fn know_force(&mut self, name: &Ident, gap: Dimension) -> Option<usize> {
        let dimension = ENERGY.over(gap);
        let known = self.scope.stops.get_mut(&name.to_string())?;
        known.dimension = Some(dimension);
        let Meaning::Input(memory) = known.force.map(|force| self.scope.meaning(force))? else { return None };
        let input = self.inputs.get_mut(memory)?;
        (input.quantity.dimension, input.quantity.unit) = (dimension, dimension.si_unit());
        Some(memory)
    }

    /// The restitution, the share of the longest flight below which a stop is not left again, and its friction.
    fn stop_properties(
        &mut self,
        name: &Ident,
        gap: Dimension,
        properties: &[Property],
    ) -> Option<Properties> {
        let found = self.read_properties(name, gap, (PROPERTIES, properties))?;
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
