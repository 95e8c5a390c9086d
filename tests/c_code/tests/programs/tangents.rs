//! Tangents of the programs of the library: what they give along a direction is what transposes give, for every
//! function that C code has a tangent of; and the C code with tangents compiles without a warning.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test says by panicking what is wrong")]

use std::path::Path;

use c_code::{compile, compilers, declarations};
use mbs_codegen::compiled::{Input, Results};
use mbs_codegen::targets::{Scalar, c_with_tangents};
use mbs_codegen::{Compiled, FunctionId, analyse};
use mbs_symbolic::{Operand, Symbol};
use paths::STRIDE;

const FUNCTIONS: [FunctionId; 5] = [
    FunctionId::Stabilized,
    FunctionId::Reactions,
    FunctionId::Outputs,
    FunctionId::Events,
    FunctionId::Complete,
];

/// Numbers between −1 and 1 that are the same in every run.
fn random(seed: usize) -> f64 {
    let x = (seed as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 31)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    ((x ^ (x >> 29)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// The value of a symbol: near the declared start, where everything is defined.
fn value(compiled: &Compiled, symbol: Symbol) -> f64 {
    let n = compiled.coordinates.len();
    let near = |at: usize| compiled.start[at] + 1e-3 * random(at);
    match compiled.input(symbol) {
        Input::Time => 1e-3,
        Input::Parameter(at) => compiled.parameters[at].value,
        Input::Position(at) => near(at),
        Input::Velocity(at) => near(n + at),
        Input::StatePosition(at) => near(compiled.states[at]),
        Input::StateVelocity(at) => near(n + compiled.states[at]),
        Input::MinusTwoAlpha => -20.0,
        Input::MinusBetaSquared => -100.0,
        // accelerations, multipliers, feedback and inputs
        _ => random(symbol.index()),
    }
}

/// Σₖ wₖ (∂rₖ/∂x) ẋ, forward and backward, with the size of the terms.
fn both_ways(compiled: &Compiled, function: FunctionId, hoisted: &[f64]) -> [f64; 3] {
    let program = compiled.program(function);
    let growths = usize::from(function.results().contains(&Results::Growth));
    let counted = program.outputs.len() - growths;
    let (symbols, directions) = (compiled.symbol_count(), compiled.directions(function));
    let rate = |at: usize| random(1000 + at);
    let tangent = compiled.tangent(function).unwrap();
    let known = |symbol: Symbol| match symbol.index() {
        at if at >= symbols => rate(at - symbols),
        _ => value(compiled, symbol),
    };
    let forward = tangent.evaluate(&known, hoisted);
    assert_eq!(forward.len(), counted, "{function:?}");

    // the number of an input in the direction, found by a direction that is one there
    let operands = program.instructions.iter().flat_map(|step| [step.a, step.b]);
    let mut by: Vec<Operand> = operands.chain(program.outputs.iter().copied()).collect();
    by.retain(|operand| match compiled.input_of(*operand) {
        Some(Input::Parameter(_) | Input::MinusTwoAlpha | Input::MinusBetaSquared) | None => false,
        Some(_) => true,
    });
    by.sort_unstable();
    by.dedup();
    let one = |at: usize| -> Vec<f64> {
        let known = |symbol: Symbol| match symbol.index() {
            index if index >= symbols => f64::from(u8::from(index - symbols == at)),
            _ => value(compiled, symbol),
        };
        tangent.evaluate(&known, hoisted)
    };
    let weights: Vec<f64> =
        (0..program.outputs.len()).map(|at| if at < counted { random(at) } else { 0.0 }).collect();
    let operands: Vec<Operand> = weights.iter().map(|weight| Operand::Number((*weight).into())).collect();
    let both = program.with_adjoint(&operands, &by).unwrap();
    let backward = both.evaluate(&|symbol| value(compiled, symbol), hoisted);
    let backward = &backward[program.outputs.len()..];
    // every derivative by one input is the weighted sum of a column
    let columns = (0..directions)
        .map(|at| one(at).iter().zip(&weights).map(|(slope, weight)| slope * weight).sum::<f64>());
    let columns: Vec<f64> = columns.collect();
    let size = columns.iter().chain(backward).fold(1.0, |size: f64, x| size.max(x.abs()));
    let mut left: Vec<f64> = columns.iter().copied().filter(|x| x.abs() > 1e-9 * size).collect();
    for slope in backward.iter().filter(|x| x.abs() > 1e-9 * size) {
        let place = left.iter().position(|x| (x - slope).abs() <= 1e-9 * size);
        left.remove(place.unwrap_or_else(|| panic!("{} {function:?}: {slope} in {left:?}", compiled.name)));
    }
    assert!(left.is_empty(), "{} {function:?}: {left:?}", compiled.name);
    let forward = forward.iter().zip(&weights).map(|(slope, weight)| slope * weight).sum();
    let along = columns.iter().enumerate().map(|(at, x)| x * rate(at)).sum();
    [forward, along, size]
}

#[test]
fn tangents_and_transposes_of_the_library_agree() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/src");
    let mut checked = 0;
    for (path, declaration) in declarations(&folder).unwrap().into_iter().step_by(STRIDE) {
        let compiled = analyse(declaration).unwrap_or_else(|errors| panic!("{}: {errors}", path.display()));
        // of the longest, a column each would take minutes
        if compiled.coordinates.len() > 60 {
            continue;
        }
        let parameter = |symbol| value(&compiled, symbol);
        let hoisted = compiled.program(FunctionId::Hoisted).evaluate(&parameter, &[]);
        for function in FUNCTIONS {
            let [forward, along, size] = both_ways(&compiled, function, &hoisted);
            // pivots magnify roundings by up to 1e6 near some starts
            assert!((forward - along).abs() <= 1e-9 * size, "{} {function:?}", path.display());
        }
        checked += 1;
    }
    assert!(checked > 25 / STRIDE, "{checked}");
}

#[test]
fn c_code_with_tangents_compiles_without_a_warning() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/src");
    let Some(&compiler) = compilers().first() else { return };
    for (path, declaration) in declarations(&folder).unwrap().into_iter().step_by(STRIDE) {
        let compiled = analyse(declaration).unwrap_or_else(|errors| panic!("{}: {errors}", path.display()));
        for scalar in [Scalar::Double, Scalar::Float] {
            let sources = c_with_tangents(&compiled, scalar).unwrap_or_else(|errors| panic!("{errors}"));
            assert!(sources.header.text.contains("_along_stabilized("));
            compile(&sources, compiler, &["-fsyntax-only"])
                .unwrap_or_else(|fault| panic!("{}: {fault}", path.display()));
        }
    }
}
