//! Tangents of programs, which exact derivatives along a direction are made of.
//!
//! The C target prints them where they are asked for, for functional mock-up units.

use std::collections::BTreeSet;

use mbs_symbolic::{Arena, Inconsistency, Operand, Program, Stage, Symbol};

use super::{Argument, Compiled, FunctionId, Input, Results, Vector};

impl Compiled {
    /// The derivatives of the results of a function, its pivot growth left out, along a direction.
    ///
    /// The direction has a number ([`Input::Weight`]) for the time and for each component of the
    /// function's arguments, in the order of the arguments and without gains:
    /// ṙₖ = Σᵢ ∂resultₖ/∂argumentᵢ · directionᵢ. Of reactions the accelerations come before the
    /// multipliers. The program is made when this is called.
    ///
    /// # Example
    /// ```
    /// use mbs_codegen::{FunctionId, analyse};
    ///
    /// let declaration = "Block { dof = 1; param k = 4 [N/m]; body block (x) { mass = 2 [kg]; }
    ///     force spring on x = -k*x; start { x = 1 [m]; } }";
    /// let compiled = analyse(declaration.parse()?)?;
    /// // t, x and its rate
    /// assert_eq!(compiled.directions(FunctionId::Stabilized), 3);
    /// let slope = compiled.tangent(FunctionId::Stabilized)?;
    /// assert_eq!(slope.outputs.len(), 1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A mistake of the compiler.
    pub fn tangent(&self, function: FunctionId) -> Result<Program, Inconsistency> {
        let program = self.program(function);
        let counted = function.results().iter().filter(|result| **result != Results::Growth);
        let counted: usize = counted.map(|result| self.length(*result)).sum();
        // symbols behind those of the mechanism
        let (mut arena, count) = (Arena::new(), self.symbol_count());
        let symbols = (0..count + self.directions(function)).map(|_| arena.symbol("weight", Stage::Variable));
        let weights: Vec<Symbol> = symbols.skip(count).collect();
        let operands = program.instructions.iter().flat_map(|step| [step.a, step.b]);
        let inputs: BTreeSet<Operand> = operands.chain(program.outputs.iter().copied()).collect();
        let direction = inputs.into_iter().filter_map(|operand| {
            let place = self.place_in_direction(function, self.input_of(operand)?)?;
            Some((operand, Operand::Symbol(*weights.get(place)?)))
        });
        let counted =
            Program { outputs: program.outputs.iter().take(counted).copied().collect(), ..program.clone() };
        counted.without_dead_code().along(&direction.collect::<Vec<_>>())
    }

    /// The length of a direction, along which a function is differentiated.
    pub fn directions(&self, function: FunctionId) -> usize {
        function.arguments().iter().flat_map(|argument| self.parts(*argument)).map(|(_, length)| length).sum()
    }

    /// Where the number of an input stands in a direction.
    fn place_in_direction(&self, function: FunctionId, input: Input) -> Option<usize> {
        let (wanted, place) = match (input, input.component()) {
            (Input::Time, _) => (None, 0),
            (_, component) => component.map(|it| (Some(it.vector), it.place))?,
        };
        let mut before = 0;
        for (part, length) in function.arguments().iter().flat_map(|argument| self.parts(*argument)) {
            // where all coordinates are integrated, functions of states read these
            let is_part = part == wanted
                || !self.has_reduced_states()
                    && matches!(
                        (part, wanted),
                        (Some(Vector::StatePositions), Some(Vector::Positions))
                            | (Some(Vector::StateVelocities), Some(Vector::Velocities))
                    );
            if is_part {
                return Some(before + place);
            }
            before += length;
        }
        None
    }

    /// The parts of an argument that a direction has numbers for, with their lengths: the time, which is no
    /// vector, or vectors.
    fn parts(&self, argument: Argument) -> Vec<(Option<Vector>, usize)> {
        let vectors: &[Vector] = match argument {
            Argument::Time => return vec![(None, 1)],
            Argument::Positions => &[Vector::Positions],
            Argument::Velocities => &[Vector::Velocities],
            Argument::StatePositions => &[Vector::StatePositions],
            Argument::StateVelocities => &[Vector::StateVelocities],
            Argument::Inputs => &[Vector::Inputs],
            Argument::Feedback => &[Vector::Feedback],
            Argument::Reactions => &[Vector::Accelerations, Vector::Multipliers],
            Argument::Predicted => &[Vector::Predicted],
            Argument::Gains | Argument::Shift => &[],
        };
        vectors.iter().map(|vector| (Some(*vector), self.components(*vector))).collect()
    }
}
