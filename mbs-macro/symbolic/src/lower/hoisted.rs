//! Values that are computed once, when a mechanism is made.

use rustc_hash::FxHashMap as HashMap;

use crate::arena::Expr;

/// Values that depend on parameters alone, shared by the programs of a
/// mechanism.
#[derive(Default)]
pub struct Hoisted {
    values: Vec<Expr>,
    index: HashMap<Expr, usize>,
}

impl Hoisted {
    /// The position of a value, which is added if it is new.
    pub(super) fn position(&mut self, expr: Expr) -> usize {
        *self.index.entry(expr).or_insert_with(|| {
            self.values.push(expr);
            self.values.len() - 1
        })
    }

    /// The hoisted values in the order of their positions.
    pub fn values(&self) -> &[Expr] {
        &self.values
    }
}
