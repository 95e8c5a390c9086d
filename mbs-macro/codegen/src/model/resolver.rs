//! From statements to the model, in an order that lets statements stand in any.
//!
//! # Order
//!
//! Names come first. Values, profiles, places, constraints and forces follow. Rates of states and outputs come last,
//! since they may measure all of these.

use std::collections::{BTreeMap, BTreeSet};

use mbs_symbolic::Expr;
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;
use rustc_hash::FxHashMap as HashMap;

use super::known::{Definition, Energies, State, Value};
use super::names::Scope;
use super::{
    Block, Body, Check, Clock, Closes, Constraint, Coordinate, Direction, Event, Friction, Gap, Lock, Mode,
    Model, Output, ReactiveLoad, Solver, Start, Stop, Transition,
};
use crate::diagnostics::{Diagnostic, Diagnostics, counted};
use crate::mechanics::{Inertia, Load, Particle};
use crate::quantity::Setting;
use crate::syntax::{Declaration, Item, ItemKind};

/// Resolves names and checks dimensions.
///
/// # Errors
/// All of them, as far as they do not follow from each other.
pub fn resolve(declaration: &Declaration) -> Result<Model, Diagnostics> {
    let mut resolver = Resolver::new(declaration);
    // Names first, so that statements may stand in any order.
    resolver.each(declaration, Resolver::declare);
    resolver.each(declaration, Resolver::find_asked);
    resolver.each(declaration, Resolver::declare_memory);
    resolver.each(declaration, Resolver::declare_rows);
    resolver.each(declaration, Resolver::resolve_value);
    resolver.each(declaration, |resolver, item| {
        if let ItemKind::Table(table) = &item.kind {
            resolver.resolve_table(table);
        }
    });
    resolver.each(declaration, Resolver::resolve_places);
    resolver.each(declaration, Resolver::resolve_constraint);
    resolver.each(declaration, Resolver::resolve_item);
    resolver.forces_are_known();
    // what drives a state may measure forces, which no rate changes
    resolver.each(declaration, |resolver, item| {
        if let ItemKind::Rate { state, value, .. } = &item.kind {
            resolver.resolve_rate(state, value);
        }
    });
    resolver.each(declaration, Resolver::resolve_measurement);
    resolver.resolve_rest();
    resolver.finish(declaration)
}

/// The model under construction, with what is only needed until it is done.
pub(super) struct Resolver<'a> {
    pub scope: Scope<'a>,
    pub errors: Diagnostics,
    pub mechanism: Span,
    pub runtime: Option<(TokenStream, Span)>,
    pub dof: Option<(i64, Span)>,
    pub minimum_norm: Option<Span>,
    pub solver: Solver,
    pub parameters: Vec<Setting>,
    /// How many of them have their value.
    pub resolved_parameters: usize,
    pub inputs: Vec<Setting>,
    pub clocks: Vec<Clock>,
    pub coordinates: Vec<Coordinate>,
    pub bodies: Vec<Body>,
    pub resolved_bodies: BTreeSet<usize>,
    /// Where a body stands in the list, and in the source.
    pub body_names: HashMap<String, (usize, Span)>,
    pub constraints: Vec<Constraint>,
    pub row_count: usize,
    pub particles: Vec<Particle>,
    /// Their names.
    pub particle_idents: Vec<Ident>,
    /// The names of particles, and where they are declared.
    pub particle_names: HashMap<String, Span>,
    pub gravity: Option<([Expr; 2], Span)>,
    pub loads: Vec<Load>,
    pub reactive_loads: Vec<ReactiveLoad>,
    pub checks: Vec<Check>,
    pub gaps: Vec<Gap>,
    pub potentials: Vec<Expr>,
    pub load_names: HashMap<String, Span>,
    pub starts: Vec<Start>,
    /// Where the rate of each own state is given, by its position among the coordinates.
    pub rates: BTreeMap<usize, Span>,
    /// Own states whose name is that of something else.
    pub refused_states: BTreeSet<String>,
    pub closes: Option<Closes>,
    /// The time of the start, and where it is declared.
    pub start_time: Option<(Expr, Span)>,
    pub outputs: Vec<Output>,
    pub output_names: HashMap<String, Span>,
    pub events: Vec<Event>,
    pub stops: Vec<Stop>,
    /// The names of all whose force something asks for.
    pub asked: BTreeSet<String>,
    pub frictions: Vec<Friction>,
    pub modes: Vec<Mode>,
    /// The modes of joints and constraints, by their names.
    pub rows_of_modes: HashMap<String, usize>,
    pub locks: Vec<Lock>,
    pub transitions: Vec<Transition>,
    /// The places of the memories of transitions, in their order, and how many of them are resolved.
    pub sides: Vec<usize>,
    pub resolved_sides: usize,
    pub event_names: HashMap<String, Span>,
}

impl<'a> Resolver<'a> {
    fn new(declaration: &Declaration) -> Self {
        Self {
            scope: Scope::new(),
            errors: Diagnostics::default(),
            mechanism: declaration.name.span(),
            runtime: None,
            dof: None,
            minimum_norm: None,
            solver: Solver::default(),
            parameters: Vec::new(),
            resolved_parameters: 0,
            inputs: Vec::new(),
            clocks: Vec::new(),
            coordinates: Vec::new(),
            bodies: Vec::new(),
            resolved_bodies: BTreeSet::new(),
            body_names: HashMap::default(),
            constraints: Vec::new(),
            row_count: 0,
            particles: Vec::new(),
            particle_idents: Vec::new(),
            particle_names: HashMap::default(),
            gravity: None,
            loads: Vec::new(),
            reactive_loads: Vec::new(),
            checks: Vec::new(),
            gaps: Vec::new(),
            potentials: Vec::new(),
            load_names: HashMap::default(),
            starts: Vec::new(),
            rates: BTreeMap::new(),
            refused_states: BTreeSet::new(),
            closes: None,
            start_time: None,
            outputs: Vec::new(),
            output_names: HashMap::default(),
            events: Vec::new(),
            stops: Vec::new(),
            asked: BTreeSet::new(),
            frictions: Vec::new(),
            modes: Vec::new(),
            rows_of_modes: HashMap::default(),
            locks: Vec::new(),
            transitions: Vec::new(),
            sides: Vec::new(),
            resolved_sides: 0,
            event_names: HashMap::default(),
        }
    }

    /// Reads all statements. The copies that a loop or an assembly makes of one
    /// statement report its errors once.
    fn each(&mut self, declaration: &'a Declaration, read: fn(&mut Self, &'a Item)) {
        let mut reported = BTreeSet::new();
        for item in &declaration.items {
            let before = self.errors.len();
            read(self, item);
            if self.errors.len() > before && !reported.insert(item.position) {
                self.errors.truncate(before);
            }
        }
    }

    fn forces_are_known(&mut self) {
        let (inertias, particles) = (self.inertias(), self.particles.clone());
        let (gravity, springs) = (self.gravity(), self.potentials.clone());
        self.scope.energies = Some(Energies { inertias, particles, gravity, springs });
    }

    fn gravity(&self) -> [Expr; 2] {
        self.gravity.map_or([self.scope.arena.zero(); 2], |(gravity, _)| gravity)
    }

    /// The inertia of each coordinate.
    fn inertias(&self) -> Vec<Inertia> {
        let gravity = self.gravity();
        let inertia = |coordinate: &Coordinate| {
            let (mass, gravity) = match coordinate.block {
                Block::Line { body, direction: Direction::X } => (self.bodies[body].mass, Some(gravity[0])),
                Block::Line { body, direction: Direction::Y } => (self.bodies[body].mass, Some(gravity[1])),
                Block::Line { body, direction: Direction::Angle } => (self.bodies[body].inertia, None),
                Block::Free => (self.scope.arena.zero(), None),
                Block::Own => (self.scope.arena.one(), None),
            };
            let (position, velocity) = (coordinate.position, coordinate.velocity);
            Inertia { position, velocity, mass, gravity, has_energy: !coordinate.is_own() }
        };
        self.coordinates.iter().map(inertia).collect()
    }

    /// Resolves the definitions that nothing else has asked for, so that their errors are found.
    fn resolve_rest(&mut self) {
        let untouched: Vec<String> = self
            .scope
            .values
            .iter()
            .filter(|(_, value)| {
                matches!(value, Value::Definition(Definition { state: State::Untouched, .. }))
            })
            .map(|(name, _)| name.clone())
            .collect();
        for name in untouched {
            self.scope.definition(&name, &mut self.errors);
        }
    }

    fn finish(mut self, declaration: &Declaration) -> Result<Model, Diagnostics> {
        if self.coordinates.is_empty() && self.bodies.is_empty() {
            self.errors.push(
                Diagnostic::new(self.mechanism, format!("`{}` has no bodies", declaration.name))
                    .help("declare one: `body bob (x, y) { mass = 1 [kg]; }`"),
            );
        }
        if declaration.name == "T" {
            self.errors.push(
                Diagnostic::new(self.mechanism, "a mechanism cannot be called `T`: that is its scalar type")
                    .help("give it a longer name"),
            );
        }
        self.check_rates();
        self.check_solver();
        self.check_stops();
        self.check_frictions();
        self.order_frictions();
        self.check_modes(declaration);
        if self.dof.is_none() {
            let lines = self.coordinates.iter().filter(|coordinate| !coordinate.is_own()).count();
            let left = lines as i64 - self.row_count as i64;
            self.errors.push(
                Diagnostic::new(
                    self.mechanism,
                    format!("`{}` does not say how many degrees of freedom it has", declaration.name),
                )
                .help(format!(
                    "add `dof = …;` as a contract that is checked ({} − {} = {left})",
                    counted(lines, "coordinate"),
                    counted(self.row_count, "constraint")
                )),
            );
        }
        let sketch = self.sketch(declaration);
        let warnings = self.warnings(declaration);
        let (zero, gravity) = (self.scope.arena.zero(), self.gravity());
        let model = Model {
            time: self.scope.time,
            inertias: self.inertias(),
            particles: self.particles,
            particle_names: self.particle_idents,
            motion: self.scope.motion,
            meanings: self.scope.meanings,
            arena: self.scope.arena,
            doc: declaration.doc.clone(),
            visibility: declaration.visibility.clone(),
            name: declaration.name.clone(),
            runtime: self.runtime.map_or_else(|| quote!(::mbs_runtime), |(path, _)| path),
            dof: self.dof.unwrap_or((0, self.mechanism)),
            minimum_norm: self.minimum_norm,
            solver: self.solver,
            parameters: self.parameters,
            requirements: self.scope.requirements,
            memories: self.inputs.len().saturating_sub(self.scope.first_memory),
            inputs: self.inputs,
            clocks: self.clocks,
            coordinates: self.coordinates,
            bodies: self.bodies,
            constraints: self.constraints,
            gravity,
            loads: self.loads,
            reactive_loads: self.reactive_loads,
            checks: self.checks,
            gaps: self.gaps,
            potentials: self.potentials,
            start: self.starts,
            start_time: self.start_time.map_or(zero, |(time, _)| time),
            closes: self.closes,
            outputs: self.outputs,
            events: self.events,
            stops: self.stops,
            frictions: self.frictions,
            modes: self.modes,
            locks: self.locks,
            transitions: self.transitions,
            sketch,
            warnings,
        };
        self.errors.finish(model)
    }
}
