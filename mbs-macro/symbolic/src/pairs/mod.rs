//! Straight-line code on pairs: two equal operations as one on two lanes.
//!
//! Processors compute on two doubles as fast as on one, but compilers are poor at
//! finding the pairs in long straight-line code. A mechanism is full of them: the x
//! and the y of a place, two angles, two stages of a step.
//!
//! 1. `choose` decides which instructions share a vector;
//! 2. `weave` writes them down, with what brings operands into their lanes, and `sines` the
//!    operations of sines and cosines;
//! 3. `order` puts each where its time comes.
//!
//! Results are those of the program, bit for bit but for the sign of a zero: lanes
//! do the same operations on the same operands. Where one lane adds and the other
//! subtracts, an operand is held with one lane negated, which is exact.
//!
//! # Which pairs pay
//!
//! A pair waits for the operands of both lanes. It is formed only if the time per step does not grow: the
//! larger of the critical path from step to step, and of the operations over the throughput (`interval`). No
//! pair waits for itself.

mod ancestors;
mod choose;
mod interval;
mod nodes;
mod order;
mod sines;
mod steps;
mod trial;
mod weave;

use std::collections::{BTreeMap, BTreeSet};

use mbs_interface::sine::SHIFT;
use rustc_hash::FxHashMap as HashMap;

pub use self::steps::{Given, Lane, Scalar, Step, Term};
use crate::arena::Symbol;
use crate::inconsistency::Inconsistency;
use crate::operators::Function;
use crate::probe;
use crate::program::{Instruction, Operand, Operation, Program};

/// A program on pairs and scalars.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Woven {
    /// The steps; each refers to earlier ones only.
    pub steps: Vec<Step>,
    /// The results.
    pub outputs: Vec<Scalar>,
}

/// Where the symbols of a program come from.
pub struct Layout<'a> {
    /// True if two symbols lie side by side in memory, so that they are read as a pair.
    pub are_neighbours: &'a dyn Fn(Symbol, Symbol) -> bool,
    /// True if two outputs do, so that they are written as a pair.
    pub are_written_together: &'a dyn Fn(usize, usize) -> bool,
    /// True if a symbol is the same in run after run of the program, so that a loop
    /// moves it into both lanes once.
    pub is_constant: &'a dyn Fn(Symbol) -> bool,
    /// The output from which the next run of the program reads a symbol.
    pub carried: &'a dyn Fn(Symbol) -> Option<usize>,
}

/// Weaves a program.
pub fn weave(program: &Program, layout: &Layout<'_>) -> Woven {
    let angles = pair_angles(program);
    let partners = choose::choose(program, &angles, layout);
    order::in_order(&weave::weave(program, &partners, &angles, layout), layout)
}

/// Two operands, as the lanes of a pair.
type Lanes = (Operand, Operand);

/// Angle → the pair of angles that it belongs to, and its lane.
type Angles = HashMap<Operand, (Lanes, Lane)>;

/// Pairs the angles whose sines and cosines can be computed at once, in their order;
/// the last of an odd number stands alone.
fn pair_angles(program: &Program) -> Angles {
    // How many turns one after the other lead to a value: those with equal numbers do
    // not depend on each other, whatever else shares vectors.
    let mut depths = Vec::with_capacity(program.instructions.len());
    let mut angles: BTreeMap<u32, Vec<Operand>> = BTreeMap::new();
    for instruction in &program.instructions {
        let depth = |operand: Operand| match operand {
            Operand::Value(at) => depths[at],
            _ => 0,
        };
        let mut of_result: u32 = depth(instruction.a).max(depth(instruction.b));
        if is_sine_or_cosine(instruction) {
            let angles = angles.entry(of_result).or_default();
            if !angles.contains(&instruction.a) {
                angles.push(instruction.a);
            }
            of_result += 1;
        }
        depths.push(of_result);
    }
    let mut lanes = Angles::default();
    for pair in angles.values().flat_map(|angles| angles.chunks(2)) {
        if let [first, second] = *pair {
            lanes.insert(first, ((first, second), Lane::First));
            lanes.insert(second, ((first, second), Lane::Second));
        } else {
            lanes.extend(pair.iter().map(|&angle| (angle, ((angle, angle), Lane::First))));
        }
    }
    lanes
}

/// How an instruction stands in a vector: with which other, and in which lane.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Partner {
    other: usize,
    lane: Lane,
}

/// The kind of operation that the instructions of a vector have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Kind {
    Sum,
    Product,
    Quotient,
    Magnitude,
}

pub(crate) fn kind(instruction: &Instruction) -> Option<Kind> {
    match instruction.operation {
        Operation::Add | Operation::Sub => Some(Kind::Sum),
        Operation::Mul => Some(Kind::Product),
        Operation::Div => Some(Kind::Quotient),
        Operation::Call(Function::Abs) => Some(Kind::Magnitude),
        _ => None,
    }
}

pub(crate) fn is_sine_or_cosine(instruction: &Instruction) -> bool {
    instruction.operation.turn().is_some()
}

/// The ways to line up the operands of two instructions of one kind beside first with first
/// and second with second: crossed where an instruction commutes. The first operand of a
/// difference is what is subtracted from.
fn crossings(x: &Instruction, y: &Instruction) -> impl Iterator<Item = [(Operand, Operand); 2]> + use<> {
    let both = commutes(x) && commutes(y) && x.operation != Operation::Mul;
    [
        commutes(x).then_some([(x.b, y.a), (x.a, y.b)]),
        commutes(y).then_some([(x.a, y.b), (x.b, y.a)]),
        both.then_some([(x.b, y.b), (x.a, y.a)]),
    ]
    .into_iter()
    .flatten()
}

/// Those among them in which different operands stand together, whatever their order.
fn matchings<'a>(
    x: &'a Instruction,
    y: &'a Instruction,
) -> impl Iterator<Item = [(&'a Operand, &'a Operand); 2]> {
    let crossed = if commutes(x) {
        Some([(&x.b, &y.a), (&x.a, &y.b)])
    } else {
        commutes(y).then_some([(&x.a, &y.b), (&x.b, &y.a)])
    };
    std::iter::once([(&x.a, &y.a), (&x.b, &y.b)]).chain(crossed)
}

fn commutes(instruction: &Instruction) -> bool {
    instruction.operation.commutes()
}

impl Woven {
    /// Runs the program.
    pub fn evaluate(
        &self,
        program: &Program,
        symbol: &dyn Fn(Symbol) -> f64,
        hoisted: &dyn Fn(usize) -> f64,
    ) -> Vec<f64> {
        let mut values: Vec<[f64; 2]> = Vec::with_capacity(self.steps.len());
        let read = |scalar: Scalar, values: &[[f64; 2]]| match scalar {
            Scalar::Given(Given::Number(number)) => number.to_f64(),
            Scalar::Given(Given::Symbol(s)) => symbol(s),
            Scalar::Given(Given::Hoisted(at)) => hoisted(at),
            Scalar::Step(at) | Scalar::Lane(at, Lane::First) => values[at][0],
            Scalar::Lane(at, Lane::Second) => values[at][1],
        };
        for step in &self.steps {
            let value = match step {
                Step::Scalar(operation, a, b, _) => {
                    let value = program.apply(*operation, read(*a, &values), read(*b, &values));
                    [value, value]
                }
                Step::Join(a, b) => [read(*a, &values), read(*b, &values)],
                Step::Splat(a) => [read(*a, &values); 2],
                Step::Swap(at) => [values[*at][1], values[*at][0]],
                Step::Flip(at) => [values[*at][0], -values[*at][1]],
                Step::Pair(operation, a, b) => {
                    [0, 1].map(|lane| program.apply(*operation, values[*a][lane], values[*b][lane]))
                }
                Step::Angles(at) => values[*at],
                Step::ShiftBack(_) => [SHIFT; 2],
                Step::Term(operation, a, b) => {
                    let [a, b] = [a, b].map(|term| match *term {
                        Term::Constant(constant) => [constant; 2],
                        Term::Step(at) => values[at],
                    });
                    [0, 1].map(|lane| program.apply(*operation, a[lane], b[lane]))
                }
                // as the program has them, not in the digits of its terms
                Step::Sines(at, _) => values[*at].map(f64::sin),
                Step::Cosines(at) => values[*at].map(f64::cos),
            };
            values.push(value);
        }
        self.outputs.iter().map(|&output| read(output, &values)).collect()
    }

    /// Checks that the steps compute what the program does that they were woven from, at
    /// numbers without any relation: bit for bit but for the sign of a zero.
    ///
    /// # Errors
    /// Some output differs.
    pub fn check(&self, program: &Program) -> Result<(), Inconsistency> {
        for point in 0..probe::POINTS {
            let expected = program.evaluate_with(&probe::symbol(point), &probe::hoisted(point));
            let found = self.evaluate(program, &probe::symbol(point), &probe::hoisted(point));
            let is_same = |(x, y): (&f64, &f64)| x == y || x.is_nan() && y.is_nan();
            if found.len() < expected.len() || !expected.iter().zip(&found).all(is_same) {
                return Err(Inconsistency {
                    pass: "weave",
                    rule: "pairs compute what their instructions do",
                });
            }
        }
        Ok(())
    }

    /// Appends an output: the sum of the first `outputs`, with some of them negated
    /// or twice, as their pairs have it. It is finite only if all of them are.
    pub fn sum_outputs(&mut self, outputs: usize) {
        let mut pairs = BTreeSet::new();
        let mut scalars = Vec::new();
        for &output in self.outputs.iter().take(outputs) {
            match output {
                Scalar::Lane(at, _) => {
                    pairs.insert(at);
                }
                _ => scalars.push(output),
            }
        }
        let sum = in_a_tree(pairs.into_iter().collect(), |a, b| self.push(Step::Pair(Operation::Add, a, b)));
        if let Some(sum) = sum {
            scalars.extend([Scalar::Lane(sum, Lane::First), Scalar::Lane(sum, Lane::Second)]);
        }
        let add = |a, b| Scalar::Step(self.push(Step::Scalar(Operation::Add, a, b, None)));
        let sum = in_a_tree(scalars, add);
        self.outputs.extend(sum);
    }

    fn push(&mut self, step: Step) -> usize {
        self.steps.push(step);
        self.steps.len() - 1
    }

    /// The number of steps of each kind: scalars, pairs, then what only moves
    /// lanes.
    pub fn census(&self) -> [usize; 6] {
        let count = |wanted: fn(&Step) -> bool| self.steps.iter().filter(|step| wanted(step)).count();
        [
            count(|step| matches!(step, Step::Scalar(..))),
            count(|step| matches!(step, Step::Pair(..))),
            count(|step| matches!(step, Step::Join(..))),
            count(|step| matches!(step, Step::Splat(..))),
            count(|step| matches!(step, Step::Swap(..))),
            count(|step| matches!(step, Step::Flip(..))),
        ]
    }
}

/// Adds neighbours until one is left: no addition waits for more than log₂ of their
/// number before it.
fn in_a_tree<T: Copy>(mut terms: Vec<T>, mut add: impl FnMut(T, T) -> T) -> Option<T> {
    while terms.len() > 1 {
        terms =
            terms.chunks(2).filter_map(|neighbours| neighbours.iter().copied().reduce(&mut add)).collect();
    }
    terms.first().copied()
}
