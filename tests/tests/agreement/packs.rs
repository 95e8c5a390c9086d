//! Runs that advance together, and each alone.

use mbs_live::{LANES, Live, Pack, Run};
use mbs_runtime::{Explicit, SCHEMES, System};

use crate::compare::same;

/// Each run of a pack with its own parameters and inputs, with every scheme and both kinds of
/// feedback, is what it is alone.
pub fn packs_agree(live: &Live, inputs: &[f64], h: f64) {
    let info = live.declared_info();
    let start = |lane: usize, method: Explicit| -> Run {
        let factor = 1.0 + 1e-4 * lane as f64;
        let change = |values: &mut [f64]| values.iter_mut().for_each(|value| *value *= factor);
        let mechanism = live.with_parameters(change).expect("parameters");
        let inputs: Vec<f64> = inputs.iter().map(|input| input * factor).collect();
        Run::builder(&mechanism, h).method(method).inputs(&inputs).build().expect("a start")
    };
    let methods = SCHEMES
        .map(|tableau| [Explicit::held(tableau), Explicit::per_stage(tableau), Explicit::projected(tableau)]);
    for method in methods.into_iter().flatten() {
        let mut alone: Vec<Run> = (0..LANES - 1).map(|lane| start(lane, method)).collect();
        let together: Vec<Run> = (0..LANES - 1).map(|lane| start(lane, method)).collect();
        let mut pack = match Pack::new(together) {
            Ok(pack) => pack,
            // which are judged run by run
            Err(runs) => {
                assert!(!info.redundant.is_empty() && runs.len() == LANES - 1);
                continue;
            }
        };
        let mut rows = vec![[0.0; LANES]; info.coordinates.len() + info.outputs.len()];
        for _ in 0..50 {
            assert_eq!(pack.step(), []);
            assert_eq!(pack.observe(&mut rows), []);
            for (lane, run) in alone.iter_mut().enumerate() {
                run.step().expect("a step");
                let found: Vec<f64> = rows.iter().map(|row| row[lane]).collect();
                same("what is observed", &found, &observed(run));
            }
        }
        for (found, expected) in pack.into_runs().iter().zip(&alone) {
            assert_eq!((found.steps(), found.time()), (expected.steps(), expected.time()));
            assert_eq!(found.worst_growth(), expected.worst_growth());
            same("the end", &observed(found), &observed(expected));
            same("violations", &found.violations(), &expected.violations());
        }
    }
}

/// Coordinates and outputs.
fn observed(run: &Run) -> Vec<f64> {
    let info = run.equations().info();
    let zeros = |count: usize| vec![0.0; count];
    let n = info.coordinates.len();
    let (mut q, mut v, mut acceleration) = (zeros(n), zeros(n), zeros(n));
    let (mut multipliers, mut outputs) = (zeros(info.constraints.len()), zeros(info.outputs.len()));
    run.state(&mut q, &mut v);
    run.reactions(&mut acceleration, &mut multipliers).expect("reactions");
    run.outputs(&acceleration, &multipliers, &mut outputs).expect("outputs");
    [q, outputs].concat()
}
