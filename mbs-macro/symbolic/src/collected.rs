//! Coefficients or exponents, collected expression by expression.

use crate::arena::Expr;

/// A map in the order of handles. Rows are short, so that a sorted vector is quicker
/// than a tree.
pub(crate) struct Collected<T>(Vec<(Expr, T)>);

impl<T: Copy> Collected<T> {
    pub fn with_capacity(capacity: usize) -> Self {
        Self(Vec::with_capacity(capacity))
    }

    pub fn get(&self, expr: Expr) -> Option<T> {
        self.position(expr).ok().map(|at| self.0[at].1)
    }

    /// The value of an expression, after `first` was put there if it had none.
    pub fn entry(&mut self, expr: Expr, first: T) -> &mut T {
        let at = self.position(expr).unwrap_or_else(|at| {
            self.0.insert(at, (expr, first));
            at
        });
        &mut self.0[at].1
    }

    pub fn insert(&mut self, expr: Expr, value: T) {
        *self.entry(expr, value) = value;
    }

    pub fn remove(&mut self, expr: Expr) {
        if let Ok(at) = self.position(expr) {
            self.0.remove(at);
        }
    }

    pub fn iter(&self) -> impl Iterator<Item = (Expr, T)> + '_ {
        self.0.iter().copied()
    }

    pub fn retain(&mut self, mut is_kept: impl FnMut(T) -> bool) {
        self.0.retain(|&(_, value)| is_kept(value));
    }

    pub fn into_vec(self) -> Vec<(Expr, T)> {
        self.0
    }

    fn position(&self, expr: Expr) -> Result<usize, usize> {
        self.0.binary_search_by_key(&expr, |&(key, _)| key)
    }
}
