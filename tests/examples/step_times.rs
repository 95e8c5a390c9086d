//! Times Heun steps with feedback in both stages, from the declared starts: prints
//! name, median of ns per step, and the sum of the last state.
//! `benches/casadi/compare.py` compares with it.

use std::hint::black_box;
use std::time::Instant;

use mbs_runtime::{Baumgarte, Components, Mechanism, PerStage, Simulation};
use models::*;

const STEPS: u32 = 600;
const REPETITIONS: usize = 21;

fn main() {
    time("driven", 0.5e-3, SliderCrank::declared(), Default::default());
    time("free", 0.5e-3, SliderCrankFree::declared(), SliderCrankFreeInputs { crank_torque: 0.5 });
    time("pendulum 1", 1e-3, NPendulum1::declared(), Default::default());
    time("pendulum 10", 1e-3, NPendulum10::declared(), Default::default());
    time("pendulum 40", 1e-3, NPendulum40::declared(), Default::default());
    time("four-bar 1", 1e-3, NFourBar1::declared(), Default::default());
    time("four-bar 10", 1e-3, NFourBar10::declared(), Default::default());
    time("four-bar 40", 1e-3, NFourBar40::declared(), Default::default());
}

#[inline(never)]
fn time<M: Mechanism<Real = f64>>(name: &str, h: f64, mechanism: M, inputs: M::Inputs) {
    let simulation = Simulation::builder(black_box(mechanism), h)
        .baumgarte(Baumgarte::<PerStage>::deadbeat(h))
        .inputs(inputs)
        .build()
        .unwrap_or_else(|_| std::process::abort());
    let mut times = Vec::with_capacity(REPETITIONS);
    let mut sum = 0.0;
    for _ in 0..REPETITIONS {
        let start = Instant::now();
        let mut run = black_box(simulation);
        for _ in 0..STEPS {
            if run.step().is_err() {
                std::process::abort();
            }
        }
        let state = black_box(run.state());
        times.push(start.elapsed().as_secs_f64() * 1e9 / f64::from(STEPS));
        let (q, v) = (state.q.into_array(), state.v.into_array());
        sum = q.as_ref().iter().chain(v.as_ref()).sum();
    }
    times.sort_by(f64::total_cmp);
    println!("{name} {:.3} {sum:.12}", times[REPETITIONS / 2]);
}
