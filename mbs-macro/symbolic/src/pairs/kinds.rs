//! Instructions that can share a vector, and how their operands stand beside each other.

use super::steps::Lane;
use crate::operators::Function;
use crate::program::{Instruction, Operand, Operation};

/// How an instruction stands in a vector: with which other, and in which lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Partner {
    pub other: usize,
    pub lane: Lane,
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

/// The ways to line up the operands of two instructions of one kind beside first with first
/// and second with second: crossed where an instruction commutes. The first operand of a
/// difference is what is subtracted from.
pub(super) fn crossings(
    x: &Instruction,
    y: &Instruction,
) -> impl Iterator<Item = [(Operand, Operand); 2]> + use<> {
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
pub(super) fn matchings<'a>(
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
