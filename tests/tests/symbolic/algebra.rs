//! Signs make the nodes that constructors make, and vectors are those of the plane.

use mbs_symbolic::{Algebra, Arena, Expr, Function, Number, Stage, Symbol};

const NAMES: [&str; 5] = ["a", "b", "c", "d", "phi"];

fn letters() -> (Arena, [Symbol; 5]) {
    let mut arena = Arena::new();
    let symbols = NAMES.map(|name| arena.symbol(name, Stage::Variable));
    (arena, symbols)
}

#[test]
fn signs_are_constructors() {
    let (mut arena, [a, b, ..]) = letters();
    let (x, y) = (arena.variable(a), arena.variable(b));
    let half = Number::ratio(1, 2);
    let (one, two) = (arena.one(), arena.number(Number::integer(2)));
    let expected: Vec<Expr> = vec![
        arena.add(x, y),
        arena.sub(x, y),
        arena.neg(x),
        arena.mul(x, y),
        arena.product(&[(x, 1), (y, -1)]),
        arena.scale(x, half),
        arena.mul(two, x),
        arena.sub(one, x),
        arena.add(one, x),
        arena.sub(x, one),
        arena.powi(x, 3),
        arena.pow(x, y),
        arena.call(Function::Sqrt, x),
        arena.call2(Function::Atan2, x, y),
    ];
    let algebra = Algebra::new(&mut arena);
    let (x, y) = (algebra.variable(a), algebra.variable(b));
    let written = [
        x + y,
        x - y,
        -x,
        x * y,
        x / y,
        x / 2,
        2 * x,
        1 - x,
        1 + x,
        x - 1,
        x.powi(3),
        x.pow(y),
        x.sqrt(),
        x.atan2(y),
    ];
    assert_eq!(written.map(|scalar| scalar.expr()).to_vec(), expected);
}

#[test]
fn vectors_turn_and_keep_their_length() {
    let (mut arena, symbols) = letters();
    let algebra = Algebra::new(&mut arena);
    let [a, b, c, d, phi] = symbols.map(|symbol| algebra.variable(symbol));
    let (u, v) = (algebra.vector([a, b]), algebra.vector([c, d]));
    let quarter = algebra.number(std::f64::consts::FRAC_PI_2);
    let zeros = [
        u.perpendicular().dot(u),
        u.rotated(phi).norm() - u.norm(),
        u.rotated(phi).dot(v.rotated(phi)) - u.dot(v),
        (u.rotated(quarter) - u.perpendicular()).norm(),
        ((phi * (u + v) - phi * v) / phi - u).norm(),
        (-(v - u) - (u - v)).norm(),
    ];
    let zeros = zeros.map(|zero| zero.expr());
    let value = |symbol: Symbol| 0.3 + 0.7 * symbol.index() as f64;
    for (at, zero) in arena.evaluate(&zeros, &value).into_iter().enumerate() {
        assert!(zero.abs() < 1e-14, "{at}: {zero}");
    }
}
