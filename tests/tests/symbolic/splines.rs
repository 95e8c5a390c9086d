//! Periodic splines pass through their points with two continuous derivatives,
//! come close to smooth functions at the order that the theory promises, and are
//! differentiated, printed and run like any other function.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_symbolic::{Arena, Spline, Stage, lower_whole};

/// Unequal distances, from a negative argument on.
const POINTS: [(f64, f64); 5] = [(-0.5, 2.0), (0.1, -1.0), (1.4, 0.5), (1.6, 0.7), (3.0, -2.0)];
const PERIOD: f64 = 4.0;

fn spline() -> Spline {
    Spline::periodic("f", &POINTS, PERIOD).expect("points in order")
}

/// The end of every segment meets the beginning of the next one, in value, slope
/// and curvature: conditions that only one such spline satisfies.
#[test]
fn joins_its_points_smoothly() {
    let spline = spline();
    for (at, (x, y)) in POINTS.iter().enumerate() {
        assert_eq!(spline.derivative(0, *x), *y);
        let before = &spline.segments[(at + POINTS.len() - 1) % POINTS.len()];
        let end = if at == 0 { PERIOD } else { spline.segments[at].from };
        let u = end - before.from;
        let [c0, c1, c2, c3] = before.coefficients;
        let from_left =
            [c0 + u * (c1 + u * (c2 + u * c3)), c1 + u * (2.0 * c2 + u * 3.0 * c3), 2.0 * c2 + u * 6.0 * c3];
        for (order, left) in from_left.into_iter().enumerate() {
            // curvatures reach 100 where points are 0.2 apart; ten operations
            let right = spline.derivative(order as u8, *x);
            assert!((left - right).abs() < 1000.0 * f64::EPSILON, "{order} at {x}: {left} {right}");
        }
    }
}

/// Whole periods make no difference, whatever the sign; binary fractions keep
/// every step of the wrapping exact.
#[test]
fn is_periodic() {
    let points = [(-0.5, 2.0), (0.125, -1.0), (1.5, 0.5), (3.0, -2.0)];
    let spline = Spline::periodic("f", &points, PERIOD).expect("points in order");
    for k in 0..64 {
        let x = f64::from(k) / 16.0 - 1.0;
        for turns in [-1000.0, -3.0, -1.0, 1.0, 7.0] {
            for order in 0..4 {
                assert_eq!(spline.derivative(order, x + turns * PERIOD), spline.derivative(order, x));
            }
        }
    }
}

/// A cosine from n samples: the error of the values falls as n⁻⁴, 5/384 h⁴ at
/// most, that of the curvature as n⁻².
#[test]
fn comes_close_to_a_cosine() {
    use std::f64::consts::TAU;
    let errors = |n: u32| {
        let points: Vec<_> =
            (0..n).map(|k| TAU * f64::from(k) / f64::from(n)).map(|x| (x, x.cos())).collect();
        let spline = Spline::periodic("cosine", &points, TAU).expect("points in order");
        let worst = |order: u8, exact: fn(f64) -> f64| {
            let deviation = |k: u32| {
                let x = TAU * (f64::from(k) / 1000.0 - 2.0);
                (spline.derivative(order, x) - exact(x)).abs()
            };
            (0..4000).map(deviation).fold(0.0, f64::max)
        };
        (worst(0, f64::cos), worst(2, |x| -x.cos()))
    };
    for n in [16, 32, 64] {
        let h = TAU / f64::from(n);
        let (value, curvature) = errors(n);
        assert!(value < 5.0 / 384.0 * h.powi(4), "{n}: {value:e}");
        let (finer_value, finer_curvature) = errors(2 * n);
        // 16 and 4 up to terms of the next order, some h² of it
        assert!((value / finer_value / 16.0 - 1.0).abs() < 0.1 * h, "{n}: {}", value / finer_value);
        assert!((curvature / finer_curvature / 4.0 - 1.0).abs() < 0.1 * h, "{n}");
    }
}

#[test]
fn refuses_points_that_make_no_spline() {
    let refused = |points: &[(f64, f64)], period| Spline::periodic("f", points, period).is_none();
    assert!(refused(&POINTS[..2], 4.0));
    assert!(refused(&POINTS, 3.5));
    assert!(refused(&[(0.0, 0.0), (2.0, 1.0), (1.0, 0.0)], 4.0));
    assert!(refused(&[(0.0, 0.0), (f64::NAN, 1.0), (1.0, 0.0)], 4.0));
    assert!(refused(&[(0.0, 0.0), (1e-300, 1e300), (1.0, 0.0)], 4.0));
    assert!(refused(&POINTS, f64::INFINITY));
}

#[test]
fn is_a_function_among_others() {
    let mut arena = Arena::new();
    let symbol = arena.symbol("x", Stage::Variable);
    let x = arena.variable(symbol);
    let id = arena.add_spline(spline());
    let square = arena.powi(x, 2);
    let value = arena.spline(id, square);
    let mut derivatives = vec![value];
    for _ in 0..4 {
        derivatives.push(arena.partial(derivatives[derivatives.len() - 1], symbol));
    }
    assert_eq!(arena.display(derivatives[1]), "2*x*f'(x^2)");
    assert_eq!(arena.display(derivatives[2]), "2*f'(x^2) + 4*x^2*f''(x^2)");
    let program = lower_whole(&mut arena, &derivatives, 1024).expect("a program");
    assert_eq!(program.operations().other, 4);
    let at = |x: f64| arena.evaluate(&derivatives, &|_| x);
    // central differences; between points derivatives stay below 10⁴
    let h = f64::EPSILON.cbrt();
    for x in [-1.9, -0.4, 0.0, 0.7, 1.3, 5.5] {
        let (here, before, behind) = (at(x), at(x - h), at(x + h));
        for order in 0..4 {
            let slope = (behind[order] - before[order]) / (2.0 * h);
            assert!((slope - here[order + 1]).abs() < 1e4 * h * h * (1.0 + slope.abs()), "{order} at {x}");
        }
        for (ours, theirs) in program.evaluate(&|_| x, &[]).iter().zip(&here) {
            assert!((ours - theirs).abs() <= 8.0 * f64::EPSILON * theirs.abs(), "{ours} {theirs}");
        }
    }
    // of a constant it is one
    let half = arena.number(mbs_symbolic::Number::ratio(1, 2));
    let constant = arena.spline(id, half);
    assert_eq!(arena.as_number(constant).map(|n| n.to_f64()), Some(spline().derivative(0, 0.5)));
}
