//! The tangent of a program: the derivatives of all of its results along one direction.
//!
//! A direction says how fast every input changes. Each instruction y = f(a, b), in its order, then
//! changes by
//!
//! ```text
//! ẏ = ∂f/∂a ȧ + ∂f/∂b ḃ
//! ```
//!
//! The derivatives along one direction cost about as much as the program twice more, however many
//! results there are. They are a program again, so that nothing is recorded when it runs.
//!
//! `Program::along` gives this program. Tangents and transposes grow by `growing.rs`.
//!
//! # Source
//! A. Griewank, A. Walther, Evaluating Derivatives, 2nd ed., SIAM 2008, chapter 3.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::growing::{Growing, ZERO};
use crate::inconsistency::Inconsistency;
use crate::operators::Function;
use crate::program::{Instruction, Operand, Operation, Program};

impl Program {
    /// The derivatives of the results along a direction, a result each:
    /// Σᵢ ∂resultₖ/∂xᵢ ẋᵢ for the pairs (xᵢ, ẋᵢ) of `direction`. Inputs that are in no pair do not
    /// change.
    ///
    /// Derivatives of functions are those of the table ([`FUNCTIONS`](crate::FUNCTIONS)).
    ///
    /// # Example
    /// ```
    /// use mbs_symbolic::{Arena, Operand, Stage, lower_whole};
    ///
    /// // x y, along (ẋ, 0)
    /// let mut arena = Arena::new();
    /// let symbols = ["x", "y", "rate"].map(|name| arena.symbol(name, Stage::Variable));
    /// let [x, y, _] = symbols.map(|symbol| arena.variable(symbol));
    /// let product = arena.mul(x, y);
    /// let program = lower_whole(&mut arena, &[product], 1024)?;
    ///
    /// let [x, y, rate] = symbols.map(Operand::Symbol);
    /// let along = program.along(&[(x, rate)])?;
    /// // y ẋ
    /// assert_eq!(along.evaluate(&|symbol| [3.0, 5.0, 2.0][symbol.index()], &[]), [10.0]);
    /// # Ok::<(), mbs_symbolic::Inconsistency>(())
    /// ```
    ///
    /// # Errors
    /// A function of the table whose slopes read something else than its arguments and value, which
    /// is a mistake in the table.
    pub fn along(&self, direction: &[(Operand, Operand)]) -> Result<Self, Inconsistency> {
        let inputs: Vec<Operand> = direction.iter().map(|(input, _)| *input).collect();
        let active = self.active(&inputs);
        let mut tangent =
            Tangent { program: Growing::behind(self), rates: direction.iter().copied().collect() };
        for (at, instruction) in self.instructions.iter().enumerate() {
            if active.contains(&Operand::Value(at)) {
                let rate = tangent.rate_of(at, instruction, &active)?;
                tangent.rates.insert(Operand::Value(at), rate);
            }
        }
        let outputs = self.outputs.iter().map(|output| tangent.rate(*output)).collect();
        let instructions = tangent.program.instructions;
        Ok(Self { instructions, outputs, splines: self.splines.clone() }.without_dead_code())
    }
}

/// A program while its tangent grows behind it.
struct Tangent {
    program: Growing,
    /// ẏ of the inputs of the direction, and of what was met so far and depends on them.
    rates: FxHashMap<Operand, Operand>,
}

impl Tangent {
    fn rate(&self, operand: Operand) -> Operand {
        self.rates.get(&operand).copied().unwrap_or(ZERO)
    }

    /// How the value of an instruction changes.
    fn rate_of(
        &mut self,
        at: usize,
        step: &Instruction,
        active: &FxHashSet<Operand>,
    ) -> Result<Operand, Inconsistency> {
        let (a, b, result) = (step.a, step.b, Operand::Value(at));
        let [along_a, along_b] = [a, b].map(|operand| self.rate(operand));
        let grows = &mut self.program;
        Ok(match step.operation {
            Operation::Add => grows.sum(along_a, along_b),
            Operation::Sub => grows.difference(along_a, along_b),
            Operation::Mul => {
                let [first, second] = [grows.product(along_a, b), grows.product(a, along_b)];
                grows.sum(first, second)
            }
            Operation::Div => {
                let carried = grows.product(result, along_b);
                let above = grows.difference(along_a, carried);
                if above == ZERO { ZERO } else { grows.push(Operation::Div, above, b) }
            }
            Operation::Neg => grows.negative(along_a),
            Operation::Call(Function::Gate) if along_b == ZERO => ZERO,
            Operation::Call(Function::Gate) => grows.push(step.operation, a, along_b),
            Operation::Call(function) => {
                let is_active = [a, b].map(|operand| active.contains(&operand));
                let [slope_a, slope_b] = grows.slopes(function, [a, b, result], is_active)?;
                let [first, second] = [grows.product(slope_a, along_a), grows.product(slope_b, along_b)];
                grows.sum(first, second)
            }
            Operation::Spline(spline, order) => {
                let slope = grows.spline_slope(spline, order, a);
                slope.map_or(ZERO, |slope| grows.product(slope, along_a))
            }
        })
    }
}
