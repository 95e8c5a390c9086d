//! Times at which forces, constraints or events bend or jump: points of tables of time, `if t < 1 [s]`, `step(t - 1 [s])`.
//!
//! A run to a tolerance ends a step there. Steps that grow while nothing happens would go over a short pulse. Values of
//! the motion that pass such a place are switches: a run looks at them between its steps.

use mbs_symbolic::{Arena, Expr, Function, Node, Pieces, Stage};
use rustc_hash::FxHashMap as HashMap;

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
}

/// A value a t + b that has its knots where time passes them.
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
    let roots: Vec<Expr> = declared.chain(equations.total_forces.iter().copied()).chain(events).collect();
    let time = model.arena.variable(model.time);
    let of_time = OfTime::new(&model.arena, &roots, time);
    let is_known = |symbol| !matches!(inputs.of(symbol), Some(Input::Multiplier(_) | Input::Acceleration(_)));
    let (mut corners, mut switches) = (Vec::new(), Vec::new());
    for (node, is_of_time) in of_time.pieces(&model.arena) {
        let found = knots(&mut model.arena, node, is_of_time);
        let Some((argument, knots)) = found.filter(|(_, knots)| !knots.at.is_empty()) else {
            continue;
        };
        let pieces = if is_of_time { alternatives(&mut model.arena, argument, time) } else { vec![argument] };
        for piece in pieces {
            let line = affine(&mut model.arena, piece, model.time, time).filter(|_| is_of_time);
            if let Some([rate, offset]) = line {
                push(&mut corners, Corner { rate, offset, knots: knots.clone() });
            } else if switches.len() < MOST && model.arena.symbols_in(argument).into_iter().all(is_known) {
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
    let zero = || Knots { at: vec![0.0], period: None };
    match *arena.node(node) {
        Node::Spline(spline, _, argument) => {
            let spline = arena.splines().get(spline.index())?;
            let at = if is_of_time { spline.points() } else { spline.knots() };
            Some((argument, Knots { at, period: spline.period }))
        }
        Node::Call(function, [x, y]) if function.row().arity == 2 => Some((arena.sub(x, y), zero())),
        Node::Call(_, [x, _]) => Some((x, zero())),
        _ => None,
    }
}

/// Of expressions, whether they depend on time, and on no other variable.
struct OfTime(Vec<Expr>, HashMap<Expr, [bool; 2]>);

impl OfTime {
    fn new(arena: &Arena, roots: &[Expr], time: Expr) -> Self {
        let all = arena.reachable(roots);
        let mut depends: HashMap<Expr, [bool; 2]> = HashMap::default();
        for &node in &all {
            let own = match arena.node(node) {
                Node::Symbol(_) if node == time => [true, false],
                Node::Symbol(_) => [false, arena.stage(node) == Stage::Variable],
                _ => arena
                    .operands(node)
                    .iter()
                    .filter_map(|operand| depends.get(operand))
                    .fold([false; 2], |[of_time, of_others], [time, others]| {
                        [of_time | time, of_others | others]
                    }),
            };
            depends.insert(node, own);
        }
        Self(all, depends)
    }

    /// The nodes that have pieces and vary, each with whether it depends on time alone.
    fn pieces(&self, arena: &Arena) -> Vec<(Expr, bool)> {
        let varies = |node: Expr| match self.1.get(&node)? {
            [false, false] => None,
            [is_of_time, is_of_others] => Some((node, *is_of_time && !is_of_others)),
        };
        self.0.iter().copied().filter(|node| has_pieces(arena, *node)).filter_map(varies).collect()
    }
}

fn has_pieces(arena: &Arena, node: Expr) -> bool {
    match arena.node(node) {
        Node::Call(function, _) => !matches!(function.row().pieces, Pieces::One | Pieces::Gate),
        Node::Spline(..) => true,
        _ => false,
    }
}

/// An expression with each piece of what it is made of: x and y of max(x, y).
fn alternatives(arena: &mut Arena, expr: Expr, time: Expr) -> Vec<Expr> {
    let (mut open, mut found) = (vec![expr], Vec::new());
    while let Some(next) = open.pop() {
        let piece =
            OfTime::new(arena, &[next], time).0.into_iter().find_map(|node| match *arena.node(node) {
                Node::Call(function @ (Function::Min | Function::Max), [x, y]) => {
                    Some((node, function, [x, y]))
                }
                Node::Call(function @ (Function::Abs | Function::Gate), [x, y]) => {
                    Some((node, function, [x, y]))
                }
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

/// a and b of an expression a t + b, if it is one whose a is not 0.
fn affine(arena: &mut Arena, expr: Expr, symbol: mbs_symbolic::Symbol, time: Expr) -> Option<[Expr; 2]> {
    let rate = arena.partial(expr, symbol);
    let zero = arena.zero();
    let offset = arena.substitute(expr, &HashMap::from_iter([(symbol, zero)]));
    let is_known = |expr: Expr| arena.stage(expr) != Stage::Variable;
    let of_time = OfTime::new(arena, &[expr], time);
    (is_known(rate) && is_known(offset) && !arena.is_zero(rate) && of_time.pieces(arena).is_empty())
        .then_some([rate, offset])
}
