//! Expressions as LaTeX.

use crate::abbreviated::Names;
use crate::arena::{Arena, Expr, Node};
use crate::number::Number;
use crate::operators::{Function, Latex, Row};

/// Greek letters that names may begin with, longer ones first.
const GREEK: &[&str] = &[
    "epsilon", "upsilon", "lambda", "omega", "alpha", "gamma", "delta", "theta", "kappa", "sigma", "beta",
    "zeta", "iota", "eta", "rho", "tau", "phi", "chi", "psi", "mu", "nu", "xi",
];

#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Binding {
    Sum,
    Product,
    Power,
}

impl Arena {
    /// The expression as LaTeX, `\frac{1}{2} l_{1} \cos \theta_{1}`, for math mode.
    pub fn latex(&self, expr: Expr) -> String {
        self.latex_with(expr, &Names::default())
    }

    /// The same with names for some parts of it.
    pub(crate) fn latex_with(&self, expr: Expr, names: &Names) -> String {
        self.typeset_whole(expr, Binding::Sum, names)
    }

    fn typeset(&self, expr: Expr, context: Binding, names: &Names) -> String {
        names.get(&expr).cloned().unwrap_or_else(|| self.typeset_whole(expr, context, names))
    }

    fn typeset_whole(&self, expr: Expr, context: Binding, names: &Names) -> String {
        let (text, binding) = match self.node(expr) {
            Node::Number(value) => (number(value.abs()), Binding::Power),
            Node::Symbol(symbol) => (symbol_name(self.name(*symbol)), Binding::Power),
            Node::Sum(constant, terms) => self.typeset_sum(*constant, terms, names),
            Node::Product(factors) => self.typeset_product(factors, names),
            Node::Call(function, both) => {
                return self.typeset_call(*function, function.arguments(both), names);
            }
            Node::Spline(spline, order, x) => {
                let primes = "'".repeat((*order).into());
                let name = symbol_name(&self.splines()[spline.index()].name);
                let argument = self.typeset(*x, Binding::Sum, names);
                return format!(r"{name}{primes}\left({argument}\right)");
            }
            Node::Shared(inner) => return self.typeset(*inner, context, names),
        };
        let (text, binding) = match self.as_number(expr) {
            Some(value) if value.is_negative() => (format!("-{text}"), Binding::Sum),
            _ => (text, binding),
        };
        if binding < context { format!(r"\left({text}\right)") } else { text }
    }

    fn typeset_sum(&self, constant: Number, terms: &[(Expr, Number)], names: &Names) -> (String, Binding) {
        let (negative, positive): (Vec<_>, Vec<_>) =
            terms.iter().copied().partition(|(_, coefficient)| coefficient.is_negative());
        let mut text = String::new();
        let mut push = |is_negative: bool, term: String| {
            text.push_str(match (is_negative, text.is_empty()) {
                (true, true) => "-",
                (true, false) => " - ",
                (false, true) => "",
                (false, false) => " + ",
            });
            text.push_str(&term);
        };
        for (term, coefficient) in positive.into_iter().chain(negative) {
            let factor = coefficient.abs();
            let term = self.typeset(term, Binding::Product, names);
            let term = if factor.is_one() { term } else { format!("{} {term}", number(factor)) };
            push(coefficient.is_negative(), term);
        }
        if !constant.is_zero() {
            push(constant.is_negative(), number(constant.abs()));
        }
        let is_one_term = terms.len() == 1 && constant.is_zero() && !text.starts_with('-');
        (text, if is_one_term { Binding::Product } else { Binding::Sum })
    }

    fn typeset_product(&self, factors: &[(Expr, i32)], names: &Names) -> (String, Binding) {
        let (above, below): (Vec<_>, Vec<_>) = factors.iter().copied().partition(|(_, e)| *e > 0);
        // inside a fraction the bar groups, except that a factor beside others does not
        let row = |factors: &[(Expr, i32)], inside_fraction: bool| {
            let context = if inside_fraction && factors.len() == 1 { Binding::Sum } else { Binding::Product };
            let factors = factors
                .iter()
                .map(|&(factor, exponent)| self.typeset_power(factor, exponent.abs(), context, names));
            factors.collect::<Vec<_>>().join(r" \, ")
        };
        if below.is_empty() {
            return (row(&above, false), Binding::Product);
        }
        let numerator = if above.is_empty() { "1".to_owned() } else { row(&above, true) };
        (format!(r"\frac{{{numerator}}}{{{}}}", row(&below, true)), Binding::Power)
    }

    fn typeset_power(&self, base: Expr, exponent: i32, context: Binding, names: &Names) -> String {
        match exponent {
            1 => {
                let is_sum = matches!(self.node(base), Node::Sum(..));
                let context = if is_sum && context == Binding::Product { Binding::Power } else { context };
                self.typeset(base, context, names)
            }
            // sin^2 θ, as it is read
            _ => match self.node(base) {
                Node::Call(function, [x, _]) if function.row().of_turn.is_some() => {
                    format!(r"\{}^{{{exponent}}} {}", function.row().name, self.argument(*x, names))
                }
                _ => format!("{}^{{{exponent}}}", self.typeset(base, Binding::Power, names)),
            },
        }
    }

    fn typeset_call(&self, function: Function, arguments: &[Expr], names: &Names) -> String {
        let Row { name, latex, .. } = function.row();
        match (latex, arguments) {
            (Latex::Around(before, behind), [x]) => {
                format!("{before}{}{behind}", self.typeset(*x, Binding::Sum, names))
            }
            (Latex::Operator(operator), [x]) => format!("{operator} {}", self.argument(*x, names)),
            (Latex::Bracket(sign), [x, y]) => {
                let [x, y] = [x, y].map(|side| self.typeset(*side, Binding::Sum, names));
                format!(r"\left[{x} {sign} {y}\right]")
            }
            (Latex::Product, [x, y]) => {
                let [x, y] = [x, y].map(|factor| self.typeset(*factor, Binding::Product, names));
                format!(r"{x} \, {y}")
            }
            _ => {
                let arguments: Vec<_> =
                    arguments.iter().map(|&x| self.typeset(x, Binding::Sum, names)).collect();
                format!(r"\operatorname{{{name}}}\left({}\right)", arguments.join(", "))
            }
        }
    }

    /// An argument, in parentheses unless it is a symbol.
    fn argument(&self, x: Expr, names: &Names) -> String {
        match self.node(x) {
            _ if names.contains_key(&x) => self.typeset(x, Binding::Sum, names),
            Node::Symbol(_) => self.typeset(x, Binding::Sum, names),
            _ => format!(r"\left({}\right)", self.typeset(x, Binding::Sum, names)),
        }
    }
}

fn number(value: Number) -> String {
    let text = value.to_string();
    match text.split_once('/') {
        Some((n, d)) => format!(r"\frac{{{n}}}{{{d}}}"),
        None => match text.split_once('e') {
            Some((digits, exponent)) => format!(r"{digits} \cdot 10^{{{exponent}}}"),
            None => text,
        },
    }
}

/// `theta1` as θ₁, `der(x)` as ẋ, `left_length` upright.
pub fn symbol_name(name: &str) -> String {
    if let Some(inner) = name.strip_prefix("der(").and_then(|rest| rest.strip_suffix(')')) {
        return match inner.strip_prefix("der(").and_then(|rest| rest.strip_suffix(')')) {
            Some(inner) => format!(r"\ddot{{{}}}", symbol_name(inner)),
            None => format!(r"\dot{{{}}}", symbol_name(inner)),
        };
    }
    if let Some(row) = name.strip_prefix("lambda(").and_then(|rest| rest.strip_suffix(')')) {
        return format!(r"\lambda_{{\mathrm{{{}}}}}", row.replace('_', r"\_"));
    }
    let (stem, index) = name.split_at(name.trim_end_matches(|c: char| c.is_ascii_digit()).len());
    let stem = stem.strip_suffix('_').filter(|stem| !stem.is_empty() && !index.is_empty()).unwrap_or(stem);
    let stem = match stem {
        letter if letter.chars().count() == 1 => letter.to_owned(),
        greek if GREEK.contains(&greek) => format!(r"\{greek}"),
        word => format!(r"\mathrm{{{}}}", word.replace('_', r"\_")),
    };
    if index.is_empty() { stem } else { format!("{stem}_{{{index}}}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arena::Stage;
    use crate::operators::Function;

    #[test]
    fn formulas_read_as_they_are_written_by_hand() {
        let mut arena = Arena::new();
        let [l, theta, x] = ["l1", "theta1", "x"].map(|name| arena.symbol(name, Stage::Variable));
        let [l, theta, x] = [l, theta, x].map(|symbol| arena.variable(symbol));
        let cosine = arena.call(Function::Cos, theta);
        let half = arena.number(Number::ratio(1, 2));
        let term = arena.product(&[(half, 1), (l, 1), (cosine, 1)]);
        let phi = arena.sub(x, term);
        assert_eq!(arena.latex(phi), r"x - \frac{1}{2} l_{1} \, \cos \theta_{1}");
        let sum = arena.add(x, l);
        let square = arena.powi(sum, -2);
        assert_eq!(arena.latex(square), r"\frac{1}{\left(l_{1} + x\right)^{2}}");
        let sine = arena.call(Function::Sin, sum);
        let squared = arena.powi(sine, 2);
        assert_eq!(arena.latex(squared), r"\sin^{2} \left(l_{1} + x\right)");
        let product = arena.mul(sum, cosine);
        assert_eq!(arena.latex(product).matches(r"\left(").count(), 1);
    }

    #[test]
    fn names_become_symbols() {
        assert_eq!(symbol_name("theta1"), r"\theta_{1}");
        assert_eq!(symbol_name("x_12"), "x_{12}");
        assert_eq!(symbol_name("der(phi2)"), r"\dot{\phi_{2}}");
        assert_eq!(symbol_name("left_length"), r"\mathrm{left\_length}");
        assert_eq!(symbol_name("lambda(pin_x)"), r"\lambda_{\mathrm{pin\_x}}");
    }
}
