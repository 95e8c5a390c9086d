//! Elimination at compile time solves the constrained system: random sparse
//! matrices, all strategies, sums closed and open, massless coordinates, fully driven systems,
//! against a dense LU with pivoting.
#![allow(clippy::expect_used, reason = "helpers of tests")]
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use std::collections::BTreeMap;

use mbs_symbolic::{
    Arena, Expr, Function, Hoisted, Kkt, Number, Stage, Strategy as Order, Sums, Symbol, Unknown, factor,
    lower, lower_whole,
};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// A random system: masses and the pattern of Φ_q.
#[derive(Clone, Debug)]
struct System {
    masses: Vec<Mass>,
    /// (row, column, kind)
    entries: Vec<(usize, usize, Entry)>,
    rows: usize,
    seed: u64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Mass {
    Positive,
    Massless,
}

#[derive(Clone, Copy, Debug)]
enum Entry {
    /// ±1
    Unit(bool),
    /// A rational.
    Constant(i64),
    /// A length.
    Parameter,
    /// length · sin(coordinate)
    Trigonometric,
    /// A coordinate.
    Variable,
}

fn entries() -> impl Strategy<Value = Entry> {
    prop_oneof![
        4 => any::<bool>().prop_map(Entry::Unit),
        1 => (2_i64..5).prop_map(Entry::Constant),
        1 => Just(Entry::Parameter),
        3 => Just(Entry::Trigonometric),
        1 => Just(Entry::Variable),
    ]
}

/// n coordinates, m rows of two to four entries each. `massless` of ten
/// coordinates have no mass.
fn systems(n: std::ops::Range<usize>, is_driven: bool, massless: u32) -> impl Strategy<Value = System> {
    n.prop_flat_map(move |n| {
        let rows = if is_driven { n..n + 1 } else { 0..n };
        (Just(n), rows, any::<u64>())
    })
    .prop_flat_map(move |(n, rows, seed)| {
        let mass = prop_oneof![
            10 - massless => Just(Mass::Positive),
            massless => Just(Mass::Massless),
        ];
        let entry = (0..rows.max(1), 0..n, entries());
        (
            prop::collection::vec(mass, n),
            prop::collection::vec(entry, 2 * rows..=3 * rows + 1),
            Just(rows),
            Just(seed),
        )
    })
    .prop_map(|(masses, mut entries, rows, seed)| {
        entries.retain(|(row, ..)| *row < rows);
        System { masses, entries, rows, seed }
    })
}

struct Problem {
    arena: Arena,
    kkt: Kkt,
    rhs: BTreeMap<Unknown, Expr>,
    unknowns: Vec<Unknown>,
}

fn problem(system: &System) -> Problem {
    let mut arena = Arena::new();
    let mut kkt = Kkt::new();
    let mut rhs = BTreeMap::new();
    let mut unknowns = Vec::new();
    let letter = |arena: &mut Arena, name: String, stage| {
        let symbol = arena.symbol(&name, stage);
        arena.variable(symbol)
    };
    let unit = letter(&mut arena, "unit".to_owned(), Stage::Parameter);
    for (at, mass) in system.masses.iter().enumerate() {
        let unknown = Unknown::Coordinate(at);
        kkt.add_unknown(unknown);
        unknowns.push(unknown);
        if *mass == Mass::Positive {
            let own = letter(&mut arena, format!("m{at}"), Stage::Parameter);
            // half of the systems have a factor that all masses share
            let mass = if system.seed.is_multiple_of(2) { own } else { arena.mul(unit, own) };
            kkt.set(&arena, unknown, unknown, mass);
            kkt.mark_massive(at);
        }
        let force = letter(&mut arena, format!("f{at}"), Stage::Variable);
        rhs.insert(unknown, force);
    }
    for row in 0..system.rows {
        kkt.add_unknown(Unknown::Row(row));
        unknowns.push(Unknown::Row(row));
        let gamma = letter(&mut arena, format!("g{row}"), Stage::Variable);
        rhs.insert(Unknown::Row(row), gamma);
    }
    for &(row, column, entry) in &system.entries {
        let value = match entry {
            Entry::Unit(negative) => arena.number(if negative { Number::MINUS_ONE } else { Number::ONE }),
            Entry::Constant(value) => arena.number(Number::integer(value)),
            Entry::Parameter => letter(&mut arena, format!("l_{row}_{column}"), Stage::Parameter),
            Entry::Variable => letter(&mut arena, format!("q_{row}_{column}"), Stage::Variable),
            Entry::Trigonometric => {
                let length = letter(&mut arena, format!("l_{row}_{column}"), Stage::Parameter);
                let angle = letter(&mut arena, format!("q_{row}_{column}"), Stage::Variable);
                let sine = arena.call(Function::Sin, angle);
                arena.mul(length, sine)
            }
        };
        kkt.set(&arena, Unknown::Row(row), Unknown::Coordinate(column), value);
    }
    Problem { arena, kkt, rhs, unknowns }
}

/// Symbol values: all between 0.2 and 1.8, so that masses are positive; the
/// sampled position decides.
fn value(seed: u64, position: u64, symbol: Symbol) -> f64 {
    let mut z = seed ^ position.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ ((symbol.index() as u64 + 1) << 32);
    for _ in 0..3 {
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z ^= z >> 27;
    }
    0.2 + 1.6 * (z >> 11) as f64 / (1_u64 << 53) as f64
}

fn dense(problem: &Problem, symbol: &dyn Fn(Symbol) -> f64) -> (DMatrix<f64>, DVector<f64>) {
    let Problem { arena, kkt, rhs, unknowns } = problem;
    let of = |expr: Option<Expr>| expr.map_or(0.0, |expr| arena.evaluate(&[expr], symbol)[0]);
    let size = unknowns.len();
    let matrix = DMatrix::from_fn(size, size, |i, j| of(kkt.get(unknowns[i], unknowns[j])));
    let rhs = DVector::from_fn(size, |i, _| of(rhs.get(&unknowns[i]).copied()));
    (matrix, rhs)
}

const LARGEST_CONDITION: f64 = 1e5;

fn check(system: &System) -> Result<(), TestCaseError> {
    let mut problem = problem(system);
    let symbol = |s| value(system.seed, 0, s);
    let (matrix, rhs) = dense(&problem, &symbol);
    let singular = matrix.singular_values();
    let condition = singular.max() / singular.min();
    prop_assume!(condition < LARGEST_CONDITION);
    let expected = matrix.lu().solve(&rhs);
    prop_assume!(expected.is_some());
    let expected = expected.unwrap();

    let forms = Order::ALL.into_iter().flat_map(|order| [(order, Sums::Closed), (order, Sums::Open)]);
    for (strategy, sums) in forms {
        let Problem { arena, kkt, rhs: given, unknowns } = &mut problem;
        let factorization = factor(arena, kkt, strategy);
        prop_assert!(factorization.is_ok(), "{strategy:?}: {:?} of a regular matrix", factorization.err());
        let factorization = factorization.unwrap();
        let solution = factorization.solve_with(arena, given, sums);
        let growths: Vec<Expr> = factorization.pivots.iter().map(|pivot| pivot.growth).collect();
        let growth: f64 = arena.evaluate(&growths, &symbol).iter().sum();
        prop_assert!(growth.is_finite() && growth >= 0.0, "{strategy:?}: growth {growth}");

        let roots: Vec<Expr> =
            unknowns.iter().map(|u| solution.get(u).copied().unwrap_or(arena.zero())).collect();
        let mut hoisted = Hoisted::default();
        let program = lower(arena, &roots, &mut hoisted, 1024).expect("a program");
        let prepared = lower_whole(arena, hoisted.values(), 1024).expect("a program").evaluate(&symbol, &[]);
        let direct = arena.evaluate(&roots, &symbol);
        let lowered = program.evaluate(&symbol, &prepared);
        // The dense solution is good to n·cond·ε; elimination without row
        // exchanges multiplies that by the growth of its pivots.
        let size = unknowns.len() as f64;
        let tolerance = 4.0 * size * f64::EPSILON * condition * (1.0 + growth) * expected.amax();
        for (found, expected) in direct.iter().zip(&lowered).zip(&expected).map(|((d, l), e)| ([d, l], e)) {
            for found in found {
                let deviation = (found - expected).abs();
                prop_assert!(
                    deviation <= tolerance,
                    "{strategy:?}, {sums:?}: {found:e} for {expected:e}, {deviation:e} > {tolerance:e}"
                );
            }
        }
    }
    Ok(())
}

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        max_global_rejects: 200_000,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1),
        ..Default::default()
    }
}

proptest! {
    #![proptest_config(config(500))]

    #[test]
    fn systems_with_masses_are_solved(system in systems(1..8, false, 0)) {
        check(&system)?;
    }

    #[test]
    fn driven_systems_are_solved(system in systems(1..6, true, 0)) {
        check(&system)?;
    }

    #[test]
    fn systems_with_massless_coordinates_are_solved(system in systems(1..7, false, 3)) {
        check(&system)?;
    }

    #[test]
    fn driven_systems_with_massless_coordinates_are_solved(system in systems(1..6, true, 3)) {
        check(&system)?;
    }
}

/// A row that repeats another, and a coordinate that nothing determines, are
/// named.
#[test]
fn what_nothing_determines_is_named() {
    let mut arena = Arena::new();
    let mut kkt = Kkt::new();
    let one = arena.one();
    kkt.add_unknown(Unknown::Coordinate(0));
    kkt.add_unknown(Unknown::Coordinate(1));
    kkt.set(&arena, Unknown::Coordinate(0), Unknown::Coordinate(0), one);
    kkt.mark_massive(0);
    for order in Order::ALL {
        let error = factor(&mut arena, &kkt, order).err().expect("coordinate 1 is free");
        assert_eq!(error.unknowns, [Unknown::Coordinate(1)]);
    }
    kkt.set(&arena, Unknown::Coordinate(1), Unknown::Coordinate(1), one);
    kkt.mark_massive(1);
    for row in 0..2 {
        kkt.add_unknown(Unknown::Row(row));
        kkt.set(&arena, Unknown::Row(row), Unknown::Coordinate(0), one);
    }
    for order in Order::ALL {
        assert!(factor(&mut arena, &kkt, order).is_err());
    }
}

/// The growth of a pivot of relative size δ is about 1/δ: l sin q in the only
/// place of its row, and a Schur complement of two nearly parallel rows.
#[test]
fn growth_tells_how_much_is_left_of_a_pivot() {
    for delta in [1e-3, 1e-6, 1e-9] {
        for order in Order::ALL {
            let mut arena = Arena::new();
            let (l, q) = (arena.symbol("l", Stage::Parameter), arena.symbol("q", Stage::Variable));
            let (lx, qx) = (arena.variable(l), arena.variable(q));
            let sine = arena.call(Function::Sin, qx);
            let entry = arena.mul(lx, sine);
            let mut kkt = Kkt::new();
            kkt.set(&arena, Unknown::Coordinate(0), Unknown::Coordinate(0), arena.one());
            kkt.mark_massive(0);
            kkt.set(&arena, Unknown::Row(0), Unknown::Coordinate(0), entry);
            let factorization = factor(&mut arena, &kkt, order).unwrap();
            let growth = factorization.growth(&mut arena);
            let growth = arena.evaluate(&[growth], &|s| if s == l { 0.5 } else { delta })[0];
            assert!((growth * delta - 1.0).abs() < 0.1, "{order:?}: {growth:e} for {delta:e}");
        }
        for order in Order::ALL {
            // rows (1, q) and (1, −q) over unit masses meet at q = 0
            let mut arena = Arena::new();
            let masses = [0, 1].map(|at| arena.symbol(&format!("m{at}"), Stage::Parameter));
            let q = arena.symbol("q", Stage::Variable);
            let l = arena.symbol("l", Stage::Variable);
            let (qx, lx) = (arena.variable(q), arena.variable(l));
            let minus = arena.neg(qx);
            let mut kkt = Kkt::new();
            for (at, mass) in masses.into_iter().enumerate() {
                let mass = arena.variable(mass);
                kkt.set(&arena, Unknown::Coordinate(at), Unknown::Coordinate(at), mass);
                kkt.mark_massive(at);
            }
            for (row, other) in [qx, minus].into_iter().enumerate() {
                kkt.set(&arena, Unknown::Row(row), Unknown::Coordinate(0), lx);
                kkt.set(&arena, Unknown::Row(row), Unknown::Coordinate(1), other);
            }
            let factorization = factor(&mut arena, &kkt, order).unwrap();
            let growth = factorization.growth(&mut arena);
            let at = |delta: f64| arena.evaluate(&[growth], &|s| if s == q { delta } else { 1.0 })[0];
            // masses and pairs see δ, a Schur complement δ²
            let (here, regular) = (at(delta), at(1.0));
            assert!(here > 0.1 / delta, "{order:?}: {here:e} for {delta:e}");
            assert!(regular < 10.0, "{order:?}: {regular:e}");
        }
    }
}

/// A chain of masses, each tied to the next by a row: from both ends its pivots wait for each
/// other half as long as from one, with the same operations.
#[test]
fn a_chain_is_eliminated_from_both_ends() {
    let rows = 16;
    let tied = |row| [(row, row, Entry::Variable), (row, row + 1, Entry::Variable)];
    let entries = (0..rows).flat_map(tied).collect();
    let chain = System { masses: vec![Mass::Positive; rows + 1], entries, rows, seed: 0 };
    let costs = [Order::Cheapest, Order::BothEnds].map(|order| {
        let Problem { mut arena, kkt, rhs, unknowns } = problem(&chain);
        let solution = factor(&mut arena, &kkt, order).unwrap().solve(&mut arena, &rhs);
        let roots: Vec<Expr> = unknowns.iter().map(|unknown| solution[unknown]).collect();
        let program = lower(&mut arena, &roots, &mut Hoisted::default(), 1024).unwrap();
        (program.operations().total(), program.critical_path())
    });
    let [(from_one, long), (from_both, short)] = costs;
    assert!(from_both <= from_one, "{from_both} operations, and {from_one} from one end");
    // the ends and the middle are not halved
    assert!(10 * short <= 6 * long, "{short} cycles, and {long} from one end");
}
