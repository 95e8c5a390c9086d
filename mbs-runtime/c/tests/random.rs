//! Random sequences of calls with null pointers, wrong counts, unknown names and indices and wild numbers: every one
//! gives a status of the header, nothing is written beside its place, and what worked before works behind it.
#![allow(unsafe_code, reason = "functions of C are called; the contract of the header is kept and no more")]
#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

mod support;

use std::cell::RefCell;
use std::ffi::{CString, c_int};
use std::ptr::{null, null_mut};

use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use support::*;

/// The arguments of a call; each function takes those that it needs.
#[derive(Clone, Debug)]
struct Given {
    function: u8,
    handle: u8,
    is_null: [bool; 2],
    kind: c_int,
    index: usize,
    count: usize,
    number: f64,
    other: f64,
    text: CString,
}

const WORDS: [&str; 10] =
    ["x", "push", "length", "rk4", "heun per-stage", "rattle", "trbdf2", "dopri5 projection", "", "Ünknown"];

fn texts(path: &str) -> impl Strategy<Value = CString> {
    let words = prop::sample::select(&WORDS[..]).prop_map(c);
    let declarations =
        prop::sample::select(&[PENDULUM, "P {", "P { dof = 1; }", "mechanism! { }"][..]).prop_map(c);
    let bytes =
        prop::collection::vec(1..=u8::MAX, 0..20).prop_map(|bytes| CString::new(bytes).unwrap_or_default());
    prop_oneof![4 => words, 1 => Just(c(path)), 2 => declarations, 1 => bytes]
}

fn numbers() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -3.0..3.0,
        2 => prop::sample::select(&[0.0, 1e-3, 0.01, 1e-6, 50.0, 1e300, -1e300, f64::INFINITY, f64::NAN][..]),
        1 => any::<f64>(),
    ]
}

/// How many functions `call` knows, and the last of them.
const FUNCTIONS: usize = 28;
const PROBLEM_AT: u8 = 27;

/// Starts and steps more often, since so much waits for them, and what waits for a text that is wrong.
fn functions() -> impl Strategy<Value = u8> {
    prop_oneof![8 => 0..=PROBLEM_AT, 1 => 14..=15_u8, 1 => Just(PROBLEM_AT)]
}

fn given(path: &str) -> impl Strategy<Value = Given> {
    let small = || prop_oneof![6 => 0..3_usize, 1 => 3..5_usize, 1 => any::<usize>()];
    let kinds = prop_oneof![6 => 1..7_i32, 1 => 0..8, 1 => any::<c_int>()];
    let is_null = [prop::bool::weighted(0.1), prop::bool::weighted(0.1)];
    let whole = (functions(), any::<u8>(), is_null, kinds, small(), small());
    (whole, numbers(), numbers(), texts(path)).prop_map(|(whole, number, other, text)| {
        let (function, handle, is_null, kind, index, count) = whole;
        Given { function, handle, is_null, kind, index, count, number, other, text }
    })
}

/// Room with numbers around it that nobody may touch.
struct Guarded([f64; 12]);

/// As many as the pendulum has of anything.
const MOST: usize = 4;

impl Guarded {
    const GUARD: f64 = 1234.5;

    /// A place that is null if so said.
    fn place(&mut self, is_null: bool) -> *mut f64 {
        if is_null { null_mut() } else { self.0[4..].as_mut_ptr() }
    }

    fn is_whole(&self) -> bool {
        self.0[..4].iter().chain(&self.0[4 + MOST..]).all(|x| *x == Self::GUARD)
    }
}

/// Mechanisms and runs that are there.
struct Handles {
    mechanisms: Vec<Pointer>,
    runs: Vec<Pointer>,
}

/// Makes a call; the answer is a status.
fn call(given: &Given, handles: &mut Handles) -> c_int {
    let Given { function, handle, is_null, kind, index, count, number, other, text } = given;
    let (kind, index, count, number, other) = (*kind, *index, *count, *number, *other);
    // one in eight is null
    let pick = |all: &[Pointer]| match usize::from(*handle) {
        at if at.is_multiple_of(8) => null_mut(),
        at => all[at / 8 % all.len()],
    };
    let (mechanism, run) = (pick(&handles.mechanisms), pick(&handles.runs));
    let [mut first, mut second] = [Guarded([Guarded::GUARD; 12]), Guarded([Guarded::GUARD; 12])];
    let [a, b] = [first.place(is_null[0]), second.place(is_null[1])];
    let text = if is_null[0] { null() } else { text.as_ptr() };
    let (mut name, mut whole, mut small, mut new) = (null(), 0, 0, null_mut());
    let mut quantity = Quantity { name: null(), doc: null(), unit: null(), scale: 0.0, value: 0.0 };
    let mut problem = Problem { message: null(), help: null(), line: 0, column: 0, length: 0 };
    // an array is no longer than the room that there is; where a count is wrong it is not touched
    // SAFETY: handles are null or not freed, texts end with a NUL, and places have room for `MOST` numbers, which is
    // no less than any count that the pendulum has
    let status = unsafe {
        match function {
            0 => mbs_compile(text, null(), if is_null[1] { null() } else { c"P".as_ptr() }, 0.0, &mut new),
            1 => mbs_read(text, null(), 0.0, if is_null[1] { null_mut() } else { &mut new }),
            2 => mbs_mechanism_name(mechanism, if is_null[1] { null_mut() } else { &mut name }),
            3 => mbs_mechanism_freedom(mechanism, if is_null[1] { null_mut() } else { &mut small }),
            4 => mbs_count(mechanism, kind, if is_null[1] { null_mut() } else { &mut whole }),
            5 => mbs_find(mechanism, kind, text, if is_null[1] { null_mut() } else { &mut whole }),
            6 => mbs_describe(mechanism, kind, index, if is_null[1] { null_mut() } else { &mut quantity }),
            7 => mbs_run_new(
                mechanism,
                text,
                mild(number, 1e-9, 0.1),
                if is_null[1] { null_mut() } else { &mut new },
            ),
            8 => mbs_run_clone(run, if is_null[1] { null_mut() } else { &mut new }),
            9 => mbs_run_set_parameter(run, index, mild(number, 0.01, 100.0)),
            10 => mbs_run_set_input(run, index, mild(number, 0.01, 100.0)),
            11 => mbs_run_set_start(run, number, a, b, count),
            12 => mbs_run_set_tolerances(run, mild(number, 1e-7, 1.0), mild(other, 1e-7, 1.0)),
            13 => mbs_run_set_gains(run, number, other),
            14 => mbs_run_start(run),
            15 => mbs_run_step(run, u64::from(*handle) % 8),
            16 => mbs_run_advance_to(run, not_behind(run, number)),
            17 => mbs_run_time(run, a),
            18 => mbs_run_parameters(run, a, count),
            19 => mbs_run_inputs(run, a, count),
            20 => mbs_run_state(run, a, b, count),
            21 => mbs_run_reactions(run, a, count, b, index),
            22 => mbs_run_outputs(run, a, count),
            23 => mbs_run_points(run, a, count),
            24 => mbs_run_energy(run, a, b),
            25 => mbs_run_violation(run, a, b),
            26 => mbs_run_digits(run, a),
            _ => mbs_problem_at(index, if is_null[1] { null_mut() } else { &mut problem }),
        }
    };
    assert!(first.is_whole() && second.is_whole(), "{given:?}");
    let is_answered = *function == PROBLEM_AT || status == OK || !error().is_empty();
    assert!(is_answered, "{given:?}");
    if status != OK {
        assert!(new.is_null(), "{given:?}");
    } else if !new.is_null() {
        let all = if *function < 2 { &mut handles.mechanisms } else { &mut handles.runs };
        all.push(new);
    }
    status
}

/// The present time, and so no step, or one before it; a step may be so small that none but a few can be made.
unsafe fn not_behind(run: Pointer, number: f64) -> f64 {
    let mut now = 0.0;
    // SAFETY: the run is null or not freed, and the result has a place
    unsafe { mbs_run_time(run, &mut now) };
    if number.is_finite() { now - number.abs() } else { number }
}

/// A run to a tolerance takes as many steps as a motion asks for, which is any number where dimensions, forces or
/// intervals are wild. So those are neither small nor large; what is no number or 0 stays so.
fn mild(number: f64, least: f64, most: f64) -> f64 {
    let is_number = number.is_finite() && number != 0.0;
    if is_number { number.abs().clamp(least, most).copysign(number) } else { number }
}

/// How often each function did what was asked, and how often it refused.
type Seen = [[u32; 2]; FUNCTIONS];

fn run_calls(pendulum: &Mechanism, calls: &[Given], seen: &mut Seen) {
    let first = pendulum.run("", 1e-3);
    let (mechanisms, runs) = (vec![pendulum.0], vec![first.pointer]);
    let mut handles = Handles { mechanisms, runs };
    for given in calls {
        let status = call(given, &mut handles);
        assert!((OK..INTERNAL).contains(&status), "{status} of {given:?}: {}", error());
        seen[usize::from(given.function)][usize::from(status != OK)] += 1;
    }
    // SAFETY: each is freed once; the first ones free themselves
    unsafe {
        handles.mechanisms.drain(1..).for_each(|mechanism| mbs_mechanism_free(mechanism));
        handles.runs.drain(1..).for_each(|run| mbs_run_free(run));
    }
    // another run is what it would have been
    let mut after = pendulum.run("rk4", 1e-3).started();
    ok(after.step(3));
    assert_eq!(after.bits()[0], 0.003_f64.to_bits());
}

#[test]
fn every_call_is_answered() {
    let file = tempfile::NamedTempFile::new().expect("a file");
    std::fs::write(&file, PENDULUM).expect("a text");
    let path = file.path().to_str().expect("a path of UTF-8");
    let pendulum = Mechanism::compiled(PENDULUM);
    let seen = RefCell::new([[0; 2]; FUNCTIONS]);
    let config = ProptestConfig { cases: 512, failure_persistence: None, ..ProptestConfig::default() };
    TestRunner::new(config)
        .run(&prop::collection::vec(given(path), 1..100), |calls| {
            run_calls(&pendulum, &calls, &mut seen.borrow_mut());
            Ok(())
        })
        .unwrap_or_else(|error| panic!("{error}"));
    let seen = seen.into_inner();
    eprintln!("{seen:?}");
    assert!(seen.iter().flatten().all(|&count| count > 0), "{seen:?}");
}
