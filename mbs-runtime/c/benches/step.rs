//! The cost of a step through the C interface and in Rust, in turns in one process.
#![allow(unsafe_code, reason = "a function of C is called with a handle that is not freed")]
#![allow(clippy::expect_used, clippy::panic, reason = "a benchmark")]

#[path = "../tests/support/mod.rs"]
mod support;

use std::time::Instant;

use mbs_live::{Run, Text};
use mbs_runtime::System;
use support::{Mechanism, file, mbs_run_step, ok};

// short rounds, some of which nothing else interrupts
const STEPS: u64 = 500;
const ROUNDS: usize = 1000;

/// The least and the median time of a step in ns.
fn summary(mut times: Vec<f64>) -> [f64; 2] {
    times.sort_by(f64::total_cmp);
    [times[0], times[times.len() / 2]].map(|time| 1e9 * time / STEPS as f64)
}

fn timed(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}

fn main() {
    println!("least / median of {ROUNDS} rounds of {STEPS} steps, in ns a step");
    for name in ["pendulum", "slider_crank_free", "jansen"] {
        let text = std::fs::read_to_string(file(name)).expect("a text");
        let (_, declaration) = text.split_once("mechanism! {").expect("a declaration");
        let declaration = declaration.rsplit_once('}').expect("its end").0;
        let live = Text::declaration(name, declaration).compile().unwrap_or_else(|error| panic!("{error}"));
        let mut rust: Box<dyn System> = Box::new(Run::builder(&live, 1e-5).build().expect("a start"));
        let c = Mechanism::compiled(declaration).run("held", 1e-5).started();
        let (mut of_rust, mut of_c) = (Vec::new(), Vec::new());
        for _ in 0..ROUNDS {
            of_rust.push(timed(|| (0..STEPS).for_each(|_| rust.step().expect("a step"))));
            // SAFETY: the handle is not freed
            of_c.push(timed(|| (0..STEPS).for_each(|_| ok(unsafe { mbs_run_step(c.pointer, 1) }))));
        }
        assert_eq!(c.bits(), support::rust_bits(&*rust));
        let [[least, median], [least_c, median_c]] = [summary(of_rust), summary(of_c)];
        println!("{name:20} Rust {least:7.1} / {median:7.1}   C {least_c:7.1} / {median_c:7.1}");
    }
}
