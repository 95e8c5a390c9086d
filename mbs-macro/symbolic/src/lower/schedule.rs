//! Values in order, as binary instructions.

use std::collections::HashMap;

use super::flatten::{Definition, Flat, Signed, Value};
use crate::number::Number;
use crate::program::{Instruction, Operand, Operation, Program};

pub(super) fn schedule(flat: &Flat, outputs: &[Value]) -> Program {
    let order = order(flat, outputs);
    let mut schedule = Schedule {
        flat,
        outputs,
        program: Program::default(),
        operands: HashMap::new(),
        uses: count_uses(flat, &order),
        latencies: Vec::new(),
    };
    for &value in &order {
        schedule.emit(value);
    }
    schedule.program.outputs = outputs.iter().map(|value| schedule.operands[value]).collect();
    schedule.program
}

/// Rows with more terms or factors than this are gathered one after the other.
const LONGEST_TREE: usize = 32;

struct Schedule<'a> {
    flat: &'a Flat,
    outputs: &'a [Value],
    program: Program,
    operands: HashMap<Value, Operand>,
    uses: HashMap<Value, usize>,
    /// Per instruction, how long its result takes from the inputs.
    latencies: Vec<u32>,
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
            Definition::Spline(spline, order, x) => {
                let x = self.operands[x];
                self.push(Operation::Spline(*spline, *order), x, x)
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
        self.latencies.push(self.latency(a).max(self.latency(b)) + operation.latency());
        self.program.instructions.push(Instruction { operation, a, b, name: None });
        Operand::Value(self.program.instructions.len() - 1)
    }

    fn is_folded(&self, value: Value) -> bool {
        matches!(self.flat.definitions[value], Definition::Reciprocal(_))
            && self.uses.get(&value) == Some(&1)
            && !self.outputs.contains(&value)
    }

    fn product(&mut self, factors: &[Value]) -> Operand {
        let (below, above): (Vec<_>, Vec<_>) = factors.iter().partition(|&&factor| self.is_folded(factor));
        let above: Vec<_> = above.into_iter().map(|factor| self.operands[factor]).collect();
        let multiply = |schedule: &mut Self, a, b| schedule.push(Operation::Mul, a, b);
        let product = self.reduce(above, multiply, |&factor| factor);
        let mut product = product.unwrap_or(Operand::Number(Number::ONE));
        for factor in below {
            if let Definition::Reciprocal(x) = &self.flat.definitions[*factor] {
                let divisor = self.operands[x];
                product = self.push(Operation::Div, product, divisor);
            }
        }
        product
    }

    fn sum(&mut self, summands: &[Signed]) -> Operand {
        let operands =
            summands.iter().map(|summand| (self.operands[&summand.value], summand.negative)).collect();
        let add = |schedule: &mut Self, (a, minus_a), (b, minus_b)| match (minus_a, minus_b) {
            (false, true) => (schedule.push(Operation::Sub, a, b), false),
            (true, false) => (schedule.push(Operation::Sub, b, a), false),
            (_, both) => (schedule.push(Operation::Add, a, b), both),
        };
        match self.reduce(operands, add, |&(operand, _)| operand) {
            Some((sum, true)) => self.push(Operation::Neg, sum, sum),
            Some((sum, false)) => sum,
            None => Operand::Number(Number::ZERO),
        }
    }

    /// Combines two operands at a time, those first that are there first, so
    /// that the result waits for as few operations as possible. `None` of none.
    ///
    /// Very long rows are gathered in their order: the same instruction over and
    /// over, which can become a loop.
    fn reduce<T: Copy>(
        &mut self,
        mut operands: Vec<T>,
        combine: impl Fn(&mut Self, T, T) -> T,
        operand: impl Fn(&T) -> Operand,
    ) -> Option<T> {
        if operands.len() > LONGEST_TREE {
            return operands.into_iter().reduce(|sum, next| combine(self, sum, next));
        }
        loop {
            // Stable, latest first: ties keep the order of the row.
            operands.sort_by_key(|item| std::cmp::Reverse(self.latency(operand(item))));
            let first = operands.pop()?;
            let Some(second) = operands.pop() else { return Some(first) };
            let combined = combine(self, first, second);
            operands.push(combined);
        }
    }

    fn latency(&self, operand: Operand) -> u32 {
        match operand {
            Operand::Value(at) => self.latencies[at],
            _ => 0,
        }
    }
}

/// The values that the outputs need, operands before users; functions of inputs
/// come first. A call in the middle would make the machine save every value that
/// is alive across it.
fn order(flat: &Flat, outputs: &[Value]) -> Vec<Value> {
    let order = depth_first(flat, outputs);
    let is_leaf = |value: Value| matches!(flat.definitions[value], Definition::Leaf(_));
    let of_inputs = |value: &Value| match flat.definitions[*value] {
        Definition::Call(_, x) | Definition::Spline(.., x) => is_leaf(x),
        Definition::Call2(_, x, y) => is_leaf(x) && is_leaf(y),
        _ => false,
    };
    let mut roots: Vec<Value> = order.into_iter().filter(of_inputs).collect();
    roots.extend(outputs);
    gather_early(flat, outputs, depth_first(flat, &roots))
}

/// Moves what only very long sums need to where its operands are: the watch over a
/// pivot beside the pivot, where it fills the time that others wait for it.
fn gather_early(flat: &Flat, outputs: &[Value], order: Vec<Value>) -> Vec<Value> {
    let is_long =
        |value: Value| matches!(&flat.definitions[value], Definition::Sum(row) if row.len() > LONGEST_TREE);
    if !order.iter().any(|&value| is_long(value)) {
        return order;
    }
    // users stand behind what they use
    let mut is_needed = vec![false; flat.definitions.len()];
    outputs.iter().for_each(|&output| is_needed[output] = true);
    for &value in order.iter().rev().filter(|&&value| !is_long(value)) {
        if is_needed[value] {
            operands(&flat.definitions[value]).into_iter().for_each(|operand| is_needed[operand] = true);
        }
    }
    let mut places = vec![0; flat.definitions.len()];
    for (place, &value) in order.iter().enumerate() {
        let behind = operands(&flat.definitions[value]).into_iter().map(|operand| places[operand]).max();
        places[value] = if is_needed[value] { place } else { behind.unwrap_or(place) };
    }
    let mut order = order;
    order.sort_by_key(|&value| places[value]);
    order
}

pub(super) fn depth_first(flat: &Flat, roots: &[Value]) -> Vec<Value> {
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

pub(super) fn operands(definition: &Definition) -> Vec<Value> {
    match definition {
        Definition::Leaf(_) => Vec::new(),
        Definition::Product(factors) => factors.clone(),
        Definition::Sum(summands) => summands.iter().map(|summand| summand.value).collect(),
        Definition::Call(_, x)
        | Definition::Spline(.., x)
        | Definition::Reciprocal(x)
        | Definition::Negative(x) => vec![*x],
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
