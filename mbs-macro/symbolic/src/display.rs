//! Expressions as text.

use std::fmt::Write;

use crate::abbreviated::Names;
use crate::arena::{Arena, Expr, Node};
use crate::number::Number;
use crate::operators::Latex;

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
        self.display_with(expr, &Names::default())
    }

    /// The same with names for some parts of it.
    pub(crate) fn display_with(&self, expr: Expr, names: &Names) -> String {
        let mut text = String::new();
        self.write_whole(&mut text, expr, Binding::Sum, names);
        text
    }

    fn write(&self, out: &mut String, expr: Expr, context: Binding, names: &Names) {
        match names.get(&expr) {
            Some(name) => out.push_str(name),
            None => self.write_whole(out, expr, context, names),
        }
    }

    fn write_whole(&self, out: &mut String, expr: Expr, context: Binding, names: &Names) {
        let parenthesize = self.binding(expr) < context;
        if parenthesize {
            out.push('(');
        }
        match self.node(expr) {
            Node::Number(value) => put(out, value),
            Node::Symbol(symbol) => out.push_str(self.name(*symbol)),
            Node::Sum(constant, terms) => self.write_sum(out, *constant, terms, names),
            Node::Product(factors) => self.write_product(out, factors, names),
            Node::Call(function, [x, y]) => match function.row().latex {
                Latex::Bracket(sign) => {
                    out.push('[');
                    self.write(out, *x, Binding::Sum, names);
                    let _ = write!(out, " {sign} ");
                    self.write(out, *y, Binding::Sum, names);
                    out.push(']');
                }
                Latex::Product => {
                    self.write(out, *x, Binding::Product, names);
                    out.push('*');
                    self.write(out, *y, Binding::Product, names);
                }
                _ => self.write_call(out, function.row().name, function.arguments(&[*x, *y]), names),
            },
            Node::Spline(spline, order, x) => {
                let primes = "'".repeat((*order).into());
                let name = &self.splines()[spline.index()].name;
                self.write_call(out, &format!("{name}{primes}"), &[*x], names);
            }
            Node::Shared(x) => self.write(out, *x, context, names),
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
            Node::Call(function, _) if function.row().latex == Latex::Product => Binding::Product,
            Node::Call(..) | Node::Spline(..) => Binding::Power,
        }
    }

    fn write_sum(&self, out: &mut String, constant: Number, terms: &[(Expr, Number)], names: &Names) {
        // Positive terms first, so that a formula does not start with a sign.
        let (negative, positive): (Vec<_>, Vec<_>) =
            terms.iter().copied().partition(|(_, coefficient)| coefficient.is_negative());
        let mut first = true;
        for (term, coefficient) in positive.into_iter().chain(negative) {
            put_sign(out, coefficient.is_negative(), first);
            first = false;
            if coefficient.abs().is_one() {
                self.write(out, term, Binding::Product, names);
            } else {
                put(out, &coefficient.abs());
                out.push('*');
                self.write(out, term, Binding::Product, names);
            }
        }
        if !constant.is_zero() {
            put_sign(out, constant.is_negative(), first);
            put(out, &constant.abs());
        }
    }

    fn write_product(&self, out: &mut String, factors: &[(Expr, i32)], names: &Names) {
        let (above, below): (Vec<_>, Vec<_>) = factors.iter().copied().partition(|(_, e)| *e > 0);
        if above.is_empty() {
            out.push('1');
        }
        for (at, (factor, exponent)) in above.into_iter().enumerate() {
            if at > 0 {
                out.push('*');
            }
            self.write_power(out, factor, exponent, names);
        }
        for (factor, exponent) in below {
            out.push('/');
            self.write_power(out, factor, -exponent, names);
        }
    }

    fn write_power(&self, out: &mut String, base: Expr, exponent: i32, names: &Names) {
        self.write(out, base, Binding::Power, names);
        if exponent != 1 {
            put(out, &'^');
            put(out, &exponent);
        }
    }

    fn write_call(&self, out: &mut String, name: &str, arguments: &[Expr], names: &Names) {
        out.push_str(name);
        out.push('(');
        for (at, &argument) in arguments.iter().enumerate() {
            if at > 0 {
                out.push_str(", ");
            }
            self.write(out, argument, Binding::Sum, names);
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
