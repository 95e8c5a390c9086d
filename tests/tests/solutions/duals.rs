//! Duals compute the value of every function as the scalar does, to the last bit, and the
//! derivatives that the symbolic table of functions has, at kinks too; these are the slopes of
//! the functions, as differences find them.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::{Dual, Lanes, Real};
use mbs_symbolic::{Arena, FUNCTIONS, Function, Stage};
use tests::differences::slopes;
use tests::random::Random;

/// A function of programs on any scalar.
fn call<T: Real>(function: Function, x: T, y: T) -> T {
    match function {
        Function::Sin => x.sin(),
        Function::Cos => x.cos(),
        Function::Tan => x.tan(),
        Function::Asin => x.asin(),
        Function::Acos => x.acos(),
        Function::Atan => x.atan(),
        Function::Sqrt => x.sqrt(),
        Function::Exp => x.exp(),
        Function::Ln => x.ln(),
        Function::Tanh => x.tanh(),
        Function::Abs => x.abs(),
        Function::Sign => x.sign(),
        Function::Atan2 => x.atan2(y),
        Function::Min => x.min(y),
        Function::Max => x.max(y),
        Function::Pow => x.pow(y),
        Function::Greater | Function::Choice => x.greater(y),
        Function::Gate => x.gate(y),
    }
}

/// The derivatives by x and y that the symbolic engine makes of a function, at (x, y).
fn table(function: Function, x: f64, y: f64) -> [f64; 2] {
    let mut arena = Arena::new();
    let symbols = ["x", "y"].map(|name| arena.symbol(name, Stage::Variable));
    let [of_x, of_y] = symbols.map(|symbol| arena.variable(symbol));
    let is_of_two = function.row().arity == 2;
    let f = if is_of_two { arena.call2(function, of_x, of_y) } else { arena.call(function, of_x) };
    let partials = symbols.map(|symbol| arena.partial(f, symbol));
    let found = arena.evaluate(&partials, &|symbol| if symbol == symbols[0] { x } else { y });
    [found[0], found[1]]
}

/// x and y along which a function is smooth, with its value and seven derivatives below 10³.
fn smooth_points(function: Function, random: &mut Random) -> [f64; 2] {
    let mut signed = |low, high| random.between(low, high) * *random.of(&[-1.0, 1.0]);
    match function {
        Function::Asin | Function::Acos => [signed(0.0, 0.7), 0.0],
        Function::Tan => [signed(0.0, 0.9), 0.0],
        Function::Sqrt | Function::Ln => [random.between(0.8, 3.0), 0.0],
        Function::Pow => [random.between(0.8, 2.0), random.between(-2.0, 2.0)],
        Function::Abs | Function::Sign => [signed(0.1, 2.0), 0.0],
        Function::Atan2 => [signed(0.8, 2.0), signed(0.8, 2.0)],
        Function::Min | Function::Max | Function::Greater | Function::Choice => {
            [signed(0.1, 1.0), signed(1.1, 2.0)]
        }
        Function::Gate => [signed(0.1, 1.0), signed(0.1, 2.0)],
        _ => [signed(0.0, 2.0), 0.0],
    }
}

/// Products of at most four factors that were rounded, evaluated in two orders.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

fn variables(x: f64, y: f64) -> [Dual<f64, 2>; 2] {
    [Dual::variable(x, 0), Dual::variable(y, 1)]
}

#[test]
fn functions_have_the_derivatives_of_the_symbolic_table_and_of_differences() {
    let mut random = Random::new(3);
    for row in FUNCTIONS {
        for _ in 0..200 {
            let [x, y] = smooth_points(row.function, &mut random);
            let of = |dx: f64, dy: f64| call(row.function, x + dx, y + dy);
            let [of_x, of_y] = variables(x, y);
            let found = call(row.function, of_x, of_y);
            assert_eq!(found.value.to_bits(), of(0.0, 0.0).to_bits(), "{} at {x}, {y}", row.name);
            let along = slopes(x.abs().max(y.abs()), 1e-3, 4.0, |s| vec![of(s, 0.0), of(0.0, s)]);
            for (at, (table, slope)) in table(row.function, x, y).into_iter().zip(along).enumerate() {
                let partial = found.partials[at];
                let deviation = (partial - table).abs();
                assert!(
                    deviation <= ROUNDING * (1.0 + table.abs()),
                    "{} at {x}, {y}: {partial} {table}",
                    row.name
                );
                assert!(slope.is(partial), "{} at {x}, {y}: {partial} {slope:?}", row.name);
            }
        }
    }
}

/// Where pieces of a function meet, derivatives are those of the symbolic table.
#[test]
fn kinks_have_the_derivatives_of_the_symbolic_table() {
    for function in [Function::Abs, Function::Sign, Function::Min, Function::Max, Function::Greater] {
        for [x, y] in [[0.0, 0.0], [-0.0, 0.0], [1.5, 1.5], [-2.0, -2.0]] {
            let [of_x, of_y] = variables(x, y);
            let found = call(function, of_x, of_y);
            assert_eq!(found.partials, table(function, x, y), "{} at {x}, {y}", function.row().name);
        }
    }
    let [x, y] = variables(1.0, 1.0);
    assert_eq!((x.min(y).partials, x.max(y).partials), ([0.0, 1.0], [0.0, 1.0]));
    assert_eq!(Dual::<f64, 1>::variable(0.0, 0).abs().partials, [0.0]);
}

/// The quotient, the product and the sums, from their rules.
#[test]
fn operators_have_their_rules() {
    let mut random = Random::new(4);
    for _ in 0..200 {
        let [x, y] = [random.between(-2.0, 2.0), random.between(0.5, 2.0)];
        let [of_x, of_y] = variables(x, y);
        assert_eq!((of_x + of_y).partials, [1.0, 1.0]);
        assert_eq!((of_x - of_y).partials, [1.0, -1.0]);
        assert_eq!((-of_x).partials, [-1.0, -0.0]);
        assert_eq!((of_x * of_y).partials, [y, x]);
        let quotient = of_x / of_y;
        assert_eq!(quotient.value, x / y);
        for (partial, expected) in quotient.partials.into_iter().zip([1.0 / y, -x / (y * y)]) {
            assert!((partial - expected).abs() <= ROUNDING * expected.abs());
        }
    }
}

/// A partial derivative of zero stays zero where a slope is infinite or undefined: at the root of nothing, in
/// the exponent of a negative number.
#[test]
fn what_does_not_move_needs_no_slope() {
    let still = Dual::<f64, 2>::constant;
    assert_eq!(still(0.0).sqrt().partials, [0.0; 2]);
    assert_eq!(still(0.0).ln().partials, [0.0; 2]);
    let [x, y] = variables(-2.0, 3.0);
    let cube = x.pow(still(3.0));
    assert_eq!((cube.value, cube.partials), (-8.0, [12.0, 0.0]));
    let root = (Dual::variable(0.0, 0) * y).sqrt();
    assert!(root.partials[0].is_infinite() && root.partials[1] == 0.0, "{root}");
}

/// Decisions are those of values.
#[test]
fn decisions_are_those_of_values() {
    let [x, y] = [Dual::new(1.0, [5.0]), Dual::new(1.0, [f64::NAN])];
    assert!(
        x == y
            && x <= y
            && x.partial_cmp(&y) == Some(std::cmp::Ordering::Equal)
            && x.is_finite()
            && y.is_finite()
    );
    assert!(Dual::new(2.0, [0.0]) > x && !Dual::new(f64::NAN, [0.0]).is_finite());
    assert_eq!(Dual::<f64, 1>::new(0.25, [1.0]).to_string(), "0.25 [1]");
}

/// A dual of duals has second derivatives: (xy)″ = 2 along x = y = s.
#[test]
fn duals_of_duals_have_second_derivatives() {
    let s = Dual::<Dual<f64, 1>, 1>::new(Dual::new(0.7, [1.0]), [Dual::constant(1.0)]);
    let [Dual { partials: [second], .. }] = s.sin().partials;
    assert!((second + 0.7_f64.sin()).abs() < ROUNDING);
    let [Dual { value, partials: [second] }] = (s * s).partials;
    assert_eq!((value, second), (1.4, 2.0));
}

/// Duals of lanes differentiate several members at once; choices are made lane by lane.
#[test]
fn duals_of_lanes_choose_lane_by_lane() {
    let x = Dual::<Lanes<f64, 2>, 1>::new(Lanes([1.0, 3.0]), [Lanes([1.0, 1.0])]);
    let y = Dual::new(Lanes([2.0, 2.0]), [Lanes([0.0, 0.0])]);
    assert_eq!((x.min(y).value, x.min(y).partials), (Lanes([1.0, 2.0]), [Lanes([1.0, 0.0])]));
    assert_eq!((x.max(y).value, x.max(y).partials), (Lanes([2.0, 3.0]), [Lanes([0.0, 1.0])]));
}
