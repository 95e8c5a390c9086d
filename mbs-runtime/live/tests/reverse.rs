//! Derivatives of sums over runs, of states and outputs, in reverse are those that dual numbers carry forward, for every mechanism
//! of the library, for schemes whose step is one program and for those in stages, with both kinds of
//! feedback and with projection, and whatever part of the states is kept.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test says by panicking what is wrong")]

use std::fs;
use std::path::Path;

use mbs_live::{Builder, Live, Run, Text};
use mbs_runtime::equations::Equations;
use mbs_runtime::gradients::{Sum, Variable};
use mbs_runtime::{DOPRI5, Dual, Error, Explicit, HEUN, RK4, Stabilization, System};

const STEPS: u64 = 30;
/// Such that no step meets a point of the profile of the cam, where its third derivative jumps.
const H: f64 = 0.47e-3;
/// Partials of a dual.
const N: usize = 8;

/// The mechanisms of the library.
fn library() -> Vec<Live> {
    with(|source| source)
}

/// The same of changed sources, but for those through whose clocks or stops no way leads back.
fn with(change: impl Fn(String) -> String) -> Vec<Live> {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/src");
    let mut found = Vec::new();
    for entry in fs::read_dir(sources).unwrap() {
        let path = entry.unwrap().path();
        let Ok(source) = fs::read_to_string(&path) else { continue };
        // chains are made by a macro
        let source = source.replace("$(#[$($attribute)*])*", "").replace("$Name", "Chain").replace("$n", "6");
        if source.contains("mechanism! {") && !path.ends_with("lib.rs") && !source.contains("    stop ") {
            let text = Text::rust(path.display().to_string(), change(source));
            let live = text.compile_with_transposes().unwrap();
            if live.declared_info().sampling.clocks == 0 {
                found.push(live);
            }
        }
    }
    assert!(found.len() > 30, "{}", found.len());
    found
}

/// The weight of a number in the sum: another one for every number and every step.
fn weight(step: u64, at: usize) -> f64 {
    (1.0 + 0.7 * step as f64 + 1.3 * at as f64).sin()
}

/// All parameters, all inputs over a part of the run, and where the first coordinate begins.
fn variables(live: &Live) -> Vec<Variable> {
    let info = live.declared_info();
    let parameters = info.parameters.iter().map(|parameter| Variable::Parameter(parameter.name));
    let inputs = info.inputs.iter().map(|input| Variable::Input { name: input.name, from: 7, until: 23 });
    let first = info.coordinates[0].name;
    parameters.chain(inputs).chain([Variable::Position(first), Variable::Velocity(first)]).collect()
}

/// The sum, its derivatives, and for each how large its terms are.
fn forward(builder: &Builder, sum: &Sum<'_>) -> (f64, Vec<f64>, Vec<f64>) {
    let count = sum.variables().len();
    let (mut gradient, mut sizes, mut chunk) = (vec![0.0; count], vec![0.0; count], 0);
    let term = |run: &Run<Dual<f64, N>>| {
        let mut term = Dual::default();
        for (at, x) in [run.q(), run.v(), &run.measured()?].concat().into_iter().enumerate() {
            let weighed = Dual::constant(weight(run.steps(), at)) * x;
            term = term + weighed;
            let places = sizes.iter_mut().skip(chunk * N);
            places.zip(weighed.partials).for_each(|(size, partial)| *size += partial.abs());
        }
        chunk += usize::from(run.steps() == sum.steps());
        Ok(term)
    };
    let value = builder.gradient(sum, term, &mut gradient).unwrap();
    (value, gradient, sizes)
}

/// How large the terms of the sum are.
fn terms(builder: &Builder, sum: &Sum<'_>) -> f64 {
    let mut terms = 0.0;
    let term = |run: &Run<Dual<f64, 1>>| {
        let numbers = [run.q(), run.v(), &run.measured()?].concat().into_iter().enumerate();
        terms += numbers.map(|(at, x)| (weight(run.steps(), at) * x.value).abs()).sum::<f64>();
        Ok(Dual::default())
    };
    let sum = Sum::new(sum.steps(), &[]);
    builder.gradient(&sum, term, &mut []).unwrap();
    terms
}

/// The size of a variable; 1 where it is 0, or no parameter.
fn itself(live: &Live, variable: Variable) -> f64 {
    let Variable::Parameter(_) = variable else { return 1.0 };
    let value = live.parameters()[variable.find(live.declared_info()).unwrap()].abs();
    if value == 0.0 { 1.0 } else { value }
}

fn backward(builder: &Builder, sum: &Sum<'_>, memory: usize) -> Result<(f64, Vec<f64>), Error> {
    let mut gradient = vec![0.0; sum.variables().len()];
    let value = builder.gradient_in_reverse(
        sum,
        memory,
        |moment| {
            let numbers = [moment.at.q, moment.at.v, moment.outputs()?].concat();
            let places = moment.by_q.iter_mut().chain(&mut *moment.by_v).chain(&mut *moment.by_outputs);
            places.enumerate().for_each(|(at, place)| *place = weight(moment.step, at));
            Ok(numbers.iter().enumerate().map(|(at, x)| weight(moment.step, at) * x).sum())
        },
        &mut gradient,
    )?;
    Ok((value, gradient))
}

/// Both agree to 1e-10 of the terms that a derivative is summed of, where these are more than rounding: a
/// thousand ε of the terms of the sum for a change of the variable by itself.
fn compared(live: &Live, method: Option<Explicit>) -> f64 {
    let info = live.declared_info();
    let builder = || {
        let builder = Run::builder(live, H);
        match method {
            Some(method) => builder.method(method),
            None => builder,
        }
    };
    let variables = variables(live);
    let signal = |step: u64, at: usize| 0.3 + 0.2 * at as f64 + 0.01 * step as f64;
    let sum = Sum::new(STEPS, &variables).driven_by(&signal);
    let (value, gradient, sizes) = forward(&builder(), &sum);
    let (again, reverse) = backward(&builder(), &sum, usize::MAX).unwrap();
    assert!((value - again).abs() <= 1e-12 * (1.0 + value.abs()) * STEPS as f64, "{}", info.name);
    let mut worst = 0.0_f64;
    let terms = terms(&builder(), &sum);
    for (((variable, forward), backward), size) in variables.iter().zip(&gradient).zip(&reverse).zip(&sizes) {
        let rounding = 1e3 * f64::EPSILON * terms / itself(live, *variable);
        let deviation = (forward - backward).abs();
        assert!(
            deviation <= 1e-10 * size + rounding,
            "{} by {variable:?}: {forward:e} {backward:e}, {size:e}",
            info.name
        );
        worst = worst.max(if *size > 1e6 * rounding { deviation / size } else { 0.0 });
    }
    // made again from a few states, it is the same to the last bit
    let kept = 2 * 8 * info.states.len() * 12;
    assert_eq!(backward(&builder(), &sum, kept).unwrap(), (again, reverse), "{}", info.name);
    worst
}

#[test]
fn declared_schemes() {
    for live in library() {
        println!("{}: {:.1e}", live.declared_info().name, compared(&live, None));
    }
}

#[test]
fn feedback_in_every_stage() {
    let method =
        |live: &Live| Explicit { tableau: live.declared_scheme(), stabilization: Stabilization::PerStage };
    for live in library() {
        println!("{}: {:.1e}", live.declared_info().name, compared(&live, Some(method(&live))));
    }
}

#[test]
fn steps_in_stages() {
    for live in library() {
        for (tableau, stabilization) in [
            (&DOPRI5, Stabilization::Held),
            (&RK4, Stabilization::PerStage),
            (&RK4, Stabilization::Held),
            (&RK4, Stabilization::Projection),
            (&HEUN, Stabilization::Projection),
        ] {
            let worst = compared(&live, Some(Explicit { tableau, stabilization }));
            println!("{}, {}: {worst:.1e}", live.declared_info().name, tableau.word);
        }
    }
}

#[test]
fn reduced_states() {
    let reduced = |source: String| match source.contains("states = ") {
        true => source,
        false => source.replacen(" dof = ", " states = reduced; dof = ", 1),
    };
    let mut fewer = 0;
    for live in with(reduced) {
        let projected = Explicit { tableau: &HEUN, stabilization: Stabilization::Projection };
        let worst = compared(&live, None).max(compared(&live, Some(projected)));
        fewer += usize::from(live.declared_info().states.len() < live.declared_info().coordinates.len());
        println!("{}, {} states: {worst:.1e}", live.declared_info().name, live.declared_info().states.len());
    }
    assert!(fewer > 20, "{fewer}");
}

const SWING: &str = "Swing {
    dof = 1;
    param length = 1 [m];
    gravity = (0, -9.81) [m/s^2];
    body bob (x, y) { mass = 2 [kg]; }
    constraint rod: x^2 + y^2 = length^2;
    start { x = length; guess y = 0; }
}";

#[test]
fn what_is_refused() {
    let text = Text::declaration("swing.mbs", SWING);
    let by = [Variable::Parameter("length")];
    let sum = Sum::new(100, &by);
    let plain = text.compile().unwrap();
    let error = backward(&Run::builder(&plain, H), &sum, usize::MAX).unwrap_err();
    assert!(error.to_string().contains("compile_with_transposes"), "{error}");

    let swing = text.compile_with_transposes().unwrap();
    // 10 + 10 states of 4 numbers are the least
    let error = backward(&Run::builder(&swing, H), &sum, 639).unwrap_err();
    assert_eq!(error, Error::Memory { allowed: 639, needed: 640 });
    assert!(backward(&Run::builder(&swing, H), &sum, 640).is_ok());
    let unknown = Sum::new(100, &[Variable::Parameter("mass")]);
    assert!(matches!(backward(&Run::builder(&swing, H), &unknown, 0), Err(Error::NoVariable { .. })));
    let mut short: [f64; 0] = [];
    let found = Run::builder(&swing, H).gradient_in_reverse(&sum, 1 << 20, |_| Ok(0.0), &mut short);
    assert!(matches!(found, Err(Error::Length { expected: 1, .. })));
    assert_eq!(swing.info().states.len(), 2);
}
