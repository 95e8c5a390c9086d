//! Products that are read once, by a sum or a difference, which are done with it.

use mbs_symbolic::{Operand, Operation, Program};
use rustc_hash::FxHashMap as HashMap;

/// Instructions that multiply → the ones that add.
pub struct Products {
    readers: HashMap<usize, usize>,
}

/// A sum or a difference with one of its operands a product.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sum {
    /// c + a·b
    MulAdd,
    /// c − a·b
    SubMul,
    /// a·b − c
    MulSub,
}

impl Products {
    /// Those of a program. Where both operands of a sum are such products, the second one
    /// is done with it.
    pub fn of(program: &Program) -> Self {
        let mut reads: HashMap<usize, usize> = HashMap::default();
        let mut count = |operand: Operand| {
            if let Operand::Value(at) = operand {
                *reads.entry(at).or_default() += 1;
            }
        };
        for step in &program.instructions {
            count(step.a);
            if step.b != step.a {
                count(step.b);
            }
        }
        // a result is read in the end, too
        program.outputs.iter().for_each(|&output| count(output));
        let product = |operand: Operand| match operand {
            Operand::Value(at) if reads.get(&at) == Some(&1) => {
                (program.instructions[at].operation == Operation::Mul).then_some(at)
            }
            _ => None,
        };
        let sums = program.instructions.iter().enumerate().filter_map(|(at, step)| {
            let is_sum = matches!(step.operation, Operation::Add | Operation::Sub) && step.a != step.b;
            let product = product(step.b).or_else(|| product(step.a)).filter(|_| is_sum)?;
            Some((product, at))
        });
        Self { readers: sums.collect() }
    }

    /// The sum that a product is done with.
    pub fn reader(&self, product: usize) -> Option<usize> {
        self.readers.get(&product).copied()
    }

    /// The product that is done with a sum, how, and the other operand.
    pub fn product(&self, program: &Program, sum: usize) -> Option<(usize, Sum, Operand)> {
        let step = program.instructions.get(sum)?;
        let of = |operand: Operand| match operand {
            Operand::Value(at) if self.reader(at) == Some(sum) => Some(at),
            _ => None,
        };
        let is_sum = step.operation == Operation::Add;
        match (of(step.a), of(step.b)) {
            (_, Some(product)) => Some((product, if is_sum { Sum::MulAdd } else { Sum::SubMul }, step.a)),
            (Some(product), None) => Some((product, if is_sum { Sum::MulAdd } else { Sum::MulSub }, step.b)),
            (None, None) => None,
        }
    }
}
