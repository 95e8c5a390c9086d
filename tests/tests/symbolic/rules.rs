//! Every rule of simplification by itself: what it does, and what it leaves
//! alone because its condition does not hold.

use mbs_symbolic::{Arena, Expr, Function, Number, Stage};

struct Letters {
    a: Arena,
    x: Expr,
    y: Expr,
    z: Expr,
}

fn letters() -> Letters {
    let mut a = Arena::new();
    let mut letter = |name: &str| {
        let symbol = a.symbol(name, Stage::Variable);
        a.variable(symbol)
    };
    let (x, y, z) = (letter("x"), letter("y"), letter("z"));
    Letters { a, x, y, z }
}

fn int(value: i64) -> Number {
    Number::integer(value)
}

#[test]
fn like_terms_are_collected_exactly() {
    let Letters { mut a, x, y, .. } = letters();
    let third = Number::ratio(1, 3);
    assert_eq!(a.sum(&[(x, third), (x, third), (x, third)]), x);
    assert_eq!(a.sum(&[(x, int(2)), (y, int(3)), (x, int(-2))]), a.scale(y, int(3)));
    let nested = a.sum(&[(x, int(1)), (y, int(2))]);
    let flat = a.sum(&[(x, int(4)), (y, int(6))]);
    assert_eq!(a.sum(&[(nested, int(3)), (x, int(1))]), flat);
    // one tenth is no binary fraction; ten of them are one all the same
    let tenth = Number::parse("0.1").expect("a number");
    let terms = [(x, tenth); 10];
    assert_eq!(a.sum(&terms), x);
}

#[test]
fn order_does_not_matter() {
    let Letters { mut a, x, y, z } = letters();
    let one = Number::ONE;
    assert_eq!(a.sum(&[(x, one), (y, one), (z, one)]), a.sum(&[(z, one), (x, one), (y, one)]));
    assert_eq!(a.product(&[(x, 1), (y, 2), (z, -1)]), a.product(&[(z, -1), (y, 2), (x, 1)]));
    let (xy, yz) = (a.mul(x, y), a.mul(y, z));
    assert_eq!(a.mul(xy, z), a.mul(x, yz));
}

#[test]
fn equal_factors_are_collected() {
    let Letters { mut a, x, y, .. } = letters();
    assert_eq!(a.div(x, x), Some(a.one()));
    let square = a.powi(x, 2);
    assert_eq!(a.div(square, x), Some(x));
    let product = a.mul(x, y);
    assert_eq!(a.div(product, y), Some(x));
    let cube = a.powi(x, 3);
    let inverse = a.powi(cube, -1);
    assert_eq!(a.mul(cube, inverse), a.one());
    let sum = a.add(x, y);
    assert_eq!(a.div(sum, sum), Some(a.one()));
}

#[test]
fn coefficients_move_in_front_of_products() {
    let Letters { mut a, x, y, .. } = letters();
    let (two_x, three_y) = (a.scale(x, int(2)), a.scale(y, int(3)));
    let xy = a.mul(x, y);
    assert_eq!(a.mul(two_x, three_y), a.scale(xy, int(6)));
    let inverse = a.powi(two_x, -2);
    let plain = a.powi(x, -2);
    assert_eq!(inverse, a.scale(plain, Number::ratio(1, 4)));
}

#[test]
fn zero_and_one_disappear() {
    let Letters { mut a, x, .. } = letters();
    let (zero, one) = (a.zero(), a.one());
    assert_eq!(a.mul(x, zero), zero);
    assert_eq!(a.mul(x, one), x);
    assert_eq!(a.add(x, zero), x);
    assert_eq!(a.powi(x, 0), one);
    assert_eq!(a.powi(x, 1), x);
    assert_eq!(a.sub(x, x), zero);
    assert_eq!(a.div(x, zero), None);
    assert_eq!(a.div(zero, x), Some(zero));
}

#[test]
fn squares_of_sine_and_cosine_of_one_angle_are_one() {
    let Letters { mut a, x, y, z } = letters();
    let (s, c) = (a.call(Function::Sin, x), a.call(Function::Cos, x));
    let (ss, cc) = (a.powi(s, 2), a.powi(c, 2));
    assert_eq!(a.add(ss, cc), a.one());
    // with a common factor, and among other terms
    let (rs, rc) = (a.mul(y, ss), a.mul(y, cc));
    assert_eq!(a.sum(&[(rs, int(3)), (z, int(1)), (rc, int(3))]), a.sum(&[(y, int(3)), (z, int(1))]));
    // with different coefficients what is left is one square
    let rest = a.sum(&[(ss, int(3)), (a.one(), int(2))]);
    assert_eq!(a.sum(&[(ss, int(5)), (cc, int(2))]), rest);
    // higher powers: s⁴ + s²c² = s²
    let (s4, s2c2) = (a.powi(s, 4), a.mul(ss, cc));
    assert_eq!(a.add(s4, s2c2), ss);
}

#[test]
fn squares_of_different_angles_stay() {
    let Letters { mut a, x, y, .. } = letters();
    let (s, c) = (a.call(Function::Sin, x), a.call(Function::Cos, y));
    let (ss, cc) = (a.powi(s, 2), a.powi(c, 2));
    let sum = a.add(ss, cc);
    assert_eq!(a.operands(sum).len(), 2);
    // and so does 1 with only one of the two: 1 − sin²x is not shorter as cos²x
    let one = a.one();
    let difference = a.sub(one, ss);
    assert_eq!(a.operands(difference), [ss]);
}

#[test]
fn square_of_a_root_is_its_argument() {
    let Letters { mut a, x, y, .. } = letters();
    let root = a.call(Function::Sqrt, x);
    assert_eq!(a.powi(root, 2), x);
    assert_eq!(a.mul(root, root), x);
    assert_eq!(a.powi(root, -2), a.powi(x, -1));
    assert_eq!(a.powi(root, 3), a.mul(x, root));
    // but √(x²) is |x|, not x, and is left alone
    let square = a.powi(x, 2);
    let of_square = a.call(Function::Sqrt, square);
    assert_ne!(of_square, x);
    let product = a.mul(x, y);
    assert_ne!(a.call(Function::Sqrt, product), product);
}

/// √√x to the fourth power is x, in one step or in two.
#[test]
fn power_of_nested_roots_is_canonical() {
    let Letters { mut a, x, .. } = letters();
    let root = a.call(Function::Sqrt, x);
    let root = a.call(Function::Sqrt, root);
    let square = a.powi(root, 2);
    let in_two = a.powi(square, 2);
    assert_eq!(in_two, x);
    assert_eq!(a.powi(root, 4), x);
}

#[test]
fn powers_of_halves_are_roots() {
    let Letters { mut a, x, y, .. } = letters();
    let power = |a: &mut Arena, n, d| {
        let exponent = a.number(Number::ratio(n, d));
        a.pow(x, exponent)
    };
    let root = a.call(Function::Sqrt, x);
    assert_eq!(power(&mut a, 1, 2), root);
    assert_eq!(power(&mut a, -1, 2), a.powi(root, -1));
    assert_eq!(power(&mut a, 3, 1), a.powi(x, 3));
    assert_eq!(power(&mut a, 3, 2), a.mul(x, root));
    let third = power(&mut a, 1, 3);
    assert_eq!(a.operands(third).len(), 2);
    let general = a.pow(x, y);
    assert_eq!(a.operands(general), [x, y]);
}

#[test]
fn odd_functions_let_signs_out_and_even_ones_drop_them() {
    let Letters { mut a, x, y, .. } = letters();
    let minus_x = a.neg(x);
    let difference = a.sub(x, y);
    let reversed = a.sub(y, x);
    for row in mbs_symbolic::FUNCTIONS.iter().filter(|row| row.arity == 1) {
        let (plain, mirrored) = (a.call(row.function, x), a.call(row.function, minus_x));
        let (one, other) = (a.call(row.function, difference), a.call(row.function, reversed));
        match row.parity {
            mbs_symbolic::Parity::Odd => {
                assert_eq!(mirrored, a.neg(plain), "{}", row.name);
                assert_eq!(one, a.neg(other), "{}", row.name);
                assert_eq!((row.value)(-0.3, 0.0), -(row.value)(0.3, 0.0));
            }
            mbs_symbolic::Parity::Even => {
                assert_eq!((mirrored, one), (plain, other), "{}", row.name);
                assert_eq!((row.value)(-0.3, 0.0), (row.value)(0.3, 0.0));
            }
            mbs_symbolic::Parity::Neither => assert_ne!(mirrored, plain, "{}", row.name),
        }
    }
}

#[test]
fn functions_of_constants_are_constants() {
    let Letters { mut a, .. } = letters();
    let quarter = a.number(Number::ratio(9, 4));
    assert_eq!(a.call(Function::Sqrt, quarter), a.number(Number::ratio(3, 2)));
    let zero = a.zero();
    assert_eq!(a.call(Function::Cos, zero), a.one());
    assert_eq!(a.call(Function::Sin, zero), zero);
    let (two, three) = (a.number(int(2)), a.number(int(3)));
    assert_eq!(a.call2(Function::Max, two, three), three);
    assert_eq!(a.call2(Function::Greater, two, three), zero);
}

/// A function without a finite value stays as it was written instead of becoming a
/// constant that is not a number.
#[test]
fn functions_without_a_value_stay() {
    let Letters { mut a, .. } = letters();
    let minus_one = a.number(Number::MINUS_ONE);
    for function in [Function::Sqrt, Function::Ln] {
        let call = a.call(function, minus_one);
        assert_eq!(a.as_number(call), None);
        assert!(a.evaluate(&[call], &|_| 0.0)[0].is_nan());
    }
    let zero = a.zero();
    let logarithm = a.call(Function::Ln, zero);
    assert_eq!(a.as_number(logarithm), None);
}

#[test]
fn shared_values_are_not_taken_apart_and_signs_stay_outside() {
    let Letters { mut a, x, y, .. } = letters();
    let sum = a.add(x, y);
    let shared = a.share(sum);
    assert_ne!(shared, sum);
    let twice = a.scale(shared, int(2));
    assert_eq!(a.operands(twice), [shared]);
    let negative = a.neg(sum);
    let product = a.mul(x, y);
    let of_product = a.share(product);
    let minus = a.neg(product);
    assert_eq!(a.share(minus), a.neg(of_product));
    assert_eq!(a.share(x), x);
    // a value and its sharing have the same derivative
    let symbol = a.symbols_in(x)[0];
    assert_eq!(a.partial(shared, symbol), a.one());
    assert_eq!(a.partial(negative, symbol), a.number(Number::MINUS_ONE));
}

/// Exponents multiply; what leaves the range of exponents must not come back
/// as another exponent.
#[test]
fn exponents_that_overflow_are_not_wrapped() {
    let Letters { mut a, x, .. } = letters();
    let mut power = x;
    for _ in 0..6 {
        let exponent = a.number(int(64));
        power = a.pow(power, exponent);
    }
    assert_ne!(power, a.one());
    assert_eq!(a.evaluate(&[power], &|_| 1.0 + 1e-12)[0].ln().round(), (64_f64.powi(6) * 1e-12).round());
}
