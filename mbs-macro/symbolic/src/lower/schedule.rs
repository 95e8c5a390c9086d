//! Values in order, as binary instructions.

use rustc_hash::FxHashMap as HashMap;

use super::flatten::{Definition, Flat, Signed, Value};
use super::fusion::fuse;
use super::order::order;
use crate::number::Number;
use crate::program::{Instruction, Operand, Operation, Program};

pub(super) fn schedule(flat: &Flat, outputs: &[Value], unrolled: usize) -> Program {
    let order = order(flat, outputs, unrolled);
    let (program, starts) = in_order(flat, outputs, &order);
    if order.len() <= unrolled {
        return program;
    }
    let order = fuse(flat, &order, &starts, &program);
    in_order(flat, outputs, &order).0
}

/// The program, and with which instruction each value begins.
fn in_order(flat: &Flat, outputs: &[Value], order: &[Value]) -> (Program, Vec<usize>) {
    let mut schedule = Schedule {
        flat,
        outputs,
        program: Program::default(),
        // none is asked for before it is there
        operands: vec![Operand::Number(Number::ZERO); flat.definitions.len()],
        uses: count_uses(flat, order),
        latencies: Vec::new(),
        summands: Summands::new(flat, order),
    };
    let mut starts = Vec::with_capacity(order.len());
    for &value in order {
        starts.push(schedule.program.instructions.len());
        schedule.emit(value);
        schedule.gather(value);
    }
    schedule.program.outputs = outputs.iter().map(|&value| schedule.operands[value]).collect();
    (schedule.program, starts)
}

/// Rows with more terms or factors than this are gathered one after the other.
const LONGEST_TREE: usize = 32;

struct Schedule<'a> {
    flat: &'a Flat,
    outputs: &'a [Value],
    program: Program,
    operands: Vec<Operand>,
    uses: Vec<usize>,
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
        let mut of: HashMap<Value, Vec<(Value, bool)>> = HashMap::default();
        for &sum in order {
            if let Some(row) = long_row(flat, sum) {
                row.iter().for_each(|s| of.entry(s.value).or_default().push((sum, s.negative)));
            }
        }
        Self { of, gathered: HashMap::default() }
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
            Definition::Call(function, both) => {
                let [x, y] = both.map(|x| self.operands[x]);
                self.push(Operation::Call(*function), x, y)
            }
            Definition::Spline(spline, order, x) => {
                let x = self.operands[*x];
                self.push(Operation::Spline(*spline, *order), x, x)
            }
            // Used in one product alone, it becomes that product's division.
            Definition::Reciprocal(_) if self.is_folded(value) => return,
            Definition::Reciprocal(x) => {
                let x = self.operands[*x];
                self.push(Operation::Div, Operand::Number(Number::ONE), x)
            }
            Definition::Negative(x) => {
                let x = self.operands[*x];
                self.push(Operation::Neg, x, x)
            }
        };
        if let (Operand::Value(at), Some(name)) = (operand, self.flat.names.get(&value)) {
            self.program.instructions[at].name.get_or_insert_with(|| name.clone());
        }
        self.operands[value] = operand;
    }

    fn push(&mut self, operation: Operation, a: Operand, b: Operand) -> Operand {
        self.latencies.push(self.latency(a).max(self.latency(b)) + operation.latency());
        self.program.instructions.push(Instruction { operation, a, b, name: None });
        Operand::Value(self.program.instructions.len() - 1)
    }

    fn is_folded(&self, value: Value) -> bool {
        matches!(self.flat.definitions[value], Definition::Reciprocal(_))
            && self.uses[value] == 1
            && !self.outputs.contains(&value)
    }

    fn product(&mut self, factors: &[Value]) -> Operand {
        let (below, above): (Vec<_>, Vec<_>) = factors.iter().partition(|&&factor| self.is_folded(factor));
        let above: Vec<_> = above.into_iter().map(|&factor| self.operands[factor]).collect();
        let multiply = |schedule: &mut Self, a, b| schedule.push(Operation::Mul, a, b);
        let product = self.reduce(above, multiply, |&factor| factor);
        let mut product = product.unwrap_or(Operand::Number(Number::ONE));
        for factor in below {
            if let Definition::Reciprocal(x) = &self.flat.definitions[*factor] {
                let divisor = self.operands[*x];
                product = self.push(Operation::Div, product, divisor);
            }
        }
        product
    }

    fn sum(&mut self, summands: &[Signed]) -> Operand {
        let operands =
            summands.iter().map(|summand| (self.operands[summand.value], summand.negative)).collect();
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
            let mut gathered = (self.operands[value], negative);
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
        // one operand less each time
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

/// How often each value is used in products; a use elsewhere counts twice, so
/// that it never looks like a single use in a product.
fn count_uses(flat: &Flat, order: &[Value]) -> Vec<usize> {
    let mut uses = vec![0; flat.definitions.len()];
    for &value in order {
        let definition = &flat.definitions[value];
        let weight = if matches!(definition, Definition::Product(_)) { 1 } else { 2 };
        definition.for_each_operand(|operand| uses[operand] += weight);
    }
    uses
}
