//! The WebAssembly module of a mechanism, run by an interpreter of WebAssembly, computes what the live
//! mechanism does, to the last bit: functions at random states, and steps.
#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests")]

mod host;
mod runs;

use std::fs;
use std::path::Path;

use host::{Given, Host};
use mbs_live::{Live, Stepper, Text};
use mbs_runtime::equations::{At, Equations};
use mbs_runtime::{Explicit, Gains};

/// Uniform in −1 … 1.
fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// Equal to the bit; numbers that are none have bits of the processor's choice.
fn same(what: &str, found: &[f64], expected: &[f64]) {
    let bits = |numbers: &[f64]| -> Vec<u64> {
        numbers.iter().map(|x| if x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() }).collect()
    };
    assert_eq!(bits(found), bits(expected), "{what}: {found:?}, expected {expected:?}");
}

fn model(file: &str) -> Text {
    Text::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../models/src").join(file)).unwrap()
}

fn agree(text: &Text) {
    let live = text.compile().unwrap_or_else(|error| panic!("{error}"));
    let wasm = text.wasm().unwrap_or_else(|error| panic!("{error}"));
    let mut host = Host::new(&wasm.module, live.parameters());
    functions_agree(&live, &mut host);
    for (name, method) in [("step_held", Explicit::default()), ("step_per_stage", per_stage())] {
        let method = Explicit { tableau: live.declared_scheme(), ..method };
        steps_agree(&live, &mut host, name, method);
    }
}

fn per_stage() -> Explicit {
    Explicit { stabilization: mbs_runtime::Stabilization::PerStage, ..Explicit::default() }
}

fn functions_agree(live: &Live, host: &mut Host) {
    let info = live.declared_info();
    let (t, q, v) = live.declared_start();
    let (n, m) = (q.len(), info.constraints.len());
    same(
        "declared_start",
        &host.call("declared_start", &[], &[n, n]).concat(),
        &[q.clone(), v.clone(), vec![t]].concat(),
    );
    let gains = [-300.0, -2e5];
    let mut seed = 7;
    for round in 0..20 {
        let mut near = |values: &[f64], size: f64| -> Vec<f64> {
            values.iter().map(|value| value + size * random(&mut seed)).collect()
        };
        let (q, v, feedback) = (near(&q, 0.1), near(&v, 3.0), near(&vec![0.0; m], 1.0));
        let inputs = near(&vec![0.0; info.inputs.len()], 2.0);
        let t = t + 0.01 * f64::from(round);
        let at = At { t, q: &q, v: &v };
        let states = |all: &[f64]| -> Vec<f64> { info.states.iter().map(|&state| all[state]).collect() };
        let (q_states, v_states) = (states(&q), states(&v));
        let at_states = At { t, q: &q_states, v: &v_states };
        let [time, position, velocity] = [Given::Number(t), Given::Vector(&q), Given::Vector(&v)];
        let [of_step, rates] = [Given::Vector(&q_states), Given::Vector(&v_states)];
        let [given, residual] = [Given::Vector(&inputs), Given::Vector(&feedback)];
        let mut expect = |name: &str, given: &[Given<'_>], expected: &[&[f64]], returned: Option<f64>| {
            let lengths: Vec<usize> = expected.iter().map(|vector| vector.len()).collect();
            let expected: Vec<f64> = expected.concat().into_iter().chain(returned).collect();
            same(&format!("{name} of {}", info.name), &host.call(name, given, &lengths).concat(), &expected);
        };

        let (mut rows, mut solved) = (vec![0.0; m], vec![0.0; n]);
        live.phi(t, &q, &mut rows);
        expect("phi", &[time, position], &[&rows], None);
        live.phi_dot(at, &mut rows);
        expect("phi_dot", &[time, position, velocity], &[&rows], None);
        let mut found = vec![0.0; q_states.len()];
        let both = Gains { minus_two_alpha: gains[0], minus_beta_squared: gains[1] };
        let growth = live.stabilized(at_states, &inputs, &both, &mut found, &mut rows);
        let arguments = [time, of_step, rates, given, Given::Vector(&gains)];
        expect("stabilized", &arguments, &[&found, &rows], Some(growth));
        let growth = live.constrained(at_states, &inputs, &feedback, &mut found);
        expect("constrained", &[time, of_step, rates, given, residual], &[&found], Some(growth));
        let growth = live.position_correction(t, &q, &feedback, &mut solved);
        expect("position_correction", &[time, position, residual], &[&solved], Some(growth));
        let growth = live.velocity_correction(t, &q, &feedback, &mut solved);
        expect("velocity_correction", &[time, position, residual], &[&solved], Some(growth));
        let growth = live.projection(t, &q, &feedback, &mut solved);
        expect("projection", &[time, position, residual], &[&solved], Some(growth));
        let growth = live.reactions(at, &inputs, &mut solved, &mut rows);
        let none = vec![0.0; m];
        let arguments = [time, position, velocity, given, Given::Vector(&none)];
        expect("reactions", &arguments, &[&solved, &rows], Some(growth));
        let mut outputs = vec![0.0; info.outputs.len()];
        live.outputs(at, &inputs, [&solved, &rows], &mut outputs);
        let reactions = [solved.clone(), rows.clone()].concat();
        expect("outputs", &[time, position, velocity, given, Given::Vector(&reactions)], &[&outputs], None);
        expect("kinetic_energy", &[time, position, velocity], &[], Some(live.kinetic_energy(at)));
        expect("potential_energy", &[time, position, velocity], &[], Some(live.potential_energy(at)));
        let mut points = vec![0.0; 2 * live.sketch().points.len()];
        live.points(t, &q, &mut points);
        expect("points", &[time, position], &[&points], None);
        let (mut q_all, mut v_all) = (vec![0.0; n], vec![0.0; n]);
        live.complete(at_states, &mut q_all, &mut v_all);
        expect("complete", &[time, of_step, rates], &[&q_all, &v_all], None);
    }
}

/// Steps from the declared start, each of which begins where the last one has ended.
fn steps_agree(live: &Live, host: &mut Host, name: &str, method: Explicit) {
    if !host.has(name) {
        return;
    }
    let info = live.declared_info();
    let h = live.declared_step().unwrap_or(1e-4);
    let [alpha, beta] = method.deadbeat(h);
    let gains = Gains { minus_two_alpha: -2.0 * alpha, minus_beta_squared: -beta * beta };
    let given_gains = [gains.minus_two_alpha, gains.minus_beta_squared];
    let inputs = vec![0.25; info.inputs.len()];
    let (start, q, v) = live.declared_start();
    let states = |all: &[f64]| -> Vec<f64> { info.states.iter().map(|&state| all[state]).collect() };
    let (mut q, mut v) = (states(&q), states(&v));
    let mut steps = Stepper::new(live, method);
    for k in 0..200 {
        let (t, t_next) = (start + f64::from(k) * h, start + f64::from(k + 1) * h);
        let growth = steps.step(At { t, q: &q, v: &v }, &inputs, &gains, h, t_next);
        let given = [
            Given::Number(t),
            Given::Vector(&q),
            Given::Vector(&v),
            Given::Vector(&inputs),
            Given::Vector(&given_gains),
            Given::Number(h),
            Given::Number(0.5 * h),
            Given::Number(t_next),
        ];
        let found = host.call(name, &given, &[q.len(), v.len()]).concat();
        same(&format!("{name} of {}", info.name), &found, &[steps.q(), steps.v(), &[growth]].concat());
        (q, v) = (steps.q().to_vec(), steps.v().to_vec());
    }
}

#[test]
fn mechanisms_of_the_library() {
    let files = [
        "slider_crank.rs",
        "slider_crank_free.rs",
        "double_pendulum.rs",
        "four_bar.rs",
        "cam_follower.rs",
        "block_on_incline.rs",
        "jansen_walker.rs",
        "planetary_gear.rs",
        "trammel_of_archimedes.rs",
        "v_engine.rs",
        "andrews_squeezer.rs",
        "geneva_pin_slot.rs",
        "quick_return.rs",
        "metronome.rs",
        "excavator.rs",
    ];
    for file in files {
        agree(&model(file));
    }
}

/// Long programs are written as loops.
#[test]
fn chains_in_loops() {
    for file in ["n_pendulum.rs", "n_four_bar.rs"] {
        agree(&chain(file, 40));
    }
    // tables of places that have no rule, loops that run down, chances for loops of few copies
    for file in
        ["jansen_walker.rs", "planetary_gear.rs", "v_engine.rs", "excavator.rs", "andrews_squeezer.rs"]
    {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../models/src").join(file);
        let text = fs::read_to_string(path).unwrap().replacen("dof = ", "limit unrolled = 0; dof = ", 1);
        agree(&Text::rust(file, text));
    }
}

/// A chain of the library with so many links.
fn chain(file: &str, links: usize) -> Text {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../models/src").join(file);
    let text = fs::read_to_string(path).unwrap().replace("$(#[$($attribute)*])*", "");
    Text::rust(file, text.replace("$Name", "Chain").replace("$n", &links.to_string())).named("Chain")
}

/// Coordinates that constraints give are not among the states of a step.
#[test]
fn reduced_states() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../models/src/slider_crank_free.rs");
    let text = fs::read_to_string(path).unwrap().replacen("dof = 1;", "dof = 1; states = reduced;", 1);
    let text = Text::rust("reduced.rs", text);
    let info = text.compile().unwrap().declared_info();
    assert!(info.states.len() < info.coordinates.len());
    agree(&text);
}

/// Every elementary function and kind of table, sines of far angles too; those of the host are here the ones of Rust.
#[test]
fn every_function() {
    agree(&Text::declaration("functions.mbs", FUNCTIONS));
}

const FUNCTIONS: &str = "Functions {
    dof = 2;
    param k = 3 [N];
    param l = 2 [m];
    input first [1];
    input second [1];
    body one (x) { mass = 1 [kg]; }
    body two (y) { mass = 2 [kg]; }
    let u = x/l;
    let w = y/l + first;
    force elementary on x = -k*(sin(u) + cos(w) + tan(u/4) + asin(u/8) + acos(w/8) + atan(w) + sqrt(1 + u^2)
        + exp(-w^2) + ln(2 + u^2) + tanh(w) + abs(u) + sign(w) + sin(1e6*w) + cos(1e6*u));
    force others on y = k*(atan2(u, 1 + w^2) + min(u, w) + max(u, second) + pow(1 + u^2, w/3) - 2*w);
    table rises(u) = [(-1, -0.3), (0, 0), (0.25, 0.5), (2, 0.7)] monotone outside hold;
    table bends(u) = [(-0.5, 1), (0, 0.5), (0.4, 2), (0.9, -1)] cubic outside extend;
    table kinks(w) = [(-0.3, 0), (0, 1), (0.3, 0)] linear outside periodic;
    table steps(w) = [(-0.2, 1), (0.1, 2)] step outside extend;
    table all(w) = [(-100, 0.5), (0, 1), (100, 3)] cubic outside refuse;
    force by_tables on x = k*(rises(u) + bends(2*w) + kinks(w) - steps(u) + all(w));
    force chosen on y = k*(if u > w && !(w > 0.2) { sqrt(u - w) } else if u < -0.1 || t < 0.1 [s] { u } else { ln(w) })
        + k*(clamp(u, -0.1, w) - step(u) + ramp(w));
    start { x = 0.3 [m]; y = -0.4 [m]; der(x) = 1 [m/s]; }
    output largest = max(u, w);
    output far = sin(1e7*u);
}";

/// Pages carry the module.
#[test]
fn module_is_small() {
    let sizes = [("slider_crank.rs", 40_000), ("double_pendulum.rs", 30_000), ("jansen_walker.rs", 400_000)];
    for (file, most) in sizes {
        let length = model(file).wasm().unwrap().module.len();
        println!("{file}: {length} bytes");
        assert!(length < most, "{file}: {length} bytes");
    }
    // what a link more takes is its places in the tables of loops, and not its instructions, which are 5 kB
    let [short, long] = [40, 80].map(|links| chain("n_pendulum.rs", links).wasm().unwrap().module.len());
    println!("n_pendulum.rs: {short} bytes with 40 rods, {long} with 80");
    assert!(long < short + 40 * 1_500, "{short} and {long} bytes");
}
