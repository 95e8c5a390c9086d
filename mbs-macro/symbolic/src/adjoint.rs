//! The transpose of a program: derivatives of its results by all of its inputs at once.
//!
//! Forward, a perturbation of one input goes through every instruction. Backward, the weight of a
//! result does: each instruction y = f(a, b), in reverse order, adds what it passes on,
//!
//! ```text
//! ā ← ā + ȳ ∂f/∂a      b̄ ← b̄ + ȳ ∂f/∂b
//! ```
//!
//! where ȳ = ∂(Σ wₖ resultₖ)/∂y is complete by then. The gradient costs a few times the program,
//! however many inputs there are. It is a program again, so that nothing is recorded when it runs.
//!
//! # Source
//! A. Griewank, A. Walther, Evaluating Derivatives, 2nd ed., SIAM 2008, chapter 3.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::algebra::Algebra;
use crate::arena::{Arena, Expr, Node, Stage};
use crate::inconsistency::Inconsistency;
use crate::number::Number;
use crate::operators::Function;
use crate::program::{Instruction, Operand, Operation, Program};

const ZERO: Operand = Operand::Number(Number::ZERO);

impl Program {
    /// The program with its transpose behind it: its results, and then
    /// Σₖ `weights`ₖ ∂resultₖ/∂`by`ᵢ for each of `by`, symbols or hoisted values.
    ///
    /// Derivatives of functions are those of the table ([`FUNCTIONS`](crate::FUNCTIONS)).
    /// Instructions that no input of `by` reaches pass nothing on.
    ///
    /// # Example
    /// ```
    /// use mbs_symbolic::{Arena, Operand, Stage, lower_whole};
    ///
    /// // x y + sin x
    /// let mut arena = Arena::new();
    /// let symbols = ["x", "y", "w"].map(|name| arena.symbol(name, Stage::Variable));
    /// let [x, y, _] = symbols.map(|symbol| arena.variable(symbol));
    /// let (product, sine) = (arena.mul(x, y), arena.call(mbs_symbolic::Function::Sin, x));
    /// let f = arena.add(product, sine);
    /// let program = lower_whole(&mut arena, &[f], 1024)?;
    ///
    /// let [x, y, weight] = symbols.map(Operand::Symbol);
    /// let both = program.with_adjoint(&[weight], &[x, y])?;
    /// let values = |symbol| if symbol == symbols[0] { 0.0 } else { 2.0 };
    /// // f, w (y + cos x), w x
    /// assert_eq!(both.evaluate(&values, &[]), [0.0, 6.0, 0.0]);
    /// # Ok::<(), mbs_symbolic::Inconsistency>(())
    /// ```
    ///
    /// # Errors
    /// As many weights as results are needed, and instructions that read earlier ones.
    pub fn with_adjoint(&self, weights: &[Operand], by: &[Operand]) -> Result<Self, Inconsistency> {
        if weights.len() != self.outputs.len() {
            return Err(broken("every result has a weight"));
        }
        let active = self.active(by);
        let mut transpose = Transpose::of(self);
        for (&output, &weight) in self.outputs.iter().zip(weights) {
            if active.contains(&output) {
                transpose.pass(output, weight);
            }
        }
        for (at, instruction) in self.instructions.iter().enumerate().rev() {
            let Some(&weight) = transpose.weights.get(&Operand::Value(at)) else { continue };
            transpose.instruction(at, instruction, weight, &active)?;
        }
        let gradient = by.iter().map(|input| transpose.weights.get(input).copied().unwrap_or(ZERO));
        let outputs = self.outputs.iter().copied().chain(gradient).collect();
        let Transpose { instructions, .. } = transpose;
        Ok(Self { instructions, outputs, splines: self.splines.clone() }.without_dead_code())
    }

    /// What depends on these inputs, they themselves included.
    fn active(&self, by: &[Operand]) -> FxHashSet<Operand> {
        let mut active: FxHashSet<Operand> = by.iter().copied().collect();
        for (at, instruction) in self.instructions.iter().enumerate() {
            if active.contains(&instruction.a) || active.contains(&instruction.b) {
                active.insert(Operand::Value(at));
            }
        }
        active
    }
}

const fn broken(rule: &'static str) -> Inconsistency {
    Inconsistency { pass: "transposing a program", rule }
}

/// Instructions while they grow.
struct Transpose {
    instructions: Vec<Instruction>,
    /// Where a value is computed already.
    known: FxHashMap<(Operation, Operand, Operand), usize>,
    /// ȳ of what has passed something on so far.
    weights: FxHashMap<Operand, Operand>,
}

impl Transpose {
    fn of(program: &Program) -> Self {
        let mut known = FxHashMap::default();
        for (at, step) in program.instructions.iter().enumerate() {
            known.insert(key(step.operation, step.a, step.b), at);
        }
        Self { instructions: program.instructions.clone(), known, weights: FxHashMap::default() }
    }

    /// Passes the weight of a result on to what it was computed from.
    fn instruction(
        &mut self,
        at: usize,
        step: &Instruction,
        weight: Operand,
        active: &FxHashSet<Operand>,
    ) -> Result<(), Inconsistency> {
        let (a, b, result) = (step.a, step.b, Operand::Value(at));
        let parts: [Option<(Operand, Operand)>; 2] = match step.operation {
            Operation::Add => [Some((a, weight)), Some((b, weight))],
            Operation::Sub => [Some((a, weight)), Some((b, self.negative(weight)))],
            Operation::Mul => [Some((a, self.product(weight, b))), Some((b, self.product(weight, a)))],
            Operation::Div => {
                let share = self.push(Operation::Div, weight, b);
                let back = self.product(share, result);
                [Some((a, share)), Some((b, self.negative(back)))]
            }
            Operation::Neg => [Some((a, self.negative(weight))), None],
            Operation::Call(function) => {
                let [slope, _] = self.slopes(function, [a, a, result], [active.contains(&a), false])?;
                [Some((a, self.product(weight, slope))), None]
            }
            Operation::Call2(function) => {
                let is_active = [a, b].map(|operand| active.contains(&operand));
                let [along, across] = self.slopes(function, [a, b, result], is_active)?;
                [Some((a, self.product(weight, along))), Some((b, self.product(weight, across)))]
            }
            // the fourth derivative of a cubic vanishes
            Operation::Spline(_, 3..) => [None, None],
            Operation::Spline(spline, order) => {
                let slope = self.push(Operation::Spline(spline, order + 1), a, a);
                [Some((a, self.product(weight, slope))), None]
            }
        };
        for (operand, weight) in parts.into_iter().flatten() {
            if active.contains(&operand) {
                self.pass(operand, weight);
            }
        }
        Ok(())
    }

    /// Adds to the weight of an operand.
    fn pass(&mut self, operand: Operand, weight: Operand) {
        let sum = match self.weights.get(&operand).copied() {
            Some(sum) => self.sum(sum, weight),
            None => weight,
        };
        self.weights.insert(operand, sum);
    }

    /// The derivatives of a function of the table by its arguments, 0 for those that nobody asks
    /// for; given both arguments and its value.
    fn slopes(
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
            (function.row().partials)(x, y, f).map(|partial| partial.expr())
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
            Node::Call(function, x) => {
                let x = self.expression(arena, *x, given)?;
                self.push(Operation::Call(*function), x, x)
            }
            Node::Call2(function, x, y) => {
                let (x, y) = (self.expression(arena, *x, given)?, self.expression(arena, *y, given)?);
                self.push(Operation::Call2(*function), x, y)
            }
            Node::Shared(x) => self.expression(arena, *x, given)?,
            Node::Spline(..) => return Err(broken("no slope of the table is a spline")),
        })
    }

    fn sum(&mut self, a: Operand, b: Operand) -> Operand {
        match (a, b) {
            (Operand::Number(x), Operand::Number(y)) => Operand::Number(x + y),
            (Operand::Number(zero), other) | (other, Operand::Number(zero)) if zero.is_zero() => other,
            _ => self.push(Operation::Add, a, b),
        }
    }

    fn product(&mut self, a: Operand, b: Operand) -> Operand {
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

    fn negative(&mut self, a: Operand) -> Operand {
        match a {
            Operand::Number(number) => Operand::Number(-number),
            _ => self.push(Operation::Neg, a, a),
        }
    }

    /// The value of an instruction, which is made if there is none yet.
    fn push(&mut self, operation: Operation, a: Operand, b: Operand) -> Operand {
        let at = *self.known.entry(key(operation, a, b)).or_insert_with(|| {
            self.instructions.push(Instruction { operation, a, b, name: None });
            self.instructions.len() - 1
        });
        Operand::Value(at)
    }
}

/// Sums and products are the same in either order.
fn key(operation: Operation, a: Operand, b: Operand) -> (Operation, Operand, Operand) {
    let is_symmetric = matches!(operation, Operation::Add | Operation::Mul);
    if is_symmetric && b < a { (operation, b, a) } else { (operation, a, b) }
}
