//! Constants: exact as long as they fit, nearest floats beyond, one total order.

use std::cmp::Ordering;

use mbs_symbolic::Number;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

fn is_near(number: Number, expected: f64) -> bool {
    let found = number.to_f64();
    // numerator, denominator and quotient are rounded once each
    found == expected || (found - expected).abs() <= 3.0 * f64::EPSILON * expected.abs()
}

fn numbers() -> impl Strategy<Value = Number> {
    prop_oneof![
        (any::<i64>(), 1_i64..).prop_map(|(n, d)| Number::ratio(n, d)),
        (-9_i64..10, 1_i64..10).prop_map(|(n, d)| Number::ratio(n, d)),
        any::<f64>().prop_map(Number::float),
        (-9_i64..10).prop_map(|n| Number::float(n as f64)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..Default::default() })]

    /// Against the exact result in 128 bits: exact if it fits, else its float.
    #[test]
    fn sums_and_products_are_exact_or_the_nearest_float(
        a in any::<i64>(), b in 1_i64.., c in any::<i64>(), d in 1_i64..
    ) {
        let (x, y) = (Number::ratio(a, b), Number::ratio(c, d));
        let (wa, wb, wc, wd) = (i128::from(a), i128::from(b), i128::from(c), i128::from(d));
        for (found, numerator, denominator) in
            [(x + y, wa * wd + wc * wb, wb * wd), (x * y, wa * wc, wb * wd)]
        {
            prop_assert!(is_near(found, numerator as f64 / denominator as f64));
            if let Number::Rational(n, d) = found {
                prop_assert_eq!(i128::from(n) * (denominator / gcd(numerator, denominator)),
                    (numerator / gcd(numerator, denominator)) * i128::from(d));
            }
        }
    }

    /// Small rationals never become floats.
    #[test]
    fn small_rationals_stay_exact(a in -1000_i64..1000, b in 1_i64..1000, c in -1000_i64..1000, d in 1_i64..1000) {
        let (x, y) = (Number::ratio(a, b), Number::ratio(c, d));
        for number in [x + y, x * y, -x, x.powi(3), x.abs()] {
            prop_assert!(matches!(number, Number::Rational(..)), "{number:?}");
        }
        prop_assert_eq!(x + y, y + x);
        prop_assert_eq!((x + y) + (-y), x);
        if c != 0 {
            prop_assert_eq!((x * y) * y.recip(), x);
        }
    }

    #[test]
    fn order_is_total(a in numbers(), b in numbers(), c in numbers()) {
        prop_assert_eq!(a.cmp(&b), b.cmp(&a).reverse());
        prop_assert_eq!(a.cmp(&b) == Ordering::Equal, a == b);
        if a <= b && b <= c {
            prop_assert!(a <= c, "{a:?} {b:?} {c:?}");
        }
        if a == b {
            prop_assert_eq!(format!("{a:?}"), format!("{b:?}"));
        }
    }

    /// A literal has the value that Rust gives it, to the last place.
    #[test]
    fn literals_have_their_value(whole in 0_u64..1_000_000_000, fraction in 0_u32..1_000_000, exponent in -30_i32..30) {
        let text = format!("{whole}.{fraction:06}e{exponent}");
        let number = Number::parse(&text);
        prop_assert!(number.is_some());
        let expected: f64 = text.parse().map_err(|_| TestCaseError::fail("a literal"))?;
        prop_assert!(number.is_some_and(|number| is_near(number, expected)), "{text}: {number:?}");
    }
}

fn gcd(a: i128, b: i128) -> i128 {
    if b == 0 { a.abs().max(1) } else { gcd(b, a % b) }
}

#[test]
fn results_that_do_not_fit_are_floats_of_the_right_size() {
    let big = Number::integer(i64::MAX);
    let small = Number::ratio(1, i64::MAX);
    assert!(is_near(big + big, 2.0 * i64::MAX as f64));
    assert!(is_near(big * big, (i64::MAX as f64).powi(2)));
    assert!(is_near(small * small, (i64::MAX as f64).powi(-2)));
    assert!(is_near(Number::ratio(1, 3).powi(-41), 3_f64.powi(41)));
    assert!(is_near(Number::ratio(i64::MIN, -1), -(i64::MIN as f64)));
    assert!(is_near(-Number::integer(i64::MIN), -(i64::MIN as f64)));
    assert!(is_near(Number::integer(i64::MIN).recip(), 1.0 / i64::MIN as f64));
    assert_eq!(big + -big, Number::ZERO);
}

#[test]
fn division_by_zero_is_infinite_and_nothing_panics() {
    assert_eq!(Number::ZERO.recip().to_f64(), f64::INFINITY);
    assert_eq!(Number::ratio(3, 0).to_f64(), f64::INFINITY);
    assert!(Number::ratio(0, 0).to_f64().is_nan());
    assert_eq!(Number::ZERO.powi(0), Number::ONE);
    assert_eq!(Number::ZERO.powi(-2).to_f64(), f64::INFINITY);
    assert_eq!(Number::MINUS_ONE.sqrt(), None);
    assert_eq!(Number::integer(10).powi(400).to_f64(), f64::INFINITY);
}
