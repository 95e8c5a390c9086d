//! A step of a healthy motion allocates nothing, as the header says.
#![allow(unsafe_code, reason = "functions of C, and an allocator that counts and passes on")]
#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

mod support;

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use support::{Mechanism, PENDULUM, mbs_run_set_input, mbs_run_time, ok};

/// Counts what this thread allocates.
struct Counting;

thread_local! {
    static ALLOCATED: Cell<u64> = const { Cell::new(0) };
}

// SAFETY: everything is passed on
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // a thread that ends counts no more
        let _ = ALLOCATED.try_with(|count| count.set(count.get() + 1));
        // SAFETY: as the caller promised
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: as the caller promised
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

#[test]
fn steps_allocate_nothing() {
    for method in ["", "rk4", "rk4 per-stage", "heun projection"] {
        let pendulum = Mechanism::compiled(PENDULUM);
        let mut run = pendulum.run(method, 1e-3).started();
        ok(run.step(1));
        let before = ALLOCATED.get();
        assert!(before > 0);
        let mut t = 0.0;
        for k in 0..500 {
            // SAFETY: the handle is not freed, and the result has a place
            unsafe {
                ok(mbs_run_set_input(run.pointer, 0, f64::from(k % 3)));
                ok(mbs_run_time(run.pointer, &mut t));
            }
            ok(run.step(1));
        }
        assert_eq!(ALLOCATED.get(), before, "{method}");
    }
}
