//! `let` and `const`: resolved when a formula first needs them.

use std::collections::BTreeSet;

use super::known::{State, Typed, Value};
use super::names::{Place, Scope};
use crate::diagnostics::{Diagnostic, Diagnostics};

/// Names may build on each other this deep before those below are resolved first.
const DEEPEST: usize = 128;

/// A definition of more nodes than this is a value that is computed once. Those of a person are
/// smaller, and stay open to algebra; definitions that build on each other a hundred times would
/// otherwise become sums of hundreds of terms, each with a sum in it.
const LARGEST_OPEN: usize = 100;

impl Scope<'_> {
    /// Resolves a `let` or `const` that is met for the first time. Those that it
    /// builds on are met on the way; where there are many, they come first, so
    /// that the recursion has an end.
    pub fn definition(&mut self, name: &str, errors: &mut Diagnostics) -> Option<Typed> {
        if self.depth > DEEPEST + 1 {
            return self.endless(name, errors);
        }
        self.depth += 1;
        if self.depth > DEEPEST {
            for below in self.untouched_below(name) {
                if self.is_untouched(&below) {
                    self.resolve_definition(&below, errors);
                }
            }
        }
        let typed = self.resolve_definition(name, errors);
        self.depth -= 1;
        typed
    }

    /// The definitions that one builds on, each behind its own.
    fn untouched_below(&self, name: &str) -> Vec<String> {
        let names_in = |name: &str| match self.values.get(name) {
            Some(Value::Definition(definition)) if self.is_untouched(name) => {
                definition.formula.names().into_iter().map(ToString::to_string).collect()
            }
            _ => Vec::new(),
        };
        let mut seen = BTreeSet::from([name.to_owned()]);
        let mut way = vec![(name.to_owned(), names_in(name))];
        let mut found = Vec::new();
        while let Some((_, names)) = way.last_mut() {
            match names.pop() {
                Some(next) if seen.insert(next.clone()) => {
                    let names = names_in(&next);
                    way.push((next, names));
                }
                Some(_) => {}
                None => found.extend(way.pop().map(|(name, _)| name)),
            }
        }
        found.pop();
        found
    }

    fn is_untouched(&self, name: &str) -> bool {
        let Some(Value::Definition(definition)) = self.values.get(name) else { return false };
        matches!(definition.state, State::Untouched)
    }

    /// With all that it builds on resolved, only a circle is this deep.
    fn endless(&mut self, name: &str, errors: &mut Diagnostics) -> Option<Typed> {
        if let Some(Value::Definition(definition)) = self.values.get_mut(name) {
            definition.state = State::Failed;
            errors.push(
                Diagnostic::new(definition.span, format!("`{name}` is defined through itself"))
                    .help("break the circle: one of the names on it needs a value of its own"),
            );
        }
        None
    }

    fn resolve_definition(&mut self, name: &str, errors: &mut Diagnostics) -> Option<Typed> {
        let Some(Value::Definition(definition)) = self.values.get_mut(name) else { return None };
        definition.state = State::Open;
        let (formula, place) =
            (definition.formula, if definition.is_constant { Place::Constant } else { Place::Anywhere });
        // a definition means the same wherever it is used
        let locals = std::mem::take(&mut self.locals);
        let mut typed = self.formula(formula, place, errors);
        if let Some(typed) = &mut typed
            && self.arena.is_larger_than(typed.expr, LARGEST_OPEN)
        {
            typed.expr = self.arena.share(typed.expr);
        }
        self.locals = locals;
        if let Some(Value::Definition(definition)) = self.values.get_mut(name) {
            definition.state = typed.map_or(State::Failed, State::Done);
        }
        typed
    }
}
