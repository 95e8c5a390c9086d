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
//! `Program::with_adjoint` puts these instructions behind a program. Slopes of functions are those of
//! `operators.rs`.
//!
//! # Source
//! A. Griewank, A. Walther, Evaluating Derivatives, 2nd ed., SIAM 2008, chapter 3.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::growing::{Growing, ZERO, broken};
use crate::inconsistency::Inconsistency;
use crate::operators::Function;
use crate::program::{Instruction, Operand, Operation, Program};

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
        let instructions = transpose.program.instructions;
        Ok(Self { instructions, outputs, splines: self.splines.clone() }.without_dead_code())
    }

    /// The operands that depend on these inputs, they themselves included.
    pub(crate) fn active(&self, by: &[Operand]) -> FxHashSet<Operand> {
        let mut active: FxHashSet<Operand> = by.iter().copied().collect();
        for (at, instruction) in self.instructions.iter().enumerate() {
            if active.contains(&instruction.a) || active.contains(&instruction.b) {
                active.insert(Operand::Value(at));
            }
        }
        active
    }
}

/// A program while its transpose grows behind it.
struct Transpose {
    program: Growing,
    /// ȳ of what has passed something on so far.
    weights: FxHashMap<Operand, Operand>,
}

impl Transpose {
    fn of(program: &Program) -> Self {
        Self { program: Growing::behind(program), weights: FxHashMap::default() }
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
        let grows = &mut self.program;
        let parts: [Option<(Operand, Operand)>; 2] = match step.operation {
            Operation::Add => [Some((a, weight)), Some((b, weight))],
            Operation::Sub => [Some((a, weight)), Some((b, grows.negative(weight)))],
            Operation::Mul => [Some((a, grows.product(weight, b))), Some((b, grows.product(weight, a)))],
            Operation::Div => {
                let share = grows.push(Operation::Div, weight, b);
                let back = grows.product(share, result);
                [Some((a, share)), Some((b, grows.negative(back)))]
            }
            Operation::Neg => [Some((a, grows.negative(weight))), None],
            Operation::Call(Function::Gate) => [None, Some((b, grows.push(step.operation, a, weight)))],
            Operation::Call(function) => {
                let is_active = [a, b].map(|operand| active.contains(&operand));
                let slopes = grows.slopes(function, [a, b, result], is_active)?;
                let [along, across] = slopes.map(|slope| grows.product(weight, slope));
                [Some((a, along)), (function.row().arity > 1).then_some((b, across))]
            }
            Operation::Spline(spline, order) => {
                let slope = grows.spline_slope(spline, order, a);
                [slope.map(|slope| (a, grows.product(weight, slope))), None]
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
            Some(sum) => self.program.sum(sum, weight),
            None => weight,
        };
        self.weights.insert(operand, sum);
    }
}
