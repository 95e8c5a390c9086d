//! Two printers of one compiled mechanism agree: C, built by gcc or clang, and live, which
//! runs the text at once. `models/tests/library` holds live to the third one, rustc's code.
//!
//! `MECHANISMS=200 cargo test --release -p c_code --test programs printers` tries more of the random
//! ones.

#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

use c_code::{Choice, Fault, build, compilers};
use mbs_live::{Live, Run, Scalar, Text};
use mbs_runtime::{Baumgarte, Error, Held, Method, PerStage, System};
use paths::{STRIDE, some_of};

use crate::{between_stops, linkages, rough, thrown};

const MECHANISMS: u64 = 24;
const STEPS: usize = 1000;
const EVERY: usize = 10;

/// A run as it looks from outside: t, q, v, q̈, λ and outputs, at the start and after every tenth step; and
/// why it ended before its end, if it did.
type Rows = (Vec<Vec<f64>>, Option<Error>);

fn alone<X: Method>(live: &Live, step: f64, inputs: &[f64]) -> Result<Rows, Error> {
    let gains = Baumgarte::<X>::deadbeat(step);
    let mut run = Run::builder(live, step).baumgarte(gains).build()?;
    run.set_inputs(inputs);
    let info = live.declared_info();
    let (n, m) = (info.coordinates.len(), info.constraints.len());
    let mut rows = Vec::new();
    for taken in 0..=STEPS {
        if taken.is_multiple_of(EVERY) {
            let mut row = vec![0.0; 1 + 3 * n + m + info.outputs.len()];
            row[0] = run.time();
            let (q, rest) = row[1..].split_at_mut(n);
            let (v, rest) = rest.split_at_mut(n);
            let (acceleration, rest) = rest.split_at_mut(n);
            let (multipliers, outputs) = rest.split_at_mut(m);
            run.state(q, v);
            let seen = run
                .reactions(acceleration, multipliers)
                .and_then(|()| run.outputs(acceleration, multipliers, outputs));
            if let Err(error) = seen {
                return Ok((rows, Some(error)));
            }
            rows.push(row);
        }
        if taken < STEPS
            && let Err(error) = run.step()
        {
            return Ok((rows, Some(error)));
        }
    }
    Ok((rows, None))
}

/// Runs a mechanism in both ways; whether it could be started.
fn compare(name: &str, text: &Text, step: f64, compiler: &str) -> bool {
    let live = text.compile().unwrap_or_else(|error| panic!("{name}: {error}"));
    let sources = text.c(Scalar::Double).unwrap_or_else(|error| panic!("{name}: {error}"));
    let built = build(&sources, compiler, "-O1").unwrap_or_else(|fault| panic!("{name}: {fault}"));
    let info = live.declared_info();
    let free = info.free_inputs().len();
    let inputs: Vec<f64> = (0..info.inputs.len()).map(|at| if at < free { 0.5 } else { f64::NAN }).collect();
    let mut has_started = true;
    for is_held in [true, false] {
        let gains = if is_held {
            let gains = Baumgarte::<Held>::deadbeat(step);
            (gains.alpha(), gains.beta(), true)
        } else {
            let gains = Baumgarte::<PerStage>::deadbeat(step);
            (gains.alpha(), gains.beta(), false)
        };
        let feedback = Some(gains);
        let choice = Choice { step, steps: STEPS, every: EVERY, feedback, inputs: &inputs, start: None };
        let of_c = built.run(&choice);
        let of_live = if is_held {
            alone::<Held>(&live, step, &inputs)
        } else {
            alone::<PerStage>(&live, step, &inputs)
        };
        match (of_c, of_live) {
            (Ok(of_c), Ok((of_live, None))) => {
                assert_eq!(of_c.len(), of_live.len(), "{name}");
                for (at, (c, live)) in of_c.iter().zip(&of_live).enumerate() {
                    // but for the sign of a zero, which a fused step may change
                    assert!(c == live, "{name}, held: {is_held}, line {at}:\n{c:?}\n{live:?}");
                }
            }
            (Err(Fault::Program(_)), Err(_)) => has_started = false,
            (Err(Fault::Program(_)), Ok((_, Some(_)))) => {}
            (of_c, of_live) => {
                let ended = of_live.map(|(rows, ended)| (rows.len(), ended));
                panic!("{name}, held: {is_held}: {:?} in C, {ended:?} live", of_c.map(|rows| rows.len()));
            }
        }
    }
    has_started
}

/// Those that hit, rest, stick and lock; the others are in `library`.
#[test]
fn mechanisms_of_the_library() {
    let Some(&compiler) = compilers().first() else { return };
    let texts = mbs::library().iter().map(|entry| (entry.name, entry.text()));
    let jumps = |text: &Text| text.compile().is_ok_and(|live| live.declared_info().jumps());
    for (name, text) in texts.filter(|(_, text)| jumps(text)).step_by(STRIDE) {
        assert!(compare(name, &text, 1e-4, compiler), "{name} starts");
    }
}

#[test]
fn random_mechanisms() {
    let Some(&compiler) = compilers().first() else { return };
    let count =
        std::env::var("MECHANISMS").map_or(some_of(MECHANISMS), |text| text.parse().expect("a number"));
    let (mut number, mut compared) = (0, 0);
    while compared < count {
        let text = Text::declaration(format!("random {number}"), linkages::declaration(number));
        if text.compile().is_ok() {
            compared += u64::from(compare(&format!("random {number}"), &text, 1e-4, compiler));
        }
        number += 1;
    }
}

/// Between stops, on which they land and rest.
#[test]
fn random_mechanisms_between_stops() {
    compare_random("stops", |number| between_stops::random(number).0);
    compare_random("bearing", |number| between_stops::bearing(&between_stops::random(number).0));
}

/// Random mechanisms of a kind.
fn compare_random(kind: &str, declaration: impl Fn(u64) -> String) {
    let Some(&compiler) = compilers().first() else { return };
    for number in 0..some_of(8) {
        let name = format!("{kind} {number}");
        let text = Text::declaration(&name, declaration(number));
        assert!(compare(&name, &text, 1e-3, compiler), "{name} starts");
    }
}

/// The same with friction that sticks.
#[test]
fn random_mechanisms_that_stick() {
    compare_random("sticks", between_stops::rubbing);
}

/// The same with modes that are entered and left.
#[test]
fn random_mechanisms_with_modes() {
    compare_random("modes", |number| between_stops::switching(number, &between_stops::rubbing(number)));
}

/// The same with modes that are left where they hold with too much.
#[test]
fn random_mechanisms_that_let_go() {
    compare_random("forces", |number| between_stops::letting_go(number, &between_stops::rubbing(number)));
}

/// Conditions on forces without modes.
#[test]
fn conditions_on_forces() {
    let Some(&compiler) = compilers().first() else { return };
    let text = "Hanging { dof = 1; gravity = (0, -10) [m/s^2];
        body bob (x, y, phi) { mass = 2 [kg]; inertia = 0.5 [kg*m^2]; } point top on bob = (0, 0.5 [m]);
        revolute pin (bob.top, ground);
        memory times [1] = 0; memory side [1] = 1;
        when reaction(pin) > 20 [N] { set times = times + 1; }
        when der(der(phi)) < 0 { set side = -1; }
        when der(der(phi)) > 0 { set side = 1; }
        torque push on bob = side*0.5 [N*m];
        start { guess x = 0; y = -0.5 [m]; phi = 0; der(phi) = 2 [rad/s]; }
        output times = times; }";
    assert!(compare("forces", &Text::declaration("forces", text), 1e-3, compiler));
}

/// Blocks and rods, thrown on what rubs.
#[test]
fn random_mechanisms_on_rough_stops() {
    compare_random("thrown", |number| thrown::random(number).0);
    compare_random("bearing thrown", |number| between_stops::bearing(&thrown::random(number).0));
}

#[test]
fn mechanisms_on_rough_stops() {
    let Some(&compiler) = compilers().first() else { return };
    for (name, text) in rough::rough().step_by(STRIDE) {
        assert!(compare(name, &Text::declaration(name, text), 1e-3, compiler), "{name} starts");
    }
}
