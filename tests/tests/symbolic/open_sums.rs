//! Open sums of right-hand sides cost less where terms cancel or have factors in common.
#![allow(clippy::expect_used, reason = "helpers of tests")]
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use std::collections::BTreeMap;

use mbs_symbolic::{
    Arena, Expr, Function, Hoisted, Kkt, Operations, Stage, Strategy, Sums, Unknown, factor, lower,
};

fn letters<const N: usize>(arena: &mut Arena, names: [&str; N], stage: Stage) -> [Expr; N] {
    names.map(|name| {
        let symbol = arena.symbol(name, stage);
        arena.variable(symbol)
    })
}

/// Coordinates with these masses, and no rows yet.
fn coordinates<const N: usize>(arena: &Arena, masses: [Expr; N]) -> Kkt {
    let mut kkt = Kkt::new();
    for (at, mass) in masses.into_iter().enumerate() {
        kkt.set(arena, Unknown::Coordinate(at), Unknown::Coordinate(at), mass);
        kkt.mark_massive(at);
    }
    kkt
}

/// The cost of an acceleration with closed sums, and with open ones.
fn costs(
    arena: &mut Arena,
    kkt: &Kkt,
    rhs: &BTreeMap<Unknown, Expr>,
    acceleration: Unknown,
) -> [Operations; 2] {
    let factorization = factor(arena, kkt, Strategy::NullSpace).unwrap();
    [Sums::Closed, Sums::Open].map(|sums| {
        let solution = factorization.solve_with(arena, rhs, sums);
        lower(arena, &[solution[&acceleration]], &mut Hoisted::default(), 1024).unwrap().operations()
    })
}

/// A rod on a pivot: x = l cos θ and y = l sin θ give it one mass about the pivot, and what
/// centripetal accelerations do along x cancels with what they do along y.
#[test]
fn what_cancels_in_open_sums_is_gone() {
    let mut arena = Arena::new();
    let [m, j, l] = letters(&mut arena, ["m", "j", "l"], Stage::Parameter);
    let [angle, rate, torque] = letters(&mut arena, ["theta", "omega", "torque"], Stage::Variable);
    let [sine, cosine] = [Function::Sin, Function::Cos].map(|function| arena.call(function, angle));
    let [x, y, theta] = [0, 1, 2].map(Unknown::Coordinate);
    let mut kkt = coordinates(&arena, [m, m, j]);
    let mut rhs = BTreeMap::from([(theta, torque)]);
    let (of_x, of_y) = (arena.mul(l, sine), arena.mul(l, cosine));
    let of_y = arena.neg(of_y);
    // γ = −l ω² (cos θ, sin θ)
    for (row, (coordinate, entry, direction)) in [(x, of_x, cosine), (y, of_y, sine)].into_iter().enumerate()
    {
        kkt.set(&arena, Unknown::Row(row), coordinate, arena.one());
        kkt.set(&arena, Unknown::Row(row), theta, entry);
        let gamma = arena.product(&[(l, 1), (rate, 2), (direction, 1)]);
        rhs.insert(Unknown::Row(row), arena.neg(gamma));
    }
    let [closed, open] = costs(&mut arena, &kkt, &rhs, theta).map(|cost| cost.total());
    // θ̈ = torque/(j + m l²)
    assert!(closed > 1 && open == 1, "{closed}, {open}");
}

/// f = c p + c q over a mass: computed as c (p + q), where sums are open.
#[test]
fn open_sums_get_their_common_factors_back() {
    let mut arena = Arena::new();
    // with nothing in common that all masses would be measured in
    let masses = letters(&mut arena, ["m", "n"], Stage::Parameter);
    let [c, p, q] = letters(&mut arena, ["c", "p", "q"], Stage::Variable);
    let x = Unknown::Coordinate(0);
    let kkt = coordinates(&arena, masses);
    let (cp, cq) = (arena.mul(c, p), arena.mul(c, q));
    let rhs = BTreeMap::from([(x, arena.add(cp, cq))]);
    let products = costs(&mut arena, &kkt, &rhs, x).map(|cost| cost.mul);
    // one of them by 1/m
    assert_eq!(products, [3, 2]);
}
