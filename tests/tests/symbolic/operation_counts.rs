//! Operation counts of a few programs that a person can count: common
//! subexpressions are computed once, divisions are as few as can be, what
//! depends on parameters alone costs nothing.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_symbolic::{Arena, Expr, Function, Hoisted, Operations, Stage, lower, lower_whole};

fn letters<const N: usize>(stage: Stage) -> (Arena, [Expr; N]) {
    let mut arena = Arena::new();
    let letters = std::array::from_fn(|at| {
        let symbol = arena.symbol(&format!("x{at}"), stage);
        arena.variable(symbol)
    });
    (arena, letters)
}

fn count(arena: &mut Arena, outputs: &[Expr]) -> Operations {
    lower_whole(arena, outputs, 1024).expect("a program").operations()
}

fn operations(mul: u32, add: u32, div: u32, sin_cos: u32, other: u32) -> Operations {
    Operations { mul, add, div, sin_cos, other }
}

#[test]
fn sine_and_cosine_of_one_angle_count_as_one() {
    let (mut a, [x, y]) = letters(Stage::Variable);
    let (s, c) = (a.call(Function::Sin, x), a.call(Function::Cos, x));
    assert_eq!(count(&mut a, &[s, c]), operations(0, 0, 0, 1, 0));
    let other = a.call(Function::Cos, y);
    assert_eq!(count(&mut a, &[s, other]), operations(0, 0, 0, 2, 0));
    // sin(−x) is −sin x: one negation, no second angle
    let negative = a.neg(x);
    let mirrored = a.call(Function::Sin, negative);
    assert_eq!(count(&mut a, &[s, mirrored]), operations(0, 1, 0, 1, 0));
}

#[test]
fn common_parts_are_computed_once() {
    let (mut a, [x, y, z]) = letters(Stage::Variable);
    // x y z and x y + z share x y
    let xy = a.mul(x, y);
    let (product, sum) = (a.mul(xy, z), a.add(xy, z));
    assert_eq!(count(&mut a, &[product, sum]), operations(2, 1, 0, 0, 0));
    // x + y + z and x + y − z share x + y
    let xy = a.add(x, y);
    let (plus, minus) = (a.add(xy, z), a.sub(xy, z));
    assert_eq!(count(&mut a, &[plus, minus]), operations(0, 3, 0, 0, 0));
    // x − y and y − x: one subtraction, one negation
    let (forward, backward) = (a.sub(x, y), a.sub(y, x));
    assert_eq!(count(&mut a, &[forward, backward]), operations(0, 2, 0, 0, 0));
    // the same output twice costs nothing more
    assert_eq!(count(&mut a, &[plus, plus]), operations(0, 2, 0, 0, 0));
}

#[test]
fn signs_cost_nothing_where_a_difference_can_be_turned_around() {
    let (mut a, [x, y, z]) = letters(Stage::Variable);
    // −(x − y) z is (y − x) z
    let difference = a.sub(x, y);
    let difference = a.share(difference);
    let product = a.mul(difference, z);
    let negative = a.neg(product);
    assert_eq!(count(&mut a, &[negative]), operations(1, 1, 0, 0, 0));
    // −(x − y) z − z likewise
    let less = a.sub(negative, z);
    assert_eq!(count(&mut a, &[less]), operations(1, 2, 0, 0, 0));
    // both signs of one value need a negation
    assert_eq!(count(&mut a, &[product, negative]), operations(1, 2, 0, 0, 0));
    // |−x y| is |x y|
    let (product, negative) = (a.mul(x, y), a.scale(z, (-1.0).into()));
    let flipped = a.mul(product, negative);
    let size = a.call(Function::Abs, flipped);
    assert_eq!(count(&mut a, &[size]), operations(2, 0, 0, 0, 1));
}

#[test]
fn quotients_are_one_division() {
    let (mut a, [x, y, z]) = letters(Stage::Variable);
    let quotient = a.div(x, y).expect("y is not the constant 0");
    assert_eq!(count(&mut a, &[quotient]), operations(0, 0, 1, 0, 0));
    // x/y and z/y share the reciprocal
    let other = a.div(z, y).expect("y is not the constant 0");
    assert_eq!(count(&mut a, &[quotient, other]), operations(2, 0, 1, 0, 0));
}

#[test]
fn powers_are_products() {
    let (mut a, [x]) = letters(Stage::Variable);
    let square = a.powi(x, 2);
    assert_eq!(count(&mut a, &[square]), operations(1, 0, 0, 0, 0));
    let fourth = a.powi(x, 4);
    assert_eq!(count(&mut a, &[square, fourth]), operations(2, 0, 0, 0, 0));
}

#[test]
fn what_depends_on_parameters_alone_is_hoisted() {
    let mut a = Arena::new();
    let mut letter = |name: &str, stage| {
        let symbol = a.symbol(name, stage);
        a.variable(symbol)
    };
    let (p, q) = (letter("p", Stage::Parameter), letter("q", Stage::Parameter));
    let x = letter("x", Stage::Variable);
    // sin(p) q² x + p q − p/q
    let sine = a.call(Function::Sin, p);
    let square = a.powi(q, 2);
    let leading = a.product(&[(sine, 1), (square, 1), (x, 1)]);
    let product = a.mul(p, q);
    let quotient = a.div(p, q).expect("q is not the constant 0");
    let sum = a.add(leading, product);
    let sum = a.sub(sum, quotient);
    let mut hoisted = Hoisted::default();
    let program = lower(&mut a, &[sum], &mut hoisted, 1024).expect("a program");
    assert_eq!(program.operations(), operations(1, 1, 0, 0, 0));
    assert_eq!(hoisted.values().len(), 2);
    assert_eq!(count(&mut a, hoisted.values()), operations(3, 1, 1, 1, 0));
}

/// Φ, Φ_q and γ of a rigid pendulum, x = l sin θ, y = −l cos θ.
#[test]
fn pendulum_costs_what_a_person_counts() {
    let mut a = Arena::new();
    let mut letter = |name: &str, stage| {
        let symbol = a.symbol(name, stage);
        a.variable(symbol)
    };
    let l = letter("l", Stage::Parameter);
    let [x, y, angle, w] = ["x", "y", "angle", "w"].map(|name| letter(name, Stage::Variable));
    let (s, c) = (a.call(Function::Sin, angle), a.call(Function::Cos, angle));
    let (ls, lc) = (a.mul(l, s), a.mul(l, c));
    let (phi_x, phi_y) = (a.sub(x, ls), a.add(y, lc));
    // γ = (−l s w², l c w²)
    let (gamma_x, gamma_y) = (a.product(&[(ls, 1), (w, 2)]), a.product(&[(lc, 1), (w, 2)]));
    let gamma_x = a.neg(gamma_x);
    let mut hoisted = Hoisted::default();
    let program =
        lower(&mut a, &[phi_x, phi_y, ls, lc, gamma_x, gamma_y], &mut hoisted, 1024).expect("a program");
    // l s, l c, w², two products with it; two sums and a sign
    assert_eq!(program.operations(), operations(5, 3, 0, 1, 0));
}
