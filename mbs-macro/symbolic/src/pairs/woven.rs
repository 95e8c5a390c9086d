//! A program on pairs, and its check against the program that it was woven from.

use std::collections::BTreeSet;

use mbs_interface::sine::SHIFT;

use super::steps::{Given, Lane, Scalar, Step, Term};
use crate::arena::Symbol;
use crate::inconsistency::Inconsistency;
use crate::probe;
use crate::program::{Operation, Program};

/// A program on pairs and scalars.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Woven {
    /// The steps; each refers to earlier ones only.
    pub steps: Vec<Step>,
    /// The results.
    pub outputs: Vec<Scalar>,
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
