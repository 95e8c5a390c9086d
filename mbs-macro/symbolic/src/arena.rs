//! Hash-consed expressions: equal expressions are the same node.
//!
//! # Why values are shared
//!
//! `Node::Shared` marks a value that is computed once. Sums and products are not opened across it. So the
//! elimination of a chain stays linear in its length. The entries of a small system stay open to algebra:
//! sin² + cos² = 1 turns a reduced mass into a constant.
//!
//! # Files beside it
//!
//! * `construct.rs` has the constructors, which keep sums, products and calls canonical. Each rule states
//!   its condition there.
//! * `differentiate.rs` takes derivatives, `substitute.rs` puts expressions in the place of symbols.
//! * `exact` decides whether an expression vanishes.

use std::rc::Rc;

use indexmap::IndexSet;
use rustc_hash::{FxBuildHasher, FxHashMap as HashMap};

use crate::exact::Point;
use crate::number::Number;
use crate::operators::Function;
use crate::spline::{Spline, SplineId};

/// An expression: a handle into an [`Arena`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Expr(pub(crate) u32);

impl Expr {
    /// Its position in the list of nodes.
    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

/// A symbol: a handle into an [`Arena`]'s list of symbols.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Symbol(pub(crate) u32);

impl Symbol {
    /// Its position in the list of symbols.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// When the value of a symbol or an expression is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Stage {
    /// At compile time.
    Constant,
    /// When the parameters are.
    Parameter,
    /// In every evaluation anew.
    Variable,
}

/// The canonical form of an expression.
///
/// A coefficient lives in a sum only: −3x is a sum of one term. Terms and
/// factors are in the order of their handles, without repetition, and no sum
/// stands directly in a sum, no product in a product: [`Node::Shared`] marks a
/// value that is to be computed once, and stops that flattening.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// A constant.
    Number(Number),
    /// A symbol.
    Symbol(Symbol),
    /// constant + Σ coefficient·term
    Sum(Number, Vec<(Expr, Number)>),
    /// Π factor^exponent, exponents not 0
    Product(Vec<(Expr, i32)>),
    /// f(x, y), or f(x) with x twice
    Call(Function, [Expr; 2]),
    /// The derivative of this order of a spline, 0 to 3, at x
    Spline(SplineId, u8, Expr),
    /// The same value, computed once.
    Shared(Expr),
}

struct SymbolEntry {
    name: String,
    stage: Stage,
}

/// Holds expressions, each once.
pub struct Arena {
    /// In the order of their handles.
    nodes: IndexSet<Node, FxBuildHasher>,
    stages: Vec<Stage>,
    symbols: Vec<SymbolEntry>,
    labels: HashMap<Expr, String>,
    /// The bounds of values at any position. They are kept, so that a part in several places is
    /// looked at once.
    pub(crate) bounds: HashMap<Expr, Option<Expr>>,
    /// True if values are never negative at any position; likewise.
    pub(crate) never_negative: HashMap<Expr, bool>,
    /// The exact values of expressions at a random point.
    point: Point,
    pub(crate) splines: Vec<Rc<Spline>>,
}

impl Default for Arena {
    fn default() -> Self {
        Self::new()
    }
}

impl Arena {
    /// An empty arena.
    pub fn new() -> Self {
        let mut arena = Self {
            nodes: IndexSet::default(),
            stages: Vec::new(),
            symbols: Vec::new(),
            labels: HashMap::default(),
            bounds: HashMap::default(),
            never_negative: HashMap::default(),
            point: Point::default(),
            splines: Vec::new(),
        };
        // `zero` and `one` rely on these two being the first.
        arena.number(Number::ZERO);
        arena.number(Number::ONE);
        arena
    }

    /// A new symbol, different from all others even of the same name.
    pub fn symbol(&mut self, name: &str, stage: Stage) -> Symbol {
        let symbol = Symbol(self.symbols.len() as u32);
        self.symbols.push(SymbolEntry { name: name.to_owned(), stage });
        symbol
    }

    /// The expression that is just this symbol.
    pub fn variable(&mut self, symbol: Symbol) -> Expr {
        self.intern(Node::Symbol(symbol))
    }

    /// The name of a symbol.
    pub fn name(&self, symbol: Symbol) -> &str {
        &self.symbols[symbol.index()].name
    }

    /// The symbol with this index, if there is one.
    pub fn symbol_at(&self, index: usize) -> Option<Symbol> {
        (index < self.symbols.len()).then_some(Symbol(index as u32))
    }

    /// The number of symbols.
    pub fn symbol_count(&self) -> usize {
        self.symbols.len()
    }

    /// Adds a spline.
    pub fn add_spline(&mut self, spline: Spline) -> SplineId {
        self.splines.push(Rc::new(spline));
        SplineId((self.splines.len() - 1) as u32)
    }

    /// The splines, by their index.
    pub fn splines(&self) -> &[Rc<Spline>] {
        &self.splines
    }

    /// A constant.
    pub fn number(&mut self, value: Number) -> Expr {
        self.intern(Node::Number(value))
    }

    /// 0
    pub fn zero(&self) -> Expr {
        Expr(0)
    }

    /// 1
    pub fn one(&self) -> Expr {
        Expr(1)
    }

    /// The canonical form of an expression.
    pub fn node(&self, expr: Expr) -> &Node {
        &self.nodes[expr.0 as usize]
    }

    /// When its value is known.
    pub fn stage(&self, expr: Expr) -> Stage {
        self.stages[expr.0 as usize]
    }

    /// Its value if it is a constant.
    pub fn as_number(&self, expr: Expr) -> Option<Number> {
        match self.node(expr) {
            Node::Number(value) => Some(*value),
            _ => None,
        }
    }

    /// True if it is the constant 0.
    pub fn is_zero(&self, expr: Expr) -> bool {
        self.as_number(expr).is_some_and(Number::is_zero)
    }

    /// Reports whether an expression is 0 wherever it has a value, in whatever form it is written.
    pub fn vanishes(&mut self, expr: Expr) -> bool {
        let mut point = std::mem::take(&mut self.point);
        let vanishes = point.is_zero(self, expr);
        self.point = point;
        vanishes
    }

    /// Reports whether an expression, written out, has more than `most` nodes. A value that is computed once counts as
    /// one node.
    pub fn is_larger_than(&self, expr: Expr, most: usize) -> bool {
        let (mut count, mut open) = (0, vec![expr]);
        while let Some(expr) = open.pop() {
            count += 1;
            if count > most {
                return true;
            }
            if !matches!(self.node(expr), Node::Shared(_)) {
                self.for_each_operand(expr, |operand| open.push(operand));
            }
        }
        false
    }

    /// The expression marked as one value to be computed once: sums and
    /// products around it do not take it apart. Signs stay outside.
    pub fn share(&mut self, expr: Expr) -> Expr {
        match self.node(expr) {
            Node::Sum(constant, terms) => match terms[..] {
                [(term, coefficient)] if constant.is_zero() && coefficient == Number::MINUS_ONE => {
                    let shared = self.share(term);
                    self.neg(shared)
                }
                _ => self.intern(Node::Shared(expr)),
            },
            Node::Product(_) => self.intern(Node::Shared(expr)),
            _ => expr,
        }
    }

    /// Suggests a name for a value in generated code; the first one stays.
    pub fn label(&mut self, expr: Expr, name: &str) {
        self.labels.entry(expr).or_insert_with(|| name.to_owned());
    }

    /// The suggested name.
    pub fn label_of(&self, expr: Expr) -> Option<&str> {
        self.labels.get(&expr).map(String::as_str)
    }

    /// The node's one handle. Only canonical nodes may come here.
    pub(crate) fn intern(&mut self, node: Node) -> Expr {
        let (at, is_new) = self.nodes.insert_full(node);
        if is_new {
            self.stages.push(self.stage_of(&self.nodes[at]));
        }
        Expr(at as u32)
    }

    fn stage_of(&self, node: &Node) -> Stage {
        let latest = |stages: &mut dyn Iterator<Item = Stage>| stages.max().unwrap_or(Stage::Constant);
        match node {
            Node::Number(_) => Stage::Constant,
            Node::Symbol(symbol) => self.symbols[symbol.index()].stage,
            Node::Sum(_, terms) => latest(&mut terms.iter().map(|(term, _)| self.stage(*term))),
            Node::Product(factors) => latest(&mut factors.iter().map(|(factor, _)| self.stage(*factor))),
            Node::Call(_, [x, y]) => self.stage(*x).max(self.stage(*y)),
            Node::Spline(.., x) | Node::Shared(x) => self.stage(*x),
        }
    }

    /// The operands of an expression.
    pub fn operands(&self, expr: Expr) -> Vec<Expr> {
        let mut operands = Vec::new();
        self.for_each_operand(expr, |operand| operands.push(operand));
        operands
    }

    pub(crate) fn for_each_operand(&self, expr: Expr, mut each: impl FnMut(Expr)) {
        match self.node(expr) {
            Node::Number(_) | Node::Symbol(_) => {}
            Node::Sum(_, terms) => terms.iter().for_each(|(term, _)| each(*term)),
            Node::Product(factors) => factors.iter().for_each(|(factor, _)| each(*factor)),
            Node::Call(function, both) => function.arguments(both).iter().for_each(|x| each(*x)),
            Node::Spline(.., x) | Node::Shared(x) => each(*x),
        }
    }

    /// Every expression that `roots` are made of, operands before users.
    pub fn reachable(&self, roots: &[Expr]) -> Vec<Expr> {
        let mut order = Vec::new();
        // a bit each: operands have smaller indices than their users
        let last = roots.iter().map(|root| root.index()).max().unwrap_or(0);
        let mut seen = vec![0_u64; last / 64 + 1];
        let mut is_new = |expr: Expr| {
            let (word, bit) = (&mut seen[expr.index() / 64], 1 << (expr.index() % 64));
            let is_new = *word & bit == 0;
            *word |= bit;
            is_new
        };
        let mut stack: Vec<(Expr, bool)> = roots.iter().rev().map(|&root| (root, false)).collect();
        while let Some((expr, operands_done)) = stack.pop() {
            if operands_done {
                order.push(expr);
            } else if is_new(expr) {
                stack.push((expr, true));
                let first = stack.len();
                self.for_each_operand(expr, |operand| stack.push((operand, false)));
                stack[first..].reverse();
            }
        }
        order
    }

    /// The symbols that an expression depends on, in order.
    pub fn symbols_in(&self, expr: Expr) -> Vec<Symbol> {
        let symbol = |&e: &Expr| match self.node(e) {
            Node::Symbol(symbol) => Some(*symbol),
            _ => None,
        };
        let mut symbols: Vec<_> = self.reachable(&[expr]).iter().filter_map(symbol).collect();
        symbols.sort_unstable();
        symbols
    }
}
