//! Values in order, as binary instructions.

use std::collections::HashMap;

use super::flatten::{Definition, Flat, Signed, Value};
use crate::number::Number;
use crate::program::{Instruction, Operand, Operation, Program};

pub(super) fn schedule(flat: &Flat) -> Program {
    let order = order(flat);
    let mut schedule = Schedule {
        flat,
        program: Program::default(),
        operands: HashMap::new(),
        uses: count_uses(flat, &order),
    };
    for &value in &order {
        schedule.emit(value);
    }
    schedule.program.outputs = flat.outputs.iter().map(|value| schedule.operands[value]).collect();
    schedule.program
}

struct Schedule<'a> {
    flat: &'a Flat,
    program: Program,
    operands: HashMap<Value, Operand>,
    uses: HashMap<Value, usize>,
}

impl Schedule<'_> {
    fn emit(&mut self, value: Value) {
        let operand = match &self.flat.definitions[value] {
            Definition::Leaf(operand) => *operand,
            Definition::Product(factors) => self.product(factors),
            Definition::Sum(summands) => self.sum(summands),
            Definition::Call(function, x) => {
                let x = self.operands[x];
                self.push(Operation::Call(*function), x, x)
            }
            Definition::Call2(function, x, y) => {
                let (x, y) = (self.operands[x], self.operands[y]);
                self.push(Operation::Call2(*function), x, y)
            }
            // Used in one product alone, it becomes that product's division.
            Definition::Reciprocal(_) if self.is_folded(value) => return,
            Definition::Reciprocal(x) => {
                let x = self.operands[x];
                self.push(Operation::Div, Operand::Number(Number::ONE), x)
            }
            Definition::Negative(x) => {
                let x = self.operands[x];
                self.push(Operation::Neg, x, x)
            }
        };
        if let (Operand::Value(at), Some(name)) = (operand, self.flat.names.get(&value)) {
            self.program.instructions[at].name.get_or_insert_with(|| name.clone());
        }
        self.operands.insert(value, operand);
    }

    fn push(&mut self, operation: Operation, a: Operand, b: Operand) -> Operand {
        self.program.instructions.push(Instruction { operation, a, b, name: None });
        Operand::Value(self.program.instructions.len() - 1)
    }

    fn is_folded(&self, value: Value) -> bool {
        matches!(self.flat.definitions[value], Definition::Reciprocal(_))
            && self.uses.get(&value) == Some(&1)
            && !self.flat.outputs.contains(&value)
    }

    fn product(&mut self, factors: &[Value]) -> Operand {
        let (below, above): (Vec<_>, Vec<_>) = factors.iter().partition(|&&factor| self.is_folded(factor));
        let mut product = None;
        for factor in above {
            let factor = self.operands[&factor];
            product = Some(match product {
                None => factor,
                Some(product) => self.push(Operation::Mul, product, factor),
            });
        }
        let mut product = product.unwrap_or(Operand::Number(Number::ONE));
        for factor in below {
            if let Definition::Reciprocal(x) = &self.flat.definitions[factor] {
                let divisor = self.operands[x];
                product = self.push(Operation::Div, product, divisor);
            }
        }
        product
    }

    fn sum(&mut self, summands: &[Signed]) -> Operand {
        let positive = summands.iter().position(|summand| !summand.negative);
        let first = positive.unwrap_or(0);
        let mut sum = self.operands[&summands[first].value];
        if positive.is_none() {
            sum = self.push(Operation::Neg, sum, sum);
        }
        for (at, summand) in summands.iter().enumerate() {
            if at != first {
                let operation = if summand.negative { Operation::Sub } else { Operation::Add };
                sum = self.push(operation, sum, self.operands[&summand.value]);
            }
        }
        sum
    }
}

/// The values that the outputs need, operands before users; functions of inputs
/// come first. A call in the middle would make the machine save every value that
/// is alive across it.
fn order(flat: &Flat) -> Vec<Value> {
    let order = depth_first(flat, &flat.outputs);
    let is_leaf = |value: Value| matches!(flat.definitions[value], Definition::Leaf(_));
    let of_inputs = |value: &Value| match flat.definitions[*value] {
        Definition::Call(_, x) => is_leaf(x),
        Definition::Call2(_, x, y) => is_leaf(x) && is_leaf(y),
        _ => false,
    };
    let mut roots: Vec<Value> = order.into_iter().filter(of_inputs).collect();
    roots.extend(&flat.outputs);
    depth_first(flat, &roots)
}

fn depth_first(flat: &Flat, roots: &[Value]) -> Vec<Value> {
    let mut order = Vec::new();
    let mut seen = vec![false; flat.definitions.len()];
    let mut stack: Vec<(Value, bool)> = roots.iter().rev().map(|&value| (value, false)).collect();
    while let Some((value, operands_done)) = stack.pop() {
        if operands_done {
            order.push(value);
        } else if !std::mem::replace(&mut seen[value], true) {
            stack.push((value, true));
            stack
                .extend(operands(&flat.definitions[value]).into_iter().rev().map(|operand| (operand, false)));
        }
    }
    order
}

fn operands(definition: &Definition) -> Vec<Value> {
    match definition {
        Definition::Leaf(_) => Vec::new(),
        Definition::Product(factors) => factors.clone(),
        Definition::Sum(summands) => summands.iter().map(|summand| summand.value).collect(),
        Definition::Call(_, x) | Definition::Reciprocal(x) | Definition::Negative(x) => vec![*x],
        Definition::Call2(_, x, y) => vec![*x, *y],
    }
}

/// How often each value is used in products; a use elsewhere counts twice, so
/// that it never looks like a single use in a product.
fn count_uses(flat: &Flat, order: &[Value]) -> HashMap<Value, usize> {
    let mut uses = HashMap::new();
    for &value in order {
        let definition = &flat.definitions[value];
        let weight = if matches!(definition, Definition::Product(_)) { 1 } else { 2 };
        for operand in operands(definition) {
            *uses.entry(operand).or_insert(0) += weight;
        }
    }
    uses
}
