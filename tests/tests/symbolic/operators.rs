//! Every row of the table of functions is complete, and all who compute with a function compute the same:
//! floats, slopes, numbers that move, bounds of errors, expressions, programs, tangents and transposes.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_symbolic::{
    Arena, Arithmetic, FUNCTIONS, Function, Jet, Number, Numeric, Operand, Parity, Pieces, Range, Rounded,
    Row, Stage, Tape, lower_whole,
};

/// Arguments in the domain of every function, away from where pieces meet.
const POINTS: [[f64; 2]; 3] = [[0.3, 0.7], [0.8, 0.2], [0.55, 0.6]];

/// The same, with equal arguments for a function of one.
fn points(row: &Row) -> impl Iterator<Item = [f64; 2]> + use<> {
    let is_of_one = row.arity == 1;
    POINTS.into_iter().map(move |[x, y]| [x, if is_of_one { x } else { y }])
}

/// f′(0) by differences of the fourth order.
fn difference(f: impl Fn(f64) -> f64) -> f64 {
    let h = 1e-3;
    (8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h)
}

fn assert_near(row: &Row, what: &str, found: f64, expected: f64) {
    let tolerance = 1e-9 * (1.0 + expected.abs());
    assert!((found - expected).abs() < tolerance, "{what} of {}: {found} and {expected}", row.name);
}

#[test]
fn slopes_are_those_of_values() {
    for row in FUNCTIONS {
        for [x, y] in points(row) {
            let slopes = row.function.slopes(x, y, (row.value)(x, y));
            assert_near(row, "slope", slopes[0], difference(|h| (row.value)(x + h, y)));
            let across = if row.arity == 1 { 0.0 } else { difference(|h| (row.value)(x, y + h)) };
            assert_near(row, "second slope", slopes[1], across);
        }
    }
}

/// f(x + s, y − s/2 + s²) and two derivatives by s at s = 0: of expressions, programs, jets, tangents and transposes.
#[test]
fn all_ways_to_compute_agree() {
    for row in FUNCTIONS {
        let mut arena = Arena::new();
        let s = arena.symbol("s", Stage::Variable);
        for [x, y] in points(row) {
            let [x_of_s, y_of_s] = [[x, 1.0, 0.0], [y, -0.5, 1.0]].map(|[value, first, second]| {
                let variable = arena.variable(s);
                let terms = [(value, 0), (first, 1), (second, 2)].map(|(factor, exponent)| {
                    let power = arena.powi(variable, exponent);
                    (power, Number::from(factor))
                });
                arena.sum(&terms)
            });
            let arguments = if row.arity == 1 { [x_of_s; 2] } else { [x_of_s, y_of_s] };
            let f = arena.apply(row.function, arguments);
            let first = arena.partial(f, s);
            let roots = [f, first, arena.partial(first, s)];
            let values = arena.evaluate(&roots, &|_| 0.0);
            assert_eq!(values[0].to_bits(), (row.value)(x, y).to_bits(), "{}", row.name);
            let along = |s: f64| (row.value)(x + s, y - s / 2.0 + s * s);
            assert_near(row, "derivative", values[1], difference(along));

            let program = lower_whole(&mut arena, &roots, 1024).expect("a program");
            let of_program = program.evaluate(&|_| 0.0, &[]);
            let jet = Jet { value: 0.0, first: 1.0, second: 0.0 };
            let jet = Tape::new(&arena, &[f]).jets(&arena, &|_| jet)[0];
            for (at, of_jet) in [jet.value, jet.first, jet.second].into_iter().enumerate() {
                assert_near(row, "result of the program", of_program[at], values[at]);
                assert_near(row, "jet", of_jet, values[at]);
            }

            let (input, one) = (Operand::Symbol(s), Operand::Number(Number::ONE));
            let value = lower_whole(&mut arena, &[f], 1024).expect("a program");
            let tangent = value.along(&[(input, one)]).expect("a tangent").evaluate(&|_| 0.0, &[]);
            assert_near(row, "tangent", tangent[0], values[1]);
            let transpose = value.with_adjoint(&[one], &[input]).expect("a transpose");
            assert_near(row, "transpose", transpose.evaluate(&|_| 0.0, &[])[1], values[1]);
        }
    }
}

/// An argument within its error leads to a value within the bound, and nothing is known near a step.
#[test]
fn bounds_of_errors_hold() {
    let wide = |value: f64| Rounded { value, error: 1e-6 };
    for row in FUNCTIONS {
        for [x, y] in points(row) {
            let Rounded { value, error } = wide(x).call(row.function, wide(y));
            assert_eq!(value.to_bits(), (row.value)(x, y).to_bits(), "{}", row.name);
            assert_eq!(
                error == 0.0,
                matches!(row.pieces, Pieces::Steps | Pieces::Seamless),
                "{}: {error}",
                row.name
            );
            for [dx, dy] in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
                let moved = (row.value)(x + 1e-6 * dx, y + 1e-6 * dy);
                assert!((moved - value).abs() <= 1.001 * error, "{}: {moved} {value} {error}", row.name);
            }
        }
        if row.pieces == Pieces::Steps {
            let at_step = wide(0.0).call(row.function, wide(0.0));
            assert!(at_step.error.is_infinite(), "{}", row.name);
        }
    }
}

#[test]
fn properties_hold() {
    for row in FUNCTIONS {
        assert_eq!(Function::named(row.name), row.is_word.then_some(row.function));
        assert_eq!(row.function.row().name, row.name);
        for [x, y] in points(row) {
            let (value, mirrored) = ((row.value)(x, y), (row.value)(-x, y));
            match row.parity {
                Parity::Odd => assert_eq!(mirrored, -value, "{}", row.name),
                Parity::Even => assert_eq!(mirrored, value, "{}", row.name),
                Parity::Neither => {
                    assert!(mirrored.is_nan() || mirrored.abs() != value.abs() || row.arity == 2)
                }
            }
            for value in [value, mirrored].into_iter().filter(|value| !value.is_nan()) {
                match row.range {
                    Range::All => {}
                    Range::NotNegative => assert!(value >= 0.0, "{}", row.name),
                    Range::Unit => assert!(value.abs() <= 1.0, "{}", row.name),
                }
            }
            if let Some(of_turn) = row.of_turn {
                let third = mbs_symbolic::Real::pi(2, 3);
                assert!(third.turn().and_then(of_turn).is_some(), "{}", row.name);
            }
            if let Some(of_number) = row.of_number {
                assert_eq!(of_number(Number::ratio(9, 4)).map(Number::to_f64), Some((row.value)(2.25, 0.0)));
            }
        }
    }
}

/// A number that does not move may stand where a function has no slope.
#[test]
fn still_numbers_have_no_derivative() {
    for function in [Function::Sqrt, Function::Asin] {
        let edge = if function == Function::Sqrt { 0.0 } else { 1.0 };
        let still: mbs_symbolic::Moving<f64> = Numeric::number(Number::from(edge));
        let found = still.of(function);
        assert!((found - found).is_zero(), "{function:?}");
    }
}
