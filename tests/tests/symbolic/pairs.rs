//! Programs on pairs compute what the programs compute that they were woven from,
//! bit for bit but for the sign of a zero; and do it in fewer operations.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use super::common::{Tree, VARIABLES, points, trees};
use mbs_interface::sine::{Octant, SHIFT};
use mbs_symbolic::pairs::{Lane, Layout, Scalar, Step, Term, Woven, weave};
use mbs_symbolic::{Arena, Expr, Function, Operation, Program, Stage, Symbol, lower_whole};
use proptest::prelude::*;

/// Symbols with even numbers lie before their successors.
fn woven(program: &Program) -> Woven {
    woven_for_runs(program, &|_| None)
}

/// The same where a run reads symbols from the outputs of the run before.
fn woven_for_runs(program: &Program, carried: &dyn Fn(Symbol) -> Option<usize>) -> Woven {
    let layout = Layout {
        are_neighbours: &|a, b| a.index() % 2 == 0 && b.index() == a.index() + 1,
        are_written_together: &|a, b| a % 2 == 0 && b == a + 1,
        is_constant: &|_| false,
        carried,
    };
    weave(program, &layout)
}

fn letters<const N: usize>() -> (Arena, [Expr; N]) {
    let mut arena = Arena::new();
    let letters = std::array::from_fn(|at| {
        let symbol = arena.symbol(&format!("x{at}"), Stage::Variable);
        arena.variable(symbol)
    });
    (arena, letters)
}

fn assert_refers_back(woven: &Woven) {
    for (at, step) in woven.steps.iter().enumerate() {
        let is_earlier = |scalar: &Scalar| match scalar {
            Scalar::Given(_) => true,
            Scalar::Step(of) | Scalar::Lane(of, _) => *of < at,
        };
        let is_earlier_term = |term: &Term| match term {
            Term::Constant(_) => true,
            Term::Step(of) => *of < at,
        };
        let is_fine = match step {
            Step::Scalar(_, a, b, _) | Step::Join(a, b) => is_earlier(a) && is_earlier(b),
            Step::Splat(a) => is_earlier(a),
            Step::Swap(of) | Step::Flip(of) | Step::Angles(of) | Step::ShiftBack(of) => *of < at,
            Step::Pair(_, a, b) => *a < at && *b < at,
            Step::Term(_, a, b) => is_earlier_term(a) && is_earlier_term(b),
            Step::Sines(of, Octant { shifted, sine, cosine }) => {
                *of < at && [shifted, sine, cosine].into_iter().all(is_earlier_term)
            }
            Step::Cosines(of) => {
                matches!(woven.steps[at - 1], Step::Sines(angles, _) if angles == *of)
            }
        };
        assert!(is_fine, "step {at} of {woven:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn woven_programs_compute_the_same(
        trees in prop::collection::vec(trees(), 1..6),
        points in prop::collection::vec(points(), 4),
    ) {
        let (mut arena, variables) = letters::<VARIABLES>();
        let roots: Vec<Expr> = trees.iter().filter_map(|tree: &Tree| tree.build(&mut arena, &variables)).collect();
        let program = lower_whole(&mut arena, &roots, 1024).expect("a program");
        let mut woven = woven(&program);
        assert_refers_back(&woven);
        woven.sum_outputs(roots.len());
        assert_refers_back(&woven);
        for point in points {
            let symbol = |symbol: Symbol| point[symbol.index()];
            let expected = program.evaluate(&symbol, &[]);
            let found = woven.evaluate(&program, &symbol, &|_| f64::NAN);
            for (expected, found) in expected.iter().zip(&found) {
                prop_assert!(
                    expected == found || expected.is_nan() && found.is_nan(),
                    "{expected} became {found} in {woven:?}"
                );
            }
            // the sum tells whether all of them are finite
            let sum = found.get(roots.len()).copied().unwrap_or(0.0);
            prop_assert!(!sum.is_finite() || expected.iter().all(|x| x.is_finite()));
        }
    }
}

#[test]
fn a_rotation_is_two_pairs_of_operations() {
    // x cos a − y sin a, y cos a + x sin a: two products on pairs and a sum, in
    // which one lane subtracts
    let (mut arena, [x, y, angle]) = letters();
    let (s, c) = (arena.call(Function::Sin, angle), arena.call(Function::Cos, angle));
    let [xc, ys, yc, xs] = [(x, c), (y, s), (y, c), (x, s)].map(|(a, b)| arena.mul(a, b));
    let (first, second) = (arena.sub(xc, ys), arena.add(yc, xs));
    let program = lower_whole(&mut arena, &[first, second], 1024).expect("a program");
    let woven = woven(&program);
    let [scalars, pairs, ..] = woven.census();
    assert_eq!((scalars, pairs), (0, 3), "{woven:?}");
    let point = [3.0, 4.0, 0.5];
    let symbol = |symbol: Symbol| point[symbol.index()];
    assert_eq!(woven.evaluate(&program, &symbol, &|_| f64::NAN), program.evaluate(&symbol, &[]));
}

#[test]
fn magnitudes_are_computed_in_pairs() {
    // x + |x z|, y − |y w|: a product on pairs, its magnitude, which has no sign to negate, and a
    // sum, in which one lane subtracts
    let (mut arena, [x, y, z, w]) = letters();
    let [first, second] = [(x, z), (y, w)].map(|(a, b)| {
        let product = arena.mul(a, b);
        arena.call(Function::Abs, product)
    });
    let outputs = [arena.add(x, first), arena.sub(y, second)];
    let program = lower_whole(&mut arena, &outputs, 1024).expect("a program");
    let woven = woven(&program);
    let [scalars, pairs, ..] = woven.census();
    assert_eq!((scalars, pairs), (0, 3), "{woven:?}");
    assert_eq!(woven.check(&program), Ok(()));
    let point = [3.0, -4.0, -0.5, 2.0];
    let found = woven.evaluate(&program, &|symbol| point[symbol.index()], &|_| f64::NAN);
    assert_eq!(found, [4.5, -12.0]);
}

/// The check that the compiler makes finds an operand that was taken for another.
#[test]
fn a_pair_with_another_operand_is_caught() {
    let (mut arena, [x, y, angle]) = letters();
    let (s, c) = (arena.call(Function::Sin, angle), arena.call(Function::Cos, angle));
    let [xc, ys, yc, xs] = [(x, c), (y, s), (y, c), (x, s)].map(|(a, b)| arena.mul(a, b));
    let (first, second) = (arena.sub(xc, ys), arena.add(yc, xs));
    let program = lower_whole(&mut arena, &[first, second], 1024).expect("a program");
    let right = woven(&program);
    assert_eq!(right.check(&program), Ok(()));
    let (mut tried, mut missed) = (0, 0);
    for at in 0..right.steps.len() {
        let mut wrong = right.clone();
        match &mut wrong.steps[at] {
            Step::Pair(Operation::Add | Operation::Mul, ..) | Step::Splat(_) | Step::Scalar(..) => continue,
            // not looked at: sines are those of the program
            Step::Angles(_) | Step::ShiftBack(_) | Step::Term(..) => continue,
            Step::Pair(_, a, b) => std::mem::swap(a, b),
            Step::Join(a, b) => std::mem::swap(a, b),
            Step::Swap(of) | Step::Flip(of) | Step::Sines(of, _) | Step::Cosines(of) => *of = 0,
        }
        if wrong != right {
            tried += 1;
            missed += usize::from(wrong.check(&program).is_ok());
        }
    }
    assert!(tried > 0 && missed == 0, "{missed} of {tried} wrong steps of {right:?}");
}

#[test]
fn what_waits_for_each_other_is_no_pair() {
    // a chain: no two of its operations can be done at once
    let (mut arena, [x, y]) = letters();
    let mut chain = x;
    for _ in 0..6 {
        let product = arena.mul(chain, y);
        chain = arena.add(product, x);
        chain = arena.share(chain);
    }
    let program = lower_whole(&mut arena, &[chain], 1024).expect("a program");
    let woven = woven(&program);
    assert_eq!(woven.census()[0], program.instructions.len());
    assert_eq!(woven.census()[1], 0);
}

/// Where x and y of a run come from the run before, x ← p/(p y + q) and y ← p/(p (x + q) + q) by
/// turns, both would wait for x + q in one vector.
#[test]
fn what_makes_the_way_from_run_to_run_longer_is_no_pair() {
    let (mut arena, [x, y, p, q]) = letters();
    let later = arena.add(x, q);
    let outputs = [y, later].map(|factor| {
        let product = arena.mul(p, factor);
        let sum = arena.add(product, q);
        arena.div(p, sum).expect("no division by 0")
    });
    let program = lower_whole(&mut arena, &outputs, 1024).expect("a program");
    let pairs = |woven: &Woven| woven.census()[1];
    let alone = woven(&program);
    assert_eq!(pairs(&alone), 3, "{alone:?}");
    let by_turns = woven_for_runs(&program, &|symbol| Some(symbol.index()).filter(|&at| at < 2));
    assert_eq!(pairs(&by_turns), 0, "{by_turns:?}");
}

#[test]
fn the_longest_way_to_an_end_begins_first() {
    // sums and products, which are asked for first, beside a sine of a sine, which takes longer
    let (mut arena, [x, y, angle]) = letters();
    let mut sum = x;
    for _ in 0..4 {
        let product = arena.mul(sum, y);
        sum = arena.add(product, x);
        sum = arena.share(sum);
    }
    let sine = arena.call(Function::Sin, angle);
    let of_sine = arena.call(Function::Sin, sine);
    let program = lower_whole(&mut arena, &[sum, of_sine], 1024).expect("a program");
    let steps = woven(&program).steps;
    let [first_sum, last_sum] = [
        steps.iter().position(|step| matches!(step, Step::Scalar(Operation::Add, ..))),
        steps.iter().rposition(|step| matches!(step, Step::Scalar(Operation::Add, ..))),
    ];
    let [first_sine, last_sine] = [
        steps.iter().position(|step| matches!(step, Step::Sines(..))),
        steps.iter().rposition(|step| matches!(step, Step::Sines(..))),
    ];
    assert!(first_sine < first_sum && last_sum < last_sine, "{steps:?}");
}

/// The operations of a sine stand one by one, and give what the formula gives.
#[test]
fn terms_of_sines_are_those_of_the_formula() {
    let (mut arena, [x, y]) = letters();
    let (sine, cosine) = (arena.call(Function::Sin, x), arena.call(Function::Cos, y));
    let program = lower_whole(&mut arena, &[sine, cosine], 1024).expect("a program");
    let mut woven = woven(&program);
    assert_refers_back(&woven);
    let octants: Vec<Octant<Term>> = woven
        .steps
        .iter()
        .filter_map(|step| if let Step::Sines(_, of) = step { Some(*of) } else { None })
        .collect();
    let [Octant { shifted, sine, cosine }] = octants[..] else { panic!("two angles are a pair") };
    woven.outputs = [shifted, sine, cosine]
        .into_iter()
        .flat_map(|term| match term {
            Term::Step(at) => [Lane::First, Lane::Second].map(|lane| Scalar::Lane(at, lane)),
            Term::Constant(_) => panic!("sines depend on their angles"),
        })
        .collect();
    let angles = [0.5, -40.0];
    let expected = angles.map(|x| Octant::new(x, SHIFT, |constant| constant));
    let found = woven.evaluate(&program, &|symbol| angles[symbol.index()], &|_| f64::NAN);
    let [x, y] = expected;
    assert_eq!(found, [x.shifted, y.shifted, x.sine, y.sine, x.cosine, y.cosine]);
}

/// A quotient is there before the sine of an angle. But where a run reads its angle from a result of
/// the run before, the next run waits for the sine, and what ends with the run has time.
#[test]
fn what_the_next_run_waits_for_comes_before_what_ends_with_a_run() {
    let (mut arena, [angle, x, y]) = letters();
    let sine = arena.call(Function::Sin, angle);
    let next = arena.mul(sine, x);
    let end = arena.div(x, y).expect("a quotient");
    let program = lower_whole(&mut arena, &[next, end], 1024).expect("a program");
    let places = |woven: &Woven| [0, 1].map(|at| woven.outputs[at].step().expect("a step"));
    let [next, end] = places(&woven(&program));
    assert!(end < next);
    let [next, end] = places(&woven_for_runs(&program, &|symbol| (symbol.index() == 0).then_some(0)));
    assert!(next < end);
}
