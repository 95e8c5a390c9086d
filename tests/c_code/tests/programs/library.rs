//! Every mechanism of the library as C: compiled without a warning, and equal to its programs.

#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

use std::path::Path;

use c_code::{Choice, Evaluator, build, build_around, compile, compilers, declarations, is_there};
use mbs_codegen::targets::{Scalar, c};
use mbs_codegen::{Compiled, analyse};
use paths::{EXHAUSTIVE, STRIDE};

use crate::{OPTIMIZATION, rough};

/// The files of mechanisms that are also compiled with reduced states.
const REDUCED: [&str; 5] =
    ["slider_crank.rs", "slider_crank_free.rs", "four_bar_free.rs", "scotch_yoke.rs", "cam_follower.rs"];

/// Declarations with what they are called, or a sample of them.
fn some() -> Vec<(String, Compiled)> {
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/src");
    let mut texts: Vec<(String, String)> = declarations(&models)
        .expect("the library is there")
        .into_iter()
        .map(|(path, tokens)| (path.display().to_string(), tokens.to_string()))
        .collect();
    assert!(texts.len() > 25, "{}", texts.len());
    let reduced = texts.iter().filter(|(name, _)| REDUCED.iter().any(|file| name.ends_with(file)));
    let reduced = reduced.map(|(name, text)| {
        (format!("{name} with reduced states"), text.replacen("dof =", "states = reduced; dof =", 1))
    });
    texts.extend(reduced.collect::<Vec<_>>());
    let rods = pendulum!(stringify; Rods40 40).replacen("dof =", "states = reduced; dof =", 1);
    texts.push(("a chain of rods with reduced states".to_owned(), rods));
    texts.push(("a chain of rods".to_owned(), pendulum!(stringify; Rods40 40).to_owned()));
    // straight lines, of which compilers of C take seconds
    let bars = if EXHAUSTIVE { four_bar!(stringify; Bars 40) } else { four_bar!(stringify; Bars 10) };
    texts.push(("a chain of four-bars".to_owned(), bars.to_owned()));
    let compiled = |(name, text): (String, String)| {
        let tokens = text.parse().expect("tokens");
        let compiled = analyse(tokens).unwrap_or_else(|error| panic!("{name}: {error}"));
        (name, compiled)
    };
    let rough = rough::rough().map(|(name, text)| (name.to_owned(), text)).step_by(STRIDE);
    texts.into_iter().step_by(STRIDE).chain(rough).map(compiled).collect()
}

#[test]
fn c_compiles_without_a_warning() {
    let compilers = compilers().into_iter().step_by(STRIDE).collect::<Vec<_>>();
    for (name, compiled) in some() {
        for scalar in [Scalar::Double, Scalar::Float] {
            let sources = c(&compiled, scalar).unwrap_or_else(|error| panic!("{name}: {error}"));
            for &compiler in &compilers {
                // gcc finds what may be uninitialized only where it optimizes
                let optimizes = compiler == "gcc" && scalar == Scalar::Double;
                compile(&sources, compiler, &[if optimizes { "-O1" } else { "-fsyntax-only" }])
                    .unwrap_or_else(|fault| panic!("{name}, {scalar:?}, {compiler}: {fault}"));
            }
        }
    }
}

#[test]
fn names_of_c_and_declarations_that_broke_something_once_compile_too() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../corpus");
    let mut tried = 0;
    for entry in std::fs::read_dir(corpus).expect("the corpus is there") {
        let path = entry.expect("a file").path();
        let name = path.display().to_string();
        if !["valid_", "names_of_rust", "raw_names"].iter().any(|kind| name.contains(kind)) {
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("a text");
        let Ok(compiled) = analyse(text.parse().expect("tokens")) else { continue };
        let sources = c(&compiled, Scalar::Double).unwrap_or_else(|error| panic!("{name}: {error}"));
        for compiler in compilers() {
            compile(&sources, compiler, &["-fsyntax-only"])
                .unwrap_or_else(|fault| panic!("{name}, {compiler}: {fault}"));
        }
        tried += 1;
    }
    assert!(tried > 10, "{tried}");
}

#[test]
fn places_of_the_text_that_is_filled_may_be_names() {
    let text = "pub Math {
        dof = 1;
        param CAPS_PIVOTS = 1 [m];  param SQRT = 2 [kg];  param STEP = 0.5;
        input STAGE [N];
        gravity = (0, -9.81) [m/s^2];
        body bob (NAME, int, q) { mass = SQRT; inertia = 1 [kg*m^2]; }
        force pull on bob = (STAGE*STEP, 0 [N]);
        constraint double: NAME^2 + int^2 = CAPS_PIVOTS^2;
        constraint still: q = 0;
        start { NAME = CAPS_PIVOTS; guess int = 0 [m]; }
        output EPSILON [m] = NAME;
    }";
    let compiled = analyse(text.parse().expect("tokens")).unwrap_or_else(|error| panic!("{error}"));
    let sources = c(&compiled, Scalar::Float).expect("it is printed");
    assert_eq!([sources.header.name.as_str(), sources.source.name.as_str()], ["math_.h", "math_.c"]);
    for compiler in compilers() {
        compile(&sources, compiler, &["-O1"]).unwrap_or_else(|fault| panic!("{fault}"));
    }
}

#[test]
fn the_example_prints_a_table_and_firmware_compiles() {
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/src");
    let all = declarations(&models).expect("the library is there");
    let (_, tokens) = all.into_iter().find(|(path, _)| path.ends_with("slider_crank.rs")).expect("a model");
    let compiled = analyse(tokens).unwrap_or_else(|error| panic!("{error}"));
    if let Some(compiler) = compilers().first() {
        let sources = c(&compiled, Scalar::Double).expect("it is printed");
        let built = build_around(&sources, &sources.example.text, compiler, OPTIMIZATION)
            .unwrap_or_else(|fault| panic!("{fault}"));
        let table = built.output().unwrap_or_else(|fault| panic!("{fault}"));
        assert_eq!(table.lines().next(), Some("t,x1,y1,theta1,x2,y2,theta2,x3,drive_torque"));
        assert!(table.lines().count() > 100, "{table}");
    }
    if is_there("arm-none-eabi-gcc") {
        let sources = c(&compiled, Scalar::Float).expect("it is printed");
        let flags = ["-mcpu=cortex-m4", "-mthumb", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard", "-Os"];
        compile(&sources, "arm-none-eabi-gcc", &flags).unwrap_or_else(|fault| panic!("{fault}"));
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
    // where velocities jump, at stops and by modes, is for `printers`
    for (name, compiled) in some().into_iter().filter(|(_, compiled)| !compiled.jumps()) {
        let sources = c(&compiled, Scalar::Double).unwrap_or_else(|error| panic!("{name}: {error}"));
        let built = build(&sources, compiler, OPTIMIZATION).unwrap_or_else(|fault| panic!("{name}: {fault}"));
        // the squeezer turns once in some milliseconds
        let step = if name.contains("squeezer") { 1e-5 } else { compiled.choices.step.unwrap_or(1e-4) };
        let free = compiled.inputs.len() - compiled.sampling.memories;
        let given: Vec<f64> =
            (0..compiled.inputs.len()).map(|at| if at < free { 0.5 } else { f64::NAN }).collect();
        let evaluator = Evaluator::new(&compiled);
        for is_held in [true, false] {
            let (alpha, beta) = if is_held { (0.75 / step, 1.0 / step) } else { (1.0 / step, 1.4 / step) };
            let gains = [-2.0 * alpha, -beta * beta];
            let feedback = Some((alpha, beta, is_held));
            let choice = Choice { step, steps: STEPS, every: 10, feedback, inputs: &given, start: None };
            let lines = built.run(&choice).unwrap_or_else(|fault| panic!("{name}: {fault}"));
            assert_eq!(lines.len(), 1 + STEPS / 10);
            let states = 1 + 2 * compiled.coordinates.len();
            let mut state = lines[0][..states].to_vec();
            let start = state[0];
            // the first samples are taken before a program sets anything
            let mut inputs: Vec<f64> = compiled.inputs.iter().map(|input| input.value).collect();
            evaluator.sample(&state, &mut inputs, 0, step);
            inputs[..free].fill(0.5);
            for (at, line) in lines.iter().enumerate() {
                let expected = evaluator.line(&state, &inputs);
                assert!(is_same(line, &expected), "{name}, line {at}:\n{line:?}\n{expected:?}");
                // a line is followed by ten steps
                for k in 10 * at..10 * (at + 1) {
                    let t_next = start + (k + 1) as f64 * step;
                    state = evaluator.step(&state, &inputs, [step, t_next], gains, is_held);
                    evaluator.sample(&state, &mut inputs, k + 1, step);
                }
            }
        }
    }
}
