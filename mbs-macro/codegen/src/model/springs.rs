//! Springs with dampers, between two points or between two bodies' angles.
//!
//! With the elongation s (distance minus free length, or relative angle minus
//! free angle) the tension is F = k s + c ṡ. It does the virtual work −F δs, so
//! the generalized forces are −F ∂s/∂q, and the spring holds the energy ½ k s².

use std::collections::{BTreeMap, HashMap};

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Expr, Number};
use proc_macro2::{Ident, Span};

use super::joints;
use super::names::Place;
use super::resolver::Resolver;
use super::{Load, Meaning};
use crate::diagnostics::{Diagnostic, listing, nearest};
use crate::syntax::{Property, Spring};

/// Property, its dimension for a spring between points, and between angles.
const PROPERTIES: [(&str, Dimension, Dimension); 2] = [
    ("stiffness", Dimension::of(1, 0, -2), Dimension::of(1, 2, -2)),
    ("damping", Dimension::of(1, 0, -1), Dimension::of(1, 2, -1)),
];

impl Resolver<'_> {
    pub(super) fn resolve_spring(&mut self, spring: &Spring) {
        if !self.declare_load(&spring.name) {
            return;
        }
        let first = self.scope.attachment(&spring.first, &mut self.errors);
        let second = self.scope.attachment(&spring.second, &mut self.errors);
        let Some(properties) = self.spring_properties(spring) else { return };
        let (Some(first), Some(second)) = (first, second) else { return };
        let free = properties.get(free_name(spring)).copied().unwrap_or(self.scope.arena.zero());
        let stretch = if spring.is_torsion {
            self.scope.arena.sub(first.angle, second.angle)
        } else {
            joints::distance_between(&mut self.scope.arena, &first, &second)
        };
        if !self.depends_on_coordinates(stretch) {
            self.errors.push(
                Diagnostic::new(spring.name.span(), format!("`{}` connects nothing that moves", spring.name))
                    .help(if spring.is_torsion {
                        "one of its bodies has to turn"
                    } else {
                        "let it act between points that move apart"
                    }),
            );
            return;
        }
        let elongation = self.scope.arena.sub(stretch, free);
        self.push_spring(elongation, &properties);
    }

    fn push_spring(&mut self, elongation: Expr, properties: &BTreeMap<String, Expr>) {
        let mut direction = HashMap::new();
        for coordinate in &self.coordinates {
            direction.insert(coordinate.position, self.scope.arena.variable(coordinate.velocity));
        }
        let arena = &mut self.scope.arena;
        let zero = arena.zero();
        let stiffness = properties.get("stiffness").copied().unwrap_or(zero);
        let damping = properties.get("damping").copied().unwrap_or(zero);
        let rate = arena.derivative(elongation, &direction);
        let (elastic, viscous) = (arena.mul(stiffness, elongation), arena.mul(damping, rate));
        let tension = arena.add(elastic, viscous);
        let tension = arena.share(tension);
        let energy = arena.product(&[(stiffness, 1), (elongation, 2)]);
        self.potentials.push(arena.scale(energy, Number::ratio(1, 2)));
        for symbol in self.scope.arena.symbols_in(elongation) {
            if let Meaning::Coordinate(coordinate) = self.scope.meaning(symbol) {
                let arena = &mut self.scope.arena;
                let slope = arena.partial(elongation, symbol);
                let work = arena.mul(tension, slope);
                self.loads.push(Load { coordinate, value: arena.neg(work) });
            }
        }
    }

    fn spring_properties(&mut self, spring: &Spring) -> Option<BTreeMap<String, Expr>> {
        let free = (free_name(spring), if spring.is_torsion { Dimension::NONE } else { Dimension::LENGTH });
        let known: Vec<(&str, Dimension)> = PROPERTIES
            .iter()
            .map(|(name, linear, torsional)| (*name, if spring.is_torsion { *torsional } else { *linear }))
            .chain([free])
            .collect();
        let mut values = BTreeMap::new();
        let mut given: BTreeMap<String, Span> = BTreeMap::new();
        let mut is_complete = true;
        for Property { name, value } in &spring.properties {
            let text = name.to_string();
            if let Some(earlier) = given.insert(text.clone(), name.span()) {
                let what = format!("the {name} of `{}`", spring.name);
                self.repeated(&what, name.span(), earlier);
                is_complete = false;
                continue;
            }
            let Some((_, dimension)) = known.iter().find(|(known, _)| *known == text) else {
                self.errors.push(unknown_property(name, &known));
                is_complete = false;
                continue;
            };
            let what = format!("the {name} of `{}`", spring.name);
            match self.scope.formula_of(value, Place::Property, (&what, *dimension), &mut self.errors) {
                Some(value) => drop(values.insert(text, value)),
                None => is_complete = false,
            }
        }
        if is_complete {
            self.check_given(spring, &given, free.0);
        }
        is_complete.then_some(values)
    }

    /// A spring without stiffness and damping does nothing; one with stiffness
    /// needs to know where it is at rest.
    fn check_given(&mut self, spring: &Spring, given: &BTreeMap<String, Span>, free: &str) {
        let has = |name: &str| given.contains_key(name);
        let missing = match (has("stiffness"), has("damping"), has(free)) {
            (false, false, _) => "`stiffness` or `damping`".to_owned(),
            (true, _, false) => format!("`{free}`, at which it is free of force"),
            _ => return,
        };
        self.errors.push(
            Diagnostic::new(spring.name.span(), format!("`{}` does not say its {missing}", spring.name))
                .help(format!("as in `{{ stiffness = …; {free} = …; damping = …; }}`")),
        );
    }
}

fn free_name(spring: &Spring) -> &'static str {
    if spring.is_torsion { "angle" } else { "length" }
}

fn unknown_property(name: &Ident, known: &[(&str, Dimension)]) -> Diagnostic {
    let names: Vec<_> = known.iter().map(|(name, _)| *name).collect();
    let error = Diagnostic::new(name.span(), format!("a spring has no `{name}`"));
    match nearest(&name.to_string(), names.iter().copied()) {
        Some(near) => error.help(format!("did you mean `{near}`?")),
        None => error.help(format!("its properties are {}", listing(names))),
    }
}
