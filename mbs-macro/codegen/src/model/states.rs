//! `state current [A] = 0; der(current) = (u - R*current)/L;`: first-order states of the declaration's own.
//!
//! A state is the velocity of a block of its own ([`Coordinate`](super::Coordinate)), and the right
//! side of its equation the load along it.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Expr, Stage};
use proc_macro2::Ident;

use super::declare::quantity;
use super::known::Value;
use super::names::Place;
use super::resolver::Resolver;
use super::{Block, Coordinate, Meaning, Start};
use crate::diagnostics::{Diagnostic, listing, nearest};
use crate::mechanics::Work;
use crate::quantity::Quantity;
use crate::syntax::{Formula, UnitText};

impl Resolver<'_> {
    pub(super) fn declare_state(&mut self, name: &Ident, unit: &UnitText, doc: &str) {
        self.declare_state_of(name, quantity(name, doc, &unit.text, unit.unit));
    }

    /// A state of this unit.
    pub(super) fn declare_state_of(&mut self, name: &Ident, quantity: Quantity) {
        let (at, text) = (self.coordinates.len(), name.to_string());
        if self.scope.values.contains_key(&text) {
            self.scope.declare(name, Value::Refused(name.span()), &mut self.errors);
            self.refused_states.insert(text);
            return;
        }
        // formulas reach a coordinate's velocity from its position, and its acceleration from that
        let integral = format!("integral({text})");
        let position = self.scope.symbol(&integral, Stage::Variable, Meaning::Coordinate(at));
        let velocity = self.scope.symbol(&text, Stage::Variable, Meaning::Velocity(at));
        self.scope.motion.add_coordinate(position, velocity);
        self.scope.symbol(&format!("der({text})"), Stage::Variable, Meaning::Acceleration(at));
        let value = Value::Symbol { symbol: velocity, dimension: quantity.dimension, span: name.span() };
        self.scope.declare(name, value, &mut self.errors);
        let (span, block) = (name.span(), Block::Own);
        self.coordinates.push(Coordinate { quantity, span, position, velocity, block });
    }

    /// The value at the start that stands in the declaration of a state.
    pub(super) fn resolve_state(&mut self, name: &Ident, value: Option<&Formula>) {
        let (Some(state), Some(value)) = (self.state_named(name), value) else { return };
        self.start_state(state, name, value);
    }

    /// The start of a state.
    pub(super) fn start_state(&mut self, coordinate: usize, name: &Ident, value: &Formula) {
        let what = format!("the start of `{name}`");
        let span = name.span();
        if let Some(earlier) = self.starts.iter().find(|start| start.coordinate == coordinate) {
            let earlier = earlier.span;
            return self.repeated(&what, span, earlier);
        }
        let dimension = self.coordinates[coordinate].quantity.dimension;
        let value = self.scope.formula_of(value, Place::Property, (&what, dimension), &mut self.errors);
        if let Some(value) = value {
            self.starts.push(Start { coordinate, is_rate: true, is_guess: false, value, span });
        }
    }

    /// `der(current) = …;`
    pub(super) fn resolve_rate(&mut self, name: &Ident, value: &Formula) {
        let Some(coordinate) = self.state_named(name) else {
            if !self.refused_states.contains(&name.to_string()) {
                let error = self.no_state(name);
                self.errors.push(error);
            }
            return;
        };
        let what = format!("the rate of `{name}`");
        if let Some(earlier) = self.rates.insert(coordinate, name.span()) {
            return self.repeated(&what, name.span(), earlier);
        }
        let dimension = self.coordinates[coordinate].quantity.dimension.over(Dimension::TIME);
        let value = self.scope.formula_of(value, Place::Rate, (&what, dimension), &mut self.errors);
        if let Some(rate) = value {
            self.push_rate(name, coordinate, rate);
        }
    }

    /// The rate of a state is the load along its block.
    pub(super) fn push_rate(&mut self, name: &Ident, coordinate: usize, rate: Expr) {
        let along = vec![(coordinate, self.scope.arena.one())];
        self.push_work(name, Work { force: rate, along });
    }

    /// The error for a rate of something that is no state.
    fn no_state(&self, name: &Ident) -> Diagnostic {
        let text = name.to_string();
        if self.coordinate_named(&text).is_some() {
            return Diagnostic::new(
                name.span(),
                format!("`{text}` is a coordinate, whose motion forces drive"),
            )
            .help("prescribe it with a `drive`, or let a `force` act along it");
        }
        let message = format!("there is no state `{text}`");
        let names: Vec<&str> = self.states().map(|state| state.quantity.name.as_str()).collect();
        let help = match nearest(&text, names.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None if names.is_empty() => format!("declare it: `state {text} [A] = 0;` with its unit"),
            None => format!("the states are {}", listing(&names)),
        };
        Diagnostic::new(name.span(), message).help(help)
    }

    /// Every state has an equation.
    pub(super) fn check_rates(&mut self) {
        for (at, state) in self.coordinates.iter().enumerate() {
            if !state.is_own() || self.rates.contains_key(&at) {
                continue;
            }
            let name = &state.quantity.name;
            let message = format!("nothing says how the state `{name}` changes");
            let help = format!("add its equation: `der({name}) = …;`");
            self.errors.push(Diagnostic::new(state.span, message).help(help));
        }
    }

    /// The position of a state among the coordinates.
    pub(super) fn state_named(&self, name: &Ident) -> Option<usize> {
        self.coordinate_named(&name.to_string()).filter(|&at| self.coordinates[at].is_own())
    }

    fn states(&self) -> impl Iterator<Item = &Coordinate> {
        self.coordinates.iter().filter(|coordinate| coordinate.is_own())
    }
}
