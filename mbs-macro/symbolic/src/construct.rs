//! Constructors that keep expressions canonical.
//!
//! Each rule names its condition. Rules marked *generic* hold wherever the
//! original is defined and may extend it where it is not (x/x is 1 at x = 0).

use crate::arena::{Arena, Expr, Node};
use crate::collected::Collected;
use crate::exact::{Real, Residue};
use crate::number::Number;
use crate::operators::{Function, Parity};
use crate::spline::SplineId;

/// Larger exponents are powers, not repeated products.
const LARGEST_EXPONENT: i64 = 64;

impl Arena {
    /// a + b
    pub fn add(&mut self, a: Expr, b: Expr) -> Expr {
        self.sum(&[(a, Number::ONE), (b, Number::ONE)])
    }

    /// a − b
    pub fn sub(&mut self, a: Expr, b: Expr) -> Expr {
        self.sum(&[(a, Number::ONE), (b, Number::MINUS_ONE)])
    }

    /// −a
    pub fn neg(&mut self, a: Expr) -> Expr {
        self.scale(a, Number::MINUS_ONE)
    }

    /// coefficient·a
    pub fn scale(&mut self, a: Expr, coefficient: Number) -> Expr {
        self.sum(&[(a, coefficient)])
    }

    /// Σ coefficient·term: nested sums are opened, like terms collected, and
    /// c sin²x·r + d cos²x·r becomes d·r + (c − d) sin²x·r (always valid).
    pub fn sum(&mut self, terms: &[(Expr, Number)]) -> Expr {
        let mut constant = Number::ZERO;
        let mut collected = Collected::with_capacity(terms.len());
        for &(term, coefficient) in terms {
            self.collect_term(term, coefficient, &mut constant, &mut collected);
        }
        self.merge_squares(&mut constant, &mut collected);
        collected.retain(|coefficient| !coefficient.is_zero());
        let terms = collected.into_vec();
        match terms[..] {
            [] => self.number(constant),
            [(term, coefficient)] if constant.is_zero() && coefficient.is_one() => term,
            _ => self.intern(Node::Sum(constant, terms)),
        }
    }

    fn collect_term(
        &self,
        term: Expr,
        coefficient: Number,
        constant: &mut Number,
        collected: &mut Collected<Number>,
    ) {
        let mut collect = |term, coefficient: Number| {
            let sum = collected.entry(term, Number::ZERO);
            *sum = *sum + coefficient;
        };
        match self.node(term) {
            Node::Number(value) => *constant = *constant + coefficient * *value,
            Node::Sum(inner, terms) => {
                *constant = *constant + coefficient * *inner;
                for (term, inner) in terms {
                    collect(*term, coefficient * *inner);
                }
            }
            _ => collect(term, coefficient),
        }
    }

    /// sin² + cos² = 1 on all pairs of terms that differ in just that.
    fn merge_squares(&mut self, constant: &mut Number, collected: &mut Collected<Number>) {
        let is_square = |&(term, _): &(Expr, Number)| matches!(self.node(term), Node::Product(_));
        let candidates: Vec<_> = collected.iter().filter(is_square).collect();
        for (term, _) in candidates {
            let Some(of_cosine) = collected.get(term) else { continue };
            for (partner, rest) in self.square_partners(term) {
                let Some(of_sine) = collected.get(partner) else { continue };
                collected.remove(term);
                collected.insert(partner, of_sine + of_cosine * Number::MINUS_ONE);
                self.collect_term(rest, of_cosine, constant, collected);
                break;
            }
        }
    }

    /// For a term cos²x·r: the pair (sin²x·r, r), for every such x.
    fn square_partners(&mut self, term: Expr) -> Vec<(Expr, Expr)> {
        let Node::Product(factors) = self.node(term) else { return Vec::new() };
        let factors = factors.clone();
        let mut partners = Vec::new();
        for (at, &(factor, exponent)) in factors.iter().enumerate() {
            if let Node::Call(Function::Cos, [angle, _]) = *self.node(factor)
                && exponent >= 2
            {
                let mut rest = factors.clone();
                rest[at].1 -= 2;
                let sine = self.call(Function::Sin, angle);
                let rest = self.product(&rest);
                let square = self.powi(sine, 2);
                partners.push((self.mul(square, rest), rest));
            }
        }
        partners
    }

    /// a·b
    pub fn mul(&mut self, a: Expr, b: Expr) -> Expr {
        self.product(&[(a, 1), (b, 1)])
    }

    /// a/b; `None` if b is the constant 0.
    pub fn div(&mut self, a: Expr, b: Expr) -> Option<Expr> {
        (!self.is_zero(b)).then(|| self.product(&[(a, 1), (b, -1)]))
    }

    /// a to an integer power; the constant 0 to a negative power is left
    /// standing as a float infinity, which no caller should provoke.
    pub fn powi(&mut self, a: Expr, exponent: i32) -> Expr {
        self.product(&[(a, exponent)])
    }

    /// Π factor^exponent: nested products are opened, coefficients move in
    /// front, equal factors collect (x/x = 1 is *generic*), and (√x)² = x
    /// (*generic*: for x < 0 the original is undefined).
    pub fn product(&mut self, factors: &[(Expr, i32)]) -> Expr {
        let mut coefficient = Number::ONE;
        let mut collected = Collected::with_capacity(factors.len());
        for &(factor, exponent) in factors {
            self.collect_factor(factor, exponent.into(), &mut coefficient, &mut collected);
        }
        // A root gives way to what stands under it, which has a smaller handle.
        while self.merge_roots(&mut coefficient, &mut collected) {}
        collected.retain(|exponent| exponent != 0);
        if coefficient.is_zero() {
            return self.zero();
        }
        let factors = self.limit_exponents(collected);
        let product = match factors[..] {
            [] => return self.number(coefficient),
            [(factor, 1)] => factor,
            _ => self.intern(Node::Product(factors)),
        };
        if coefficient.is_one() { product } else { self.scale(product, coefficient) }
    }

    fn collect_factor(
        &self,
        factor: Expr,
        exponent: i64,
        coefficient: &mut Number,
        collected: &mut Collected<i64>,
    ) {
        if exponent == 0 {
            return;
        }
        let mut collect = |factor, exponent: i64| {
            let sum = collected.entry(factor, 0);
            *sum = sum.saturating_add(exponent);
        };
        match self.node(factor) {
            Node::Number(value) => *coefficient = *coefficient * power(*value, exponent),
            Node::Sum(constant, terms) if constant.is_zero() && terms.len() == 1 => {
                let (term, inner) = terms[0];
                *coefficient = *coefficient * power(inner, exponent);
                self.collect_factor(term, exponent, coefficient, collected);
            }
            Node::Product(factors) => {
                for (factor, inner) in factors {
                    collect(*factor, exponent.saturating_mul((*inner).into()));
                }
            }
            _ => collect(factor, exponent),
        }
    }

    /// (√x)² = x once on every factor; whether there was one.
    fn merge_roots(&mut self, coefficient: &mut Number, collected: &mut Collected<i64>) -> bool {
        let roots: Vec<_> = collected
            .iter()
            .filter_map(|(factor, exponent)| match self.node(factor) {
                Node::Call(Function::Sqrt, [inner, _]) if exponent.abs() >= 2 => {
                    Some((factor, *inner, exponent))
                }
                _ => None,
            })
            .collect();
        for &(root, inner, exponent) in &roots {
            collected.insert(root, exponent % 2);
            self.collect_factor(inner, exponent / 2, coefficient, collected);
        }
        !roots.is_empty()
    }

    /// Factors with exponents that are worth multiplying out; larger ones
    /// become powers.
    fn limit_exponents(&mut self, collected: Collected<i64>) -> Vec<(Expr, i32)> {
        let mut factors = Collected::with_capacity(0);
        for (factor, exponent) in collected.into_vec() {
            let (factor, exponent) = match i32::try_from(exponent) {
                Ok(small) if exponent.abs() <= LARGEST_EXPONENT => (factor, small),
                _ => {
                    let exponent = self.number(Number::integer(exponent));
                    (self.apply_plainly(Function::Pow, [factor, exponent]), 1)
                }
            };
            *factors.entry(factor, 0) += exponent;
        }
        factors.into_vec()
    }

    /// xʸ: integer and half-integer constant exponents become products and
    /// square roots, all others stay a power (defined for x > 0).
    pub fn pow(&mut self, x: Expr, y: Expr) -> Expr {
        match self.as_number(y) {
            Some(Number::Rational(n, 1)) if n.abs() <= LARGEST_EXPONENT => self.powi(x, n as i32),
            Some(Number::Rational(n, 2)) if n.abs() <= LARGEST_EXPONENT => {
                let root = self.call(Function::Sqrt, x);
                self.powi(root, n as i32)
            }
            _ => self.apply_plainly(Function::Pow, [x, y]),
        }
    }

    /// f(x), with f(−x) turned into ±f(x) where f is odd or even.
    pub fn call(&mut self, function: Function, x: Expr) -> Expr {
        self.apply(function, [x, x])
    }

    /// f(x, y)
    pub fn call2(&mut self, function: Function, x: Expr, y: Expr) -> Expr {
        self.apply(function, [x, y])
    }

    /// f of its arguments, x twice where it has one.
    pub fn apply(&mut self, function: Function, [x, y]: [Expr; 2]) -> Expr {
        let parity = function.row().parity;
        if function == Function::Gate {
            return match self.as_number(x) {
                Some(shut) if shut.is_zero() => self.zero(),
                Some(_) => y,
                None if self.is_zero(y) => y,
                None => self.intern(Node::Call(function, [x, y])),
            };
        }
        if function == Function::Pow {
            self.pow(x, y)
        } else if parity != Parity::Neither && self.leads_negative(x) && self.fold(function, [x, y]).is_none()
        {
            let positive = self.neg(x);
            let value = self.intern(Node::Call(function, [positive; 2]));
            if parity == Parity::Odd { self.neg(value) } else { value }
        } else {
            self.apply_plainly(function, [x, y])
        }
    }

    /// A call as it stands, or the number that it is.
    fn apply_plainly(&mut self, function: Function, arguments: [Expr; 2]) -> Expr {
        match self.fold(function, arguments) {
            Some(number) => self.number(number),
            None => self.intern(Node::Call(function, arguments)),
        }
    }

    /// f of constants: exact where that exists; `None` where it is not finite.
    fn fold(&self, function: Function, [x, y]: [Expr; 2]) -> Option<Number> {
        let (row, both) = (function.row(), [self.as_number(x)?, self.as_number(y)?]);
        if let Some(of_number) = row.of_number {
            return of_number(both[0]);
        }
        let arguments = function.arguments(&both);
        let value = (row.value)(both[0].to_f64(), both[1].to_f64());
        if !value.is_finite() {
            return None;
        }
        if let ([_, _], Some(same)) = (arguments, arguments.iter().find(|x| x.to_f64() == value)) {
            return Some(*same);
        }
        let reals: Vec<Real> = arguments.iter().map(|x| x.real()).collect();
        Some(match row.of_turn.and_then(|of_turn| of_turn(reals[0].turn()?)) {
            Some(exact) if exact == Residue::ZERO => Number::ZERO,
            Some(exact) => Real::known(value, &reals, exact).number(),
            None => Real::of_function(value, row.name, &reals).number(),
        })
    }

    /// The value of a spline at x.
    pub fn spline(&mut self, spline: SplineId, x: Expr) -> Expr {
        self.spline_derivative(spline, 0, x)
    }

    /// The derivative of this order of a spline at x: 0 beyond its degree.
    pub(crate) fn spline_derivative(&mut self, spline: SplineId, order: u8, x: Expr) -> Expr {
        if order > self.splines[spline.index()].degree() {
            return self.zero();
        }
        if let Some(x) = self.as_number(x) {
            let value = self.splines[spline.index()].derivative(order, x.to_f64());
            // none where the spline refuses its argument
            if value.is_finite() {
                return self.number(value.into());
            }
        }
        self.intern(Node::Spline(spline, order, x))
    }

    /// True if the first term has a negative coefficient: one of x and −x does.
    fn leads_negative(&self, x: Expr) -> bool {
        match self.node(x) {
            Node::Sum(_, terms) => terms.first().is_some_and(|(_, coefficient)| coefficient.is_negative()),
            Node::Number(value) => value.is_negative(),
            _ => false,
        }
    }
}

/// A constant to an integer power, as a float where it is large.
fn power(value: Number, exponent: i64) -> Number {
    match i32::try_from(exponent) {
        Ok(small) if exponent.abs() <= LARGEST_EXPONENT => value.powi(small),
        _ => value.to_f64().powf(exponent as f64).into(),
    }
}
