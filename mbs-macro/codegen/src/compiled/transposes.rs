//! Transposed programs, which a derivative in reverse is made of.
//!
//! They are made when a target asks for them. A declaration wants them if it says `gradients = reverse;`.
//! `targets/rust/transposes.rs` prints them, long ones in loops and parts as other long programs.
//! `transposed.rs` of `mbs-live` makes code of them.

use mbs_symbolic::{Arena, Inconsistency, Operand, Program, Stage};

use super::{Compiled, FunctionId, Input, Kinds, Property, Results};

/// A program that goes backward: from how much each result of a function counts, its weight, to how much
/// everything counts that the function reads,
///
/// ```text
/// x̄ = Σₖ wₖ ∂resultₖ/∂x
/// ```
pub struct Transposed {
    /// It reads what the function reads, and the weights ([`Input::Weight`]).
    pub program: Program,
    /// x of each of its results: a component of a vector, or a hoisted value.
    pub by: Vec<Operand>,
    /// How many results of the function have a weight, the first ones.
    pub weights: usize,
}

/// The transposed programs of a mechanism.
pub struct Transposes {
    /// With the functions that they belong to.
    pub functions: Vec<(FunctionId, Transposed)>,
    /// Of a whole step, where there is one.
    pub step: Option<Kinds<Transposed>>,
}

impl Transposes {
    /// That of a function, if it is transposed.
    pub fn of(&self, function: FunctionId) -> Option<&Transposed> {
        self.functions.iter().find(|(id, _)| *id == function).map(|(_, transposed)| transposed)
    }
}

impl Compiled {
    /// The transposed programs. They are made when this is called, which takes about as long as the programs
    /// took.
    ///
    /// # Example
    /// ```
    /// use mbs_codegen::analyse;
    ///
    /// let declaration = "Block { dof = 1; param k = 4 [N/m]; body block (x) { mass = 1 [kg]; }
    ///     force spring on x = -k*x; start { x = 1 [m]; } }";
    /// let compiled = analyse(declaration.parse()?)?;
    /// let transposes = compiled.transposes()?;
    /// assert!(transposes.step.is_some());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A mistake of the compiler.
    pub fn transposes(&self) -> Result<Transposes, Inconsistency> {
        let functions =
            self.functions().filter(|function| function.is(Property::Transposed)).map(|function| {
                let counted = function.results().iter().filter(|result| **result != Results::Growth);
                let weights = counted.map(|result| self.length(*result)).sum();
                Ok((function, self.transposed(self.program(function), weights)?))
            });
        let step = self.fused_step.as_ref().map(|step| {
            let transposed = |program| self.transposed(program, 2 * self.states.len());
            Ok(Kinds { held: transposed(&step.alone.held)?, per_stage: transposed(&step.alone.per_stage)? })
        });
        Ok(Transposes { functions: functions.collect::<Result<_, _>>()?, step: step.transpose()? })
    }

    /// The transpose of a program of which the first `counted` results have a weight.
    fn transposed(&self, program: &Program, counted: usize) -> Result<Transposed, Inconsistency> {
        // symbols behind those of the mechanism
        let mut arena = Arena::new();
        let count = self.symbol_count();
        let mut symbols = (0..count + counted).map(|_| arena.symbol("weight", Stage::Variable)).skip(count);
        let zero = Operand::Number(0.0.into());
        let weights: Vec<Operand> =
            program.outputs.iter().map(|_| symbols.next().map_or(zero, Operand::Symbol)).collect();
        let operands = program.instructions.iter().flat_map(|step| [step.a, step.b]);
        let mut by: Vec<Operand> = operands
            .chain(program.outputs.iter().copied())
            .filter(|operand| self.is_differentiated(*operand))
            .collect();
        by.sort_unstable();
        by.dedup();
        let both = program.with_adjoint(&weights, &by)?;
        let gradient = both.outputs.iter().copied().skip(program.outputs.len());
        let (outputs, by) = gradient.zip(by).filter(|(output, _)| *output != zero).unzip();
        let program = Program { outputs, ..both }.without_dead_code();
        Ok(Transposed { program, by, weights: counted })
    }

    /// True if derivatives by an operand are asked for: not by constants, times and gains, nor by what
    /// implicit stages add, which are not transposed.
    fn is_differentiated(&self, operand: Operand) -> bool {
        let Some(input) = self.input_of(operand) else { return matches!(operand, Operand::Hoisted(_)) };
        input.component().is_some() && !matches!(input, Input::Predicted(_) | Input::Weight(_))
    }
}
