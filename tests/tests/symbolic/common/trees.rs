//! Trees to test with: random ones, and one that has everything.

use mbs_symbolic::Function;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use super::Tree;

/// How many variables trees have.
pub const VARIABLES: usize = 4;

const UNARY: [Function; 12] = [
    Function::Sin,
    Function::Cos,
    Function::Tan,
    Function::Asin,
    Function::Acos,
    Function::Atan,
    Function::Sqrt,
    Function::Exp,
    Function::Ln,
    Function::Tanh,
    Function::Abs,
    Function::Sign,
];

const BINARY: [Function; 7] = [
    Function::Atan2,
    Function::Min,
    Function::Max,
    Function::Pow,
    Function::Greater,
    Function::Choice,
    Function::Gate,
];

fn boxed(tree: Tree) -> Box<Tree> {
    Box::new(tree)
}

/// f(x) with x brought into the domain of f.
fn guarded(function: Function, x: Tree) -> Tree {
    let half = boxed(Tree::Number(1, 2));
    let argument = match function {
        Function::Sqrt | Function::Ln => Tree::Add(boxed(Tree::Power(boxed(x), 2)), half),
        Function::Tan | Function::Asin | Function::Acos | Function::Exp => {
            Tree::Mul(half, boxed(Tree::Call(Function::Sin, boxed(x))))
        }
        _ => x,
    };
    Tree::Call(function, boxed(argument))
}

/// Random trees of all operators; repeated leaves are likely, so that rules
/// for like terms, equal factors and squares of sines find work.
pub fn trees() -> impl Strategy<Value = Tree> {
    let leaf = prop_oneof![
        (-4_i64..5, 1_i64..4).prop_map(|(n, d)| Tree::Number(n, d)),
        (0..VARIABLES).prop_map(Tree::Variable),
        (0..VARIABLES).prop_map(Tree::Variable),
    ];
    leaf.prop_recursive(6, 40, 2, |inner| {
        let pair = || (inner.clone(), inner.clone());
        prop_oneof![
            3 => pair().prop_map(|(a, b)| Tree::Add(boxed(a), boxed(b))),
            2 => pair().prop_map(|(a, b)| Tree::Sub(boxed(a), boxed(b))),
            4 => pair().prop_map(|(a, b)| Tree::Mul(boxed(a), boxed(b))),
            1 => pair().prop_map(|(a, b)| Tree::Div(boxed(a), boxed(b))),
            1 => inner.clone().prop_map(|a| Tree::Neg(boxed(a))),
            2 => (inner.clone(), -3..4).prop_map(|(a, e)| Tree::Power(boxed(a), e)),
            2 => (prop::sample::select(&UNARY[..]), inner.clone()).prop_map(|(f, a)| Tree::Call(f, boxed(a))),
            3 => (prop::sample::select(&UNARY[..]), inner.clone()).prop_map(|(f, a)| guarded(f, a)),
            1 => (prop::sample::select(&BINARY[..]), pair()).prop_map(|(f, (a, b))| Tree::Call2(f, boxed(a), boxed(b))),
            1 => (inner.clone(), pair()).prop_map(|(a, (b, c))| {
                // r cos²a + s sin²a
                let square = |f| boxed(Tree::Power(boxed(Tree::Call(f, boxed(a.clone()))), 2));
                let (b, c) = (Tree::Mul(boxed(b), square(Function::Cos)), Tree::Mul(boxed(c), square(Function::Sin)));
                Tree::Add(boxed(b), boxed(c))
            }),
        ]
    })
}

/// One expression with every row of the operator table in it, and every other
/// constructor.
pub fn every_operator() -> Tree {
    let x = || boxed(Tree::Variable(0));
    let y = || boxed(Tree::Variable(1));
    let plus = |a: Tree, b: Tree| Tree::Add(boxed(a), boxed(b));
    let mut sum = Tree::Number(-7, 3);
    for (at, function) in UNARY.into_iter().enumerate() {
        let scaled = Tree::Mul(boxed(Tree::Number(at as i64 + 1, 9)), y());
        let term = Tree::Mul(boxed(guarded(function, plus(Tree::Variable(0), scaled))), y());
        sum = plus(sum, term);
    }
    let positive = || boxed(Tree::Add(boxed(Tree::Power(x(), 2)), boxed(Tree::Number(1, 2))));
    for function in BINARY {
        let term = Tree::Call2(function, positive(), boxed(Tree::Variable(2)));
        sum = plus(sum, Tree::Div(boxed(Tree::Neg(boxed(term))), positive()));
    }
    Tree::Sub(boxed(sum), boxed(Tree::Power(positive(), -3)))
}

/// Values or directions of all variables.
pub fn points() -> impl Strategy<Value = [f64; VARIABLES]> {
    prop::array::uniform4(-3.0..3.0)
}

/// The same cases in every run.
pub fn config(seed: u64) -> ProptestConfig {
    ProptestConfig {
        cases: 500,
        max_global_rejects: 100_000,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(seed),
        ..Default::default()
    }
}
