//! Sums of products, written as polynomials in what depends on the state.
//!
//! The masses of many particles that move with the same coordinates add up to a few numbers: of Σ m (a w)² is
//! Σ m a² times w². An expression is multiplied out, its terms are collected by the powers of what depends on the
//! state, and their coefficients, which depend on parameters alone, are computed once.

use std::collections::BTreeMap;

use crate::arena::{Arena, Expr, Node, Stage};
use crate::number::Number;

/// An expression with more terms is left as it is.
const MOST_TERMS: usize = 256;

/// Sums of a higher power, or in more of each other, are factors as they stand.
const HIGHEST_POWER: i32 = 16;
const DEEPEST: usize = 32;

/// Factors that depend on the state, with their exponents.
type Monomial = BTreeMap<Expr, i32>;

/// Coefficients, which depend on parameters alone, by monomials.
type Polynomial = BTreeMap<Monomial, Expr>;

impl Arena {
    /// The same value with terms of equal powers collected, where this takes fewer operations for each state.
    pub fn collected(&mut self, expr: Expr) -> Expr {
        let Some(polynomial) = self.polynomial(expr, 0) else { return expr };
        let terms = polynomial.into_iter().map(|(monomial, coefficient)| {
            let factors = monomial.into_iter().chain([(coefficient, 1)]);
            (self.product(&factors.collect::<Vec<_>>()), Number::ONE)
        });
        let terms: Vec<_> = terms.collect();
        let collected = self.sum(&terms);
        if self.cost(collected) < self.cost(expr) { collected } else { expr }
    }

    fn polynomial(&mut self, expr: Expr, depth: usize) -> Option<Polynomial> {
        if self.stage(expr) <= Stage::Parameter {
            return Some(Polynomial::from([(Monomial::new(), expr)]));
        }
        match self.node(expr).clone() {
            Node::Sum(constant, terms) if depth < DEEPEST => {
                let constant = self.number(constant);
                let mut sum = Polynomial::from([(Monomial::new(), constant)]);
                for (term, factor) in terms {
                    for (monomial, coefficient) in self.polynomial(term, depth + 1)? {
                        let coefficient = self.scale(coefficient, factor);
                        self.add_to(&mut sum, monomial, coefficient)?;
                    }
                }
                Some(sum)
            }
            Node::Product(factors) => {
                let one = self.one();
                let mut product = Polynomial::from([(Monomial::new(), one)]);
                for (factor, exponent) in factors {
                    let (base, times) = match self.node(factor) {
                        Node::Sum(..) if (1..=HIGHEST_POWER).contains(&exponent) && depth < DEEPEST => {
                            (self.polynomial(factor, depth + 1)?, exponent)
                        }
                        _ => (self.power(factor, exponent), 1),
                    };
                    for _ in 0..times {
                        product = self.times(&product, &base)?;
                    }
                }
                Some(product)
            }
            _ => Some(self.power(expr, 1)),
        }
    }

    /// A power of what is not taken apart.
    fn power(&mut self, factor: Expr, exponent: i32) -> Polynomial {
        if self.stage(factor) <= Stage::Parameter {
            return Polynomial::from([(Monomial::new(), self.powi(factor, exponent))]);
        }
        Polynomial::from([(Monomial::from([(factor, exponent)]), self.one())])
    }

    fn times(&mut self, a: &Polynomial, b: &Polynomial) -> Option<Polynomial> {
        let mut product = Polynomial::new();
        for (a, x) in a {
            for (b, y) in b {
                let mut monomial = a.clone();
                for (&factor, &exponent) in b {
                    *monomial.entry(factor).or_default() += exponent;
                }
                monomial.retain(|_, exponent| *exponent != 0);
                let coefficient = self.mul(*x, *y);
                self.add_to(&mut product, monomial, coefficient)?;
            }
        }
        Some(product)
    }

    /// Adds a term; `None` if there are too many.
    fn add_to(&mut self, sum: &mut Polynomial, monomial: Monomial, coefficient: Expr) -> Option<()> {
        let known = sum.get(&monomial).copied().unwrap_or(self.zero());
        let coefficient = self.add(known, coefficient);
        match self.is_zero(coefficient) {
            true => sum.remove(&monomial),
            false => sum.insert(monomial, coefficient),
        };
        (sum.len() <= MOST_TERMS).then_some(())
    }

    /// The operations that an expression takes for each state.
    fn cost(&self, expr: Expr) -> usize {
        let of = |expr: &Expr| match self.node(*expr) {
            Node::Sum(_, terms) => terms.len(),
            Node::Product(factors) => {
                factors.iter().map(|(_, exponent)| exponent.unsigned_abs() as usize).sum()
            }
            _ => 1,
        };
        let is_of_state = |expr: &Expr| self.stage(*expr) > Stage::Parameter;
        self.reachable(&[expr]).iter().filter(|expr| is_of_state(expr)).map(of).sum()
    }
}

#[cfg(test)]
mod tests {
    use crate::{Arena, Number, Stage};

    #[test]
    fn masses_of_particles_become_one_number() {
        let mut arena = Arena::new();
        let m = arena.symbol("m", Stage::Parameter);
        let w = arena.symbol("w", Stage::Variable);
        let (m, w) = (arena.variable(m), arena.variable(w));
        // Σ m (k/4 + k w)²
        let terms: Vec<_> = (1..=3)
            .map(|k| {
                let along = arena.number(Number::ratio(k, 4));
                let place = arena.sum(&[(along, Number::ONE), (w, Number::integer(k))]);
                let square = arena.powi(place, 2);
                (arena.mul(m, square), Number::ONE)
            })
            .collect();
        let sum = arena.sum(&terms);
        let collected = arena.collected(sum);
        assert_eq!(arena.display(collected), "7/8*m + 7*m*w + 14*m*w^2");
    }

    #[test]
    fn what_is_shorter_stays() {
        let mut arena = Arena::new();
        let [a, b] = ["a", "b"].map(|name| arena.symbol(name, Stage::Variable));
        let (a, b) = (arena.variable(a), arena.variable(b));
        let sum = arena.add(a, b);
        let power = arena.powi(sum, 4);
        assert_eq!(arena.collected(power), power);
        let one = arena.one();
        let quotient = arena.powi(sum, -1);
        let sum = arena.add(quotient, one);
        assert_eq!(arena.collected(sum), sum);
    }
}
