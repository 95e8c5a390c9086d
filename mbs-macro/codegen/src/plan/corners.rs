//! Times at which forces, constraints or events bend or jump: points of tables of time, `if t < 1 [s]`, `step(t - 1 [s])`.
//!
//! A run to a tolerance ends a step there. Steps that grow while nothing happens would go over a short pulse. Values of
//! the motion that pass such a place are switches: a run looks at them between its steps.
//!
//! A delay that is an input or a memory is known as a parameter is, until it is set again. Since inputs may vary during
//! a step, what is delayed by one is a switch as well.

use mbs_symbolic::{Arena, Expr, Function, Node, Pieces, Stage, Symbol};
use rustc_hash::FxHashMap as HashMap;

use super::seams::Uses;
use crate::derive::Equations;
use crate::inputs::{Input, Inputs};
use crate::model::Model;

/// A run looks for so many values at each step. What is beyond is left to the control of the error.
const MOST: usize = 64;
/// `clamp(t, a, b)` has a piece within a piece; so many of one value are looked at.
const MOST_PIECES: usize = 16;

/// The arguments at which a function bends or jumps, over and over after a period if it has one.
#[derive(Clone, Debug, PartialEq)]
pub struct Knots {
    /// In ascending order.
    pub at: Vec<f64>,
    /// The period.
    pub period: Option<f64>,
    /// True unless it is known that the function only bends there.
    pub jumps: bool,
}

/// A value a t + b that has its knots where time passes them; a and b depend on parameters and inputs.
#[derive(Clone, PartialEq)]
pub struct Corner {
    pub rate: Expr,
    pub offset: Expr,
    pub knots: Knots,
}

/// A value that depends on the motion, too.
#[derive(Clone, PartialEq)]
pub struct Switch {
    pub value: Expr,
    pub knots: Knots,
}

/// The corners and switches of all that a run computes.
pub fn corners(model: &mut Model, equations: &Equations, inputs: &Inputs) -> (Vec<Corner>, Vec<Switch>) {
    let declared = model.constraints.iter().map(|constraint| constraint.declared());
    let events = model.events.iter().map(|event| event.value);
    let gaps = model.contacts().map(|contact| contact.gap);
    let forces = equations.total_forces.iter().copied();
    let roots: Vec<Expr> = declared.chain(forces).chain(events).chain(gaps).collect();
    let first_memory = model.inputs.len().saturating_sub(model.memories);
    let looked_at = Looked { inputs, time: model.time, first_memory };
    let depends = looked_at.depends(&model.arena, &roots);
    let uses = Uses::new(&model.arena, &roots);
    let (mut corners, mut switches) = (Vec::new(), Vec::new());
    for (node, on) in pieces(&model.arena, &roots, &depends) {
        let is_of_time = on.time && !on.motion;
        let found = knots(&mut model.arena, node, is_of_time);
        let Some((argument, mut knots)) = found.filter(|(_, knots)| !knots.at.is_empty()) else {
            continue;
        };
        knots.jumps &= !uses.only_bend(&model.arena, node, argument);
        let alternatives = if is_of_time { alternatives(&mut model.arena, argument) } else { vec![argument] };
        for piece in alternatives {
            let line = looked_at.affine(&mut model.arena, piece).filter(|_| is_of_time);
            if let Some([rate, offset]) = line {
                push(&mut corners, Corner { rate, offset, knots: knots.clone() });
            }
            if (line.is_none() || on.inputs) && looked_at.is_known(&model.arena, argument) {
                push(&mut switches, Switch { value: argument, knots: knots.clone() });
            }
        }
    }
    (corners, switches)
}

fn push<T: PartialEq>(all: &mut Vec<T>, new: T) {
    if all.len() < MOST && !all.contains(&new) {
        all.push(new);
    }
}

/// The argument of a function of pieces, and where these bend or jump. Of time they are all points of a table: a step
/// over the points of a smooth one may step over what is between them.
fn knots(arena: &mut Arena, node: Expr, is_of_time: bool) -> Option<(Expr, Knots)> {
    let zero = |function: Function| {
        let jumps = function.row().pieces != Pieces::Kinked;
        Knots { at: vec![0.0], period: None, jumps }
    };
    match *arena.node(node) {
        Node::Spline(spline, order, argument) => {
            let spline = arena.splines().get(spline.index())?;
            let at = if is_of_time { spline.points() } else { spline.knots() };
            let jumps = order > 0 || spline.has_jumps();
            Some((argument, Knots { at, period: spline.period, jumps }))
        }
        Node::Call(function, [x, y]) if function.row().arity == 2 => Some((arena.sub(x, y), zero(function))),
        Node::Call(function, [x, _]) => Some((x, zero(function))),
        _ => None,
    }
}

/// The variables on which an expression depends.
#[derive(Clone, Copy, Default)]
struct Depends {
    time: bool,
    /// Inputs, which may vary during a step.
    inputs: bool,
    /// Memories, which do not.
    memories: bool,
    /// Anything else: what a run computes.
    motion: bool,
}

impl Depends {
    fn or(self, other: Self) -> Self {
        Self {
            time: self.time | other.time,
            inputs: self.inputs | other.inputs,
            memories: self.memories | other.memories,
            motion: self.motion | other.motion,
        }
    }
}

/// The meanings of variables, as steps see them.
struct Looked<'a> {
    inputs: &'a Inputs,
    time: Symbol,
    first_memory: usize,
}

impl Looked<'_> {
    /// The variables on which expressions depend.
    fn depends(&self, arena: &Arena, roots: &[Expr]) -> HashMap<Expr, Depends> {
        let mut depends: HashMap<Expr, Depends> = HashMap::default();
        for node in arena.reachable(roots) {
            let on = match *arena.node(node) {
                Node::Symbol(symbol) => self.symbol(symbol, arena.stage(node)),
                _ => arena
                    .operands(node)
                    .iter()
                    .filter_map(|operand| depends.get(operand))
                    .fold(Depends::default(), |all, on| all.or(*on)),
            };
            depends.insert(node, on);
        }
        depends
    }

    fn symbol(&self, symbol: Symbol, stage: Stage) -> Depends {
        let none = Depends::default();
        match self.inputs.of(symbol) {
            Some(Input::Time) => Depends { time: true, ..none },
            Some(Input::Input(index)) if index < self.first_memory => Depends { inputs: true, ..none },
            Some(Input::Input(_)) => Depends { memories: true, ..none },
            _ => Depends { motion: stage == Stage::Variable, ..none },
        }
    }

    /// True if a value is one between steps: λ and q̈ are not.
    fn is_known(&self, arena: &Arena, expr: Expr) -> bool {
        let is_known =
            |symbol| !matches!(self.inputs.of(symbol), Some(Input::Multiplier(_) | Input::Acceleration(_)));
        arena.symbols_in(expr).into_iter().all(is_known)
    }

    /// a and b of an expression a t + b, if it is one whose a is not 0.
    fn affine(&self, arena: &mut Arena, expr: Expr) -> Option<[Expr; 2]> {
        let rate = arena.partial(expr, self.time);
        let zero = arena.zero();
        let offset = arena.substitute(expr, &HashMap::from_iter([(self.time, zero)]));
        let depends = self.depends(arena, &[expr, rate, offset]);
        let is_held = |expr| depends.get(&expr).is_some_and(|on| !on.time && !on.motion);
        let is_line = pieces(arena, &[expr], &depends).iter().all(|(_, on)| !on.time);
        (is_held(rate) && is_held(offset) && !arena.is_zero(rate) && is_line).then_some([rate, offset])
    }
}

/// The functions of pieces that vary.
fn pieces(arena: &Arena, roots: &[Expr], depends: &HashMap<Expr, Depends>) -> Vec<(Expr, Depends)> {
    let varies = |node| {
        let on = *depends.get(&node)?;
        (on.time || on.inputs || on.memories || on.motion).then_some((node, on))
    };
    arena.reachable(roots).into_iter().filter(|node| has_pieces(arena, *node)).filter_map(varies).collect()
}

fn has_pieces(arena: &Arena, node: Expr) -> bool {
    match arena.node(node) {
        Node::Call(function, _) => matches!(function.row().pieces, Pieces::Kinked | Pieces::Steps),
        Node::Spline(..) => true,
        _ => false,
    }
}

/// An expression with each piece of what it is made of: x and y of max(x, y).
fn alternatives(arena: &mut Arena, expr: Expr) -> Vec<Expr> {
    let (mut open, mut found) = (vec![expr], Vec::new());
    while let Some(next) = open.pop() {
        let piece = arena.reachable(&[next]).into_iter().find_map(|node| match *arena.node(node) {
            Node::Call(
                function @ (Function::Min | Function::Max | Function::Abs | Function::Gate),
                [x, y],
            ) => Some((node, function, [x, y])),
            _ => None,
        });
        let Some((node, function, [x, y])) = piece.filter(|_| open.len() + found.len() < MOST_PIECES) else {
            found.push(next);
            continue;
        };
        let others = match function {
            Function::Abs => [x, arena.neg(x)],
            Function::Gate => [y, arena.zero()],
            _ => [x, y],
        };
        open.extend(others.map(|other| arena.replace(next, node, other)));
    }
    found
}
