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
        summands: Summands::new(flat, &order),
    };
    for &value in &order {
        schedule.emit(value);
        schedule.gather(value);
    }
    schedule.program.outputs = outputs.iter().map(|value| schedule.operands[value]).collect();
    schedule.program
}

/// Rows with more terms or factors than this are gathered one after the other.
const LONGEST_TREE: usize = 32;

/// Programs of more values than this, which may become loops, are ordered by
/// the pivots that they wait for.
const LONGEST_ON_DEMAND: usize = 1024;

struct Schedule<'a> {
    flat: &'a Flat,
    outputs: &'a [Value],
    program: Program,
    operands: HashMap<Value, Operand>,
    uses: HashMap<Value, usize>,
    /// Per instruction, how long its result takes from the inputs.
    latencies: Vec<u32>,
    summands: Summands,
}

/// Very long sums, which grow as soon as a summand is there.
struct Summands {
    /// Value → the sums that it belongs to, and whether it is subtracted.
    of: HashMap<Value, Vec<(Value, bool)>>,
    /// The sum so far, and whether it is the negative of it.
    gathered: HashMap<Value, (Operand, bool)>,
}

impl Summands {
    fn new(flat: &Flat, order: &[Value]) -> Self {
        let mut of: HashMap<Value, Vec<(Value, bool)>> = HashMap::new();
        for &sum in order {
            if let Some(row) = long_row(flat, sum) {
                row.iter().for_each(|s| of.entry(s.value).or_default().push((sum, s.negative)));
            }
        }
        Self { of, gathered: HashMap::new() }
    }
}

/// The summands of a very long sum.
fn long_row(flat: &Flat, value: Value) -> Option<&[Signed]> {
    match &flat.definitions[value] {
        Definition::Sum(row) if row.len() > LONGEST_TREE => Some(row),
        _ => None,
    }
}

impl Schedule<'_> {
    fn emit(&mut self, value: Value) {
        let operand = match &self.flat.definitions[value] {
            Definition::Leaf(operand) => *operand,
            Definition::Product(factors) => self.product(factors),
            Definition::Sum(summands) => match self.summands.gathered.remove(&value) {
                Some(gathered) => self.positive(gathered),
                None => self.sum(summands),
            },
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
        let sum = self.reduce(operands, Self::add, |&(operand, _)| operand);
        sum.map_or(Operand::Number(Number::ZERO), |sum| self.positive(sum))
    }

    /// The sum of two values, each perhaps given as its negative.
    fn add(&mut self, (a, minus_a): (Operand, bool), (b, minus_b): (Operand, bool)) -> (Operand, bool) {
        match (minus_a, minus_b) {
            (false, true) => (self.push(Operation::Sub, a, b), false),
            (true, false) => (self.push(Operation::Sub, b, a), false),
            (_, both) => (self.push(Operation::Add, a, b), both),
        }
    }

    fn positive(&mut self, (value, is_negative): (Operand, bool)) -> Operand {
        if is_negative { self.push(Operation::Neg, value, value) } else { value }
    }

    /// Adds a value to the very long sums that it belongs to: the same instruction
    /// in every copy of what gives the summands.
    fn gather(&mut self, value: Value) {
        for (sum, negative) in self.summands.of.remove(&value).unwrap_or_default() {
            let mut gathered = (self.operands[&value], negative);
            if let Some(so_far) = self.summands.gathered.remove(&sum) {
                gathered = self.add(so_far, gathered);
            }
            self.summands.gathered.insert(sum, gathered);
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
    let mut roots: Vec<Value> = order.iter().copied().filter(of_inputs).collect();
    if order.len() <= LONGEST_ON_DEMAND {
        roots.extend(outputs);
        return depth_first(flat, &roots);
    }
    Eager::new(flat, order, depth_first(flat, &roots)).run()
}

/// Orders a long program for loops: what needs a pivot stands right behind what it
/// waits for, short branches first, and the rest where it is first needed. Pivots
/// wait for each other; the right-hand sides, the watch and the next link fill that time,
/// and most results are used in the copy that computes them.
struct Eager<'a> {
    flat: &'a Flat,
    /// Depth first.
    values: Vec<Value>,
    /// Whether a value needs a pivot.
    is_late: Vec<bool>,
    users: Vec<Vec<Value>>,
    is_done: Vec<bool>,
    order: Vec<Value>,
}

impl<'a> Eager<'a> {
    fn new(flat: &'a Flat, values: Vec<Value>, first: Vec<Value>) -> Self {
        let count = flat.definitions.len();
        let mut is_late = vec![false; count];
        let mut users = vec![Vec::new(); count];
        for &value in &values {
            let definition = &flat.definitions[value];
            let operands = operands(definition);
            is_late[value] =
                matches!(definition, Definition::Reciprocal(_)) || operands.iter().any(|&o| is_late[o]);
            operands.into_iter().for_each(|operand| users[operand].push(value));
        }
        // how many operations lie between a value and the last one that waits for it
        let mut heights = vec![0_usize; count];
        for &value in values.iter().rev() {
            heights[value] = users[value].iter().map(|&user| heights[user] + 1).max().unwrap_or(0);
        }
        // what is tried last comes first
        users.iter_mut().for_each(|users| users.sort_by_key(|&user| std::cmp::Reverse(heights[user])));
        let mut is_done = vec![false; count];
        first.iter().for_each(|&value| is_done[value] = true);
        Self { flat, values, is_late, users, is_done, order: first }
    }

    fn run(mut self) -> Vec<Value> {
        let values = std::mem::take(&mut self.values);
        for &value in &values {
            let mut stack = vec![value];
            while let Some(value) = stack.pop() {
                let operands = operands(&self.flat.definitions[value]);
                let is_ready = operands.iter().all(|&operand| self.is_done[operand] || !self.is_late[operand]);
                if !self.is_late[value] || self.is_done[value] || !is_ready {
                    continue;
                }
                self.demand(value);
                stack.extend(&self.users[value]);
            }
        }
        values.into_iter().for_each(|value| self.demand(value));
        self.order
    }

    /// The value, behind those of its operands that are not there yet.
    fn demand(&mut self, value: Value) {
        let mut stack = vec![(value, false)];
        while let Some((value, operands_done)) = stack.pop() {
            if operands_done {
                self.order.push(value);
            } else if !std::mem::replace(&mut self.is_done[value], true) {
                stack.push((value, true));
                let operands = operands(&self.flat.definitions[value]);
                stack.extend(operands.into_iter().rev().map(|operand| (operand, false)));
            }
        }
    }
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
