//! Substitution replaces symbols and nothing else, for random expressions: the
//! values are those of the inner expression in the place of the symbol.
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use super::common::{Jet, Line, Tolerance, Tree, VARIABLES, config, every_operator, points, trees};
use mbs_symbolic::{Arena, Expr, Stage, Symbol};
use proptest::prelude::*;
use rustc_hash::FxHashMap as HashMap;

struct Setting {
    arena: Arena,
    symbols: Vec<Symbol>,
    variables: Vec<Expr>,
}

fn setting() -> Setting {
    let mut arena = Arena::new();
    let symbols: Vec<_> = (0..VARIABLES).map(|at| arena.symbol(&format!("x{at}"), Stage::Variable)).collect();
    let variables = symbols.iter().map(|&symbol| arena.variable(symbol)).collect();
    Setting { arena, symbols, variables }
}

/// outer(x₀ → inner) at x, against the jet of the outer tree at the value of
/// the inner one. The inner value has its own rounding, which the outer slope
/// magnifies; both bounds are added.
fn check_values(outer: &Tree, inner: &Tree, x: [f64; VARIABLES]) -> Result<(), TestCaseError> {
    let Setting { mut arena, symbols, variables } = setting();
    let point: Vec<_> = x.iter().map(|&x| Jet::line(x, 0.0)).collect();
    let inner_value = inner.jet(&point);
    prop_assume!(inner_value.is_some());
    let inner_value = inner_value.unwrap().value;
    let mut moved = point;
    moved[0] = Jet::line(inner_value.value, 1.0);
    let expected = outer.jet(&moved);
    prop_assume!(expected.is_some());
    let expected = expected.unwrap();
    let built = (outer.build(&mut arena, &variables), inner.build(&mut arena, &variables));
    prop_assume!(built.0.is_some() && built.1.is_some());
    let (outer, inner) = (built.0.unwrap(), built.1.unwrap());

    let substituted = arena.substitute(outer, &HashMap::from_iter([(symbols[0], inner)]));
    let found = arena.evaluate(&[substituted], &|symbol| x[symbol.index()])[0];
    let tolerance = expected.value.tolerance()
        + inner_value.tolerance() * (expected.first.value.abs() + expected.first.tolerance());
    // Second order in the rounding of the inner value, where a slope changes fast.
    let curvature = inner_value.tolerance().powi(2) * expected.second.value.abs();
    prop_assert!(
        (found - expected.value.value).abs() <= tolerance + curvature,
        "{found:e} {:?} {tolerance:e}",
        expected.value
    );
    Ok(())
}

proptest! {
    #![proptest_config(config(2))]

    #[test]
    fn substituted_expressions_have_the_values_of_compositions(
        outer in trees(), inner in trees(), x in points()
    ) {
        check_values(&outer, &inner, x)?;
    }

    #[test]
    fn every_operator_is_rebuilt(inner in trees(), x in points()) {
        check_values(&every_operator(), &inner, x)?;
    }

    /// Symbols for themselves, and symbols that do not occur, change nothing.
    #[test]
    fn substitution_of_nothing_is_the_same_node(tree in trees()) {
        let Setting { mut arena, symbols, variables } = setting();
        let Some(expr) = tree.build(&mut arena, &variables) else { return Ok(()) };
        let stranger = arena.symbol("stranger", Stage::Variable);
        let mut values: HashMap<_, _> = symbols.iter().copied().zip(variables.iter().copied()).collect();
        values.insert(stranger, arena.one());
        prop_assert_eq!(arena.substitute(expr, &values), expr);
        let shared = arena.share(expr);
        prop_assert_eq!(arena.substitute(shared, &HashMap::default()), shared);
    }

    /// All symbols at once: an exchange of two is its own inverse in value.
    #[test]
    fn replacements_are_not_replaced_again(tree in trees(), x in points()) {
        let Setting { mut arena, symbols, variables } = setting();
        let point: Vec<_> = x.iter().map(|&x| Jet::line(x, 0.0)).collect();
        let Some(expected) = tree.jet(&point) else { return Ok(()) };
        let Some(expr) = tree.build(&mut arena, &variables) else { return Ok(()) };
        let exchange = HashMap::from_iter([(symbols[0], variables[1]), (symbols[1], variables[0])]);
        let exchanged = arena.substitute(expr, &exchange);
        let other = |symbol: Symbol| [x[1], x[0], x[2], x[3]][symbol.index()];
        let found = arena.evaluate(&[exchanged], &other)[0];
        prop_assert!(expected.value.agrees_with(found), "{expected:?} {found:e}");
    }
}

/// A shared value stays one: its contents are replaced inside.
#[test]
fn shared_values_stay_shared() {
    let Setting { mut arena, symbols, variables } = setting();
    let sum = arena.add(variables[0], variables[1]);
    let shared = arena.share(sum);
    let outer = arena.mul(shared, variables[2]);
    let outer = arena.add(outer, variables[0]);
    let substituted = arena.substitute(outer, &HashMap::from_iter([(symbols[0], variables[3])]));
    let expected = arena.add(variables[3], variables[1]);
    let expected = arena.share(expected);
    let expected = arena.mul(expected, variables[2]);
    assert_eq!(substituted, arena.add(expected, variables[3]));
}
