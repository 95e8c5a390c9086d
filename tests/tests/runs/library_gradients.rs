//! For every mechanism of the library, from its text: the derivatives of accelerations,
//! multipliers and outputs by time, positions, velocities, inputs and parameters are those of
//! differences, and so are the derivatives of the state after a step and after a short run by the
//! parameters; forward by duals and backward by the transposed programs they are the same.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test says by panicking what is wrong")]

use std::fs;
use std::path::Path;

use mbs_codegen::FunctionId;
use mbs_codegen::compiled::{Compiled, Input};
use mbs_live::{Live, Run, Text};
use mbs_runtime::equations::{At, Equations, PARTIALS, Partials};
use mbs_runtime::{Dual, System};
use mbs_symbolic::{Operand, Program};
use proc_macro2::{TokenStream, TokenTree};
use tests::differences::{Slope, slopes};
use tests::random::Random;

/// Steps before the state at which equations are differentiated.
const STEPS: u64 = 33;
/// Such that no step meets a point of the profile of the cam, where its third derivative jumps.
const H: f64 = 0.47e-3;

fn library() -> Vec<Live> {
    let compiled = |(path, source): (String, String)| Text::rust(path, source).compile().unwrap();
    sources().into_iter().map(compiled).collect()
}

/// The files that declare a mechanism, and their texts.
fn sources() -> Vec<(String, String)> {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("../models/src");
    let mut found = Vec::new();
    for entry in fs::read_dir(sources).unwrap() {
        let path = entry.unwrap().path();
        let Ok(source) = fs::read_to_string(&path) else { continue };
        // chains are made by a macro
        let source = source.replace("$(#[$($attribute)*])*", "").replace("$Name", "Chain").replace("$n", "6");
        // steps of this length lead to no sample of a clock, and impacts in constant steps have no derivatives
        let has_events = source.contains("\n        every ") || source.contains("    stop ");
        if source.contains("mechanism! {") && !path.ends_with("lib.rs") && !has_events {
            found.push((path.display().to_string(), source));
        }
    }
    assert!(found.len() > 30, "{}", found.len());
    found
}

/// t, q, v, inputs and parameters, one after the other.
#[derive(Clone)]
struct Arguments<T> {
    numbers: Vec<T>,
    n: usize,
    /// Of bodies, behind which own states stand.
    lines: usize,
    inputs: usize,
}

impl<T: Copy> Arguments<T> {
    fn at(&self) -> At<'_, T> {
        let n = self.n;
        At { t: self.numbers[0], q: &self.numbers[1..=n], v: &self.numbers[n + 1..=2 * n] }
    }

    fn inputs(&self) -> &[T] {
        &self.numbers[2 * self.n + 1..][..self.inputs]
    }

    fn parameters(&self) -> &[T] {
        &self.numbers[2 * self.n + 1 + self.inputs..]
    }
}

/// The state of a run on its way, with inputs that do something.
fn arguments(live: &Live) -> Arguments<f64> {
    let info = live.info();
    let mut run = Run::builder(live, H).build().unwrap();
    let inputs: Vec<f64> = (0..info.inputs.len()).map(|at| 0.3 + 0.2 * at as f64).collect();
    run.set_inputs(&inputs);
    run.advance(STEPS).unwrap();
    let numbers = [&[run.time()], run.q(), run.v(), &inputs, live.parameters()].concat();
    Arguments { numbers, n: info.coordinates.len(), lines: info.lines, inputs: inputs.len() }
}

/// q̈, λ and the outputs.
fn solved<T: mbs_runtime::Real>(equations: &dyn Equations<T>, given: &Arguments<T>) -> [Vec<T>; 3] {
    let info = equations.info();
    let [mut a, mut multipliers, mut outputs] =
        [info.coordinates.len(), info.constraints.len(), info.outputs.len()].map(|n| vec![T::ZERO; n]);
    equations.reactions(given.at(), given.inputs(), &mut a, &mut multipliers);
    equations.outputs(given.at(), given.inputs(), [&a, &multipliers], &mut outputs);
    [a, multipliers, outputs]
}

fn growth(live: &Live, given: &Arguments<f64>) -> f64 {
    let [mut a, mut multipliers, _] = solved(live, given);
    live.reactions(given.at(), given.inputs(), &mut a, &mut multipliers)
}

/// Asserts that derivatives are those of differences: apart by the error of their formula, and by the
/// rounding of a vector, that of its largest number.
fn agree(name: &str, found: &[f64], slopes: &[Slope], rounding: f64, step: f64) -> f64 {
    let mut worst = 0.0_f64;
    for (at, (found, slope)) in found.iter().zip(slopes).enumerate() {
        let allowed = slope.error + rounding;
        let deviation = (found - slope.value).abs();
        assert!(deviation <= allowed, "{name}, {at}: {found:e} {slope:?} {rounding:e}");
        // of what a thousand steps change
        worst = worst.max(1e3 * step * deviation);
    }
    worst
}

fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |largest, x| largest.max(x.abs()))
}

/// The steps of the differences: shares of a parameter, of a length of the mechanism, of its
/// velocities, of a state of its own.
fn step(given: &Arguments<f64>, at: usize) -> f64 {
    let At { q, v, .. } = given.at();
    let (n, x) = (given.n, given.numbers[at]);
    let scale = match at {
        0 => 0.01,
        _ if at <= n => 0.1 * largest(q).min(1.0),
        _ if at <= n + given.lines => 0.1 * largest(&v[..given.lines]).max(1.0),
        // states of its own have units of their own
        _ if at <= 2 * n => 0.1 * x.abs().max(1.0),
        _ if x == 0.0 => 1.0,
        _ => x.abs(),
    };
    1e-3 * scale
}

fn equations_of(live: &Live) {
    let info = live.info();
    let given = arguments(live);
    let plain = solved(live, &given);
    let growth = growth(live, &given);
    let (mut worst, mut compared) = (0.0_f64, 0);
    for first in (0..given.numbers.len()).step_by(PARTIALS) {
        let numbers = given.numbers.iter().enumerate().map(|(at, &x)| match at.checked_sub(first) {
            Some(index) => Partials::variable(x, index),
            None => Partials::constant(x),
        });
        let duals =
            Arguments { numbers: numbers.collect(), n: given.n, lines: given.lines, inputs: given.inputs };
        let mut found = [vec![], vec![], vec![]];
        live.with_partials(duals.parameters(), &mut |equations| found = solved(equations, &duals)).unwrap();
        for at in first..(first + PARTIALS).min(given.numbers.len()) {
            let step = step(&given, at);
            let moved = |change: f64| {
                let mut moved = given.clone();
                moved.numbers[at] += change;
                moved
            };
            // a parameter at the limit of what it may be
            let is_possible = |change: &f64| {
                live.with_parameters(|own| own.copy_from_slice(moved(*change).parameters())).is_ok()
            };
            if ![-2.0 * step, 2.0 * step].iter().all(is_possible) {
                continue;
            }
            for (which, what) in ["q̈", "λ", "outputs"].into_iter().enumerate() {
                let slopes = slopes(given.numbers[at], step, 16.0, |change| {
                    let moved = moved(change);
                    let live = live.with_parameters(|own| own.copy_from_slice(moved.parameters())).unwrap();
                    let mut found = solved(&live, &moved);
                    std::mem::take(&mut found[which])
                });
                let partials: Vec<f64> = found[which].iter().map(|x| x.partials[at - first]).collect();
                assert!(found[which].iter().map(|x| x.value).eq(plain[which].iter().copied()), "{what}");
                // what solves the system is off by its own rounding, and by the growth of pivots that can cancel
                let size = plain.iter().map(|vector| largest(vector)).fold(0.0, f64::max);
                let rounding = (1.0 + growth) * f64::EPSILON * size * 1.5 / (0.25 * step);
                let name = format!("{} by number {at} of {}", what, info.name);
                worst = worst.max(agree(&name, &partials, &slopes, rounding, step));
                compared += partials.len();
            }
        }
    }
    println!("{}: {compared} derivatives, growth {growth:.0}, apart by {worst:.1e}", info.name);
    assert!(compared > 0, "{}", info.name);
}

#[test]
fn equations_have_the_derivatives_of_differences() {
    library().iter().for_each(equations_of);
}

/// Positions and velocities after some steps.
fn ends(live: &Live, steps: u64) -> Option<Vec<f64>> {
    let mut run = Run::builder(live, H).build().ok()?;
    run.advance(steps).ok()?;
    Some([run.q(), run.v()].concat())
}

fn run_of(live: &Live, steps: u64) {
    let info = live.info();
    let plain = ends(live, steps).unwrap();
    let mut worst = 0.0_f64;
    for (at, parameter) in info.parameters.iter().enumerate() {
        let value = live.parameters()[at];
        let mut run = Run::builder(live, H)
            .over(|own: &mut [Dual<f64, 1>]| own[at] = Dual::variable(value, 0))
            .unwrap()
            .build()
            .unwrap();
        run.advance(steps).unwrap();
        let found = [run.q(), run.v()].concat();
        assert!(found.iter().map(|x| x.value).eq(plain.iter().copied()), "{}", info.name);
        let step = 1e-4 * if value == 0.0 { 1.0 } else { value.abs() };
        let moved = |change: f64| live.with_parameters(|own| own[at] += change).ok();
        let Some(_) = moved(-2.0 * step).zip(moved(2.0 * step)) else { continue };
        let slopes = slopes(value, step, 16.0, |change| ends(&moved(change).unwrap(), steps).unwrap());
        // ε of positions is fed back within a step
        let size = largest(&plain[..info.coordinates.len()]) / H + largest(&plain);
        let rounding = 16.0 * f64::EPSILON * size * 1.5 / (0.25 * step);
        let partials: Vec<f64> = found.iter().map(|x| x.partials[0]).collect();
        let name = format!("{} by {}", info.name, parameter.name);
        worst = worst.max(agree(&name, &partials, &slopes, rounding, step));
    }
    println!("{}, {steps} steps: apart by {worst:.1e}", info.name);
}

#[test]
fn steps_and_runs_have_the_derivatives_of_differences() {
    for live in library() {
        run_of(&live, 1);
        run_of(&live, STEPS);
    }
}

/// The declaration in the first `mechanism! { … }`.
fn declaration(tokens: TokenStream) -> Option<TokenStream> {
    let mut before = [false; 2];
    for tree in tokens {
        match tree {
            TokenTree::Group(group) if before == [true, true] => return Some(group.stream()),
            TokenTree::Group(group) => {
                if let Some(found) = declaration(group.stream()) {
                    return Some(found);
                }
                before = [false; 2];
            }
            TokenTree::Ident(word) => before = [word == "mechanism", false],
            TokenTree::Punct(sign) => before = [before[0], before[0] && sign.as_char() == '!'],
            TokenTree::Literal(_) => before = [false; 2],
        }
    }
    None
}

/// Where an input of a program stands among the arguments.
fn place(input: Input, given: &Arguments<f64>) -> usize {
    match input {
        Input::Time => 0,
        Input::Position(at) => 1 + at,
        Input::Velocity(at) => 1 + given.n + at,
        Input::Input(at) => 1 + 2 * given.n + at,
        Input::Parameter(at) => 1 + 2 * given.n + given.inputs + at,
        other => panic!("{other:?} is no argument of the reactions"),
    }
}

/// The derivatives of Σ wₖ resultₖ of a program by its symbols, added to those by the arguments, and
/// by what is hoisted.
fn backward(
    (compiled, program): (&Compiled, &Program),
    weights: &[f64],
    hoisted: &[f64],
    given: &Arguments<f64>,
    gradient: &mut [f64],
) -> Vec<f64> {
    let mut symbols: Vec<Operand> = program
        .instructions
        .iter()
        .flat_map(|step| [step.a, step.b])
        .chain(program.outputs.clone())
        .collect();
    symbols.retain(|operand| matches!(operand, Operand::Symbol(_)));
    symbols.sort_unstable();
    symbols.dedup();
    // feedback is none
    let is_argument = |operand: &Operand| !matches!(compiled.input_of(*operand), Some(Input::Feedback(_)));
    symbols.retain(is_argument);
    let values = (0..hoisted.len()).map(Operand::Hoisted);
    let by: Vec<Operand> = symbols.iter().copied().chain(values).collect();
    let weights: Vec<Operand> = weights.iter().map(|weight| Operand::Number((*weight).into())).collect();
    let both = program.with_adjoint(&weights, &by).unwrap();
    let number = |symbol| match compiled.input(symbol) {
        Input::Feedback(_) => 0.0,
        input => given.numbers[place(input, given)],
    };
    let found = both.evaluate(&number, hoisted);
    let (by_symbols, by_hoisted) = found[program.outputs.len()..].split_at(symbols.len());
    for (symbol, derivative) in symbols.iter().zip(by_symbols) {
        gradient[place(compiled.input_of(*symbol).unwrap(), given)] += derivative;
    }
    by_hoisted.to_vec()
}

/// A weighted sum of all accelerations and multipliers, by every argument: forward in as many
/// evaluations as there are arguments over four, backward in one.
#[test]
fn transposed_programs_have_the_derivatives_of_duals() {
    for ((path, source), live) in sources().into_iter().zip(library()) {
        let tokens = declaration(source.parse().unwrap()).unwrap();
        let compiled = mbs_codegen::analyse(tokens).unwrap_or_else(|_| panic!("{path} compiles"));
        let given = arguments(&live);
        let [a, multipliers, _] = solved(&live, &given);
        let mut random = Random::new(8);
        let weights: Vec<f64> = (0..a.len() + multipliers.len()).map(|_| random.between(-1.0, 1.0)).collect();

        let of_hoisted = compiled.program(FunctionId::Hoisted);
        let parameter = |symbol| given.numbers[place(compiled.input(symbol), &given)];
        let hoisted = of_hoisted.evaluate(&parameter, &[]);
        let reactions = compiled.program(FunctionId::Reactions);
        let mut gradient = vec![0.0; given.numbers.len()];
        // the growth of pivots has no weight
        let all = [&weights[..], &[0.0]].concat();
        let by_hoisted = backward((&compiled, reactions), &all, &hoisted, &given, &mut gradient);
        backward((&compiled, of_hoisted), &by_hoisted, &[], &given, &mut gradient);

        let mut worst = 0.0_f64;
        for (at, found) in gradient.iter().enumerate() {
            let numbers = given.numbers.iter().enumerate();
            let numbers =
                numbers.map(|(other, &x)| Partials::variable(x, if other == at { 0 } else { PARTIALS }));
            let duals = Arguments {
                numbers: numbers.collect(),
                n: given.n,
                lines: given.lines,
                inputs: given.inputs,
            };
            let mut terms = Vec::new();
            live.with_partials(duals.parameters(), &mut |equations| {
                let [a, multipliers, _] = solved(equations, &duals);
                let results = a.iter().chain(&multipliers).zip(&weights);
                terms = results.map(|(result, weight)| weight * result.partials[0]).collect();
            })
            .unwrap();
            let (forward, size) =
                (terms.iter().sum::<f64>(), terms.iter().map(|term| term.abs()).sum::<f64>());
            let deviation = (forward - found).abs() / (1.0 + size);
            assert!(deviation < 1e-10, "{}, {at}: {forward:e} forward, {found:e} backward", live.info().name);
            worst = worst.max(deviation);
        }
        println!("{}: {} derivatives, apart by {worst:.1e}", live.info().name, gradient.len());
    }
}
