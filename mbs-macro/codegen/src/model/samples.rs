//! `every 1 [ms] { set u = k*(target - x); }`: what a controller does at sample times.
//!
//! A memory is an input that the mechanism sets itself, at the samples of its clocks. So every path that carries inputs
//! carries memories, and a step knows nothing of clocks.

use std::collections::BTreeSet;

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Expr, Number, Symbol};
use proc_macro2::{Ident, Span};
use rustc_hash::FxHashMap as HashMap;

use super::known::Value;
use super::names::Place;
use super::resolver::Resolver;
use super::{Clock, Meaning, Requirement};
use crate::diagnostics::{Diagnostic, listing, nearest};
use crate::quantity::Comparison;
use crate::syntax::{Declaration, Every, FormulaKind, ItemKind, Set};

/// A mechanism has at most so many clocks, of which a step asks each whether it is due.
const MOST_CLOCKS: usize = 64;
/// A clock samples at most so often, in s, and at least so often: a run counts its samples exactly, and comes to an end.
const SHORTEST_PERIOD: f64 = 1e-9;
const LONGEST_PERIOD: f64 = 1e9;

impl Resolver<'_> {
    /// Reads what a clock does: each `set` sees the memories as those before it have left them.
    pub(super) fn resolve_every(&mut self, every: &Every) {
        let time = |what| (what, Dimension::TIME);
        let what = time("the period of `every`");
        let period = self.scope.formula_of(&every.period, Place::Property, what, &mut self.errors);
        let offset = match &every.offset {
            None => Some(self.scope.arena.zero()),
            Some(offset) => {
                let what = time("the offset of `every`");
                self.scope.formula_of(offset, Place::Property, what, &mut self.errors)
            }
        };
        let sets = self.sets(&every.sets);
        let error = |message: String, help: &str| Diagnostic::new(every.keyword, message).help(help);
        if every.sets.is_empty() {
            self.errors.push(error(
                "this `every` sets nothing".to_owned(),
                "give a memory a value in it: `memory u [V] = 0; every 1 [ms] { set u = …; }`",
            ));
        }
        if self.clocks.len() == MOST_CLOCKS {
            let message = format!("a mechanism has at most {MOST_CLOCKS} clocks, and this is one more");
            self.errors.push(error(message, "gather what has the same period in one `every`"));
        }
        let (Some(period), Some(offset), Some(first)) = (period, offset, every.sets.first()) else { return };
        let name = match &every.period.kind {
            FormulaKind::Name(name) => name.to_string(),
            _ => format!("the sampling period of {}", first.memory),
        };
        self.bound(&name, (period, "it is the period of a clock"), LONGEST_PERIOD, every.period.span);
        let least = self.seconds(SHORTEST_PERIOD);
        self.scope.requirements.push(Requirement {
            name,
            value: period,
            difference: self.scope.arena.sub(period, least),
            comparison: Comparison::GreaterOrEqual,
            text: "it is the period of a clock, which has to be at least 1 ns".to_owned(),
            span: every.period.span,
        });
        if let Some(formula) = &every.offset {
            let name = format!("the offset of the samples of {}", first.memory);
            self.bound(&name, (offset, "it is the offset of a clock"), LONGEST_PERIOD, formula.span);
            let opposite = self.scope.arena.neg(offset);
            self.bound(&name, (opposite, "it is the offset of a clock"), LONGEST_PERIOD, formula.span);
        }
        self.clocks.push(Clock { period, offset, sets });
    }

    /// Memories with their values, each once: what is set later sees what was set before it.
    pub(super) fn sets(&mut self, sets: &[Set]) -> Vec<(usize, Expr)> {
        let mut found: Vec<(usize, Expr)> = Vec::new();
        let mut known: HashMap<Symbol, Expr> = HashMap::default();
        for set in sets {
            let memory = if set.is_of_mode { self.mode(&set.memory) } else { self.memory(&set.memory) };
            let Some((memory, symbol)) = memory else { continue };
            let what = format!("the value of `{}`", set.memory);
            let dimension = self.inputs[memory].quantity.dimension;
            let value =
                self.scope.formula_of(&set.value, Place::Sample, (&what, dimension), &mut self.errors);
            let Some(value) = value else { continue };
            let value = self.scope.arena.substitute(value, &known);
            known.insert(symbol, value);
            match found.iter_mut().find(|(earlier, _)| *earlier == memory) {
                Some((_, earlier)) => *earlier = value,
                None => found.push((memory, value)),
            }
        }
        found
    }

    /// Asks that a time is no longer than clocks count exactly.
    fn bound(&mut self, name: &str, (value, what): (Expr, &str), most: f64, span: Span) {
        let bound = self.seconds(most);
        self.scope.requirements.push(Requirement {
            name: name.to_owned(),
            value,
            difference: self.scope.arena.sub(value, bound),
            comparison: Comparison::LessOrEqual,
            text: format!("{what}, which has to be {most:e} s at most"),
            span,
        });
    }

    fn seconds(&mut self, value: f64) -> Expr {
        self.scope.arena.number(Number::from(value))
    }

    /// A memory by its name: its place among the inputs, and its symbol.
    fn memory(&mut self, name: &Ident) -> Option<(usize, Symbol)> {
        let text = name.to_string();
        let first = self.scope.first_memory;
        let message = match self.scope.values.get(&text) {
            Some(Value::Refused(_)) => return None,
            Some(Value::Symbol { symbol, .. }) => match self.scope.meaning(*symbol) {
                Meaning::Input(at) if at >= first => return self.settable(name, at, *symbol),
                Meaning::Input(_) => format!("`{text}` is an input, which the program sets"),
                Meaning::Parameter(_) => format!("`{text}` is a parameter, which stays as it is"),
                _ => format!("`{text}` is integrated, and no clock sets it"),
            },
            Some(Value::Definition(_)) => format!("`{text}` is a name for a formula, and no memory"),
            _ => format!("there is no memory `{text}`"),
        };
        let memories = self.inputs.get(first..).unwrap_or_default();
        // one whose name is that of something else has been refused
        if memories.iter().any(|memory| memory.quantity.name == text) {
            return None;
        }
        // those that a run has for itself have no names
        let is_named = |name: &str| self.scope.values.contains_key(name);
        let names = (first..).zip(memories).filter(|(at, memory)| {
            !self.is_of_run(*at)
                && is_named(&memory.quantity.name)
                && self.modes.iter().all(|mode| mode.memory != *at)
        });
        let names = names.map(|(_, memory)| memory.quantity.name.as_str());
        let help = match nearest(&text, names.clone()) {
            Some(near) => format!("did you mean `{near}`?"),
            None if names.clone().next().is_none() => {
                "declare a memory with its unit: `memory u [V] = 0;`".to_owned()
            }
            None => format!("the memories are {}", listing(names)),
        };
        self.errors.push(Diagnostic::new(name.span(), message).help(help));
        None
    }

    /// True of the memories that stops and frictions set.
    fn is_of_run(&self, memory: usize) -> bool {
        let of_stops = self.stops.iter().map(|stop| stop.memory);
        let mut of_contacts = of_stops.chain(self.frictions.iter().map(|friction| friction.memory));
        of_contacts.any(|own| own == memory || own + 1 == memory)
    }

    /// A memory that no stop sets.
    fn settable(&mut self, name: &Ident, memory: usize, symbol: Symbol) -> Option<(usize, Symbol)> {
        if self.modes.iter().any(|mode| mode.memory == memory) {
            let help = format!("write `enter {name};` or `leave {name};`");
            self.errors.push(Diagnostic::new(name.span(), format!("`{name}` is a mode")).help(help));
            return None;
        }
        if !self.is_of_run(memory) {
            return Some((memory, symbol));
        }
        let message = format!("`{name}` is set by the run, and no clock sets it");
        let help = "let a memory of its own depend on it: `set held = …;`";
        self.errors.push(Diagnostic::new(name.span(), message).help(help));
        None
    }

    /// The memories that no clock sets. The copies that a loop or an assembly makes of a statement are warned of once.
    pub(super) fn never_set(&self, declaration: &Declaration) -> Vec<Diagnostic> {
        let of_clocks = self.clocks.iter().flat_map(|clock| &clock.sets);
        let sets = of_clocks.chain(self.transitions.iter().flat_map(|transition| &transition.sets));
        let set: BTreeSet<&str> =
            sets.map(|(memory, _)| self.inputs[*memory].quantity.name.as_str()).collect();
        let mut told = BTreeSet::new();
        let never = declaration.items.iter().filter_map(|item| match &item.kind {
            ItemKind::Memory { name, .. } if !set.contains(&*name.to_string()) => {
                told.insert(item.position).then(|| {
                    Diagnostic::new(
                        name.span(),
                        "no clock sets this memory, and no `when`, so that it stays as it is",
                    )
                    .help(format!("set it, as in `every 1 [ms] {{ set {name} = …; }}`, or make it a `param`"))
                })
            }
            _ => None,
        });
        never.collect()
    }

    /// A `set` that belongs to no clock.
    pub(super) fn set_outside(&mut self, set: &Set) {
        let done = if set.is_of_mode { "entered or left" } else { "set" };
        let message = format!("nothing says when `{}` is {done}", set.memory);
        let help = "put it in a clock, `every 1 [ms] { … }`, or in a `when x < 0 [m] { … }`";
        self.errors.push(Diagnostic::new(set.memory.span(), message).help(help));
    }
}
