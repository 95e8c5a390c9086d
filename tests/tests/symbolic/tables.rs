//! Functions through points in the four ways of interpolation, inside and outside of their points, beside SciPy.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_symbolic::Interpolation::{self, Cubic, Linear, Monotone, Step};
use mbs_symbolic::Outside::{self, Extend, Hold, Periodic, Refuse};
use mbs_symbolic::{Arena, Spline, Stage};

const POINTS: [(f64, f64); 6] = [(-0.5, 2.0), (0.1, -1.0), (1.4, 0.5), (1.6, 0.7), (3.0, 0.7), (3.7, -2.0)];
const AT: [f64; 9] = [-0.4, 0.0, 0.1, 0.9, 1.45, 1.6, 2.3, 3.2, 3.7];

fn table(interpolation: Interpolation, outside: Outside) -> Spline {
    Spline::through("f", &POINTS, interpolation, outside).expect("points in order")
}

/// Values and two derivatives at [`AT`].
fn compare(spline: &Spline, expected: [[f64; 9]; 3]) {
    for (order, expected) in (0..).zip(expected) {
        for (x, expected) in AT.into_iter().zip(expected) {
            let found = spline.derivative(order, x);
            // third derivatives reach 100: twenty roundings of terms of that size
            assert!((found - expected).abs() < 2000.0 * f64::EPSILON, "{order} at {x}: {found} {expected}");
        }
    }
}

/// `CubicSpline(x, y, bc_type="natural")` of SciPy 1.17.1.
#[test]
fn a_cubic_table_is_the_natural_spline() {
    compare(
        &table(Cubic, Hold),
        [
            [
                1.3876239929469854,
                -0.6765908682261663,
                -1.0,
                -0.5640053047525944,
                0.5601830834388056,
                0.7,
                1.291604641852854,
                0.09573123710170758,
                -2.0,
            ],
            [
                -6.0595452093569975,
                -3.747810207123548,
                -2.6882649977665505,
                2.388040098243973,
                1.0957388397672094,
                0.8885935326326392,
                0.4008527220449012,
                -3.494963271993918,
                // SciPy has the slope at the last point; here the value holds from there on
                0.0,
            ],
            [
                1.9264458351945453,
                9.632229175972705,
                11.558675011167242,
                1.1320877288590676,
                -3.7831050792423104,
                1.0211676507813752,
                -2.4147128238891997,
                -4.178995213256984,
                0.0,
            ],
        ],
    );
}

/// `PchipInterpolator(x, y)` of SciPy 1.17.1.
#[test]
fn a_monotone_table_is_that_of_fritsch_and_butland() {
    compare(
        &table(Monotone, Refuse),
        [
            [
                1.2956027890238417,
                -0.8742127755285649,
                -1.0,
                -0.194385763596224,
                0.560866809672387,
                0.7,
                0.7,
                0.3746355685131191,
                -2.0,
            ],
            [
                -7.059716599190284,
                -2.430836707152497,
                0.0,
                1.5389017927581008,
                1.3224453978159112,
                0.0,
                0.0,
                -3.043731778425657,
                -5.142857142857143,
            ],
            [
                1.3832658569500644,
                21.76113360323887,
                3.705378984390147,
                0.1418754975051053,
                1.8369734789391492,
                0.0,
                0.0,
                -12.069970845481041,
                3.6734693877550946,
            ],
        ],
    );
}

/// `CubicSpline(x, y, bc_type="periodic")` of SciPy 1.17.1, whose last point is the first one again. A period behind
/// the first point the argument is that of the first point, so the last column is that of -0.5.
#[test]
fn a_periodic_table_returns() {
    let closed = Spline::through("f", &POINTS[..5], Cubic, Periodic(4.2)).expect("points in order");
    let values = [
        1.6787964579740682,
        -0.5260782895409795,
        -1.0,
        -0.7811417479998475,
        0.5722012188553259,
        0.7,
        0.33654426434193063,
        1.307155608125077,
        2.0,
    ];
    let slopes = [
        -4.081815204995074,
        -5.303560552459784,
        -4.072436282963109,
        2.8118454478497927,
        1.2851097629124373,
        0.4515934511589357,
        -0.7450192050909958,
        3.263430213527619,
        -2.239818261766043,
    ];
    let curvatures = [
        -15.34684821956461,
        9.238121482241063,
        15.384363907692475,
        1.8263404193397683,
        -6.211164721204411,
        -4.902386102175599,
        1.483492798604364,
        -0.5199032561586305,
        -21.493090645016025,
    ];
    compare(&closed, [values, slopes, curvatures]);
}

/// Straight lines have their chords' slopes, and no curvature; steps have no slope.
#[test]
fn lines_and_steps() {
    let chords = [-5.0, -5.0, 1.5 / 1.3, 1.5 / 1.3, 1.0, 0.0, 0.0, -2.7 / 0.7, -2.7 / 0.7];
    let values = [1.5, -0.5, -1.0, -1.0 + 0.8 * 1.5 / 1.3, 0.55, 0.7, 0.7, 0.7 - 0.2 * 2.7 / 0.7, -2.0];
    compare(&table(Linear, Extend), [values, chords, [0.0; 9]]);
    let held = [2.0, 2.0, -1.0, -1.0, 0.5, 0.7, 0.7, 0.7, -2.0];
    compare(&table(Step, Extend), [held, [0.0; 9], [0.0; 9]]);
    assert_eq!([Linear, Step, Cubic, Monotone].map(|it| table(it, Extend).degree()), [1, 0, 3, 3]);
}

/// At the ends and beyond them, for each rule: a value that holds, a line that goes on, no number.
#[test]
fn outside_of_the_points() {
    for interpolation in [Linear, Cubic, Monotone, Step] {
        let [hold, extend, refuse] = [Hold, Extend, Refuse].map(|outside| table(interpolation, outside));
        for (x, expected) in [(-0.5, 2.0), (-1.0, 2.0), (-1e9, 2.0), (3.7, -2.0), (4.0, -2.0), (1e9, -2.0)] {
            assert_eq!(hold.derivative(0, x), expected, "{interpolation:?} {x}");
        }
        assert_eq!([-1.0, 4.0].map(|x| hold.derivative(1, x)), [0.0; 2]);
        for x in [(-0.5_f64).next_up(), -0.5, 1.0, 3.7] {
            assert_eq!(refuse.derivative(0, x), hold.derivative(0, x), "{interpolation:?} {x}");
        }
        for x in [-0.6, 3.7_f64 + 1e-14, 4.0, -1e9, 1e9] {
            for order in 0..=refuse.degree() {
                assert!(refuse.derivative(order, x).is_nan(), "{interpolation:?} {order} {x}");
            }
        }
        // what is outside continues the cubic next to it: a fourth difference across the end vanishes
        let ends = [(-0.5, 0.1), (3.7, 0.1)];
        for (end, h) in ends.into_iter().filter(|_| matches!(interpolation, Linear | Cubic)) {
            let values = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| extend.derivative(0, end + h * k));
            let difference = values[0] - 4.0 * values[1] + 6.0 * values[2] - 4.0 * values[3] + values[4];
            assert!(difference.abs() < 1e-13, "{interpolation:?} {end} {difference:e}");
        }
        // a monotone one goes on by the lines that touch its ends
        for (end, out) in [(-0.5, -0.3), (3.7, 0.3)].into_iter().filter(|_| interpolation == Monotone) {
            let [value, slope] = [0, 1].map(|order| refuse.derivative(order, end));
            assert!((extend.derivative(0, end + out) - (value + slope * out)).abs() < 1e-14);
            assert_eq!(extend.derivative(2, end + out), 0.0);
        }
        for spline in [&hold, &extend, &refuse] {
            assert!(spline.derivative(0, f64::NAN).is_nan());
        }
    }
}

/// A monotone table of ten thousand points that rise does not fall anywhere.
#[test]
fn a_monotone_table_rises_where_its_points_do() {
    let step = |k: u32| 0.1 + f64::from(k * 7919 % 101) / 101.0;
    let points: Vec<_> = (0..10_000)
        .scan((0.0, 0.0), |at, k| {
            *at = (at.0 + step(k), at.1 + step(k + 13).powi(5));
            Some(*at)
        })
        .collect();
    let spline = Spline::through("f", &points, Monotone, Hold).expect("points in order");
    let end = points[9_999].0;
    let values: Vec<f64> = (0..100_000).map(|k| spline.derivative(0, end * f64::from(k) / 1e5)).collect();
    assert!(values.windows(2).all(|pair| pair[0] <= pair[1]));
}

#[test]
fn refuses_points_that_make_no_table() {
    let refused = |points: &[(f64, f64)], outside| {
        [Linear, Cubic, Monotone, Step].map(|it| Spline::through("f", points, it, outside).is_none())
    };
    assert_eq!(refused(&POINTS[..1], Hold), [true; 4]);
    assert_eq!(refused(&POINTS[..2], Hold), [false; 4]);
    // one piece of a periodic spline would be a cubic that joins itself
    assert_eq!(refused(&POINTS[..2], Periodic(1.0)), [false, true, false, false]);
    assert_eq!(refused(&[(0.0, 0.0), (0.0, 1.0)], Hold), [true; 4]);
    assert_eq!(refused(&[(0.0, 0.0), (1.0, f64::NAN)], Extend), [true; 4]);
}

/// The derivative of a line is a step, whose derivative is 0: the compiler knows it.
#[test]
fn derivatives_end_with_the_degree() {
    let mut arena = Arena::new();
    let symbol = arena.symbol("x", Stage::Variable);
    let x = arena.variable(symbol);
    for (interpolation, degree) in [(Linear, 1), (Step, 0), (Cubic, 3)] {
        let id = arena.add_spline(table(interpolation, Extend));
        let mut value = arena.spline(id, x);
        for _ in 0..degree {
            value = arena.partial(value, symbol);
            assert!(!arena.is_zero(value));
        }
        let next = arena.partial(value, symbol);
        assert!(arena.is_zero(next), "{interpolation:?}");
    }
}
