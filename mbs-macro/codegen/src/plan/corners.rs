//! Times at which forces, constraints or events bend or jump: points of tables of time, `if t < 1 [s]`, `step(t - 1 [s])`.
//!
//! A run to a tolerance ends a step there. Steps that grow while nothing happens would go over a short pulse.

use mbs_symbolic::{Arena, Expr, Function, Node, Pieces, Stage};
use rustc_hash::FxHashMap as HashMap;

use crate::derive::Equations;
use crate::model::Model;

/// A run looks for so many values at each step. What is beyond is left to the control of the error.
const MOST: usize = 64;
/// `clamp(t, a, b)` has a piece within a piece; so many of one value are looked at.
const MOST_PIECES: usize = 16;

/// A value a t + b that has its knots at these arguments, over and over after a period.
#[derive(Clone, PartialEq)]
pub struct Corner {
    pub rate: Expr,
    pub offset: Expr,
    pub knots: Vec<f64>,
    pub period: Option<f64>,
}

/// The corners of all that a run computes.
pub fn corners(model: &mut Model, equations: &Equations) -> Vec<Corner> {
    let events = model.events.iter().map(|event| event.value);
    let roots: Vec<Expr> =
        equations.phi.iter().chain(&equations.total_forces).copied().chain(events).collect();
    let time = model.arena.variable(model.time);
    let of_time = OfTime::new(&model.arena, &roots, time);
    let mut corners = Vec::new();
    for node in of_time.pieces(&model.arena) {
        let (argument, knots, period) = match *model.arena.node(node) {
            Node::Spline(spline, _, argument) => {
                let Some(spline) = model.arena.splines().get(spline.index()) else { continue };
                (argument, spline.knots(), spline.period)
            }
            Node::Call(function, [x, y]) if function.row().arity == 2 => {
                (model.arena.sub(x, y), vec![0.0], None)
            }
            Node::Call(_, [x, _]) => (x, vec![0.0], None),
            _ => continue,
        };
        for argument in alternatives(&mut model.arena, argument, time) {
            let Some([rate, offset]) = affine(&mut model.arena, argument, model.time, time) else { continue };
            let corner = Corner { rate, offset, knots: knots.clone(), period };
            if corners.len() < MOST && !knots.is_empty() && !corners.contains(&corner) {
                corners.push(corner);
            }
        }
    }
    corners
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

    /// What has pieces and depends on time alone.
    fn pieces(&self, arena: &Arena) -> Vec<Expr> {
        let is_of_time = |node: &Expr| self.1.get(node) == Some(&[true, false]);
        self.0.iter().copied().filter(|node| is_of_time(node) && has_pieces(arena, *node)).collect()
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
