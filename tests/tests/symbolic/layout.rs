//! Layouts compute what their programs do (they are run before they are handed out), and
//! have the forms that targets rely on.

#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

use mbs_symbolic::layout::{Array, Column, Component, Home, Kept, Layout, Loop, Part, Read, Rule, blocks};
use mbs_symbolic::{
    Arena, Expr, Function, Instruction, Number, Operand, Operation, Program, Stage, Symbol, lower_whole,
};
use proptest::prelude::*;

const LINKS: usize = 60;

/// All symbols are components of one vector.
fn component(symbol: Symbol) -> Option<Component<char>> {
    Some(Component { vector: 'q', place: symbol.index() })
}

/// The outputs of a program on symbols q₀, q₁, …
fn program(outputs: impl Fn(&mut Arena, &[Expr]) -> Vec<Expr>) -> Program {
    let mut arena = Arena::new();
    let symbols: Vec<Expr> = (0..LINKS)
        .map(|link| {
            let symbol = arena.symbol(&format!("q{link}"), Stage::Variable);
            arena.variable(symbol)
        })
        .collect();
    let outputs = outputs(&mut arena, &symbols);
    lower_whole(&mut arena, &outputs, 0).expect("a program")
}

fn layout(program: &Program, results: &[usize]) -> Layout<char> {
    let blocks = blocks(program, 0, &component);
    Layout::new(program, &blocks, results, &component).expect("it computes what the program does")
}

fn loops(layout: &Layout<char>) -> impl Iterator<Item = &Loop<char>> {
    layout.parts.iter().filter_map(|part| match part {
        Part::Loop(repeated) => Some(repeated),
        Part::Straight(_) => None,
    })
}

/// sin qᵢ and cos qᵢ
fn sines_and_cosines(arena: &mut Arena, symbols: &[Expr]) -> Vec<Expr> {
    let calls = |q: &Expr| [Function::Sin, Function::Cos].map(|function| arena.call(function, *q));
    symbols.iter().flat_map(calls).collect()
}

#[test]
fn a_loop_of_sines_and_cosines_alone_has_angles() {
    let layout = layout(&program(sines_and_cosines), &[]);
    let [repeated] = loops(&layout).collect::<Vec<_>>()[..] else { panic!("one loop") };
    let angles = repeated.angles().expect("angles");
    assert_eq!(angles.len(), 1);
    let by_rule = Rule::Line { first: 0, step: 1, is_down: false };
    assert_eq!(repeated.columns[angles[0].column], Column::Elements(Home::Vector('q'), by_rule));
    for step in angles[0].steps {
        assert!(matches!(repeated.steps[step].kept, Kept::Each(Array::Slots, Rule::Line { .. })));
    }
}

#[test]
fn outputs_are_in_the_arrays_that_were_asked_for() {
    let program = program(|arena, symbols| {
        let roots: Vec<_> = symbols.iter().map(|q| arena.call(Function::Sqrt, *q)).collect();
        let one = arena.one();
        roots.into_iter().chain([one, one]).collect()
    });
    let layout = layout(&program, &[LINKS]);
    for (at, place) in layout.outputs[..LINKS].iter().enumerate() {
        assert_eq!((place.array, place.at), (Array::Result(0), at));
    }
    // what no instruction computes is stored once
    assert_eq!(layout.given.len(), 1);
    assert_eq!(layout.outputs[LINKS], layout.given[0].1);
    assert_eq!(layout.outputs[LINKS], layout.outputs[LINKS + 1]);
}

#[test]
fn a_result_of_the_copy_before_is_carried() {
    let program = program(|arena, symbols| {
        let mut last = arena.one();
        for q in symbols {
            let sum = arena.add(last, *q);
            let sine = arena.call(Function::Sin, sum);
            last = arena.share(sine);
        }
        vec![last]
    });
    let layout = layout(&program, &[]);
    let [repeated] = loops(&layout).collect::<Vec<_>>()[..] else { panic!("one loop") };
    assert_eq!((repeated.carried.len(), repeated.columns.len()), (1, 1));
    assert!(repeated.steps.iter().all(|step| !matches!(step.kept, Kept::Each(..))), "only the last one is");
}

proptest! {
    /// Programs that repeat themselves here and there, with slips in between.
    #[test]
    fn a_layout_computes_what_its_program_does(
        period in 1_usize..12,
        copies in 1_usize..40,
        tail in 0_usize..30,
        choices in prop::collection::vec((0_u8..3, 0_usize..40, 0_usize..40), 12),
        slips in prop::collection::vec((0_usize..300, 0_u8..3, 0_usize..300), 0..6),
        outputs in prop::collection::vec(0_usize..500, 1..40),
        in_array in 0_usize..40,
    ) {
        let operation = |choice| match choice {
            0 => Operation::Add,
            1 => Operation::Mul,
            _ => Operation::Sub,
        };
        let operand = |at: usize, back: usize| match at.checked_sub(back + 1) {
            Some(earlier) => Operand::Value(earlier),
            None => Operand::Hoisted(back),
        };
        let mut program = Program::default();
        for at in 0..period * copies + tail {
            let (choice, a, b) = choices[at % period];
            let (a, b) = (operand(at, a), operand(at, b));
            program.instructions.push(Instruction { operation: operation(choice), a, b, name: None });
        }
        let length = program.instructions.len();
        for (at, choice, back) in slips {
            let at = at % length;
            program.instructions[at].operation = operation(choice);
            program.instructions[at].a = operand(at, back);
        }
        program.outputs = outputs.into_iter().map(|at| Operand::Value(at % length)).collect();
        let blocks = blocks(&program, 0, &component);
        let results = in_array.min(program.outputs.len());
        prop_assert!(Layout::new(&program, &blocks, &[results], &component).is_ok());
    }
}

/// xᵢ = xᵢ₋₁ + 1/(1 + (xᵢ₋₁ + qᵢ)²) up the first half of the symbols, and the same with xᵢ₋₁ − 1/…
/// down the second half, in turns as the two ends of a chain are eliminated.
fn from_both_ends(arena: &mut Arena, symbols: &[Expr]) -> Vec<Expr> {
    let one = arena.one();
    let mut ends = [one; 2];
    for link in 0..LINKS / 2 {
        let beside = [symbols[link], symbols[LINKS - 1 - link]];
        for ((end, q), sign) in ends.iter_mut().zip(beside).zip([Number::ONE, Number::MINUS_ONE]) {
            let sum = arena.add(*end, q);
            let sum = arena.share(sum);
            let square = arena.powi(sum, 2);
            let sum = arena.add(one, square);
            let inverse = arena.powi(sum, -1);
            let sum = arena.sum(&[(*end, Number::ONE), (inverse, sign)]);
            *end = arena.share(sum);
        }
    }
    ends.to_vec()
}

#[test]
fn two_ends_of_a_chain_become_the_lanes_of_a_vector() {
    let program = program(from_both_ends);
    let layout = layout(&program, &[]);
    let [repeated] = loops(&layout).collect::<Vec<_>>()[..] else { panic!("one loop") };
    let woven = repeated.woven(&program).expect("pairs are right").expect("there are pairs");
    assert_eq!(woven.together.len(), 1, "both results are carried in one vector");
    let [scalars, pairs, ..] = woven.woven.census();
    assert_eq!((scalars, pairs), (0, 5), "{:?}", woven.woven);

    // copy after copy, as a target runs it
    let symbol = |place: usize| 0.9 + 0.01 * place as f64;
    let outside = |operand: Operand| match operand {
        Operand::Number(number) => number.to_f64(),
        Operand::Symbol(at) => symbol(at.index()),
        Operand::Value(at) => {
            let values = Program { outputs: vec![Operand::Value(at)], ..program.clone() };
            values.evaluate(&|at| symbol(at.index()), &[])[0]
        }
        Operand::Hoisted(_) => panic!("nothing is hoisted"),
    };
    let mut carried: Vec<f64> = repeated.carried.iter().map(|carried| outside(carried.first)).collect();
    for copy in 0..repeated.repetition.count {
        let given = |at: Symbol| match woven.given[at.index()] {
            Read::Carried(at) => carried[at],
            Read::Each(at) => match &repeated.columns[at] {
                Column::Elements(Home::Vector('q'), rule) => symbol(rule.at(copy, &repeated.tables)),
                other => panic!("{other:?}"),
            },
            other => panic!("{other:?}"),
        };
        let values = woven.woven.evaluate(&program, &given, &|_| f64::NAN);
        carried = values[..repeated.carried.len()].to_vec();
    }
    let last = repeated.repetition.range().end;
    for (value, variable) in carried.iter().zip(&repeated.carried) {
        let at = last - repeated.repetition.length + variable.from;
        assert_eq!(value.to_bits(), outside(Operand::Value(at)).to_bits());
    }
}

/// The sines of pairs have a range, which only a whole step can do without; and a product
/// alone has nothing beside it.
#[test]
fn loops_of_sines_or_without_pairs_are_not_woven() {
    let alone = |arena: &mut Arena, symbols: &[Expr]| {
        let mut last = arena.one();
        for &q in symbols {
            let sum = arena.add(last, q);
            last = arena.share(sum);
            let product = arena.mul(last, q);
            last = arena.share(product);
        }
        vec![last]
    };
    let turning = |arena: &mut Arena, symbols: &[Expr]| {
        let ends = from_both_ends(arena, symbols);
        let sum = arena.add(ends[0], ends[1]);
        let mut last = arena.share(sum);
        for &q in symbols {
            let sum = arena.add(last, q);
            last = arena.call(Function::Sin, sum);
        }
        vec![last]
    };
    for (program, woven) in [(program(alone), 0), (program(turning), 1)] {
        let layout = layout(&program, &[]);
        assert!(loops(&layout).count() > woven);
        let found = loops(&layout).filter(|repeated| repeated.woven(&program).expect("right").is_some());
        assert_eq!(found.count(), woven);
    }
}
