//! The order in which an interpreter goes through a program.
//!
//! An interpreter branches by the kind of each instruction. A processor foresees branches that are the same
//! many times in a row, and hardly those of a thousand instructions of changing kinds. It also waits where an
//! instruction reads a number that the one before has just written. So instructions of one kind follow each
//! other. Among them the one comes first whose operands have been there for longest. The operations and their
//! operands stay the same.

use std::collections::VecDeque;

use mbs_symbolic::{Instruction, Operand, Operation, Program, SinCos};
use rustc_hash::FxHashMap as HashMap;

use crate::products::{Products, Sum};

/// The kind of an instruction, by which an interpreter branches.
type Kind = (Operation, Option<Sum>);

/// A program with the same instructions, those of a kind together.
pub fn grouped(program: &Program) -> Program {
    let mut units = Units::of(program);
    let mut order = Vec::with_capacity(program.instructions.len());
    // a turn takes at least one unit, and no unit twice
    while let Some(kind) = units.most_ready() {
        while let Some(unit) = units.take(kind) {
            order.extend_from_slice(&units.members[unit]);
            units.release(unit);
        }
    }
    reordered(program, &order)
}

/// The parts of a program that an interpreter does as one instruction: a sum with its product, a sine with
/// its cosine, and any other by itself. Each is named after an instruction that belongs to it.
struct Units {
    /// The instructions of each unit, in their order; none of what belongs to another unit.
    members: Vec<Vec<usize>>,
    /// The kind of each unit, by number.
    kinds: Vec<usize>,
    /// The units that read a result of each, once for every reading.
    readers: Vec<Vec<usize>>,
    /// How many readings each one still waits for.
    waits: Vec<usize>,
    /// Those that wait for nothing, by kind.
    ready: Vec<VecDeque<usize>>,
}

impl Units {
    fn of(program: &Program) -> Self {
        let (pairs, products) = (SinCos::of(program), Products::of(program));
        let count = program.instructions.len();
        // a product belongs to its sum, and of a sine and a cosine the later one to the earlier
        let unit_of = |at: usize| {
            let earlier = pairs.partner(at).map_or(at, |partner| partner.min(at));
            products.reader(at).unwrap_or(earlier)
        };
        let unit_of: Vec<usize> = (0..count).map(unit_of).collect();
        let (mut members, mut readers) = (vec![Vec::new(); count], vec![Vec::new(); count]);
        let (mut kinds, mut waits) = (Vec::with_capacity(count), vec![0; count]);
        let mut numbers: HashMap<Kind, usize> = HashMap::default();
        for (at, step) in program.instructions.iter().enumerate() {
            let unit = unit_of[at];
            members[unit].push(at);
            for operand in [step.a, step.b] {
                if let Operand::Value(read) = operand
                    && unit_of[read] != unit
                {
                    readers[unit_of[read]].push(unit);
                    waits[unit] += 1;
                }
            }
            let sum = products.product(program, at).map(|(_, sum, _)| sum);
            let next = numbers.len();
            kinds.push(*numbers.entry((step.operation, sum)).or_insert(next));
        }
        let mut ready = vec![VecDeque::new(); numbers.len()];
        for unit in (0..count).filter(|&unit| waits[unit] == 0 && !members[unit].is_empty()) {
            ready[kinds[unit]].push_back(unit);
        }
        Self { members, kinds, readers, waits, ready }
    }

    /// The kind with the most units that are ready.
    fn most_ready(&self) -> Option<usize> {
        let ready = self.ready.iter().enumerate().filter(|(_, units)| !units.is_empty());
        ready.max_by_key(|(_, units)| units.len()).map(|(kind, _)| kind)
    }

    /// The unit of a kind that has been ready for longest.
    fn take(&mut self, kind: usize) -> Option<usize> {
        self.ready[kind].pop_front()
    }

    /// Makes the units ready that wait for nothing else than this one.
    fn release(&mut self, unit: usize) {
        for reader in std::mem::take(&mut self.readers[unit]) {
            self.waits[reader] -= 1;
            if self.waits[reader] == 0 {
                self.ready[self.kinds[reader]].push_back(reader);
            }
        }
    }
}

/// The instructions in another order, and what reads them.
fn reordered(program: &Program, order: &[usize]) -> Program {
    let mut places = vec![0; order.len()];
    for (place, &at) in order.iter().enumerate() {
        places[at] = place;
    }
    let moved = |operand: Operand| match operand {
        Operand::Value(at) => Operand::Value(places[at]),
        _ => operand,
    };
    let instructions = order.iter().map(|&at| {
        let step = &program.instructions[at];
        Instruction { operation: step.operation, a: moved(step.a), b: moved(step.b), name: None }
    });
    Program {
        instructions: instructions.collect(),
        outputs: program.outputs.iter().map(|&output| moved(output)).collect(),
        splines: program.splines.clone(),
    }
}

#[cfg(test)]
mod tests {
    use std::mem;

    use mbs_codegen::compiled::Compiled;
    use mbs_codegen::{FunctionId, analyse};
    use mbs_symbolic::{Program, probe};

    use super::grouped;
    use crate::check::tests::DECLARATION;
    use crate::code::Code;

    /// How often the interpreter goes from one kind of instruction to another.
    fn changes_of_kind(compiled: &Compiled, program: &Program) -> usize {
        let code = Code::in_order(compiled, program).unwrap();
        let kinds: Vec<_> = code.instructions.iter().map(mem::discriminant).collect();
        kinds.windows(2).filter(|pair| pair[0] != pair[1]).count()
    }

    /// To the bit, for every function and for the whole step; of its transpose the order is looked at.
    #[test]
    fn a_program_computes_the_same_in_its_new_order() {
        let compiled = analyse(DECLARATION.parse().unwrap()).unwrap();
        let step = &compiled.fused_step.as_ref().unwrap().alone;
        let functions = FunctionId::all().map(|function| compiled.program(function));
        for program in functions.chain([&step.held, &step.per_stage]) {
            let ordered = grouped(program);
            assert_eq!(ordered.instructions.len(), program.instructions.len());
            for point in 0..probe::POINTS {
                let of = |program: &Program| -> Vec<u64> {
                    let results = program.evaluate_with(&probe::symbol(point), &probe::hoisted(point));
                    results.into_iter().map(f64::to_bits).collect()
                };
                assert_eq!(of(&ordered), of(program));
            }
        }
        let transposes = compiled.transposes().unwrap();
        let long = &transposes.step.as_ref().unwrap().held.program;
        let [before, after] = [long, &grouped(long)].map(|program| changes_of_kind(&compiled, program));
        assert!(2 * after < before, "{after} in place of {before}");
    }
}
