//! Expressions as text.

use std::fmt::Write;

use crate::arena::{Arena, Expr, Node};
use crate::number::Number;

/// How tightly an expression binds; a looser one needs parentheses inside a
/// tighter one.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Binding {
    Sum,
    Product,
    Power,
}

impl Arena {
    /// The expression in the notation of the language, `1/2*l1*cos(theta1)`.
    pub fn display(&self, expr: Expr) -> String {
        let mut text = String::new();
        self.write(&mut text, expr, Binding::Sum);
        text
    }

    /// Whether the expression has at most `limit` nodes as it would be written.
    /// What is computed once is written out wherever it is used, so the text of
    /// an eliminated matrix can be longer than any memory.
    pub fn is_shorter(&self, expr: Expr, limit: usize) -> bool {
        let mut open = vec![expr];
        let mut count = 0;
        while let Some(expr) = open.pop() {
            count += 1;
            if count > limit {
                return false;
            }
            match self.node(expr) {
                Node::Number(_) | Node::Symbol(_) => {}
                Node::Sum(_, terms) => open.extend(terms.iter().map(|(term, _)| *term)),
                Node::Product(factors) => open.extend(factors.iter().map(|(factor, _)| *factor)),
                Node::Call(_, x) | Node::Shared(x) | Node::Spline(_, _, x) => open.push(*x),
                Node::Call2(_, x, y) => open.extend([*x, *y]),
            }
        }
        true
    }

    fn write(&self, out: &mut String, expr: Expr, context: Binding) {
        let parenthesize = self.binding(expr) < context;
        if parenthesize {
            out.push('(');
        }
        match self.node(expr) {
            Node::Number(value) => put(out, value),
            Node::Symbol(symbol) => out.push_str(self.name(*symbol)),
            Node::Sum(constant, terms) => self.write_sum(out, *constant, terms),
            Node::Product(factors) => self.write_product(out, factors),
            Node::Call(function, x) => self.write_call(out, function.row().name, &[*x]),
            Node::Call2(function, x, y) => {
                let name = function.row().name;
                self.write_call(out, if name.is_empty() { "greater" } else { name }, &[*x, *y]);
            }
            Node::Spline(spline, order, x) => {
                let primes = "'".repeat((*order).into());
                let name = &self.splines()[spline.index()].name;
                self.write_call(out, &format!("{name}{primes}"), &[*x]);
            }
            Node::Shared(x) => self.write(out, *x, context),
        }
        if parenthesize {
            out.push(')');
        }
    }

    fn binding(&self, expr: Expr) -> Binding {
        match self.node(expr) {
            Node::Sum(constant, terms) if constant.is_zero() && terms.len() == 1 => {
                if terms[0].1.is_negative() { Binding::Sum } else { Binding::Product }
            }
            Node::Sum(..) => Binding::Sum,
            Node::Product(_) => Binding::Product,
            Node::Number(value) if value.is_negative() => Binding::Sum,
            Node::Number(Number::Rational(_, d)) if *d != 1 => Binding::Product,
            // prints itself with the parentheses that its content needs
            Node::Shared(_) | Node::Number(_) | Node::Symbol(_) => Binding::Power,
            Node::Call(..) | Node::Call2(..) | Node::Spline(..) => Binding::Power,
        }
    }

    fn write_sum(&self, out: &mut String, constant: Number, terms: &[(Expr, Number)]) {
        // Positive terms first, so that a formula does not start with a sign.
        let (negative, positive): (Vec<_>, Vec<_>) =
            terms.iter().copied().partition(|(_, coefficient)| coefficient.is_negative());
        let mut first = true;
        for (term, coefficient) in positive.into_iter().chain(negative) {
            put_sign(out, coefficient.is_negative(), first);
            first = false;
            if coefficient.abs().is_one() {
                self.write(out, term, Binding::Product);
            } else {
                put(out, &coefficient.abs());
                out.push('*');
                self.write(out, term, Binding::Product);
            }
        }
        if !constant.is_zero() {
            put_sign(out, constant.is_negative(), first);
            put(out, &constant.abs());
        }
    }

    fn write_product(&self, out: &mut String, factors: &[(Expr, i32)]) {
        let (above, below): (Vec<_>, Vec<_>) = factors.iter().copied().partition(|(_, e)| *e > 0);
        if above.is_empty() {
            out.push('1');
        }
        for (at, (factor, exponent)) in above.into_iter().enumerate() {
            if at > 0 {
                out.push('*');
            }
            self.write_power(out, factor, exponent);
        }
        for (factor, exponent) in below {
            out.push('/');
            self.write_power(out, factor, -exponent);
        }
    }

    fn write_power(&self, out: &mut String, base: Expr, exponent: i32) {
        self.write(out, base, Binding::Power);
        if exponent != 1 {
            put(out, &'^');
            put(out, &exponent);
        }
    }

    fn write_call(&self, out: &mut String, name: &str, arguments: &[Expr]) {
        out.push_str(name);
        out.push('(');
        for (at, &argument) in arguments.iter().enumerate() {
            if at > 0 {
                out.push_str(", ");
            }
            self.write(out, argument, Binding::Sum);
        }
        out.push(')');
    }
}

fn put_sign(out: &mut String, negative: bool, first: bool) {
    out.push_str(match (negative, first) {
        (true, true) => "-",
        (false, true) => "",
        (true, false) => " - ",
        (false, false) => " + ",
    });
}

fn put(out: &mut String, value: &dyn std::fmt::Display) {
    // writing to a `String` cannot fail
    let _ = write!(out, "{value}");
}
