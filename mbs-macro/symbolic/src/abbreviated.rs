//! Formulas as text of bounded length.
//!
//! A part that stands in several places is written out in each of them, so that the text
//! of definitions that use each other grows exponentially with their number. A formula that
//! is too long in full is written with names for such parts.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::arena::{Arena, Expr, Node};

/// With names, formulas of at most this many different parts are written.
const MOST_PARTS: usize = 150;

/// Shorter parts get no names.
const SHORTEST_NAMED: usize = 4;

/// The names of parts.
pub(crate) type Names = FxHashMap<Expr, String>;

impl Arena {
    /// As [`display`](Self::display), but with names for the parts that occur more than
    /// once if the formula has more than `limit` parts, `s1*cos(s1) where s1 = x + y`; and `…`
    /// if that would be too long as well.
    pub fn display_within(&self, expr: Expr, limit: usize) -> String {
        if self.is_shorter(expr, limit) {
            return self.display(expr);
        }
        let Some((names, order)) = self.names_of_parts(expr) else { return "…".to_owned() };
        let definition = |part: &Expr| format!("{} = {}", names[part], self.display_with(*part, &names));
        let definitions: Vec<_> = order.iter().map(definition).collect();
        format!("{} where {}", self.display_with(expr, &names), definitions.join(", "))
    }

    /// The same as LaTeX, for math mode.
    pub fn latex_within(&self, expr: Expr, limit: usize) -> String {
        if self.is_shorter(expr, limit) {
            return self.latex(expr);
        }
        let Some((names, order)) = self.names_of_parts(expr) else { return r"\cdots".to_owned() };
        let in_latex: Names =
            names.iter().map(|(&part, name)| (part, crate::latex::symbol_name(name))).collect();
        let definition = |part: &Expr| format!("{} = {}", in_latex[part], self.latex_with(*part, &in_latex));
        let definitions: Vec<_> = order.iter().map(definition).collect();
        format!(r"{}, \quad {}", self.latex_with(expr, &in_latex), definitions.join(r", \quad "))
    }

    /// True if the expression has at most `limit` nodes as it would be written.
    /// A value that is computed once is written out wherever it is used, so the text of
    /// an eliminated matrix can be longer than any memory.
    pub fn is_shorter(&self, expr: Expr, limit: usize) -> bool {
        let mut open = vec![expr];
        let mut count = 0;
        // ends at the limit
        while let Some(expr) = open.pop() {
            count += 1;
            if count > limit {
                return false;
            }
            self.for_each_operand(expr, |operand| open.push(operand));
        }
        true
    }

    /// Names for the parts of an expression that occur more than once, and these parts,
    /// operands before users; `None` if it has too many parts.
    fn names_of_parts(&self, expr: Expr) -> Option<(Names, Vec<Expr>)> {
        let parts = self.parts(expr)?;
        let mut uses: FxHashMap<Expr, usize> = FxHashMap::default();
        for &part in &parts {
            self.for_each_operand(part, |operand| *uses.entry(operand).or_insert(0) += 1);
        }
        // a value computed once is used where its marks are
        for &part in parts.iter().rev() {
            if let Node::Shared(inner) = self.node(part) {
                *uses.entry(*inner).or_insert(0) += uses.get(&part).map_or(0, |uses| uses - 1);
            }
        }
        let is_named = |part: &&Expr| {
            let is_repeated = uses.get(*part).is_some_and(|uses| *uses > 1);
            let is_mark = matches!(self.node(**part), Node::Shared(_));
            is_repeated && !is_mark && !self.is_shorter(**part, SHORTEST_NAMED - 1)
        };
        let order: Vec<Expr> = parts.iter().filter(is_named).copied().collect();
        let symbols = self.symbols_in(expr);
        let is_free = |letter: &&str| {
            let is_number = |rest: &str| rest.bytes().all(|byte| byte.is_ascii_digit());
            !symbols.iter().any(|symbol| self.name(*symbol).strip_prefix(*letter).is_some_and(is_number))
        };
        let letter = ["s", "u", "w", "part", "common_part"].into_iter().find(is_free)?;
        let names = order.iter().enumerate().map(|(at, &part)| (part, format!("{letter}{}", at + 1)));
        Some((names.collect(), order))
    }

    /// The different nodes of an expression, operands before users; `None` if there are too
    /// many.
    fn parts(&self, expr: Expr) -> Option<Vec<Expr>> {
        let mut seen = FxHashSet::default();
        let mut open = vec![expr];
        // every node is opened once
        while let Some(part) = open.pop() {
            if seen.insert(part) {
                self.for_each_operand(part, |operand| open.push(operand));
            }
            if seen.len() > MOST_PARTS {
                return None;
            }
        }
        let mut parts: Vec<Expr> = seen.into_iter().collect();
        // operands have smaller handles than their users
        parts.sort_unstable();
        Some(parts)
    }
}

#[cfg(test)]
mod tests {
    use crate::arena::{Arena, Stage};
    use crate::operators::Function;

    #[test]
    fn what_occurs_more_than_once_has_a_name_in_a_long_formula() {
        let mut arena = Arena::new();
        let symbol = arena.symbol("x", Stage::Variable);
        let mut level = arena.variable(symbol);
        for _ in 0..3 {
            let (sine, cosine) = (arena.call(Function::Sin, level), arena.call(Function::Cos, level));
            let product = arena.mul(level, cosine);
            level = arena.add(product, sine);
        }
        assert_eq!(arena.display_within(level, 1000), arena.display(level));
        assert_eq!(
            arena.display_within(level, 10),
            "sin(s2) + s2*cos(s2) where s1 = sin(x) + x*cos(x), s2 = sin(s1) + s1*cos(s1)"
        );
        assert_eq!(
            arena.latex_within(level, 10),
            r"\sin s_{2} + s_{2} \, \cos s_{2}, \quad s_{1} = \sin x + x \, \cos x, \quad s_{2} = \sin s_{1} + s_{1} \, \cos s_{1}"
        );
    }
}
