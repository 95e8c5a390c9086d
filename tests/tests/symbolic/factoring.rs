//! Rows that hold a value twice, or with both signs: factoring ends, and the program
//! computes what its expressions say.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_symbolic::{Arena, Expr, Number, Stage, Symbol, lower_whole};
use proptest::prelude::*;

const VARIABLES: usize = 4;

/// One value in several forms, of which canonical sums know nothing: a product and the
/// product computed once; a product with a difference, and with its negative.
fn member(arena: &mut Arena, x: &[Expr], kind: u8, a: usize, b: usize) -> Expr {
    let (a, b) = (x[a % VARIABLES], x[b % VARIABLES]);
    match kind {
        0 => a,
        1 => arena.mul(a, b),
        2 => {
            let product = arena.mul(a, b);
            arena.share(product)
        }
        3 => {
            let difference = arena.sub(a, b);
            arena.mul(x[0], difference)
        }
        4 => {
            let sum = arena.add(a, b);
            arena.share(sum)
        }
        _ => {
            let twice = arena.scale(a, Number::integer(2));
            arena.share(twice)
        }
    }
}

fn variables() -> (Arena, Vec<Expr>) {
    let mut arena = Arena::new();
    let symbols: Vec<_> = (0..VARIABLES).map(|at| arena.symbol(&format!("x{at}"), Stage::Variable)).collect();
    let variables = symbols.into_iter().map(|symbol| arena.variable(symbol)).collect();
    (arena, variables)
}

fn assert_computes(arena: &mut Arena, roots: &[Expr], size: f64) {
    let program = lower_whole(arena, roots, 1024).expect("every pass ends");
    let symbol = |symbol: Symbol| [0.7, -1.3, 2.1, 0.4][symbol.index()];
    let (expected, found) = (arena.evaluate(roots, &symbol), program.evaluate(&symbol, &[]));
    for (expected, found) in expected.iter().zip(found) {
        assert!((expected - found).abs() <= 1e-13 * size, "{expected} became {found}");
    }
}

/// x, −x and y in one sum: the pair of −x and y was looked for beside x, not found, put
/// back, and looked for again without end.
#[test]
fn a_sum_that_holds_a_value_with_both_signs_is_factored() {
    let (mut arena, x) = variables();
    let product = arena.mul(x[0], x[1]);
    let shared = arena.share(product);
    let first = arena.sum(&[(product, Number::ONE), (shared, Number::MINUS_ONE), (x[2], Number::ONE)]);
    let second = arena.sum(&[(product, Number::MINUS_ONE), (x[2], Number::ONE), (x[3], Number::ONE)]);
    let program = lower_whole(&mut arena, &[first, second], 1024).expect("every pass ends");
    // the first is x2 as it stands
    assert_eq!(program.operations().total(), 3);
    assert_computes(&mut arena, &[first, second], 10.0);
}

/// a + b + c − s with s = a + b elsewhere: the opposites meet when the pair is replaced.
#[test]
fn a_pair_that_is_put_beside_its_negative_cancels() {
    let (mut arena, x) = variables();
    let sum = arena.add(x[0], x[1]);
    let shared = arena.share(sum);
    let rest = arena.sum(&[
        (x[0], Number::ONE),
        (x[1], Number::ONE),
        (x[2], Number::ONE),
        (shared, Number::MINUS_ONE),
    ]);
    let rest = arena.mul(rest, x[3]);
    let program = lower_whole(&mut arena, &[shared, rest], 1024).expect("every pass ends");
    assert_eq!(program.operations().total(), 2);
    assert_computes(&mut arena, &[shared, rest], 10.0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn rows_with_repeated_and_opposite_members_are_factored(
        rows in prop::collection::vec(
            prop::collection::vec((0_u8..7, 0_usize..6, 0_usize..6, -2_i64..3), 2..7), 1..7),
    ) {
        let (mut arena, x) = variables();
        let mut roots: Vec<Expr> = Vec::new();
        for row in rows {
            let mut terms = Vec::new();
            for (kind, a, b, coefficient) in row {
                // rows are members of later rows
                let term = match roots.get(a).copied() {
                    Some(earlier) if kind == 6 => arena.share(earlier),
                    _ => member(&mut arena, &x, kind, a, b),
                };
                terms.push((term, Number::integer(coefficient)));
            }
            roots.push(arena.sum(&terms));
        }
        // members are at most 5 in size, and rows stand in rows six deep
        assert_computes(&mut arena, &roots, 5.0 * 12.0_f64.powi(6));
    }
}
