//! Straight-line programs in static single assignment form.
//!
//! One program serves several readers. The closure check and tests evaluate it. Documentation and goldens
//! count its operations. Targets print it.

use std::collections::BTreeSet;
use std::fmt;
use std::rc::Rc;

use crate::arena::Symbol;
use crate::arithmetic::Numeric;
use crate::number::Number;
use crate::operators::Function;
use crate::spline::{Spline, SplineId};

/// Where an instruction finds an operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Operand {
    /// A constant.
    Number(Number),
    /// An input of the program.
    Symbol(Symbol),
    /// A value that depends on parameters alone, computed beforehand.
    Hoisted(usize),
    /// The result of an earlier instruction.
    Value(usize),
}

/// The operation of an instruction on its operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Operation {
    /// a + b
    Add,
    /// a − b
    Sub,
    /// a·b
    Mul,
    /// a/b
    Div,
    /// −a
    Neg,
    /// f(a, b), or f(a)
    Call(Function),
    /// the derivative of this order of a spline at a
    Spline(SplineId, u8),
}

impl Operation {
    /// Roughly how many cycles today's processors take.
    pub(crate) fn latency(self) -> u32 {
        match self {
            Self::Add | Self::Sub | Self::Mul => 4,
            Self::Neg => 1,
            Self::Div => 14,
            Self::Call(function) => function.row().latency,
            Self::Spline(..) => 50,
        }
    }

    /// The number of its operands.
    pub fn arity(self) -> usize {
        match self {
            Self::Add | Self::Sub | Self::Mul | Self::Div => 2,
            Self::Neg | Self::Spline(..) => 1,
            Self::Call(function) => function.row().arity,
        }
    }

    /// True if it is the same, to the bit, with its operands exchanged.
    pub(crate) fn commutes(self) -> bool {
        matches!(self, Self::Add | Self::Mul)
    }

    /// The sine or cosine that it is.
    pub fn turn(self) -> Option<Function> {
        match self {
            Self::Call(function) if function.is_turn() => Some(function),
            _ => None,
        }
    }
}

/// One assignment. `b` equals `a` where the operation has one operand.
#[derive(Clone, Debug, PartialEq)]
pub struct Instruction {
    /// The operation.
    pub operation: Operation,
    /// The first operand.
    pub a: Operand,
    /// The second operand.
    pub b: Operand,
    /// A name for the result, if one was suggested.
    pub name: Option<String>,
}

/// Instructions in order, and which values are results.
///
/// An instruction refers to earlier ones only, every instruction is needed by
/// an output, and no two compute the same.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// The instructions.
    pub instructions: Vec<Instruction>,
    /// The results.
    pub outputs: Vec<Operand>,
    /// The splines that instructions refer to.
    pub splines: Vec<Rc<Spline>>,
}

/// Operation counts; see the fields.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Multiplications.
    pub mul: u32,
    /// Additions, subtractions and negations.
    pub add: u32,
    /// Divisions.
    pub div: u32,
    /// Sine–cosine pairs (a sine or cosine alone counts as one).
    pub sin_cos: u32,
    /// Other elementary functions, comparisons, square roots and splines.
    pub other: u32,
}

impl Operations {
    /// mul + add + div
    pub fn arithmetic(&self) -> u32 {
        self.mul + self.add + self.div
    }

    /// All of them.
    pub fn total(&self) -> u32 {
        self.arithmetic() + self.sin_cos + self.other
    }
}

impl fmt::Display for Operations {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} mul + {} add + {} div + {} sincos", self.mul, self.add, self.div, self.sin_cos)?;
        if self.other > 0 { write!(f, " + {} other", self.other) } else { Ok(()) }
    }
}

impl Instruction {
    /// The operands that it has.
    pub fn operands(&self) -> impl Iterator<Item = Operand> {
        [self.a, self.b].into_iter().take(self.operation.arity())
    }
}

impl Program {
    /// How long the longest chain of operations takes that wait for each other, in cycles.
    pub fn critical_path(&self) -> u32 {
        self.latencies().into_iter().max().unwrap_or(0)
    }

    /// For every instruction how long its result takes from the inputs, in cycles.
    pub(crate) fn latencies(&self) -> Vec<u32> {
        let mut latencies: Vec<u32> = Vec::with_capacity(self.instructions.len());
        for instruction in &self.instructions {
            let of = |operand: Operand| match operand {
                Operand::Value(at) => latencies[at],
                _ => 0,
            };
            latencies.push(of(instruction.a).max(of(instruction.b)) + instruction.operation.latency());
        }
        latencies
    }

    /// The operations of the whole program.
    pub fn operations(&self) -> Operations {
        self.count(0..self.instructions.len())
    }

    /// The operations that the first `outputs` results need.
    pub fn operations_for(&self, outputs: usize) -> Operations {
        let needed = self.needed_for(outputs);
        self.count((0..needed.len()).filter(|&at| needed[at]))
    }

    /// Which instructions the first `outputs` results need.
    fn needed_for(&self, outputs: usize) -> Vec<bool> {
        let mut needed = vec![false; self.instructions.len()];
        let mut mark = |operand: &Operand| {
            if let Operand::Value(at) = operand {
                needed[*at] = true;
            }
        };
        self.outputs.iter().take(outputs).for_each(&mut mark);
        for at in (0..self.instructions.len()).rev() {
            if needed[at] {
                for operand in [self.instructions[at].a, self.instructions[at].b] {
                    if let Operand::Value(earlier) = operand {
                        needed[earlier] = true;
                    }
                }
            }
        }
        needed
    }

    /// The program without instructions that no output needs.
    #[must_use]
    pub fn without_dead_code(self) -> Self {
        let needed = self.needed_for(self.outputs.len());
        let mut positions = Vec::with_capacity(needed.len());
        let mut count = 0;
        for &is_needed in &needed {
            positions.push(count);
            count += usize::from(is_needed);
        }
        let moved = |operand: Operand| match operand {
            Operand::Value(at) => Operand::Value(positions[at]),
            _ => operand,
        };
        let instructions = self.instructions.into_iter().zip(&needed).filter(|(_, is_needed)| **is_needed);
        Self {
            instructions: instructions
                .map(|(i, _)| Instruction { a: moved(i.a), b: moved(i.b), ..i })
                .collect(),
            outputs: self.outputs.into_iter().map(moved).collect(),
            splines: self.splines,
        }
    }

    fn count(&self, instructions: impl Iterator<Item = usize>) -> Operations {
        let mut count = Operations::default();
        let mut angles = BTreeSet::new();
        for at in instructions {
            let instruction = &self.instructions[at];
            match instruction.operation {
                Operation::Mul => count.mul += 1,
                Operation::Add | Operation::Sub | Operation::Neg => count.add += 1,
                Operation::Div => count.div += 1,
                Operation::Call(function) if function.is_turn() => {
                    angles.insert(instruction.a);
                }
                Operation::Call(_) | Operation::Spline(..) => count.other += 1,
            }
        }
        count.sin_cos = angles.len() as u32;
        count
    }

    /// Which inputs each result depends on, as the instructions have it: where one is multiplied by
    /// what happens to be 0, too.
    ///
    /// # Example
    /// ```
    /// use mbs_symbolic::{Arena, Operand, Stage, lower_whole};
    ///
    /// let mut arena = Arena::new();
    /// let [x, y] = ["x", "y"].map(|name| arena.symbol(name, Stage::Variable));
    /// let [of_x, of_y] = [x, y].map(|symbol| arena.variable(symbol));
    /// let product = arena.mul(of_x, of_y);
    /// let program = lower_whole(&mut arena, &[product, of_y], 1024)?;
    /// let reads = program.reads();
    /// assert_eq!(reads[0].iter().collect::<Vec<_>>(), [&x, &y]);
    /// assert_eq!(reads[1].iter().collect::<Vec<_>>(), [&y]);
    /// # Ok::<(), mbs_symbolic::Inconsistency>(())
    /// ```
    pub fn reads(&self) -> Vec<BTreeSet<Symbol>> {
        let mut all: Vec<BTreeSet<Symbol>> = Vec::with_capacity(self.instructions.len());
        let of = |operand: Operand, all: &[BTreeSet<Symbol>]| match operand {
            Operand::Symbol(symbol) => BTreeSet::from([symbol]),
            Operand::Value(at) => all[at].clone(),
            Operand::Number(_) | Operand::Hoisted(_) => BTreeSet::new(),
        };
        for instruction in &self.instructions {
            let mut read = of(instruction.a, &all);
            read.extend(of(instruction.b, &all));
            all.push(read);
        }
        self.outputs.iter().map(|output| of(*output, &all)).collect()
    }

    /// An operation on numbers.
    pub fn apply<T: Numeric>(&self, operation: Operation, a: T, b: T) -> T {
        match operation {
            Operation::Add => a + b,
            Operation::Sub => a - b,
            Operation::Mul => a * b,
            Operation::Div => a / b,
            Operation::Neg => -a,
            Operation::Call(function) => a.call(function, b),
            Operation::Spline(spline, order) => a.spline(&self.splines[spline.index()], order),
        }
    }

    /// Runs the program.
    pub fn evaluate(&self, symbol: &dyn Fn(Symbol) -> f64, hoisted: &[f64]) -> Vec<f64> {
        self.evaluate_with(symbol, &|at| hoisted[at])
    }

    /// Runs the program in any kind of number, with hoisted values from a function.
    pub fn evaluate_with<T: Numeric>(
        &self,
        symbol: &dyn Fn(Symbol) -> T,
        hoisted: &dyn Fn(usize) -> T,
    ) -> Vec<T> {
        let mut values: Vec<T> = Vec::with_capacity(self.instructions.len());
        let read = |operand: Operand, values: &[T]| match operand {
            Operand::Number(number) => T::number(number),
            Operand::Symbol(s) => symbol(s),
            Operand::Hoisted(at) => hoisted(at),
            Operand::Value(at) => values[at],
        };
        for instruction in &self.instructions {
            let (a, b) = (read(instruction.a, &values), read(instruction.b, &values));
            values.push(self.apply(instruction.operation, a, b));
        }
        self.outputs.iter().map(|&output| read(output, &values)).collect()
    }
}
