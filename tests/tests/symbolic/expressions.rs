//! Canonical forms keep values, derivatives are those of jets over the source
//! expression, and programs compute what expressions mean, for random
//! expressions and for one that uses every operator.
#![allow(clippy::expect_used, reason = "helpers of tests")]
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use std::collections::{BTreeSet, HashSet};

use super::common::{Jet, Line, Tolerance, Tree, VARIABLES, config, every_operator, points, trees};
use mbs_symbolic::{
    Arena, Expr, FUNCTIONS, Hoisted, Number, Operand, Operation, Program, Rounded, Stage, Symbol, lower,
    lower_whole,
};
use proptest::prelude::*;
use rustc_hash::FxHashMap as HashMap;

struct Setting {
    arena: Arena,
    symbols: Vec<Symbol>,
    velocities: Vec<Symbol>,
    expr: Expr,
}

/// The tree in a new arena; the first `parameters` variables are parameters.
fn setting(tree: &Tree, parameters: usize) -> Option<Setting> {
    let mut arena = Arena::new();
    let stage = |at| if at < parameters { Stage::Parameter } else { Stage::Variable };
    let symbols: Vec<_> = (0..VARIABLES).map(|at| arena.symbol(&format!("x{at}"), stage(at))).collect();
    let velocities: Vec<_> =
        (0..VARIABLES).map(|at| arena.symbol(&format!("v{at}"), Stage::Variable)).collect();
    let variables: Vec<_> = symbols.iter().map(|&symbol| arena.variable(symbol)).collect();
    let expr = tree.build(&mut arena, &variables)?;
    Some(Setting { arena, symbols, velocities, expr })
}

impl Setting {
    /// The first and second derivative along x + s v with v constant.
    fn derivatives(&mut self) -> [Expr; 2] {
        let mut direction = HashMap::default();
        for (&x, &v) in self.symbols.iter().zip(&self.velocities) {
            direction.insert(x, self.arena.variable(v));
        }
        let first = self.arena.derivative(self.expr, &direction);
        [first, self.arena.derivative(first, &direction)]
    }
}

fn values(x: [f64; VARIABLES], v: [f64; VARIABLES]) -> impl Fn(Symbol) -> f64 {
    move |symbol| if symbol.index() < VARIABLES { x[symbol.index()] } else { v[symbol.index() - VARIABLES] }
}

fn assert_agrees(what: &str, expected: Rounded, found: f64) -> Result<(), TestCaseError> {
    prop_assert!(
        expected.agrees_with(found),
        "{what}: {expected:?} and {found:e}, {:e}",
        expected.tolerance()
    );
    Ok(())
}

fn check_derivatives(tree: &Tree, x: [f64; VARIABLES], v: [f64; VARIABLES]) -> Result<(), TestCaseError> {
    let lines: Vec<_> = x.iter().zip(v).map(|(&x, v)| Jet::line(x, v)).collect();
    let jet = tree.jet(&lines);
    prop_assume!(jet.is_some());
    let jet = jet.unwrap();
    let setting = setting(tree, 0);
    prop_assume!(setting.is_some());
    let mut setting = setting.unwrap();

    let [first, second] = setting.derivatives();
    let found = setting.arena.evaluate(&[setting.expr, first, second], &values(x, v));
    assert_agrees("value", jet.value, found[0])?;
    assert_agrees("first derivative", jet.first, found[1])?;
    assert_agrees("second derivative", jet.second, found[2])?;

    for at in 0..VARIABLES {
        let along: Vec<_> = (0..VARIABLES).map(|i| Jet::line(x[i], f64::from(u8::from(i == at)))).collect();
        let partial = setting.arena.partial(setting.expr, setting.symbols[at]);
        let found = setting.arena.evaluate(&[partial], &values(x, v))[0];
        if let Some(jet) = tree.jet(&along) {
            assert_agrees("partial derivative", jet.first, found)?;
        }
    }
    Ok(())
}

/// Checks the form that `Program` promises.
fn check_form(program: &Program) -> Result<(), TestCaseError> {
    let mut needed: BTreeSet<usize> = BTreeSet::new();
    let mut mark = |operand: Operand| {
        if let Operand::Value(at) = operand {
            needed.insert(at);
        }
    };
    program.outputs.iter().copied().for_each(&mut mark);
    let mut seen = HashSet::new();
    for (at, instruction) in program.instructions.iter().enumerate() {
        for operand in [instruction.a, instruction.b] {
            if let Operand::Value(earlier) = operand {
                prop_assert!(earlier < at, "instruction {at} uses {earlier}");
            }
            mark(operand);
        }
        let (mut a, mut b) = (instruction.a, instruction.b);
        if matches!(instruction.operation, Operation::Add | Operation::Mul) && b < a {
            (a, b) = (b, a);
        }
        prop_assert!(seen.insert((instruction.operation, a, b)), "instruction {at} repeats another");
    }
    prop_assert_eq!(needed.len(), program.instructions.len(), "an instruction is not needed");
    Ok(())
}

/// Programs add and multiply in another order than expressions: both are
/// within the running error bound of the jet.
fn check_programs(
    tree: &Tree,
    x: [f64; VARIABLES],
    v: [f64; VARIABLES],
    parameters: usize,
) -> Result<(), TestCaseError> {
    let still: [f64; VARIABLES] = std::array::from_fn(|at| if at < parameters { 0.0 } else { v[at] });
    let lines: Vec<_> = x.iter().zip(still).map(|(&x, v)| Jet::line(x, v)).collect();
    let jet = tree.jet(&lines);
    prop_assume!(jet.is_some());
    let jet = jet.unwrap();
    let setting = setting(tree, parameters);
    prop_assume!(setting.is_some());
    let mut setting = setting.unwrap();
    let [first, second] = setting.derivatives();
    let roots = [setting.expr, first, second];
    let expected = [jet.value, jet.first, jet.second];

    let whole = lower_whole(&mut setting.arena, &roots, 1024).expect("a program");
    check_form(&whole)?;
    let symbol = values(x, still);
    for (expected, found) in expected.iter().zip(whole.evaluate(&symbol, &[])) {
        assert_agrees("program", *expected, found)?;
    }

    let mut hoisted = Hoisted::default();
    let rest = lower(&mut setting.arena, &roots, &mut hoisted, 1024).expect("a program");
    let prepare = lower_whole(&mut setting.arena, hoisted.values(), 1024).expect("a program");
    check_form(&rest)?;
    check_form(&prepare)?;
    let prepared = prepare.evaluate(&symbol, &[]);
    for (expected, found) in expected.iter().zip(rest.evaluate(&symbol, &prepared)) {
        assert_agrees("hoisted program", *expected, found)?;
    }
    // Instructions that depend on parameters alone have left the program, but for signs.
    let late = |operand: Operand| match operand {
        Operand::Number(_) | Operand::Hoisted(_) => false,
        Operand::Symbol(symbol) => symbol.index() >= parameters,
        Operand::Value(_) => true,
    };
    for instruction in &rest.instructions {
        let is_sign = instruction.operation == Operation::Neg;
        prop_assert!(
            late(instruction.a) || late(instruction.b) || is_sign,
            "{instruction:?} could be hoisted"
        );
    }
    let is_early = |&value: &Expr| setting.arena.stage(value) <= Stage::Parameter;
    prop_assert!(hoisted.values().iter().all(is_early));
    Ok(())
}

proptest! {
    #![proptest_config(config(1))]

    #[test]
    fn random_expressions_keep_values_and_have_the_derivatives_of_jets(
        tree in trees(), x in points(), v in points()
    ) {
        check_derivatives(&tree, x, v)?;
    }

    #[test]
    fn programs_of_random_expressions_compute_them(
        tree in trees(), x in points(), v in points(), parameters in 0..=VARIABLES
    ) {
        check_programs(&tree, x, v, parameters)?;
    }

    #[test]
    fn expression_of_every_operator(x in points(), v in points(), parameters in 0..=VARIABLES) {
        check_derivatives(&every_operator(), x, v)?;
        check_programs(&every_operator(), x, v, parameters)?;
    }

    /// Building an expression twice gives the same node, and its parts rebuilt
    /// through the constructors are already canonical.
    #[test]
    fn canonical_forms_are_canonical(tree in trees(), x in points()) {
        // 0 to a negative power is an infinite constant, on which algebra ends
        prop_assume!(tree.jet(&x.map(|x| Jet::line(x, 0.0))).is_some());
        let setting = setting(&tree, 0);
        prop_assume!(setting.is_some());
        let mut setting = setting.unwrap();
        let variables: Vec<_> = setting.symbols.iter().map(|&s| setting.arena.variable(s)).collect();
        prop_assert_eq!(tree.build(&mut setting.arena, &variables), Some(setting.expr));
        let one = setting.arena.one();
        prop_assert_eq!(setting.arena.mul(setting.expr, one), setting.expr);
        let zero = setting.arena.zero();
        prop_assert_eq!(setting.arena.add(setting.expr, zero), setting.expr);
        let negative = setting.arena.neg(setting.expr);
        prop_assert_eq!(setting.arena.neg(negative), setting.expr);
        let nothing = setting.arena.add(negative, setting.expr);
        prop_assert!(setting.arena.is_zero(nothing));
        let halves = setting.arena.scale(setting.expr, Number::ratio(1, 2));
        prop_assert_eq!(setting.arena.add(halves, halves), setting.expr);
    }
}

#[test]
fn expression_of_every_operator_has_every_operator() {
    fn functions(tree: &Tree, found: &mut HashSet<mbs_symbolic::Function>) {
        match tree {
            Tree::Number(..) | Tree::Variable(_) => {}
            Tree::Add(a, b) | Tree::Sub(a, b) | Tree::Mul(a, b) | Tree::Div(a, b) => {
                functions(a, found);
                functions(b, found);
            }
            Tree::Neg(a) | Tree::Power(a, _) => functions(a, found),
            Tree::Call(function, a) => {
                found.insert(*function);
                functions(a, found);
            }
            Tree::Call2(function, a, b) => {
                found.insert(*function);
                functions(a, found);
                functions(b, found);
            }
        }
    }
    let mut found = HashSet::new();
    functions(&every_operator(), &mut found);
    for row in FUNCTIONS {
        assert!(found.contains(&row.function), "{:?} is missing", row.function);
    }
}
