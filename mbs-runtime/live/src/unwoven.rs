//! A step on pairs of numbers as one on single numbers, which are what slots hold.

use std::collections::HashMap;

use mbs_symbolic::pairs::{Given, Lane, Scalar, Step, Woven};
use mbs_symbolic::{Function, Inconsistency, Instruction, Operand, Operation, Program, probe};

/// The program of the first outputs of a woven one, to the bit: the pairs are undone, and
/// lanes that were negated are subtracted where they would be added.
///
/// # Errors
/// The program does not compute what the pairs do, which is a mistake of this crate.
pub fn unwoven(woven: &Woven, of: &Program, outputs: usize) -> Result<Program, Inconsistency> {
    let mut thread = Thread::default();
    let mut lanes: Vec<[Signed; 2]> = Vec::with_capacity(woven.steps.len());
    for step in &woven.steps {
        let lane = thread.step(step, &lanes);
        lanes.push(lane);
    }
    let results = woven.outputs.iter().take(outputs).map(|&output| {
        let value = scalar(output, &lanes);
        thread.plain(value)
    });
    let results = results.collect();
    let program =
        Program { instructions: thread.instructions, outputs: results, splines: of.splines.clone() };
    let program = program.without_dead_code();
    check(woven, &program)?;
    Ok(program)
}

/// Both give the same at numbers without any relation, to the bit.
fn check(woven: &Woven, program: &Program) -> Result<(), Inconsistency> {
    for point in 0..probe::POINTS {
        let (symbol, hoisted) = (probe::symbol(point), probe::hoisted(point));
        let expected = woven.evaluate(program, &symbol, &hoisted);
        let found = program.evaluate_with(&symbol, &hoisted);
        let is_same = |(x, y): (&f64, &f64)| x.to_bits() == y.to_bits() || x.is_nan() && y.is_nan();
        if found.len() > expected.len() || !expected.iter().zip(&found).all(is_same) {
            return Err(Inconsistency { pass: "unwoven", rule: "a program computes what its pairs do" });
        }
    }
    Ok(())
}

/// A value, or its negative.
#[derive(Clone, Copy)]
struct Signed {
    operand: Operand,
    is_negative: bool,
}

impl Signed {
    fn plain(operand: Operand) -> Self {
        Self { operand, is_negative: false }
    }

    fn negative(self) -> Self {
        Self { is_negative: !self.is_negative, ..self }
    }
}

fn scalar(scalar: Scalar, lanes: &[[Signed; 2]]) -> Signed {
    match scalar {
        Scalar::Given(Given::Number(number)) => Signed::plain(Operand::Number(number)),
        Scalar::Given(Given::Symbol(symbol)) => Signed::plain(Operand::Symbol(symbol)),
        Scalar::Given(Given::Hoisted(at)) => Signed::plain(Operand::Hoisted(at)),
        Scalar::Step(at) | Scalar::Lane(at, Lane::First) => lanes[at][0],
        Scalar::Lane(at, Lane::Second) => lanes[at][1],
    }
}

/// Instructions one after the other, none of them twice.
#[derive(Default)]
struct Thread {
    instructions: Vec<Instruction>,
    known: HashMap<(Operation, Operand, Operand), Operand>,
}

impl Thread {
    /// What a step of the woven program gives, in both lanes.
    fn step(&mut self, step: &Step, lanes: &[[Signed; 2]]) -> [Signed; 2] {
        match step {
            Step::Scalar(operation, a, b, _) => {
                [self.apply(*operation, scalar(*a, lanes), scalar(*b, lanes)); 2]
            }
            Step::Join(a, b) => [scalar(*a, lanes), scalar(*b, lanes)],
            Step::Splat(a) => [scalar(*a, lanes); 2],
            Step::Swap(at) => [lanes[*at][1], lanes[*at][0]],
            Step::Flip(at) => [lanes[*at][0], lanes[*at][1].negative()],
            Step::Pair(operation, a, b) => {
                let (a, b) = (lanes[*a], lanes[*b]);
                [self.apply(*operation, a[0], b[0]), self.apply(*operation, a[1], b[1])]
            }
            Step::Sines(at) => lanes[*at].map(|a| self.apply(Operation::Call(Function::Sin), a, a)),
            Step::Cosines(at) => lanes[*at].map(|a| self.apply(Operation::Call(Function::Cos), a, a)),
        }
    }

    /// An operation on values and negatives. Each rule is exact, signs of zeros included.
    fn apply(&mut self, operation: Operation, a: Signed, b: Signed) -> Signed {
        let is_negative = a.is_negative != b.is_negative;
        match (operation, a.is_negative, b.is_negative) {
            // x + (−y) = x − y, (−x) + y = y − x
            (Operation::Add, false, true) => Signed::plain(self.push(Operation::Sub, a.operand, b.operand)),
            (Operation::Add, true, false) => Signed::plain(self.push(Operation::Sub, b.operand, a.operand)),
            // x − (−y) = x + y, (−x) − (−y) = y − x
            (Operation::Sub, false, true) => Signed::plain(self.push(Operation::Add, a.operand, b.operand)),
            (Operation::Sub, true, true) => Signed::plain(self.push(Operation::Sub, b.operand, a.operand)),
            // signs of products and quotients do not depend on their sizes
            (Operation::Mul | Operation::Div, ..) => {
                Signed { operand: self.push(operation, a.operand, b.operand), is_negative }
            }
            (Operation::Neg, ..) => a.negative(),
            // (−x) + (−y) and (−x) − y are sums whose zeros would change their sign
            (
                Operation::Add
                | Operation::Sub
                | Operation::Call(_)
                | Operation::Call2(_)
                | Operation::Spline(..),
                ..,
            ) => {
                let (a, b) = (self.plain(a), self.plain(b));
                Signed::plain(self.push(operation, a, b))
            }
        }
    }

    /// The value itself.
    fn plain(&mut self, value: Signed) -> Operand {
        match value {
            Signed { operand, is_negative: false } => operand,
            Signed { operand, is_negative: true } => self.push(Operation::Neg, operand, operand),
        }
    }

    fn push(&mut self, operation: Operation, a: Operand, b: Operand) -> Operand {
        *self.known.entry((operation, a, b)).or_insert_with(|| {
            self.instructions.push(Instruction { operation, a, b, name: None });
            Operand::Value(self.instructions.len() - 1)
        })
    }
}

#[cfg(test)]
mod tests {
    use mbs_codegen::{FunctionId, analyse};

    use super::*;

    /// In the plane, so that x and y share pairs.
    const DECLARATION: &str = "Pendulum {
        dof = 1;
        param l = 1 [m];
        gravity = (0, -9.81) [m/s^2];
        body rod (x, y, theta) { mass = 2 [kg]; inertia = 1 [kg*m^2]; }
        constraint pin_x: x = l*cos(theta);
        constraint pin_y: y = l*sin(theta);
        start { theta = 0.3; guess x = l; guess y = 0; }
    }";

    #[test]
    fn every_wrong_operation_is_caught() {
        let compiled = analyse(DECLARATION.parse().unwrap()).unwrap();
        let woven = &compiled.fused_step.as_ref().unwrap().alone.held;
        let outputs = 2 * compiled.coordinates.len() + 1;
        let right = unwoven(woven, compiled.program(FunctionId::Stabilized), outputs).unwrap();
        let has_subtractions = right.instructions.iter().any(|step| step.operation == Operation::Sub);
        assert!(has_subtractions && woven.steps.iter().any(|step| matches!(step, Step::Flip(_))));
        for at in 0..right.instructions.len() {
            let mut wrong = right.clone();
            let operation = &mut wrong.instructions[at].operation;
            *operation = match *operation {
                Operation::Add => Operation::Sub,
                Operation::Sub => Operation::Add,
                Operation::Mul => Operation::Div,
                _ => Operation::Mul,
            };
            assert!(check(woven, &wrong).is_err(), "instruction {at}: {:?}", right.instructions[at]);
        }
    }
}
