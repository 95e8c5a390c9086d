//! The library as C sees it: functions by their symbols, and handles that free themselves.
#![allow(unsafe_code, reason = "functions of C are called; each test keeps the contract of the header")]
#![allow(dead_code, reason = "each test uses a part of it")]
#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::path::{Path, PathBuf};
use std::ptr::{null, null_mut};

use mbs_runtime::System;
use mbs_runtime::equations::At;

pub use mbs::{Problem, Quantity};

/// A handle.
pub type Pointer = *mut c_void;

// declared anew, as C does it, and not imported
unsafe extern "C" {
    pub fn mbs_version() -> *const c_char;
    pub fn mbs_abi() -> u32;
    pub fn mbs_status_text(status: c_int) -> *const c_char;
    pub fn mbs_error() -> *const c_char;
    pub fn mbs_problem_count() -> usize;
    pub fn mbs_problem_at(index: usize, problem: *mut Problem) -> c_int;
    pub fn mbs_compile(
        text: *const c_char,
        file: *const c_char,
        name: *const c_char,
        limit: f64,
        mechanism: *mut Pointer,
    ) -> c_int;
    pub fn mbs_read(path: *const c_char, name: *const c_char, limit: f64, mechanism: *mut Pointer) -> c_int;
    pub fn mbs_mechanism_free(mechanism: Pointer);
    pub fn mbs_mechanism_name(mechanism: Pointer, name: *mut *const c_char) -> c_int;
    pub fn mbs_mechanism_freedom(mechanism: Pointer, freedom: *mut i32) -> c_int;
    pub fn mbs_count(mechanism: Pointer, kind: c_int, count: *mut usize) -> c_int;
    pub fn mbs_find(mechanism: Pointer, kind: c_int, name: *const c_char, index: *mut usize) -> c_int;
    pub fn mbs_describe(mechanism: Pointer, kind: c_int, index: usize, quantity: *mut Quantity) -> c_int;
    pub fn mbs_run_new(mechanism: Pointer, method: *const c_char, step: f64, run: *mut Pointer) -> c_int;
    pub fn mbs_run_clone(run: Pointer, copy: *mut Pointer) -> c_int;
    pub fn mbs_run_free(run: Pointer);
    pub fn mbs_run_set_parameter(run: Pointer, index: usize, value: f64) -> c_int;
    pub fn mbs_run_set_input(run: Pointer, index: usize, value: f64) -> c_int;
    pub fn mbs_run_set_start(run: Pointer, time: f64, q: *const f64, v: *const f64, count: usize) -> c_int;
    pub fn mbs_run_set_tolerances(run: Pointer, relative: f64, absolute: f64) -> c_int;
    pub fn mbs_run_set_gains(run: Pointer, alpha: f64, beta: f64) -> c_int;
    pub fn mbs_run_start(run: Pointer) -> c_int;
    pub fn mbs_run_step(run: Pointer, steps: u64) -> c_int;
    pub fn mbs_run_advance_to(run: Pointer, end: f64) -> c_int;
    pub fn mbs_run_time(run: Pointer, time: *mut f64) -> c_int;
    pub fn mbs_run_parameters(run: Pointer, values: *mut f64, count: usize) -> c_int;
    pub fn mbs_run_inputs(run: Pointer, values: *mut f64, count: usize) -> c_int;
    pub fn mbs_run_state(run: Pointer, q: *mut f64, v: *mut f64, count: usize) -> c_int;
    pub fn mbs_run_reactions(run: Pointer, a: *mut f64, n: usize, multipliers: *mut f64, m: usize) -> c_int;
    pub fn mbs_run_outputs(run: Pointer, values: *mut f64, count: usize) -> c_int;
    pub fn mbs_run_points(run: Pointer, places: *mut f64, count: usize) -> c_int;
    pub fn mbs_run_energy(run: Pointer, kinetic: *mut f64, potential: *mut f64) -> c_int;
    pub fn mbs_run_violation(run: Pointer, violation: *mut f64, rate: *mut f64) -> c_int;
    pub fn mbs_run_digits(run: Pointer, digits: *mut f64) -> c_int;
}

/// Numbers of the header, whose test reads them there.
pub const OK: c_int = 0;
pub const NULL: c_int = 1;
pub const UTF8: c_int = 2;
pub const COUNT: c_int = 3;
pub const INDEX: c_int = 4;
pub const NAME: c_int = 5;
pub const FILE: c_int = 6;
pub const DECLARATION: c_int = 7;
pub const VALUE: c_int = 8;
pub const METHOD: c_int = 9;
pub const NOT_STARTED: c_int = 10;
pub const START: c_int = 11;
pub const OUT_OF_REACH: c_int = 13;
pub const DIVERGED: c_int = 14;
pub const UNDEFINED: c_int = 15;
pub const INTERNAL: c_int = 17;

pub const PARAMETER: c_int = 1;
pub const INPUT: c_int = 2;
pub const COORDINATE: c_int = 3;
pub const OUTPUT: c_int = 4;
pub const CONSTRAINT: c_int = 5;
pub const POINT: c_int = 6;

/// A mechanism with one of each kind of quantities.
pub const PENDULUM: &str = "Pendulum {
    dof = 1;
    /// From the pivot to the bob.
    param length = 500 [mm] where length > 0;
    param weight = 2 [kg];
    input push [N];
    gravity = (0, -9.81) [m/s^2];
    body bob (x, y) { mass = weight; }
    constraint rod: x^2 + y^2 = length^2;
    force wind on bob = (push, 0 [N]);
    start { x = length; guess y = 0; }
    output height [mm] = y;
}";

/// A text for C.
pub fn c(text: &str) -> CString {
    CString::new(text).expect("a text without NUL")
}

/// A text of C as a string.
pub fn said(text: *const c_char) -> String {
    assert!(!text.is_null());
    // SAFETY: texts of the library end with a NUL and stay while they are read here
    let text = unsafe { CStr::from_ptr(text) };
    text.to_str().expect("UTF-8").to_owned()
}

/// The last error of this thread.
pub fn error() -> String {
    // SAFETY: it takes nothing
    said(unsafe { mbs_error() })
}

/// Checks that a status is 0; the panic shows the last error.
#[track_caller]
pub fn ok(status: c_int) {
    assert!(status == OK, "{status}: {}", error());
}

/// A mechanism that is freed in the end.
pub struct Mechanism(pub Pointer);

// SAFETY: the header says that threads may share it
unsafe impl Sync for Mechanism {}
// SAFETY: and hand it on
unsafe impl Send for Mechanism {}

impl Mechanism {
    /// A mechanism of a text.
    #[track_caller]
    pub fn compiled(text: &str) -> Self {
        let (text, mut mechanism) = (c(text), null_mut());
        // SAFETY: the text ends with a NUL, and the result has a place
        ok(unsafe { mbs_compile(text.as_ptr(), null(), null(), 0.0, &mut mechanism) });
        Self(mechanism)
    }

    /// How many quantities of a kind there are.
    pub fn count(&self, kind: c_int) -> usize {
        let mut count = 0;
        // SAFETY: the handle is not freed, and the result has a place
        ok(unsafe { mbs_count(self.0, kind, &mut count) });
        count
    }

    /// A run that is not started.
    #[track_caller]
    pub fn run(&self, method: &str, step: f64) -> Run {
        let (method, mut run) = (c(method), null_mut());
        // SAFETY: as above
        ok(unsafe { mbs_run_new(self.0, method.as_ptr(), step, &mut run) });
        let counts = [COORDINATE, CONSTRAINT, OUTPUT, POINT].map(|kind| self.count(kind));
        Run { pointer: run, counts }
    }
}

impl Drop for Mechanism {
    fn drop(&mut self) {
        // SAFETY: nobody uses it behind this
        unsafe { mbs_mechanism_free(self.0) };
    }
}

/// A run that is freed in the end.
pub struct Run {
    pub pointer: Pointer,
    /// Of coordinates, constraints, outputs and points.
    counts: [usize; 4],
}

// SAFETY: the header says that threads may hand it on
unsafe impl Send for Run {}

impl Run {
    /// Starts it.
    #[track_caller]
    pub fn started(self) -> Self {
        // SAFETY: the handle is not freed
        ok(unsafe { mbs_run_start(self.pointer) });
        self
    }

    /// Steps; the status.
    pub fn step(&mut self, steps: u64) -> c_int {
        // SAFETY: the handle is not freed
        unsafe { mbs_run_step(self.pointer, steps) }
    }

    /// A copy.
    pub fn copy(&self) -> Self {
        let mut copy = null_mut();
        // SAFETY: the handle is not freed, and the result has a place
        ok(unsafe { mbs_run_clone(self.pointer, &mut copy) });
        Self { pointer: copy, ..*self }
    }

    /// All that can be read, as bits.
    #[track_caller]
    pub fn bits(&self) -> Vec<u64> {
        let [n, m, outputs, points] = self.counts;
        let [mut t, mut kinetic, mut potential, mut violation, mut rate, mut digits] = [0.0; 6];
        let [mut q, mut v, mut a] = [(); 3].map(|()| vec![0.0; n]);
        let [mut multipliers, mut y, mut xy] = [m, outputs, 2 * points].map(|count| vec![0.0; count]);
        let run = self.pointer;
        // SAFETY: the handle is not freed, and arrays are as long as the counts beside them
        unsafe {
            ok(mbs_run_time(run, &mut t));
            ok(mbs_run_state(run, q.as_mut_ptr(), v.as_mut_ptr(), n));
            ok(mbs_run_reactions(run, a.as_mut_ptr(), n, multipliers.as_mut_ptr(), m));
            ok(mbs_run_outputs(run, y.as_mut_ptr(), outputs));
            ok(mbs_run_points(run, xy.as_mut_ptr(), 2 * points));
            ok(mbs_run_energy(run, &mut kinetic, &mut potential));
            ok(mbs_run_violation(run, &mut violation, &mut rate));
            ok(mbs_run_digits(run, &mut digits));
        }
        let scalars = vec![t, kinetic, potential, violation, rate, digits];
        [scalars, q, v, a, multipliers, y, xy].concat().into_iter().map(f64::to_bits).collect()
    }
}

impl Drop for Run {
    fn drop(&mut self) {
        // SAFETY: nobody uses it behind this
        unsafe { mbs_run_free(self.pointer) };
    }
}

/// Driven and free, with friction, tables, inputs, redundant constraints, own states and events.
pub const LIBRARY: [&str; 12] = [
    "slider_crank",
    "slider_crank_free",
    "four_bar",
    "four_bar_free",
    "double_pendulum",
    "cam_follower",
    "block_on_incline",
    "geared_motor",
    "dc_motor",
    "differential_drive",
    "tipper",
    "jansen",
];

/// The file of a mechanism of the library.
pub fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/src").join(format!("{name}.rs"))
}

/// All that can be read of a run in Rust, in the order of [`Run::bits`].
pub fn rust_bits(run: &dyn System) -> Vec<u64> {
    let info = run.equations().info();
    let (n, m) = (info.coordinates.len(), info.constraints.len());
    let [mut q, mut v, mut a] = [(); 3].map(|()| vec![0.0; n]);
    let [mut multipliers, mut y] = [m, info.outputs.len()].map(|count| vec![0.0; count]);
    let mut xy = vec![0.0; 2 * run.sketch().points.len()];
    run.state(&mut q, &mut v);
    run.reactions(&mut a, &mut multipliers).expect("reactions");
    run.outputs(&a, &multipliers, &mut y).expect("outputs");
    run.points(run.time(), &q, &mut xy);
    let [kinetic, potential] = run.energies(At { t: run.time(), q: &q, v: &v });
    let [violation, rate] = run.violations();
    let scalars = vec![run.time(), kinetic, potential, violation, rate, run.digits_left()];
    [scalars, q, v, a, multipliers, y, xy].concat().into_iter().map(f64::to_bits).collect()
}
