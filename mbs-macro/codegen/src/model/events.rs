//! `event hit: x = 0.2 [m] rising;`: a moment that a run finds.

use mbs_symbolic::units::Unit;
use mbs_symbolic::{Number, Stage};
use proc_macro2::{Ident, Span};

use super::Event;
use super::declare::quantity;
use super::names::{Place, duplicate};
use super::resolver::Resolver;
use crate::diagnostics::Diagnostic;
use crate::quantity::Crossing;
use crate::syntax::Formula;

/// A run watches 64 values at once, one of which may be the condition that ends it.
const MOST_EVENTS: usize = 63;
/// As many of them are those of stops, frictions and transitions, where there are transitions.
const OF_CONTACTS: usize = 32;

impl Resolver<'_> {
    pub(super) fn resolve_event(
        &mut self,
        (name, doc): (&Ident, &str),
        [left, right]: [&Formula; 2],
        equals: Span,
        crossing: Crossing,
    ) {
        let text = name.to_string();
        if let Some(earlier) = self.event_names.get(&text) {
            self.errors.push(duplicate(name, *earlier));
            return;
        }
        self.event_names.insert(text, name.span());
        let [left, right] =
            [left, right].map(|side| self.scope.formula(side, Place::Event, &mut self.errors));
        let (Some(left), Some(right)) = (left, right) else { return };
        let difference = self.difference(left, right, equals);
        let Some((value, dimension)) = self.errors.take(difference) else { return };
        if self.scope.arena.stage(value) != Stage::Variable {
            let message = format!("`{name}` does not change: nothing that moves is left in it");
            let help = "write it in positions, velocities or time, as in `event hit: x = 0.2 [m];`";
            self.errors.push(Diagnostic::new(name.span(), message).help(help));
            return;
        }
        // stops, frictions that stick and transitions are watched, too
        let watched = match self.sides.is_empty() {
            true => self.stops.len() + self.frictions.len(),
            false => OF_CONTACTS,
        };
        if self.events.len() + watched >= MOST_EVENTS {
            let message = format!("`{name}` is one event too many: a run watches {MOST_EVENTS} of them");
            let help = "leave some out, or watch them from the program with `advance_until`";
            self.errors.push(Diagnostic::new(name.span(), message).help(help));
            return;
        }
        let unit = Unit { scale: Number::ONE, dimension };
        let quantity = quantity(name, doc, &dimension.si_unit(), unit);
        self.events.push(Event { quantity, value, crossing });
    }
}
