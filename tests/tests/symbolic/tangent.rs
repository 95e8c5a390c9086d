//! The tangent of a program has the derivatives of its results along a direction: those that jets find
//! over the source expression, for random expressions and for one that uses every operator; and those
//! of the transpose, for several results, hoisted values and splines.
#![allow(clippy::expect_used, clippy::unwrap_used, reason = "helpers of tests")]

use super::common::{Jet, Line, Tolerance, Tree, VARIABLES, config, every_operator, points, trees};
use mbs_symbolic::{Arena, Hoisted, Number, Operand, Spline, Stage, lower, lower_whole};
use proptest::prelude::*;

fn check(tree: &Tree, x: [f64; VARIABLES], rates: [f64; VARIABLES]) -> Result<(), TestCaseError> {
    let mut arena = Arena::new();
    let symbols: Vec<_> = (0..2 * VARIABLES).map(|_| arena.symbol("x", Stage::Variable)).collect();
    let variables: Vec<_> = symbols.iter().map(|&symbol| arena.variable(symbol)).collect();
    let expr = tree.build(&mut arena, &variables[..VARIABLES]);
    prop_assume!(expr.is_some());
    let program = lower_whole(&mut arena, &[expr.unwrap()], 1024).expect("a program");
    let direction: Vec<_> =
        (0..VARIABLES).map(|at| [at, at + VARIABLES].map(|at| Operand::Symbol(symbols[at])).into()).collect();
    let along = program.along(&direction).expect("a tangent");
    let values: Vec<f64> = x.into_iter().chain(rates).collect();
    let found = along.evaluate(&|symbol| values[symbol.index()], &[])[0];
    let line: Vec<_> = x.into_iter().zip(rates).map(|(x, rate)| Jet::line(x, rate)).collect();
    if let Some(jet) = tree.jet(&line) {
        let expected = jet.first;
        // the bound of jets holds for the operations in the order of the tree; the program has a few more
        let allowed = 2.0 * expected.tolerance() + 64.0 * f64::EPSILON * expected.value.abs();
        prop_assert!((expected.value - found).abs() <= allowed, "{expected:?} {found:e}, {allowed:e}");
    }
    Ok(())
}

proptest! {
    #![proptest_config(config(3))]

    #[test]
    fn random_programs_have_the_slopes_of_jets(tree in trees(), x in points(), rates in points()) {
        check(&tree, x, rates)?;
    }

    #[test]
    fn every_operator_has_the_slope_of_jets(x in points(), rates in points()) {
        check(&every_operator(), x, rates)?;
    }
}

/// Σₖ wₖ (∂rₖ/∂x) ẋ is the same forward and backward, to roundings of its terms.
#[test]
fn tangent_and_transpose_agree() {
    let mut arena = Arena::new();
    let [x, y, p] = ["x", "y", "p"]
        .map(|name| arena.symbol(name, if name == "p" { Stage::Parameter } else { Stage::Variable }));
    let [of_x, of_y, of_p] = [x, y, p].map(|symbol| arena.variable(symbol));
    let points = [(0.0, 0.0), (1.0, 2.0), (2.0, 1.0), (3.0, 3.0)];
    let table = arena.add_spline(Spline::periodic("table", &points, 4.0).unwrap());
    let read = arena.spline(table, of_x);
    let cube = arena.powi(of_p, 3);
    let roots = [arena.mul(read, of_y), arena.div(of_x, of_y).unwrap(), arena.mul(cube, of_x), of_y];
    let mut hoisted = Hoisted::default();
    let program = lower(&mut arena, &roots, &mut hoisted, 1024).unwrap();
    let by = [Operand::Symbol(x), Operand::Symbol(y), Operand::Hoisted(0)];
    let number = |value: f64| Operand::Number(Number::from(value));
    let rates = [0.5, -2.0, 3.0];
    let weights = [1.0, 0.25, -1.5, 4.0];
    let direction: Vec<_> = by.into_iter().zip(rates.map(number)).collect();
    let values = |symbol| if symbol == x { 1.25 } else { 0.75 };
    let forward = program.along(&direction).unwrap().evaluate(&values, &[3.375]);
    let backward = program.with_adjoint(&weights.map(number), &by).unwrap().evaluate(&values, &[3.375]);
    let forward: f64 = forward.iter().zip(weights).map(|(slope, weight)| slope * weight).sum();
    let backward: f64 = backward[4..].iter().zip(rates).map(|(slope, rate)| slope * rate).sum();
    // the terms are below 20, and there are some 20 of them
    assert!((forward - backward).abs() <= 20.0 * 20.0 * f64::EPSILON, "{forward} {backward}");
    assert!(forward.abs() > 1.0);
}

/// A result that does not depend on the direction has the derivative 0, without an instruction.
#[test]
fn what_does_not_change_costs_nothing() {
    let mut arena = Arena::new();
    let [x, y] = ["x", "y"].map(|name| arena.symbol(name, Stage::Variable));
    let of_y = arena.variable(y);
    let sine = arena.call(mbs_symbolic::Function::Sin, of_y);
    let program = lower_whole(&mut arena, &[sine], 1024).unwrap();
    let along = program.along(&[(Operand::Symbol(x), Operand::Number(Number::ONE))]).unwrap();
    assert!(along.instructions.is_empty());
    assert_eq!(along.evaluate(&|_| 1.0, &[]), [0.0]);
}
