//! A program that grows: instructions behind those that are there, none of them twice.

use std::rc::Rc;

use rustc_hash::FxHashMap;

use crate::algebra::Algebra;
use crate::arena::{Arena, Expr, Node, Stage};
use crate::inconsistency::Inconsistency;
use crate::number::Number;
use crate::operators::Function;
use crate::program::{Instruction, Operand, Operation, Program};
use crate::spline::{Spline, SplineId};

pub(crate) const ZERO: Operand = Operand::Number(Number::ZERO);

/// Instructions while they grow.
pub(crate) struct Growing {
    pub instructions: Vec<Instruction>,
    splines: Vec<Rc<Spline>>,
    /// Where a value is computed already.
    known: FxHashMap<(Operation, Operand, Operand), usize>,
}

impl Growing {
    /// Behind the instructions of a program.
    pub fn behind(program: &Program) -> Self {
        let mut known = FxHashMap::default();
        for (at, step) in program.instructions.iter().enumerate() {
            known.insert(key(step.operation, step.a, step.b), at);
        }
        Self { instructions: program.instructions.clone(), splines: program.splines.clone(), known }
    }

    /// The derivatives of a function of the table by its arguments, 0 for those that nobody asks
    /// for; given both arguments and its value.
    pub fn slopes(
        &mut self,
        function: Function,
        given: [Operand; 3],
        is_asked: [bool; 2],
    ) -> Result<[Operand; 2], Inconsistency> {
        let mut arena = Arena::new();
        let symbols = ["x", "y", "f"].map(|name| arena.symbol(name, Stage::Variable));
        // an exponent that is a number has a derivative of its own
        let partials = {
            let algebra = Algebra::new(&mut arena);
            let [x, y, f] = [0, 1, 2].map(|at| match given[at] {
                Operand::Number(number) if at < 2 => algebra.number(number),
                _ => algebra.variable(symbols[at]),
            });
            function.slopes(x, y, f).map(|slope| slope.expr())
        };
        let mut found = [ZERO; 2];
        for (slope, (partial, is_asked)) in found.iter_mut().zip(partials.into_iter().zip(is_asked)) {
            if is_asked {
                *slope = self.expression(&arena, partial, &given)?;
            }
        }
        Ok(found)
    }

    /// The instructions of an expression of the table.
    fn expression(
        &mut self,
        arena: &Arena,
        expr: Expr,
        given: &[Operand; 3],
    ) -> Result<Operand, Inconsistency> {
        Ok(match arena.node(expr) {
            Node::Number(number) => Operand::Number(*number),
            Node::Symbol(symbol) => {
                *given.get(symbol.index()).ok_or(broken("slopes read arguments and values"))?
            }
            Node::Sum(constant, terms) => {
                let mut sum = Operand::Number(*constant);
                for (term, coefficient) in terms {
                    let term = self.expression(arena, *term, given)?;
                    let term = self.product(Operand::Number(*coefficient), term);
                    sum = self.sum(sum, term);
                }
                sum
            }
            Node::Product(factors) => {
                let one = Operand::Number(Number::ONE);
                let (mut above, mut below) = (one, one);
                for (factor, exponent) in factors {
                    let factor = self.expression(arena, *factor, given)?;
                    for _ in 0..exponent.unsigned_abs() {
                        let side = if *exponent > 0 { &mut above } else { &mut below };
                        *side = self.product(*side, factor);
                    }
                }
                if below == one { above } else { self.push(Operation::Div, above, below) }
            }
            Node::Call(function, [x, y]) => {
                let (x, y) = (self.expression(arena, *x, given)?, self.expression(arena, *y, given)?);
                self.push(Operation::Call(*function), x, y)
            }
            Node::Shared(x) => self.expression(arena, *x, given)?,
            Node::Spline(..) => return Err(broken("no slope of the table is a spline")),
        })
    }

    pub fn sum(&mut self, a: Operand, b: Operand) -> Operand {
        match (a, b) {
            (Operand::Number(x), Operand::Number(y)) => Operand::Number(x + y),
            (Operand::Number(zero), other) | (other, Operand::Number(zero)) if zero.is_zero() => other,
            _ => self.push(Operation::Add, a, b),
        }
    }

    pub fn difference(&mut self, a: Operand, b: Operand) -> Operand {
        match (a, b) {
            (Operand::Number(x), Operand::Number(y)) => Operand::Number(x + -y),
            (other, Operand::Number(zero)) if zero.is_zero() => other,
            (Operand::Number(zero), other) if zero.is_zero() => self.negative(other),
            _ => self.push(Operation::Sub, a, b),
        }
    }

    pub fn product(&mut self, a: Operand, b: Operand) -> Operand {
        match (a, b) {
            (Operand::Number(x), Operand::Number(y)) => Operand::Number(x * y),
            (Operand::Number(number), other) | (other, Operand::Number(number)) => {
                if number.is_zero() {
                    ZERO
                } else if number.is_one() {
                    other
                } else if number == Number::MINUS_ONE {
                    self.negative(other)
                } else {
                    self.push(Operation::Mul, a, b)
                }
            }
            _ => self.push(Operation::Mul, a, b),
        }
    }

    pub fn negative(&mut self, a: Operand) -> Operand {
        match a {
            Operand::Number(number) => Operand::Number(-number),
            _ => self.push(Operation::Neg, a, a),
        }
    }

    /// The slope of a derivative of a spline at `x`; nothing of the last one that does not vanish.
    pub fn spline_slope(&mut self, spline: SplineId, order: u8, x: Operand) -> Option<Operand> {
        let slope = Operation::Spline(spline, order + 1);
        (order < self.splines[spline.index()].degree()).then(|| self.push(slope, x, x))
    }

    /// The value of an instruction, which is made if there is none yet.
    pub fn push(&mut self, operation: Operation, a: Operand, b: Operand) -> Operand {
        let at = *self.known.entry(key(operation, a, b)).or_insert_with(|| {
            self.instructions.push(Instruction { operation, a, b, name: None });
            self.instructions.len() - 1
        });
        Operand::Value(at)
    }
}

/// Sums and products are the same in either order.
fn key(operation: Operation, a: Operand, b: Operand) -> (Operation, Operand, Operand) {
    if operation.commutes() && b < a { (operation, b, a) } else { (operation, a, b) }
}

/// A rule that a derivative of a program keeps.
pub(crate) const fn broken(rule: &'static str) -> Inconsistency {
    Inconsistency { pass: "differentiating a program", rule }
}
