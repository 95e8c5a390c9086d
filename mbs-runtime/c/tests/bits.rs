//! Runs through the interface are those of Rust, to the bit: mechanisms of the library, with every kind of method.
#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

mod support;

use mbs_live::{Live, Prepared, Text};
use mbs_runtime::{Adaptive, Dop853, Explicit, RATTLE4, RK4, Rattle, Sampled, System, Tolerances, TrBdf2};
use support::{
    LIBRARY, Mechanism, c, file, mbs_read, mbs_run_set_input, mbs_run_set_tolerances, ok, rust_bits,
};

const STEPS: u64 = 200;

/// A mechanism through the interface, and in Rust.
fn both(name: &str) -> (Mechanism, Live) {
    let path = file(name);
    let text = path.to_str().expect("a path of UTF-8");
    let mut mechanism = std::ptr::null_mut();
    #[allow(unsafe_code, reason = "the path ends with a NUL, and the result has a place")]
    ok(unsafe { mbs_read(c(text).as_ptr(), std::ptr::null(), 0.0, &mut mechanism) });
    let live = Text::read(&path).expect("a text").compile().unwrap_or_else(|error| panic!("{error}"));
    (Mechanism(mechanism), live)
}

/// Both from the start on, with every input set to a half on the way.
#[track_caller]
fn agree(mut run: support::Run, mut system: Box<dyn System>) {
    let inputs = vec![0.5; system.equations().info().inputs.len()];
    for part in 0..4 {
        assert_eq!(run.bits(), rust_bits(&*system), "{part}");
        if part == 1 {
            for (at, &input) in inputs.iter().enumerate() {
                #[allow(unsafe_code, reason = "the handle is not freed")]
                ok(unsafe { mbs_run_set_input(run.pointer, at, input) });
            }
            // what is set makes a method solve anew, even where nothing changes
            if !inputs.is_empty() {
                system.set_inputs(&inputs);
            }
        }
        ok(run.step(STEPS / 4));
        system.advance(STEPS / 4).expect("steps");
    }
    assert_eq!(run.bits(), rust_bits(&*system));
}

#[test]
fn mechanisms_of_the_library_as_declared() {
    for name in LIBRARY {
        let (mechanism, live) = both(name);
        let step = live.declared_step().unwrap_or(1e-4);
        let method = Explicit::held(live.declared_scheme());
        let mut builder = mbs_live::Run::builder(&live, step).method(method);
        if let Some(feedback) = live.declared_feedback() {
            assert!(feedback.is_held, "{name}: not met yet");
            builder = builder.gains([feedback.alpha, feedback.beta]);
        }
        agree(mechanism.run("", step).started(), Box::new(builder.build().expect("a start")));
    }
}

#[test]
fn other_schemes_and_what_keeps_the_constraints() {
    let (mechanism, live) = both("four_bar_free");
    for (words, method) in [
        ("rk4", Explicit::held(&RK4)),
        ("per-stage", Explicit::per_stage(live.declared_scheme())),
        ("projection rk4", Explicit::projected(&RK4)),
    ] {
        let run = mbs_live::Run::builder(&live, 1e-4).method(method).build().expect("a start");
        agree(mechanism.run(words, 1e-4).started(), Box::new(run));
    }
}

#[test]
fn methods_that_keep_the_constraints_themselves() {
    let (mechanism, live) = both("double_pendulum");
    let rattle = Rattle::builder(Prepared::new(&live), 1e-3).composition(&RATTLE4).build().expect("a start");
    agree(mechanism.run("rattle4", 1e-3).started(), Box::new(rattle));
    let stiff = TrBdf2::builder(Prepared::new(&live), 1e-3).build().expect("a start");
    agree(mechanism.run("trbdf2", 1e-3).started(), Box::new(stiff));
}

#[test]
fn runs_to_a_tolerance() {
    let tolerances = Tolerances { rtol: 1e-9, atol: 1e-11, ..Tolerances::default() };
    let with_tolerances = |run: support::Run| {
        #[allow(unsafe_code, reason = "the handle is not freed")]
        ok(unsafe { mbs_run_set_tolerances(run.pointer, 1e-9, 1e-11) });
        run.started()
    };
    let (mechanism, live) = both("slider_crank_free");
    let declared = Adaptive::builder(Prepared::new(&live)).tolerances(tolerances).build().expect("a start");
    let declared = Sampled::new(declared, 1e-3).expect("an interval");
    agree(with_tolerances(mechanism.run("", 1e-3)), Box::new(declared));
    let fine = Adaptive::builder(Prepared::new(&live)).scheme::<Dop853>().tolerances(tolerances).build();
    let fine = Sampled::new(fine.expect("a start"), 1e-3).expect("an interval");
    agree(with_tolerances(mechanism.run("dop853 projection", 1e-3)), Box::new(fine));
}
