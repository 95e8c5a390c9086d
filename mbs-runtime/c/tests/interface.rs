//! Every function through its symbol, as C calls it: results, and an answer to everything that can be checked. Small
//! enough for Miri.
#![allow(unsafe_code, reason = "functions of C are called; each call keeps the contract of the header")]
#![allow(clippy::expect_used, reason = "helpers of tests")]

mod support;

use std::ffi::c_int;
use std::ptr::{null, null_mut};

use support::*;

/// The status of a call, and what it says.
fn failed(status: c_int) -> (c_int, String) {
    assert_ne!(status, OK);
    (status, error())
}

#[test]
fn a_pendulum_through_all_functions() {
    unsafe {
        assert_eq!(said(mbs_version()), env!("CARGO_PKG_VERSION"));
        assert_eq!(mbs_abi(), 1);
        let pendulum = Mechanism::compiled(PENDULUM);
        assert_eq!(
            [PARAMETER, INPUT, COORDINATE, OUTPUT, CONSTRAINT, POINT].map(|kind| pendulum.count(kind)),
            [2, 1, 2, 1, 1, 2]
        );
        let (mut name, mut freedom, mut index) = (null(), 0, 0);
        ok(mbs_mechanism_name(pendulum.0, &mut name));
        ok(mbs_mechanism_freedom(pendulum.0, &mut freedom));
        assert_eq!((said(name).as_str(), freedom), ("Pendulum", 1));
        ok(mbs_find(pendulum.0, PARAMETER, c("weight").as_ptr(), &mut index));
        assert_eq!(index, 1);

        let described = |kind, index| {
            let mut found = std::mem::MaybeUninit::<Quantity>::uninit();
            ok(mbs_describe(pendulum.0, kind, index, found.as_mut_ptr()));
            let Quantity { name, doc, unit, scale, value } = found.assume_init();
            (said(name), said(doc), said(unit), scale, value)
        };
        let text = str::to_owned;
        assert_eq!(
            described(PARAMETER, 0),
            (text("length"), text("From the pivot to the bob."), text("mm"), 1e-3, 0.5)
        );
        assert_eq!(described(INPUT, 0), (text("push"), text(""), text("N"), 1.0, 0.0));
        assert_eq!(described(COORDINATE, 0), (text("x"), text(""), text("m"), 1.0, 0.5));
        assert_eq!(described(OUTPUT, 0), (text("height"), text(""), text("mm"), 1e-3, 0.0));
        // Φ is an area, so that its multiplier is a force per length
        assert_eq!(described(CONSTRAINT, 0), (text("rod"), text(""), text("N/m"), 1.0, 0.0));
        assert_eq!(described(POINT, 0).0, "bob");

        let mut run = pendulum.run("rk4 projection", 0.01);
        ok(mbs_run_set_parameter(run.pointer, 0, 1.0));
        ok(mbs_run_set_input(run.pointer, 0, 3.0));
        run = run.started();
        ok(mbs_run_step(run.pointer, 5));
        ok(mbs_run_advance_to(run.pointer, 0.1));
        let ([mut parameters, mut q, mut v], mut inputs) = ([[0.0; 2]; 3], [0.0]);
        ok(mbs_run_parameters(run.pointer, parameters.as_mut_ptr(), 2));
        ok(mbs_run_inputs(run.pointer, inputs.as_mut_ptr(), 1));
        ok(mbs_run_state(run.pointer, q.as_mut_ptr(), v.as_mut_ptr(), 2));
        assert_eq!((parameters, inputs), ([1.0, 2.0], [3.0]));
        // projected to 1 m, to rounding
        assert!((q[0].hypot(q[1]) - 1.0).abs() < 1e-12, "{q:?}");

        // a copy outlives its run, and both outlive their mechanism
        let mut copy = run.copy();
        drop(pendulum);
        assert_eq!(run.bits(), copy.bits());
        ok(copy.step(3));
        assert_ne!(run.bits(), copy.bits());
        ok(run.step(3));
        assert_eq!(run.bits(), copy.bits());
        drop(run);
        ok(copy.step(1));

        // from a state that was read
        let mut second = copy.copy();
        ok(mbs_run_state(copy.pointer, q.as_mut_ptr(), v.as_mut_ptr(), 2));
        ok(mbs_run_set_start(second.pointer, 7.0, q.as_ptr(), v.as_ptr(), 2));
        second = second.started();
        assert_eq!(second.bits()[0], 7.0_f64.to_bits());
        ok(second.step(1));
        ok(copy.step(1));
        // nothing depends on time, but the steps that watch the pivots begin anew
        assert_eq!(second.bits()[6..], copy.bits()[6..]);
    }
}

#[test]
fn inputs_begin_at_their_declared_values() {
    unsafe {
        let pendulum = Mechanism::compiled(&PENDULUM.replace("input push [N];", "input push [N] = 2 [kN];"));
        let mut found = std::mem::MaybeUninit::<Quantity>::uninit();
        ok(mbs_describe(pendulum.0, INPUT, 0, found.as_mut_ptr()));
        assert_eq!(found.assume_init().value, 2000.0);
        let run = pendulum.run("", 1e-4).started();
        let mut inputs = [0.0];
        ok(mbs_run_inputs(run.pointer, inputs.as_mut_ptr(), 1));
        assert_eq!(inputs, [2000.0]);
    }
}

#[test]
fn null_is_answered() {
    unsafe {
        let pendulum = Mechanism::compiled(PENDULUM);
        let run = pendulum.run("", 1e-3);
        let (no, text, mut handle) = (null_mut(), c("x"), null_mut());
        assert_eq!(
            failed(mbs_compile(null(), null(), null(), 0.0, &mut handle)),
            (NULL, "`text` is NULL".into())
        );
        assert_eq!(mbs_compile(text.as_ptr(), null(), null(), 0.0, null_mut()), NULL);
        assert_eq!(mbs_read(null(), null(), 0.0, &mut handle), NULL);
        assert_eq!(mbs_read(text.as_ptr(), null(), 0.0, null_mut()), NULL);
        assert_eq!(mbs_mechanism_name(pendulum.0, null_mut()), NULL);
        assert_eq!(mbs_mechanism_name(no, &mut null()), NULL);
        assert_eq!(mbs_mechanism_freedom(pendulum.0, null_mut()), NULL);
        assert_eq!(mbs_count(no, INPUT, &mut 0), NULL);
        assert_eq!(mbs_count(pendulum.0, INPUT, null_mut()), NULL);
        assert_eq!(mbs_find(pendulum.0, INPUT, null(), &mut 0), NULL);
        assert_eq!(mbs_find(pendulum.0, INPUT, c("push").as_ptr(), null_mut()), NULL);
        assert_eq!(mbs_describe(pendulum.0, INPUT, 0, null_mut()), NULL);
        // a result that cannot be given is no reason to leave the other behind
        handle = std::ptr::dangling_mut();
        assert_eq!(failed(mbs_run_new(no, null(), 1e-3, &mut handle)), (NULL, "`mechanism` is NULL".into()));
        assert!(handle.is_null());
        assert_eq!(mbs_run_new(pendulum.0, null(), 1e-3, null_mut()), NULL);
        assert_eq!(mbs_run_clone(no, &mut handle), NULL);
        assert_eq!(mbs_run_clone(run.pointer, null_mut()), NULL);
        assert_eq!(mbs_run_set_parameter(no, 0, 1.0), NULL);
        assert_eq!(mbs_run_set_input(no, 0, 1.0), NULL);
        assert_eq!(mbs_run_set_start(no, 0.0, null(), null(), 2), NULL);
        assert_eq!(mbs_run_set_start(run.pointer, 0.0, null(), null(), 2), NULL);
        assert_eq!(mbs_run_set_tolerances(no, 1e-6, 1e-6), NULL);
        assert_eq!(mbs_run_set_gains(no, 1.0, 1.0), NULL);
        assert_eq!(mbs_run_start(no), NULL);
        assert_eq!(mbs_run_step(no, 1), NULL);
        assert_eq!(mbs_run_advance_to(no, 1.0), NULL);
        let run = run.started();
        let (mut kept, mut room) = (5.0, [0.0; 4]);
        assert_eq!(mbs_run_time(no, &mut kept), NULL);
        assert_eq!(mbs_run_time(run.pointer, null_mut()), NULL);
        assert_eq!(mbs_run_parameters(run.pointer, null_mut(), 2), NULL);
        assert_eq!(mbs_run_inputs(run.pointer, null_mut(), 1), NULL);
        assert_eq!(
            failed(mbs_run_state(run.pointer, room.as_mut_ptr(), null_mut(), 2)),
            (NULL, "`velocities` is NULL".into())
        );
        assert_eq!(mbs_run_reactions(run.pointer, null_mut(), 2, room.as_mut_ptr(), 1), NULL);
        assert_eq!(mbs_run_outputs(run.pointer, null_mut(), 1), NULL);
        assert_eq!(mbs_run_points(run.pointer, null_mut(), 4), NULL);
        assert_eq!(mbs_run_energy(run.pointer, &mut kept, null_mut()), NULL);
        assert_eq!(mbs_run_violation(run.pointer, null_mut(), &mut kept), NULL);
        assert_eq!(mbs_run_digits(run.pointer, null_mut()), NULL);
        assert_eq!(mbs_problem_at(0, null_mut()), NULL);
        // what failed wrote nothing
        assert_eq!((kept, room), (5.0, [0.0; 4]));
        mbs_mechanism_free(null_mut());
        mbs_run_free(null_mut());
    }
}

#[test]
fn counts_indices_and_names_are_checked() {
    unsafe {
        let pendulum = Mechanism::compiled(PENDULUM);
        let (mut index, mut handle) = (9, null_mut());
        assert_eq!(
            failed(mbs_find(pendulum.0, COORDINATE, c("z").as_ptr(), &mut index)),
            (NAME, "there is no coordinate `z`; known are x, y".into())
        );
        assert_eq!(mbs_find(pendulum.0, COORDINATE, c"\xff".as_ptr(), &mut index), UTF8);
        assert_eq!(error(), "`name` is no UTF-8 from byte 0 on");
        for kind in [0, 7, -1, c_int::MIN, c_int::MAX] {
            assert_eq!(mbs_count(pendulum.0, kind, &mut index), INDEX);
        }
        assert_eq!(
            failed(mbs_describe(pendulum.0, OUTPUT, 1, null_mut())),
            (INDEX, "there is no output with the index 1; there is one, with the index 0".into())
        );
        assert_eq!(index, 9);
        assert_eq!(mbs_run_new(pendulum.0, c("euler").as_ptr(), 1e-3, &mut handle), NAME);
        let schemes = mbs_runtime::SCHEMES.map(|scheme| scheme.word).join(", ");
        let start = format!("there is no method `euler`; it is one of {schemes}, or");
        assert!(error().starts_with(&start));
        for step in [-1e-3, f64::NAN, f64::INFINITY] {
            assert_eq!(mbs_run_new(pendulum.0, null(), step, &mut handle), VALUE);
        }
        assert_eq!(mbs_run_new(pendulum.0, null(), 0.0, &mut handle), VALUE);
        assert!(error().contains("the text declares none"));

        let run = pendulum.run("", 1e-3);
        assert_eq!(failed(mbs_run_step(run.pointer, 1)).0, NOT_STARTED);
        let mut numbers = [1.0; 8];
        assert_eq!(mbs_run_state(run.pointer, numbers.as_mut_ptr(), numbers.as_mut_ptr(), 2), NOT_STARTED);
        assert_eq!(mbs_run_set_parameter(run.pointer, 2, 1.0), INDEX);
        assert_eq!(mbs_run_set_input(run.pointer, usize::MAX, 1.0), INDEX);
        assert_eq!(failed(mbs_run_set_input(run.pointer, 0, f64::NAN)).0, VALUE);
        let run = run.started();
        for count in [0, 1, 3, usize::MAX] {
            assert_eq!(mbs_run_set_start(run.pointer, 0.0, numbers.as_ptr(), numbers.as_ptr(), count), COUNT);
            assert_eq!(mbs_run_state(run.pointer, numbers.as_mut_ptr(), null_mut(), count), COUNT);
            assert_eq!(mbs_run_parameters(run.pointer, numbers.as_mut_ptr(), count), COUNT);
            assert_eq!(mbs_run_points(run.pointer, numbers.as_mut_ptr(), count), COUNT);
        }
        assert_eq!(
            failed(mbs_run_outputs(run.pointer, numbers.as_mut_ptr(), 2)),
            (COUNT, "`values` has 2 numbers, but there have to be 1".into())
        );
        assert_eq!(mbs_run_inputs(run.pointer, numbers.as_mut_ptr(), 0), COUNT);
        assert_eq!(mbs_run_reactions(run.pointer, numbers.as_mut_ptr(), 2, numbers.as_mut_ptr(), 2), COUNT);
        assert_eq!(numbers, [1.0; 8]);
        // results may share a place, and need not be aligned
        let place = numbers.as_mut_ptr();
        ok(mbs_run_state(run.pointer, place, place, 2));
        assert_eq!(numbers[..2], [0.0; 2]);
        let odd = numbers.as_mut_ptr().cast::<u8>().add(1).cast::<f64>();
        ok(mbs_run_time(run.pointer, odd));
        ok(mbs_run_inputs(run.pointer, odd, 1));
        ok(mbs_run_set_start(run.pointer, 0.0, odd, odd, 2));
    }
}

#[test]
fn a_wrong_text_is_answered_with_its_places() {
    unsafe {
        let (wrong, mut handle) =
            (c("Fall {\n    dof = 1;\n    body ball (y) { mass = n; }\n}"), std::ptr::dangling_mut());
        let (status, text) =
            failed(mbs_compile(wrong.as_ptr(), c("fall.mbs").as_ptr(), null(), 0.0, &mut handle));
        assert_eq!(status, DECLARATION);
        assert!(handle.is_null());
        assert!(text.contains("fall.mbs:3:28") && !text.contains('\u{1b}'), "{text}");
        assert_eq!(mbs_problem_count(), 1);
        let mut problem = std::mem::MaybeUninit::<Problem>::uninit();
        assert_eq!(mbs_problem_at(1, problem.as_mut_ptr()), INDEX);
        // asking does not change what is asked for
        assert_eq!(error(), text);
        ok(mbs_problem_at(0, problem.as_mut_ptr()));
        let Problem { message, help, line, column, length } = problem.assume_init();
        assert_eq!((line, column, length), (3, 28, 1));
        assert!(said(message).contains("`n`") && text.contains(&said(message)));
        assert!(text.contains(&said(help)));
        // another failure has no problems of a text, and another thread none at all
        assert_eq!(mbs_read(c("no such file").as_ptr(), null(), 0.0, &mut handle), FILE);
        assert!(error().starts_with("the file `no such file` cannot be read: "));
        assert_eq!(mbs_problem_count(), 0);
        std::thread::spawn(|| assert_eq!(error(), "")).join().expect("a thread");
        assert_eq!(mbs_compile(c("P {}").as_ptr(), null(), null(), -1.0, &mut handle), VALUE);
        assert_eq!(mbs_compile(c"\xc3".as_ptr(), null(), null(), 0.0, &mut handle), UTF8);
    }
}

#[test]
fn what_does_not_go_together_is_refused_at_the_start() {
    unsafe {
        let pendulum = Mechanism::compiled(PENDULUM);
        let run = pendulum.run("heun", 1e-3);
        ok(mbs_run_set_parameter(run.pointer, 0, -1.0));
        let (status, text) = failed(mbs_run_start(run.pointer));
        assert!(status == VALUE && text.contains("`length` is -1, but"), "{text}");
        ok(mbs_run_set_parameter(run.pointer, 0, 0.5));
        assert_eq!(mbs_run_set_gains(run.pointer, -1.0, 1.0), VALUE);
        ok(mbs_run_set_gains(run.pointer, 1e6, 1e6));
        assert_eq!(mbs_run_start(run.pointer), METHOD);
        ok(mbs_run_set_gains(run.pointer, 100.0, 100.0));
        let run = run.started();
        let before = run.bits();
        // one that fails leaves the run as it was
        ok(mbs_run_set_start(run.pointer, 0.0, [2.0, 0.0].as_ptr(), [0.0; 2].as_ptr(), 2));
        assert_eq!(mbs_run_start(run.pointer), START);
        assert_eq!(run.bits(), before);

        assert_eq!(mbs_run_set_tolerances(run.pointer, 1e-30, 1e-9), VALUE);
        for (method, has_gains) in
            [("held", false), ("rattle", false), ("heun", false), ("", true), ("esdirk4", true)]
        {
            let run = pendulum.run(method, 1e-3);
            ok(mbs_run_set_tolerances(run.pointer, 1e-6, 1e-9));
            if has_gains {
                ok(mbs_run_set_gains(run.pointer, 1.0, 1.0));
            }
            assert_eq!(mbs_run_start(run.pointer), METHOD, "{method}");
        }
        for method in ["rattle4", "trbdf2", "esdirk4", "projection"] {
            let run = pendulum.run(method, 1e-3);
            ok(mbs_run_set_gains(run.pointer, 1.0, 1.0));
            assert_eq!(mbs_run_start(run.pointer), METHOD, "{method}");
        }
    }
}

#[test]
fn what_ends_a_run_leaves_the_last_good_state() {
    unsafe {
        let mut run = Mechanism::compiled(PENDULUM).run("", 1e-3).started();
        ok(run.step(2));
        let before = run.bits();
        assert_eq!(failed(mbs_run_advance_to(run.pointer, 0.0)).0, VALUE);
        ok(mbs_run_set_input(run.pointer, 0, 1e308));
        let (status, text) = failed(mbs_run_step(run.pointer, 3));
        assert!(status == DIVERGED && text.contains("no longer finite"), "{text}");
        ok(mbs_run_set_input(run.pointer, 0, 0.0));
        assert_eq!(run.bits(), before);
        ok(run.step(1));
    }
}

#[test]
fn statuses_have_words() {
    unsafe {
        assert_eq!(said(mbs_status_text(OK)), "no error");
        assert_eq!(said(mbs_status_text(INTERNAL)), "a mistake of the library");
        for other in [-1, INTERNAL + 1, c_int::MAX, c_int::MIN] {
            assert_eq!(said(mbs_status_text(other)), "unknown status");
        }
    }
}

#[test]
fn threads_share_a_mechanism_and_hand_on_a_run() {
    let pendulum = Mechanism::compiled(PENDULUM);
    let run = pendulum.run("", 1e-3).started();
    let ends = std::thread::scope(|scope| {
        let shared = &pendulum;
        let first = scope.spawn(move || {
            let mut run = run;
            ok(run.step(20));
            run
        });
        let second = scope.spawn(move || {
            let mut run = shared.run("", 1e-3).started();
            ok(run.step(20));
            run
        });
        [first, second].map(|thread| thread.join().expect("a thread").bits())
    });
    assert_eq!(ends[0], ends[1]);
}
