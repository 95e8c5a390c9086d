//! Blocks are the program, cut: written out again, they give its instructions
//! and operands, and every operand is where the block says.

#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_symbolic::{
    Block, Function, Instruction, Operand, Operation, Program, Repetition, Source, Stage, Symbol, lower_whole,
};
use proptest::prelude::*;

/// The operands of a copy from the description of a repetition.
fn operand(source: &Source, repetition: &Repetition, copy: usize) -> Operand {
    let start = repetition.start + copy * repetition.length;
    match source {
        Source::Same(operand) => *operand,
        Source::Own(at) => Operand::Value(start + at),
        Source::Carried(_, first) if copy == 0 => *first,
        Source::Carried(at, _) => Operand::Value(start - repetition.length + at),
        Source::Each(operands) => operands[copy],
    }
}

/// Instructions written out from blocks; checks that loops can run in order.
fn unrolled(program: &Program, blocks: &[Block]) -> Vec<(Operation, Operand, Operand)> {
    let mut all = Vec::new();
    for block in blocks {
        assert_eq!(block.range().start, all.len(), "blocks follow each other");
        match block {
            Block::Straight(range) => all.extend(
                program.instructions[range.clone()]
                    .iter()
                    .map(|Instruction { operation, a, b, .. }| (*operation, *a, *b)),
            ),
            Block::Repeated(repetition) => {
                let sources: Vec<_> =
                    (0..repetition.length).map(|at| repetition.sources(program, at)).collect();
                for copy in 0..repetition.count {
                    for (at, [a, b]) in sources.iter().enumerate() {
                        let operation = program.instructions[repetition.start + at].operation;
                        // results of other copies are read from memory: they have to be there
                        let begin = repetition.start + copy * repetition.length;
                        for source in [a, b] {
                            if let (Source::Each(_) | Source::Same(_), Operand::Value(value)) =
                                (source, operand(source, repetition, copy))
                            {
                                assert!(value < begin, "a copy reads its own result before it is kept");
                            }
                        }
                        all.push((operation, operand(a, repetition, copy), operand(b, repetition, copy)));
                    }
                }
            }
        }
    }
    all
}

fn assert_cut(program: &Program, class: &dyn Fn(Symbol) -> usize) -> Vec<Block> {
    let blocks = program.blocks(class);
    let written = unrolled(program, &blocks);
    let instructions: Vec<_> = program.instructions.iter().map(|i| (i.operation, i.a, i.b)).collect();
    assert_eq!(written, instructions);
    blocks
}

/// x₁ = sin(q₁), xᵢ = xᵢ₋₁·sin(qᵢ) + xᵢ₋₁/qᵢ: a recurrence with `links` links.
fn chain(links: usize) -> Program {
    let mut arena = mbs_symbolic::Arena::new();
    let mut last = None;
    for link in 0..links {
        let symbol = arena.symbol(&format!("q{link}"), Stage::Variable);
        let q = arena.variable(symbol);
        let sine = arena.call(Function::Sin, q);
        let next = match last {
            None => sine,
            Some(before) => {
                let (inverse, product) = (arena.powi(q, -1), arena.mul(before, sine));
                let quotient = arena.mul(before, inverse);
                arena.add(product, quotient)
            }
        };
        last = Some(arena.share(next));
    }
    lower_whole(&mut arena, &[last.expect("there are links")], 1024).expect("a program")
}

#[test]
fn the_links_of_a_chain_become_two_loops() {
    let program = chain(50);
    let blocks = assert_cut(&program, &|_| 0);
    let written: usize = blocks.iter().map(Block::written).sum();
    let loops = blocks.iter().filter(|block| matches!(block, Block::Repeated(_))).count();
    assert_eq!(loops, 2, "the sines, and the recurrence");
    assert!(written <= 20, "{written} of {}", program.instructions.len());
    // the text does not grow with the chain
    let written = |links| assert_cut(&chain(links), &|_| 0).iter().map(Block::written).sum::<usize>();
    assert_eq!(written(500), written(2000));
}

#[test]
fn symbols_of_different_classes_do_not_take_each_others_place() {
    let program = chain(50);
    let blocks = assert_cut(&program, &|symbol| symbol.index());
    assert!(blocks.iter().all(|block| matches!(block, Block::Straight(_)) || block.range().len() < 150));
}

/// xᵢ = xᵢ₋₁·qᵢ + 1/(xᵢ₋₁ + qᵢ) from the first link to the last, and yᵢ = pᵢ/(yᵢ₊₁ − pᵢ) from
/// the last to the first, from where x ends if `follows`. In loops or in straight lines.
fn two_chains(links: usize, follows: bool, unrolled: usize) -> Program {
    let mut arena = mbs_symbolic::Arena::new();
    let mut symbols = |name: &str| -> Vec<_> {
        let symbol = |link| arena.symbol(&format!("{name}{link}"), Stage::Variable);
        (0..links).map(symbol).collect()
    };
    let (q, p) = (symbols("q"), symbols("p"));
    let mut x = arena.one();
    for symbol in q {
        let q = arena.variable(symbol);
        let (product, sum) = (arena.mul(x, q), arena.add(x, q));
        let sum = arena.share(sum);
        let inverse = arena.powi(sum, -1);
        let next = arena.add(product, inverse);
        x = arena.share(next);
    }
    let mut y = if follows { x } else { arena.one() };
    for symbol in p.into_iter().rev() {
        let p = arena.variable(symbol);
        let difference = arena.sub(y, p);
        let difference = arena.share(difference);
        let inverse = arena.powi(difference, -1);
        let next = arena.mul(p, inverse);
        y = arena.share(next);
    }
    lower_whole(&mut arena, &[x, y], unrolled).expect("a program")
}

/// A processor waits for a link of one while it works at a link of the other.
#[test]
fn loops_that_do_not_need_each_other_are_one() {
    let loops = |follows| {
        let blocks = assert_cut(&two_chains(40, follows, 0), &|_| 0);
        blocks.iter().filter(|block| matches!(block, Block::Repeated(_))).count()
    };
    assert_eq!(loops(false), 1);
    assert_eq!(loops(true), 2);
}

/// Their operations are those of straight lines, in another order.
#[test]
fn loops_side_by_side_compute_the_same() {
    let value = |symbol: Symbol| 0.2 + 0.7 * (symbol.index() as f64).sin().abs();
    let results = [0, usize::MAX].map(|unrolled| two_chains(40, false, unrolled).evaluate(&value, &[]));
    assert_eq!(results[0], results[1]);
}

/// A short program is left alone.
#[test]
fn nothing_is_gained_in_a_short_program() {
    let program = chain(3);
    assert_eq!(assert_cut(&program, &|_| 0), [Block::Straight(0..program.instructions.len())]);
}

proptest! {
    /// Programs that repeat themselves here and there, with slips in between.
    #[test]
    fn blocks_are_the_program(
        period in 1_usize..12,
        copies in 1_usize..20,
        tail in 0_usize..30,
        choices in prop::collection::vec((0_u8..4, 0_usize..40, 0_usize..40), 12),
        slips in prop::collection::vec((0_usize..300, 0_u8..4, 0_usize..300), 0..6),
    ) {
        let operation = |choice| match choice {
            0 => Operation::Add,
            1 => Operation::Mul,
            2 => Operation::Sub,
            _ => Operation::Div,
        };
        let operand = |at: usize, back: usize| match at.checked_sub(back + 1) {
            Some(earlier) => Operand::Value(earlier),
            None => Operand::Hoisted(back),
        };
        let mut program = Program::default();
        for at in 0..period * copies + tail {
            let (choice, a, b) = choices[at % period];
            program.instructions.push(Instruction {
                operation: operation(choice),
                a: operand(at, a),
                b: operand(at, b),
                name: None,
            });
        }
        let length = program.instructions.len();
        for (at, choice, back) in slips {
            let at = at % length;
            program.instructions[at].operation = operation(choice);
            program.instructions[at].a = operand(at, back);
        }
        assert_cut(&program, &|_| 0);
    }
}
