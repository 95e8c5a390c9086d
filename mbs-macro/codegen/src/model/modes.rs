//! `mode engaged { fixed lock (plate, wheel); }` and `when x < 0 [m] { enter engaged; }`: constraints that come and go.
//!
//! A mode is a memory of 1 while its constraints hold, else 0. They have no rows in the elimination. A run asks for the
//! responses of the mechanism to impulses along them, as it does at [stops](super::stops), and finds the forces with
//! which they hold. So what runs outside of every mode is what it would be without them.
//!
//! A transition is a sample whose time is where a condition begins to hold.

use std::collections::BTreeSet;

use mbs_symbolic::units::{Dimension, Unit};
use mbs_symbolic::{Algebra, Expr, Node, Stage, Symbol};
use proc_macro2::Ident;

use super::declare::quantity;
use super::frictions::memory_of;
use super::known::{Row, Value};
use super::names::{Place, Scope};
use super::resolver::Resolver;
use super::{Constraint, Contact, Lock, Meaning, Mode, Transition};
use crate::diagnostics::{Diagnostic, described, listing, nearest};
use crate::quantity::{Comparison, Setting};
use crate::syntax::{Declaration, FormulaKind, ItemKind, When};

/// A run looks at the condition of each of them in every step.
const MOST_TRANSITIONS: usize = 16;

impl Resolver<'_> {
    /// The memory of a mode, which is 1 while it holds.
    pub(super) fn declare_mode(&mut self, name: &Ident, rows: &[Ident], doc: &str) {
        self.scope.first_memory = self.scope.first_memory.min(self.inputs.len());
        let memory = self.inputs.len();
        let symbol = self.scope.symbol(&name.to_string(), Stage::Variable, Meaning::Input(memory));
        let value = Value::Symbol { symbol, dimension: Dimension::NONE, span: name.span() };
        self.scope.declare(name, value, &mut self.errors);
        self.inputs.push(Setting { quantity: quantity(name, doc, "", Unit::ONE), value: 0.0 });
        self.rows_of_modes.extend(rows.iter().map(|row| (row.to_string(), self.modes.len())));
        self.modes.push(Mode { name: name.clone(), memory });
    }

    /// The symbol of the multiplier of a row of a mode: a memory, which a run sets while the mode holds.
    pub(super) fn declare_lock(&mut self, name: &Ident) -> Row {
        let memory = self.inputs.len();
        let text = format!("lambda({name})");
        let multiplier = self.scope.symbol(&text, Stage::Variable, Meaning::Input(memory));
        let held = memory_of(name, "held");
        let doc = "the multiplier of a constraint while its mode holds";
        self.inputs.push(Setting { quantity: quantity(&held, doc, "", Unit::ONE), value: 0.0 });
        let (dimension, phi, rate, is_broken) = (None, None, None, false);
        Row {
            position: None,
            is_drive: false,
            span: name.span(),
            multiplier,
            dimension,
            phi,
            rate,
            is_broken,
        }
    }

    /// The memory of a transition: the sign that its value had last.
    pub(super) fn declare_transition(&mut self) {
        self.scope.first_memory = self.scope.first_memory.min(self.inputs.len());
        self.sides.push(self.inputs.len());
        let name = Ident::new(&format!("when_{}", self.sides.len()), proc_macro2::Span::call_site());
        let doc = "the sign of the difference of both sides of a condition";
        self.inputs.push(Setting { quantity: quantity(&name, doc, "", Unit::ONE), value: 0.0 });
    }

    /// The mode of a joint or a constraint, if it has one.
    pub(super) fn mode_of(&self, owner: &str) -> Option<usize> {
        self.rows_of_modes.get(owner).copied()
    }

    /// Enters a row, among the constraints or those of its mode.
    pub(super) fn push_row(&mut self, row: Constraint) {
        match self.mode_of(&row.source.name) {
            Some(mode) => self.push_lock(mode, &row),
            None => self.constraints.push(row),
        }
    }

    fn push_lock(&mut self, mode: usize, row: &Constraint) {
        let name = Ident::new(&row.name, row.span);
        let known = self.scope.rows.get(&row.name).map(|known| self.scope.meaning(known.multiplier));
        let (Some(Meaning::Input(held)), Some(mode)) = (known, self.modes.get(mode)) else { return };
        let mode = mode.memory;
        let help = "let fewer constraints come and go";
        if self.has_room_for(&name, "constraint of a mode", help).is_none() {
            return;
        }
        let contact = match row.rate {
            Some(rate) => self.contact_of_rate(rate),
            None => self.contact(row.phi),
        };
        let dimension = Dimension::of(1, 2, -2).over(row.dimension);
        if let Some(input) = self.inputs.get_mut(held) {
            (input.quantity.dimension, input.quantity.unit) = (dimension, dimension.si_unit());
        }
        self.locks.push(Lock { name: row.name.clone(), contact, mode, held, span: row.span });
    }

    /// An equation between rates with its derivative. Nothing holds positions.
    fn contact_of_rate(&mut self, rate: Expr) -> Contact {
        let algebra = Algebra::new(&mut self.scope.arena);
        let motion = &self.scope.motion;
        let scalar = algebra.scalar(rate);
        let (slopes, curved) = (motion.slopes_of_rate(scalar), motion.rate(scalar).expr());
        let gap = self.scope.arena.zero();
        self.contact_with((gap, rate, curved), slopes)
    }

    /// A mode by its name: the place of its memory among the inputs, and its symbol.
    pub(super) fn mode(&mut self, name: &Ident) -> Option<(usize, Symbol)> {
        if let Some(mode) = self.modes.iter().find(|mode| mode.name == *name) {
            return Some((mode.memory, self.scope.symbol_of(Meaning::Input(mode.memory))?));
        }
        let names: Vec<String> = self.modes.iter().map(|mode| mode.name.to_string()).collect();
        let help = match nearest(&name.to_string(), names.iter().map(String::as_str)) {
            Some(near) => format!("did you mean `{near}`?"),
            None if names.is_empty() => {
                "declare one: `mode engaged { fixed lock (plate, wheel); }`".to_owned()
            }
            None => format!("the modes are {}", listing(&names)),
        };
        self.errors.push(Diagnostic::new(name.span(), format!("there is no mode `{name}`")).help(help));
        None
    }

    /// Refuses a first value of a mode that is neither 0 nor 1.
    pub(super) fn check_mode(&mut self, name: &Ident, value_span: proc_macro2::Span) {
        let value = self.inputs.iter().find(|input| *name == input.quantity.name).map(|input| input.value);
        if value.is_some_and(|value| value != 0.0 && value != 1.0) {
            let message = format!("`{name}` holds at first or it does not");
            let help = format!("write `mode {name} = 1 {{ … }}`, or leave the value out");
            self.errors.push(Diagnostic::new(value_span, message).help(help));
        }
    }

    /// Reads a transition.
    pub(super) fn resolve_when(&mut self, when: &When) {
        let Some(memory) = self.sides.get(self.resolved_sides).copied() else { return };
        self.resolved_sides += 1;
        let sets = self.sets(&when.sets);
        let condition = &when.condition;
        let [left, right] = [&condition.left, &condition.right]
            .map(|side| self.scope.formula(side, Place::Anywhere, &mut self.errors));
        let (Some(left), Some(right)) = (left, right) else { return };
        if let (Some(a), Some(b)) = (left.dimension, right.dimension)
            && a != b
        {
            let message = format!("{} cannot be compared with {}", described(a), described(b));
            let help = "give the number its unit, or compare with 0";
            self.errors.push(Diagnostic::new(condition.comparison_span, message).help(help));
            return;
        }
        let value = self.scope.arena.sub(left.expr, right.expr);
        let mut refuse =
            |message: &str, help: &str| self.errors.push(Diagnostic::new(when.keyword, message).help(help));
        if self.scope.arena.stage(value) != Stage::Variable {
            let help =
                "write it in positions, velocities, forces, inputs or time, as in `when x < 0 [m] { … }`";
            return refuse("this never begins to hold: nothing that changes is left in it", help);
        }
        let sides = match condition.comparison {
            Comparison::Less | Comparison::LessOrEqual => [left.expr, right.expr],
            Comparison::Greater | Comparison::GreaterOrEqual => [right.expr, left.expr],
        };
        if let Some(stop) = bearing(&self.scope, sides) {
            let help = format!("write `when {stop} < 0.5 {{ … }}` for the moment at which it is left");
            return refuse(
                &format!("this never begins to hold: the force of `{stop}` is never below 0"),
                &help,
            );
        }
        if when.sets.is_empty() {
            let help =
                "enter or leave a mode in it, or give a memory a value: `when x < 0 [m] { enter latched; }`";
            return refuse("this `when` does nothing", help);
        }
        if self.transitions.len() == MOST_TRANSITIONS {
            let message =
                format!("a mechanism has at most {MOST_TRANSITIONS} of these, and this is one more");
            return refuse(&message, "gather what happens at the same moment in one `when`");
        }
        let is_rising = matches!(condition.comparison, Comparison::Greater | Comparison::GreaterOrEqual);
        let is_strict = matches!(condition.comparison, Comparison::Greater | Comparison::Less);
        let text = condition.text.clone();
        let symbols = self.scope.arena.symbols_in(value);
        let mut meanings = symbols.iter().map(|&symbol| self.scope.meaning(symbol));
        let sees_forces = meanings.clone().any(|meaning| self.is_of_forces(meaning));
        let jumps = meanings.all(|meaning| matches!(meaning, Meaning::Input(_) | Meaning::Parameter(_)));
        let holds_near = !(is_strict && jumps || sees_forces);
        let transition =
            Transition { value, is_rising, is_strict, holds_near, sees_forces, memory, text, sets };
        self.transitions.push(transition);
    }

    /// True of what a run solves for: accelerations, multipliers, and the forces of stops, frictions that stick and modes.
    fn is_of_forces(&self, meaning: Meaning) -> bool {
        match meaning {
            Meaning::Acceleration(_) | Meaning::Multiplier(_) => true,
            Meaning::Input(memory) => {
                self.locks.iter().any(|lock| lock.held == memory)
                    || self.stops.iter().any(|stop| stop.force == Some(memory))
                    || self.frictions.iter().any(|friction| friction.memory + 1 == memory)
            }
            _ => false,
        }
    }

    /// Refuses modes that are never entered, and what does not go with modes.
    pub(super) fn check_modes(&mut self, declaration: &Declaration) {
        let sets = declaration.items.iter().flat_map(|item| match &item.kind {
            ItemKind::Every(every) => every.sets.as_slice(),
            ItemKind::When(when) => when.sets.as_slice(),
            _ => &[],
        });
        let (mut set, mut entered) = (BTreeSet::new(), BTreeSet::new());
        for it in sets {
            let name = it.memory.to_string();
            let is_entered = matches!(&it.value.kind, FormulaKind::Number { value, .. } if !value.is_zero());
            if is_entered {
                entered.insert(name.clone());
            }
            set.insert(name);
        }
        for item in &declaration.items {
            let ItemKind::Mode { name, value, rows } = &item.kind else { continue };
            let mut refuse = |message: String, help: String| {
                self.errors.push(Diagnostic::new(name.span(), message).help(help));
            };
            if rows.is_empty() {
                let help = format!("`mode {name} {{ fixed lock (plate, wheel); }}`, or take a `memory`");
                refuse(format!("nothing holds in `{name}`"), help);
            } else if !set.contains(&name.to_string()) {
                let help = format!("say when, as in `when x < 0 [m] {{ enter {name}; }}`");
                refuse(format!("nothing enters or leaves `{name}`"), help);
            } else if value.is_none() && !entered.contains(&name.to_string()) {
                let help = format!("enter it, or let it hold at first: `mode {name} = 1 {{ … }}`");
                refuse(format!("nothing enters `{name}`"), help);
            }
            if self.solver.has_reduced_states() {
                let help = "leave `states = reduced;` out where there are modes".to_owned();
                refuse(format!("`{name}` holds coordinates that are not integrated"), help);
            }
            if self.solver.reverse.is_some() {
                let help = "leave `gradients = reverse;` out".to_owned();
                refuse(format!("no way leads back through what enters `{name}`"), help);
            }
        }
    }
}

/// The stop whose force is to be less than 0.
fn bearing(scope: &Scope<'_>, [smaller, larger]: [Expr; 2]) -> Option<String> {
    let is_force =
        |force: Symbol| matches!(scope.arena.node(smaller), Node::Symbol(symbol) if *symbol == force);
    let mut stops = scope.stops.iter().filter(|(_, stop)| stop.force.is_some_and(is_force));
    stops.next().filter(|_| scope.arena.is_zero(larger)).map(|(name, _)| name.clone())
}
