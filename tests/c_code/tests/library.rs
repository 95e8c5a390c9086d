//! Every mechanism of the library as C: compiled without a warning, and equal to its programs.

#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

use std::path::Path;

use c_code::{Choice, Evaluator, build, compile, compilers, declarations};
use mbs_codegen::target::{Scalar, c};
use mbs_codegen::{Compiled, analyse};

#[path = "../../src/chains.rs"]
#[macro_use]
mod chains;

/// Declarations with what they are called.
fn all() -> Vec<(String, Compiled)> {
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/src");
    let mut texts: Vec<(String, String)> = declarations(&models)
        .expect("the library is there")
        .into_iter()
        .map(|(path, tokens)| (path.display().to_string(), tokens.to_string()))
        .collect();
    assert!(texts.len() > 25, "{}", texts.len());
    texts.push(("a chain of rods".to_owned(), pendulum!(stringify; Rods40 40).to_owned()));
    texts.push(("a chain of four-bars".to_owned(), four_bar!(stringify; Bars40 40).to_owned()));
    let compiled = |(name, text): (String, String)| {
        let tokens = text.parse().expect("tokens");
        let compiled = analyse(tokens).unwrap_or_else(|error| panic!("{name}: {error}"));
        (name, compiled)
    };
    texts.into_iter().map(compiled).collect()
}

#[test]
fn c_compiles_without_a_warning() {
    let compilers = compilers();
    for (name, compiled) in all() {
        for scalar in [Scalar::Double, Scalar::Float] {
            let sources = c(&compiled, scalar).unwrap_or_else(|error| panic!("{name}: {error}"));
            // gcc finds what may be uninitialized only where it optimizes
            for (compiler, flag) in [("gcc", "-O1"), ("clang", "-fsyntax-only")] {
                if !compilers.contains(&compiler) {
                    continue;
                }
                compile(&sources, compiler, &[flag])
                    .unwrap_or_else(|fault| panic!("{name}, {scalar:?}, {compiler}: {fault}"));
            }
        }
    }
}

/// Equal to the bit, but for the sign of a zero, which a fused step may change.
fn is_same(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a == b)
}

#[test]
fn a_thousand_steps_in_c_are_those_of_the_programs_to_the_bit() {
    const STEPS: usize = 1000;
    let Some(&compiler) = compilers().first() else { return };
    for (name, compiled) in all() {
        let sources = c(&compiled, Scalar::Double).unwrap_or_else(|error| panic!("{name}: {error}"));
        let built = build(&sources, compiler, "-O2").unwrap_or_else(|fault| panic!("{name}: {fault}"));
        // the squeezer turns once in some milliseconds
        let step = if name.contains("squeezer") { 1e-5 } else { compiled.choices.step.unwrap_or(1e-3) };
        let inputs = vec![0.5; compiled.inputs.len()];
        let evaluator = Evaluator::new(&compiled);
        for is_held in [true, false] {
            let (alpha, beta) = if is_held { (0.75 / step, 1.0 / step) } else { (1.0 / step, 1.4 / step) };
            let gains = [-2.0 * alpha, -beta * beta];
            let feedback = Some((alpha, beta, is_held));
            let choice = Choice { step, steps: STEPS, every: 10, feedback, inputs: &inputs, start: None };
            let lines = built.run(&choice).unwrap_or_else(|fault| panic!("{name}: {fault}"));
            assert_eq!(lines.len(), 1 + STEPS / 10);
            let states = 1 + 2 * compiled.coordinates.len();
            let mut state = lines[0][..states].to_vec();
            let start = state[0];
            for (at, line) in lines.iter().enumerate() {
                let expected = evaluator.line(&state, &inputs);
                assert!(is_same(line, &expected), "{name}, line {at}:\n{line:?}\n{expected:?}");
                // a line is followed by ten steps
                for k in 10 * at..10 * (at + 1) {
                    let t_next = start + (k + 1) as f64 * step;
                    state = evaluator.step(&state, &inputs, [step, t_next], gains, is_held);
                }
            }
        }
    }
}
