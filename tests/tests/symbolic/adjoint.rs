//! The transpose of a program has the derivatives of its results by all inputs: those that jets find
//! over the source expression along each input, for random expressions and for one that uses every
//! operator; of several results with weights; through splines.
#![allow(clippy::expect_used, clippy::unwrap_used, reason = "helpers of tests")]

use super::common::{Jet, Line, Tolerance, Tree, VARIABLES, config, every_operator, points, trees};
use mbs_symbolic::{Arena, Number, Operand, Program, Stage, Symbol, lower, lower_whole};
use proptest::prelude::*;

/// The program of a tree and its symbols.
fn program(tree: &Tree) -> Option<(Program, Vec<Symbol>)> {
    let mut arena = Arena::new();
    let symbols: Vec<_> = (0..VARIABLES).map(|at| arena.symbol(&format!("x{at}"), Stage::Variable)).collect();
    let variables: Vec<_> = symbols.iter().map(|&symbol| arena.variable(symbol)).collect();
    let expr = tree.build(&mut arena, &variables)?;
    Some((lower_whole(&mut arena, &[expr], 1024).expect("a program"), symbols))
}

const ONE: Operand = Operand::Number(Number::ONE);

fn check(tree: &Tree, x: [f64; VARIABLES]) -> Result<(), TestCaseError> {
    let found = program(tree);
    prop_assume!(found.is_some());
    let (program, symbols) = found.unwrap();
    let by: Vec<Operand> = symbols.iter().map(|&symbol| Operand::Symbol(symbol)).collect();
    let both = program.with_adjoint(&[ONE], &by).expect("a transpose");
    let numbers = both.evaluate(&|symbol| x[symbol.index()], &[]);
    prop_assert_eq!(numbers[0].to_bits(), program.evaluate(&|symbol| x[symbol.index()], &[])[0].to_bits());
    for (at, found) in numbers[1..].iter().enumerate() {
        let along: Vec<_> = (0..VARIABLES).map(|i| Jet::line(x[i], f64::from(u8::from(i == at)))).collect();
        if let Some(jet) = tree.jet(&along) {
            let expected = jet.first;
            // the bound is that of the products forward; backward as many are rounded again
            let apart = (expected.value - found).abs();
            let allowed = 2.0 * expected.tolerance() + 64.0 * f64::EPSILON * expected.value.abs();
            prop_assert!(apart <= allowed, "{at}: {expected:?} {found:e}, {allowed:e}");
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(config(2))]

    #[test]
    fn random_programs_have_the_gradients_of_jets(tree in trees(), x in points()) {
        check(&tree, x)?;
    }

    #[test]
    fn every_operator_has_the_gradient_of_jets(x in points()) {
        check(&every_operator(), x)?;
    }
}

/// u = x y and v = x/y with weights 2 and p; inputs that nothing depends on have 0, and what is
/// hoisted is an input like others.
#[test]
fn results_are_weighted() {
    let mut arena = Arena::new();
    let [x, y, p, unused] = ["x", "y", "p", "unused"]
        .map(|name| arena.symbol(name, if name == "p" { Stage::Parameter } else { Stage::Variable }));
    let [of_x, of_y, of_p] = [x, y, p].map(|symbol| arena.variable(symbol));
    let cube = arena.powi(of_p, 3);
    let hoisted_product = arena.mul(cube, of_x);
    let roots = [arena.mul(of_x, of_y), arena.div(of_x, of_y).unwrap(), hoisted_product];
    let mut hoisted = mbs_symbolic::Hoisted::default();
    let program = lower(&mut arena, &roots, &mut hoisted, 1024).unwrap();
    let weights = [Operand::Number(Number::integer(2)), Operand::Symbol(p), ONE];
    let by = [Operand::Symbol(x), Operand::Symbol(y), Operand::Hoisted(0), Operand::Symbol(unused)];
    let both = program.with_adjoint(&weights, &by).unwrap();
    let (of_x, of_y, of_p) = (3.0, 0.5, 1.5);
    let value = |symbol| {
        if symbol == x {
            of_x
        } else if symbol == y {
            of_y
        } else {
            of_p
        }
    };
    let found = both.evaluate(&value, &[of_p * of_p * of_p]);
    let expected = [
        1.5,
        6.0,
        10.125,
        2.0 * of_y + of_p / of_y + 3.375,
        2.0 * of_x - of_p * of_x / (of_y * of_y),
        of_x,
        0.0,
    ];
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() <= 8.0 * f64::EPSILON * expected.abs(), "{found} {expected}");
    }
    assert!(program.with_adjoint(&[ONE], &by).is_err());
}

/// The gradient of a function of many inputs costs a few times the function.
#[test]
fn a_gradient_costs_a_few_times_the_program() {
    let mut arena = Arena::new();
    let symbols: Vec<_> = (0..40).map(|at| arena.symbol(&format!("x{at}"), Stage::Variable)).collect();
    let mut product = arena.one();
    for &symbol in &symbols {
        let x = arena.variable(symbol);
        let sine = arena.call(mbs_symbolic::Function::Sin, x);
        let (sum, one) = (arena.add(product, sine), arena.one());
        let shifted = arena.add(sum, one);
        product = arena.mul(shifted, sine);
        product = arena.share(product);
    }
    let program = lower_whole(&mut arena, &[product], 1024).unwrap();
    let by: Vec<_> = symbols.iter().map(|&symbol| Operand::Symbol(symbol)).collect();
    let both = program.with_adjoint(&[ONE], &by).unwrap();
    let (alone, all) = (program.operations().total(), both.operations().total());
    assert!(all <= 4 * alone, "{alone} {all}");
}
