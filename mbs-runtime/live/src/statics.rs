//! Texts and tables that live as long as the process: names in errors and in [`Info`] are `'static`.
//!
//! A mechanism that `mechanism!` makes has them in its binary. One that comes as a text has
//! them here: each name once, and the tables of each declaration once, however often it is
//! compiled. They are never freed, so that a process that compiles ever new declarations
//! grows by some kilobytes with each.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Mutex, MutexGuard, PoisonError};

use mbs_codegen::Compiled;
use mbs_codegen::compiled::{self, Count, Crossing};
use mbs_runtime::__private::{Segment, Spline};
use mbs_runtime::{
    Constraint, DeclaredEvent, DeclaredFriction, DeclaredLock, DeclaredMode, DeclaredStop,
    DeclaredTransition, Derivation, Dimension, Direction, Function, Info, Knots, Modes, Operations, Pivot,
    Quantity, Sampling, Sketch, Switch,
};
use mbs_symbolic::{Block, units};

use crate::words;

/// The tables of a declaration.
pub struct Tables {
    /// Names, units, equations and counts.
    pub info: Info,
    /// The functions given by tables.
    pub splines: &'static [Spline],
    /// Where values over time bend or jump.
    pub corners: &'static [Knots],
    /// Where values of the motion do.
    pub switches: &'static [Switch],
    /// The equations, for people to read.
    pub derivation: Derivation,
    /// The picture of the mechanism.
    pub sketch: Sketch,
    /// The declared step in s.
    pub step: Option<f64>,
    /// The declared feedback.
    pub feedback: Option<compiled::Feedback>,
}

static TEXTS: Mutex<BTreeSet<&'static str>> = Mutex::new(BTreeSet::new());
static TABLES: Mutex<BTreeMap<String, &'static Tables>> = Mutex::new(BTreeMap::new());

/// Locks a mutex whose contents are whole at any time: a panic elsewhere does not spoil them.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The text, for the life of the process.
pub fn text(text: &str) -> &'static str {
    let mut texts = locked(&TEXTS);
    if let Some(known) = texts.get(text) {
        return known;
    }
    let new: &'static str = text.to_owned().leak();
    texts.insert(new);
    new
}

/// The tables of a declaration, given as tokens, and of what it was compiled to.
pub fn tables(declaration: String, compiled: &Compiled) -> &'static Tables {
    let mut tables = locked(&TABLES);
    tables.entry(declaration).or_insert_with(|| Box::leak(Box::new(Tables::new(compiled))))
}

impl Tables {
    fn new(compiled: &Compiled) -> Self {
        Self {
            info: info(compiled),
            splines: leak(compiled.splines.iter().map(|it| spline(it))),
            corners: leak(compiled.corners.iter().map(knots)),
            switches: leak(
                compiled.switches.iter().map(|(name, at)| Switch { name: text(name), knots: knots(at) }),
            ),
            derivation: words::derivation(&compiled.derivation),
            sketch: words::sketch(&compiled.sketch),
            step: compiled.choices.step,
            feedback: compiled.choices.feedback,
        }
    }
}

/// The items, for the life of the process.
pub fn leak<T>(items: impl IntoIterator<Item = T>) -> &'static [T] {
    items.into_iter().collect::<Vec<_>>().leak()
}

fn info(compiled: &Compiled) -> Info {
    Info::from_parts(
        text(&compiled.name),
        text(&compiled.doc),
        compiled.degrees_of_freedom,
        leak(compiled.parameters.iter().map(|parameter| quantity(&parameter.quantity, parameter.value))),
        leak(compiled.inputs.iter().map(|input| quantity(&input.quantity, input.value))),
        leak(
            (compiled.coordinates.iter().enumerate())
                .map(|(at, it)| quantity(it, compiled.declared_start(at))),
        ),
        compiled.line_count,
        leak(compiled.outputs.iter().map(|output| quantity(output, 0.0))),
        leak(compiled.events.iter().map(event)),
        leak(compiled.constraints.iter().map(constraint)),
        leak(compiled.states.iter().copied()),
        leak(compiled.redundant.iter().copied()),
        leak(compiled.velocity_forces.iter().copied()),
        compiled.kept.each_ref().map(|kept| leak(kept.iter().copied())),
        leak(compiled.pivots.iter().map(pivot)),
        leak(compiled.start_pivots.iter().map(pivot)),
        sampling(&compiled.sampling),
        leak(compiled.stops.iter().map(stop)),
        leak(compiled.frictions.iter().map(friction)),
        modes(compiled),
        leak(compiled.counts().into_iter().map(|count| function(compiled, &count))),
    )
}

fn modes(compiled: &Compiled) -> Modes {
    let mode = |it: &compiled::Mode| DeclaredMode { name: text(&it.name), memory: it.memory };
    let lock = |it: &compiled::Lock| {
        let (name, formula) = (text(&it.name), text(&it.formula));
        DeclaredLock { name, mode: it.mode, held: it.held, is_rate: it.is_rate, formula }
    };
    let transition = |it: &compiled::Transition| {
        let &compiled::Transition {
            text: ref condition,
            is_rising,
            is_strict,
            holds_near,
            sees_forces,
            memory,
        } = it;
        let condition = text(condition);
        DeclaredTransition { condition, is_rising, is_strict, holds_near, sees_forces, memory }
    };
    Modes {
        modes: leak(compiled.modes.iter().map(mode)),
        locks: leak(compiled.locks.iter().map(lock)),
        transitions: leak(compiled.transitions.iter().map(transition)),
    }
}

fn sampling(compiled::Sampling { memories, clocks, samples }: &compiled::Sampling) -> Sampling {
    Sampling { memories: *memories, clocks: *clocks, samples: leak(samples.iter().copied()) }
}

fn knots(compiled::Knots { at, period, jumps }: &compiled::Knots) -> Knots {
    Knots { at: leak(at.iter().copied()), period: period.unwrap_or_default(), jumps: *jumps }
}

fn quantity(quantity: &compiled::Quantity, default: f64) -> Quantity {
    let compiled::Quantity { name, doc, unit, scale, dimension: of } = quantity;
    let dimension = dimension(*of);
    Quantity { name: text(name), doc: text(doc), unit: text(unit), scale: *scale, dimension, default }
}

fn stop(stop: &compiled::Stop) -> DeclaredStop {
    let compiled::Quantity { name, doc, unit, dimension: of, .. } = &stop.quantity;
    let (name, doc, unit) = (text(name), text(doc), text(unit));
    DeclaredStop {
        name,
        doc,
        unit,
        dimension: dimension(*of),
        memory: stop.memory,
        force: stop.force,
        formula: text(&stop.formula),
    }
}

fn friction(compiled::Friction { name, memory, limits, stop, .. }: &compiled::Friction) -> DeclaredFriction {
    let limits = limits.each_ref().map(|limit| text(limit));
    DeclaredFriction { name: text(name), memory: *memory, limits, stop: *stop }
}

fn event(event: &compiled::Event) -> DeclaredEvent {
    let compiled::Quantity { name, doc, dimension: of, .. } = &event.quantity;
    let direction = match event.crossing {
        Crossing::Rising => Direction::Rising,
        Crossing::Falling => Direction::Falling,
        Crossing::Either => Direction::Either,
    };
    DeclaredEvent { name: text(name), doc: text(doc), dimension: dimension(*of), direction }
}

/// Fractional exponents, which only outputs can have, are given as 0, as `mechanism!` does.
fn dimension(dimension: units::Dimension) -> Dimension {
    Dimension::from_exponents(dimension.exponents().unwrap_or_default())
}

fn constraint(constraint: &compiled::Constraint) -> Constraint {
    Constraint {
        name: text(&constraint.name),
        doc: text(&constraint.doc),
        formula: text(&constraint.formula),
        is_drive: constraint.is_drive,
        is_rate: constraint.is_rate,
        dimension: dimension(constraint.dimension),
    }
}

fn pivot(pivot: &compiled::Pivot) -> Pivot {
    Pivot { constraint: text(&pivot.constraint), coordinate: text(&pivot.coordinate) }
}

fn function(compiled: &Compiled, count: &Count) -> Function {
    let mbs_symbolic::Operations { mul, add, div, sin_cos, other } = count.operations;
    let blocks = compiled.blocks(compiled.program(count.function));
    Function {
        name: count.function.name(),
        operations: Operations { mul, add, div, sin_cos, other, watch: count.watch },
        written: blocks.iter().map(|block| block.written() as u32).sum(),
        loops: blocks.iter().filter(|block| matches!(block, Block::Repeated(_))).count() as u32,
    }
}

fn spline(spline: &mbs_symbolic::Spline) -> Spline {
    let segment =
        |segment: &mbs_symbolic::Segment| Segment { from: segment.from, coefficients: segment.coefficients };
    let segments = leak(spline.segments.iter().map(segment));
    Spline { origin: spline.origin, period: spline.period, segments }
}
