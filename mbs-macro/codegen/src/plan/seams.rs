//! Steps that only bend what they choose: `if x > 0 { k*x } else { 0 }`, or the push of a contact, which is 0 where it begins.

use mbs_symbolic::{Arena, Expr, Function, Node, Pieces};
use rustc_hash::FxHashMap as HashMap;

/// The users of every part of some expressions.
pub struct Uses(HashMap<Expr, Vec<Expr>>);

impl Uses {
    pub fn new(arena: &Arena, roots: &[Expr]) -> Self {
        let mut uses: HashMap<Expr, Vec<Expr>> = HashMap::default();
        for node in arena.reachable(roots) {
            for operand in arena.operands(node) {
                uses.entry(operand).or_default().push(node);
            }
        }
        Self(uses)
    }

    /// True if a step in a value does nothing but let values through that are 0 where that value is.
    pub fn only_bend(&self, arena: &Arena, step: Expr, value: Expr) -> bool {
        let Some(uses) = self.0.get(&step) else { return false };
        uses.iter().all(|&user| match *arena.node(user) {
            Node::Shared(_) => self.only_bend(arena, user, value),
            Node::Call(Function::Gate, [gate, let_through]) => {
                gate == step
                    && let_through != step
                    && vanishes(arena, let_through, value, &mut HashMap::default())
            }
            _ => false,
        })
    }
}

/// True if it follows from its form that an expression is 0 where `value` is.
fn vanishes(arena: &Arena, expr: Expr, value: Expr, known: &mut HashMap<Expr, bool>) -> bool {
    if expr == value || arena.is_zero(expr) {
        return true;
    }
    if let Some(&known) = known.get(&expr) {
        return known;
    }
    let mut vanish = |expr: &Expr| vanishes(arena, *expr, value, known);
    let is_zero = match arena.node(expr) {
        Node::Sum(constant, terms) => constant.is_zero() && terms.iter().all(|(term, _)| vanish(term)),
        Node::Product(factors) => {
            let (above, below): (Vec<_>, Vec<_>) = factors.iter().partition(|(_, exponent)| *exponent > 0);
            above.iter().any(|(factor, _)| vanish(factor)) && !below.iter().any(|(factor, _)| vanish(factor))
        }
        Node::Call(Function::Gate, [_, let_through]) => vanish(let_through),
        Node::Call(function, [x, y]) => {
            let row = function.row();
            match (row.pieces, function) {
                (Pieces::Kinked, _) => vanish(x) && vanish(y),
                (_, Function::Sqrt) => vanish(x),
                _ => false,
            }
        }
        Node::Shared(x) => vanish(x),
        Node::Number(_) | Node::Symbol(_) | Node::Spline(..) => false,
    };
    known.insert(expr, is_zero);
    is_zero
}
