//! Random mechanisms compiled by rustc and run from their texts: q, v, q̈, λ and outputs of
//! 1,000 steps are the same numbers, with every method; a run that cannot start or ends early
//! does so in both, with the same error.
//!
//! `MECHANISMS=200 cargo test --release -p random_types` compiles more of them.
#![allow(clippy::expect_used, clippy::panic, reason = "a test says by panicking what is wrong")]

use mbs_live::{Live, Text};
use mbs_runtime::{Baumgarte, Error, Held, Mechanism, Method, PerStage, Rk4, Simulation, System};
use random_types::{Visit, all};

const STEP: f64 = 1e-4;
const STEPS: u64 = 1000;

struct Compare {
    compared: usize,
}

impl Visit for Compare {
    fn visit<M: Mechanism<Real = f64>>(&mut self, text: &str) {
        let live = Text::declaration("random.mbs", text).compile().unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(live.declared_info(), M::INFO);
        let mechanism = M::new(M::Parameters::default()).expect("declared parameters");
        let has_started = [
            same::<M, Held>(&live, mechanism),
            same::<M, PerStage>(&live, mechanism),
            same::<M, Held<Rk4>>(&live, mechanism),
        ];
        self.compared += usize::from(has_started[0]);
    }
}

/// Compares the runs of one method; whether they could be started.
fn same<M: Mechanism<Real = f64>, X: Method>(live: &Live, mechanism: M) -> bool {
    let baumgarte = Baumgarte::<X>::deadbeat(STEP);
    let typed = Simulation::builder(mechanism, STEP).baumgarte(baumgarte).build();
    let text = mbs_live::Run::builder(live, STEP).baumgarte(baumgarte).build();
    let (mut typed, mut text) = match (typed, text) {
        (Ok(typed), Ok(text)) => (typed, text),
        (typed, text) => {
            assert_eq!(typed.err(), text.err(), "{}", M::INFO.name);
            return false;
        }
    };
    for step in 0..STEPS {
        let name = M::INFO.name;
        let (found, expected) = (seen(&text), seen(&typed));
        assert!(are_same(&found, &expected), "{name}, step {step}:\n{found:?}\n{expected:?}");
        let (found, expected) = (text.step(), System::step(&mut typed));
        assert_eq!(format!("{found:?}"), format!("{expected:?}"), "{name}, step {step}");
        if expected.is_err() {
            break;
        }
    }
    true
}

/// t, q, v, q̈, λ and outputs, or why there are none.
fn seen(run: &dyn System) -> Result<Vec<f64>, Error> {
    let info = run.equations().info();
    let (n, m) = (info.coordinates.len(), info.constraints.len());
    let (mut q, mut v, mut a) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    let (mut multipliers, mut outputs) = (vec![0.0; m], vec![0.0; info.outputs.len()]);
    run.state(&mut q, &mut v);
    run.reactions(&mut a, &mut multipliers)?;
    run.outputs(&a, &multipliers, &mut outputs)?;
    Ok([vec![run.time()], q, v, a, multipliers, outputs].concat())
}

/// Equal numbers, zeros of any sign, or equal errors.
fn are_same(a: &Result<Vec<f64>, Error>, b: &Result<Vec<f64>, Error>) -> bool {
    match (a, b) {
        (Ok(a), Ok(b)) => a == b,
        (a, b) => format!("{a:?}") == format!("{b:?}"),
    }
}

#[test]
fn rustc_and_live_agree_to_the_bit() {
    let mut compare = Compare { compared: 0 };
    all(&mut compare);
    println!("{} mechanisms", compare.compared);
    assert!(compare.compared > 0);
}
